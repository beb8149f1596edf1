//! A cloud of points with normals, as bytes.

use super::are_finite;
use crate::project::Blob;
use serde::{Deserialize, Serialize};

/// Number of bytes of a point: three floats, normal, color, number of photographs.
const NUM_BYTES: usize = 19;
/// Length of a normal in bytes.
#[cfg(feature = "vision")]
const NORMAL: f64 = 127.0;

/// A point of a cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudVertex {
    /// Position in the frame of the reconstruction.
    pub position: [f64; 3],
    /// Unit normal, towards the cameras.
    pub normal: [f64; 3],
    /// Red, green, blue.
    pub color: [u8; 3],
    /// Number of photographs that agree on it.
    pub num_views: u8,
}

impl CloudVertex {
    #[cfg(feature = "vision")]
    pub(super) fn to_bytes(self) -> [u8; NUM_BYTES] {
        let mut bytes = [0; NUM_BYTES];
        for (axis, x) in self.position.iter().enumerate() {
            bytes[4 * axis..][..4].copy_from_slice(&(*x as f32).to_le_bytes());
        }
        for (axis, x) in self.normal.iter().enumerate() {
            bytes[12 + axis] = ((x * NORMAL).round() as i8).to_le_bytes()[0];
        }
        bytes[15..18].copy_from_slice(&self.color);
        bytes[18] = self.num_views;
        bytes
    }

    fn from_bytes(bytes: &[u8; NUM_BYTES]) -> Self {
        let coordinate = |axis: usize| {
            let at = 4 * axis;
            let bytes = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        let normal = [12, 13, 14].map(|at| f64::from(i8::from_le_bytes([bytes[at]])));
        let norm = nalgebra::Vector3::from(normal).norm().max(1.0);
        Self {
            position: [0, 1, 2].map(coordinate),
            normal: normal.map(|x| x / norm),
            color: [bytes[15], bytes[16], bytes[17]],
            num_views: bytes[18],
        }
    }
}

/// The depth of all views, fused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DenseCloud {
    /// Number of photographs with a depth map.
    pub num_maps: u32,
    /// Number of registered photographs.
    pub num_registered: u32,
    /// Width and height of the largest depth map, pixels.
    pub size: (u32, u32),
    /// Side of a pixel of the depth maps in pixels of the photographs, the largest.
    pub pixel_px: f64,
    /// Share of the pixels of all depth maps with a depth.
    pub density: f64,
    /// The points, 19 bytes each.
    pub points: Blob,
}

impl DenseCloud {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.points.len() / NUM_BYTES
    }

    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The point of an index.
    pub fn point(&self, index: u32) -> Option<CloudVertex> {
        let bytes = self.points.get(NUM_BYTES * index as usize..)?;
        Some(CloudVertex::from_bytes(bytes.first_chunk()?))
    }

    /// Every n-th point.
    pub fn points(&self, every: usize) -> impl Iterator<Item = CloudVertex> {
        let (points, _) = self.points.as_chunks::<NUM_BYTES>();
        points
            .iter()
            .step_by(every.max(1))
            .map(CloudVertex::from_bytes)
    }

    /// Whether no point is cut off.
    pub fn is_whole(&self) -> bool {
        self.points.len().is_multiple_of(NUM_BYTES)
    }

    /// Whether an untrusted cloud has only finite numbers.
    pub(super) fn is_valid(&self) -> bool {
        self.is_whole()
            && are_finite(&[self.pixel_px, self.density])
            && self.points(1).all(|point| are_finite(&point.position))
    }
}

#[cfg(all(test, feature = "vision"))]
mod tests {
    use super::*;

    #[test]
    fn points_survive_as_bytes() {
        let vertex = |x: f64| CloudVertex {
            position: [x, -0.25, 1e6],
            normal: [0.0, 0.6, -0.8],
            color: [1, 128, 255],
            num_views: 5,
        };
        let bytes: Vec<u8> = [vertex(0.5), vertex(f64::NAN)]
            .into_iter()
            .flat_map(CloudVertex::to_bytes)
            .collect();
        let cloud = |bytes: &[u8]| DenseCloud {
            num_maps: 2,
            num_registered: 2,
            size: (4, 3),
            pixel_px: 1.0,
            density: 0.5,
            points: bytes.to_vec().into(),
        };
        let (one, two) = (cloud(&bytes[..19]), cloud(&bytes));
        assert_eq!((one.len(), two.len(), two.points(2).count()), (1, 2, 1));
        let read = one.point(0).expect("one point");
        assert_eq!(
            (read.position, read.color),
            ([0.5, -0.25, 1e6], [1, 128, 255])
        );
        assert_eq!(read.num_views, 5);
        for (read, given) in read.normal.iter().zip([0.0, 0.6, -0.8]) {
            assert!((read - given).abs() < 0.01, "{read} {given}");
        }
        assert_eq!(one.point(1), None);
        assert!(one.is_valid() && !two.is_valid(), "NaN is not valid");
        assert!(!cloud(&bytes[..20]).is_whole());
    }
}
