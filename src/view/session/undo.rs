//! Undoing what was done, gesture by gesture.

use super::{Session, Told};
use crate::scene::{KnobValue, UNSET};

/// What one gesture did, and how what it turned stood before.
pub(super) struct Undo {
    /// The first frame that it holds for.
    pub(super) frame: u32,
    /// Paths of keys, and what turns them back, in the order that they were turned in.
    before: Vec<(String, String)>,
    /// The frame from which on it is undone.
    pub(super) undone_from: Option<u32>,
}

/// Whether somebody holds something now: all that they do until they let go is undone in one go.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Gesture {
    None,
    /// Nothing has been done since it began.
    Begun,
    /// What is done belongs to the last [`Undo`].
    Noted,
}

impl Session {
    /// Somebody takes hold of something: all that is done until [`Session::let_go`] is undone in one go.
    pub fn take_hold(&mut self) {
        self.gesture = Gesture::Begun;
    }

    /// What was held is let go.
    pub fn let_go(&mut self) {
        self.gesture = Gesture::None;
    }

    /// The value that brings back what is now.
    pub(super) fn value_of(&self, path: &str) -> String {
        let knob = self.knobs.iter().find(|knob| knob.path == path);
        match knob.map(|knob| &knob.value) {
            Some(KnobValue::Written(value)) => value.clone(),
            _ => UNSET.to_owned(),
        }
    }

    /// Notes what was done, with the values before.
    pub(super) fn note(&mut self, before: Vec<(String, String)>) {
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
}
