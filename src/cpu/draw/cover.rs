//! cover: in every pixel, what covers it, from near to far.
//!
//! Not a translation of the kernels under `wgsl/draw/`: records are sorted by the standard library,
//! and each row of tiles looks through all of them.

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::cover::{Layered, behind, bounds_of, far_to_near};
use crate::exact::bits_of;
use crate::layout::{COVER_NONE, Cover, Frame};

/// Pixels of a tile's side.
const TILE_PX: usize = 32;

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
    let band = width * TILE_PX;
    let rows = rg.par_chunks_mut(band).zip(bt.par_chunks_mut(band));
    rows.enumerate().for_each(|(band, (rg, bt))| {
        let top = band * TILE_PX;
        let bottom = (top + TILE_PX).min(height);
        let meets = |[_, first, _, end]: &[i32; 4]| *first < bottom as i32 && *end > top as i32;
        let of_band: Vec<_> = seen.iter().filter(|(_, bounds)| meets(bounds)).collect();
        for left in (0..width).step_by(TILE_PX) {
            let right = (left + TILE_PX).min(width);
            let of_tile: Vec<&Cover> = of_band
                .iter()
                .filter(|(_, [first, _, end, _])| *first < right as i32 && *end > left as i32)
                .map(|(cover, _)| *cover)
                .collect();
            for y in top..bottom {
                for x in left..right {
                    let pixel = pixel_of(&of_tile, light_from, x as i32, y as i32);
                    let at = (y - top) * width + x;
                    rg[at] = [pixel.color.x, pixel.color.y].map(bits_of);
                    bt[at] = [pixel.color.z, pixel.clear].map(bits_of);
                }
            }
        }
    });
}

fn pixel_of(near_to_far: &[&Cover], light_from: Vec3, x: i32, y: i32) -> Layered {
    let mut pixel = Layered::EMPTY;
    for cover in near_to_far {
        pixel = behind(pixel, cover, light_from, x, y);
        if pixel.is_closed() {
            break;
        }
    }
    pixel
}
