//! Binary glTF 2.0: points and the frusta of the cameras.
//!
//! glTF's y points up, and its cameras look along −z. A node rotates the world by 180° about x, so
//! that a scene whose first camera is upright is upright.
//!
//! Source: Khronos Group, "glTF 2.0 Specification".

use super::Model;
use super::frustum::{FRUSTUM_RATIO, corners, extent};
use crate::Result;
use crate::gltf::{Buffer, HALF_TURN, LINES, POINTS, document};
use crate::rotation::half_turn;
use epipole::camera::Camera;
use nalgebra::Point3;
use serde_json::json;

/// Returns center and corners of the image at this depth, in the axes of glTF's cameras.
fn frustum(camera: &Camera, depth: f64) -> Vec<Point3<f64>> {
    let flipped = corners(camera, depth).map(|p| Point3::new(p.x, -p.y, -p.z));
    std::iter::once(Point3::origin()).chain(flipped).collect()
}

impl Model {
    /// Writes the points and the frusta of the cameras as a binary glTF 2.0 file (`.glb`); each
    /// image is a node with its name and a camera of the same field of view.
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) if an index of the model is wrong.
    pub fn to_glb(&self) -> Result<Vec<u8>> {
        self.check()?;
        let mut buffer = Buffer::default();
        let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
        // The first node is the root, the parent of all others.
        nodes.push(json!({ "name": "world", "rotation": HALF_TURN }));
        if !self.points.is_empty() {
            let positions: Vec<_> = self.points.iter().map(|point| point.position).collect();
            let position = buffer.positions(&positions);
            let color = buffer.colors(self.points.iter().map(|point| point.color));
            nodes.push(json!({ "name": "points", "mesh": meshes.len() }));
            meshes.push(json!({ "name": "points", "primitives": [{
                "mode": POINTS, "attributes": { "POSITION": position, "COLOR_0": color },
            }]}));
        }
        let depth = FRUSTUM_RATIO * extent(self).1;
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
        let lists = [("meshes", meshes), ("cameras", cameras)];
        Ok(document(nodes, lists.into(), buffer))
    }
}

#[cfg(test)]
mod tests {
    use super::super::ModelImage;
    use super::*;
    use epipole::camera::{Intrinsics, RigidTransform};
    use serde_json::Value;

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
        // An empty model is written without empty lists.
        let empty = Model::default().to_glb().unwrap();
        let (json, binary) = chunks(&empty);
        assert!(json.get("meshes").is_none() && json.get("buffers").is_none() && binary.is_empty());
    }
}
