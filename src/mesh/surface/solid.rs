//! What of a surface tells inside from outside (Baerentzen and Aanaes 2005): normals of faces, edges and
//! corners that point outward wherever the nearest place is.

use super::vectors::{Place, cross, dot, plus};
use super::{NO_EDGE, Surface, before};

impl Surface {
    /// Whether it encloses something: it has no border.
    pub fn is_closed(&self) -> bool {
        self.half_edges.iter().all(|half| half.twin != NO_EDGE)
    }

    /// Of each face of a closed surface seven outward normals, not all of length 1: its own, those of
    /// its edges from the first corner on, the sums of both faces', and those of its corners, the sums of
    /// all faces' by their angles.
    pub fn outward_normals(&self) -> impl Iterator<Item = [[f64; 3]; 7]> + '_ {
        let outward = if self.volume() < 0.0 { -1.0 } else { 1.0 };
        (0..self.faces.len() as u32).map(move |face| {
            let own = self.faces[face as usize].normal;
            let half = |side: u32| 3 * face + side;
            let edge = |side: u32| {
                let twin = self.half_edges[half(side) as usize].twin;
                plus(own, self.faces[twin as usize / 3].normal, 1.0)
            };
            [
                own,
                edge(0),
                edge(1),
                edge(2),
                self.corner_normal(half(0)),
                self.corner_normal(half(1)),
                self.corner_normal(half(2)),
            ]
            .map(|normal| normal.map(|x| x * outward))
        })
    }

    /// Of the half-edge's first corner.
    fn corner_normal(&self, first: u32) -> Place {
        let (mut half, mut sum) = (first, [0.0; 3]);
        loop {
            let normal = self.faces[half as usize / 3].normal;
            sum = plus(sum, normal, self.corner_angle(half));
            half = self.half_edges[before(half) as usize].twin;
            if half == first || half == NO_EDGE {
                return sum;
            }
        }
    }

    /// What it encloses, below 0 if its faces face inward.
    fn volume(&self) -> f64 {
        let of = |face: &super::SurfaceFace| {
            let [a, b, c] = face.corners.map(|[x, y]| {
                let along = plus(face.origin, face.x, x);
                plus(along, face.y, y)
            });
            dot(a, cross(b, c)) / 6.0
        };
        self.faces.iter().map(of).sum()
    }
}
