//! What passes are held against, measured beside them: how long a copy takes, whatever its size.
//!
//! A dispatch has a price even if it does nothing, so the rate of a small copy says nothing about
//! memory; and what fits in a cache is copied faster than what does not. So three copies are
//! measured: of one record, whose time is that price; of [`NEAR`] records; and of [`FAR`], which fit in
//! no cache; the latter two by a kernel and by the interface. [`Rates`] draws the line through them.

use std::time::Instant;

use super::copy::{Copy, Fastest, timed};
use super::micro::copy_by_one_thread;
use super::record::gb_per_s;
use super::spread::{Clock, Spread};
use super::target::Target;
use crate::backend::BackendError;
use crate::gpu::Yardstick;

/// Records of the copy that stays in a cache: 8 MiB read and written.
pub(super) const NEAR: u32 = 1 << 17;

/// Records of the copy that fits in none: 256 MiB read and written, 128 MiB a binding.
pub(super) const FAR: u32 = 1 << 22;

/// Bytes of a record, read and written.
const BOTH_WAYS: u64 = 64;

/// The copies are measured again while they have had less than this part of the frames' time.
const PART_OF_TIME: f64 = 0.5;

/// Idle dispatches of a submission, as a frame has them: the first of a submission costs more.
const IN_A_ROW: u32 = 16;

/// Times that each is measured at least.
const LEAST: usize = 5;

/// The copies of one target.
pub(super) struct Yard {
    far: Copy,
    near: Copy,
    buffer: Interface,
    near_buffer: Interface,
    /// A copy of one record by itself, and among others; the processor has no dispatches.
    idle: Option<[Copy; 2]>,
}

/// The interface's own copy.
enum Interface {
    Gpu(Box<Yardstick>),
    Cpu(Box<super::copy::CpuCopy>),
}

/// What has been measured of a [`Yard`], milliseconds.
#[derive(Default)]
pub(super) struct YardTimes {
    far: Vec<f64>,
    near: Vec<f64>,
    buffer: Vec<f64>,
    near_buffer: Vec<f64>,
    lone: Vec<f64>,
    dispatch: Vec<f64>,
    clock: Clock,
    /// Seconds spent on it.
    secs: f64,
}

/// How fast the target copies.
#[derive(Clone, Debug, Default)]
pub(super) struct Rates {
    /// Of the far records: by a kernel, every sample.
    pub(super) copy_ms: Spread,
    /// Of the near records.
    pub(super) near_ms: Spread,
    /// Of the far records, by the interface.
    pub(super) buffer_ms: Spread,
    /// What a dispatch costs that does nothing, among others of its kind.
    pub(super) dispatch_ms: Option<Spread>,
    /// By a kernel, out of caches, 10^9 bytes a second.
    pub(super) kernel: Option<f64>,
    /// By a kernel, within a cache, the price of the dispatch not counted.
    pub(super) near: Option<f64>,
    /// By the interface, out of caches.
    pub(super) buffer: Option<f64>,
    /// By the interface, within a cache.
    near_buffer: Option<f64>,
}

impl Interface {
    /// Of what the kernel copies.
    fn new(copy: &Copy) -> Result<Self, BackendError> {
        Ok(match copy.memory() {
            Some(memory) => Self::Gpu(Box::new(Yardstick::copy_buffer(memory)?)),
            None => Self::Cpu(Box::new(copy_by_one_thread(copy.records())?)),
        })
    }

    fn run(&mut self) -> Result<f64, BackendError> {
        match self {
            Self::Gpu(copy) => Ok(timed(copy)?.0),
            Self::Cpu(copy) => Ok(copy.run()),
        }
    }
}

impl Yard {
    /// Finds the fastest form and sets the copies up.
    pub(super) fn new(target: &Target) -> Result<Self, BackendError> {
        let far = Fastest::of(target, FAR)?.copy(FAR)?;
        let fastest = Fastest::of(target, NEAR)?;
        let near = fastest.copy(NEAR)?;
        let idle = match target {
            Target::Gpu(_) => Some([fastest.copy(1)?, fastest.copy(1)?.repeated(IN_A_ROW)]),
            Target::Cpu => None,
        };
        let mut yard = Self {
            buffer: Interface::new(&far)?,
            near_buffer: Interface::new(&near)?,
            near,
            far,
            idle,
        };
        // The first run of each compiles it, and gives its memory to what is written.
        yard.measure(&mut YardTimes::default())?;
        Ok(yard)
    }

    /// Which form is fastest.
    pub(super) fn form(&self) -> &str {
        &self.far.form
    }

    /// Measures each once.
    pub(super) fn measure(&mut self, times: &mut YardTimes) -> Result<(), BackendError> {
        let begun = Instant::now();
        let (ms, clock) = self.far.run()?;
        times.far.push(ms);
        times.clock = clock;
        times.near.push(self.near.run()?.0);
        times.buffer.push(self.buffer.run()?);
        times.near_buffer.push(self.near_buffer.run()?);
        if let Some([lone, among_others]) = &mut self.idle {
            times.lone.push(lone.run()?.0);
            times.dispatch.push(among_others.run()?.0);
        }
        times.secs += begun.elapsed().as_secs_f64();
        Ok(())
    }

    /// The same, unless that has taken too much of the time already.
    pub(super) fn measure_beside(
        &mut self,
        times: &mut YardTimes,
        frames_secs: f64,
    ) -> Result<(), BackendError> {
        if times.secs > PART_OF_TIME * frames_secs {
            return Ok(());
        }
        self.measure(times)
    }

