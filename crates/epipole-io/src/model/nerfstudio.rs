//! nerfstudio's and instant-ngp's `transforms.json`.
//!
//! `transform_matrix` is world from camera, for cameras that look along −z with y up; pixel centers
//! are at halves. Intrinsics are in the document or in a frame. Tangential and radial terms are
//! OpenCV's. `applied_transform` is not undone.
//!
//! Source: nerfstudio's documentation, "Data conventions"; its `cameras/camera_utils.py` for the
//! equation of the lens.

use super::notes::LeftOut;
use super::{CameraList, Model, ModelFile, ModelFolder, ModelImage, points_of};
use crate::camera::nerfstudio::camera_of_frame;
use crate::cloud::read_ply;
use crate::error::set_aside;
use crate::rotation::{FOUR_DIGITS, half_turn, pose, rotation_from_matrix};
use crate::tree::{Field, Syntax};
use crate::{Error, Result, text};
use epipole::camera::{Camera, LensKind, RigidTransform};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// Key of the camera model.
const MODEL: &str = "camera_model";

/// Usual name of the file of points.
const POINTS: &str = "sparse_pc.ply";

/// Returns a pose from a matrix of three or four rows.
fn cam_from_world(matrix: &Field<'_>) -> Result<RigidTransform> {
    let rows = matrix.list()?;
    if !(3..=4).contains(&rows.len()) {
        return Err(matrix.wrong(&format!("has {} rows, not 4", rows.len())));
    }
    let mut world_from_cam = [[0.0; 4]; 3];
    for (row, node) in world_from_cam.iter_mut().zip(&rows) {
        *row = node.array()?;
    }
    let rotation = Matrix3::from_fn(|i, j| world_from_cam[i][j]);
    let rotation = rotation_from_matrix(&rotation, FOUR_DIGITS)
        .ok_or_else(|| matrix.wrong("has no rotation in its first three columns"))?;
    let center = Vector3::from_fn(|i, _| world_from_cam[i][3]);
    let cam_from_world = (rotation * half_turn()).inverse();
    pose(cam_from_world, -(cam_from_world * center))
        .ok_or_else(|| matrix.wrong("has a translation that is not finite"))
}

/// Reads a document.
///
/// * `folder`: folder of the document, for the points
///
/// Also returns sentences on omitted parts.
pub(super) fn read(bytes: &[u8], folder: &dyn ModelFolder) -> Result<(Model, Vec<String>)> {
    let node = Syntax::Json.parse(text::decode(bytes)?)?;
    let document = Field::root(&node);
    let (mut cameras, mut images) = (CameraList::default(), Vec::new());
    let frames = document.need("frames", "the images")?.list()?;
    let size = match document.get("w") {
        Some(_) => None,
        None => (frames
            .first()
            .and_then(|frame| frame.get("file_path")?.text()))
        .and_then(|name| folder.image_size(name)),
    };
    let (mut left_out, mut used) = (LeftOut::default(), Vec::new());
    for (index, frame) in frames.iter().enumerate() {
        let name = frame.need("file_path", "the image of the frame")?.word()?;
        let camera = match set_aside(camera_of_frame(frame, &document, size))? {
            Ok(camera) => cameras.number_of(camera),
            Err(why) => {
                left_out.add(&why, Some(name));
                continue;
            }
        };
        used.push(frame);
        images.push(ModelImage {
            id: u32::try_from(index + 1).unwrap_or(u32::MAX),
            name: name.to_owned(),
            camera,
            cam_from_world: cam_from_world(&frame.need("transform_matrix", "world from camera")?)?,
            keypoints: Vec::new(),
        });
    }
    let mut notes = left_out.notes(images.len())?;
    let id = |frame: &Field<'_>| {
        let id = frame.get("colmap_im_id")?.whole().ok()?;
        u32::try_from(id).ok()
    };
    let ids: Vec<u32> = used.iter().filter_map(|frame| id(frame)).collect();
    if ids.len() == images.len() && ids.iter().collect::<BTreeSet<_>>().len() == ids.len() {
        for (image, id) in images.iter_mut().zip(ids) {
            image.id = id;
        }
    }
    let mut points = Vec::new();
    if let Some(path) = document.get("ply_file_path") {
        let path = path.word()?;
        match folder.file(path.trim_start_matches("./")) {
            Some(bytes) => {
                let (cloud, of_points) = read_ply(&bytes).map_err(|error| error.in_file(path))?;
                points = points_of(cloud);
                notes.extend(of_points);
            }
            None => notes.push(format!("{path} is not there: no points")),
        }
    }
    if document.get("applied_transform").is_some() {
        notes.push("the world is that of the file: applied_transform is not undone".to_owned());
    }
    let model = Model {
        cameras: cameras.into_list(),
        images,
        points,
        ..Model::default()
    };
    Ok((model, notes))
}

