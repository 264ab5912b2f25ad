//! Files of linear light, read back.

use std::fs;
use std::path::Path;

use exr::prelude::{
    Compression, FlatSamples, ReadChannels, ReadLayers, Text, Vec2, attribute::Chromaticities, read,
};
use motes::output::{FrameSink, LinearImage, OutputTarget, Picture, Pixels, Rgba8Image, write_exr};

use crate::linear::displayed;
use crate::studio::Studio;
use crate::{common, decode_png, error, image, names_in, set, target};

type Read = exr::image::Image<exr::image::Layer<exr::image::AnyChannels<FlatSamples>>>;

fn decode(path: &Path) -> Read {
    read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .expect("an EXR")
}

/// Red, green, blue and alpha of each pixel.
fn pixels_of(file: &Read) -> Vec<[f32; 4]> {
    let channels = &file.layer_data.channel_data.list;
    let names: Vec<_> = channels.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["A", "B", "G", "R"]);
    let channel = |at: usize| match &channels[at].sample_data {
        FlatSamples::F32(values) => values,
        _ => panic!("32-bit floats"),
    };
    (0..channel(0).len())
        .map(|at| [3, 2, 1, 0].map(|c| channel(c)[at]))
        .collect()
}

fn linear(width: u32, height: u32, value: impl Fn(usize) -> f32) -> LinearImage {
    LinearImage {
        width,
        height,
        pixels: (0..3 * (width * height) as usize).map(value).collect(),
        is_layer: false,
        hidden: Vec::new(),
        comment: String::new(),
    }
}

/// Bright and dark by turns, over all exponents that light has.
fn wild(at: usize) -> f32 {
    match at % 5 {
        0 => 0.0,
        1 => f32::from_bits(common::hash(at as u32) % 0x7000_0000),
        2 => 1.0,
        _ => at as f32 / 700.0,
    }
}

#[test]
fn exr_keeps_every_float_and_says_what_they_are() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("deep/er/one.exr");
    // 37 rows are two blocks of 16 and a part.
    let mut picture = linear(43, 37, wild);
    picture.comment = "fünf sparks, seed 7, frame 12".into();
    write_exr(&path, &picture).unwrap();
    let file = decode(&path);
    assert_eq!(file.layer_data.size, Vec2(43, 37));
    assert_eq!(file.layer_data.encoding.compression, Compression::ZIP16);
    let got: Vec<u32> = pixels_of(&file)
        .concat()
        .into_iter()
        .map(f32::to_bits)
        .collect();
    let (wanted, _) = picture.pixels.as_chunks::<3>();
    let wanted: Vec<u32> = wanted
        .iter()
        .flat_map(|&[r, g, b]| [r, g, b, 1.0].map(f32::to_bits))
        .collect();
    assert!(got == wanted);
    assert_eq!(
        file.attributes.chromaticities,
        Some(Chromaticities {
            red: Vec2(0.64, 0.33),
            green: Vec2(0.3, 0.6),
            blue: Vec2(0.15, 0.06),
            white: Vec2(0.3127, 0.329),
        })
    );
    assert_eq!(file.attributes.pixel_aspect, 1.0);
    let own = &file.layer_data.attributes;
    assert_eq!(
        own.comments,
        Some(Text::from("f?nf sparks, seed 7, frame 12"))
    );
    assert_eq!(own.capture_date, None);
    let again = dir.path().join("again.exr");
    write_exr(&again, &picture).unwrap();
    assert!(fs::read(path).unwrap() == fs::read(again).unwrap());
}

#[test]
fn alpha_of_a_layer_is_its_brightest_channel() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("layer.exr");
    let mut picture = linear(3, 1, |_| 0.0);
    picture.pixels = vec![0.25, 0.5, 0.125, 0.0, 0.0, 0.0, 3.0, 0.5, 7.0];
    Picture::Linear(picture).into_layer().write(&path).unwrap();
    let wanted = [
        [0.25, 0.5, 0.125, 0.5],
        [0.0, 0.0, 0.0, 0.0],
        [3.0, 0.5, 7.0, 1.0],
    ];
    assert_eq!(pixels_of(&decode(&path)), wanted);
}

