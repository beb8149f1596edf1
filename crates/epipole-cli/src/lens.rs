//! Files of calibrated cameras.

use crate::failure::Failure;
use crate::files;
use crate::matrices::FAR;
use clap::ValueEnum;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::{Matrix3, Point2, Rotation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};
use std::path::Path;

/// The model of a lens, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// Five numbers (Brown and Conrady), for usual lenses.
    Brown,
    /// Eight numbers, for wide angles.
    Rational,
    /// Four numbers (Kannala and Brandt), for views of 120° and more.
    Fisheye,
    /// One number (Fitzgibbon's division model), for lenses that bend much and few boards.
    Division,
}

impl From<Model> for LensKind {
    fn from(model: Model) -> Self {
        match model {
            Model::Brown => Self::Brown,
            Model::Rational => Self::Rational,
            Model::Fisheye => Self::Fisheye,
            Model::Division => Self::Division,
        }
    }
}

/// `image`, `k` and `distortion`, as they stand in results and in files.
pub(crate) fn fields(camera: &Camera) -> [(&'static str, Value); 3] {
    let k = &camera.intrinsics;
    let center = k.principal_point();
    [
        (
            "image",
            json!({ "width": camera.width, "height": camera.height }),
        ),
        ("k", json!([k.fu_px(), k.fv_px(), center.x, center.y])),
        (
            "distortion",
            json!({ "model": camera.lens.kind().name(), "coefficients": camera.lens.coefficients() }),
        ),
    ]
}

/// Share of an image that has no rays: beyond the fold of its model, or beyond straight backwards.
pub(crate) fn unseen_share(camera: &Camera) -> f64 {
    const SIDE: u32 = 24;
    let at = |n: u32, size: u32| f64::from(size) * (f64::from(n) + 0.5) / f64::from(SIDE) - 0.5;
    let places = (0..SIDE * SIDE)
        .map(|n| Point2::new(at(n % SIDE, camera.width), at(n / SIDE, camera.height)));
    let unseen = places
        .filter(|place| camera.unproject(place).is_err())
        .count();
    unseen as f64 / f64::from(SIDE * SIDE)
}

/// Reads a stereo rig, left camera, right camera and right_from_left, from a file that
/// `epipole calibrate --right` wrote.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_rig(path: &Path) -> Result<([Camera; 2], RigidTransform), Failure> {
    parse_rig(&files::read_text(path)?, path)
}

/// As [`read_rig`], from the text of the file.
///
/// # Errors
/// As [`read`].
pub(crate) fn parse_rig(text: &str, path: &Path) -> Result<([Camera; 2], RigidTransform), Failure> {
    let cameras = [parse(text, path, false)?, parse(text, path, true)?];
    let malformed = |why: &str| Failure::new("malformed", why).about(path);
    let whole: Value = serde_json::from_str(text).map_err(|error| malformed(&error.to_string()))?;
    let motion = &whole["stereo"]["right_from_left"];
    let numbers = |name: &str| -> Option<Vec<f64>> {
        (motion[name].as_array()?.iter())
            .map(Value::as_f64)
            .collect()
    };
    let rotation = numbers("rotation")
        .filter(|numbers| numbers.len() == 9)
        .map(|numbers| Matrix3::from_row_slice(&numbers))
        .filter(|r| {
            (r.transpose() * r - Matrix3::identity()).amax() < 1e-6 && r.determinant() > 0.0
        })
        .ok_or_else(|| {
            malformed("stereo.right_from_left.rotation is not nine numbers of a rotation")
        })?;
    let translation = numbers("translation")
        .filter(|numbers| numbers.len() == 3 && numbers.iter().all(|x| x.abs() <= *FAR.end()))
        .ok_or_else(|| {
            malformed("stereo.right_from_left.translation is not three numbers of meters")
        })?;
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    let right_from_left = RigidTransform::from_parts(
        Vector3::from_column_slice(&translation).into(),
        UnitQuaternion::from_rotation_matrix(&rotation),
    );
    Ok((cameras, right_from_left))
}

/// Reads a camera from a file that `epipole calibrate` wrote.
///
/// # Errors
/// A sentence that names the file and what is wrong in it.
pub(crate) fn read(path: &Path, is_right: bool) -> Result<Camera, Failure> {
    parse(&files::read_text(path)?, path, is_right)
}

/// As [`read`], from the text of the file.
///
/// # Errors
/// As [`read`].
pub(crate) fn parse(text: &str, path: &Path, is_right: bool) -> Result<Camera, Failure> {
    let malformed = |why: String| Failure::new("malformed", why).about(path);
    let whole: Value = serde_json::from_str(text)
        .map_err(|error| malformed(format!("this is not JSON: {error}")))?;
    let camera = if is_right { &whole["right"] } else { &whole };
    if camera.is_null() {
        return Err(malformed(
            "there is no right camera in it; calibrate with --right".to_owned(),
        ));
    }
    let side = |name: &str| {
        let side = camera["image"][name].as_u64();
        side.and_then(|side| u32::try_from(side).ok())
            .ok_or_else(|| malformed(format!("image.{name} is not a whole number")))
    };
    let numbers = |list: &Value, name: &str| -> Result<Vec<f64>, Failure> {
        let list = list.as_array().map(|l| l.iter().map(Value::as_f64));
        list.and_then(Iterator::collect)
            .ok_or_else(|| malformed(format!("{name} is not a list of numbers")))
    };
    let k = numbers(&camera["k"], "k")?;
    let [fx, fy, cx, cy] = k[..] else {
        return Err(malformed("k is not [fx, fy, cx, cy]".to_owned()));
    };
    let model = camera["distortion"]["model"].as_str().unwrap_or_default();
    let kinds = [
        LensKind::Brown,
        LensKind::Rational,
        LensKind::Fisheye,
        LensKind::Division,
    ];
    let kind = (kinds.into_iter())
        .find(|kind| kind.name() == model)
        .ok_or_else(|| {
            malformed(
                "distortion.model is none of brown, rational, fisheye and division".to_owned(),
            )
        })?;
    let coefficients = numbers(
        &camera["distortion"]["coefficients"],
        "distortion.coefficients",
    )?;
    let about = |error: epipole::Error| Failure::from(error).about(path);
    Ok(Camera {
        intrinsics: Intrinsics::new(fx, fy, cx, cy).map_err(about)?,
        lens: Lens::from_coefficients(kind, &coefficients).map_err(about)?,
        width: side("width")?,
        height: side("height")?,
    })
}
