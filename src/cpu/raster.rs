//! Triangles in the picture: where their corners are, which samples they cover, and how near they
//! are. Twin of `wgsl/lib/raster.wgsl`, line by line; see there.

use glam::{IVec3, IVec4, Vec3, Vec4};

use crate::exact::{
    clamp_exact, cross3, dot3, f32_of_u32, less, max_exact, min_exact, normalize_exact, reciprocal,
    shared_constants, to_i32,
};
use crate::layout::{Frame, SurfaceFrame};

shared_constants! {
    /// Steps of a corner's place in a pixel.
    const SUBPIXELS: f32 = 256.0;
    /// Farther from the picture's middle, in pixels, is out of it.
    const GUARD_PX: f32 = 8192.0;
    /// No corner is farther from the picture's corner, in subpixels, rounded or not.
    const FARTHEST_SUBPIXEL: i32 = 4_000_000;
    /// Corners of a triangle that is clipped at five planes, at most.
    const MOST_CORNERS: u32 = 8;
    /// Sides of a block of pixels that is looked at at once.
    pub const BLOCK_PX: i32 = 8;
    /// A triangle that may touch more blocks is not left to one invocation of a device.
    pub const BLOCKS_FOR_ONE: u32 = 16;
    /// An edge that is so far to one side of a block is on that side of all of it.
    const ASIDE: i32 = 536_870_912;
    /// 2 / 65,535.
    const OCTAHEDRON_STEP: f32 = 0.000_030_518_044;
}

/// Where a pixel's samples are to the right of its left upper corner, pixels.
pub const SAMPLES_RIGHT: Vec4 = Vec4::new(0.375, 0.875, 0.125, 0.625);

/// Where they are below it.
pub const SAMPLES_DOWN: Vec4 = Vec4::new(0.125, 0.375, 0.625, 0.875);

/// Where a corner of a mesh is in view space.
pub fn corner_seen(frame: &Frame, surface: &SurfaceFrame, corner: Vec3) -> Vec3 {
    let world = world_of(surface, corner);
    let rows = [
        frame.view_from_world_x,
        frame.view_from_world_y,
        frame.view_from_world_z,
    ];
    rows_times(rows, world)
}

/// Where a corner of a mesh is in world space.
pub fn world_of(surface: &SurfaceFrame, corner: Vec3) -> Vec3 {
    let rows = [
        surface.world_from_mesh_x,
        surface.world_from_mesh_y,
        surface.world_from_mesh_z,
    ];
    rows_times(rows, corner)
}

fn rows_times(rows: [[f32; 4]; 3], p: Vec3) -> Vec3 {
    let [x, y, z] = rows.map(|row| row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]);
    Vec3::new(x, y, z)
}

/// How near a triangle is at a place of the picture, from its middle in pixels: a linear function,
/// within what its corners have.
#[derive(Clone, Copy, Debug)]
pub struct Nearness {
    right: f32,
    up: f32,
    middle: f32,
    least: f32,
    most: f32,
}

impl Nearness {
    /// That of a triangle in view space.
    pub fn new(frame: &Frame, [a, b, c]: [Vec3; 3]) -> Self {
        let normal = normalize_exact(cross3(normalize_exact(b - a), normalize_exact(c - a)));
        let inverse = reciprocal(dot3(normal, a));
        let a_pixel = inverse * reciprocal(frame.focal_px);
        let [of_a, of_b, of_c] = [a, b, c].map(|p| reciprocal(max_exact(p.z, frame.near)));
        Self {
            right: normal.x * a_pixel,
            up: normal.y * a_pixel,
            middle: normal.z * inverse,
            least: min_exact(min_exact(of_a, of_b), of_c),
            most: max_exact(max_exact(of_a, of_b), of_c),
        }
    }

    /// How near it is so many pixels to the right of the picture's middle and above it.
    pub fn at(&self, right: f32, up: f32) -> f32 {
        let linear = self.right * right + self.up * up + self.middle;
        clamp_exact(linear, self.least, self.most)
    }
}

