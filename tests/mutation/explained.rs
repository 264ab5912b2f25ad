//! Changes that make no difference that a comparison could see, and why.

/// Kernel (`*`: any), description (a `*` stands for anything), reason.
type Explanation = (&'static str, &'static str, &'static str);

#[rustfmt::skip] // one explanation a line
static EXPLAINED: &[Explanation] = &[
    ("*", "*: ? = Bool(false) -> omitted", "one branch of a short circuit: variables begin as false"),
    ("systems/births", "const WORKGROUP_SIZE: 256u -> *", "named for the attribute alone, which was read before the change"),
    ("scan/count_bits", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 17 billion particles"),
    ("scan/sum_runs", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 10^12 particles"),
    ("scan/spread_runs", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 10^12 particles"),
    ("scan/spread_bits", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 17 billion particles"),
    ("draw/large_work", "const WORKGROUP_SIZE: 256u -> 255u", "a few workgroups too many, and invocations bound their own index"),
    ("systems/births", "births: (slot >= frame.system_count) -> Greater", "one count more than there are systems, which nothing reads; checked kernels do not write it"),
    ("systems/offsets", "offsets: 0u -> 4294967295u in select(0u, (end - first_birth), (end > first_birth))", "rounding up to workgroups wraps it to none"),
    ("systems/offsets", "offsets: 0u -> 4294967295u in select(0u, (((end - start) + 31u) / 32u), (end > start))", "rounding up to workgroups wraps it to none"),
    ("systems/offsets", "offsets: (end > first_birth) -> GreaterEqual", "where they are equal, their difference is the 0 that was selected"),
    ("systems/offsets", "offsets: (end > start) -> GreaterEqual", "where they are equal, their difference is the 0 that was selected"),
    ("particles/cull", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 268 million particles a page"),
    ("particles/cull", "cull: (first >= page_end) -> Greater", "one word more, of no particles: 0 bits that nothing reads"),
    ("particles/cull", "const DIES_OF_BOUNDS: 3u -> 4u", "a code that has to differ from the others, and does"),
    ("particles/cull", "const LIVES: 0u -> 4294967295u", "a code that has to differ from the others, and does"),
    ("particles/cull", "is_out_of_bounds: ? = is_out -> omitted", "it still has the turn before's, which is is_out"),
    ("particles/cull", "fate_of: 0.0f -> -1.0f", "no threshold is -1, and no intensity is below it either"),
    ("scan/spread_bits", "spread_bits: (first + 64u) -> Subtract", "the first run wraps to the end of all and spreads all words in order, the others have none left"),
    ("scan/spread_bits", "spread_bits: (first >= words) -> Greater", "one run more, of no words"),
    ("scan/spread_bits", "spread_bits: 64u -> 65u in (first + 64u)", "the next run's first word, with the value that it gets there, too"),
    ("scan/spread_bits", "spread_bits: Min((first + 64u), words) -> not Min", "words beyond the last, which nothing reads"),
    ("scan/spread_runs", "spread_runs: (first >= sums) -> Greater", "one run more, of no sums"),
    ("scan/spread_runs", "spread_runs: 64u -> 65u in (first + 64u)", "the next run's first sum, with the value that it gets there, too"),
    ("scan/spread_runs", "spread_runs: (first + 64u) -> Subtract", "the first run wraps to the end of all and spreads all sums in order, the others have none left"),
    ("scan/sum_runs", "sum_runs: (first >= sums) -> Greater", "one run more, of no sums: a 0 that nothing reads"),
    ("scan/pages", "pages: 0u -> 4294967295u in select(0u, present, ?)", "rounding up to workgroups wraps it to none"),
    ("draw/large_work", "const WORKGROUP_SIZE: 256u -> 257u", "a workgroup less, from 257 large particles a page on"),
    ("draw/splat", "draw_small_disc: 0.0f -> -1.0f", "of the comparison: a weight of 0 adds no light"),
    ("digest/digest", "digest_records: (start < end) -> LessEqual", "the sum over no records is 0, and adding it changes nothing"),
    ("lib/footprint", "footprint_of: Min(across, Uint(_.minor_size)) -> not Min", "decides only who draws: one invocation or many, the same light"),
    ("lib/footprint", "span: 0i -> -1i in Clamp((last - first), 0i, LONGEST_PX)", "of rows outside of the picture, where nothing is drawn"),
    ("lib/footprint", "gain_of: (minor < range.1) -> LessEqual", "a pixel more, beyond the reach: its weight is 0"),
    ("lib/footprint", "footprint_of: Bool(false) -> Bool(true)", "of the eye, for what is at rest: a way of no length has no lateness"),
    ("lib/footprint", "footprint_of: shape.gain -> member early", "a square's gain, whose weights need none"),
    ("lib/footprint", "const FEW_CELLS: 2048u -> 2047u", "tells only on footprints of 2,048 cells, and there by the last bit of a sum"),
    ("lib/footprint", "const FEW_CELLS: 2048u -> 2049u", "tells only on footprints of 2,049 cells, and there by the last bit of a sum"),
    ("lib/footprint", "gain_of: (major < last) -> LessEqual", "one row more, beyond the reach: its weights are 0"),
    ("lib/footprint", "is_visible: end.x -> member y", "looks at more of what is outside and covers nothing; only a streak from beyond a corner would tell"),
    ("lib/footprint", "is_visible: end.y -> member depth", "depths are never negative: looks at more of what is outside and covers nothing"),
    ("lib/footprint", "is_visible: start.y -> member depth", "depths are never negative: looks at more of what is outside and covers nothing"),
    ("lib/footprint", "is_visible: 2.0f -> 4.0f in (radius_px + 2.0f)", "looks at more of what is outside and covers nothing"),
    ("lib/footprint", "is_visible: ? = less() -> omitted", "looks at more of what is outside and covers nothing"),
    ("lib/footprint", "square_weight_at: shape.reach -> member minor_reach", "a square's sides are the axes: the two are the same"),
    ("lib/footprint", "footprint_of: shape.gain = 1.0f -> omitted", "a square's, whose weights need none; others get theirs later"),
    ("lib/footprint", "footprint_of: 1.0f -> 2.0f", "a square's gain, whose weights need none"),
    ("lib/footprint", "footprint_of: 1.0f -> -1.0f", "a square's gain, whose weights need none"),
    ("lib/footprint", "const SQUARE: 2u -> 3u", "a code that has to differ from the others, and does"),
    ("lib/footprint", "footprint_of: shape.kind = SMALL_DISC -> omitted", "its code is 0, which variables begin as"),
    ("lib/footprint", "footprint_of: shape.last -> member minor_size", "of the number of cells, which decides only who draws: the same light"),
    ("lib/footprint", "footprint_of: shape.cells = *", "decides only who draws: one invocation or many, the same light"),
    ("lib/footprint", "const MOST_RADIUS_PX: 16384.0f -> 32768.0f", "four times the largest picture or eight times, it is all covered"),
    ("lib/footprint", "footprint_of: -16777216i -> *", "rows that far are far from every picture"),
    ("lib/footprint", "minor_range: 1i -> 2i in (to_i32() + 1i)", "a pixel more, beyond the reach: its weight is 0"),
    ("lib/footprint", "gain_of: (cells <= FEW_CELLS) -> Less", "tells only on footprints of 2,048 cells, and there by the last bit of a sum"),
    ("lib/footprint", "footprint_of: 0.0f -> -1.0f in select(0.0f, (inverse_length * inverse_length), moves)", "of a footprint at rest, whose way along itself is 0 whatever it is multiplied by"),
    ("lib/footprint", "gain_of: 1.0f -> 2.0f", "of a clamp: radii for which it would matter have been left before"),
    ("lib/footprint", "gain_of: ? = LogicalNot(less()) -> omitted", "the share of a large disc is 1, and so is its gain in the end"),
    ("lib/footprint", "const LARGE_RADIUS_PX: 4.0f -> 8.0f", "the share of a disc between them is 1, and so is its gain in the end"),
    ("lib/footprint", "const SMALL_DISC: 0u -> 4294967295u", "a code that has to differ from the others, and does"),
    ("lib/footprint", "footprint_of: shape.reach -> member minor_reach", "of what is at rest the two are the same; else a row more, whose weights are 0"),
    ("lib/footprint", "footprint_of: 0.0f -> * in select(0.0f, select(dx, dy, steep), moves)", "of a footprint at rest, which has no way: at most a row more, whose weights are 0"),
    ("lib/footprint", "footprint_of: 0.0f -> * in select(0.0f, select(dy, dx, steep), moves)", "of a footprint at rest, which has no way: at most a row more, whose weights are 0"),
    ("lib/footprint", "footprint_of: 0.0f -> 1.0f in select(0.0f, (inverse_length * inverse_length), moves)", "of a footprint at rest, whose way along itself is 0 whatever it is multiplied by"),
    ("lib/footprint", "const FARTHEST_PX: *", "rows that far are far from every picture"),
    ("lib/footprint", "const LONGEST_PX: *", "spans that long have too many cells for one invocation, however they are counted"),
    ("lib/footprint", "footprint_of: Bool(true) -> Bool(false)", "a square is the same along both axes"),
    ("lib/footprint", "footprint_of: ? = Bool(true) -> omitted", "a square is the same along both axes"),
    ("lib/footprint", "span: 0i -> 1i in Clamp((last - first), 0i, LONGEST_PX)", "of the number of cells, which decides only who draws: the same light"),
    ("lib/footprint", "footprint_of: shape.kind -> member cells", "of a small disc, whose kind and number of cells are both 0"),
    ("lib/footprint", "minor_range: 0.5f -> 1.0f in (f32_of_i32() + 0.5f)", "pixels count by their centres, half a pixel inside: what the range loses has no weight"),
    ("lib/footprint", "footprint_of: (span() * Min(across, Uint(_))) -> Add", "of the number of cells, which decides only who draws: the same light"),
    ("lib/footprint", "footprint_of: shape.first -> member last", "of the number of cells, which decides only who draws; or of the first row, which becomes the picture's edge"),
    ("lib/footprint", "footprint_of: shape.first = Max(first, 0i) -> omitted", "begins at the picture's edge instead: before the reach, weights are 0"),
    ("lib/footprint", "footprint_of: shape.minor_size -> member first", "of the number of cells, which decides only who draws: the same light"),
    ("lib/footprint", "is_visible: 0.0f -> 1.0f", "a pixel less of a margin of two, where nothing is covered"),
    ("lib/footprint", "is_visible: 0.0f -> -1.0f", "a pixel more of a margin of two, where nothing is covered"),
    ("lib/emission", "axis_of: axis = up -> omitted", "an axis of zeros becomes up in the end"),
    ("lib/sprite", "sprite_of: Bool(false) -> Bool(true)", "of a feature that is off, and kernels that leave out nothing have them all"),
    ("lib/sprite", "sprite_of: features.rectangles -> member spread_rates", "kernels that leave out nothing have all features"),
    ("lib/sprite", "sprite_of: features.streaks -> member rectangles", "kernels that leave out nothing have all features"),
    ("lib/sprite", "sprite_of: features.spread_rates -> member light_distances", "kernels that leave out nothing have all features"),
    ("lib/sprite", "sprite_of: features.light_distances -> member streaks", "kernels that leave out nothing have all features"),
    ("particles/advance", "advance: (at >= frame.page_len) -> Greater", "the first particle of the next page, whose own dispatch writes it again"),
    ("particles/emit", "birthplace: (place.3 < choice.0) -> LessEqual", "one draw of a face in 2^32"),
    ("particles/emit", "slot_of_birth: 1u -> 0u in ((high - low) > 1u)", "goes on when the slot is found, without changing it, until the bound on loops"),
    ("particles/emit", "slot_of_birth: ((high - low) > 1u) -> GreaterEqual", "goes on when the slot is found, without changing it, until the bound on loops"),
    ("particles/emit", "slot_of_birth: (high - low) -> Add", "goes on when the slot is found, without changing it, until the bound on loops"),
    ("particles/emit", "slot_of_birth: 0u -> 4294967295u", "begins one below the first slot, modulo 2^32, and the halving finds the first in its turn"),
    ("particles/cull", "cull: (of_intensity > 0u) -> GreaterEqual", "adding none changes nothing"),
    ("particles/cull", "cull: (of_bounds > 0u) -> GreaterEqual", "adding none changes nothing"),
    ("particles/cull", "cull: Bool(false) -> Bool(true)", "in a branch that the switch has closed"),
    ("particles/cull", "cull: (at - first) -> Add", "first is a multiple of 32, and shifts are counted modulo 32"),
    ("particles/cull", "fate_of: Bool(false) -> Bool(true)", "in a branch that the switch has closed"),
    ("particles/cull", "fate_of: ? = LogicalNot(less()) -> omitted", "no intensity is below a negative threshold either"),
    ("*", "draw_row: Bool(false) -> Bool(true)", "in a branch that the switch has closed"),
    ("*", "draw_row: weight = ZeroValue -> omitted", "assigned on both branches that follow"),
    ("*", "draw_row: minor = Max(range.0, 0i) -> omitted", "begins at the picture's edge instead: before the reach, weights are 0"),
    ("*", "draw_row: 0.0f -> -1.0f", "a weight of 0 adds no light"),
    ("draw/splat", "splat: Bool(false) -> Bool(true)", "in a branch that the switch has closed"),
    ("draw/splat", "splat: shape.7 -> member minor_reach", "of a disc at rest the two are the same"),
    ("draw/splat", "splat: shape.0 -> member cells", "a small disc's kind and number of cells are both 0; other footprints of none draw nothing"),
    ("draw/splat", "splat: (shape.16 <= FEW_CELLS) -> *", "decides only who draws: one invocation or many, the same light"),
    ("draw/splat", "splat: if (shape.16 <= FEW_CELLS) -> if !", "decides only who draws: one invocation or many, the same light"),
    ("draw/splat", "splat: shape.16 -> member kind", "decides only who draws: one invocation or many, the same light"),
    ("draw/splat", "splat: major = shape.13 -> omitted", "begins at the picture's edge instead: before the reach, weights are 0"),
    ("draw/splat", "layer_of: (at < frame.layer_plane_count) -> LessEqual", "a plane that is not there is zeros, behind which nothing is"),
    ("draw/splat", "draw_small_disc: Bool(false) -> Bool(true)", "of the first condition: a weight of 0 adds no light"),
    ("draw/splat", "layer_of: frame.layer_plane_count -> member layer", "planes after that of the layer drawn do not decide what is in it"),
    ("draw/splat", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: more than a page"),
    ("draw/splat_large", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 32,768 large particles"),
    ("draw/resolve", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: more than the largest picture"),
    ("digest/digest", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: more than a page"),
    ("probe/noise", "gradient_of: 8380416u -> 8380417u *", "keeps a bit that the shift has made 0"),
    ("probe/exact", "to_u32: (x > INTEGER_LIMIT) -> GreaterEqual", "at the limit both are the same"),
    ("probe/exact", "clamp_unit: (x > 1.0f) -> GreaterEqual", "at 1 both are the same"),
    ("probe/wind", "wind_of: has.octaves -> member curls", "the probe has all kinds of noise"),
    ("probe/wind", "wind_of: has.curls -> member *", "a curl that is made in vain is not taken"),
    ("particles/cull", "cull: particles[first].velocity_and_birth.3 -> member x", "an age that is too great has each particle looked at, with the same end"),
    ("particles/cull", "cull: particles[first].velocity_and_birth -> member position_and_index", "an age that is too great has each particle looked at, with the same end"),
    ("particles/cull", "cull: ? = (oldest < _.least_lifetime) -> omitted", "each particle is looked at, with the same end"),
    ("particles/cull", "cull: (end - first) -> Add", "first is a multiple of 32, and shifts are counted modulo 32"),
    ("particles/advance", "advance: ((ranks.1 >> bit) & 1u) -> InclusiveOr", "the dead go to the place of the next survivor: a race that drivers which run invocations in order, as those of the tests do, always decide well"),
    ("draw/resolve", "pixel_of: sums.more -> member low", "a sum that wrapped is below either of its parts"),
    ("lib/packed", "packed: *", "what of the steps is not packed, or too much of it, goes to the limbs: the sum stays"),
    ("lib/packed", "channels_of: 0u -> 1u *", "a channel that has nothing left is given nothing"),
    ("lib/packed", "channels_of: 4u -> 5u *", "a channel that has nothing left is given nothing"),
    ("draw/splat", "draw_small_disc: 5i -> 6i *", "no small disc covers so many"),
    ("draw/splat", "draw_small_disc: Min(* -> not Min", "no small disc covers more"),
    ("draw/splat", "draw_small_disc: 1i -> 2i *", "a column or line more, of which nothing is covered"),
    ("draw/splat", "draw_small_disc: (line < lines) -> LessEqual", "a line more, of which nothing is covered"),
    ("draw/splat", "draw_small_disc: 0.5f -> -0.5f in ((center*", "columns or lines more, of which nothing is covered"),
    ("draw/splat", "draw_small_disc: 0i -> -1i", "a column or line more, of which nothing is covered"),
    ("draw/unpack", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: pictures of more pixels"),
    ("draw/unpack", "unpack: (pixel >= (_.width * _.height)) -> Greater", "one pixel more, past the picture, which nothing reads"),
    ("probe/exact", "f32_of_i32: -16777216i -> * in (i < -16777216i)", "at the limit both are the same, and one beyond it rounds to it"),
    ("probe/exact", "f32_of_i32: -16777216i -> * in select(i, -16777216i, (i < -16777216i))", "one beyond the limit rounds to it"),
    ("probe/exact", "f32_of_i32: (i < -16777216i) -> LessEqual", "at the limit both are the same"),
    ("probe/exact", "f32_of_i32: 16777216i -> * in (raised > 16777216i)", "at the limit both are the same, and one beyond it rounds to it"),
    ("probe/exact", "f32_of_i32: 16777216i -> * in select(raised, 16777216i, (raised > 16777216i))", "one beyond the limit rounds to it"),
    ("probe/exact", "f32_of_i32: (raised > 16777216i) -> GreaterEqual", "at the limit both are the same"),
    ("probe/exact", "f32_of_u32: (u > EXACT_INTEGER_LIMIT) -> GreaterEqual", "at the limit both are the same"),
    ("probe/exact", "const EXACT_INTEGER_LIMIT: 16777216u -> 16777217u", "one beyond the limit rounds to it"),
    ("probe/exact", "to_i32: (whole < -1073741800.0f) -> LessEqual", "at the limit both are the same"),
    ("probe/exact", "to_i32: (raised > INTEGER_LIMIT) -> GreaterEqual", "at the limit both are the same"),
    ("probe/exact", "const SMALLEST_BITS: 729808896u -> 729808895u", "floats are snapped: none is left between 0 and the smallest"),
    ("probe/transcendental", "cube_root: 0.0f -> -1.0f", "between -1 and 0 it then gives next to nothing, which is snapped to 0 like all that is stored"),
    ("probe/transcendental", "const SQRT_HALF_BITS: *", "tells only of the root of a half and its neighbours, whose logarithm is the same both ways"),
    ("probe/wind", "wind_of: 0u -> 1u in select(0u, wind.kinds.1, (kind == WIND_CURL))", "a second noise that only a curl uses"),
    ("probe/wind", "wind_of: 0u -> 4294967295u in select(0u, wind.kinds.1, (kind == WIND_CURL))", "a second noise that only a curl uses"),
    ("probe/area", "screen_area_px: 0.0f -> -1.0f", "of what is below 0 the root is 0; rows above the picture of a sphere above it are beyond its reach"),
];

fn fits(explanation: &Explanation, kernel: &str, description: &str) -> bool {
    let (of, what, _) = explanation;
    let is_kernel = *of == "*" || *of == kernel;
    is_kernel
        && match what.split_once('*') {
            Some((start, end)) => {
                let rest = description.strip_prefix(start);
                rest.is_some_and(|rest| rest.ends_with(end))
            }
            None => description == *what,
        }
}

/// Why that change of that kernel makes no difference, where that is known.
pub(crate) fn reason(kernel: &str, description: &str) -> Option<&'static str> {
    let found = EXPLAINED.iter().find(|one| fits(one, kernel, description));
    found.map(|(_, _, reason)| *reason)
}

/// Explanations that fit none of these changes.
pub(crate) fn idle(changes: &[(&str, String)]) -> Vec<&'static str> {
    let fits_any =
        |one: &&Explanation| changes.iter().any(|(kernel, what)| fits(one, kernel, what));
    EXPLAINED
        .iter()
        .filter(|one| !fits_any(one))
        .map(|(_, what, _)| *what)
        .collect()
}
