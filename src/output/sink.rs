//! Frames on their way out, one after another, into whatever the user asked for.

use std::path::PathBuf;

use super::atomic::probe;
use super::gif::GifWriter;
use super::mp4::Mp4Writer;
use super::{FramePattern, OutputError, OutputTarget, PictureRef, Pixels};

/// An output that takes frames.
///
/// Each PNG or EXR appears when it is complete; a GIF or MP4 appears at [`FrameSink::finish`]. Dropping the sink before
/// that leaves the pictures so far and no animation. An output takes the pixels that [`FrameSink::pixels`] says.
///
/// ```no_run
/// # use motes::output::{FrameSink, OutputTarget, Rgba8Image};
/// # let frame = Rgba8Image { width: 1, height: 1, pixels: vec![255; 4] };
/// let target = OutputTarget::parse("fireworks.gif")?;
/// let mut sink = FrameSink::open(&target, 1280, 720, 24.0, 150)?;
/// for frame_number in 0..150 {
///     sink.write_frame(frame_number, &frame)?;
/// }
/// sink.finish()?;
/// # Ok::<(), motes::output::OutputError>(())
/// ```
pub struct FrameSink {
    writer: Writer,
    width: u32,
    height: u32,
    /// What messages name.
    path: PathBuf,
    pixels: Pixels,
    written: Written,
}

/// What an output took, for a closing message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Frames handed to [`FrameSink::write_frame`].
    pub frames: u32,
    /// Of these, frames that the format had no time for: a GIF shows at most 50 frames a second, and a quicker animation
    /// keeps its speed by leaving out frames.
    pub left_out: u32,
}

enum Writer {
    Frames(FramePattern),
    One(PathBuf),
    Gif(Box<GifWriter>),
    Mp4(Box<Mp4Writer>),
}

impl FrameSink {
    /// Prepares an output for `frame_count` frames of `width`×`height` pixels at `frame_rate` frames a second (finite,
    /// above 0; only animations keep it). Folders are created, and whether files can be written there, and whether there is
    /// an ffmpeg for an MP4, is found out now.
    ///
    /// An MP4 is H.264 with 4:2:0 chroma, whose sides are even: an odd one gets its last column or row twice.
    ///
    /// # Errors
    /// The user's fault: no frames, more than one frame for a single PNG or EXR, a size of 0 or beyond what the format
    /// holds (65,535 a side for a GIF), a frame rate that is none, a path that cannot be. The machine's: it cannot be
    /// written, or there is no ffmpeg with libx264.
    pub fn open(
        target: &OutputTarget,
        width: u32,
        height: u32,
        frame_rate: f64,
        frame_count: u32,
    ) -> Result<Self, OutputError> {
        let path = target.path();
        let usage = |problem: String, advice: &str| Err(OutputError::usage(&path, problem, advice));
        if frame_count == 0 {
            return usage(
                "there is no frame to write".to_owned(),
                "ask for at least one",
            );
        }
        if width == 0 || height == 0 {
            return usage(
                format!("a picture of {width}×{height} pixels"),
                "give a size of at least 1x1",
            );
        }
        if !(frame_rate.is_finite() && frame_rate > 0.0) {
            return usage(
                format!("a frame rate of {frame_rate}"),
                "give frames a second, above 0",
            );
        }
        let writer = match target {
            OutputTarget::Folder(folder) => frames(FramePattern::in_folder(folder))?,
            OutputTarget::Pattern(pattern) => frames(pattern.clone())?,
            OutputTarget::Png(_) if frame_count > 1 => {
                return usage(
                    format!("one PNG holds one frame, and there are {frame_count}"),
                    "use name-%04d.png, .gif or .mp4, or pick one with --frame",
                );
            }
            OutputTarget::Exr(_) if frame_count > 1 => {
                return usage(
                    format!("one EXR holds one frame, and there are {frame_count}"),
                    "use name-%04d.exr, or pick one with --frame",
                );
            }
            OutputTarget::Png(path) | OutputTarget::Exr(path) => {
                probe(path)?;
                Writer::One(path.clone())
            }
            OutputTarget::Svg(_) => {
                return usage(
                    "a line drawing takes no pictures".to_owned(),
                    "use write_svg",
                );
            }
            OutputTarget::Gif(path) => Writer::Gif(Box::new(GifWriter::create(
                path, width, height, frame_rate,
            )?)),
            OutputTarget::Mp4(path) => Writer::Mp4(Box::new(Mp4Writer::create(
                path, width, height, frame_rate,
            )?)),
        };
        Ok(Self {
            writer,
            width,
            height,
            path,
            pixels: target.pixels(),
            written: Written::default(),
        })
    }

    /// What it stores of a pixel, and so takes.
    pub fn pixels(&self) -> Pixels {
        self.pixels
    }

    /// Writes the next frame. `frame_number` names its file; an animation takes frames in the order of the calls.
    ///
    /// # Errors
    /// The user's fault: a picture of another size than the sink was opened for or of other pixels than it takes, a
    /// second one for a single PNG or EXR. The machine's: it cannot be written.
    pub fn write_frame<'a>(
        &mut self,
        frame_number: u32,
        picture: impl Into<PictureRef<'a>>,
    ) -> Result<(), OutputError> {
        let picture = picture.into();
        let Self { width, height, .. } = *self;
        let refuse = |what: String| {
            let each = match self.pixels {
                Pixels::Bytes => "4 bytes a pixel",
                Pixels::Linear => "3 linear values a pixel",
            };
            Err(OutputError::usage(
                &self.path,
                format!("frame {frame_number} is {what}"),
                format!("every frame of this output is {width}×{height}, {each}"),
            ))
        };
        if let Some(misfit) = picture.misfit(width, height, self.pixels) {
            return refuse(misfit);
        }
        match (&mut self.writer, picture) {
            (Writer::Frames(pattern), picture) => picture.write(&pattern.path(frame_number))?,
            (Writer::One(path), picture) if self.written.frames == 0 => picture.write(path)?,
            (Writer::One(path), _) => {
                let ending = self.pixels.ending();
                return Err(OutputError::usage(
                    &*path,
                    format!("a second frame for a single .{ending}"),
                    format!("use name-%04d.{ending}"),
                ));
            }
            (Writer::Gif(writer), PictureRef::Bytes(image)) => writer.write_frame(image)?,
            (Writer::Mp4(writer), PictureRef::Bytes(image)) => writer.write_frame(image)?,
            (Writer::Gif(_) | Writer::Mp4(_), PictureRef::Linear(_)) => {
                return refuse("linear".to_owned());
            }
        }
        self.written.frames += 1;
        Ok(())
    }

    /// Completes the output and puts it in its place.
    ///
    /// # Errors
    /// The machine's fault: it cannot be written, or ffmpeg fails. The user's: an animation to which no frame was written.
    pub fn finish(mut self) -> Result<Written, OutputError> {
        match self.writer {
            Writer::Frames(_) | Writer::One(_) => {}
            Writer::Gif(writer) => self.written.left_out = writer.finish()?,
            Writer::Mp4(writer) => writer.finish()?,
        }
        Ok(self.written)
    }
}

fn frames(pattern: FramePattern) -> Result<Writer, OutputError> {
    // The name of a frame may be a folder; that of frame 0 stands for all of them.
    probe(&pattern.path(0))?;
    Ok(Writer::Frames(pattern))
}
