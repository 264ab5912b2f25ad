//! The named buffers of a frame: what WGSL binds by name and Rust declares, once.

use super::Plan;
use crate::layout::{
    AgeLook, Boid, Bound, Brood, CLUSTER_LIGHTS, Counts, Cover, Dispatch, DroppedFlame,
    FLAME_LIGHTS, FLAME_STEPS, FireFrame, Flame, FlameDisc, FlameLight, FlockFrame, Frame,
    FrameStats, Ground, Ignition, Lamp, ListedFlame, Node, Obstacle, Particle, Pillar, Planet,
    Pose, ROWS_A_SOLID_FACE, Relation, ShadeBox, SpreadCounts, SpreadEdge, SpreadFace,
    SpreadFeature, SpreadFrame, SpreadPiece, SpreadPoint, StripJoint, StrokeLight, SurfaceFrame,
    SurfaceLight, SystemFrame, SystemRow, Walker, Wind,
};

/// What a buffer is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferRole {
    /// Uploaded by the processor each frame.
    Input,
    /// Uploaded each frame for the scene's own systems, and written by a kernel for those that others
    /// bear.
    Shared,
    /// The same on every backend over its live records: compared bit for bit.
    State,
    /// A backend's own.
    Scratch,
}

/// How many records a buffer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// A fixed number.
    Fixed(u32),
    /// So many for each system, and so many more.
    Systems {
        /// Records a system.
        each: u32,
        /// Records besides.
        extra: u32,
    },
    /// One for each slot, and so many more, if any system bears systems.
    TreeSlots {
        /// Records besides.
        extra: u32,
    },
    /// One for each system of the scene, if any bears systems.
    Broods,
    /// One for each slot of a system that others bear.
    Borne,
    /// A ring of parameter rows for each system.
    Rows,
    /// The stored points of curves.
    CurvePoints,
    /// So many for each stored face of a mesh.
    MeshFaces(u32),
    /// So many for each stored face of a mesh that boids stay out of.
    SolidFaces(u32),
    /// One for every so many particles of the capacity; the last may stand for fewer.
    ParticlesOver(u32),
    /// One a flock.
    Flocks,
    /// One for each thing that a flock makes of another.
    Relations,
    /// One a boid.
    Boids,
    /// One for each place of a boid's trail.
    BoidTrails,
    /// One for every so many cells of the flocks' grids, and so many more.
    Cells {
        /// Cells a record; the last may stand for fewer.
        over: u32,
        /// Records besides.
        extra: u32,
    },
    /// So many a fire.
    Fires(u32),
    /// One a flame that is told by itself.
    ListedFlames,
    /// So many a flame.
    Flames(u32),
    /// One for each place of a flame, if particles have a matrix.
    FlameSkews,
    /// One for each place of a flame, if strips are drawn.
    StripJoints,
    /// One a fire that spreads.
    Spreads,
    /// So many for each stored face that fires spread over.
    SpreadFaces(u32),
    /// One for each edge that is stored as near a face.
    SpreadFeatures,
    /// One a ring of control points.
    Rings,
    /// So many for each piece that flames may light.
    Pieces(u32),
    /// One for each place of a flame that control points have dropped.
    DroppedPlaces,
    /// One for every so many flames that control points may have dropped.
    DroppedFlames(u32),
    /// One for each list of control points that are near to each other, and one a control point.
    Crowd,
    /// One for every so many control points; the last may stand for fewer.
    PointsOver(u32),
    /// So many a pixel, for pixels in whole fours.
    Pixels(u32),
    /// One for each record of what may cover.
    Covers,
    /// One a pixel, in whole fours, if there is a planet.
    PlanetPixels,
    /// One a pixel, in whole fours, if there is a ground.
    GroundPixels,
    /// So many a pixel, in whole fours, if there are surfaces.
    SurfacePixels(u32),
    /// Three for each stored triangle of the surfaces.
    SurfaceCorners,
    /// Two for each triangle of all surfaces, and one more.
    LargeFaces,
    /// One a pixel, in whole fours, if anything covers where there are surfaces.
    FrontPixels,
    /// So many a pixel, in whole fours, if anything covers.
    CoveredPixels(u32),
    /// One a cell of the box in which clouds throw shadows on themselves.
    ShadeCells,
    /// So many for each point light of particles that there may be, and so many more, if particles throw
    /// light on anything.
    Clusters(u32, u32),
    /// A list of the backend's.
    Backend,
}

