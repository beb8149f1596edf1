//! Alignment of two reconstructions, and trajectory errors.

use crate::camera::RigidTransform;
use crate::math::order::at_rank;
use crate::math::{Svd3, svd3};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point3, Rotation3, Similarity3, Translation3, UnitQuaternion, Vector3};

/// Transformation between two frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum AlignmentKind {
    /// Position and orientation.
    Rigid,
    /// Position, orientation and scale, as for a single moving camera.
    #[default]
    Similarity,
}

/// Finds the transform `T` that minimizes `Σ ‖T fromᵢ − toᵢ‖²`, in closed form.
///
/// * `from`, `to`: matched points, at least three, not all on one line
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::TooFew`] for fewer than three
/// points, [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if either set lies
/// on a line or in a point.
///
/// Source: Umeyama 1991, "Least-squares estimation of transformation parameters between two point
/// patterns".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::sfm::{AlignmentKind, align_points};
/// use nalgebra::Point3;
/// let from = [Point3::new(0.0, 0.0, 0.0), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
/// // Twice as large and moved by 5 along z.
/// let to = from.map(|p| Point3::new(2.0 * p.x, 2.0 * p.y, 2.0 * p.z + 5.0));
/// let to_from_from = align_points(&from, &to, AlignmentKind::Similarity)?;
/// assert!((to_from_from.scaling() - 2.0).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn align_points(
    from: &[Point3<f64>],
    to: &[Point3<f64>],
    kind: AlignmentKind,
) -> Result<Similarity3<f64>> {
    if from.len() != to.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of points to align",
            first: from.len(),
            second: to.len(),
        });
    }
    if from.len() < 3 {
        return Err(Error::TooFew {
            what: "an alignment from matched points",
            needed: 3,
            got: from.len(),
        });
    }
    if !from
        .iter()
        .chain(to)
        .all(|p| p.coords.iter().all(|x| x.is_finite()))
    {
        return Err(Error::NotFinite {
            what: "a point to align",
        });
    }
    let count = from.len() as f64;
    let mean =
        |points: &[Point3<f64>]| points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count;
    let (from_mean, to_mean) = (mean(from), mean(to));
    let spread = |points: &[Point3<f64>], mean: &Vector3<f64>| -> Result<Svd3> {
        let around = points.iter().map(|p| p.coords - mean);
        let spread = svd3(&around.map(|a| a * a.transpose() / count).sum());
        let values = spread.singular_values;
        if values[1] <= 1e-14 * values[0] || values[0] <= 0.0 {
            return Err(Error::Degenerate {
                what: "an alignment of points",
                why: match values[0] > 0.0 {
                    true => "they lie on one line",
                    false => "those of one set are all equal",
                },
            });
        }
        Ok(spread)
    };
    let (from_spread, to_spread) = (spread(from, &from_mean)?, spread(to, &to_mean)?);
    // The principal axes of each set. For points near a line, the singular values differ widely,
    // and the rotation about the line is in the vectors of the small ones: in any other frame,
    // rounding of the long coordinates would swamp them.
    let (from_axes, to_axes) = (from_spread.u, to_spread.u);
    let mut covariance = Matrix3::zeros();
    for (a, b) in from.iter().zip(to) {
        let a = from_axes.tr_mul(&(a.coords - from_mean));
        let b = to_axes.tr_mul(&(b.coords - to_mean));
        covariance += b * a.transpose() / count;
    }
    let Svd3 {
        u,
        singular_values,
        v,
    } = svd3(&covariance);
    let (u, v) = (to_axes * u, from_axes * v);
    // At −1 a reflection would fit better than any rotation: flip the weakest axis.
    let sign = (u * v.transpose()).determinant().signum();
    let signs = Vector3::new(1.0, 1.0, sign);
    let rotation = u * Matrix3::from_diagonal(&signs) * v.transpose();
    let scale = match kind {
        AlignmentKind::Rigid => 1.0,
        AlignmentKind::Similarity => {
            singular_values.dot(&signs) / from_spread.singular_values.sum()
        }
    };
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(Error::Degenerate {
            what: "an alignment of points",
            why: "the two sets have no common shape",
        });
    }
    let rotation =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    let translation = to_mean - rotation * from_mean * scale;
    Ok(Similarity3::from_parts(
        Translation3::from(translation),
        rotation,
        scale,
    ))
}

/// Statistics of non-negative errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorStatistics {
    /// Root of the mean square.
    pub rmse: f64,
    /// Arithmetic mean.
    pub mean: f64,
    /// Median; the lower of the two for an even number.
    pub median: f64,
    /// Maximum.
    pub max: f64,
}

impl ErrorStatistics {
    fn new(mut errors: Vec<f64>) -> Self {
        let count = errors.len().max(1) as f64;
        let sum_sq: f64 = errors.iter().map(|e| e * e).sum();
        let mean = errors.iter().sum::<f64>() / count;
        let last = errors.len().saturating_sub(1);
        let [median, max] = [last / 2, last].map(|rank| match errors.is_empty() {
            true => 0.0,
            false => at_rank(&mut errors, rank),
        });
        Self {
            rmse: (sum_sq / count).sqrt(),
            mean,
            median,
            max,
        }
    }
}

/// Computes the absolute trajectory error: distances between camera centers after the best
/// alignment.
///
/// * `estimated`, `truth`: centers of the same cameras, in the same order
///
/// Returns the statistics, in the unit of `truth`, and `truth_from_estimated`.
///
/// # Errors
/// As [`align_points`].
///
/// Source: Sturm, Engelhard, Endres, Burgard & Cremers 2012, "A benchmark for the evaluation of
/// RGB-D SLAM systems", §IV.
pub fn absolute_trajectory_error(
    estimated: &[Point3<f64>],
    truth: &[Point3<f64>],
    kind: AlignmentKind,
) -> Result<(ErrorStatistics, Similarity3<f64>)> {
    let truth_from_estimated = align_points(estimated, truth, kind)?;
    let errors = estimated
        .iter()
        .zip(truth)
        .map(|(e, t)| (truth_from_estimated * e - t).norm())
        .collect();
    Ok((ErrorStatistics::new(errors), truth_from_estimated))
}

/// Relative pose error of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePoseError {
    /// Error of the translation, in the unit of the trajectories.
    pub translation: ErrorStatistics,
    /// Error of the rotation, degrees.
    pub rotation_deg: ErrorStatistics,
}

/// Computes the relative pose error over `step` frames: the difference between the estimated and
/// the true motion, `(Qᵢ⁻¹ Qᵢ₊ₛ)⁻¹ (Pᵢ⁻¹ Pᵢ₊ₛ)`.
///
/// * `estimated`, `truth`: `world_from_cam` of the same frames, in order; for a monocular estimate
///   correct the scale first, for example by that of [`align_points`]
/// * `step`: number of frames from the start of a motion to its end, at least 1
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::OutOfRange`] for a step of 0,
/// [`Error::TooFew`] if the trajectory is not longer than a step.
///
/// Source: Sturm et al. 2012, "A benchmark for the evaluation of RGB-D SLAM systems", §IV.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::sfm::relative_pose_error;
/// let at = |x: f64| RigidTransform::translation(x, 0.0, 0.0);
/// // The second step is 0.5 too long.
/// let error = relative_pose_error(&[at(0.0), at(1.0), at(2.5)], &[at(0.0), at(1.0), at(2.0)], 1)?;
/// assert_eq!(error.translation.max, 0.5);
/// assert_eq!(error.translation.mean, 0.25);
/// # Ok(()) }
/// ```
pub fn relative_pose_error(
    estimated: &[RigidTransform],
    truth: &[RigidTransform],
    step: usize,
) -> Result<RelativePoseError> {
    if estimated.len() != truth.len() {
        return Err(Error::SizeMismatch {
            what: "the two trajectories",
            first: estimated.len(),
            second: truth.len(),
        });
    }
    if step == 0 {
        return Err(Error::OutOfRange {
            what: "the number of frames between compared poses",
            requirement: "at least 1",
            value: 0.0,
        });
    }
    if estimated.len() <= step {
        return Err(Error::TooFew {
            what: "a relative pose error from frames",
            needed: step.saturating_add(1),
            got: estimated.len(),
        });
    }
    let (mut translations, mut rotations) = (Vec::new(), Vec::new());
    for i in 0..estimated.len() - step {
        let moved = estimated[i].inv_mul(&estimated[i + step]);
        let truly = truth[i].inv_mul(&truth[i + step]);
        let rest = truly.inv_mul(&moved);
        translations.push(rest.translation.vector.norm());
        rotations.push(rest.rotation.angle().to_degrees());
    }
    Ok(RelativePoseError {
        translation: ErrorStatistics::new(translations),
        rotation_deg: ErrorStatistics::new(rotations),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn cloud(count: usize, seed: u64) -> Vec<Point3<f64>> {
        let mut random = Random::new(seed);
        (0..count)
            .map(|_| Point3::from(Vector3::from_fn(|_, _| random.normal())))
            .collect()
    }

    #[test]
    fn known_similarities_are_found() {
        let truth = Similarity3::new(
            Vector3::new(3.0, -2.0, 0.5),
            Vector3::new(0.4, 1.1, -0.7),
            0.35,
        );
        // Also a flat set, whose covariance is singular.
        let mut flat = cloud(12, 2);
        flat.iter_mut().for_each(|p| p.z = 0.25);
        for from in [cloud(3, 1), cloud(50, 1), flat] {
            let to: Vec<_> = from.iter().map(|p| truth * p).collect();
            let found = align_points(&from, &to, AlignmentKind::Similarity).unwrap();
            assert!((found.scaling() - 0.35).abs() < 1e-12);
            assert!(found.isometry.rotation.angle_to(&truth.isometry.rotation) < 1e-7);
            for (a, b) in from.iter().zip(&to) {
                assert!((found * a - b).norm() < 1e-12);
            }
        }
    }

    /// A kilometer along the road, a centimeter to either side, for any heading.
    #[test]
    fn a_path_that_is_nearly_a_line_keeps_its_roll() {
        let mut random = Random::new(9);
        let along_x: Vec<_> = (0..200)
            .map(|i| {
                let mut sideways = || random.uniform(-0.01, 0.01);
                Point3::new(5.0 * f64::from(i), sideways(), sideways())
            })
            .collect();
        let axis = Vector3::new(0.8, 0.3, -0.5).normalize();
        for (lead, angle) in [(0.0, 0.0), (0.0, 0.3), (0.9, 1.0), (2.0, 2.5), (0.4, 3.0)] {
            let leads = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.7, 0.6) * lead);
            let from: Vec<_> = along_x.iter().map(|p| leads * p).collect();
            let truth = Similarity3::new(Vector3::new(3.0, -2.0, 0.5), axis * angle, 1.0);
            let to: Vec<_> = from.iter().map(|p| truth * p).collect();
            for kind in [AlignmentKind::Rigid, AlignmentKind::Similarity] {
                let found = align_points(&from, &to, kind).unwrap();
                let rest = found.isometry.rotation.inverse() * truth.isometry.rotation;
                // Coordinates near a kilometer are rounded to 1e-13 m.
                assert!(rest.angle() < 1e-11, "{lead} {angle}: {} rad", rest.angle());
            }
        }
    }

    #[test]
    fn a_mirrored_cloud_gets_a_rotation_nonetheless() {
        let from = cloud(30, 3);
        let to: Vec<_> = from.iter().map(|p| Point3::new(-p.x, p.y, p.z)).collect();
        let found = align_points(&from, &to, AlignmentKind::Rigid).unwrap();
        let matrix = *found.isometry.rotation.to_rotation_matrix().matrix();
        assert!((matrix.determinant() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn degenerate_sets_are_refused() {
        let line: Vec<_> = (0..5)
            .map(|i| Point3::new(f64::from(i), 2.0, 3.0))
            .collect();
        let good = cloud(5, 4);
        for (from, to) in [(&line, &good), (&good, &line)] {
            assert!(matches!(
                align_points(from, to, AlignmentKind::Rigid),
                Err(Error::Degenerate { .. })
            ));
        }
        assert!(align_points(&good[..2], &good[..2], AlignmentKind::Rigid).is_err());
        assert!(align_points(&good[..4], &good, AlignmentKind::Rigid).is_err());
        let mut bad = good.clone();
        bad[1].x = f64::NAN;
        assert!(align_points(&bad, &good, AlignmentKind::Rigid).is_err());
    }

    #[test]
    fn the_trajectory_error_is_the_noise() {
        let truth = cloud(2000, 5);
        let mut random = Random::new(6);
        let estimated: Vec<_> = truth
            .iter()
            .map(|p| p + Vector3::from_fn(|_, _| 0.01 * random.normal()))
            .map(|p| p * 3.0)
            .collect();
        let (error, _) =
            absolute_trajectory_error(&estimated, &truth, AlignmentKind::Similarity).unwrap();
        let expected = 0.01 * 3f64.sqrt();
        assert!((error.rmse / expected - 1.0).abs() < 0.05, "{error:?}");
        assert!(error.median <= error.rmse && error.rmse <= error.max);
    }

    #[test]
    fn rotations_between_frames_are_compared() {
        let rotation =
            |angle: f64| RigidTransform::new(Vector3::zeros(), Vector3::new(0.0, angle, 0.0));
        let truth = [rotation(0.0), rotation(0.1), rotation(0.2)];
        let estimated = [rotation(0.0), rotation(0.12), rotation(0.2)];
        let error = relative_pose_error(&estimated, &truth, 1).unwrap();
        assert!((error.rotation_deg.max - 0.02f64.to_degrees()).abs() < 1e-9);
        let error = relative_pose_error(&estimated, &truth, 2).unwrap();
        assert!(error.rotation_deg.max < 1e-9);
        assert!(relative_pose_error(&estimated, &truth, 3).is_err());
        assert!(relative_pose_error(&estimated, &truth, 0).is_err());
    }
}
