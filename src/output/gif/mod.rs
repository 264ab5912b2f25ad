//! Frames as one animated GIF that repeats for ever.
//!
//! Particles glow on black, so pictures are smooth, dark and mostly still. Each frame therefore stores only the rectangle
//! that changed, with the pixels that stay as they are left transparent (`canvas.rs`), in a palette made for just these
//! pixels (`palette.rs`), dithered between two palette colours by a mask that stands still on the screen (`mixing.rs`,
//! `mask.rs`): what does not move does not flicker, and black is exactly black.

mod canvas;
mod clock;
mod histogram;
mod mask;
mod mixing;
mod palette;

use std::borrow::Cow;
use std::io::{self, ErrorKind};
use std::path::Path;

use ::gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use self::canvas::Canvas;
use self::clock::Clock;
use super::atomic::AtomicFile;
use super::{OutputError, Rgba8Image};

/// A GIF being written; it appears at [`GifWriter::finish`].
pub(super) struct GifWriter {
    encoder: Encoder<AtomicFile>,
    canvas: Canvas,
    clock: Clock,
    /// The latest frame, which waits for the next one to know how long it is shown.
    waiting: Option<Frame<'static>>,
}

impl GifWriter {
    /// Starts a GIF. Sides above 65,535 pixels and frames slower than 655 seconds are the user's fault.
    pub(super) fn create(
        path: &Path,
        width: u32,
        height: u32,
        frame_rate: f64,
    ) -> Result<Self, OutputError> {
        let (Ok(side_x), Ok(side_y)) = (u16::try_from(width), u16::try_from(height)) else {
            return Err(OutputError::usage(
                path,
                format!("a GIF of {width}×{height} pixels"),
                "a GIF has at most 65535 pixels a side; use name-%04d.png",
            ));
        };
        let Some(clock) = Clock::new(frame_rate) else {
            return Err(OutputError::usage(
                path,
                format!("a GIF of {frame_rate} frames a second"),
                "a GIF shows a frame for at most 655 seconds",
            ));
        };
        let file = AtomicFile::begin(path)?;
        let started = Encoder::new(file, side_x, side_y, &[]).and_then(|mut encoder| {
            encoder.set_repeat(Repeat::Infinite)?;
            Ok(encoder)
        });
        let no_room = |_| OutputError::io(path, "write", ErrorKind::OutOfMemory.into());
        Ok(Self {
            encoder: started.map_err(|error| OutputError::io(path, "write", io_error(error)))?,
            canvas: Canvas::new(side_x, side_y).map_err(no_room)?,
            clock,
            waiting: None,
        })
    }

    /// Adds a frame of the size that the GIF was created with; transparency is shown over black.
    pub(super) fn write_frame(&mut self, image: &Rgba8Image) -> Result<(), OutputError> {
        let Some(ended_delay) = self.clock.next_frame() else {
            return Ok(());
        };
        self.write_waiting(ended_delay)?;
        let patch = self.canvas.draw(&image.pixels);
        let mut frame = Frame {
            left: patch.left,
            top: patch.top,
            width: patch.width,
            height: patch.height,
            dispose: DisposalMethod::Keep,
            transparent: patch.transparent,
            palette: Some(patch.palette),
            buffer: Cow::Owned(patch.indices),
            ..Frame::default()
        };
        frame.make_lzw_pre_encoded();
        self.waiting = Some(frame);
        Ok(())
    }

    /// Completes the file and puts it in its place; gives the number of frames left out for want of time.
    pub(super) fn finish(mut self) -> Result<u32, OutputError> {
        if self.waiting.is_none() {
            return Err(OutputError::usage(
                self.encoder.get_ref().path(),
                "a GIF without a frame",
                "write at least one",
            ));
        }
        let last_delay = self.clock.finish();
        self.write_waiting(last_delay)?;
        let path = self.encoder.get_ref().path().to_owned();
        let file = self
            .encoder
            .into_inner()
            .map_err(|error| OutputError::io(&path, "write", io_error(error)))?;
        file.commit()?;
        Ok(self.clock.left_out())
    }

    fn write_waiting(&mut self, delay: u16) -> Result<(), OutputError> {
        let Some(mut frame) = self.waiting.take() else {
            return Ok(());
        };
        frame.delay = delay;
        self.encoder
            .write_lzw_pre_encoded_frame(&frame)
            .map_err(|error| self.encoder.get_ref().error(io_error(error)))
    }
}

fn io_error(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}
