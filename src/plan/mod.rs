//! Scene → [`Plan`]: named buffers, stages in frame order, and the inputs of every frame.
//!
//! Pure and static: no device, no clock, no files. Matrices, angles and everything else that needs
//! more than a multiplication is computed here, once, with [`crate::exact`] math, so that every
//! backend starts from the same bits.

mod blackbody;
mod bounds;
mod buffers;
mod camera;
mod curves;
mod fire;
mod flock;
mod ground;
mod ignitions;
mod inputs;
mod lights;
mod meshes;
mod planet;
mod population;
mod shade;
mod solids;
mod spread;
mod stages;
mod stroke;
mod surface;
mod system;
mod tree;
mod turned;
mod urges;
mod uses;
mod wind;

pub use buffers::{BUFFERS, Buffer, BufferRole, Count, buffer};
pub use fire::DetailPass;
pub use ignitions::Ignitions;
pub(crate) use ignitions::check_ignitions;
pub use inputs::FrameInputs;
pub use meshes::MeshTables;
pub use population::Population;
pub use solids::SolidTables;
pub use spread::SpreadTables;
pub use stages::{STAGES, Stage, StageInfo};
pub use surface::SurfaceTables;
pub use uses::Uses;

use std::sync::Arc;

use crate::scene::{Blend, Camera, Fire, FireSpread, Owner, Scene, Track};

/// Why a scene cannot become a plan: it is the scene's fault, and the message says what to change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanError {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
    /// The key of the scene that is at fault, as [`load_with`](crate::scene::load_with) takes its
    /// path, such as `flock.crows.count`; `None` if there is no one key.
    pub key: Option<String>,
}

impl PlanError {
    /// With the key that is at fault.
    fn of_key(mut self, key: impl Into<String>) -> Self {
        self.key = Some(key.into());
        self
    }
}

impl std::fmt::Display for PlanError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "error: {}\n  = help: {}", self.message, self.help)
    }
}

impl std::error::Error for PlanError {}

/// A parameter change while a scene runs: from `frame` on, the scene is `scene`.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// First frame that it holds for.
    pub frame: u32,
    /// The whole scene as it is from then on: same systems, by number and name.
    pub scene: Scene,
}

/// What a backend needs to know of a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Most particles alive at once.
    pub capacity: u32,
    /// Whether births may be dropped for want of room.
    pub may_drop: bool,
    /// No particle lives longer than this many frames.
    pub lifetime_bound: u32,
    /// No particle dies of age before it has this many frames.
    pub least_lifetime: u32,
    /// Parameter rows kept for each system, a power of two; 1 if no parameter ever changes.
    pub row_count: u32,
    /// Slots of systems: those of the scene, then those that others bear.
    pub system_count: u32,
    /// Systems of the scene.
    pub own_system_count: u32,
    /// Steps from roots down to the farthest systems that others bear; 0 if there are none.
    pub tree_levels: u32,
    /// Number of flocks.
    pub flock_count: u32,
    /// Boids of all flocks.
    pub boid_count: u32,
    /// Places of the trails of all boids.
    pub boid_trail_count: u32,
    /// How often boids, and segments of their trails, are drawn in all, at most.
    pub boid_cover_count: u32,
    /// What flocks make of each other, at most.
    pub relation_count: u32,
    /// Cells of the flocks' grids, at most.
    pub cell_count: u32,
    /// Number of fires.
    pub fire_count: u32,
    /// Flames of all fires.
    pub flame_count: u32,
    /// Those of them that control points may have dropped: the last.
    pub dropped_capacity: u32,
    /// Places for those while they burn and for the marks that they leave: at least as many.
    pub dropped_places: u32,
    /// Those of them that are told one by one.
    pub listed_flame_count: u32,
    /// How often the particles along flames are drawn again, smaller, beside their ways.
    pub detail_passes: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Straight pieces of a stroke, at most, and records of what covers for each particle: those of its
    /// shadow and of itself. 0 if there are no strokes.
    pub stroke_records: [u32; 2],
    /// Cells along each side of the box in which clouds throw shadows on themselves; 0 if there is none.
    pub shade_cells: u32,
    /// What its systems make use of, at any time.
    pub uses: Uses,
    /// The frame that a run begins with: 0, or before it where births begin earlier.
    pub first_frame: i32,
    /// Points of the curves that particles are born on; w unused.
    pub curve_points: Vec<[f32; 4]>,
    /// Faces of the meshes that particles are born on.
    pub meshes: Arc<MeshTables>,
    /// Faces of the meshes that boids stay out of.
    pub solids: Arc<SolidTables>,
    /// What fires spread over.
    pub spreads: Arc<SpreadTables>,
    /// Fires that spread.
    pub spread_count: u32,
    /// Where and when they begin to burn.
    pub ignitions: Ignitions,
    /// Rings that begin at any time, at most.
    pub ring_count: u32,
    /// Points of rings that begin in one frame, at most.
    pub ignited_count: u32,
    /// Whether some fire is kept from burning anything twice, at any time.
    pub blocks: bool,
    /// Control points at most, of all fires together.
    pub point_capacity: u32,
    /// Triangles of the meshes that are seen.
    pub surfaces: Arc<SurfaceTables>,
    /// Meshes that are seen.
    pub surface_count: u32,
    /// Triangles of all of them.
    pub surface_face_count: u32,
    /// The scene as it is from a frame on, in the order of these frames.
    variants: Vec<(i32, Scene)>,
}

