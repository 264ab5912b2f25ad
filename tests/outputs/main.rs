//! What leaves Motes, read back by other programs' means: the decoders of `png`, `gif` and `exr`, ffmpeg, and small
//! readers of our own for PLY and CSV; and what is left when writing ends early or is refused.

#[path = "../common/mod.rs"]
mod common;
mod exr;
mod gif;
mod linear;
mod mp4;
mod places;
mod png;
mod studio;
mod tables;
mod target;

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::Path;

use motes::output::{OutputError, OutputTarget, Rgba8Image};

/// A picture made pixel by pixel.
fn image(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 4]) -> Rgba8Image {
    let at = |i| colour(i % width, i / width);
    Rgba8Image {
        width,
        height,
        pixels: (0..width * height).flat_map(at).collect(),
    }
}

/// Glows of two hues that drift over black, as additive particles make them; more than 256 colours.
fn glow(frame: u32) -> Rgba8Image {
    image(160, 90, |x, y| {
        let light = |centre_x: f32, centre_y: f32| {
            let (dx, dy) = (x as f32 - centre_x, y as f32 - centre_y);
            (1.0 - (dx * dx + dy * dy) / 1600.0).max(0.0).powi(2) * 300.0
        };
        let fire = light(50.0 + frame as f32, 45.0);
        let spark = light(110.0 - 2.0 * frame as f32, 40.0);
        let add = |share: f32, other: f32| (share * fire + other * spark).min(255.0) as u8;
        [add(1.0, 0.3), add(0.45, 0.7), add(0.1, 1.0), 255]
    })
}

fn target(path: &Path) -> OutputTarget {
    OutputTarget::parse(path.to_str().expect("a path of the test")).expect("a target")
}

fn names_in(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries
        .map(|entry| entry.expect("an entry").file_name().into_string().unwrap())
        .collect()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn error<T>(result: Result<T, OutputError>) -> OutputError {
    result.err().expect("this cannot work")
}

fn decode_png(path: &Path) -> (::png::ColorType, Vec<u8>) {
    let file = std::io::BufReader::new(File::open(path).expect("a file"));
    let mut reader = ::png::Decoder::new(file).read_info().expect("a PNG");
    assert_eq!(reader.info().bit_depth, ::png::BitDepth::Eight);
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    let info = reader.next_frame(&mut bytes).expect("a picture");
    bytes.truncate(info.buffer_size());
    (info.color_type, bytes)
}

fn rgb(image: &Rgba8Image) -> Vec<[u8; 3]> {
    let (pixels, _) = image.pixels.as_chunks::<4>();
    pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
}
