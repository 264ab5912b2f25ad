//! Everything that changes while a scene runs reaches a frame as one value.

use super::Plan;
use super::camera::{camera_frame, layer_planes};
use super::fire::fires_of;
use super::flock::flocks_of;
use super::ground::{ground_of, has_ground};
use super::lights::light_roots;
use super::planet::{lamps_of, outline_of, planet_of};
use super::shade::box_of;
use super::spread::spread_frames;
use super::stroke::light_of;
use super::surface::surfaces_of;
use super::system::{Moments, bounds_of, system_frame, system_row};
use super::tree::{bears_systems, broods, pose_of, row_spread};
use super::wind::winds_of;
use crate::layout::{
    AgeLook, Bound, Brood, FireFrame, FlockFrame, Frame, Ground, Ignition, Lamp, ListedFlame,
    Obstacle, Pillar, Planet, Pose, Relation, SYSTEM_BEARS_SYSTEMS, ShadeBox, SpreadFrame,
    SpreadPiece, StrokeLight, SurfaceFrame, SurfaceLight, SystemFrame, SystemRow, Wind,
};
use crate::scene::Scene;

/// What the processor uploads for one frame. The list of them is a recording of the run, and a
/// recording replays exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameInputs {
    /// The frame's own values. `page_len` and `page_count` are the backend's to fill in.
    pub frame: Frame,
    /// One a system of the scene.
    pub systems: Vec<SystemFrame>,
    /// One a system of the scene: the row that this frame's newborns keep for life.
    pub rows: Vec<SystemRow>,
    /// One a system of the scene, if any bears systems: where it is.
    pub poses: Vec<Pose>,
    /// One a system of the scene, if any bears systems.
    pub broods: Vec<Brood>,
    /// One a system of the scene, if any bears systems: how much those differ that it stands for.
    pub row_spreads: Vec<SystemRow>,
    /// Where particles may not be, system by system; at most [`Plan::MOST_BOUNDS`].
    pub bounds: Vec<Bound>,
    /// The parts of the wind, at most [`Plan::MOST_WINDS`].
    pub winds: Vec<Wind>,
    /// The planes between layers (unit normal, distance along it), at most [`Plan::MOST_LAYERS`].
    pub layer_planes: Vec<[f32; 4]>,
    /// The planet, if there is one.
    pub planets: Vec<Planet>,
    /// Lights near it, the ground, surfaces and strokes, at most [`Plan::MOST_LAMPS`].
    pub lamps: Vec<Lamp>,
    /// The ground, if there is a surface besides a planet.
    pub grounds: Vec<Ground>,
    /// Cylinders before it, at most [`Plan::MOST_PILLARS`].
    pub pillars: Vec<Pillar>,
    /// Meshes that are seen, at most [`Plan::MOST_SURFACES`].
    pub surfaces: Vec<SurfaceFrame>,
    /// What falls on them, if there are any.
    pub surface_lights: Vec<SurfaceLight>,
    /// What falls on strokes, if there are any.
    pub stroke_lights: Vec<StrokeLight>,
    /// The box in which clouds throw shadows on themselves, if there is one.
    pub shade_boxes: Vec<ShadeBox>,
    /// One a flock.
    pub flocks: Vec<FlockFrame>,
    /// What flocks make of each other, flock by flock.
    pub relations: Vec<Relation>,
    /// What their boids are kept from, flock by flock; at most [`Plan::MOST_OBSTACLES`].
    pub obstacles: Vec<Obstacle>,
    /// One a fire.
    pub fires: Vec<FireFrame>,
    /// Places that point lights' are counted from, world space, one a light, fire by fire; w unused. Those
    /// of fires that do not tell them are unused.
    pub light_roots: Vec<[f32; 4]>,
    /// The flames that are told one by one, fire by fire.
    pub listed_flames: Vec<ListedFlame>,
    /// What flames look like at each age, fire by fire.
    pub age_looks: Vec<AgeLook>,
    /// One a fire that spreads.
    pub spreads: Vec<SpreadFrame>,
    /// Pieces that flames may light, fire by fire.
    pub spread_pieces: Vec<SpreadPiece>,
    /// The rings that begin; if there are none, one without points if any fire spreads.
    pub due_ignitions: Vec<Ignition>,
    /// Whether flocks begin in this frame: their boids are put where they are at first.
    pub hatches: bool,
}

