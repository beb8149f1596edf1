//! Robust triangulation of a track with outliers.

use super::views::View;
use crate::camera::PosedCamera;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Matrix3, Point3, SMatrix, SVector, Vector2, Vector3};

/// An undistorted keypoint and its camera.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight<'a> {
    pub(super) camera: PosedCamera,
    pub(super) view: View<'a>,
}

impl Sight<'_> {
    fn ray(&self) -> Vector3<f64> {
        match &self.view {
            View::Pixel(pixel) => self.camera.ray_in_world(pixel).normalize(),
            View::Ray(projected) => {
                let rotation = &self.camera.cam_from_world.rotation;
                rotation.inverse_transform_vector(&projected.ray())
            }
        }
    }

    /// Returns the squared reprojection error; infinite behind the camera, or 90° and more off the
    /// ray.
    pub(super) fn error_sq(&self, point: &Point3<f64>) -> f64 {
        match &self.view {
            View::Pixel(pixel) => self
                .camera
                .project(point)
                .map_or(f64::INFINITY, |projected| {
                    (projected - pixel).norm_squared()
                }),
            View::Ray(projected) => {
                projected.error_sq(&(self.camera.cam_from_world * point).coords)
            }
        }
    }

    /// Returns the reprojection error and its derivative by the point in the camera frame; `None`
    /// 90° or more off the ray.
    fn residual(&self, p: &Point3<f64>) -> Option<(Vector2<f64>, SMatrix<f64, 2, 3>)> {
        let pixel = match &self.view {
            View::Pixel(pixel) => pixel,
            View::Ray(projected) => return projected.offset_with_derivative(&p.coords),
        };
        let k = &self.camera.camera.intrinsics;
        let (x, y) = (p.x / p.z, p.y / p.z);
        let center = k.principal_point();
        let residual = Vector2::new(
            k.fu_px() * x + center.x - pixel.x,
            k.fv_px() * y + center.y - pixel.y,
        );
        let (fu, fv) = (k.fu_px() / p.z, k.fv_px() / p.z);
        let by_p = SMatrix::<f64, 2, 3>::new(fu, 0.0, -fu * x, 0.0, fv, -fv * y);
        Some((residual, by_p))
    }
}

/// Returns the point nearest to all rays by `Σ ‖(I − d dᵀ)(X − C)‖²`; `None` if they are parallel.
fn nearest_to_rays(sights: &[Sight<'_>], chosen: impl Fn(usize) -> bool) -> Option<Point3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (_, sight) in sights.iter().enumerate().filter(|(i, _)| chosen(*i)) {
        let ray = sight.ray();
        let across = Matrix3::identity() - ray * ray.transpose();
        normal += across;
        right += across * sight.camera.center_in_world().coords;
    }
    let solved = normal.cholesky()?.solve(&right);
    solved
        .iter()
        .all(|x| x.is_finite())
        .then(|| Point3::from(solved))
}

/// Returns the largest angle between rays from two of the cameras to a point, radians, in [0, π/2].
/// As for [`triangulation_angle_rad`](crate::triangulation::triangulation_angle_rad), opposite rays
/// are as bad as parallel ones.
pub(super) fn widest_angle_rad<'a>(
    point: &Point3<f64>,
    centers: impl Iterator<Item = Point3<f64>> + Clone + 'a,
) -> f64 {
    let directions = centers.map(|center| (center - point).normalize());
    let mut least_cosine: f64 = 1.0;
    for (i, a) in directions.clone().enumerate() {
        for b in directions.clone().skip(i + 1) {
            least_cosine = least_cosine.min(a.dot(&b).abs());
        }
    }
    libm::acos(least_cosine)
}

struct Refinement<'a> {
    sights: &'a [Sight<'a>],
    inliers: &'a [bool],
}

impl FixedProblem<3> for Refinement<'_> {
    type Parameters = Point3<f64>;

    fn accumulate(&self, point: &Point3<f64>, normal: &mut NormalEquations<3>) {
        for (sight, _) in self
            .sights
            .iter()
            .zip(self.inliers)
            .filter(|(_, inlier)| **inlier)
        {
            let rotation = sight.camera.cam_from_world.rotation.to_rotation_matrix();
            let p = sight.camera.cam_from_world * point;
            let Some((residual, by_p)) = sight.residual(&p) else {
                normal.cost = f64::INFINITY;
                continue;
            };
            normal.add(&residual, &(by_p * rotation.matrix()), &RobustLoss::Trivial);
        }
    }

    fn cost(&self, point: &Point3<f64>) -> f64 {
        let mut sum = 0.0;
        for (sight, _) in self
            .sights
            .iter()
            .zip(self.inliers)
            .filter(|(_, inlier)| **inlier)
        {
            sum += sight.error_sq(point);
        }
        0.5 * sum
    }

    fn plus(&self, point: &Point3<f64>, delta: &SVector<f64, 3>) -> Point3<f64> {
        point + delta
    }

    fn parameter_norm(&self, point: &Point3<f64>) -> f64 {
        point.coords.norm()
    }
}

