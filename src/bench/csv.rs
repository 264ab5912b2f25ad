//! Records as tidy CSV: one line a measurement, one header for all.

use std::borrow::Cow;

use super::record::{Measure, Record, Run};
use super::spread::Spread;
use crate::output::quoted_field;

/// The columns. Scripts depend on their names, not on their order.
const HEADER: &str = "adapter,driver,backend,exact,motes,commit,kind,scene,particles,live,part,name,clock,\
                      median_ms,p10_ms,p90_ms,samples,outliers,items,bytes,gb_per_s,share_of_copy,share_of_frame";

/// The records as CSV (RFC 4180, lines end with a line feed). `kind` is micro, pass, or one of
/// frame, step, draw and wall for the whole of a run. Lines of sweeps are not among them: a line here is
/// one measurement at one count, and what reads it would count them twice.
pub fn csv(records: &[Record]) -> String {
    let mut text = HEADER.to_owned() + "\n";
    for record in records {
        for measure in &record.micro {
            text += &line(record, "micro", None, measure);
        }
        for run in &record.runs {
            for pass in &run.passes {
                text += &line(record, "pass", Some(run), pass);
            }
            let whole = |ms: &Spread| Measure {
                ms: ms.clone(),
                items: run.live.unwrap_or(run.particles),
                ..Measure::default()
            };
            let wall = run.wall_ms.as_ref().map(|ms| ("wall", ms));
            let sums = [
                ("frame", &run.frame_ms),
                ("step", &run.step_ms),
                ("draw", &run.draw_ms),
            ];
            for (kind, ms) in sums.into_iter().chain(wall) {
                text += &line(record, kind, Some(run), &whole(ms));
            }
        }
    }
    text
}

fn line(record: &Record, kind: &str, run: Option<&Run>, measure: &Measure) -> String {
    let number = |number: Option<f64>| number.map_or(String::new(), |it| it.to_string());
    let ms = &measure.ms;
    let frame_ms = run.map(|run| run.frame_ms.median).filter(|ms| *ms > 0.0);
    let part = match measure.part {
        Some(super::Part::Step) => "step",
        Some(super::Part::Draw) => "draw",
        None => "",
    };
    let fields: [Cow<'_, str>; 23] = [
        quoted_field(&record.adapter),
        quoted_field(&record.driver),
        quoted_field(&record.backend),
        record.exact.to_string().into(),
        quoted_field(&record.motes),
        quoted_field(record.commit.as_deref().unwrap_or_default()),
        kind.into(),
        quoted_field(run.map_or("", |run| &run.scene)),
        run.map_or(String::new(), |run| run.particles.to_string())
            .into(),
        run.and_then(|run| run.live)
            .map_or(String::new(), |live| live.to_string())
            .into(),
        part.into(),
        quoted_field(&measure.name),
        ms.clock.name().into(),
        ms.median.to_string().into(),
        ms.p10.to_string().into(),
        ms.p90.to_string().into(),
        ms.samples.len().to_string().into(),
        ms.outliers.count.to_string().into(),
        measure.items.to_string().into(),
        measure.bytes.to_string().into(),
        number(measure.gb_per_s).into(),
        number(measure.share_of_copy).into(),
        number(frame_ms.map(|frame| ms.median / frame)).into(),
    ];
    fields.join(",") + "\n"
}
