//! Cameras of `transforms.json`, which nerfstudio and instant-ngp read.
//!
//! `fl_x`, `fl_y`, `cx`, `cy`, `w`, `h` and the lens are at the top level or in each frame; a
//! frame's camera has the name of its `file_path`. Without `fl_x`, `camera_angle_x` is the
//! horizontal field of view, radians. The center of the first pixel is at (0.5, 0.5), so half a
//! pixel is subtracted from `cx` and `cy`.
//!
//! Source: nerfstudio's documentation, "Data conventions"; instant-ngp, `scripts/colmap2nerf.py`.

use super::named::Cameras;
use super::parts::{Size, lens, size_or};
use crate::Result;
use crate::error::set_aside;
use crate::tree::Field;
use epipole::camera::{Camera, Intrinsics, Lens, LensKind};

pub(super) fn is_it(root: &Field) -> bool {
    let keys = ["fl_x", "camera_angle_x", "frames"];
    keys.iter().any(|key| root.get(key).is_some())
}

/// * `size`: of the images, for a file without one
pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let frames = root.get("frames").and_then(|frames| frames.items());
    let frames = frames.unwrap_or_default();
    let has_own = |frame: &Field| frame.get("fl_x").or(frame.get("camera_angle_x")).is_some();
    if !frames.iter().any(has_own) {
        return Ok(Cameras::of(camera(&Keys([root, root]), size)?));
    }
    let mut cameras = Vec::new();
    for frame in &frames {
        let name = frame.need("file_path", "the image of the frame")?;
        let camera = set_aside(camera(&Keys([frame, root]), size))?;
        cameras.push((name.text().unwrap_or_default().to_owned(), camera));
    }
    Cameras::of_list(cameras)
}

/// Keys of a frame, with those of the whole file as defaults.
struct Keys<'a>([&'a Field<'a>; 2]);

impl<'a> Keys<'a> {
    fn get(&self, key: &str) -> Option<Field<'a>> {
        self.0[0].get(key).or_else(|| self.0[1].get(key))
    }

    fn number(&self, key: &str) -> Result<Option<f64>> {
        self.get(key).map(|field| field.number()).transpose()
    }
}

/// Reads the camera of a frame.
///
/// * `document`: the whole file, for keys missing in the frame
/// * `size`: of the images, for a file without one
///
/// # Errors
/// [`Error::Malformed`](crate::Error::Malformed) without a size or focal length,
/// [`Error::Unsupported`](crate::Error::Unsupported) for other lenses.
pub(crate) fn camera_of_frame(
    frame: &Field,
    document: &Field,
    size: Option<(u32, u32)>,
) -> Result<Camera> {
    camera(&Keys([frame, document]), size)
}

fn camera(keys: &Keys, size: Option<Size>) -> Result<Camera> {
    let (width, height) = match (keys.get("w"), keys.get("h")) {
        (Some(width), Some(height)) => (width.pixels()?, height.pixels()?),
        _ => size_or(size, "w and h")?,
    };
    let focal = |name: &str, angle: &str, side: u32| -> Result<Option<f64>> {
        let of_angle = |angle: f64| f64::from(side) / 2.0 / libm::tan(angle / 2.0);
        match keys.number(name)? {
            Some(focal_px) => Ok(Some(focal_px)),
            None => Ok(keys.number(angle)?.map(of_angle)),
        }
    };
    let fx = focal("fl_x", "camera_angle_x", width)?;
    let fy = focal("fl_y", "camera_angle_y", height)?;
    let (Some(fx), Some(fy)) = (fx.or(fy), fy.or(fx)) else {
        let expected = "focal length in pixels, or camera_angle_x";
        return Err(keys.0[1].missing("fl_x", expected));
    };
    let cx = keys.number("cx")?.unwrap_or(f64::from(width) / 2.0);
    let cy = keys.number("cy")?.unwrap_or(f64::from(height) / 2.0);
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::from_colmap([fx, fy, cx, cy])?,
        lens: lens_of(keys)?,
    })
}

