//! Faces of the meshes that boids stay out of or inside of.

use crate::exact::snap;
use crate::layout::ROWS_A_SOLID_FACE;
use crate::mesh::{Mesh, Surface};
use crate::scene::{ObstacleShape, Scene};

/// Every face of every mesh that is an obstacle in a run. Where there are none, one that is nobody's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolidTables {
    /// [`ROWS_A_SOLID_FACE`] a face; w unused.
    pub rows: Vec<[f32; 4]>,
    /// Digest, first face and number of faces of each mesh.
    stored: Vec<(u64, u32, u32)>,
}

impl SolidTables {
    /// The tables of all obstacles in the scenes.
    pub(super) fn new(scenes: &[&Scene]) -> Self {
        let mut tables = Self::default();
        let flocks = scenes.iter().flat_map(|scene| &scene.flocks);
        for obstacle in flocks.flat_map(|flock| &flock.obstacles) {
            if let ObstacleShape::Mesh { mesh, surface, .. } = &obstacle.shape
                && tables.place_of(surface).is_none()
            {
                tables.add(mesh, surface);
            }
        }
        if tables.rows.is_empty() {
            tables.rows = vec![[0.0; 4]; ROWS_A_SOLID_FACE as usize];
        }
        tables
    }

    /// The first face of a mesh and how many it has; `None` if it is not stored.
    pub(super) fn place_of(&self, surface: &Surface) -> Option<(u32, u32)> {
        let found = self.stored.iter().find(|it| it.0 == surface.digest());
        found.map(|(_, first, count)| (*first, *count))
    }

    /// Whether all meshes of `other` are stored here, too.
    pub(super) fn cover(&self, other: &Self) -> bool {
        let is_here = |it: &(u64, u32, u32)| self.stored.iter().any(|own| own.0 == it.0);
        other.stored.iter().all(is_here)
    }

    /// How many faces are stored.
    pub(crate) fn face_count(&self) -> u32 {
        self.rows.len() as u32 / ROWS_A_SOLID_FACE
    }

    fn add(&mut self, mesh: &Mesh, surface: &Surface) {
        let first = self.rows.len() as u32 / ROWS_A_SOLID_FACE;
        let (center, radius) = mesh.bounding_sphere();
        let center = center.map(f64::from);
        let radius = f64::from(radius);
        let row = |[x, y, z]: [f64; 3]| [x as f32, y as f32, z as f32, 0.0].map(snap);
        for (face, around) in surface.faces().iter().zip(surface.outward_normals()) {
            let [a, b, c] = face.corners.map(|[x, y]| {
                let at = |i: usize| face.origin[i] + face.x[i] * x + face.y[i] * y;
                [0, 1, 2].map(|i| (at(i) - center[i]) / radius)
            });
            let less = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
            self.rows.extend([row(a), row(less(b, a)), row(less(c, a))]);
            self.rows.extend(around.map(row));
        }
        let count = surface.faces().len() as u32;
        self.stored.push((surface.digest(), first, count));
    }
}
