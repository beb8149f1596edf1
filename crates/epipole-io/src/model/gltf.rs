//! glTF 2.0, binary: points and the frusta of the cameras.
//!
//! glTF's y points up, and its cameras look along −z. A node turns the world by half a turn about
//! x, so that a scene whose first camera is upright stands upright.
//!
//! Source: Khronos Group, "glTF 2.0 Specification".

use super::{Model, ModelImage};
use crate::Result;
use crate::rotation::half_turn;
use epipole::camera::Camera;
use nalgebra::{Point2, Point3, Vector3};
use serde_json::{Value, json};

const BYTE: u32 = 5121;
const FLOAT: u32 = 5126;
const INDEX: u32 = 5125;
const POINTS: u32 = 0;
const LINES: u32 = 1;

/// Length of the frusta relative to the extent of the scene.
const FRUSTUM_SHARE: f64 = 0.05;

/// The binary chunk with its views and accessors.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds an accessor and returns its number.
    fn add(&mut self, bytes: Vec<u8>, target: u32, mut accessor: Value) -> usize {
        accessor["bufferView"] = self.views.len().into();
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target,
        }));
        self.bytes.extend(bytes);
        // Offsets are multiples of the size of a value.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn positions(&mut self, positions: &[Point3<f64>]) -> usize {
        let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let mut bytes = Vec::new();
        for position in positions {
            for axis in 0..3 {
                let value = position[axis] as f32;
                min[axis] = min[axis].min(value);
                max[axis] = max[axis].max(value);
                bytes.extend(value.to_le_bytes());
            }
        }
        let accessor = json!({
            "componentType": FLOAT, "count": positions.len(), "type": "VEC3", "min": min, "max": max,
        });
        self.add(bytes, 34962, accessor)
    }

    /// Colors of four bytes, as a stride must be a multiple of four.
    fn colors(&mut self, colors: impl Iterator<Item = [u8; 3]>) -> usize {
        let bytes: Vec<u8> = colors.flat_map(|[r, g, b]| [r, g, b, 255]).collect();
        let accessor = json!({
            "componentType": BYTE, "normalized": true, "count": bytes.len() / 4, "type": "VEC4",
        });
        self.add(bytes, 34962, accessor)
    }

    fn indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let accessor = json!({ "componentType": INDEX, "count": indices.len(), "type": "SCALAR" });
        self.add(bytes.collect(), 34963, accessor)
    }
}

/// Center and corners of the image at this depth, in the axes of glTF's cameras. A corner that the
/// lens does not see, or sees behind the camera, is that of a pinhole.
fn frustum(camera: &Camera, depth: f64) -> Vec<Point3<f64>> {
    let (right, bottom) = (
        f64::from(camera.width) - 0.5,
        f64::from(camera.height) - 0.5,
    );
    let corners = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)];
    let mut points = vec![Point3::origin()];
    for (u, v) in corners {
        let pixel = Point2::new(u, v);
        let ray = camera.unproject(&pixel).ok().filter(|ray| ray.z > 0.2);
        let ray = ray.unwrap_or_else(|| camera.intrinsics.ray(&pixel));
        let at = ray * (depth / ray.z);
        points.push(Point3::new(at.x, -at.y, -at.z));
    }
    points
}

