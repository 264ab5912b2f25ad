//! A scene that somebody plays with: it runs, its knobs turn, and all that is done is recorded, so
//! that it can be done again bit for bit (Perry 1994, 1.2: interactive control).

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::{Duration, Instant};

use super::detail::{Detail, hangs_on_pixels};
use super::error::WindowError;
use super::orbit::Orbit;
use crate::gpu::{GpuDevice, GpuOptions};
use crate::output::write_whole;
use crate::plan::{Plan, Turn};
use crate::recording::{Change, Recording};
use crate::scene::{
    Corners, Dimensions, Draft, Flock, Goal, Ignition, Knob, KnobValue, Loader, Scene, SceneError,
};
use crate::simulation::{AdapterChoice, Options, Pick, Ray, Simulation, SimulationError, Snapshot};

/// Room for so many times the particles that the scene can have as it is.
const ROOM: u32 = 4;
/// Room at least.
const LEAST_ROOM: u32 = 100_000;
/// Room at most, unless the scene has more particles as it is.
const MOST_ROOM: u32 = 8_000_000;

/// How much boids accelerate, as a share of their greatest speed, to where somebody calls them.
const CALLED_LIMIT: f32 = 0.05;

/// Frames that a detail is tried for before another is chosen.
const SETTLING_FRAMES: u32 = 20;

/// Frames that take less than this share of the time that there is leave room for more detail, as far as
/// one knows who has not tried.
const SPARE_SHARE: f32 = 0.3;

/// What frames may take of the time that there is where more detail was tried before.
const ENOUGH_SHARE: f32 = 0.8;

/// What to play with, and on what.
pub struct Source {
    /// Name of a built-in scene, or path.
    pub scene: String,
    /// Changes made to it before it begins, as `--set` has them.
    pub sets: Vec<String>,
    /// How it is loaded.
    pub loader: Loader,
    /// Where it runs.
    pub device: GpuDevice,
    /// Whether the device was opened with a clock.
    pub is_timed: bool,
    /// How much of it is drawn, and what that changes of it, as `--set` has it.
    detail: (Detail, Vec<String>),
    /// What was read of its files last.
    read: Option<Rc<Files>>,
}

/// What was read of a scene's files.
struct Files {
    draft: Draft,
    /// Its text.
    text: String,
    /// What can be turned, as it is written.
    knobs: Vec<Knob>,
}

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
    /// Frames a second that detail is given up for, if it is slower; `None` for all detail that was asked
    /// for.
    pub least_rate: Option<f32>,
    /// Frames since the detail was chosen.
    settled: u32,
    /// Of each level, when it was last given up for less: what frames took, and then took with less,
    /// milliseconds.
    given_up: [Option<[f32; 2]>; Detail::LEVELS.len()],
}

/// How a knob stood before it was turned.
struct Undo {
    path: String,
    before: KnobValue,
}

impl Session {
    /// Begins the scene at its first frame that is seen.
    ///
    /// # Errors
    /// The scene, or the machine.
    pub fn new(mut source: Source) -> Result<Self, Told> {
        source.read_files()?;
        source.make_room()?;
        let scene = source.load(&[])?;
        let knobs = source.files()?.knobs.clone();
        let recording = Recording::default();
        let simulation = source.begin(&scene, &recording, 0)?;
        let mut session = Self {
            orbit: Orbit::STILL,
            playing: true,
            speed: 1.0,
            owed: Duration::ZERO,
            times: Vec::new(),
            history: Vec::new(),
            least_rate: None,
            settled: 0,
            given_up: [None; Detail::LEVELS.len()],
            undone: Vec::new(),
            source,
            simulation,
            scene,
            knobs,
            recording,
        };
        session.note_sets(&[]);
        Ok(session)
    }

    /// Shows what `--set` has changed, and then these changes.
    fn note_sets(&mut self, changes: &[String]) {
        let sets = [self.source.sets.as_slice(), changes].concat();
        for (path, value) in sets.iter().filter_map(|set| set.split_once('=')) {
            self.note_value(path, KnobValue::Written(value.to_owned()));
        }
    }

