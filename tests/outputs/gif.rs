//! An animation as a viewer sees it.

use std::fs::{self, File};
use std::path::Path;

use motes::output::{FrameSink, Rgba8Image, Written};

use crate::{glow, image, rgb, target};

/// A GIF as a viewer sees it.
pub(crate) struct Seen {
    repeat: gif::Repeat,
    /// Of each frame: hundredths of a second, width and height of its rectangle, all pixels of the screen (RGB).
    pub(crate) frames: Vec<(u16, u16, u16, Vec<[u8; 3]>)>,
}

pub(crate) fn see_gif(path: &Path) -> Seen {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(File::open(path).expect("a file"))
        .expect("a GIF");
    let width = usize::from(decoder.width());
    // A colour that no test draws, so that what is never drawn shows.
    let mut screen = vec![[1, 2, 3]; width * usize::from(decoder.height())];
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        assert_eq!(frame.dispose, gif::DisposalMethod::Keep);
        let (pixels, _) = frame.buffer.as_chunks::<4>();
        for (i, &[red, green, blue, alpha]) in pixels.iter().enumerate() {
            let (x, y) = (i % usize::from(frame.width), i / usize::from(frame.width));
            let place = (y + usize::from(frame.top)) * width + x + usize::from(frame.left);
            if alpha != 0 {
                screen[place] = [red, green, blue];
            }
        }
        frames.push((frame.delay, frame.width, frame.height, screen.clone()));
    }
    Seen {
        repeat: decoder.repeat(),
        frames,
    }
}

pub(crate) fn write_gif(path: &Path, frame_rate: f64, frames: &[Rgba8Image]) -> Written {
    let (width, height) = (frames[0].width, frames[0].height);
    let mut sink = FrameSink::open(
        &target(path),
        width,
        height,
        frame_rate,
        frames.len() as u32,
    )
    .expect("a sink");
    for (number, frame) in frames.iter().enumerate() {
        sink.write_frame(number as u32, frame).expect("a frame");
    }
    sink.finish().expect("a GIF")
}

#[test]
fn gif_repeats_and_lasts_as_long_as_its_frames() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.gif");
    let frames: Vec<_> = (0..50)
        .map(|f| image(3, 3, |x, _| [f as u8 * 5, x as u8, 0, 255]))
        .collect();
    for (frame_rate, hundredths, shown) in [
        (24.0, 208, 50),
        (25.0, 200, 50),
        (30.0, 167, 50),
        (50.0, 100, 50),
        // 83, and one more for the last frame, which would else be shown for one alone.
        (60.0, 84, 34),
        (0.5, 10_000, 50),
    ] {
        let written = write_gif(&path, frame_rate, &frames);
        let seen = see_gif(&path);
        assert_eq!(seen.repeat, gif::Repeat::Infinite);
        assert_eq!(seen.frames.len(), shown, "{frame_rate}");
        assert_eq!(written.left_out as usize, 50 - shown);
        let delays: Vec<u16> = seen.frames.iter().map(|frame| frame.0).collect();
        assert_eq!(
            delays.iter().map(|&d| u32::from(d)).sum::<u32>(),
            hundredths,
            "{frame_rate}"
        );
        // Never so short that a browser slows it down, and even to a hundredth where nothing is left out.
        assert!(delays.iter().all(|&delay| delay >= 2));
        if shown == 50 {
            let exact = 100.0 / frame_rate;
            assert!(delays.iter().all(|&d| (f64::from(d) - exact).abs() < 1.0));
        }
    }
}

