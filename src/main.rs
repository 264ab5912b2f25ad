//! The command line program: parse, call, report.

use std::io::Write as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    // A panic is a defect of ours: it is told in one line, with the exit code of a failed machine.
    std::panic::set_hook(Box::new(|info| {
        // To nobody, if nobody reads it. A panic of wgpu's that is caught and answered is none of ours.
        if !motes::gpu::is_waiting() {
            let _ = writeln!(std::io::stderr(), "error: a defect in motes: {info}");
        }
    }));
    match std::panic::catch_unwind(motes::cli::main) {
        Ok(code) => ExitCode::from(code),
        Err(_) => ExitCode::from(3),
    }
}
