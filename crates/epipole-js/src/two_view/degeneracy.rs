//! Checks for matches that do not determine a model.

use crate::argument::{Argument, Vectors, not};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Mask, Output, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, RigidTransform};
use epipole::two_view::{self, ExplainingRotation, RotationAndFocal, TwoViewOptions};

structs! {
    /// Reason why the inliers of a model do not determine it.
    struct Degeneracy as Degeneracy {
        /// Kind.
        kind: Kind,
        /// Number of inliers that show it.
        num_explained: usize,
        /// Number of inliers.
        num_inliers: usize,
    }
}

records! {
    /// Rotation that explains nearly all inliers of a model.
    ExplainingRotation as ExplainingRotation {
        /// Rotation, with a translation of 0.
        cam2_from_cam1: RigidTransform,
        /// Number of inliers that it explains.
        num_explained: usize,
        /// Number of inliers.
        num_inliers: usize,
    }

    /// Rotation and focal length that explain nearly all inliers of a model.
    RotationAndFocal as RotationAndFocal {
        /// Rotation, with a translation of 0.
        cam2_from_cam1: RigidTransform,
        /// Ratio of the focal lengths to the given ones.
        focal_factor: f64,
        /// Number of unique matches that it explains.
        num_explained: usize,
        /// Number of unique matches.
        num_inliers: usize,
    }
}

/// Name of a degeneracy.
struct Kind(&'static str);

impl Output for Kind {
    fn typescript(_: &mut Types) -> String {
        "\"unmoved\" | \"homography\"".to_owned()
    }

    fn into_value(self) -> Value {
        Value::Text(self.0.to_owned())
    }
}

impl From<two_view::Degeneracy> for Degeneracy {
    fn from(found: two_view::Degeneracy) -> Self {
        let (kind, num_explained, num_inliers) = match found {
            two_view::Degeneracy::Unmoved {
                num_unmoved,
                num_inliers,
            } => ("unmoved", num_unmoved, num_inliers),
            two_view::Degeneracy::Homography {
                num_explained,
                num_inliers,
            } => ("homography", num_explained, num_inliers),
        };
        Self {
            kind: Kind(kind),
            num_explained,
            num_inliers,
        }
    }
}

impl Argument for Mask {
    fn typescript(_: &mut Types) -> String {
        "ArrayLike<number>".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let numbers = value
            .numbers()
            .ok_or_else(|| not(name, "an array of 0 and 1", value))?;
        match numbers
            .iter()
            .find(|number| **number != 0.0 && **number != 1.0)
        {
            Some(number) => Err(Fault::of_range(format!(
                "{name} must contain 0 and 1 only, but contains {number}"
            ))),
            None => Ok(Self(numbers.iter().map(|number| *number == 1.0).collect())),
        }
    }
}

functions! {
    /// Reason why the inliers of F or E do not determine it: they did not move, or a homography
    /// explains them; null if there is none.
    fn find_degeneracy(
        pixels1: Vectors<2>, pixels2: Vectors<2>, inliers: Mask, options: Options<TwoViewOptions>
    ) -> Option<Degeneracy> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let found = two_view::find_degeneracy(&pixels1, &pixels2, &inliers.0, &options.0)?;
        found.map(Degeneracy::from)
    }

    /// The degeneracy of a model nearly all of whose inliers did not move; null if they did.
    fn find_unmoved(
        pixels1: Vectors<2>, pixels2: Vectors<2>, inliers: Mask, options: Options<TwoViewOptions>
    ) -> Option<Degeneracy> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let found = two_view::find_unmoved(&pixels1, &pixels2, &inliers.0, &options.0)?;
        found.map(Degeneracy::from)
    }

    /// Rotation that explains the inliers of a model equally well; null if none does.
    fn find_explaining_rotation(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera, inliers: Mask,
        options: Options<TwoViewOptions>
    ) -> Option<ExplainingRotation> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        two_view::find_explaining_rotation(&pixels1, &pixels2, cameras, &inliers.0, &options.0)?
    }

    /// Rotation and factor of the focal lengths that explain the inliers of a model; null if none
    /// do.
    fn find_rotation_and_focal(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera, inliers: Mask,
        options: Options<TwoViewOptions>
    ) -> Option<RotationAndFocal> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        two_view::find_rotation_and_focal(&pixels1, &pixels2, cameras, &inliers.0, &options.0)?
    }
}
