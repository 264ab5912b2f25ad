//! Frames on their way out, one after another, into whatever the user asked for.

use std::path::PathBuf;

use super::atomic::AtomicFile;
use super::gif::GifWriter;
use super::png::write_png;
use super::target::FramePattern;
use super::{OutputError, OutputTarget, Rgba8Image};

/// An output that takes frames.
///
/// Each PNG appears when it is complete; a GIF appears at [`FrameSink::finish`]. Dropping the sink before that leaves the
/// PNGs so far and no GIF.
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
}

impl FrameSink {
    /// Prepares an output for `frame_count` frames of `width`×`height` pixels at `frame_rate` frames a second (finite,
    /// above 0; only a GIF keeps it). Folders are created, and whether files can be written there is found out now.
    ///
    /// # Errors
    /// The user's fault: no frames, more than one frame for a single PNG, a size of 0 or beyond what the format holds
    /// (65,535 a side for a GIF), a frame rate that is none, a path that cannot be. The machine's: it cannot be written.
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
                    "use name-%04d.png or .gif, or pick one with --frame",
                );
            }
            OutputTarget::Png(path) => {
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
        };
        Ok(Self {
            writer,
            width,
            height,
            path,
            written: Written::default(),
        })
    }

    /// Whether all frames go into one file, which is nothing before the last.
    pub fn is_animation(&self) -> bool {
        matches!(self.writer, Writer::Gif(_))
    }

    /// Writes the next frame. `frame_number` names its file; an animation takes frames in the order of the calls.
    ///
    /// # Errors
    /// The user's fault: a picture of another size than the sink was opened for, a second one for a single PNG. The
    /// machine's: it cannot be written.
    pub fn write_frame(
        &mut self,
        frame_number: u32,
        image: &Rgba8Image,
    ) -> Result<(), OutputError> {
        let Self { width, height, .. } = *self;
        if (image.width, image.height) != (width, height) || !image.is_consistent() {
            return Err(OutputError::usage(
                &self.path,
                format!(
                    "frame {frame_number} is {}×{} with {} bytes of pixels",
                    image.width,
                    image.height,
                    image.pixels.len()
                ),
                format!("every frame of this output is {width}×{height}, 4 bytes a pixel"),
            ));
        }
        match &mut self.writer {
            Writer::Frames(pattern) => write_png(&pattern.path(frame_number), image)?,
            Writer::One(path) if self.written.frames == 0 => write_png(path, image)?,
            Writer::One(path) => {
                return Err(OutputError::usage(
                    &*path,
                    "a second frame for a single PNG",
                    "use name-%04d.png or .gif",
                ));
            }
            Writer::Gif(writer) => writer.write_frame(image)?,
        }
        self.written.frames += 1;
        Ok(())
    }

    /// Completes the output and puts it in its place.
    ///
    /// # Errors
    /// The machine's fault: it cannot be written. The user's: a GIF to which no frame was written.
    pub fn finish(mut self) -> Result<Written, OutputError> {
        if let Writer::Gif(writer) = self.writer {
            self.written.left_out = writer.finish()?;
        }
        Ok(self.written)
    }
}

fn frames(pattern: FramePattern) -> Result<Writer, OutputError> {
    // The name of a frame may be a folder; that of frame 0 stands for all of them.
    probe(&pattern.path(0))?;
    Ok(Writer::Frames(pattern))
}

/// Finds out before a long run, rather than after it, whether a file can be written.
fn probe(path: &std::path::Path) -> Result<(), OutputError> {
    AtomicFile::create(path).map(drop)
}
