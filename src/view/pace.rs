//! How much of a scene can be drawn at so many frames a second.

use super::detail::Detail;

/// Frames that a detail is tried for before another is chosen.
const SETTLING_FRAMES: u32 = 20;

/// Frames that take less than this share of the time that there is leave room for more detail, as far as
/// one knows who has not tried.
const SPARE_SHARE: f32 = 0.3;

/// What frames may take of the time that there is where more detail was tried before.
const ENOUGH_SHARE: f32 = 0.8;

/// Chooses the detail by the time that frames take.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    /// Frames a second that detail is given up for, if it is slower; `None` for all detail that was asked
    /// for.
    pub least_rate: Option<f32>,
    /// Frames since the detail was chosen.
    settled: u32,
    /// Of each level, when it was last given up for less: what frames took, and then took with less,
    /// milliseconds.
    given_up: [Option<[f32; 2]>; Detail::LEVELS.len()],
}

impl Pace {
    /// Notes that another detail was chosen.
    pub(super) fn settle(&mut self) {
        self.settled = 0;
    }

    /// After a frame, the detail to go on with, if it is another one; `history` is what frames took,
    /// milliseconds, the last one last.
    pub(super) fn choose(&mut self, history: &[f32], detail: Detail) -> Option<Detail> {
        self.settled += 1;
        let rate = self.least_rate?;
        if self.settled < SETTLING_FRAMES {
            return None;
        }
        let recent = history.iter().rev().take(SETTLING_FRAMES as usize / 2);
        let mut recent: Vec<f32> = recent.copied().collect();
        recent.sort_by(f32::total_cmp);
        let typical = recent.get(recent.len() / 2).copied().unwrap_or(0.0);
        let share = typical * rate / 1000.0;
        let level = detail.level();
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
                return Some(detail.at_level(more));
            }
        }
        if share >= 1.0 && level + 1 < Detail::LEVELS.len() {
            self.given_up[level] = Some([typical, 0.0]);
            return Some(detail.at_level(level + 1));
        }
        None
    }
}
