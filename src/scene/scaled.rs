//! The same scene with more particles, or fewer.

use super::{Scene, Track};

impl Scene {
    /// The scene with its births, and its capacity if it has one, times `factor`. Nothing checks
    /// whether they are still in the range that files have.
    #[must_use]
    pub fn with_births(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        let times = |value: f32| (f64::from(value) * factor) as f32;
        for system in &mut scaled.systems {
            let births = &mut system.births;
            for parts in [
                &mut births.initial_mean_parts,
                &mut births.delta_mean_parts,
                &mut births.quadratic_mean_parts,
                &mut births.cubic_mean_parts,
                &mut births.var_parts,
                &mut births.delta_var_parts,
                &mut births.quadratic_var_parts,
                &mut births.cubic_var_parts,
            ] {
                *parts = times(*parts);
            }
            for burst in &mut system.bursts {
                burst.parts.mean = times(burst.parts.mean);
                burst.parts.var = times(burst.parts.var);
            }
        }
        let is_births = |track: &&mut Track| track.key.contains("_parts");
        for track in scaled.tracks.iter_mut().filter(is_births) {
            for key in &mut track.keys {
                key.value = key.value.map(times);
            }
        }
        // What was dropped for want of room is still dropped, in proportion.
        let times = |most: u32| ((f64::from(most) * factor) as u32).max(1);
        scaled.capacity = self.capacity.map(times);
        scaled.steady_particles = self.steady_particles.map(times);
        scaled
    }
}