/// Mean colours of blocks of 5×5 pixels stay within 6 levels of 255 and on average within 0.5; single pixels within 24;
/// black is black.
#[test]
fn gif_shows_the_colours_of_glows() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("glow.gif");
    let frames: Vec<_> = (0..12).map(glow).collect();
    write_gif(&path, 24.0, &frames);
    let seen = see_gif(&path);
    assert_eq!(seen.frames.len(), frames.len());
    let (mut total, mut blocks) = (0.0, 0);
    for (wanted, (_, _, _, shown)) in frames.iter().zip(&seen.frames) {
        let wanted = rgb(wanted);
        for (wanted, shown) in wanted.iter().zip(shown) {
            if *wanted == [0; 3] {
                assert_eq!(*shown, [0; 3]);
            }
            let worst = (0..3).map(|c| wanted[c].abs_diff(shown[c])).max().unwrap();
            assert!(worst <= 24, "{wanted:?} is shown as {shown:?}");
        }
        for (block_x, block_y) in (0..32).flat_map(|x| (0..18).map(move |y| (x, y))) {
            for channel in 0..3 {
                let mut difference = 0;
                for (x, y) in (0..5).flat_map(|x| (0..5).map(move |y| (x, y))) {
                    let place = (block_y * 5 + y) * 160 + block_x * 5 + x;
                    difference +=
                        i32::from(wanted[place][channel]) - i32::from(shown[place][channel]);
                }
                let mean = (f64::from(difference) / 25.0).abs();
                assert!(mean <= 6.0, "block {block_x} {block_y} is off by {mean}");
                total += mean;
                blocks += 1;
            }
        }
    }
    let mean = total / f64::from(blocks);
    assert!(mean <= 0.5, "blocks are off by {mean} on average");
}

#[test]
fn gif_of_few_colours_is_exact() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("few.gif");
    // 254 colours beside black, far from each other in time as well.
    let frames: Vec<_> = (0..4)
        .map(|f| {
            image(51, 5, |x, y| {
                let n = (x * 5 + y + f * 7) % 255;
                [n as u8, (n * 101 % 256) as u8, (n * 37 % 256) as u8, 255]
            })
        })
        .collect();
    write_gif(&path, 10.0, &frames);
    let seen = see_gif(&path);
    for (wanted, (_, _, _, shown)) in frames.iter().zip(&seen.frames) {
        assert!(rgb(wanted) == *shown);
    }
}

#[test]
fn gif_shows_transparency_over_black() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("alpha.gif");
    write_gif(
        &path,
        10.0,
        &[image(3, 1, |x, _| {
            [200, 100, 51, [0, 128, 255][x as usize]]
        })],
    );
    let shown = &see_gif(&path).frames[0].3;
    assert_eq!(shown[..], [[0, 0, 0], [100, 50, 26], [200, 100, 51]]);
}

#[test]
fn gif_does_not_flicker_where_nothing_moves() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("still.gif");
    // A spark of new colours moves along the top and so asks for new palettes; the glow stands still.
    let with_spark = |f: u32| {
        let mut picture = glow(0);
        for x in 0..40 {
            let place = 4 * (f * 8 + x) as usize;
            picture.pixels[place..place + 3].copy_from_slice(&[255, (x * 6) as u8, f as u8]);
        }
        picture
    };
    let frames: Vec<_> = (0..10).map(with_spark).collect();
    write_gif(&path, 24.0, &frames);
    let seen = see_gif(&path);
    let below = |shown: &[[u8; 3]]| shown[160..].to_vec();
    let first = below(&seen.frames[0].3);
    for (_, _, height, shown) in &seen.frames[1..] {
        assert!(below(shown) == first);
        assert_eq!(*height, 1, "only the top row changes");
    }
}

#[test]
fn gif_stores_what_changes() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = |count: usize| {
        let path = dir.path().join(format!("{count}.gif"));
        write_gif(&path, 24.0, &vec![glow(0); count]);
        fs::metadata(path).unwrap().len()
    };
    // A frame that repeats the one before costs its headers.
    assert_eq!((bytes(11) - bytes(1)) % 10, 0);
    assert!((bytes(11) - bytes(1)) / 10 < 48);
    let path = dir.path().join("dot.gif");
    let dot = |f: u32| {
        image(100, 50, move |x, y| match (x, y) {
            (x, 20) if x == 30 + f => [255, 255, 255, 255],
            _ => [0, 0, 0, 255],
        })
    };
    write_gif(&path, 24.0, &[dot(0), dot(1), dot(5)]);
    let sizes: Vec<_> = see_gif(&path)
        .frames
        .iter()
        .map(|frame| (frame.1, frame.2))
        .collect();
    assert_eq!(sizes, [(100, 50), (2, 1), (5, 1)]);
}

#[test]
fn gif_bytes_do_not_depend_on_threads() {
    let dir = tempfile::tempdir().unwrap();
    let frames: Vec<_> = (0..4).map(glow).collect();
    let bytes = |threads: usize| {
        let path = dir.path().join(format!("{threads}.gif"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| write_gif(&path, 24.0, &frames));
        fs::read(path).unwrap()
    };
    let alone = bytes(1);
    assert!(alone == bytes(2));
    assert!(alone == bytes(5));
}
