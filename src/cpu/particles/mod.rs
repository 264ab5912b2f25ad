//! Stages of particles.

pub mod advance;
pub mod cluster;
pub mod cull;
pub mod emit;
