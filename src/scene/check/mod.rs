//! Checks that look at more than one key: each value here has already passed its own.

mod fires;
mod flocks;
mod parents;
mod tracks;

pub(super) use fires::{fire, flames, ignited, materials, mesh_part};
pub(super) use flocks::{boids, no_such_flock};
pub(super) use parents::parents;
pub(super) use tracks::tracks;

use super::read::{Reader, Spot};
use super::schema::MOST_NAME_CHARS;
use super::tree::{At, Node, Value};
use super::values::Quantity;
use super::{BirthUnit, Blend, Camera, Image, ParticleShape, SceneError, Spread, System};

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
    first && rest && text.chars().count() <= MOST_NAME_CHARS
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

/// What is wrong with values that are at odds, what would be right, and the key to blame.
struct Fault {
    what: String,
    help: String,
    key: &'static str,
}

/// The camera looks somewhere and knows which way is up.
pub(super) fn camera(camera: &Camera, table: &Reader<'_>) -> Result<(), SceneError> {
    let fault = || {
        let fault = camera_fault(camera)?;
        // If no `up` is written, its default is right for most targets.
        let key = if table.has(fault.key) {
            fault.key
        } else {
            "target"
        };
        Some(Fault { key, ..fault })
    };
    refused(fault, &["position", "target", "up"], table)
}

fn camera_fault(camera: &Camera) -> Option<Fault> {
    let [position, target, up] =
        [camera.position, camera.target, camera.up].map(|v| v.map(f64::from));
    let view = [0, 1, 2].map(|i| target[i] - position[i]);
    // Positions are 32-bit floats, so a nearer target has no direction left to speak of.
    let least = 1e-6 * length(position).max(1.0);
    if length(view) < least {
        return Some(Fault {
            what: "`camera.target` is where `camera.position` is, so the camera looks nowhere"
                .into(),
            help: format!("a target at least {least:.6} world units from the position"),
            key: "target",
        });
    }
    let cross = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| view[i] * up[j] - view[j] * up[i]);
    if length(cross) > MIN_SINE * length(view) * length(up) {
        return None;
    }
    let what = if length(up) == 0.0 {
        "`camera.up` is zero, which is no direction"
    } else {
        "`camera.up` is parallel to the view from `camera.position` to `camera.target`"
    };
    Some(Fault {
        what: what.into(),
        help: "any direction across the view, such as up = [0, 1, 0] for a level view or up = \
               [0, 0, -1] for one straight down"
            .into(),
        key: "up",
    })
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The keys that say how many are born: the mean's four coefficients, then the half-width's.
pub(super) fn birth_keys(per: BirthUnit) -> [&'static str; 8] {
    match per {
        BirthUnit::Frame => [
            "initial_mean_parts",
            "delta_mean_parts",
            "quadratic_mean_parts",
            "cubic_mean_parts",
            "var_parts",
            "delta_var_parts",
            "quadratic_var_parts",
            "cubic_var_parts",
        ],
        BirthUnit::ScreenArea => [
            "initial_mean_parts_per_area",
            "delta_mean_parts_per_area",
            "quadratic_mean_parts_per_area",
            "cubic_mean_parts_per_area",
            "var_parts_per_area",
            "delta_var_parts_per_area",
            "quadratic_var_parts_per_area",
            "cubic_var_parts_per_area",
        ],
    }
}

/// Whether any key of either set of births is written.
pub(super) fn has_births(table: &Reader<'_>) -> bool {
    let given = |per| birth_keys(per).into_iter().any(|key| table.has(key));
    given(BirthUnit::Frame) || given(BirthUnit::ScreenArea)
}

