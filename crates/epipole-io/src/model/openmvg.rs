//! openMVG's `sfm_data.json`, version 0.3.
//!
//! A pose is a rotation, camera from world, and the center of the camera in the world; pixels are
//! those of openMVG's detectors, with centers at integers. Lenses are OpenCV's; tangential terms
//! follow the radial ones.
//!
//! Source: openMVG, `src/openMVG/sfm/sfm_data_io_cereal.cpp`, `src/openMVG/cameras/`.

use super::notes::LeftOut;
use super::{CameraList, Model, ModelFile, ModelImage, ModelPoint};
use crate::error::set_aside;
use crate::rotation::{FOUR_DIGITS, pose, rotation_from_matrix};
use crate::tree::{Field, Syntax};
use crate::{Error, Result, text};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::{Matrix3, Point2, Point3, Vector3};
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};

/// Bit of a pointer ID that cereal sets at its first use.
const IS_NEW: u64 = 1 << 31;

/// Type ID of cereal for objects without a type name.
const NO_TYPE: u64 = 1 << 30;

/// Returns keys and values of a map; empty if it is absent.
fn entries<'a>(document: &Field<'a>, key: &str) -> Result<Vec<(u64, Field<'a>)>> {
    let Some(map) = document.get(key) else {
        return Ok(Vec::new());
    };
    let entry = |node: Field<'a>| {
        Ok((
            node.need("key", "the number of an entry")?.whole()?,
            node.need("value", "the entry of a key")?,
        ))
    };
    map.list()?.into_iter().map(entry).collect()
}

fn camera(value: &Field<'_>, names: &mut HashMap<u64, String>) -> Result<Camera> {
    let data = value
        .need("ptr_wrapper", "an object of cereal")?
        .need("data", "the fields of an object")?;
    let id = value.need("polymorphic_id", "the number of a camera model")?;
    let number = id.whole()? & (IS_NEW - 1);
    if let Some(name) = value.get("polymorphic_name") {
        names.insert(number, name.word()?.to_owned());
    }
    let name = (names.get(&number)).ok_or_else(|| id.wrong("names no camera model"))?;
    // Old files have the pinhole in a separate object.
    let pinhole = data.get("value0").unwrap_or_else(|| data.clone());
    let side = |key: &str| {
        let side = pinhole.need(key, "pixels")?;
        side.pixels()
    };
    let lens = match name.as_str() {
        "pinhole" => Lens::NONE,
        "pinhole_radial_k1" => {
            let [k1] = data.need("disto_k1", "k1")?.array()?;
            Lens::from_coefficients(LensKind::Brown, &[k1, 0.0, 0.0, 0.0, 0.0])?
        }
        "pinhole_radial_k3" => {
            let [k1, k2, k3] = data.need("disto_k3", "k1, k2, k3")?.array()?;
            Lens::from_coefficients(LensKind::Brown, &[k1, k2, 0.0, 0.0, k3])?
        }
        "pinhole_brown_t2" => {
            let [k1, k2, k3, t1, t2] = data.need("disto_t2", "k1, k2, k3, t1, t2")?.array()?;
            Lens::from_coefficients(LensKind::Brown, &[k1, k2, t1, t2, k3])?
        }
        "fisheye" => {
            let k: [f64; 4] = data.need("fisheye", "k1 to k4")?.array()?;
            Lens::from_coefficients(LensKind::Fisheye, &k)?
        }
        other => {
            return Err(Error::unsupported(format!(
                "openMVG's camera {other} is not supported: only pinhole, pinhole_radial_k1, \
                 pinhole_radial_k3, pinhole_brown_t2 and fisheye are"
            )));
        }
    };
    let f = pinhole.need("focal_length", "pixels")?.number()?;
    let [cx, cy] = pinhole.need("principal_point", "x, y in pixels")?.array()?;
    Ok(Camera {
        width: side("width")?,
        height: side("height")?,
        intrinsics: Intrinsics::new(f, f, cx, cy)?,
        lens,
    })
}

