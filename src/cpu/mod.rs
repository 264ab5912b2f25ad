//! A [`Plan`] on the processor, with rayon: always there, and the other side of every comparison.
//!
//! Stages of float work are line-by-line twins of their WGSL kernels; births, compaction and
//! digests are plain Rust, so that the two sides are not one translation.

pub mod behind;
pub mod boid;
pub mod cluster;
pub mod cover;
pub mod detail;
mod digest;
pub mod disc;
pub mod draw;
pub mod drops;
pub mod emission;
pub mod fan;
pub mod flame;
pub mod flames;
pub mod flock;
pub mod footprint;
pub mod grain;
pub mod grid;
pub(crate) mod lanes;
pub mod light;
pub mod meet;
pub mod particle;
pub mod particles;
pub mod pillar;
pub mod projection;
pub mod raster;
pub mod reach;
pub mod shade;
pub mod shape;
pub mod solid;
pub mod spread;
pub(crate) mod sprite;
pub mod steering;
pub mod strip;
pub mod stroke;
pub mod systems;
pub mod tree;
pub mod urge;
pub mod veil;
pub mod walk;
pub mod wind;

use std::sync::Arc;

use rayon::prelude::*;

use crate::backend::{Backend, BackendError, Living, available_bytes, try_copied, try_zeroed};
use crate::layout::{COVER_NONE, Counts, Cover, Frame, FrameStats, Particle, SystemRow};
use crate::plan::{DetailPass, FrameInputs, MeshTables, Plan, Population, Stage, SurfaceTables};
use flames::Flames;
use flock::Flocks;
use lanes::LANES;
use light::LightSums;
use particle::{Identity, row_index};
use particles::cluster::Clusters;
use particles::cull::{Fate, fate_of};
use spread::Spreads;
use tree::Tree;

pub use digest::{digest, digest_from};

/// Particles that a task takes at a time; a multiple of 32, so that words of bits stay whole.
const CHUNK: usize = 8192;

/// The state of a run on the processor.
#[derive(Debug)]
pub struct CpuBackend {
    rows: Vec<SystemRow>,
    birth_counts: Vec<u32>,
    birth_offsets: Vec<u32>,
    counts: Counts,
    particles: Vec<Particle>,
    survivors: Vec<Particle>,
    alive_bits: Vec<u32>,
    /// For want of light, and out of bounds.
    deaths: [u32; 2],
    /// Whether particles die of nothing else.
    only_age_kills: bool,
    curve_points: Vec<[f32; 4]>,
    meshes: Arc<MeshTables>,
    tree: Tree,
    /// Empty if there is no planet.
    planet_pixels: Vec<[u32; 4]>,
    /// Empty if there is no ground.
    ground_pixels: Vec<[u32; 4]>,
    stored_surfaces: Arc<SurfaceTables>,
    /// Empty if there are no surfaces, as the two below; four a pixel.
    surface_nearness: Vec<u32>,
    surface_faces: Vec<u32>,
    surface_pixels: Vec<[u32; 4]>,
    /// Empty unless something covers where there are surfaces.
    cover_front: Vec<u32>,
    flocks: Flocks,
    flames: Flames,
    spreads: Spreads,
    light: LightSums,
    /// Room for what is seen of particles.
    seen: Vec<draw::splat::Seen>,
    /// Whether anything covers; if not, what follows is empty.
    has_covers: bool,
    covers: Vec<Cover>,
    /// How many of them are of particles, of boids, of marks, of fronts, of smoke and of strokes.
    families: [usize; 6],
    /// Whether particles throw light on anything.
    has_clusters: bool,
    clusters: Clusters,
    /// Empty if clouds throw no shadows, as the one below.
    shade_sums: Vec<u32>,
    shade_light: Vec<u32>,
    /// As [`Plan::stroke_records`] has it.
    stroke_records: [u32; 2],
    cover_rg: Vec<[u32; 2]>,
    cover_bt: Vec<[u32; 2]>,
    image: Vec<u32>,
    statistics: Vec<FrameStats>,
    threads: Option<rayon::ThreadPool>,
}

