//! Less detail, by hand and by the clock.

use super::*;
use motes::scene::FlameForm;
use motes::view::Detail;

const FIRE: &str = r#"frames = 60
image = { width = 66, height = 38 }
camera = { position = [0, 1, 4], target = [0, 0.5, 0] }
[[fire]]
name = "oak"
lifetime = 8
[fire.spread]
mesh = "cube"
scale = 0.5
time_scale = 0.2
drop_distance = 0.05
ignition = [{ position = [0, 0, 0.5] }]
"#;

fn fire() -> (tempfile::TempDir, Session) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("fire.toml");
    std::fs::write(&scene, FIRE).expect("it is written");
    let session = Session::new(source(&scene, &[])).expect("it begins");
    (folder, session)
}

#[test]
fn less_is_drawn_of_the_same_run() {
    let (_folder, mut all) = fire();
    let (_other, mut less) = fire();
    steps(&mut all, 6);
    all.turn("fire.oak.spread.time_scale", "0.3")
        .expect("it turns");
    steps(&mut all, 24);
    steps(&mut less, 6);
    let least = Detail::LEVELS[2].with_lines(true);
    less.set_detail(least).expect("it goes on");
    assert_eq!(less.frame(), 6);
    let scene = less.scene();
    assert_eq!((scene.image.width, scene.image.height), (17, 10));
    assert_eq!(scene.fires[0].form, FlameForm::Line);
    less.simulation().draw().expect("it is drawn");
    less.turn("fire.oak.spread.time_scale", "0.3")
        .expect("it turns");
    steps(&mut less, 12);
    less.set_detail(Detail::LEVELS[1]).expect("it goes on");
    assert_eq!(less.scene().fires[0].form, FlameForm::Particles);
    assert_eq!(less.scene().image.width, 33);
    steps(&mut less, 12);
    assert_eq!(digest(&mut less), digest(&mut all));
    less.set_detail(Detail::FULL).expect("it goes on");
    let [of_less, of_all] = [&mut less, &mut all].map(|session| {
        let simulation = session.simulation();
        simulation.draw().expect("it is drawn");
        simulation.image().expect("it is read")
    });
    assert!(of_less == of_all, "with all detail it is the same picture");
    // What is drawn is no change of the run.
    assert_eq!(less.recording().changes.len(), 1);
}

#[test]
fn lines_stand_where_flames_do() {
    let (_folder, mut session) = fire();
    steps(&mut session, 20);
    let mut lit = |lines: bool, least: u8| {
        session
            .set_detail(Detail::LEVELS[1].with_lines(lines))
            .expect("it goes on");
        session.simulation().draw().expect("it is drawn");
        let image = session.simulation().image().expect("it is read");
        let pixels = image.chunks(4);
        let lit: Vec<bool> = pixels.map(|it| it[0] > least).collect();
        lit
    };
    let (flames, lines) = (lit(false, 8), lit(true, 40));
    let count = |lit: &[bool]| lit.iter().filter(|it| **it).count();
    let both = flames
        .iter()
        .zip(&lines)
        .filter(|(a, b)| **a && **b)
        .count();
    assert!(count(&lines) > 10, "{}", count(&lines));
    assert!(count(&lines) < count(&flames), "{}", count(&flames));
    assert_eq!(both, count(&lines), "none is where no flame is");
}

#[test]
fn detail_follows_the_time_that_frames_take() {
    let (_folder, mut session) = fire();
    session.pace.least_rate = Some(1e6);
    let lines = Detail::FULL.with_lines(true);
    session.set_detail(lines).expect("it goes on");
    steps(&mut session, 90);
    let least = Detail::LEVELS[4].with_lines(true);
    assert_eq!(session.detail(), least, "none is that fast");
    session.pace.least_rate = Some(1e-3);
    steps(&mut session, 90);
    assert_eq!(session.detail(), lines, "there is time enough");
    session.set_detail(Detail::FULL).expect("it goes on");
    steps(&mut session, 30);
    assert_eq!(session.detail(), Detail::FULL, "there is time enough");
    session.pace.least_rate = None;
    steps(&mut session, 30);
    assert_eq!(session.detail(), Detail::FULL);
}

#[test]
fn every_frame_is_stepped_where_few_are_drawn() {
    let (_folder, mut all) = fire();
    let (_other, mut few) = fire();
    few.set_detail(Detail::LEVELS[4]).expect("it goes on");
    let frame = Duration::from_secs_f64(1.0 / f64::from(few.scene().frame_rate));
    let mut drawn = Vec::new();
    for _ in 0..24 {
        let before = few.frame();
        if few.advance(frame).expect("it steps") {
            drawn.push(few.frame() - before);
        }
    }
    // A frame may be owed still, for lengths of frames are rounded.
    assert!((5..=6).contains(&drawn.len()), "{drawn:?}");
    assert!(drawn.iter().all(|frames| *frames == 4), "{drawn:?}");
    let frame = few.frame();
    steps(&mut all, frame);
    assert_eq!(digest(&mut few), digest(&mut all));
    assert_eq!(few.history.len(), drawn.len(), "one time a picture");
}

#[test]
fn where_births_go_by_area_all_is_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("jet.toml");
    let text = SCENE.replace(
        "initial_mean_parts = 30",
        "initial_mean_parts_per_area = 0.1",
    );
    std::fs::write(&scene, text).expect("it is written");
    let mut session = Session::new(source(&scene, &["capacity=10000"])).expect("it begins");
    assert!(!session.can_be_coarse());
    let told = session.set_detail(Detail::LEVELS[1]);
    assert!(told.is_err_and(|told| told.contains("by the area")));
    session.pace.least_rate = Some(1e6);
    steps(&mut session, 50);
    assert_eq!(session.detail(), Detail::FULL);
}