fn cam_from_world(value: &Field<'_>) -> Result<RigidTransform> {
    let node = value.need("rotation", "camera from world")?;
    let rows = node.list()?;
    if rows.len() != 3 {
        return Err(node.wrong(&format!("has {} rows, not 3", rows.len())));
    }
    let mut matrix = Matrix3::zeros();
    for (i, row) in rows.iter().enumerate() {
        let row: [f64; 3] = row.array()?;
        for (j, value) in row.into_iter().enumerate() {
            matrix[(i, j)] = value;
        }
    }
    let rotation =
        rotation_from_matrix(&matrix, FOUR_DIGITS).ok_or_else(|| node.wrong("is no rotation"))?;
    let center = Vector3::from(
        value
            .need("center", "the center of a camera")?
            .array::<3>()?,
    );
    pose(rotation, -(rotation * center)).ok_or_else(|| value.wrong("is not finite"))
}

/// Reads a document.
///
/// Also returns sentences on omitted parts.
pub(super) fn read(bytes: &[u8]) -> Result<(Model, Vec<String>)> {
    let node = Syntax::Json.parse(text::decode(bytes)?)?;
    let document = Field::root(&node);
    let mut names = HashMap::new();
    let (mut cameras, mut camera_of_key) = (CameraList::default(), HashMap::new());
    for (key, value) in entries(&document, "intrinsics")? {
        let camera = set_aside(camera(&value, &mut names))?;
        camera_of_key.insert(key, camera.map(|camera| cameras.number_of(camera)));
    }
    let mut poses = HashMap::new();
    for (key, value) in entries(&document, "extrinsics")? {
        poses.insert(key, cam_from_world(&value)?);
    }
    let (mut images, mut image_of_view) = (Vec::new(), HashMap::new());
    let (mut left_out, mut num_without) = (LeftOut::default(), 0_usize);
    for (key, value) in entries(&document, "views")? {
        let data = value
            .need("ptr_wrapper", "an object of cereal")?
            .need("data", "the fields of an object")?;
        let view = data.get("value0").unwrap_or(data);
        let number = |key: &str| view.need(key, "a number of an entry")?.whole();
        let (camera, pose) = (
            camera_of_key.get(&number("id_intrinsic")?),
            poses.get(&number("id_pose")?),
        );
        let (Some(camera), Some(pose)) = (camera, pose) else {
            num_without += 1;
            continue;
        };
        let folder = view
            .get("local_path")
            .map_or(Ok(""), |folder| folder.word())?;
        let name = view.need("filename", "the file of an image")?.word()?;
        let camera = match camera {
            Ok(camera) => *camera,
            Err(why) => {
                left_out.add(why, Some(name));
                continue;
            }
        };
        if image_of_view.insert(key, images.len()).is_some() {
            return Err(Error::malformed(format!("two views have the key {key}")));
        }
        images.push(ModelImage {
            id: u32::try_from(key).map_err(|_| value.wrong("has a key beyond 32 bits"))?,
            name: match folder.trim_end_matches('/') {
                "" => name.to_owned(),
                folder => format!("{folder}/{name}"),
            },
            camera,
            cam_from_world: *pose,
            keypoints: Vec::new(),
        });
    }
    let mut notes = left_out.notes(images.len())?;
    if num_without > 0 {
        notes.push(format!(
            "{num_without} views have no pose or camera: left out"
        ));
    }
    // Keypoints by their numbers, per image.
    let mut places: Vec<BTreeMap<u64, usize>> = vec![BTreeMap::new(); images.len()];
    let (mut points, mut num_lost) = (Vec::new(), 0_usize);
    for (key, value) in entries(&document, "structure")? {
        let mut track = Vec::new();
        for (view, value) in entries(&value, "observations")? {
            let Some(&image) = image_of_view.get(&view) else {
                num_lost += 1;
                continue;
            };
            let feature = value.need("id_feat", "the number of a keypoint")?.whole()?;
            let keypoints = &mut images[image].keypoints;
            let place = match places[image].get(&feature) {
                // The maximum is not an ID; files without IDs have it for all keypoints.
                Some(place) if feature != u64::from(u32::MAX) => *place,
                _ => {
                    keypoints.push(Point2::from(value.need("x", "a pixel")?.array::<2>()?));
                    places[image].insert(feature, keypoints.len() - 1);
                    keypoints.len() - 1
                }
            };
            track.push((image, place));
        }
        points.push(ModelPoint {
            id: key,
            position: Point3::from(value.need("X", "a position")?.array::<3>()?),
            // The format has no colors.
            color: [128; 3],
            error_px: None,
            track,
        });
    }
    if num_lost > 0 {
        notes.push(format!(
            "{num_lost} observations are of views without a pose: left out"
        ));
    }
    let model = Model {
        cameras: cameras.into_list(),
        images,
        points,
        ..Model::default()
    };
    model.check()?;
    Ok((model, notes))
}

