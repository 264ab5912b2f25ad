//! Frames as one MP4: H.264 by an `ffmpeg` that is found on the path.
//!
//! Frames go as raw bytes into its standard input; it writes a hidden file beside the film's place, which is renamed
//! when it has ended well. Threads are a fixed number and no date is kept, so that one build of ffmpeg and x264 makes
//! the same bytes again.

mod boxes;
mod ffmpeg;

use std::ffi::OsString;
use std::path::Path;

use self::ffmpeg::{Failure, Ffmpeg};
use super::atomic::AtomicFile;
use super::error::NO_ROOM;
use super::picture::over_black;
use super::special::is_special;
use super::{OutputError, Rgba8Image};

/// Particles are small and bright on black: what x264 makes of them at its default of 23 is smeared.
const QUALITY: &str = "16";

/// x264's picture depends on the number of its threads, so that it is not left to the machine.
const THREADS: &str = "4";

/// From full-range RGB to what the film is tagged as.
const CONVERSION: &str = "scale=in_range=full:out_range=limited:out_color_matrix=bt709\
                          :flags=bicubic+accurate_rnd+full_chroma_int+full_chroma_inp+bitexact,\
                          format=yuv420p";

/// An MP4 being written; it appears at [`Mp4Writer::finish`].
pub(super) struct Mp4Writer {
    // Ended before the hidden file is removed.
    ffmpeg: Ffmpeg,
    file: AtomicFile,
    /// A frame as ffmpeg takes it.
    buffer: Vec<u8>,
    frames: u32,
}

impl Mp4Writer {
    /// Starts a film, and ffmpeg. That there is none, or none with libx264, is the machine's fault.
    pub(super) fn create(
        path: &Path,
        width: u32,
        height: u32,
        frame_rate: f64,
    ) -> Result<Self, OutputError> {
        let no_file = || {
            OutputError::usage(
                path,
                "an MP4 is not written in one go, as a device or a pipe needs it",
                "give the name of a file, or write a .gif",
            )
        };
        // To open a pipe would be to wait for who reads it.
        if is_special(path) {
            return Err(no_file());
        }
        let file = AtomicFile::begin(path)?;
        let hidden = file.hidden_path().ok_or_else(no_file)?;
        // A plain path could be taken for an option or for a protocol.
        let mut url = OsString::from("file:");
        url.push(hidden);
        let started = Ffmpeg::require("libx264").and_then(|()| {
            let mut arguments = arguments(even(width), even(height), frame_rate);
            arguments.push(url);
            Ffmpeg::start(arguments)
        });
        Ok(Self {
            ffmpeg: started.map_err(|failure| told(&file, failure))?,
            file,
            buffer: Vec::new(),
            frames: 0,
        })
    }

    /// Adds a frame of the size that the film was created with; transparency is shown over black.
    pub(super) fn write_frame(&mut self, image: &Rgba8Image) -> Result<(), OutputError> {
        fill_even(&mut self.buffer, image);
        self.frames += 1;
        let written = self.ffmpeg.write(&self.buffer);
        written.map_err(|failure| told(&self.file, failure))
    }

    /// Completes the film and puts it in its place.
    pub(super) fn finish(mut self) -> Result<(), OutputError> {
        let path = self.file.path();
        if self.frames == 0 {
            return Err(OutputError::usage(
                path,
                "an MP4 without a frame",
                "write at least one",
            ));
        }
        let finished = self.ffmpeg.finish();
        finished.map_err(|failure| told(&self.file, failure))?;
        // Some end well though the disk is full.
        let hidden = self.file.hidden_path();
        if !hidden.is_some_and(|hidden| boxes::is_whole(hidden).unwrap_or(false)) {
            let lines = self.ffmpeg.last_lines();
            let problem = "ffmpeg ended well, but the film is not whole".to_owned();
            let advice =
                "make room if the disk is full; else see whether the `ffmpeg` on the PATH is one";
            return Err(with_words(&self.file, problem, &lines, advice));
        }
        self.file.commit()
    }
}

