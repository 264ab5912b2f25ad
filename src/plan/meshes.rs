//! Faces of meshes that particles are born on, and the table that a face is drawn by its area from.

use std::sync::Arc;

use glam::Vec3;

use super::PlanError;
use crate::exact::{length3, snap};
use crate::mesh::{MOST_TRIANGLES, Mesh};
use crate::scene::Scene;

/// Every face of every mesh of a run. Where there are none, one that is nobody's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshTables {
    /// Three a face: a corner, the edges from it to the next and to the last corner; in their w,
    /// the outward normal's x, y and z.
    pub faces: Vec<[f32; 4]>,
    /// One a face, by Walker's alias method (1977): a face drawn evenly stands if a random word is
    /// below the first number; else the face is the second.
    pub choices: Vec<[u32; 2]>,
    /// Digest, first face and number of faces of each mesh.
    stored: Vec<(u64, u32, u32)>,
    /// How far the farthest corner of each is from the origin.
    reaches: Vec<f32>,
}

impl MeshTables {
    /// The tables of all meshes in the scenes.
    pub(super) fn new(scenes: &[&Scene]) -> Result<Self, PlanError> {
        let mut tables = Self::default();
        for mesh in scenes.iter().flat_map(|scene| scene.meshes_of_roots()) {
            if tables.place_of(mesh).is_none() {
                tables.add(mesh)?;
            }
        }
        if tables.choices.is_empty() {
            tables.faces = vec![[0.0; 4]; 3];
            tables.choices = vec![[0; 2]];
        }
        Ok(tables)
    }

    /// The first face of a mesh and how many it has; `None` if it is not stored.
    pub(super) fn place_of(&self, mesh: &Mesh) -> Option<(u32, u32)> {
        let stored = self.stored.iter();
        let found = stored.clone().find(|(digest, ..)| *digest == mesh.digest());
        found.map(|(_, first, count)| (*first, *count))
    }

    /// How far its farthest corner is from the origin; 0 if it is not stored.
    pub(super) fn reach_of(&self, mesh: &Mesh) -> f32 {
        let at = self.stored.iter().position(|own| own.0 == mesh.digest());
        at.map_or(0.0, |at| self.reaches[at])
    }

    /// Whether all meshes of `other` are stored here, too.
    pub(super) fn cover(&self, other: &Self) -> bool {
        let is_here = |it: &(u64, u32, u32)| self.stored.iter().any(|own| own.0 == it.0);
        other.stored.iter().all(is_here)
    }

    fn add(&mut self, mesh: &Arc<Mesh>) -> Result<(), PlanError> {
        let first = self.choices.len();
        let count = mesh.triangles().len();
        if first + count > MOST_TRIANGLES {
            return Err(PlanError {
                message: format!("this scene is born on {} faces of meshes", first + count),
                help: format!("at most {MOST_TRIANGLES} in all"),
                key: None,
            });
        }
        let mut areas = Vec::with_capacity(count);
        let mut reach = 0.0f32;
        for face in 0..count {
            let normal = mesh.doubled_area(face);
            let [a, b, c] = mesh.corners(face);
            for corner in mesh.corners(face) {
                reach = reach.max(length3(Vec3::from(corner)));
            }
            let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
            areas.push(length);
            for (at, i) in [a, less(b, a), less(c, a)].into_iter().zip(0..) {
                let [x, y, z] = at;
                self.faces
                    .push([x, y, z, (normal[i] / length) as f32].map(snap));
            }
        }
        let of = |[below, other]: [u32; 2]| [below, other + first as u32];
        self.choices.extend(choices(&areas).into_iter().map(of));
        self.reaches.push(reach);
        self.stored
            .push((mesh.digest(), first as u32, count as u32));
        Ok(())
    }
}

fn less(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// The alias table of the weights, at least one of them and all above 0. Each weight becomes a
/// share of 2^32 for each of them; these are whole numbers, so that the table is the same on every
/// processor and sums to what it should.
fn choices(weights: &[f64]) -> Vec<[u32; 2]> {
    const WHOLE: u64 = 1 << 32;
    let sum: f64 = weights.iter().sum();
    let of_one = weights.len() as f64 * WHOLE as f64;
    let mut shares: Vec<u64> = weights
        .iter()
        .map(|weight| (weight / sum * of_one) as u64)
        .collect();
    // Rounding down leaves less than one for each, and sums may be off as little: whoever has
    // most makes up for it.
    let largest = (0..shares.len()).max_by_key(|at| shares[*at]).unwrap_or(0);
    let others: u64 = shares.iter().sum::<u64>() - shares[largest];
    shares[largest] = (weights.len() as u64 * WHOLE).saturating_sub(others);
    let (mut small, mut large): (Vec<usize>, Vec<usize>) =
        (0..shares.len()).partition(|at| shares[*at] < WHOLE);
    let mut table: Vec<[u32; 2]> = (0..shares.len() as u32).map(|at| [u32::MAX, at]).collect();
    while let Some(poor) = small.pop() {
        let Some(&rich) = large.last() else {
            break;
        };
        table[poor] = [shares[poor] as u32, rich as u32];
        shares[rich] -= WHOLE - shares[poor];
        if shares[rich] < WHOLE {
            large.pop();
            small.push(rich);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::choices;

    /// How often each comes up, of 2^32 draws for each of them.
    fn drawn(table: &[[u32; 2]]) -> Vec<u64> {
        let mut counts = vec![0; table.len()];
        for (at, [below, other]) in table.iter().enumerate() {
            counts[at] += u64::from(*below);
            counts[*other as usize] += (1 << 32) - u64::from(*below);
        }
        counts
    }

    #[test]
    fn an_alias_table_draws_by_weight() {
        let ramp: Vec<f64> = (1..=1000).map(f64::from).collect();
        let steep: Vec<f64> = (0..40).map(|at| 3f64.powi(-at)).collect();
        for weights in [vec![7.0], vec![1.0, 3.0], vec![2.5; 97], ramp, steep] {
            let sum: f64 = weights.iter().sum();
            let counts = drawn(&choices(&weights));
            let all = counts.len() as u64 * (1 << 32);
            assert_eq!(counts.iter().sum::<u64>(), all);
            for (weight, count) in weights.iter().zip(counts) {
                let expected = weight / sum * all as f64;
                let off = (count as f64 - expected).abs();
                assert!(off <= weights.len() as f64 + 1.0, "{count} for {expected}");
            }
        }
    }
}
