//! Keypoints of an image.

use nalgebra::Point2;

/// A keypoint: a detected position in an image with its scale, direction and response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keypoint {
    /// Column, pixels; pixel centers are at integers.
    pub u: f64,
    /// Row, pixels; pixel centers are at integers.
    pub v: f64,
    /// Standard deviation of the blur at detection, pixels of the image; 1 for detectors without
    /// scale.
    pub scale_px: f32,
    /// Direction, `atan2(v, u)` with v down, in (−π, π]; 0 for detectors without orientation.
    pub angle_rad: f32,
    /// Response of the detector; larger is better.
    pub response: f32,
    /// Octave or level of the pyramid.
    pub octave: i32,
}

impl Keypoint {
    /// Returns the position.
    ///
    /// ```
    /// use epipole::feature::Keypoint;
    /// assert_eq!(Keypoint::at(3.0, 4.0, 1.0).point(), nalgebra::Point2::new(3.0, 4.0));
    /// ```
    pub fn point(&self) -> Point2<f64> {
        Point2::new(self.u, self.v)
    }

    /// Creates a keypoint without scale or direction.
    ///
    /// ```
    /// let keypoint = epipole::feature::Keypoint::at(3.0, 4.0, 0.5);
    /// assert_eq!((keypoint.scale_px, keypoint.angle_rad), (1.0, 0.0));
    /// ```
    pub fn at(u: f64, v: f64, response: f32) -> Self {
        Self {
            u,
            v,
            scale_px: 1.0,
            angle_rad: 0.0,
            response,
            octave: 0,
        }
    }
}