/// Members of a frame or a document that describe a camera.
fn fields(camera: &Camera) -> Result<Map<String, Value>> {
    let [fx, fy, cx, cy] = camera.intrinsics.to_colmap();
    let k = camera.lens.coefficients();
    let (model, lens) = match camera.lens.kind() {
        LensKind::Brown => (
            "OPENCV",
            json!({ "k1": k[0], "k2": k[1], "k3": k[4], "p1": k[2], "p2": k[3] }),
        ),
        LensKind::Fisheye => (
            "OPENCV_FISHEYE",
            json!({ "k1": k[0], "k2": k[1], "k3": k[2], "k4": k[3] }),
        ),
        LensKind::Rational | LensKind::Division => {
            return Err(Error::unsupported(format!(
                "transforms.json has no {} lens: undistort the images first",
                camera.lens.kind().name()
            )));
        }
    };
    let mut fields = json!({
        MODEL: model, "w": camera.width, "h": camera.height,
        "fl_x": fx, "fl_y": fy, "cx": cx, "cy": cy,
    });
    if let (Value::Object(fields), Value::Object(lens)) = (&mut fields, lens) {
        // A k3 of 0 is left out, because some programs do not support it for this model.
        fields.extend(
            lens.into_iter()
                .filter(|(key, value)| key != "k3" || *value != 0.0),
        );
    }
    match fields {
        Value::Object(fields) => Ok(fields),
        _ => Ok(Map::new()),
    }
}