fn lens_of(keys: &Keys) -> Result<Lens> {
    let mut k = [0.0; 6];
    for (k, key) in k.iter_mut().zip(["k1", "k2", "k3", "k4", "p1", "p2"]) {
        *k = keys.number(key)?.unwrap_or(0.0);
    }
    let [k1, k2, k3, k4, p1, p2] = k;
    let model = keys.get("camera_model");
    let name = model.as_ref().and_then(|model| model.text());
    let flag = keys.get("is_fisheye");
    let is_fisheye = flag
        .and_then(|flag| flag.text())
        .is_some_and(|flag| flag == "true");
    match (name, is_fisheye) {
        (Some("OPENCV_FISHEYE"), _) | (None, true) => lens(LensKind::Fisheye, &[k1, k2, k3, k4]),
        (None | Some("OPENCV" | "PINHOLE" | "SIMPLE_PINHOLE" | "SIMPLE_RADIAL" | "RADIAL"), _) => {
            match keys.get("k4").filter(|_| k4 != 0.0) {
                Some(field) => Err(field.unsupported(
                    "is not 0: the eighth power of the radius is supported for fisheyes only",
                )),
                None => lens(LensKind::Brown, &[k1, k2, p1, p2, k3]),
            }
        }
        (Some(other), _) => {
            let message = format!(
                "\"{other:.40}\" is not supported: OPENCV, OPENCV_FISHEYE, PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL and RADIAL are"
            );
            Err(match model {
                Some(field) => field.unsupported(&message),
                None => crate::Error::unsupported(message),
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::tree::Syntax;

    fn parse(text: &str, size: Option<Size>) -> Result<Cameras> {
        let node = Syntax::Json.parse(text).unwrap();
        let root = Field::root(&node);
        assert!(is_it(&root));
        read(&root, size)
    }

    #[test]
    fn half_a_pixel_is_subtracted() {
        let text = r#"{"camera_model": "OPENCV", "fl_x": 1072.0, "fl_y": 1068.0, "cx": 1504.0,
            "cy": 1000.5, "w": 3008, "h": 2000, "k1": 0.03, "k2": -0.02, "p1": 1e-4, "p2": 2e-4}"#;
        let camera = parse(text, None).unwrap().cameras[0].camera;
        let k = Intrinsics::new(1072.0, 1068.0, 1503.5, 1000.0).unwrap();
        assert_eq!((camera.intrinsics, camera.width), (k, 3008));
        assert_eq!(camera.lens.coefficients(), [0.03, -0.02, 1e-4, 2e-4, 0.0]);
        let fisheye = text.replace("OPENCV", "OPENCV_FISHEYE");
        let fisheye = parse(&fisheye, None).unwrap().cameras[0].camera;
        assert_eq!(fisheye.lens.coefficients(), [0.03, -0.02, 0.0, 0.0]);
        for (from, to) in [("OPENCV", "EQUIRECTANGULAR"), ("p1", "k4")] {
            let error = parse(&text.replace(from, to), None).unwrap_err();
            assert!(matches!(error, Error::Unsupported { .. }), "{error}");
        }
    }

    #[test]
    fn an_angle_needs_the_size_of_the_images() {
        let text =
            r#"{"camera_angle_x": 0.6911112070083618, "frames": [{"file_path": "./train/r_0"}]}"#;
        let camera = parse(text, Some((800, 600))).unwrap().cameras[0].camera;
        // The usual focal length of NeRF's synthetic scenes.
        assert!((camera.intrinsics.fu_px() - 1111.1110311937682).abs() < 1e-9);
        assert_eq!(camera.intrinsics.fu_px(), camera.intrinsics.fv_px());
        assert_eq!(camera.intrinsics.principal_point(), [399.5, 299.5].into());
        let message = "the file has no image size: w and h are missing";
        assert_eq!(parse(text, None).unwrap_err().to_string(), message);
    }

    #[test]
    fn frames_have_their_own_cameras() {
        let text = r#"{"w": 640, "h": 480, "frames": [
            {"file_path": "a b.png", "fl_x": 500}, {"file_path": "ç.png", "fl_x": 510, "w": 320, "h": 240}]}"#;
        let cameras = parse(text, None).unwrap();
        assert_eq!(cameras.named("a b.png").unwrap().width, 640);
        assert_eq!(cameras.named("ç.png").unwrap().height, 240);
        let error = parse(r#"{"fl_x": null, "frames": [], "w": 4, "h": 4}"#, None).unwrap_err();
        let message = "fl_x is missing: focal length in pixels, or camera_angle_x";
        assert_eq!(error.to_string(), message);
    }
}
