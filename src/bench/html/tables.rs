//! Machine facts and the numbers behind the pictures.

use super::super::record::{Measure, Record, Run};
use super::super::remarks;
use super::super::spread::Spread;
use super::super::table::title;
use super::super::units::{binary_bytes, digits, grouped, percent, prefixed};
use super::Labelled;
use super::svg::{color, escaped, tick};

/// What a record is of, and its best rate.
pub(super) fn card(at: usize, labelled: &Labelled) -> String {
    let Labelled { label, record, .. } = labelled;
    let rate = |rate: Option<f64>| rate.map_or("unknown".to_owned(), |it| digits(it) + " GB/s");
    let mut facts = vec![
        ("adapter", record.adapter.clone()),
        (
            "driver",
            format!(
                "{} {}",
                record.driver,
                record.driver_version.as_deref().unwrap_or_default()
            ),
        ),
        ("interface", record.backend.clone()),
        ("exact", if record.exact { "yes" } else { "no" }.to_owned()),
        ("copy by a kernel", rate(record.copy_kernel_gb_per_s)),
        ("copy by the interface", rate(record.copy_buffer_gb_per_s)),
        ("processor", record.cpu.clone()),
        ("threads", record.cpu_threads.to_string()),
        ("system", record.os.clone()),
        (
            "motes",
            format!(
                "{}, commit {:.12}",
                record.motes,
                record.commit.as_deref().unwrap_or("unknown")
            ),
        ),
    ];
    if let Some(ms) = &record.dispatch_ms {
        facts.insert(6, ("an idle dispatch", digits(ms.median) + " ms"));
    }
    let options = record
        .options
        .iter()
        .map(|(key, value)| (key.as_str(), value.clone()));
    facts.extend(options);
    let mut html = format!(
        "<section class=\"card\" style=\"--mark:{}\"><h3>{}</h3>",
        color(at),
        escaped(label)
    );
    if let Some(file) = labelled.file {
        html += &format!("<div class=\"file\">{}</div>", escaped(file.trim()));
    }
    if let Some((rate, run)) = best(record) {
        html += &format!(
            "<div class=\"big\">{} <small>particles a second in {} at {}</small></div>",
            prefixed(rate),
            escaped(&run.scene),
            tick(run.particles as f64)
        );
    }
    html += "<dl>";
    for (key, value) in facts {
        let value = value.trim();
        if !value.is_empty() && value != "0" {
            html += &format!("<dt>{}</dt><dd>{}</dd>", escaped(key), escaped(value));
        }
    }
    html + "</dl></section>\n"
}

