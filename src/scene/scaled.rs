//! The same scene with more particles or boids, or fewer.

use super::{Corners, Dimensions, Edges, Owner, Scene, System, Track};

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

    /// The scene with `factor` times as many boids, each flock at least one. The boxes that they begin
    /// in and live in grow about their middles, so that boids see as many others as before; an
    /// orthographic view grows alike. Nothing checks whether all is still in the range that files have.
    #[must_use]
    pub fn with_boids(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        let mut view = 1.0f64;
        for flock in &mut scaled.flocks {
            let exponent = match flock.dimensions {
                Dimensions::Two => 0.5,
                Dimensions::Three => 1.0 / 3.0,
            };
            let length = factor.powf(exponent);
            view = if factor > 1.0 {
                view.max(length)
            } else {
                length
            };
            flock.count = (f64::from(flock.count) * factor).round().max(1.0) as u32;
            let axes = match flock.dimensions {
                Dimensions::Two => 2,
                Dimensions::Three => 3,
            };
            let grow = |corners: &mut Corners| grow(corners, length, axes);
            grow(&mut flock.region);
            match &mut flock.edges {
                Edges::None => {}
                Edges::Wrap(corners)
                | Edges::Torus(corners)
                | Edges::Repel { corners, .. }
                | Edges::Constrain { corners, .. } => grow(corners),
            }
        }
        scaled.camera.view_height = (f64::from(self.camera.view_height) * view) as f32;
        scaled
    }
}

/// Moves the corners from their middle on the first so many axes.
fn grow(corners: &mut Corners, factor: f64, axes: usize) {
    for axis in 0..axes {
        let (min, max) = (f64::from(corners.min[axis]), f64::from(corners.max[axis]));
        let (middle, half) = (0.5 * (min + max), 0.5 * (max - min) * factor);
        corners.min[axis] = (middle - half) as f32;
        corners.max[axis] = (middle + half) as f32;
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn more_boids_live_in_a_larger_world_as_close_as_before() {
        for (dimensions, axes) in [(2, 2), (3, 3)] {
            let text = format!(
                "frames = 9
[camera]
position = [0, 0, 9]
target = [0, 0, 0]
projection = \"orthographic\"
view_height = 10
[[flock]]
name = \"many\"
count = 80
dimensions = {dimensions}
region = {{ min = [-4, 0, -1], max = [4, 6, 1] }}
edges = {{ kind = \"wrap\", min = [-4, 0, -1], max = [4, 6, 1] }}
"
            );
            let scene = crate::scene::parse(&text, "flock", "flock").expect("a good scene");
            let scaled = scene.with_boids(64.0);
            let flock = &scaled.flocks[0];
            assert_eq!(flock.count, 5120);
            let size = |axis: usize| flock.region.max[axis] - flock.region.min[axis];
            let grown: f32 = (0..axes).map(size).product();
            let before: f32 = [8.0f32, 6.0, 2.0][..axes].iter().product();
            assert!((grown / before - 64.0).abs() < 1e-3, "{grown}");
            assert!((0.5 * (flock.region.min[1] + flock.region.max[1]) - 3.0).abs() < 1e-4);
            if dimensions == 2 {
                assert_eq!((size(2), scaled.camera.view_height), (2.0, 80.0));
            }
            assert_eq!(flock.edges, super::Edges::Wrap(flock.region));
        }
    }
}
