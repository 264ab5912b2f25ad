//! A flock's part of a frame: its edges, its grid, and what it makes of others.

use super::PlanError;
use super::solids::SolidTables;
use super::system::name_key;
use super::urges::{flattened, goal_of, obstacle_of, sight_of};
use crate::exact::snap;
use crate::layout::{self, FlockFrame, SUM_STEPS};
use crate::scene::{BoidShape, Corners, Dimensions, Edges, Flock, RelationKind, Rule, Scene};

/// Marks hashes that make flocks' keys.
const FLOCK_TAG: u32 = 0x666c_6f63;

/// Cells along an axis at most, so that rounding of their coordinates stays below a thousandth of a
/// cell.
const MOST_CELLS_ALONG: f64 = 2048.0;

/// Cells of all flocks that have more boids.
const MOST_DENSE_CELLS: u64 = 3_000_000;

/// Cells of all flocks that have fewer boids.
const MOST_SPARSE_CELLS: u64 = 1 << 20;

/// Cells across a radius: of who has most to look at, and of all at most, for software drivers end
/// loops of many turns.
const CELLS_A_RADIUS: f64 = 1.0;
const MOST_CELLS_A_RADIUS: f64 = 4.0;

/// Cells along x for one along the others: those of a row are looked at in one go.
const FINER_ALONG_X: f64 = 2.0;

/// How wide a trail begins, in sizes of its boid.
const TRAIL_WIDTH: f32 = 0.4;

/// How much farther boids look for neighbours than they see, for rounding.
const RADIUS_MARGIN: f32 = 1.001;

/// Who sees no farther than this does not ask how far away a row is: differences of so small squares
/// may be lost.
const LEAST_TOLD_RADIUS: f64 = 1.0 / 64.0;

/// Boids that are looked at in a frame, at most, while they are spread as they begin: an hour of one
/// core, and more than a driver waits for.
const MOST_LOOKS: f64 = 274_877_906_944.0;

/// Where a flock's cells are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Grid {
    corners: Corners,
    cells: [u32; 3],
    /// Whether all who look see far enough to ask how far away a row is.
    tells_gaps: bool,
}

impl Grid {
    /// The grid of the flock at `slot`. A flock that nobody looks at has one cell.
    fn of(scene: &Scene, slot: usize) -> Self {
        let flock = &scene.flocks[slot];
        let corners = flat(flock, corners_of(flock.edges).unwrap_or(flock.region));
        let looks = scene.flocks.iter().flat_map(|other| {
            let ties = other.relations.iter().filter(|tie| tie.other == slot);
            ties.map(|tie| (other.count, tie.radius.unwrap_or(other.perception_radius)))
        });
        let (mut most, mut main) = (0, 0.0);
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
        for (count, radius) in looks {
            let radius = f64::from(radius);
            (nearest, farthest) = (nearest.min(radius), farthest.max(radius));
            if count > most {
                (most, main) = (count, radius);
            }
        }
        if farthest == 0.0 {
            return Self {
                corners,
                cells: [1; 3],
                tells_gaps: false,
            };
        }
        let sparse = MOST_SPARSE_CELLS / scene.flocks.len() as u64;
        let count = u64::from(flock.count);
        let all: u64 = scene
            .flocks
            .iter()
            .map(|flock| u64::from(flock.count))
            .sum();
        let dense = count.min(count * MOST_DENSE_CELLS / all);
        let most_cells = dense.max(sparse.min(8 * count));
        let mut width = (main / CELLS_A_RADIUS).max(farthest / MOST_CELLS_A_RADIUS);
        loop {
            let along = |axis: usize| {
                let extent = f64::from(corners.max[axis]) - f64::from(corners.min[axis]);
                let finer = if axis == 0 { FINER_ALONG_X } else { 1.0 };
                (extent * finer / width)
                    .floor()
                    .clamp(1.0, MOST_CELLS_ALONG) as u32
            };
            let cells = [0, 1, 2].map(along);
            let total: u64 = cells.into_iter().map(u64::from).product();
            if total <= most_cells {
                return Self {
                    corners,
                    cells,
                    tells_gaps: nearest >= LEAST_TOLD_RADIUS,
                };
            }
            width *= 1.25;
        }
    }

