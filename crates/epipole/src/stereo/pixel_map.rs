//! Maps from the pixels of a result to positions in a source image.

use crate::imaging::Channel;
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use image::{GrayImage, ImageBuffer, Pixel};
use nalgebra::{Matrix3, Point2};

/// Position in a source image for every pixel of a result, if any.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelMap {
    width: u32,
    height: u32,
    /// (u, v) in the source; NaN if there is none.
    sources: Vec<[f32; 2]>,
}

impl PixelMap {
    /// Creates a map in which pixel (u, v) of the result is read from `source(u, v)`. The only
    /// stage is [`Stage::Warping`].
    ///
    /// # Errors
    /// [`Error::Canceled`].
    pub fn from_fn(
        width: u32,
        height: u32,
        source: impl Fn(u32, u32) -> Option<Point2<f64>> + Sync,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let row_len = width as usize;
        let mut sources = vec![[f32::NAN; 2]; row_len * height as usize];
        monitored::for_each_chunk(
            &mut sources,
            row_len,
            Stage::Warping,
            monitor,
            |first, row| {
                let v = (first / row_len) as u32;
                for (u, place) in (0..).zip(row) {
                    if let Some(p) = source(u, v) {
                        *place = [p.x as f32, p.y as f32];
                    }
                }
            },
        )?;
        Ok(Self {
            width,
            height,
            sources,
        })
    }

    /// Creates the map of a homography, `out ~ H source`. The only stage is [`Stage::Warping`].
    ///
    /// * `out_from_source`: H at any scale, pixels to pixels
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::Degenerate`] if H has no inverse, [`Error::Canceled`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::stereo::PixelMap;
    /// use image::{GrayImage, Luma};
    /// use nalgebra::Matrix3;
    /// // One pixel to the right.
    /// let h = Matrix3::new(1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    /// let map = PixelMap::from_homography(3, 1, &h, &mut ())?;
    /// let row = GrayImage::from_raw(3, 1, vec![10, 20, 30]).unwrap();
    /// assert_eq!(map.warp(&row, &mut ())?.as_raw(), &[0, 10, 20]);
    /// # Ok(()) }
    /// ```
    pub fn from_homography(
        width: u32,
        height: u32,
        out_from_source: &Matrix3<f64>,
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let scale = out_from_source.amax();
        if !out_from_source.iter().all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "every entry of the warp's matrix",
            });
        }
        let source_from_out = (scale > 0.0)
            .then(|| (out_from_source / scale).try_inverse())
            .flatten()
            .filter(|m| m.iter().all(|x| x.is_finite()))
            .ok_or(Error::Degenerate {
                what: "the warp's inverse",
                why: "its matrix maps the picture to a line or a point",
            })?;
        let source = |u, v| {
            let out = Point2::new(f64::from(u), f64::from(v));
            Point2::from_homogeneous(source_from_out * out.to_homogeneous())
        };
        Self::from_fn(width, height, source, monitor)
    }

    /// Returns the number of columns of the result.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows of the result.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the source position for (u, v) of the result.
    pub fn source(&self, u: u32, v: u32) -> Option<Point2<f64>> {
        if u >= self.width || v >= self.height {
            return None;
        }
        let [x, y] = self.sources[v as usize * self.width as usize + u as usize];
        x.is_finite()
            .then(|| Point2::new(f64::from(x), f64::from(y)))
    }

    /// Warps an image, bilinearly, 0 where nothing is read. The only stage is [`Stage::Warping`].
    ///
    /// # Errors
    /// [`Error::Canceled`].
    pub fn warp<P: Pixel<Subpixel: Channel>>(
        &self,
        source: &ImageBuffer<P, Vec<P::Subpixel>>,
        monitor: &mut dyn Monitor,
    ) -> Result<ImageBuffer<P, Vec<P::Subpixel>>> {
        let num_channels = usize::from(P::CHANNEL_COUNT);
        let (raw, size) = (source.as_raw(), source.dimensions());
        let row_len = num_channels * self.width as usize;
        let mut values = vec![P::Subpixel::from_float(0.0); num_channels * self.sources.len()];
        monitored::for_each_chunk(
            &mut values,
            row_len,
            Stage::Warping,
            monitor,
            |first, row| {
                let places = &self.sources[first / num_channels..];
                for (place, pixel) in places.iter().zip(row.chunks_exact_mut(num_channels)) {
                    let Some(corners) = Corners::around(place, size) else {
                        continue;
                    };
                    for (channel, value) in pixel.iter_mut().enumerate() {
                        let read = |pixel: usize| raw[num_channels * pixel + channel].to_float();
                        *value = P::Subpixel::from_float(corners.mean(read));
                    }
                }
            },
        )?;
        let image = ImageBuffer::from_raw(self.width, self.height, values);
        Ok(image.expect("every channel of every pixel of the map"))
    }

    /// Returns 255 where an image of the given size is read, 0 elsewhere.
    pub fn mask(&self, source_width: u32, source_height: u32) -> GrayImage {
        let size = (source_width, source_height);
        let is_read = |place: &[f32; 2]| Corners::around(place, size).is_some();
        let read = self.sources.iter().map(is_read);
        let raw = read.map(|is_read| if is_read { 255 } else { 0 }).collect();
        GrayImage::from_raw(self.width, self.height, raw)
            .expect("one value for every pixel of the map")
    }
}

