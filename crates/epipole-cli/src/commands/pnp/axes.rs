//! Reversed or exchanged axes, which mirror the image, so that few points agree.

use crate::context::Context;
use epipole::absolute_pose::estimate_absolute_pose;
use epipole::camera::Camera;
use epipole::robust::RansacOptions;
use nalgebra::{Point2, Point3};

/// Change of the pixel axes.
type Axes<'a> = &'a dyn Fn(&Point2<f64>) -> Point2<f64>;

/// Warns if few points agree, and many would in a mirrored image.
///
/// * `num_inliers`: number of inliers of the pose
pub(super) fn check(
    points: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
    num_inliers: usize,
    options: &RansacOptions,
    context: &Context,
) {
    let count = points.len();
    if 2 * num_inliers >= count {
        return;
    }
    let center = camera.intrinsics.principal_point();
    let upward = |p: &Point2<f64>| Point2::new(p.x, 2.0 * center.y - p.y);
    let exchanged = |p: &Point2<f64>| Point2::new(p.y, p.x);
    let axes: [Axes; 2] = [&upward, &exchanged];
    let num_mirrored = |axis: Axes| {
        let mirrored: Vec<_> = pixels.iter().map(axis).collect();
        let report = estimate_absolute_pose(points, &mirrored, camera, options, &mut ()).ok()?;
        (!report.could_be_random()).then_some(report.num_inliers)
    };
    let Some(most) = axes.into_iter().filter_map(num_mirrored).max() else {
        return;
    };
    if 2 * most >= count && most >= 2 * num_inliers {
        context.warn(&format!(
            "{num_inliers} of {count} points agree, but {most} where the image is mirrored: is v counted upward, are \
             u and v exchanged, or is one axis of the world reversed?"
        ));
    }
}
