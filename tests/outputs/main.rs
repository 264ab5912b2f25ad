//! What leaves Motes, read back by other programs' means: the decoders of `png` and `gif`, and small readers of our own
//! for PLY and CSV; and what is left when writing ends early or is refused.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use motes::output::{
    FrameSink, Measured, OutputError, OutputTarget, ParticleCounts, ParticleRecord, Rgba8Image,
    StatsRow, StatsWriter, Written, dump_path, write_particles, write_png,
};

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

fn decode_png(path: &Path) -> (png::ColorType, Vec<u8>) {
    let file = std::io::BufReader::new(File::open(path).expect("a file"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    assert_eq!(reader.info().bit_depth, png::BitDepth::Eight);
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    let info = reader.next_frame(&mut bytes).expect("a picture");
    bytes.truncate(info.buffer_size());
    (info.color_type, bytes)
}

/// A GIF as a viewer sees it.
struct Seen {
    repeat: gif::Repeat,
    /// Of each frame: hundredths of a second, width and height of its rectangle, all pixels of the screen (RGB).
    frames: Vec<(u16, u16, u16, Vec<[u8; 3]>)>,
}

fn see_gif(path: &Path) -> Seen {
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

fn write_gif(path: &Path, frame_rate: f64, frames: &[Rgba8Image]) -> Written {
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

fn rgb(image: &Rgba8Image) -> Vec<[u8; 3]> {
    let (pixels, _) = image.pixels.as_chunks::<4>();
    pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
}

/// A folder where no file can be created, even by an administrator.
#[cfg(unix)]
fn unwritable_folder(scratch: &Path) -> PathBuf {
    use std::os::unix::fs::PermissionsExt;
    let folder = scratch.join("unwritable");
    fs::create_dir(&folder).expect("a folder");
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).expect("permissions");
    if File::create(folder.join("probe")).is_ok() {
        // Permissions do not bind an administrator; the kernel's own file system does.
        return PathBuf::from("/sys");
    }
    folder
}

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
fn frames_are_named_by_folder_or_pattern() {
    let dir = tempfile::tempdir().unwrap();
    let frame = image(4, 3, |x, _| [x as u8, 0, 0, 255]);
    for (out, names) in [
        ("plain", ["frame-0007.png", "frame-12345.png"]),
        ("pattern/a-%06d-b.png", ["a-000007-b.png", "a-012345-b.png"]),
        ("short/%d.png", ["7.png", "12345.png"]),
    ] {
        let out = dir.path().join(out);
        let mut sink = FrameSink::open(&target(&out), 4, 3, 24.0, 2).unwrap();
        sink.write_frame(7, &frame).unwrap();
        sink.write_frame(12345, &frame).unwrap();
        let written = sink.finish().unwrap();
        assert_eq!((written.frames, written.left_out), (2, 0));
        let folder = if out.extension().is_some() {
            out.parent().unwrap()
        } else {
            &out
        };
        assert_eq!(names_in(folder), set(&names));
        assert_eq!(decode_png(&folder.join(names[0])).1, rgb(&frame).concat());
    }
}

#[test]
fn outputs_are_told_by_their_ending() {
    for (out, expected) in [
        ("out", OutputTarget::Folder("out".into())),
        ("out/v1.2", OutputTarget::Folder("out/v1.2".into())),
        ("odd.png/", OutputTarget::Folder("odd.png/".into())),
        ("..", OutputTarget::Folder("..".into())),
        ("a/b.PNG", OutputTarget::Png("a/b.PNG".into())),
        ("50%%.png", OutputTarget::Png("50%.png".into())),
        ("b.gif", OutputTarget::Gif("b.gif".into())),
    ] {
        assert_eq!(OutputTarget::parse(out).unwrap(), expected, "{out}");
    }
    let OutputTarget::Pattern(pattern) = OutputTarget::parse("d/5%%-%03d%%.png").unwrap() else {
        panic!("a pattern");
    };
    assert_eq!(pattern.path(42), PathBuf::from("d/5%-042%.png"));
    assert_eq!(pattern.folder(), Path::new("d"));
}

#[test]
fn outputs_that_mean_nothing_say_what_would() {
    for (out, part) in [
        ("", "name.gif"),
        ("a.mp4", "does not write .mp4 yet"),
        ("a.exr", "does not write .exr yet"),
        ("a-%04d.svg", "a line drawing is one frame"),
        ("a.jpg", "give a folder, name-%04d.png"),
        ("a-%04d.gif", "name-%04d.png"),
        ("a-%04d", "use a-%04d.png"),
        ("a-%4d.png", "%04d"),
        ("a-%00d.png", "%04d"),
        ("a-%099d.png", "%04d"),
        ("a-%s.png", "%%"),
        ("a%.png", "%%"),
        ("a-%d-%d.png", "two frame numbers"),
        ("a-%d/b.png", "not into a folder's"),
    ] {
        let error = error(OutputTarget::parse(out));
        assert!(error.is_users_fault(), "{out}");
        assert_eq!(error.path(), Path::new(out));
        assert!(error.to_string().contains(part), "{out}: {error}");
    }
}

#[test]
fn one_png_takes_one_frame() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("one.png");
    let refused = error(FrameSink::open(&target(&path), 4, 3, 24.0, 2));
    assert!(refused.is_users_fault());
    assert!(refused.to_string().contains("use name-%04d.png or .gif"));
    let frame = image(4, 3, |_, _| [0, 0, 0, 255]);
    let mut sink = FrameSink::open(&target(&path), 4, 3, 24.0, 1).unwrap();
    sink.write_frame(9, &frame).unwrap();
    assert!(error(sink.write_frame(10, &frame)).is_users_fault());
    assert_eq!(names_in(dir.path()), set(&["one.png"]));
}

#[test]
fn impossible_requests_are_the_users_fault() {
    let dir = tempfile::tempdir().unwrap();
    let gif = target(&dir.path().join("x.gif"));
    for (width, height, frame_rate, frame_count) in [
        (4, 3, 24.0, 0),
        (0, 3, 24.0, 1),
        (4, 0, 24.0, 1),
        (65536, 3, 24.0, 1),
        (4, 3, 0.0, 1),
        (4, 3, f64::NAN, 1),
        (4, 3, f64::INFINITY, 1),
        (4, 3, 0.001, 1),
    ] {
        let refused = error(FrameSink::open(
            &gif,
            width,
            height,
            frame_rate,
            frame_count,
        ));
        assert!(refused.is_users_fault(), "{refused}");
    }
    let sink = FrameSink::open(&gif, 4, 3, 24.0, 1).unwrap();
    assert!(error(sink.finish()).is_users_fault());
    assert_eq!(names_in(dir.path()), set(&[]));
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

#[test]
fn what_is_not_finished_is_not_there() {
    let dir = tempfile::tempdir().unwrap();
    let frame = image(4, 3, |x, _| [x as u8, 0, 0, 255]);
    let gif_path = dir.path().join("x.gif");
    let csv_path = dir.path().join("x.csv");
    fs::write(&gif_path, "old").unwrap();

    // Dropped before the end.
    let mut sink = FrameSink::open(&target(&gif_path), 4, 3, 24.0, 9).unwrap();
    sink.write_frame(0, &frame).unwrap();
    sink.write_frame(1, &frame).unwrap();
    let stats = StatsWriter::create(&csv_path).unwrap();
    // While they are being written there are two hidden files, and the old one is whole.
    let names = names_in(dir.path());
    assert_eq!(names.len(), 3, "{names:?}");
    let hidden = names.iter().filter(|name| name.starts_with(".motes-"));
    assert_eq!(hidden.count(), 2, "{names:?}");
    drop((sink, stats));
    assert_eq!(names_in(dir.path()), set(&["x.gif"]));
    assert_eq!(fs::read_to_string(&gif_path).unwrap(), "old");

    // An error on the way.
    let mut sink = FrameSink::open(&target(&gif_path), 4, 3, 24.0, 9).unwrap();
    sink.write_frame(0, &frame).unwrap();
    assert!(error(sink.write_frame(1, &glow(0))).is_users_fault());
    drop(sink);
    assert_eq!(fs::read_to_string(&gif_path).unwrap(), "old");

    // A PNG a frame: those that are complete stay.
    let frames = dir.path().join("frames");
    let mut sink = FrameSink::open(&target(&frames), 4, 3, 24.0, 9).unwrap();
    sink.write_frame(0, &frame).unwrap();
    drop(sink);
    assert_eq!(names_in(&frames), set(&["frame-0000.png"]));

    // The place is taken by a folder meanwhile.
    let stats = StatsWriter::create(&csv_path).unwrap();
    fs::create_dir(&csv_path).unwrap();
    assert!(error(stats.finish()).is_users_fault());
    assert_eq!(names_in(dir.path()), set(&["frames", "x.csv", "x.gif"]));

    // And at last the new one is there.
    write_gif(&gif_path, 24.0, &[frame]);
    assert_eq!(see_gif(&gif_path).frames.len(), 1);
}

/// Every way of starting an output at a path.
fn all_errors(folder: &Path) -> Vec<OutputError> {
    let open = |name: &str| {
        let target = target(&folder.join(name));
        error(FrameSink::open(&target, 4, 3, 24.0, 1))
    };
    vec![
        open("x.gif"),
        open("x.png"),
        open("x-%d.png"),
        open("frames"),
        error(StatsWriter::create(&folder.join("x.csv"))),
        error(write_particles(&folder.join("x.ply"), &[])),
        error(write_png(&folder.join("x.png"), &glow(0))),
    ]
}

#[test]
fn a_file_in_place_of_a_folder_is_the_users_fault() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    fs::write(&file, "kept").unwrap();
    let mut errors = all_errors(&file);
    errors.extend(all_errors(&file.join("deeper")));
    for error in errors {
        assert!(error.is_users_fault(), "{error}");
        assert!(error.to_string().contains("is a file"), "{error}");
        assert!(error.path().starts_with(&file), "{error}");
    }
    assert_eq!(fs::read_to_string(file).unwrap(), "kept");
}

#[test]
fn a_folder_in_place_of_a_file_is_the_users_fault() {
    let dir = tempfile::tempdir().unwrap();
    for name in ["x.gif", "x.png", "x-0.png", "x.csv", "x.ply"] {
        fs::create_dir(dir.path().join(name)).unwrap();
    }
    fs::create_dir_all(dir.path().join("frames/frame-0000.png")).unwrap();
    for error in all_errors(dir.path()) {
        assert!(error.is_users_fault(), "{error}");
        assert!(error.to_string().contains("this is a folder"), "{error}");
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_is_the_machines_fault() {
    let dir = tempfile::tempdir().unwrap();
    for error in all_errors(&unwritable_folder(dir.path())) {
        assert!(!error.is_users_fault(), "{error}");
        assert!(error.to_string().contains("you may write to"), "{error}");
    }
}

/// Names the folder that `write_where_files_may_not_grow` writes to.
#[cfg(unix)]
const CRAMPED_FOLDER: &str = "MOTES_TEST_CRAMPED_FOLDER";

/// A limit on the size of files stands for a full disk: writing fails in the middle, after the file was created.
#[cfg(unix)]
#[test]
fn a_disk_without_room_is_the_machines_fault_and_nothing_is_left() {
    let dir = tempfile::tempdir().unwrap();
    // Ignoring the signal turns it into an error of the write.
    let child = std::process::Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\""])
        .arg(std::env::current_exe().unwrap())
        .args(["--ignored", "--exact", "write_where_files_may_not_grow"])
        .env(CRAMPED_FOLDER, dir.path())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success(), "{told}");
    assert!(told.contains("1 passed"), "{told}");
    assert_eq!(names_in(dir.path()), set(&[]));
}

#[cfg(unix)]
#[test]
#[ignore = "run by a_disk_without_room_…, in a process of its own"]
fn write_where_files_may_not_grow() {
    let Some(folder) = std::env::var_os(CRAMPED_FOLDER).map(PathBuf::from) else {
        return;
    };
    let record = ParticleRecord {
        position: [0.0; 3],
        velocity: [0.0; 3],
        age: 0,
        lifetime: 1,
        system: 0,
        id: 0,
    };
    let mut gif = FrameSink::open(&target(&folder.join("x.gif")), 160, 90, 24.0, 1).unwrap();
    gif.write_frame(0, &glow(0)).unwrap();
    let mut stats = StatsWriter::create(&folder.join("x.csv")).unwrap();
    for frame in 0..100 {
        stats
            .row(&StatsRow {
                frame,
                population: "image",
                measured: Measured::Image,
                digest: Some(0),
            })
            .unwrap();
    }
    for error in [
        error(gif.finish()),
        error(stats.finish()),
        error(write_png(&folder.join("x.png"), &glow(0))),
        // Beyond the buffer, so that writing fails before the end.
        error(write_particles(&folder.join("x.ply"), &[record; 5000])),
    ] {
        assert!(!error.is_users_fault(), "{error}");
        assert!(error.to_string().contains("make room"), "{error}");
    }
}

/// `/dev/stdout` and its like must not be renamed over. A pipe in a folder of ours stands for them, so that a mistake
/// in the code under test harms no device.
#[cfg(target_os = "linux")]
#[test]
fn a_pipe_is_written_and_stays() {
    use std::io::Read;
    use std::os::unix::fs::FileTypeExt;
    let dir = tempfile::tempdir().unwrap();
    let (pipe, plain) = (dir.path().join("pipe"), dir.path().join("plain.png"));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    // Open for both, a pipe waits for nobody.
    let mut reader = File::options().read(true).write(true).open(&pipe).unwrap();
    let picture = image(8, 8, |x, y| [x as u8, y as u8, 0, 255]);
    write_png(&plain, &picture).unwrap();
    write_png(&pipe, &picture).unwrap();
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
    let expected = fs::read(plain).unwrap();
    let mut got = vec![0; expected.len()];
    reader.read_exact(&mut got).unwrap();
    assert_eq!(got, expected);
    assert_eq!(names_in(dir.path()), set(&["pipe", "plain.png"]));
}

#[cfg(unix)]
#[test]
fn a_link_is_written_through() {
    let dir = tempfile::tempdir().unwrap();
    let (real, link) = (dir.path().join("real.png"), dir.path().join("link.png"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink("real.png", &link).unwrap();
    write_png(&link, &glow(0)).unwrap();
    assert_eq!(fs::read_link(&link).unwrap(), Path::new("real.png"));
    assert_eq!(decode_png(&real).1, rgb(&glow(0)).concat());
}

#[test]
fn ply_reads_back() {
    let dir = tempfile::tempdir().unwrap();
    // More than one buffer's worth.
    let records: Vec<_> = (0..10_000_u32)
        .map(|i| ParticleRecord {
            position: [i as f32, -0.5, f32::MIN_POSITIVE],
            velocity: [1.0 / (i + 1) as f32, 3e30, -0.0],
            age: i % 50,
            lifetime: 50,
            system: u32::MAX - i,
            id: i.wrapping_mul(0x9E37_79B9),
        })
        .collect();
    let path = dump_path(dir.path(), "particles", 7);
    assert_eq!(path, dir.path().join("particles-0007.ply"));
    assert!(dump_path(dir.path(), "a", 12345).ends_with("a-12345.ply"));
    write_particles(&path, &records).unwrap();

    let bytes = fs::read(&path).unwrap();
    let end = b"end_header\n";
    let header_len = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = std::str::from_utf8(&bytes[..header_len]).unwrap();
    let lines: Vec<_> = header
        .lines()
        .filter(|line| !line.starts_with("comment"))
        .collect();
    assert_eq!(
        lines[..3],
        [
            "ply",
            "format binary_little_endian 1.0",
            "element vertex 10000"
        ]
    );
    let names = "float x,float y,float z,float vx,float vy,float vz,\
                 uint age,uint lifetime,uint system,uint id";
    let properties: Vec<_> = names.split(',').map(|p| format!("property {p}")).collect();
    assert_eq!(lines[3..lines.len() - 1], properties);
    let (words, rest) = bytes[header_len..].as_chunks::<4>();
    assert!(rest.is_empty());
    assert_eq!(words.len(), 10 * records.len());
    for (vertex, record) in words.chunks(10).zip(&records) {
        let float = |i: usize| f32::from_le_bytes(vertex[i]).to_bits();
        let uint = |i: usize| u32::from_le_bytes(vertex[i]);
        assert_eq!([0, 1, 2].map(float), record.position.map(f32::to_bits));
        assert_eq!([3, 4, 5].map(float), record.velocity.map(f32::to_bits));
        let ParticleRecord {
            age,
            lifetime,
            system,
            id,
            ..
        } = *record;
        assert_eq!([6, 7, 8, 9].map(uint), [age, lifetime, system, id]);
    }
    write_particles(&path, &[]).unwrap();
    let empty = fs::read_to_string(&path).unwrap();
    assert!(empty.contains("element vertex 0\n") && empty.ends_with("end_header\n"));
}

#[test]
fn stats_are_lines_of_the_contract() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("stats/run.csv");
    let mut stats = StatsWriter::create(&path).unwrap();
    let counts = ParticleCounts {
        requested: 12,
        born: 10,
        died: 6,
        live: 5_000_000_000,
        dropped: 2,
        died_of_intensity: 1,
        died_of_bounds: 2,
    };
    for (frame, population, measured, digest) in [
        (0, "particles", Measured::Particles(counts), None),
        (1, "a, \"b\"", Measured::Particles(counts), Some(u64::MAX)),
        (1, "image", Measured::Image, Some(0xABC)),
        (2, "image", Measured::Image, None),
    ] {
        stats
            .row(&StatsRow {
                frame,
                population,
                measured,
                digest,
            })
            .unwrap();
    }
    assert!(!path.exists());
    stats.finish().unwrap();
    assert_eq!(
        fs::read_to_string(&path).unwrap(),
        "frame,population,kind,requested,born,died,live,dropped,digest,\
         died_of_age,died_of_intensity,died_of_bounds\n\
         0,particles,particles,12,10,6,5000000000,2,,3,1,2\n\
         1,\"a, \"\"b\"\"\",particles,12,10,6,5000000000,2,ffffffffffffffff,3,1,2\n\
         1,image,image,,,,,,0000000000000abc,,,\n\
         2,image,image,,,,,,,,,\n"
    );
    assert_eq!(names_in(path.parent().unwrap()), set(&["run.csv"]));
}
