//! Layers of a picture: light with alpha, and putting one over another (Reeves 1983, 2.5: other
//! objects are composited with the particles' picture afterwards).

use super::{LinearImage, Picture, Rgba8Image};

impl Rgba8Image {
    /// Light on black becomes a layer with alpha: the brightest channel is how much of what is
    /// behind it hides, and over black it looks as before, to a step of 1/255.
    #[must_use]
    pub fn into_layer(self) -> Self {
        self.into_layer_hiding(&[])
    }

    /// As [`Rgba8Image::into_layer`], where something in it also covers: `hidden` is how much of what is
    /// behind each pixel that hides, 0 to 1, row by row; pixels that it does not reach hide nothing so.
    #[must_use]
    pub fn into_layer_hiding(mut self, hidden: &[f32]) -> Self {
        for (at, pixel) in self.pixels.chunks_exact_mut(4).enumerate() {
            let hidden = hidden.get(at).copied().unwrap_or(0.0).clamp(0.0, 1.0);
            let light = pixel[..3].iter().copied().max().unwrap_or(0);
            let alpha = light.max((hidden * 255.0 + 0.5) as u8);
            for channel in &mut pixel[..3] {
                // 255 c / alpha, to the nearest.
                let scaled = (u32::from(*channel) * 510 + u32::from(alpha))
                    .checked_div(2 * u32::from(alpha))
                    .unwrap_or(0);
                *channel = scaled as u8;
            }
            pixel[3] = alpha;
        }
        self
    }

    /// This picture with `layer` over it, alpha straight; both of one size.
    #[must_use]
    pub fn under(mut self, layer: &Self) -> Self {
        for (below, above) in self
            .pixels
            .chunks_exact_mut(4)
            .zip(layer.pixels.chunks_exact(4))
        {
            let [above_alpha, below_alpha] = [above[3], below[3]].map(|a| f64::from(a) / 255.0);
            let kept = below_alpha * (1.0 - above_alpha);
            let alpha = above_alpha + kept;
            for (low, high) in below[..3].iter_mut().zip(&above[..3]) {
                let sum = f64::from(*high) * above_alpha + f64::from(*low) * kept;
                *low = if alpha > 0.0 {
                    (sum / alpha + 0.5) as u8
                } else {
                    0
                };
            }
            below[3] = (alpha * 255.0 + 0.5) as u8;
        }
        self
    }
}

impl LinearImage {
    /// Light on black becomes a layer with alpha, premultiplied: the brightest channel, at most 1, is
    /// how much of what is behind it hides. The light itself stays as it is.
    #[must_use]
    pub fn into_layer(mut self) -> Self {
        self.is_layer = true;
        self
    }
}

impl Picture {
    /// Light on black becomes a layer with alpha.
    #[must_use]
    pub fn into_layer(self) -> Self {
        self.into_layer_hiding(Vec::new())
    }

    /// As [`Picture::into_layer`], where something in it also covers: `hidden` is how much of what is
    /// behind each pixel that hides, 0 to 1; one a pixel, or none at all.
    #[must_use]
    pub fn into_layer_hiding(self, hidden: Vec<f32>) -> Self {
        match self {
            Self::Bytes(image) => Self::Bytes(image.into_layer_hiding(&hidden)),
            Self::Linear(image) => Self::Linear(LinearImage {
                hidden,
                ..image.into_layer()
            }),
        }
    }
}
