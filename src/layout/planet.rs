//! What a planet adds to the shared structs (Reeves 1983, section 3).

use bytemuck::{Pod, Zeroable};

/// A ball with a surface, as one frame sees it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Planet {
    /// From the eye to its centre, world space; radius.
    pub place: [f32; 4],
    /// The eye, world space; squared distance of the centre less squared radius.
    pub eye: [f32; 4],
    /// The part of the light that it reflects; slope of its relief.
    pub color: [f32; 4],
    /// Noise cells a world unit, contrast; z and w unused.
    pub ground: [f32; 4],
    /// Where the light comes from, world space; w unused.
    pub light_from: [f32; 4],
    /// Its colour; w unused.
    pub light_color: [f32; 4],
    /// Light from everywhere; w unused.
    pub ambient: [f32; 4],
    /// Octaves of the noise, its key, lamps; w unused.
    pub kinds: [u32; 4],
}

/// A light near the planet.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Lamp {
    /// From the planet's centre to it, world space; squared distance at which its light is as the
    /// colour says.
    pub place: [f32; 4],
    /// Red, green, blue; w unused.
    pub color: [f32; 4],
}