impl Plan {
    /// Bounds of all systems together, at most.
    pub const MOST_BOUNDS: u32 = 4096;
    /// Parts of the wind, at most.
    pub const MOST_WINDS: u32 = crate::layout::MOST_WINDS;
    /// Obstacles of all flocks together, at most.
    pub const MOST_OBSTACLES: u32 = 1024;
    /// Lights near the planet and the ground, at most.
    pub const MOST_LAMPS: u32 = crate::layout::MOST_LAMPS;
    /// Meshes that are seen, at most.
    pub const MOST_SURFACES: u32 = 64;
    /// Cylinders before the ground, at most.
    pub const MOST_PILLARS: u32 = 16;
    /// Planes between layers, at most.
    pub const MOST_LAYERS: u32 = 8;

    /// Plans `scene` for frames below `frame_end`.
    ///
    /// # Errors
    /// More particles than 10^9, or a bound too costly to find: the scene then has to name its
    /// capacity. More than 4,096 bounds or 2,796,202 faces of meshes, or a run of more than 65,000
    /// frames in which particles live without limit. Boids that would look at more than 2^38 others
    /// in a frame.
    pub fn new(scene: &Scene, frame_end: u32) -> Result<Self, PlanError> {
        Self::with_turns(scene, &[], frame_end)
    }

    /// Plans `scene` and its recorded `turns` for frames below `frame_end`.
    ///
    /// # Errors
    /// As [`Plan::new`]; also when a turn adds, removes or renames systems, or changes the image,
    /// the seed or the capacity, which hold for a whole run.
    pub fn with_turns(scene: &Scene, turns: &[Turn], frame_end: u32) -> Result<Self, PlanError> {
        Self::planned(scene, turns, frame_end, None)
    }

