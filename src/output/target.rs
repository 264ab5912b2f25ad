//! What `-o OUT` means, by its ending. Nothing here touches a file.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::OutputError;

/// What Motes can write today, for messages.
const SUPPORTED: &str =
    "give a folder, name-%04d.png (a PNG a frame), name.png or name.svg (one frame) or name.gif";

/// Digits beyond which a frame number is not padded: more than a `u32` has is surely a slip of the hand.
const MAX_DIGITS: usize = 10;

/// Where frames go, and as what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputTarget {
    /// A folder with `frame-%04d.png` in it, a PNG a frame.
    Folder(PathBuf),
    /// A PNG a frame, named by a pattern such as `name-%04d.png`.
    Pattern(FramePattern),
    /// One frame in one PNG.
    Png(PathBuf),
    /// All frames in one animated GIF.
    Gif(PathBuf),
    /// One frame as a line drawing.
    Svg(PathBuf),
}

/// File names with a frame number in them, such as `fire/name-%04d.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FramePattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl FramePattern {
    /// The file of one frame. The number is padded with zeros to the pattern's digits, and longer where it must be.
    pub fn path(&self, frame_number: u32) -> PathBuf {
        let Self {
            folder,
            before,
            digits,
            after,
        } = self;
        folder.join(format!("{before}{frame_number:0digits$}{after}"))
    }

    /// The folder that the frames go to; empty for the current one.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The pattern that `OutputTarget::Folder` stands for: `frame-%04d.png` in the folder.
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            before: "frame-".to_owned(),
            digits: 4,
            after: ".png".to_owned(),
        }
    }
}

