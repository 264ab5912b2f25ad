//! Checks of fires.

use crate::mesh::Mesh;
use crate::scene::read::{Reader, Spot};
use crate::scene::{Fire, FireSpread, SceneError};

/// Flames of all fires at most: what a binding holds of them on every adapter.
const MOST_FLAMES: u64 = 1_000_000;

/// Those that control points have dropped, and all where some may light what spreads: what a binding
/// holds of their particles.
const MOST_FLAMES_THAT_SPREAD: u64 = 100_000;

/// Point lights of all fires at most.
const MOST_LIGHTS: u32 = 64;

/// Control points that all fires begin to spread from at most: where many begin at one place, each looks
/// at all others.
const MOST_IGNITED: u64 = 16_384;

/// Whether what it spreads over may catch fire from flames.
fn catches(spread: &FireSpread) -> bool {
    spread.catch_points.is_some()
}

/// There are not too many flames, nor too many lights, nor points where fires begin.
pub(in crate::scene) fn flames(fires: &[Fire], spot: &Spot<'_>) -> Result<(), SceneError> {
    let spreads = fires.iter().filter_map(|fire| fire.spread.as_ref());
    let dropped: u64 = spreads.clone().map(|it| u64::from(it.max_flames)).sum();
    let rooted: u64 = fires.iter().map(|fire| u64::from(fire.count())).sum();
    let (total, may_catch) = (rooted + dropped, spreads.clone().any(catches));
    let most = match may_catch {
        true => MOST_FLAMES_THAT_SPREAD,
        false => MOST_FLAMES,
    };
    if total > most || dropped > MOST_FLAMES_THAT_SPREAD {
        let (what, help) = if dropped > MOST_FLAMES_THAT_SPREAD {
            (
                format!("the fires may have dropped {dropped} flames in all, too many"),
                format!("`max_flames` that sum to at most {MOST_FLAMES_THAT_SPREAD}"),
            )
        } else if may_catch {
            (
                format!(
                    "the fires have {total} flames in all, too many where something may catch fire"
                ),
                format!(
                    "`count`s, `max_flames` and listed flames that sum to at most {most}, or no `catch_points`"
                ),
            )
        } else {
            (
                format!("the fires have {total} flames in all, too many"),
                format!("`count`s, `max_flames` and listed flames that sum to at most {most}"),
            )
        };
        return Err(spot.node.at.error(what, help));
    }
    let lights: u32 = fires.iter().map(|fire| fire.lights.count).sum();
    if lights > MOST_LIGHTS {
        let what = format!("the fires have {lights} point lights in all, too many");
        let help = format!("`lights` that sum to at most {MOST_LIGHTS}");
        return Err(spot.node.at.error(what, help));
    }
    let ignitions = fires.iter().filter_map(|fire| fire.spread.as_ref());
    let ignitions = ignitions.flat_map(|spread| &spread.ignitions);
    let points: u64 = ignitions.map(|it| u64::from(it.points)).sum();
    if points > MOST_IGNITED {
        let what =
            format!("the fires begin to spread from {points} control points in all, too many");
        let help = format!("`points` of ignitions that sum to at most {MOST_IGNITED}");
        return Err(spot.node.at.error(what, help));
    }
    Ok(())
}

/// There is room for the control points that a fire begins to spread from.
pub(in crate::scene) fn ignited(spread: &FireSpread, table: &Reader<'_>) -> Result<(), SceneError> {
    let points: u64 = spread.ignitions.iter().map(|it| u64::from(it.points)).sum();
    if points > u64::from(spread.max_points) {
        let what = format!(
            "`{}` is {}, and ignitions have {points} control points",
            table.path_of("max_points"),
            spread.max_points
        );
        let help = format!("{points} or more: fires that grow have many times as many");
        return Err(table.at("max_points").error(what, help));
    }
    Ok(())
}

/// The mesh has a part of that name.
pub(in crate::scene) fn mesh_part(
    spot: &Spot<'_>,
    mesh: &Mesh,
    part: &str,
) -> Result<(), SceneError> {
    let names = mesh
        .parts()
        .iter()
        .flat_map(|one| [&one.group, &one.material]);
    let mut names: Vec<&str> = names
        .map(String::as_str)
        .filter(|name| !name.is_empty())
        .collect();
    names.sort_unstable();
    names.dedup();
    if names.contains(&part) {
        return Ok(());
    }
    let what = format!(
        "`{}` is \"{part}\", and {} has no such part",
        spot.path,
        mesh.name()
    );
    let help = if names.is_empty() {
        "a mesh of a file with groups or materials: that one has none".to_owned()
    } else {
        let some = names.iter().take(8).map(|name| format!("\"{name}\""));
        format!(
            "one of its groups or materials: {}",
            some.collect::<Vec<_>>().join(", ")
        )
    };
    Err(spot.node.at.error(what, help))
}

/// Thickness and conductivity of materials have a formula that they are put in.
pub(in crate::scene) fn materials(
    spread: &FireSpread,
    table: &Reader<'_>,
) -> Result<(), SceneError> {
    let conducts = spread
        .formula
        .is_some_and(|formula| formula.opposed_flux() > 0.0);
    for (at, material) in spread.materials.iter().enumerate() {
        let asks = [
            ("thickness", material.thickness, spread.formula.is_some()),
            ("conductivity", material.conductivity, conducts),
        ];
        for (key, value, is_right) in asks {
            if let Some(value) = value
                && !is_right
            {
                let what = format!(
                    "`{}.{at}.{key}` is {value}, and `{}` {}",
                    table.path_of("material"),
                    table.path_of("formula"),
                    if spread.formula.is_some() {
                        "conducts no heat"
                    } else {
                        "is left out"
                    }
                );
                let help = "a `formula` of which that is another value; or `speed`, a factor";
                return Err(table.at("material").error(what, help));
            }
        }
    }
    Ok(())
}

/// The fire has a flame, each of them a height, and colours in ascending order.
pub(in crate::scene) fn fire(fire: &Fire, table: &Reader<'_>) -> Result<(), SceneError> {
    if fire.count() == 0 && fire.spread.is_none() {
        let what = format!("`{}` has no flame", table.path());
        let help = "roots = { kind = \"line\", length = 2, count = 20 }, or a `[[fire.flame]]` \
                    with a position";
        return Err(table.at("roots").error(what, help));
    }
    if fire.ramp.is_empty() {
        let what = format!("`{}` is empty", table.path_of("ramp"));
        let help = "at least one table with age, center, rim and alpha";
        return Err(table.at("ramp").error(what, help));
    }
    let ramp: Vec<f32> = fire.ramp.iter().map(|stop| stop.age).collect();
    let profile: Vec<f32> = fire.profile.stops.iter().map(|stop| stop.age).collect();
    for (key, ages) in [("ramp", ramp), ("profile", profile)] {
        if let Some(at) = ages.windows(2).position(|two| two[0] >= two[1]) {
            let what = format!(
                "`{}.{}.age` is {}, not more than the one before",
                table.path_of(key),
                at + 1,
                ages[at + 1]
            );
            let help = "ages in ascending order";
            return Err(table.at(key).error(what, help));
        }
    }
    Ok(())
}
