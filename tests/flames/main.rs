//! Flames (Perry 1994, 3.2): trajectories, looks, roots, and every adapter against the processor.

#[path = "../common/mod.rs"]
mod common;

mod details;
mod fan;
mod further;
mod lights;
mod looks;
mod polygons;
mod roots;
mod shipped;
mod strips;
mod support;
mod trajectories;
mod twins;
mod wind;
