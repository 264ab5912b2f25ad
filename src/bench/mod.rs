//! What is measured, how it is written down, shown and compared.
//!
//! | file | holds |
//! |---|---|
//! | `session.rs` | all that one call measures, [`measure`] |
//! | `job.rs` | a scene at one count: what is to be measured, [`Job`] |
//! | `run.rs` | that on several targets, frame by frame in turn, [`run()`]; `lane.rs` is one of them |
//! | `steady.rs` | from which frame on |
//! | `told.rs` | what is told of a run |
//! | `micro.rs` | kernels alone, [`micro()`]; `splats.rs` has what the splat is given, `flames.rs` what flames are |
//! | `yard.rs` | the copies that all else is held against; `copy.rs` is one of them |
//! | `budget.rs` | when to stop: [`Budget`] |
//! | `record.rs` | the record: what `motes bench --json` writes, [`Record`] |
//! | `spread.rs` | one quantity, measured many times: [`Spread`]; `groups.rs` sees a change of pace in it |
//! | `file.rs` | records as files, [`read_records`] and [`write_records`] |
//! | `merge.rs` | a sweep that was cut in pieces, as one record: [`merged()`] |
//! | `fits.rs` | a sweep over counts as straight lines: [`fits()`] |
//! | `readable.rs` | how their JSON is laid out |
//! | `schema.json` | their JSON Schema, [`record_schema()`] |
//! | `table.rs` | a record as text for a terminal: [`table`] |
//! | `csv.rs` | records as tidy CSV: [`csv`] |
//! | `html/` | records as one page with pictures: [`html()`] |
//! | `compare/` | records of two builds, held against each other: [`compare()`] |
//! | `remarks.rs` | what a reader should know before believing the numbers |
//! | `units.rs` | numbers as people read them |
//!
//! Who moves how many bytes stands where kernels are declared: [`crate::gpu::traffic`].

mod compare;
mod csv;
mod file;
mod fits;
mod groups;
mod html;
mod readable;
mod record;
mod remarks;
mod spread;
mod table;
mod units;

pub use compare::{
    BETWEEN_RUNS, Change, CompareError, Compared, Comparison, Kind, LEAST_MS, LEAST_SHARE, LEVEL,
    Verdict, compare, comparisons_json,
};
pub use csv::csv;

mod budget;
mod copy;
mod error;
mod flames;
mod job;
mod lane;
mod machine;
mod merge;
mod micro;
mod process;
mod run;
mod session;
mod splats;
mod steady;
mod target;
mod told;
mod yard;

pub use budget::Budget;
pub use error::BenchError;
pub use file::{RecordError, parse_records, read_records, records_json, write_records};
pub use fits::{Fit, fits};
pub use html::html;
pub use job::Job;
pub use merge::merged;
pub use micro::micro;
pub use record::{Measure, Part, Record, Run, SCHEMA};
pub use run::{Progress, Watch, run};
pub use session::{Request, measure};
pub use spread::{Clock, OUTLIER_RULE, Outliers, Spread, percentile};
pub use table::{COLUMNS, heading, micro_table, run_table, sweep_tables, table};
pub use target::Target;

/// JSON Schema of the file that `motes bench --json` writes: a [`Record`], or several in an array.
pub fn record_schema() -> &'static str {
    include_str!("schema.json")
}
