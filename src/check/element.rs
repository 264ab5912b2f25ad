//! From a word of a buffer to what people call it.

use crate::plan::{Count, Plan, buffer};

/// One word of a buffer that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Index of the record: of the particle, the pixel, the system, the word of bits.
    pub record: usize,
    /// Name of the field, e.g. `position.x`; empty where records are single words.
    pub field: &'static str,
    /// Index of the word among the buffer's.
    pub word: usize,
    /// Pixel from the left and from the top, where records are pixels.
    pub pixel: Option<(u32, u32)>,
    /// Whether the word holds a float.
    pub is_float: bool,
    /// The word as expected; `None` where the buffer ends before it.
    pub expected: Option<u32>,
    /// The word as it was got; `None` where the buffer ends before it.
    pub got: Option<u32>,
}

/// Fields a word each, floats marked.
type Fields = &'static [(&'static str, bool)];

const PARTICLE: Fields = &[
    ("position.x", true),
    ("position.y", true),
    ("position.z", true),
    ("index", false),
    ("velocity.x", true),
    ("velocity.y", true),
    ("velocity.z", true),
    ("slot_and_birth_frame", false),
];

const BOID: Fields = &[
    ("position.x", true),
    ("position.y", true),
    ("position.z", true),
    ("flock", false),
    ("velocity.x", true),
    ("velocity.y", true),
    ("velocity.z", true),
    ("index", false),
];

const FLAME: Fields = &[
    ("root.x", true),
    ("root.y", true),
    ("root.z", true),
    ("fire", false),
    ("normal.x", true),
    ("normal.y", true),
    ("normal.z", true),
    ("birth_frame", false),
    ("motion.x", true),
    ("motion.y", true),
    ("motion.z", true),
    ("index", false),
    ("height", true),
    ("width", true),
    ("brightness", true),
    ("burns", false),
];

const PLACE: Fields = &[
    ("position.x", true),
    ("position.y", true),
    ("position.z", true),
    ("position.w", false),
];

const FLAME_DISC: Fields = &[
    ("place.x", true),
    ("place.y", true),
    ("inverse_half_width", true),
    ("inverse_half_height", true),
    ("center.red", true),
    ("center.green", true),
    ("center.blue", true),
    ("center.alpha", true),
    ("rim.red", true),
    ("rim.green", true),
    ("rim.blue", true),
    ("rim.alpha", true),
];

const FLAME_BOUNDS: Fields = &[
    ("columns", false),
    ("lines", false),
    ("inner_alpha", true),
    ("inverse_inner_radius", true),
];

const SPREAD_POINT: Fields = &[
    ("place.x", true),
    ("place.y", true),
    ("face", false),
    ("ring", false),
    ("heading.x", true),
    ("heading.y", true),
    ("key", false),
    ("state", false),
    ("travelled_since_drop", true),
    ("travelled", true),
    ("first_frame", false),
    ("spare", false),
    ("position.x", true),
    ("position.y", true),
    ("position.z", true),
    ("spread", false),
];

const SPREAD_COUNTS: Fields = &[
    ("total", false),
    ("live", false),
    ("requested", false),
    ("born", false),
    ("died", false),
    ("before", false),
    ("inserted", false),
    ("ignited_from", false),
    ("flames_total", false),
    ("flames_first", false),
    ("flames_requested", false),
    ("flames_born", false),
    ("flames_died", false),
    ("flames_live", false),
    ("marks_first", false),
    ("marks_died", false),
];

const DROPPED_FLAME: Fields = &[
    ("root.x", true),
    ("root.y", true),
    ("root.z", true),
    ("fire", false),
    ("normal.x", true),
    ("normal.y", true),
    ("normal.z", true),
    ("birth_frame", false),
    ("key", false),
    ("number", false),
    ("lifetime", false),
    ("spare", false),
];

