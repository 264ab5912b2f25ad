// splat: every particle adds its light to the pixels it covers, antialiased.
//
// Reeves 1983, 2.5 and 3: each particle is a point light source, nothing hides anything, and the
// light added depends on colour and transparency, not on distance. A sphere is a disc of radius
// size focal / depth; a streak is that disc swept from the place at the frame's start to the place
// when the shutter closes; a rectangle is a square that faces the viewer.
// A disc or streak covers a pixel by the distance of the pixel's centre from the segment, with an
// edge one pixel wide; the weights are then scaled so that their sum is exactly the disc's area
// (its total light), wherever it stands between pixels and however long the streak is.
// One invocation a particle of one page. Reads: frame, system_frames, rows, counts, particles.
// Writes: light_low, light_high (atomic adds; a carry goes from low to high).
// Invariant: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{
    clamp_exact, f32_of_i32, inverse_square_root, less, max_exact, min_exact, reciprocal,
    square_root, to_i32,
}
#import motes::layout::{Counts, Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system draws such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};

const PARTICLE_RECTANGLE: u32 = 1u;
const PARTICLE_STREAK: u32 = 2u;
const STREAK_CONSTANT: u32 = 1u;

const PI: f32 = 3.14159265f;
// Radii are at most this many pixels; what is larger belongs to surfaces.
const MOST_RADIUS_PX: f32 = 256.0f;
// Streaks are followed this far outside the picture to learn their total.
const GUARD_PX: i32 = 1024;
// A disc of at least this radius needs no scaling of its weights; below half of it, all of it.
const LARGE_RADIUS_PX: f32 = 4.0f;
// Pixels from the centre at which a small disc's edge ends at most.
const SMALL_REACH_PX: f32 = 1.5f;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;

// A point in pixels, and its depth along the view axis.
struct Projected {
    x: f32,
    y: f32,
    depth: f32,
    // Pixels a world unit spans there.
    scale: f32,
}

// The system in that slot; a lone one is loaded once for all invocations.
fn system_at(slot: u32) -> SystemFrame {
    if frame.system_count == 1u {
        return system_frames[0];
    }
    return system_frames[slot];
}

// The parameter row there. A lone row is loaded once for all invocations, not once for each.
fn row_at(index: u32) -> SystemRow {
    if frame.system_count == 1u && frame.row_mask == 0u {
        return rows[0];
    }
    return rows[index];
}

fn transform(x_row: vec4<f32>, y_row: vec4<f32>, z_row: vec4<f32>, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        x_row.x * p.x + x_row.y * p.y + x_row.z * p.z + x_row.w,
        y_row.x * p.x + y_row.y * p.y + y_row.z * p.z + y_row.w,
        z_row.x * p.x + z_row.y * p.y + z_row.z * p.z + z_row.w,
    );
}

fn project(system: SystemFrame, in_system: vec3<f32>) -> Projected {
    let world = transform(
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
        in_system,
    );
    let view = transform(
        frame.view_from_world_x, frame.view_from_world_y, frame.view_from_world_z, world,
    );
    let scale = frame.focal_px * reciprocal(max_exact(view.z, frame.near));
    return Projected(
        frame.center_x_px + view.x * scale,
        frame.center_y_px - view.y * scale,
        view.z,
        scale,
    );
}

fn add_channel(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&light_high[at], 1u);
    }
}

fn add_light(x: i32, y: i32, color: vec3<f32>, weight: f32) {
    let at = (u32(y) * frame.width + u32(x)) * 3u;
    add_channel(at, steps_of(color.x * weight));
    add_channel(at + 1u, steps_of(color.y * weight));
    add_channel(at + 2u, steps_of(color.z * weight));
}

// A disc swept along a segment: `major` is the axis on which the segment is longer.
struct Capsule {
    start_major: f32,
    start_minor: f32,
    along_major: f32,
    along_minor: f32,
    // 1 / length squared, 0 for a disc at rest.
    inverse_length_squared: f32,
    // Reach of the outermost covered pixel centre, across the segment and along the minor axis.
    reach: f32,
    minor_reach: f32,
    slope: f32,
}

