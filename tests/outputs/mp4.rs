//! Films: what ffmpeg is asked and given, and what is left when it fails, by a script in its place; and
//! one film that the real one makes and reads back.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use motes::output::{FrameSink, OutputTarget};

use crate::studio::{Studio, ended};
use crate::{error, glow, image, names_in, set, target};

const FAKE: &str = include_str!("fake_ffmpeg.sh");

/// Columns and rows of the studio's picture, and of its film.
const ODD: (usize, usize) = (161, 91);
const EVEN: (usize, usize) = (162, 92);

/// A folder for the path, with the fake in it.
fn with_fake() -> (Studio, tempfile::TempDir) {
    let tools = tempfile::tempdir().unwrap();
    let fake = tools.path().join("ffmpeg");
    fs::write(&fake, FAKE).unwrap();
    fs::set_permissions(&fake, fs::Permissions::from_mode(0o755)).unwrap();
    (Studio::new(), tools)
}

/// Renders with the fake first on the path: exit code, words, and how long it took.
fn render(
    studio: &Studio,
    tools: &Path,
    behaviour: &str,
    arguments: &[&str],
) -> (i32, String, Duration) {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(tools.to_owned()).chain(std::env::split_paths(&path));
    let mut command = studio.render(arguments);
    command
        .env("PATH", std::env::join_paths(all).unwrap())
        .env("FAKE", behaviour);
    let start = Instant::now();
    let (code, told) = ended(command.output());
    (code, told, start.elapsed())
}

#[test]
fn ffmpeg_gets_every_frame_with_even_sides_and_makes_the_film() {
    let (studio, tools) = with_fake();
    let (code, told, _) = render(&studio, tools.path(), "good", &["-o", "deep/a.mp4"]);
    assert_eq!(code, 0, "{told}");
    let wrote = "motes: wrote deep/a.mp4: 10 frames of ";
    assert!(told.contains(wrote), "{told}");
    assert_eq!(studio.files(), ["arguments.txt", "bytes.bin", "deep"]);
    assert_eq!(names_in(&studio.path("deep")), set(&["a.mp4"]));
    assert_eq!(fs::read(studio.path("deep/a.mp4")).unwrap().len(), 36);

    let bytes = fs::read(studio.path("bytes.bin")).unwrap();
    let (columns, rows) = EVEN;
    assert_eq!(bytes.len(), 10 * columns * rows * 4);
    studio.rendered(&["-o", "frames"]);
    for (frame, film) in bytes.chunks(columns * rows * 4).enumerate() {
        let name = format!("frames/frame-{frame:04}.png");
        let (_, wanted) = crate::decode_png(&studio.path(&name));
        for (y, x) in (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x))) {
            let from = 3 * (y.min(ODD.1 - 1) * ODD.0 + x.min(ODD.0 - 1));
            let [red, green, blue] = [0, 1, 2].map(|channel| wanted[from + channel]);
            let at = 4 * (y * columns + x);
            assert_eq!(
                film[at..at + 4],
                [red, green, blue, 255],
                "{frame}: {x} {y}"
            );
        }
    }

    let arguments = fs::read_to_string(studio.path("arguments.txt")).unwrap();
    let arguments: Vec<_> = arguments.lines().collect();
    let after = |name: &str| {
        let at = arguments.iter().position(|argument| *argument == name);
        arguments[at.unwrap_or_else(|| panic!("no {name} in {arguments:?}")) + 1]
    };
    for (name, wanted) in [
        ("-f", "rawvideo"),
        ("-pixel_format", "rgba"),
        ("-video_size", "162x92"),
        ("-framerate", "30"),
        ("-i", "pipe:0"),
        ("-c:v", "libx264"),
        ("-colorspace", "bt709"),
        ("-movflags", "+faststart"),
    ] {
        assert_eq!(after(name), wanted);
    }
    assert!(arguments.contains(&"-an"));
    let hidden = arguments.last().unwrap();
    assert!(hidden.starts_with("file:deep/.motes-"), "{hidden}");
}

