//! A rectified pair of cameras in front of the long table, and its measurement of the ball.

use crate::kit::scenes::{self, PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera};
use epipole::stereo::{DepthInterval, depth_from_disparity, depth_interval};
use nalgebra::{Isometry3, Point2, Point3};

/// Disparity error that the figure illustrates, pixels.
pub(super) const ERROR_PX: f64 = 1.0;

/// Two parallel cameras side by side, and the ball's position to the right of the left camera and
/// away from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rig {
    pub(super) baseline_m: f64,
    pub(super) focal_px: f64,
    pub(super) x_m: f64,
    pub(super) z_m: f64,
}

/// Measurement from the two photographs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured {
    pub(super) disparity_px: f64,
    pub(super) depth_m: f64,
    pub(super) interval: DepthInterval,
}

/// Visibility of the ball's center in a photograph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sight {
    /// Visible.
    Clear,
    /// Hidden by the named object.
    Hidden(&'static str),
    /// Outside of the picture.
    Outside,
}

impl Rig {
    /// Returns the ball's center in the frame of the left camera, which is the world frame.
    pub(super) fn ball_in_world(&self) -> Point3<f64> {
        Point3::new(self.x_m, scenes::BALL_Y_M, self.z_m)
    }

    /// Returns the left and the right camera.
    pub(super) fn cameras(&self) -> Result<[PosedCamera; 2], Error> {
        let intrinsics = Intrinsics::centered(self.focal_px, PHOTO_WIDTH, PHOTO_HEIGHT)?;
        Ok([0.0, self.baseline_m].map(|x_m| PosedCamera {
            camera: Camera::pinhole(intrinsics, PHOTO_WIDTH, PHOTO_HEIGHT),
            cam_from_world: Isometry3::translation(-x_m, 0.0, 0.0),
        }))
    }

    /// Returns the pixels of the ball's center in the left and the right photograph.
    pub(super) fn pixels(&self) -> Result<[Point2<f64>; 2], Error> {
        let [left, right] = self.cameras()?;
        let ball = self.ball_in_world();
        Ok([left.project(&ball)?, right.project(&ball)?])
    }

    /// Computes disparity and depth from the two pixels only; `None` without a baseline.
    pub(super) fn measured(&self) -> Option<Measured> {
        let [left, right] = self.pixels().ok()?;
        let disparity_px = left.x - right.x;
        let (focal_px, baseline_m) = (self.focal_px, self.baseline_m);
        Some(Measured {
            disparity_px,
            depth_m: depth_from_disparity(focal_px, baseline_m, disparity_px).ok()?,
            interval: depth_interval(focal_px, baseline_m, disparity_px, ERROR_PX).ok()?,
        })
    }

    /// Returns the visibility of the ball's center in each photograph.
    pub(super) fn sights(&self) -> Result<[Sight; 2], Error> {
        let scene = scenes::long_table((self.x_m, self.z_m))?;
        let (cameras, pixels) = (self.cameras()?, self.pixels()?);
        let sight = |index: usize| {
            if !scenes::in_picture(&pixels[index]) {
                return Sight::Outside;
            }
            let center = cameras[index].center_in_world();
            let hit = scene.cast(&center, &(self.ball_in_world() - center));
            match hit {
                Some(hit) if hit.object != scenes::BALL => Sight::Hidden(hit.object),
                _ => Sight::Clear,
            }
        };
        Ok([sight(0), sight(1)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIG: Rig = Rig {
        baseline_m: 0.12,
        focal_px: 700.0,
        x_m: 0.362,
        z_m: 2.8,
    };

    #[test]
    fn the_worked_example_is_measured() {
        let [left, right] = RIG.pixels().unwrap();
        assert!((left.x - 410.0).abs() < 1e-9 && (right.x - 380.0).abs() < 1e-9);
        let measured = RIG.measured().unwrap();
        assert!((measured.disparity_px - 30.0).abs() < 1e-9);
        assert!((measured.depth_m - 2.8).abs() < 1e-9);
        // 84 / 31 and 84 / 29.
        assert!((measured.interval.near_m - 84.0 / 31.0).abs() < 1e-9);
        assert!((measured.interval.far_m.unwrap() - 84.0 / 29.0).abs() < 1e-9);
        assert_eq!(left.y, right.y, "rows are aligned");
        assert_eq!(RIG.sights(), Ok([Sight::Clear, Sight::Clear]));
    }

    #[test]
    fn the_interval_can_reach_infinity() {
        let rig = Rig {
            baseline_m: 0.01,
            focal_px: 400.0,
            x_m: 0.0,
            z_m: 8.0,
        };
        assert_eq!(rig.measured().unwrap().interval.far_m, None);
        let still = Rig {
            baseline_m: 0.0,
            ..rig
        };
        assert!(still.measured().is_none());
    }

    #[test]
    fn what_is_in_the_way_is_named() {
        let beside = Rig {
            baseline_m: 0.4,
            x_m: -0.3,
            z_m: 0.9,
            ..RIG
        };
        assert_eq!(beside.sights().unwrap()[1], Sight::Outside);
        let hidden = (8..100).any(|tenths| {
            let rig = Rig {
                x_m: 0.6,
                z_m: f64::from(tenths) / 10.0,
                ..RIG
            };
            matches!(rig.sights(), Ok([Sight::Hidden(_), _]))
        });
        assert!(hidden);
    }
}
