//! When each frame of a GIF begins. GIF counts whole hundredths of a second, so each beginning is rounded, not each
//! duration: the whole then has the right length to half a hundredth (above 50 frames a second, to one and a half, for the
//! last frame needs its shortest time as well).

/// The shortest time a frame is shown, in hundredths of a second. Browsers turn anything shorter into a tenth.
const SHORTEST: u64 = 2;

/// Counts frames and says how long each is shown.
pub(super) struct Clock {
    frame_rate: f64,
    frames: u32,
    left_out: u32,
    /// Beginning of the frame now shown, in hundredths of a second.
    shown_since: u64,
}

impl Clock {
    /// A clock for so many frames a second; None where one frame lasts longer than GIF can say.
    pub(super) fn new(frame_rate: f64) -> Option<Self> {
        // Half a hundredth less than the field holds, for the rounding.
        (100.0 / frame_rate < f64::from(u16::MAX) - 1.0).then_some(Self {
            frame_rate,
            frames: 0,
            left_out: 0,
            shown_since: 0,
        })
    }

    /// Begins the next frame and gives the delay of the one before it (0 for the first, which has none before it).
    /// None where it would begin too soon after the one that is shown: it is left out.
    pub(super) fn next_frame(&mut self) -> Option<u16> {
        let begins = self.begins(self.frames);
        let delay = begins - self.shown_since;
        let is_first = self.frames == 0;
        self.frames += 1;
        if delay < SHORTEST && !is_first {
            self.left_out += 1;
            return None;
        }
        self.shown_since = begins;
        Some(in_field(delay))
    }

    /// The delay of the last frame.
    pub(super) fn finish(&self) -> u16 {
        in_field((self.begins(self.frames) - self.shown_since).max(SHORTEST))
    }

    /// Frames left out so far.
    pub(super) fn left_out(&self) -> u32 {
        self.left_out
    }

    fn begins(&self, frame: u32) -> u64 {
        (f64::from(frame) * 100.0 / self.frame_rate).round() as u64
    }
}

fn in_field(delay: u64) -> u16 {
    u16::try_from(delay).unwrap_or(u16::MAX)
}
