//! Absolute and relative pose errors with their statistics, as evo defines them.
//!
//! Source: Grupp 2017, evo, `metrics.py`; Sturm et al. 2012, "A benchmark for the evaluation of
//! RGB-D SLAM systems", §IV.

use epipole::camera::RigidTransform;
use serde::Serialize;

/// Statistics of errors, with the names of evo.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Statistics {
    /// Root of the mean square.
    pub(super) rmse: f64,
    pub(super) mean: f64,
    /// Of an even number, the mean of the two middle values.
    pub(super) median: f64,
    /// Of the population.
    pub(super) std: f64,
    pub(super) min: f64,
    pub(super) max: f64,
    /// Sum of squares.
    pub(super) sse: f64,
}

/// Errors of poses.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct PoseErrors {
    pub(super) translation_m: Statistics,
    pub(super) rotation_deg: Statistics,
}

impl Statistics {
    /// * `errors`: at least one
    fn new(mut errors: Vec<f64>) -> Self {
        let count = errors.len() as f64;
        let sse: f64 = errors.iter().map(|e| e * e).sum();
        let mean = errors.iter().sum::<f64>() / count;
        let variance = errors.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() / count;
        errors.sort_by(f64::total_cmp);
        let last = errors.len() - 1;
        Self {
            rmse: (sse / count).sqrt(),
            mean,
            median: (errors[last / 2] + errors[last.div_ceil(2)]) / 2.0,
            std: variance.sqrt(),
            min: errors[0],
            max: errors[last],
            sse,
        }
    }
}

impl PoseErrors {
    /// * `errors`: relative motion of each estimated pose from the true one, at least one
    fn new(errors: &[RigidTransform]) -> Self {
        let translations = errors.iter().map(|e| e.translation.vector.norm());
        let rotations = errors.iter().map(|e| e.rotation.angle().to_degrees());
        Self {
            translation_m: Statistics::new(translations.collect()),
            rotation_deg: Statistics::new(rotations.collect()),
        }
    }
}

/// Returns the errors `Qᵢ⁻¹ Pᵢ` of poses in one frame.
///
/// * `truth`, `estimate`: `world_from_cam` of the same poses, at least one
pub(super) fn absolute_errors(truth: &[RigidTransform], estimate: &[RigidTransform]) -> PoseErrors {
    let errors: Vec<RigidTransform> = (truth.iter().zip(estimate))
        .map(|(q, p)| q.inv_mul(p))
        .collect();
    PoseErrors::new(&errors)
}

/// Returns the errors `(Qᵢ⁻¹ Qᵢ₊ₛ)⁻¹ (Pᵢ⁻¹ Pᵢ₊ₛ)` of all motions over `step` poses; `None` if there
/// is none.
pub(super) fn relative_errors(
    truth: &[RigidTransform],
    estimate: &[RigidTransform],
    step: usize,
) -> Option<PoseErrors> {
    let motions = |poses: &[RigidTransform]| -> Vec<RigidTransform> {
        let ends = poses.iter().skip(step);
        poses.iter().zip(ends).map(|(a, b)| a.inv_mul(b)).collect()
    };
    let (truly, estimated) = (motions(truth), motions(estimate));
    (!truly.is_empty()).then(|| absolute_errors(&truly, &estimated))
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::sfm::{AlignmentKind, absolute_trajectory_error, relative_pose_error};
    use nalgebra::{Point3, Vector3};

    #[test]
    fn statistics_are_numpys() {
        let s = Statistics::new(vec![4.0, 1.0, 2.0, 3.0]);
        assert_eq!(
            (s.mean, s.median, s.min, s.max, s.sse),
            (2.5, 2.5, 1.0, 4.0, 30.0)
        );
        assert!((s.rmse - 7.5_f64.sqrt()).abs() < 1e-15);
        assert!((s.std - 1.25_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn errors_are_those_of_the_core() {
        let pose = |i: u32, noise: f64| {
            let i = f64::from(i);
            let center = Vector3::new(i, i * i * 0.1, noise * (i * 7.0 % 3.0));
            RigidTransform::new(center, Vector3::new(0.1 * i, noise * (i % 4.0), 0.3))
        };
        let truth: Vec<_> = (0..30).map(|i| pose(i, 0.0)).collect();
        let estimate: Vec<_> = (0..30).map(|i| pose(i, 0.01)).collect();
        for step in [1, 5] {
            let ours = relative_errors(&truth, &estimate, step).unwrap();
            let core = relative_pose_error(&estimate, &truth, step).unwrap();
            assert!((ours.translation_m.rmse - core.translation.rmse).abs() < 1e-14);
            assert!((ours.rotation_deg.rmse - core.rotation_deg.rmse).abs() < 1e-6);
        }
        assert_eq!(relative_errors(&truth, &estimate, 30), None);
        let centers = |poses: &[RigidTransform]| -> Vec<Point3<f64>> {
            poses
                .iter()
                .map(|pose| pose.translation.vector.into())
                .collect()
        };
        let (core, to) =
            absolute_trajectory_error(&centers(&estimate), &centers(&truth), AlignmentKind::Rigid)
                .unwrap();
        let aligned: Vec<_> = estimate.iter().map(|pose| to.isometry * pose).collect();
        let ours = absolute_errors(&truth, &aligned);
        assert!((ours.translation_m.rmse - core.rmse).abs() < 1e-14);
    }
}
