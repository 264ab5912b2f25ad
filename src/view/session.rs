//! A scene that somebody plays with: it runs, its knobs turn, and all that is done is recorded, so
//! that it can be done again bit for bit (Perry 1994, 1.2: interactive control).

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::detail::{Detail, hangs_on_pixels};
use super::error::WindowError;
use super::knobs::is_fixed;
use super::orbit::Orbit;
use super::pace::Pace;
use super::source::{Source, frame_end, lives_for_ever, told};
use crate::output::write_whole;
use crate::recording::{Change, Recording, without_effect};
use crate::scene::{Corners, Dimensions, Flock, Goal, Ignition, Knob, KnobValue, Scene, UNSET};
use crate::simulation::{Pick, Ray, Simulation};

/// How much boids accelerate, as a share of their greatest speed, to where somebody calls them.
const CALLED_LIMIT: f32 = 0.05;

/// What went wrong, for the window: a few lines.
pub type Told = String;

/// A scene under way.
pub struct Session {
    source: Source,
    simulation: Simulation,
    scene: Scene,
    /// What can be turned, as it is now.
    knobs: Vec<Knob>,
    recording: Recording,
    undone: Vec<Undo>,
    gesture: Gesture,
    /// One past the last frame that there are places for, where something lives for ever.
    frame_end: u32,
    /// Whether frames follow each other by themselves.
    pub playing: bool,
    /// Frames a second over those that the scene asks for.
    pub speed: f32,
    /// How it is looked at.
    pub orbit: Orbit,
    /// Time that steps are owed for.
    owed: Duration,
    /// What each kernel took in the last frame and the drawing before it, milliseconds; nothing where
    /// the device has no clock.
    pub times: Vec<(&'static str, f64)>,
    /// Frame times, the last 240, milliseconds.
    pub history: Vec<f32>,
    /// Gives up detail for frames a second, if it is to.
    pub pace: Pace,
}

/// What one gesture did, and how what it turned stood before.
struct Undo {
    /// The first frame that it holds for.
    frame: u32,
    /// Paths of keys, and what turns them back, in the order that they were turned in.
    before: Vec<(String, String)>,
    /// The frame from which on it is undone.
    undone_from: Option<u32>,
}

/// Whether somebody holds something now: all that they do until they let go is undone in one go.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Gesture {
    None,
    /// Nothing has been done since it began.
    Begun,
    /// What is done belongs to the last [`Undo`].
    Noted,
}

impl Session {
    /// Begins the scene at its first frame that is seen.
    ///
    /// # Errors
    /// The scene, or the machine.
    pub fn new(mut source: Source) -> Result<Self, Told> {
        source.read_files()?;
        let scene = source.load(&[])?;
        let knobs = source.knobs(&[])?;
        let recording = Recording::default();
        let simulation = source.begin(&scene, &recording, 0)?;
        Ok(Self {
            frame_end: frame_end(&scene, 0),
            orbit: Orbit::STILL,
            playing: true,
            speed: 1.0,
            owed: Duration::ZERO,
            times: Vec::new(),
            history: Vec::new(),
            pace: Pace::default(),
            undone: Vec::new(),
            gesture: Gesture::None,
            source,
            simulation,
            scene,
            knobs,
            recording,
        })
    }

    /// The scene as it is now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What can be turned, as it is now.
    pub fn knobs(&self) -> &[Knob] {
        &self.knobs
    }

    /// What has been done.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The simulation, for who draws or counts.
    pub fn simulation(&mut self) -> &mut Simulation {
        &mut self.simulation
    }

    /// Every file that the scene was read from last: its own, meshes and their buffers.
    pub fn files(&self) -> Vec<PathBuf> {
        self.source.paths()
    }

    /// The last frame that has been stepped.
    pub fn frame(&self) -> u32 {
        self.simulation.frame().unwrap_or(0)
    }

    /// Steps the frames that are due after this time, no more than one picture shows: what is too slow
    /// for its frame rate runs slower. Whether any was.
    ///
    /// # Errors
    /// The machine.
    pub fn advance(&mut self, passed: Duration) -> Result<bool, Told> {
        if !self.playing {
            return Ok(false);
        }
        let frames = self.detail().frames_a_picture;
        let rate = self.scene.frame_rate as f32 * self.speed.max(0.01);
        let due = Duration::from_secs_f32(frames as f32 / rate);
        self.owed = (self.owed + passed).min(due * 2);
        if self.owed < due {
            return Ok(false);
        }
        self.owed -= due;
        self.step_frames(frames)?;
        Ok(true)
    }