    /// Measures until there is enough to tell.
    pub(super) fn measure_enough(&mut self, times: &mut YardTimes) -> Result<(), BackendError> {
        while times.far.len() < LEAST {
            self.measure(times)?;
        }
        Ok(())
    }
}

impl YardTimes {
    /// Of all copies by a kernel, in the order taken: those of one record (where there are
    /// dispatches), of [`NEAR`] and of [`FAR`]; and that by the interface, of [`FAR`].
    pub(super) fn rates(self) -> Rates {
        let spread = |samples: Vec<f64>| Spread::new(samples, self.clock);
        let all = [
            self.far,
            self.near,
            self.buffer,
            self.near_buffer,
            self.lone,
        ];
        let [far, near, buffer, near_buffer, lone] = all.map(spread);
        let dispatch_ms = (!self.dispatch.is_empty()).then(|| spread(self.dispatch));
        let bytes = |records: u32| u64::from(records) * BOTH_WAYS;
        let kernel = gb_per_s(bytes(FAR), far.median);
        // The copies are alone in their submissions, too.
        let price = lone.median;
        // Of a copy that takes hardly longer than nothing, the difference is noise; and a cache is no
        // slower than memory.
        let of_cache = |ms: f64, price: f64, far: Option<f64>| {
            let rate = (ms > 2.0 * price).then(|| gb_per_s(bytes(NEAR), ms - price));
            rate.flatten().into_iter().chain(far).reduce(f64::max)
        };
        let buffer_rate = gb_per_s(bytes(FAR), buffer.median);
        Rates {
            near: of_cache(near.median, price, kernel),
            kernel,
            buffer: buffer_rate,
            near_buffer: of_cache(near_buffer.median, 0.0, buffer_rate),
            copy_ms: far,
            near_ms: near,
            buffer_ms: buffer,
            dispatch_ms,
        }
    }
}

impl Rates {
    /// Milliseconds that a copy of so many bytes takes beyond the price of its dispatch: what a pass
    /// that must move them cannot be faster than. `by_interface` for a command, not a kernel.
    pub(super) fn floor_ms(&self, bytes: u64, by_interface: bool) -> Option<f64> {
        let (near, far) = match by_interface {
            true => (self.near_buffer, self.buffer),
            false => (self.near, self.kernel),
        };
        let rate = rate_at(bytes, near?, far?);
        (bytes > 0).then(|| bytes as f64 / (rate * 1e6))
    }
}

/// The rate of a copy of so many bytes: that of a cache up to [`NEAR`], that of memory from [`FAR`]
/// on, a straight line over the logarithm of bytes between them.
fn rate_at(bytes: u64, near: f64, far: f64) -> f64 {
    let octaves = (bytes.max(1) as f64 / (u64::from(NEAR) * BOTH_WAYS) as f64).log2();
    let place = octaves / f64::from(FAR / NEAR).log2();
    near + (far - near) * place.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A machine with a price of 0.05 ms a dispatch, 20 GB/s in its cache and 10 outside.
    fn machine() -> Rates {
        let times = YardTimes {
            far: vec![0.05 + 268.435_456 / 10.0; 3],
            near: vec![0.05 + 8.388_608 / 20.0; 3],
            buffer: vec![268.435_456 / 25.0; 3],
            near_buffer: vec![8.388_608 / 50.0; 3],
            lone: vec![0.05; 3],
            dispatch: vec![0.02; 3],
            ..YardTimes::default()
        };
        times.rates()
    }

    #[test]
    fn the_floor_follows_the_size_of_the_copy() {
        let rates = machine();
        let floor = |bytes| rates.floor_ms(bytes, false).expect("there are rates");
        // A small pass is not held against a small copy's rate, most of which is its dispatch.
        assert!((floor(20_000_000 / 1000) - 1e-3).abs() < 1e-5);
        assert!((floor(8 << 20) - 8.388_608 / 20.0).abs() < 1e-3);
        assert!((floor(1 << 30) - 107.374).abs() < 0.3);
        // Five octaves from the near to the far copy.
        let middle = floor(16 << 20) / (16.777_216 / 18.0);
        assert!((middle - 1.0).abs() < 1e-3, "{middle}");
        assert_eq!(rates.floor_ms(0, false), None);
        let by_interface = rates.floor_ms(5_000_000, true).expect("there is a rate");
        assert!((by_interface - 0.1).abs() < 1e-6);
    }

    #[test]
    fn no_floor_lies_above_a_copy_of_as_many_bytes() {
        // Whatever the sizes' times: those of a faster cache, of a slower one, of noise.
        for near in [0.06, 0.2, 0.5, 2.0] {
            let times = YardTimes {
                far: vec![20.0],
                near: vec![near],
                buffer: vec![12.0],
                near_buffer: vec![0.3],
                lone: vec![0.05],
                dispatch: vec![0.02],
                ..YardTimes::default()
            };
            let rates = times.rates();
            let floor = |records: u32| rates.floor_ms(u64::from(records) * 64, false);
            assert!(floor(FAR).expect("a rate") <= 20.0 + 1e-9);
            assert!(floor(NEAR).expect("a rate") <= near.max(20.0 / 32.0) + 1e-9);
            assert!(floor(1).expect("a rate") < 0.05);
        }
    }
}
