//! Edges that can be seen: those of polygons, which triangles in one plane make together.

use super::vectors::{Place, between, cross, dot, length, less, plus, unit};
use super::{FLAT, NO_EDGE, Surface, after};

/// An edge of a flat polygon, as seen from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// Where it begins, the polygon to its left.
    pub from: [f64; 3],
    /// Where it ends.
    pub to: [f64; 3],
    /// The angle between the normals of the polygons that it parts, above 0 where the surface is
    /// convex; 0 at a border.
    pub dihedral: f64,
    /// Whether nothing is beyond it.
    pub is_border: bool,
}

/// A feature near a face, in the face's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureNear {
    /// Where it begins.
    pub from: [f64; 2],
    /// From there to its end.
    pub along: [f64; 2],
    /// As [`Feature::dihedral`].
    pub dihedral: f64,
}

/// How far edges may bend, as a share of their length, and still be one.
const STRAIGHT: f64 = 1e-4;

/// How far their angles may differ, radians.
const ALIKE: f64 = 1e-3;

/// No feature.
const NONE: u32 = u32::MAX;

impl Surface {
    /// Edges of the face's polygon that are no border and within `reach` of the face.
    pub fn features_near(&self, face: u32, reach: f64) -> Vec<FeatureNear> {
        let frame = &self.faces()[face as usize];
        let own: Vec<[Place; 2]> = (0..3).map(|side| self.ends(3 * face + side)).collect();
        let middle = own
            .iter()
            .fold([0.0; 3], |sum, [from, _]| plus(sum, *from, 1.0 / 3.0));
        let corners = own.iter().map(|[from, _]| length(less(*from, middle)));
        let ball = corners.fold(0.0, f64::max);
        let is_near = |piece: [Place; 2]| {
            // Far from the ball around the face: most are, and this is told quicker.
            let [from, to] = piece;
            let half = length(less(to, from)) / 2.0;
            let away = length(less(plus(from, less(to, from), 0.5), middle));
            if away - half - ball > reach * 1.001 {
                return false;
            }
            own.iter().any(|side| between(*side, piece) < reach)
        };
        let mut found: Vec<u32> = Vec::new();
        let mut faces = vec![face];
        let mut at = 0;
        while let Some(here) = faces.get(at).copied() {
            at += 1;
            for half in 3 * here..3 * here + 3 {
                let feature = self.feature_of[half as usize];
                let near = is_near(self.ends(half));
                if here != face && !near {
                    continue;
                }
                if feature == NONE {
                    let beyond = self.half_edges()[half as usize].twin / 3;
                    if !faces.contains(&beyond) {
                        faces.push(beyond);
                    }
                } else if !found.contains(&feature)
                    && !self.features()[feature as usize].is_border
                    && near
                {
                    found.push(feature);
                }
            }
        }
        // In the order of the polygon, however it is cut.
        found.sort_unstable();
        let flat = |place: Place| {
            let from = less(place, frame.origin);
            [dot(from, frame.x), dot(from, frame.y)]
        };
        let near = |at: u32| {
            let feature = &self.features()[at as usize];
            let (from, to) = (flat(feature.from), flat(feature.to));
            FeatureNear {
                from,
                along: [to[0] - from[0], to[1] - from[1]],
                dihedral: feature.dihedral,
            }
        };
        found.into_iter().map(near).collect()
    }

    /// Where a half-edge begins and ends.
    pub(super) fn ends(&self, half: u32) -> [Place; 2] {
        let face = &self.faces()[half as usize / 3];
        [half, after(half)].map(|half| {
            let [x, y] = face.corners[half as usize % 3];
            plus(plus(face.origin, face.x, x), face.y, y)
        })
    }

    /// Whether what is on both sides of a half-edge is not one plane.
    fn parts(&self, half: u32) -> bool {
        let half = &self.half_edges()[half as usize];
        half.twin == NO_EDGE || half.dihedral.abs() > FLAT
    }

    /// The next half-edge around the same polygon.
    fn next_around(&self, half: u32) -> u32 {
        let mut next = after(half);
        while !self.parts(next) {
            next = after(self.half_edges()[next as usize].twin);
        }
        next
    }

    /// Whether the half-edge goes on in the line that begins with `first`.
    fn goes_on(&self, first: u32, half: u32) -> bool {
        let [a, b] = self.ends(first);
        let [_, end] = self.ends(half);
        let way = unit(less(b, a));
        let whole = less(end, a);
        let (one, other) = (
            &self.half_edges()[first as usize],
            &self.half_edges()[half as usize],
        );
        (one.twin == NO_EDGE) == (other.twin == NO_EDGE)
            && (one.dihedral - other.dihedral).abs() < ALIKE
            && dot(way, whole) > length(less(b, a))
            && length(cross(way, whole)) < STRAIGHT * length(whole)
    }

    pub(super) fn find_features(&mut self) {
        let count = self.half_edges().len() as u32;
        let mut feature_of = vec![NONE; count as usize];
        let mut features = Vec::new();
        for half in (0..count).filter(|half| self.parts(*half)) {
            if feature_of[half as usize] != NONE {
                continue;
            }
            let mut around = vec![half];
            loop {
                let next = self.next_around(around[around.len() - 1]);
                if next == half {
                    break;
                }
                around.push(next);
            }
            // Begin at a corner, so that no line is cut.
            let turns = |at: &usize| {
                !self.goes_on(around[(at + around.len() - 1) % around.len()], around[*at])
            };
            let begin = (0..around.len()).find(turns).unwrap_or(0);
            around.rotate_left(begin);
            let mut first = around[0];
            for (at, half) in around.iter().copied().enumerate() {
                let [from, to] = self.ends(half);
                if at == 0 || !self.goes_on(first, half) {
                    first = half;
                    let own = &self.half_edges()[half as usize];
                    features.push(Feature {
                        from,
                        to,
                        dihedral: own.dihedral,
                        is_border: own.twin == NO_EDGE,
                    });
                } else if let Some(last) = features.last_mut() {
                    last.to = to;
                }
                feature_of[half as usize] = features.len() as u32 - 1;
            }
        }
        let (mut sum, mut weight) = (0.0, 0.0);
        for feature in &features {
            // All but borders are there from both sides.
            let share = if feature.is_border { 1.0 } else { 0.5 };
            sum += share * length(less(feature.to, feature.from));
            weight += share;
        }
        self.mean_edge_length = sum / weight;
        self.features = features;
        self.feature_of = feature_of;
    }
}
