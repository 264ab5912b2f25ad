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
    // Extents of the generation shape; w: cosine of the ejection angle.
    shape: vec4<f32>,
    // Speed mean and half-width, lifetime mean and half-width.
    speed_and_lifetime: vec4<f32>,
    // Size mean, half-width and rate; w: intensity threshold, negative when there is none.
    size_and_threshold: vec4<f32>,
    // Red, green, blue, transparency: means, half-widths, rates a frame.
    color_mean: vec4<f32>,
    color_var: vec4<f32>,
    color_rate: vec4<f32>,
    // Generation shape, particle shape, streak light, and one unused word.
    kinds: vec4<u32>,
}

// What the processor knows of one system in this frame.
struct SystemFrame {
    // Rows of the 3 x 4 transform to world space.
    world_from_system_x: vec4<f32>,
    world_from_system_y: vec4<f32>,
    world_from_system_z: vec4<f32>,
    // Added to velocities each frame, system space; w unused.
    acceleration: vec4<f32>,
    // Mean births and their half-width.
    mean_parts: f32,
    var_parts: f32,
    // The system's key: hash of the seed and its name.
    key: u32,
    // 1: floor(x + u) with u uniform; 0: floor(x + 1/2).
    stochastic_rounding: u32,
}

// What the processor knows of the whole frame.
struct Frame {
    // Rows of the 3 x 4 transform to view space: right, up, forward.
    view_from_world_x: vec4<f32>,
    view_from_world_y: vec4<f32>,
    view_from_world_z: vec4<f32>,
    background: vec4<f32>,
    // Pixels per unit of x/z; the principal point; nearest drawn depth.
    focal_px: f32,
    center_x_px: f32,
    center_y_px: f32,
    near: f32,
    // Fraction of a frame that the shutter is open.
    shutter: f32,
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
    spare_a: u32,
    spare_b: u32,
    spare_c: u32,
}

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
    spare_a: u32,
    spare_b: u32,
}

// The arguments of one indirect dispatch.
struct Dispatch {
    x: u32,
    y: u32,
    z: u32,
}
