// How many flames a control point drops on its way, and how far it has come since the last.
//
// Perry 1994, 3.4: a point that has come as far as d_d drops a flame and counts anew. To the letter that
// is one flame at most in a step, and what the point has come beyond d_d is lost; carried on, it counts,
// and a long step drops several.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/drops.rs.
#define_import_path motes::drops

#import motes::exact::{less, snap}
#import motes::layout::{SPREAD_CARRIES, SpreadFrame}

// Flames that a point drops in one step at most.
const MOST_DROPS: u32 = 64u;

// How many flames a point drops that has come so far since the last.
fn drops_of(spread: SpreadFrame, come: f32) -> u32 {
    let most = select(1u, MOST_DROPS, (spread.kinds.y & SPREAD_CARRIES) != 0u);
    var rest = come;
    var drops = 0u;
    while drops < most && !less(rest, spread.distances.y) {
        rest = snap(rest - spread.distances.y);
        drops += 1u;
    }
    return drops;
}

// How far a point has come since the last flame when it has dropped so many.
fn rest_of(spread: SpreadFrame, come: f32, drops: u32) -> f32 {
    if drops > 0u && (spread.kinds.y & SPREAD_CARRIES) == 0u {
        return 0.0f;
    }
    var rest = come;
    for (var at = 0u; at < drops; at += 1u) {
        rest = snap(rest - spread.distances.y);
    }
    return rest;
}
