//! A picture redrawn: for each pixel of the result, where to read.

use crate::imaging::Channel;
use crate::{Error, Result};
use image::{GrayImage, ImageBuffer, Pixel};
use nalgebra::{Matrix3, Point2};

/// For every pixel of a result, the place in a source picture that it is read from, or none.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelMap {
    width: u32,
    height: u32,
    /// (u, v) in the source; NaN where there is none.
    sources: Vec<[f32; 2]>,
}

impl PixelMap {
    /// The map that reads pixel (u, v) of the result from `source(u, v)`.
    pub fn from_fn(
        width: u32,
        height: u32,
        mut source: impl FnMut(u32, u32) -> Option<Point2<f64>>,
    ) -> Self {
        let mut sources = Vec::with_capacity(width as usize * height as usize);
        for v in 0..height {
            for u in 0..width {
                let place = source(u, v).map(|p| [p.x as f32, p.y as f32]);
                sources.push(place.unwrap_or([f32::NAN; 2]));
            }
        }
        Self {
            width,
            height,
            sources,
        }
    }

    /// The map of a homography, `out ~ H source`.
    ///
    /// * `out_from_source`: H, pixels to pixels, any scale
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::Degenerate`] if H has no inverse.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::stereo::PixelMap;
    /// use image::{GrayImage, Luma};
    /// use nalgebra::Matrix3;
    /// // One pixel to the right.
    /// let h = Matrix3::new(1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    /// let map = PixelMap::from_homography(3, 1, &h)?;
    /// let row = GrayImage::from_raw(3, 1, vec![10, 20, 30]).unwrap();
    /// assert_eq!(map.warp(&row).as_raw(), &[0, 10, 20]);
    /// # Ok(()) }
    /// ```
    pub fn from_homography(
        width: u32,
        height: u32,
        out_from_source: &Matrix3<f64>,
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
        Ok(Self::from_fn(width, height, |u, v| {
            let out = Point2::new(f64::from(u), f64::from(v));
            Point2::from_homogeneous(source_from_out * out.to_homogeneous())
        }))
    }

    /// Columns of the result.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the result.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The place in the source that (u, v) of the result is read from.
    pub fn source(&self, u: u32, v: u32) -> Option<Point2<f64>> {
        if u >= self.width || v >= self.height {
            return None;
        }
        let [x, y] = self.sources[v as usize * self.width as usize + u as usize];
        x.is_finite()
            .then(|| Point2::new(f64::from(x), f64::from(y)))
    }

    /// The redrawn image, bilinear, 0 where nothing is read.
    pub fn warp<P: Pixel<Subpixel: Channel>>(
        &self,
        source: &ImageBuffer<P, Vec<P::Subpixel>>,
    ) -> ImageBuffer<P, Vec<P::Subpixel>> {
        let num_channels = usize::from(P::CHANNEL_COUNT);
        let raw = source.as_raw();
        let mut values = Vec::with_capacity(num_channels * self.sources.len());
        for corners in self.corners(source.dimensions()) {
            for channel in 0..num_channels {
                let read = |pixel: usize| raw[num_channels * pixel + channel].to_float();
                let value = corners.as_ref().map_or(0.0, |corners| corners.mean(read));
                values.push(P::Subpixel::from_float(value));
            }
        }
        ImageBuffer::from_raw(self.width, self.height, values)
            .expect("every channel of every pixel of the map")
    }

    /// 255 where a picture of the given size is read, 0 elsewhere.
    pub fn mask(&self, source_width: u32, source_height: u32) -> GrayImage {
        let read = self.corners((source_width, source_height));
        let raw = read.map(|p| if p.is_some() { 255 } else { 0 }).collect();
        GrayImage::from_raw(self.width, self.height, raw)
            .expect("one value for every pixel of the map")
    }

    /// The pixels of the source around the place of each pixel; none outside the source's outermost
    /// pixel centers.
    fn corners(&self, (width, height): (u32, u32)) -> impl Iterator<Item = Option<Corners>> {
        let (last_u, last_v) = (width as f32 - 1.0, height as f32 - 1.0);
        let (columns, rows) = (width as usize, height as usize);
        // A border place computed with rounding still counts.
        let slack = 1e-3;
        self.sources.iter().map(move |&[x, y]| {
            // NaN compares as false.
            let inside = x >= -slack && y >= -slack && x <= last_u + slack && y <= last_v + slack;
            if !inside {
                return None;
            }
            let (x, y) = (x.max(0.0).min(last_u), y.max(0.0).min(last_v));
            let (u0, v0) = (x as usize, y as usize);
            let (u1, v1) = ((u0 + 1).min(columns - 1), (v0 + 1).min(rows - 1));
            Some(Corners {
                pixels: [(u0, v0), (u1, v0), (u0, v1), (u1, v1)].map(|(u, v)| v * columns + u),
                fraction: [x - u0 as f32, y - v0 as f32],
            })
        })
    }
}

/// Four neighboring pixels, and a place between them.
struct Corners {
    /// Indices row by row: top left, top right, bottom left, bottom right.
    pixels: [usize; 4],
    /// Offset from the top left, in [0, 1].
    fraction: [f32; 2],
}

impl Corners {
    /// The bilinear value.
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
        let map = PixelMap::from_fn(2, 1, |u, _| Some(Point2::new(f64::from(u) + 0.5, 0.0)));
        let gray = GrayImage::from_raw(2, 1, vec![10, 20]).unwrap();
        // The second reads beyond the last pixel center.
        assert_eq!(map.warp(&gray).as_raw(), &[15, 0]);
        assert_eq!(map.mask(2, 1).as_raw(), &[255, 0]);
        let float = ImageBuffer::<Luma<f32>, _>::from_raw(2, 1, vec![0.25, 0.75]).unwrap();
        assert_eq!(map.warp(&float).as_raw(), &[0.5, 0.0]);
        let rgb = RgbImage::from_fn(2, 1, |u, _| Rgb([u as u8 * 100, 7, 0]));
        assert_eq!(map.warp(&rgb).as_raw(), &[50, 7, 0, 0, 0, 0]);
    }

    #[test]
    fn places_without_a_source_stay_black() {
        let map = PixelMap::from_fn(2, 2, |u, v| (u == v).then(|| Point2::new(0.0, 0.0)));
        let gray = GrayImage::from_raw(1, 1, vec![9]).unwrap();
        assert_eq!(map.warp(&gray).as_raw(), &[9, 0, 0, 9]);
        assert_eq!(map.source(1, 0), None);
        assert_eq!(map.source(0, 7), None);
        let empty = GrayImage::new(0, 0);
        assert_eq!(map.warp(&empty).as_raw(), &[0; 4]);
    }

    #[test]
    fn bad_matrices_are_refused() {
        assert!(PixelMap::from_homography(4, 4, &Matrix3::zeros()).is_err());
        assert!(PixelMap::from_homography(4, 4, &(Matrix3::identity() * f64::NAN)).is_err());
    }
}