    /// Steps one frame.
    ///
    /// # Errors
    /// The machine, or there are no more frames: where something lives for ever, a run has an end.
    pub fn step(&mut self) -> Result<(), Told> {
        self.step_frames(1)
    }

    fn step_frames(&mut self, count: u32) -> Result<(), Told> {
        let begun = Instant::now();
        self.times.clear();
        for _ in 0..count {
            if self.next_frame() >= self.frame_end && lives_for_ever(&self.scene) {
                return Err(format!(
                    "the run ends here: something lives for ever, and has places for {} frames",
                    self.frame_end
                ));
            }
            self.simulation.step().map_err(told)?;
            self.note_kernels();
            self.follow()?;
        }
        self.note_times(begun, count);
        self.keep_up()
    }

    /// Where a run that was begun again comes to what was done before, that holds for the next frame on.
    fn follow(&mut self) -> Result<(), Told> {
        let next = self.next_frame();
        let mut latest = self.recording.changes.iter().rev();
        let is_due = latest
            .find(|change| change.frame <= next)
            .is_some_and(|change| change.frame == next);
        if is_due {
            let sets = self.sets(next);
            (self.scene, self.knobs) = (self.source.load(&sets)?, self.source.knobs(&sets)?);
        }
        Ok(())
    }

    /// How many changes are to come, of a run that was begun again before they were made.
    pub fn upcoming(&self) -> usize {
        let next = self.next_frame();
        let changes = self.recording.changes.iter();
        changes.filter(|change| change.frame > next).count()
    }

    /// How much is drawn.
    pub fn detail(&self) -> Detail {
        self.source.detail.0
    }

    /// Whether less can be drawn without a change of what happens: not where births go by the area that
    /// systems are seen on.
    pub fn can_be_coarse(&self) -> bool {
        !hangs_on_pixels(&self.scene)
    }

    /// Goes on with that much detail.
    ///
    /// # Errors
    /// What happens in the scene hangs on its pixels, or the machine; all is then as it was.
    pub fn set_detail(&mut self, detail: Detail) -> Result<(), Told> {
        if detail == self.detail() {
            return Ok(());
        }
        if detail != Detail::FULL && !self.can_be_coarse() {
            return Err("births go by the area that systems are seen on: all is drawn".into());
        }
        let before = self.source.detail.clone();
        let begun = self.source.draw_as(detail).and_then(|()| {
            // Fewer pictures are of the same kind.
            match self.source.detail.1 == before.1 {
                true => Ok(()),
                false => self.resume(),
            }
        });
        if begun.is_err() {
            self.source.detail = before;
        }
        self.pace.settle();
        begun
    }

    /// Goes on from where it is with what the source says now.
    fn resume(&mut self) -> Result<(), Told> {
        let scene = self.source.load(&self.sets(self.next_frame()))?;
        let simulation = self.resumed(&self.recording.clone())?;
        (self.simulation, self.scene) = (simulation, scene);
        Ok(())
    }

    /// A run with these changes that stands where this one stands; up to there they are the same.
    fn resumed(&mut self, done: &Recording) -> Result<Simulation, Told> {
        let snapshot = self.simulation.snapshot().map_err(told)?;
        let begun = self.source.load(&[])?;
        let mut simulation = self.source.prepare(&begun, done, self.frame_end)?;
        match snapshot {
            Some(snapshot) => simulation.restore(&snapshot).map_err(told)?,
            None => simulation.seek(0).map_err(told)?,
        }
        Ok(simulation)
    }

    /// Gives up detail if frames take too long, and takes it back when there is time enough.
    fn keep_up(&mut self) -> Result<(), Told> {
        if !self.can_be_coarse() {
            return Ok(());
        }
        let chosen = self.pace.choose(&self.history, self.detail());
        chosen.map_or(Ok(()), |detail| self.set_detail(detail))
    }

    fn note_kernels(&mut self) {
        for (name, ms) in self.simulation.take_kernel_times().unwrap_or_default() {
            match self.times.iter_mut().find(|(of, _)| *of == name) {
                Some((_, sum)) => *sum += ms,
                None => self.times.push((name, ms)),
            }
        }
    }

