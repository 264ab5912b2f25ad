//! `[fire.spread]`, with what is in it.

use crate::mesh::Mesh;
use crate::scene::check;
use crate::scene::files::Files;
use crate::scene::read::{Reader, Spot};
use crate::scene::schema::{CHAR, FORMULA, GRAIN, IGNITION, LINE, MATERIAL, SMOKE, SPREAD};
use crate::scene::values::{Quantity, choice, list, text, whole32};
use crate::scene::{
    Char, Curvature, FireSpread, FluxFormula, FrontHeading, FrontLine, Grain, GrainPattern,
    Ignition, Insertion, Material, SceneError, Smoke, SpreadLaw,
};

pub(super) fn spread(spot: &Spot<'_>, files: &Files) -> Result<FireSpread, SceneError> {
    let table = Reader::new(spot.path.clone(), SPREAD, spot.node)?;
    let scale = table.must("scale", Quantity::read)?;
    let (mesh, surface) = table.must("mesh", |spot| {
        let mesh = files.mesh(spot)?;
        let surface = files.surface(spot, &mesh, scale)?;
        Ok((mesh, surface))
    })?;
    let distance = |key: &str, share: f64| -> Result<f32, SceneError> {
        let by_itself = (share * surface.mean_edge_length()).clamp(1e-6, 1e4) as f32;
        Ok(table.may(key, Quantity::read)?.unwrap_or(by_itself))
    };
    let ignitions = table.must("ignition", |spot| list(spot, |_, spot| ignition(spot)))?;
    if ignitions.is_empty() {
        let what = format!("`{}` is empty", table.path_of("ignition"));
        let help = "at least one table with a position";
        return Err(table.at("ignition").error(what, help));
    }
    let spread = FireSpread {
        ignitions,
        catch_points: table.may("catch_points", whole32)?,
        time_scale: table.must("time_scale", Quantity::read)?,
        opposed_flux: table.must("opposed_flux", Quantity::read)?,
        concurrent_flux: table.must("concurrent_flux", Quantity::read)?,
        ignition_heat: table.must("ignition_heat", Quantity::read)?,
        formula: table.may("formula", formula)?,
        drop_distance: distance("drop_distance", 0.2)?,
        separation: distance("separation", 0.1)?,
        curvature_distance: distance("curvature_distance", 0.1)?,
        law: [SpreadLaw::Fire, SpreadLaw::Spill, SpreadLaw::Stain][table.must("law", choice)?],
        materials: table.must("material", |spot| {
            list(spot, |_, spot| material(spot, &mesh))
        })?,
        grain: table.may("grain", grain)?,
        curvature: [Curvature::Exposed, Curvature::Literal, Curvature::Ignored]
            [table.must("curvature", choice)?],
        heading: [FrontHeading::Ray, FrontHeading::Normal][table.must("heading", choice)?],
        insertion: [Insertion::Arc, Insertion::Midpoint][table.must("insertion", choice)?],
        prevents_double_burning: table.must("double_burning", choice)? == 0,
        carries_rest: table.must("drop_counter", choice)? == 1,
        max_flames: table.must("max_flames", whole32)?,
        char: table.may("char", char_of)?,
        smoke: table.may("smoke", smoke)?,
        line: table.may("line", line)?,
        max_points: table.must("max_points", whole32)?,
        mesh,
        surface,
    };
    check::ignited(&spread, &table)?;
    check::materials(&spread, &table)?;
    Ok(spread)
}

fn material(spot: &Spot<'_>, mesh: &Mesh) -> Result<Material, SceneError> {
    let table = Reader::new(spot.path.clone(), MATERIAL, spot.node)?;
    let part = table.must("part", |spot| {
        let part = text(spot)?;
        check::mesh_part(spot, mesh, &part)?;
        Ok(part)
    })?;
    Ok(Material {
        part,
        speed: table.must("speed", Quantity::read)?,
        thickness: table.may("thickness", Quantity::read)?,
        conductivity: table.may("conductivity", Quantity::read)?,
        lifetime: table.may("lifetime", whole32)?,
    })
}

fn ignition(spot: &Spot<'_>) -> Result<Ignition, SceneError> {
    let table = Reader::new(spot.path.clone(), IGNITION, spot.node)?;
    Ok(Ignition {
        position: table.must("position", Quantity::read)?,
        first_frame: table.must("first_frame", whole32)?,
        points: table.must("points", whole32)?,
    })
}

pub(super) fn grain(spot: &Spot<'_>) -> Result<Grain, SceneError> {
    let table = Reader::new(spot.path.clone(), GRAIN, spot.node)?;
    Ok(Grain {
        pattern: [GrainPattern::Stripes, GrainPattern::Rings][table.must("pattern", choice)?],
        direction: table.must("direction", check::direction)?,
        scale: table.must("scale", Quantity::read)?,
        strength: table.must("strength", Quantity::read)?,
        shift: table.must("shift", Quantity::read)?,
        noise_scale: table.must("noise_scale", Quantity::read)?,
    })
}

fn char_of(spot: &Spot<'_>) -> Result<Char, SceneError> {
    let table = Reader::new(spot.path.clone(), CHAR, spot.node)?;
    Ok(Char {
        size: table.may("size", Quantity::read)?,
        opacity: table.must("opacity", Quantity::read)?,
        edge_softness: table.must("edge_softness", Quantity::read)?,
        glow: table.must("glow", Quantity::read)?,
        glow_frames: table.must("glow_frames", Quantity::read)?,
        appear_frames: table.must("appear_frames", Quantity::read)?,
        max_marks: table.must("max_marks", whole32)?,
    })
}

fn smoke(spot: &Spot<'_>) -> Result<Smoke, SceneError> {
    let table = Reader::new(spot.path.clone(), SMOKE, spot.node)?;
    Ok(Smoke {
        speed: table.must("speed", Quantity::read)?,
        frames: table.must("frames", Quantity::read)?,
        size: table.must("size", Quantity::read)?,
        growth: table.must("growth", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        opacity: table.must("opacity", Quantity::read)?,
        max_puffs: table.must("max_puffs", whole32)?,
    })
}

fn line(spot: &Spot<'_>) -> Result<FrontLine, SceneError> {
    let table = Reader::new(spot.path.clone(), LINE, spot.node)?;
    Ok(FrontLine {
        width: table.must("width", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        opacity: table.must("opacity", Quantity::read)?,
    })
}

fn formula(spot: &Spot<'_>) -> Result<FluxFormula, SceneError> {
    let table = Reader::new(spot.path.clone(), FORMULA, spot.node)?;
    let formula = FluxFormula {
        flame_temperature: table.must("flame_temperature", Quantity::read)?,
        fuel_temperature: table.must("fuel_temperature", Quantity::read)?,
        conductivity: table.must("conductivity", Quantity::read)?,
        emissivity: table.must("emissivity", Quantity::read)?,
        flame_length: table.must("flame_length", Quantity::read)?,
        flame_angle_degrees: table.must("flame_angle_degrees", Quantity::read)?,
        thickness: table.must("thickness", Quantity::read)?,
        density: table.must("density", Quantity::read)?,
        enthalpy: table.must("enthalpy", Quantity::read)?,
    };
    if formula.fuel_temperature > formula.flame_temperature {
        let what = format!(
            "`{}` is {}, hotter than the flame's {}",
            table.path_of("fuel_temperature"),
            formula.fuel_temperature,
            formula.flame_temperature
        );
        let help = "a fuel that is not hotter than the flame";
        return Err(table.at("fuel_temperature").error(what, help));
    }
    Ok(formula)
}
