//! Scene files: what is accepted, and that what is not is refused with file, line, column, key
//! and what would be right.

mod hostile;
mod keys;
mod load;
mod presence;
mod rules;
mod set;
mod text;
