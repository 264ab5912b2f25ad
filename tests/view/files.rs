//! What a session reads and writes: scenes, meshes, kernels, recordings.

use super::*;

const FLOCK: &str = r#"frames = 20
image = { width = 40, height = 30 }
camera = { projection = "orthographic", position = [20, 15, 50], target = [20, 15, 0], view_height = 30 }
[[flock]]
name = "gulls"
count = 20
region = { min = [0, 0, 0], max = [40, 30, 0] }
"#;

/// Colours at its second age may not come before those at its first.
const FLAME: &str = r#"frames = 20
image = { width = 40, height = 30 }
camera = { position = [0, 1, 4], target = [0, 0.5, 0] }
[[fire]]
name = "match"
flame = [{ position = [0, 0, 0] }]
ramp = [
  { age = 0.0, center = [1, 0.5, 0.2], rim = [1, 0.2, 0], alpha = 0.2 },
  { age = 0.1, center = [1, 0.5, 0.2], rim = [1, 0.2, 0], alpha = 0.1 },
]
"#;

#[test]
fn changes_of_one_frame_are_replayed_in_their_order() {
    let (folder, mut session) = begun(FLAME);
    steps(&mut session, 3);
    let [first, last] = ["fire.match.ramp.0.age", "fire.match.ramp.1.age"];
    session.turn(first, "0.4").expect_err("0.4 is after 0.1");
    for (key, value) in [(last, "0.6"), (last, "0.5"), (first, "0.4"), (last, "0.45")] {
        session.turn(key, value).expect("it turns");
    }
    steps(&mut session, 3);
    // A knob that is held leaves one change a frame; others stand as they were made.
    let changes = session.recording().changes.iter();
    let values: Vec<&str> = changes.filter_map(|it| it.set.split('=').nth(1)).collect();
    assert_eq!(values, ["0.5", "0.4", "0.45"]);
    let mut replay = saved(&folder, &session).replay;
    let digest_of_replay = replay.state_digest().expect("it is told");
    assert_eq!(digest_of_replay, digest(&mut session));
    session.restart(5).expect("it begins");
    assert_eq!(session.recording().changes.len(), 3);
}

#[test]
fn what_a_scene_that_is_read_again_has_no_keys_for_is_left_out_and_told() {
    let (folder, mut session) = session();
    steps(&mut session, 3);
    session.turn("system.jet.drag", "0.25").expect("it turns");
    session
        .turn("system.jet.speed.mean", "0.3")
        .expect("it turns");
    steps(&mut session, 3);
    let file = folder.path().join("jet.toml");
    std::fs::write(&file, SCENE.replace("\"jet\"", "\"jets\"")).expect("it is written");
    let left_out = session.reload().expect("it is a scene");
    assert_eq!(left_out, ["system.jet.drag", "system.jet.speed.mean"]);
    assert!(session.recording().changes.is_empty());
    assert_eq!(session.frame(), 6);
}

#[test]
fn what_alone_does_not_fit_is_left_out_alone() {
    let (folder, mut session) = begun(FLAME);
    steps(&mut session, 2);
    session
        .turn("fire.match.noisiness", "0.1")
        .expect("it turns");
    session
        .turn("fire.match.ramp.1.alpha", "0.3")
        .expect("it turns");
    steps(&mut session, 2);
    let file = folder.path().join("own.toml");
    let one = FLAME.lines().filter(|line| !line.contains("age = 0.1"));
    let one: Vec<&str> = one.collect();
    std::fs::write(&file, one.join("\n")).expect("it is written");
    let left_out = session.reload().expect("it is a scene");
    assert_eq!(left_out, ["fire.match.ramp.1.alpha"]);
    assert_eq!(session.recording().changes.len(), 1);
    assert_eq!(session.scene().fires[0].noisiness, 0.1);
}

