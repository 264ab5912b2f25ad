//! `[[wind]]`.

use crate::scene::check;
use crate::scene::read::{Reader, Spot};
use crate::scene::values::{Quantity, flag, variant, whole32};
use crate::scene::{SceneError, Turbulence, Wind};

pub(super) fn wind(_: usize, spot: &Spot<'_>) -> Result<Wind, SceneError> {
    let (kind, table) = variant(spot)?;
    let number = |key: &str| table.must(key, f32::read);
    let vector = |key: &str| table.must(key, <[f32; 3]>::read);
    Ok(match kind {
        "uniform" => Wind::Uniform {
            velocity: vector("velocity")?,
        },
        "buoyancy" => Wind::Buoyancy {
            gravity: vector("gravity")?,
            strength: number("strength")?,
        },
        "gusts" => Wind::Gusts {
            velocity: vector("velocity")?,
            amplitude: number("amplitude")?,
            frames: number("frames")?,
        },
        "vortex" => Wind::Vortex {
            position: vector("position")?,
            axis: table.must("axis", check::direction)?,
            speed: number("speed")?,
            radius: number("radius")?,
        },
        "source" | "sink" => Wind::Source {
            position: vector("position")?,
            strength: number("strength")? * if kind == "sink" { -1.0 } else { 1.0 },
            radius: number("radius")?,
        },
        "attractor" => Wind::Attractor {
            position: vector("position")?,
            speed: number("speed")?,
            radius: number("radius")?,
        },
        "noise" => Wind::Noise(turbulence(&table)?),
        _ => Wind::Curl(turbulence(&table)?),
    })
}

fn turbulence(table: &Reader<'_>) -> Result<Turbulence, SceneError> {
    Ok(Turbulence {
        strength: table.must("strength", Quantity::read)?,
        scale: table.must("scale", Quantity::read)?,
        drift: table.must("drift", Quantity::read)?,
        octaves: table.must("octaves", whole32)?,
        spectrum_exponent: table.must("spectrum_exponent", Quantity::read)?,
        absolute: table.must("absolute", flag)?,
    })
}
