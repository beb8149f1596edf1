//! A camera from points of the scene and where they are seen.

use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use crate::robust::{Estimator, RansacOptions, ransac};
use nalgebra::{
    Matrix3, Matrix4, Point2, Point3, Rotation3, SMatrix, SVector, Translation3, UnitQuaternion,
    Vector2, Vector3,
};

/// A camera with the points that agree with it.
#[derive(Debug, Clone)]
pub(super) struct FoundCamera {
    pub(super) camera: Camera,
    pub(super) inliers: Vec<bool>,
    pub(super) num_inliers: usize,
}

struct ResectionEstimator<'a> {
    pixels: &'a [Point2<f64>],
    points: &'a [Point3<f64>],
    intrinsics: Intrinsics,
}

/// `cam_from_world` from three points and their rays, up to four solutions.
///
/// Source: Grunert 1841, as in Haralick, Lee, Ottenberg & Nölle 1994, "Review and analysis of
/// solutions of the three point perspective pose estimation problem".
fn p3p(rays: &[Vector3<f64>; 3], points: &[Point3<f64>; 3]) -> Vec<RigidTransform> {
    let a2 = (points[1] - points[2]).norm_squared();
    let b2 = (points[0] - points[2]).norm_squared();
    let c2 = (points[0] - points[1]).norm_squared();
    let (cos_a, cos_b, cos_c) = (
        rays[1].dot(&rays[2]),
        rays[0].dot(&rays[2]),
        rays[0].dot(&rays[1]),
    );
    let (p, q, r, s) = (
        (a2 - c2) / b2,
        (a2 + c2) / b2,
        (b2 - c2) / b2,
        (b2 - a2) / b2,
    );
    let c = [
        (1.0 + p) * (1.0 + p) - 4.0 * a2 / b2 * cos_c * cos_c,
        4.0 * (-p * (1.0 + p) * cos_b + 2.0 * a2 / b2 * cos_c * cos_c * cos_b
            - (1.0 - q) * cos_a * cos_c),
        2.0 * (p * p - 1.0 + 2.0 * p * p * cos_b * cos_b + 2.0 * r * cos_a * cos_a
            - 4.0 * q * cos_a * cos_b * cos_c
            + 2.0 * s * cos_c * cos_c),
        4.0 * (p * (1.0 - p) * cos_b - (1.0 - q) * cos_a * cos_c
            + 2.0 * c2 / b2 * cos_a * cos_a * cos_b),
        (p - 1.0) * (p - 1.0) - 4.0 * c2 / b2 * cos_a * cos_a,
    ];
    let mut solutions = Vec::new();
    if !c.iter().all(|x| x.is_finite()) || c[4].abs() < 1e-12 {
        return solutions;
    }
    #[rustfmt::skip]
    let companion = Matrix4::new(
        0.0, 0.0, 0.0, -c[0] / c[4],
        1.0, 0.0, 0.0, -c[1] / c[4],
        0.0, 1.0, 0.0, -c[2] / c[4],
        0.0, 0.0, 1.0, -c[3] / c[4],
    );
    for root in companion.complex_eigenvalues().iter() {
        if root.im.abs() > 1e-4 * root.re.abs() || root.re <= 0.0 {
            continue;
        }
        let v = root.re;
        let below = 2.0 * (cos_c - v * cos_a);
        let u = ((p - 1.0) * v * v - 2.0 * p * cos_b * v + 1.0 + p) / below;
        let depth_sq = b2 / (1.0 + v * v - 2.0 * v * cos_b);
        if !(u > 0.0 && u.is_finite() && depth_sq > 0.0 && depth_sq.is_finite()) {
            continue;
        }
        let depth = depth_sq.sqrt();
        let seen = [
            rays[0] * depth,
            rays[1] * (u * depth),
            rays[2] * (v * depth),
        ];
        let frame = |x: Vector3<f64>, y: Vector3<f64>, z: Vector3<f64>| {
            let first = (y - x).try_normalize(1e-12)?;
            let third = first.cross(&(z - x)).try_normalize(1e-12)?;
            Some(Matrix3::from_columns(&[first, third.cross(&first), third]))
        };
        let [x, y, z] = points.map(|point| point.coords);
        let (Some(in_cam), Some(in_world)) = (frame(seen[0], seen[1], seen[2]), frame(x, y, z))
        else {
            continue;
        };
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(
            in_cam * in_world.transpose(),
        ));
        let center = (seen[0] + seen[1] + seen[2]) / 3.0 - rotation * ((x + y + z) / 3.0);
        solutions.push(RigidTransform::from_parts(
            Translation3::from(center),
            rotation,
        ));
    }
    solutions
}

