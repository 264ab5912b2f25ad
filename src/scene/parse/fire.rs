//! `[[fire]]`, with what is in it.

use crate::scene::check;
use crate::scene::files::Files;
use crate::scene::read::{Reader, Spot};
use crate::scene::schema::{FIRE, FLAME, PROFILE, RAMP};
use crate::scene::values::{Quantity, choice, list, signed32, spread, text, variant, whole32};
use crate::scene::{
    Burning, Fire, FireLights, FlameForm, LightFrom, ListedFlame, Profile, ProfileStop, RampStop,
    Roots, SceneError,
};

/// Reads all fires.
pub(super) fn fires(spot: &Spot<'_>, files: &Files) -> Result<Vec<Fire>, SceneError> {
    let fires = list(spot, |at, spot| fire(at, spot, files))?;
    check::flames(&fires, spot)?;
    Ok(fires)
}

fn fire(at: usize, spot: &Spot<'_>, files: &Files) -> Result<Fire, SceneError> {
    let name = spot.node.entry("name").and_then(|name| name.node.text());
    let path = match name {
        Some(name) if check::is_name(name) => format!("fire.{name}"),
        _ => format!("fire.{at}"),
    };
    let table = Reader::new(path, FIRE, spot.node)?;
    let fire = Fire {
        name: table.must("name", text)?,
        position: table.must("position", Quantity::read)?,
        rotation_degrees: table.must("rotation_degrees", Quantity::read)?,
        roots: table.must("roots", |spot| roots(spot, files))?,
        listed: table.must("flame", |spot| list(spot, |_, spot| flame(spot)))?,
        height: table.must("height", spread)?,
        width: table.must("width", spread)?,
        profile: Profile {
            base_width: table.must("base_width", Quantity::read)?,
            swell: table.must("swell", Quantity::read)?,
            base_height: table.must("base_height", Quantity::read)?,
            height_growth: table.must("height_growth", Quantity::read)?,
            stops: table.must("profile", |spot| list(spot, |_, spot| profile_stop(spot)))?,
        },
        start_speed: table.must("start_speed", Quantity::read)?,
        normalised: table.must("speed", choice)? == 0,
        buoyancy: table.must("buoyancy", Quantity::read)?,
        gravity: table.must("gravity", check::direction)?,
        noisiness: table.must("noisiness", Quantity::read)?,
        sampling: table.must("sampling", Quantity::read)?,
        inverse_cohesion: table.must("inverse_cohesion", Quantity::read)?,
        wind_factor: table.must("wind_factor", Quantity::read)?,
        brightness: table.must("brightness", Quantity::read)?,
        color_noise: table.must("color_noise", Quantity::read)?,
        color_noise_scale: table.must("color_noise_scale", Quantity::read)?,
        inner_radius: table.must("inner_radius", Quantity::read)?,
        inner_alpha: table.must("inner_alpha", Quantity::read)?,
        details: table.must("details", whole32)?,
        detail_spread: table.must("detail_spread", Quantity::read)?,
        detail_alpha: table.must("detail_alpha", Quantity::read)?,
        form: [FlameForm::Particles, FlameForm::Strip, FlameForm::Line]
            [table.must("form", choice)?],
        strip_cells: table.must("strip_cells", Quantity::read)?,
        strip_contrast: table.must("strip_contrast", Quantity::read)?,
        particle_matrix: table.must("particle_matrix", check::invertible)?,
        matrix_noise: table.must("matrix_noise", Quantity::read)?,
        lights: FireLights {
            gain: table.must("light", Quantity::read)?,
            count: table.must("lights", whole32)?,
            from: [LightFrom::Mean, LightFrom::Middle, LightFrom::Tip]
                [table.must("light_from", choice)?],
        },
        ramp: table.must("ramp", |spot| list(spot, |_, spot| ramp_stop(spot)))?,
        blackbody: table.may("blackbody", Quantity::read)?,
        blackbody_rim: table.must("blackbody_rim", Quantity::read)?,
        burning: Burning {
            first_frame: table.must("first_frame", signed32)?,
            kindling_frames: table.must("kindling_frames", whole32)?,
            lifetime: table.may("lifetime", whole32)?,
            growth_frames: table.must("growth_frames", whole32)?,
        },
        spread: table.may("spread", |spot| super::spread::spread(spot, files))?,
    };
    check::fire(&fire, &table)?;
    Ok(fire)
}

fn roots(spot: &Spot<'_>, files: &Files) -> Result<Roots, SceneError> {
    let (kind, table) = variant(spot)?;
    let count = || table.must("count", whole32);
    let extent = |key: &str| table.must(key, Quantity::read);
    Ok(match kind {
        "line" => Roots::Line {
            length: extent("length")?,
            count: count()?,
        },
        "circle" => Roots::Circle {
            radius: extent("radius")?,
            count: count()?,
        },
        "disc" => Roots::Disc {
            radius: extent("radius")?,
            count: count()?,
        },
        "mesh" => Roots::Mesh {
            mesh: table.must("mesh", |spot| files.mesh(spot))?,
            scale: extent("scale")?,
            count: count()?,
        },
        _ => Roots::Listed,
    })
}

fn flame(spot: &Spot<'_>) -> Result<ListedFlame, SceneError> {
    let table = Reader::new(spot.path.clone(), FLAME, spot.node)?;
    Ok(ListedFlame {
        position: table.must("position", Quantity::read)?,
        normal: table.must("normal", check::direction)?,
        height: table.may("height", Quantity::read)?,
        width: table.may("width", Quantity::read)?,
        brightness: table.must("brightness", Quantity::read)?,
        first_frame: table.may("first_frame", signed32)?,
    })
}

fn profile_stop(spot: &Spot<'_>) -> Result<ProfileStop, SceneError> {
    let table = Reader::new(spot.path.clone(), PROFILE, spot.node)?;
    Ok(ProfileStop {
        age: table.must("age", Quantity::read)?,
        width: table.must("width", Quantity::read)?,
        height: table.must("height", Quantity::read)?,
    })
}

fn ramp_stop(spot: &Spot<'_>) -> Result<RampStop, SceneError> {
    let table = Reader::new(spot.path.clone(), RAMP, spot.node)?;
    Ok(RampStop {
        age: table.must("age", Quantity::read)?,
        center: table.must("center", Quantity::read)?,
        rim: table.must("rim", Quantity::read)?,
        alpha: table.must("alpha", Quantity::read)?,
        rim_alpha: table.must("rim_alpha", Quantity::read)?,
    })
}
