//! The inventory's rows, from scene files to states and pictures. A test's name begins with the
//! id of its row, so that `cargo test r27` runs what there is of R27.

mod attributes;
mod bending;
mod births;
mod bounds;
mod camera;
#[path = "../common/mod.rs"]
mod common;
mod curves;
mod dynamics;
mod exposure;
mod extinction;
mod generation;
mod identity;
mod keyed;
mod kills;
mod layers;
mod light;
mod meshes;
mod motion;
mod order;
mod over;
mod places;
mod raster;
mod rates;
mod restart;
mod schedule;
mod shapes;
mod shows;
mod steadiness;
mod streaks;
mod support;
mod warm_starts;
