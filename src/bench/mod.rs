//! What is measured, how it is written down, shown and compared.
//!
//! | file | holds |
//! |---|---|
//! | `session.rs` | all that one call measures, [`measure`] |
//! | `run.rs` | a scene at one count on several targets, [`run()`]; `lane.rs` is one of them |
//! | `micro.rs` | kernels alone, [`micro()`]; `splats.rs` has what the splat is given |
//! | `copy.rs` | the copy that all else is held against |
//! | `budget.rs` | when to stop: [`Budget`] |
//! | `record.rs` | the record: what `motes bench --json` writes, [`Record`] |
//! | `spread.rs` | one quantity, measured many times: [`Spread`] |
//! | `file.rs` | records as files, [`read_records`] and [`write_records`] |
//!
//! Who moves how many bytes stands where kernels are declared: [`crate::gpu::traffic`].

mod file;
mod record;
mod spread;

mod budget;
mod copy;
mod error;
mod lane;
mod machine;
mod micro;
mod process;
mod run;
mod session;
mod splats;
mod target;

pub use budget::Budget;
pub use error::BenchError;
pub use file::{RecordError, parse_records, read_records, records_json, write_records};
pub use micro::micro;
pub use record::{Measure, Part, Record, Run, SCHEMA};
pub use run::{Job, Progress, Watch, run};
pub use session::{Request, measure};
pub use spread::{Clock, OUTLIER_RULE, Outliers, Spread, percentile};
pub use target::Target;
