//! Going to a frame: a run is begun anew beside the one that is seen and stepped a little at a time, so
//! that the window never stands still. Until it is there, all is as it was.

use std::time::{Duration, Instant};

use super::{Gesture, Session, Told, sets_of};
use crate::recording::Recording;
use crate::scene::{Knob, Scene};
use crate::simulation::Simulation;
use crate::view::source::{AsRead, frame_end, told};

/// A run on its way to the frame that is wanted.
pub(super) struct Ahead {
    simulation: Simulation,
    /// What holds when it is there.
    scene: Scene,
    knobs: Vec<Knob>,
    recording: Recording,
    frame_end: u32,
    /// The frame that is wanted.
    frame: u32,
    /// What the source was before it, should it not get there.
    before: AsRead,
    /// Whether what was done can still be undone when it is there.
    keeps_undo: bool,
}

impl Ahead {
    fn is_there(&self) -> bool {
        // Frames before the first one that is seen are negative.
        let at = self.simulation.frame().map(u32::cast_signed);
        at.is_some_and(|at| i64::from(at) >= i64::from(self.frame))
    }

    /// Steps until it is there or the time is over, one frame at least; whether it is there.
    fn go_on(&mut self, time: Duration) -> Result<bool, Told> {
        let begun = Instant::now();
        while !self.is_there() {
            self.simulation.step().map_err(told)?;
            self.simulation.wait().map_err(told)?;
            if begun.elapsed() >= time {
                break;
            }
        }
        Ok(self.is_there())
    }
}

impl Session {
    /// The frame that the run is on its way to, and the one that it has come to so far; `None` if it is
    /// nowhere on its way to.
    pub fn on_the_way(&self) -> Option<(u32, u32)> {
        let ahead = self.ahead.as_ref()?;
        let at = ahead.simulation.frame().map_or(0, u32::cast_signed);
        Some((ahead.frame, u32::try_from(at).unwrap_or(0)))
    }

    /// Stays where it is, and what it was on its way to is given up; nothing if it was not.
    pub fn stay(&mut self) {
        if let Some(ahead) = self.ahead.take() {
            self.source.put_back(ahead.before);
        }
    }

    /// Goes on to where it is on its way to, for that long; whether it came there.
    ///
    /// # Errors
    /// The machine; it stays where it was.
    pub(super) fn go_on(&mut self, time: Duration) -> Result<bool, Told> {
        let gone = self.ahead.as_mut().map(|ahead| ahead.go_on(time));
        match gone {
            None | Some(Ok(false)) => return Ok(false),
            Some(Err(told)) => {
                self.stay();
                return Err(told);
            }
            Some(Ok(true)) => {}
        }
        let Some(ahead) = self.ahead.take() else {
            return Ok(false);
        };
        (self.simulation, self.frame_end) = (ahead.simulation, ahead.frame_end);
        (self.scene, self.knobs, self.recording) = (ahead.scene, ahead.knobs, ahead.recording);
        self.gesture = Gesture::None;
        self.began = self.began.wrapping_add(1);
        if !ahead.keeps_undo {
            self.undone.clear();
        }
        Ok(true)
    }

    /// Begins again and goes to a frame, with what has been done up to it, while [`Session::advance`] is
    /// called. What was done later is done again as the run comes to its frames, unless something else is
    /// done before.
    ///
    /// # Errors
    /// The machine.
    pub fn go_to(&mut self, frame: u32) -> Result<(), Told> {
        self.stay();
        let before = self.source.as_read();
        self.set_out(self.recording.clone(), frame, (before, true))
    }

    /// As [`Session::go_to`], and is there at once.
    ///
    /// # Errors
    /// The machine.
    pub fn restart(&mut self, frame: u32) -> Result<(), Told> {
        self.go_to(frame)?;
        self.go_on(Duration::MAX).map(drop)
    }

    /// Begins again with other random decisions; what has been done is done again, each at its frame.
    ///
    /// # Errors
    /// The machine.
    pub fn reseed(&mut self, seed: u64) -> Result<(), Told> {
        self.stay();
        let before = self.source.as_read();
        self.source.sets.push(format!("seed={seed}"));
        self.set_out(self.recording.clone(), 0, (before, true))?;
        self.go_on(Duration::MAX).map(drop)
    }

    /// Reads the scene's file and its meshes again, and begins anew on the way to the same frame, with what
    /// was done. Knobs that the scene no longer turns so are left as it has them: the keys of these. What
    /// is wrong with it leaves all as it was.
    ///
    /// # Errors
    /// The scene.
    pub fn read_again(&mut self) -> Result<Vec<String>, Told> {
        // A run that was on its way goes there still.
        let frame = self.on_the_way().map_or(self.frame(), |(to, _)| to);
        self.stay();
        let before = self.source.as_read();
        let read = self.source.read_files();
        let read = read.and_then(|()| self.source.draw_as(self.detail()));
        if let Err(told) = read {
            self.source.put_back(before);
            return Err(told);
        }
        let (recording, left_out) = self.source.fitting(&self.recording);
        self.set_out(recording, frame, (before, false))?;
        Ok(left_out)
    }

    /// As [`Session::read_again`], and is there at once.
    ///
    /// # Errors
    /// The scene.
    pub fn reload(&mut self) -> Result<Vec<String>, Told> {
        let left_out = self.read_again()?;
        self.go_on(Duration::MAX)?;
        Ok(left_out)
    }

    /// Begins the scene as the source has it now, with what the recording says, on the way to a frame; an
    /// error leaves all as it was `before`.
    fn set_out(
        &mut self,
        recording: Recording,
        frame: u32,
        (before, keeps_undo): (AsRead, bool),
    ) -> Result<(), Told> {
        // Frame 0 has been stepped when it begins.
        let sets = sets_of(&recording, frame.saturating_add(1));
        let begin = || -> Result<_, Told> {
            let (begun, scene) = (self.source.load(&[])?, self.source.load(&sets)?);
            let knobs = self.source.knobs(&sets)?;
            let frame_end = frame_end(&begun, frame);
            let simulation = self
                .source
                .set_out(&begun, &recording, (frame, frame_end))?;
            Ok((simulation, scene, knobs, frame_end))
        };
        match begin() {
            Ok((simulation, scene, knobs, frame_end)) => {
                self.ahead = Some(Ahead {
                    simulation,
                    scene,
                    knobs,
                    recording,
                    frame_end,
                    frame,
                    before,
                    keeps_undo,
                });
                Ok(())
            }
            Err(told) => {
                self.source.put_back(before);
                Err(told)
            }
        }
    }
}
