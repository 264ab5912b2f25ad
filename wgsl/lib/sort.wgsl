// What the passes of the sort share (wgsl/sort/): digits of 8 bits, runs of pairs.
// Twin of gpu/sort.rs.
#define_import_path motes::sort

// Pairs that an invocation takes.
const RUN: u32 = 512u;
// Values of a digit.
const DIGITS: u32 = 256u;

// Which bits of the keys a pass sorts by: those from `shift` on.
struct Digit {
    shift: u32,
}

fn digit_of(key: u32, digit: Digit) -> u32 {
    return (key >> digit.shift) & (DIGITS - 1u);
}

fn runs_of(count: u32) -> u32 {
    return (count + (RUN - 1u)) / RUN;
}