fn best(record: &Record) -> Option<(f64, &Run)> {
    let runs = record.runs.iter();
    let rates = runs.filter_map(|run| Some((run.particles_per_s()?, run)));
    rates.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// What a reader should know before believing any of it, at the top; nothing where all is well.
pub(super) fn notices(records: &[Labelled]) -> String {
    let mut items = String::new();
    let mut tell = |place: &str, texts: &[String]| {
        for text in texts {
            items += &format!("<li><b>{}</b>: {}</li>\n", escaped(place), escaped(text));
        }
    };
    for Labelled { label, record, .. } in records {
        tell(label, &record.warnings);
        tell(
            &format!("{label}, kernels alone"),
            &remarks::of_micro(record),
        );
        for run in &record.runs {
            let count = tick(run.particles as f64);
            let place = format!("{label}, {} at {count}", run.scene);
            tell(&place, &remarks::of_run(run));
        }
    }
    match items.as_str() {
        "" => String::new(),
        items => format!(
            "<section class=\"notice\"><h3>Before you believe it</h3>\n<ul>\n{items}</ul></section>\n"
        ),
    }
}

/// All numbers of a record, folded away.
pub(super) fn tables(at: usize, labelled: &Labelled) -> String {
    let Labelled { label, record, .. } = labelled;
    let label = escaped(label);
    let mut html = String::new();
    if !record.micro.is_empty() {
        let rows: String = record
            .micro
            .iter()
            .map(|measure| row(measure, None))
            .collect();
        html += &folded(
            &format!("{label}: kernels alone"),
            at,
            &rows,
            &warnings(&remarks::of_micro(record)),
        );
    }
    for run in &record.runs {
        let share = |ms: &Spread| run.share_of_frame(ms);
        let rows = run.passes.iter().map(|pass| row(pass, share(&pass.ms)));
        let mut rows: String = rows.collect();
        let sums = [
            ("whole step", &run.step_ms),
            ("whole draw", &run.draw_ms),
            ("whole frame", &run.frame_ms),
        ];
        rows += &sums.map(|(name, ms)| sum(name, ms, share(ms))).concat();
        rows += &run.wall_ms.as_ref().map_or(String::new(), |ms| {
            sum("frame by the machine's clock", ms, share(ms))
        });
        let alone = |ms: f64| Spread {
            median: ms,
            p10: ms,
            p90: ms,
            ..Spread::default()
        };
        if let Some(ms) = run.floor_ms(record).map(alone) {
            rows += &sum("floor: a copy of as many bytes", &ms, share(&ms));
        }
        if let Some((ms, count)) = run.dispatches_ms() {
            let ms = alone(ms);
            rows += &sum(&format!("{count} idle dispatches"), &ms, share(&ms));
        }
        let memory = match run.gpu_memory_bytes {
            Some(bytes) => format!(", {} on the device", binary_bytes(bytes)),
            None => String::new(),
        };
        let live = run
            .live
            .map_or(String::new(), |live| format!("{} live, ", grouped(live)));
        let facts = format!(
            "<p>{live}peak {} of memory{memory}</p>",
            binary_bytes(run.peak_memory_bytes)
        );
        let after = facts + &warnings(&remarks::of_run(run));
        html += &folded(
            &format!("{label}: {}", escaped(&title(run))),
            at,
            &rows,
            &after,
        );
    }
    html
}

fn folded(title: &str, at: usize, rows: &str, after: &str) -> String {
    format!(
        "<details style=\"--mark:{}\"><summary>{title}</summary>\n<div class=\"scroll\"><table>\n<thead><tr><th>pass</th>\
         <th>ms</th><th>p10</th><th>p90</th><th>outliers</th><th>items</th><th>GB/s</th><th>of copy</th><th>of frame</th>\
         <th></th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n{after}</details>\n",
        color(at)
    )
}

fn row(measure: &Measure, share: Option<f64>) -> String {
    let Measure {
        name,
        ms,
        items,
        gb_per_s,
        share_of_copy,
        note,
        ..
    } = measure;
    let note = note.as_ref().map_or(String::new(), |note| {
        format!(" title=\"{}\"", escaped(note))
    });
    let bar = share.map_or(String::new(), |share| {
        let width = (share * 120.0).clamp(0.0, 120.0);
        format!("<span class=\"bar\" style=\"width:{width:.1}px\"></span>")
    });
    format!(
        "<tr><td{note}>{}</td>{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td style=\"text-align:left\">{bar}</td></tr>\n",
        escaped(name),
        times(ms),
        prefixed(*items as f64),
        gb_per_s.map_or(String::new(), digits),
        share_of_copy.map_or(String::new(), percent),
        share.map_or(String::new(), percent)
    )
}

fn sum(name: &str, ms: &Spread, share: Option<f64>) -> String {
    let share = share.map_or(String::new(), percent);
    let times = times(ms);
    format!(
        "<tr class=\"sum\"><td>{name}</td>{times}<td></td><td></td><td></td><td>{share}</td><td></td></tr>\n"
    )
}

fn times(ms: &Spread) -> String {
    let outliers = match ms.samples.len() {
        0 => String::new(),
        samples => format!("{} of {samples}", ms.outliers.count),
    };
    let [median, low, high] = [ms.median, ms.p10, ms.p90].map(digits);
    format!("<td>{median}</td><td>{low}</td><td>{high}</td><td>{outliers}</td>")
}

fn warnings(texts: &[String]) -> String {
    if texts.is_empty() {
        return String::new();
    }
    let items: String = texts
        .iter()
        .map(|text| format!("<li>{}</li>", escaped(text)))
        .collect();
    format!("<ul class=\"warnings\">{items}</ul>")
}
