//! Clicks at the picture: what burns there, and where boids steer to.

use super::*;

/// A cube that burns somewhat, seen along z from 3 away: 18 pixels a unit at a distance of 1.
const CUBE: &str = r#"frames = 60
image = { width = 64, height = 36 }
camera = { position = [0, 0, 3], target = [0, 0, 0], vertical_fov_degrees = 90 }
[[fire]]
name = "oak"
lifetime = 12
[fire.spread]
mesh = "cube"
scale = 0.5
time_scale = 0.1
drop_distance = 0.05
ignition = [{ position = [0, 0, -0.5] }]
"#;

fn begun(text: &str, sets: &[&str]) -> (tempfile::TempDir, Session) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, text).expect("it is written");
    let mut session = Session::new(source(&scene, sets)).expect("it begins");
    session.simulation().draw().expect("it is drawn");
    (folder, session)
}

/// Control points of the ring that began last.
fn last_ring(session: &mut Session) -> Vec<[f32; 3]> {
    let points = session
        .simulation()
        .control_points()
        .expect("they are told");
    let last = points.iter().map(|point| point.ring).max();
    let own = points.iter().filter(|point| Some(point.ring) == last);
    own.map(|point| point.position).collect()
}

fn assert_near(points: &[[f32; 3]], place: [f32; 3]) {
    assert!(!points.is_empty());
    for point in points {
        let off = (0..3).map(|axis| (point[axis] - place[axis]).abs());
        assert!(off.fold(0.0, f32::max) < 1e-5, "{point:?} {place:?}");
    }
}

#[test]
fn a_click_lights_what_it_meets() {
    let (_folder, mut session) = begun(CUBE, &[]);
    steps(&mut session, 4);
    session.simulation().draw().expect("it is drawn");
    // Its face is 2.5 away: a pixel is 2.5 / 18 wide there. It ends 3.6 pixels from the middle.
    assert_eq!(session.touch([32.0 + 3.7, 18.0], false), Ok(None));
    assert_eq!(session.touch([32.0, 18.0], true), Ok(None));
    let done = session.touch([32.0 + 1.8, 18.0 - 0.9], false);
    let done = done.expect("there is room").expect("something burns");
    assert!(done.contains("`fire.oak`"), "{done}");
    steps(&mut session, 1);
    assert_near(&last_ring(&mut session), [0.25, 0.125, 0.5]);
    // What has begun to burn cannot be undone, and does not stand before what can be.
    let told = session.undo().expect_err("it burns");
    assert!(told.contains("has begun to burn before"), "{told}");
    assert_eq!(session.undo(), Ok(false));
    // It burns on.
    steps(&mut session, 8);
    let ring = last_ring(&mut session);
    assert!(
        ring.iter().any(|[x, ..]| (x - 0.25).abs() > 0.05),
        "{ring:?}"
    );
}

#[test]
fn a_click_meets_what_has_moved_and_turned() {
    let posed = [
        "fire.oak.position=[0.5, 0, 0]",
        "fire.oak.rotation_degrees=[0, 90]",
    ];
    let (_folder, mut session) = begun(CUBE, &posed);
    session
        .touch([32.0 + 3.6 + 1.8, 18.0 - 0.9], false)
        .expect("there is room")
        .expect("something burns");
    // It turned its left side to the viewer.
    let ignitions = &session.scene().fires[0]
        .spread
        .as_ref()
        .expect("it spreads")
        .ignitions;
    let [x, y, z] = ignitions[1].position;
    assert!(
        (x + 0.5).abs() < 1e-5 && (y - 0.125).abs() < 1e-5,
        "{x} {y}"
    );
    assert!((z - 0.25).abs() < 1e-5, "{z}");
    steps(&mut session, 1);
    assert_near(&last_ring(&mut session), [0.75, 0.125, 0.5]);
}

#[test]
fn a_click_does_not_reach_behind_what_does_not_burn() {
    let screen = "[[surface]]\nmesh = \"plane\"\nscale = 0.2\nposition = [0, 0, 1]\n";
    let (_folder, mut session) = begun(&(CUBE.to_owned() + screen), &[]);
    assert_eq!(session.touch([32.0, 18.0], false), Ok(None));
    // Beside it the cube is seen.
    let beside = session.touch([32.0 + 2.5, 18.0], false);
    assert!(matches!(beside, Ok(Some(_))), "{beside:?}");
}

#[test]
fn what_was_lit_by_hand_is_replayed_bit_for_bit() {
    let (folder, mut session) = begun(CUBE, &[]);
    steps(&mut session, 5);
    session.simulation().draw().expect("it is drawn");
    let click = |session: &mut Session, x: f32| {
        let done = session.touch([x, 18.0], false);
        assert!(matches!(done, Ok(Some(_))), "{done:?}");
    };
    click(&mut session, 31.0);
    click(&mut session, 34.0);
    steps(&mut session, 6);
    session
        .turn("fire.oak.spread.time_scale", "0.2")
        .expect("it turns");
    click(&mut session, 32.5);
    steps(&mut session, 9);
    let Saved { mut replay, .. } = saved(&folder, &session);
    assert_eq!(replay.state_digest().expect("told"), digest(&mut session));
    let rings = |points: Vec<motes::simulation::PointState>| points.iter().map(|it| it.ring).max();
    assert_eq!(rings(replay.control_points().expect("told")), Some(3));
    // Begun again and gone to the same frame, it is the same, too.
    let (frame, seen) = (session.frame(), digest(&mut session));
    session.restart(frame).expect("it begins again");
    assert_eq!(digest(&mut session), seen);
}

