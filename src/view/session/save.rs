//! Saving what was played, so that it can be rendered again bit for bit.

use std::path::{Path, PathBuf};

use super::Session;
use crate::output::write_whole;
use crate::view::error::WindowError;

impl Session {
    /// Writes the scene to `path`, its meshes to where it looks for them from there, and what has been done
    /// beside it, with ending `.inputs`: `motes render` with `--inputs` makes the same run of them. The
    /// recording's path.
    ///
    /// # Errors
    /// It cannot be written, or there is another file where a mesh would go.
    pub fn save_as(&self, path: &Path) -> Result<PathBuf, WindowError> {
        if path.extension().is_none_or(|ending| ending != "toml") {
            let told = format!("{}: a scene's file ends in .toml", path.display());
            return Err(wrong(&told));
        }
        if let Some((to, _)) = self.on_the_way() {
            let told = format!("the run is on its way to frame {to}: save it when it is there");
            return Err(wrong(&told));
        }
        let files = self.source.files().map_err(WindowError::Scene)?;
        let meshes = self.meshes_beside(path)?;
        let inputs = path.with_extension("inputs");
        let sets = self.source.first_sets();
        let sets = sets.iter().map(|set| format!(" --set {}", shell_word(set)));
        let sets: String = sets.collect();
        let outside = match self.source.loader.allow_outside {
            true => " --allow-outside",
            false => "",
        };
        let head = format!(
            "# motes render {}{sets}{outside} --inputs {} --frames 0..{}\n",
            shell_word(&path.display().to_string()),
            shell_word(&inputs.display().to_string()),
            self.frame() + 1
        );
        for (place, bytes) in meshes {
            if let Some(folder) = place.parent() {
                let made = std::fs::create_dir_all(folder);
                made.map_err(|error| wrong(&format!("{}: {error}", folder.display())))?;
            }
            write_whole(&place, &bytes).map_err(WindowError::Output)?;
        }
        write_whole(&inputs, (head + &self.recording.to_text()).as_bytes())
            .map_err(WindowError::Output)?;
        write_whole(path, files.draft.text().as_bytes()).map_err(WindowError::Output)?;
        Ok(inputs)
    }

    /// Meshes that a scene at `path` would look for where there is none yet, with their bytes.
    fn meshes_beside(&self, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, WindowError> {
        let files = self.source.files().map_err(WindowError::Scene)?;
        let read = files.draft.companions();
        let read = read.map_err(|told| wrong(&format!("a mesh of the scene: {told}")))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut missing = Vec::new();
        for (name, bytes) in read {
            let place = folder.join(name);
            match std::fs::read(&place) {
                Ok(there) if there == bytes => {}
                Ok(_) => {
                    let told = "there is another file where the scene's mesh would go: save it to \
                                another folder";
                    return Err(wrong(&format!("{}: {told}", place.display())));
                }
                Err(_) => missing.push((place, bytes)),
            }
        }
        Ok(missing)
    }
}

/// A word as shells take it.
fn shell_word(text: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./=:,+@%".contains(letter);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

fn wrong(told: &str) -> WindowError {
    WindowError::Scene(format!("error: {told}"))
}