    /// As [`Plan::with_turns`]; with the tables of what fires spread over that are known, if they serve.
    fn planned(
        scene: &Scene,
        turns: &[Turn],
        frame_end: u32,
        known: Option<&Arc<SpreadTables>>,
    ) -> Result<Self, PlanError> {
        let mut scenes: Vec<&Scene> = vec![scene];
        for turn in turns {
            check_turn(scene, turn)?;
            scenes.push(&turn.scene);
        }
        check_bounds(&scenes)?;
        tree::check_rings(scene)?;
        planet::check_planet(scene)?;
        for scene in &scenes {
            ground::check_ground(scene)?;
            surface::check_surfaces(scene)?;
        }
        for scene in &scenes {
            flock::check_looks(scene)?;
        }
        let first_frame = bounds::first_frame(&scenes);
        let frame_end = frame_end.max(scene.frames);
        let lifetime_bound = bounds::lifetime_bound(&scenes, first_frame, frame_end)?;
        let mut variants = vec![(first_frame, scene.clone())];
        variants.extend(turns.iter().map(|turn| {
            (
                i32::try_from(turn.frame).unwrap_or(i32::MAX),
                turn.scene.clone(),
            )
        }));
        variants.sort_by_key(|(from, _)| *from);
        for [(_, before), (from, scene)] in variants.array_windows() {
            check_ignitions(before, (from.cast_unsigned(), scene))?;
        }
        let changes_rows = |scene: &&Scene| scene.tracks.iter().any(Track::rules_newborns);
        let row_count = if turns.is_empty() && !scenes.iter().any(changes_rows) {
            1
        } else {
            (lifetime_bound + 1).next_power_of_two()
        };
        let relations = |scene: &&Scene| {
            let flocks = scene.flocks.iter();
            flocks.map(|flock| flock.relations.len() as u32).sum()
        };
        let most = |of: &dyn Fn(&&Scene) -> u32| scenes.iter().map(of).max().unwrap_or(0);
        let most_of_kinds = tree::most_of_kinds(&scenes, lifetime_bound, frame_end);
        let borne = tree::capacity(scene, &most_of_kinds)?;
        let spreads = match known.filter(|known| known.serve(&scenes)) {
            Some(known) => Arc::clone(known),
            None => Arc::new(SpreadTables::new(&scenes)?),
        };
        let (_, last) = variants.last().expect("there is the scene itself");
        let ignitions = Ignitions::new(last, &spreads)?;
        let surfaces = SurfaceTables::new(&scenes)?;
        let mut plan = Self {
            capacity: 1,
            may_drop: false,
            lifetime_bound,
            least_lifetime: bounds::least_lifetime(&scenes),
            row_count,
            system_count: scene.systems.len() as u32 + borne,
            own_system_count: scene.systems.len() as u32,
            tree_levels: tree::levels(scene),
            flock_count: scene.flocks.len() as u32,
            boid_count: scene.flocks.iter().map(|flock| flock.count).sum(),
            boid_trail_count: scene.flocks.iter().map(flock::trail_places).sum(),
            boid_cover_count: most(&|scene| flock::cover_count(scene)),
            relation_count: most(&relations),
            cell_count: most(&|scene| flock::cell_count(scene)),
            fire_count: scene.fires.len() as u32,
            flame_count: scene.fires.iter().map(Fire::count).sum::<u32>() + dropped_capacity(scene),
            dropped_capacity: dropped_capacity(scene),
            // A place at least: those of fires without flames are asked for, though never taken.
            dropped_places: (dropped_capacity(scene) + mark_places(scene)?).max(1),
            detail_passes: most(&|scene| fire::detail_passes(scene)),
            listed_flame_count: scene
                .fires
                .iter()
                .map(|fire| fire.listed.len() as u32)
                .sum(),
            width: scene.image.width,
            height: scene.image.height,
            stroke_records: stroke::records_of(scene),
            shade_cells: shade::cells_of(scene),
            uses: Uses::default(),
            first_frame,
            curve_points: curves::curve_points(&scenes),
            meshes: Arc::new(MeshTables::new(&scenes)?),
            solids: Arc::new(SolidTables::new(&scenes)),
            spread_count: spread::spreads_of(scene).count() as u32,
            ring_count: ignitions.ring_count(),
            ignited_count: ignitions.most_points(),
            ignitions,
            blocks: scenes.iter().any(|scene| {
                spread::spreads_of(scene).any(|(_, spread)| spread.prevents_double_burning)
            }),
            point_capacity: point_capacity(scene)?,
            spreads,
            surface_count: scene.surfaces.len() as u32,
            surface_face_count: surface::face_count(scene)?,
            surfaces: Arc::new(surfaces),
            variants,
        };
        plan.uses = plan.uses_of_all();
        let bound = plan.bound(frame_end, &most_of_kinds);
        (plan.capacity, plan.may_drop) = match scene.capacity {
            Some(capacity) => (capacity, !bound.is_ok_and(|most| most <= capacity)),
            None => (bound?, false),
        };
        Ok(plan)
    }

    /// What any frame uses: features grow with the numbers that they are asked for by, but for places,
    /// whose greatest may be the world's origin.
    fn uses_of_all(&self) -> Uses {
        let of = |(from, scene): &(i32, Scene)| {
            let greatest = scene.greatest();
            let uses = Uses::of(&inputs::frame_inputs(self, &greatest, *from));
            Uses {
                placed: uses.placed || uses.drags && system::may_move(scene),
                ..uses
            }
        };
        self.variants
            .iter()
            .map(of)
            .fold(Uses::default(), Uses::and)
    }

