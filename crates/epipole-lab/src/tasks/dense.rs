//! A rectified pair with its disparities.

use super::camera_found::CameraFound;
use crate::project::Blob;
use serde::{Deserialize, Serialize};

/// A rectified pair and its disparities. The first image is the left one or, for a vertical pair,
/// the upper one; its points are further left, or further up, in the second image.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Dense {
    /// Width of both images, pixels.
    pub width: u32,
    /// Height of both images, pixels.
    pub height: u32,
    /// Factor by which photographs were downscaled: 1, 2, 4 and so on.
    pub factor: u32,
    /// Whether matches share a column instead of a row.
    pub is_vertical: bool,
    /// Whether the first image belongs to the second photograph.
    pub is_swapped: bool,
    /// Camera of the first image, without distortion.
    pub camera: CameraFound,
    /// Distance of the cameras, units of the reconstruction.
    pub baseline: f64,
    /// Disparity range given by the sparse points, pixels of the photographs.
    pub proposed_px: Option<[i32; 2]>,
    /// Disparity range that was searched.
    pub range_px: [i32; 2],
    /// Number of pixels of the first image that its photograph covers; rotation leaves a border.
    pub num_shown: u32,
    /// Fraction of them with a disparity.
    pub density: f64,
    /// Disparities of the first image, in its pixels, NaN for none; four bytes each, little-endian.
    pub disparity: Blob,
    /// First image: red, green, blue, row by row.
    pub left: Blob,
    /// Second image, in the same format.
    pub right: Blob,
}

impl Dense {
    /// Whether there are as many disparities and colors as pixels.
    pub fn is_whole(&self) -> bool {
        let pixels = u64::from(self.width) * u64::from(self.height);
        let has = |bytes: &Blob, each: u64| pixels.checked_mul(each) == Some(bytes.len() as u64);
        has(&self.disparity, 4) && has(&self.left, 3) && has(&self.right, 3)
    }

    /// Returns the disparity of a pixel of the first image, pixels; `None` without one.
    pub fn disparity(&self, u: u32, v: u32) -> Option<f32> {
        if u >= self.width || v >= self.height {
            return None;
        }
        let at = 4 * (v as usize * self.width as usize + u as usize);
        let bytes: [u8; 4] = self.disparity.get(at..at + 4)?.try_into().ok()?;
        Some(f32::from_le_bytes(bytes)).filter(|d| d.is_finite())
    }

    /// Returns the depth of a pixel along the axis of the first image's camera, `Z = f B / d`, in
    /// units of the reconstruction. `None` without a disparity, and at infinity.
    pub fn depth(&self, u: u32, v: u32) -> Option<f64> {
        let disparity = f64::from(self.disparity(u, v)?);
        let depth = self.focal_px() * self.baseline / disparity;
        (disparity > 0.0 && depth.is_finite()).then_some(depth)
    }

    /// Returns the focal length along which disparities are measured, pixels.
    pub fn focal_px(&self) -> f64 {
        self.camera.intrinsics[usize::from(self.is_vertical)]
    }

    /// Returns the matching pixel in the second image.
    pub fn matched(&self, u: u32, v: u32) -> Option<[f64; 2]> {
        let disparity = f64::from(self.disparity(u, v)?);
        let (u, v) = (f64::from(u), f64::from(v));
        Some(match self.is_vertical {
            true => [u, v - disparity],
            false => [u - disparity, v],
        })
    }

    /// Returns every n-th pixel along rows and columns that has a depth, with the depth.
    pub fn deep_pixels(&self, every: u32) -> impl Iterator<Item = ([u32; 2], f64)> {
        let step = every.max(1) as usize;
        let rows = (0..self.height).step_by(step);
        let pixels = rows.flat_map(move |v| (0..self.width).step_by(step).map(move |u| [u, v]));
        pixels.filter_map(|[u, v]| Some(([u, v], self.depth(u, v)?)))
    }

    /// Returns the points of these pixels in the frame of the reconstruction, with their colors.
    pub fn points(&self, every: u32) -> impl Iterator<Item = ([f64; 3], [u8; 3])> {
        let (center, ray) = (self.camera.center(), self.camera.rays());
        self.deep_pixels(every).filter_map(move |([u, v], depth)| {
            let place = center + ray([f64::from(u), f64::from(v)]) * depth;
            let at = 3 * (v as usize * self.width as usize + u as usize);
            let color = self.left.get(at..at + 3)?.try_into().ok()?;
            Some((place.coords.into(), color))
        })
    }

    /// Returns the depth range of all pixels without the nearest and the farthest percent; `None`
    /// without any.
    pub fn depth_range(&self) -> Option<[f64; 2]> {
        let pixels = (0..self.height).flat_map(|v| (0..self.width).map(move |u| (u, v)));
        let mut depths: Vec<f64> = pixels.filter_map(|(u, v)| self.depth(u, v)).collect();
        let last = depths.len().checked_sub(1)?;
        let mut at = |share: f64| {
            let place = (share * last as f64).round() as usize;
            *depths.select_nth_unstable_by(place, f64::total_cmp).1
        };
        Some([at(0.01), at(0.99)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dense(is_vertical: bool) -> Dense {
        let disparity = [2.0_f32, f32::NAN, 0.0, 4.0];
        Dense {
            width: 2,
            height: 2,
            factor: 1,
            is_vertical,
            is_swapped: false,
            camera: CameraFound {
                intrinsics: [100.0, 50.0, 0.0, 0.0],
                rotation: [0.0, 0.0, 0.0, 1.0],
                translation: [0.0, 0.0, 0.0],
            },
            baseline: 0.1,
            proposed_px: None,
            range_px: [0, 4],
            num_shown: 4,
            density: 0.75,
            disparity: disparity
                .iter()
                .flat_map(|d| d.to_le_bytes())
                .collect::<Vec<u8>>()
                .into(),
            left: (0..12).collect::<Vec<u8>>().into(),
            right: vec![0; 12].into(),
        }
    }

    #[test]
    fn depth_is_focal_length_times_baseline_over_disparity() {
        let pair = dense(false);
        assert_eq!(pair.depth(0, 0), Some(5.0));
        assert_eq!(pair.depth(1, 0), None);
        assert_eq!(pair.depth(0, 1), None, "that is infinitely far");
        assert_eq!(pair.depth(1, 1), Some(2.5));
        assert_eq!(pair.depth(2, 0), None);
        assert_eq!(pair.matched(1, 1), Some([-3.0, 1.0]));
        assert_eq!(dense(true).matched(1, 1), Some([1.0, -3.0]));
        assert_eq!(dense(true).depth(0, 0), Some(2.5));
        let points: Vec<_> = pair.points(1).collect();
        assert_eq!(
            points,
            [
                ([0.0, 0.0, 5.0], [0, 1, 2]),
                ([0.025, 0.05, 2.5], [9, 10, 11])
            ]
        );
        assert_eq!(pair.points(2).count(), 1);
        assert_eq!(pair.depth_range(), Some([2.5, 5.0]));
    }
}