/// How far inside one of the planes a place is that all is clipped at: below 0 is outside.
fn inside_by(frame: &Frame, p: Vec3, side: u32) -> f32 {
    if side == 0 {
        return p.z - frame.near;
    }
    let aside = if side > 2 { p.y } else { p.x } * frame.focal_px;
    GUARD_PX * p.z
        + if side.is_multiple_of(2) {
            -aside
        } else {
            aside
        }
}

/// One bit a plane that a place is outside of.
fn sides_of(frame: &Frame, p: Vec3) -> u32 {
    let is_out = |side: &u32| less(inside_by(frame, p, *side), 0.0);
    (0..5).filter(is_out).map(|side| 1 << side).sum()
}

/// Corners of what is left of a triangle, in subpixels; the whole pixels that it may touch, first and
/// one past the last; none if there are fewer than three corners.
#[derive(Clone, Debug, Default)]
pub struct Polygon {
    corners: Vec<[i32; 2]>,
    /// First pixel across and down.
    pub first: [i32; 2],
    /// One past the last.
    pub end: [i32; 2],
}

fn subpixel(px: f32) -> i32 {
    to_i32(px * SUBPIXELS + 0.5).clamp(-FARTHEST_SUBPIXEL, FARTHEST_SUBPIXEL)
}

/// The places on that side of the plane, and where edges go through it.
fn clipped(frame: &Frame, places: &[Vec3], side: u32) -> Vec<Vec3> {
    let mut kept = Vec::with_capacity(MOST_CORNERS as usize);
    for (at, &here) in places.iter().enumerate() {
        let next = places[if at + 1 == places.len() { 0 } else { at + 1 }];
        let by_here = inside_by(frame, here, side);
        let by_next = inside_by(frame, next, side);
        let is_out = less(by_here, 0.0);
        if !is_out {
            kept.push(here);
        }
        if is_out != less(by_next, 0.0) {
            // From the end that is inside, whichever triangle's edge it is.
            let (inner, outer, by_inner, by_outer) = if is_out {
                (next, here, by_next, by_here)
            } else {
                (here, next, by_here, by_next)
            };
            let part = by_inner * reciprocal(by_inner - by_outer);
            kept.push(inner + (outer - inner) * part);
        }
    }
    kept.truncate(MOST_CORNERS as usize);
    kept
}

impl Polygon {
    /// What is left of a triangle in view space.
    pub fn new(frame: &Frame, corners: [Vec3; 3]) -> Self {
        let [of_a, of_b, of_c] = corners.map(|p| sides_of(frame, p));
        if of_a & of_b & of_c != 0 {
            return Self::default();
        }
        let sides = of_a | of_b | of_c;
        let mut places = corners.to_vec();
        for side in (0..5).filter(|side| sides >> side & 1 == 1) {
            places = clipped(frame, &places, side);
        }
        let seen = |place: &Vec3| {
            let scale = frame.focal_px * reciprocal(max_exact(place.z, frame.near));
            [
                subpixel(frame.center_x_px + place.x * scale),
                subpixel(frame.center_y_px - place.y * scale),
            ]
        };
        let corners: Vec<[i32; 2]> = places.iter().map(seen).collect();
        let low = |axis: usize| corners.iter().map(|corner| corner[axis]).min();
        let high = |axis: usize| corners.iter().map(|corner| corner[axis]).max();
        let size = [frame.width as i32, frame.height as i32];
        Self {
            first: [0, 1].map(|axis| (low(axis).unwrap_or(0) >> 8).max(0)),
            end: [0, 1].map(|axis| ((high(axis).unwrap_or(-256) >> 8) + 1).min(size[axis])),
            corners,
        }
    }

    /// Blocks of pixels that it may touch, across and down.
    pub fn blocks(&self) -> [i32; 2] {
        let blocks = [0, 1].map(|axis| {
            let size = (self.end[axis] - self.first[axis]).max(0);
            (size + BLOCK_PX - 1) / BLOCK_PX
        });
        if self.corners.len() < 3 || blocks.contains(&0) {
            [0, 0]
        } else {
            blocks
        }
    }

