//! Which values can change with the frame, and where they are.

use super::Owner;
use crate::scene::{Fire, FireSpread, Flock, GenerationShape, Scene, System, Wind};

/// The numbers that a key names, if they may change with the frame.
pub(super) fn numbers_of<'a>(
    scene: &'a mut Scene,
    owner: Owner,
    key: &str,
) -> Option<&'a mut [f32]> {
    use std::slice::from_mut as one;
    Some(match owner {
        Owner::Image => match key {
            "background" => &mut scene.image.background,
            "exposure" => one(&mut scene.image.exposure),
            _ => return None,
        },
        Owner::Camera => match key {
            "position" => &mut scene.camera.position,
            "target" => &mut scene.camera.target,
            "up" => &mut scene.camera.up,
            "vertical_fov_degrees" => one(&mut scene.camera.vertical_fov_degrees),
            "view_height" => one(&mut scene.camera.view_height),
            _ => return None,
        },
        Owner::System(at) => return system_numbers(scene.systems.get_mut(at)?, key),
        Owner::Lamp(at) => {
            let lamp = scene.lamps.get_mut(at)?;
            match key {
                "position" => &mut lamp.position,
                "color" => &mut lamp.color,
                _ => return None,
            }
        }
        Owner::Surface(at) => {
            let surface = scene.surfaces.get_mut(at)?;
            match key {
                "position" => &mut surface.position,
                "rotation_degrees" => &mut surface.rotation_degrees,
                "scale" => one(&mut surface.scale),
                "color" => &mut surface.color,
                _ => return None,
            }
        }
        Owner::Flock(at) => return flock_numbers(scene.flocks.get_mut(at)?, key),
        Owner::Wind(at) => return wind_numbers(scene.winds.get_mut(at)?, key),
        Owner::Fire(at) => return fire_numbers(scene.fires.get_mut(at)?, key),
    })
}

fn flock_numbers<'a>(flock: &'a mut Flock, key: &str) -> Option<&'a mut [f32]> {
    use std::slice::from_mut as one;
    Some(match key {
        "max_speed" => one(&mut flock.max_speed),
        "force" => &mut flock.force,
        "size" => one(&mut flock.size),
        "color" => &mut flock.color,
        "drag" => one(&mut flock.drag),
        "goal.position" => &mut flock.goal.as_mut()?.position,
        "goal.weight" => one(&mut flock.goal.as_mut()?.weight),
        _ => return None,
    })
}

fn system_numbers<'a>(system: &'a mut System, key: &str) -> Option<&'a mut [f32]> {
    use std::slice::from_mut as one;
    let births = &mut system.births;
    Some(match key {
        "position" => &mut system.position,
        "rotation_degrees" => &mut system.rotation_degrees,
        "initial_mean_parts" | "initial_mean_parts_per_area" => one(&mut births.initial_mean_parts),
        "var_parts" | "var_parts_per_area" => one(&mut births.var_parts),
        "ejection_angle_degrees" => one(&mut system.ejection_angle_degrees),
        "speed.mean" => one(&mut system.speed.mean),
        "speed.var" => one(&mut system.speed.var),
        "lifetime.mean" => one(&mut system.lifetime.as_mut()?.mean),
        "lifetime.var" => one(&mut system.lifetime.as_mut()?.var),
        "color.mean" => &mut system.color.initial.mean,
        "color.var" => &mut system.color.initial.var,
        "color.rate" => &mut system.color.rate,
        "color.rate_var" => &mut system.color.rate_var,
        "transparency.mean" => one(&mut system.transparency.initial.mean),
        "transparency.var" => one(&mut system.transparency.initial.var),
        "transparency.rate" => one(&mut system.transparency.rate),
        "transparency.rate_var" => one(&mut system.transparency.rate_var),
        "size.mean" => one(&mut system.size.initial.mean),
        "size.var" => one(&mut system.size.initial.var),
        "size.rate" => one(&mut system.size.rate),
        "size.rate_var" => one(&mut system.size.rate_var),
        "acceleration" => &mut system.acceleration,
        "drag" => one(&mut system.drag),
        "intensity_threshold" => one(system.intensity_threshold.as_mut()?),
        "light_distance" => one(system.light_distance.as_mut()?),
        "light" => one(&mut system.light),
        _ => {
            return shape_numbers(
                &mut system.generation_shape,
                key.strip_prefix("generation_shape.")?,
            );
        }
    })
}

