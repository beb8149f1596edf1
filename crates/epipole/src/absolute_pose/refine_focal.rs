//! Nonlinear refinement of a camera pose with the focal length.

use super::local_pose::{LocalPose, Pivot};
use super::point_errors::{PinholePoints, PointErrors};
use super::pose_with_focal::PoseFocal;
use super::refine::PoseProblem;
use crate::camera::Intrinsics;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use nalgebra::{Point2, Point3, SMatrix, SVector, Vector2};

/// Like `LocalProblem`, but refines the focal length instead of using that of the intrinsics.
struct FocalProblem<'a> {
    problem: &'a PoseProblem<'a, PinholePoints<'a>>,
    pivot: Pivot,
}

impl<'a> FocalProblem<'a> {
    fn new(problem: &'a PoseProblem<'a, PinholePoints<'a>>, (rotation, t, _): &PoseFocal) -> Self {
        Self {
            problem,
            pivot: problem.pivot(&(*rotation, *t)),
        }
    }

    /// Returns the same pixels for a camera with other intrinsics.
    fn points_with<'b>(&'b self, intrinsics: &'b Intrinsics) -> PinholePoints<'b> {
        PinholePoints {
            intrinsics,
            ..self.problem.errors
        }
    }

    /// Returns the intrinsics with another focal length, if valid.
    fn camera(&self, focal_px: f64) -> Option<Intrinsics> {
        let center = self.problem.errors.intrinsics.principal_point();
        Intrinsics::new(focal_px, focal_px, center.x, center.y).ok()
    }

    /// Returns the residual and its derivatives by rotation, shift and log f.
    fn linearized(
        &self,
        pose: &LocalPose,
        k: &Intrinsics,
        index: usize,
    ) -> Option<(Vector2<f64>, SMatrix<f64, 2, 7>)> {
        let [x, from_pivot] = self.pivot.places(pose, &self.problem.points[index].coords);
        let (residual, by_point) = self.points_with(k).linearized(&x, index)?;
        let projected = self.problem.errors.pixels[index].coords + residual;
        let mut jacobian = SMatrix::<f64, 2, 7>::zeros();
        let by_pose = self.pivot.jacobian(&by_point, &from_pivot);
        jacobian.fixed_view_mut::<2, 6>(0, 0).copy_from(&by_pose);
        jacobian.set_column(6, &(projected - k.principal_point().coords));
        Some((residual, jacobian))
    }
}

impl FixedProblem<7> for FocalProblem<'_> {
    type Parameters = (LocalPose, f64);

    fn accumulate(&self, (pose, focal_px): &(LocalPose, f64), normal: &mut NormalEquations<7>) {
        let Some(k) = self.camera(*focal_px) else {
            normal.cost = f64::INFINITY;
            return;
        };
        for (index, root) in self.problem.used.iter() {
            match self.linearized(pose, &k, index) {
                Some((residual, jacobian)) => {
                    normal.add(&(residual * root), &(jacobian * root), &self.problem.loss);
                }
                None => normal.cost = f64::INFINITY,
            }
        }
    }

    fn cost(&self, (pose, focal_px): &(LocalPose, f64)) -> f64 {
        let Some(k) = self.camera(*focal_px) else {
            return f64::INFINITY;
        };
        let mut total = 0.0;
        for (index, root) in self.problem.used.iter() {
            let [x, _] = self.pivot.places(pose, &self.problem.points[index].coords);
            match self.points_with(&k).residual(&x, index) {
                Some(residual) => {
                    total += 0.5 * self.problem.loss.rho((residual * root).norm_squared());
                }
                None => return f64::INFINITY,
            }
        }
        total
    }

    fn plus(
        &self,
        (pose, focal_px): &(LocalPose, f64),
        delta: &SVector<f64, 7>,
    ) -> (LocalPose, f64) {
        let moved = self
            .pivot
            .moved(pose, &delta.fixed_rows::<6>(0).into_owned());
        (moved, focal_px * libm::exp(delta[6]))
    }
}

