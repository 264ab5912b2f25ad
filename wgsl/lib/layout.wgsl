// Every struct that Rust and WGSL share; src/layout.rs is its twin and a test compares the two
// field by field. Storage that kernels write holds no floats: a float goes in as the bits of its
// snapped value (motes::exact::bits_of), so no denormal and no negative zero can reach memory.
#define_import_path motes::layout

// Who a particle is and where it is, 32 bytes, in its system's space.
struct Particle {
    // x, y, z as bits; index within the births of its system and frame.
    position_and_index: vec4<u32>,
    // Velocity a frame as bits; system slot in the high 16 bits, birth frame modulo 65536 in the low.
    velocity_and_birth: vec4<u32>,
}

// The parameters of one system at one birth frame; they rule its particles for life.
struct SystemRow {
    // Extents of the generation shape; w: inner radius of a ring, slope of a cone.
    shape: vec4<f32>,
    // Cosine of the ejection angle, the angle in turns; z: distance at which light is as the
    // colour says, 0 when that is everywhere; w: half-width of the size's rate.
    ejection_and_light: vec4<f32>,
    // Speed mean and half-width, lifetime mean and half-width.
    speed_and_lifetime: vec4<f32>,
    // Size mean, half-width and rate; w: intensity threshold, negative when there is none.
    size_and_threshold: vec4<f32>,
    // Red, green, blue, transparency: means, half-widths, rates a frame, half-widths of the rates.
    color_mean: vec4<f32>,
    color_var: vec4<f32>,
    color_rate: vec4<f32>,
    color_rate_var: vec4<f32>,
    // Generation shape, particle shape, streak light, and flags (ROW_...).
    kinds: vec4<u32>,
}

// SystemRow.kinds.x: where particles are born.
const SHAPE_SPHERE: u32 = 0u;
const SHAPE_CIRCLE: u32 = 1u;
const SHAPE_RECTANGLE: u32 = 2u;
const SHAPE_RING: u32 = 3u;
const SHAPE_BOX: u32 = 4u;
const SHAPE_CONE: u32 = 5u;
const SHAPE_LINE: u32 = 6u;
const SHAPE_CURVE: u32 = 7u;
const SHAPE_MESH: u32 = 8u;
const SHAPE_RINGS: u32 = 9u;
// SystemRow.kinds.y: what they look like.
const PARTICLE_SPHERE: u32 = 0u;
const PARTICLE_RECTANGLE: u32 = 1u;
const PARTICLE_STREAK: u32 = 2u;
const PARTICLE_STROKE: u32 = 3u;
// SystemRow.kinds.z: how light is spread along a streak, in the lowest bit; the others are those of a float,
// the factor of what particles throw on surfaces.
const STREAK_CONSERVED: u32 = 0u;
const STREAK_CONSTANT: u32 = 1u;
// The same of a stroke: the most pieces that it is drawn of; above that, in 4,095ths, what its width
// loses to its end, and how dark its shadow is.
const STROKE_PIECES_MASK: u32 = 0xffu;
const STROKE_TAPER_SHIFT: u32 = 8u;
const STROKE_SHADOW_SHIFT: u32 = 20u;
const STROKE_SHARE_MASK: u32 = 0xfffu;
// SystemRow.kinds.w: the axis of the ejection cone (up if neither), angles instead of solid angles
// uniform, intensity as luminance, births spread over the frame.
const ROW_OUTWARD: u32 = 1u;
const ROW_AROUND: u32 = 2u;
const ROW_ANGLE_UNIFORM: u32 = 4u;
const ROW_LUMINANCE: u32 = 8u;
const ROW_WITHIN_FRAME: u32 = 16u;
// Particles cover what is behind them; they are shaded as spheres; as parts of a cloud; how soft their
// edge is stands above that bit, in 65,535ths.
const ROW_OVER: u32 = 32u;
const ROW_LIT_SPHERE: u32 = 64u;
const ROW_LIT_CLOUD: u32 = 128u;
const ROW_SOFTNESS_SHIFT: u32 = 16u;