#[test]
fn knobs_show_what_a_click_has_changed() {
    let (_folder, mut session) = begun(FLOCK);
    steps(&mut session, 2);
    let goal = |session: &Session| {
        let mut knobs = session.knobs().iter();
        let knob = knobs.find(|knob| knob.path == "flock.gulls.goal.weight");
        knob.map(|knob| knob.value.clone())
    };
    assert_eq!(goal(&session), None);
    session.simulation().draw().expect("it is drawn");
    let done = session.touch([20.0, 15.0], true).expect("there is a place");
    assert!(done.is_some());
    assert_eq!(goal(&session), Some(KnobValue::Written("-1".into())));
    session
        .turn("flock.gulls.goal.weight", "0.5")
        .expect("it turns");
    assert_eq!(goal(&session), Some(KnobValue::Written("0.5".into())));
}

#[test]
fn what_lives_for_ever_is_played_past_the_scenes_frames_and_begun_again_there() {
    let text = SCENE
        .replace("frames = 40", "frames = 5")
        .replace("lifetime = 9\n", "");
    let (_folder, mut session) = begun(&text);
    steps(&mut session, 30);
    let (frame, before) = (session.frame(), digest(&mut session));
    steps(&mut session, 3);
    session.restart(frame).expect("it begins");
    assert_eq!(digest(&mut session), before);
}

#[test]
fn a_built_in_scene_is_saved_with_its_meshes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut session = Session::new(source(Path::new("ember-knot"), &[])).expect("it begins");
    steps(&mut session, 1);
    let scene = folder.path().join("mine.toml");
    session.save_as(&scene).expect("it is saved");
    let mesh = folder.path().join("meshes/torus-knot.obj");
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/meshes/torus-knot.obj");
    let [mine, carried] = [&mesh, &own].map(|path| std::fs::read(path).expect("it is there"));
    assert!(mine == carried);
    let loads = |scene: &Path| Loader::default().load(&scene.display().to_string());
    loads(&scene).expect("it finds its meshes");
    session.save_as(&scene).expect("they are the same");
    // One that is saved elsewhere takes them along, too.
    let mut again = Session::new(source(&scene, &[])).expect("it begins");
    steps(&mut again, 1);
    let elsewhere = tempfile::tempdir().expect("a folder");
    let there = elsewhere.path().join("other.toml");
    again.save_as(&there).expect("it is saved");
    loads(&there).expect("it finds its meshes");
    // Nobody's file is written over.
    std::fs::write(&mesh, "v 0 0 0\n").expect("it is written");
    let told = session.save_as(&scene).expect_err("there is another mesh");
    assert!(
        format!("{told:?}").contains("torus-knot.obj: there is another file"),
        "{told:?}"
    );
    assert_eq!(std::fs::read(&mesh).expect("it is there"), b"v 0 0 0\n");
}

#[test]
fn kernels_are_read_again_and_wrong_ones_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("wgsl/particles/advance.wgsl");
    let text = std::fs::read_to_string(own).expect("it is there");
    let kernel = folder.path().join("particles/advance.wgsl");
    std::fs::create_dir(folder.path().join("particles")).expect("a folder");
    std::fs::write(&kernel, &text).expect("it is written");
    let scene = folder.path().join("jet.toml");
    std::fs::write(&scene, SCENE).expect("it is written");
    let source = source(&scene, &[]).with_kernels(Some(folder.path().to_owned()));
    let mut session = Session::new(source).expect("it begins");
    assert!(session.files().contains(&kernel));
    steps(&mut session, 6);
    let (frame, before) = (session.frame(), digest(&mut session));
    std::fs::write(&kernel, text.replacen("fn ", "fun ", 1)).expect("it is written");
    let told = session.reload().expect_err("it is no WGSL");
    assert!(told.contains("wgsl/particles/advance.wgsl:"), "{told}");
    assert_eq!((session.frame(), digest(&mut session)), (frame, before));
    // One that does nothing moves nobody.
    let begin = text.find("@compute").expect("there is an entry point");
    let body = begin + text[begin..].find(") {\n").expect("a body") + 4;
    let idle = format!("{}    return;\n{}", &text[..body], &text[body..]);
    std::fs::write(&kernel, idle).expect("it is written");
    session.reload().expect("it is WGSL");
    assert_eq!(session.frame(), frame);
    assert_ne!(digest(&mut session), before);
    std::fs::write(&kernel, &text).expect("it is written");
    session.reload().expect("it is WGSL");
    assert_eq!(digest(&mut session), before);
    std::fs::remove_file(&kernel).expect("it is there");
    let told = session.reload().expect_err("there is none");
    assert!(told.contains("there is no kernel in it"), "{told}");
}

