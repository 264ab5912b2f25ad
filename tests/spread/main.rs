//! Fires that spread (Perry 1994, 3.3): surfaces, speeds, fronts, and every adapter against the
//! processor.

#[path = "../common/mod.rs"]
mod common;

mod areas;
mod burnt;
mod catch;
mod edges;
mod flames;
mod front;
mod keys;
mod laws;
mod marks;
mod materials;
mod shipped;
mod speed;
mod support;
mod surfaces;
mod twins;
