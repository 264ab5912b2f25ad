//! What `-o` means.

use std::path::{Path, PathBuf};

use motes::output::{FrameSink, OutputTarget};

use crate::{decode_png, error, image, names_in, rgb, set, target};

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
        ("a/b.exr", OutputTarget::Exr("a/b.exr".into())),
        ("5%%.Exr", OutputTarget::Exr("5%.Exr".into())),
        ("b.gif", OutputTarget::Gif("b.gif".into())),
        ("b.MP4", OutputTarget::Mp4("b.MP4".into())),
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
        ("", "name.exr"),
        ("", "name.mp4"),
        ("a-%04d.mp4", "one MP4 holds all frames"),
        ("a-%s.exr", "%%"),
        ("a-%d-%d.exr", "name-%04d.exr"),
        ("a-%d/b.exr", "folder/name-%04d.exr"),
        ("a.mkv", "name-%04d.exr (a file a frame)"),
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
