//! What comes back of fires that spread.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::{Simulation, SimulationError};
use crate::cpu::emission::turned;
use crate::cpu::walk::raised;
use crate::layout::SpreadPoint;

/// A control point of a front, for people: world space. Its bytes are those of a record of a dump:
/// 44, no padding.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PointState {
    /// Where it is.
    pub position: [f32; 3],
    /// The unit vector that it heads along, in the plane of its face.
    pub heading: [f32; 3],
    /// Index of the face in the mesh.
    pub face: u32,
    /// Index of its fire in the scene.
    pub fire: u32,
    /// Number of its ring: of its ignition, in the order of frames, then of fires and ignitions.
    pub ring: u32,
    /// How far it has come, world units.
    pub travelled: f32,
    /// 0: it moves; 1: it rests at a border; 2: it rests where it has burnt; 3: it rests since its step
    /// crossed too many edges.
    pub inert: u32,
}

impl Simulation {
    /// The control points of all fires that spread, ring by ring, along each counterclockwise; none
    /// before the first frame is stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn control_points(&mut self) -> Result<Vec<PointState>, SimulationError> {
        let Some(inputs) = self
            .inputs
            .as_ref()
            .filter(|inputs| !inputs.spreads.is_empty())
        else {
            return Ok(Vec::new());
        };
        let words = self.backend.read("control_points")?;
        let points: &[SpreadPoint] = bytemuck::cast_slice(&words);
        let state = |point: &SpreadPoint| {
            let fire_at = inputs.spreads[point.position[3] as usize].kinds[0];
            let fire = &inputs.fires[fire_at as usize];
            let rows = [
                fire.world_from_fire_x,
                fire.world_from_fire_y,
                fire.world_from_fire_z,
            ];
            let face = &self.plan.spreads.faces[point.place[2] as usize];
            let [x, y, ..] = point.course.map(f32::from_bits);
            let origin = Vec3::from(rows.map(|row| row[3]));
            PointState {
                position: (turned(rows, Vec3::from(point.position())) + origin).into(),
                heading: turned(rows, raised(face, Vec2::new(x, y))).into(),
                face: face.features[2],
                fire: fire_at,
                ring: point.ring(),
                travelled: f32::from_bits(point.path[1]),
                inert: point.course[3],
            }
        };
        Ok(points.iter().map(state).collect())
    }
}