    fn count(&self) -> u32 {
        self.cells.iter().product()
    }

    /// The width of a cell along each axis.
    fn widths(&self) -> [f64; 3] {
        let Corners { min, max } = self.corners;
        [0, 1, 2]
            .map(|axis| (f64::from(max[axis]) - f64::from(min[axis])) / f64::from(self.cells[axis]))
    }

    fn cells_per_unit(&self) -> [f32; 3] {
        let widths = self.widths();
        [0, 1, 2].map(|axis| {
            if self.cells[axis] > 1 {
                (1.0 / widths[axis]) as f32
            } else {
                0.0
            }
        })
    }

    /// The widths, where they tell how far away a row is.
    fn told_widths(&self) -> [f32; 3] {
        if self.tells_gaps {
            self.widths().map(|width| width as f32)
        } else {
            [0.0; 3]
        }
    }
}

/// The corners, without a depth where the flock has none.
fn flat(flock: &Flock, Corners { min, max }: Corners) -> Corners {
    Corners {
        min: flattened(flock, min),
        max: flattened(flock, max),
    }
}

fn corners_of(edges: Edges) -> Option<Corners> {
    match edges {
        Edges::None => None,
        Edges::Wrap(corners) | Edges::Torus(corners) => Some(corners),
        Edges::Repel { corners, .. } | Edges::Constrain { corners, .. } => Some(corners),
    }
}

/// Whether a frame of the flocks comes to an end in bearable time, and boids without depth are kept from what
/// has a cut with their plane that is told by numbers.
pub(super) fn check_looks(scene: &Scene) -> Result<(), PlanError> {
    for flock in &scene.flocks {
        if flock.dimensions == Dimensions::Two && flock.solid_faces() > 0 {
            return Err(PlanError {
                message: format!(
                    "an obstacle of `flock.{}` is a mesh, and the boids have no depth",
                    flock.name
                ),
                help: "a flock with `dimensions = 3`, or a ball or a box instead".into(),
                key: Some(format!("flock.{}.obstacle", flock.name)),
            });
        }
    }
    let looks: f64 = scene
        .flocks
        .iter()
        .map(|flock| looks_of(scene, flock))
        .sum();
    if looks <= MOST_LOOKS {
        return Ok(());
    }
    let of = |flock: &&Flock| looks_of(scene, flock);
    let costliest = scene.flocks.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
    let name = costliest.map_or("", |flock| flock.name.as_str());
    Err(PlanError {
        message: format!(
            "boids, most of them of flock `{name}`, would look at {looks:.0} others in every frame"
        ),
        help: format!(
            "at most {MOST_LOOKS}: a smaller `count` or `perception_radius`, or a larger `region`"
        ),
        key: Some(format!("flock.{name}.count")),
    })
}

/// About how many boids are looked at by those of a flock in its first frame.
fn looks_of(scene: &Scene, flock: &Flock) -> f64 {
    let seen = |tie: &crate::scene::Relation| -> f64 {
        let other = &scene.flocks[tie.other];
        let reach = 2.0 * f64::from(tie.radius.unwrap_or(flock.perception_radius));
        let Corners { min, max } = flat(other, other.region);
        let share = |axis: usize| {
            let extent = f64::from(max[axis]) - f64::from(min[axis]);
            if reach < extent { reach / extent } else { 1.0 }
        };
        f64::from(other.count) * share(0) * share(1) * share(2)
    };
    // Where it is and where it goes, each face is looked at.
    let faces = 2.0 * f64::from(flock.solid_faces());
    f64::from(flock.count) * (flock.relations.iter().map(seen).sum::<f64>() + faces)
}

/// Grid cells of all flocks.
pub(super) fn cell_count(scene: &Scene) -> u32 {
    let slots = 0..scene.flocks.len();
    slots.map(|slot| Grid::of(scene, slot).count()).sum()
}

