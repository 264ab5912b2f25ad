//! What the window's widgets do, by pointer and keys; and what undo and a new beginning do to it.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Shape, vec2};
use motes::view::App;

use super::*;

/// A window that nobody sees, and what it shows.
struct Desk {
    app: App,
    ctx: egui::Context,
    passes: u32,
    shown: Vec<(String, Rect)>,
}

impl Desk {
    fn new(session: Session) -> Self {
        let mut desk = Self {
            app: App::new(session),
            ctx: egui::Context::default(),
            passes: 0,
            shown: Vec::new(),
        };
        desk.app.session.playing = false;
        desk.wait(3);
        desk
    }

    /// A pass as long as a frame.
    fn pass(&mut self, events: Vec<Event>) {
        let frame = Duration::from_secs_f64(1.0 / 24.0);
        self.app.pass(frame);
        self.show(events);
    }

    /// What is shown, and no time passes.
    fn look(&mut self) {
        self.show(Vec::new());
    }

    fn show(&mut self, events: Vec<Event>) {
        let input = egui::RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(1200.0, 2600.0))),
            time: Some(f64::from(self.passes) / 24.0),
            events,
            focused: true,
            ..Default::default()
        };
        self.passes += 1;
        let app = &mut self.app;
        let mut output = self.ctx.run_ui(input, |ui| app.ui(ui));
        // Nobody draws it.
        output.textures_delta.clear();
        self.shown.clear();
        for clipped in &output.shapes {
            note(&clipped.shape, clipped.clip_rect, &mut self.shown);
        }
    }

    /// Waits until the run is at the frame that it is on its way to.
    fn come(&mut self) {
        while self.app.session.on_the_way().is_some() {
            self.wait(1);
        }
    }

    fn wait(&mut self, passes: u32) {
        for _ in 0..passes {
            self.pass(Vec::new());
        }
    }

    fn at(&self, text: &str) -> Pos2 {
        let is_it = |(shown, area): &&(String, Rect)| shown.trim() == text && area.min.y < 2400.0;
        let found = self.shown.iter().find(is_it);
        let found = found.map(|(_, area)| area.center());
        found.unwrap_or_else(|| panic!("no `{text}` in {:?}", self.shown))
    }

    /// What stands to the right of a text, in order.
    fn beside(&self, text: &str) -> Vec<(String, Pos2)> {
        let at = self.at(text);
        let mut row: Vec<(String, Pos2)> = self
            .shown
            .iter()
            .map(|(text, area)| (text.trim().to_owned(), area.center()))
            .filter(|(_, other)| other.x > at.x && other.x < 500.0 && (other.y - at.y).abs() < 6.0)
            .collect();
        row.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
        row
    }

    fn words(&self, text: &str) -> Vec<String> {
        let row = self.beside(text).into_iter();
        row.map(|(text, _)| text).collect()
    }

    fn button(&mut self, at: Pos2, pressed: bool) {
        let button = Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.pass(vec![Event::PointerMoved(at), button]);
    }

    fn click(&mut self, at: Pos2) {
        self.pass(vec![Event::PointerMoved(at)]);
        self.button(at, true);
        self.button(at, false);
        self.wait(1);
    }

    /// Drags to the right, some points in each of so many passes.
    fn drag(&mut self, from: Pos2, points: f32, passes: u32) {
        self.pass(vec![Event::PointerMoved(from)]);
        self.button(from, true);
        let mut at = from;
        for _ in 0..passes {
            at.x += points;
            self.pass(vec![Event::PointerMoved(at)]);
        }
        self.button(at, false);
        self.wait(1);
    }

    /// Clicks at a slot and writes into it, a letter a pass; without Enter.
    fn write(&mut self, at: Pos2, text: &str) {
        self.click(at);
        self.wait(2);
        for letter in text.chars() {
            self.pass(vec![Event::Text(letter.to_string())]);
        }
    }

    fn key(&mut self, key: Key) {
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        self.pass(vec![event(true), event(false)]);
    }

    /// The transport's slot whose name that is.
    fn slot(&self, name: &str) -> Pos2 {
        let is_it = |text: &str| {
            let rest = text.strip_prefix(name).map(str::trim);
            rest.is_some_and(|rest| rest.chars().all(|it| it.is_ascii_digit()))
        };
        let below = self.shown.iter().filter(|(_, area)| area.min.y > 2400.0);
        let mut found = below.filter(|(text, _)| is_it(text.trim()));
        let (_, area) = found.next().expect("there is such a slot");
        area.center()
    }

    /// Opens a group of knobs.
    fn open(&mut self, group: &str) {
        self.click(self.at(group));
        self.wait(20);
    }
}

