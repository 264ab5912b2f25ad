//! Checks of fires.

use crate::scene::read::{Reader, Spot};
use crate::scene::{Fire, SceneError};

/// Flames of all fires at most: what a binding holds of their discs on every adapter.
const MOST_FLAMES: u64 = 100_000;

/// Point lights of all fires at most.
const MOST_LIGHTS: u32 = 64;

/// There are not too many flames, nor too many lights.
pub(in crate::scene) fn flames(fires: &[Fire], spot: &Spot<'_>) -> Result<(), SceneError> {
    let total: u64 = fires.iter().map(|fire| u64::from(fire.count())).sum();
    if total > MOST_FLAMES {
        let what = format!("the fires have {total} flames in all, too many");
        let help = format!("`count`s and listed flames that sum to at most {MOST_FLAMES}");
        return Err(spot.node.at.error(what, help));
    }
    let lights: u32 = fires.iter().map(|fire| fire.lights.count).sum();
    if lights > MOST_LIGHTS {
        let what = format!("the fires have {lights} point lights in all, too many");
        let help = format!("`lights` that sum to at most {MOST_LIGHTS}");
        return Err(spot.node.at.error(what, help));
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
    let ascends = |two: &[crate::scene::RampStop]| two[0].age < two[1].age;
    if let Some(at) = fire.ramp.windows(2).position(|two| !ascends(two)) {
        let what = format!(
            "`{}.{}.age` is {}, not more than the one before",
            table.path_of("ramp"),
            at + 1,
            fire.ramp[at + 1].age
        );
        let help = "ages in ascending order";
        return Err(table.at("ramp").error(what, help));
    }
    Ok(())
}
