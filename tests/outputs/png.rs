//! One picture in bytes.

use std::fs;

use motes::output::{FrameSink, Rgba8Image, write_png};

use crate::{decode_png, error, glow, image, names_in, rgb, set, target};

#[test]
fn opaque_png_is_rgb_and_keeps_every_byte() {
    let dir = tempfile::tempdir().unwrap();
    let picture = glow(3);
    let path = dir.path().join("deep/er/one.png");
    write_png(&path, &picture).unwrap();
    let (colour_type, bytes) = decode_png(&path);
    assert_eq!(colour_type, png::ColorType::Rgb);
    assert_eq!(bytes, rgb(&picture).concat());
    let again = dir.path().join("again.png");
    write_png(&again, &picture).unwrap();
    assert_eq!(fs::read(path).unwrap(), fs::read(again).unwrap());
}

#[test]
fn png_with_transparency_is_rgba_and_keeps_every_byte() {
    let dir = tempfile::tempdir().unwrap();
    let picture = image(33, 7, |x, y| [x as u8, y as u8, 9, (x * y) as u8]);
    let path = dir.path().join("layer.png");
    write_png(&path, &picture).unwrap();
    assert_eq!(
        decode_png(&path),
        (png::ColorType::Rgba, picture.pixels.clone())
    );
}

#[test]
fn a_picture_that_does_not_fit_its_size_is_an_error() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.png");
    for (width, height, bytes) in [(2, 2, 15), (0, 2, 0), (u32::MAX, u32::MAX, 4)] {
        let picture = Rgba8Image {
            width,
            height,
            pixels: vec![0; bytes],
        };
        assert!(error(write_png(&path, &picture)).is_users_fault());
    }
    assert_eq!(names_in(dir.path()), set(&[]));
}

#[test]
fn one_png_takes_one_frame() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("one.png");
    let refused = error(FrameSink::open(&target(&path), 4, 3, 24.0, 2));
    assert!(refused.is_users_fault());
    assert!(
        refused
            .to_string()
            .contains("use name-%04d.png, .gif or .mp4")
    );
    let frame = image(4, 3, |_, _| [0, 0, 0, 255]);
    let mut sink = FrameSink::open(&target(&path), 4, 3, 24.0, 1).unwrap();
    sink.write_frame(9, &frame).unwrap();
    assert!(error(sink.write_frame(10, &frame)).is_users_fault());
    assert_eq!(names_in(dir.path()), set(&["one.png"]));
}