/// Refines a pose with its focal length; only the principal point of the problem's intrinsics is
/// used.
pub(super) fn refine_with_focal(
    problem: &PoseProblem<'_, PinholePoints<'_>>,
    start: &PoseFocal,
    options: &LmOptions,
) -> Option<PoseFocal> {
    let focal = FocalProblem::new(problem, start);
    let mut model = (focal.pivot.local(&(start.0, start.1)), start.2);
    minimize_fixed(&focal, &mut model, options).ok()?;
    let (rotation, t) = focal.pivot.in_world(&model.0)?;
    (model.1 > 0.0 && model.1.is_finite()).then_some((rotation, t, model.1))
}

/// Returns the relative standard deviation of the focal length, from the errors and their
/// dependence on all seven parameters. `None` if they do not determine it.
pub(super) fn relative_focal_deviation(
    problem: &PoseProblem<'_, PinholePoints<'_>>,
    model: &PoseFocal,
) -> Option<f64> {
    let focal = FocalProblem::new(problem, model);
    let at = (focal.pivot.local(&(model.0, model.1)), model.2);
    let mut normal = NormalEquations::new();
    focal.accumulate(&at, &mut normal);
    let free = (2 * problem.used.indices.len())
        .checked_sub(7)
        .filter(|n| *n > 0)?;
    let variance = 2.0 * normal.cost / free as f64;
    let inverse = normal.hessian.cholesky()?.inverse();
    let deviation = (variance * inverse[(6, 6)]).sqrt();
    deviation.is_finite().then_some(deviation)
}

/// Refines a solution for four points, with pixels relative to the principal point.
pub(super) fn polish_sample(
    about: &[Vector2<f64>; 4],
    points: &[Point3<f64>; 4],
    start: &PoseFocal,
) -> Option<PoseFocal> {
    let options = LmOptions {
        max_iterations: 20,
        cost_tolerance: 1e-12,
        step_tolerance: 1e-13,
        ..LmOptions::default()
    };
    let problem = PoseProblem {
        points,
        errors: PinholePoints {
            pixels: &about.map(Point2::from),
            intrinsics: &Intrinsics::new(1.0, 1.0, 0.0, 0.0).ok()?,
        },
        used: Subset::alike(&[0, 1, 2, 3]),
        loss: RobustLoss::Trivial,
    };
    refine_with_focal(&problem, start, &options)
}

#[cfg(test)]
mod tests {
    use super::super::p3p::tests::problem;
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn jacobian_agrees_with_differences() {
        let mut random = Random::new(1);
        let k = Intrinsics::new(500.0, 500.0, 320.0, 240.0).unwrap();
        for _ in 0..20 {
            let (truth, rays, points) = problem::<8>(&mut random);
            let pose_problem = PoseProblem {
                points: &points,
                errors: PinholePoints {
                    pixels: &rays.map(|r| k.project(&r.into()).unwrap()),
                    intrinsics: &k,
                },
                used: Subset::alike(&[0, 1, 2, 3, 4, 5, 6, 7]),
                loss: RobustLoss::Trivial,
            };
            let rotation = truth.rotation.to_rotation_matrix().into_inner();
            let start = (rotation, truth.translation.vector, 620.0);
            let focal = FocalProblem::new(&pose_problem, &start);
            let model = (focal.pivot.local(&(start.0, start.1)), start.2);
            let at = |(pose, focal_px): &(LocalPose, f64), i: usize| {
                let camera = focal.camera(*focal_px).unwrap();
                focal.linearized(pose, &camera, i).unwrap()
            };
            let residuals = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 7>::from_column_slice(delta.as_slice());
                let moved = focal.plus(&model, &delta);
                DVector::from_fn(16, |row, _| at(&moved, row / 2).0[row % 2])
            };
            let analytic = DMatrix::from_fn(16, 7, |row, column| {
                at(&model, row / 2).1[(row % 2, column)]
            });
            assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
        }
    }
}