impl CpuBackend {
    /// An empty run of `plan`, on `threads` threads, or as many as the machine has cores.
    ///
    /// # Errors
    /// Out of memory, or threads that cannot be started.
    pub fn new(plan: &Plan, threads: Option<usize>) -> Result<Self, BackendError> {
        let pool = |count| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(count)
                .build()
                .map_err(|e| BackendError::Internal(format!("threads cannot be started: {e}")))
        };
        let mut particles = Vec::new();
        particles
            .try_reserve(plan.capacity.min(1 << 20) as usize)
            .map_err(|_| {
                BackendError::OutOfMemory(format!("a pool of {} particles", plan.capacity))
            })?;
        let rows = plan.system_count as usize * plan.row_count as usize;
        let pixels = plan.width as usize * plan.height as usize;
        let surface_pixels = if plan.uses.surfaces { pixels } else { 0 };
        let covered_pixels = if plan.uses.covers { pixels } else { 0 };
        Ok(Self {
            rows: try_zeroed(rows, "parameter rows")?,
            birth_counts: Vec::new(),
            birth_offsets: Vec::new(),
            counts: Counts::default(),
            particles,
            survivors: Vec::new(),
            alive_bits: Vec::new(),
            deaths: [0; 2],
            only_age_kills: !plan.uses.thresholds && !plan.uses.bounds,
            curve_points: plan.curve_points.clone(),
            meshes: Arc::clone(&plan.meshes),
            tree: Tree::new(plan),
            planet_pixels: try_zeroed(if plan.uses.planet { pixels } else { 0 }, "pixels")?,
            ground_pixels: try_zeroed(if plan.uses.ground { pixels } else { 0 }, "pixels")?,
            stored_surfaces: Arc::clone(&plan.surfaces),
            surface_nearness: try_zeroed(surface_pixels * 4, "samples")?,
            surface_faces: try_zeroed(surface_pixels * 4, "samples")?,
            surface_pixels: try_zeroed(surface_pixels, "pixels")?,
            cover_front: try_zeroed(surface_pixels.min(covered_pixels), "covered pixels")?,
            flocks: Flocks::new(plan)?,
            flames: Flames::new(plan)?,
            spreads: Spreads::new(plan),
            light: LightSums::new(plan.width, plan.height),
            seen: Vec::new(),
            has_covers: plan.uses.covers,
            covers: Vec::new(),
            families: [0; 6],
            has_clusters: plan.gathers_clusters(),
            clusters: Clusters::default(),
            shade_sums: try_zeroed(plan.shade_cells.pow(3) as usize, "cells")?,
            shade_light: try_zeroed(plan.shade_cells.pow(3) as usize, "cells")?,
            stroke_records: plan.stroke_records,
            cover_rg: try_zeroed(covered_pixels, "covered pixels")?,
            cover_bt: try_zeroed(covered_pixels, "covered pixels")?,
            image: try_zeroed(pixels, "pixels")?,
            statistics: Vec::new(),
            threads: threads.map(pool).transpose()?,
        })
    }

    fn run(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        if !stage.is_due(inputs) {
            return Ok(());
        }
        if stage == Stage::Tree {
            self.keep_rows(inputs);
            let stored = particles::emit::Stored {
                curve_points: &self.curve_points,
                meshes: &self.meshes,
            };
            self.tree.step(inputs, &mut self.rows, stored);
            return Ok(());
        }
        if self.tree.is_empty() {
            return self.run_filled(stage, inputs);
        }
        let filled = self.tree.filled(inputs);
        self.run_filled(stage, &filled)
    }

    /// Runs a stage with the systems that others have borne among its inputs.
    fn run_filled(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        match stage {
            Stage::Tree => {}
            Stage::Front => self.spreads.front(inputs),
            Stage::Block => self.spreads.block(inputs),
            Stage::Insert => self.spreads.insert(inputs),
            Stage::Births => self.births(inputs),
            Stage::Emit => self.emit(inputs)?,
            Stage::Cull => self.cull(inputs),
            Stage::Advance => self.advance(inputs)?,
            Stage::Hatch => self.flocks.hatch(inputs),
            Stage::Cells => self.flocks.sort(inputs),
            Stage::Steer => self.flocks.steer(inputs),
            Stage::Kindle => {
                self.flames.kindle(inputs);
                self.flames.kindle_dropped(inputs, &self.spreads);
            }
            Stage::Trace => self.flames.trace(inputs),
            Stage::Catch => {
                let flames = &self.flames;
                let burns = |at: u32| flames.flames[at as usize].burns();
                self.spreads.catch(inputs, &flames.steps, burns);
            }
            Stage::Lights => self.flames.gather(inputs),
            Stage::Clusters if self.has_clusters => {
                let (particles, rows) = (&self.particles, &self.rows);
                let span = particles::cluster::span(particles, inputs, rows);
                let sums = particles::cluster::shed(particles, inputs, rows, span);
                let lights = particles::cluster::cluster(span, &sums);
                self.clusters = Clusters { span, sums, lights };
            }
            Stage::Clusters => {}
            Stage::Ground => {
                let flames = &self.flames.lights;
                let clusters = cluster::lights_of(&self.clusters.lights);
                let lit = draw::ground::Lit {
                    inputs,
                    flames,
                    clusters,
                };
                let pixels = self.ground_pixels.par_iter_mut().with_min_len(1024);
                pixels.enumerate().for_each(|(pixel, out)| {
                    *out = draw::ground::ground(lit, &inputs.grounds[0], pixel as u32);
                });
            }
            Stage::FlameDiscs => self.flames.discs(inputs, DetailPass::default()),
            Stage::Surface => self.surface(inputs),
            Stage::Glow => {
                let (nearness, _) = self.surface_nearness.as_chunks::<4>();
                self.flames.glow(inputs, &self.light, nearness);
            }
            Stage::Strips => {
                let (nearness, _) = self.surface_nearness.as_chunks::<4>();
                self.flames.strips(inputs, &self.light, nearness);
            }
            Stage::Shade => {
                self.shade_sums = draw::shade::deposit(&self.particles, inputs, &self.rows);
                let cells = inputs.shade_boxes[0].kinds[0] as usize;
                self.shade_light = draw::shade::shade(&self.shade_sums, cells);
            }
            Stage::Shapes if self.has_covers => {
                let rows = &self.rows;
                let shade_light = &self.shade_light;
                self.covers.clear();
                let room = self.covers.try_reserve(self.particles.len());
                room.map_err(|_| {
                    let len = self.particles.len();
                    BackendError::OutOfMemory(format!("{len} records of what covers"))
                })?;
                let records = self.particles.par_iter().with_min_len(CHUNK / 8);
                let record = |particle| draw::shapes::shapes(particle, inputs, rows, shade_light);
                records.map(record).collect_into_vec(&mut self.covers);
                let of_particles = self.covers.len();
                self.flocks.shapes(inputs, &mut self.covers);
                let of_boids = self.covers.len() - of_particles;
                let [marks, fronts, smoke] = self.spreads.shapes(inputs, &mut self.covers);
                let before = self.covers.len();
                if self.stroke_records[1] > 0 {
                    let kinds = (self.stroke_records[0], self.stroke_records[1]);
                    let particles = self.particles.par_iter().with_min_len(64);
                    let records = particles.flat_map_iter(|particle| {
                        draw::strokes::strokes(particle, inputs, rows, kinds)
                    });
                    self.covers.par_extend(records);
                }
                let strokes = self.covers.len() - before;
                self.families = [of_particles, of_boids, marks, fronts, smoke, strokes];
            }
            Stage::Cover if self.has_covers => {
                let (nearness, _) = self.surface_nearness.as_chunks::<4>();
                let pixels = draw::cover::Pixels {
                    rg: &mut self.cover_rg,
                    bt: &mut self.cover_bt,
                    front: &mut self.cover_front,
                };
                draw::cover::cover(&self.covers, &inputs.frame, nearness, pixels);
                let fronts = self.surface_pixels.iter_mut().zip(&self.cover_front);
                for (pixel, front) in fronts {
                    *pixel = draw::cover::dim(*pixel, *front);
                }
            }
            Stage::Shapes | Stage::Cover => {}
            Stage::Planet => {
                let clusters = cluster::lights_of(&self.clusters.lights);
                let pixels = self.planet_pixels.par_iter_mut().with_min_len(1024);
                pixels.enumerate().for_each(|(pixel, out)| {
                    *out = draw::planet::planet(inputs, clusters, pixel as u32);
                });
                self.light.clear();
                self.splat(inputs, true);
                self.light.hide(&self.planet_pixels);
            }
            Stage::Splat => {
                if inputs.planets.is_empty() {
                    self.light.clear();
                }
                self.splat(inputs, false);
            }
            Stage::Resolve => self.resolve(&inputs.frame),
        }
        Ok(())
    }

    /// Makes pixels of the sums of light and what is behind them.
    fn resolve(&mut self, frame: &Frame) {
        let light = &self.light;
        let (rg, bt) = (&self.cover_rg, &self.cover_bt);
        let (ground, planet) = (&self.ground_pixels, &self.planet_pixels);
        let surface = &self.surface_pixels;
        let is_plain = [
            rg.len(),
            bt.len(),
            ground.len(),
            planet.len(),
            surface.len(),
        ] == [0; 5];
        let runs = self.image.par_chunks_mut(LANES).with_min_len(256);
        runs.enumerate().for_each(|(run, out)| {
            let first = run * LANES;
            if is_plain && out.len() == LANES {
                out.copy_from_slice(&draw::resolve::resolve_lanes(frame, light, first));
                return;
            }
            for (pixel, out) in (first..).zip(out) {
                let behind = draw::resolve::Behind {
                    ground: ground.get(pixel).copied(),
                    planet: planet.get(pixel).copied(),
                    surface: surface.get(pixel).copied(),
                    covers: rg.get(pixel).copied().zip(bt.get(pixel).copied()),
                };
                *out = draw::resolve::resolve(frame, light, behind, pixel);
            }
        });
    }

    /// Draws the surfaces.
    fn surface(&mut self, inputs: &FrameInputs) {
        let corners = &self.stored_surfaces.corners;
        [self.surface_nearness, self.surface_faces] =
            draw::surface_raster::surface_raster(&inputs.frame, &inputs.surfaces, corners);
        let flames = &self.flames.lights;
        let clusters = cluster::lights_of(&self.clusters.lights);
        let lit = draw::surface::Lit {
            inputs,
            flames,
            clusters,
            corners,
        };
        let (nearness, _) = self.surface_nearness.as_chunks_mut::<4>();
        let (faces, _) = self.surface_faces.as_chunks_mut::<4>();
        self.surface_pixels
            .par_iter_mut()
            .zip(nearness)
            .zip(faces)
            .with_min_len(1024)
            .enumerate()
            .for_each(|(pixel, ((out, nearness), faces))| {
                *out = draw::surface::surface(lit, pixel as u32, nearness, faces);
            });
    }

    /// Adds the light of the particles on that side of a planet's outline.
    fn splat(&mut self, inputs: &FrameInputs, is_behind: bool) {
        let (nearness, _) = self.surface_nearness.as_chunks::<4>();
        let view = draw::splat::View {
            inputs,
            rows: &self.rows,
            nearness,
            is_behind,
        };
        draw::splat::splat(&self.particles, view, &mut self.light, &mut self.seen);
    }

    fn keep_rows(&mut self, inputs: &FrameInputs) {
        for (slot, row) in inputs.rows.iter().enumerate() {
            let at = row_index(slot as u32, inputs.frame.frame, inputs.frame.row_mask);
            self.rows[at] = *row;
        }
    }

    fn births(&mut self, inputs: &FrameInputs) {
        self.keep_rows(inputs);
        self.deaths = [0; 2];
        (self.birth_counts, self.birth_offsets) = systems::births::births(inputs);
        let requested = self.birth_offsets.last().copied().unwrap_or(0);
        self.counts = systems::births::book(self.counts.live, requested, inputs.frame.capacity);
    }

    fn emit(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let frame = &inputs.frame;
        let live = self.counts.live as usize;
        let stored = particles::emit::Stored {
            curve_points: &self.curve_points,
            meshes: &self.meshes,
        };
        grow(&mut self.particles, self.counts.total as usize)?;
        for (slot, system) in inputs.systems.iter().enumerate() {
            let room = |offset: u32| offset.min(self.counts.born) as usize;
            let (start, end) = (
                room(self.birth_offsets[slot]),
                room(self.birth_offsets[slot + 1]),
            );
            let slot = slot as u32;
            let row = self.rows[row_index(slot, frame.frame, frame.row_mask)];
            self.particles[live + start..live + end]
                .par_iter_mut()
                .with_min_len(CHUNK / 8)
                .enumerate()
                .for_each(|(index, newborn)| {
                    let who = Identity {
                        key: system.key,
                        birth_frame: frame.frame,
                        index: index as u32,
                    };
                    *newborn = particles::emit::emit(who, slot, system, &row, stored);
                });
        }
        Ok(())
    }

    fn cull(&mut self, inputs: &FrameInputs) {
        let rows = &self.rows;
        let (now, least_lifetime) = (inputs.frame.frame, inputs.frame.least_lifetime);
        let only_age_kills = self.only_age_kills;
        self.alive_bits.resize(self.particles.len().div_ceil(32), 0);
        self.deaths = self
            .alive_bits
            .par_iter_mut()
            .with_min_len(CHUNK / 32)
            .zip(self.particles.par_chunks(32))
            .map(|(bits, word)| {
                // The first is the oldest: where it is too young to die, so are all.
                if only_age_kills && word[0].age(now) < least_lifetime {
                    *bits = u32::MAX >> (32 - word.len());
                    return [0, 0];
                }
                *bits = 0;
                let mut deaths = [0, 0];
                for (at, particle) in word.iter().enumerate() {
                    match fate_of(particle, inputs, rows) {
                        Fate::Lives => *bits |= 1 << at,
                        Fate::DiesOfAge => {}
                        Fate::DiesOfIntensity => deaths[0] += 1,
                        Fate::DiesOfBounds => deaths[1] += 1,
                    }
                }
                deaths
            })
            .reduce(|| [0, 0], |[a, b], [c, d]| [a + c, b + d]);
    }

    fn advance(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let live_by_chunk: Vec<usize> = self
            .alive_bits
            .par_chunks(CHUNK / 32)
            .map(|bits| bits.iter().map(|word| word.count_ones() as usize).sum())
            .collect();
        let live = live_by_chunk.iter().sum();
        grow(&mut self.survivors, live)?;
        let mut places = self.survivors.as_mut_slice();
        let mut targets = Vec::with_capacity(live_by_chunk.len());
        for count in live_by_chunk {
            let (target, rest) = places.split_at_mut(count);
            targets.push(target);
            places = rest;
        }
        targets
            .into_par_iter()
            .zip(self.particles.par_chunks(CHUNK))
            .zip(self.alive_bits.par_chunks(CHUNK / 32))
            .for_each(|((target, source), bits)| {
                let alive = |at: &usize| bits[at / 32] >> (at % 32) & 1 == 1;
                let survivors = (0..source.len()).filter(alive).map(|at| &source[at]);
                let (systems, winds) = (&inputs.systems, &inputs.winds);
                particles::advance::advance_all(survivors, target, systems, winds);
            });
        std::mem::swap(&mut self.particles, &mut self.survivors);
        let counts = &mut self.counts;
        counts.died = counts.total - live as u32;
        counts.live = live as u32;
        self.statistics.push(FrameStats {
            frame: inputs.frame.frame,
            requested: counts.requested,
            born: counts.born,
            died: counts.died,
            live: counts.live,
            dropped: counts.dropped,
            died_of_intensity: self.deaths[0],
            died_of_bounds: self.deaths[1],
            systems_requested: self.tree.counts.requested,
            systems_born: self.tree.counts.born,
            systems_died: self.tree.counts.died,
            systems_live: self.tree.counts.live,
            points_requested: self.spreads.counts.requested,
            points_born: self.spreads.counts.born,
            points_died: self.spreads.counts.died,
            points_live: self.spreads.counts.live,
            flames_requested: self.spreads.counts.flames_requested,
            flames_born: self.spreads.counts.flames_born,
            flames_died: self.spreads.counts.flames_died,
            flames_live: self.spreads.counts.flames_live,
            marks_died: self.spreads.counts.marks_died,
            marks_live: self.spreads.counts.marks(),
        });
        Ok(())
    }
}

