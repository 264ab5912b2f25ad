//! Particles as point lights: what one sends out, the cells that lights stand for, and what a light
//! throws on a surface (Reeves 1983, section 3). Twin of `wgsl/lib/cluster.wgsl`.

use glam::{UVec3, Vec3};

use crate::cpu::particle::{Appearance, Identity, STREAM_CLUSTER, draw};
use crate::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, max_exact, min_exact, reciprocal,
    shared_constants, square_root, to_u32,
};
use crate::layout::{
    CLUSTERS_ACROSS, FlameLight, PARTICLE_RECTANGLE, PARTICLE_STROKE, STREAK_CONSTANT, SystemRow,
};
use crate::rng::unit_float;

shared_constants! {
    /// The cube is at least so wide.
    pub const LEAST_SPAN: f32 = 0.001;
    /// No particle sends out more.
    pub const MOST_SENT: f32 = 1_099_511_627_776.0;
    /// 4 / pi: the area of a square beside that of a disc.
    pub const OF_A_SQUARE: f32 = 1.273_239_5;
    /// The square of how much wider a light is than what it stands for.
    pub const WIDENING: f32 = 0.75;
    /// How many times its height over a surface a light may be lifted, squared.
    pub const MOST_LIFT: f32 = 16.0;
}

/// The cube: its least corner, its width, the inverse of a cell's width; what the brightest particle
/// sends out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub(crate) corner: Vec3,
    pub(crate) width: f32,
    pub(crate) scale: f32,
    pub(crate) most: f32,
}

/// The factor of what particles of the row throw on surfaces.
fn factor_of(row: &SystemRow) -> f32 {
    if row.kinds[1] == PARTICLE_STROKE {
        return 0.0;
    }
    f32::from_bits(row.kinds[2] & !STREAK_CONSTANT)
}

/// What a particle makes of white a unit away: pi falls out, as it is a disc and white sends light
/// everywhere.
pub(crate) fn sent_by(look: Appearance, row: &SystemRow) -> Vec3 {
    let of_shape = if row.kinds[1] == PARTICLE_RECTANGLE {
        OF_A_SQUARE
    } else {
        1.0
    };
    let area = look.size * look.size * of_shape;
    let share = factor_of(row) * area * (1.0 - look.transparency);
    let sent = look.color * share;
    Vec3::from(sent.to_array().map(|part| min_exact(part, MOST_SENT)))
}

pub(crate) fn brightest(sent: Vec3) -> f32 {
    max_exact(sent.x, max_exact(sent.y, sent.z))
}

/// Words whose order is that of floats, which are snapped.
pub(crate) fn ordered(bits: u32) -> u32 {
    if bits >> 31 != 0 {
        !bits
    } else {
        bits | 0x8000_0000
    }
}

fn float_of(word: u32) -> f32 {
    f32::from_bits(if word >> 31 != 0 {
        word & 0x7fff_ffff
    } else {
        !word
    })
}

/// From the greatest of x, y and z, of their complements, and of what is sent.
pub(crate) fn span_of([x, y, z, low_x, low_y, low_z, most, _]: [u32; 8]) -> Span {
    let place = |words: [u32; 3]| Vec3::from(words.map(float_of));
    let corner = place([low_x, low_y, low_z].map(|word| !word));
    let extent = place([x, y, z]) - corner;
    let width = max_exact(
        max_exact(extent.x, max_exact(extent.y, extent.z)),
        LEAST_SPAN,
    );
    let cells = f32_of_u32(CLUSTERS_ACROSS - 1);
    Span {
        corner,
        width: width * reciprocal(cells),
        scale: reciprocal(width) * cells,
        most: f32::from_bits(most),
    }
}

/// Which corner a coordinate in cells goes to.
fn corner_of(at: f32, word: u32) -> u32 {
    to_u32(at + unit_float(word)).min(CLUSTERS_ACROSS - 1)
}

pub(crate) fn corner_for(who: Identity, at: Vec3) -> UVec3 {
    let chance = draw(who, STREAM_CLUSTER);
    UVec3::new(
        corner_of(at.x, chance.x),
        corner_of(at.y, chance.y),
        corner_of(at.z, chance.z),
    )
}

/// The way to a light that is lifted over a surface as far as it is wide; near the surface, less. What
/// is below it throws nothing on it.
pub(crate) fn way_to(light: &FlameLight, place: Vec3, up: Vec3) -> Vec3 {
    let [x, y, z, spread] = light.place.map(f32::from_bits);
    let away = Vec3::new(x, y, z) - place;
    let height = at_least_zero(dot3(up, away));
    let high = height * height;
    let lifted = square_root(high + min_exact(spread, MOST_LIFT * high));
    away + up * (lifted - height)
}

/// How much of what a light at the end of that way sends out falls on a surface of that normal.
pub(crate) fn fallen(way: Vec3, normal: Vec3) -> f32 {
    let near = inverse_square_root(dot3(way, way));
    at_least_zero(dot3(normal, way) * near) * near * near
}

/// The point lights that there are: the first record tells how many.
pub(crate) fn lights_of(records: &[FlameLight]) -> &[FlameLight] {
    match records {
        [first, rest @ ..] => &rest[..first.place[0] as usize],
        [] => &[],
    }
}
