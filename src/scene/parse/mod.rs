//! TOML → [`Scene`]: each key of the [`schema`](super::schema) goes to its place in the types.

mod fire;
mod flock;
mod spread;
mod system;
mod wind;

use std::path::PathBuf;
use std::rc::Rc;

use self::fire::fires;
use self::flock::flocks;
use self::system::systems;
use self::wind::wind;
use super::check;
use super::files::Files;
use super::read::{Reader, Spot};
use super::schema::{CAMERA, GROUND, IMAGE, LAMP, LAYER, LIGHT, PILLAR, PLANET, SCENE, SURFACE};
use super::set;
use super::set::Set;
use super::tracks;
use super::tree::{self, Node, Source};
use super::values::{Quantity, choice, list, text, whole, whole32};
use super::{
    Camera, Ground, Image, Lamp, Layer, Light, LitSurface, Pillar, Planet, Projection, Scene,
    SceneError, ShutterWeighting,
};

/// A scene's text, read but not yet checked, so that values can be changed.
pub(crate) struct Draft {
    root: Node,
    name: String,
    files: Rc<Files>,
}

impl Draft {
    /// Reads a text as [`Loader::parse`](super::Loader::parse) does; it names these files.
    pub(super) fn new(
        text: &str,
        file: &str,
        name: &str,
        files: Files,
    ) -> Result<Self, SceneError> {
        // Some editors begin a text with a byte order mark.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let source = Rc::new(Source {
            file: file.to_owned(),
            text: text.to_owned(),
            first_line: Some(1),
        });
        let mut root = tree::document(&source)?;
        // Where something is missing from the whole file, its first character stands for it.
        root.at.span = 0..0;
        let name = name.to_owned();
        Ok(Self {
            root,
            name,
            files: Rc::new(files),
        })
    }

    /// Changes a value.
    pub(crate) fn set(&mut self, set: &Set) -> Result<(), SceneError> {
        set::apply(&mut self.root, set)
    }

    /// Another one with these changes, `path.to.key=value`, that reads no file a second time.
    #[cfg(feature = "view")]
    pub(crate) fn with(&self, sets: &[String]) -> Result<Self, SceneError> {
        let mut changed = Self {
            root: self.root.clone(),
            name: self.name.clone(),
            files: Rc::clone(&self.files),
        };
        for set in sets {
            changed.set(&Set::argument(set))?;
        }
        Ok(changed)
    }

    /// The text that it was read from.
    #[cfg(feature = "view")]
    pub(crate) fn text(&self) -> &str {
        &self.root.at.source.text
    }

    /// Files that its text needs beside it, by their places relative to it, with their bytes.
    #[cfg(feature = "view")]
    pub(crate) fn companions(&self) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        self.files.companions()
    }

    /// What can be turned, as it is now; of a scene that is right.
    #[cfg(feature = "view")]
    pub(crate) fn knobs(&self) -> Result<Vec<super::Knob>, SceneError> {
        super::knobs::of_tree(&self.root)
    }

    /// Every file that was opened for it up to now, with what it is to the scene: its own, meshes,
    /// and their buffers.
    pub(crate) fn files(&self) -> Vec<(&'static str, PathBuf)> {
        self.files.opened()
    }

    /// An error about the key of that path, or what is around it where it is not written; `None` if
    /// nothing of the path is there.
    pub(crate) fn error_at(&self, path: &str, what: &str, help: &str) -> Option<SceneError> {
        set::place_of(&self.root, path).map(|at| at.error(what, help))
    }

    /// The scene that it is now, checked.
    pub(crate) fn scene(&self) -> Result<Scene, SceneError> {
        scene(&self.root, &self.name, &self.files)
    }
}

fn scene(root: &Node, name: &str, files: &Files) -> Result<Scene, SceneError> {
    let table = Reader::new(String::new(), SCENE, root)?;
    let table = if table.has("flock") || table.has("fire") {
        table
    } else {
        table.needs("system")
    };
    let mut scene = Scene {
        name: name.to_owned(),
        title: table.may("title", text)?.unwrap_or_else(|| name.to_owned()),
        description: table.must("description", text)?,
        frames: table.must("frames", whole32)?,
        frame_rate: table.must("frame_rate", whole32)?,
        seed: table.must("seed", whole)?,
        capacity: table.may("capacity", whole32)?,
        max_systems: table.may("max_systems", whole32)?,
        steady_particles: table.may("steady_particles", whole32)?,
        image: table.must("image", image)?,
        camera: table.must("camera", camera)?,
        systems: table
            .may("system", |spot| systems(spot, files))?
            .unwrap_or_default(),
        flocks: table.must("flock", |spot| flocks(spot, files))?,
        fires: table.must("fire", |spot| fires(spot, files))?,
        light: table.must("light", light)?,
        planet: table.may("planet", planet)?,
        lamps: table.must("lamp", |spot| list(spot, lamp))?,
        ground: table.may("ground", ground)?,
        pillars: table.must("pillar", |spot| list(spot, pillar))?,
        surfaces: table.must("surface", |spot| list(spot, |_, spot| surface(spot, files)))?,
        winds: table.must("wind", |spot| list(spot, wind))?,
        layers: table.must("layer", |spot| list(spot, layer))?,
        tracks: Vec::new(),
    };
    if scene.systems.is_empty() && scene.flocks.is_empty() && scene.fires.is_empty() {
        return Err(table.missing("system"));
    }
    check::unique_names(root)?;
    tracks::collect(root, &mut scene)?;
    check::tracks(&scene, root)?;
    Ok(scene)
}

