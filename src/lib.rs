//! Motes: a headless-first particle laboratory.

pub mod backend;
pub mod cli;
pub mod cpu;
pub mod exact;
pub mod gpu;
pub mod layout;
pub mod output;
pub mod plan;
pub mod recording;
pub mod rng;
pub mod scene;
pub mod simulation;
pub mod transcendental;
