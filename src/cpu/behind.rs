//! What covers, and surfaces: a pixel on the way from near to far, some samples of which end on one.
//! Twin of `wgsl/lib/behind.wgsl`, line by line; see there.

use glam::Vec3;

use super::cover::{Layered, Spot, part_at};
use super::veil::open_samples;
use crate::exact::{bits_of, f32_of_u32, less, reciprocal, snap, snap3};
use crate::layout::Cover;

/// A pixel: its open part as if there were no other, and how much shows through of what its surface
/// sends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    /// The open part; its colour is that of both.
    pub open: Layered,
    /// 0 to 1.
    pub front: f32,
}

/// Samples of a pixel that end on a surface.
#[inline]
fn ended_samples(nearness: [u32; 4]) -> u32 {
    4 - open_samples(nearness, 1)
}

impl Parted {
    /// Nothing yet.
    pub const EMPTY: Self = Self {
        open: Layered::EMPTY,
        front: 1.0,
    };

    /// Whether nothing that comes behind is seen.
    #[inline]
    pub fn is_closed(&self, nearness: [u32; 4]) -> bool {
        let ended = ended_samples(nearness);
        (ended == 4 || self.open.is_closed())
            && (ended == 0 || less(self.front, super::cover::HIDDEN))
    }

    /// The pixel with `cover` behind what it has so far.
    #[inline]
    #[must_use]
    pub fn behind(self, cover: &Cover, light_from: Vec3, spot: Spot, nearness: [u32; 4]) -> Self {
        let ended = ended_samples(nearness);
        let part = part_at(cover, light_from, spot);
        let nearer = bits_of(reciprocal(f32::from_bits(cover.shape[3])));
        let before = open_samples(nearness, nearer) - (4 - ended);
        if self.is_closed(nearness) {
            return self;
        }
        let open_part = f32_of_u32(4 - ended) * 0.25;
        let front_part = f32_of_u32(before) * 0.25;
        let shows = self.open.clear * open_part + self.front * front_part;
        let seen = shows * part.alpha;
        let [red, green, blue, _] = cover.color.map(f32::from_bits);
        let [lit_red, lit_green, lit_blue, _] = cover.lit.map(f32::from_bits);
        let lit = Vec3::new(lit_red, lit_green, lit_blue);
        let look = Vec3::new(red, green, blue) + lit * part.light;
        let clear = self.open.clear * (1.0 - part.alpha);
        let of_ended = f32_of_u32(before) * reciprocal(f32_of_u32(ended));
        let front = self.front * (1.0 - part.alpha * of_ended);
        Self {
            open: Layered {
                color: snap3(self.open.color + look * seen),
                clear: snap(clear),
            },
            front: snap(front),
        }
    }
}
