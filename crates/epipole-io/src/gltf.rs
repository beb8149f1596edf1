//! Parts of binary glTF 2.0 files: the buffer with its accessors, and the container.
//!
//! Source: Khronos Group, "glTF 2.0 Specification".

use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};

const SHORT: u32 = 5123;
const FLOAT: u32 = 5126;
const INDEX: u32 = 5125;
pub(crate) const POINTS: u32 = 0;
pub(crate) const LINES: u32 = 1;
pub(crate) const TRIANGLES: u32 = 4;

/// Rotation of the world node by 180° about x, because glTF's y points up.
pub(crate) const HALF_TURN: [u8; 4] = [1, 0, 0, 0];

/// Binary chunk with its views and accessors.
#[derive(Default)]
pub(crate) struct Buffer {
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

    /// Adds positions with their bounds.
    pub(crate) fn positions(&mut self, positions: &[Point3<f64>]) -> usize {
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

    /// Adds unit normals.
    pub(crate) fn normals(&mut self, normals: &[Vector3<f64>]) -> usize {
        let values = normals.iter().flat_map(|normal| normal.iter());
        let bytes = values.flat_map(|value| (*value as f32).to_le_bytes());
        let accessor = json!({ "componentType": FLOAT, "count": normals.len(), "type": "VEC3" });
        self.add(bytes.collect(), 34962, accessor)
    }

    /// Adds colors as linear intensities of two bytes, enough for dark levels. A stride must be a
    /// multiple of four.
    pub(crate) fn colors(&mut self, colors: impl Iterator<Item = [u8; 3]>) -> usize {
        let levels: Vec<u16> = (0..=u8::MAX).map(linear).collect();
        let values = colors.flat_map(|[r, g, b]| [r, g, b, 255]);
        let bytes = values.flat_map(|value| levels[usize::from(value)].to_le_bytes());
        let bytes: Vec<u8> = bytes.collect();
        let accessor = json!({
            "componentType": SHORT, "normalized": true, "count": bytes.len() / 8, "type": "VEC4",
        });
        self.add(bytes, 34962, accessor)
    }

    /// Adds positions in the texture, 0 to 1 from its top left corner.
    pub(crate) fn texture_coordinates(&mut self, places: &[[f32; 2]]) -> usize {
        let bytes = places.as_flattened().iter().flat_map(|x| x.to_le_bytes());
        let accessor = json!({ "componentType": FLOAT, "count": places.len(), "type": "VEC2" });
        self.add(bytes.collect(), 34962, accessor)
    }

    /// Adds the content of an image file and returns the number of its view.
    pub(crate) fn image(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    pub(crate) fn indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let accessor = json!({ "componentType": INDEX, "count": indices.len(), "type": "SCALAR" });
        self.add(bytes.collect(), 34963, accessor)
    }
}

/// Converts a level of sRGB to a linear intensity, 0 to 65535.
fn linear(level: u8) -> u16 {
    let level = f64::from(level) / 255.0;
    let intensity = match level <= 0.04045 {
        true => level / 12.92,
        false => libm::pow((level + 0.055) / 1.055, 2.4),
    };
    (65535.0 * intensity).round() as u16
}

/// Writes the file of a scene whose first node is the root.
///
/// * `lists`: further lists of the document, by name
pub(crate) fn document(
    nodes: Vec<Value>,
    lists: Vec<(&str, Vec<Value>)>,
    buffer: Buffer,
) -> Vec<u8> {
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "Epipole" },
        "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": nodes,
    });
    let own = [
        ("accessors", buffer.accessors),
        ("bufferViews", buffer.views),
    ];
    // Empty lists are not allowed.
    for (key, list) in lists.into_iter().chain(own) {
        if !list.is_empty() {
            document[key] = list.into();
        }
    }
    if !buffer.bytes.is_empty() {
        document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
    }
    container(document.to_string().into_bytes(), buffer.bytes)
}

/// Writes the container of a JSON chunk and a binary chunk.
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

    #[test]
    fn colors_are_linear() {
        assert_eq!([0, 255].map(linear), [0, 65535]);
        // Half of the light.
        assert!((f64::from(linear(188)) / 65535.0 - 0.5).abs() < 0.005);
    }
}
