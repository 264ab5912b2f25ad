//! Loading a scene by name or by path, with the files that it names.

use super::builtin::{SceneText, text_of};
use super::files::Files;
use super::parse::Draft;
use super::set::Set;
use super::{Knob, Scene, SceneError};

/// How scenes are loaded. Paths in a scene are relative to its file's folder; those of a built-in
/// scene name files that the program carries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Loader {
    /// Whether a scene may name files outside of its folder: by absolute paths, by `..`, through
    /// links. For scenes whose writer is trusted with all that the process may read. Paths of a
    /// built-in scene are then relative to the current folder where the program carries no such file.
    pub allow_outside: bool,
}

impl Loader {
    /// Loads a scene: a file if `name_or_path` ends in `.toml` or has a slash in it, else a
    /// built-in scene. The scene's name is the built-in name or the file's stem.
    ///
    /// # Errors
    /// If there is no such scene or file, the file cannot be read, is larger than 1 MiB or is not
    /// UTF-8, and as [`Loader::parse`].
    pub fn load(&self, name_or_path: &str) -> Result<Scene, SceneError> {
        self.load_with(name_or_path, &[])
    }

    /// [`Loader::load`], with values changed before they are checked.
    ///
    /// Each of `sets` is `path.to.key=value`. The path's parts are keys, indices of arrays from 0,
    /// or names of systems and layers: `image.width`, `system.0.speed.mean`,
    /// `system.jet.speed.keys.1`. The value is TOML, or else a text that begins with a letter:
    /// `title=Fire`. It replaces whatever was there; later sets see what earlier ones did. Paths
    /// of files are relative to the scene's folder here, too.
    ///
    /// # Errors
    /// As [`Loader::load`]; and if a set has no `=`, no value, or a path that leads nowhere. An
    /// error that comes from a set shows that set in place of a line of the file.
    pub fn load_with(&self, name_or_path: &str, sets: &[String]) -> Result<Scene, SceneError> {
        let sets: Vec<Set> = sets.iter().map(|set| Set::argument(set)).collect();
        self.draft(name_or_path, &sets)?.scene()
    }

    /// Reads a scene from TOML.
    ///
    /// `file` is what errors call the text, and paths in it are relative to that file's folder;
    /// `name` becomes [`Scene::name`] and, if the text has no title, [`Scene::title`].
    ///
    /// # Errors
    /// If the text is not TOML, or a key is unknown, missing, of the wrong kind, out of range or
    /// at odds with another; if a file that it names cannot be read, is not right, or lies where
    /// it may not. The first such thing is reported.
    pub fn parse(&self, text: &str, file: &str, name: &str) -> Result<Scene, SceneError> {
        Draft::new(text, file, name, Files::beside(file, self.allow_outside))?.scene()
    }

    /// Every number, flag and choice of a scene that can be set by itself, in the order of the
    /// [`schema`](super::schema), of a scene as [`Loader::load`] takes it.
    ///
    /// # Errors
    /// As [`Loader::load`].
    pub fn knobs(&self, name_or_path: &str) -> Result<Vec<Knob>, SceneError> {
        let scene = text_of(name_or_path)?;
        // Only what is right has knobs to speak of.
        self.open(&scene)?.scene()?;
        super::knobs::of_text(scene)
    }

    /// A scene as [`Loader::load`] has it, with these changes made and more to come.
    pub(crate) fn draft(&self, name_or_path: &str, sets: &[Set]) -> Result<Draft, SceneError> {
        let mut draft = self.open(&text_of(name_or_path)?)?;
        for set in sets {
            draft.set(set)?;
        }
        Ok(draft)
    }

    fn open(&self, scene: &SceneText) -> Result<Draft, SceneError> {
        let SceneText { text, file, name } = scene;
        let files = match scene.is_builtin() {
            true => Files::carried(self.allow_outside),
            false => Files::beside(file, self.allow_outside),
        };
        Draft::new(text, file, name, files)
    }
}

/// [`Loader::load`] of files in the scene's folder alone.
///
/// # Errors
/// As [`Loader::load`].
pub fn load(name_or_path: &str) -> Result<Scene, SceneError> {
    Loader::default().load(name_or_path)
}

/// [`Loader::load_with`] of files in the scene's folder alone.
///
/// # Errors
/// As [`Loader::load_with`].
pub fn load_with(name_or_path: &str, sets: &[String]) -> Result<Scene, SceneError> {
    Loader::default().load_with(name_or_path, sets)
}

/// [`Loader::parse`] of files in the folder of `file` alone.
///
/// # Errors
/// As [`Loader::parse`].
pub fn parse(text: &str, file: &str, name: &str) -> Result<Scene, SceneError> {
    Loader::default().parse(text, file, name)
}

/// [`Loader::knobs`] of files in the scene's folder alone.
///
/// # Errors
/// As [`Loader::knobs`].
pub fn knobs(name_or_path: &str) -> Result<Vec<Knob>, SceneError> {
    Loader::default().knobs(name_or_path)
}