/// The median distance of points and cameras from their median.
fn extent(model: &Model) -> f64 {
    let centers = model.images.iter().map(ModelImage::center_in_world);
    let positions: Vec<Point3<f64>> = centers
        .chain(model.points.iter().map(|point| point.position))
        .collect();
    let median = |mut values: Vec<f64>| -> f64 {
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let middle = Point3::from(Vector3::from_fn(|axis, _| {
        median(positions.iter().map(|p| p[axis]).collect())
    }));
    let distances = positions.iter().map(|p| (p - middle).norm()).collect();
    let extent = 2.0 * median(distances);
    if extent > 0.0 && extent.is_finite() {
        extent
    } else {
        1.0
    }
}

impl Model {
    /// The points and the frusta of the cameras as a binary glTF 2.0 file (`.glb`); each image is a
    /// node with its name and a camera of the same field of view.
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) if an index of the model is wrong.
    pub fn to_glb(&self) -> Result<Vec<u8>> {
        self.check()?;
        let mut buffer = Buffer::default();
        let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
        // The root comes first; its children are all others.
        nodes.push(json!({ "name": "world", "rotation": [1, 0, 0, 0] }));
        if !self.points.is_empty() {
            let positions: Vec<_> = self.points.iter().map(|point| point.position).collect();
            let position = buffer.positions(&positions);
            let color = buffer.colors(self.points.iter().map(|point| point.color));
            nodes.push(json!({ "name": "points", "mesh": meshes.len() }));
            meshes.push(json!({ "name": "points", "primitives": [{
                "mode": POINTS, "attributes": { "POSITION": position, "COLOR_0": color },
            }]}));
        }
        let depth = FRUSTUM_SHARE * extent(self);
        let first = meshes.len();
        let mut cameras = Vec::new();
        if !self.images.is_empty() {
            let lines = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1];
            let lines = buffer.indices(&lines);
            for camera in &self.cameras {
                let position = buffer.positions(&frustum(camera, depth));
                meshes.push(json!({ "name": "frustum", "primitives": [{
                    "mode": LINES, "attributes": { "POSITION": position }, "indices": lines,
                }]}));
                let height = f64::from(camera.height) / 2.0;
                let yfov = 2.0 * libm::atan(height / camera.intrinsics.fv_px());
                let aspect = (f64::from(camera.width) / camera.intrinsics.fu_px())
                    / (f64::from(camera.height) / camera.intrinsics.fv_px());
                cameras.push(json!({ "type": "perspective", "perspective": {
                    "yfov": yfov, "aspectRatio": aspect, "znear": 0.1 * depth,
                }}));
            }
        }
        for image in &self.images {
            let world_from_cam = image.cam_from_world.inverse();
            let q = world_from_cam.rotation * half_turn();
            let t = world_from_cam.translation.vector;
            nodes.push(json!({
                "name": image.name, "mesh": first + image.camera, "camera": image.camera,
                "rotation": [q.i, q.j, q.k, q.w], "translation": [t.x, t.y, t.z],
            }));
        }
        if nodes.len() > 1 {
            nodes[0]["children"] = (1..nodes.len()).collect();
        }
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "Epipole" },
            "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": nodes,
        });
        // Empty lists are not allowed.
        for (key, list) in [
            ("meshes", meshes),
            ("cameras", cameras),
            ("accessors", buffer.accessors),
            ("bufferViews", buffer.views),
        ] {
            if !list.is_empty() {
                document[key] = list.into();
            }
        }
        if !buffer.bytes.is_empty() {
            document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
        }
        Ok(container(document.to_string().into_bytes(), buffer.bytes))
    }
}

/// The container of a JSON chunk and a binary chunk.
fn container(mut json: Vec<u8>, binary: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut chunks = Vec::new();
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        if !chunk.is_empty() {
            chunks.extend((chunk.len() as u32).to_le_bytes());
            chunks.extend(kind);
            chunks.extend(chunk);
        }
    }
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2u32.to_le_bytes());
    bytes.extend((chunks.len() as u32 + 12).to_le_bytes());
    bytes.extend(chunks);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::{Intrinsics, RigidTransform};

    fn chunks(glb: &[u8]) -> (Value, &[u8]) {
        let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
        let length = word(12);
        assert_eq!((&glb[16..20], length % 4), (&b"JSON"[..], 0));
        let json = serde_json::from_slice(&glb[20..20 + length]).unwrap();
        let rest = &glb[20 + length..];
        (json, rest.get(8..).unwrap_or_default())
    }

    #[test]
    fn corners_of_an_image_are_those_of_its_frustum() {
        let intrinsics = Intrinsics::new(100.0, 100.0, 99.5, 49.5).unwrap();
        let camera = Camera::pinhole(intrinsics, 200, 100);
        let corners = frustum(&camera, 2.0);
        assert_eq!(corners[1], Point3::new(-2.0, 1.0, -2.0));
        assert_eq!(corners[3], Point3::new(2.0, -1.0, -2.0));
    }

    #[test]
    fn views_follow_each_other() {
        let intrinsics = Intrinsics::new(100.0, 100.0, 99.5, 49.5).unwrap();
        let model = Model {
            cameras: vec![Camera::pinhole(intrinsics, 200, 100)],
            images: vec![ModelImage {
                id: 1,
                name: "a \"b\".png".to_owned(),
                camera: 0,
                cam_from_world: RigidTransform::translation(0.0, 0.0, 3.0),
                keypoints: Vec::new(),
            }],
            points: vec![super::super::ModelPoint {
                id: 1,
                position: Point3::new(1.0, 2.0, 3.0),
                color: [1, 2, 3],
                error_px: None,
                track: Vec::new(),
            }],
            ..Model::default()
        };
        let glb = model.to_glb().unwrap();
        let (json, binary) = chunks(&glb);
        assert_eq!(json["nodes"][2]["name"], "a \"b\".png");
        assert_eq!(json["nodes"][2]["translation"], json!([0.0, 0.0, -3.0]));
        assert_eq!(json["nodes"][0]["children"], json!([1, 2]));
        assert_eq!(json["accessors"][0]["max"], json!([1.0, 2.0, 3.0]));
        let views = json["bufferViews"].as_array().unwrap();
        let last = &views[views.len() - 1];
        let end = last["byteOffset"].as_u64().unwrap() + last["byteLength"].as_u64().unwrap();
        assert_eq!(end as usize, binary.len());
        assert_eq!(json["buffers"][0]["byteLength"], binary.len());
        assert_eq!(binary[..4], 1f32.to_le_bytes());
        // An empty model has no empty lists.
        let empty = Model::default().to_glb().unwrap();
        let (json, binary) = chunks(&empty);
        assert!(json.get("meshes").is_none() && json.get("buffers").is_none() && binary.is_empty());
    }
}
