//! Changes that make no difference that a comparison could see, and why.

/// Kernel (`*`: any), description (a trailing `*`: what begins so), reason.
type Explanation = (&'static str, &'static str, &'static str);

#[rustfmt::skip] // one explanation a line
static EXPLAINED: &[Explanation] = &[
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
    ("particles/cull", "const THRESHOLDS: Bool(true) -> Bool(false)", "folded into its use before the change"),
    ("particles/cull", "const WORKGROUP_SIZE: 256u -> *", "moves the second row of workgroups, from invocation 8,388,608 on: 268 million particles a page"),
    ("particles/cull", "cull: (first >= page_end) -> Greater", "one word more, of no particles: 0 bits that nothing reads"),
    ("particles/cull", "survives: 0.0f -> -1.0f", "no threshold is -1, and no intensity is below it either"),
    ("*", "acceleration_at: 1u -> 0u in (frame.system_count == 1u)", "only the short cut of a lone system is lost"),
    ("*", "system_at: 1u -> 0u in (frame.system_count == 1u)", "only the short cut of a lone system is lost"),
    ("*", "row_at: 1u -> 0u in (frame.system_count == 1u)", "only the short cut of a lone row is lost"),
    ("scan/spread_runs", "spread_runs: (first + 64u) -> Subtract", "the first run wraps to the end of all and spreads all sums in order, the others have none left"),
    ("scan/sum_runs", "sum_runs: (first >= sums) -> Greater", "one run more, of no sums: a 0 that nothing reads"),
    ("draw/splat", "draw_small_disc: 0.0f -> -1.0f", "of the comparison: a weight of 0 adds no light"),
    ("draw/resolve", "byte_of: 0.0f -> -1.0f", "light is never negative"),
    ("digest/digest", "digest_records: (start < end) -> LessEqual", "the sum over no records is 0, and adding it changes nothing"),
    ("lib/footprint", "footprint_of: Min(across, Uint(_.minor_size)) -> not Min", "decides only who draws: one invocation or many, the same light"),
    ("lib/footprint", "gain_of: (major < last) -> LessEqual", "one row more, beyond the reach: its weights are 0"),
    ("lib/footprint", "is_visible: 0.0f -> -1.0f", "a pixel more of a margin of two, where nothing is covered"),
];

fn fits(explanation: &Explanation, kernel: &str, description: &str) -> bool {
    let (of, what, _) = explanation;
    let is_kernel = *of == "*" || *of == kernel;
    is_kernel
        && match what.strip_suffix('*') {
            Some(start) => description.starts_with(start),
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
