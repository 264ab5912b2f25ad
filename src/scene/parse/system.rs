//! `[[system]]`, with what is in it.

use crate::scene::check;
use crate::scene::files::Files;
use crate::scene::read::{Reader, Spot};
use crate::scene::schema::{BURST, INHERIT, SYSTEM};
use crate::scene::tree::Node;
use crate::scene::values::{
    Quantity, changing, choice, list, signed32, spread, text, variant, whole32, wholes,
};
use crate::scene::{
    Attractor, BirthMoment, BirthRounding, BirthUnit, Births, Blend, Burst, ChildUp, EjectionAxis,
    EjectionSpread, Extinction, GenerationShape, Inherit, Integration, Intensity, ParticleShape,
    ParticleSpace, SceneError, Shading, Side, StreakLight, System,
};

pub(super) fn systems(spot: &Spot<'_>, files: &Files) -> Result<Vec<System>, SceneError> {
    let systems = list(spot, |index, spot| system(index, spot.node, files))?;
    if systems.is_empty() {
        return Err(spot.wrong_kind());
    }
    check::parents(&systems, spot)?;
    Ok(systems)
}

fn system(index: usize, node: &Node, files: &Files) -> Result<System, SceneError> {
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
        ParticleShape::Stroke,
    ];
    let axes = [
        EjectionAxis::Up,
        EjectionAxis::Outward,
        EjectionAxis::Around,
    ];
    let shape = table.must("generation_shape", |spot| generation_shape(spot, files))?;
    let axis = default_axis(&shape);
    let is_rings = matches!(shape, GenerationShape::Rings { .. });
    let lights = [StreakLight::Conserved, StreakLight::Constant];
    let system = System {
        name: table.must("name", text)?,
        parent: table.may("parent", text)?,
        child_up: [ChildUp::Parent, ChildUp::Outward][table.must("child_up", choice)?],
        inherit: table.must("inherit", inherit)?,
        position: table.must("position", Quantity::read)?,
        rotation_degrees: table.must("rotation_degrees", Quantity::read)?,
        first_frame: table.must("first_frame", signed32)?,
        end_frame: table.may("end_frame", signed32)?,
        trigger_frames: table.must("trigger_frames", wholes)?,
        bursts: table.must("burst", |spot| list(spot, burst))?,
        birth_moment: [BirthMoment::FrameStart, BirthMoment::WithinFrame]
            [table.must("birth_moment", choice)?],
        particle_space: [ParticleSpace::System, ParticleSpace::World]
            [table.must("particle_space", choice)?],
        birth_rounding: roundings[table.must("birth_rounding", choice)?],
        generation_shape: shape,
        ejection_axis: table
            .may("ejection_axis", choice)?
            .map_or(axis, |at| axes[at]),
        ejection_angle_degrees: table.must("ejection_angle_degrees", Quantity::read)?,
        ejection_spread: [EjectionSpread::SolidAngle, EjectionSpread::Angle]
            [table.must("ejection_spread", choice)?],
        speed: table.must("speed", spread)?,
        lifetime: table.may("lifetime", spread)?,
        color: table.must("color", changing)?,
        transparency: table.must("transparency", changing)?,
        size: table.must("size", changing)?,
        acceleration: table.must("acceleration", Quantity::read)?,
        acceleration_space: [ParticleSpace::World, ParticleSpace::System]
            [table.must("acceleration_space", choice)?],
        drag: table.must("drag", Quantity::read)?,
        integration: [Integration::Euler, Integration::Parabola]
            [table.must("integration", choice)?],
        particle_shape: shapes[table.must("particle_shape", choice)?],
        blend: [Blend::Add, Blend::Over][table.must("blend", choice)?],
        shading: [Shading::Flat, Shading::LitSphere, Shading::LitCloud]
            [table.must("shading", choice)?],
        edge_softness: table.must("edge_softness", Quantity::read)?,
        streak_light: lights[table.must("streak_light", choice)?],
        stroke_taper: table.must("stroke_taper", Quantity::read)?,
        stroke_pieces: table.must("stroke_pieces", whole32)?,
        stroke_shadow: table.must("stroke_shadow", Quantity::read)?,
        intensity_threshold: table.may("intensity_threshold", Quantity::read)?,
        intensity: [Intensity::Brightest, Intensity::Luminance][table.must("intensity", choice)?],
        extinctions: table.must("extinction", |spot| list(spot, |_, spot| extinction(spot)))?,
        light_distance: table.may("light_distance", Quantity::read)?,
        light: table.must("light", Quantity::read)?,
        // Last: where there are none, they may have slipped into a table below, which says so.
        births: match is_rings && !check::has_births(&table) {
            true => Births::none(BirthUnit::Frame),
            false => births(&table)?,
        },
    };
    check::frames(system.first_frame, system.end_frame, &table)?;
    check::triggers(&system, &table)?;
    check::stroke(&system, &table)?;
    if let Some(lifetime) = system.lifetime {
        check::lifetime(lifetime, &table)?;
    }
    Ok(system)
}