fn fire_numbers<'a>(fire: &'a mut Fire, key: &str) -> Option<&'a mut [f32]> {
    use std::slice::from_mut as one;
    Some(match key {
        "position" => &mut fire.position,
        "rotation_degrees" => &mut fire.rotation_degrees,
        "height.mean" => one(&mut fire.height.mean),
        "height.var" => one(&mut fire.height.var),
        "width.mean" => one(&mut fire.width.mean),
        "width.var" => one(&mut fire.width.var),
        "buoyancy" => one(&mut fire.buoyancy),
        "noisiness" => one(&mut fire.noisiness),
        "wind_factor" => one(&mut fire.wind_factor),
        "brightness" => one(&mut fire.brightness),
        "color_noise" => one(&mut fire.color_noise),
        "inner_alpha" => one(&mut fire.inner_alpha),
        "detail_spread" => one(&mut fire.detail_spread),
        "detail_alpha" => one(&mut fire.detail_alpha),
        "strip_contrast" => one(&mut fire.strip_contrast),
        "matrix_noise" => one(&mut fire.matrix_noise),
        "light" => one(&mut fire.lights.gain),
        _ => {
            let spread = fire.spread.as_mut()?;
            return spread_number(spread, key.strip_prefix("spread.")?).map(one);
        }
    })
}

fn spread_number<'a>(spread: &'a mut FireSpread, key: &str) -> Option<&'a mut f32> {
    Some(match key {
        "time_scale" => &mut spread.time_scale,
        "opposed_flux" => &mut spread.opposed_flux,
        "concurrent_flux" => &mut spread.concurrent_flux,
        "ignition_heat" => &mut spread.ignition_heat,
        "drop_distance" => &mut spread.drop_distance,
        "separation" => &mut spread.separation,
        "curvature_distance" => &mut spread.curvature_distance,
        _ => return None,
    })
}

fn shape_numbers<'a>(shape: &'a mut GenerationShape, key: &str) -> Option<&'a mut [f32]> {
    use GenerationShape as Shape;
    let number = match (shape, key) {
        (
            Shape::Sphere { radius } | Shape::Circle { radius } | Shape::Attractor { radius, .. },
            "radius",
        ) => radius,
        (
            Shape::Rectangle { length, .. } | Shape::Box { length, .. } | Shape::Line { length },
            "length",
        ) => length,
        (Shape::Rectangle { width, .. } | Shape::Box { width, .. }, "width") => width,
        (Shape::Box { height, .. } | Shape::Cone { height, .. }, "height") => height,
        (Shape::Ring { inner_radius, .. }, "inner_radius") => inner_radius,
        (Shape::Ring { outer_radius, .. }, "outer_radius") => outer_radius,
        (Shape::Mesh { scale, .. }, "scale") => scale,
        _ => return None,
    };
    Some(std::slice::from_mut(number))
}

fn wind_numbers<'a>(wind: &'a mut Wind, key: &str) -> Option<&'a mut [f32]> {
    use std::slice::from_mut as one;
    Some(match (wind, key) {
        (Wind::Uniform { velocity } | Wind::Gusts { velocity, .. }, "velocity") => velocity,
        (Wind::Buoyancy { gravity, .. }, "gravity") => gravity,
        (Wind::Buoyancy { strength, .. } | Wind::Source { strength, .. }, "strength") => {
            one(strength)
        }
        (
            Wind::Vortex { position, .. }
            | Wind::Source { position, .. }
            | Wind::Attractor { position, .. },
            "position",
        ) => position,
        (Wind::Vortex { speed, .. } | Wind::Attractor { speed, .. }, "speed") => one(speed),
        (
            Wind::Vortex { radius, .. }
            | Wind::Source { radius, .. }
            | Wind::Attractor { radius, .. },
            "radius",
        ) => one(radius),
        (Wind::Noise(noise) | Wind::Curl(noise), "strength") => one(&mut noise.strength),
        _ => return None,
    })
}