/// Returns the openMVG model of a camera, and the name and coefficients of its lens.
fn model_of(camera: &Camera) -> Result<(&'static str, &'static str, Vec<f64>)> {
    let k = camera.lens.coefficients();
    if camera.intrinsics.fu_px() != camera.intrinsics.fv_px() {
        return Err(Error::unsupported(format!(
            "openMVG has one focal length a camera, not {} and {}: undistort the images first",
            camera.intrinsics.fu_px(),
            camera.intrinsics.fv_px()
        )));
    }
    Ok(match camera.lens.kind() {
        LensKind::Brown if camera.lens.is_none() => ("pinhole", "", vec![]),
        LensKind::Brown => (
            "pinhole_brown_t2",
            "disto_t2",
            vec![k[0], k[1], k[4], k[2], k[3]],
        ),
        LensKind::Fisheye => ("fisheye", "fisheye", k),
        LensKind::Rational | LensKind::Division => {
            return Err(Error::unsupported(format!(
                "openMVG has no {} lens: undistort the images first",
                camera.lens.kind().name()
            )));
        }
    })
}

impl Model {
    /// Writes openMVG's `sfm_data.json`. Colors and keypoints without a point are lost.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for rational and division lenses and for pixels that are not square,
    /// [`Error::Malformed`] if an index of the model is wrong.
    pub fn to_openmvg(&self) -> Result<Vec<ModelFile>> {
        self.check()?;
        // Pointer IDs begin with the views.
        let pointer = |index: usize| IS_NEW + 1 + index as u64;
        let mut intrinsics = Vec::new();
        let mut known: Vec<&str> = Vec::new();
        for (index, camera) in self.cameras.iter().enumerate() {
            let (name, key, lens) = model_of(camera)?;
            let center = camera.intrinsics.principal_point();
            let mut data = json!({
                "width": camera.width, "height": camera.height,
                "focal_length": camera.intrinsics.fu_px(),
                "principal_point": [center.x, center.y],
            });
            if !key.is_empty() {
                data[key] = json!(lens);
            }
            let mut value = json!({
                "ptr_wrapper": { "id": pointer(self.images.len() + index), "data": data },
            });
            match known.iter().position(|other| *other == name) {
                Some(place) => value["polymorphic_id"] = (place + 1).into(),
                None => {
                    known.push(name);
                    value["polymorphic_id"] = (IS_NEW + known.len() as u64).into();
                    value["polymorphic_name"] = name.into();
                }
            }
            intrinsics.push(json!({ "key": index, "value": value }));
        }
        let (mut views, mut extrinsics) = (Vec::new(), Vec::new());
        for (index, image) in self.images.iter().enumerate() {
            let camera = &self.cameras[image.camera];
            views.push(json!({ "key": image.id, "value": {
                "polymorphic_id": NO_TYPE,
                "ptr_wrapper": { "id": pointer(index), "data": {
                    "local_path": "", "filename": image.name,
                    "width": camera.width, "height": camera.height,
                    "id_view": image.id, "id_intrinsic": image.camera, "id_pose": image.id,
                }},
            }}));
            let r = image.cam_from_world.rotation.to_rotation_matrix();
            let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)]];
            let center = image.center_in_world();
            extrinsics.push(json!({ "key": image.id, "value": {
                "rotation": [row(0), row(1), row(2)], "center": [center.x, center.y, center.z],
            }}));
        }
        let mut structure = Vec::new();
        for point in &self.points {
            let is_observed = |&(image, keypoint): &(usize, usize)| {
                let image = &self.images[image];
                let x = image.keypoints[keypoint];
                json!({ "key": image.id, "value": { "id_feat": keypoint, "x": [x.x, x.y] } })
            };
            let observations: Vec<Value> = point.track.iter().map(is_observed).collect();
            let p = point.position;
            structure.push(json!({ "key": point.id, "value": {
                "X": [p.x, p.y, p.z], "observations": observations,
            }}));
        }
        let document = json!({
            "sfm_data_version": "0.3", "root_path": "", "views": views, "intrinsics": intrinsics,
            "extrinsics": extrinsics, "structure": structure, "control_points": [],
        });
        Ok(vec![ModelFile::new(
            "sfm_data.json",
            format!("{document:#}\n"),
        )])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"{ "sfm_data_version": "0.3", "root_path": "/x", "views": [
        { "key": 0, "value": { "polymorphic_id": 1073741824, "ptr_wrapper": { "id": 2147483649, "data": {
            "local_path": "left/", "filename": "a b.JPG", "width": 640, "height": 480,
            "id_view": 0, "id_intrinsic": 1, "id_pose": 5 } } } },
        { "key": 1, "value": { "polymorphic_id": 1073741824, "ptr_wrapper": { "id": 2147483650, "data": {
            "local_path": "", "filename": "c.JPG", "width": 640, "height": 480,
            "id_view": 1, "id_intrinsic": 0, "id_pose": 1 } } } } ],
      "intrinsics": [
        { "key": 0, "value": { "polymorphic_id": 2147483649, "polymorphic_name": "pinhole_radial_k3",
            "ptr_wrapper": { "id": 2147483651, "data": { "width": 640, "height": 480,
            "focal_length": 500.0, "principal_point": [320.0, 240.0], "disto_k3": [0.1, 0.2, 0.3] } } } },
        { "key": 1, "value": { "polymorphic_id": 1,
            "ptr_wrapper": { "id": 2147483652, "data": { "value0": { "width": 640, "height": 480,
            "focal_length": 600.0, "principal_point": [321.0, 240.0] }, "disto_k3": [0.0, 0.0, 0.5] } } } } ],
      "extrinsics": [ { "key": 5, "value": {
        "rotation": [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], "center": [1.0, 2.0, 3.0] } } ],
      "structure": [ { "key": 0, "value": { "X": [1.0, 2.0, 5.0], "observations": [
        { "key": 0, "value": { "id_feat": 9, "x": [321.5, 240.0] } },
        { "key": 1, "value": { "id_feat": 2, "x": [1.0, 2.0] } } ] } } ],
      "control_points": [] }"#;

    #[test]
    fn types_are_named_once() {
        let (model, notes) = read(FILE.as_bytes()).unwrap();
        assert_eq!(model.cameras.len(), 2);
        assert_eq!(
            model.cameras[0].lens.coefficients(),
            [0.1, 0.2, 0.0, 0.0, 0.3]
        );
        assert_eq!(model.cameras[1].lens.coefficients()[4], 0.5);
        let [image] = &model.images[..] else {
            panic!("one view has a pose");
        };
        assert_eq!(
            (image.id, &*image.name, image.camera),
            (0, "left/a b.JPG", 1)
        );
        let in_cam = image.cam_from_world * Point3::new(1.0, 3.0, 5.0);
        assert!((in_cam - Point3::new(1.0, 0.0, 2.0)).norm() < 1e-15);
        assert_eq!(model.points[0].track, [(0, 0)]);
        assert!((model.mean_reprojection_px().unwrap().unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(notes.len(), 2, "{notes:?}");
    }

    #[test]
    fn wrong_values_are_named() {
        let of = |from: &str, to: &str| {
            let text = FILE.replacen(from, to, 1);
            read(text.as_bytes()).unwrap_err().to_string()
        };
        assert!(of("pinhole_radial_k3", "spherical").contains("spherical is not supported"));
        assert!(of("\"disto_k3\": [0.1, ", "\"disto_k3\": [").contains("has 2 numbers, not 3"));
        assert!(of("[0.0, 1.0, 0.0]", "[0.0, 2.0, 0.0]").contains("extrinsics[0].value.rotation"));
        assert!(of("\"polymorphic_id\": 1,", "\"polymorphic_id\": 2,").contains("names no camera"));
        assert!(
            of(
                "\"width\": 640, \"height\": 480,\n            \"focal",
                "\"focal"
            )
            .contains("width")
        );
    }
}
