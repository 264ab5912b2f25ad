// book: where inserted control points and dropped flames go, which rings begin, and the frame's books.
//
// Last step of the prefix sums over insertions and flames, by one invocation, for runs are few. What
// does not fit are the last insertions, whole rings, and the last flames. A flame keeps its place until
// all that were dropped before it have gone out.
// Reads: due_ignitions, spread_pieces, catches, flame_runs. Writes: gap_runs (w: insertions before the run), drop_runs (y:
// flames before the run), spread_counts.
// Invariant: born + dropped = requested; live(f) = live(f-1) + born - died.

#import motes::layout::{Ignition, SpreadCounts, SpreadPiece}

struct Work {
    // Points that there is room for.
    room: u32,
    // Flames that there is room for while they burn, and places for them and for those that are out.
    flame_room: u32,
    places: u32,
    // Pieces that flames may light.
    pieces: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> due_ignitions: array<Ignition>;
@group(0) @binding(1) var<storage, read> flame_runs: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> gap_runs: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> drop_runs: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read_write> spread_counts: SpreadCounts;
@group(0) @binding(5) var<storage, read> spread_pieces: array<SpreadPiece>;
@group(0) @binding(6) var<storage, read> catches: array<vec4<u32>>;

@compute @workgroup_size(1)
fn book() {
    let before = spread_counts.total;
    let runs = (before + 31u) / 32u;
    var requested = 0u;
    var live = 0u;
    var died = 0u;
    var drops = 0u;
    for (var run = 0u; run < runs; run += 1u) {
        let sums = gap_runs[run];
        gap_runs[run].w = requested;
        drop_runs[run].y = drops;
        requested += countOneBits(sums.x);
        live += sums.y;
        died += sums.z;
        drops += drop_runs[run].x;
    }
    let inserted = min(requested, work.room - before);
    // The first of the due ignitions says how many points they have together.
    var due = due_ignitions[0].order.z;
    for (var piece = 0u; piece < work.pieces; piece += 1u) {
        due += select(0u, spread_pieces[piece].ring.x, catches[piece].x > 0u);
    }
    let ignites = due <= work.room - before - inserted;
    let ignited = select(0u, due, ignites);
    let flames = spread_counts.flames_total;
    let flame_count = (flames - spread_counts.flames_first + 31u) / 32u;
    var first = flames;
    var burning = 0u;
    var out = 0u;
    for (var run = 0u; run < flame_count; run += 1u) {
        let bits_and_out = flame_runs[run];
        if bits_and_out.x != 0u && burning == 0u {
            first = spread_counts.flames_first + 32u * run + firstTrailingBit(bits_and_out.x);
        }
        burning += countOneBits(bits_and_out.x);
        out += bits_and_out.y;
    }
    let dropped = min(drops, work.flame_room - (flames - first));
    // The oldest that are out lose their places to the newest.
    let marks = max(spread_counts.marks_first, max(flames + dropped, work.places) - work.places);
    spread_counts = SpreadCounts(
        before + inserted + ignited,
        live + inserted + ignited,
        requested + due,
        inserted + ignited,
        died,
        before,
        inserted,
        before + inserted,
        flames + dropped,
        first,
        drops,
        dropped,
        out,
        burning + dropped,
        marks,
        marks - spread_counts.marks_first,
    );
}
