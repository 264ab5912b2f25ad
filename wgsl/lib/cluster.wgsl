// Particles as point lights: what one sends out, the cells that lights stand for, and what a light throws on
// a surface.
//
// Reeves 1983, section 3, names light of particles on surfaces as missing. Particles are gathered in the
// cells of a cube around all that throw light; each goes to one of the eight corners around it, by chance,
// the nearer the likelier, so that lights change smoothly while particles move. A light is as wide as what it
// stands for is spread: over a flat surface it stands so much higher, which takes nothing from what that gets.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/cluster.rs.
#define_import_path motes::cluster

#import motes::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, max_exact, min_exact, reciprocal,
    square_root, to_u32,
}
#import motes::layout::{CLUSTERS_ACROSS, FlameLight, PARTICLE_RECTANGLE, PARTICLE_STROKE, STREAK_CONSTANT, SystemRow}
#import motes::particle::{Appearance, Identity, STREAM_CLUSTER, draw}
#import motes::rng::unit_float

// The cube is at least so wide.
const LEAST_SPAN: f32 = 0.001f;
// No particle sends out more.
const MOST_SENT: f32 = 1099511627776.0f;
// 4 / pi: the area of a square beside that of a disc.
const OF_A_SQUARE: f32 = 1.2732395f;
// The square of how much wider a light is than what it stands for.
const WIDENING: f32 = 0.75f;
// How many times its height over a surface a light may be lifted, squared.
const MOST_LIFT: f32 = 16.0f;

// The cube: its least corner, its width, the inverse of a cell's width; what the brightest particle sends out.
struct Span {
    corner: vec3<f32>,
    width: f32,
    scale: f32,
    most: f32,
}

// The factor of what particles of the row throw on surfaces.
fn factor_of(row: SystemRow) -> f32 {
    return select(bitcast<f32>(row.kinds.z & ~STREAK_CONSTANT), 0.0f, row.kinds.y == PARTICLE_STROKE);
}

// What a particle makes of white a unit away: pi falls out, as it is a disc and white sends light everywhere.
fn sent_by(look: Appearance, row: SystemRow) -> vec3<f32> {
    let area = look.size * look.size * select(1.0f, OF_A_SQUARE, row.kinds.y == PARTICLE_RECTANGLE);
    let share = factor_of(row) * area * (1.0f - look.transparency);
    return vec3<f32>(
        min_exact(look.color.x * share, MOST_SENT),
        min_exact(look.color.y * share, MOST_SENT),
        min_exact(look.color.z * share, MOST_SENT),
    );
}

fn brightest(sent: vec3<f32>) -> f32 {
    return max_exact(sent.x, max_exact(sent.y, sent.z));
}

// Words whose order is that of floats, which are snapped.
fn ordered(bits: u32) -> u32 {
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn float_of(word: u32) -> f32 {
    return bitcast<f32>(select(~word, word & 0x7fffffffu, (word & 0x80000000u) != 0u));
}

// From the greatest of x, y and z, of their complements, and of what is sent.
fn span_of(high: vec3<u32>, low: vec3<u32>, most: u32) -> Span {
    let corner = vec3<f32>(float_of(~low.x), float_of(~low.y), float_of(~low.z));
    let extent = vec3<f32>(float_of(high.x), float_of(high.y), float_of(high.z)) - corner;
    let width = max_exact(max_exact(extent.x, max_exact(extent.y, extent.z)), LEAST_SPAN);
    let cells = f32_of_u32(CLUSTERS_ACROSS - 1u);
    return Span(corner, width * reciprocal(cells), reciprocal(width) * cells, bitcast<f32>(most));
}

// Which corner a coordinate in cells goes to.
fn corner_of(at: f32, word: u32) -> u32 {
    return min(to_u32(at + unit_float(word)), CLUSTERS_ACROSS - 1u);
}

fn corner_for(who: Identity, at: vec3<f32>) -> vec3<u32> {
    let chance = draw(who, STREAM_CLUSTER);
    return vec3<u32>(corner_of(at.x, chance.x), corner_of(at.y, chance.y), corner_of(at.z, chance.z));
}

// The way to a light that is lifted over a surface as far as it is wide; near the surface, less. What is
// below it throws nothing on it.
fn way_to(light: FlameLight, place: vec3<f32>, up: vec3<f32>) -> vec3<f32> {
    let source = bitcast<vec4<f32>>(light.place);
    let away = source.xyz - place;
    let height = at_least_zero(dot3(up, away));
    let high = height * height;
    let lifted = square_root(high + min_exact(source.w, MOST_LIFT * high));
    return away + up * (lifted - height);
}

// How much of what a light at the end of that way sends out falls on a surface of that normal.
fn fallen(way: vec3<f32>, normal: vec3<f32>) -> f32 {
    let near = inverse_square_root(dot3(way, way));
    return at_least_zero(dot3(normal, way) * near) * near * near;
}