impl OutputTarget {
    /// Reads what the user wrote after `-o`, by its ending (in any case of letters).
    ///
    /// No ending, or a trailing slash, is a folder. `.png` is one frame, or a pattern where its name holds `%d` or `%04d`
    /// (1 to 10 digits); `%%` is a percent sign. `.gif` is an animation, `.svg` a line drawing of one frame.
    ///
    /// # Errors
    /// The user's fault: nothing at all, an ending that Motes does not write, a pattern that is none.
    pub fn parse(out: &str) -> Result<Self, OutputError> {
        let usage = |problem: String, advice: &str| OutputError::usage(out, problem, advice);
        if out.is_empty() {
            return Err(usage("the output has no name".to_owned(), SUPPORTED));
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
        let problem = match ending.as_str() {
            "png" => return Self::png(out, folder, name),
            "gif" => {
                if has_conversion(out) {
                    return Err(usage(
                        "one GIF holds all frames, so its name has no frame number".to_owned(),
                        "use name.gif, or name-%04d.png for a file a frame",
                    ));
                }
                return Ok(Self::Gif(path.to_owned()));
            }
            "svg" => {
                if has_conversion(out) {
                    return Err(usage(
                        "a line drawing is one frame, so its name has no frame number".to_owned(),
                        "use name.svg and --frame N",
                    ));
                }
                return Ok(Self::Svg(path.to_owned()));
            }
            "exr" | "mp4" => format!("this version does not write .{ending} yet"),
            "apng" | "avi" | "avif" | "bmp" | "hdr" | "jpeg" | "jpg" | "jxl" | "m4v" | "mkv"
            | "mov" | "ogv" | "pdf" | "pnm" | "ppm" | "qoi" | "tga" | "tif" | "tiff" | "webm"
            | "webp" | "zip" => format!("Motes does not write .{ending}"),
            // `out/v1.2`, `.` hidden folders: a dot alone does not make a file type.
            _ => return Self::folder(out),
        };
        Err(usage(problem, SUPPORTED))
    }

    /// The folder or file as a path; for a pattern, that of frame 0.
    pub fn path(&self) -> PathBuf {
        match self {
            Self::Folder(path) | Self::Png(path) | Self::Gif(path) | Self::Svg(path) => {
                path.clone()
            }
            Self::Pattern(pattern) => pattern.path(0),
        }
    }

    /// The file of a frame; `None` where frames share one.
    pub fn frame_path(&self, frame_number: u32) -> Option<PathBuf> {
        match self {
            Self::Folder(folder) => Some(FramePattern::in_folder(folder).path(frame_number)),
            Self::Pattern(pattern) => Some(pattern.path(frame_number)),
            Self::Png(path) | Self::Svg(path) => Some(path.clone()),
            Self::Gif(_) => None,
        }
    }

    /// The folder that files go to, and the name that they have there, with `%04d` or its kind for
    /// the number of a frame.
    pub(crate) fn folder_and_name(&self) -> (PathBuf, String) {
        let of_pattern = |pattern: &FramePattern| {
            let FramePattern {
                before,
                digits,
                after,
                ..
            } = pattern;
            (
                pattern.folder().to_owned(),
                format!("{before}%0{digits}d{after}"),
            )
        };
        match self {
            Self::Folder(folder) => of_pattern(&FramePattern::in_folder(folder)),
            Self::Pattern(pattern) => of_pattern(pattern),
            Self::Png(path) | Self::Gif(path) | Self::Svg(path) => {
                let name = path.file_name().unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                (folder.to_owned(), name.to_string_lossy().into_owned())
            }
        }
    }

    /// The file of a frame's layer, beside the frame's own: `name-LAYER.png`; `None` where frames
    /// have no PNG of their own.
    pub fn layer_path(&self, frame_number: u32, layer: &str) -> Option<PathBuf> {
        let frame = match self {
            Self::Folder(folder) => FramePattern::in_folder(folder).path(frame_number),
            Self::Pattern(pattern) => pattern.path(frame_number),
            Self::Png(path) => path.clone(),
            Self::Gif(_) | Self::Svg(_) => return None,
        };
        let mut name = frame.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{layer}.png"));
        Some(frame.with_file_name(name))
    }

    fn folder(out: &str) -> Result<Self, OutputError> {
        if has_conversion(out) {
            return Err(OutputError::usage(
                out,
                "a frame number needs a file name that ends in .png",
                format!("use {}.png", out.trim_end_matches(std::path::is_separator)),
            ));
        }
        Ok(Self::Folder(PathBuf::from(out)))
    }

    fn png(out: &str, folder: &Path, name: &str) -> Result<Self, OutputError> {
        if folder.to_str().is_some_and(has_conversion) {
            return Err(OutputError::usage(
                out,
                "a frame number belongs into the file's name, not into a folder's",
                "use folder/name-%04d.png",
            ));
        }
        let mut before = String::new();
        let mut after = String::new();
        let mut digits = None;
        let mut rest = name;
        while let Some((text, tail)) = rest.split_once('%') {
            let part = if digits.is_some() {
                &mut after
            } else {
                &mut before
            };
            part.push_str(text);
            if let Some(tail) = tail.strip_prefix('%') {
                part.push('%');
                rest = tail;
            } else if let Some((found, tail)) = conversion(tail) {
                if digits.replace(found).is_some() {
                    return Err(OutputError::usage(
                        out,
                        "two frame numbers in one name",
                        "keep one, as in name-%04d.png",
                    ));
                }
                rest = tail;
            } else {
                return Err(OutputError::usage(
                    out,
                    "a % that is no frame number",
                    "use %04d (or %d) for the frame's number, and %% for a percent sign",
                ));
            }
        }
        let Some(digits) = digits else {
            return Ok(Self::Png(folder.join(before + rest)));
        };
        after.push_str(rest);
        Ok(Self::Pattern(FramePattern {
            folder: folder.to_owned(),
            before,
            digits,
            after,
        }))
    }
}

/// Digits of the conversion after a `%` (`d`, `04d`), and what follows it; None where there is none.
fn conversion(after_percent: &str) -> Option<(usize, &str)> {
    let (width, tail) = after_percent.split_once('d')?;
    if width.is_empty() {
        return Some((1, tail));
    }
    let digits: usize = width.strip_prefix('0')?.parse().ok()?;
    let is_plain = width.bytes().all(|byte| byte.is_ascii_digit());
    (is_plain && (1..=MAX_DIGITS).contains(&digits)).then_some((digits, tail))
}

fn has_conversion(text: &str) -> bool {
    text.match_indices('%')
        .any(|(at, _)| conversion(&text[at + 1..]).is_some())
}
