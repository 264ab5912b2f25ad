//! The inventory's rows, from scene files to states and pictures. A test's name begins with the
//! id of its row, so that `cargo test r27` runs what there is of R27.

mod attributes;
mod bending;
mod births;
#[path = "../common/mod.rs"]
mod common;
mod extinction;
mod identity;
mod light;
mod motion;
mod order;
mod places;
mod raster;
mod restart;
mod steadiness;
mod streaks;
mod support;