// What the processor knows of one system in this frame.
struct SystemFrame {
    // Rows of the 3 x 4 transform from the space of its particles to world space: now, and when
    // the shutter closes.
    world_from_system_x: vec4<f32>,
    world_from_system_y: vec4<f32>,
    world_from_system_z: vec4<f32>,
    closing_world_from_system_x: vec4<f32>,
    closing_world_from_system_y: vec4<f32>,
    closing_world_from_system_z: vec4<f32>,
    // Rows of the transform from the space of the generation shape to that of the particles: a
    // frame ago, and now.
    earlier_system_from_birth_x: vec4<f32>,
    earlier_system_from_birth_y: vec4<f32>,
    earlier_system_from_birth_z: vec4<f32>,
    system_from_birth_x: vec4<f32>,
    system_from_birth_y: vec4<f32>,
    system_from_birth_z: vec4<f32>,
    // Added to velocities each frame, system space; w: the part of the velocity against the wind
    // that drag takes each frame.
    acceleration: vec4<f32>,
    // Mean births and their half-width, in this frame or for each pixel of the screen area.
    mean_parts: f32,
    var_parts: f32,
    // The system's key: hash of the seed and its name.
    key: u32,
    // SYSTEM_...
    flags: u32,
    // The sphere whose projection is the screen area: centre in world space, radius.
    bounding_sphere: vec4<f32>,
    // Where its bounds stand, and how many they are.
    first_bound: u32,
    bound_count: u32,
    // Births all at once besides the others, and their half-width.
    burst_parts: f32,
    burst_var: f32,
}

// SystemFrame.flags: births are floor(x + u) with u uniform (else floor(x + 1/2)); they are counted
// for each pixel of screen area; velocities are those halfway through a frame.
const SYSTEM_STOCHASTIC: u32 = 1u;
const SYSTEM_PER_AREA: u32 = 2u;
const SYSTEM_PARABOLIC: u32 = 4u;
// What it bears are systems.
const SYSTEM_BEARS_SYSTEMS: u32 = 8u;
// Its particles stay where they are born, for what is seen of one is its whole trajectory.
const SYSTEM_STILL: u32 = 16u;

// Something that covers what is behind it, as it is seen: a family's shapes stage writes one for
// each that it has, in the order of their identities. Floats are bits.
struct Cover {
    // x and y in pixels of two points: a triangle's first two corners, the ends of a segment or
    // of a piece of a stroke, the centre of a cone's base and its apex; a disc's or square's centre, then for shading the reciprocal of
    // a disc's radius.
    points: vec4<u32>,
    // A triangle's third corner. Of a disc or segment, how far it reaches from its centre or axis,
    // pixels, and the reciprocal of its edge's width; of a square, half its width; of a cone, how far
    // its base reaches, and how much its axis points to the viewer, -1 to 1; of a piece of a stroke,
    // half its width at both ends. Then what it is (COVER_...), and its depth along the view axis.
    shape: vec4<u32>,
    // Colour in red, green, blue, before exposure; alpha, 0 to 1.
    color: vec4<u32>,
    // What the light adds to the colour of a sphere where it falls straight; of a piece of a stroke,
    // the directions that cut it off at both ends (motes::cover); on which side of the picture it is
    // drawn (COVER_PLAIN and what follows it).
    lit: vec4<u32>,
}

// Words of cover_counts: records of something; records of each family, which stand in covers one
// family after the other.
const COVERS_SEEN: u32 = 0u;
const COVERS_OF_PARTICLES: u32 = 1u;
const COVERS_OF_BOIDS: u32 = 2u;
const COVERS_OF_MARKS: u32 = 3u;
const COVERS_OF_FRONTS: u32 = 4u;
const COVERS_OF_SMOKE: u32 = 5u;
const COVERS_OF_STROKES: u32 = 6u;
// Cover.shape.z: nothing, a disc, a disc with a smooth edge of its own width, a square along the
// axes, a segment with round ends, a triangle, a cone with a round base, a disc seen at a slant, a
// piece of a stroke.
const COVER_NONE: u32 = 0u;
const COVER_DISC: u32 = 1u;
const COVER_SOFT_DISC: u32 = 2u;
const COVER_SQUARE: u32 = 3u;
const COVER_SEGMENT: u32 = 4u;
const COVER_TRIANGLE: u32 = 5u;
const COVER_CONE: u32 = 6u;
const COVER_SLANTED: u32 = 7u;
const COVER_STROKE: u32 = 8u;
// Cover.lit of a piece of a stroke: nothing is cut off where it ends.
const STROKE_UNCUT: f32 = 4.0f;
// Cover.lit.w: drawn where it is; at the other side of the picture, mirrored; at both sides at once,
// which overlap.
const COVER_PLAIN: u32 = 0u;
const COVER_MIRRORED: u32 = 1u;
const COVER_TWIN: u32 = 2u;

// What ends particles that come where they should not be, in world space.
struct Bound {
    // Plane: unit normal and distance along it. Sphere: centre and squared radius. Box: least corner.
    place: vec4<f32>,
    // Box: greatest corner.
    extent: vec4<f32>,
    // x: BOUND_...; y: 1 if the outside kills, 0 if the inside does (of a plane, where the normal
    // points from).
    kinds: vec4<u32>,
}

const BOUND_PLANE: u32 = 0u;
const BOUND_SPHERE: u32 = 1u;
const BOUND_BOX: u32 = 2u;