impl CpuBackend {
    /// How many records are of something, and how many there are of each family; room for more.
    fn cover_counts(&self) -> Vec<u32> {
        let is_something = |cover: &&Cover| cover.shape[2] != COVER_NONE;
        let something = self.covers.iter().filter(is_something).count();
        let [particles, boids, marks, fronts, smoke, strokes] = self.families;
        let counts = [
            something, particles, boids, marks, fronts, smoke, strokes, 0,
        ];
        counts.map(|count| count as u32).to_vec()
    }
}

/// Resizes a pool without aborting the program when memory runs out.
fn grow(pool: &mut Vec<Particle>, len: usize) -> Result<(), BackendError> {
    let failed = || BackendError::OutOfMemory(format!("a pool of {len} particles"));
    if len > pool.capacity() {
        let bytes = (len * size_of::<Particle>()) as u64;
        if available_bytes().is_some_and(|available| bytes > available) {
            return Err(failed());
        }
        pool.try_reserve(len - pool.len()).map_err(|_| failed())?;
    }
    pool.resize(len, Particle::default());
    Ok(())
}

impl Backend for CpuBackend {
    fn adapter_name(&self) -> String {
        let threads = match &self.threads {
            Some(pool) => pool.current_num_threads(),
            None => rayon::current_num_threads(),
        };
        format!("cpu ({threads} threads)")
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        match self.threads.take() {
            Some(pool) => {
                let result = pool.install(|| self.run(stage, inputs));
                self.threads = Some(pool);
                result
            }
            None => self.run(stage, inputs),
        }
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        Ok(match buffer {
            "birth_counts" => self.birth_counts.clone(),
            "birth_offsets" => self.birth_offsets.clone(),
            "counts" => bytemuck::cast_slice(&[self.counts]).to_vec(),
            "particles" => try_copied(bytemuck::cast_slice(&self.particles), "the particles")?,
            "planet_pixels" => bytemuck::cast_slice(&self.planet_pixels).to_vec(),
            "ground_pixels" => bytemuck::cast_slice(&self.ground_pixels).to_vec(),
            "surface_nearness" => self.surface_nearness.clone(),
            "surface_faces" => self.surface_faces.clone(),
            "surface_pixels" => bytemuck::cast_slice(&self.surface_pixels).to_vec(),
            "cover_front" => self.cover_front.clone(),
            "nodes" => bytemuck::cast_slice(&self.tree.nodes).to_vec(),
            "tree_counts" => bytemuck::cast_slice(&[self.tree.counts]).to_vec(),
            "borne_systems" => bytemuck::cast_slice(&self.tree.systems).to_vec(),
            "rows" => bytemuck::cast_slice(&self.rows).to_vec(),
            "alive_bits" => self.alive_bits.clone(),
            "deaths" => self.deaths.to_vec(),
            "boids" => try_copied(bytemuck::cast_slice(&self.flocks.boids), "the boids")?,
            "boid_trails" => bytemuck::cast_slice(&self.flocks.trails).to_vec(),
            "boid_cells" => self.flocks.cells.clone(),
            "cell_starts" => self.flocks.starts.clone(),
            "sorted_boids" => try_copied(bytemuck::cast_slice(&self.flocks.sorted), "the boids")?,
            "flames" => bytemuck::cast_slice(&self.flames.flames).to_vec(),
            "flame_steps" => try_copied(bytemuck::cast_slice(&self.flames.steps), "the flames")?,
            "flame_discs" => try_copied(bytemuck::cast_slice(&self.flames.discs), "the flames")?,
            "flame_skews" => try_copied(bytemuck::cast_slice(&self.flames.skews), "the flames")?,
            "strip_joints" => try_copied(bytemuck::cast_slice(&self.flames.joints), "the flames")?,
            "flame_sums" => self.flames.sums.clone(),
            "flame_lights" => bytemuck::cast_slice(&self.flames.lights).to_vec(),
            "flame_bounds" => bytemuck::cast_slice(&self.flames.bounds).to_vec(),
            "control_points" => {
                try_copied(bytemuck::cast_slice(&self.spreads.points), "the front")?
            }
            "moved_points" => try_copied(bytemuck::cast_slice(&self.spreads.moved), "the front")?,
            "dropped_flames" => bytemuck::cast_slice(&self.spreads.dropped).to_vec(),
            "catches" => bytemuck::cast_slice(&self.spreads.catches).to_vec(),
            "ring_spans" => bytemuck::cast_slice(&self.spreads.ring_spans).to_vec(),
            "spread_counts" => bytemuck::cast_slice(&[self.spreads.counts]).to_vec(),
            "cluster_span" if !self.has_clusters => Vec::new(),
            "cluster_span" => self.clusters.span.to_vec(),
            "cluster_sums" => self.clusters.sums.clone(),
            "cluster_lights" => bytemuck::cast_slice(&self.clusters.lights).to_vec(),
            "shade_sums" => self.shade_sums.clone(),
            "shade_light" => self.shade_light.clone(),
            "covers" => try_copied(bytemuck::cast_slice(&self.covers), "what covers")?,
            "cover_counts" => self.cover_counts(),
            "cover_rg" => bytemuck::cast_slice(&self.cover_rg).to_vec(),
            "cover_bt" => bytemuck::cast_slice(&self.cover_bt).to_vec(),
            "light_low" => (0..self.light.len())
                .map(|at| self.light.limbs(at).0)
                .collect(),
            "light_high" => (0..self.light.len())
                .map(|at| self.light.limbs(at).1)
                .collect(),
            "image" => self.image.clone(),
            _ => {
                return Err(BackendError::Internal(format!(
                    "no state buffer `{buffer}`"
                )));
            }
        })
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        Ok(std::mem::take(&mut self.statistics))
    }

    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError> {
        let particles = living.particles;
        bytemuck::cast_slice_mut(&mut self.flocks.boids).copy_from_slice(living.boids);
        bytemuck::cast_slice_mut(&mut self.flocks.trails).copy_from_slice(living.trails);
        self.spreads.put(living.front);
        self.tree.clear();
        recent.iter().for_each(|inputs| self.keep_rows(inputs));
        let live = particles.len() * 4 / size_of::<Particle>();
        self.particles.clear();
        grow(&mut self.particles, live)?;
        bytemuck::cast_slice_mut(&mut self.particles).copy_from_slice(particles);
        self.counts = Counts {
            live: live as u32,
            total: live as u32,
            ..Counts::default()
        };
        self.statistics.clear();
        // Flames have no past: they are what the last frame makes of them.
        if let Some(last) = recent.last() {
            self.run_stage(Stage::Kindle, last)?;
            self.run_stage(Stage::Trace, last)?;
        }
        Ok(())
    }

    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError> {
        let (words, vectors) = match population {
            Population::Systems => (bytemuck::cast_slice(&self.tree.nodes), 7),
            Population::Particles => (bytemuck::cast_slice(&self.particles), 2),
            Population::Boids => (bytemuck::cast_slice(&self.flocks.boids), 2),
            Population::Points => (bytemuck::cast_slice(&self.spreads.points), 4),
            Population::Flames => (bytemuck::cast_slice(&self.flames.flames), 4),
        };
        Ok(digest_from(population.first_index(), words, vectors))
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        Ok(digest(&self.image, 1))
    }
}
