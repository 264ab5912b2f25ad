//! A record as text for a terminal, at most [`COLUMNS`] wide.

use super::fits::{by_scene, fits};
use super::record::{Measure, Part, Record, Run};
use super::remarks;
use super::spread::Spread;
use super::units::{binary_bytes, digits, grouped, percent, prefixed, shortened};

/// No line is longer, characters.
pub const COLUMNS: usize = 100;

/// Characters of a pass's name.
const NAME: usize = 30;

/// The whole record: the adapter, the kernels alone, each run.
pub fn table(record: &Record) -> String {
    let mut text = heading(record);
    if !record.micro.is_empty() {
        text += &micro_table(record);
    }
    for run in &record.runs {
        text += &run_table(record, run);
    }
    text + &sweep_tables(record)
}

/// What scenes cost that were measured at three counts or more: `a` with nothing in it and so much each,
/// over the whole sweep, how far a count is off that line at most, and what each one more takes from one
/// count to the next. Each with a blank line before.
pub fn sweep_tables(record: &Record) -> String {
    let mut text = String::new();
    for (scene, runs) in by_scene(&record.runs) {
        let fits = fits(&runs);
        if fits.is_empty() {
            continue;
        }
        let rest = format!(", as a line over {} counts", runs.len());
        let title = shortened(scene, COLUMNS - rest.len()) + &rest;
        text += &format!(
            "\n{}\n{:<NAME$} {:>8} {:>9} {:>9} {:>21} {:>9}\n",
            shortened(&title, COLUMNS),
            "pass",
            "a, ms",
            "ns each",
            "off by",
            "from 10,000 on",
            "apart"
        );
        for fit in &fits {
            let indent = if fit.part.is_some() { "  " } else { "" };
            let name = indent.to_owned() + &shortened(&fit.name, NAME - indent.len());
            let steps = match fit.steps_ns {
                Some([least, most]) if least > 0.0 => {
                    format!("{} .. {}", digits(least), digits(most))
                }
                _ => "-".to_owned(),
            };
            let line = format!(
                "{name:<NAME$} {:>8} {:>9} {:>9} {steps:>21} {:>9}",
                digits(fit.a_ms),
                digits(fit.b_ns),
                percent(fit.off),
                fit.strays().map_or_else(|| "-".to_owned(), percent)
            );
            text += &(line + "\n");
        }
    }
    text
}

/// What was measured, and on what.
pub fn heading(record: &Record) -> String {
    let Record {
        adapter,
        driver,
        backend,
        ..
    } = record;
    let version = record.driver_version.as_deref().unwrap_or_default();
    let exact = if record.exact { "exact" } else { "not exact" };
    let threads = match record.cpu_threads {
        0 => String::new(),
        threads => format!("{threads} threads"),
    };
    let motes = match (record.motes.as_str(), &record.commit) {
        ("", _) => String::new(),
        (motes, Some(commit)) => format!("motes {motes} ({commit:.12})"),
        (motes, None) => format!("motes {motes} (commit unknown)"),
    };
    let options = record
        .options
        .iter()
        .map(|(key, value)| format!("{key} {value}"));
    let options: Vec<String> = options.collect();
    let rate = |rate: Option<f64>| rate.map_or("unknown".to_owned(), |it| digits(it) + " GB/s");
    let lines = [
        vec![adapter.as_str(), driver, version, backend, exact],
        vec![&motes, &record.os, &record.cpu, &threads],
        options.iter().map(String::as_str).collect(),
    ];
    let mut text = String::new();
    for line in lines {
        let parts: Vec<&str> = line.into_iter().filter(|part| !part.is_empty()).collect();
        if !parts.is_empty() {
            text += shortened(&parts.join(", "), COLUMNS).trim_end();
            text.push('\n');
        }
    }
    let dispatch = record.dispatch_ms.as_ref().map_or(String::new(), |ms| {
        format!("; an idle dispatch {} ms", digits(ms.median))
    });
    text += &format!(
        "copy by a kernel {}, by the interface {}{dispatch}\n",
        rate(record.copy_kernel_gb_per_s),
        rate(record.copy_buffer_gb_per_s)
    );
    text + &warnings(&record.warnings)
}

/// The kernels alone, with a blank line before.
pub fn micro_table(record: &Record) -> String {
    let mut text = format!("\n{}\n", head("kernels alone", ""));
    for measure in &record.micro {
        text += &line(measure, "", None);
        if let Some(note) = &measure.note {
            text += &format!("    {}\n", shortened(note.trim(), COLUMNS - 4));
        }
    }
    text + &warnings(&remarks::of_micro(record))
}

/// One run, with a blank line before.
pub fn run_table(record: &Record, run: &Run) -> String {
    let frame = run.frame_ms.median;
    // What a scene was changed by may be long: count and size are told whole.
    let room = COLUMNS.saturating_sub(titled("", run).chars().count());
    let title = titled(&shortened(&run.scene, room.max(NAME)), run);
    let mut text = format!(
        "\n{}\n{}\n",
        shortened(&title, COLUMNS),
        head("pass", "of frame")
    );
    let mut part = None;
    for pass in &run.passes {
        if pass.part != part {
            part = pass.part;
            text += match part {
                Some(Part::Step) => "step\n",
                Some(Part::Draw) => "draw\n",
                None => "",
            };
        }
        let indent = if part.is_some() { "  " } else { "" };
        text += &line(pass, indent, Some(frame));
    }
    let sums = [
        ("step", &run.step_ms),
        ("draw", &run.draw_ms),
        ("frame", &run.frame_ms),
    ];
    for (name, ms) in sums {
        text += &sum(&format!("whole {name}"), ms, frame);
    }
    if let Some(wall) = &run.wall_ms {
        text += &sum("frame by the machine's clock", wall, frame);
    }
    if let Some(floor) = run.floor_ms(record) {
        let times = match frame > 0.0 {
            true => format!("; the frame takes {} times that", digits(frame / floor)),
            false => String::new(),
        };
        let line = format!(
            "{:<NAME$} {:>8}  to copy as many bytes{times}",
            "floor",
            digits(floor)
        );
        text += &(shortened(&line, COLUMNS) + "\n");
    }
    if let Some((ms, dispatches)) = run.dispatches_ms() {
        text += &format!(
            "{:<NAME$} {:>8}  for {dispatches} that do nothing\n",
            "dispatches",
            digits(ms)
        );
    }
    text += &flocking(run);
    text += &tracing(run);
    text += &facts(run);
    text + &warnings(&remarks::of_run(run))
}

