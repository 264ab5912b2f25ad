//! Wind (Perry 1994, 3.2.3).

/// One part of the wind: a velocity at each place, units a frame (Perry 1994, 3.2.3). Drag makes
/// particles follow it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wind {
    /// The same everywhere.
    Uniform {
        /// World units a frame.
        velocity: [f32; 3],
    },
    /// -k_g g: what is hot rises against gravity.
    Buoyancy {
        /// g, a direction with a length.
        gravity: [f32; 3],
        /// k_g.
        strength: f32,
    },
    /// The same everywhere, now stronger, now weaker.
    Gusts {
        /// On average, world units a frame.
        velocity: [f32; 3],
        /// How far it strays from that, as a share of it, 0 ..= 10.
        amplitude: f32,
        /// How long a gust lasts, 1 ..= 1,000,000 frames.
        frames: f32,
    },
    /// Around an axis: fastest at `radius` (Scully's vortex).
    Vortex {
        /// A point of the axis.
        position: [f32; 3],
        /// Its direction; not zero.
        axis: [f32; 3],
        /// Greatest speed, world units a frame; negative the other way around.
        speed: f32,
        /// Of the core, world units.
        radius: f32,
    },
    /// Out of a point as an incompressible fluid flows, negative strength into it.
    Source {
        /// The point.
        position: [f32; 3],
        /// Speed times squared distance, far away.
        strength: f32,
        /// Within which it slows down, world units.
        radius: f32,
    },
    /// Toward a point, as fast from anywhere.
    Attractor {
        /// The point.
        position: [f32; 3],
        /// World units a frame; negative away from it.
        speed: f32,
        /// Within which it slows down, world units.
        radius: f32,
    },
    /// The gradient of a noise: eddies of all sizes, with sources and sinks.
    Noise(Turbulence),
    /// The product of two such gradients, which is as swirling and has neither.
    Curl(Turbulence),
}

/// A noise that wind is made of (Perry 1994, 2.1.2, 3.2.3 and 3.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turbulence {
    /// C: root mean square of one octave's speed, world units a frame.
    pub strength: f32,
    /// k_p: noise cells a world unit along each axis, 0 ..= 10,000. Default 1.
    pub scale: [f32; 3],
    /// k_s j: how the pattern moves, noise cells a frame. Default 0.
    pub drift: [f32; 3],
    /// Octaves, 1 ..= 8, each of twice the frequency. Default 1.
    pub octaves: u32,
    /// beta: the power of the noise falls as 1 / frequency^beta from octave to octave, 0 ..= 8.
    /// Default 11/3, which makes the wind's fall as 1 / frequency^(5/3).
    pub spectrum_exponent: f32,
    /// Whether octaves count by their absolute value, which folds them (Perlin's turbulence).
    pub absolute: bool,
}