fn note(shape: &Shape, clip: Rect, shown: &mut Vec<(String, Rect)>) {
    match shape {
        Shape::Vec(all) => all.iter().for_each(|one| note(one, clip, shown)),
        Shape::Text(text) => {
            let area = text.galley.rect.translate(text.pos.to_vec2());
            if clip.contains(area.center()) {
                shown.push((text.galley.text().to_owned(), area));
            }
        }
        _ => {}
    }
}

#[test]
fn frames_and_seeds_are_written_and_dragged_in() {
    let (_folder, session) = session();
    let mut desk = Desk::new(session);
    desk.app.session.playing = true;
    desk.wait(8);
    desk.write(desk.slot("frame"), "3");
    assert!(desk.app.session.frame() > 10, "it plays on meanwhile");
    desk.key(Key::Enter);
    desk.come();
    assert_eq!(desk.app.session.frame(), 3);
    desk.wait(4);
    desk.write(desk.slot("seed"), "99");
    assert_eq!(desk.app.session.scene().seed, 7);
    desk.key(Key::Enter);
    assert_eq!(desk.app.session.scene().seed, 99);
    desk.wait(6);
    // What is not altered goes on.
    let before = desk.app.session.frame();
    desk.click(desk.slot("frame"));
    desk.wait(3);
    desk.key(Key::Enter);
    assert!(desk.app.session.frame() > before);
    desk.app.session.playing = false;
    desk.wait(1);
    let before = desk.app.session.frame();
    desk.drag(desk.slot("frame"), 10.0, 4);
    desk.come();
    let after = desk.app.session.frame();
    assert!(
        (before + 5..=before + 12).contains(&after),
        "{before} {after}"
    );
}

#[test]
fn what_is_held_is_undone_in_one_go() {
    let (_folder, session) = session();
    let mut desk = Desk::new(session);
    desk.open("system.jet");
    let path = "system.jet.drag";
    let drag = |desk: &Desk| desk.app.session.scene().systems[0].drag;
    let slot = |desk: &Desk| desk.beside("drag")[0].1;
    // Paused; and while it plays, when each pass is a frame.
    desk.drag(slot(&desk), 8.0, 5);
    let first = drag(&desk);
    assert!(first > 0.0);
    desk.app.session.playing = true;
    desk.drag(slot(&desk), 8.0, 5);
    let second = drag(&desk);
    assert!(second > first, "{first} {second}");
    let frames = desk.app.session.recording().changes.iter();
    assert!(frames.filter(|change| change.key() == path).count() > 3);
    desk.app.session.playing = false;
    desk.click(desk.at("Undo"));
    assert_eq!(drag(&desk), first);
    desk.click(desk.at("Undo"));
    assert_eq!(drag(&desk), 0.0);
    // A turn right after an undo is of its own.
    let session = &mut desk.app.session;
    session.turn(path, "0.1").expect("it turns");
    session.step().expect("it steps");
    session.turn(path, "0.2").expect("it turns");
    assert_eq!(session.undo(), Ok(true));
    session.turn(path, "0.3").expect("it turns");
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].drag, 0.1);
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].drag, 0.0);
    assert_eq!(session.undo(), Ok(false));
}

