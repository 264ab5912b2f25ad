//! What `-o OUT` means, by its ending. Nothing here touches a file, but for a look whether there is a
//! folder of that name, or something in its way.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use super::pattern::{Named, has_conversion};
use super::{FramePattern, OutputError, Pixels};

/// What Motes can write, for messages.
const SUPPORTED: &str = "give a folder, name-%04d.png or name-%04d.exr (a file a frame), name.png, \
                         name.exr or name.svg (one frame), name.gif or name.mp4";

/// Endings that it knows.
const KNOWN: [&str; 5] = ["png", "exr", "gif", "mp4", "svg"];

/// Where frames go, and as what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputTarget {
    /// A folder with `frame-%04d.png` in it, a PNG a frame.
    Folder(PathBuf),
    /// A PNG or EXR a frame, named by a pattern such as `name-%04d.png`.
    Pattern(FramePattern),
    /// One frame in one PNG.
    Png(PathBuf),
    /// One frame in one EXR.
    Exr(PathBuf),
    /// All frames in one animated GIF.
    Gif(PathBuf),
    /// All frames in one MP4, which ffmpeg encodes.
    Mp4(PathBuf),
    /// One frame as a line drawing.
    Svg(PathBuf),
}

impl OutputTarget {
    /// Reads what the user wrote after `-o`, by its ending (in any case of letters).
    ///
    /// No ending, or a trailing slash, is a folder, and so is one that is there already; a dot and
    /// a digit are no ending (`v1.2`). `.png` and `.exr` are one frame, or a pattern where the name holds
    /// `%d` or `%04d` (1 to 10 digits); `%%` is a percent sign. `.gif` and `.mp4` are animations, `.svg` a line drawing
    /// of one frame.
    ///
    /// # Errors
    /// The user's fault: nothing at all, `-`, an ending that Motes does not write, a pattern that is none, a folder where
    /// something else stands.
    pub fn parse(out: &str) -> Result<Self, OutputError> {
        let usage = |problem: String, advice: &str| OutputError::usage(out, problem, advice);
        if out.is_empty() {
            return Err(usage("the output has no name".to_owned(), SUPPORTED));
        }
        if out == "-" {
            return Err(usage(
                "pictures do not go to standard output".to_owned(),
                &format!("{SUPPORTED}; a folder of this name is `./-`"),
            ));
        }
        let path = Path::new(out);
        let folder = path.parent().unwrap_or(Path::new(""));
        let is_folder = out.ends_with(std::path::is_separator);
        let name = path.file_name().and_then(OsStr::to_str);
        let (Some(name), false) = (name, is_folder) else {
            // `.`, `..`, `/` and whatever ends in a slash.
            return Self::folder(out);
        };
        let ending = match name.rsplit_once('.') {
            Some((_, ending)) => ending.to_ascii_lowercase(),
            None => return Self::folder(out),
        };
        match ending.as_str() {
            "png" => Self::stills(out, folder, name, Pixels::Bytes),
            "exr" => Self::stills(out, folder, name, Pixels::Linear),
            "gif" | "mp4" if has_conversion(out) => Err(usage(
                format!(
                    "one {} holds all frames, so its name has no frame number",
                    ending.to_ascii_uppercase()
                ),
                &format!("use name.{ending}, or name-%04d.png for a file a frame"),
            )),
            "gif" => Ok(Self::Gif(path.to_owned())),
            "mp4" => Ok(Self::Mp4(path.to_owned())),
            "svg" if has_conversion(out) => Err(usage(
                "a line drawing is one frame, so its name has no frame number".to_owned(),
                "use name.svg and --frame N",
            )),
            "svg" => Ok(Self::Svg(path.to_owned())),
            "apng" | "avi" | "avif" | "bmp" | "hdr" | "jpeg" | "jpg" | "jxl" | "m4v" | "mkv"
            | "mov" | "ogv" | "pdf" | "pnm" | "ppm" | "qoi" | "tga" | "tif" | "tiff" | "webm"
            | "webp" | "zip" => Err(usage(format!("Motes does not write .{ending}"), SUPPORTED)),
            _ if path.is_dir() || !is_ending(name, &ending) => Self::folder(out),
            _ => {
                let close = KNOWN
                    .iter()
                    .map(|it| (strsim::osa_distance(&ending, it), it));
                // Two mistakes in three letters leave nothing to guess from.
                let close = close.filter(|(distance, _)| *distance == 1).min();
                let guess =
                    close.map_or(String::new(), |(_, it)| format!("did you mean `.{it}`? "));
                let help = format!("{guess}A folder of this name is `{out}/`; else {SUPPORTED}");
                Err(usage(format!("Motes does not write .{ending}"), &help))
            }
        }
    }

