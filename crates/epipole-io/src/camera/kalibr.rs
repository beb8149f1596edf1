//! Camera chains of Kalibr, and the `sensor.yaml` of EuRoC.
//!
//! Pinhole cameras with `radtan` or `equidistant` distortion. Pixel centers are at integers;
//! `T_cn_cnm1` of a camera is the motion from the previous camera, meters.
//!
//! Source: Kalibr's wiki, "YAML formats"; Burri et al. 2016, "The EuRoC micro aerial vehicle
//! datasets".

use super::named::Cameras;
use super::parts::{fisheye, lens, matrix_motion};
use crate::Result;
use crate::error::set_aside;
use crate::tree::Field;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind};

/// Returns the cameras of a chain with their keys, `cam0` and so on.
fn chain<'a>(root: &Field<'a>) -> Vec<(String, Field<'a>)> {
    let is_camera = |key: &str, field: &Field| {
        let number = key.strip_prefix("cam");
        number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
            && field.is_map()
    };
    let entries = root.entries().into_iter();
    entries
        .filter(|(key, field)| is_camera(key, field))
        .collect()
}

fn is_camera(field: &Field) -> bool {
    field.get("intrinsics").is_some_and(|k| !k.is_map())
        && (field.get("camera_model").is_some() || field.get("distortion_model").is_some())
}

pub(super) fn is_it(root: &Field) -> bool {
    is_camera(root) || chain(root).iter().any(|(_, field)| is_camera(field))
}

pub(super) fn read(root: &Field) -> Result<Cameras> {
    let chain = chain(root);
    if chain.is_empty() {
        return Ok(Cameras::of(camera(root)?));
    }
    let mut cameras = Vec::new();
    for (name, field) in &chain {
        cameras.push((name.clone(), set_aside(camera(field))?));
    }
    let has_both = cameras.iter().take(2).all(|(_, camera)| camera.is_ok());
    let second = chain.get(1).filter(|_| has_both);
    let second = second.and_then(|(_, field)| field.get("T_cn_cnm1"));
    Ok(Cameras {
        right_from_left: second.map(|field| matrix_motion(&field)).transpose()?,
        ..Cameras::of_list(cameras)?
    })
}

fn camera(field: &Field) -> Result<Camera> {
    if let Some(model) = field.get("camera_model")
        && model.text() != Some("pinhole")
    {
        let name = model.text().unwrap_or_default();
        return Err(model.unsupported(&format!(
            "\"{name:.40}\" is not supported: pinhole is, with radtan or equidistant distortion"
        )));
    }
    let k = field.need("intrinsics", "[fx, fy, cx, cy]")?;
    let [fx, fy, cx, cy] = k.numbers()?[..] else {
        return Err(k.wrong("is not [fx, fy, cx, cy]"));
    };
    let resolution = field.need("resolution", "[width, height]")?;
    let sides = match resolution.items().as_deref() {
        Some([width, height]) => [width.pixels()?, height.pixels()?],
        _ => return Err(resolution.wrong("is not [width, height]")),
    };
    Ok(Camera {
        width: sides[0],
        height: sides[1],
        intrinsics: Intrinsics::new(fx, fy, cx, cy)?,
        lens: lens_of(field)?,
    })
}

