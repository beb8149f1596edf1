//! Least-squares problem of rotations and a common focal factor.

use crate::camera::{Intrinsics, cross_matrix};
use crate::optim::{DenseProblem, RobustLoss};
use nalgebra::{DMatrix, DVector, Matrix2x3, Matrix3, Point2, Rotation3, Vector2, Vector3};

/// Width of the Cauchy loss, pixels.
const WIDTH_PX: f64 = 1.0;

/// Angle below which quotients are replaced by series, radians.
const SMALL: f64 = 1e-4;

/// A match between two photos, given by index.
pub(super) struct PixelMatch {
    pub(super) images: [usize; 2],
    pub(super) pixels: [Point2<f64>; 2],
}

/// Photos by index, the first of which is fixed: the parameters are a rotation vector for each
/// other photo, applied after its initial rotation, and the logarithm of the factor relative to its
/// initial value.
pub(super) struct RotationParameters {
    pub(super) intrinsics: Vec<Intrinsics>,
    pub(super) starts: Vec<Matrix3<f64>>,
    pub(super) factor: f64,
}

impl RotationParameters {
    fn vector(&self, parameters: &DVector<f64>, number: usize) -> Vector3<f64> {
        match number.checked_sub(1) {
            None => Vector3::zeros(),
            Some(n) => parameters.fixed_rows::<3>(3 * n).into_owned(),
        }
    }

    pub(super) fn rotation(&self, parameters: &DVector<f64>, number: usize) -> Matrix3<f64> {
        let delta = Rotation3::from_scaled_axis(self.vector(parameters, number));
        delta * self.starts[number]
    }

    pub(super) fn factor(&self, parameters: &DVector<f64>) -> f64 {
        self.factor * libm::exp(parameters[parameters.len() - 1])
    }
}

/// Residuals of matches in their second photo, pixels.
pub(super) struct RotationsProblem {
    pub(super) matches: Vec<PixelMatch>,
    pub(super) rotations: RotationParameters,
    pub(super) is_focal_held: bool,
}

/// A match for some parameters.
struct ProjectedMatch {
    /// Ray in image 1, with its z scaled by the factor.
    ray1: Vector3<f64>,
    /// The same in image 2.
    ray2: Vector3<f64>,
    rotation: Matrix3<f64>,
    residual: Vector2<f64>,
    /// Derivatives of the residual by `ray2`.
    by_ray: Matrix2x3<f64>,
    /// Predicted pixel relative to the principal point.
    about: Vector2<f64>,
}

impl RotationsProblem {
    pub(super) fn num_parameters(&self) -> usize {
        3 * (self.rotations.intrinsics.len() - 1) + 1
    }

    fn project(&self, parameters: &DVector<f64>, found: &PixelMatch) -> Option<ProjectedMatch> {
        let [k1, k2] = found
            .images
            .map(|number| &self.rotations.intrinsics[number]);
        let [r1, r2] = found
            .images
            .map(|number| self.rotations.rotation(parameters, number));
        let factor = self.rotations.factor(parameters);
        let ray = k1.ray(&found.pixels[0]);
        let ray1 = Vector3::new(ray.x / ray.z, ray.y / ray.z, factor);
        let rotation = r2 * r1.transpose();
        let ray2 = rotation * ray1;
        if ray2.z <= 0.0 {
            return None;
        }
        let focal = Vector2::new(k2.fu_px(), k2.fv_px()) * factor;
        let about = focal.component_mul(&ray2.xy()) / ray2.z;
        let by_ray = Matrix2x3::new(
            focal.x / ray2.z,
            0.0,
            -about.x / ray2.z,
            0.0,
            focal.y / ray2.z,
            -about.y / ray2.z,
        );
        let residual = about + k2.principal_point().coords - found.pixels[1].coords;
        Some(ProjectedMatch {
            ray1,
            ray2,
            rotation,
            residual,
            by_ray,
            about,
        })
    }
}