#[test]
fn what_was_not_said_is_not_said_again() {
    let (_folder, mut session) = session();
    session.turn("system.jet.drag", "0.5").expect("it turns");
    steps(&mut session, 2);
    session
        .turn("system.jet.end_frame", "30")
        .expect("it turns");
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].end_frame, None);
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].drag, 0.0);
    assert_eq!(session.undo(), Ok(false));
}

/// A cube that burns.
const CUBE: &str = r#"frames = 60
image = { width = 64, height = 36 }
camera = { position = [0, 0, 3], target = [0, 0, 0], vertical_fov_degrees = 90 }
[[fire]]
name = "oak"
lifetime = 12
noisiness = { keys = [[0, 0.01], [20, 0.04], [40, 0.02]] }
[fire.spread]
mesh = "cube"
scale = 0.5
time_scale = 0.1
ignition = [{ position = [0, 0, -0.5] }]
"#;

#[test]
fn knobs_show_what_holds_and_are_set_to_what_fits() {
    let text = SCENE.replace("size = 0.05", "size = 0.00002");
    let (_folder, session) = begun(&text);
    let mut desk = Desk::new(session);
    desk.open("scene");
    assert_eq!(desk.words("seed"), ["7", "for a whole run"]);
    assert_eq!(desk.words("max_systems")[..1], ["not set systems"]);
    desk.click(desk.at("scene"));
    desk.wait(20);
    desk.open("system.jet");
    assert_eq!(desk.words("size.mean")[0], "2e-5");
    assert_eq!(desk.words("end_frame"), ["not set", "set"]);
    desk.click(desk.beside("end_frame")[1].1);
    // Births do not end at once.
    let end = desk.app.session.scene().systems[0].end_frame;
    assert_eq!(end, Some(40));
    assert!(desk.words("end_frame")[0].starts_with("40"));
    // Written in, by keys.
    desk.write(desk.beside("size.mean")[0].1, "0.25");
    assert_eq!(
        value(&desk.app.session, "system.jet.size.mean"),
        KnobValue::Written("0.00002".into())
    );
    desk.key(Key::Enter);
    assert_eq!(
        value(&desk.app.session, "system.jet.size.mean"),
        KnobValue::Written("0.25".into())
    );
    // Back to the default.
    desk.app
        .session
        .turn("system.jet.drag", "0.5")
        .expect("it turns");
    desk.wait(1);
    assert_eq!(desk.words("drag").last().map(String::as_str), Some("reset"));
    let back = desk.beside("drag").pop().expect("there is a button");
    desk.click(back.1);
    assert_eq!(desk.app.session.scene().systems[0].drag, 0.0);
    assert_eq!(desk.words("drag")[0], "0");

    let (_folder, session) = begun(CUBE);
    let mut desk = Desk::new(session);
    assert_eq!(desk.words("noisiness C"), ["keyed: 3 keys", "reset"]);
    desk.open("fire.oak");
    assert_eq!(desk.words("blackbody"), ["not set", "set"]);
    desk.click(desk.beside("blackbody")[1].1);
    assert!(desk.app.message.is_none(), "{:?}", desk.app.message);
    assert_eq!(
        value(&desk.app.session, "fire.oak.blackbody"),
        KnobValue::Written("[2000, 1400]".into())
    );
}

#[test]
fn p78b_the_knobs_of_the_table_stand_first() {
    let (_folder, session) = begun(CUBE);
    let mut desk = Desk::new(session);
    desk.wait(10);
    let labels = [
        "how oak burns",
        "time scale K",
        "drop distance d_d",
        "separation d_s",
        "inverse cohesion k_p",
        "noisiness C",
        "sampling k_s",
        "curvature distance d_t",
        "lifetime l_f",
        "scene",
        "fire.oak",
    ];
    let heights = labels.map(|label| desk.at(label).y);
    assert!(heights.is_sorted(), "{heights:?}");
    // A fifth of the mean edge of 0.5, set as it is: nothing changes but that it can be turned.
    let distance = |desk: &Desk| {
        let spread = desk.app.session.scene().fires[0].spread.as_ref();
        spread.expect("it spreads").drop_distance
    };
    let before = distance(&desk);
    desk.click(desk.beside("drop distance d_d")[1].1);
    assert_eq!(distance(&desk), before);
    desk.drag(desk.beside("drop distance d_d")[0].1, 10.0, 4);
    assert!(distance(&desk) > before);
    desk.click(desk.at("Undo"));
    assert_eq!(distance(&desk), before);
}

