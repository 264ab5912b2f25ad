//! What a run came to, for its last words.

use crate::layout::FrameStats;
use crate::output::Picture;

/// What a run came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Summary {
    /// What found no room, as [`FrameStats::roomless`] has it.
    pub(super) roomless: [u64; 4],
    /// Most that lived after a frame: particles, control points, boids or flames.
    pub(super) most_live: u32,
    /// Most control points that moved.
    pub(super) most_points: u32,
    /// Whether any pixel differed from the others of its picture, or had none to differ from.
    pub(super) lit: bool,
    /// The frame that was next when it was asked to stop, and the exit code for that.
    pub(super) stopped: Option<(u32, u8)>,
}

impl Summary {
    /// Counts what happened in these frames.
    pub(super) fn count(&mut self, lines: &[FrameStats]) {
        for line in lines {
            for (sum, lost) in self.roomless.iter_mut().zip(line.roomless()) {
                *sum += u64::from(lost);
            }
            self.most_live = self.most_live.max(line.live).max(line.points_live);
            self.most_points = self.most_points.max(line.points_live);
        }
    }

    /// Sees whether there is anything to see in a picture.
    pub(super) fn look_at(&mut self, picture: &Picture) {
        self.lit = self.lit || is_lit(picture);
    }
}

/// Whether a pixel differs from the first; of one alone, nobody knows whether it shows anything.
fn is_lit(picture: &Picture) -> bool {
    match picture {
        Picture::Bytes(image) => {
            let (pixels, _) = image.pixels.as_chunks::<4>();
            pixels.len() == 1 || pixels.iter().any(|pixel| Some(pixel) != pixels.first())
        }
        Picture::Linear(image) => {
            let (pixels, _) = image.pixels.as_chunks::<3>();
            pixels.len() == 1 || pixels.iter().any(|pixel| Some(pixel) != pixels.first())
        }
    }
}
