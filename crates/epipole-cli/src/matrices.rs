//! Numbers on the command line and in results: intrinsics, matrices, motions.

use crate::failure::Failure;
use crate::photo::Photo;
use clap::Args;
use epipole::camera::{Intrinsics, RigidTransform};
use nalgebra::Matrix3;
use serde::Serialize;

/// The entries of a matrix, row by row.
pub(crate) fn row_major(matrix: &Matrix3<f64>) -> [f64; 9] {
    let mut entries = [0.0; 9];
    entries.copy_from_slice(matrix.transpose().as_slice());
    entries
}

/// A rotation matrix, row by row, and a translation.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Motion {
    rotation: [f64; 9],
    translation: [f64; 3],
}

impl From<&RigidTransform> for Motion {
    fn from(transform: &RigidTransform) -> Self {
        let rotation = transform.rotation.to_rotation_matrix();
        Self {
            rotation: row_major(rotation.matrix()),
            translation: transform.translation.vector.into(),
        }
    }
}

/// Reads `fx,fy,cx,cy`.
pub(crate) fn intrinsics(text: &str) -> Result<Intrinsics, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([fu, fv, cu, cv]) => {
            Intrinsics::new(*fu, *fv, *cu, *cv).map_err(|error| error.to_string())
        }
        _ => Err("it must be four numbers: fx,fy,cx,cy".to_owned()),
    }
}

/// Reads a number above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(format!("\"{text}\" is not a number above 0")),
    }
}

/// How the intrinsics of photographs are given.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct CameraArguments {
    /// Focal lengths and principal point in pixels.
    #[arg(long, value_name = "fx,fy,cx,cy", value_parser = intrinsics, allow_hyphen_values = true)]
    pub(crate) k: Option<Intrinsics>,
    /// Focal length in pixels, principal point in the middle.
    #[arg(long, value_name = "F", value_parser = positive, conflicts_with = "k")]
    pub(crate) focal_px: Option<f64>,
}

impl CameraArguments {
    /// The intrinsics given, if any.
    ///
    /// # Errors
    /// As [`Intrinsics::centered`].
    pub(crate) fn given(&self, photo: &Photo) -> Result<Option<Intrinsics>, Failure> {
        match (self.k, self.focal_px) {
            (Some(k), _) => Ok(Some(k)),
            (None, Some(focal_px)) => Ok(Some(centered(focal_px, photo)?)),
            (None, None) => Ok(None),
        }
    }

    /// Refuses intrinsics of the second camera alone, which nothing could be done with.
    ///
    /// # Errors
    /// A sentence that says what is missing.
    pub(crate) fn check_second(&self, k2: Option<Intrinsics>) -> Result<(), Failure> {
        if k2.is_some() && self.k.is_none() && self.focal_px.is_none() {
            return Err(Failure::usage(
                "--k2 is for the second camera: the first needs --k or --focal-px, too",
            ));
        }
        Ok(())
    }

    /// The intrinsics given, or else a guess from the photograph's own data, or else the field of
    /// view of a usual lens; with a sentence if it is a guess.
    ///
    /// # Errors
    /// As [`Intrinsics::centered`].
    pub(crate) fn or_guess(&self, photo: &Photo) -> Result<(Intrinsics, Option<String>), Failure> {
        if let Some(k) = self.given(photo)? {
            return Ok((k, None));
        }
        let (focal_px, from) = match photo.focal_px {
            Some(focal_px) => (focal_px, "from the photograph's EXIF data"),
            None => {
                let longer = photo.color.width().max(photo.color.height());
                (1.2 * f64::from(longer), "1.2 times the longer side")
            }
        };
        let sentence = format!("no --k or --focal-px: taking {focal_px:.0} px, {from}");
        Ok((centered(focal_px, photo)?, Some(sentence)))
    }
}

fn centered(focal_px: f64, photo: &Photo) -> Result<Intrinsics, Failure> {
    Ok(Intrinsics::centered(
        focal_px,
        photo.color.width(),
        photo.color.height(),
    )?)
}
