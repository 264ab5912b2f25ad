// shade: how much of the light comes to each cell of the box, through those before it.
//
// Reeves 1983, 5; what is left of light falls with e to the power of what it has passed (Bouguer). One
// invocation a column of cells along the light, from where it comes. Reads: shade_box, shade_sums. Writes:
// shade_light (0 to 1, as bits).
// Invariant: half of what a cell takes is before its middle.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32}
#import motes::layout::ShadeBox
#import motes::transcendental::exp2_exact

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// More counts as that.
const MOST_TAKEN: u32 = 4194304u;
// Half a 65,536th of the logarithm of e to the base 2, below 0.
const EXPONENT_STEP: f32 = -0.000011006889508f;

@group(0) @binding(0) var<uniform> shade_box: ShadeBox;
@group(0) @binding(1) var<storage, read> shade_sums: array<u32>;
@group(0) @binding(2) var<storage, read_write> shade_light: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn shade(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let column = linear_index(global_id, WORKGROUP_SIZE);
    let cells = shade_box.kinds.x;
    if column >= cells * cells {
        return;
    }
    var taken = 0u;
    for (var layer = 0u; layer < cells; layer += 1u) {
        let place = layer * cells * cells + column;
        let own = min(shade_sums[place], MOST_TAKEN);
        // Twice what is taken before the middle.
        let twice = min(2u * taken + own, 2u * MOST_TAKEN);
        shade_light[place] = bits_of(exp2_exact(f32_of_u32(twice) * EXPONENT_STEP));
        taken = min(taken + own, MOST_TAKEN);
    }
}
