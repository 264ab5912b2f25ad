// caught: where the first step of a flame that meets a piece meets it.
//
// Perry 1994, 4.6. One invocation a piece.
// Reads: flame_steps, spread_pieces, spread_faces, spread_edges. Writes: catches (y: the face; z and w: x
// and y in its frame, as bits).
// Invariant: of several faces the nearest counts, of two as near the first.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, less}
#import motes::layout::{FLAME_STEPS, SpreadEdge, SpreadFace, SpreadPiece}
#import motes::meet::{meeting, within_fire}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    pieces: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> spread_pieces: array<SpreadPiece>;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(4) var<storage, read_write> catches: array<vec4<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn caught(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let piece = linear_index(global_id, WORKGROUP_SIZE);
    if piece >= work.pieces || catches[piece].x == 0u {
        return;
    }
    let own = spread_pieces[piece];
    let at = 0xffffffffu - catches[piece].x;
    let first = at / (FLAME_STEPS - 1u) * FLAME_STEPS + at % (FLAME_STEPS - 1u);
    let from_here = within_fire(own, bitcast<vec3<f32>>(flame_steps[first].xyz));
    let to_there = within_fire(own, bitcast<vec3<f32>>(flame_steps[first + 1u].xyz));
    var best = 2.0f;
    for (var face = own.faces.x; face < own.faces.x + own.faces.y; face += 1u) {
        let met = meeting(
            spread_faces[face], spread_edges[3u * face].line, spread_edges[3u * face + 1u].line,
            spread_edges[3u * face + 2u].line, from_here, to_there,
        );
        if met.is_met && less(met.share, best) {
            best = met.share;
            catches[piece] = vec4<u32>(
                catches[piece].x, face, bits_of(met.place.x), bits_of(met.place.y),
            );
        }
    }
}
