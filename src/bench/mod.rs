//! What is measured, how it is written down, shown and compared.
//!
//! | file | holds |
//! |---|---|
//! | `record.rs` | the record: what `motes bench --json` writes, [`Record`] |
//! | `spread.rs` | one quantity, measured many times: [`Spread`] |
//! | `file.rs` | records as files, [`read_records`] and [`write_records`] |

mod file;
mod record;
mod spread;

pub use file::{RecordError, parse_records, read_records, records_json, write_records};
pub use record::{Measure, Part, Record, Run, SCHEMA};
pub use spread::{Clock, OUTLIER_RULE, Outliers, Spread, percentile};
