//! Which features a plan has: kernels leave out what it has none of.

use super::FrameInputs;
use super::system::IDENTITY;
use crate::layout::{
    BOID_CONE, BOID_TRIANGLE, EDGES_TORUS, FIRE_STRIP, FireFrame, FlockFrame, GRAIN_NONE,
    OBSTACLE_MESH, Obstacle, PARTICLE_RECTANGLE, PARTICLE_STREAK, PARTICLE_STROKE, ROW_OVER,
    Relation, SHAPE_MESH, STREAK_CONSTANT, SystemFrame, SystemRow, WIND_ATTRACTOR, WIND_CURL,
    WIND_SOURCE, WIND_VORTEX, Wind,
};

macro_rules! uses {
    ($($(#[$doc:meta])* $field:ident $switch:literal;)*) => {
        /// Which features some system has at some time; kernels leave out what none has.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Uses {
            $($(#[$doc])* pub $field: bool,)*
        }

        impl Uses {
            /// Every switch of the kernels by its name, and whether it is on.
            pub fn switches(self) -> Vec<(&'static str, bool)> {
                vec![$(($switch, self.$field)),*]
            }

            /// Every field by its name, and whether it is on.
            fn fields(self) -> Vec<(&'static str, bool)> {
                vec![$((stringify!($field), self.$field)),*]
            }

            /// All of them.
            pub(super) fn all() -> Self {
                Self { $($field: true),* }
            }

            /// What either has.
            #[must_use]
            pub(super) fn and(self, other: Self) -> Self {
                Self { $($field: self.$field | other.$field),* }
            }
        }
    };
}

uses! {
    /// Extinction by intensity.
    thresholds "THRESHOLDS";
    /// Extinction by place.
    bounds "BOUNDS";
    /// Rates that differ from particle to particle.
    rate_spreads "RATE_SPREADS";
    /// More than one system.
    many_systems "MANY_SYSTEMS";
    /// More than one parameter row in all: of several systems, or of parameters that change.
    many_rows "MANY_ROWS";
    /// Drag, and with it wind.
    drags "DRAGS";
    /// Wind of several parts.
    many_winds "MANY_WINDS";
    /// Wind around or out of a place.
    flows "FLOWS";
    /// Wind that is made of noise.
    noises "NOISES";
    /// Noise of more than one octave.
    octaves "OCTAVES";
    /// Noise whose octaves count by their absolute value.
    folds "FOLDS";
    /// Systems with drag that are turned, scaled or away from the world's origin.
    placed "PLACED";
    /// Wind that is a product of two gradients.
    curls "CURLS";
    /// Particles drawn as streaks.
    streaks "STREAKS";
    /// Particles drawn as rectangles.
    rectangles "RECTANGLES";
    /// Light that falls with the distance.
    light_distances "LIGHT_DISTANCES";
    /// A picture of layers.
    layers "LAYERS";
    /// Births on meshes.
    meshes "MESHES";
    /// Boids that look at more others than a loop of a software driver turns.
    crowds "CROWDS";
    /// Boids that look at more than four times as many, for whom there is a second time.
    throngs "THRONGS";
    /// A planet, which splits the picture.
    planet "PLANET";
    /// A ground behind everything, or pillars.
    ground "GROUND";
    /// Meshes or pillars that are seen, which hide.
    surfaces "SURFACES";
    /// Pillars.
    pillars "PILLARS";
    /// More than one mesh that is seen.
    many_surfaces "MANY_SURFACES";
    /// Lamps near the ground and surfaces.
    lamps "LAMPS";
    /// Point lights of flames on the ground and on surfaces.
    lights "LIGHTS";
    /// More than 16 of them.
    more_lights "MORE_LIGHTS";
    /// More than 32.
    most_lights "MOST_LIGHTS";
    /// Surfaces with grain, seen or burning.
    grains "GRAINS";
    /// Flames with details.
    details "DETAILS";
    /// Particles of flames with a matrix.
    skews "SKEWS";
    /// Particles of flames with a second layer.
    inners "INNERS";
    /// Strips that noise changes.
    textures "TEXTURES";
    /// Flames whose colours noise moves.
    color_noises "COLOR_NOISES";
    /// Strips along flames.
    strips "STRIPS";
    /// Flocks with depth.
    depths "DEPTHS";
    /// Flocks whose opposite edges are the same.
    torus "TORUS";
    /// Boids that do not see all around.
    views "VIEWS";
    /// Boids that see but the nearest.
    nearest "NEAREST";
    /// Flocks with a goal.
    goals "GOALS";
    /// Flocks with obstacles.
    obstacles "OBSTACLES";
    /// Meshes among them.
    solids "SOLIDS";
    /// Flocks with drag.
    blown "BLOWN";
    /// What covers what is behind it.
    covers "COVERS";
    /// Covering triangles.
    triangles "TRIANGLES";
    /// Trails of boids.
    trails "TRAILS";
    /// Covering cones.
    cones "CONES";
    /// Covers that are drawn at the other side of the picture, too.
    mirrors "MIRRORS";
    /// Marks of flames that have gone out.
    marks "MARKS";
    /// Smoke where dropped flames have gone out.
    smokes "SMOKES";
    /// Fronts that are drawn as lines.
    front_lines "FRONT_LINES";
    /// Whole trajectories.
    strokes "STROKES";
    /// Clouds that throw shadows on themselves.
    shades "SHADES";
    /// Particles that throw light on surfaces.
    clusters "CLUSTERS";
}

fn has_matrix(fire: &FireFrame) -> bool {
    let columns = [fire.matrix_x, fire.matrix_y, fire.matrix_center];
    let same = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    columns != same || fire.strip[3] > 0.0
}

fn is_strip(fire: &FireFrame) -> bool {
    fire.kinds[3] & FIRE_STRIP != 0
}

fn is_placed(system: &SystemFrame) -> bool {
    let [x, y, z] = [
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
    ];
    [x, y, z] != IDENTITY
}

/// Whether noise eats into its strips or moves their colours.
fn has_texture(fire: &FireFrame) -> bool {
    is_strip(fire) && (fire.look[1] > 0.0 || fire.strip[2] > 0.0)
}

fn is_solid(obstacle: &Obstacle) -> bool {
    obstacle.kinds[0] == OBSTACLE_MESH
}

fn is_drawn(flock: &FlockFrame) -> bool {
    flock.drawn[1] > 0
}

fn has_trails(flock: &FlockFrame) -> bool {
    flock.trail[2] > 0
}

fn has_cones(flock: &FlockFrame) -> bool {
    is_drawn(flock) && flock.ties[3] == BOID_CONE
}

fn is_mirrored(flock: &FlockFrame) -> bool {
    flock.drawn[1] == 2
}

fn has_depth(flock: &FlockFrame) -> bool {
    flock.ties[2] == 1
}

fn is_torus(flock: &FlockFrame) -> bool {
    flock.members[3] == EDGES_TORUS
}

fn has_triangles(flock: &FlockFrame) -> bool {
    is_drawn(flock) && flock.ties[3] == BOID_TRIANGLE
}

/// Turns that loops of an invocation may make in all, with some to spare: software drivers end them
/// after 65,535. Of as many, sums over boids need not be carried.
const MOST_TURNS: u64 = 60_000;

/// Turns that the loops of neighbours in a flock make together at most, if they look at so many boids in
/// one: each boid of the others in one of them, for neighbours visit rows in an order that they share, but
/// twice for each axis where rows begin again beyond the end of a torus; and the faces of meshes.
fn turns(flock: &FlockFrame, inputs: &FrameInputs, a_turn: u64) -> u64 {
    let [first, count, ..] = flock.ties.map(|word| word as usize);
    let ties = inputs.relations.iter().skip(first).take(count);
    let other = |tie: &Relation| inputs.flocks.get(tie.kinds[1] as usize);
    let looked_at = |other: &FlockFrame| {
        let ways = match (is_torus(other), has_depth(other)) {
            (false, _) => 1,
            (true, false) => 2,
            (true, true) => 4,
        };
        ways * u64::from(other.members[1])
    };
    let own = u64::from(flock.members[1]);
    let [_, _, first, count] = flock.drawn.map(|word| word as usize);
    let obstacles = inputs.obstacles.iter().skip(first).take(count);
    // Where it is and where it goes.
    let faces = obstacles
        .filter(|it| is_solid(it))
        .map(|it| u64::from(it.kinds[3]));
    let boids = ties.filter_map(other).map(looked_at).sum::<u64>().max(own);
    boids.div_ceil(a_turn) + 2 * faces.sum::<u64>()
}

impl Uses {
    /// What the inputs of one frame use.
    pub(super) fn of(inputs: &FrameInputs) -> Self {
        let rows = inputs.rows.iter().map(Self::of_row);
        let systems = inputs.systems.iter().map(Self::of_system);
        let winds = inputs.winds.iter().map(Self::of_wind);
        let marks = inputs.fires.iter().any(|fire| fire.char_look[3] > 0.0);
        let smokes = inputs.fires.iter().any(|fire| fire.smoke_look[3] > 0.0);
        let front_lines = inputs
            .spreads
            .iter()
            .any(|spread| spread.line_shape[0] > 0.0);
        let most_turns = |a_turn: u64| {
            let all = inputs.flocks.iter();
            all.map(|flock| turns(flock, inputs, a_turn))
                .max()
                .unwrap_or(0)
        };
        let on_grounds = inputs.grounds.iter().map(|ground| ground.kinds[3]);
        let on_surfaces = inputs.surface_lights.iter().map(|light| light.kinds[1]);
        let lights = on_grounds.chain(on_surfaces).max().unwrap_or(0);
        let own = Self {
            pillars: !inputs.pillars.is_empty(),
            many_surfaces: inputs.surfaces.len() > 1,
            lamps: !inputs.lamps.is_empty(),
            lights: lights > 0,
            more_lights: lights > 16,
            most_lights: lights > 32,
            // Those that are borne are anywhere.
            placed: !inputs.poses.is_empty(),
            planet: !inputs.planets.is_empty(),
            details: inputs.fires.iter().any(|fire| fire.details[0] > 0.0),
            skews: inputs.fires.iter().any(has_matrix),
            inners: inputs.fires.iter().any(|fire| fire.inner[0] > 0.0),
            strips: inputs.fires.iter().any(is_strip),
            textures: inputs.fires.iter().any(has_texture),
            color_noises: inputs.fires.iter().any(|fire| fire.look[1] > 0.0),
            ground: !inputs.grounds.is_empty(),
            surfaces: !inputs.surfaces.is_empty() || !inputs.pillars.is_empty(),
            grains: inputs
                .surfaces
                .iter()
                .any(|one| one.grain_kind[0] != GRAIN_NONE)
                || inputs.spreads.iter().any(|one| one.kinds[2] != GRAIN_NONE),
            // What has surfaces is drawn without particles for the layer that these are.
            layers: !inputs.layer_planes.is_empty()
                || !inputs.planets.is_empty()
                || !inputs.grounds.is_empty()
                || !inputs.surfaces.is_empty(),
            covers: inputs.flocks.iter().any(is_drawn) || marks || smokes || front_lines,
            shades: !inputs.shade_boxes.is_empty(),
            marks,
            smokes,
            front_lines,
            triangles: inputs.flocks.iter().any(has_triangles),
            trails: inputs.flocks.iter().any(has_trails),
            streaks: inputs.flocks.iter().any(has_trails) || front_lines,
            cones: inputs.flocks.iter().any(has_cones),
            mirrors: inputs.flocks.iter().any(is_mirrored),
            depths: inputs.flocks.iter().any(has_depth),
            torus: inputs.flocks.iter().any(is_torus),
            views: inputs.relations.iter().any(|tie| tie.sight[0] >= -1.0),
            nearest: inputs.relations.iter().any(|tie| tie.kinds[3] > 0),
            goals: inputs.flocks.iter().any(|flock| flock.goal_rule[2] > 0.0),
            obstacles: !inputs.obstacles.is_empty(),
            solids: inputs.obstacles.iter().any(is_solid),
            blown: inputs.flocks.iter().any(|flock| flock.goal_rule[3] > 0.0),
            crowds: most_turns(1) > MOST_TURNS,
            throngs: most_turns(4) > MOST_TURNS,
            many_systems: inputs.frame.system_count > 1,
            many_rows: inputs.frame.system_count > 1 || inputs.frame.row_mask > 0,
            many_winds: inputs.winds.len() > 1,
            ..Self::default()
        };
        // What differs among systems adds to what their kind has.
        let spreads = inputs.row_spreads.iter().map(|row| Self {
            rate_spreads: Self::of_row(row).rate_spreads,
            ..Self::default()
        });
        rows.chain(systems)
            .chain(winds)
            .chain(spreads)
            .fold(own, Self::and)
    }

    fn of_row(row: &SystemRow) -> Self {
        let varied = row.color_rate_var.iter().any(|rate| *rate != 0.0);
        Self {
            thresholds: row.size_and_threshold[3] >= 0.0,
            rate_spreads: varied || row.ejection_and_light[3] != 0.0,
            streaks: row.kinds[1] == PARTICLE_STREAK,
            rectangles: row.kinds[1] == PARTICLE_RECTANGLE,
            strokes: row.kinds[1] == PARTICLE_STROKE,
            meshes: row.kinds[0] == SHAPE_MESH,
            light_distances: row.ejection_and_light[2] > 0.0,
            covers: row.kinds[3] & ROW_OVER != 0,
            clusters: row.kinds[1] != PARTICLE_STROKE && row.kinds[2] & !STREAK_CONSTANT != 0,
            ..Self::default()
        }
    }

    fn of_system(system: &SystemFrame) -> Self {
        Self {
            bounds: system.bound_count > 0,
            drags: system.acceleration[3] != 0.0,
            placed: system.acceleration[3] != 0.0 && is_placed(system),
            ..Self::default()
        }
    }

    fn of_wind(wind: &Wind) -> Self {
        Self {
            flows: matches!(wind.kinds[0], WIND_VORTEX | WIND_SOURCE | WIND_ATTRACTOR),
            noises: wind.kinds[1] > 0,
            octaves: wind.kinds[1] > 1,
            folds: wind.kinds[3] == 1,
            curls: wind.kinds[0] == WIND_CURL,
            ..Self::default()
        }
    }

    /// What inputs of the caller's making use beyond this, by the names of the fields above; empty where
    /// they use no more.
    pub fn lacking(self, inputs: &FrameInputs) -> Vec<&'static str> {
        let asked = Self::of(inputs).fields();
        let lacks = self.fields().into_iter().zip(asked);
        lacks
            .filter_map(|((name, has), (_, asked))| (asked && !has).then_some(name))
            .collect()
    }
}
