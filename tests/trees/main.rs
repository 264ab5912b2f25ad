//! Systems that bear systems, the rings of fire and the planet (Reeves 1983, 2.6 and section 3). A
//! test's name begins with the id of its row.

#[path = "../common/mod.rs"]
mod common;
mod families;
mod genesis;
mod planet;
mod restart;
mod rings;
mod support;
mod twins;
