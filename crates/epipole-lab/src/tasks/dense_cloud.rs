//! Depth of all views: a cloud of points and a surface, as bytes.

use super::are_finite;
use super::cloud_vertex::{CloudVertex, NUM_BYTES};
use crate::project::Blob;
use serde::{Deserialize, Serialize};

/// The depth of all views, fused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DenseCloud {
    /// Number of photographs with a depth map.
    pub num_maps: u32,
    /// Number of registered photographs.
    pub num_registered: u32,
    /// Width and height of the largest depth map, pixels.
    pub size: (u32, u32),
    /// Maximum side of a depth map's pixel, in pixels of its photograph.
    pub pixel_px: f64,
    /// Fraction of the pixels of all depth maps with a depth.
    pub density: f64,
    /// Points, 19 bytes each.
    pub points: Blob,
    /// Vertices of the surface from the same depth maps, 19 bytes each.
    pub vertices: Blob,
    /// Indices of the three vertices of each triangle, 12 bytes, counterclockwise from outside.
    pub triangles: Blob,
}

impl DenseCloud {
    /// Returns the number of points.
    pub fn len(&self) -> usize {
        self.points.len() / NUM_BYTES
    }

    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Returns the point with this index; the vertices of the surface follow the points.
    pub fn point(&self, index: u32) -> Option<CloudVertex> {
        let (points, _) = self.points.as_chunks();
        let (vertices, _) = self.vertices.as_chunks();
        let index = index as usize;
        let bytes = match index.checked_sub(points.len()) {
            None => &points[index],
            Some(vertex) => vertices.get(vertex)?,
        };
        Some(CloudVertex::from_bytes(bytes))
    }

    /// Returns every n-th point.
    pub fn points(&self, every: usize) -> impl Iterator<Item = CloudVertex> {
        let (points, _) = self.points.as_chunks::<NUM_BYTES>();
        points
            .iter()
            .step_by(every.max(1))
            .map(CloudVertex::from_bytes)
    }

    /// Returns the vertices of the surface.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = CloudVertex> {
        let (vertices, _) = self.vertices.as_chunks::<NUM_BYTES>();
        vertices.iter().map(CloudVertex::from_bytes)
    }

    /// Returns the vertices of each triangle, by index.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> {
        let (triangles, _) = self.triangles.as_chunks::<12>();
        triangles.iter().map(|bytes| {
            let (corners, _) = bytes.as_chunks::<4>();
            [0, 1, 2].map(|corner| u32::from_le_bytes(corners[corner]))
        })
    }

    /// Whether the bytes contain no incomplete point, vertex or triangle.
    pub fn is_whole(&self) -> bool {
        self.points.len().is_multiple_of(NUM_BYTES)
            && self.vertices.len().is_multiple_of(NUM_BYTES)
            && self.triangles.len().is_multiple_of(12)
    }

    /// Whether an untrusted cloud has only finite numbers, and valid indices in its triangles.
    pub(super) fn is_valid(&self) -> bool {
        let num_vertices = self.vertices().len();
        self.is_whole()
            && are_finite(&[self.pixel_px, self.density])
            && (self.points(1).chain(self.vertices())).all(|point| are_finite(&point.position))
            && self
                .triangles()
                .flatten()
                .all(|vertex| (vertex as usize) < num_vertices)
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
            vertices: Blob::default(),
            triangles: Blob::default(),
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

    #[test]
    fn a_surface_has_its_vertices_after_the_points() {
        let vertex = |x: f64| CloudVertex {
            position: [x, 0.0, 1.0],
            normal: [0.0, 0.0, -1.0],
            color: [9; 3],
            num_views: 0,
        };
        let blob = |places: &[f64]| {
            let places = places.iter().copied();
            let bytes: Vec<u8> = places.flat_map(|x| vertex(x).to_bytes()).collect();
            Blob::from(bytes)
        };
        let surface = |corners: [u32; 3]| DenseCloud {
            num_maps: 2,
            num_registered: 2,
            size: (4, 3),
            pixel_px: 1.0,
            density: 0.5,
            points: blob(&[5.0]),
            vertices: blob(&[6.0, 7.0, 8.0]),
            triangles: corners
                .iter()
                .flat_map(|n| n.to_le_bytes())
                .collect::<Vec<u8>>()
                .into(),
        };
        let cloud = surface([0, 2, 1]);
        assert_eq!((cloud.len(), cloud.vertices().len()), (1, 3));
        assert_eq!(cloud.triangles().collect::<Vec<_>>(), [[0, 2, 1]]);
        let x = |index: u32| cloud.point(index).map(|point| point.position[0]);
        assert_eq!([0, 1, 3, 4].map(x), [Some(5.0), Some(6.0), Some(8.0), None]);
        assert!(cloud.is_valid() && !surface([0, 1, 3]).is_valid());
        let cut = DenseCloud {
            triangles: vec![0; 11].into(),
            ..cloud
        };
        assert!(!cut.is_whole());
    }
}
