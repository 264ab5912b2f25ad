//! Checks that look at more than one key: each value here has already passed its own.

use super::read::Reader;
use super::tree::{At, Node, Value};
use super::{BirthUnit, Camera, Image, SceneError, Spread};

/// Pixels of an image at most: 4096 x 2160.
const MAX_PIXELS: u32 = 8_847_360;

/// Frames that a particle can live at most: birth frames are 16 bits of its state.
const MAX_LIFETIME: f32 = 65_000.0;

/// The sine of the least angle between the camera's view and its up.
const MIN_SINE: f64 = 1e-4;

/// Whether the text can be a name: see [`Kind::Name`](super::schema::Kind::Name).
pub(super) fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    let first = letters
        .next()
        .is_some_and(|c| c.is_alphabetic() || c == '_');
    let rest = letters.all(|c| c.is_alphanumeric() || c == '-' || c == '_');
    first && rest && text.chars().count() <= 64
}

/// The image has no more pixels than a frame's buffers can hold.
pub(super) fn image(image: &Image, table: &Reader<'_>) -> Result<(), SceneError> {
    let Image { width, height, .. } = *image;
    if width * height <= MAX_PIXELS {
        return Ok(());
    }
    let key = if table.has("height") {
        "height"
    } else {
        "width"
    };
    let what = format!(
        "`image.width` times `image.height` is {} pixels, too many",
        width * height
    );
    let help = format!("at most {MAX_PIXELS} pixels, such as width = 4096 and height = 2160");
    Err(table.at(key).error(what, help))
}

/// The camera looks somewhere and knows which way is up.
pub(super) fn camera(camera: &Camera, table: &Reader<'_>) -> Result<(), SceneError> {
    let [position, target, up] =
        [camera.position, camera.target, camera.up].map(|v| v.map(f64::from));
    let view = [0, 1, 2].map(|i| target[i] - position[i]);
    // Positions are 32-bit floats, so a nearer target has no direction left to speak of.
    let least = 1e-6 * length(position).max(1.0);
    if length(view) < least {
        let what = "`camera.target` is where `camera.position` is, so the camera looks nowhere";
        let help = format!("a target at least {least:.6} world units from the position");
        return Err(table.at("target").error(what, help));
    }
    let cross = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| view[i] * up[j] - view[j] * up[i]);
    if length(cross) <= MIN_SINE * length(view) * length(up) {
        let what = if length(up) == 0.0 {
            "`camera.up` is zero, which is no direction"
        } else {
            "`camera.up` is parallel to the view from `camera.position` to `camera.target`"
        };
        let help = "any direction across the view, such as up = [0, 1, 0] for a level view or \
                    up = [0, 0, -1] for one straight down";
        let key = if table.has("up") { "up" } else { "target" };
        return Err(table.at(key).error(what, help));
    }
    Ok(())
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The triple of keys that says how many are born: initial mean, its change a frame, half-width.
pub(super) fn birth_keys(per: BirthUnit) -> [&'static str; 3] {
    match per {
        BirthUnit::Frame => ["initial_mean_parts", "delta_mean_parts", "var_parts"],
        BirthUnit::ScreenArea => [
            "initial_mean_parts_per_area",
            "delta_mean_parts_per_area",
            "var_parts_per_area",
        ],
    }
}

/// Which of the two triples of births the system has: exactly one (Reeves 1983, 2.1).
pub(super) fn births(table: &Reader<'_>) -> Result<BirthUnit, SceneError> {
    let given = |per| birth_keys(per).into_iter().find(|key| table.has(key));
    let [frame, area] = [BirthUnit::Frame, BirthUnit::ScreenArea].map(|per| {
        let [initial, delta, var] = birth_keys(per).map(|key| format!("`{key}`"));
        format!("({initial}, {delta}, {var})")
    });
    match (given(BirthUnit::Frame), given(BirthUnit::ScreenArea)) {
        (Some(_), None) => Ok(BirthUnit::Frame),
        (None, Some(_)) => Ok(BirthUnit::ScreenArea),
        (Some(_), Some(key)) => Err(table.at(key).error(
            format!(
                "`{}` has both births a frame {frame} and births an area {area}",
                table.path()
            ),
            "keep one of the two triples: particles a frame, or particles a frame and pixel of \
             screen area",
        )),
        (None, None) => Err(table.at("").error(
            format!(
                "`{}` has neither births a frame {frame} nor births an area {area}",
                table.path()
            ),
            "add `initial_mean_parts = 1000` for particles a frame, or \
             `initial_mean_parts_per_area = 0.5` for particles a frame and pixel of screen area",
        )),
    }
}

/// Births end after they begin.
pub(super) fn frames(first: u32, end: Option<u32>, table: &Reader<'_>) -> Result<(), SceneError> {
    match end {
        Some(end) if end <= first => {
            let path = table.path_of("end_frame");
            let what = format!("`{path}` is {end}, but births begin at frame {first}");
            let help = format!(
                "more than first_frame, so at least {}",
                u64::from(first) + 1
            );
            Err(table.at("end_frame").error(what, help))
        }
        _ => Ok(()),
    }
}

/// The longest lifetime fits a particle's state.
pub(super) fn lifetime(lifetime: Spread<f32>, table: &Reader<'_>) -> Result<(), SceneError> {
    let most = lifetime.mean + lifetime.var;
    if most <= MAX_LIFETIME {
        return Ok(());
    }
    let path = table.path_of("lifetime");
    let what = format!("`{path}` reaches {most} frames (mean + var), too many");
    let help = format!("mean + var at most {MAX_LIFETIME} frames");
    Err(table.at("lifetime").error(what, help))
}

/// No two systems have the same name.
pub(super) fn unique_names(systems: &[Node]) -> Result<(), SceneError> {
    let mut seen: std::collections::BTreeMap<&str, &At> = std::collections::BTreeMap::new();
    for system in systems {
        let Some(name) = system.entry("name") else {
            continue;
        };
        let Value::Text(text) = &name.node.value else {
            continue;
        };
        if let Some(first) = seen.insert(text, &name.node.at) {
            let what = format!("`system.{text}.name` is already that of another system");
            let help = format!(
                "a name of its own: the other stands on line {}",
                first.line()
            );
            return Err(name.node.at.error(what, help));
        }
    }
    Ok(())
}