/// A declared buffer.
#[derive(Clone, Copy, Debug)]
pub struct Buffer {
    /// The name that WGSL binds it by.
    pub name: &'static str,
    /// What it is for.
    pub role: BufferRole,
    /// Name of the record's type in WGSL.
    pub record: &'static str,
    /// Bytes a record.
    pub stride: u32,
    /// How many records.
    pub count: Count,
}

const fn buffer_of(
    name: &'static str,
    role: BufferRole,
    record: &'static str,
    stride: usize,
    count: Count,
) -> Buffer {
    Buffer {
        name,
        role,
        record,
        stride: stride as u32,
        count,
    }
}

/// Every buffer. `particles` and `survivors` are the two pools, in pages; they change places after
/// each advance.
pub static BUFFERS: &[Buffer] = {
    use BufferRole::{Input, Scratch, Shared, State};
    &[
        buffer_of("frame", Input, "Frame", size_of::<Frame>(), Count::Fixed(1)),
        buffer_of(
            "system_frames",
            Shared,
            "SystemFrame",
            size_of::<SystemFrame>(),
            Count::Systems { each: 1, extra: 0 },
        ),
        buffer_of(
            "rows",
            Shared,
            "SystemRow",
            size_of::<SystemRow>(),
            Count::Rows,
        ),
        buffer_of(
            "poses",
            Shared,
            "Pose",
            size_of::<Pose>(),
            Count::TreeSlots { extra: 0 },
        ),
        buffer_of("broods", Input, "Brood", size_of::<Brood>(), Count::Broods),
        buffer_of(
            "row_spreads",
            Input,
            "SystemRow",
            size_of::<SystemRow>(),
            Count::Broods,
        ),
        buffer_of("nodes", State, "Node", size_of::<Node>(), Count::Borne),
        buffer_of(
            "system_births",
            Scratch,
            "u32",
            4,
            Count::TreeSlots { extra: 0 },
        ),
        buffer_of(
            "system_offsets",
            Scratch,
            "u32",
            4,
            Count::TreeSlots { extra: 1 },
        ),
        buffer_of("free_slots", Scratch, "u32", 4, Count::Borne),
        buffer_of(
            "tree_counts",
            State,
            "Counts",
            size_of::<Counts>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "bounds",
            Input,
            "Bound",
            size_of::<Bound>(),
            Count::Fixed(Plan::MOST_BOUNDS),
        ),
        buffer_of(
            "winds",
            Input,
            "Wind",
            size_of::<Wind>(),
            Count::Fixed(Plan::MOST_WINDS),
        ),
        buffer_of(
            "layer_planes",
            Input,
            "vec4<f32>",
            16,
            Count::Fixed(Plan::MOST_LAYERS),
        ),
        buffer_of(
            "planets",
            Input,
            "Planet",
            size_of::<Planet>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "lamps",
            Input,
            "Lamp",
            size_of::<Lamp>(),
            Count::Fixed(Plan::MOST_LAMPS),
        ),
        buffer_of("planet_pixels", State, "vec4<u32>", 16, Count::PlanetPixels),
        buffer_of(
            "grounds",
            Input,
            "Ground",
            size_of::<Ground>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "pillars",
            Input,
            "Pillar",
            size_of::<Pillar>(),
            Count::Fixed(Plan::MOST_PILLARS),
        ),
        buffer_of("ground_pixels", State, "vec4<u32>", 16, Count::GroundPixels),
        buffer_of(
            "surfaces",
            Input,
            "SurfaceFrame",
            size_of::<SurfaceFrame>(),
            Count::Fixed(Plan::MOST_SURFACES),
        ),
        buffer_of(
            "surface_light",
            Input,
            "SurfaceLight",
            size_of::<SurfaceLight>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "shade_box",
            Input,
            "ShadeBox",
            size_of::<ShadeBox>(),
            Count::Fixed(1),
        ),
        buffer_of("cluster_span", State, "u32", 4, Count::Clusters(0, 8)),
        buffer_of("cluster_sums", State, "u32", 4, Count::Clusters(16, 0)),
        buffer_of(
            "cluster_lights",
            State,
            "FlameLight",
            size_of::<FlameLight>(),
            Count::Clusters(1, 1),
        ),
        buffer_of("shade_sums", State, "u32", 4, Count::ShadeCells),
        buffer_of("shade_light", State, "u32", 4, Count::ShadeCells),
        buffer_of(
            "stroke_light",
            Input,
            "StrokeLight",
            size_of::<StrokeLight>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "surface_corners",
            Input,
            "vec4<u32>",
            16,
            Count::SurfaceCorners,
        ),
        buffer_of("large_faces", Scratch, "u32", 4, Count::LargeFaces),
        buffer_of("surface_nearness", State, "u32", 4, Count::SurfacePixels(4)),
        buffer_of("surface_faces", State, "u32", 4, Count::SurfacePixels(4)),
        buffer_of(
            "surface_pixels",
            State,
            "vec4<u32>",
            16,
            Count::SurfacePixels(1),
        ),
        buffer_of("curve_points", Input, "vec4<f32>", 16, Count::CurvePoints),
        buffer_of("mesh_faces", Input, "vec4<f32>", 16, Count::MeshFaces(3)),
        buffer_of("mesh_choices", Input, "vec2<u32>", 8, Count::MeshFaces(1)),
        buffer_of(
            "birth_counts",
            State,
            "u32",
            4,
            Count::Systems { each: 1, extra: 0 },
        ),
        buffer_of(
            "birth_offsets",
            State,
            "u32",
            4,
            Count::Systems { each: 1, extra: 1 },
        ),
        buffer_of(
            "counts",
            State,
            "Counts",
            size_of::<Counts>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "particles",
            State,
            "Particle",
            size_of::<Particle>(),
            Count::ParticlesOver(1),
        ),
        buffer_of(
            "survivors",
            Scratch,
            "Particle",
            size_of::<Particle>(),
            Count::ParticlesOver(1),
        ),
        buffer_of("alive_bits", State, "u32", 4, Count::ParticlesOver(32)),
        buffer_of("deaths", State, "u32", 4, Count::Fixed(2)),
        buffer_of("sums_1", Scratch, "u32", 4, Count::ParticlesOver(2048)),
        buffer_of("sums_2", Scratch, "u32", 4, Count::ParticlesOver(131_072)),
        buffer_of(
            "word_ranks",
            Scratch,
            "vec2<u32>",
            8,
            Count::ParticlesOver(32),
        ),
        buffer_of(
            "dispatches",
            Scratch,
            "Dispatch",
            size_of::<Dispatch>(),
            Count::Backend,
        ),
        buffer_of(
            "statistics",
            Scratch,
            "FrameStats",
            size_of::<FrameStats>(),
            Count::Fixed(256),
        ),
        buffer_of(
            "flocks",
            Input,
            "FlockFrame",
            size_of::<FlockFrame>(),
            Count::Flocks,
        ),
        buffer_of(
            "relations",
            Input,
            "Relation",
            size_of::<Relation>(),
            Count::Relations,
        ),
        buffer_of(
            "obstacles",
            Input,
            "Obstacle",
            size_of::<Obstacle>(),
            Count::Fixed(Plan::MOST_OBSTACLES),
        ),
        buffer_of(
            "solid_faces",
            Input,
            "vec4<f32>",
            16,
            Count::SolidFaces(ROWS_A_SOLID_FACE),
        ),
        buffer_of("boids", State, "Boid", size_of::<Boid>(), Count::Boids),
        buffer_of("boid_trails", State, "vec4<u32>", 16, Count::BoidTrails),
        buffer_of("boid_cells", State, "u32", 4, Count::Boids),
        buffer_of(
            "cell_counts",
            Scratch,
            "u32",
            4,
            Count::Cells { over: 1, extra: 0 },
        ),
        buffer_of(
            "cell_sums",
            Scratch,
            "u32",
            4,
            Count::Cells { over: 64, extra: 0 },
        ),
        buffer_of(
            "cell_starts",
            State,
            "u32",
            4,
            Count::Cells { over: 1, extra: 1 },
        ),
        buffer_of("cell_members", Scratch, "u32", 4, Count::Boids),
        buffer_of("overlooked", Scratch, "u32", 4, Count::Fixed(2)),
        buffer_of(
            "sorted_boids",
            State,
            "Boid",
            size_of::<Boid>(),
            Count::Boids,
        ),
        buffer_of(
            "fires",
            Input,
            "FireFrame",
            size_of::<FireFrame>(),
            Count::Fires(1),
        ),
        buffer_of(
            "light_roots",
            Input,
            "vec4<f32>",
            16,
            Count::Fixed(FLAME_LIGHTS),
        ),
        buffer_of(
            "listed_flames",
            Input,
            "ListedFlame",
            size_of::<ListedFlame>(),
            Count::ListedFlames,
        ),
        buffer_of(
            "age_looks",
            Input,
            "AgeLook",
            size_of::<AgeLook>(),
            Count::Fires(FLAME_STEPS),
        ),
        buffer_of(
            "flames",
            State,
            "Flame",
            size_of::<Flame>(),
            Count::Flames(1),
        ),
        buffer_of(
            "flame_steps",
            State,
            "vec4<u32>",
            16,
            Count::Flames(FLAME_STEPS),
        ),
        buffer_of(
            "flame_discs",
            State,
            "FlameDisc",
            size_of::<FlameDisc>(),
            Count::Flames(FLAME_STEPS),
        ),
        buffer_of("flame_skews", State, "vec4<u32>", 16, Count::FlameSkews),
        buffer_of(
            "strip_joints",
            State,
            "StripJoint",
            size_of::<StripJoint>(),
            Count::StripJoints,
        ),
        buffer_of(
            "flame_sums",
            State,
            "u32",
            4,
            Count::Fixed(8 * FLAME_LIGHTS),
        ),
        buffer_of(
            "flame_lights",
            State,
            "FlameLight",
            size_of::<FlameLight>(),
            Count::Fixed(FLAME_LIGHTS),
        ),
        buffer_of("flame_bounds", State, "vec4<u32>", 16, Count::Flames(1)),
        buffer_of(
            "spreads",
            Input,
            "SpreadFrame",
            size_of::<SpreadFrame>(),
            Count::Spreads,
        ),
        buffer_of(
            "due_ignitions",
            Input,
            "Ignition",
            size_of::<Ignition>(),
            Count::Rings,
        ),
        buffer_of(
            "spread_faces",
            Input,
            "SpreadFace",
            size_of::<SpreadFace>(),
            Count::SpreadFaces(1),
        ),
        buffer_of(
            "spread_edges",
            Input,
            "SpreadEdge",
            size_of::<SpreadEdge>(),
            Count::SpreadFaces(3),
        ),
        buffer_of(
            "spread_features",
            Input,
            "SpreadFeature",
            size_of::<SpreadFeature>(),
            Count::SpreadFeatures,
        ),
        buffer_of(
            "spread_counts",
            State,
            "SpreadCounts",
            size_of::<SpreadCounts>(),
            Count::Fixed(1),
        ),
        buffer_of(
            "spread_pieces",
            Input,
            "SpreadPiece",
            size_of::<SpreadPiece>(),
            Count::Pieces(1),
        ),
        buffer_of("catches", State, "u32", 4, Count::Pieces(4)),
        buffer_of("ring_spans", State, "vec2<u32>", 8, Count::Rings),
        buffer_of(
            "control_points",
            State,
            "SpreadPoint",
            size_of::<SpreadPoint>(),
            Count::PointsOver(1),
        ),
        buffer_of(
            "moved_points",
            State,
            "SpreadPoint",
            size_of::<SpreadPoint>(),
            Count::PointsOver(1),
        ),
        buffer_of(
            "walkers",
            Scratch,
            "Walker",
            size_of::<Walker>(),
            Count::PointsOver(1),
        ),
        buffer_of(
            "dropped_flames",
            State,
            "DroppedFlame",
            size_of::<DroppedFlame>(),
            Count::DroppedPlaces,
        ),
        buffer_of("crowd", Scratch, "u32", 4, Count::Crowd),
        buffer_of("gap_flags", Scratch, "u32", 4, Count::PointsOver(1)),
        buffer_of("gap_runs", Scratch, "vec4<u32>", 16, Count::PointsOver(32)),
        buffer_of("drop_runs", Scratch, "vec2<u32>", 8, Count::PointsOver(32)),
        buffer_of(
            "flame_runs",
            Scratch,
            "vec2<u32>",
            8,
            Count::DroppedFlames(32),
        ),
        buffer_of("covers", State, "Cover", size_of::<Cover>(), Count::Covers),
        buffer_of("cover_counts", State, "u32", 4, Count::Fixed(8)),
        buffer_of(
            "ranked_covers",
            Scratch,
            "Cover",
            size_of::<Cover>(),
            Count::Backend,
        ),
        buffer_of("ranked_bounds", Scratch, "vec2<u32>", 8, Count::Backend),
        buffer_of("tile_bits", Scratch, "u32", 4, Count::Backend),
        buffer_of("tile_summaries", Scratch, "u32", 4, Count::Backend),
        buffer_of("flame_tiles", Scratch, "u32", 4, Count::Backend),
        buffer_of("cover_rg", State, "vec2<u32>", 8, Count::CoveredPixels(1)),
        buffer_of("cover_bt", State, "vec2<u32>", 8, Count::CoveredPixels(1)),
        buffer_of("cover_front", State, "u32", 4, Count::FrontPixels),
        buffer_of("sort_count", Scratch, "u32", 4, Count::Fixed(4)),
        buffer_of("sort_pairs", Scratch, "vec2<u32>", 8, Count::Covers),
        buffer_of("sorted_pairs", Scratch, "vec2<u32>", 8, Count::Covers),
        buffer_of("digit_counts", Scratch, "u32", 4, Count::Backend),
        buffer_of("digit_starts", Scratch, "u32", 4, Count::Fixed(256)),
        buffer_of("light_low", State, "u32", 4, Count::Pixels(3)),
        buffer_of("light_high", State, "u32", 4, Count::Pixels(3)),
        buffer_of("light_packed", Scratch, "u64", 8, Count::Pixels(1)),
        buffer_of("large_particles", Scratch, "u32", 4, Count::Backend),
        buffer_of("image", State, "u32", 4, Count::Pixels(1)),
        buffer_of("digest", Scratch, "u32", 4, Count::Fixed(4)),
    ]
};

