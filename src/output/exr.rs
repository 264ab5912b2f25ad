//! One picture as an OpenEXR file: linear RGBA in 32-bit floats, 16 rows a block, deflated; with the
//! sRGB primaries and no date, so that equal pictures are equal files.

use std::io::Cursor;
use std::path::Path;

use ::exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels,
    Text, Vec2, WritableImage, attribute::Chromaticities,
};

use super::folder::write_whole;
use super::{LinearImage, OutputError};

/// Primaries and white of sRGB (ITU-R BT.709, D65).
const SRGB: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Writes a picture as an EXR, whole or not at all; folders that are missing above it are created.
///
/// # Errors
/// The user's fault: a size of 0 or one that does not fit the pixels, a path that cannot be a file. The machine's: it
/// cannot be written.
pub fn write_exr(path: &Path, image: &LinearImage) -> Result<(), OutputError> {
    if !image.is_consistent() {
        return Err(OutputError::usage(
            path,
            format!(
                "a picture of {}×{} with {} linear values",
                image.width,
                image.height,
                image.pixels.len()
            ),
            "a picture has at least 1×1 pixels and 3 values a pixel",
        ));
    }
    let bytes = encode(image).map_err(|error| {
        // It is written to memory, so that only a picture too large for the format can fail.
        OutputError::usage(path, format!("no EXR: {error}"), "give a smaller picture")
    })?;
    write_whole(path, &bytes)
}

fn encode(image: &LinearImage) -> ::exr::error::Result<Vec<u8>> {
    let (width, height) = (image.width as usize, image.height as usize);
    let (pixels, _) = image.pixels.as_chunks::<3>();
    let channels = SpecificChannels::rgba(|Vec2(x, y): Vec2<usize>| {
        let [red, green, blue] = pixels[y * width + x];
        let alpha = if image.is_layer {
            let hidden = image.hidden.get(y * width + x).copied().unwrap_or(0.0);
            red.max(green).max(blue).max(hidden).min(1.0)
        } else {
            1.0
        };
        (red, green, blue, alpha)
    });
    let attributes = LayerAttributes {
        comments: text(&image.comment),
        software_name: text("motes"),
        ..LayerAttributes::default()
    };
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let mut file = Image::from_layer(Layer::new((width, height), attributes, encoding, channels));
    file.attributes.chromaticities = Some(SRGB);
    let mut bytes = Cursor::new(Vec::new());
    file.write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// Header texts are ASCII; what is not becomes `?`. None where there is nothing to say.
fn text(words: &str) -> Option<Text> {
    let ascii = |c: char| if c.is_ascii() { c } else { '?' };
    let plain: String = words.chars().map(ascii).collect();
    (!plain.is_empty()).then(|| Text::from(plain.as_str()))
}
