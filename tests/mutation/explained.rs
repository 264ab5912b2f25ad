//! Changes that make no difference that a comparison could see, and why.

/// Kernel (`*`: any), description (a trailing `*`: what begins so), reason.
type Explanation = (&'static str, &'static str, &'static str);

#[rustfmt::skip] // one explanation a line
static EXPLAINED: &[Explanation] = &[
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
