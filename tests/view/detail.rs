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
    less.set_detail(Detail::LEVELS[3]).expect("it goes on");
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
    less.set_detail(Detail::LEVELS[0]).expect("it goes on");
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
    let mut lit = |level: usize, least: u8| {
        session
            .set_detail(Detail::LEVELS[level])
            .expect("it goes on");
        session.simulation().draw().expect("it is drawn");
        let image = session.simulation().image().expect("it is read");
        let pixels = image.chunks(4);
        let lit: Vec<bool> = pixels.map(|it| it[0] > least).collect();
        lit
    };
    let (flames, lines) = (lit(1, 8), lit(2, 40));
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
    session.least_rate = Some(1e6);
    steps(&mut session, 70);
    assert_eq!(session.detail(), Detail::LEVELS[3], "none is that fast");
    session.least_rate = Some(1e-3);
    steps(&mut session, 70);
    assert_eq!(session.detail(), Detail::LEVELS[0], "there is time enough");
    session.least_rate = None;
    steps(&mut session, 30);
    assert_eq!(session.detail(), Detail::LEVELS[0]);
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
    session.least_rate = Some(1e6);
    steps(&mut session, 50);
    assert_eq!(session.detail(), Detail::LEVELS[0]);
}
