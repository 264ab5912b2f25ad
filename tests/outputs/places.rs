//! Files appear whole or not at all, wherever they are to be.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use motes::output::{
    FrameSink, Measured, OutputError, StatsRow, StatsWriter, write_particles, write_png,
};
use motes::simulation::ParticleState;

use crate::gif::{see_gif, write_gif};
use crate::{decode_png, error, glow, image, names_in, rgb, set, target};

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
        .args([
            "--ignored",
            "--exact",
            "places::write_where_files_may_not_grow",
        ])
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
    let record = ParticleState {
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
