//! A wireframe house and the cameras around it, as ground truth.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at};
use nalgebra::{Point2, Point3, Vector3};

/// Width and height of the photographs, pixels.
pub(crate) const SIZE: (u32, u32) = (640, 480);
const FOCAL_PX: f64 = 560.0;

/// Number of cameras.
pub(crate) const NUM_CAMERAS: usize = 4;
/// Index of the camera whose photograph is shown.
pub(crate) const SHOWN: usize = 2;
/// Azimuth around the house, degrees, and y (down) of each camera.
const STANDS: [(f64, f64); NUM_CAMERAS] =
    [(-48.0, -0.45), (-12.0, -0.85), (30.0, -0.75), (62.0, -0.5)];
const DISTANCE: f64 = 2.6;
/// Point that all cameras look at.
const TARGET: [f64; 3] = [0.0, -0.15, 0.0];

/// Width of the house, scene units; errors are relative to it.
pub(crate) const WIDTH: f64 = 1.6;

/// Four corners on the ground, four under the eaves, two ends of the ridge, and a door; y is down.
const CORNERS: [[f64; 3]; 14] = [
    [-0.8, 0.4, -0.5],
    [0.8, 0.4, -0.5],
    [0.8, 0.4, 0.5],
    [-0.8, 0.4, 0.5],
    [-0.8, -0.3, -0.5],
    [0.8, -0.3, -0.5],
    [0.8, -0.3, 0.5],
    [-0.8, -0.3, 0.5],
    [-0.8, -0.75, 0.0],
    [0.8, -0.75, 0.0],
    [0.1, 0.4, -0.5],
    [0.1, -0.1, -0.5],
    [0.42, -0.1, -0.5],
    [0.42, 0.4, -0.5],
];
/// Index of the ridge's end whose feature the reader drags.
pub(crate) const MARK: usize = 9;

/// Both end corners of each wire, and the number of points between them.
const WIRES: [(usize, usize, usize); 20] = [
    (0, 1, 3),
    (1, 2, 2),
    (2, 3, 3),
    (3, 0, 2),
    (0, 4, 1),
    (1, 5, 1),
    (2, 6, 1),
    (3, 7, 1),
    (4, 5, 3),
    (5, 6, 2),
    (6, 7, 3),
    (7, 4, 2),
    (8, 9, 3),
    (4, 8, 1),
    (7, 8, 1),
    (5, 9, 1),
    (6, 9, 1),
    (10, 11, 0),
    (11, 12, 0),
    (12, 13, 0),
];

/// House and cameras.
pub(crate) struct House {
    pub(crate) cameras: Vec<PosedCamera>,
    pub(crate) points: Vec<Point3<f64>>,
    /// Indices of the points along each wire.
    pub(crate) wires: Vec<Vec<usize>>,
}

impl House {
    /// # Errors
    /// Never for the constants above, as a test confirms.
    pub(crate) fn new() -> Result<Self, Error> {
        let mut points: Vec<Point3<f64>> = CORNERS.map(Point3::from).to_vec();
        let mut wires = Vec::new();
        for (from, to, between) in WIRES {
            let (a, b) = (points[from], points[to]);
            let mut wire = vec![from];
            for step in 1..=between {
                wire.push(points.len());
                points.push(a + (b - a) * (step as f64 / (between + 1) as f64));
            }
            wire.push(to);
            wires.push(wire);
        }
        let camera = |(angle_deg, y): (f64, f64)| {
            let angle = angle_deg.to_radians();
            let (sin, cos) = libm::sincos(angle);
            let center = Point3::new(DISTANCE * sin, y, -DISTANCE * cos);
            let up = Vector3::new(0.0, -1.0, 0.0);
            Ok(PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::centered(FOCAL_PX, SIZE.0, SIZE.1)?,
                    SIZE.0,
                    SIZE.1,
                ),
                cam_from_world: look_at(&center, &Point3::from(TARGET), &up)?,
            })
        };
        Ok(Self {
            cameras: STANDS
                .into_iter()
                .map(camera)
                .collect::<Result<_, Error>>()?,
            points,
            wires,
        })
    }

    /// Returns the segments of the wires between neighboring points.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = [usize; 2]> {
        let wires = self.wires.iter();
        wires.flat_map(|wire| wire.windows(2).map(|pair| [pair[0], pair[1]]))
    }

    /// Returns a camera with another pose.
    pub(crate) fn camera(&self, index: usize, cam_from_world: RigidTransform) -> PosedCamera {
        PosedCamera {
            cam_from_world,
            ..self.cameras[index]
        }
    }

    /// Returns the true position of the dragged feature in the photograph shown, pixels.
    pub(crate) fn mark(&self) -> Point2<f64> {
        let seen = self.cameras[SHOWN].project(&self.points[MARK]);
        // The house is in front of every camera.
        seen.unwrap_or_else(|_| Point2::origin())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_photograph_shows_the_whole_house() {
        let house = House::new().unwrap();
        assert_eq!((house.cameras.len(), house.points.len()), (NUM_CAMERAS, 45));
        for camera in &house.cameras {
            for point in &house.points {
                let pixel = camera.project(point).unwrap();
                assert!((20.0..620.0).contains(&pixel.x), "{pixel}");
                assert!((20.0..460.0).contains(&pixel.y), "{pixel}");
            }
        }
    }
}