    fn bound(&self, frame_end: u32, most_of_kinds: &[u64]) -> Result<u32, PlanError> {
        let of_borne =
            |(_, scene): &(i32, Scene)| tree::births_bound(&scene.greatest(), most_of_kinds);
        let of_borne = self.variants.iter().map(of_borne).max().unwrap_or(0);
        // What has no keys covers the same area in all frames: it is found once.
        let still_areas: Vec<Option<Vec<f32>>> = self
            .variants
            .iter()
            .map(|(_, scene)| scene.tracks.is_empty().then(|| bounds::areas_of(scene)))
            .collect();
        let has_keys = still_areas.iter().any(Option::is_none);
        bounds::capacity(
            |frame| {
                let at = self.variant_at(frame);
                let now = self.variants[at].1.at(f64::from(frame));
                let of_own = match &still_areas[at] {
                    Some(areas) => bounds::births_bound(&now, areas, frame),
                    None => bounds::births_bound(&now, &bounds::areas_of(&now), frame),
                };
                // A sum of a run's frames stays far below 2^64.
                of_own.saturating_add(of_borne).min(1 << 40)
            },
            self.own_system_count as usize * if has_keys { bounds::KEYED_COST } else { 1 },
            self.lifetime_bound,
            self.first_frame,
            frame_end,
        )
    }

    /// The scene that holds at a frame.
    pub(crate) fn scene_at(&self, frame: i32) -> &Scene {
        &self.variants[self.variant_at(frame)].1
    }

    fn variant_at(&self, frame: i32) -> usize {
        let begun = self.variants.partition_point(|(from, _)| *from <= frame);
        begun.saturating_sub(1)
    }

    /// Everything that reaches frame `frame` from outside; pure, so any frame can be asked for.
    /// Frames before 0 are counted modulo 2^32.
    pub fn inputs(&self, frame: u32) -> FrameInputs {
        let frame = frame.cast_signed();
        inputs::frame_inputs(self, self.scene_at(frame), frame)
    }

    /// [`Plan::inputs`], seen by another camera, which does not move.
    pub(crate) fn inputs_seen_by(&self, frame: u32, camera: &Camera) -> FrameInputs {
        let frame = frame.cast_signed();
        let mut scene = self.scene_at(frame).clone();
        scene.tracks.retain(|track| track.owner != Owner::Camera);
        scene.camera = *camera;
        inputs::frame_inputs(self, &scene, frame)
    }

