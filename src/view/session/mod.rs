//! A scene that somebody plays with: it runs, its knobs turn, and all that is done is recorded, so
//! that it can be done again bit for bit (Perry 1994, 1.2: interactive control).

mod ahead;
mod save;
mod touch;
mod undo;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use ahead::Ahead;
use undo::{Gesture, Undo};

use super::detail::{Detail, hangs_on_pixels};
use super::knobs::is_fixed;
use super::orbit::Orbit;
use super::pace::Pace;
use super::source::{Source, frame_end, lives_for_ever, told};
use crate::recording::{Change, Recording, without_effect};
use crate::scene::{Knob, Scene, UNSET};
use crate::simulation::Simulation;

/// How long a run steps on its way to another frame before the window is seen to again.
const ON_THE_WAY: Duration = Duration::from_millis(40);

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
    /// The run that is on its way to another frame, to take the place of this one.
    ahead: Option<Ahead>,
    /// How many times a run has taken the place of another.
    began: u32,
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
        let frame_end = frame_end(&scene, 0);
        let mut simulation = source.set_out(&scene, &recording, (0, frame_end))?;
        simulation.seek(0).map_err(told)?;
        Ok(Self {
            frame_end,
            orbit: Orbit::STILL,
            playing: true,
            speed: 1.0,
            owed: Duration::ZERO,
            times: Vec::new(),
            history: Vec::new(),
            pace: Pace::default(),
            undone: Vec::new(),
            gesture: Gesture::None,
            ahead: None,
            began: 0,
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

    /// How many times this run was begun anew, be it at another frame, with another seed or from files that
    /// were written since.
    pub fn began(&self) -> u32 {
        self.began
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
    /// for its frame rate runs slower. One that is on its way to another frame goes on to it first.
    /// Whether there is another frame to be seen.
    ///
    /// # Errors
    /// The machine.
    pub fn advance(&mut self, passed: Duration) -> Result<bool, Told> {
        if self.ahead.is_some() {
            return self.go_on(ON_THE_WAY);
        }
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
        self.stay();
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
        self.stay();
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
        self.stay();
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

    /// The next frame to be stepped, from 0.
    fn next_frame(&self) -> u32 {
        self.simulation.frame().map_or(0, |frame| frame + 1)
    }

    /// Puts a knob to what holds where a scene says nothing.
    ///
    /// # Errors
    /// The scene has to say something.
    pub fn reset(&mut self, path: &str) -> Result<(), Told> {
        self.turn(path, UNSET)
    }

    /// What was done that holds at a frame, as `--set` has it.
    fn sets(&self, frame: u32) -> Vec<String> {
        sets_of(&self.recording, frame)
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
