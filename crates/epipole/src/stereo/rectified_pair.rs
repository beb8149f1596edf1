//! Images warped by a rectified rig, and their disparities.

use super::{DisparityImage, PixelMap, Rectification, fill_gaps};
use crate::imaging::rgb_to_gray;
use crate::math::order::at_rank;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use image::{GrayImage, RgbImage};
use nalgebra::{Point2, Point3, Vector4};

/// Width of the border of an image, pixels, whose disparities are not trusted: edges match each
/// other.
const EDGE_PX: f64 = 6.0;
/// Minimum number of points to determine the range of disparities.
const MIN_POINTS: usize = 8;
/// Fraction of points below and above the range, which may be outliers.
const WRONG: f64 = 0.02;
/// Margin of the range on either side, as surfaces continue beyond the points: pixels, and a
/// fraction of the range.
const BEYOND: (f64, f64) = (2.0, 0.15);

impl Rectification {
    /// Returns the pixel of the first rectified image that shows a point, and the disparity of the
    /// point, pixels. `None` if the point is not in front of the camera.
    ///
    /// * `place`: the point in the frame of the first camera, in the unit of the baseline
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Intrinsics, RigidTransform};
    /// use epipole::stereo::{RectifyOptions, rectify_calibrated};
    /// use nalgebra::Point3;
    /// let camera = Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480);
    /// let cam2_from_cam1 = RigidTransform::translation(-0.1, 0.0, 0.0);
    /// let rig = rectify_calibrated(&[camera, camera], &cam2_from_cam1, &RectifyOptions::default())?;
    /// let (pixel, disparity) = rig.disparity_of(&Point3::new(0.0, 0.0, 2.0)).unwrap();
    /// assert!((pixel.x - 319.5).abs() < 1e-6 && (disparity - 500.0 * 0.1 / 2.0).abs() < 1e-6);
    /// # Ok(()) }
    /// ```
    pub fn disparity_of(&self, place: &Point3<f64>) -> Option<(Point2<f64>, f64)> {
        let rotated = self.rect_from_cam[0] * place;
        if rotated.z.is_nan() || rotated.z <= 0.0 {
            return None;
        }
        let from_space = self.q.try_inverse()?;
        let [u, v, d, w] = (from_space * Vector4::from(rotated.to_homogeneous())).into();
        let found = [u / w, v / w, d / w];
        let is_finite = found.iter().all(|x| x.is_finite());
        is_finite.then(|| (Point2::new(found[0], found[1]), found[2]))
    }

    /// Returns the minimum and maximum disparity to search, pixels: those of nearly all points,
    /// with a margin, since surfaces continue beyond the points, but not past infinity.
    ///
    /// * `places`: points that both images show, in the frame of the first camera
    ///
    /// # Errors
    /// [`Error::TooFew`] if the first image shows fewer than eight of them.
    pub fn disparity_range(&self, places: &[Point3<f64>]) -> Result<[i32; 2]> {
        let sides = [f64::from(self.width), f64::from(self.height)];
        let inside =
            |pixel: &Point2<f64>| (0..2).all(|axis| (0.0..sides[axis]).contains(&pixel[axis]));
        let projected = places.iter().filter_map(|place| self.disparity_of(place));
        let disparities =
            projected.filter_map(|(pixel, disparity)| inside(&pixel).then_some(disparity));
        let axis = usize::from(self.is_vertical);
        let center = |index: usize| self.intrinsics[index].principal_point()[axis];
        range_of(disparities.collect(), center(0) - center(1))
    }
}

