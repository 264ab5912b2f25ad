//! Every key refuses what it should, with file, line, column, key and what would be right.

use std::collections::BTreeSet;

use crate::text::{FILE, MINIMAL, line_of, refused, with};
use motes::scene::parse;
use motes::scene::schema::{self, Field, Kind};

/// Every key that is not a table: section, key, a value of the wrong kind, a value that is out
/// of range, and words that the help must have.
#[rustfmt::skip]
pub(crate) const KEYS: &[(&str, &str, &str, &str, &str)] = &[
    ("", "title", "3", r#""two\nlines""#, "at most 200 characters in one line"),
    ("", "description", "false", r#""bell\u0007""#, "at most 10_000 characters"),
    ("", "frames", "12.5", "0", "a whole number from 1 to 1_000_000"),
    ("", "frame_rate", "\"fast\"", "241", "from 1 to 240"),
    ("", "seed", "1.0", "-1", "from 0 to 9223372036854775807"),
    ("", "capacity", "[1]", "1_000_000_001", "from 1 to 1_000_000_000"),
    ("", "max_systems", "[1]", "16_385", "from 1 to 16_384"),
    ("", "steady_particles", "\"1e6\"", "0", "from 1 to 1_000_000_000"),
    ("image", "width", "640.0", "4097", "from 1 to 4096, pixels"),
    ("image", "height", "\"720\"", "0", "from 1 to 4096, pixels"),
    ("image", "background", "0.5", "[0, 0, 1.01]", "3 numbers, each from 0 to 1"),
    ("image", "shutter", "true", "1.5", "from 0 to 1, frames"),
    ("image", "shutter_weighting", "1", "\"eyes\"", "\"camera\", \"eye\""),
    ("image", "exposure", "[1]", "-0.1", "from 0 to 1000"),
    ("camera", "position", "[0, 1]", "[0, 1e7, 0]", "3 numbers, each from -1_000_000 to 1_000_000, world"),
    ("camera", "target", "[0, 0, 0, 0]", "[0, 0, nan]", "3 numbers, each from -1_000_000"),
    ("camera", "up", "{ x = 1 }", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("camera", "projection", "true", "\"ortographic\"", "\"perspective\", \"orthographic\""),
    ("camera", "view_height", "\"4\"", "0", "from 0.000001 to 1_000_000, world units"),
    ("camera", "vertical_fov_degrees", "\"wide\"", "0.5", "from 1 to 170, degrees"),
    ("camera", "near", "[0.1]", "0", "from 0.000001 to 1_000_000"),
    ("light", "direction", "1", "[0, 0, 0]", "3 numbers, each from -1_000_000 to 1_000_000"),
    ("light", "color", "1", "[0, 0, -1]", "3 numbers, each from 0 to 1000"),
    ("light", "ambient", "[1]", "[0, 0, 1001]", "3 numbers, each from 0 to 1000"),
    ("light", "shadow_center", "1", "[0, 0, 2e6]", "3 numbers, each from -1_000_000 to 1_000_000"),
    ("light", "shadow_radius", "[1]", "0", "from 0.001 to 1_000_000, world units"),
    ("light", "shadow_cells", "\"all\"", "97", "from 4 to 96, cells"),
    ("system", "name", "7", r#""7th""#, "a letter or _, then letters, digits, - and _"),
    ("system", "parent", "7", r#""7th""#, "a letter or _, then letters, digits, - and _"),
    ("system", "child_up", "1", "\"up\"", "\"parent\", \"outward\""),
    ("inherit", "mean_parts", "[1]", "-1", "from 0 to 16_000_000"),
    ("inherit", "var_parts", "true", "-0.5", "from 0 to 16_000_000"),
    ("inherit", "generation_scale", "\"1\"", "1.5", "from 0 to 1, a share of the shape's extents"),
    ("inherit", "ejection_angle_degrees", "[1]", "181", "from 0 to 180, degrees"),
    ("inherit", "speed", "\"0.1\"", "-0.1", "from 0 to 10_000"),
    ("inherit", "lifetime", "true", "65_001", "from 0 to 65_000"),
    ("inherit", "color", "0.5", "[0, 0, -0.1]", "from 0 to 1000"),
    ("inherit", "transparency", "[0.5]", "1.5", "from 0 to 1"),
    ("inherit", "size", "\"big\"", "-1", "from 0 to 10_000"),
    ("system", "position", "1979-05-27", "[-2e6, 0, 0]", "3 numbers, each from -1_000_000"),
    ("system", "rotation_degrees", "[0, 0, 0]", "[36_001, 0]", "2 numbers, each from -36_000 to 36_000"),
    ("system", "first_frame", "0.5", "-65_001", "from -65_000 to 1_000_000"),
    ("system", "end_frame", "\"never\"", "-65_000", "from -64_999 to 1_000_000"),
    ("system", "trigger_frames", "3", "[0, 1_000_001]", "at most 256 whole numbers in ascending order, each from -65_000 to 1_000_000"),
    ("system", "birth_moment", "0.5", "\"within\"", "\"frame_start\", \"within_frame\""),
    ("system", "particle_space", "[]", "\"local\"", "\"system\", \"world\""),
    ("system", "initial_mean_parts", "\"many\"", "-1", "from 0 to 16_000_000, particles a frame"),
    ("system", "delta_mean_parts", "[1]", "1e9", "from -16_000_000 to 16_000_000"),
    ("system", "quadratic_mean_parts", "\"1\"", "-16_000_001", "from -16_000_000 to 16_000_000"),
    ("system", "cubic_mean_parts", "true", "inf", "from -16_000_000 to 16_000_000"),
    ("system", "var_parts", "false", "-0.5", "from 0 to 16_000_000"),
    ("system", "delta_var_parts", "[]", "1e9", "from -16_000_000 to 16_000_000"),
    ("system", "quadratic_var_parts", "{}", "-1e9", "from -16_000_000 to 16_000_000"),
    ("system", "cubic_var_parts", "\"0\"", "nan", "from -16_000_000 to 16_000_000"),
    ("system", "initial_mean_parts_per_area", "\"1\"", "1001", "from 0 to 1000"),
    ("system", "delta_mean_parts_per_area", "\"1\"", "-1001", "from -1000 to 1000"),
    ("system", "quadratic_mean_parts_per_area", "[1]", "1001", "from -1000 to 1000"),
    ("system", "cubic_mean_parts_per_area", "\"1\"", "-1001", "from -1000 to 1000"),
    ("system", "var_parts_per_area", "\"1\"", "-1", "from 0 to 1000"),
    ("system", "delta_var_parts_per_area", "false", "1001", "from -1000 to 1000"),
    ("system", "quadratic_var_parts_per_area", "\"1\"", "-1001", "from -1000 to 1000"),
    ("system", "cubic_var_parts_per_area", "\"1\"", "inf", "from -1000 to 1000"),
    ("system", "mean_parts_wander", "\"much\"", "1.5", "from 0 to 1, a share of the mean"),
    ("system", "mean_parts_wander_frames", "[24]", "0.5", "from 1 to 1_000_000, frames"),
    ("system", "birth_rounding", "1", "\"nearst\"", "\"stochastic\", \"nearest\""),
    ("system", "generation_shape", "\"sphere\"", "{ kind = \"cube\" }", "{ kind = \"circle\", radius }"),
    ("system", "ejection_axis", "[0, 1, 0]", "\"outwards\"", "\"up\", \"outward\", \"around\""),
    ("system", "ejection_angle_degrees", "\"30\"", "181", "from 0 to 180, degrees"),
    ("system", "ejection_spread", "30", "\"even\"", "\"solid_angle\", \"angle\""),
    ("system", "speed", "\"0.1\"", "10_001", "from -10_000 to 10_000"),
    ("system", "lifetime", "true", "0", "from 1 to 65_000"),
    ("system", "color", "0.5", "[0, 0, -0.1]", "from 0 to 1000"),
    ("system", "transparency", "[0.5]", "1.5", "from 0 to 1"),
    ("system", "size", "\"big\"", "0", "from 0.000001 to 10_000"),
    ("system", "acceleration", "-0.01", "[0, 0, 1e5]", "3 numbers, each from -10_000 to 10_000"),
    ("system", "acceleration_space", "1", "\"local\"", "\"world\", \"system\""),
    ("system", "drag", "\"some\"", "1.01", "from 0 to 1, a share of the velocity"),
    ("system", "integration", "2", "\"verlet\"", "\"euler\", \"parabola\""),
    ("system", "particle_shape", "3", "\"disc\"", "\"sphere\", \"rectangle\", \"streak\", \"stroke\""),
    ("system", "blend", "1", "\"under\"", "\"add\", \"over\""),
    ("system", "shading", "true", "\"lit\"", "\"flat\", \"lit_sphere\", \"lit_cloud\""),
    ("system", "edge_softness", "\"soft\"", "1.5", "from 0 to 1, a share of the radius"),
    ("system", "streak_light", "true", "\"kept\"", "\"conserved\", \"constant\""),
    ("system", "stroke_taper", "\"thin\"", "1.5", "from 0 to 1, a share of the width"),
    ("system", "stroke_pieces", "1.5", "65", "from 1 to 64"),
    ("system", "stroke_shadow", "[1]", "-0.1", "from 0 to 1, a share of the light"),
    ("system", "intensity_threshold", "[0]", "-0.01", "from 0 to 1000"),
    ("system", "intensity", "0.01", "\"bright\"", "\"brightest\", \"luminance\""),
    ("system", "light_distance", "\"far\"", "0", "from 0.000001 to 1_000_000, world units"),
    ("system", "light", "\"dim\"", "-0.5", "from 0 to 1_000_000"),
    ("burst", "frame", "1.5", "-65_001", "from -65_000 to 1_000_000"),
    ("burst", "parts", "\"many\"", "-1", "from 0 to 16_000_000"),
    ("extinction.distance", "direction", "3", "[0, 0, 0]", "3 numbers, each from -1_000_000 to 1_000_000"),
    ("extinction.distance", "distance", "[5]", "-1e7", "from -1_000_000 to 1_000_000"),
    ("extinction.plane", "point", "[0, 0]", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("extinction.plane", "normal", "\"up\"", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("extinction.sphere", "center", "0", "[inf, 0, 0]", "3 numbers, each from -1_000_000"),
    ("extinction.sphere", "radius", "[1]", "-0.5", "from 0 to 1_000_000"),
    ("extinction.sphere", "kills", "true", "\"in\"", "\"inside\", \"outside\""),
    ("extinction.box", "min", "-1", "[-1e7, 0, 0]", "3 numbers, each from -1_000_000"),
    ("extinction.box", "max", "1", "[0, 1e7, 0]", "3 numbers, each from -1_000_000"),
    ("extinction.box", "kills", "0", "\"both\"", "\"inside\", \"outside\""),
    ("flock", "name", "7", r#""a b""#, "a letter or _, then letters, digits, - and _"),
    ("flock", "count", "1.5", "32_000_001", "from 1 to 32_000_000, boids"),
    ("flock", "dimensions", "true", "4", "from 2 to 3"),
    ("flock", "start_speed", "[1]", "-1", "from 0 to 10_000"),
    ("flock", "max_speed", "\"fast\"", "0", "from 0.000001 to 10_000"),
    ("flock", "mass", "[1]", "0", "from 0.000001 to 1_000_000"),
    ("flock", "force", "1", "[0, 0, 1e5]", "3 numbers, each from -10_000 to 10_000"),
    ("flock", "perception_radius", "true", "-1", "from 0.000001 to 1_000_000"),
    ("flock", "edges", "\"wrap\"", "{ kind = \"bounce\" }", "{ kind = \"wrap\", min, max }"),
    ("flock", "drag", "[1]", "1.5", "from 0 to 1"),
    ("goal", "position", "1", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("goal", "weight", "[1]", "101", "from -100 to 100"),
    ("goal", "speed", "\"1\"", "-1", "from 0 to 10_000"),
    ("goal", "limit", "true", "0", "from 0.000001 to 10_000"),
    ("goal", "slowing_radius", "[1]", "-1", "from 0 to 1_000_000"),
    ("obstacle.sphere", "center", "0", "[inf, 0, 0]", "3 numbers, each from -1_000_000"),
    ("obstacle.sphere", "radius", "[1]", "0", "from 0.001 to 1_000_000"),
    ("obstacle.plane", "point", "[0, 0]", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("obstacle.plane", "normal", "\"up\"", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("obstacle.box", "min", "-1", "[-1e7, 0, 0]", "3 numbers, each from -1_000_000"),
    ("obstacle.box", "max", "1", "[0, 1e7, 0]", "3 numbers, each from -1_000_000"),
    ("obstacle.sphere", "stay", "true", "\"in\"", "\"outside\", \"inside\""),
    ("obstacle.box", "stay", "0", "\"both\"", "\"outside\", \"inside\""),
    ("obstacle.sphere", "margin", "[1]", "0", "from 0.001 to 1_000_000"),
    ("obstacle.plane", "margin", "[1]", "0", "from 0.001 to 1_000_000"),
    ("obstacle.box", "margin", "[1]", "0", "from 0.001 to 1_000_000"),
    ("obstacle.mesh", "mesh", "1", r#""two\nlines""#, "at most 1000 characters in one line"),
    ("obstacle.mesh", "position", "0", "[inf, 0, 0]", "3 numbers, each from -1_000_000"),
    ("obstacle.mesh", "scale", "[1]", "0", "from 0.000001 to 10_000"),
    ("obstacle.mesh", "stay", "1", "\"in\"", "\"outside\", \"inside\""),
    ("obstacle.mesh", "margin", "[1]", "0", "from 0.001 to 1_000_000"),
    ("obstacle.mesh", "limit", "true", "0", "from 0.000001 to 10_000"),
    ("obstacle.sphere", "limit", "true", "0", "from 0.000001 to 10_000"),
    ("obstacle.plane", "limit", "true", "0", "from 0.000001 to 10_000"),
    ("obstacle.box", "limit", "true", "0", "from 0.000001 to 10_000"),
    ("flock", "shape", "3", "\"square\"", "\"triangle\", \"disc\", \"point\", \"cone\""),
    ("flock", "size", "\"big\"", "0", "from 0.000001 to 10_000"),
    ("flock", "color", "1", "[0, 0, 1.5]", "3 numbers, each from 0 to 1"),
    ("flock", "opacity", "[1]", "1.5", "from 0 to 1"),
    ("flock", "trail_frames", "1.5", "65", "from 0 to 64, frames"),
    ("flock", "mirrored", "1", "\"yes\"", "true or false"),
    ("region", "min", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("region", "max", "true", "[0, nan, 0]", "3 numbers, each from -1_000_000"),
    ("edges.wrap", "min", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("edges.wrap", "max", "true", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("edges.repel", "min", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("edges.repel", "max", "true", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("edges.constrain", "min", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("edges.constrain", "max", "true", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("edges.torus", "min", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("edges.torus", "max", "true", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("edges.repel", "inward", "1", "\"yes\"", "true or false"),
    ("edges.constrain", "factor", "\"4\"", "-101", "from -100 to 100"),
    ("relation.flock", "other", "1", "\"a b\"", "a letter or _, then letters, digits, - and _"),
    ("relation.flock", "radius", "[1]", "0", "from 0.000001 to 1_000_000"),
    ("relation.flock", "view_angle_degrees", "true", "361", "from 1 to 360"),
    ("relation.flock", "nearest", "1.5", "17", "from 1 to 16"),
    ("relation.avoid", "other", "1", "\"a b\"", "a letter or _, then letters, digits, - and _"),
    ("relation.avoid", "radius", "[1]", "0", "from 0.000001 to 1_000_000"),
    ("relation.avoid", "view_angle_degrees", "true", "361", "from 1 to 360"),
    ("relation.avoid", "nearest", "1.5", "17", "from 1 to 16"),
    ("relation.avoid", "limit", "[1]", "0", "from 0.000001 to 10_000"),
    ("relation.approach", "other", "1", "\"a b\"", "a letter or _, then letters, digits, - and _"),
    ("relation.approach", "radius", "[1]", "0", "from 0.000001 to 1_000_000"),
    ("relation.approach", "view_angle_degrees", "true", "361", "from 1 to 360"),
    ("relation.approach", "nearest", "1.5", "17", "from 1 to 16"),
    ("relation.approach", "limit", "[1]", "0", "from 0.000001 to 10_000"),
    ("relation.flock", "separation_weight", "[1]", "101", "from -100 to 100"),
    ("relation.flock", "separation_speed", "\"1\"", "-1", "from 0 to 10_000"),
    ("relation.flock", "separation_limit", "true", "0", "from 0.000001 to 10_000"),
    ("relation.flock", "alignment_weight", "[1]", "101", "from -100 to 100"),
    ("relation.flock", "alignment_speed", "\"1\"", "-1", "from 0 to 10_000"),
    ("relation.flock", "alignment_limit", "true", "0", "from 0.000001 to 10_000"),
    ("relation.flock", "cohesion_weight", "[1]", "101", "from -100 to 100"),
    ("relation.flock", "cohesion_speed", "\"1\"", "-1", "from 0 to 10_000"),
    ("relation.flock", "cohesion_limit", "true", "0", "from 0.000001 to 10_000"),
    ("relation.flock", "separation", "1", "\"near\"", "\"literal\", \"inverse_distance\""),
    ("fire", "name", "7", r#""a b""#, "a letter or _, then letters, digits, - and _"),
    ("fire", "position", "1", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("fire", "rotation_degrees", "[0, 0, 0]", "[36_001, 0]", "2 numbers, each from -36_000 to 36_000"),
    ("fire", "roots", "\"line\"", "{ kind = \"square\" }", "{ kind = \"line\", length, count }"),
    ("fire", "height", "\"high\"", "0", "from 0.000001 to 10_000"),
    ("fire", "width", "[1]", "1e5", "from 0.000001 to 10_000"),
    ("fire", "base_width", "[1]", "-1", "from 0 to 100"),
    ("fire", "swell", "true", "101", "from 0 to 100"),
    ("fire", "base_height", "\"0\"", "0", "from 0.001 to 100"),
    ("fire", "height_growth", "[1]", "-0.1", "from 0 to 10"),
    ("fire", "speed", "1", "\"fast\"", "\"normalised\", \"free\""),
    ("fire", "start_speed", "\"1\"", "-1", "from 0 to 10_000"),
    ("fire", "buoyancy", "[1]", "1e5", "from -10_000 to 10_000"),
    ("fire", "gravity", "1", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("fire", "noisiness", "[1]", "-0.1", "from 0 to 1000"),
    ("fire", "sampling", "true", "1001", "from -1000 to 1000"),
    ("fire", "inverse_cohesion", "[1]", "-1", "from 0 to 10_000"),
    ("fire", "wind_factor", "\"1\"", "-1", "from 0 to 10_000"),
    ("fire", "brightness", "[1]", "-1", "from 0 to 1000"),
    ("fire", "color_noise", "true", "-0.1", "from 0 to 10"),
    ("fire", "color_noise_scale", "[1]", "-1", "from 0 to 10_000"),
    ("fire", "inner_radius", "[1]", "0", "from 0.01 to 1"),
    ("fire", "inner_alpha", "\"1\"", "-1", "from 0 to 100"),
    ("fire", "details", "1.5", "5", "from 0 to 4, octaves"),
    ("fire", "detail_spread", "[1]", "-1", "from 0 to 100"),
    ("fire", "detail_alpha", "true", "2.5", "from 0 to 2"),
    ("fire", "blackbody", "2000", "[2000, 999]", "2 numbers, each from 1000 to 20_000, kelvin"),
    ("fire", "blackbody_rim", "[1]", "0", "from 0.1 to 1"),
    ("fire", "form", "1", "\"ribbon\"", "\"particles\", \"strip\""),
    ("fire", "strip_cells", "2", "[1, -1]", "2 numbers, each from 0 to 1000"),
    ("fire", "strip_contrast", "true", "-1", "from 0 to 10"),
    ("fire", "particle_matrix", "[1, 0, 0, 1]", "[101, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", "16 numbers, each from -100 to 100"),
    ("fire", "matrix_noise", "[1]", "11", "from 0 to 10"),
    ("fire", "light", "true", "-1", "from 0 to 1_000_000"),
    ("fire", "lights", "1.5", "65", "from 0 to 64"),
    ("fire", "light_from", "1", "\"root\"", "\"mean\", \"middle\", \"tip\""),
    ("fire", "first_frame", "0.5", "-65_001", "from -65_000 to 1_000_000"),
    ("fire", "kindling_frames", "1.5", "-1", "from 0 to 1_000_000"),
    ("fire", "lifetime", "true", "0", "from 1 to 1_000_000"),
    ("fire", "growth_frames", "\"few\"", "-1", "from 0 to 1_000_000"),
    ("flame", "position", "1", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("flame", "normal", "1", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("flame", "height", "[1]", "0", "from 0.000001 to 10_000"),
    ("flame", "width", "true", "-1", "from 0.000001 to 10_000"),
    ("flame", "brightness", "[1]", "-1", "from 0 to 1000"),
    ("flame", "first_frame", "0.5", "1_000_001", "from -65_000 to 1_000_000"),
    ("roots.line", "length", "[1]", "0", "from 0.000001 to 10_000"),
    ("roots.line", "count", "1.5", "0", "from 1 to 1_000_000, flames"),
    ("roots.circle", "radius", "true", "0", "from 0.000001 to 10_000"),
    ("roots.circle", "count", "\"many\"", "1_000_001", "from 1 to 1_000_000"),
    ("roots.disc", "radius", "[1]", "-1", "from 0.000001 to 10_000"),
    ("roots.disc", "count", "1.5", "0", "from 1 to 1_000_000"),
    ("roots.mesh", "mesh", "1", r#""two\nlines""#, "at most 1000 characters in one line"),
    ("roots.mesh", "scale", "[1]", "0", "from 0.000001 to 10_000"),
    ("roots.mesh", "count", "true", "0", "from 1 to 1_000_000"),
    ("ramp", "age", "[1]", "1.5", "from 0 to 1"),
    ("ramp", "center", "1", "[0, 0, -1]", "3 numbers, each from 0 to 1000"),
    ("ramp", "rim", "[1]", "[0, 0, 1001]", "3 numbers, each from 0 to 1000"),
    ("ramp", "alpha", "true", "1.5", "from 0 to 1"),
    ("ramp", "rim_alpha", "[1]", "-0.1", "from 0 to 1"),
    ("profile", "age", "[1]", "-0.1", "from 0 to 1"),
    ("profile", "width", "true", "101", "from 0 to 100"),
    ("profile", "height", "\"1\"", "0", "from 0.001 to 100"),
    ("spread", "mesh", "1", r#""two\nlines""#, "at most 1000 characters in one line"),
    ("spread", "scale", "[1]", "0", "from 0.000001 to 10_000"),
    ("spread", "time_scale", "true", "-1", "from 0 to 1000"),
    ("spread", "opposed_flux", "[1]", "-1", "from 0 to 1_000_000_000"),
    ("spread", "concurrent_flux", "\"1\"", "-1", "from 0 to 1_000_000_000"),
    ("spread", "ignition_heat", "[1]", "0", "from 0.000001 to 1_000_000_000_000"),
    ("spread", "drop_distance", "true", "0", "from 0.000001 to 10_000"),
    ("spread", "separation", "[1]", "0", "from 0.000001 to 10_000"),
    ("spread", "curvature_distance", "[1]", "0", "from 0.000001 to 10_000"),
    ("spread", "catch_points", "1.5", "2", "from 3 to 256"),
    ("spread", "law", "1", "\"rain\"", "\"fire\", \"spill\""),
    ("spread", "curvature", "1", "\"round\"", "\"exposed\", \"literal\""),
    ("spread", "heading", "1", "\"up\"", "\"ray\", \"normal\""),
    ("spread", "insertion", "1", "\"none\"", "\"arc\", \"midpoint\""),
    ("spread", "double_burning", "1", "\"yes\"", "\"prevented\", \"ignored\""),
    ("spread", "drop_counter", "1", "\"drop\"", "\"reset\", \"carry\""),
    ("spread", "max_flames", "1.5", "-1", "from 0 to 60_000"),
    ("spread", "max_points", "1.5", "7", "from 8 to 1_000_000"),
    ("ignition", "position", "1", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("ignition", "first_frame", "0.5", "-1", "from 0 to 1_000_000"),
    ("ignition", "points", "1.5", "2", "from 3 to 4096"),
    ("material", "part", "1", r#""two\nlines""#, "at most 256 characters in one line"),
    ("material", "speed", "[1]", "-1", "from 0 to 1000"),
    ("material", "thickness", "[1]", "0", "from 0.000001 to 1000"),
    ("material", "conductivity", "[1]", "-1", "from 0 to 10_000"),
    ("material", "lifetime", "1.5", "0", "from 1 to 1_000_000"),
    ("formula", "flame_temperature", "[1]", "0", "from 1 to 10_000"),
    ("formula", "fuel_temperature", "[1]", "-1", "from 0 to 10_000"),
    ("formula", "conductivity", "[1]", "-1", "from 0 to 10_000"),
    ("formula", "emissivity", "true", "1.5", "from 0 to 1"),
    ("formula", "flame_length", "[1]", "-1", "from 0 to 1000"),
    ("formula", "flame_angle_degrees", "[1]", "181", "from 0 to 180"),
    ("formula", "thickness", "[1]", "0", "from 0.000001 to 1000"),
    ("formula", "density", "[1]", "0", "from 0.001 to 1_000_000"),
    ("formula", "enthalpy", "[1]", "0", "from 0.001 to 1_000_000_000"),
    ("grain", "pattern", "1", "\"dots\"", "\"stripes\", \"rings\""),
    ("grain", "direction", "1", "[0, 0, 0]", "3 numbers"),
    ("grain", "scale", "[1]", "-1", "from 0 to 10_000"),
    ("grain", "strength", "[1]", "1.5", "from 0 to 1"),
    ("grain", "shift", "[1]", "-1", "from 0 to 1000"),
    ("grain", "noise_scale", "[1]", "-1", "from 0 to 10_000"),
    ("smoke", "speed", "[1]", "-1", "from 0 to 10_000"),
    ("smoke", "frames", "[1]", "0", "from 1 to 1_000_000"),
    ("smoke", "size", "[1]", "0", "from 0.000001 to 10_000"),
    ("smoke", "growth", "[1]", "-1", "from 0 to 1000"),
    ("smoke", "color", "1", "[0, 0, -1]", "3 numbers, each from 0 to 1000"),
    ("smoke", "opacity", "true", "1.5", "from 0 to 1"),
    ("smoke", "max_puffs", "1.5", "0", "from 1 to 200_000"),
    ("char", "size", "[1]", "0", "from 0.000001 to 10_000"),
    ("char", "opacity", "true", "1.5", "from 0 to 1"),
    ("char", "edge_softness", "[1]", "1.5", "from 0 to 1"),
    ("char", "glow", "1", "[0, 0, -1]", "3 numbers, each from 0 to 1000"),
    ("char", "glow_frames", "[1]", "0", "from 1 to 1_000_000"),
    ("char", "appear_frames", "true", "0", "from 1 to 1_000_000"),
    ("char", "max_marks", "1.5", "0", "from 1 to 200_000"),
    ("line", "width", "[1]", "-1", "from 0 to 10_000"),
    ("line", "color", "1", "[0, 0, 1001]", "3 numbers, each from 0 to 1000"),
    ("line", "opacity", "true", "1.5", "from 0 to 1"),
    ("wind.uniform", "velocity", "0.02", "[0, 0, 1e5]", "3 numbers, each from -10_000 to 10_000"),
    ("wind.buoyancy", "gravity", "-1", "[0, nan, 0]", "3 numbers, each from -10_000 to 10_000"),
    ("wind.buoyancy", "strength", "[1]", "10_001", "from -10_000 to 10_000"),
    ("wind.gusts", "velocity", "[1, 2]", "[-1e5, 0, 0]", "3 numbers, each from -10_000 to 10_000"),
    ("wind.gusts", "amplitude", "\"strong\"", "-0.1", "from 0 to 10, a share of the velocity"),
    ("wind.gusts", "frames", "true", "0.5", "from 1 to 1_000_000, frames"),
    ("wind.vortex", "position", "1", "[0, 0, 2e6]", "3 numbers, each from -1_000_000"),
    ("wind.vortex", "axis", "\"y\"", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("wind.vortex", "speed", "[1]", "-10_001", "from -10_000 to 10_000"),
    ("wind.vortex", "radius", "[1]", "0", "from 0.001 to 1_000_000"),
    ("wind.source", "position", "1", "[0, 2e6, 0]", "3 numbers, each from -1_000_000"),
    ("wind.source", "strength", "[1]", "1e10", "from -1_000_000_000 to 1_000_000_000"),
    ("wind.source", "radius", "\"r\"", "0", "from 0.001 to 1_000_000"),
    ("wind.sink", "position", "1", "[2e6, 0, 0]", "3 numbers, each from -1_000_000"),
    ("wind.sink", "strength", "{}", "-1e10", "from -1_000_000_000 to 1_000_000_000"),
    ("wind.sink", "radius", "true", "1e7", "from 0.001 to 1_000_000"),
    ("wind.attractor", "position", "1", "[0, inf, 0]", "3 numbers, each from -1_000_000"),
    ("wind.attractor", "speed", "\"fast\"", "1e5", "from -10_000 to 10_000"),
    ("wind.attractor", "radius", "[1]", "-1", "from 0.001 to 1_000_000"),
    ("wind.noise", "strength", "true", "1e5", "from -10_000 to 10_000"),
    ("wind.noise", "scale", "1", "[1, -1, 1]", "3 numbers, each from 0 to 10_000"),
    ("wind.noise", "drift", "0", "[0, 1e5, 0]", "3 numbers, each from -10_000 to 10_000"),
    ("wind.noise", "octaves", "1.5", "9", "a whole number from 1 to 8"),
    ("wind.noise", "spectrum_exponent", "\"5/3\"", "8.5", "from 0 to 8"),
    ("wind.noise", "absolute", "1", "\"yes\"", "true or false"),
    ("wind.curl", "strength", "[1]", "-1e5", "from -10_000 to 10_000"),
    ("wind.curl", "scale", "[1, 1]", "[1, 1, 1e5]", "3 numbers, each from 0 to 10_000"),
    ("wind.curl", "drift", "true", "[0, 0, nan]", "3 numbers, each from -10_000 to 10_000"),
    ("wind.curl", "octaves", "[2]", "0", "a whole number from 1 to 8"),
    ("wind.curl", "spectrum_exponent", "[2]", "-1", "from 0 to 8"),
    ("wind.curl", "absolute", "0", "\"no\"", "true or false"),
    ("planet", "center", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("planet", "radius", "[1]", "0", "from 0.001 to 1_000_000, world units"),
    ("planet", "color", "0.3", "[0, 0, 1.1]", "3 numbers, each from 0 to 1"),
    ("planet", "relief", "\"high\"", "-1", "from 0 to 10, slope"),
    ("planet", "contrast", "true", "1.5", "from 0 to 1, a share of the colour"),
    ("planet", "scale", "[1]", "-1", "from 0 to 10_000, noise cells a world unit"),
    ("planet", "octaves", "1.5", "9", "a whole number from 1 to 8"),
    ("ground", "position", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("ground", "normal", "1", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("ground", "radius", "[1]", "0", "from 0.001 to 1_000_000, world units"),
    ("ground", "color", "0.3", "[0, 0, 1.1]", "3 numbers, each from 0 to 1"),
    ("ground", "contrast", "true", "1.5", "from 0 to 1, a share of the colour"),
    ("ground", "scale", "[1]", "-1", "from 0 to 10_000, noise cells a world unit"),
    ("ground", "octaves", "1.5", "9", "a whole number from 1 to 8"),
    ("pillar", "position", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("pillar", "radius", "[1]", "0", "from 0.001 to 10_000, world units"),
    ("pillar", "height", "true", "0", "from 0.001 to 10_000, world units"),
    ("pillar", "color", "0.3", "[0, 0, 1.1]", "3 numbers, each from 0 to 1"),
    ("pillar", "translucence", "\"some\"", "-1", "from 0 to 100, a share of the light"),
    ("pillar", "depth", "[1]", "0", "from 0.001 to 10_000, world units"),
    ("surface", "mesh", "1", r#""two\nlines""#, "at most 1000 characters in one line"),
    ("surface", "position", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("surface", "rotation_degrees", "0", "[0, 1e9]", "2 numbers, each from -36_000"),
    ("surface", "scale", "[1]", "-1", "from 0 to 1000, world units"),
    ("surface", "color", "0.3", "[0, 0, 1.1]", "3 numbers, each from 0 to 1"),
    ("surface", "crease_degrees", "[1]", "181", "from 0 to 180, degrees"),
    ("lamp", "position", "1", "[0, 0, 2e6]", "3 numbers, each from -1_000_000"),
    ("lamp", "color", "1", "[0, 0, -1]", "3 numbers, each from 0 to 1_000_000"),
    ("lamp", "distance", "[1]", "0", "from 0.001 to 1_000_000, world units"),
    ("layer", "name", "1", "\"a b\"", "a letter or _, then letters, digits, - and _"),
    ("layer", "point", "0", "[0, 0, 1e7]", "3 numbers, each from -1_000_000"),
    ("layer", "normal", "1", "[0, 0, 0]", "3 numbers, each from -1_000_000"),
    ("generation_shape.sphere", "radius", "\"1\"", "-1", "from 0 to 1_000_000"),
    ("generation_shape.circle", "radius", "[1]", "inf", "from 0 to 1_000_000"),
    ("generation_shape.rectangle", "length", "true", "-1", "from 0 to 1_000_000"),
    ("generation_shape.rectangle", "width", "{}", "nan", "from 0 to 1_000_000"),
    ("generation_shape.ring", "inner_radius", "\"1\"", "-1", "from 0 to 1_000_000"),
    ("generation_shape.ring", "outer_radius", "[1]", "1e7", "from 0 to 1_000_000"),
    ("generation_shape.rings", "radius", "[1]", "0", "from 0.001 to 1_000_000"),
    ("generation_shape.rings", "wall_speed", "\"1\"", "0", "from 0.000001 to 10_000"),
    ("generation_shape.rings", "ring_frames", "1.5", "0", "a whole number from 1 to 65_000"),
    ("generation_shape.rings", "density", "[1]", "-1", "from 0 to 10_000"),
    ("generation_shape.box", "length", "[1]", "-1", "from 0 to 1_000_000"),
    ("generation_shape.box", "width", "true", "1e7", "from 0 to 1_000_000"),
    ("generation_shape.box", "height", "\"1\"", "nan", "from 0 to 1_000_000"),
    ("generation_shape.cone", "height", "true", "-1", "from 0 to 1_000_000"),
    ("generation_shape.cone", "angle_degrees", "[20]", "90", "from 0 to 89, degrees"),
    ("generation_shape.line", "length", "{}", "-1", "from 0 to 1_000_000"),
    ("generation_shape.attractor", "attractor", "1", "\"lorentz\"", "\"lorenz\", \"rossler\", \"halvorsen\""),
    ("generation_shape.attractor", "radius", "[1]", "-1", "from 0 to 1_000_000"),
    ("generation_shape.mesh", "mesh", "1", r#""two\nlines""#, "at most 1000 characters in one line"),
    ("generation_shape.mesh", "scale", "[1]", "-1", "from 0 to 1000"),
];

fn keys_of(section: &str, fields: &[Field], keys: &mut BTreeSet<(String, String)>) {
    for field in fields {
        match field.kind {
            Kind::Table(fields) | Kind::Tables { fields, .. } => keys_of(field.key, fields, keys),
            Kind::List { .. } => {}
            _ => drop(keys.insert((section.to_owned(), field.key.to_owned()))),
        }
        if let Kind::Variants(variants) | Kind::List { variants, .. } = field.kind {
            for variant in variants {
                let section = format!("{}.{}", field.key, variant.name);
                keys_of(&section, variant.fields, keys);
            }
        }
    }
}

/// The text has the key on its usual line; the error is at its value, names the key and says
/// what would be right.
fn check_refused(text: &str, (section, key): (&str, &str), path: &str, right: &str) {
    let error = refused(text);
    let line = line_of(section, key);
    let content = text.lines().nth(line - 1).unwrap_or_default();
    let column = error.column().expect("a place");
    let value = content.find(&format!("{} =", path.rsplit('.').next().unwrap_or(path)));
    let value = value.expect("the line has the key") + 1;
    let case = format!("\n{content}\n{error}\n");
    assert_eq!(error.line(), Some(line), "{case}");
    assert!(
        (value..=content.chars().count()).contains(&column),
        "{case}"
    );
    assert!(error.message().contains(path), "wants {path:?}: {case}");
    assert!(error.help().contains(right), "wants {right:?}: {case}");
    let shown = error.to_string();
    let place = format!("--> {FILE}:{line}:{column}\n");
    for part in ["error: `", &place, content, "^", "= help: "] {
        assert!(shown.contains(part), "wants {part:?}: {case}");
    }
}

#[test]
fn every_key_refuses_wrong_kinds_and_ranges_with_a_place() {
    let mut keys = BTreeSet::new();
    keys_of("", schema::SCENE, &mut keys);
    let tested = KEYS.iter().map(|row| (row.0.to_owned(), row.1.to_owned()));
    assert_eq!(
        keys,
        tested.collect(),
        "keys of the schema and of this test"
    );
    for &(section, key, wrong_kind, out_of_range, right) in KEYS {
        let text = with(section, key, wrong_kind);
        assert!(refused(&text).message().contains("cannot be "), "{text}");
        check_refused(&text, (section, key), key, right);
        check_refused(
            &with(section, key, out_of_range),
            (section, key),
            key,
            right,
        );
    }
}

#[test]
fn every_part_of_a_spread_refuses_wrong_kinds_and_ranges() {
    // Key, part, too much for it, and what would be right.
    #[rustfmt::skip]
    let parts = [
        ("speed", "mean", "-10_001", "from -10_000 to 10_000, world units a frame"),
        ("speed", "var", "-1", "from 0 to 10_000"),
        ("lifetime", "mean", "0.5", "from 1 to 65_000, frames"),
        ("lifetime", "var", "65_001", "from 0 to 65_000"),
        ("color", "mean", "[0, 1001, 0]", "3 numbers, each from 0 to 1000"),
        ("color", "var", "[0, 0, -0.1]", "3 numbers, each from 0 to 1000"),
        ("color", "rate", "[-1001, 0, 0]", "3 numbers, each from -1000 to 1000"),
        ("transparency", "mean", "-0.1", "from 0 to 1"),
        ("transparency", "var", "1.1", "from 0 to 1"),
        ("transparency", "rate", "-1.1", "from -1 to 1"),
        ("size", "mean", "0", "from 0.000001 to 10_000, world units"),
        ("size", "var", "-1", "from 0 to 10_000"),
        ("size", "rate", "1e5", "from -10_000 to 10_000"),
        ("color", "rate_var", "[0, -0.1, 0]", "3 numbers, each from 0 to 1000"),
        ("transparency", "rate_var", "1.1", "from 0 to 1"),
        ("size", "rate_var", "-1", "from 0 to 10_000"),
    ];
    for (key, part, outside, right) in parts {
        let path = format!("system.first.{key}.{part}");
        for value in ["\"text\"", "{ x = 1 }", outside] {
            let mean = match (part, key) {
                ("mean", _) => "",
                (_, "color") => "mean = [1, 1, 1], ",
                _ => "mean = 1, ",
            };
            let text = with("system", key, &format!("{{ {mean}{part} = {value} }}"));
            check_refused(&text, ("system", key), &path, right);
        }
    }
    let error = refused(&with("system", "speed", "{ mean = 1, rate = 1 }"));
    assert!(
        error
            .message()
            .contains("no key `rate` in `system.first.speed`"),
        "{error}"
    );
    let error = refused(&with("system", "speed", "{ var = 1 }"));
    assert!(
        error
            .message()
            .contains("`system.first.speed.mean` is missing"),
        "{error}"
    );
}

#[test]
fn tables_refuse_what_is_no_table() {
    let system = MINIMAL.find("[[system]]").expect("it is there");
    let cases = [
        (
            "image = 3\n".to_owned() + MINIMAL,
            "`image` must be a table",
            "width, height",
        ),
        (
            "camera = [1]\n".to_owned() + &MINIMAL[system..],
            "`camera` must be a table",
            "position, target",
        ),
        (
            "system = 1\n".to_owned() + &MINIMAL[..system],
            "`system` cannot be",
            "1 to 1024 tables",
        ),
        (
            "system = []\n".to_owned() + &MINIMAL[..system],
            "`system` cannot be",
            "1 to 1024 tables",
        ),
        (
            "system = [1]\n".to_owned() + &MINIMAL[..system],
            "`system.0` must be",
            "`motes schema --markdown`",
        ),
        (
            "[system]\n".to_owned() + &MINIMAL[..system],
            "`system` cannot be a table",
            "[[system]]",
        ),
    ];
    for (text, message, help) in cases {
        let error = refused(&text);
        assert!(error.message().contains(message), "{error}");
        assert!(error.help().contains(help), "{error}");
        assert!(error.line().is_some_and(|line| line <= 2), "{error}");
    }
    let many = |count| {
        let one = |i| MINIMAL[system..].replace("only", &format!("s{i}"));
        MINIMAL[..system].to_owned() + &(0..count).map(one).collect::<String>()
    };
    assert_eq!(
        parse(&many(1024), FILE, "s").map(|scene| scene.systems.len()),
        Ok(1024)
    );
    assert!(refused(&many(1025)).message().contains("an array of 1025"));
}