/// The inputs of the frame `number`, with `scene` as it is from some frame on.
pub(super) fn frame_inputs(plan: &Plan, scene: &Scene, number: i32) -> FrameInputs {
    let time = f64::from(number);
    let now = scene.at(time);
    let earlier = scene.seen_from(time, time - 1.0);
    let closing = scene.seen_from(time, time + f64::from(now.image.shutter));
    let mut bounds = Vec::new();
    let mut poses = Vec::new();
    let systems = now
        .systems
        .iter()
        .zip(&earlier.systems)
        .zip(&closing.systems)
        .map(|((system, earlier), closing)| {
            let moments = Moments {
                now: system,
                earlier,
                closing,
            };
            let first_bound = bounds.len();
            bounds.extend(bounds_of(system));
            let mut of_system = system_frame(&moments, scene.seed, number);
            if plan.tree_levels > 0 {
                poses.push(pose_of(&moments));
                if bears_systems(&now.systems, system) {
                    of_system.flags |= SYSTEM_BEARS_SYSTEMS;
                }
            }
            SystemFrame {
                first_bound: first_bound as u32,
                bound_count: (bounds.len() - first_bound) as u32,
                ..of_system
            }
        })
        .collect();
    let (broods, row_spreads) = if plan.tree_levels > 0 {
        let spreads = now.systems.iter().map(row_spread);
        (broods(&now, plan.lifetime_bound), spreads.collect())
    } else {
        (Vec::new(), Vec::new())
    };
    let winds = winds_of(&now, number);
    let layer_planes = layer_planes(&now);
    // What jumps has jumped: velocities are as they were limited in the frame before.
    let before = plan.scene_at(number.saturating_sub(1)).at(time - 1.0);
    let (flocks, relations, obstacles) = flocks_of(&now, &before, &plan.solids);
    let planets = planet_of(&now);
    let stroke_lights = light_of(&now);
    let is_lit = has_ground(&now) || !now.surfaces.is_empty() || !stroke_lights.is_empty();
    let lamps = if planets.is_empty() && !is_lit {
        Vec::new()
    } else {
        lamps_of(&now).0
    };
    let (fires, listed_flames, age_looks) = fires_of(&now, &earlier, &plan.meshes, number);
    let spread_pieces = plan.ignitions.pieces(&fires, number);
    let light_roots = light_roots(&now, &fires, &plan.spreads);
    let flame_lights = fires.iter().map(|fire| fire.lights[1]).sum();
    let (grounds, pillars) = ground_of(&now, flame_lights);
    let (surfaces, surface_lights) =
        surfaces_of(&now, &plan.surfaces, (&planets, &grounds), flame_lights);
    let frame = Frame {
        frame: number.cast_unsigned(),
        wind_count: winds.len() as u32,
        layer_plane_count: layer_planes.len() as u32,
        planet_outline: outline_of(&now),
        ..plan.bounded(camera_frame(&now, &closing))
    };
    let rows = now.systems.iter();
    let rows = rows.map(|system| system_row(system, &plan.meshes));
    FrameInputs {
        frame,
        systems,
        rows: rows.collect(),
        poses,
        broods,
        row_spreads,
        bounds,
        winds,
        layer_planes,
        planets,
        lamps,
        grounds,
        pillars,
        surfaces,
        surface_lights,
        stroke_lights,
        shade_boxes: box_of(&now),
        flocks,
        relations,
        obstacles,
        fires,
        light_roots,
        listed_flames,
        age_looks,
        spreads: spread_frames(&now),
        spread_pieces,
        due_ignitions: plan.ignitions.due(number),
        hatches: number == plan.first_frame,
    }
}

impl Plan {
    /// `frame` with the sizes and counts that hold for the whole run.
    pub(crate) fn bounded(&self, frame: Frame) -> Frame {
        Frame {
            system_count: self.system_count,
            own_system_count: self.own_system_count,
            row_mask: self.row_count - 1,
            least_lifetime: self.least_lifetime,
            capacity: self.capacity,
            width: self.width,
            height: self.height,
            cell_count: self.cell_count,
            ..frame
        }
    }
}
