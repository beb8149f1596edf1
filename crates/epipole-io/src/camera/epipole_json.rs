//! JSON of `epipole calibrate` and `epipole pnp`.
//!
//! `image` (width and height), `k` (fx, fy, cx, cy), `distortion` (model and coefficients),
//! `cam_from_world` if the pose is known; for a rig also `right` (the same keys for the right
//! camera) and `stereo.right_from_left`. Pixel centers are at integers. Other keys are not read.

use super::named::Cameras;
use super::parts::matrix_rotation;
use crate::tree::Field;
use crate::{Error, Result};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::Translation3;
use serde_json::{Map, Value, json};

/// Largest coordinate of a translation, in units of the board.
const FAR: f64 = 1e12;

const KINDS: [LensKind; 4] = [
    LensKind::Brown,
    LensKind::Rational,
    LensKind::Fisheye,
    LensKind::Division,
];

/// Returns `image`, `k` and `distortion` of a camera, as in results and files.
pub fn camera_fields(camera: &Camera) -> [(&'static str, Value); 3] {
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

pub(super) fn is_it(root: &Field) -> bool {
    root.get("k").is_some() && root.get("distortion").is_some_and(|lens| lens.is_map())
        || root.get("image").is_some_and(|image| image.is_map())
}

pub(super) fn read(root: &Field) -> Result<Cameras> {
    let left = camera(root)?;
    let Some(right) = root.get("right") else {
        let mut cameras = Cameras::of(left);
        if let Some(pose) = root.get("cam_from_world") {
            cameras.cameras[0].cam_from_world = Some(motion(Some(&pose), "cam_from_world")?);
        }
        return Ok(cameras);
    };
    let stereo = root.get("stereo");
    let right_from_left = stereo.and_then(|stereo| stereo.get("right_from_left"));
    let right_from_left = motion(right_from_left.as_ref(), "stereo.right_from_left")?;
    Ok(Cameras::of_rig([left, camera(&right)?], right_from_left))
}

fn camera(field: &Field) -> Result<Camera> {
    let image = field.need("image", "width and height in pixels")?;
    let side = |name| image.need(name, "pixels")?.pixels();
    let k = field.need("k", "[fx, fy, cx, cy]")?;
    let [fx, fy, cx, cy] = k.numbers()?[..] else {
        return Err(k.wrong("is not [fx, fy, cx, cy]"));
    };
    let distortion = field.need("distortion", "model and coefficients")?;
    let model = distortion.need("model", "brown, rational, fisheye or division")?;
    let kind = (KINDS.into_iter())
        .find(|kind| Some(kind.name()) == model.text())
        .ok_or_else(|| model.wrong("is none of brown, rational, fisheye and division"))?;
    let coefficients = distortion.need("coefficients", "numbers of the lens model")?;
    Ok(Camera {
        intrinsics: Intrinsics::new(fx, fy, cx, cy)?,
        lens: Lens::from_coefficients(kind, &coefficients.numbers()?)?,
        width: side("width")?,
        height: side("height")?,
    })
}

/// Reads rotation and translation.
///
/// * `place`: keys that lead to the motion
fn motion(motion: Option<&Field>, place: &str) -> Result<RigidTransform> {
    let part = |name: &str, expected: &str| {
        let part = motion.and_then(|motion| motion.get(name));
        part.ok_or_else(|| Error::malformed(format!("{place}.{name} is not {expected}")))
    };
    let rotation = part("rotation", "nine numbers of a rotation")?;
    let translation = part("translation", "three numbers of meters")?;
    let numbers = translation.numbers()?;
    let [x, y, z] = numbers[..] else {
        return Err(translation.wrong("is not three numbers of meters"));
    };
    if numbers.iter().any(|x| x.abs() > FAR) {
        return Err(translation.wrong("is not three numbers of meters"));
    }
    let rotation = matrix_rotation(&rotation, &rotation.numbers()?)?;
    Ok(RigidTransform::from_parts(
        Translation3::new(x, y, z),
        rotation,
    ))
}

fn motion_fields(motion: &RigidTransform) -> Value {
    let rotation = motion.rotation.to_rotation_matrix();
    let rotation: Vec<f64> = rotation.matrix().transpose().iter().copied().collect();
    let translation: [f64; 3] = motion.translation.vector.into();
    json!({ "rotation": rotation, "translation": translation })
}

/// Writes one camera, or a rig of two.
pub(super) fn write(cameras: &Cameras) -> Result<String> {
    let fields = |camera| camera_fields(camera).map(|(name, value)| (name.to_owned(), value));
    let whole = match (&cameras.cameras[..], &cameras.right_from_left) {
        ([one], _) => {
            let pose = one.cam_from_world.as_ref().map(motion_fields);
            let pose = pose.map(|pose| ("cam_from_world".to_owned(), pose));
            Map::from_iter(fields(&one.camera).into_iter().chain(pose))
        }
        ([left, right], Some(motion)) => {
            let mut whole = Map::from_iter(fields(&left.camera));
            let right = Map::from_iter(fields(&right.camera));
            whole.insert("right".to_owned(), Value::Object(right));
            whole.insert(
                "stereo".to_owned(),
                json!({ "right_from_left": motion_fields(motion) }),
            );
            whole
        }
        (all, _) => {
            return Err(Error::unsupported(format!(
                "Epipole's JSON holds one camera or a rig of two, not {} cameras",
                all.len()
            )));
        }
    };
    Ok(format!("{:#}\n", Value::Object(whole)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::Syntax;
    use nalgebra::Vector3;

    fn camera(kind: LensKind) -> Camera {
        let numbers = [0.1, -0.2, 1e-3, 2e-3, 0.3, 0.4, 0.5, 0.6];
        Camera {
            width: 640,
            height: 480,
            intrinsics: Intrinsics::new(532.8, 533.1, 319.25, 1.0 / 3.0).unwrap(),
            lens: Lens::from_coefficients(kind, &numbers[..kind.num_coefficients()]).unwrap(),
        }
    }

    fn again(cameras: &Cameras) -> Cameras {
        let node = Syntax::Json.parse(&write(cameras).unwrap()).unwrap();
        let root = Field::root(&node);
        assert!(is_it(&root));
        read(&root).unwrap()
    }

    #[test]
    fn every_lens_comes_back_to_the_last_bit() {
        for kind in KINDS {
            let cameras = Cameras::of(camera(kind));
            assert_eq!(again(&cameras), cameras);
        }
        let motion =
            RigidTransform::new(Vector3::new(-0.1, 0.0, 1e-3), Vector3::new(0.1, 0.2, 0.3));
        let rig = Cameras::of_rig([LensKind::Brown, LensKind::Fisheye].map(camera), motion);
        let read = again(&rig);
        assert_eq!(read.cameras, rig.cameras);
        let off = read.right_from_left.unwrap().to_matrix() - motion.to_matrix();
        assert!(off.amax() < 1e-15);
        let three = Cameras {
            cameras: [&rig.cameras[..], &rig.cameras[..1]].concat(),
            ..Cameras::default()
        };
        assert!(matches!(write(&three), Err(Error::Unsupported { .. })));
    }

    #[test]
    fn errors_name_the_key() {
        let whole: Value =
            serde_json::from_str(&write(&Cameras::of(camera(LensKind::Brown))).unwrap()).unwrap();
        for (pointer, value, message) in [
            ("/k", json!([1, 2]), "k is not [fx, fy, cx, cy]"),
            (
                "/image/width",
                json!(0.5),
                "image.width is not a whole number above 0: \"0.5\"",
            ),
            (
                "/distortion/model",
                json!("fov"),
                "distortion.model is none of brown, rational, fisheye and division",
            ),
            (
                "/distortion/coefficients",
                json!("a"),
                "distortion.coefficients is not a list of finite numbers: \"a\"",
            ),
            (
                "/distortion/coefficients",
                Value::Null,
                "distortion.coefficients is missing: numbers of the lens model",
            ),
        ] {
            let mut changed = whole.clone();
            *changed.pointer_mut(pointer).unwrap() = value;
            let node = Syntax::Json.parse(&changed.to_string()).unwrap();
            assert_eq!(read(&Field::root(&node)).unwrap_err().to_string(), message);
        }
    }
}
