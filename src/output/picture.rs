//! Pictures on their way to a file: bytes as a display takes them, or linear light.

use std::path::Path;

use super::{OutputError, write_exr, write_png};

/// What a file stores of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pixels {
    /// 8 bits a channel, clamped: [`Rgba8Image`].
    Bytes,
    /// Linear light in floats, unclamped: [`LinearImage`].
    Linear,
}

impl Pixels {
    /// The ending of a file that holds one picture of such pixels, without the dot.
    pub(super) fn ending(self) -> &'static str {
        match self {
            Self::Bytes => "png",
            Self::Linear => "exr",
        }
    }
}

/// A finished picture, 8 bits a channel, display-referred.
///
/// Alpha is straight (not premultiplied), as PNG has it; 255 everywhere for an ordinary frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgba8Image {
    /// Pixels a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Red, green, blue, alpha of every pixel, row by row, the top row first: `4 * width * height` bytes.
    pub pixels: Vec<u8>,
}

impl Rgba8Image {
    /// Whether the size is at least 1×1 and `pixels` is as long as the size says.
    pub fn is_consistent(&self) -> bool {
        fits(self.width, self.height, 4, self.pixels.len())
    }
}

/// A finished picture in linear light, unclamped: [`Simulation::radiance`](crate::simulation::Simulation::radiance).
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    /// Pixels a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Red, green, blue of every pixel, 1 for white, row by row, the top row first: `3 * width * height` values.
    pub pixels: Vec<f32>,
    /// Whether this is light to be put over another picture. Alpha is then a pixel's brightest channel,
    /// at most 1, and colours are premultiplied, as EXR has it; else alpha is 1.
    pub is_layer: bool,
    /// Of a layer: how much of what is behind each pixel it hides at least, 0 to 1, where something in
    /// it covers; one a pixel, or none at all.
    pub hidden: Vec<f32>,
    /// A word about the picture for the file's header; may be empty.
    pub comment: String,
}

impl LinearImage {
    /// Whether the size is at least 1×1 and `pixels` is as long as the size says.
    pub fn is_consistent(&self) -> bool {
        let hides = self.hidden.is_empty() || fits(self.width, self.height, 1, self.hidden.len());
        hides && fits(self.width, self.height, 3, self.pixels.len())
    }
}

fn fits(width: u32, height: u32, channels: u64, len: usize) -> bool {
    let pixel_count = u64::from(width) * u64::from(height);
    pixel_count > 0 && pixel_count.checked_mul(channels) == Some(len as u64)
}

/// A picture in whichever form its file takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// Bytes.
    Bytes(Rgba8Image),
    /// Linear light.
    Linear(LinearImage),
}

impl Picture {
    /// Writes the picture as the file of one picture that such pixels have: PNG or EXR.
    ///
    /// # Errors
    /// As [`write_png`] and [`write_exr`].
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        PictureRef::from(self).write(path)
    }
}

/// A picture that is lent to a [`FrameSink`](super::FrameSink).
#[derive(Clone, Copy, Debug)]
pub enum PictureRef<'a> {
    /// Bytes.
    Bytes(&'a Rgba8Image),
    /// Linear light.
    Linear(&'a LinearImage),
}

impl PictureRef<'_> {
    pub(super) fn write(self, path: &Path) -> Result<(), OutputError> {
        match self {
            Self::Bytes(image) => write_png(path, image),
            Self::Linear(image) => write_exr(path, image),
        }
    }

    /// What is wrong with it for an output of that size and kind, if anything.
    pub(super) fn misfit(self, width: u32, height: u32, pixels: Pixels) -> Option<String> {
        let (own, size, len, is_consistent) = match self {
            Self::Bytes(image) => (
                Pixels::Bytes,
                (image.width, image.height),
                format!("{} bytes of pixels", image.pixels.len()),
                image.is_consistent(),
            ),
            Self::Linear(image) => (
                Pixels::Linear,
                (image.width, image.height),
                format!("{} linear values", image.pixels.len()),
                image.is_consistent(),
            ),
        };
        let fits = size == (width, height) && own == pixels && is_consistent;
        (!fits).then(|| format!("{}×{} with {len}", size.0, size.1))
    }
}

impl<'a> From<&'a Rgba8Image> for PictureRef<'a> {
    fn from(image: &'a Rgba8Image) -> Self {
        Self::Bytes(image)
    }
}

impl<'a> From<&'a LinearImage> for PictureRef<'a> {
    fn from(image: &'a LinearImage) -> Self {
        Self::Linear(image)
    }
}

impl<'a> From<&'a Picture> for PictureRef<'a> {
    fn from(picture: &'a Picture) -> Self {
        match picture {
            Picture::Bytes(image) => Self::Bytes(image),
            Picture::Linear(image) => Self::Linear(image),
        }
    }
}

/// A pixel with straight alpha, as it looks over black.
pub(super) fn over_black([red, green, blue, alpha]: [u8; 4]) -> [u8; 3] {
    if alpha == 255 {
        return [red, green, blue];
    }
    let faded = |channel: u8| ((u16::from(channel) * u16::from(alpha) + 127) / 255) as u8;
    [red, green, blue].map(faded)
}
