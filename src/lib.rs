//! Motes: a headless-first particle laboratory whose every state and every pixel is the same, bit
//! for bit, on every driver.
//!
//! # The house
//!
//! ```text
//! scenes/*.toml --> scene --> plan --> gpu --+
//!    (the user)   (checked)  (pure)    cpu --+--> simulation --> cli, output, check
//! ```
//!
//! Imports run one way, left to right. [`scene`] is what the user wrote, checked; [`scene::schema`] is
//! the one table of its keys, from which come the reader's checks, the JSON Schema for editors, the
//! reference page and the list of knobs ([`scene::knobs()`]). Files that a scene names lie in its
//! folder, unless its loader ([`scene::Loader`]) lets it look further; surfaces among them are a
//! [`mesh::Mesh`] each, which knows no scene. [`plan`] makes of
//! it named buffers, the stages of a frame ([`plan::STAGES`]: reading the table is reading the
//! frame) and, for any frame, one [`plan::FrameInputs`] with everything that reaches it from
//! outside. Two backends run a plan: [`gpu`] expands each stage into WGSL kernels
//! ([`gpu::STAGE_KERNELS`]), [`cpu`] runs their twins with rayon; both are a
//! [`backend::Backend`]. [`simulation`] is the front door of the library, [`cli`] that of the
//! program, [`check`] holds two backends against each other, [`bench`](mod@bench) says what they cost. A [`recording`] is the list of changes
//! made while a scene ran, a [`simulation::Snapshot`] its whole state, which goes on with the same bits
//! on any exact adapter. [`output`] writes files, each whole or not at all; JSON is written by one
//! private module. That a stopped render goes on is the program's doing: it keeps a journal of finished
//! frames, and snapshots, beside its output.
//!
//! A stage has one basename: `wgsl/particles/advance.wgsl` and `src/cpu/particles/advance.rs`.
//! What Rust and WGSL share stands once in each: [`layout`], [`exact`], [`transcendental`], [`rng`],
//! [`noise`], [`area`].
//!
//! # One frame, as the data sees it
//!
//! 0. *tree*, where systems bear systems: how many, in which slots, with which parameters, and where
//!    each is. A borne system is a row of the tables that the stages below read, and nothing else.
//! 1. *front*, where fires spread: control points go straight on over their surface, as fast as wind,
//!    edges and heat have it. *block*: those that would enter what has burnt stop. *insert*: points
//!    come between neighbours that are far apart, and rings begin.
//! 2. *births*: how many particles each system bears, perhaps by its screen area; where its
//!    newborns go.
//! 3. *emit*: the newborns' places and velocities, behind the living.
//! 4. *cull*: who dies of age, of dimness or out of bounds, one bit a particle; prefix sums over
//!    the bits.
//! 5. *advance*: survivors sample the wind, move, and take their compacted places in the other
//!    pool.
//! 6. *hatch*, once: boids where their flocks begin; they never die. *cells*: a copy of them,
//!    sorted by grid cell, stably. *steer*: each looks at those in the cells around it, steers, seeks
//!    its goal, turns away from obstacles, drifts with the wind and moves; sums over others are
//!    integers. Where it has been is kept for as long as its trail is.
//! 7. *kindle*: the roots of flames, by hash of who each is, moved with their fires. *trace*: the way
//!    of each flame's particle through this frame's wind, 25 steps; flames have no past.
//!    *gather*, where there is a surface: a few point lights that stand for them. *ground*: a plane
//!    behind everything, in that light.
//! 8. *surface*: triangles, by four samples a pixel: how near the nearest is, then which it is, by
//!    integer atomics; those that are seen, lit, and pillars. What follows is hidden where it is behind them.
//!    *shade*: clouds, in cells of a box along the light: how much of it comes to each.
//! 9. *shapes*: what covers what is behind it, one record a particle, a boid or a segment of its trail,
//!    several for a particle's whole trajectory ([`layout::Cover`]).
//! 10. *cover*: the records are sorted by depth, stably, and each pixel gathers those that cover it,
//!     from near to far; by tiles, in rounds, so that no tile has too many.
//! 11. *planet*: a ball with a surface in every pixel, and on it what shows of the light of particles
//!     behind its outline.
//! 12. *splat*: particles that glow add light to pixels, in 64-bit integers; all of them, or one
//!     layer's.
//! 13. *flame_discs*: the particles along each flame as they are seen. *glow*: each pixel gathers
//!     those of a flame and adds their sum to its light.
//! 14. *resolve*: what covers, what shows of the background, and light on top of both become bytes.
//!
//! Counts stay on the device; nothing comes back but a ring of statistics, and what is asked for.
//!
//! # Who a particle is
//!
//! Its system's key (a hash of the seed and the system's name), the frame of its birth, and its
//! index among that frame's births. Every attribute is a hash of these and of a stream number,
//! spread by the parameter row of its system at its birth. Nothing depends on where it is stored,
//! so a run can be entered at any frame from one lifetime before, and two runs differ only in what
//! was asked to be different.
//!
//! A borne system's key is a hash of its parent's key and of its own birth, so all systems of all
//! frames before are borne again where a run is entered, without their particles.
//!
//! Its state is 32 bytes: position, velocity, index, system and birth frame. Colours, sizes and
//! lifetimes are recomputed wherever they are needed; values with keys ([`scene::Track`]) reach a
//! newborn through its row and the living through the frame's inputs.
//!
//! # Exactness
//!
//! Kernels use only what every driver computes alike: `+ - *`, comparisons, `floor`, `abs`,
//! integers; a lint on naga's IR ([`gpu::shader`]) refuses everything else. The SPIR-V forbids
//! contraction. Floats are snapped ([`exact::snap`]) before they are stored or compared, so
//! denormals and the sign of zero cannot be seen. Compaction is by prefix sums and keeps the order;
//! light is added in integers.
//!
//! # Example
//!
//! ```
//! use motes::{AdapterChoice, Options, Simulation};
//!
//! let scene = motes::scene::load_with("fountain", &["image.width=160".into(), "image.height=90".into()])?;
//! let options = Options { adapter: AdapterChoice::Cpu, ..Options::default() };
//! let mut simulation = Simulation::new(&scene, &options)?;
//! simulation.seek(11)?;
//! simulation.draw()?;
//! assert_eq!(simulation.image()?.len(), 160 * 90 * 4);
//! assert_eq!(simulation.particles()?.len(), simulation.take_statistics()?[11].live as usize);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! An application with a wgpu device of its own hands it over ([`gpu::GpuDevice::from_wgpu`]) and
//! has the picture drawn into its textures ([`Simulation::draw_into`]), or draws the particles
//! itself ([`Simulation::particle_buffers`]); errors of its own work reach its own callbacks as before.
//! Scenes are edited while they run by
//! [`Simulation::turn`]. `examples/` shows each of these at work.
//!
//! Everything that can fail says how in a type: [`SimulationError`] has all that a simulation can
//! meet, and tells the scene's faults from the machine's ([`backend::BackendError`]). Errors can be
//! sent to other threads, and so can a [`Simulation`].

// What a closed pipe answers with a panic.
#![cfg_attr(not(test), deny(clippy::print_stderr, clippy::print_stdout))]

pub mod area;
pub mod backend;
pub mod bench;
pub mod check;
pub mod cli;
pub mod cpu;
pub mod exact;
pub mod gpu;
mod json;
pub mod layout;
pub mod mesh;
pub mod noise;
pub mod output;
pub mod plan;
pub mod recording;
pub mod rng;
pub mod scene;
pub mod simulation;
pub mod transcendental;
#[cfg(feature = "view")]
pub mod view;

pub use simulation::{AdapterChoice, Options, Simulation, SimulationError};
/// The graphics interface, in the version whose devices Motes runs on.
pub use wgpu;