    /// Makes times those of one frame, of so many that were stepped since.
    fn note_times(&mut self, begun: Instant, frames: u32) {
        for (_, ms) in &mut self.times {
            *ms /= f64::from(frames);
        }
        // A device draws while its caller goes on: what it took is told by its clock.
        let on_device: f64 = self.times.iter().map(|(_, ms)| ms).sum();
        let waited = begun.elapsed().as_secs_f32() * 1000.0 / frames as f32;
        self.history.push(waited.max(on_device as f32));
        let surplus = self.history.len().saturating_sub(240);
        self.history.drain(..surplus);
    }

    /// Somebody takes hold of something: all that is done until [`Session::let_go`] is undone in one go.
    pub fn take_hold(&mut self) {
        self.gesture = Gesture::Begun;
    }

    /// What was held is let go.
    pub fn let_go(&mut self) {
        self.gesture = Gesture::None;
    }

    /// Turns a knob from the next frame on; what was to come of a run that was begun again is dropped.
    ///
    /// # Errors
    /// The scene does not take the value, or it holds for a whole run.
    pub fn turn(&mut self, path: &str, value: &str) -> Result<(), Told> {
        let before = self.value_of(path);
        self.change(path, value)?;
        self.note(vec![(path.to_owned(), before)]);
        Ok(())
    }

    /// The value that brings back what is now.
    fn value_of(&self, path: &str) -> String {
        let knob = self.knobs.iter().find(|knob| knob.path == path);
        match knob.map(|knob| &knob.value) {
            Some(KnobValue::Written(value)) => value.clone(),
            _ => UNSET.to_owned(),
        }
    }

    /// What holds of a key that the scene leaves out and that is computed then, in TOML; `None` where
    /// nothing of that kind does.
    pub fn in_force(&self, path: &str) -> Option<String> {
        let (name, key) = path.strip_prefix("fire.")?.split_once(".spread.")?;
        let fire = self.scene.fires.iter().find(|fire| fire.name == name)?;
        let spread = fire.spread.as_ref()?;
        let value = match key {
            "drop_distance" => spread.drop_distance,
            "separation" => spread.separation,
            "curvature_distance" => spread.curvature_distance,
            _ => return None,
        };
        Some(format!("{value:?}"))
    }

    /// Whether a key holds for a whole run as it is, and is no knob of one under way.
    pub fn is_fixed(&self, path: &str) -> bool {
        self.knobs
            .iter()
            .any(|knob| knob.path == path && is_fixed(knob))
    }

    /// Notes what was done, with the values before.
    fn note(&mut self, before: Vec<(String, String)>) {
        let frame = self.next_frame();
        if let (Gesture::Noted, Some(last)) = (self.gesture, self.undone.last_mut()) {
            for one in before {
                if last.before.iter().all(|(path, _)| *path != one.0) {
                    last.before.push(one);
                }
            }
            return;
        }
        self.undone.push(Undo {
            frame,
            before,
            undone_from: None,
        });
        if self.gesture == Gesture::Begun {
            self.gesture = Gesture::Noted;
        }
    }

    /// Makes several changes or, where one is refused, none.
    fn change_all(&mut self, all: &[(String, String)]) -> Result<(), Told> {
        let (scene, knobs) = (self.scene.clone(), self.knobs.clone());
        let recording = self.recording.clone();
        for (at, (path, value)) in all.iter().enumerate() {
            if let Err(refused) = self.change(path, value) {
                if at > 0 {
                    self.simulation.turn(scene.clone()).map_err(told)?;
                    (self.scene, self.knobs) = (scene, knobs);
                    // What was to come is gone with the first of them.
                    let next = self.next_frame();
                    self.recording = recording;
                    let changes = &mut self.recording.changes;
                    changes.retain(|change| change.frame <= next);
                }
                return Err(refused);
            }
        }
        Ok(())
    }