/// The declared buffer of that name, if there is one.
pub fn buffer(name: &str) -> Option<&'static Buffer> {
    BUFFERS.iter().find(|buffer| buffer.name == name)
}

impl Buffer {
    /// Records under `plan`; `None` where it is the backend's to say.
    pub fn records(&self, plan: &Plan) -> Option<u32> {
        Some(match self.count {
            Count::Fixed(count) => count,
            Count::Systems { each, extra } => plan.system_count * each + extra,
            Count::TreeSlots { .. } | Count::Broods if plan.tree_levels == 0 => 0,
            Count::TreeSlots { extra } => plan.system_count + extra,
            Count::Broods => plan.own_system_count,
            Count::Borne => plan.system_count - plan.own_system_count,
            Count::CurvePoints => plan.curve_points.len() as u32,
            Count::MeshFaces(each) => plan.meshes.choices.len() as u32 * each,
            Count::SolidFaces(each) => plan.solids.face_count() * each,
            Count::Rows => plan.system_count * plan.row_count,
            Count::ParticlesOver(each) => plan.capacity.div_ceil(each),
            Count::Flocks => plan.flock_count,
            Count::Relations => plan.relation_count,
            Count::Boids => plan.boid_count,
            Count::BoidTrails => plan.boid_trail_count,
            Count::Fires(each) => plan.fire_count * each,
            Count::ListedFlames => plan.listed_flame_count,
            Count::Flames(each) => plan.flame_count * each,
            Count::FlameSkews if plan.uses.skews => plan.flame_count * FLAME_STEPS,
            Count::StripJoints if plan.uses.strips => plan.flame_count * FLAME_STEPS,
            Count::FlameSkews | Count::StripJoints => 0,
            Count::Spreads => plan.spread_count,
            Count::SpreadFaces(each) => plan.spreads.faces.len() as u32 * each,
            Count::SpreadFeatures => plan.spreads.features.len() as u32,
            Count::Rings => plan.ring_count,
            Count::Pieces(each) => plan.ignitions.piece_count() * each,
            Count::DroppedPlaces => plan.dropped_places,
            Count::DroppedFlames(each) => plan.dropped_capacity.div_ceil(each),
            Count::Crowd if plan.blocks => plan.crowd_lists() + plan.point_capacity,
            Count::Crowd => 0,
            Count::PointsOver(each) => plan.point_capacity.div_ceil(each),
            Count::Cells { over, extra } => plan.cell_count.div_ceil(over) + extra,
            Count::Covers => plan.cover_capacity(),
            Count::CoveredPixels(each) if plan.uses.covers => {
                (plan.width * plan.height).next_multiple_of(4) * each
            }
            Count::CoveredPixels(_) => 0,
            Count::PlanetPixels if plan.uses.planet => {
                (plan.width * plan.height).next_multiple_of(4)
            }
            Count::GroundPixels if plan.uses.ground => {
                (plan.width * plan.height).next_multiple_of(4)
            }
            Count::SurfacePixels(each) if plan.uses.surfaces => {
                (plan.width * plan.height).next_multiple_of(4) * each
            }
            Count::FrontPixels if plan.uses.surfaces && plan.uses.covers => {
                (plan.width * plan.height).next_multiple_of(4)
            }
            Count::SurfaceCorners => plan.surfaces.corners.len() as u32,
            Count::LargeFaces => 2 * plan.surface_face_count + 1,
            Count::PlanetPixels
            | Count::GroundPixels
            | Count::SurfacePixels(_)
            | Count::FrontPixels => 0,
            Count::Pixels(each) => (plan.width * plan.height).next_multiple_of(4) * each,
            Count::ShadeCells => plan.shade_cells.pow(3),
            Count::Clusters(each, extra) if plan.gathers_clusters() => {
                CLUSTER_LIGHTS * each + extra
            }
            Count::Clusters(..) => 0,
            Count::Backend => return None,
        })
    }
}