    /// How many boids each flock has.
    pub fn boid_counts(&self) -> impl Iterator<Item = u32> + '_ {
        let (_, scene) = &self.variants[0];
        scene.flocks.iter().map(|flock| flock.count)
    }

    /// Segments of the trails that are drawn in a frame, out of sight or not.
    pub(crate) fn trail_segments(&self) -> u64 {
        let (_, scene) = &self.variants[0];
        scene.flocks.iter().map(flock::trail_segments).sum()
    }

    /// How many frames long the trails of each flock's boids are.
    pub fn trail_frames(&self) -> impl Iterator<Item = u32> + '_ {
        let (_, scene) = &self.variants[0];
        scene.flocks.iter().map(|flock| flock.trail_frames)
    }

    /// The name of each flock.
    pub fn flock_names(&self) -> impl Iterator<Item = &str> + '_ {
        let (_, scene) = &self.variants[0];
        scene.flocks.iter().map(|flock| flock.name.as_str())
    }

    /// Whether the plan has anything for the stage to do at any time.
    pub fn has(&self, stage: Stage) -> bool {
        match stage {
            Stage::Tree => self.tree_levels > 0,
            Stage::Planet => self.uses.planet,
            Stage::Ground => self.uses.ground,
            Stage::Surface => self.uses.surfaces,
            Stage::Lights => (self.uses.ground || self.uses.surfaces) && self.fire_count > 0,
            Stage::Clusters => self.gathers_clusters(),
            Stage::Hatch | Stage::Cells | Stage::Steer => self.flock_count > 0,
            Stage::Shapes | Stage::Cover => self.uses.covers,
            Stage::Shade => self.shade_cells > 0,
            Stage::Front | Stage::Insert => self.spread_count > 0,
            Stage::Block => self.blocks,
            Stage::Catch => self.ignitions.piece_count() > 0,
            Stage::Strips => self.uses.strips,
            Stage::Kindle | Stage::Trace | Stage::FlameDiscs | Stage::Glow => self.fire_count > 0,
            _ => true,
        }
    }

    /// Whether particles throw light on anything.
    pub(crate) fn gathers_clusters(&self) -> bool {
        let is_lit = self.uses.planet || self.uses.ground || self.surface_count > 0;
        self.uses.clusters && is_lit
    }

    /// Lists of control points that are near to each other: a power of two.
    pub(crate) fn crowd_lists(&self) -> u32 {
        (2 * self.point_capacity).next_power_of_two()
    }

    /// Records of what covers, at most: one a particle, those of boids, of marks, of fronts, of smoke and of strokes, if
    /// anything covers.
    pub fn cover_capacity(&self) -> u32 {
        if self.uses.covers {
            let marks = if self.uses.marks {
                self.dropped_places
            } else {
                0
            };
            let lines = if self.uses.front_lines {
                self.point_capacity
            } else {
                0
            };
            let smoke = if self.uses.smokes {
                self.dropped_places
            } else {
                0
            };
            let strokes = self.capacity.saturating_mul(self.stroke_records[1]);
            let own = self.capacity.saturating_add(strokes);
            [self.boid_cover_count, marks, lines, smoke]
                .into_iter()
                .fold(own, u32::saturating_add)
        } else {
            0
        }
    }

    /// Whether the scene has surfaces of any kind ([`Scene::has_surfaces`]).
    pub fn has_surfaces(&self) -> bool {
        self.variants[0].1.has_surfaces()
    }

    /// Names of the picture's layers: those of the scene and `rest`, or `particles` alone if the scene
    /// has none.
    pub fn layer_names(&self) -> Vec<String> {
        self.variants[0].1.layer_names()
    }

    /// The earliest frame that a run has to step to have every particle of `frame` right, from an
    /// empty start, its deaths included: particles born before it are dead by then
    /// (Reeves 1983, section 3). Where births may be dropped, who is alive depends on all that
    /// came before, and so do the places of boids and of fronts: then it is the first frame.
    pub fn restart_frame(&self, frame: u32) -> i32 {
        if self.may_drop || self.flock_count > 0 || self.spread_count > 0 {
            return self.first_frame;
        }
        let earliest = i64::from(frame) - i64::from(self.lifetime_bound);
        earliest.max(i64::from(self.first_frame)) as i32
    }
}

/// Control points of all fires together, at most as many as one binding holds.
fn point_capacity(scene: &Scene) -> Result<u32, PlanError> {
    const MOST: u32 = 1_000_000;
    let wanted = spread::spreads_of(scene).map(|(_, spread)| spread.max_points);
    let wanted = wanted.fold(0, u32::saturating_add);
    if wanted <= MOST {
        return Ok(wanted);
    }
    Err(PlanError {
        message: format!("this scene's fires may have {wanted} control points in all"),
        help: format!("`max_points` that sum to at most {MOST}"),
        key: costliest(scene, "spread.max_points", |spread| spread.max_points),
    })
}

/// The key below the fire that has the most of it.
fn costliest(scene: &Scene, key: &str, most: impl Fn(&FireSpread) -> u32) -> Option<String> {
    let (fire, _) = spread::spreads_of(scene).max_by_key(|(_, spread)| most(spread))?;
    Some(format!("fire.{}.{key}", scene.fires[fire].name))
}

/// Flames that control points may have dropped at once, of all fires together.
fn dropped_capacity(scene: &Scene) -> u32 {
    let most = spread::spreads_of(scene).map(|(_, spread)| spread.max_flames);
    most.sum()
}

