//! The article's own code in double precision and in its own order: one boid after the other, each in
//! place, so that it sees some of the others as they were and some as they are (reading FA4).

use crate::oracle::{Vector, add, limit, mag, set_mag, sub, times};
use crate::support::State;

/// A boid of the article, or an attractor.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    pub(crate) position: Vector,
    pub(crate) velocity: Vector,
    acceleration: Vector,
}

impl Body {
    pub(crate) fn of((position, velocity): &State) -> Self {
        let flat = |[x, y, _]: &[f32; 3]| [f64::from(*x), f64::from(*y)];
        Self {
            position: flat(position),
            velocity: flat(velocity),
            acceleration: [0.0; 2],
        }
    }

    /// `Particle.update`, of one whose greatest speed is 2.
    fn update(&mut self) {
        self.velocity = add(self.velocity, self.acceleration);
        self.position = add(self.position, self.velocity);
        self.velocity = limit(self.velocity, 2.0);
        self.acceleration = [0.0; 2];
    }

    /// `Particle.constrain`, and what the article calls `constrainRepell`, to 50 from the middle.
    fn constrain(&mut self) {
        for axis in 0..2 {
            if self.position[axis].abs() >= 50.0 {
                self.velocity[axis] *= -4.0;
            }
        }
    }

    /// `Particle.wrapEdges` of a canvas of 500 by 300.
    fn wrap(&mut self) {
        for (x, end) in self.position.iter_mut().zip([500.0, 300.0]) {
            if *x < 0.0 {
                *x = end;
            } else if *x > end {
                *x = 0.0;
            }
        }
    }
}

/// `Boid.flock` of the boid at `own`, with those of separation, alignment and cohesion that are on.
fn flock(boids: &mut [Body], own: usize, rules: [bool; 3]) {
    let me = boids[own];
    let (mut count, mut away, mut along, mut toward) = (0.0, [0.0; 2], [0.0; 2], [0.0; 2]);
    for (at, boid) in boids.iter().enumerate() {
        let offset = sub(me.position, boid.position);
        let distance = mag(offset);
        if at == own || distance >= 60.0 {
            continue;
        }
        count += 1.0;
        if distance > 0.0 {
            away = add(away, times(offset, 1.0 / distance));
        }
        along = add(along, boid.velocity);
        toward = add(toward, boid.position);
    }
    if count == 0.0 {
        return;
    }
    let middle = sub(times(toward, 1.0 / count), me.position);
    let ways = [
        (times(away, 1.0 / count), 4.0, 0.3),
        (times(along, 1.0 / count), 4.0, 0.2),
        (middle, 4.5, 0.2),
    ];
    for (way, length, most) in (0..3).filter(|at| rules[*at]).map(|at| ways[at]) {
        let force = limit(sub(set_mag(way, length), me.velocity), most);
        boids[own].acceleration = add(boids[own].acceleration, force);
    }
}

/// A frame of the sketches of one flock on a canvas whose edges wrap.
pub(crate) fn draw_flock(boids: &mut [Body], rules: [bool; 3]) {
    for own in 0..boids.len() {
        flock(boids, own, rules);
        boids[own].update();
        boids[own].wrap();
    }
}

/// A frame of the Rorschach sketch.
pub(crate) fn draw_ink(boids: &mut [Body], attractors: &mut [Body]) {
    for attractor in attractors.iter_mut() {
        attractor.update();
        attractor.constrain();
        for boid in boids.iter_mut() {
            let way = sub(attractor.position, boid.position);
            if mag(way) < 60.0 {
                boid.acceleration = add(boid.acceleration, limit(way, 0.4));
            }
        }
    }
    for own in 0..boids.len() {
        flock(boids, own, [true; 3]);
        let me = &mut boids[own];
        for attractor in attractors.iter() {
            let way = sub(me.position, attractor.position);
            if mag(way) < 40.0 {
                me.acceleration = add(me.acceleration, limit(sub(way, me.velocity), 1.0));
            }
        }
        me.update();
        me.constrain();
    }
}
