//! cover: in every pixel, what covers it, from near to far.
//!
//! Not a translation of the kernels under `wgsl/draw/`: records are sorted by the standard library,
//! and painted one after another.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::behind::Parted;
use crate::cpu::cover::{Spot, behind, bounds_of, far_to_near};
use crate::exact::bits_of;
use crate::layout::{COVER_NONE, Cover, Frame};

/// Rows of pixels that one task paints.
const BAND_ROWS: usize = 8;

/// Indices of the records that cover something, from near to far: the reverse of the order by depth
/// and, of equal depth, identity.
fn near_to_far(covers: &[Cover]) -> Vec<u32> {
    let is_something = |at: &u32| covers[*at as usize].shape[2] != COVER_NONE;
    let mut order: Vec<u32> = (0..covers.len() as u32).filter(is_something).collect();
    order.par_sort_by_key(|at| far_to_near(&covers[*at as usize]));
    order.reverse();
    order
}

/// What becomes of every pixel.
#[derive(Debug)]
pub struct Pixels<'a> {
    /// Red and green.
    pub rg: &'a mut [[u32; 2]],
    /// Blue, and what shows through.
    pub bt: &'a mut [[u32; 2]],
    /// What of surfaces shows through; empty if there are none.
    pub front: &'a mut [u32],
}

/// The pixels; `nearness` is that of surfaces in each pixel's samples, empty if there are none.
pub fn cover(covers: &[Cover], frame: &Frame, nearness: &[[u32; 4]], out: Pixels<'_>) {
    let Pixels { rg, bt, front } = out;
    let (width, height) = (frame.width as usize, frame.height as usize);
    let order = near_to_far(covers);
    let light_from = Vec3::from_slice(&frame.light_from);
    let seen: Vec<(&Cover, [i32; 4])> = order
        .iter()
        .map(|at| &covers[*at as usize])
        .map(|cover| (cover, bounds_of(cover, frame.width, frame.height)))
        .collect();
    let band = width * BAND_ROWS;
    let rows = rg.par_chunks_mut(band).zip(bt.par_chunks_mut(band));
    let painted = rows.enumerate().map(|(band, (rg, bt))| {
        let top = band * BAND_ROWS;
        let bottom = (top + BAND_ROWS).min(height);
        let pixels = painted(&seen, light_from, width, top..bottom, nearness);
        for ((rg, bt), pixel) in rg.iter_mut().zip(bt).zip(&pixels) {
            *rg = [pixel.open.color.x, pixel.open.color.y].map(bits_of);
            *bt = [pixel.open.color.z, pixel.open.clear].map(bits_of);
        }
        pixels
            .into_iter()
            .map(|pixel| bits_of(pixel.front))
            .collect::<Vec<_>>()
    });
    if front.is_empty() {
        painted.for_each(drop);
        return;
    }
    let fronts: Vec<Vec<u32>> = painted.collect();
    for (front, bits) in front.iter_mut().zip(fronts.into_iter().flatten()) {
        *front = bits;
    }
}

/// What the part `front`, as bits, of the light of a surface's pixel is. Twin of `wgsl/draw/dim.wgsl`.
pub fn dim([red, green, blue, clear]: [u32; 4], front: u32) -> [u32; 4] {
    let dimmed = |light: u32| bits_of(f32::from_bits(light) * f32::from_bits(front));
    [dimmed(red), dimmed(green), dimmed(blue), clear]
}

/// The pixels of some rows: each record, from near to far, goes behind what its pixels show so far.
fn painted(
    near_to_far: &[(&Cover, [i32; 4])],
    light_from: Vec3,
    width: usize,
    rows: Range<usize>,
    nearness: &[[u32; 4]],
) -> Vec<Parted> {
    let mut pixels = vec![Parted::EMPTY; width * rows.len()];
    let (top, bottom) = (rows.start as i32, rows.end as i32);
    for (cover, [left, first, right, end]) in near_to_far {
        for y in *first.max(&top)..*end.min(&bottom) {
            let row = (y - top) as usize * width;
            for x in *left..*right {
                let pixel = &mut pixels[row + x as usize];
                let spot = Spot {
                    x,
                    y,
                    width: width as i32,
                };
                match nearness.get(y as usize * width + x as usize) {
                    Some(nearness) if !pixel.is_closed(*nearness) => {
                        *pixel = pixel.behind(cover, light_from, spot, *nearness);
                    }
                    None if !pixel.open.is_closed() => {
                        pixel.open = behind(pixel.open, cover, light_from, spot);
                    }
                    _ => {}
                }
            }
        }
    }
    pixels
}