/// Places for marks of flames that have gone out, of all fires together.
fn mark_places(scene: &Scene) -> Result<u32, PlanError> {
    const MOST: u32 = 1_000_000;
    let wanted = spread::spreads_of(scene).fold(0u32, |sum, (_, spread)| {
        let marks = spread.char.map_or(0, |char| char.max_marks);
        let puffs = spread.smoke.map_or(0, |smoke| smoke.max_puffs);
        sum.saturating_add(marks.max(puffs))
    });
    if wanted <= MOST {
        return Ok(wanted);
    }
    Err(PlanError {
        message: format!("this scene's fires may leave {wanted} marks in all"),
        help: format!("`max_marks` and `max_puffs` that sum to at most {MOST}"),
        key: costliest(scene, "spread.char.max_marks", |spread| {
            spread.char.map_or(0, |char| char.max_marks)
        }),
    })
}

/// Whether all bounds of the scenes have room.
fn check_bounds(scenes: &[&Scene]) -> Result<(), PlanError> {
    let count = |scene: &&Scene| -> usize {
        let systems = scene.systems.iter();
        systems.map(|system| system.extinctions.len()).sum()
    };
    let most = scenes.iter().map(count).max().unwrap_or(0);
    if most <= Plan::MOST_BOUNDS as usize {
        return Ok(());
    }
    Err(PlanError {
        message: format!("this scene has {most} extinctions by place in all"),
        help: format!("at most {}", Plan::MOST_BOUNDS),
        key: None,
    })
}

/// Whether the turn leaves alone what holds for a whole run of `scene`.
pub(crate) fn check_turn(scene: &Scene, turn: &Turn) -> Result<(), PlanError> {
    let flocks = |scene: &Scene| -> Vec<(String, u32, u32)> {
        let flocks = scene.flocks.iter();
        flocks
            .map(|flock| (flock.name.clone(), flock.count, flock.trail_frames))
            .collect()
    };
    type Burns = Option<(u64, [u32; 4])>;
    let fires = |scene: &Scene| -> Vec<(String, usize, u32, Burns)> {
        let fires = scene.fires.iter();
        fires
            .map(|fire| {
                let spread = fire.spread.as_ref().map(|spread| {
                    let digest = spread.surface.digest();
                    let marks = spread.char.map_or(0, |char| char.max_marks);
                    let puffs = spread.smoke.map_or(0, |smoke| smoke.max_puffs);
                    let marks = marks.max(puffs);
                    let caught = spread.catch_points.unwrap_or(0);
                    let most = [spread.max_points, spread.max_flames, marks, caught];
                    (digest, most)
                });
                (fire.name.clone(), fire.listed.len(), fire.count(), spread)
            })
            .collect()
    };
    let names = |scene: &Scene| -> Vec<String> {
        scene
            .systems
            .iter()
            .map(|system| system.name.clone())
            .collect()
    };
    let blends = |scene: &Scene| -> Vec<Blend> {
        let systems = scene.systems.iter();
        systems.map(|system| system.blend).collect()
    };
    let strokes = |scene: &Scene| -> Vec<bool> {
        let systems = scene.systems.iter();
        systems.map(stroke::is_stroke).collect()
    };
    let tree = |scene: &Scene| -> Vec<Option<String>> {
        let systems = scene.systems.iter();
        systems.map(|system| system.parent.clone()).collect()
    };
    let fixed = |scene: &Scene| {
        (
            (tree(scene), scene.max_systems),
            (
                (scene.planet.is_some(), ground::has_ground(scene)),
                surface::fixed_of(scene),
            ),
            (
                blends(scene),
                strokes(scene),
                stroke::records_of(scene),
                shade::cells_of(scene),
            ),
            scene.image.width,
            scene.image.height,
            scene.seed,
            scene.capacity,
            scene.layers.len(),
            flocks(scene),
            fires(scene),
        )
    };
    if names(scene) != names(&turn.scene) || fixed(scene) != fixed(&turn.scene) {
        return Err(PlanError {
            message: format!(
                "the change at frame {} alters what holds for a whole run",
                turn.frame
            ),
            help: "the list of systems, their names, parents and `blend`, which are of strokes, of how many pieces and whether with shadows, whether clouds throw shadows and in how many cells, whether there is a planet, whether a ground or pillars, the number of surfaces, their meshes and `crease_degrees`, the flocks' and fires' names and counts, `trail_frames`, what fires spread over and their `max_points`, the \
                   number of layers, the image size, the seed and the capacity stay as the scene has \
                   them"
                .into(), key: None });
    }
    Ok(())
}