/// A step of a flame, counted down from above, and where it meets a piece.
const CATCHES: Fields = &[("first", false), ("face", false), ("x", true), ("y", true)];

const RING_SPAN: Fields = &[("first", false), ("last", false)];

const COUNTS: Fields = &[
    ("live", false),
    ("requested", false),
    ("born", false),
    ("dropped", false),
    ("total", false),
    ("died", false),
    ("spare_a", false),
    ("spare_b", false),
];

const FRAME_STATS: Fields = &[
    ("frame", false),
    ("requested", false),
    ("born", false),
    ("died", false),
    ("live", false),
    ("dropped", false),
    ("died_of_intensity", false),
    ("died_of_bounds", false),
    ("systems_requested", false),
    ("systems_born", false),
    ("systems_died", false),
    ("systems_live", false),
    ("points_requested", false),
    ("points_born", false),
    ("points_died", false),
    ("points_live", false),
    ("flames_requested", false),
    ("flames_born", false),
    ("flames_died", false),
    ("flames_live", false),
    ("marks_died", false),
    ("marks_live", false),
];

const NODE: Fields = &[
    ("key", false),
    ("birth_frame", false),
    ("like_slot", false),
    ("parent_slot", false),
    ("state", false),
    ("lifetime", false),
    ("free_from", false),
    ("index", false),
    ("velocity.x", true),
    ("velocity.y", true),
    ("velocity.z", true),
    ("velocity.w", true),
    ("acceleration.x", true),
    ("acceleration.y", true),
    ("acceleration.z", true),
    ("acceleration.w", true),
    ("place_x.x", true),
    ("place_x.y", true),
    ("place_x.z", true),
    ("place_x.w", true),
    ("place_y.x", true),
    ("place_y.y", true),
    ("place_y.z", true),
    ("place_y.w", true),
    ("place_z.x", true),
    ("place_z.y", true),
    ("place_z.z", true),
    ("place_z.w", true),
];

const COVER: Fields = &[
    ("points.x", true),
    ("points.y", true),
    ("points.z", true),
    ("points.w", true),
    ("shape.x", true),
    ("shape.y", true),
    ("kind", false),
    ("depth", true),
    ("color.red", true),
    ("color.green", true),
    ("color.blue", true),
    ("color.alpha", true),
    ("lit.red", true),
    ("lit.green", true),
    ("lit.blue", true),
    ("side", false),
];

const RED_GREEN: Fields = &[("red", true), ("green", true)];

const SKEW: Fields = &[
    ("skew.x", true),
    ("skew.y", true),
    ("tilt.x", true),
    ("tilt.y", true),
];

const STRIP_JOINT: Fields = &[
    ("place.x", true),
    ("place.y", true),
    ("along.x", true),
    ("along.y", true),
    ("half-width", true),
    ("opacity", true),
    ("seen", false),
    ("depth", true),
];

const FLAME_LIGHT: Fields = &[
    ("place.x", true),
    ("place.y", true),
    ("place.z", true),
    ("extent", true),
    ("red", true),
    ("green", true),
    ("blue", true),
    ("w", false),
];

const PLANET_PIXEL: Fields = &[
    ("red", true),
    ("green", true),
    ("blue", true),
    ("clear", true),
];

const SAMPLE_NEARNESS: Fields = &[
    ("sample_0", true),
    ("sample_1", true),
    ("sample_2", true),
    ("sample_3", true),
];

const SAMPLE_FACES: Fields = &[
    ("sample_0", false),
    ("sample_1", false),
    ("sample_2", false),
    ("sample_3", false),
];

const FRONT: Fields = &[("front", true)];

const BLUE_CLEAR: Fields = &[("blue", true), ("clear", true)];

const CHANNELS: Fields = &[("red", false), ("green", false), ("blue", false)];

const WORD: Fields = &[("", false)];