impl Model {
    /// Writes nerfstudio's `transforms.json`, and `sparse_pc.ply` if there are points. Names of
    /// images become paths unchanged; `file_path` is relative to the folder of the file. Keypoints
    /// and tracks are lost.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for rational and division lenses, [`Error::Malformed`] if an index of
    /// the model is wrong.
    pub fn to_transforms(&self) -> Result<Vec<ModelFile>> {
        self.check()?;
        let cameras = self.cameras.iter().map(fields);
        let cameras = cameras.collect::<Result<Vec<_>>>()?;
        let mut document = match &cameras[..] {
            [camera] => camera.clone(),
            // nerfstudio reads the camera model only from the document, but other values from
            // frames.
            [first, rest @ ..] if rest.iter().all(|camera| camera[MODEL] == first[MODEL]) => {
                Map::from_iter([(MODEL.to_owned(), first[MODEL].clone())])
            }
            _ => Map::new(),
        };
        let mut frames = Vec::new();
        for image in &self.images {
            let world_from_cam = image.cam_from_world.inverse();
            let rotation = (world_from_cam.rotation * half_turn()).to_rotation_matrix();
            let t = world_from_cam.translation.vector;
            let row =
                |i: usize| json!([rotation[(i, 0)], rotation[(i, 1)], rotation[(i, 2)], t[i]]);
            let mut frame = match cameras.len() {
                1 => Map::new(),
                _ => cameras[image.camera].clone(),
            };
            frame.insert("file_path".to_owned(), image.name.clone().into());
            frame.insert("colmap_im_id".to_owned(), image.id.into());
            let matrix = json!([row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]);
            frame.insert("transform_matrix".to_owned(), matrix);
            frames.push(Value::Object(frame));
        }
        document.insert("frames".to_owned(), frames.into());
        let mut files = Vec::new();
        if !self.points.is_empty() {
            document.insert("ply_file_path".to_owned(), POINTS.into());
            files.push(ModelFile::new(POINTS, self.to_ply()));
        }
        let text = format!("{:#}\n", Value::Object(document));
        files.insert(0, ModelFile::new("transforms.json", text));
        Ok(files)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn a_camera_looks_along_minus_z() {
        let text = r#"{ "camera_angle_x": 1.5707963267948966, "w": 640, "h": 480.0, "k1": 0.1,
            "applied_transform": [], "ply_file_path": "./none.ply",
            "frames": [
              { "file_path": "./images/a b.png", "colmap_im_id": 7, "transform_matrix":
                [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]] },
              { "file_path": "c.png", "colmap_im_id": 5, "fl_x": 400, "fl_y": 410, "cx": 300.5,
                "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] } ] }"#;
        let (model, notes) = read(text.as_bytes(), &|_: &str| None).unwrap();
        let first = &model.images[0];
        assert_eq!((first.id, &*first.name), (7, "./images/a b.png"));
        assert_eq!(first.center_in_world(), Point3::new(1.0, 2.0, 3.0));
        // In front of it, above it, right of it.
        let in_cam = first.cam_from_world * Point3::new(1.5, 3.0, 1.0);
        assert!((in_cam - Point3::new(0.5, -1.0, 2.0)).norm() < 1e-15);
        let k = model.cameras[first.camera].intrinsics;
        assert!((k.fu_px() - 320.0).abs() < 1e-12 && k.principal_point().y == 239.5);
        let k = model.cameras[model.images[1].camera].intrinsics;
        assert_eq!(
            (k.fu_px(), k.fv_px(), k.principal_point().x),
            (400.0, 410.0, 300.0)
        );
        assert_eq!(notes.len(), 2);
    }

    #[cfg(feature = "photos")]
    #[test]
    fn a_size_that_is_missing_is_that_of_the_image() {
        let text = r#"{ "camera_angle_x": 1.5707963267948966, "frames": [ { "file_path": "./train/r_0",
            "transform_matrix": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]] } ] }"#;
        let file = |name: &str| (name == "train/r_0.png").then(|| b"P5 8 6 255\n".repeat(9));
        let (model, _) = read(text.as_bytes(), &file).unwrap();
        let camera = &model.cameras[0];
        assert_eq!((camera.width, camera.height), (8, 6));
        assert!((camera.intrinsics.fu_px() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn missing_and_wrong_values_are_named() {
        let of = |text: &str| {
            read(text.as_bytes(), &|_: &str| None)
                .unwrap_err()
                .to_string()
        };
        let frame = r#"{ "frames": [ { "file_path": "a", "transform_matrix": [] } ]"#;
        assert!(of("{}").contains("frames is missing"));
        assert!(of(&format!("{frame} }}")).contains("w and h are missing"));
        let sized = format!("{frame}, \"w\": 4, \"h\": 4");
        assert!(of(&format!("{sized} }}")).contains("camera_angle_x"));
        assert!(
            of(&format!("{sized}, \"fl_x\": 4 }}"))
                .contains("frames[0].transform_matrix has 0 rows")
        );
        let model = r#", "fl_x": 4, "camera_model": "EQUIRECTANGULAR" }"#;
        assert!(of(&format!("{sized}{model}")).contains("\"EQUIRECTANGULAR\" is not supported"));
        assert!(of(&format!("{sized}, \"fl_x\": 4, \"k4\": 1 }}")).contains("k4"));
        assert!(of("{ \"frames\": [ }").starts_with("line 1"));
    }
}
