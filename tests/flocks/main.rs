//! Flocks (the flocking article's rows F1 to F40). A test's name begins with the id of its row.

mod bands;
#[path = "../common/mod.rs"]
mod common;
mod cones;
mod edges;
mod grid;
mod ink;
mod line_drawings;
mod looks;
mod metrics;
mod nearest;
mod oracle;
mod readings;
mod rules;
mod runs;
mod sketch;
mod solids;
mod start;
mod support;
mod trails;
mod twins;
mod urges;
mod views;
