//! The same scene with more particles, or fewer.

use super::{Owner, Scene, System, Track};

impl Scene {
    /// The scene with its births, and its capacity if it has one, times `factor`. Nothing checks
    /// whether they are still in the range that files have.
    #[must_use]
    pub fn with_births(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        let times = |value: f32| (f64::from(value) * factor) as f32;
        // More of the same systems, not more systems.
        let bears_systems = |system: &System| self.bears_systems(&system.name);
        for system in &mut scaled.systems {
            if bears_systems(system) {
                continue;
            }
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
            for parts in [
                &mut system.inherit.mean_parts,
                &mut system.inherit.var_parts,
            ] {
                *parts = times(*parts);
            }
            for burst in &mut system.bursts {
                burst.parts.mean = times(burst.parts.mean);
                burst.parts.var = times(burst.parts.var);
            }
        }
        let is_births = |track: &&mut Track| match track.owner {
            Owner::System(at) => track.key.contains("_parts") && !bears_systems(&self.systems[at]),
            _ => false,
        };
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