#[test]
fn an_ffmpeg_that_fails_is_the_machines_fault_and_leaves_nothing() {
    for (behaviour, said) in [
        ("broken", &["127", "shared libraries"][..]),
        ("no-encoder", &["no libx264", ".gif"]),
        ("at-once", &["exit status: 7", "unknown option in a.mp4\n"]),
        (
            "half-way",
            &[
                "exit status: 1",
                "no space left on device",
                "help: make room",
            ],
        ),
        ("at-end", &["exit status: 1", "complaint 4999"]),
        ("killed", &["signal: 9", "said nothing"]),
        ("deaf", &["takes no more frames"]),
        ("leaves-one-behind", &["exit status: 3", "the last word"]),
        ("nothing", &["the film is not whole"]),
        ("cut-off", &["the film is not whole", "No space left"]),
    ] {
        let (studio, tools) = with_fake();
        fs::write(studio.path("a.mp4"), "precious").unwrap();
        let arguments = ["-o", "a.mp4", "--stats", "s.csv"];
        let (code, told, time) = render(&studio, tools.path(), behaviour, &arguments);
        assert_eq!(code, 3, "{behaviour}: {told}");
        assert!(told.contains("error: a.mp4: "), "{behaviour}: {told}");
        for words in said {
            assert!(
                told.contains(words),
                "{behaviour}: `{words}` is not in {told}"
            );
        }
        assert!(told.lines().count() < 9, "{behaviour}: {told}");
        // Its words are no advice, and nobody knows the hidden file.
        assert!(told.contains("\n  = help: "), "{behaviour}: {told}");
        assert!(!told.contains(".motes-"), "{behaviour}: {told}");
        assert!(time < Duration::from_secs(30), "{behaviour}: {time:?}");
        let left: Vec<_> = studio.files();
        let left: Vec<_> = left.iter().filter(|n| *n != "arguments.txt").collect();
        assert_eq!(left, ["a.mp4"], "{behaviour}");
        assert_eq!(fs::read(studio.path("a.mp4")).unwrap(), b"precious");
    }
}

#[test]
fn without_ffmpeg_nothing_is_simulated() {
    let studio = Studio::new();
    let start = Instant::now();
    // So many frames that simulating them would take hours.
    let arguments = ["-o", "a.mp4", "--frames", "0..1000000"];
    let mut command = studio.render(&arguments);
    let (code, told) = ended(command.env("PATH", studio.folder.path()).output());
    assert_eq!(code, 3, "{told}");
    for words in [
        "a.mp4: no ffmpeg on the PATH",
        "apt-get install ffmpeg",
        ".gif",
    ] {
        assert!(told.contains(words), "`{words}` is not in {told}");
    }
    assert!(start.elapsed() < Duration::from_secs(60));
    assert_eq!(studio.files(), [""; 0]);

    // There is a file of that name that is no program.
    fs::write(studio.path("ffmpeg"), "text").unwrap();
    let mut command = studio.render(&arguments);
    let (code, told) = ended(command.env("PATH", studio.folder.path()).output());
    assert_eq!(code, 3, "{told}");
    assert!(told.contains("ffmpeg cannot be started"), "{told}");
    assert_eq!(studio.files(), ["ffmpeg"]);
}

#[test]
fn a_pipe_cannot_be_a_film() {
    let (studio, tools) = with_fake();
    let made = Command::new("mkfifo").arg(studio.path("a.mp4")).status();
    assert!(made.unwrap().success());
    // Open for both, a pipe waits for nobody.
    let _reader = fs::File::options()
        .read(true)
        .write(true)
        .open(studio.path("a.mp4"))
        .unwrap();
    let (code, told, _) = render(&studio, tools.path(), "good", &["-o", "a.mp4"]);
    assert_eq!(code, 2, "{told}");
    assert!(told.contains("give the name of a file"), "{told}");
}

/// Whether there is a real ffmpeg; there must be one where `MOTES_REQUIRE_FFMPEG` is set.
fn is_there() -> bool {
    let asked = Command::new("ffmpeg").arg("-version").output();
    let is_there = asked.is_ok_and(|output| output.status.success());
    let is_required = std::env::var_os("MOTES_REQUIRE_FFMPEG").is_some_and(|v| !v.is_empty());
    assert!(is_there || !is_required, "there is no ffmpeg on the path");
    if !is_there {
        println!("not run: there is no ffmpeg on the path");
    }
    is_there
}

fn asked(program: &str, arguments: &[&str], path: &Path) -> Vec<u8> {
    let output = Command::new(program)
        .args(["-v", "error", "-i"])
        .arg(path)
        .args(arguments)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && told.is_empty(), "{told}");
    output.stdout
}