/// Returns J(w), for the derivatives of `exp(w) x` by w, `−[exp(w) x]× J(w)`.
fn left_jacobian(w: &Vector3<f64>) -> Matrix3<f64> {
    let (angle, cross) = (w.norm(), cross_matrix(w));
    let (a, b) = match angle < SMALL {
        true => (0.5, 1.0 / 6.0),
        false => {
            let (sin, cos) = libm::sincos(angle);
            let sq = angle * angle;
            ((1.0 - cos) / sq, (angle - sin) / (sq * angle))
        }
    };
    Matrix3::identity() + a * cross + b * cross * cross
}

impl DenseProblem for RotationsProblem {
    fn num_residuals(&self) -> usize {
        2 * self.matches.len()
    }

    fn residuals(&self, parameters: &DVector<f64>, residuals: &mut DVector<f64>) {
        for (n, found) in self.matches.iter().enumerate() {
            let projected = self.project(parameters, found);
            let behind = Vector2::repeat(f64::INFINITY);
            let residual = projected.map_or(behind, |projected| projected.residual);
            residuals.fixed_rows_mut::<2>(2 * n).copy_from(&residual);
        }
    }

    fn jacobian(&self, parameters: &DVector<f64>, jacobian: &mut DMatrix<f64>) {
        jacobian.fill(0.0);
        let last = parameters.len() - 1;
        for (n, found) in self.matches.iter().enumerate() {
            let Some(projected) = self.project(parameters, found) else {
                continue;
            };
            let by_rotation =
                |number: usize| left_jacobian(&self.rotations.vector(parameters, number));
            let [first, second] = found.images;
            if let Some(place) = second.checked_sub(1) {
                let block = -projected.by_ray * cross_matrix(&projected.ray2) * by_rotation(second);
                jacobian
                    .fixed_view_mut::<2, 3>(2 * n, 3 * place)
                    .copy_from(&block);
            }
            if let Some(place) = first.checked_sub(1) {
                let block = projected.by_ray
                    * projected.rotation
                    * cross_matrix(&projected.ray1)
                    * by_rotation(first);
                jacobian
                    .fixed_view_mut::<2, 3>(2 * n, 3 * place)
                    .copy_from(&block);
            }
            let factor = projected.ray1.z;
            let by_focal =
                projected.about + projected.by_ray * projected.rotation.column(2) * factor;
            jacobian
                .fixed_view_mut::<2, 1>(2 * n, last)
                .copy_from(&by_focal);
        }
    }

    fn loss(&self) -> RobustLoss {
        RobustLoss::Cauchy { width: WIDTH_PX }
    }

    fn is_held(&self, index: usize) -> bool {
        self.is_focal_held && index + 1 == self.num_parameters()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;

    #[test]
    fn jacobian_agrees_with_differences() {
        let mut random = Random::new(8);
        let k = Intrinsics::new(500.0, 520.0, 320.0, 240.0).unwrap();
        let mut small = || Vector3::from_fn(|_, _| random.uniform(-0.2, 0.2));
        let starts = (0..3)
            .map(|_| Rotation3::from_scaled_axis(small()).into_inner())
            .collect();
        let parameters = DVector::from_fn(7, |n, _| 0.1 * (n as f64 - 3.0));
        let mut pixel = || Point2::new(random.uniform(200.0, 440.0), random.uniform(140.0, 340.0));
        let problem = RotationsProblem {
            matches: [[0, 1], [2, 1], [1, 0], [2, 0], [1, 2]]
                .map(|images| PixelMatch {
                    images,
                    pixels: [pixel(), pixel()],
                })
                .into(),
            rotations: RotationParameters {
                intrinsics: vec![k; 3],
                starts,
                factor: 1.2,
            },
            is_focal_held: false,
        };
        let mut analytic = DMatrix::zeros(10, 7);
        problem.jacobian(&parameters, &mut analytic);
        let residuals = |delta: &DVector<f64>| {
            let mut residuals = DVector::zeros(10);
            problem.residuals(&(&parameters + delta), &mut residuals);
            residuals
        };
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
    }
}