    fn change(&mut self, path: &str, value: &str) -> Result<(), Told> {
        let set = format!("{path}={value}");
        let frame = self.next_frame();
        let mut changes = self.recording.changes.clone();
        // Whoever goes back and does something else does not want what came after.
        changes.retain(|change| change.frame <= frame);
        let drops = changes.len() < self.recording.changes.len();
        let kept = drops.then(|| Recording {
            changes: changes.clone(),
        });
        // Of a knob that is held, the last value in a frame counts. No other change of the frame is left
        // out or moved: each is refused or not by those before it, here and where it is replayed.
        changes.pop_if(|last| last.frame == frame && last.key() == path);
        let sets = changes.iter().map(|change| change.set.clone());
        let sets: Vec<String> = sets.chain([set.clone()]).collect();
        let scene = self.source.load(&sets)?;
        if let Some(key) = without_effect(&self.source.load(&[])?, &scene) {
            return Err(format!(
                "`{key}` changes nothing in a run that is under way"
            ));
        }
        let knobs = self.source.knobs(&sets)?;
        if self.detail() != Detail::FULL && hangs_on_pixels(&scene) {
            return Err(
                "births would go by the area that systems are seen on: draw all detail first"
                    .into(),
            );
        }
        let anew = kept.map(|kept| self.resumed(&kept)).transpose()?;
        match anew {
            Some(mut anew) => {
                anew.turn(scene.clone()).map_err(told)?;
                self.simulation = anew;
                self.undone.retain(|undo| undo.frame <= frame);
                for undo in &mut self.undone {
                    undo.undone_from = undo.undone_from.filter(|from| *from <= frame);
                }
            }
            None => self.simulation.turn(scene.clone()).map_err(told)?,
        }
        changes.push(Change {
            frame,
            set,
            line: 0,
        });
        self.recording.changes = changes;
        (self.scene, self.knobs) = (scene, knobs);
        Ok(())
    }