/// * `at_infinity`: disparity of points at infinity, pixels
fn range_of(mut disparities: Vec<f64>, at_infinity: f64) -> Result<[i32; 2]> {
    if disparities.len() < MIN_POINTS {
        return Err(Error::TooFew {
            what: "a range of disparities from points visible in both images",
            needed: MIN_POINTS,
            got: disparities.len(),
        });
    }
    let last = (disparities.len() - 1) as f64;
    let mut at = |fraction: f64| at_rank(&mut disparities, (fraction * last).round() as usize);
    let (low, high) = (at(WRONG), at(1.0 - WRONG));
    let room = BEYOND.0 + BEYOND.1 * (high - low);
    let (mut first, mut end) = ((low - room).floor(), (high + room).ceil());
    if low >= at_infinity {
        first = first.max(at_infinity.floor());
    }
    if high <= at_infinity {
        end = end.min(at_infinity.ceil());
    }
    // A saturating cast; a single disparity would have no neighbors.
    let (first, end) = (first as i32, end as i32);
    Ok([first, end.max(first.saturating_add(1))])
}

/// Images of a rig, rectified.
///
/// With [`RectifyOptions::alpha`](super::RectifyOptions::alpha) of 1, the results have empty
/// borders. Borders match each other perfectly, so disparities there, and those whose match is
/// there, are removed. For a vertical rig the images are transposed before matching.
#[derive(Debug, Clone)]
pub struct RectifiedPair {
    rig: Rectification,
    pictures: [RgbImage; 2],
    /// Pixels of the first result with image content.
    shown: Vec<bool>,
    /// Pixels of each result with image content, at some distance from its edge.
    trusted: [Vec<bool>; 2],
}

impl RectifiedPair {
    /// Rectifies two images.
    ///
    /// * `images`: images with the sizes of the rig's intrinsics, pixels
    ///
    /// The only stage is [`Stage::Warping`](crate::progress::Stage::Warping).
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for images of different size, [`Error::Canceled`].
    pub fn new(
        rig: &Rectification,
        images: [&RgbImage; 2],
        monitor: &mut dyn Monitor,
    ) -> Result<Self> {
        let sizes = images.map(RgbImage::dimensions);
        for (what, first, second) in [
            ("the rows of the two images", sizes[0].0, sizes[1].0),
            ("the columns of the two images", sizes[0].1, sizes[1].1),
        ] {
            if first != second {
                return Err(Error::SizeMismatch {
                    what,
                    first: first as usize,
                    second: second as usize,
                });
            }
        }
        let maps = [
            rig.map(0, &mut Part::new(monitor, 0.0, 0.3))?,
            rig.map(1, &mut Part::new(monitor, 0.3, 0.6))?,
        ];
        let [first, second] = images;
        let pictures = [
            maps[0].warp(first, &mut Part::new(monitor, 0.6, 0.7))?,
            maps[1].warp(second, &mut Part::new(monitor, 0.7, 0.8))?,
        ];
        // Each takes about as long as a warp.
        report(monitor, Stage::Warping, 0.8)?;
        let shown = source_mask(&maps[0], sizes[0], 0.0);
        report(monitor, Stage::Warping, 0.9)?;
        Ok(Self {
            rig: rig.clone(),
            pictures,
            shown,
            trusted: maps.map(|map| source_mask(&map, sizes[0], EDGE_PX)),
        })
    }

    /// Returns the rectified images, black outside the image content.
    pub fn pictures(&self) -> &[RgbImage; 2] {
        &self.pictures
    }

    /// Returns the number of pixels of the first result with image content.
    pub fn num_shown(&self) -> usize {
        self.shown.iter().filter(|is_shown| **is_shown).count()
    }

    /// Computes the disparities of the first image, pixels, along the columns if the rig is
    /// vertical.
    ///
    /// * `matching`: matcher of two gray images whose matches share a row, such as
    ///   [`StereoSgm::compute`](super::StereoSgm::compute)
    ///
    /// # Errors
    /// As `matching`.
    pub fn disparity(
        &self,
        matching: impl FnOnce(&GrayImage, &GrayImage) -> Result<DisparityImage>,
    ) -> Result<DisparityImage> {
        let [first, second] =
            [0, 1].map(|index| self.along_rows(&rgb_to_gray(&self.pictures[index])));
        let found = self.transposed_if_vertical(&matching(&first, &second)?);
        Ok(self.masked(&found, |index, disparity| self.is_within(index, disparity)))
    }

