// How much of its grain is at a place of wood, or of what else has some.
//
// Perry 1994, 4.4: what holds for a surface may differ from place to place, as in wood.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/grain.rs.
#define_import_path motes::grain

#import motes::exact::{dot3, floor_exact, less, square_root}
#import motes::layout::{GRAIN_NONE, GRAIN_RINGS}
#import motes::noise::noise

// 0 where there is none, 1 where it is densest. Slabs across the direction are half and half; rings
// around it, through the origin, get denser and less dense.
fn grain_at(kind: u32, key: u32, grain: vec4<f32>, shape: vec4<f32>, place: vec3<f32>) -> f32 {
    if kind == GRAIN_NONE {
        return 0.0f;
    }
    let along = dot3(place, grain.xyz);
    let across = place - grain.xyz * along;
    let is_ring = kind == GRAIN_RINGS;
    let far = select(along, square_root(dot3(across, across)), is_ring);
    let phase = far * grain.w + noise(place * shape.z, key).w * shape.y;
    let part = phase - floor_exact(phase);
    let slab = select(1.0f, 0.0f, less(part, 0.5f));
    return select(slab, abs(part * 2.0f - 1.0f), is_ring);
}