    /// What a click at a place of the picture would do, in words; `None` where it does nothing.
    pub fn touch_hint(&self) -> Option<&'static str> {
        let burns = self.scene.fires.iter().any(|fire| fire.spread.is_some());
        match (burns, self.scene.flocks.is_empty()) {
            (true, _) => Some("click: it burns there; drag: look around"),
            (false, false) => {
                Some("click: boids steer there, right button: away from there; drag: look around")
            }
            (false, true) => None,
        }
    }

    /// A click at a place of the picture drawn last, pixels from its upper left corner: from the next frame
    /// on, what can burn burns there, or flocks steer there; or `away` from there. What was done, in
    /// words; `None` where there is nothing to do.
    ///
    /// # Errors
    /// The scene has no room for it.
    pub fn touch(&mut self, at_px: [f32; 2], away: bool) -> Result<Option<String>, Told> {
        if self.scene.fires.iter().any(|fire| fire.spread.is_some()) {
            return match self.simulation.pick(at_px) {
                Some(pick) if !away => self.ignite(&pick).map(Some),
                _ => Ok(None),
            };
        }
        let Some(ray) = self.simulation.ray_through(at_px) else {
            return Ok(None);
        };
        let (mut done, mut all, mut before) = (None, Vec::new(), Vec::new());
        for flock in &self.scene.flocks {
            let Some(place) = place_for(flock, &ray) else {
                continue;
            };
            let weight = if away { -1.0 } else { 1.0 };
            let path = format!("flock.{}.goal", flock.name);
            let [known, new] = goals(flock, place, weight);
            all.push((path.clone(), new));
            before.push((path, known));
            let [x, y, z] = place;
            let way = if away { "away from" } else { "to" };
            done = Some(format!("boids steer {way} {x:.2}, {y:.2}, {z:.2}"));
        }
        self.change_all(&all)?;
        if !before.is_empty() {
            self.note(before);
        }
        Ok(done)
    }

    fn ignite(&mut self, pick: &Pick) -> Result<String, Told> {
        let fire = &self.scene.fires[pick.fire];
        let known = fire.spread.as_ref().map_or(&[][..], |it| &it.ignitions);
        let new = Ignition {
            position: pick.position,
            first_frame: self.next_frame(),
            points: known.first().map_or(16, |first| first.points),
        };
        let text = |one: &Ignition| {
            format!(
                "{{ position = {:?}, first_frame = {}, points = {} }}",
                one.position, one.first_frame, one.points
            )
        };
        let all: Vec<String> = known.iter().chain([&new]).map(text).collect();
        let path = format!("fire.{}.spread.ignition", fire.name);
        let [x, y, z] = pick.position;
        let done = format!("`fire.{}` burns at {x:.3}, {y:.3}, {z:.3}", fire.name);
        let listed = |all: &[String]| format!("[{}]", all.join(", "));
        let before = listed(&all[..all.len() - 1]);
        self.change(&path, &listed(&all))?;
        self.note(vec![(path, before)]);
        Ok(done)
    }

    /// The next frame to be stepped, from 0.
    fn next_frame(&self) -> u32 {
        self.simulation.frame().map_or(0, |frame| frame + 1)
    }

    /// Puts what was done last back to what it was, from the next frame on; whether there was anything.
    ///
    /// # Errors
    /// It cannot be put back, for that value is refused now; it is passed over, and what
    /// was done before it is the last.
    pub fn undo(&mut self) -> Result<bool, Told> {
        if self.gesture == Gesture::Noted {
            self.gesture = Gesture::Begun;
        }
        let next = self.next_frame();
        let is_in_force = |undo: &Undo| {
            let is_undone = undo.undone_from.is_some_and(|from| from <= next);
            undo.frame <= next && !is_undone
        };
        let Some(at) = self.undone.iter().rposition(is_in_force) else {
            return Ok(false);
        };
        let values = self.undone[at].before.iter().rev();
        let values: Vec<(String, String)> = values.cloned().collect();
        match self.change_all(&values) {
            Ok(()) => {
                // Of those up to this frame none is dropped by a change.
                self.undone[at].undone_from = Some(next);
                Ok(true)
            }
            Err(refused) => {
                self.undone.remove(at);
                let refused = refused.trim_start_matches("error: ");
                Err(format!(
                    "error: this cannot be undone, and undo goes on before it: {refused}"
                ))
            }
        }
    }

    /// Puts a knob to what holds where a scene says nothing.
    ///
    /// # Errors
    /// The scene has to say something.
    pub fn reset(&mut self, path: &str) -> Result<(), Told> {
        self.turn(path, UNSET)
    }

    /// Begins again and goes to a frame at once, with what has been done up to it. What was done later is
    /// done again as the run comes to its frames, unless something else is done before.
    ///
    /// # Errors
    /// The machine.
    pub fn restart(&mut self, frame: u32) -> Result<(), Told> {
        self.begin_again(self.recording.clone(), frame)?;
        self.gesture = Gesture::None;
        Ok(())
    }

    /// Begins again with other random decisions; what has been done is done again, each at its frame.
    ///
    /// # Errors
    /// The machine.
    pub fn reseed(&mut self, seed: u64) -> Result<(), Told> {
        self.source.sets.push(format!("seed={seed}"));
        let begun = self.restart(0);
        if begun.is_err() {
            self.source.sets.pop();
        }
        begun
    }

    /// Reads the scene's file and its meshes again, and begins anew at the same frame, with what was done.
    /// Knobs that the scene no longer turns so are left as it has them: the keys of these. What is wrong
    /// with it leaves all as it was.
    ///
    /// # Errors
    /// The scene.
    pub fn reload(&mut self) -> Result<Vec<String>, Told> {
        let before = self.source.as_read();
        let begun = self
            .source
            .read_files()
            .and_then(|()| self.source.draw_as(self.detail()))
            .and_then(|()| {
                let (recording, left_out) = self.source.fitting(&self.recording);
                self.begin_again(recording, self.frame())?;
                Ok(left_out)
            });
        match begun {
            Ok(_) => self.undone.clear(),
            Err(_) => self.source.put_back(before),
        }
        begun
    }

    /// Begins the scene as its file is now, with what the recording says, and goes to a frame; an
    /// error leaves all as it was.
    fn begin_again(&mut self, recording: Recording, frame: u32) -> Result<(), Told> {
        // Frame 0 has been stepped when it begins.
        let sets = sets_of(&recording, frame.saturating_add(1));
        let (begun, scene) = (self.source.load(&[])?, self.source.load(&sets)?);
        let knobs = self.source.knobs(&sets)?;
        self.simulation = self.source.begin(&begun, &recording, frame)?;
        self.frame_end = frame_end(&begun, frame);
        (self.scene, self.knobs, self.recording) = (scene, knobs, recording);
        Ok(())
    }

    /// What was done that holds at a frame, as `--set` has it.
    fn sets(&self, frame: u32) -> Vec<String> {
        sets_of(&self.recording, frame)
    }

    /// Writes the scene to `path`, its meshes to where it looks for them from there, and what has been done
    /// beside it, with ending `.inputs`: `motes render` with `--inputs` makes the same run of them. The
    /// recording's path.
    ///
    /// # Errors
    /// It cannot be written, or there is another file where a mesh would go.
    pub fn save_as(&self, path: &Path) -> Result<PathBuf, WindowError> {
        if path.extension().is_none_or(|ending| ending != "toml") {
            let told = format!("{}: a scene's file ends in .toml", path.display());
            return Err(wrong(&told));
        }
        let files = self.source.files().map_err(WindowError::Scene)?;
        let meshes = self.meshes_beside(path)?;
        let inputs = path.with_extension("inputs");
        let sets = self.source.first_sets();
        let sets = sets.iter().map(|set| format!(" --set {}", shell_word(set)));
        let sets: String = sets.collect();
        let outside = match self.source.loader.allow_outside {
            true => " --allow-outside",
            false => "",
        };
        let head = format!(
            "# motes render {}{sets}{outside} --inputs {} --frames 0..{}\n",
            shell_word(&path.display().to_string()),
            shell_word(&inputs.display().to_string()),
            self.frame() + 1
        );
        for (place, bytes) in meshes {
            if let Some(folder) = place.parent() {
                let made = std::fs::create_dir_all(folder);
                made.map_err(|error| wrong(&format!("{}: {error}", folder.display())))?;
            }
            write_whole(&place, &bytes).map_err(WindowError::Output)?;
        }
        write_whole(&inputs, (head + &self.recording.to_text()).as_bytes())
            .map_err(WindowError::Output)?;
        write_whole(path, files.draft.text().as_bytes()).map_err(WindowError::Output)?;
        Ok(inputs)
    }

    /// Meshes that a scene at `path` would look for where there is none yet, with their bytes.
    fn meshes_beside(&self, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, WindowError> {
        let files = self.source.files().map_err(WindowError::Scene)?;
        let read = files.draft.companions();
        let read = read.map_err(|told| wrong(&format!("a mesh of the scene: {told}")))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut missing = Vec::new();
        for (name, bytes) in read {
            let place = folder.join(name);
            match std::fs::read(&place) {
                Ok(there) if there == bytes => {}
                Ok(_) => {
                    let told = "there is another file where the scene's mesh would go: save it to \
                                another folder";
                    return Err(wrong(&format!("{}: {told}", place.display())));
                }
                Err(_) => missing.push((place, bytes)),
            }
        }
        Ok(missing)
    }

    /// Draws the last frame into the texture, as it is looked at.
    ///
    /// # Errors
    /// The machine.
    pub fn draw_into(&mut self, texture: &wgpu::Texture) -> Result<(), Told> {
        let now = self.scene.at(f64::from(self.frame().cast_signed()));
        let camera = self.orbit.camera(&now.camera);
        match camera {
            Some(camera) => self.simulation.draw_seen_by(&camera),
            None => self.simulation.draw(),
        }
        .map_err(told)?;
        self.simulation.image_into(texture).map_err(told)
    }
}

