//! cover: in every pixel, what covers it, from near to far.
//!
//! Not a translation of the kernels under `wgsl/draw/`: records are sorted by the standard library,
//! and painted one after another.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::cover::{Layered, Spot, behind, bounds_of, far_to_near};
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

/// Red and green, and blue and what shows through, of every pixel.
pub fn cover(covers: &[Cover], frame: &Frame, rg: &mut [[u32; 2]], bt: &mut [[u32; 2]]) {
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
    rows.enumerate().for_each(|(band, (rg, bt))| {
        let top = band * BAND_ROWS;
        let bottom = (top + BAND_ROWS).min(height);
        let pixels = painted(&seen, light_from, width, top..bottom);
        for ((rg, bt), pixel) in rg.iter_mut().zip(bt).zip(pixels) {
            *rg = [pixel.color.x, pixel.color.y].map(bits_of);
            *bt = [pixel.color.z, pixel.clear].map(bits_of);
        }
    });
}

/// The pixels of some rows: each record, from near to far, goes behind what its pixels show so far.
fn painted(
    near_to_far: &[(&Cover, [i32; 4])],
    light_from: Vec3,
    width: usize,
    rows: Range<usize>,
) -> Vec<Layered> {
    let mut pixels = vec![Layered::EMPTY; width * rows.len()];
    let (top, bottom) = (rows.start as i32, rows.end as i32);
    for (cover, [left, first, right, end]) in near_to_far {
        for y in *first.max(&top)..*end.min(&bottom) {
            let row = (y - top) as usize * width;
            for x in *left..*right {
                let pixel = &mut pixels[row + x as usize];
                if !pixel.is_closed() {
                    let width = width as i32;
                    *pixel = behind(*pixel, cover, light_from, Spot { x, y, width });
                }
            }
        }
    }
    pixels
}
