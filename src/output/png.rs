//! One picture as a PNG: RGB where every pixel is opaque, else RGBA; 8 bits a channel, no ancillary chunks, so that equal
//! pictures are equal files.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;

use ::png::{BitDepth, ColorType, Compression, Decoder, DecodingError, Encoder, EncodingError};

use super::atomic::AtomicFile;
use super::{OutputError, Rgba8Image};

/// Writes a picture as a PNG, whole or not at all; folders that are missing above it are created.
///
/// # Errors
/// The user's fault: a size of 0 or one that does not fit the pixels, a path that cannot be a file. The machine's: it
/// cannot be written.
pub fn write_png(path: &Path, image: &Rgba8Image) -> Result<(), OutputError> {
    if !image.is_consistent() {
        return Err(OutputError::usage(
            path,
            format!(
                "a picture of {}×{} with {} bytes of pixels",
                image.width,
                image.height,
                image.pixels.len()
            ),
            "a picture has at least 1×1 pixels and 4 bytes a pixel",
        ));
    }
    let mut file = AtomicFile::create(path)?;
    let encoded = encode(&mut file, image);
    encoded.map_err(|error| file.error(error))?;
    file.commit()
}

/// Reads a picture that [`write_png`] wrote.
pub(crate) fn read_png(path: &Path) -> Result<Rgba8Image, OutputError> {
    let failed = |error: io::Error| OutputError::io(path, "read", error);
    let file = BufReader::new(File::open(path).map_err(failed)?);
    let decode = || {
        let mut reader = Decoder::new(file).read_info()?;
        let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
        let info = reader.next_frame(&mut bytes)?;
        bytes.truncate(info.buffer_size());
        Ok((info, bytes))
    };
    let (info, bytes) = decode().map_err(|error: DecodingError| failed(error.into()))?;
    let pixels = match info.color_type {
        ColorType::Rgba => bytes,
        _ => {
            let (pixels, _) = bytes.as_chunks::<3>();
            pixels
                .iter()
                .flat_map(|&[r, g, b]| [r, g, b, 255])
                .collect()
        }
    };
    let image = Rgba8Image {
        width: info.width,
        height: info.height,
        pixels,
    };
    if image.is_consistent() {
        Ok(image)
    } else {
        Err(failed(io::ErrorKind::InvalidData.into()))
    }
}

fn encode(file: impl Write, image: &Rgba8Image) -> io::Result<()> {
    let mut encoder = Encoder::new(file, image.width, image.height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    let (pixels, _) = image.pixels.as_chunks::<4>();
    if pixels.iter().all(|&[.., alpha]| alpha == 255) {
        encoder.set_color(ColorType::Rgb);
        let rgb: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        write_image(encoder, &rgb)
    } else {
        encoder.set_color(ColorType::Rgba);
        write_image(encoder, &image.pixels)
    }
}

fn write_image(encoder: Encoder<'_, impl Write>, bytes: &[u8]) -> io::Result<()> {
    let write = || {
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()
    };
    write().map_err(|error| match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    })
}
