//! Numbers under their own names: `fx`, `fy`, `cx`, `cy`, `k1` and so on, as in settings of
//! ORB-SLAM (`Camera.fx`, `Camera1.fx`) and JSON of depth cameras, phones and scripts.
//!
//! Pixel centers are at integers. A rig has `Camera.bf` (focal length times baseline), or
//! `Camera2.fx` with `Stereo.T_c1_c2`, meters.
//!
//! Source: ORB-SLAM3, "Calibration tutorial", 2021, and its examples of settings.

use super::named::Cameras;
use super::parts::{Size, fisheye, lens, matrix_rotation, opencv_lens, size_or, translation};
use crate::Result;
use crate::tree::Field;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::UnitQuaternion;

/// Prefixes of the names.
const PREFIXES: [&str; 3] = ["", "Camera.", "Camera1."];

fn prefix(root: &Field) -> Option<&'static str> {
    let has = |prefix: &&str| {
        ["fx", "fy"]
            .iter()
            .all(|name| root.get(&format!("{prefix}{name}")).is_some())
    };
    PREFIXES.into_iter().find(has)
}

pub(super) fn is_it(root: &Field) -> bool {
    prefix(root).is_some()
}

pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let prefix = prefix(root).unwrap_or_default();
    let left = camera(root, prefix, size)?;
    if prefix == "Camera1." && root.get("Camera2.fx").is_some() {
        let right = camera(root, "Camera2.", size)?;
        let motion = root.need("Stereo.T_c1_c2", "a 4 × 4 matrix")?;
        return Ok(Cameras::of_rig(
            [left, right],
            left_from_right(&motion)?.inverse(),
        ));
    }
    let baseline = match (root.get("Camera.bf"), root.get("Stereo.b")) {
        (Some(field), _) => Some((field.number()? / left.intrinsics.fu_px(), field)),
        (None, Some(field)) => Some((field.number()?, field)),
        (None, None) => None,
    };
    let Some((baseline, field)) = baseline else {
        return Ok(Cameras::of(left));
    };
    let x = translation(&field, [-baseline, 0.0, 0.0])?;
    let motion = RigidTransform::from_parts(x, UnitQuaternion::identity());
    Ok(Cameras::of_rig([left, left], motion))
}

fn camera(root: &Field, prefix: &str, size: Option<Size>) -> Result<Camera> {
    let number = |names: [&str; 2]| {
        let [first, second] = names.map(|name| format!("{prefix}{name}"));
        (root.get(&first).or_else(|| root.get(&second)))
            .ok_or_else(|| root.missing(&first, "a number of pixels"))?
            .number()
    };
    let side = |name: &str| {
        let names = [format!("{prefix}{name}"), format!("Camera.{name}")];
        names
            .iter()
            .find_map(|name| root.get(name))
            .map(|field| field.pixels())
            .transpose()
    };
    let (width, height) = match (side("width")?, side("height")?) {
        (Some(width), Some(height)) => (width, height),
        _ => size_or(size, "width and height")?,
    };
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::new(
            number(["fx", "fx"])?,
            number(["fy", "fy"])?,
            number(["cx", "ppx"])?,
            number(["cy", "ppy"])?,
        )?,
        lens: lens_of(root, prefix)?,
    })
}

fn lens_of(root: &Field, prefix: &str) -> Result<Lens> {
    let model = root.get("Camera.type").or_else(|| root.get("model"));
    let name = model.as_ref().and_then(Field::text).unwrap_or_default();
    if let Some(list) = root.get("coeffs").or_else(|| root.get("distortion")) {
        let numbers = list.numbers()?;
        return match (numbers.iter().all(|&k| k == 0.0), name.contains("inverse")) {
            (true, _) => Ok(Lens::NONE),
            (_, true) => {
                Err(list.unsupported("are those of an inverse model, which is not supported"))
            }
            _ => opencv_lens(&list, &numbers),
        };
    }
    let coefficient = |name: &str| match root.get(&format!("{prefix}{name}")) {
        Some(field) => field.number(),
        None => Ok(0.0),
    };
    let all = |names: &[&str]| {
        names
            .iter()
            .map(|name| coefficient(name))
            .collect::<Result<Vec<_>>>()
    };
    match (model, name) {
        (_, "Rectified") => Ok(Lens::NONE),
        (_, "" | "PinHole" | "pinhole") => {
            lens(LensKind::Brown, &all(&["k1", "k2", "p1", "p2", "k3"])?)
        }
        (Some(model), "KannalaBrandt8") => fisheye(&model, &all(&["k1", "k2", "k3", "k4"])?),
        (Some(model), _) if prefix.starts_with("Camera") => Err(model.unsupported(&format!(
            "\"{name:.40}\" is not supported: PinHole, Rectified and KannalaBrandt8 are"
        ))),
        _ => lens(LensKind::Brown, &all(&["k1", "k2", "p1", "p2", "k3"])?),
    }
}

