// deposit: how much of the light each part of a cloud takes, in the cells of a box along the light.
//
// Reeves 1983, 5: clouds throw shadows on themselves. One invocation a particle of one page: what it takes
// of the light that falls on its cell's cross-section, to the eight cells around it.
// Reads: frame, shade_box, system_frames, rows, counts, particles. Writes: shade_sums (65,536ths, by atomic
// adds).
// Invariant: sums are of integers, so they do not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, less, min_exact, to_u32}
#import motes::layout::{Counts, Frame, Particle, ROW_LIT_CLOUD, ROW_OVER, ROW_SOFTNESS_SHIFT, ShadeBox, SystemFrame, SystemRow}
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}
#import motes::projection::world_of
#import motes::shade::{around, corner_share, depth_of, is_cell}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const RATE_SPREADS: bool = #{RATE_SPREADS};

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> shade_box: ShadeBox;
@group(0) @binding(2) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(3) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(4) var<storage, read> counts: Counts;
@group(0) @binding(5) var<storage, read> particles: array<Particle>;
@group(0) @binding(6) var<storage, read_write> shade_sums: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn deposit(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let age = age_of(birth, frame.frame);
    let row = rows[row_index(slot, frame.frame - age, frame.row_mask)];
    if (row.kinds.w & ROW_OVER) == 0u || (row.kinds.w & ROW_LIT_CLOUD) == 0u {
        return;
    }
    let system = system_frames[slot];
    let who = Identity(system.key, frame.frame - age, particle.position_and_index.w);
    let look = appearance_of(who, row, age + 1u, RATE_SPREADS);
    let depth = depth_of(look.size, 1.0f - look.transparency, row.kinds.w >> ROW_SOFTNESS_SHIFT, shade_box);
    let near = around(shade_box, world_of(system, bitcast<vec3<f32>>(particle.position_and_index.xyz)));
    for (var corner = 0u; corner < 8u; corner += 1u) {
        let cell = near.cell + vec3<i32>(vec3<u32>(corner, corner >> 1u, corner >> 2u) & vec3<u32>(1u));
        if is_cell(shade_box, cell) {
            let share = depth * corner_share(near.part, corner);
            let place = (u32(cell.z) * shade_box.kinds.x + u32(cell.y)) * shade_box.kinds.x + u32(cell.x);
            atomicAdd(&shade_sums[place], to_u32(share * 65536.0f + 0.5f));
        }
    }
}
