//! Scene files: what is accepted, and that what is not is refused with file, line, column, key
//! and what would be right.

mod commands;
mod fires;
mod flocks;
mod hostile;
mod keyed;
mod keyed_rules;
mod keys;
mod kinds;
mod knobs;
mod load;
mod presence;
mod reach;
mod reference;
mod rules;
mod schema;
mod schema_files;
mod set;
mod text;
mod tracks;
