//! TOML → [`Scene`]: each key of the [`schema`](super::schema) goes to its place in the types.

use std::rc::Rc;

use super::check;
use super::read::{Reader, Spot};
use super::schema::{CAMERA, IMAGE, Kind, SCENE, SYSTEM};
use super::set;
use super::tree::{self, Node, Source, Value};
use super::values::{Quantity, changing, choice, spread, text, variant, whole, whole32};
use super::{
    BirthRounding, Births, Camera, GenerationShape, Image, ParticleShape, Scene, SceneError,
    StreakLight, System,
};

/// Reads a scene from TOML.
///
/// `file` is what errors call the text; `name` becomes [`Scene::name`] and, if the text has no
/// title, [`Scene::title`].
///
/// # Errors
/// If the text is not TOML, or a key is unknown, missing, of the wrong kind, out of range or at
/// odds with another. The first such thing is reported.
pub fn parse(text: &str, file: &str, name: &str) -> Result<Scene, SceneError> {
    parse_with(text, file, name, &[])
}

/// [`parse`], with values changed on the way: see [`load_with`](super::load_with).
pub(super) fn parse_with(
    text: &str,
    file: &str,
    name: &str,
    sets: &[String],
) -> Result<Scene, SceneError> {
    let source = Rc::new(Source {
        file: file.to_owned(),
        text: text.to_owned(),
        numbered: true,
    });
    let mut root = tree::document(&source)?;
    // Where something is missing from the whole file, its first character stands for it.
    root.at.span = 0..0;
    for set in sets {
        set::apply(&mut root, set)?;
    }
    scene(&root, name)
}

fn scene(root: &Node, name: &str) -> Result<Scene, SceneError> {
    let table = Reader::new(String::new(), SCENE, root)?;
    Ok(Scene {
        name: name.to_owned(),
        title: table.may("title", text)?.unwrap_or_else(|| name.to_owned()),
        description: table.must("description", text)?,
        frames: table.must("frames", whole32)?,
        frame_rate: table.must("frame_rate", whole32)?,
        seed: table.must("seed", whole)?,
        capacity: table.may("capacity", whole32)?,
        image: table.must("image", image)?,
        camera: table.must("camera", camera)?,
        systems: table.must("system", systems)?,
    })
}

fn image(spot: &Spot<'_>) -> Result<Image, SceneError> {
    let table = Reader::new(spot.path.clone(), IMAGE, spot.node)?;
    let image = Image {
        width: table.must("width", whole32)?,
        height: table.must("height", whole32)?,
        background: table.must("background", Quantity::read)?,
        shutter: table.must("shutter", Quantity::read)?,
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
        vertical_fov_degrees: table.must("vertical_fov_degrees", Quantity::read)?,
        near: table.must("near", Quantity::read)?,
    };
    check::camera(&camera, &table)?;
    Ok(camera)
}

fn systems(spot: &Spot<'_>) -> Result<Vec<System>, SceneError> {
    let (Kind::Tables { max, .. }, Value::Array(nodes)) = (spot.field.kind, &spot.node.value)
    else {
        return Err(spot.wrong_kind());
    };
    if nodes.is_empty() || nodes.len() > max {
        return Err(spot.wrong_kind());
    }
    let systems = nodes.iter().enumerate().map(|(i, node)| system(i, node));
    let systems = systems.collect::<Result<_, _>>()?;
    check::unique_names(nodes)?;
    Ok(systems)
}

fn system(index: usize, node: &Node) -> Result<System, SceneError> {
    let name = node.entry("name").and_then(|name| name.node.text());
    let path = match name {
        Some(name) if check::is_name(name) => format!("system.{name}"),
        _ => format!("system.{index}"),
    };
    let table = Reader::new(path, SYSTEM, node)?;
    let roundings = [BirthRounding::Stochastic, BirthRounding::Nearest];
    let shapes = [
        ParticleShape::Sphere,
        ParticleShape::Rectangle,
        ParticleShape::Streak,
    ];
    let lights = [StreakLight::Conserved, StreakLight::Constant];
    let system = System {
        name: table.must("name", text)?,
        position: table.must("position", Quantity::read)?,
        rotation_degrees: table.must("rotation_degrees", Quantity::read)?,
        first_frame: table.must("first_frame", whole32)?,
        end_frame: table.may("end_frame", whole32)?,
        births: births(&table)?,
        birth_rounding: roundings[table.must("birth_rounding", choice)?],
        generation_shape: table.must("generation_shape", generation_shape)?,
        ejection_angle_degrees: table.must("ejection_angle_degrees", Quantity::read)?,
        speed: table.must("speed", spread)?,
        lifetime: table.must("lifetime", spread)?,
        color: table.must("color", changing)?,
        transparency: table.must("transparency", changing)?,
        size: table.must("size", changing)?,
        acceleration: table.must("acceleration", Quantity::read)?,
        particle_shape: shapes[table.must("particle_shape", choice)?],
        streak_light: lights[table.must("streak_light", choice)?],
        intensity_threshold: table.may("intensity_threshold", Quantity::read)?,
    };
    check::frames(system.first_frame, system.end_frame, &table)?;
    check::lifetime(system.lifetime, &table)?;
    Ok(system)
}

fn births(table: &Reader<'_>) -> Result<Births, SceneError> {
    let per = check::births(table)?;
    let [initial, delta, var] = check::birth_keys(per);
    let Some(initial_mean_parts) = table.may(initial, Quantity::read)? else {
        return Err(table.missing(initial));
    };
    Ok(Births {
        per,
        initial_mean_parts,
        delta_mean_parts: table.must(delta, Quantity::read)?,
        var_parts: table.must(var, Quantity::read)?,
    })
}

fn generation_shape(spot: &Spot<'_>) -> Result<GenerationShape, SceneError> {
    let (kind, table) = variant(spot)?;
    Ok(match kind {
        "sphere" => GenerationShape::Sphere {
            radius: table.must("radius", Quantity::read)?,
        },
        "circle" => GenerationShape::Circle {
            radius: table.must("radius", Quantity::read)?,
        },
        _ => GenerationShape::Rectangle {
            length: table.must("length", Quantity::read)?,
            width: table.must("width", Quantity::read)?,
        },
    })
}
