// catch: which step of which flame is the first that meets a piece of a surface that does not burn.
//
// Perry 1994, 4.6: fire gets over to what is apart where flames' ways go through its faces. One
// invocation a step of a flame.
// Reads: flames, flame_steps, ring_spans, spread_pieces, spread_faces, spread_edges. Writes, by atomic
// maxima: catches (x, counted down, so that none is 0; the others are not written).
// Invariant: the first step of the first flame counts, whichever comes first here.

#import motes::dispatch::linear_index
#import motes::exact::{dot3, less, length3}
#import motes::layout::{FLAME_STEPS, Flame, SpreadEdge, SpreadFace, SpreadPiece}
#import motes::meet::{meeting, within_fire}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    flame_count: u32,
    pieces: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> flames: array<Flame>;
@group(0) @binding(1) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> ring_spans: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> spread_pieces: array<SpreadPiece>;
@group(0) @binding(4) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(5) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(6) var<storage, read_write> catches: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn catch_fire(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let flame = at / (FLAME_STEPS - 1u);
    if flame >= work.flame_count || flames[flame].look.w != 1u {
        return;
    }
    let first = flame * FLAME_STEPS + at % (FLAME_STEPS - 1u);
    let world_from = bitcast<vec3<f32>>(flame_steps[first].xyz);
    let world_to = bitcast<vec3<f32>>(flame_steps[first + 1u].xyz);
    for (var piece = 0u; piece < work.pieces; piece += 1u) {
        let own = spread_pieces[piece];
        // A ring that has begun has more points than one.
        if own.faces.y == 0u || ring_spans[own.faces.w].y > 0u {
            continue;
        }
        let from_here = within_fire(own, world_from);
        let to_there = within_fire(own, world_to);
        let away = to_there - own.ball.xyz;
        let reach = own.ball.w + length3(to_there - from_here);
        if less(reach * reach, dot3(away, away)) {
            continue;
        }
        for (var face = own.faces.x; face < own.faces.x + own.faces.y; face += 1u) {
            let met = meeting(
                spread_faces[face], spread_edges[3u * face].line, spread_edges[3u * face + 1u].line,
                spread_edges[3u * face + 2u].line, from_here, to_there,
            );
            if met.is_met {
                atomicMax(&catches[4u * piece], 0xffffffffu - at);
                break;
            }
        }
    }
}
