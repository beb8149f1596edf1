//! Alignment of points, and comparison of trajectories.

use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Setting;
use crate::output::{Mask, Output, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::RigidTransform;
use epipole::nalgebra::Similarity3;
use epipole::sfm::{self, AlignmentKind, ErrorStatistics, RelativePoseError};

structs! {
    /// Error of a trajectory.
    struct TrajectoryError as TrajectoryError {
        /// Distances of the centers, in the unit of the truth.
        errors: ErrorStatistics,
        /// Alignment.
        truth_from_estimated: Similarity,
    }

    /// Similarity between two lists of points.
    struct SimilarityOfPoints as SimilarityOfPoints {
        /// From the first list to the second.
        to_from_from: Similarity,
        /// 1 for pairs that agree, otherwise 0.
        inliers: Mask,
    }
}

records! {
    /// Statistics of errors.
    ErrorStatistics as ErrorStatistics {
        /// Root of the mean square.
        rmse: f64,
        /// Mean.
        mean: f64,
        /// Median; the lower of the middle two for an even number.
        median: f64,
        /// Maximum.
        max: f64,
    }

    /// Errors of the motions between frames.
    RelativePoseError as RelativePoseError {
        /// Errors of the translations, in the unit of the trajectories.
        translation: ErrorStatistics,
        /// Errors of the rotations, degrees.
        rotation_deg: ErrorStatistics,
    }
}

/// A similarity of space.
#[derive(Clone, Copy)]
pub(crate) struct Similarity(pub(crate) Similarity3<f64>);

impl Output for Similarity {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "Similarity3 extends RigidTransform",
            "A similarity of space: `xInA = scale * R * xInB + t`.",
            &[("scale", "number", "Ratio of lengths.")],
        );
        <RigidTransform as Output>::typescript(types);
        "Similarity3".to_owned()
    }

    fn into_value(self) -> Value {
        let mut value = self.0.isometry.into_value();
        if let Value::Record(entries) = &mut value {
            entries.push(("scale".into(), self.0.scaling().into_value()));
        }
        value
    }
}

impl Argument for Similarity {
    fn typescript(types: &mut Types) -> String {
        <RigidTransform as Argument>::typescript(types);
        types.interface(
            "Similarity3Like extends RigidTransformLike",
            "A rotation, a translation and a scale.",
            &[("scale?", "number", "Ratio of lengths. 1 if not given.")],
        );
        "Similarity3Like".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = ["rotation", "quaternion", "translation", "scale"];
        check_keys(name, value, &keys)?;
        let scale = entry::<Option<f64>>(name, value, "scale")?.unwrap_or(1.0);
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Fault::of_range(format!(
                "{name}.scale must be greater than 0 and finite, but is {scale}"
            )));
        }
        let mut rigid = value.clone();
        if let Value::Record(entries) = &mut rigid {
            entries.retain(|(key, _)| key != "scale");
        }
        let rigid = RigidTransform::read(name, &rigid)?;
        Ok(Self(Similarity3::from_isometry(rigid, scale)))
    }
}

fn alignment_kind(kind: Option<Setting<AlignmentKind>>) -> AlignmentKind {
    kind.map_or(AlignmentKind::default(), |kind| kind.0)
}

functions! {
    /// Similarity that moves points best onto others, by least squares; "rigid" keeps the scale.
    fn align_points(
        from_points: Vectors<3>, to_points: Vectors<3>, kind: Option<Setting<AlignmentKind>>
    ) -> Similarity {
        let (from, to) = (from_points.points(), to_points.points());
        Similarity(sfm::align_points(&from, &to, alignment_kind(kind))?)
    }

    /// Distances between camera centers and their true ones after alignment.
    fn absolute_trajectory_error(
        estimated: Vectors<3>, truth: Vectors<3>, kind: Option<Setting<AlignmentKind>>
    ) -> TrajectoryError {
        let (estimated, truth) = (estimated.points(), truth.points());
        let kind = alignment_kind(kind);
        let (errors, aligned) = sfm::absolute_trajectory_error(&estimated, &truth, kind)?;
        TrajectoryError { errors, truth_from_estimated: Similarity(aligned) }
    }

    /// Errors of the motions over `step` frames, 1 if not given, between poses `worldFromCam`.
    fn relative_pose_error(
        estimated: Vec<RigidTransform>, truth: Vec<RigidTransform>, step: Option<u32>
    ) -> RelativePoseError {
        sfm::relative_pose_error(&estimated, &truth, step.unwrap_or(1) as usize)?
    }

    /// Similarity between two lists of points with outliers, by RANSAC. `maxDistance` is the
    /// threshold of an inlier, in the unit of the second list.
    fn estimate_similarity_of_points(
        from_points: Vectors<3>, to_points: Vectors<3>, max_distance: f64, seed: Option<u32>
    ) -> SimilarityOfPoints {
        let (from, to) = (from_points.points(), to_points.points());
        let seed = u64::from(seed.unwrap_or(0));
        let (found, inliers) = sfm::estimate_similarity_of_points(&from, &to, max_distance, seed)?;
        SimilarityOfPoints { to_from_from: Similarity(found), inliers: Mask(inliers) }
    }
}