/// All arguments but the file to write, which comes last.
fn arguments(width: u32, height: u32, frame_rate: f64) -> Vec<OsString> {
    let (size, rate) = (format!("{width}x{height}"), frame_rate.to_string());
    let quiet = [
        "-hide_banner",
        "-nostdin",
        "-nostats",
        "-loglevel",
        "error",
        "-xerror",
    ];
    let frames_in = [
        "-f",
        "rawvideo",
        "-pixel_format",
        "rgba",
        "-video_size",
        &size,
        "-framerate",
        &rate,
        "-i",
        "pipe:0",
    ];
    let film = ["-an", "-vf", CONVERSION, "-c:v", "libx264"];
    let encoding = ["-preset", "medium", "-crf", QUALITY, "-threads", THREADS];
    let tags = [
        "-color_primaries",
        "bt709",
        "-color_trc",
        "bt709",
        "-colorspace",
        "bt709",
        "-color_range",
        "tv",
    ];
    // No names of versions and no date.
    let exact = ["-map_metadata", "-1", "-fflags", "+bitexact"];
    let exact_too = ["-flags:v", "+bitexact"];
    // Its index first, so that it can be shown while it is being loaded. The hidden file is there already.
    let file = ["-movflags", "+faststart", "-f", "mp4", "-y"];
    let groups: [&[&str]; 8] = [
        &quiet, &frames_in, &film, &encoding, &tags, &exact, &exact_too, &file,
    ];
    groups.concat().iter().map(OsString::from).collect()
}

/// Chroma is stored for two by two pixels.
fn even(side: u32) -> u32 {
    side + side % 2
}

/// The picture over black, with sides made even: the last column, and the last row, twice.
fn fill_even(buffer: &mut Vec<u8>, image: &Rgba8Image) {
    buffer.clear();
    for row in image.pixels.chunks_exact(4 * image.width as usize) {
        let (pixels, _) = row.as_chunks::<4>();
        let last = if image.width % 2 == 1 {
            pixels.last()
        } else {
            None
        };
        for &pixel in pixels.iter().chain(last) {
            let [red, green, blue] = over_black(pixel);
            buffer.extend_from_slice(&[red, green, blue, 255]);
        }
    }
    if image.height % 2 == 1 {
        let row_len = 4 * even(image.width) as usize;
        buffer.extend_from_within(buffer.len() - row_len..);
    }
}

/// The failure in the user's words; all of them are the machine's fault.
fn told(file: &AtomicFile, failure: Failure) -> OutputError {
    let path = file.path();
    let install = "`apt-get install ffmpeg` or its like brings it; or write a .gif";
    match failure {
        Failure::Missing => OutputError::machine(path, "no ffmpeg on the PATH", install),
        Failure::NotStarted(error) => {
            OutputError::machine(path, format!("ffmpeg cannot be started: {error}"), install)
        }
        Failure::NoEncoder(encoder) => OutputError::machine(
            path,
            format!("the ffmpeg on the PATH has no {encoder}, which makes H.264"),
            "put one on the PATH that has it; or write a .gif",
        ),
        Failure::Failed { how, last_lines } => {
            let problem = match last_lines.is_empty() {
                true => format!("ffmpeg failed ({how}) and said nothing"),
                false => format!("ffmpeg failed ({how})"),
            };
            let advice = "see whether the `ffmpeg` on the PATH works; or write a .gif";
            with_words(file, problem, &last_lines, advice)
        }
    }
}

/// What is wrong, with ffmpeg's last lines, in which the hidden file has the name of the film.
fn with_words(file: &AtomicFile, problem: String, lines: &[String], advice: &str) -> OutputError {
    let path = file.path();
    let mut words = lines.join("\n  ");
    if let Some(hidden) = file.hidden_path() {
        let (hidden, shown) = (hidden.display().to_string(), path.display().to_string());
        words = words.replace(&format!("file:{hidden}"), &hidden);
        words = words.replace(&hidden, &shown);
    }
    let is_full = words.to_ascii_lowercase().contains("no space left");
    let advice = if is_full { NO_ROOM } else { advice };
    let problem = match words.is_empty() {
        true => problem,
        false => format!("{problem}, and it said at last:\n  {words}"),
    };
    OutputError::machine(path, problem, advice)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_odd_picture_gets_its_last_column_and_row_twice() {
        let pixel = |n: u8| [n, n + 1, n + 2, 255];
        let image = Rgba8Image {
            width: 3,
            height: 1,
            pixels: [pixel(10), pixel(20), [200, 100, 0, 128]].concat(),
        };
        let mut buffer = vec![1; 99];
        fill_even(&mut buffer, &image);
        let faded = [100, 50, 0, 255];
        let row = [pixel(10), pixel(20), faded, faded].concat();
        assert_eq!(buffer, [row.clone(), row].concat());
    }
}