    /// The folder or file as a path; for a pattern, that of frame 0.
    pub fn path(&self) -> PathBuf {
        match self {
            Self::Pattern(pattern) => pattern.path(0),
            Self::Folder(path)
            | Self::Png(path)
            | Self::Exr(path)
            | Self::Gif(path)
            | Self::Mp4(path)
            | Self::Svg(path) => path.clone(),
        }
    }

    /// Whether all frames go into one file, which is nothing before the last.
    pub fn is_animation(&self) -> bool {
        matches!(self, Self::Gif(_) | Self::Mp4(_))
    }

    /// The folder that files go to, and the name that they have there, with `%04d` or its kind for
    /// the number of a frame.
    pub(crate) fn folder_and_name(&self) -> (PathBuf, String) {
        let of_pattern = |pattern: &FramePattern| (pattern.folder().to_owned(), pattern.name());
        match self {
            Self::Folder(folder) => of_pattern(&FramePattern::in_folder(folder)),
            Self::Pattern(pattern) => of_pattern(pattern),
            Self::Png(path)
            | Self::Exr(path)
            | Self::Gif(path)
            | Self::Mp4(path)
            | Self::Svg(path) => {
                let name = path.file_name().unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                (folder.to_owned(), name.to_string_lossy().into_owned())
            }
        }
    }

    /// The file that a frame is in: one of its own, or that of all frames.
    pub fn frame_path(&self, frame_number: u32) -> PathBuf {
        match self {
            Self::Folder(folder) => FramePattern::in_folder(folder).path(frame_number),
            Self::Pattern(pattern) => pattern.path(frame_number),
            one => one.path(),
        }
    }

    /// What its files store of a pixel.
    pub fn pixels(&self) -> Pixels {
        match self {
            Self::Pattern(pattern) => pattern.pixels(),
            Self::Exr(_) => Pixels::Linear,
            Self::Folder(_) | Self::Png(_) | Self::Gif(_) | Self::Mp4(_) | Self::Svg(_) => {
                Pixels::Bytes
            }
        }
    }

    /// The file of a frame's layer, beside the frame's own: `name-LAYER.png` or `.exr`; `None` where
    /// frames have no file of their own.
    pub fn layer_path(&self, frame_number: u32, layer: &str) -> Option<PathBuf> {
        if matches!(self, Self::Gif(_) | Self::Mp4(_) | Self::Svg(_)) {
            return None;
        }
        let frame = self.frame_path(frame_number);
        let mut name = frame.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{layer}.{}", self.pixels().ending()));
        Some(frame.with_file_name(name))
    }

    fn folder(out: &str) -> Result<Self, OutputError> {
        if has_conversion(out) {
            return Err(OutputError::usage(
                out,
                "a frame number needs a file name that ends in .png or .exr",
                format!("use {}.png", out.trim_end_matches(std::path::is_separator)),
            ));
        }
        Self::in_folder(out)
    }

    /// A PNG a frame in that folder, whatever its name.
    ///
    /// # Errors
    /// The user's fault: something else stands there.
    pub(crate) fn in_folder(out: &str) -> Result<Self, OutputError> {
        // With a slash at its end a file would be none.
        let there = out.trim_end_matches(std::path::is_separator);
        let there = fs::metadata(there).ok().filter(|it| !it.is_dir());
        if let Some(it) = there {
            let what = if it.is_file() {
                "a file"
            } else {
                "a device or a pipe"
            };
            let problem = format!("frames go to a folder of this name, and it is {what}");
            return Err(OutputError::usage(out, problem, SUPPORTED));
        }
        Ok(Self::Folder(PathBuf::from(out)))
    }

    fn stills(out: &str, folder: &Path, name: &str, pixels: Pixels) -> Result<Self, OutputError> {
        Ok(match FramePattern::parse(out, folder, name, pixels)? {
            Named::Frames(pattern) => Self::Pattern(pattern),
            Named::One(path) if pixels == Pixels::Linear => Self::Exr(path),
            Named::One(path) => Self::Png(path),
        })
    }
}

/// Whether what follows a name's last dot is meant as a file's ending: `out/v1.2` and `.hidden` are
/// names of folders.
fn is_ending(name: &str, ending: &str) -> bool {
    let is_hidden = name.len() == ending.len() + 1;
    let is_word = ending.starts_with(|c: char| c.is_ascii_alphabetic())
        && ending.chars().all(|c| c.is_ascii_alphanumeric());
    is_word && !is_hidden
}