/// The fields of a buffer's records.
fn fields(name: &str) -> Fields {
    let Some(declared) = buffer(name) else {
        return WORD;
    };
    match (declared.record, declared.count) {
        ("Cover", _) => COVER,
        _ if ["planet_pixels", "ground_pixels", "surface_pixels"].contains(&name) => PLANET_PIXEL,
        _ if name == "surface_nearness" => SAMPLE_NEARNESS,
        _ if name == "surface_faces" => SAMPLE_FACES,
        _ if name == "cover_front" => FRONT,
        ("FlameLight", _) => FLAME_LIGHT,
        _ if name == "cover_rg" => RED_GREEN,
        _ if name == "cover_bt" => BLUE_CLEAR,
        ("Flame", _) => FLAME,
        ("FlameDisc", _) => FLAME_DISC,
        ("StripJoint", _) => STRIP_JOINT,
        _ if name == "flame_skews" => SKEW,
        _ if ["flame_steps", "boid_trails"].contains(&name) => PLACE,
        ("SpreadPoint", _) => SPREAD_POINT,
        ("SpreadCounts", _) => SPREAD_COUNTS,
        ("DroppedFlame", _) => DROPPED_FLAME,
        _ if name == "ring_spans" => RING_SPAN,
        _ if name == "catches" => CATCHES,
        _ if name == "flame_bounds" => FLAME_BOUNDS,
        ("Particle", _) => PARTICLE,
        ("Node", _) => NODE,
        ("Boid", _) => BOID,
        ("Counts", _) => COUNTS,
        ("FrameStats", _) => FRAME_STATS,
        (_, Count::Pixels(3)) => CHANNELS,
        _ => WORD,
    }
}

/// What stands at `word` of the buffer.
pub(super) fn element(
    plan: &Plan,
    name: &str,
    word: usize,
    expected: &[u32],
    got: &[u32],
) -> Element {
    let fields = fields(name);
    let record = word / fields.len();
    let (field, is_float) = fields[word % fields.len()];
    let is_picture = buffer(name).is_some_and(|declared| {
        matches!(
            declared.count,
            Count::Pixels(_)
                | Count::CoveredPixels(_)
                | Count::PlanetPixels
                | Count::GroundPixels
                | Count::SurfacePixels(_)
                | Count::FrontPixels
        )
    });
    let across = plan.width.max(1) as usize;
    let pixel = is_picture.then_some(((record % across) as u32, (record / across) as u32));
    Element {
        record,
        field,
        word,
        pixel,
        is_float,
        expected: expected.get(word).copied(),
        got: got.get(word).copied(),
    }
}

impl std::fmt::Display for Element {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            record,
            field,
            pixel,
            is_float,
            expected,
            got,
            ..
        } = self;
        write!(f, "record {record}")?;
        if let Some((x, y)) = pixel {
            write!(f, " (pixel {x}, {y})")?;
        }
        if !field.is_empty() {
            write!(f, ", {field}")?;
        }
        let value = |word: &Option<u32>| match word {
            None => "nothing: there is no such record".to_owned(),
            Some(bits) if *is_float => format!("{bits:#010x} ({:e})", f32::from_bits(*bits)),
            Some(bits) => format!("{bits:#010x} ({bits})"),
        };
        write!(f, ": expected {}, got {}", value(expected), value(got))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{BUFFERS, BufferRole};

    #[test]
    fn every_word_of_a_state_record_has_a_name() {
        for declared in BUFFERS
            .iter()
            .filter(|buffer| buffer.role == BufferRole::State)
        {
            let words = declared.stride as usize / 4;
            let fields = fields(declared.name);
            match declared.count {
                Count::Pixels(each) | Count::SurfacePixels(each) | Count::Pieces(each) => {
                    assert_eq!(fields.len(), each as usize * words, "{}", declared.name);
                }
                _ => assert_eq!(fields.len(), words, "{}", declared.name),
            }
            assert!(words == 1 || fields.iter().all(|(name, _)| !name.is_empty()));
        }
    }
}