/// 12 frames of one colour each with a lighter column at the right, 33×19.
fn write_film(path: &Path) -> Vec<[u8; 3]> {
    let colours: Vec<_> = (0..12u8).map(|f| [240 - 20 * f, 20 * f, 60]).collect();
    let mut sink = FrameSink::open(&target(path), 33, 19, 25.0, 12).unwrap();
    for (frame, &[red, green, blue]) in colours.iter().enumerate() {
        let picture = image(33, 19, |_, _| [red, green, blue, 255]);
        sink.write_frame(frame as u32, &picture).unwrap();
    }
    assert_eq!(sink.finish().unwrap().frames, 12);
    colours
}

#[test]
fn a_real_film_has_the_frames_sizes_and_colours() {
    if !is_there() {
        return;
    }
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a:b.mp4");
    let colours = write_film(&path);
    assert_eq!(names_in(dir.path()), set(&["a:b.mp4"]));
    let url = PathBuf::from(format!("file:{}", path.display()));
    let entries = "stream=codec_type,codec_name,width,height,pix_fmt,color_range,color_space,\
                   color_transfer,color_primaries,avg_frame_rate,nb_read_frames";
    let told = asked(
        "ffprobe",
        &["-count_frames", "-show_entries", entries, "-of", "flat"],
        &url,
    );
    let told = String::from_utf8(told).unwrap();
    for (name, wanted) in [
        ("codec_name", "\"h264\""),
        ("width", "34"),
        ("height", "20"),
        ("pix_fmt", "\"yuv420p\""),
        ("color_range", "\"tv\""),
        ("color_space", "\"bt709\""),
        ("color_transfer", "\"bt709\""),
        ("color_primaries", "\"bt709\""),
        ("avg_frame_rate", "\"25/1\""),
        ("nb_read_frames", "\"12\""),
    ] {
        let line = format!("streams.stream.0.{name}={wanted}\n");
        assert!(told.contains(&line), "{line} is not in {told}");
    }
    assert!(!told.contains("stream.1."), "{told}");

    // Read as what the film must be, so that a wrong matrix would shift the colours.
    let matrix = "scale=in_color_matrix=bt709:in_range=limited:flags=accurate_rnd+full_chroma_int";
    let decode = ["-vf", matrix, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"];
    let bytes = asked("ffmpeg", &decode, &url);
    assert_eq!(bytes.len(), 12 * 34 * 20 * 3);
    for (frame, wanted) in bytes.chunks(34 * 20 * 3).zip(&colours) {
        let (pixels, _) = frame.as_chunks::<3>();
        for (channel, wanted) in wanted.iter().enumerate() {
            let sum: u32 = pixels.iter().map(|p| u32::from(p[channel])).sum();
            let mean = f64::from(sum) / pixels.len() as f64;
            let off = (mean - f64::from(*wanted)).abs();
            assert!(off < 2.5, "{mean} for {wanted} in channel {channel}");
        }
    }

    // Its index is first, and the same frames are the same bytes.
    let film = fs::read(&path).unwrap();
    let place = |name: &[u8]| film.windows(4).position(|window| window == name);
    assert!(place(b"moov").unwrap() < place(b"mdat").unwrap());
    let again = dir.path().join("again.mp4");
    write_film(&again);
    assert!(film == fs::read(again).unwrap());
}

#[test]
fn a_film_that_is_not_finished_is_not_there() {
    if !is_there() {
        return;
    }
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mp4");
    let open = || {
        let target = OutputTarget::Mp4(path.clone());
        FrameSink::open(&target, 160, 90, 24.0, 50).unwrap()
    };
    assert!(error(open().finish()).is_users_fault());
    let mut sink = open();
    for frame in 0..50 {
        sink.write_frame(frame, &glow(frame)).unwrap();
    }
    assert_eq!(names_in(dir.path()).len(), 1, "a hidden file");
    drop(sink);
    assert_eq!(names_in(dir.path()), set(&[]));
    // One of a single frame and pixel.
    let mut sink = FrameSink::open(&target(&path), 1, 1, 240.0, 1).unwrap();
    let pixel = image(1, 1, |_, _| [200, 100, 50, 255]);
    sink.write_frame(0, &pixel).unwrap();
    sink.finish().unwrap();
    assert_eq!(names_in(dir.path()), set(&["a.mp4"]));
}
