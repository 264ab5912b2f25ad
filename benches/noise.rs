//! What a sample of noise costs, beside a copy of the same bytes on the same adapter in the same
//! run: the simplex noise that wind is made of, and noise on a cubic lattice.
//!
//!     cargo bench --bench noise -- [ADAPTER] [SAMPLES] [REPEATS]

use motes::gpu;

fn main() {
    // Cargo hands `--bench` over as well.
    let mut words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"));
    let adapter = words.next().unwrap_or_else(|| "llvmpipe".into());
    let mut number = |default: u32| {
        let word = words.next().and_then(|word| word.parse().ok());
        word.unwrap_or(default)
    };
    let (samples, repeats) = (number(1_000_000), number(31));
    if let Err(e) = measure(&adapter, samples, repeats) {
        eprintln!("{e}");
        std::process::exit(3);
    }
}

fn measure(adapter: &str, samples: u32, repeats: u32) -> Result<(), Box<dyn std::error::Error>> {
    let device = gpu::open(adapter)?.ok_or("no such adapter")?;
    let yardsticks = ["bench/copy", "bench/noise_simplex", "bench/noise_lattice"];
    let mut times = yardsticks.map(|_| Vec::new());
    // Turn by turn, so that what else the machine does falls on all alike; the first is warm-up.
    for turn in 0..=repeats {
        for (yardstick, times) in yardsticks.iter().zip(&mut times) {
            let taken = device.yardstick_times(yardstick, samples, 256, 1)?;
            if turn > 0 {
                times.extend(taken);
            }
        }
    }
    println!("{samples} samples on {}", device.description.name);
    println!(
        "{:<24} {:>8} {:>8} {:>8} {:>8}",
        "ms", "median", "p10", "p90", "/ copy"
    );
    let mut copy_ms = f64::NAN;
    for (yardstick, mut times) in yardsticks.into_iter().zip(times) {
        times.sort_by(f64::total_cmp);
        let at = |part: f64| times[((times.len() - 1) as f64 * part).round() as usize];
        if copy_ms.is_nan() {
            copy_ms = at(0.5);
        }
        println!(
            "{yardstick:<24} {:8.2} {:8.2} {:8.2} {:8.2}",
            at(0.5),
            at(0.1),
            at(0.9),
            at(0.5) / copy_ms
        );
    }
    Ok(())
}
