//! What was measured with: the machine, the driver, the program.

use std::fs;
use std::time::{SystemTime, UNIX_EPOCH};

use super::record::{Record, SCHEMA};
use super::target::Target;

/// A record of this target, of now, without measurements.
pub(super) fn record_of(target: &Target) -> Record {
    let threads = std::thread::available_parallelism().map_or(0, |count| count.get() as u32);
    let began = SystemTime::now().duration_since(UNIX_EPOCH);
    let mut record = Record {
        schema: SCHEMA,
        motes: env!("CARGO_PKG_VERSION").to_owned(),
        commit: commit(),
        began_unix_secs: began.ok().map(|since| since.as_secs()),
        adapter: target.name().to_owned(),
        os: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        cpu: cpu_name().unwrap_or_default(),
        cpu_threads: threads,
        ..Record::default()
    };
    match target {
        Target::Cpu => {
            record.driver = format!("motes {}", env!("CARGO_PKG_VERSION"));
            record.backend = "cpu".into();
            record.exact = true;
            record
                .options
                .insert("threads".into(), rayon::current_num_threads().to_string());
        }
        Target::Gpu(device) => {
            let description = &device.description;
            record.driver = description.driver.clone();
            record.backend = description.backend.clone();
            record.exact = description.exact;
            record.options.insert("workgroup_size".into(), "256".into());
        }
    }
    if cfg!(debug_assertions) {
        record
            .warnings
            .push("this program was built without optimisation: `cargo build --release`".into());
    }
    record
}

/// The commit that the program was built from, if whoever built or runs it says so in the variable
/// `MOTES_COMMIT`.
fn commit() -> Option<String> {
    let told = std::env::var("MOTES_COMMIT").ok();
    let built = option_env!("MOTES_COMMIT").map(str::to_owned);
    told.or(built).filter(|commit| !commit.trim().is_empty())
}

/// The processor's name, where the system tells it.
fn cpu_name() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
