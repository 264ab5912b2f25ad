//! Records as a measurement would make them, from a model: each pass has its bytes, a rate, a cost of
//! starting, noise with a long tail, and now and then a sample that something else delayed.

use motes::bench::{Clock, Measure, Part, Record, Run, SCHEMA, Spread};

/// Random numbers that are the same everywhere (Marsaglia's xorshift).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) | 1);
        for _ in 0..16 {
            random.uniform();
        }
        random
    }

    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normally distributed, by the sum of twelve.
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// A pass of the model.
struct Pass {
    name: &'static str,
    part: Part,
    /// Bytes a particle.
    bytes: f64,
    /// Share of the copy's rate that it reaches.
    share: f64,
    /// Milliseconds it takes to start.
    start_ms: f64,
}

const fn pass(name: &'static str, part: Part, bytes: f64, share: f64, start_ms: f64) -> Pass {
    Pass {
        name,
        part,
        bytes,
        share,
        start_ms,
    }
}

const PASSES: [Pass; 7] = [
    pass("particles/births", Part::Step, 0.0, 1.0, 0.011),
    pass("particles/emit", Part::Step, 0.55, 0.5, 0.02),
    pass("particles/cull", Part::Step, 1.1, 0.14, 0.02),
    pass("particles/scan", Part::Step, 0.13, 0.2, 0.03),
    pass("particles/advance", Part::Step, 64.0, 0.78, 0.03),
    pass("draw/splat", Part::Draw, 40.0, 0.49, 0.05),
    pass("draw/resolve", Part::Draw, 0.0, 1.0, 1.9),
];

/// How a record is made.
#[derive(Clone, Copy)]
pub(crate) struct Model {
    pub(crate) adapter: &'static str,
    pub(crate) copy_gb_per_s: f64,
    pub(crate) seed: u64,
    pub(crate) frames: usize,
    /// Relative standard deviation of a frame.
    pub(crate) noise: f64,
    /// Relative standard deviation of a whole record.
    pub(crate) drift: f64,
    /// Share of samples that take thrice as long.
    pub(crate) delayed: f64,
    /// A pass, and how much longer it takes.
    pub(crate) slower: Option<(&'static str, f64)>,
}

pub(crate) const LLVMPIPE: Model = Model {
    adapter: "llvmpipe (LLVM 15.0.6, 256 bits)",
    copy_gb_per_s: 8.72,
    seed: 1,
    frames: 61,
    noise: 0.02,
    drift: 0.0,
    delayed: 0.01,
    slower: None,
};

impl Model {
    /// A record of `million` at these counts, with some kernels alone.
    pub(crate) fn record(&self, counts: &[u64]) -> Record {
        let is_cpu = self.adapter == "cpu";
        let mut random = Random::new(self.seed);
        let drift = (random.normal() * self.drift).exp();
        let clock = if is_cpu {
            Clock::Wall
        } else {
            Clock::GpuTimestamps
        };
        let mut micro = Vec::new();
        let alone = [
            ("copy_kernel", 64.0, 1.0),
            ("copy_buffer", 64.0, 2.9),
            ("read_only", 32.0, 1.31),
            ("atomic_add", 8.0, 0.12),
        ];
        for (name, bytes, share) in alone {
            let bytes = bytes * 2e6;
            let ms = bytes / (self.copy_gb_per_s * share * 1e6);
            micro.push(Measure {
                note: (name == "copy_kernel")
                    .then(|| "4 vec4 an invocation, workgroups of 256".into()),
                ..Measure::new(
                    name,
                    self.samples(ms * drift, &mut random),
                    clock,
                    2_000_000,
                    bytes as u64,
                    Some(self.copy_gb_per_s),
                )
            });
        }
        Record {
            schema: SCHEMA,
            motes: "0.1.0".into(),
            commit: Some("0123456789abcdef".into()),
            adapter: self.adapter.into(),
            driver: if is_cpu {
                "motes 0.1.0"
            } else {
                "llvmpipe, Mesa 22.3.6"
            }
            .into(),
            backend: if is_cpu { "cpu" } else { "vulkan" }.into(),
            exact: true,
            os: "linux x86_64".into(),
            cpu: "Example 3000 <dual> & \"fast\"".into(),
            cpu_threads: 2,
            options: [("workgroup_size".to_owned(), "256".to_owned())].into(),
            copy_kernel_gb_per_s: Some(self.copy_gb_per_s),
            copy_buffer_gb_per_s: Some(self.copy_gb_per_s * 2.9),
            micro,
            runs: counts
                .iter()
                .map(|&count| self.run(count, drift, clock, &mut random))
                .collect(),
            ..Record::default()
        }
    }

    fn run(&self, particles: u64, drift: f64, clock: Clock, random: &mut Random) -> Run {
        let mut passes = Vec::new();
        for Pass {
            name,
            part,
            bytes,
            share,
            start_ms,
        } in PASSES
        {
            let bytes = bytes * particles as f64;
            let slower = self
                .slower
                .filter(|slower| slower.0 == name)
                .map_or(1.0, |slower| slower.1);
            let ms = (start_ms + bytes / (self.copy_gb_per_s * share * 1e6)) * drift * slower;
            passes.push(Measure {
                part: Some(part),
                ..Measure::new(
                    name,
                    self.samples(ms, random),
                    clock,
                    particles,
                    bytes as u64,
                    Some(self.copy_gb_per_s),
                )
            });
        }
        let sum = |wanted: &dyn Fn(Part) -> bool| {
            let times = (0..self.frames).map(|frame| {
                let wanted = passes.iter().filter(|pass| pass.part.is_some_and(wanted));
                wanted.map(|pass| pass.ms.samples[frame]).sum()
            });
            Spread::new(times.collect(), clock)
        };
        let (frame_ms, step_ms) = (sum(&|_| true), sum(&|part| part == Part::Step));
        let wall: Vec<f64> = frame_ms.samples.iter().map(|ms| ms * 1.02 + 0.3).collect();
        Run {
            scene: "million".into(),
            particles,
            live: Some(particles - particles / 500),
            image_px: Some([1280, 720]),
            frames: self.frames as u32,
            warm_up_frames: 64,
            draw_ms: sum(&|part| part == Part::Draw),
            frame_ms,
            step_ms,
            wall_ms: Some(Spread::new(wall, Clock::Wall)),
            cpu_seconds: Some(2.5),
            neighbour_reads: Some(7 * particles),
            peak_memory_bytes: (120 << 20) + particles * 64,
            gpu_memory_bytes: Some(particles * 64 + (30 << 20)),
            passes,
            ..Run::default()
        }
    }

    fn samples(&self, ms: f64, random: &mut Random) -> Vec<f64> {
        let mut one = || {
            let delay = if random.uniform() < self.delayed {
                3.0
            } else {
                1.0
            };
            ms * (random.normal() * self.noise).exp() * delay
        };
        (0..self.frames).map(|_| one()).collect()
    }
}