/// Every flock of a frame, all their relations and all that they are kept from; `scene` is the scene as
/// it is then, `earlier` as it was a frame before.
pub(super) fn flocks_of(
    scene: &Scene,
    earlier: &Scene,
    solids: &SolidTables,
) -> (
    Vec<FlockFrame>,
    Vec<layout::Relation>,
    Vec<layout::Obstacle>,
) {
    let mut flocks = Vec::new();
    let mut relations = Vec::new();
    let mut obstacles = Vec::new();
    let (mut first_boid, mut first_cell, mut first_cover, mut first_place) = (0, 0, 0, 0);
    for (slot, (flock, before)) in scene.flocks.iter().zip(&earlier.flocks).enumerate() {
        let grid = Grid::of(scene, slot);
        let frame = flock_frame(flock, before.max_speed, &grid, scene.seed);
        let [cells_x, cells_y, cells_z] = grid.cells;
        let [_, count, key, edges] = frame.members;
        let [.., in_space, shape] = frame.ties;
        let ties = flock.relations.len() as u32;
        flocks.push(FlockFrame {
            grid: [cells_x, cells_y, cells_z, first_cell],
            members: [first_boid, count, key, edges],
            ties: [relations.len() as u32, ties, in_space, shape],
            trail: [
                first_place,
                ring(flock) - 1,
                flock.trail_frames,
                first_cover,
            ],
            drawn: [
                first_cover + flock.count * faces(flock) * flock.trail_frames,
                faces(flock),
                obstacles.len() as u32,
                flock.obstacles.len() as u32,
            ],
            ..frame
        });
        relations.extend(flock.relations.iter().map(|tie| relation(flock, tie)));
        let kept_out = flock.obstacles.iter();
        obstacles.extend(kept_out.map(|it| obstacle_of(flock, it, solids)));
        first_boid += flock.count;
        first_cover += records(flock);
        first_place += trail_places(flock);
        first_cell += grid.count();
    }
    (flocks, relations, obstacles)
}

/// A flock's frame; velocities are as they were limited to `speed_before`.
fn flock_frame(flock: &Flock, speed_before: f32, grid: &Grid, seed: u64) -> FlockFrame {
    let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w].map(snap);
    let extent = |Corners { min, max }: Corners| [0, 1, 2].map(|axis| max[axis] - min[axis]);
    let inverse = |extent: f32| if extent > 0.0 { 1.0 / extent } else { 0.0 };
    let (edges, factor) = match flock.edges {
        Edges::None => (layout::EDGES_NONE, 1.0),
        Edges::Wrap(_) => (layout::EDGES_WRAP, 1.0),
        Edges::Repel { inward: true, .. } => (layout::EDGES_INWARD, -1.0),
        Edges::Repel { .. } => (layout::EDGES_BOUNCE, -1.0),
        Edges::Constrain { factor, .. } => (layout::EDGES_BOUNCE, factor),
        Edges::Torus(_) => (layout::EDGES_TORUS, 1.0),
    };
    let region = flat(flock, flock.region);
    let corners = flat(flock, corners_of(flock.edges).unwrap_or(flock.region));
    let torus = match flock.edges {
        Edges::Torus(_) => extent(corners),
        _ => [0.0; 3],
    };
    let force = flattened(flock, flock.force);
    let fastest = flock
        .start_speed
        .max(flock.max_speed.max(speed_before) * factor.abs().max(1.0));
    let [red, green, blue] = flock.color;
    let shape = match flock.shape {
        BoidShape::Triangle => layout::BOID_TRIANGLE,
        BoidShape::Disc => layout::BOID_DISC,
        BoidShape::Point => layout::BOID_POINT,
        BoidShape::Cone => layout::BOID_CONE,
    };
    let [goal, goal_rule] = goal_of(flock);
    FlockFrame {
        region_min: with(region.min, flock.start_speed),
        region_extent: with(extent(region), flock.max_speed),
        acceleration: with(force.map(|part| part / flock.mass), 1.0 / flock.mass),
        edges_min: with(corners.min, factor),
        edges_max: with(corners.max, flock.perception_radius),
        torus: with(torus, 0.0),
        torus_inverse: with(torus.map(|extent| inverse(snap(extent))), 0.0),
        grid_min: with(grid.corners.min, SUM_STEPS / power_of_two_from(fastest)),
        cells_per_unit: with(grid.cells_per_unit(), flock.size),
        cell_extent: with(grid.told_widths(), 0.0),
        color: [red, green, blue, flock.opacity].map(snap),
        goal,
        goal_rule,
        grid: [0; 4],
        members: [
            0,
            flock.count,
            name_key(seed, &flock.name, FLOCK_TAG),
            edges,
        ],
        ties: [
            0,
            0,
            u32::from(flock.dimensions == Dimensions::Three),
            shape,
        ],
        trail: [0; 4],
        trail_look: trail_look(flock),
        drawn: [0; 4],
    }
}