// One part of the wind (motes::wind), in world space and units a frame.
struct Wind {
    // Kind (WIND_...), octaves, key of the noise, and 1 if octaves count by their absolute value.
    kinds: vec4<u32>,
    // A place, and the radius of what is around it; of a curl, a weight for each axis.
    place: vec4<f32>,
    // A velocity or an axis, and a strength.
    aim: vec4<f32>,
    // Noise cells a world unit along each axis; the factor from an octave to the next.
    scale: vec4<f32>,
    // Where the noise has moved to, in cells; w unused.
    offset: vec4<f32>,
}

const WIND_UNIFORM: u32 = 0u;
const WIND_VORTEX: u32 = 1u;
const WIND_SOURCE: u32 = 2u;
const WIND_ATTRACTOR: u32 = 3u;
const WIND_NOISE: u32 = 4u;
const WIND_CURL: u32 = 5u;

// What the processor knows of the whole frame.
struct Frame {
    // Rows of the 3 x 4 transform to view space, right, up, forward: now, and when the shutter
    // closes.
    view_from_world_x: vec4<f32>,
    view_from_world_y: vec4<f32>,
    view_from_world_z: vec4<f32>,
    closing_view_from_world_x: vec4<f32>,
    closing_view_from_world_y: vec4<f32>,
    closing_view_from_world_z: vec4<f32>,
    background: vec4<f32>,
    // Where the light comes from, in view space (right, up, towards the viewer), its colour, and
    // the light from everywhere.
    light_from: vec4<f32>,
    light_color: vec4<f32>,
    ambient_color: vec4<f32>,
    // The plane of the planet's outline: unit normal towards the eye, distance along it.
    planet_outline: vec4<f32>,
    // Pixels per unit of x/z, or of x if the view is orthographic: now, and when the shutter
    // closes. The principal point.
    focal_px: f32,
    closing_focal_px: f32,
    center_x_px: f32,
    center_y_px: f32,
    // Nearest drawn depth.
    near: f32,
    // Fraction of a frame that the shutter is open.
    shutter: f32,
    // Factor of all light.
    exposure: f32,
    frame: u32,
    system_count: u32,
    // Rows kept for each system, less one; their number is a power of two.
    row_mask: u32,
    capacity: u32,
    // Particles in a page of the pools, a multiple of 2048, and how many pages there are.
    page_len: u32,
    page_count: u32,
    width: u32,
    height: u32,
    // FRAME_...
    flags: u32,
    wind_count: u32,
    // Planes that split the picture into layers; the layer that is drawn, from 1, or 0 for all.
    layer_plane_count: u32,
    layer: u32,
    // No particle dies of age before it has this many frames.
    least_lifetime: u32,
    // Grid cells of all flocks.
    cell_count: u32,
    // Systems of the scene itself: slots from here on are of systems that others bear.
    own_system_count: u32,
    spare_b: u32,
    spare_c: u32,
}

// Frame.flags: the view is orthographic; late light counts more, as for an eye.
const FRAME_ORTHOGRAPHIC: u32 = 1u;
const FRAME_EYE: u32 = 2u;

// How many; one record, kept on the device from frame to frame.
struct Counts {
    // Alive after the last advance.
    live: u32,
    // Births asked for, done and left out for want of room, in this frame.
    requested: u32,
    born: u32,
    dropped: u32,
    // live + born: what the cull looks at.
    total: u32,
    died: u32,
    spare_a: u32,
    spare_b: u32,
}

// One frame's line of the statistics ring.
struct FrameStats {
    frame: u32,
    requested: u32,
    born: u32,
    died: u32,
    live: u32,
    dropped: u32,
    // How many of the deaths were for want of light, and how many for being out of bounds; the
    // rest were of age.
    died_of_intensity: u32,
    died_of_bounds: u32,
    // Systems that others were to bear, that they bore, whose lifetime was over, that live.
    systems_requested: u32,
    systems_born: u32,
    systems_died: u32,
    systems_live: u32,
    points_requested: u32,
    points_born: u32,
    points_died: u32,
    points_live: u32,
    flames_requested: u32,
    flames_born: u32,
    flames_died: u32,
    flames_live: u32,
    marks_died: u32,
    marks_live: u32,
}

// The arguments of one indirect dispatch.
struct Dispatch {
    x: u32,
    y: u32,
    z: u32,
}

// A boid, 32 bytes, in world space. Its place among all is its flock's first and its index.
struct Boid {
    // x, y, z as bits; slot of its flock.
    position_and_flock: vec4<u32>,
    // Velocity a frame as bits; index within its flock.
    velocity_and_index: vec4<u32>,
}