#[test]
fn what_holds_for_a_whole_run_is_not_turned() {
    let (_folder, mut session) = session();
    steps(&mut session, 2);
    for (key, value) in [
        ("frames", "20"),
        ("frame_rate", "30"),
        ("steady_particles", "9"),
    ] {
        let told = session.turn(key, value).expect_err("it holds for a run");
        assert!(told.contains(&format!("`{key}`")), "{told}");
    }
    assert!(session.recording().changes.is_empty());
    session.restart(2).expect("it begins");
}

#[test]
fn whatever_turns_is_replayed() {
    for text in [SCENE, FLAME, FLOCK] {
        let (folder, mut session) = begun(text);
        steps(&mut session, 2);
        let mut knobs: Vec<_> = session.knobs().to_vec();
        // It is given to the scene by `--set`, which the replay here has not.
        knobs.retain(|knob| knob.path != "capacity");
        let mut turned = 0;
        for knob in knobs {
            let (KnobValue::Written(value) | KnobValue::Default(value)) = knob.value else {
                continue;
            };
            let half = value
                .parse::<f64>()
                .map(|number| (0.5 * number).to_string());
            for value in [Some(value), half.ok()].into_iter().flatten() {
                turned += u32::from(session.turn(&knob.path, &value).is_ok());
            }
        }
        assert!(turned > 20, "{turned}");
        steps(&mut session, 2);
        let mut replay = saved(&folder, &session).replay;
        let digest_of_replay = replay.state_digest().expect("it is told");
        assert_eq!(digest_of_replay, digest(&mut session));
        let frame = session.frame();
        session.restart(frame).expect("it begins");
        assert_eq!(digest_of_replay, digest(&mut session));
    }
}

#[test]
fn the_room_that_a_scene_gets_gives_way_to_its_own_capacity() {
    let (folder, mut session) = session();
    assert_eq!(session.scene().capacity, Some(100_000));
    let text = format!("capacity = 1000\n{SCENE}");
    std::fs::write(folder.path().join("jet.toml"), text).expect("it is written");
    session.reload().expect("it is a scene");
    assert_eq!(session.scene().capacity, Some(1000));
    std::fs::write(folder.path().join("jet.toml"), SCENE).expect("it is written");
    session.reload().expect("it is a scene");
    assert_eq!(session.scene().capacity, Some(100_000));
}

#[test]
fn the_first_line_of_a_recording_is_a_command() {
    let (folder, _) = session();
    let scene = folder.path().join("jet.toml");
    let title = "title=\"it's\"";
    let mut session = Session::new(source(&scene, &[title])).expect("it begins");
    steps(&mut session, 2);
    let mine = folder.path().join("my scene.toml");
    let inputs = session.save_as(&mine).expect("it is saved");
    let text = std::fs::read_to_string(inputs).expect("it is there");
    let head = text.lines().next().unwrap_or_default();
    let words = head.trim_start_matches("# motes ");
    let command = format!(
        "{} {words} --size 16x12 -o out",
        env!("CARGO_BIN_EXE_motes")
    );
    let output = Command::new("sh")
        .args(["-c", &command])
        .current_dir(folder.path())
        .env("MOTES_ADAPTER", "cpu")
        .output()
        .expect("it starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{head}: {stderr}");
}

