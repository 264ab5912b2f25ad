// dim: what covers leaves of the light of the surfaces behind it.
//
// One invocation a pixel. Reads: frame, cover_front. Reads and writes: surface_pixels (red, green,
// blue; what shows of what is behind is left to cover_bt).
// Invariant: a pixel depends on its own words alone.

#import motes::dispatch::linear_index
#import motes::exact::bits_of
#import motes::layout::Frame

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> cover_front: array<u32>;
@group(0) @binding(2) var<storage, read_write> surface_pixels: array<vec4<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn dim(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    let words = surface_pixels[pixel];
    let light = bitcast<vec3<f32>>(words.xyz) * bitcast<f32>(cover_front[pixel]);
    surface_pixels[pixel] = vec4<u32>(bits_of(light.x), bits_of(light.y), bits_of(light.z), words.w);
}