/// E.g. `million at 1,000,000 particles, 1280x720, 61 frames after 64`.
pub(super) fn title(run: &Run) -> String {
    titled(&run.scene, run)
}

fn titled(scene: &str, run: &Run) -> String {
    let size = run
        .image_px
        .map_or(String::new(), |[across, down]| format!(", {across}x{down}"));
    let warm = match run.warm_up_frames {
        0 => String::new(),
        frames => format!(" after {frames}"),
    };
    let (particles, frames) = (grouped(run.particles), run.frames);
    format!("{scene} at {particles} particles{size}, {frames} frames{warm}")
}

/// What boids see and how fast.
fn flocking(run: &Run) -> String {
    let (Some(reads), Some(rate)) = (run.neighbour_reads, run.neighbour_reads_per_s()) else {
        return String::new();
    };
    let live = run.live.unwrap_or(run.particles) as f64;
    let line = format!(
        "{} neighbours a boid; of the step {} boids/s and {} neighbours/s",
        digits(reads as f64 / live.max(1.0)),
        prefixed(live / run.step_ms.median * 1e3),
        prefixed(rate)
    );
    shortened(&line, COLUMNS) + "\n"
}

/// How fast flames take samples of the wind: one for each item of the pass that traces them.
fn tracing(run: &Run) -> String {
    let is_trace = |name: &str| name.rsplit('/').next() == Some("trace");
    let traced = run.passes.iter().find(|pass| is_trace(&pass.name));
    match traced {
        Some(pass) if pass.items > 0 && pass.ms.median > 0.0 => {
            let rate = prefixed(pass.items as f64 / pass.ms.median * 1e3);
            let line = format!("{rate} samples of the wind/s in {}", pass.name);
            shortened(&line, COLUMNS) + "\n"
        }
        _ => String::new(),
    }
}

/// Rates and memory of a run.
fn facts(run: &Run) -> String {
    let mut facts = Vec::new();
    if let Some(rate) = run.particles_per_s() {
        facts.push(format!("{} particles/s", prefixed(rate)));
    }
    if run.live.is_some_and(|live| live != run.particles) {
        facts.push(format!("{} live", grouped(run.live.unwrap_or(0))));
    }
    if run.dropped > 0 {
        facts.push(format!("{} births dropped", grouped(run.dropped)));
    }
    if let Some(seconds) = run.cpu_seconds {
        facts.push(format!("{} s of processor time", digits(seconds)));
    }
    if run.peak_memory_bytes > 0 {
        facts.push(format!("peak {}", binary_bytes(run.peak_memory_bytes)));
    }
    if let Some(bytes) = run.gpu_memory_bytes {
        facts.push(format!("{} on the device", binary_bytes(bytes)));
    }
    if facts.is_empty() {
        return String::new();
    }
    format!("{}\n", shortened(&facts.join(", "), COLUMNS))
}

fn head(name: &str, last: &str) -> String {
    let text = format!(
        "{name:<NAME$} {:>8} {:>17} {:>8} {:>8} {:>8} {last:>9}",
        "ms", "p10 .. p90", "items", "GB/s", "of copy"
    );
    text.trim_end().to_owned()
}

fn line(measure: &Measure, indent: &str, frame_ms: Option<f64>) -> String {
    let name = indent.to_owned() + &shortened(&measure.name, NAME - indent.len());
    let none = || "-".to_owned();
    let text = format!(
        "{name:<NAME$} {} {:>8} {:>8} {:>8} {:>9}",
        times(&measure.ms),
        prefixed(measure.items as f64),
        measure.gb_per_s.map_or_else(none, digits),
        measure.share_of_copy.map_or_else(none, percent),
        share(measure.ms.median, frame_ms)
    );
    text.trim_end().to_owned() + "\n"
}

fn sum(name: &str, ms: &Spread, frame_ms: f64) -> String {
    let gap = "";
    let share = share(ms.median, Some(frame_ms));
    format!("{name:<NAME$} {} {gap:>26} {share:>9}\n", times(ms))
}

fn times(ms: &Spread) -> String {
    let range = format!("{} .. {}", digits(ms.p10), digits(ms.p90));
    format!("{:>8} {range:>17}", digits(ms.median))
}

fn share(ms: f64, frame_ms: Option<f64>) -> String {
    match frame_ms {
        Some(frame) if frame > 0.0 => percent(ms / frame),
        _ => String::new(),
    }
}

/// Each as `  warning: …`, broken where lines get too long.
fn warnings(texts: &[String]) -> String {
    let mut all = String::new();
    for text in texts {
        let mut line = "  warning:".to_owned();
        for word in text.split_whitespace() {
            if line.chars().count() + 1 + word.chars().count() > COLUMNS {
                all += &(line + "\n");
                line = " ".repeat(10);
            }
            line.push(' ');
            line += word;
        }
        all += &(line + "\n");
    }
    all
}
