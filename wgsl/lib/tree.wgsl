// Systems that bear systems: where each is, and what it has from those before it.
//
// Reeves 1983, 2.6: particles may be particle systems; what transforms a parent transforms all of
// its descendants, and a child's parameters are chosen around those of its kind.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/tree/mod.rs.
#define_import_path motes::tree

#import motes::exact::{f32_of_u32, snap4}
#import motes::rng::{pcg4d, signed4}

// Streams of a system's hash: its key, and what it has of its own.
const STREAM_SYSTEM: u32 = 0x73797374u;
const STREAM_OWN: u32 = 0x6f776e00u;

// A 3 x 4 matrix by its rows.
struct Rows {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

const IDENTITY_X: vec4<f32> = vec4<f32>(1.0f, 0.0f, 0.0f, 0.0f);
const IDENTITY_Y: vec4<f32> = vec4<f32>(0.0f, 1.0f, 0.0f, 0.0f);
const IDENTITY_Z: vec4<f32> = vec4<f32>(0.0f, 0.0f, 1.0f, 0.0f);

// The identity if `is_identity`, else these.
fn rows_unless(is_identity: bool, rows: Rows) -> Rows {
    return Rows(
        snap4(select(rows.x, IDENTITY_X, is_identity)),
        snap4(select(rows.y, IDENTITY_Y, is_identity)),
        snap4(select(rows.z, IDENTITY_Z, is_identity)),
    );
}

fn composed_row(outer: vec4<f32>, inner: Rows) -> vec4<f32> {
    let row = inner.x * outer.x + inner.y * outer.y + inner.z * outer.z;
    return snap4(vec4<f32>(row.xyz, row.w + outer.w));
}

// First `inner`, then `outer`.
fn composed(outer: Rows, inner: Rows) -> Rows {
    return Rows(
        composed_row(outer.x, inner), composed_row(outer.y, inner), composed_row(outer.z, inner),
    );
}

// A place that has gone on for `frames` frames, on the parabola of its acceleration.
fn gone_on(place: Rows, velocity: vec4<f32>, acceleration: vec4<f32>, frames: f32) -> Rows {
    let way = velocity * frames + acceleration * (0.5f * frames * frames);
    return Rows(
        vec4<f32>(place.x.xyz, place.x.w + way.x),
        vec4<f32>(place.y.xyz, place.y.w + way.y),
        vec4<f32>(place.z.xyz, place.z.w + way.z),
    );
}

// Four numbers from -1 to 1 that the system of this key has for life.
fn own_numbers(key: u32, which: u32) -> vec4<f32> {
    return signed4(pcg4d(vec4<u32>(key, which, 0u, STREAM_OWN)));
}

// A polynomial of whole frames by its coefficients.
fn polynomial(c: vec4<f32>, frames: u32) -> f32 {
    let n = f32_of_u32(frames);
    return c.x + n * (c.y + n * (c.z + n * c.w));
}