fn births(table: &Reader<'_>) -> Result<Births, SceneError> {
    let per = check::births(table)?;
    let number = |at: usize| table.must(check::birth_keys(per)[at], Quantity::read);
    let initial = check::birth_keys(per)[0];
    let initial_mean_parts = match table.may(initial, Quantity::read)? {
        Some(parts) => parts,
        // Bursts may be all.
        None if table.has_items("burst") && !check::has_births(table) => 0.0,
        None => return Err(table.missing(initial)),
    };
    Ok(Births {
        per,
        initial_mean_parts,
        delta_mean_parts: number(1)?,
        quadratic_mean_parts: number(2)?,
        cubic_mean_parts: number(3)?,
        var_parts: number(4)?,
        delta_var_parts: number(5)?,
        quadratic_var_parts: number(6)?,
        cubic_var_parts: number(7)?,
        mean_parts_wander: table.must("mean_parts_wander", Quantity::read)?,
        mean_parts_wander_frames: table.must("mean_parts_wander_frames", Quantity::read)?,
    })
}

fn inherit(spot: &Spot<'_>) -> Result<Inherit, SceneError> {
    let table = Reader::new(spot.path.clone(), INHERIT, spot.node)?;
    Ok(Inherit {
        mean_parts: table.must("mean_parts", Quantity::read)?,
        var_parts: table.must("var_parts", Quantity::read)?,
        generation_scale: table.must("generation_scale", Quantity::read)?,
        ejection_angle_degrees: table.must("ejection_angle_degrees", Quantity::read)?,
        speed: table.must("speed", spread)?,
        lifetime: table.must("lifetime", spread)?,
        color: table.must("color", changing)?,
        transparency: table.must("transparency", changing)?,
        size: table.must("size", changing)?,
    })
}

fn burst(_: usize, spot: &Spot<'_>) -> Result<Burst, SceneError> {
    let table = Reader::new(spot.path.clone(), BURST, spot.node)?;
    Ok(Burst {
        frame: table.must("frame", signed32)?,
        parts: table.must("parts", spread)?,
    })
}

fn extinction(spot: &Spot<'_>) -> Result<Extinction, SceneError> {
    let (kind, table) = variant(spot)?;
    let sides = [Side::Inside, Side::Outside];
    Ok(match kind {
        "distance" => Extinction::Distance {
            direction: table.must("direction", check::direction)?,
            distance: table.must("distance", Quantity::read)?,
        },
        "plane" => Extinction::Plane {
            point: table.must("point", Quantity::read)?,
            normal: table.must("normal", check::direction)?,
        },
        "sphere" => Extinction::Sphere {
            center: table.must("center", Quantity::read)?,
            radius: table.must("radius", Quantity::read)?,
            kills: sides[table.must("kills", choice)?],
        },
        _ => {
            let (min, max) = (
                table.must("min", Quantity::read)?,
                table.must("max", Quantity::read)?,
            );
            check::corners(min, max, &table)?;
            Extinction::Box {
                min,
                max,
                kills: sides[table.must("kills", choice)?],
            }
        }
    })
}

/// Where particles of a shape leave to if nothing is said.
fn default_axis(shape: &GenerationShape) -> EjectionAxis {
    match shape {
        GenerationShape::Sphere { .. }
        | GenerationShape::Cone { .. }
        | GenerationShape::Attractor { .. }
        | GenerationShape::Rings { .. }
        | GenerationShape::Mesh { .. } => EjectionAxis::Outward,
        _ => EjectionAxis::Up,
    }
}

fn generation_shape(spot: &Spot<'_>, files: &Files) -> Result<GenerationShape, SceneError> {
    let (kind, table) = variant(spot)?;
    Ok(match kind {
        "sphere" => GenerationShape::Sphere {
            radius: table.must("radius", Quantity::read)?,
        },
        "circle" => GenerationShape::Circle {
            radius: table.must("radius", Quantity::read)?,
        },
        "rectangle" => GenerationShape::Rectangle {
            length: table.must("length", Quantity::read)?,
            width: table.must("width", Quantity::read)?,
        },
        "ring" => {
            let inner_radius = table.must("inner_radius", Quantity::read)?;
            let outer_radius = table.must("outer_radius", Quantity::read)?;
            check::ring(inner_radius, outer_radius, &table)?;
            GenerationShape::Ring {
                inner_radius,
                outer_radius,
            }
        }
        "box" => GenerationShape::Box {
            length: table.must("length", Quantity::read)?,
            width: table.must("width", Quantity::read)?,
            height: table.must("height", Quantity::read)?,
        },
        "cone" => GenerationShape::Cone {
            height: table.must("height", Quantity::read)?,
            angle_degrees: table.must("angle_degrees", Quantity::read)?,
        },
        "line" => GenerationShape::Line {
            length: table.must("length", Quantity::read)?,
        },
        "rings" => GenerationShape::Rings {
            radius: table.must("radius", Quantity::read)?,
            wall_speed: table.must("wall_speed", Quantity::read)?,
            ring_frames: table.must("ring_frames", whole32)?,
            density: table.must("density", Quantity::read)?,
        },
        "mesh" => GenerationShape::Mesh {
            mesh: table.must("mesh", |spot| files.mesh(spot))?,
            scale: table.must("scale", Quantity::read)?,
        },
        _ => GenerationShape::Attractor {
            attractor: [Attractor::Lorenz, Attractor::Rossler, Attractor::Halvorsen]
                [table.must("attractor", choice)?],
            radius: table.must("radius", Quantity::read)?,
        },
    })
}
