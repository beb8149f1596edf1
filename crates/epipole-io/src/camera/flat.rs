//! Numbers under their own names: `fx`, `fy`, `cx`, `cy`, `k1` and so on, as in settings of
//! ORB-SLAM (`Camera.fx`, `Camera1.fx`) and JSON of depth cameras, phones and scripts.
//!
//! Pixel centers are at integers. A rig has `Camera.bf` (focal length times baseline), or
//! `Camera2.fx` with `Stereo.T_c1_c2`, meters.
//!
//! Source: ORB-SLAM3, "Calibration tutorial", 2021, and its examples of settings.

use super::named::Cameras;
use super::parts::{Size, fisheye, matrix_motion, opencv_lens, size_or, translation};
use crate::tree::Field;
use crate::{Error, Result};
use epipole::camera::{Camera, Intrinsics, Lens};

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
        let left_from_right = matrix_motion(&root.need("Stereo.T_c1_c2", "a 4 × 4 matrix")?)?;
        return Ok(Cameras::of_rig([left, right], left_from_right.inverse()));
    }
    // The baseline of an RGB-D camera is virtual.
    let is_rgbd = ["DepthMapFactor", "RGBD.DepthMapFactor"];
    if is_rgbd.iter().any(|key| root.get(key).is_some()) {
        return Ok(Cameras::of(left));
    }
    let baseline = match (root.get("Camera.bf"), root.get("Stereo.b")) {
        (Some(field), _) => Some((field.number()? / left.intrinsics.fu_px(), field)),
        (None, Some(field)) => Some((field.number()?, field)),
        (None, None) => None,
    };
    Ok(match baseline {
        Some((baseline, field)) => {
            translation(&field, [baseline, 0.0, 0.0])?;
            Cameras::of_rectified([left, left], baseline)
        }
        None => Cameras::of(left),
    })
}

fn camera(root: &Field, prefix: &str, size: Option<Size>) -> Result<Camera> {
    let number = |names: &[&str]| {
        let found = names
            .iter()
            .find_map(|name| root.get(&format!("{prefix}{name}")));
        let expected = || root.missing(&format!("{prefix}{}", names[0]), "a number of pixels");
        found.ok_or_else(expected)?.number()
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
            number(&["fx"])?,
            number(&["fy"])?,
            number(&["cx", "ppx"])?,
            number(&["cy", "ppy"])?,
        )?,
        lens: lens_of(root, prefix)?,
    })
}

/// Names of lens models, lower case and without `_` and `-`, with those of their coefficients.
const BROWN: ([&str; 8], [&str; 8]) = (
    [
        "",
        "pinhole",
        "opencv",
        "radtan",
        "plumbbob",
        "brown",
        "brownconrady",
        "distortion.brownconrady",
    ],
    ["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"],
);
const FISHEYE: ([&str; 6], [&str; 4]) = (
    [
        "kannalabrandt8",
        "opencvfisheye",
        "fisheye",
        "equidistant",
        "kannalabrandt4",
        "distortion.kannalabrandt4",
    ],
    ["k1", "k2", "k3", "k4"],
);

fn lens_of(root: &Field, prefix: &str) -> Result<Lens> {
    let model = root.get("Camera.type").or_else(|| root.get("model"));
    let written = model.as_ref().and_then(Field::text).unwrap_or_default();
    let letters = written.chars().filter(|c| !matches!(c, '_' | '-'));
    let name = letters.collect::<String>().to_lowercase();
    let is_fisheye = FISHEYE.0.contains(&&*name);
    let list = root.get("coeffs").or_else(|| root.get("distortion"));
    let numbers = match &list {
        Some(list) => list.numbers()?,
        None => {
            let names = if is_fisheye { &FISHEYE.1[..] } else { &BROWN.1 };
            let coefficient = |name: &&str| match root.get(&format!("{prefix}{name}")) {
                Some(field) => field.number(),
                None => Ok(0.0),
            };
            names.iter().map(coefficient).collect::<Result<_>>()?
        }
    };
    let field = list.as_ref().or(model.as_ref()).unwrap_or(root);
    if is_fisheye {
        // RealSense adds a fifth coefficient of 0.
        let count = numbers.len() - usize::from(numbers.len() == 5 && numbers[4] == 0.0);
        fisheye(field, &numbers[..count])
    } else if name == "rectified" || numbers.iter().all(|&k| k == 0.0) {
        Ok(Lens::NONE)
    } else if BROWN.0.contains(&&*name) {
        opencv_lens(field, &numbers)
    } else {
        Err(Error::unsupported(format!(
            "the lens model \"{written:.40}\" is not supported: pinholes with OpenCV's coefficients and Kannala–Brandt's fisheye are"
        )))
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::{CameraFormat, read_cameras};
    use epipole::camera::LensKind;

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
        let (_, rgbd) = read_cameras(
            format!("{SETTINGS}Camera.bf: 40\nDepthMapFactor: 5000\n").as_bytes(),
            None,
        )
        .unwrap();
        assert_eq!(rgbd.right_from_left, None);
        let (_, rational) =
            read_cameras(format!("{SETTINGS}Camera.k6: 0.1\n").as_bytes(), None).unwrap();
        assert_eq!(rational.cameras[0].camera.lens.kind(), LensKind::Rational);
        let fisheye = SETTINGS.replace("PinHole", "KannalaBrandt8");
        let (_, fisheye) = read_cameras(fisheye.as_bytes(), None).unwrap();
        assert_eq!(fisheye.cameras[0].camera.lens.kind(), LensKind::Fisheye);
        let other = read_cameras(SETTINGS.replace("PinHole", "Omni").as_bytes(), None);
        let error = other.unwrap_err().to_string();
        assert!(
            error.starts_with("the lens model \"Omni\" is not supported"),
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
        assert!(error.contains("inverse_brown_conrady"), "{error}");
        let fisheye = bent.replace("inverse_brown_conrady", "kannala_brandt4");
        let (_, fisheye) = read_cameras(fisheye.as_bytes(), None).unwrap();
        assert_eq!(fisheye.cameras[0].camera.lens.kind(), LensKind::Fisheye);
        let short = r#"{"fx": 500, "fy": 500, "cx": 320, "width": 640, "height": 480}"#;
        let error = read_cameras(short.as_bytes(), None)
            .unwrap_err()
            .to_string();
        assert!(error.contains("cy is missing"), "{error}");
    }
}