#[test]
fn what_burns_already_cannot_be_taken_back() {
    let (_folder, mut session) = begun(CUBE, &[]);
    steps(&mut session, 3);
    let elsewhere = "[{ position = [0, 0, 0.5] }]";
    let told = session.turn("fire.oak.spread.ignition", elsewhere);
    let told = told.expect_err("it has begun to burn");
    assert!(
        told.contains("`fire.oak` has begun to burn before"),
        "{told}"
    );
    assert!(told.contains("first_frame is below 4"), "{told}");
    let later = "[{ position = [0, 0, -0.5] }, { position = [0, 0, 0.5], first_frame = 9 }]";
    session
        .turn("fire.oak.spread.ignition", later)
        .expect("it is to come");
    // It can be called off as long as it has not begun.
    let none = "[{ position = [0, 0, -0.5] }]";
    steps(&mut session, 2);
    session
        .turn("fire.oak.spread.ignition", none)
        .expect("it has not begun");
    steps(&mut session, 8);
    let points = session
        .simulation()
        .control_points()
        .expect("they are told");
    assert!(!points.is_empty() && points.iter().all(|point| point.ring == 0));
}

#[test]
fn boids_come_to_a_click_and_flee_from_the_other_button() {
    let text = "frames = 90\nimage = { width = 64, height = 36 }\n\
         camera = { position = [0, 0, 10], target = [0, 0, 0], projection = \"orthographic\", view_height = 36 }\n\
         [[flock]]\nname = \"starlings\"\ncount = 40\nmax_speed = 0.5\nstart_speed = 0\n\
         region = { min = [-10, -8, 0], max = [10, 8, 0] }\n";
    let mean_distance = |session: &mut Session| {
        let boids = session.simulation().boids().expect("they are told");
        let far = boids.iter().map(|boid| {
            let [x, y, _] = boid.position;
            f64::from((x - 8.0).hypot(y - 4.0))
        });
        far.sum::<f64>() / boids.len() as f64
    };
    let after = |away: Option<bool>| {
        let (folder, mut session) = begun(text, &[]);
        if let Some(away) = away {
            // A pixel is a unit: 8 to the right of the middle and 4 above.
            let done = session.touch([40.0, 14.0], away);
            let done = done.expect("there is room").expect("boids steer");
            assert!(done.contains("8.00, 4.00, 0.00"), "{done}");
        }
        steps(&mut session, 60);
        (mean_distance(&mut session), (folder, session))
    };
    let (own, _) = after(None);
    let (called, (_folder, mut session)) = after(Some(false));
    let (sent, _) = after(Some(true));
    assert!(
        called < 0.6 * own && sent > 1.3 * own,
        "{called} {own} {sent}"
    );
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().flocks[0].goal, None);
}

#[test]
fn a_mesh_that_is_written_again_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = folder.path().join("sail.obj");
    let sail = |high: u32| format!("v 0 0 0\nv 1 0 0\nv 0 {high} 0\nf 1 2 3\n");
    std::fs::write(&mesh, sail(1)).expect("it is written");
    let scene = folder.path().join("scene.toml");
    let text = CUBE.replace("mesh = \"cube\"", "mesh = \"sail.obj\"");
    std::fs::write(&scene, text).expect("it is written");
    let mut session = Session::new(source(&scene, &[])).expect("it begins");
    let names = |files: &[std::path::PathBuf]| -> Vec<String> {
        let name = |path: &std::path::PathBuf| {
            path.file_name().map(|it| it.to_string_lossy().into_owned())
        };
        files.iter().filter_map(name).collect()
    };
    assert_eq!(names(&session.files()), ["scene.toml", "sail.obj"]);
    let area = |session: &Session| {
        let spread = session.scene().fires[0]
            .spread
            .as_ref()
            .expect("it spreads");
        spread.surface.area()
    };
    assert_eq!(area(&session), 0.125);
    std::fs::write(&mesh, sail(2)).expect("it is written");
    // Turning a knob reads nothing anew.
    session
        .turn("fire.oak.spread.time_scale", "0.3")
        .expect("it turns");
    assert_eq!(area(&session), 0.125);
    session.reload().expect("it is right");
    assert_eq!(area(&session), 0.25);
    std::fs::write(&mesh, "v 0 0 0\n").expect("it is written");
    session.reload().expect_err("it has no triangle");
    assert_eq!(area(&session), 0.25);
    // The last good state goes on, whatever is asked of it.
    session
        .set_detail(motes::view::Detail::LEVELS[1])
        .expect("it goes on");
    session.restart(3).expect("it begins again");
    assert_eq!(area(&session), 0.25);
    session
        .turn("fire.oak.spread.time_scale", "0.1")
        .expect("it turns");
}
