// From the space of a system's particles to the world, and from there to the picture.
//
// Reeves 1983, 2.5 and 3: perspective or orthographic, when the frame begins and when the shutter
// closes, so that a streak has the motion of its system and of the camera in it.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/projection.rs.
#define_import_path motes::projection

#import motes::exact::{max_exact, reciprocal}
#import motes::layout::{FRAME_ORTHOGRAPHIC, Frame, SystemFrame}

// A point in pixels, its depth along the view axis, its squared distance from the eye, and the
// pixels that a world unit spans there.
struct Projected {
    x: f32,
    y: f32,
    depth: f32,
    distance_squared: f32,
    scale: f32,
}

fn transform(x_row: vec4<f32>, y_row: vec4<f32>, z_row: vec4<f32>, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        x_row.x * p.x + x_row.y * p.y + x_row.z * p.z + x_row.w,
        y_row.x * p.x + y_row.y * p.y + y_row.z * p.z + y_row.w,
        z_row.x * p.x + z_row.y * p.y + z_row.z * p.z + z_row.w,
    );
}

// From the space of the system's particles to world space, when the frame begins.
fn world_of(system: SystemFrame, in_system: vec3<f32>) -> vec3<f32> {
    return transform(
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
        in_system,
    );
}

fn seen_at(view: Frame, seen: vec3<f32>, focal_px: f32) -> Projected {
    let orthographic = (view.flags & FRAME_ORTHOGRAPHIC) != 0u;
    let nearing = focal_px * reciprocal(max_exact(seen.z, view.near));
    let scale = select(nearing, focal_px, orthographic);
    return Projected(
        view.center_x_px + seen.x * scale,
        view.center_y_px - seen.y * scale,
        seen.z,
        seen.x * seen.x + seen.y * seen.y + seen.z * seen.z,
        scale,
    );
}

// Where a world place is seen when the frame begins.
fn project(view: Frame, world: vec3<f32>) -> Projected {
    let seen = transform(
        view.view_from_world_x, view.view_from_world_y, view.view_from_world_z, world,
    );
    return seen_at(view, seen, view.focal_px);
}

// Where a place of the system is seen when the shutter closes: by then system and camera may have
// moved.
fn project_closing(view: Frame, system: SystemFrame, in_system: vec3<f32>) -> Projected {
    let world = transform(
        system.closing_world_from_system_x,
        system.closing_world_from_system_y,
        system.closing_world_from_system_z,
        in_system,
    );
    let seen = transform(
        view.closing_view_from_world_x,
        view.closing_view_from_world_y,
        view.closing_view_from_world_z,
        world,
    );
    return seen_at(view, seen, view.closing_focal_px);
}
