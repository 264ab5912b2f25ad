// hatch: the boids of a flock as it begins.
//
// The flocking article's constructors: a place in the region and a random direction, by hash of
// who each is. One invocation a boid of the flock; runs in a flock's first frame only.
// Reads: flocks. Writes: boids, boid_trails.
// Invariant: a boid stands at its flock's first plus its index, and stays there.

#import motes::boid::newborn
#import motes::dispatch::linear_index
#import motes::exact::bits_of
#import motes::layout::{Boid, FlockFrame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any flock has trails.
const TRAILS: bool = #{TRAILS};

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read_write> boids: array<Boid>;
@group(0) @binding(2) var<storage, read_write> boid_trails: array<vec4<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn hatch(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flock.members.y {
        return;
    }
    let start = newborn(flock, at);
    let place = start.position;
    let motion = start.velocity;
    boids[flock.members.x + at] = Boid(
        vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), which.flock),
        vec4<u32>(bits_of(motion.x), bits_of(motion.y), bits_of(motion.z), at),
    );
    if TRAILS && flock.trail.z > 0u {
        // It has never been elsewhere.
        let ring = flock.trail.x + at * (flock.trail.y + 1u);
        for (var slot = 0u; slot <= flock.trail.y; slot += 1u) {
            boid_trails[ring + slot] = vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), 0u);
        }
    }
}