/// Which of the two sets of births the system has: exactly one (Reeves 1983, 2.1), or bursts alone.
pub(super) fn births(table: &Reader<'_>) -> Result<BirthUnit, SceneError> {
    let given = |per| birth_keys(per).into_iter().find(|key| table.has(key));
    let [frame, area] = [BirthUnit::Frame, BirthUnit::ScreenArea].map(|per| {
        let [initial, delta, _, _, var, ..] = birth_keys(per);
        format!("(`{initial}`, `{delta}`, `{var}`)")
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
        (None, None) if table.has_items("burst") => Ok(BirthUnit::Frame),
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

/// Reads a direction: three numbers, not all zero, nor all too small to tell.
pub(super) fn direction(spot: &Spot<'_>) -> Result<[f32; 3], SceneError> {
    let direction = <[f32; 3]>::read(spot)?;
    if length(direction.map(f64::from)) < 1e-6 {
        let why = "is zero, which is no direction";
        return Err(spot.refuse(spot.node, &spot.path, why));
    }
    Ok(direction)
}

/// Reads the four rows of a matrix that makes neither everything flat, nor puts the centre behind the
/// viewer: columns of x and y, and where the centre goes, as they are seen.
pub(super) fn invertible(spot: &Spot<'_>) -> Result<[f32; 16], SceneError> {
    let rows = <[f32; 16]>::read(spot)?;
    let seen = |row: usize| [rows[4 * row], rows[4 * row + 1], rows[4 * row + 3]];
    let [[a, b, x], [c, d, y], [p, q, w]] = [seen(0), seen(1), seen(3)];
    if w < 0.1 {
        let why = "puts the centre of a particle too far away: the last number of the fourth row is below 0.1";
        return Err(spot.refuse(spot.node, &spot.path, why));
    }
    let volume = a * (d * w - y * q) - b * (c * w - y * p) + x * (c * q - d * p);
    if volume.abs() < 1e-4 {
        let why = "is singular: what it makes of a particle is flat";
        return Err(spot.refuse(spot.node, &spot.path, why));
    }
    Ok(rows)
}

/// The least corner of a box is the lesser one.
pub(super) fn corners(min: [f32; 3], max: [f32; 3], table: &Reader<'_>) -> Result<(), SceneError> {
    let Some(axis) = (0..3).find(|&axis| min[axis] > max[axis]) else {
        return Ok(());
    };
    let (path, name) = (table.path_of("max"), ["x", "y", "z"][axis]);
    let (min, max) = (min[axis], max[axis]);
    let what = format!("`{path}` is less than `min` along {name}: {max}, and min is {min}");
    let help = "corners with min at most max along each axis";
    Err(table.at("max").error(what, help))
}

/// The inner circle of a ring is the inner one.
pub(super) fn ring(inner: f32, outer: f32, table: &Reader<'_>) -> Result<(), SceneError> {
    let fault = || ring_fault(inner, outer, &table.path_of("inner_radius"));
    refused(fault, &["inner_radius", "outer_radius"], table)
}

fn ring_fault(inner: f32, outer: f32, path: &str) -> Option<Fault> {
    (inner > outer).then(|| Fault {
        what: format!("`{path}` is {inner}, more than the outer radius"),
        help: format!("at most outer_radius, which is {outer}"),
        key: "inner_radius",
    })
}

/// Refuses a fault in the values of these keys, unless one of them changes: then [`tracks`] does.
fn refused(
    fault: impl FnOnce() -> Option<Fault>,
    keys: &[&str],
    table: &Reader<'_>,
) -> Result<(), SceneError> {
    let fault = if table.changes(keys) { None } else { fault() };
    match fault {
        Some(Fault { what, help, key }) => Err(table.at(key).error(what, help)),
        None => Ok(()),
    }
}

/// Births end after they begin.
pub(super) fn frames(first: i32, end: Option<i32>, table: &Reader<'_>) -> Result<(), SceneError> {
    match end {
        Some(end) if end <= first => {
            let path = table.path_of("end_frame");
            let what = format!("`{path}` is {end}, but births begin at frame {first}");
            let help = format!("more than first_frame, so at least {}", first + 1);
            Err(table.at("end_frame").error(what, help))
        }
        _ => Ok(()),
    }
}

/// Nothing is to be born before the trigger that it counts from.
pub(super) fn triggers(system: &System, table: &Reader<'_>) -> Result<(), SceneError> {
    if system.trigger_frames.is_empty() {
        return Ok(());
    }
    let earliest = system.bursts.iter().map(|burst| (burst.frame, "burst"));
    let births = std::iter::once((system.first_frame, "first_frame"));
    match births.chain(earliest).find(|(frame, _)| *frame < 0) {
        Some((frame, key)) => {
            let path = table.path_of(key);
            let what = format!("`{path}` is at frame {frame} before the trigger it counts from");
            let help = "frames from 0 on, and earlier `trigger_frames`";
            Err(table.at(key).error(what, help))
        }
        None => Ok(()),
    }
}

/// What is seen as a whole trajectory covers, ends, and flies free of the air.
pub(super) fn stroke(system: &System, table: &Reader<'_>) -> Result<(), SceneError> {
    if system.particle_shape != ParticleShape::Stroke {
        return Ok(());
    }
    let (key, what, help) = if system.blend != Blend::Over {
        let what = "adds the light of strokes, which cover what is behind them";
        ("blend", what, "blend = \"over\"")
    } else if system.lifetime.is_none() {
        let what = "is missing: a stroke is as long as its particle lives";
        (
            "lifetime",
            what,
            "the frames that the trajectory lasts, such as lifetime = 40",
        )
    } else if system.drag != 0.0 {
        let what = "is that of strokes, which are the parabolas of particles that feel no air";
        ("drag", what, "0")
    } else if system.light != 0.0 {
        let what = "is that of strokes, which throw none";
        ("light", what, "0")
    } else {
        return Ok(());
    };
    let path = table.path_of(key);
    Err(table.at(key).error(format!("`{path}` {what}"), help))
}

/// The longest lifetime fits a particle's state.
pub(super) fn lifetime(lifetime: Spread<f32>, table: &Reader<'_>) -> Result<(), SceneError> {
    let fault = || lifetime_fault(lifetime, &table.path_of("lifetime"));
    refused(fault, &["lifetime"], table)
}

fn lifetime_fault(lifetime: Spread<f32>, path: &str) -> Option<Fault> {
    let most = lifetime.mean + lifetime.var;
    (most > MAX_LIFETIME).then(|| Fault {
        what: format!("`{path}` reaches {most} frames (mean + var), too many"),
        help: format!("mean + var at most {MAX_LIFETIME} frames"),
        key: "lifetime",
    })
}

/// No two systems have the same name, no two flocks, fires or layers.
pub(super) fn unique_names(root: &Node) -> Result<(), SceneError> {
    for kind in ["system", "flock", "fire", "layer"] {
        let Some(Value::Array(nodes)) = root.entry(kind).map(|entry| &entry.node.value) else {
            continue;
        };
        let mut seen: std::collections::BTreeMap<&str, &At> = std::collections::BTreeMap::new();
        for node in nodes {
            let Some(name) = node.entry("name") else {
                continue;
            };
            let Value::Text(text) = &name.node.value else {
                continue;
            };
            if let Some(first) = seen.insert(text, &name.node.at) {
                let what = format!("`{kind}.{text}.name` is already that of another {kind}");
                let help = format!(
                    "a name of its own: the other stands on line {}",
                    first.line()
                );
                return Err(name.node.at.error(what, help));
            }
        }
    }
    Ok(())
}