    fn note_value(&mut self, path: &str, value: KnobValue) {
        if let Some(knob) = self.knobs.iter_mut().find(|knob| knob.path == path) {
            knob.value = value;
        }
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

    /// Steps as many frames as are due after this time, at most one: what is too slow for its frame
    /// rate shows every frame, later. Whether any was.
    ///
    /// # Errors
    /// The machine.
    pub fn advance(&mut self, passed: Duration) -> Result<bool, Told> {
        if !self.playing {
            return Ok(false);
        }
        let frame =
            Duration::from_secs_f32(1.0 / (self.scene.frame_rate as f32 * self.speed.max(0.01)));
        self.owed = (self.owed + passed).min(frame * 2);
        if self.owed < frame {
            return Ok(false);
        }
        self.owed -= frame;
        self.step()?;
        Ok(true)
    }

    /// Steps one frame.
    ///
    /// # Errors
    /// The machine.
    pub fn step(&mut self) -> Result<(), Told> {
        let begun = Instant::now();
        self.simulation.step().map_err(told)?;
        self.take_times(begun);
        self.keep_up()
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
        if detail != Detail::LEVELS[0] && !self.can_be_coarse() {
            return Err("births go by the area that systems are seen on: all is drawn".into());
        }
        let snapshot = self.simulation.snapshot().map_err(told)?;
        let before = self.source.detail.clone();
        let begun = self
            .source
            .draw_as(detail)
            .and_then(|()| self.resume(snapshot.as_ref()));
        if begun.is_err() {
            self.source.detail = before;
        }
        self.settled = 0;
        begun
    }

    /// Goes on from the snapshot with what the source says now.
    fn resume(&mut self, snapshot: Option<&Snapshot>) -> Result<(), Told> {
        let sets = self.recording.changes.iter();
        let sets: Vec<String> = sets.map(|change| change.set.clone()).collect();
        let (begun, scene) = (self.source.load(&[])?, self.source.load(&sets)?);
        let mut simulation = self.source.prepare(&begun, &self.recording)?;
        match snapshot {
            Some(snapshot) => simulation.restore(snapshot).map_err(told)?,
            None => simulation.seek(0).map_err(told)?,
        }
        (self.simulation, self.scene) = (simulation, scene);
        Ok(())
    }

    /// Gives up detail if frames take too long, and takes it back when there is time enough.
    fn keep_up(&mut self) -> Result<(), Told> {
        self.settled += 1;
        let Some(rate) = self.least_rate.filter(|_| self.can_be_coarse()) else {
            return Ok(());
        };
        if self.settled < SETTLING_FRAMES {
            return Ok(());
        }
        let recent = self.history.iter().rev().take(SETTLING_FRAMES as usize / 2);
        let mut recent: Vec<f32> = recent.copied().collect();
        recent.sort_by(f32::total_cmp);
        let typical = recent.get(recent.len() / 2).copied().unwrap_or(0.0);
        let share = typical * rate / 1000.0;
        let level = Detail::LEVELS
            .iter()
            .position(|it| *it == self.detail())
            .unwrap_or(0);
        if let Some(more) = level.checked_sub(1) {
            // What more would take now, as it did when it was given up.
            let expected = match &mut self.given_up[more] {
                None if share < SPARE_SHARE => 0.0,
                None => 1.0,
                Some([was, became]) => {
                    if *became == 0.0 {
                        *became = typical;
                    }
                    share * *was / *became
                }
            };
            if expected < ENOUGH_SHARE {
                self.given_up[more] = None;
                return self.set_detail(Detail::LEVELS[more]);
            }
        }
        if share >= 1.0 && level + 1 < Detail::LEVELS.len() {
            self.given_up[level] = Some([typical, 0.0]);
            return self.set_detail(Detail::LEVELS[level + 1]);
        }
        Ok(())
    }

    fn take_times(&mut self, begun: Instant) {
        let kernels = self.simulation.take_kernel_times().unwrap_or_default();
        if !kernels.is_empty() {
            self.times.clear();
        }
        for (name, ms) in kernels {
            match self.times.iter_mut().find(|(of, _)| *of == name) {
                Some((_, sum)) => *sum += ms,
                None => self.times.push((name, ms)),
            }
        }
        // A device draws while its caller goes on: what it took is told by its clock.
        let on_device: f64 = self.times.iter().map(|(_, ms)| ms).sum();
        let waited = begun.elapsed().as_secs_f32() * 1000.0;
        self.history.push(waited.max(on_device as f32));
        let surplus = self.history.len().saturating_sub(240);
        self.history.drain(..surplus);
    }

    /// Turns a knob from the next frame on.
    ///
    /// # Errors
    /// The scene does not take the value, or it holds for a whole run.
    pub fn turn(&mut self, path: &str, value: &str) -> Result<(), Told> {
        let before = self.knobs.iter().find(|knob| knob.path == path);
        let before = before.map_or(KnobValue::None, |knob| knob.value.clone());
        self.change(path, value)?;
        match self.undone.last() {
            // A knob that is held is undone in one go.
            Some(last) if last.path == path && self.frame() > 0 && self.is_held(path) => {}
            _ => self.undone.push(Undo {
                path: path.to_owned(),
                before,
            }),
        }
        Ok(())
    }

    /// Whether the change before the last was of the same knob, a frame ago at most.
    fn is_held(&self, path: &str) -> bool {
        let of = |change: &&Change| change.set.split('=').next() == Some(path);
        let mut own = self.recording.changes.iter().rev().filter(of);
        match (own.next(), own.next()) {
            (Some(last), Some(before)) => last.frame - before.frame <= 1,
            _ => false,
        }
    }

    fn change(&mut self, path: &str, value: &str) -> Result<(), Told> {
        let set = format!("{path}={value}");
        let frame = self.next_frame();
        let mut changes = self.recording.changes.clone();
        // Of several changes of a knob in a frame, the last holds.
        changes
            .retain(|change| change.frame != frame || change.set.split('=').next() != Some(path));
        let sets: Vec<String> = changes.iter().map(|change| change.set.clone()).collect();
        let scene = self.source.load(&[sets, vec![set.clone()]].concat())?;
        if self.detail() != Detail::LEVELS[0] && hangs_on_pixels(&scene) {
            return Err(
                "births would go by the area that systems are seen on: draw all detail first"
                    .into(),
            );
        }
        self.simulation.turn(scene.clone()).map_err(told)?;
        changes.push(Change {
            frame,
            set,
            line: 0,
        });
        self.recording.changes = changes;
        self.scene = scene;
        self.note_value(path, KnobValue::Written(value.to_owned()));
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
        let mut done = None;
        for at in 0..self.scene.flocks.len() {
            let Some(place) = place_for(&self.scene.flocks[at], &ray) else {
                continue;
            };
            let weight = if away { -1.0 } else { 1.0 };
            self.steer(at, place, weight)?;
            let [x, y, z] = place;
            let way = if away { "away from" } else { "to" };
            done = Some(format!("boids steer {way} {x:.2}, {y:.2}, {z:.2}"));
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
        let before = KnobValue::Written(listed(&all[..all.len() - 1]));
        self.change(&path, &listed(&all))?;
        self.undone.push(Undo { path, before });
        Ok(done)
    }

    /// Gives a flock a goal, or moves the one that it has.
    fn steer(&mut self, flock: usize, position: [f32; 3], weight: f32) -> Result<(), Told> {
        let flock = &self.scene.flocks[flock];
        let text = |goal: &Goal| {
            format!(
                "{{ position = {:?}, weight = {:?}, speed = {:?}, limit = {:?}, slowing_radius = {:?} }}",
                goal.position, goal.weight, goal.speed, goal.limit, goal.slowing_radius
            )
        };
        // A goal of no weight is as none.
        let before = flock.goal.unwrap_or(Goal {
            position,
            weight: 0.0,
            speed: 2.0 * flock.max_speed,
            limit: CALLED_LIMIT * flock.max_speed,
            slowing_radius: 0.0,
        });
        let now = Goal {
            position,
            weight,
            ..before
        };
        let path = format!("flock.{}.goal", flock.name);
        self.change(&path, &text(&now))?;
        self.undone.push(Undo {
            path,
            before: KnobValue::Written(text(&before)),
        });
        Ok(())
    }

    /// The next frame to be stepped, from 0.
    fn next_frame(&self) -> u32 {
        self.simulation.frame().map_or(0, |frame| frame + 1)
    }

    /// Puts the knob that was turned last back to what it was, from the next frame on; whether there
    /// was one.
    ///
    /// # Errors
    /// It had no value before: no value brings that back.
    pub fn undo(&mut self) -> Result<bool, Told> {
        let Some(Undo { path, before }) = self.undone.last() else {
            return Ok(false);
        };
        let (path, before) = (path.clone(), before.clone());
        match before {
            KnobValue::Written(value) | KnobValue::Default(value) => self.change(&path, &value)?,
            KnobValue::None => return Err(format!("`{path}` had no value to go back to")),
        }
        self.undone.pop();
        Ok(true)
    }

    /// Puts a knob to the value that holds where a scene says nothing.
    ///
    /// # Errors
    /// It has none.
    pub fn reset(&mut self, path: &str) -> Result<(), Told> {
        let knob = self.knobs.iter().find(|knob| knob.path == path);
        match knob.map(|knob| knob.field.presence) {
            Some(crate::scene::schema::Presence::Default(value)) => self.turn(path, value),
            _ => Err(format!("`{path}` has no default")),
        }
    }

    /// Begins again and goes to a frame at once, with what has been done up to it.
    ///
    /// # Errors
    /// The machine.
    pub fn restart(&mut self, frame: u32) -> Result<(), Told> {
        let mut recording = self.recording.clone();
        recording.changes.retain(|change| change.frame <= frame);
        self.begin_again(recording, frame)?;
        self.undone.clear();
        Ok(())
    }

    /// Begins again with other random decisions, and without what has been done after frame 0.
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

    /// Reads the scene's file and its meshes again, and begins anew at the same frame. What is wrong with it leaves
    /// all as it was.
    ///
    /// # Errors
    /// The scene.
    pub fn reload(&mut self) -> Result<(), Told> {
        let before = (self.source.read.clone(), self.source.detail.clone());
        let begun = self
            .source
            .read_files()
            .and_then(|()| self.source.draw_as(self.detail()))
            .and_then(|()| {
                let recording = match self.source.turns(&self.recording) {
                    Ok(_) => self.recording.clone(),
                    // The keys that were turned are not what they were.
                    Err(_) => Recording::default(),
                };
                self.begin_again(recording, self.frame())
            });
        match begun {
            Ok(()) => self.undone.clear(),
            Err(_) => (self.source.read, self.source.detail) = before,
        }
        begun
    }

    /// Begins the scene as its file is now, with what the recording says, and goes to a frame; an
    /// error leaves all as it was.
    fn begin_again(&mut self, recording: Recording, frame: u32) -> Result<(), Told> {
        let sets = recording.changes.iter().map(|change| change.set.clone());
        let sets: Vec<String> = sets.collect();
        let (begun, scene) = (self.source.load(&[])?, self.source.load(&sets)?);
        let knobs = self.source.files()?.knobs.clone();
        self.simulation = self.source.begin(&begun, &recording, frame)?;
        (self.scene, self.knobs, self.recording) = (scene, knobs, recording);
        self.note_sets(&sets);
        Ok(())
    }

    /// Writes the scene to `path`, and what has been done beside it, with ending `.inputs`:
    /// `motes render` with `--inputs` makes the same run of them. The recording's path.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save_as(&self, path: &Path) -> Result<PathBuf, WindowError> {
        if path.extension().is_none_or(|ending| ending != "toml") {
            let told = format!("error: {}: a scene's file ends in .toml", path.display());
            return Err(WindowError::Scene(told));
        }
        let files = self.source.files().map_err(WindowError::Scene)?;
        let inputs = path.with_extension("inputs");
        let sets: String = self
            .source
            .sets
            .iter()
            .map(|set| format!(" --set '{set}'"))
            .collect();
        let head = format!(
            "# motes render {}{sets} --inputs {} --frames 0..{}\n",
            path.display(),
            inputs.display(),
            self.frame() + 1
        );
        write_whole(&inputs, (head + &self.recording.to_text()).as_bytes())
            .map_err(WindowError::Output)?;
        write_whole(path, files.text.as_bytes()).map_err(WindowError::Output)?;
        Ok(inputs)
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

fn told(error: SimulationError) -> Told {
    error.to_string()
}

impl Source {
    /// A scene, by name or path, with changes made to it before it begins, loaded so, on that device, which
    /// has a clock or not.
    pub fn new(
        (scene, sets, loader): (&str, &[String], Loader),
        (device, is_timed): (GpuDevice, bool),
    ) -> Self {
        Self {
            scene: scene.to_owned(),
            sets: sets.to_vec(),
            loader,
            device,
            is_timed,
            detail: (Detail::LEVELS[0], Vec::new()),
            read: None,
        }
    }

    /// Gives a scene that names no capacity one that its births may be turned up to.
    fn make_room(&mut self) -> Result<(), Told> {
        let scene = self.load(&[])?;
        if scene.capacity.is_some() || scene.systems.is_empty() {
            return Ok(());
        }
        let plan = Plan::new(&scene, scene.frames).map_err(|error| error.to_string())?;
        let room = plan
            .capacity
            .saturating_mul(ROOM)
            .clamp(LEAST_ROOM, MOST_ROOM);
        let capacity = room.max(plan.capacity);
        self.sets.push(format!("capacity={capacity}"));
        Ok(())
    }

    fn load(&self, sets: &[String]) -> Result<Scene, Told> {
        let (_, coarser) = &self.detail;
        self.load_as(&[&self.sets, sets, coarser].concat())
    }

    fn load_as(&self, sets: &[String]) -> Result<Scene, Told> {
        self.draft_as(sets)?
            .scene()
            .map_err(|error| error.to_string())
    }

    fn draft_as(&self, sets: &[String]) -> Result<Draft, Told> {
        let draft = self.files()?.draft.with(sets);
        draft.map_err(|error| error.to_string())
    }

    fn files(&self) -> Result<&Files, Told> {
        let read = self.read.as_deref();
        read.ok_or_else(|| format!("error: {} has not been read", self.scene))
    }

    /// Reads its file and its meshes, once for many changes.
    fn read_files(&mut self) -> Result<(), Told> {
        let read = || -> Result<Files, SceneError> {
            let draft = self.loader.draft(&self.scene, &[])?;
            draft.with(&self.sets)?.scene()?;
            Ok(Files {
                draft,
                text: self.loader.text(&self.scene)?,
                knobs: self.loader.knobs(&self.scene)?,
            })
        };
        let read = read().map_err(|error| error.to_string())?;
        self.read = Some(Rc::new(read));
        Ok(())
    }

    /// Every file that it was read from.
    fn paths(&self) -> Vec<PathBuf> {
        let files = self.read.as_ref().map(|read| read.draft.files());
        files.into_iter().flatten().map(|(_, path)| path).collect()
    }

    /// Draws the scene, as its file is now, with that much detail; with all, if what happens hangs on it.
    fn draw_as(&mut self, detail: Detail) -> Result<(), Told> {
        let scene = self.load_as(&self.sets)?;
        let detail = match hangs_on_pixels(&scene) {
            true => Detail::LEVELS[0],
            false => detail,
        };
        self.detail = (detail, detail.sets(&scene));
        Ok(())
    }

    /// The run at `frame`.
    fn begin(&self, scene: &Scene, done: &Recording, frame: u32) -> Result<Simulation, Told> {
        let mut simulation = self.prepare(scene, done)?;
        simulation.seek(frame).map_err(told)?;
        Ok(simulation)
    }

    /// What was done, as turns of the scene as it is drawn.
    fn turns(&self, done: &Recording) -> Result<Vec<Turn>, Told> {
        let (_, coarser) = &self.detail;
        let mut draft = self.draft_as(&[self.sets.as_slice(), coarser].concat())?;
        let turns = done.turns_on(&mut draft, ("", "changes"));
        turns.map_err(|refused| refused.message)
    }

    /// The run, no frame of which has been stepped.
    fn prepare(&self, scene: &Scene, done: &Recording) -> Result<Simulation, Told> {
        let options = Options {
            adapter: AdapterChoice::Device(self.device.clone()),
            // There is no end to playing, but there is to what lives for ever.
            frame_end: scene.frames,
            turns: self.turns(done)?,
            editable: true,
            gpu: GpuOptions {
                timed: self.is_timed,
                ..GpuOptions::default()
            },
            threads: None,
        };
        Simulation::new(scene, &options).map_err(told)
    }
}
