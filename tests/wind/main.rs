//! The wind and its noise: Perry (1994), 2.1.2, 3.2.3 and 3.4. A test's name begins with the id of
//! its row.

#[path = "../common/mod.rs"]
mod common;
mod curl;
mod flow;
mod forms;
mod gradient;
#[path = "../rows/light.rs"]
#[allow(dead_code)]
mod light;
mod pattern;
mod runs;
mod spectrum;
#[path = "../rows/support.rs"]
#[allow(dead_code)]
mod support;
mod transform;
