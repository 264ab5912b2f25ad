//! Meshes: built in, and read from files of every format; what is wrong with a file is said with
//! its line, and no file takes more time or memory than it is worth.

mod files;
mod formats;
mod gltf;
mod mutated;
mod shapes;
mod together;
