//! Flocks (the flocking article's rows F1 to F40). A test's name begins with the id of its row.

#[path = "../common/mod.rs"]
mod common;
mod oracle;
mod support;
mod twins;