fn lens_of(field: &Field) -> Result<Lens> {
    let Some(model) = field.get("distortion_model") else {
        return Ok(Lens::NONE);
    };
    let name = model.text().unwrap_or_default();
    if name == "none" {
        return Ok(Lens::NONE);
    }
    let coefficients = match field.get("distortion_coeffs") {
        Some(coefficients) => coefficients,
        None => field
            .get("distortion_coefficients")
            .ok_or_else(|| field.missing("distortion_coeffs", "four or five numbers"))?,
    };
    let numbers = coefficients.numbers()?;
    match name {
        "radtan" | "radial-tangential" | "plumb_bob" => match numbers[..] {
            [k1, k2, p1, p2] => lens(LensKind::Brown, &[k1, k2, p1, p2, 0.0]),
            [_, _, _, _, _] => lens(LensKind::Brown, &numbers),
            _ => Err(coefficients.wrong("is not k1, k2, p1, p2 and perhaps k3")),
        },
        "equidistant" | "equi" => fisheye(&coefficients, &numbers),
        other => Err(model.unsupported(&format!(
            "\"{other:.40}\" is not supported: radtan, equidistant and none are"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::tree::Syntax;

    /// From Kalibr's wiki, shortened.
    const CHAIN: &str = "cam0:
  camera_model: pinhole
  intrinsics: [461.629, 460.152, 362.680, 246.049]
  distortion_model: radtan
  distortion_coeffs: [-0.27695497, 0.06712482, 0.00087538, 0.00011556]
  T_cam_imu:
  - [0.01779318, 0.99967549,-0.01822936, 0.07008565]
  - [0.0, 0.0, 0.0, 1.0]
  rostopic: /cam0/image_raw
  resolution: [752, 480]
cam1:
  camera_model: pinhole
  intrinsics: [460.352, 459.135, 376.371, 238.325]
  distortion_model: equidistant
  distortion_coeffs: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
  T_cn_cnm1:
  - [0.0, -1.0, 0.0, -0.11]
  - [1.0, 0.0, 0.0, 0.01]
  - [0.0, 0.0, 1.0, -0.02]
  - [0.0, 0.0, 0.0, 1.0]
  resolution: [752, 480]
";

    fn parse(text: &str) -> Result<Cameras> {
        let node = Syntax::Yaml.parse(text).unwrap();
        let root = Field::root(&node);
        assert!(is_it(&root));
        read(&root)
    }

    #[test]
    fn a_chain_is_a_rig() {
        let rig = parse(CHAIN).unwrap();
        let [left, right] = &rig.cameras[..] else {
            panic!("{rig:?}")
        };
        assert_eq!((&*left.name, &*right.name), ("cam0", "cam1"));
        assert_eq!((left.camera.width, left.camera.height), (752, 480));
        let k3 = [-0.27695497, 0.06712482, 0.00087538, 0.00011556, 0.0];
        assert_eq!(left.camera.lens.coefficients(), k3);
        assert_eq!(right.camera.lens.kind(), LensKind::Fisheye);
        let motion = rig.right_from_left.unwrap();
        assert_eq!(motion.translation.vector.as_slice(), [-0.11, 0.01, -0.02]);
        // x of the left camera is y of the right one.
        let moved = motion.rotation * nalgebra::Vector3::x();
        assert!((moved - nalgebra::Vector3::y()).norm() < 1e-15);
        let five = CHAIN.replace("0.00011556]", "0.00011556, 0.5]");
        let five = parse(&five).unwrap();
        assert_eq!(five.cameras[0].camera.lens.coefficients()[4], 0.5);
    }

    #[test]
    fn the_file_of_a_sensor_is_one_camera() {
        let text = "sensor_type: camera\nresolution: [752, 480]\ncamera_model: pinhole\n\
            intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv\n\
            distortion_model: radial-tangential\n\
            distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n";
        let one = parse(text).unwrap();
        assert_eq!(one.cameras[0].camera.intrinsics.fu_px(), 458.654);
        assert_eq!(one.cameras[0].camera.lens.coefficients()[1], 0.07395907);
    }

    #[test]
    fn other_models_are_named() {
        for (from, to, message) in [
            (
                "camera_model: pinhole",
                "camera_model: omni",
                "cam0.camera_model \"omni\"",
            ),
            (
                "model: radtan",
                "model: fov",
                "cam0.distortion_model \"fov\"",
            ),
        ] {
            let rest = parse(&CHAIN.replacen(from, to, 1)).unwrap();
            assert_eq!((rest.cameras.len(), &*rest.cameras[0].name), (1, "cam1"));
            assert_eq!(rest.right_from_left, None);
            let note = format!("camera cam0 is left out: {message}");
            assert!(rest.notes[0].starts_with(&note), "{:?}", rest.notes);
            // Nothing remains without the second camera.
            let single = CHAIN.split("cam1:").next().unwrap().replacen(from, to, 1);
            let error = parse(&single).unwrap_err();
            assert!(matches!(error, Error::Unsupported { .. }));
            assert!(error.to_string().starts_with(&note), "{error}");
        }
        let short = CHAIN.replacen(", 362.680", "", 1);
        let message = "line 3: cam0.intrinsics is not [fx, fy, cx, cy]";
        assert_eq!(parse(&short).unwrap_err().to_string(), message);
    }
}