impl Estimator for ResectionEstimator<'_> {
    type Model = RigidTransform;

    fn name(&self) -> &'static str {
        "a camera from points"
    }
    fn sample_size(&self) -> usize {
        3
    }
    fn num_data(&self) -> usize {
        self.pixels.len()
    }
    fn max_models(&self) -> usize {
        4
    }
    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<RigidTransform>) {
        let rays = [0, 1, 2].map(|i| self.intrinsics.ray(&self.pixels[sample[i]]).normalize());
        let points = [0, 1, 2].map(|i| self.points[sample[i]]);
        models.extend(p3p(&rays, &points));
    }
    fn error_sq(&self, model: &RigidTransform, index: usize) -> f64 {
        self.intrinsics
            .project(&(model * self.points[index]))
            .map_or(f64::INFINITY, |pixel| {
                (pixel - self.pixels[index]).norm_squared()
            })
    }
    fn refine(
        &mut self,
        model: &RigidTransform,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<RigidTransform> {
        let problem = PoseRefinement {
            estimator: self,
            inliers,
            loss: RobustLoss::Cauchy {
                width: 0.5 * max_error_px,
            },
        };
        let mut refined = *model;
        let options = LmOptions {
            max_iterations: 15,
            ..LmOptions::default()
        };
        minimize_fixed(&problem, &mut refined, &options).ok()?;
        Some(refined)
    }
}

struct PoseRefinement<'a> {
    estimator: &'a ResectionEstimator<'a>,
    inliers: &'a [usize],
    loss: RobustLoss,
}

impl FixedProblem<6> for PoseRefinement<'_> {
    type Parameters = RigidTransform;

    fn accumulate(&self, pose: &RigidTransform, normal: &mut NormalEquations<6>) {
        let k = &self.estimator.intrinsics;
        let center = k.principal_point();
        for &index in self.inliers {
            let rotated = pose.rotation * self.estimator.points[index].coords;
            let p = rotated + pose.translation.vector;
            let pixel = self.estimator.pixels[index];
            let (x, y) = (p.x / p.z, p.y / p.z);
            let residual = Vector2::new(
                k.fu_px() * x + center.x - pixel.x,
                k.fv_px() * y + center.y - pixel.y,
            );
            let (fu, fv) = (k.fu_px() / p.z, k.fv_px() / p.z);
            let by_p = SMatrix::<f64, 2, 3>::new(fu, 0.0, -fu * x, 0.0, fv, -fv * y);
            let mut jacobian = SMatrix::<f64, 2, 6>::zeros();
            let by_rotation = by_p * -rotated.cross_matrix();
            jacobian
                .fixed_view_mut::<2, 3>(0, 0)
                .copy_from(&by_rotation);
            jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&by_p);
            normal.add(&residual, &jacobian, &self.loss);
        }
    }

    fn cost(&self, pose: &RigidTransform) -> f64 {
        let mut sum = 0.0;
        for &index in self.inliers {
            sum += self.loss.rho(self.estimator.error_sq(pose, index));
        }
        0.5 * sum
    }

    fn plus(&self, pose: &RigidTransform, delta: &SVector<f64, 6>) -> RigidTransform {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
        let shift = Vector3::new(delta[3], delta[4], delta[5]);
        RigidTransform::from_parts(
            Translation3::from(pose.translation.vector + shift),
            UnitQuaternion::new_normalize((turn * pose.rotation).into_inner()),
        )
    }
}

/// The camera that most points agree on, refined; `None` without consensus.
pub(super) fn find_camera(
    pixels: &[Point2<f64>],
    points: &[Point3<f64>],
    intrinsics: &Intrinsics,
    options: &RansacOptions,
) -> Option<FoundCamera> {
    let estimator = ResectionEstimator {
        pixels,
        points,
        intrinsics: *intrinsics,
    };
    let report = ransac(estimator, options).ok()?;
    Some(FoundCamera {
        camera: Camera {
            intrinsics: *intrinsics,
            cam_from_world: report.model,
        },
        inliers: report.inliers,
        num_inliers: report.num_inliers,
    })
}