fn image(spot: &Spot<'_>) -> Result<Image, SceneError> {
    let table = Reader::new(spot.path.clone(), IMAGE, spot.node)?;
    let image = Image {
        width: table.must("width", whole32)?,
        height: table.must("height", whole32)?,
        background: table.must("background", Quantity::read)?,
        shutter: table.must("shutter", Quantity::read)?,
        shutter_weighting: [ShutterWeighting::Camera, ShutterWeighting::Eye]
            [table.must("shutter_weighting", choice)?],
        exposure: table.must("exposure", Quantity::read)?,
    };
    check::image(&image, &table)?;
    Ok(image)
}

fn camera(spot: &Spot<'_>) -> Result<Camera, SceneError> {
    let table = Reader::new(spot.path.clone(), CAMERA, spot.node)?;
    let camera = Camera {
        position: table.must("position", Quantity::read)?,
        target: table.must("target", Quantity::read)?,
        up: table.must("up", Quantity::read)?,
        projection: [Projection::Perspective, Projection::Orthographic]
            [table.must("projection", choice)?],
        view_height: table.must("view_height", Quantity::read)?,
        vertical_fov_degrees: table.must("vertical_fov_degrees", Quantity::read)?,
        near: table.must("near", Quantity::read)?,
    };
    check::camera(&camera, &table)?;
    Ok(camera)
}

fn light(spot: &Spot<'_>) -> Result<Light, SceneError> {
    let table = Reader::new(spot.path.clone(), LIGHT, spot.node)?;
    Ok(Light {
        direction: table.must("direction", check::direction)?,
        color: table.must("color", Quantity::read)?,
        ambient: table.must("ambient", Quantity::read)?,
        shadow_center: table.must("shadow_center", Quantity::read)?,
        shadow_radius: table.may("shadow_radius", Quantity::read)?,
        shadow_cells: table.must("shadow_cells", whole32)?,
    })
}

fn planet(spot: &Spot<'_>) -> Result<Planet, SceneError> {
    let table = Reader::new(spot.path.clone(), PLANET, spot.node)?;
    Ok(Planet {
        center: table.must("center", Quantity::read)?,
        radius: table.must("radius", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        relief: table.must("relief", Quantity::read)?,
        contrast: table.must("contrast", Quantity::read)?,
        scale: table.must("scale", Quantity::read)?,
        octaves: table.must("octaves", whole32)?,
    })
}

fn ground(spot: &Spot<'_>) -> Result<Ground, SceneError> {
    let table = Reader::new(spot.path.clone(), GROUND, spot.node)?;
    Ok(Ground {
        position: table.must("position", Quantity::read)?,
        normal: table.must("normal", check::direction)?,
        radius: table.must("radius", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        contrast: table.must("contrast", Quantity::read)?,
        scale: table.must("scale", Quantity::read)?,
        octaves: table.must("octaves", whole32)?,
    })
}

fn pillar(_: usize, spot: &Spot<'_>) -> Result<Pillar, SceneError> {
    let table = Reader::new(spot.path.clone(), PILLAR, spot.node)?;
    Ok(Pillar {
        position: table.must("position", Quantity::read)?,
        radius: table.must("radius", Quantity::read)?,
        height: table.must("height", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        translucence: table.must("translucence", Quantity::read)?,
        depth: table.must("depth", Quantity::read)?,
    })
}

fn surface(spot: &Spot<'_>, files: &Files) -> Result<LitSurface, SceneError> {
    let table = Reader::new(spot.path.clone(), SURFACE, spot.node)?;
    Ok(LitSurface {
        mesh: table.must("mesh", |spot| files.mesh(spot))?,
        position: table.must("position", Quantity::read)?,
        rotation_degrees: table.must("rotation_degrees", Quantity::read)?,
        scale: table.must("scale", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        grain: table.may("grain", spread::grain)?,
        crease_degrees: table.must("crease_degrees", Quantity::read)?,
    })
}

fn lamp(_: usize, spot: &Spot<'_>) -> Result<Lamp, SceneError> {
    let table = Reader::new(spot.path.clone(), LAMP, spot.node)?;
    Ok(Lamp {
        position: table.must("position", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        distance: table.must("distance", Quantity::read)?,
    })
}

fn layer(_: usize, spot: &Spot<'_>) -> Result<Layer, SceneError> {
    let table = Reader::new(spot.path.clone(), LAYER, spot.node)?;
    Ok(Layer {
        name: table.must("name", text)?,
        point: table.must("point", Quantity::read)?,
        normal: table.must("normal", check::direction)?,
    })
}
