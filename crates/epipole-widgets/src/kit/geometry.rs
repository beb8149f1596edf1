//! The epipolar geometry of two cameras that take photographs of the book's scenes.

use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::camera::{Camera, relative_motion};
use epipole::epipolar::{
    Epipole, epipolar_line1, epipolar_line2, epipoles, essential_from_motion,
    fundamental_from_cameras,
};
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2};

/// The epipolar geometry of two cameras.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Geometry {
    pub(crate) fundamental: Matrix3<f64>,
    pub(crate) essential: Matrix3<f64>,
    pub(crate) epipole1: Epipole,
    pub(crate) epipole2: Epipole,
}

impl Geometry {
    /// None while both cameras stand at the same place.
    pub(crate) fn of([first, second]: &[Camera; 2]) -> Option<Self> {
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        let fundamental = fundamental_from_cameras(first, second).ok()?;
        let (epipole1, epipole2) = epipoles(&fundamental).ok()?;
        Some(Self {
            fundamental,
            essential: essential_from_motion(&motion).ok()?,
            epipole1,
            epipole2,
        })
    }

    /// The epipolar line of a pixel of photograph 1; `None` for the epipole itself, too.
    pub(crate) fn line2(&self, pixel1: &Point2<f64>) -> Option<Line2> {
        epipolar_line2(&self.fundamental, pixel1).ok()
    }

    /// The line of photograph 1 through a pixel and the epipole: all its points share one line in
    /// photograph 2.
    pub(crate) fn line1(&self, pixel1: &Point2<f64>) -> Option<Line2> {
        let line2 = self.line2(pixel1)?;
        // Any point of the line in photograph 2 gives it, unless it is the epipole there.
        let center = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) * 0.5;
        let foot = line2.nearest(&center);
        let other = Point2::new(foot.x - 500.0 * line2.b, foot.y + 500.0 * line2.a);
        let nearness = |line: &Line2| line.signed_distance(pixel1).abs();
        [foot, other]
            .iter()
            .filter_map(|pixel2| epipolar_line1(&self.fundamental, pixel2).ok())
            .min_by(|a, b| nearness(a).total_cmp(&nearness(b)))
    }
}
