//! Two cameras before the still life: their epipolar geometry, and where one sees what the other sees.

use crate::kit::scenes::{self, PHOTO_SIZE, in_picture};
use epipole::camera::Camera;
use epipole::synthetic::Transfer;
use nalgebra::Point2;

/// Where a point of photograph 1 is in photograph 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Match {
    /// There it is.
    Visible(Point2<f64>),
    /// It would be there, but this hides it.
    Hidden(Point2<f64>, &'static str),
    /// It would be beyond the picture's edge.
    Outside(Point2<f64>),
    /// Camera 2 has gone past it.
    Behind,
    /// Camera 1 sees nothing there.
    Nothing,
}

impl Match {
    /// The pixel of photograph 2, inside the picture or not, hidden or not.
    pub(super) fn pixel(self) -> Option<Point2<f64>> {
        match self {
            Self::Visible(pixel) | Self::Hidden(pixel, _) | Self::Outside(pixel) => Some(pixel),
            Self::Behind | Self::Nothing => None,
        }
    }
}

/// Where a pixel of the first camera is in the picture of the second, by the scene's exact depth.
pub(super) fn find_match([first, second]: &[Camera; 2], pixel1: &Point2<f64>) -> Match {
    match scenes::still_life().transfer(first, second, pixel1) {
        Transfer::Visible { pixel2, .. } | Transfer::Occluded { pixel2, .. }
            if !in_picture(&pixel2) =>
        {
            Match::Outside(pixel2)
        }
        Transfer::Visible { pixel2, .. } => Match::Visible(pixel2),
        Transfer::Occluded { pixel2, by, .. } => Match::Hidden(pixel2, by),
        Transfer::BehindCamera { .. } => Match::Behind,
        Transfer::Nothing => Match::Nothing,
    }
}

/// The two cameras, the second moved in the first one's own horizontal plane.
///
/// * `right_m`, `forward_m`, `left_deg`: where the second stands in the frame of the first, and how
///   far it is turned to the left
pub(super) fn cameras((right_m, forward_m, left_deg): (f64, f64, f64)) -> [Camera; 2] {
    scenes::still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::geometry::Geometry;
    use epipole::epipolar::{Epipole, sampson_px};

    const POINTS: [(f64, f64); 3] = [(216.0, 60.0), (332.0, 130.0), (300.0, 410.0)];

    #[test]
    fn every_match_is_on_its_line() {
        for motion in [(0.5, -0.4, 14.0), (0.1, 0.4, 0.0), (0.8, 0.0, 30.0)] {
            let cameras = cameras(motion);
            let geometry = Geometry::of(&cameras).unwrap();
            for (u, v) in POINTS {
                let point = Point2::new(u, v);
                let Some(pixel2) = find_match(&cameras, &point).pixel() else {
                    continue;
                };
                let line = geometry.line2(&point).unwrap();
                assert!(line.signed_distance(&pixel2).abs() < 1e-6);
                assert!(sampson_px(&geometry.fundamental, &point, &pixel2) < 1e-6);
                let line1 = geometry.line1(&point).unwrap();
                assert!(line1.signed_distance(&point).abs() < 1e-6);
                // E constrains rays as F constrains pixels.
                let [ray1, ray2] = [
                    cameras[0].intrinsics.ray(&point),
                    cameras[1].intrinsics.ray(&pixel2),
                ];
                assert!(ray2.dot(&(geometry.essential * ray1)).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_epipole_is_camera_1_seen_by_camera_2() {
        let cameras = cameras((0.5, -0.4, 14.0));
        let seen = cameras[1].project(&cameras[0].center_in_world()).unwrap();
        let Epipole::Finite(pixel) = Geometry::of(&cameras).unwrap().epipole2 else {
            panic!("it is finite");
        };
        assert!((pixel - seen).norm() < 1e-6);
    }

    #[test]
    fn turned_left_means_that_things_move_right_in_the_picture() {
        let point = Point2::new(300.0, 240.0);
        let [still, turned] = [0.0, 10.0].map(|turn| cameras((0.0, 0.0, turn)));
        let [a, b] = [&still, &turned].map(|pair| find_match(pair, &point).pixel().unwrap());
        assert!(b.x > a.x + 50.0);
        assert!(Geometry::of(&turned).is_none());
    }
}