/// Another value of a knob that may fit.
fn other(knob: &motes::scene::Knob) -> Option<String> {
    use motes::scene::schema::Kind;
    let (KnobValue::Written(text) | KnobValue::Default(text)) = &knob.value else {
        return None;
    };
    match knob.field.kind {
        Kind::Flag => Some((text != "true").to_string()),
        Kind::Whole { min, max } => {
            let now: i64 = text.replace('_', "").parse().ok()?;
            [now + 1, now - 1]
                .into_iter()
                .find(|it| (min..=max).contains(it))
                .map(|it| it.to_string())
        }
        Kind::Numbers {
            count: 1, limits, ..
        } => {
            let now: f64 = text.replace('_', "").parse().ok()?;
            [now * 1.01 + 1e-3, now * 0.99 - 1e-3]
                .into_iter()
                .find(|it| (limits.min..=limits.max).contains(it))
                .map(|it| format!("{it:?}"))
        }
        Kind::Choice(words) => {
            let now = text.trim_matches('"');
            let word = words
                .iter()
                .find(|word| **word != now && **word != "stroke");
            word.map(|word| format!("\"{word}\""))
        }
        _ => None,
    }
}

#[test]
fn knobs_of_a_whole_run_are_those_that_no_run_takes() {
    let flock = "frames = 9\nimage = { width = 64, height = 36 }\n\
         camera = { position = [0, 0, 10], target = [0, 0, 0] }\n\
         [[flock]]\nname = \"starlings\"\ncount = 40\ntrail_frames = 3\n\
         region = { min = [-10, -8, 0], max = [10, 8, 0] }\n\
         [[surface]]\nmesh = \"torus\"\n";
    let fire = CUBE.to_owned()
        + "char = {}\nsmoke = {}\ncatch_points = 8\n[[fire]]\nname = \"ring\"\n\
           roots = { kind = \"circle\", radius = 1, count = 5 }\n";
    let grass = SCENE.replace(
        "lifetime = 9",
        "particle_shape = \"stroke\"\nblend = \"over\"\nlifetime = 9",
    );
    let (mut taken, mut refused) = (0, 0);
    for text in [SCENE, flock, &fire, &grass] {
        let (_folder, mut session) = begun(text);
        for knob in session.knobs().to_vec() {
            let Some(value) = other(&knob) else {
                continue;
            };
            let is_fixed = session.is_fixed(&knob.path);
            let mut outcome = session.turn(&knob.path, &value);
            if is_fixed && outcome.is_ok() {
                // Refused as late as where it is replayed.
                outcome = session.restart(session.frame());
                session.undo().expect(&knob.path);
            }
            let is_of_run = outcome.as_ref().is_err_and(|told| {
                told.contains("holds for a whole run") || told.contains("changes nothing in a run")
            });
            if outcome.is_ok() {
                taken += 1;
                session.undo().expect(&knob.path);
            }
            refused += u32::from(is_of_run);
            // These say nothing where there are no strokes, or no clouds that throw shadows.
            let is_idle = knob.path.contains(".stroke_") && !text.contains("stroke")
                || knob.path == "light.shadow_cells";
            let is_right = match is_fixed {
                true => outcome.is_err() || is_idle,
                false => !is_of_run,
            };
            assert!(is_right, "{} = {value}: {outcome:?}", knob.path);
        }
    }
    assert!(taken > 100 && refused > 12, "{taken} {refused}");
}

