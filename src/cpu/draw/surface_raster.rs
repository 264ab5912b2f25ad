//! surface_raster: which triangle is seen in every sample, and how near it is. Twin of
//! `wgsl/draw/surface_raster.wgsl`, which shares the work out.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::raster::{
    BLOCK_PX, Edges, Nearness, Polygon, SAMPLES_DOWN, SAMPLES_RIGHT, corner_seen,
};
use crate::exact::{bits_of, f32_of_i32};
use crate::layout::{Frame, SurfaceFrame};

/// Hands every sample of the picture that a triangle covers to `touch`, with how near it is there.
fn samples(frame: &Frame, corners: [Vec3; 3], touch: impl Fn(usize, u32)) {
    let polygon = Polygon::new(frame, corners);
    let [across, down] = polygon.blocks();
    let near = Nearness::new(frame, corners);
    for (at, block) in
        (0..polygon.triangles()).flat_map(|at| (0..across * down).map(move |b| (at, b)))
    {
        let place = [block % across, block / across];
        let pixel = [0, 1].map(|axis| polygon.first[axis] + place[axis] * BLOCK_PX);
        let size = [0, 1].map(|axis| (polygon.end[axis] - pixel[axis]).min(BLOCK_PX));
        let edges = Edges::new(polygon.triangle(at), pixel);
        if edges.misses(size) {
            continue;
        }
        for (down, right) in (0..size[1]).flat_map(|down| (0..size[0]).map(move |x| (down, x))) {
            let [x, y] = [pixel[0] + right, pixel[1] + down];
            let first = (y as usize * frame.width as usize + x as usize) * 4;
            for (sample, inside) in edges.samples_in(right, down).into_iter().enumerate() {
                if inside {
                    let right = f32_of_i32(x) - frame.center_x_px + SAMPLES_RIGHT[sample];
                    let up = frame.center_y_px - f32_of_i32(y) - SAMPLES_DOWN[sample];
                    touch(first + sample, bits_of(near.at(right, up)));
                }
            }
        }
    }
}

/// Nearness and triangle, and 1, of every sample; `corners` are those of all stored triangles.
pub fn surface_raster(
    frame: &Frame,
    surfaces: &[SurfaceFrame],
    corners: &[[u32; 4]],
) -> [Vec<u32>; 2] {
    let count = frame.width as usize * frame.height as usize * 4;
    let [nearness, faces] = [(); 2].map(|()| {
        let mut samples = Vec::with_capacity(count);
        samples.resize_with(count, AtomicU32::default);
        samples
    });
    let each = |touch: &(dyn Fn(u32, usize, u32) + Sync)| {
        for surface in surfaces {
            let [first, count, number, _] = surface.faces;
            (0..count).into_par_iter().for_each(|face| {
                let at = (first + face) as usize * 3;
                let seen = [0, 1, 2].map(|corner| {
                    let [x, y, z, _] = corners[at + corner].map(f32::from_bits);
                    corner_seen(frame, surface, Vec3::new(x, y, z))
                });
                samples(frame, seen, |sample, bits| {
                    touch(number + face, sample, bits)
                });
            });
        }
    };
    each(&|_, sample, bits| {
        nearness[sample].fetch_max(bits, Ordering::Relaxed);
    });
    each(&|face, sample, bits| {
        if nearness[sample].load(Ordering::Relaxed) == bits {
            faces[sample].fetch_max(face + 1, Ordering::Relaxed);
        }
    });
    [nearness, faces].map(|samples| samples.into_iter().map(AtomicU32::into_inner).collect())
}