/// Four neighboring pixels, and a position between them.
struct Corners {
    /// Indices row by row: top left, top right, bottom left, bottom right.
    pixels: [usize; 4],
    /// Offset from the top left, in [0, 1].
    fraction: [f32; 2],
}

impl Corners {
    /// Returns the pixels around a position in a source of the given size; `None` outside its
    /// outermost pixel centers.
    fn around(&[x, y]: &[f32; 2], (width, height): (u32, u32)) -> Option<Self> {
        let (last_u, last_v) = (width as f32 - 1.0, height as f32 - 1.0);
        let (columns, rows) = (width as usize, height as usize);
        // Allow for rounding errors at the border.
        let slack = 1e-3;
        // NaN compares as false.
        let inside = x >= -slack && y >= -slack && x <= last_u + slack && y <= last_v + slack;
        if !inside {
            return None;
        }
        let (x, y) = (x.max(0.0).min(last_u), y.max(0.0).min(last_v));
        let (u0, v0) = (x as usize, y as usize);
        let (u1, v1) = ((u0 + 1).min(columns - 1), (v0 + 1).min(rows - 1));
        Some(Self {
            pixels: [(u0, v0), (u1, v0), (u0, v1), (u1, v1)].map(|(u, v)| v * columns + u),
            fraction: [x - u0 as f32, y - v0 as f32],
        })
    }

    /// Interpolates bilinearly.
    fn mean(&self, read: impl Fn(usize) -> f32) -> f32 {
        let [p00, p10, p01, p11] = self.pixels.map(read);
        let [a, b] = self.fraction;
        let (top, bottom) = (p00 + a * (p10 - p00), p01 + a * (p11 - p01));
        top + b * (bottom - top)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Luma, Rgb, RgbImage};

    #[test]
    fn half_a_pixel_averages() {
        let map = PixelMap::from_fn(
            2,
            1,
            |u, _| Some(Point2::new(f64::from(u) + 0.5, 0.0)),
            &mut (),
        )
        .unwrap();
        let gray = GrayImage::from_raw(2, 1, vec![10, 20]).unwrap();
        // The second reads beyond the last pixel center.
        assert_eq!(map.warp(&gray, &mut ()).unwrap().as_raw(), &[15, 0]);
        assert_eq!(map.mask(2, 1).as_raw(), &[255, 0]);
        let float = ImageBuffer::<Luma<f32>, _>::from_raw(2, 1, vec![0.25, 0.75]).unwrap();
        assert_eq!(map.warp(&float, &mut ()).unwrap().as_raw(), &[0.5, 0.0]);
        let rgb = RgbImage::from_fn(2, 1, |u, _| Rgb([u as u8 * 100, 7, 0]));
        assert_eq!(
            map.warp(&rgb, &mut ()).unwrap().as_raw(),
            &[50, 7, 0, 0, 0, 0]
        );
    }

    #[test]
    fn places_without_a_source_stay_black() {
        let map = PixelMap::from_fn(
            2,
            2,
            |u, v| (u == v).then(|| Point2::new(0.0, 0.0)),
            &mut (),
        )
        .unwrap();
        let gray = GrayImage::from_raw(1, 1, vec![9]).unwrap();
        assert_eq!(map.warp(&gray, &mut ()).unwrap().as_raw(), &[9, 0, 0, 9]);
        assert_eq!(map.source(1, 0), None);
        assert_eq!(map.source(0, 7), None);
        let empty = GrayImage::new(0, 0);
        assert_eq!(map.warp(&empty, &mut ()).unwrap().as_raw(), &[0; 4]);
    }

    #[test]
    fn bad_matrices_are_refused() {
        assert!(PixelMap::from_homography(4, 4, &Matrix3::zeros(), &mut ()).is_err());
        assert!(
            PixelMap::from_homography(4, 4, &(Matrix3::identity() * f64::NAN), &mut ()).is_err()
        );
    }
}