// How much of the pixel at (major, minor) the capsule covers, 0 to 1.
fn weight_at(capsule: Capsule, major: i32, minor: i32) -> f32 {
    let dx = f32_of_i32(major) + 0.5f - capsule.start_major;
    let dy = f32_of_i32(minor) + 0.5f - capsule.start_minor;
    let along = (dx * capsule.along_major + dy * capsule.along_minor)
        * capsule.inverse_length_squared;
    let t = clamp_exact(along, 0.0f, 1.0f);
    let ex = dx - t * capsule.along_major;
    let ey = dy - t * capsule.along_minor;
    let distance = square_root(ex * ex + ey * ey);
    return clamp_exact(capsule.reach - distance, 0.0f, 1.0f);
}

// First and one past the last pixel whose centre is within the reach, on the minor axis.
fn minor_range(capsule: Capsule, major: i32) -> vec2<i32> {
    let middle = capsule.start_minor
        + (f32_of_i32(major) + 0.5f - capsule.start_major) * capsule.slope;
    return vec2<i32>(
        to_i32(middle - capsule.minor_reach),
        to_i32(middle + capsule.minor_reach) + 1,
    );
}

// The radius whose edge, one pixel wide, gives the area of a disc of `radius_px`: such an edge adds
// 1/12 to the square of the radius. At least half a pixel.
fn edged_radius(radius_px: f32) -> f32 {
    return max_exact(square_root(max_exact(radius_px * radius_px - 0.0833333333f, 0.0f)), 0.5f);
}

fn splat_capsule(
    start: Projected, end: Projected, radius_px: f32, reach: f32, color: vec3<f32>,
    conserved: bool,
) {
    let dx = end.x - start.x;
    let dy = end.y - start.y;
    let steep = less(abs(dx), abs(dy));
    let length_squared = dx * dx + dy * dy;
    let along_major = select(dx, dy, steep);
    let along_minor = select(dy, dx, steep);
    let inverse_length = inverse_square_root(length_squared);
    let moves = less(0.0001f, length_squared);
    let slope = select(0.0f, along_minor * reciprocal(along_major), moves);
    let capsule = Capsule(
        select(start.x, start.y, steep),
        select(start.y, start.x, steep),
        along_major,
        along_minor,
        select(0.0f, inverse_length * inverse_length, moves),
        reach,
        reach * square_root(1.0f + slope * slope),
        slope,
    );
    let end_major = capsule.start_major + select(0.0f, along_major, moves);
    let major_size = i32(select(frame.width, frame.height, steep));
    let minor_size = i32(select(frame.height, frame.width, steep));
    let first = to_i32(min_exact(capsule.start_major, end_major) - reach);
    let last = to_i32(max_exact(capsule.start_major, end_major) + reach) + 1;

    var gain = 1.0f;
    let conserves = conserved || !moves;
    // Else the sum would lack what is cut off.
    let guarded = -GUARD_PX <= first && last <= major_size + GUARD_PX;
    if (moves && (conserved || guarded)) || (!moves && less(radius_px, LARGE_RADIUS_PX)) {
        var sum = 0.0f;
        let guarded_last = min(last, major_size + GUARD_PX);
        for (var major = max(first, -GUARD_PX); major < guarded_last; major += 1) {
            let range = minor_range(capsule, major);
            for (var minor = range.x; minor < range.y; minor += 1) {
                sum += weight_at(capsule, major, minor);
            }
        }
        // A streak that is not conserved has the area it sweeps, a line's at least a pixel wide.
        let broad_px = select(max_exact(radius_px, 0.5f), radius_px, conserves);
        let swept = select(2.0f * broad_px * (length_squared * inverse_length), 0.0f, conserves);
        let scaled = (PI * broad_px * broad_px + swept) * reciprocal(sum);
        let half = 0.5f * LARGE_RADIUS_PX;
        let share = clamp_exact((radius_px - half) * 0.5f, 0.0f, 1.0f);
        gain = select(scaled + share * (1.0f - scaled), scaled, moves);
    }
    let drawn_last = min(last, major_size);
    for (var major = max(first, 0); major < drawn_last; major += 1) {
        let range = minor_range(capsule, major);
        let minor_last = min(range.y, minor_size);
        for (var minor = max(range.x, 0); minor < minor_last; minor += 1) {
            let weight = weight_at(capsule, major, minor) * gain;
            if less(0.0f, weight) {
                add_light(select(major, minor, steep), select(minor, major, steep), color, weight);
            }
        }
    }
}