    /// The triangle `at` that it is made of, from 0, in subpixels, its inside to the right of its edges.
    pub fn triangle(&self, at: usize) -> [[i32; 2]; 3] {
        let a = self.corners[0];
        let (b, c) = (self.corners[at + 1], self.corners[at + 2]);
        let is_back = wide(b[0] - a[0], c[1] - a[1], b[1] - a[1], c[0] - a[0], 0) < 0;
        if is_back { [a, c, b] } else { [a, b, c] }
    }

    /// How many triangles it is made of.
    pub fn triangles(&self) -> usize {
        self.corners.len().saturating_sub(2)
    }
}

/// (a b - c d - bias) / 64, rounded down and clamped to 2^29, for factors below 2^23.
pub fn wide(a: i32, b: i32, c: i32, d: i32, bias: i32) -> i32 {
    let [a, b, c, d, bias] = [a, b, c, d, bias].map(i64::from);
    let whole = (a * b - c * d - bias).div_euclid(64);
    let aside = i64::from(ASIDE);
    whole.clamp(-aside, aside) as i32
}

/// Three edges as they are at the first sample of a pixel: at least 0 inside; and how they change
/// for a quarter of a pixel to the right and down.
#[derive(Clone, Copy, Debug)]
pub struct Edges {
    start: IVec3,
    right: IVec3,
    down: IVec3,
}

fn edge_at([x, y]: [i32; 2], [from_x, from_y]: [i32; 2], [to_x, to_y]: [i32; 2]) -> i32 {
    let (dx, dy) = (to_x - from_x, to_y - from_y);
    let is_top_left = dy < 0 || (dy == 0 && dx > 0);
    wide(dx, y - from_y, dy, x - from_x, i32::from(!is_top_left))
}

impl Edges {
    /// Those of a triangle in subpixels at a pixel's first sample.
    pub fn new([a, b, c]: [[i32; 2]; 3], pixel: [i32; 2]) -> Self {
        let place = pixel.map(|at| at * 256 + 32);
        Self {
            start: IVec3::new(
                edge_at(place, a, b),
                edge_at(place, b, c),
                edge_at(place, c, a),
            ),
            right: IVec3::new(a[1] - b[1], b[1] - c[1], c[1] - a[1]),
            down: IVec3::new(b[0] - a[0], c[0] - b[0], a[0] - c[0]),
        }
    }

    /// Whether no sample of so many pixels to the right and down can be inside.
    pub fn misses(&self, size: [i32; 2]) -> bool {
        let [across, down] = size.map(|size| size * 4 - 1);
        let most = self.start + self.right.max(IVec3::ZERO) * across;
        let most = most + self.down.max(IVec3::ZERO) * down;
        most.min_element() < 0
    }

    /// Which of the four samples of a pixel, so many to the right and down, are inside.
    pub fn samples_in(&self, right: i32, down: i32) -> [bool; 4] {
        let here = self.start + self.right * (4 * right) + self.down * (4 * down);
        let rights = IVec4::new(1, 3, 0, 2);
        let downs = IVec4::new(0, 1, 2, 3);
        let of = |start: i32, right: i32, down: i32| start + rights * right + downs * down;
        let a = of(here.x, self.right.x, self.down.x);
        let b = of(here.y, self.right.y, self.down.y);
        let c = of(here.z, self.right.z, self.down.z);
        a.min(b).min(c).to_array().map(|least| least >= 0)
    }
}

/// A unit vector from its word.
pub fn normal_of(word: u32) -> Vec3 {
    let x = f32_of_u32(word & 0xffff) * OCTAHEDRON_STEP - 1.0;
    let y = f32_of_u32(word >> 16) * OCTAHEDRON_STEP - 1.0;
    let z = 1.0 - x.abs() - y.abs();
    let folded = |own: f32, other: f32| {
        if less(own, 0.0) {
            other.abs() - 1.0
        } else {
            1.0 - other.abs()
        }
    };
    normalize_exact(if less(z, 0.0) {
        Vec3::new(folded(x, y), folded(y, x), z)
    } else {
        Vec3::new(x, y, z)
    })
}