// What the processor knows of one flock in one frame.
struct FlockFrame {
    // Where boids are at first: least corner, w: their speed; extents, w: greatest speed after a
    // move.
    region_min: vec4<f32>,
    region_extent: vec4<f32>,
    // Of the constant force; w: inverse of the mass.
    acceleration: vec4<f32>,
    // Edges: least corner, w: factor of velocities there; greatest corner.
    edges_min: vec4<f32>,
    edges_max: vec4<f32>,
    // Extents of the torus, 0 along axes that have no wrap, and their inverses.
    torus: vec4<f32>,
    torus_inverse: vec4<f32>,
    // Least corner of the grid; w: steps of the sums of its boids' velocities.
    grid_min: vec4<f32>,
    // w: size of a boid.
    cells_per_unit: vec4<f32>,
    // World units a cell, 0 where gaps to rows are not to be relied on.
    cell_extent: vec4<f32>,
    // Red, green, blue, opacity.
    color: vec4<f32>,
    // Where to; w: inverse of the radius where boids slow down, 0 for none.
    goal: vec4<f32>,
    // Weight, speed, limit, which is 0 where there is no goal; w: drag.
    goal_rule: vec4<f32>,
    // Cells along x, y, z; the first one among those of all flocks.
    grid: vec4<u32>,
    // First boid, how many, the flock's key, EDGES_....
    members: vec4<u32>,
    // First relation, how many, 1 for headings in space, BOID_....
    ties: vec4<u32>,
    // First place of its boids' trails; length of the ring of each, less 1; segments that are drawn;
    // first record of these, among those of boids.
    trail: vec4<u32>,
    // How much fainter each segment is; width of the first, in sizes; square of what is a jump.
    trail_look: vec4<f32>,
    // First record of what covers, among those of boids, and how many a boid has; first obstacle, how
    // many.
    drawn: vec4<u32>,
}

// FlockFrame.members.w: what happens at the edges.
const EDGES_NONE: u32 = 0u;
const EDGES_WRAP: u32 = 1u;
const EDGES_BOUNCE: u32 = 2u;
const EDGES_INWARD: u32 = 3u;
const EDGES_TORUS: u32 = 4u;
// FlockFrame.ties.w: what boids look like.
const BOID_TRIANGLE: u32 = 0u;
const BOID_DISC: u32 = 1u;
const BOID_POINT: u32 = 2u;
const BOID_CONE: u32 = 3u;

// What one flock makes of another.
struct Relation {
    // RELATION_..., slot of the other flock, 1 if separation counts near ones more, how many are seen at
    // most, the nearest, or 0 for all.
    kinds: vec4<u32>,
    // Squared radius, radius, steps of the sums of offsets, of those of pushes.
    reach: vec4<f32>,
    // Weight, speed, limit; w: limit of a push.
    separation: vec4<f32>,
    // w: unit of pushes.
    alignment: vec4<f32>,
    cohesion: vec4<f32>,
    // cos |cos| of half the angle of view, below -1 for all around.
    sight: vec4<f32>,
}

// What boids of a flock turn away from, and never enter.
struct Obstacle {
    // OBSTACLE_..., 1 if boids stay inside; of a mesh, its first stored face and how many.
    kinds: vec4<u32>,
    // Centre and radius of a ball or of that around a mesh, unit normal and distance of a plane, centre
    // of a box.
    place: vec4<f32>,
    // Half the extents of a box; of a mesh, the inverse of the ball's radius.
    extent: vec4<f32>,
    // Inverse of the margin where boids turn away, most that they accelerate.
    push: vec4<f32>,
}

// Parts of the wind, at most.
const MOST_WINDS: u32 = 16u;

// Lamps, at most.
const MOST_LAMPS: u32 = 16u;

// Relation.kinds.w at most.
const MOST_NEAREST: u32 = 16u;

// Obstacle.kinds.x.
const OBSTACLE_SPHERE: u32 = 0u;
const OBSTACLE_PLANE: u32 = 1u;
const OBSTACLE_BOX: u32 = 2u;
const OBSTACLE_MESH: u32 = 3u;
// Rows of solid_faces a face.
const ROWS_A_SOLID_FACE: u32 = 10u;

// Relation.kinds.x.
const RELATION_FLOCK: u32 = 0u;
const RELATION_AVOID: u32 = 1u;
const RELATION_APPROACH: u32 = 2u;

// Steps of a sum over neighbours in its unit, which no term exceeds.
const SUM_STEPS: f32 = 536870912.0f;

