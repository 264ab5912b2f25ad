//! What is at a place of the picture: rays through it, and where they meet what can burn.

use glam::{DMat3, DVec3, Vec3};

use super::Simulation;
use crate::layout::FRAME_ORTHOGRAPHIC;
use crate::plan::FrameInputs;
use crate::scene::Scene;

/// How much farther away than a surface that is seen what burns may be, as a share of the way: they are
/// the same mesh, as a rule.
const BEHIND: f64 = 1e-3;

/// A ray of world space, through a place of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, world units: the eye, or a place of its plane if the view is orthographic.
    pub origin: [f32; 3],
    /// Where it goes; a unit vector.
    pub direction: [f32; 3],
}

impl Ray {
    /// Where it meets a plane through `point`, whose normal need not be of unit length; `None` for what is
    /// behind its origin, or parallel to it.
    pub fn meets_plane(&self, point: [f32; 3], normal: [f32; 3]) -> Option<[f32; 3]> {
        let [origin, direction] = [self.origin, self.direction].map(Vec3::from);
        let normal = Vec3::from(normal);
        let way = normal.dot(Vec3::from(point) - origin) / normal.dot(direction);
        (way.is_finite() && way >= 0.0).then(|| (origin + direction * way).into())
    }
}

/// A place of a surface that a fire can spread over.
#[derive(Clone, Debug, PartialEq)]
pub struct Pick {
    /// The fire's place among the scene's.
    pub fire: usize,
    /// The place, in the fire's space, as `[[fire.spread.ignition]]` has it.
    pub position: [f32; 3],
}

impl Simulation {
    /// The ray through a place of the picture drawn last: pixels to the right and down from its upper left
    /// corner, with parts of them. `None` before anything is drawn.
    pub fn ray_through(&self, [x_px, y_px]: [f32; 2]) -> Option<Ray> {
        let frame = self.drawn?;
        let rows = [
            frame.view_from_world_x,
            frame.view_from_world_y,
            frame.view_from_world_z,
        ];
        // Rows of a rotation are columns of its inverse.
        let [right, up, forward] = rows.map(|row| Vec3::from_slice(&row));
        let [x, y, z] = rows.map(|row| row[3]);
        let eye = -(right * x + up * y + forward * z);
        let aside = (x_px - frame.center_x_px) / frame.focal_px;
        let above = (frame.center_y_px - y_px) / frame.focal_px;
        let shift = right * aside + up * above;
        let (origin, direction) = if frame.flags & FRAME_ORTHOGRAPHIC != 0 {
            (eye + shift, forward)
        } else {
            (eye, (shift + forward).normalize())
        };
        Some(Ray {
            origin: origin.into(),
            direction: direction.into(),
        })
    }

    /// The place of the nearest surface that a fire can spread over, where the picture drawn last shows it;
    /// `None` if there is none, or another surface is before it.
    pub fn pick(&self, at_px: [f32; 2]) -> Option<Pick> {
        let (ray, inputs) = (self.ray_through(at_px)?, self.inputs.as_ref()?);
        let scene = self.plan.scene_at(inputs.frame.frame.cast_signed());
        let (way, pick) = burning(scene, inputs, &ray)?;
        let is_hidden = self.nearest_surface(inputs, &ray) < way * (1.0 - BEHIND);
        (!is_hidden).then_some(pick)
    }

    /// How far the ray goes to the nearest of the surfaces that are seen.
    fn nearest_surface(&self, inputs: &FrameInputs, ray: &Ray) -> f64 {
        let of = |corner: &[u32; 4]| {
            let [x, y, z, _] = corner.map(|bits| f64::from(f32::from_bits(bits)));
            DVec3::new(x, y, z)
        };
        let all = inputs.surfaces.iter().filter_map(|surface| {
            let local = Local::new(
                ray,
                [
                    surface.world_from_mesh_x,
                    surface.world_from_mesh_y,
                    surface.world_from_mesh_z,
                ],
            );
            let [first, count, ..] = surface.faces;
            let corners = &self.plan.surfaces.corners[3 * first as usize..][..3 * count as usize];
            let (triangles, _) = corners.as_chunks::<3>();
            let ways = triangles
                .iter()
                .filter_map(|one| local.meets(one.map(|at| of(&at))));
            ways.min_by(f64::total_cmp)
        });
        all.min_by(f64::total_cmp).unwrap_or(f64::INFINITY)
    }
}

/// How far the ray goes to the nearest face that a fire can spread over, and that place.
fn burning(scene: &Scene, inputs: &FrameInputs, ray: &Ray) -> Option<(f64, Pick)> {
    let fires = scene.fires.iter().zip(&inputs.fires).enumerate();
    let all = fires.filter_map(|(at, (fire, pose))| {
        let surface = &fire.spread.as_ref()?.surface;
        let local = Local::new(
            ray,
            [
                pose.world_from_fire_x,
                pose.world_from_fire_y,
                pose.world_from_fire_z,
            ],
        );
        let ways = surface.faces().iter().filter_map(|face| {
            let [origin, x, y] = [face.origin, face.x, face.y].map(DVec3::from);
            local.meets(face.corners.map(|[right, up]| origin + x * right + y * up))
        });
        let way = ways.min_by(f64::total_cmp)?;
        let position = (local.origin + local.direction * way).to_array();
        let pick = Pick {
            fire: at,
            position: position.map(|x| x as f32),
        };
        Some((way, pick))
    });
    all.min_by(|(a, _), (b, _)| a.total_cmp(b))
}

/// A ray in the space of something: as far along it as in world space.
struct Local {
    origin: DVec3,
    direction: DVec3,
}

impl Local {
    /// `world_from_local` is rows of a 3 × 4 matrix.
    fn new(ray: &Ray, world_from_local: [[f32; 4]; 3]) -> Self {
        let rows = world_from_local.map(|row| row.map(f64::from));
        let turn = DMat3::from_cols_array_2d(&rows.map(|[x, y, z, _]| [x, y, z])).transpose();
        let moved = DVec3::from(rows.map(|[.., w]| w));
        let back = turn.inverse();
        let [origin, direction] = [ray.origin, ray.direction].map(|v| Vec3::from(v).as_dvec3());
        Self {
            origin: back * (origin - moved),
            direction: back * direction,
        }
    }

    /// How far it goes to the triangle, either side of it, if it meets it (Möller and Trumbore 1997).
    fn meets(&self, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let (along, beside) = (b - a, c - a);
        let across = self.direction.cross(beside);
        let scale = 1.0 / along.dot(across);
        let from = self.origin - a;
        let u = from.dot(across) * scale;
        let q = from.cross(along);
        let v = self.direction.dot(q) * scale;
        let way = beside.dot(q) * scale;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && way > 0.0).then_some(way)
    }
}
