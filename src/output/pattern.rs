//! File names with a frame's number in them. Nothing here touches a file.

use std::path::{Path, PathBuf};

use super::{OutputError, Pixels};

/// Digits beyond which a frame number is not padded: more than a `u32` has is surely a slip of the hand.
const MAX_DIGITS: usize = 10;

/// File names with a frame number in them, such as `fire/name-%04d.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FramePattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
    pixels: Pixels,
}

/// What a name of files of one frame each means.
pub(super) enum Named {
    /// There is a frame number in it.
    Frames(FramePattern),
    /// There is none.
    One(PathBuf),
}

impl FramePattern {
    /// The file of one frame. The number is padded with zeros to the pattern's digits, and longer where it must be.
    pub fn path(&self, frame_number: u32) -> PathBuf {
        let Self {
            folder,
            before,
            digits,
            after,
            ..
        } = self;
        folder.join(format!("{before}{frame_number:0digits$}{after}"))
    }

    /// The folder that the frames go to; empty for the current one.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The name of its files, with the place of the number as `%04d` or its kind.
    pub(super) fn name(&self) -> String {
        let Self {
            before,
            digits,
            after,
            ..
        } = self;
        format!("{before}%0{digits}d{after}")
    }

    /// What its files store of a pixel.
    pub fn pixels(&self) -> Pixels {
        self.pixels
    }

    /// The pattern that `OutputTarget::Folder` stands for: `frame-%04d.png` in the folder.
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            before: "frame-".to_owned(),
            digits: 4,
            after: ".png".to_owned(),
            pixels: Pixels::Bytes,
        }
    }

    /// Reads the file name `name` in `folder`; `out` is all that the user wrote, for messages.
    pub(super) fn parse(
        out: &str,
        folder: &Path,
        name: &str,
        pixels: Pixels,
    ) -> Result<Named, OutputError> {
        let ending = pixels.ending();
        if folder.to_str().is_some_and(has_conversion) {
            return Err(OutputError::usage(
                out,
                "a frame number belongs into the file's name, not into a folder's",
                format!("use folder/name-%04d.{ending}"),
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
                        format!("keep one, as in name-%04d.{ending}"),
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
            return Ok(Named::One(folder.join(before + rest)));
        };
        after.push_str(rest);
        Ok(Named::Frames(Self {
            folder: folder.to_owned(),
            before,
            digits,
            after,
            pixels,
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

/// Whether there is a frame number in a text.
pub(super) fn has_conversion(text: &str) -> bool {
    text.match_indices('%')
        .any(|(at, _)| conversion(&text[at + 1..]).is_some())
}