/// A 4 × 4 matrix.
fn left_from_right(field: &Field) -> Result<RigidTransform> {
    let all: [f64; 16] = field.array()?;
    let rotation = [&all[..3], &all[4..7], &all[8..11]].concat();
    Ok(RigidTransform::from_parts(
        translation(field, [all[3], all[7], all[11]])?,
        matrix_rotation(field, &rotation)?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{CameraFormat, read_cameras};

    const SETTINGS: &str = "%YAML:1.0\n\nCamera.type: \"PinHole\"\nCamera.fx: 517.3\nCamera.fy: 516.5\n\
        Camera.cx: 318.6\nCamera.cy: 255.3\nCamera.k1: 0.26\nCamera.k2: -0.95\nCamera.p1: -0.005\n\
        Camera.p2: 0.002\nCamera.k3: 1.16\nCamera.width: 640\nCamera.height: 480\n";

    #[test]
    fn settings_of_orb_slam() {
        let (format, one) = read_cameras(SETTINGS.as_bytes(), None).unwrap();
        assert_eq!(format, CameraFormat::Flat);
        let camera = one.cameras[0].camera;
        assert_eq!(
            (camera.width, camera.intrinsics.principal_point().y),
            (640, 255.3)
        );
        assert_eq!(
            camera.lens.coefficients(),
            [0.26, -0.95, -0.005, 0.002, 1.16]
        );
        let rig = format!("{SETTINGS}Camera.bf: 51.73\n");
        let (_, rig) = read_cameras(rig.as_bytes(), None).unwrap();
        let baseline = rig.right_from_left.unwrap().translation.vector.x;
        assert!((baseline + 0.1).abs() < 1e-12, "{baseline}");
        let fisheye = SETTINGS.replace("PinHole", "KannalaBrandt8");
        let (_, fisheye) = read_cameras(fisheye.as_bytes(), None).unwrap();
        assert_eq!(fisheye.cameras[0].camera.lens.kind(), LensKind::Fisheye);
        let other = read_cameras(SETTINGS.replace("PinHole", "Omni").as_bytes(), None);
        let error = other.unwrap_err().to_string();
        assert!(
            error.starts_with("Camera.type \"Omni\" is not supported"),
            "{error}"
        );
    }

    #[test]
    fn two_cameras_of_orb_slam_3() {
        let second = SETTINGS
            .replace("Camera.fx", "Camera1.fx")
            .replace("Camera.fy", "Camera1.fy");
        let second = second.replace("Camera.c", "Camera1.c");
        let rig = format!(
            "{second}Camera2.fx: 500\nCamera2.fy: 500\nCamera2.cx: 320\nCamera2.cy: 240\n\
             Stereo.T_c1_c2: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n  \
             data: [1, 0, 0, 0.11, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
        );
        let (_, rig) = read_cameras(rig.as_bytes(), None).unwrap();
        assert_eq!(rig.cameras[1].camera.intrinsics.fu_px(), 500.0);
        assert_eq!(rig.right_from_left.unwrap().translation.vector.x, -0.11);
    }

    #[test]
    fn json_of_a_depth_camera() {
        let text = r#"{"width": 640, "height": 480, "fx": 615.1, "fy": 615.2, "ppx": 320.4, "ppy": 240.1,
            "model": "distortion.inverse_brown_conrady", "coeffs": [0, 0, 0, 0, 0]}"#;
        let (_, one) = read_cameras(text.as_bytes(), None).unwrap();
        assert_eq!(one.cameras[0].camera.intrinsics.principal_point().x, 320.4);
        let bent = text.replace("[0,", "[0.1,");
        let error = read_cameras(bent.as_bytes(), None).unwrap_err().to_string();
        assert!(error.contains("inverse model"), "{error}");
        let short = r#"{"fx": 500, "fy": 500, "cx": 320, "width": 640, "height": 480}"#;
        let error = read_cameras(short.as_bytes(), None)
            .unwrap_err()
            .to_string();
        assert!(error.contains("cy is missing"), "{error}");
    }
}
