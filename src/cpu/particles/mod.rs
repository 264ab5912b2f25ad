//! Stages of particles.

pub mod advance;
pub mod cull;
pub mod emit;
