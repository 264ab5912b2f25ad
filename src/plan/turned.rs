//! Turns that come while a plan is under way.

use std::sync::Arc;

use super::{Plan, PlanError, SpreadTables, Turn, Uses};
use crate::scene::{FireSpread, Scene};

/// Least parameter rows a system of a plan that may be turned.
const LEAST_ROWS: u32 = 256;

/// Most parameter rows a system: birth frames are told apart modulo this.
const MOST_ROWS: u32 = 1 << 16;

/// Ignitions of a fire at most.
const MOST_IGNITIONS: u32 = 256;

/// Points of rings that turns may let begin in one frame, besides those that are known.
const IGNITED_ROOM: u32 = 4096;

impl Plan {
    /// Makes room for turns that are not known yet, up to twice the lifetimes that are. To be done
    /// before a backend begins with it; changes no bit of the result.
    pub fn make_editable(&mut self) {
        // What covers is fixed for a whole run: its buffers are large. And how flocks look around: drivers
        // take minutes to compile a look that can do all at once.
        self.uses = Uses {
            covers: self.uses.covers,
            planet: self.uses.planet,
            ground: self.uses.ground,
            surfaces: self.uses.surfaces,
            strokes: self.uses.strokes,
            shades: self.uses.shades,
            triangles: self.uses.triangles,
            cones: self.uses.cones,
            mirrors: self.uses.mirrors,
            skews: self.uses.skews,
            strips: self.uses.strips,
            trails: self.uses.trails,
            crowds: self.uses.crowds,
            throngs: self.uses.throngs,
            depths: self.uses.depths,
            nearest: self.uses.nearest,
            views: self.uses.views,
            obstacles: self.uses.obstacles,
            torus: self.uses.torus,
            // More than 32 lights are loaded pixel by pixel, which takes several times as long.
            most_lights: self.uses.most_lights,
            pillars: self.uses.pillars,
            many_surfaces: self.uses.many_surfaces,
            lamps: self.uses.lamps,
            ..Uses::all()
        };
        self.blocks = self.spread_count > 0;
        if self.spread_count > 0 {
            // The thesis' slider of d_t goes to the length of an edge (Table 3.1). Where that is too much,
            // it may grow no further.
            let scenes: Vec<&Scene> = self.variants.iter().map(|(_, scene)| scene).collect();
            let edge = |spread: &FireSpread| spread.surface.mean_edge_length() as f32;
            if let Ok(tables) = SpreadTables::reaching(&scenes, edge) {
                self.spreads = Arc::new(tables);
            }
            self.ring_count = self.ignitions.piece_count() + self.spread_count * MOST_IGNITIONS;
            self.ignited_count = self.ignited_count.saturating_add(IGNITED_ROOM);
        }
        let rows = (self.lifetime_bound.saturating_add(1)).saturating_mul(2);
        let rows = rows.clamp(LEAST_ROWS, MOST_ROWS).next_power_of_two();
        self.row_count = self.row_count.max(rows);
    }

    /// This plan with one more turn, for a backend that is under way with it.
    ///
    /// # Errors
    /// As [`Plan::with_turns`]; also when the backend has no room for the turn.
    pub fn turned(&self, turn: Turn, frame_end: u32) -> Result<Self, PlanError> {
        let Some(((_, scene), later)) = self.variants.split_first() else {
            return Ok(self.clone());
        };
        let mut turns: Vec<Turn> = later
            .iter()
            .map(|(frame, scene): &(i32, Scene)| Turn {
                frame: frame.cast_unsigned(),
                scene: scene.clone(),
            })
            .filter(|known| known.frame != turn.frame)
            .collect();
        let frame = turn.frame;
        turns.push(turn);
        let mut plan = Self::planned(scene, &turns, frame_end, Some(&self.spreads))?;
        self.check_room(&plan, frame)?;
        plan.capacity = self.capacity;
        plan.relation_count = self.relation_count;
        plan.cell_count = self.cell_count;
        plan.boid_cover_count = self.boid_cover_count;
        plan.detail_passes = self.detail_passes;
        plan.row_count = self.row_count;
        plan.uses = self.uses;
        plan.first_frame = self.first_frame;
        plan.meshes = Arc::clone(&self.meshes);
        plan.solids = Arc::clone(&self.solids);
        plan.surfaces = Arc::clone(&self.surfaces);
        plan.blocks = self.blocks;
        plan.ring_count = self.ring_count;
        plan.ignited_count = self.ignited_count;
        Ok(plan)
    }

    /// Whether a backend that began with this plan has all that `plan` needs.
    fn check_room(&self, plan: &Self, frame: u32) -> Result<(), PlanError> {
        let refuse = |message: String, help: &str| {
            Err(PlanError {
                message: format!("the change at frame {frame} {message}"),
                help: help.to_owned(),
                key: None,
            })
        };
        let begin_anew = "begin a new run with it, among the turns that are known";
        if plan.capacity > self.capacity {
            return refuse(
                format!(
                    "may keep {} particles alive, and the run has room for {}",
                    plan.capacity, self.capacity
                ),
                "give the scene a `capacity` that covers what it may be turned to",
            );
        }
        if self.uses.and(plan.uses) != self.uses || plan.row_count > self.row_count {
            return refuse(
                "uses what the run was begun without".into(),
                "begin the run as one that may be edited (lifetimes may then grow twofold, and fires have up to 32 \
                 lights), or with this set",
            );
        }
        if plan.relation_count > self.relation_count
            || plan.cell_count > self.cell_count
            || plan.boid_cover_count > self.boid_cover_count
        {
            return refuse(
                "has more relations of flocks, grids of more cells, or more boids to be seen, than \
                 the run began with"
                    .into(),
                begin_anew,
            );
        }
        if plan.detail_passes > self.detail_passes {
            return refuse(
                "has more `details` of flames than the run began with".into(),
                begin_anew,
            );
        }
        if plan.curve_points != self.curve_points {
            return refuse(
                "names a curve, to be born on, that the run has not".into(),
                begin_anew,
            );
        }
        if plan.blocks && !self.blocks {
            return refuse(
                "keeps a fire from burning what has burnt, which no fire did".into(),
                begin_anew,
            );
        }
        if !Arc::ptr_eq(&self.spreads, &plan.spreads) {
            return refuse(
                "lets edges count farther away than the run was begun for".into(),
                begin_anew,
            );
        }
        if plan.ring_count > self.ring_count || plan.ignited_count > self.ignited_count {
            return refuse(
                "lights more places, or with more points at once, than the run has room for".into(),
                "begin the run as one that may be edited",
            );
        }
        if !self.solids.cover(&plan.solids) {
            return refuse(
                "names a mesh, to stay out of, that the run has not".into(),
                begin_anew,
            );
        }
        if !self.meshes.cover(&plan.meshes) {
            return refuse(
                "names a mesh, to be born on, that the run has not".into(),
                begin_anew,
            );
        }
        Ok(())
    }
}
