//! Yardsticks of a device.

use super::Entry;
use crate::backend::BackendError;
use crate::bench::copy::{forms, of_form, timed};
use crate::bench::flames::FLAME_SIZES;
use crate::bench::splats::{SHAPES, SIZE_PX};
use crate::gpu::{
    self, GpuDevice, RasterShape, RasterTarget, SortYardstick, Yardstick, YardstickMemory,
    sort_bytes,
};
use crate::layout::FLAME_STEPS;
use std::rc::Rc;

/// Invocations in a workgroup of what is not tried in several sizes.
const WORKGROUP: u32 = 256;

/// A kernel over all records, one an invocation: its name, its file, the bytes that it moves for
/// each, what it is.
type Line = (&'static str, &'static str, u64, &'static str);

const KERNELS: &[Line] = &[
    ("read_only", "bench/read_only", 32, "32 bytes a record"),
    ("write_only", "bench/write_only", 32, "32 bytes a record"),
    (
        "atomic_add_spread",
        "bench/atomic_spread",
        8,
        "over 2^21 words",
    ),
    (
        "atomic_add_contended",
        "bench/atomic_contended",
        0,
        "to one word",
    ),
    (
        "noise_simplex",
        "bench/noise_simplex",
        64,
        "a sample of the wind's noise",
    ),
    (
        "noise_lattice",
        "bench/noise_lattice",
        64,
        "a sample of noise on a cubic lattice",
    ),
];

/// An entry that owns what it runs on together with others.
fn entry(
    memory: &Rc<YardstickMemory>,
    name: impl Into<String>,
    bytes: u64,
    mut yardstick: Yardstick,
) -> Entry {
    let kept = Rc::clone(memory);
    let items = memory.records().into();
    let run = Box::new(move || {
        let _ = &kept;
        timed(&mut yardstick)
    });
    Entry::new(name, items, bytes, run)
}

/// All but the rasteriser.
pub(super) fn entries(device: &GpuDevice, records: u32) -> Result<Vec<Entry>, BackendError> {
    let memory = Rc::new(YardstickMemory::new(device, records)?);
    let count = u64::from(records);
    let copied = Yardstick::copy_buffer(&memory)?;
    let mut entries = vec![Entry {
        by_interface: true,
        ..entry(&memory, "copy_buffer", 64 * count, copied)
    }];
    for form in forms(device) {
        let (_, size, yardstick) = of_form(&memory, form)?;
        let name = form.1.replace("bench/", "");
        let name = format!("form_{name}");
        let note = format!("{}, workgroups of {size}", form.0);
        entries.push(Entry {
            is_copy: true,
            ..entry(&memory, name, 64 * count, yardstick).noted(note)
        });
    }
    for (name, kernel, bytes, about) in KERNELS {
        let yardstick = Yardstick::kernel(&memory, name, kernel, WORKGROUP, |records| records)?;
        entries.push(entry(&memory, *name, bytes * count, yardstick).noted(*about));
    }
    // Bits are read twice and sums written: one word for each 32 particles.
    let words = count.div_ceil(32);
    let scan = Yardstick::scan(&memory, WORKGROUP)?;
    entries.push(entry(&memory, "scan", words * 12, scan).noted("one bit a record, five kernels"));
    entries.push(sort(device, records)?);
    Ok(entries)
}

/// The stable sort of as many pairs, at most as many as a binding holds.
fn sort(device: &GpuDevice, pairs: u32) -> Result<Entry, BackendError> {
    let mut sort = SortYardstick::new(device, pairs, WORKGROUP)?;
    let items = u64::from(sort.count());
    let about = format!("{items} pairs by keys of 32 bits, 8 a pass, four kernels each");
    let run = Box::new(move || timed(&mut sort.yardstick));
    Ok(Entry::new("sort", items, sort_bytes(items), run).noted(about))
}

/// What the device's own rasteriser needs for as many particles, of the small discs' size, and for the fans
/// of as many flames.
pub(super) fn rasters(device: &GpuDevice, particles: u32) -> Result<Vec<Entry>, BackendError> {
    let disc = SHAPES
        .iter()
        .find(|shape| shape.name == "splat_discs_small");
    // As wide as what the splat covers, to a thousandth of a pixel.
    let radius_px = disc.map_or(1.0, |shape| shape.edged_radius_px());
    let quads = RasterShape::Quads {
        radius_millipixels: (radius_px * 1e3).round() as u32,
    };
    let side = 2.0 * radius_px + 1.0;
    // A device of its own: after a render pass, llvmpipe (Mesa 22.3.6) runs no more compute on one.
    let Some(device) = gpu::open(&device.description.name)? else {
        return Ok(Vec::new());
    };
    let mut entries = Vec::new();
    for (name, shape, target, covered, about) in [
        (
            "raster_points_half",
            RasterShape::Points,
            RasterTarget::Half,
            1.0,
            "points of one pixel, blended into 16-bit floats",
        ),
        (
            "raster_points_single",
            RasterShape::Points,
            RasterTarget::Single,
            1.0,
            "points of one pixel, blended into 32-bit floats",
        ),
        (
            "raster_quads_half",
            quads,
            RasterTarget::Half,
            side * side,
            "two triangles each, blended into 16-bit floats",
        ),
        (
            "raster_quads_single",
            quads,
            RasterTarget::Single,
            side * side,
            "two triangles each, blended into 32-bit floats",
        ),
    ] {
        let Some(mut yardstick) = device.raster(name, shape, target, particles, SIZE_PX)? else {
            continue;
        };
        let run = Box::new(move || timed(&mut yardstick));
        entries.push(Entry {
            covered_px: Some(covered * f64::from(particles)),
            ..Entry::new(name, particles.into(), 0, run).noted(about)
        });
    }
    for size in FLAME_SIZES {
        let shape = RasterShape::Fans {
            half_width_px: size.width_px / 2,
            height_px: size.height_px() as u32,
        };
        let count = size.flames(particles);
        let fans = count * FLAME_STEPS;
        let targets = [
            (
                RasterTarget::Half,
                "20 triangles each, blended into 16-bit floats",
            ),
            (
                RasterTarget::Single,
                "20 triangles each, blended into 32-bit floats",
            ),
        ];
        for (name, (target, about)) in size.rasters.into_iter().zip(targets) {
            let Some(mut yardstick) = device.raster(name, shape, target, fans, SIZE_PX)? else {
                continue;
            };
            let run = Box::new(move || timed(&mut yardstick));
            entries.push(Entry {
                covered_px: Some(size.covered_px() * f64::from(count)),
                ..Entry::new(name, fans.into(), 0, run).noted(about)
            });
        }
    }
    Ok(entries)
}