/// Triangulates the point on which most sights agree. Also returns these sights; `None` unless at
/// least two agree under a sufficient angle.
///
/// Each pair of sights (a subset of the pairs for long tracks) proposes a point; the one with the
/// smallest truncated error is refined on its inliers.
pub(super) fn triangulate_track(
    sights: &[Sight<'_>],
    max_error_px: f64,
    min_angle_rad: f64,
) -> Option<(Point3<f64>, Vec<bool>)> {
    if sights.len() < 2 {
        return None;
    }
    let max_error_sq = max_error_px * max_error_px;
    let truncated = |point: &Point3<f64>| {
        let mut sum = 0.0;
        for sight in sights {
            sum += sight.error_sq(point).min(max_error_sq);
        }
        sum
    };
    let mut best: Option<(f64, Point3<f64>)> = None;
    let mut propose = |chosen: &dyn Fn(usize) -> bool| {
        if let Some(point) = nearest_to_rays(sights, chosen) {
            let cost = truncated(&point);
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, point));
            }
        }
    };
    propose(&|_| true);
    // At most about 30 pairs: those of eight sights, spread over a long track.
    let stride = sights.len().div_ceil(8).max(1);
    for i in (0..sights.len()).step_by(stride) {
        for j in (i + stride..sights.len()).step_by(stride) {
            propose(&|k| k == i || k == j);
        }
    }
    let (_, mut point) = best?;
    let mut inliers: Vec<bool> = Vec::new();
    for _ in 0..2 {
        inliers = sights
            .iter()
            .map(|s| s.error_sq(&point) <= max_error_sq)
            .collect();
        if inliers.iter().filter(|inlier| **inlier).count() < 2 {
            return None;
        }
        let problem = Refinement {
            sights,
            inliers: &inliers,
        };
        let options = LmOptions {
            max_iterations: 10,
            ..LmOptions::default()
        };
        minimize_fixed(&problem, &mut point, &options).ok()?;
    }
    let chosen = sights.iter().zip(&inliers).filter(|(_, inlier)| **inlier);
    if chosen
        .clone()
        .any(|(sight, _)| sight.error_sq(&point) > max_error_sq)
    {
        return None;
    }
    let centers = chosen.map(|(sight, _)| sight.camera.center_in_world());
    (widest_angle_rad(&point, centers) >= min_angle_rad).then_some((point, inliers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, look_at};

    fn sights(point: &Point3<f64>, count: usize, spread: f64) -> Vec<Sight<'static>> {
        (0..count)
            .map(|i| {
                let center = Point3::new(spread * i as f64, 0.1 * (i % 2) as f64, -5.0);
                let up = Vector3::new(0.0, -1.0, 0.0);
                let camera = PosedCamera {
                    camera: Camera::pinhole(
                        Intrinsics::centered(700.0, 640, 480).unwrap(),
                        640,
                        480,
                    ),
                    cam_from_world: look_at(&center, &Point3::origin(), &up).unwrap(),
                };
                Sight {
                    camera,
                    view: View::Pixel(camera.project(point).unwrap()),
                }
            })
            .collect()
    }

    fn shift(sight: &mut Sight<'_>, u: f64, v: f64) {
        if let View::Pixel(pixel) = &mut sight.view {
            *pixel += Vector2::new(u, v);
        }
    }

    #[test]
    fn exact_sights_meet_in_the_point() {
        let truth = Point3::new(0.3, -0.2, 0.4);
        for count in [2, 3, 20] {
            let (point, inliers) =
                triangulate_track(&sights(&truth, count, 0.2), 2.0, 0.01).unwrap();
            assert!((point - truth).norm() < 1e-9);
            assert!(inliers.iter().all(|inlier| *inlier));
        }
    }

    #[test]
    fn wrong_sights_are_left_out() {
        let truth = Point3::new(0.3, -0.2, 0.4);
        let mut list = sights(&truth, 6, 0.3);
        shift(&mut list[1], 40.0, 0.0);
        shift(&mut list[4], 0.0, -25.0);
        let (point, inliers) = triangulate_track(&list, 2.0, 0.01).unwrap();
        assert!((point - truth).norm() < 1e-9);
        assert_eq!(inliers, [true, false, true, true, false, true]);
    }

    #[test]
    fn what_cannot_be_triangulated_is_refused() {
        let truth = Point3::new(0.3, -0.2, 0.4);
        // Too small an angle; the same camera twice, hence parallel rays; no agreement.
        assert!(triangulate_track(&sights(&truth, 2, 0.001), 2.0, 0.03).is_none());
        let one = sights(&truth, 1, 1.0)[0];
        assert!(triangulate_track(&[one, one], 2.0, 0.0).is_none());
        let mut apart = sights(&truth, 2, 1.0);
        shift(&mut apart[0], 0.0, 200.0);
        assert!(triangulate_track(&apart, 2.0, 0.01).is_none());
        assert!(triangulate_track(&[], 2.0, 0.0).is_none());
    }

    /// Asserts that two cameras facing each other leave a point between them undetermined along
    /// their rays.
    #[test]
    fn cameras_that_face_each_other_do_not_place_a_point() {
        let up = Vector3::new(0.0, -1.0, 0.0);
        let camera = |center: Point3<f64>| PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(700.0, 640, 480).unwrap(), 640, 480),
            cam_from_world: look_at(&center, &Point3::origin(), &up).unwrap(),
        };
        let truth = Point3::new(0.01, 0.0, 0.7);
        let sight = |x: f64, z: f64, (u, v): (f64, f64)| {
            let camera = camera(Point3::new(x, 0.0, z));
            let pixel = camera.project(&truth).unwrap() + Vector2::new(u, v);
            let view = View::Pixel(pixel);
            Sight { camera, view }
        };
        let facing = [sight(0.0, -5.0, (0.3, 0.2)), sight(0.0, 5.0, (-0.2, 0.3))];
        assert!(triangulate_track(&facing, 2.0, 0.03).is_none());
        let centers = facing.map(|sight| sight.camera.center_in_world());
        assert!(widest_angle_rad(&truth, centers.into_iter()) < 0.01);
        // A third camera, to the side, does.
        let aside = [facing[0], facing[1], sight(2.0, -5.0, (0.1, -0.2))];
        let (point, inliers) = triangulate_track(&aside, 2.0, 0.03).unwrap();
        assert!((point - truth).norm() < 0.02, "{point}");
        assert_eq!(inliers, [true; 3]);
    }
}
