//! Places on a surface: how far away they are, and some that are far from each other.

use super::Surface;
use super::vectors::{Place, length, less, plus};

/// Faces that are looked at for places, at most: of more, some.
const MOST_FACES: usize = 4096;

impl Surface {
    /// Centre and radius of a ball around these faces: that of the box around them.
    pub fn ball_around(&self, faces: std::ops::Range<u32>) -> [f64; 4] {
        let faces = &self.faces[faces.start as usize..faces.end as usize];
        let corners = faces.iter().flat_map(|face| {
            let of_face = |at: [f64; 2]| plus(plus(face.origin, face.x, at[0]), face.y, at[1]);
            face.corners.map(of_face)
        });
        let corners: Vec<Place> = corners.collect();
        let end = |of: fn(f64, f64) -> f64, from: f64| {
            [0, 1, 2].map(|axis| corners.iter().map(|at| at[axis]).fold(from, of))
        };
        let (low, high) = (end(f64::min, f64::MAX), end(f64::max, f64::MIN));
        let middle = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        let away = corners.iter().map(|corner| length(less(*corner, middle)));
        let [x, y, z] = middle;
        [x, y, z, away.fold(0.0, f64::max)]
    }

    /// The area of all faces.
    pub fn area(&self) -> f64 {
        let of_face = |[a, b, c]: [[f64; 2]; 3]| {
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        self.faces.iter().map(|face| of_face(face.corners)).sum()
    }

    /// How far its farthest corner is from the origin.
    pub fn extent(&self) -> f64 {
        let corners = self.faces.iter().flat_map(|face| {
            let of_face = |at: [f64; 2]| plus(plus(face.origin, face.x, at[0]), face.y, at[1]);
            face.corners.map(of_face)
        });
        corners.map(length).fold(0.0, f64::max)
    }

    /// So many places far from each other, or fewer where it has no more: each is as far as may be from
    /// all before it (Gonzalez 1985), of corners, middles of edges and of faces.
    pub fn spaced_places(&self, count: usize) -> Vec<Place> {
        let stride = self.faces.len().div_ceil(MOST_FACES).max(1);
        let shares = [
            [1.0, 0.0, 0.0],
            [0.5, 0.5, 0.0],
            [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.5, 0.5],
            [0.0, 0.0, 1.0],
            [0.5, 0.0, 0.5],
        ];
        let places = self.faces.iter().step_by(stride).flat_map(|face| {
            shares.map(|[a, b, c]| {
                let [p, q, r] = face.corners;
                let at = [0, 1].map(|i| a * p[i] + b * q[i] + c * r[i]);
                plus(plus(face.origin, face.x, at[0]), face.y, at[1])
            })
        });
        let places: Vec<Place> = places.collect();
        let share = 1.0 / places.len().max(1) as f64;
        let middle = places
            .iter()
            .fold([0.0; 3], |sum, place| plus(sum, *place, share));
        // The first is the nearest to the middle of all.
        let mut away = vec![f64::MAX; places.len()];
        let nearest = |a: &Place| length(less(*a, middle));
        let mut next = places
            .iter()
            .copied()
            .min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
        let mut found = Vec::new();
        while let Some(place) = next.filter(|_| found.len() < count) {
            found.push(place);
            let mut farthest = (0.0, None);
            for (at, other) in away.iter_mut().zip(&places) {
                *at = at.min(length(less(*other, place)));
                // Rounding does not make a place of one that is known.
                if *at > farthest.0 * (1.0 + 1e-9) + 1e-9 {
                    farthest = (*at, Some(*other));
                }
            }
            next = farthest.1;
        }
        found
    }
}
