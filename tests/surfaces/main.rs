//! Surfaces: which triangle is seen where, lit how, and what is hidden behind it.

#[path = "../common/mod.rs"]
mod common;

mod explosions;
mod hiding;
mod light;
mod particles;
mod reference;
mod support;
mod twins;
mod watertight;
