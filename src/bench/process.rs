//! What the process has used of the machine, where the system tells it in `/proc` (Linux).

use std::fs;

/// Ticks a second of the times in `/proc`: the same on every Linux, whatever the kernel's own.
const TICKS_PER_SEC: f64 = 100.0;

/// Processor time of all threads so far, in user and in system mode, seconds.
pub(super) fn cpu_seconds() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // The name, in parentheses, may hold anything; the state follows it.
    let (_, rest) = text.rsplit_once(')')?;
    let mut fields = rest.split_ascii_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS_PER_SEC)
}

/// Most bytes of memory that the process has held since [`forget_peak`], or its start; 0 where the
/// system does not say.
pub(super) fn peak_memory_bytes() -> u64 {
    let field = || {
        let text = fs::read_to_string("/proc/self/status").ok()?;
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
        line.trim()
            .trim_end_matches("kB")
            .trim()
            .parse::<u64>()
            .ok()
    };
    field().unwrap_or(0) * 1024
}

/// Counts the peak from now on, where the system can.
pub(super) fn forget_peak() {
    // Where it cannot, the peak is that of the whole process, which is no lie.
    let _ = fs::write("/proc/self/clear_refs", "5");
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn work_takes_processor_time_and_memory_is_seen() {
        let before = cpu_seconds().expect("Linux tells");
        let begun = std::time::Instant::now();
        let mut sum = 0u64;
        while begun.elapsed().as_secs_f64() < 0.2 {
            sum = std::hint::black_box(sum.wrapping_mul(3) + 1);
        }
        let used = cpu_seconds().expect("Linux tells") - before;
        // A machine with other work gives less than it takes.
        assert!(used > 0.01 && used < 60.0, "{used}");
        let small = peak_memory_bytes();
        let block = std::hint::black_box(vec![1u8; 64 << 20]);
        assert!(peak_memory_bytes() >= small.max(64 << 20), "{small}");
        drop(block);
    }
}