// Where a system is: rows of the 3 x 4 transform to world space now, a frame ago, and when the
// shutter closes.
struct Pose {
    now_x: vec4<f32>,
    now_y: vec4<f32>,
    now_z: vec4<f32>,
    earlier_x: vec4<f32>,
    earlier_y: vec4<f32>,
    earlier_z: vec4<f32>,
    closing_x: vec4<f32>,
    closing_y: vec4<f32>,
    closing_z: vec4<f32>,
}

// What the processor knows of systems that one of the scene's stands for.
struct Brood {
    // Slot of the scene's system that bears them, or NO_SLOT; steps from the root; BROOD_...; slot
    // of the system that stands for those that they bear, or NO_SLOT.
    ties: vec4<u32>,
    // First frame with births and the first without again (NO_SLOT: never), from their own birth;
    // frames that a slot is needed after the last of them; frames from one ring to the next.
    spans: vec4<u32>,
    // Coefficients of polynomials of the frames since the first.
    mean_parts: vec4<f32>,
    var_parts: vec4<f32>,
    // Mean, half-width, the frame from their own birth.
    burst: vec4<f32>,
    // Half-widths of the constant coefficients and of the factor of the generation shape.
    spread: vec4<f32>,
    // In their own space: centre, radius.
    bounding_sphere: vec4<f32>,
    // w: drag.
    acceleration: vec4<f32>,
    // Radius of the sphere, world units a frame, systems a world unit; 1 / (2 pi radius).
    rings: vec4<f32>,
}

// A system that another one has borne.
struct Node {
    // Key, birth frame, slot of the scene's system that it is like, slot of its parent.
    who: vec4<u32>,
    // NODE_..., frames that it bears, the frame in which its slot is free again, its index among
    // its parent's births of the frame.
    spans: vec4<u32>,
    // Bits, in the space of its parent's offspring: velocity a frame, what is added to it each
    // frame, and the rows of where it was born.
    velocity: vec4<u32>,
    acceleration: vec4<u32>,
    place_x: vec4<u32>,
    place_y: vec4<u32>,
    place_z: vec4<u32>,
}

const NO_SLOT: u32 = 0xffffffffu;
// Node.spans.x.
const NODE_FREE: u32 = 0u;
const NODE_LIVES: u32 = 1u;
const NODE_LINGERS: u32 = 2u;
// Brood.ties.z: their up is where they would leave to; what they bear stays behind; their
// acceleration turns with them; a mean that has shrunk to nothing makes no births; births at once.
const BROOD_OUTWARD: u32 = 1u;
const BROOD_WORLD_SPACE: u32 = 2u;
const BROOD_OWN_ACCELERATION: u32 = 4u;
const BROOD_SHRINKS: u32 = 8u;
const BROOD_BURSTS: u32 = 16u;

// A ball with a surface, as one frame sees it.
struct Planet {
    // From the eye to its centre; radius.
    place: vec4<f32>,
    // The eye; squared distance of the centre less squared radius.
    eye: vec4<f32>,
    // The part of the light that it reflects; slope of its relief.
    color: vec4<f32>,
    // Noise cells a world unit, contrast.
    ground: vec4<f32>,
    // Where the light comes from, its colour, light from everywhere.
    light_from: vec4<f32>,
    light_color: vec4<f32>,
    ambient: vec4<f32>,
    // Octaves of the noise, its key, lamps.
    kinds: vec4<u32>,
}

// A light near the planet.
struct Lamp {
    // From the planet's centre to it; squared distance at which its light is as the colour says.
    place: vec4<f32>,
    color: vec4<f32>,
}

// A plane behind everything, as one frame sees it.
struct Ground {
    // Its unit normal; how far the eye is above it.
    plane: vec4<f32>,
    eye: vec4<f32>,
    // The point that it is seen around; inverse squared radius of what is seen, 0 where there is none.
    middle: vec4<f32>,
    // The part of the light that it reflects; contrast.
    color: vec4<f32>,
    // Where the light comes from; noise cells a world unit.
    light_from: vec4<f32>,
    light_color: vec4<f32>,
    ambient: vec4<f32>,
    // What the places of lamps are counted from.
    lamps_from: vec4<f32>,
    // Octaves of the noise, its key, lamps, lights of flames.
    kinds: vec4<u32>,
    // Pillars.
    counts: vec4<u32>,
}

// An upright cylinder before the ground.
struct Pillar {
    // The middle of its foot; radius.
    place: vec4<f32>,
    // Height of its top; translucence; inverse squared depth of that; inverse radius.
    extent: vec4<f32>,
    // The part of the light that it reflects.
    color: vec4<f32>,
}

