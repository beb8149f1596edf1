//! Cache of scaled photographs: most frames show the same ones at the same positions, and copying
//! takes a fraction of the time.

use image::RgbImage;
use std::ops::Range;

/// Device pixels covered by a photograph.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Target {
    /// Requested left, top, right and bottom, possibly beyond the picture.
    pub(super) requested: [i64; 4],
    /// Columns of the picture within these sides.
    pub(super) columns: Range<usize>,
    /// Rows of the picture within these sides.
    pub(super) rows: Range<usize>,
}

/// Cache key: photograph and target.
#[derive(PartialEq)]
struct Key {
    fingerprint: u64,
    size: (u32, u32),
    target: Target,
}

struct CachedImage {
    key: Key,
    /// RGBA bytes of the target; empty until the second frame, since a photograph that changes in
    /// every frame is not worth caching.
    pixels: Vec<u8>,
    is_shown: bool,
}

/// Photographs of the last frame.
#[derive(Default)]
pub(super) struct Scaled(Vec<CachedImage>);

impl Scaled {
    /// Copies the photograph into the picture if it is cached, or else calls `scale` to draw it
    /// there.
    ///
    /// * `picture`: RGBA bytes, with `stride` bytes per row
    pub(super) fn draw(
        &mut self,
        photo: &RgbImage,
        target: Target,
        (picture, stride): (&mut [u8], usize),
        scale: impl FnOnce(&mut [u8]),
    ) {
        let key = Key {
            fingerprint: fingerprint(photo),
            size: photo.dimensions(),
            target,
        };
        let Some(cached) = self.0.iter_mut().find(|cached| cached.key == key) else {
            scale(picture);
            return self.0.push(CachedImage {
                key,
                pixels: Vec::new(),
                is_shown: true,
            });
        };
        cached.is_shown = true;
        let Target { columns, rows, .. } = &cached.key.target;
        let length = columns.len() * 4;
        let places = rows.clone().map(|row| row * stride + columns.start * 4);
        if cached.pixels.is_empty() {
            scale(picture);
            places.for_each(|start| cached.pixels.extend(&picture[start..][..length]));
        } else {
            for (start, pixels) in places.zip(cached.pixels.chunks_exact(length)) {
                picture[start..][..length].copy_from_slice(pixels);
            }
        }
    }

    /// Returns the cache for the next frame: only the photographs shown in this one.
    pub(super) fn after_frame(mut self) -> Self {
        self.0
            .retain_mut(|cached| std::mem::take(&mut cached.is_shown));
        self
    }
}

/// Hashes a photograph, in about 0.05 ms.
fn fingerprint(photo: &RgbImage) -> u64 {
    let mix = |hash: u64, word: &[u8; 8]| {
        let product = (hash ^ u64::from_le_bytes(*word)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        product ^ (product >> 32)
    };
    let (words, rest) = photo.as_raw().as_chunks::<8>();
    // Four independent chains, as each multiplication waits for the previous one.
    let (fours, last) = words.as_chunks::<4>();
    let mut hashes = [0, 1, 2, 3];
    for four in fours {
        for (hash, word) in hashes.iter_mut().zip(four) {
            *hash = mix(*hash, word);
        }
    }
    let mut end = [0; 8];
    end[..rest.len()].copy_from_slice(rest);
    let hashes = hashes.map(u64::to_le_bytes);
    let others = hashes.iter().chain(last).chain([&end]);
    others.fold(0, mix)
}

#[cfg(test)]
mod tests {
    use crate::Rect;
    use crate::canvas::{Canvas, Picture};
    use crate::theme::Theme;
    use image::{Rgb, RgbImage};

    fn frame(buffer: Picture, photos: &[&RgbImage], width: f64) -> Picture {
        let mut canvas = Canvas::new(90.0, 40.0, 1.0, Theme::Light, buffer).unwrap();
        for (index, photo) in photos.iter().enumerate() {
            let x = 45.0 * index as f64 - 3.0;
            canvas.photograph(Rect::new(x, 2.0, width, 30.0), photo);
        }
        canvas.finish()
    }

    #[test]
    fn frames_are_the_same_with_and_without_memory() {
        let one = RgbImage::from_fn(20, 15, |u, v| Rgb([u as u8 * 9, v as u8 * 7, 90]));
        let mut other = one.clone();
        other.put_pixel(19, 14, Rgb([1, 2, 3]));
        let shows: [(&[&RgbImage], f64); 8] = [
            (&[&one, &other], 40.0),
            (&[&one, &other], 40.0),
            (&[&one, &other], 40.0),
            (&[&other, &one], 40.0),
            (&[&other], 33.0),
            (&[&other], 33.0),
            (&[&other], 33.0),
            (&[&one], 33.0),
        ];
        let mut picture = Picture::default();
        for (photos, width) in shows {
            let fresh = frame(Picture::default(), photos, width).hash();
            picture = frame(picture, photos, width);
            assert_eq!(picture.hash(), fresh);
        }
        assert_eq!(picture.scaled.0.len(), 1, "only what is shown is kept");
    }

    #[test]
    fn what_stays_is_copied() {
        let photo = RgbImage::from_pixel(8, 6, Rgb([10, 20, 30]));
        let mut picture = Picture::default();
        for _ in 0..3 {
            picture = frame(picture, &[&photo], 40.0);
        }
        let cached = &mut picture.scaled.0[0].pixels;
        assert_eq!(
            cached.len(),
            37 * 30 * 4,
            "without what hangs over the edge"
        );
        cached.fill(7);
        picture = frame(picture, &[&photo], 40.0);
        let start = (2 * 90) * 4;
        assert_eq!(picture.rgba()[start..start + 4], [7; 4]);
    }
}