/// Places of the ring that a boid's trail is: a power of two, so that frames modulo it go on where
/// frames before 0 end.
fn ring(flock: &Flock) -> u32 {
    flock.trail_frames.next_power_of_two()
}

/// Places of the trails of a flock.
pub(super) fn trail_places(flock: &Flock) -> u32 {
    if flock.trail_frames == 0 {
        0
    } else {
        flock.count * ring(flock)
    }
}

/// Segments of the trails of a flock that are drawn.
pub(super) fn trail_segments(flock: &Flock) -> u64 {
    u64::from(flock.count) * u64::from(faces(flock) * flock.trail_frames)
}

/// How much fainter each segment of a trail is, how wide it begins, and the square of what is a jump.
fn trail_look(flock: &Flock) -> [f32; 4] {
    let axes = match flock.edges {
        Edges::Wrap(corners) | Edges::Torus(corners) => Some(flat(flock, corners)),
        _ => None,
    };
    let extents = axes.iter().flat_map(|Corners { min, max }| {
        let extent = |axis: usize| max[axis] - min[axis];
        [0, 1, 2].map(extent).into_iter().filter(|it| *it > 0.0)
    });
    let farthest = 0.5 * extents.fold(1e9, f32::min);
    let step = 1.0 / (flock.trail_frames + 1) as f32;
    [step, TRAIL_WIDTH, farthest * farthest, 0.0].map(snap)
}

/// How often each boid of the flock is drawn.
fn faces(flock: &Flock) -> u32 {
    match (flock.opacity > 0.0, flock.mirrored) {
        (false, _) => 0,
        (true, false) => 1,
        (true, true) => 2,
    }
}

/// Records of what covers that boids have.
pub(super) fn cover_count(scene: &Scene) -> u32 {
    let flocks = scene.flocks.iter();
    flocks.map(records).sum()
}

/// Records of what covers that the flock has, its trails' included.
fn records(flock: &Flock) -> u32 {
    flock.count * faces(flock) * (1 + flock.trail_frames)
}

fn relation(flock: &Flock, tie: &crate::scene::Relation) -> layout::Relation {
    let radius = tie.radius.unwrap_or(flock.perception_radius);
    let weighed = |rule: Rule, w: f32| [rule.weight, rule.speed, rule.limit, w].map(snap);
    let off = Rule {
        weight: 0.0,
        speed: 0.0,
        limit: 1.0,
    };
    let (kind, nearness, rules, limit) = match tie.kind {
        RelationKind::Flock {
            separation,
            inverse_distance,
            alignment,
            cohesion,
        } => {
            let rules = [separation, alignment, cohesion];
            (layout::RELATION_FLOCK, inverse_distance, rules, 1.0)
        }
        RelationKind::Avoid { limit } => (layout::RELATION_AVOID, false, [off; 3], limit),
        RelationKind::Approach { limit } => (layout::RELATION_APPROACH, false, [off; 3], limit),
    };
    let push = power_of_two_from(limit);
    layout::Relation {
        kinds: [
            kind,
            tie.other as u32,
            u32::from(nearness),
            tie.nearest.unwrap_or(0),
        ],
        reach: [
            radius * radius,
            radius,
            SUM_STEPS / power_of_two_from(radius),
            SUM_STEPS / push,
        ]
        .map(snap),
        separation: weighed(rules[0], limit),
        alignment: weighed(rules[1], push),
        cohesion: weighed(rules[2], radius * RADIUS_MARGIN),
        sight: [sight_of(tie.view_angle_degrees), 0.0, 0.0, 0.0],
    }
}

/// The least power of two that is not below `x`, which is above 0.
fn power_of_two_from(x: f32) -> f32 {
    let floor = f32::from_bits(x.to_bits() & 0x7f80_0000);
    if floor < x { 2.0 * floor } else { floor }
}
