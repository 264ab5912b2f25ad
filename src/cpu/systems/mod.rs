//! Stages of whole particle systems.

pub mod births;