// A mesh somewhere, as one frame sees it. The transform is rows of a 3 x 4 matrix.
struct SurfaceFrame {
    world_from_mesh_x: vec4<f32>,
    world_from_mesh_y: vec4<f32>,
    world_from_mesh_z: vec4<f32>,
    // The part of the light that it reflects.
    color: vec4<f32>,
    // First triangle among those stored, how many, the first's number among those of all surfaces.
    faces: vec4<u32>,
    // As those of SpreadFrame, in the mesh's space; GRAIN_... and the key of its noise.
    grain: vec4<f32>,
    grain_shape: vec4<f32>,
    grain_kind: vec4<u32>,
}

// What falls on surfaces, and what hides them.
struct SurfaceLight {
    eye: vec4<f32>,
    // Where the light comes from, its colour, light from everywhere.
    light_from: vec4<f32>,
    light_color: vec4<f32>,
    ambient: vec4<f32>,
    // What the places of lamps are counted from.
    lamps_from: vec4<f32>,
    // From the eye to a planet's centre; squared distance of the centre less squared radius.
    planet: vec4<f32>,
    // Those of a ground.
    plane: vec4<f32>,
    middle: vec4<f32>,
    // Lamps, lights of flames, pillars, planets.
    kinds: vec4<u32>,
    // Surfaces.
    counts: vec4<u32>,
}

// A box of cells along the light, as many each way.
struct ShadeBox {
    // From world space to cells: rows of three and offsets. Across the light, across that, along it from
    // where it comes.
    across: vec4<f32>,
    aside: vec4<f32>,
    along: vec4<f32>,
    // x: the inverse of a cell's cross-section.
    look: vec4<f32>,
    // x: cells each way.
    kinds: vec4<u32>,
}

// What falls on strokes, and what their shadows fall on.
struct StrokeLight {
    // What the places of lamps are counted from.
    lamps_from: vec4<f32>,
    // The ground's unit normal, and its distance along that from the world's origin.
    ground: vec4<f32>,
    // The way that the shadow of a place goes for each unit that it is above the ground, against its
    // sign.
    shade_from: vec4<f32>,
    // What the ground sends back where no light comes straight.
    shade_color: vec4<f32>,
    // That of the ground.
    middle: vec4<f32>,
    // Lamps; 1 if shadows fall on a ground; 1 if there is a ground.
    kinds: vec4<u32>,
}

// A point light that stands for flames, or for particles.
struct FlameLight {
    // Where it is, and the square of its extent, as bits.
    place: vec4<u32>,
    // What it makes of white a unit away, as bits.
    color: vec4<u32>,
}

// Point lights of all flames, at most.
const FLAME_LIGHTS: u32 = 64u;
// Corners of cells along each side of the cube in which particles are gathered to point lights; all of them.
const CLUSTERS_ACROSS: u32 = 8u;
const CLUSTER_LIGHTS: u32 = 512u;
// Steps of a whole weight.
const LIGHT_WEIGHT_STEPS: f32 = 1073741824.0f;

// Steps of a flame's trajectory: ages 0 to 24.
const FLAME_STEPS: u32 = 25u;

// A flame's root, 64 bytes, in world space. Its place among all is its fire's first and its index.
struct Flame {
    // x, y, z as bits; slot of its fire.
    root_and_fire: vec4<u32>,
    // The unit vector that it leaves along, as bits; the frame that it is kindled in.
    normal_and_birth: vec4<u32>,
    // How far its root has moved in this frame, as bits; index within its fire.
    motion_and_index: vec4<u32>,
    // Height, width and brightness as bits; 1 if it burns in this frame.
    look: vec4<u32>,
}