/// What was done that holds at a frame, as `--set` has it.
fn sets_of(recording: &Recording, frame: u32) -> Vec<String> {
    let changes = recording.changes.iter();
    let until = changes.take_while(|change| change.frame <= frame);
    until.map(|change| change.set.clone()).collect()
}

/// The goal that a flock has, and one at a place, in TOML.
fn goals(flock: &Flock, position: [f32; 3], weight: f32) -> [String; 2] {
    let called = Goal {
        position,
        weight,
        speed: 2.0 * flock.max_speed,
        limit: CALLED_LIMIT * flock.max_speed,
        slowing_radius: 0.0,
    };
    let now = flock.goal.map_or(called, |known| Goal {
        position,
        weight,
        ..known
    });
    let text = |goal: Goal| {
        format!(
            "{{ position = {:?}, weight = {:?}, speed = {:?}, limit = {:?}, slowing_radius = {:?} }}",
            goal.position, goal.weight, goal.speed, goal.limit, goal.slowing_radius
        )
    };
    [flock.goal.map_or(UNSET.to_owned(), text), text(now)]
}

/// Where a ray meets the plane that a flock lives in; for one in space, that of the middle of where it
/// begins, as the ray's viewer has it before them.
fn place_for(flock: &Flock, ray: &Ray) -> Option<[f32; 3]> {
    match flock.dimensions {
        Dimensions::Two => {
            let [x, y, _] = ray.meets_plane([0.0; 3], [0.0, 0.0, 1.0])?;
            Some([x, y, 0.0])
        }
        Dimensions::Three => {
            let Corners { min, max } = flock.region;
            let middle = [0, 1, 2].map(|axis| 0.5 * (min[axis] + max[axis]));
            ray.meets_plane(middle, ray.direction)
        }
    }
}

/// A word as shells take it.
fn shell_word(text: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./=:,+@%".contains(letter);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

fn wrong(told: &str) -> WindowError {
    WindowError::Scene(format!("error: {told}"))
}
