//! Whole trajectories of particles, drawn at once: grass (Reeves 1983, 4.3). A test's name begins with
//! the id of its row.

#[path = "../common/mod.rs"]
mod common;

mod grass;
mod joints;
mod light;
mod meshes;
mod parabolas;
mod shadows;
mod support;
mod twins;