// What the processor knows of one fire in one frame.
struct FireFrame {
    // Rows of the 3 x 4 transform from the fire's space to world space: now, and a frame ago.
    world_from_fire_x: vec4<f32>,
    world_from_fire_y: vec4<f32>,
    world_from_fire_z: vec4<f32>,
    earlier_world_from_fire_x: vec4<f32>,
    earlier_world_from_fire_y: vec4<f32>,
    earlier_world_from_fire_z: vec4<f32>,
    // Extent of the roots: length, radius or scale; y: the inverse of their number.
    roots: vec4<f32>,
    // Means and half-widths of height and width.
    extents: vec4<f32>,
    // The unit vector against gravity; k_g.
    rise: vec4<f32>,
    // Where the noise has moved to, in cells; k_p.
    noise: vec4<f32>,
    // C times the number of steps; factor of the scene's wind; speed at first; length of a unit step
    // as a share of the height.
    motion: vec4<f32>,
    // Brightness; C_noise times the number of steps; cells of that noise a world unit.
    look: vec4<f32>,
    // Opacity of the inner layer as a factor; the inverse of its radius.
    inner: vec4<f32>,
    // Octaves of details; how far they stray as a share of the width; their opacity as a factor.
    details: vec4<f32>,
    // Of the matrix that each particle is multiplied by after it faces the viewer: the columns of x and y,
    // half-widths, and where it puts the centre.
    matrix_x: vec4<f32>,
    matrix_y: vec4<f32>,
    matrix_center: vec4<f32>,
    // Of strips: half the noise cells across, cells a step along, contrast; how far noise changes the
    // matrix.
    strip: vec4<f32>,
    // Colour with which char begins to glow; its opacity, 0 if none is left.
    char_look: vec4<f32>,
    // How wide it is, world units; how soft; the inverse of the frames that it glows, of those in which
    // it appears.
    char_shape: vec4<f32>,
    // Colour of smoke; how much it hides, 0 if there is none.
    smoke_look: vec4<f32>,
    // Its width at first; how many times as wide in the end, less 1; the inverse of its frames; its speed.
    smoke_shape: vec4<f32>,
    // What a weight of 1 throws on white a unit away; the square of a light's extent.
    light: vec4<f32>,
    // The inverse of the greatest weight; the reach of lights from their roots, half its inverse; the
    // inverse of the number of ages in a light's place.
    light_scale: vec4<f32>,
    // ROOTS_..., the fire's key, that of the noise, FIRE_....
    kinds: vec4<u32>,
    // First flame and how many; first listed flame and how many.
    members: vec4<u32>,
    // First face of the mesh and how many.
    faces: vec4<u32>,
    // The first frame; frames of kindling; frames that a flame burns, 0 for ever; frames of growth.
    times: vec4<u32>,
    // First point light and how many; first and last age that its place is made of.
    lights: vec4<u32>,
}

// FireFrame.kinds.x: where flames stand.
const ROOTS_LISTED: u32 = 0u;
const ROOTS_LINE: u32 = 1u;
const ROOTS_CIRCLE: u32 = 2u;
const ROOTS_DISC: u32 = 3u;
const ROOTS_MESH: u32 = 4u;
// FireFrame.kinds.w: velocities are brought to length 1.
const FIRE_NORMALISED: u32 = 1u;
// FireFrame.kinds.w: a strip is drawn along each flame, not its particles.
const FIRE_STRIP: u32 = 2u;

// A flame that is told by itself, in the fire's space; extents below 0 are the fire's.
struct ListedFlame {
    // w: height.
    position: vec4<f32>,
    // w: width.
    normal: vec4<f32>,
    // x: brightness.
    look: vec4<f32>,
    // First frame; LISTED_....
    kinds: vec4<u32>,
}

// ListedFlame.kinds.y: it has a first frame of its own.
const LISTED_FIRST_FRAME: u32 = 1u;

// What a fire's particles look like at one age.
struct AgeLook {
    // Red, green, blue and opacity.
    center: vec4<f32>,
    rim: vec4<f32>,
    // Scales of the half-width and of the half-height.
    scale: vec4<f32>,
}

// One particle of a flame as it is seen; floats are bits.
struct FlameDisc {
    // Centre, pixels; reciprocals of its half-width and half-height in pixels.
    place: vec4<u32>,
    // Red, green, blue and opacity.
    center: vec4<u32>,
    rim: vec4<u32>,
}

// Where a strip along a flame bends; floats are bits.
struct StripJoint {
    // Place in pixels, the unit vector along the flame.
    place: vec4<u32>,
    // Half-width in pixels, factor of the opacity, whether it is seen, depth.
    extent: vec4<u32>,
}

// SpreadPoint.course.w: it moves; it rests at a border, where it has burnt, or because its step crossed
// too many edges.
const POINT_MOVES: u32 = 0u;
const POINT_ENDED: u32 = 1u;
const POINT_BLOCKED: u32 = 2u;
const POINT_LOST: u32 = 3u;
const NO_EDGE: u32 = 0xffffffffu;
// SpreadFrame.kinds.y.
const SPREAD_NORMAL: u32 = 1u;
const SPREAD_MIDPOINT: u32 = 2u;
const SPREAD_LITERAL: u32 = 4u;
const SPREAD_FLAT: u32 = 8u;
const SPREAD_BLOCKS: u32 = 16u;
const SPREAD_CARRIES: u32 = 32u;
const SPREAD_SPILL: u32 = 64u;
const SPREAD_STAIN: u32 = 128u;
const GRAIN_NONE: u32 = 0u;
const GRAIN_STRIPES: u32 = 1u;
const GRAIN_RINGS: u32 = 2u;
// Bits of gap_flags.
const GAP_INSERTS: u32 = 1u;
const GAP_MOVES: u32 = 2u;
const GAP_CAME_TO_REST: u32 = 4u;
const GAP_DROPS_SHIFT: u32 = 8u;