#[test]
fn a_run_that_is_begun_again_does_what_was_done_unless_something_else_is() {
    let (folder, mut session) = begun(CUBE);
    let light = |session: &mut Session, x: f32| {
        session.simulation().draw().expect("it is drawn");
        let lit = session.touch([x, 18.0], false);
        assert!(matches!(lit, Ok(Some(_))), "{lit:?}");
    };
    steps(&mut session, 4);
    session
        .turn("fire.oak.spread.time_scale", "0.2")
        .expect("it turns");
    steps(&mut session, 4);
    light(&mut session, 31.0);
    steps(&mut session, 6);
    session.turn("fire.oak.sampling", "0.4").expect("it turns");
    steps(&mut session, 4);
    let (frame, before) = (session.frame(), digest(&mut session));
    let done = session.recording().clone();
    session.restart(0).expect("it begins again");
    assert_eq!(session.upcoming(), 3);
    // Nothing of it has been done yet.
    assert_eq!(session.undo(), Ok(false));
    steps(&mut session, frame);
    assert_eq!((session.upcoming(), session.recording()), (0, &done));
    assert_eq!(digest(&mut session), before);
    assert_eq!(session.scene().fires[0].sampling, 0.4);
    // And can be undone again.
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().fires[0].sampling, 0.05);
    // Something else is done before it is lit.
    session.restart(6).expect("it begins again");
    assert_eq!(session.upcoming(), 3);
    session.turn("fire.oak.lifetime", "9").expect("it turns");
    assert_eq!(
        (session.upcoming(), session.recording().changes.len()),
        (0, 2)
    );
    steps(&mut session, 12);
    let own = session.simulation().control_points().expect("told");
    assert!(own.iter().all(|point| point.ring == 0));
    light(&mut session, 33.0);
    steps(&mut session, 3);
    let Saved { mut replay, .. } = saved(&folder, &session);
    assert_eq!(replay.state_digest().expect("told"), digest(&mut session));
    // Undo goes on with what was before it.
    session.undo().expect_err("it burns");
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.undo(), Ok(false));
    // Another seed takes what was done with it.
    let changes = session.recording().changes.len();
    session.reseed(5).expect("it begins again");
    assert_eq!(session.recording().changes.len(), changes);
}

#[test]
fn a_click_at_two_flocks_is_one_thing() {
    let flocks = |second_speed: &str| {
        let flock = |name: &str, speed: &str| {
            format!(
                "[[flock]]\nname = \"{name}\"\ncount = 20\nmax_speed = {speed}\nstart_speed = 0\n\
                 region = {{ min = [-10, -8, 0], max = [10, 8, 0] }}\n"
            )
        };
        "frames = 90\nimage = { width = 64, height = 36 }\n\
         camera = { position = [0, 0, 10], target = [0, 0, 0], projection = \"orthographic\", view_height = 36 }\n"
            .to_owned()
            + &flock("starlings", "0.5")
            + &flock("swifts", second_speed)
    };
    let weights = |session: &Session| {
        let flocks = session.scene().flocks.iter();
        let goals = flocks.map(|flock| flock.goal.map(|goal| goal.weight));
        goals.collect::<Vec<_>>()
    };
    let (_folder, mut session) = begun(&flocks("0.5"));
    session.simulation().draw().expect("it is drawn");
    let done = session.touch([40.0, 14.0], false);
    assert!(matches!(done, Ok(Some(_))), "{done:?}");
    assert_eq!(weights(&session), [Some(1.0); 2]);
    steps(&mut session, 3);
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(weights(&session), [None; 2]);
    assert_eq!(session.undo(), Ok(false));
    // A speed twice the greatest that there is: what the first was told is taken back.
    let (folder, mut session) = begun(&flocks("10_000"));
    session.simulation().draw().expect("it is drawn");
    session
        .touch([40.0, 14.0], false)
        .expect_err("it is too fast");
    assert_eq!(weights(&session), [None; 2]);
    assert!(session.recording().changes.is_empty());
    assert_eq!(session.undo(), Ok(false));
    steps(&mut session, 5);
    let Saved { mut replay, .. } = saved(&folder, &session);
    assert_eq!(replay.state_digest().expect("told"), digest(&mut session));
}

