//! Going to another frame beside what is seen.

use super::*;

/// Every one of its frames matters to those after it.
const FLOCK: &str = r#"frames = 2000
image = { width = 40, height = 30 }
camera = { projection = "orthographic", position = [20, 15, 50], target = [20, 15, 0], view_height = 30 }
[[flock]]
name = "gulls"
count = 20
region = { min = [0, 0, 0], max = [40, 30, 0] }
"#;

/// Lets a run go on until it is there; what [`Session::on_the_way`] told after each pass before.
fn come(session: &mut Session) -> Vec<(u32, u32)> {
    let mut told = Vec::new();
    while !session.advance(Duration::ZERO).expect("it goes on") {
        told.push(session.on_the_way().expect("it is on its way"));
    }
    told
}

#[test]
fn what_is_seen_stays_until_the_run_is_at_its_other_frame() {
    let (folder, mut session) = begun(FLOCK);
    steps(&mut session, 5);
    session.playing = false;
    let key = "flock.gulls.max_speed";
    session.turn(key, "3.5").expect("it turns");
    steps(&mut session, 2);
    let before = (session.frame(), digest(&mut session));
    session.go_to(1500).expect("it sets out");
    assert_eq!(session.on_the_way(), Some((1500, 0)));
    let mine = folder.path().join("mine.toml");
    let told = session.save_as(&mine).expect_err("it would be neither");
    assert!(told.to_string().contains("on its way to frame 1500"));
    assert!(!mine.exists());
    // Frame 0 is one that it steps to.
    let mut last = None;
    let mut passes = 0;
    while !session.advance(Duration::ZERO).expect("it goes on") {
        let (to, at) = session.on_the_way().expect("it is on its way");
        assert!(to == 1500 && last.is_none_or(|last| at > last), "{at}");
        assert_eq!((session.frame(), digest(&mut session)), before);
        (last, passes) = (Some(at), passes + 1);
    }
    assert!(passes > 1, "it took {passes} passes more");
    assert_eq!((session.on_the_way(), session.frame()), (None, 1500));
    let mut replay = saved(&folder, &session).replay;
    assert_eq!(replay.frame(), Some(1500));
    let digest_of_replay = replay.state_digest().expect("it is told");
    assert_eq!(digest_of_replay, digest(&mut session));
    // What was done can be undone there, too.
    assert_eq!(session.undo(), Ok(true));
}

#[test]
fn who_stays_has_all_as_it_was() {
    let (folder, mut session) = begun(FLOCK);
    steps(&mut session, 5);
    session.playing = false;
    let before = (session.frame(), digest(&mut session));
    session.go_to(1500).expect("it sets out");
    session.stay();
    assert_eq!(session.on_the_way(), None);
    assert!(!session.advance(Duration::from_secs(1)).expect("it pauses"));
    assert_eq!((session.frame(), digest(&mut session)), before);
    // A step is one of the run that is seen, and so is what is turned.
    session.go_to(1500).expect("it sets out");
    steps(&mut session, 1);
    assert_eq!((session.on_the_way(), session.frame()), (None, 6));
    session.go_to(1500).expect("it sets out");
    let key = "flock.gulls.max_speed";
    session.turn(key, "3.5").expect("it turns");
    assert_eq!((session.on_the_way(), session.frame()), (None, 6));
    assert_eq!(session.scene().flocks[0].max_speed, 3.5);
    // A scene that was written again and not come to is not the one that is played.
    let file = folder.path().join("own.toml");
    let other = FLOCK.replace("count = 20", "count = 30");
    std::fs::write(&file, &other).expect("it is written");
    session.read_again().expect("it is a scene");
    assert_eq!(session.scene().flocks[0].count, 20);
    session.stay();
    session.turn(key, "3.0").expect("it turns");
    assert_eq!(session.scene().flocks[0].count, 20);
    std::fs::write(&file, "frames = no").expect("it is written");
    session.read_again().expect_err("it is no scene");
    steps(&mut session, 1);
    std::fs::write(&file, &other).expect("it is written");
    session.read_again().expect("it is a scene");
    come(&mut session);
    assert_eq!(session.scene().flocks[0].count, 30);
    assert_eq!(session.frame(), 7);
    assert_eq!(session.undo(), Ok(false), "it is another scene's");
}

#[test]
fn who_is_on_the_way_to_a_frame_goes_there_in_what_is_read_meanwhile() {
    let (folder, mut session) = begun(FLOCK);
    steps(&mut session, 5);
    session.go_to(300).expect("it sets out");
    let file = folder.path().join("own.toml");
    let other = FLOCK.replace("count = 20", "count = 30");
    std::fs::write(&file, other).expect("it is written");
    session.read_again().expect("it is a scene");
    assert_eq!(session.on_the_way(), Some((300, 0)));
    come(&mut session);
    let there = (session.frame(), session.scene().flocks[0].count);
    assert_eq!(there, (300, 30));
}

#[test]
fn a_script_goes_to_a_frame() {
    let (folder, _) = begun(FLOCK);
    let script = "0 key Space\n1 frame 12\n9 save there.toml\n";
    std::fs::write(folder.path().join("play.txt"), script).expect("it is written");
    let arguments = ["view", "own.toml", "--script", "play.txt"];
    let output = motes(folder.path(), &arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(stderr.contains("frame 12,"), "{stderr}");
    let inputs = std::fs::read_to_string(folder.path().join("there.inputs"));
    assert!(inputs.expect("it is there").contains("--frames 0..13"));
}
