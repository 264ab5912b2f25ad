// What drives boids besides each other: a goal, and obstacles that they turn away from and never
// enter (Reynolds 1988, "Not bumping into things"; 1999, "Steering behaviors", seek and arrival).
// Reads and writes no buffers. Twin of src/cpu/urge.rs.
// Invariant: in a plane, z never changes.
#define_import_path motes::urge

#import motes::boid::Motion
#import motes::exact::{clamp_unit, dot3, inverse_square_root, less, less_equal, max3, min_exact, square_root}
#import motes::grid::nearest_way
#import motes::layout::{FlockFrame, OBSTACLE_PLANE, OBSTACLE_SPHERE, Obstacle}
#import motes::steering::steering

// What a boid accelerates by to get to its flock's goal; on a torus, by the nearest way.
fn sought(flock: FlockFrame, motion: Motion) -> vec3<f32> {
    let straight = flock.goal.xyz - motion.position;
    let way = vec3<f32>(
        nearest_way(straight.x, flock.torus.x, flock.torus_inverse.x),
        nearest_way(straight.y, flock.torus.y, flock.torus_inverse.y),
        nearest_way(straight.z, flock.torus.z, flock.torus_inverse.z),
    );
    // Within the radius where it slows down, which is none if its inverse is 0.
    let part = min_exact(square_root(dot3(way, way)) * flock.goal.w, 1.0f);
    let arrival = select(1.0f, part, less(0.0f, flock.goal.w));
    let rule = flock.goal_rule;
    return steering(vec4<f32>(rule.x, rule.y * arrival, rule.z, 0.0f), way, motion.velocity);
}

// The way to where boids may be, and how far a place is on that side, below 0 on the other one.
struct Surface {
    normal: vec3<f32>,
    distance: f32,
}

fn sign_of(x: f32) -> f32 {
    return select(1.0f, -1.0f, less(x, 0.0f));
}

// Of a ball, from outside; from its very middle along x.
fn sphere_surface(from_center: vec3<f32>, radius: f32) -> Surface {
    let squared = dot3(from_center, from_center);
    let inverse = inverse_square_root(squared);
    let normal = select(vec3<f32>(1.0f, 0.0f, 0.0f), from_center * inverse, less(0.0f, squared));
    return Surface(normal, square_root(squared) - radius);
}

// Of a box, from outside; inside, its nearest face.
fn box_surface(from_center: vec3<f32>, half: vec3<f32>) -> Surface {
    let signs = vec3<f32>(sign_of(from_center.x), sign_of(from_center.y), sign_of(from_center.z));
    let beyond = abs(from_center) - half;
    let outside = max3(beyond, vec3<f32>(0.0f));
    let squared = dot3(outside, outside);
    if less(0.0f, squared) {
        return Surface(outside * inverse_square_root(squared) * signs, square_root(squared));
    }
    if less_equal(beyond.y, beyond.x) && less_equal(beyond.z, beyond.x) {
        return Surface(vec3<f32>(signs.x, 0.0f, 0.0f), beyond.x);
    }
    if less_equal(beyond.z, beyond.y) {
        return Surface(vec3<f32>(0.0f, signs.y, 0.0f), beyond.y);
    }
    return Surface(vec3<f32>(0.0f, 0.0f, signs.z), beyond.z);
}

// The surface of what is told by a few numbers.
fn surface_of(obstacle: Obstacle, position: vec3<f32>) -> Surface {
    let kind = obstacle.kinds.x;
    if kind == OBSTACLE_PLANE {
        return Surface(obstacle.place.xyz, dot3(obstacle.place.xyz, position) - obstacle.place.w);
    }
    let from_center = position - obstacle.place.xyz;
    var surface = box_surface(from_center, obstacle.extent.xyz);
    if kind == OBSTACLE_SPHERE {
        surface = sphere_surface(from_center, obstacle.place.w);
    }
    return facing(obstacle, surface);
}

// What is seen of a surface from outside as it is from where boids may be.
fn facing(obstacle: Obstacle, surface: Surface) -> Surface {
    if obstacle.kinds.y == 1u {
        return Surface(-surface.normal, -surface.distance);
    }
    return surface;
}

// What a boid accelerates by to turn away: nothing beyond the margin, the more the nearer.
fn turned_away(obstacle: Obstacle, surface: Surface) -> vec3<f32> {
    let nearness = clamp_unit(1.0f - surface.distance * obstacle.push.x);
    return surface.normal * (obstacle.push.y * nearness);
}

// Who would be inside is put on the surface, and goes on along it.
fn kept_out(surface: Surface, motion: Motion) -> Motion {
    if !less(surface.distance, 0.0f) {
        return motion;
    }
    let outward = min_exact(dot3(motion.velocity, surface.normal), 0.0f);
    return Motion(
        motion.position - surface.normal * surface.distance,
        motion.velocity - surface.normal * outward,
    );
}
