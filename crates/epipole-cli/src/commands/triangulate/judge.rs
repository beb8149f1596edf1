//! Points from matches, and warnings about them.

use crate::context::Context;
use crate::failure::Failure;
use epipole::Error;
use epipole::camera::PosedCamera;
use epipole::optim::RobustLoss;
use epipole::triangulation::{triangulate_nview, triangulation_angle_rad};
use nalgebra::{Point2, Point3};

/// Angle below which rays are nearly parallel.
const PARALLEL_DEG: f64 = 1.0;

/// Mean error above which the cameras are not those of the matches.
const MUCH_PX: f64 = 10.0;

/// A triangulated match.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) position: Point3<f64>,
    pub(super) error_px: f64,
    pub(super) angle_deg: f64,
}

impl Point {
    /// Returns x, y, z, error and angle.
    pub(super) fn row(self) -> [f64; 5] {
        let x = self.position;
        [x.x, x.y, x.z, self.error_px, self.angle_deg]
    }
}

/// Triangulates each match. A match whose rays do not meet in front of both cameras has an error.
///
/// # Errors
/// If there is no match, or if both cameras are at the same place.
pub(super) fn triangulate(
    cameras: &[PosedCamera; 2],
    [pixels1, pixels2]: &[Vec<Point2<f64>>; 2],
) -> Result<Vec<epipole::Result<Point>>, Failure> {
    let [center1, center2] = cameras.each_ref().map(PosedCamera::center_in_world);
    let point = |(a, b): (&Point2<f64>, &Point2<f64>)| {
        let found = triangulate_nview(cameras, &[*a, *b], RobustLoss::Trivial)?;
        let position = found.point_in_world;
        let angle = triangulation_angle_rad(&center1, &center2, &position);
        Ok(Point {
            position,
            error_px: found.rms_error_px,
            angle_deg: angle.to_degrees(),
        })
    };
    let found: Vec<_> = pixels1.iter().zip(pixels2).map(point).collect();
    match found.first() {
        None => Err(Failure::new("too-few", "there is no match in it")),
        Some(Err(Error::Degenerate { .. })) => {
            let message = "both cameras are at the same position, so rays give no depth: the camera only rotated";
            Err(Failure::new("degenerate", message))
        }
        Some(_) => Ok(found),
    }
}

/// Statistics of all points.
pub(super) struct Summary {
    pub(super) num_points: usize,
    pub(super) num_parallel: usize,
    pub(super) num_behind: usize,
    num_near_parallel: usize,
    pub(super) baseline: f64,
    pub(super) mean_error_px: Option<f64>,
    pub(super) median_angle_deg: Option<f64>,
}

impl Summary {
    pub(super) fn new(cameras: &[PosedCamera; 2], found: &[epipole::Result<Point>]) -> Self {
        let points: Vec<&Point> = found.iter().flatten().collect();
        let count = |is: fn(&Error) -> bool| {
            let errors = found.iter().filter_map(|point| point.as_ref().err());
            errors.filter(|error| is(error)).count()
        };
        let mut angles: Vec<f64> = points.iter().map(|point| point.angle_deg).collect();
        angles.sort_by(f64::total_cmp);
        let sum_px: f64 = points.iter().map(|point| point.error_px).sum();
        let [center1, center2] = cameras.each_ref().map(PosedCamera::center_in_world);
        Self {
            num_points: points.len(),
            num_parallel: count(|error| matches!(error, Error::PointAtInfinity)),
            num_behind: count(|error| matches!(error, Error::PointBehindCamera)),
            num_near_parallel: angles.iter().filter(|angle| **angle < PARALLEL_DEG).count(),
            baseline: (center2 - center1).norm(),
            mean_error_px: (!points.is_empty()).then(|| sum_px / points.len() as f64),
            median_angle_deg: angles.get(angles.len() / 2).copied(),
        }
    }
}

/// Warns of nearly parallel rays, points behind cameras, and cameras that do not fit the matches.
pub(super) fn warn(
    summary: &Summary,
    cameras: &[PosedCamera; 2],
    pixels: &[Vec<Point2<f64>>; 2],
    context: &Context,
) {
    let num_matches = pixels[0].len();
    let parallel = summary.num_near_parallel + summary.num_parallel;
    if parallel > 0 {
        context.warn(&format!(
            "rays of {parallel} of {num_matches} matches are near parallel (they meet at less than {PARALLEL_DEG}°, or \
             nowhere): their depths mean little"
        ));
    }
    if 2 * summary.num_behind > num_matches {
        context.warn(&format!(
            "{} of {num_matches} matches meet behind a camera: is the order of the images that of the matches, and are \
             the poses cam_from_world?",
            summary.num_behind
        ));
    }
    if let Some(mean_px) = summary.mean_error_px
        && mean_px > MUCH_PX
    {
        context.warn(&format!(
            "the points are {mean_px:.1} px on average from the pixels: many matches are wrong, or the cameras are not \
             theirs"
        ));
    }
    for (n, (camera, pixels)) in cameras.iter().zip(pixels).enumerate() {
        let (width, height) = (camera.camera.width, camera.camera.height);
        let is_outside = |p: &&Point2<f64>| {
            p.x > f64::from(width) || p.y > f64::from(height) || p.coords.min() < -1.0
        };
        let num_outside = pixels.iter().filter(is_outside).count();
        if num_outside > 0 {
            context.warn(&format!(
                "{num_outside} pixels are outside image {}, which has {width} × {height}: are the matches of images of \
                 another size?",
                n + 1
            ));
        }
    }
}