#[test]
fn meshes_that_are_not_what_ran_are_not_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let carried = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/meshes/paper.obj");
    let text = std::fs::read_to_string(carried).expect("it is there");
    let mesh = folder.path().join("sail.obj");
    std::fs::write(&mesh, &text).expect("it is written");
    let scene = folder.path().join("in/boat.toml");
    std::fs::create_dir(folder.path().join("in")).expect("a folder");
    let of = |mesh: &str| {
        let shape = format!("{{ kind = \"mesh\", mesh = \"{mesh}\" }}");
        SCENE.replace("{ kind = \"sphere\", radius = 0.4 }", &shape)
    };
    let save = |session: &Session, name: &str| {
        let there = folder.path().join(name);
        std::fs::create_dir_all(there.parent().expect("it has one")).expect("a folder");
        session
            .save_as(&there)
            .map_err(|error| format!("{error:?}"))
    };
    let outside = |text: &str| {
        std::fs::write(&scene, text).expect("it is written");
        let mut source = source(&scene, &[]);
        source.loader.allow_outside = true;
        Session::new(source).expect("it begins")
    };
    let told = save(&outside(&of("../sail.obj")), "far/a/mine.toml");
    assert!(
        told.as_ref()
            .is_err_and(|it| it.contains("outside of the scene's folder")),
        "{told:?}"
    );
    assert!(!folder.path().join("far/a/mine.toml").exists());
    // One that is found from anywhere stays where it is.
    let absolute = mesh.display().to_string();
    save(&outside(&of(&absolute)), "far/b/mine.toml").expect("it is saved");
    let scene = folder.path().join("boat.toml");
    std::fs::write(&scene, of("sail.obj")).expect("it is written");
    let session = Session::new(source(&scene, &[])).expect("it begins");
    std::fs::write(&mesh, text + "# torn\n").expect("it is written");
    let told = save(&session, "far/c/mine.toml");
    assert!(told.is_err_and(|it| it.contains("written since the scene was read")));
}

#[test]
fn a_mesh_that_a_refused_scene_names_is_watched() {
    let (folder, mut session) = session();
    let mesh = folder.path().join("late.obj");
    std::fs::write(&mesh, "v 0 0 0\n").expect("it is written");
    let file = folder.path().join("jet.toml");
    let text = format!("{SCENE}[[surface]]\nmesh = \"late.obj\"\n");
    std::fs::write(&file, &text).expect("it is written");
    session.reload().expect_err("it has no faces");
    let is_watched = |session: &Session| session.files().iter().any(|it| it.ends_with("late.obj"));
    assert!(is_watched(&session));
    assert_eq!(
        session
            .files()
            .iter()
            .filter(|it| it.ends_with("jet.toml"))
            .count(),
        1
    );
    std::fs::write(&file, SCENE).expect("it is written");
    session.reload().expect("it is a scene");
    assert!(!is_watched(&session));
}

#[test]
fn what_was_not_set_is_undone_and_reset_to_that_and_replayed_so() {
    let (folder, mut session) = session();
    let path = "system.jet.end_frame";
    steps(&mut session, 3);
    session.turn(path, "5").expect("it turns");
    steps(&mut session, 4);
    assert_eq!(session.scene().systems[0].end_frame, Some(5));
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].end_frame, None);
    assert_eq!(value(&session, path), KnobValue::None);
    steps(&mut session, 4);
    session.turn(path, "30").expect("it turns");
    session.reset(path).expect("the scene need not say it");
    assert_eq!(session.scene().systems[0].end_frame, None);
    steps(&mut session, 2);
    let mut saved = saved(&folder, &session);
    let last = saved.recording.changes.last().expect("there are some");
    assert_eq!(last.set, "system.jet.end_frame=unset");
    let replayed = saved.replay.state_digest().expect("it is told");
    assert_eq!(replayed, digest(&mut session));
    session
        .reset("system.jet.color.mean")
        .expect_err("a colour is needed");
}
