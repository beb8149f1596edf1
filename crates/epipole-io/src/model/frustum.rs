//! Frusta of cameras, scaled to the scene.

use super::{Model, ModelImage};
use epipole::camera::Camera;
use nalgebra::{Point2, Point3, Vector3};

/// Length of the frusta relative to the extent of the scene.
pub(super) const FRUSTUM_RATIO: f64 = 0.05;

/// Returns the corners of the image at this depth, in the frame of the camera. A corner without a
/// ray in front of the camera is that of a pinhole.
pub(super) fn corners(camera: &Camera, depth: f64) -> [Point3<f64>; 4] {
    let (right, bottom) = (
        f64::from(camera.width) - 0.5,
        f64::from(camera.height) - 0.5,
    );
    let corners = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)];
    corners.map(|(u, v)| {
        let pixel = Point2::new(u, v);
        let ray = camera.unproject(&pixel).ok().filter(|ray| ray.z > 0.2);
        let ray = ray.unwrap_or_else(|| camera.intrinsics.ray(&pixel));
        Point3::from(ray * (depth / ray.z))
    })
}

/// Returns the median position of points and cameras, and twice the median distance from it, or 1
/// if that is not positive.
pub(super) fn extent(model: &Model) -> (Point3<f64>, f64) {
    let centers = model.images.iter().map(ModelImage::center_in_world);
    let positions: Vec<Point3<f64>> = centers
        .chain(model.points.iter().map(|point| point.position))
        .collect();
    let median = |mut values: Vec<f64>| -> f64 {
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let middle = Point3::from(Vector3::from_fn(|axis, _| {
        median(positions.iter().map(|p| p[axis]).collect())
    }));
    let distances = positions.iter().map(|p| (p - middle).norm()).collect();
    let extent = 2.0 * median(distances);
    match extent > 0.0 && extent.is_finite() {
        true => (middle, extent),
        false => (middle, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::Intrinsics;

    #[test]
    fn corners_are_those_of_the_outermost_pixels() {
        let intrinsics = Intrinsics::new(100.0, 100.0, 99.5, 49.5).unwrap();
        let camera = Camera::pinhole(intrinsics, 200, 100);
        let corners = corners(&camera, 2.0);
        assert_eq!(corners[0], Point3::new(-2.0, -1.0, 2.0));
        assert_eq!(corners[2], Point3::new(2.0, 1.0, 2.0));
    }
}