#[test]
fn exr_files_are_named_and_counted_like_pngs() {
    let dir = tempfile::tempdir().unwrap();
    let picture = linear(4, 3, wild);
    let pattern = target(&dir.path().join("a-%03d.exr"));
    assert_eq!(pattern.pixels(), Pixels::Linear);
    let mut sink = FrameSink::open(&pattern, 4, 3, 24.0, 2).unwrap();
    for frame in [7, 12345] {
        sink.write_frame(frame, &picture).unwrap();
    }
    assert_eq!(sink.finish().unwrap().frames, 2);
    assert_eq!(names_in(dir.path()), set(&["a-007.exr", "a-12345.exr"]));
    let layer = |target: &OutputTarget| target.layer_path(9, "left");
    assert_eq!(layer(&pattern), Some(dir.path().join("a-009-left.exr")));

    let one = target(&dir.path().join("one.exr"));
    assert_eq!(layer(&one), Some(dir.path().join("one-left.exr")));
    let refused = error(FrameSink::open(&one, 4, 3, 24.0, 2));
    assert!(refused.is_users_fault());
    assert!(
        refused.to_string().contains("use name-%04d.exr"),
        "{refused}"
    );
    let mut sink = FrameSink::open(&one, 4, 3, 24.0, 1).unwrap();
    sink.write_frame(0, &picture).unwrap();
    assert!(error(sink.write_frame(1, &picture)).is_users_fault());

    // What does not fit is refused, bytes among it.
    let mut sink = FrameSink::open(&one, 4, 3, 24.0, 1).unwrap();
    let bytes = image(4, 3, |_, _| [0; 4]);
    for refused in [
        sink.write_frame(0, &bytes),
        sink.write_frame(0, &linear(3, 4, wild)),
        FrameSink::open(&target(&dir.path().join("x.png")), 4, 3, 24.0, 1)
            .unwrap()
            .write_frame(0, &picture),
        write_exr(&dir.path().join("x.exr"), &linear(0, 4, wild)),
    ] {
        assert!(error(refused).is_users_fault());
    }
    let mut short = picture.clone();
    short.pixels.pop();
    assert!(error(write_exr(&dir.path().join("x.exr"), &short)).is_users_fault());
    assert!(!dir.path().join("x.exr").exists());
}

#[test]
fn the_program_writes_the_same_exrs_again_and_layers_beside_them() {
    let studio = Studio::new();
    let run = |out: &str, threads: &str| {
        let arguments = ["-o", out, "--frames", "4..6", "--layers"];
        let mut command = studio.render(&arguments);
        let (code, told) = crate::studio::ended(command.env("RAYON_NUM_THREADS", threads).output());
        assert_eq!(code, 0, "{told}");
    };
    let named = |start: &str| -> Vec<String> {
        let names = ["04-left", "04-rest", "04", "05-left", "05-rest", "05"];
        names.iter().map(|n| format!("{start}-{n}.exr")).collect()
    };
    run("a-%02d.exr", "1");
    assert_eq!(studio.files(), named("a"));
    run("b-%02d.exr", "3");
    for (a, b) in named("a").iter().zip(named("b")) {
        let bytes = |name: &str| fs::read(studio.path(name)).unwrap();
        assert!(bytes(a) == bytes(&b), "{a}");
    }
    studio.rendered(&["-o", "c.png", "--frame", "4"]);
    let file = decode(&studio.path("a-04.exr"));
    let comment = Text::from("sparks, seed 7, frame 4");
    assert_eq!(file.layer_data.attributes.comments, Some(comment));
    let comment = Text::from("sparks, seed 7, frame 5, layer left");
    let layer = decode(&studio.path("a-05-left.exr"));
    assert_eq!(layer.layer_data.attributes.comments, Some(comment));
    // The right half of the left layer is dark, and has no alpha.
    let pixels = pixels_of(&layer);
    assert_eq!(pixels[160], [0.0; 4]);
    assert!(pixels.iter().any(|pixel| pixel[0] > 0.1));
    let shown: Vec<u8> = pixels_of(&file)
        .iter()
        .flat_map(|&[r, g, b, _]| [r, g, b].map(|v| (displayed(v) * 255.0 + 0.5) as u8))
        .collect();
    let bytes = decode_png(&studio.path("c.png")).1;
    let different = shown.iter().zip(&bytes).filter(|(a, b)| a != b).count();
    assert!(different * 1000 < bytes.len(), "{different} bytes differ");
}

#[test]
fn a_picture_goes_to_the_file_of_its_pixels() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("one");
    let bytes: Rgba8Image = image(2, 1, |x, _| [x as u8, 1, 2, 255]);
    Picture::Bytes(bytes).write(&path).unwrap();
    assert_eq!(decode_png(&path).1, [0, 1, 2, 1, 1, 2]);
    Picture::Linear(linear(2, 1, wild)).write(&path).unwrap();
    assert_eq!(decode(&path).layer_data.size, Vec2(2, 1));
}