#[test]
fn nothing_is_written_over_that_nobody_asked_for_twice() {
    let (folder, session) = begun(SCENE);
    let mut desk = Desk::new(session);
    let file = folder.path().join("kept.toml");
    std::fs::write(&file, "mine").expect("it is written");
    desk.click(desk.at("own-mine.toml"));
    desk.pass(vec![Event::Key {
        key: Key::A,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    }]);
    desk.pass(vec![Event::Text(file.display().to_string())]);
    let read = || std::fs::read_to_string(&file).expect("it is there");
    desk.click(desk.at("Save as"));
    assert_eq!(read(), "mine");
    let told = desk.app.message.clone().expect("it is told");
    assert!(told.1 && told.0.contains("kept.toml is there"), "{told:?}");
    desk.click(desk.at("Save as"));
    assert_eq!(read(), SCENE);
    assert!(file.with_extension("inputs").is_file());
    desk.click(desk.at("Save as"));
    let told = desk.app.message.clone().expect("it is told");
    assert!(told.1, "it asks anew: {told:?}");
}

#[test]
fn births_that_find_no_room_are_told() {
    let (_folder, session) = begun(&("capacity = 20\n".to_owned() + SCENE));
    let mut desk = Desk::new(session);
    let is_told = |desk: &Desk| {
        let mut shown = desk.shown.iter();
        shown.any(|(text, _)| text.starts_with("no room for ") && text.contains("capacity"))
    };
    assert!(is_told(&desk), "{:?}", desk.shown);
    let (_folder, session) = begun(SCENE);
    let mut desk_of_room = Desk::new(session);
    desk_of_room.wait(2);
    assert!(!is_told(&desk_of_room));
    desk.wait(1);
}

#[test]
fn a_run_on_its_way_is_shown_and_can_be_stopped() {
    let (_folder, session) = session();
    let mut desk = Desk::new(session);
    let before = desk.app.session.frame();
    let is_shown = |desk: &Desk| {
        let mut shown = desk.shown.iter();
        shown.any(|(text, _)| text.starts_with("on the way to frame 30"))
    };
    desk.app.session.go_to(30).expect("it sets out");
    // No time passes, or it would be there. A panel has its new height in the second pass.
    desk.look();
    desk.look();
    assert!(is_shown(&desk), "{:?}", desk.shown);
    desk.app.session.stay();
    desk.wait(1);
    assert!(!is_shown(&desk));
    assert_eq!(desk.app.session.frame(), before);
    desk.app.session.go_to(30).expect("it sets out");
    desk.come();
    assert_eq!(desk.app.session.frame(), 30);
}

#[test]
fn clouds_without_shadows_stay_so_in_a_run() {
    let cloud = "frames = 20\nimage = { width = 40, height = 30 }\n\
        camera = { position = [0, 0, 5], target = [0, 0, 0] }\n\
        [light]\ndirection = [0, -1, 0]\nRADIUS\n\
        [[system]]\nname = \"cloud\"\ninitial_mean_parts = 30\nlifetime = 9\n\
        blend = \"over\"\nshading = \"lit_cloud\"\nsize = 0.3\n\
        generation_shape = { kind = \"sphere\", radius = 1 }\nspeed = 0.1\ncolor = [0.5, 0.5, 0.5]\n";
    let key = "light.shadow_radius";
    let (_folder, mut session) = begun(&cloud.replace("RADIUS", ""));
    assert!(session.is_fixed(key));
    session
        .turn(key, "2.0")
        .expect_err("there are no places for it");
    let (_folder, mut session) = begun(&cloud.replace("RADIUS", "shadow_radius = 2"));
    assert!(!session.is_fixed(key));
    session.turn(key, "3.0").expect("it turns");
    session.reset(key).expect_err("they throw them to the end");
}