// A control point of a front, 64 bytes. Points of a ring stand one after the other, counterclockwise,
// what burns to their left.
struct SpreadPoint {
    // x and y in the frame of its face, as bits; the face; its ring.
    place: vec4<u32>,
    // Unit heading in the face's frame, as bits; its key; POINT_....
    course: vec4<u32>,
    // How far it has come since it dropped a flame, and in all, as bits; the frame it began in.
    path: vec4<u32>,
    // Where it is in its fire's space, as bits; slot of its spread.
    position: vec4<u32>,
}

// What walks over faces, 48 bytes.
struct Walker {
    // x and y in the frame of its face, as bits; the face; POINT_....
    place: vec4<u32>,
    // The unit vector that it walks along, and a vector that turns with it, as bits.
    way: vec4<u32>,
    // How far it has to go yet, and had in all, as bits; of a front, how it began; of a gap, the point
    // after that which it began at.
    left: vec4<u32>,
}

// A stored face that fires spread over.
struct SpreadFace {
    // Rows of the 3 x 4 transform from the face's frame, whose z is the outward normal.
    fire_from_face_x: vec4<f32>,
    fire_from_face_y: vec4<f32>,
    fire_from_face_z: vec4<f32>,
    // First edge in spread_features that is near, and how many; the mesh's face.
    features: vec4<u32>,
    // What q_o and q_c are multiplied by, as bits; frames that flames burn which are dropped here, 0 if as
    // long as the fire's.
    material: vec4<u32>,
}

// A half-edge of a stored face; half-edge 3 f + i begins at corner i of face f.
struct SpreadEdge {
    // Inward unit normal and offset in the face's frame; the edge's length.
    line: vec4<f32>,
    // Its first corner; cosine and sine of a quarter of all angles around it.
    corner: vec4<f32>,
    // From this face's frame to that beyond: cosine and sine, then the shift.
    turn: vec4<f32>,
    // The half-edge beyond, or NO_EDGE; 1 if its first corner is at no border.
    ties: vec4<u32>,
}

// An edge near a face, in the face's frame.
struct SpreadFeature {
    // Where it begins; from there to its end.
    line: vec4<f32>,
    // The angle between the normals on both sides; the inverse of its squared length.
    bend: vec4<f32>,
}

// What the processor knows of one spread in one frame.
struct SpreadFrame {
    // q_o and q_c; factor of the speed; the inverse of d_t.
    rates: vec4<f32>,
    // d_s and d_d; the inverse of a cell's size; how far apart points are looked at for meetings.
    distances: vec4<f32>,
    // Slot of its fire; SPREAD_...; GRAIN_... and the key of its noise.
    kinds: vec4<u32>,
    // Colour and opacity of the front's line.
    line_look: vec4<f32>,
    // How wide it is, world units, 0 if there is none.
    line_shape: vec4<f32>,
    // Unit direction of the grain; its periods a world unit.
    grain: vec4<f32>,
    // What it takes away at most; how far noise shifts it; cells of that noise a world unit.
    grain_shape: vec4<f32>,
}

// A ring that is to begin.
struct Ignition {
    // Its middle in the frame of its face; a share of a turn a point.
    place: vec4<f32>,
    // The face; how many points; slot of the spread; its key.
    kinds: vec4<u32>,
    // Points of those before it that begin in the same frame; its ring.
    order: vec4<u32>,
}

// A piece of a surface that flames may light, in one frame.
struct SpreadPiece {
    // From its fire's space to world space.
    world_from_fire_x: vec4<f32>,
    world_from_fire_y: vec4<f32>,
    world_from_fire_z: vec4<f32>,
    // A ball around it, in the fire's space.
    ball: vec4<f32>,
    // First face, how many; slot of the spread; its ring.
    faces: vec4<u32>,
    // Points of the ring; its key; a share of a turn a point, as bits.
    ring: vec4<u32>,
}

// How many points; one record, kept on the device from frame to frame.
struct SpreadCounts {
    total: u32,
    live: u32,
    requested: u32,
    born: u32,
    died: u32,
    before: u32,
    inserted: u32,
    ignited_from: u32,
    flames_total: u32,
    flames_first: u32,
    flames_requested: u32,
    flames_born: u32,
    flames_died: u32,
    flames_live: u32,
    marks_first: u32,
    marks_died: u32,
}

// A flame that a control point has dropped, in its fire's space. Flame k is in place k modulo how many
// there may be.
struct DroppedFlame {
    // x, y, z as bits; slot of its fire.
    root_and_fire: vec4<u32>,
    // Outward unit normal of its face, as bits; the frame that it is dropped in.
    normal_and_birth: vec4<u32>,
    // Its key; its number; how many frames it burns, 0 for ever.
    identity: vec4<u32>,
}