    /// Computes disparities for every pixel with image content, by [`fill_gaps`] and with its
    /// stage.
    ///
    /// # Errors
    /// As [`fill_gaps`].
    pub fn filled(
        &self,
        disparity: &DisparityImage,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let first = self.along_rows(&rgb_to_gray(&self.pictures[0]));
        let filled = self.transposed_if_vertical(&fill_gaps(
            &self.transposed_if_vertical(disparity),
            &first,
            monitor,
        )?);
        Ok(self.masked(&filled, |index, _| self.shown[index]))
    }

    /// Returns whether a pixel of the first image and its match both have image content.
    fn is_within(&self, index: usize, disparity: f32) -> bool {
        let (width, height) = (i64::from(self.rig.width), i64::from(self.rig.height));
        let (u, v) = (index as i64 % width, index as i64 / width);
        let steps = disparity.round() as i64;
        let (u, v) = match self.rig.is_vertical {
            true => (u, v - steps),
            false => (u - steps, v),
        };
        let is_in_picture = (0..width).contains(&u) && (0..height).contains(&v);
        self.trusted[0][index] && is_in_picture && self.trusted[1][(v * width + u) as usize]
    }

    fn masked(
        &self,
        found: &DisparityImage,
        is_valid: impl Fn(usize, f32) -> bool,
    ) -> DisparityImage {
        let mut masked = found.clone();
        for (index, value) in masked.values_mut().iter_mut().enumerate() {
            if !is_valid(index, *value) {
                *value = f32::NAN;
            }
        }
        masked
    }

    /// Transposes an image of a vertical rig, so that its matches share a row.
    fn along_rows(&self, picture: &GrayImage) -> GrayImage {
        match self.rig.is_vertical {
            true => GrayImage::from_fn(picture.height(), picture.width(), |u, v| {
                *picture.get_pixel(v, u)
            }),
            false => picture.clone(),
        }
    }

    /// Transposes disparities of a vertical rig, in either direction.
    fn transposed_if_vertical(&self, disparity: &DisparityImage) -> DisparityImage {
        match self.rig.is_vertical {
            true => disparity.transposed(),
            false => disparity.clone(),
        }
    }
}

/// Returns which pixels of a rectified image are read from an image of this size, at least this far
/// from its edge.
fn source_mask(map: &PixelMap, (width, height): (u32, u32), edge_px: f64) -> Vec<bool> {
    let inside = |at: f64, side: u32| (edge_px..=f64::from(side) - 1.0 - edge_px).contains(&at);
    let is_filled = |(u, v)| {
        let source = map.source(u, v);
        source.is_some_and(|place| inside(place.x, width) && inside(place.y, height))
    };
    let pixels = (0..map.height()).flat_map(|v| (0..map.width()).map(move |u| (u, v)));
    pixels.map(is_filled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_all_points_are_within_the_range_and_few_propose_none() {
        let disparities: Vec<f64> = (0..=100).map(|n| 40.0 + 0.2 * f64::from(n)).collect();
        let [low, high] = range_of(disparities.clone(), 0.0).unwrap();
        assert!(
            (33..=39).contains(&low) && (61..=67).contains(&high),
            "{low} {high}"
        );
        // A single outlier does not widen the range, and disparities past infinity are not
        // searched.
        let mut with_outlier = disparities.clone();
        with_outlier.push(4000.0);
        assert_eq!(range_of(with_outlier, 0.0).unwrap(), [low, high]);
        let mirrored = disparities.iter().map(|d| -d).collect();
        assert_eq!(range_of(mirrored, 0.0).unwrap(), [-high, -low]);
        assert_eq!(range_of(vec![0.5; 9], 0.0).unwrap(), [0, 3]);
        assert_eq!(range_of(vec![-0.5; 9], 0.0).unwrap(), [-3, 0]);
        assert_eq!(range_of(vec![0.0; 9], 0.0).unwrap(), [0, 1]);
        assert!(matches!(
            range_of(vec![3.0; 7], 0.0),
            Err(Error::TooFew { got: 7, .. })
        ));
    }
}