// A disc at rest whose edge reaches at most 1.5 pixels covers nothing but the nine pixels around
// its centre's: no loops, and each weight is computed once.
fn splat_small_disc(center: Projected, radius_px: f32, reach: f32, color: vec3<f32>) {
    let left = to_i32(center.x) - 1;
    let top = to_i32(center.y) - 1;
    var weights: array<f32, 9>;
    var sum = 0.0f;
    for (var at = 0; at < 9; at += 1) {
        let dx = f32_of_i32(left + at % 3) + 0.5f - center.x;
        let dy = f32_of_i32(top + at / 3) + 0.5f - center.y;
        let distance = square_root(dx * dx + dy * dy);
        let weight = clamp_exact(reach - distance, 0.0f, 1.0f);
        weights[at] = weight;
        sum += weight;
    }
    let gain = PI * radius_px * radius_px * reciprocal(sum);
    for (var at = 0; at < 9; at += 1) {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at] * gain;
        if less(0.0f, weight) && x >= 0 && y >= 0 && x < i32(frame.width) && y < i32(frame.height) {
            add_light(x, y, color, weight);
        }
    }
}

// How much of the unit interval from `pixel` lies within [low, high].
fn overlap(pixel: i32, low: f32, high: f32) -> f32 {
    let left = f32_of_i32(pixel);
    return clamp_exact(min_exact(left + 1.0f, high) - max_exact(left, low), 0.0f, 1.0f);
}

fn splat_rectangle(center: Projected, half_px: f32, color: vec3<f32>) {
    let left = center.x - half_px;
    let right = center.x + half_px;
    let top = center.y - half_px;
    let bottom = center.y + half_px;
    let last_y = min(to_i32(bottom) + 1, i32(frame.height));
    let last_x = min(to_i32(right) + 1, i32(frame.width));
    for (var y = max(to_i32(top), 0); y < last_y; y += 1) {
        let tall = overlap(y, top, bottom);
        for (var x = max(to_i32(left), 0); x < last_x; x += 1) {
            add_light(x, y, color, tall * overlap(x, left, right));
        }
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    let position_bits = particles[at].position_and_index;
    let velocity_bits = particles[at].velocity_and_birth;
    let slot = slot_of(velocity_bits.w);
    let age = age_of(velocity_bits.w, frame.frame);
    let birth_frame = frame.frame - age;
    let system = system_at(slot);
    let who = Identity(system.key, birth_frame, position_bits.w);
    let row = row_at(row_index(slot, birth_frame, frame.row_mask));
    let look = appearance_of(who, row, age + 1u);
    let kinds = row.kinds;

    let position = bitcast<vec3<f32>>(position_bits.xyz);
    let start = project(system, position);
    var end = start;
    if STREAKS && kinds.y == PARTICLE_STREAK {
        let velocity = bitcast<vec3<f32>>(velocity_bits.xyz);
        end = project(system, position + velocity * frame.shutter);
    }
    if less(start.depth, frame.near) || less(end.depth, frame.near) {
        return;
    }
    let radius_px = min_exact(look.size * start.scale, MOST_RADIUS_PX);
    let reach = radius_px + 2.0f;
    let width = f32_of_i32(i32(frame.width));
    let height = f32_of_i32(i32(frame.height));
    if less(max_exact(start.x, end.x) + reach, 0.0f)
        || less(max_exact(start.y, end.y) + reach, 0.0f)
        || less(width, min_exact(start.x, end.x) - reach)
        || less(height, min_exact(start.y, end.y) - reach) {
        return;
    }
    let color = look.color * (1.0f - look.transparency);
    if RECTANGLES && kinds.y == PARTICLE_RECTANGLE {
        splat_rectangle(start, radius_px, color);
        return;
    }
    // A streak of full light is a line of its own width, or a pixel's.
    let conserved = kinds.y != PARTICLE_STREAK || kinds.z != STREAK_CONSTANT;
    let broad_px = max_exact(radius_px, 0.5f);
    let edge = select(broad_px, edged_radius(radius_px), conserved) + 0.5f;
    if kinds.y != PARTICLE_STREAK && less(edge, SMALL_REACH_PX) {
        splat_small_disc(start, radius_px, edge, color);
    } else {
        splat_capsule(start, end, radius_px, edge, color, conserved);
    }
}
