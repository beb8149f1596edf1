//! Results without the points that were edited away.

use super::cloud_vertex::NUM_BYTES;
use super::{CloudVertex, Component, Dense, DenseCloud, PointFound};
use crate::project::Blob;

impl Component {
    /// Returns the component with some of its points.
    pub fn retained(&self, keep: impl Fn(&PointFound) -> bool) -> Self {
        Self {
            points: self.points.iter().filter(|p| keep(p)).cloned().collect(),
            ..self.clone()
        }
    }
}

impl Dense {
    /// Returns the index of a pixel.
    pub fn index(&self, [u, v]: [u32; 2]) -> u32 {
        v * self.width + u
    }

    /// Returns the index and the position of every n-th pixel along rows and columns that has a
    /// depth.
    pub fn places(&self, every: u32) -> impl Iterator<Item = (u32, [f64; 3])> {
        let pixels = self.deep_pixels(every).map(|(at, _)| self.index(at));
        pixels.zip(self.points(every).map(|(place, _)| place))
    }

    /// Returns the pair without the depth of other pixels.
    ///
    /// * `keep`: whether to keep a pixel, by index and position
    pub fn retained(&self, keep: impl Fn(u32, [f64; 3]) -> bool) -> Self {
        let mut disparity = vec![f32::NAN.to_le_bytes(); self.disparity.len() / 4];
        let (before, _) = self.disparity.as_chunks();
        let (mut num_kept, mut num_all) = (0_u32, 0_u32);
        for (index, place) in self.places(1) {
            num_all += 1;
            if keep(index, place) {
                num_kept += 1;
                disparity[index as usize] = before[index as usize];
            }
        }
        Self {
            disparity: disparity.into_flattened().into(),
            density: self.density * f64::from(num_kept) / f64::from(num_all.max(1)),
            ..self.clone()
        }
    }
}

impl DenseCloud {
    /// Returns the cloud and the surface with some of their points, and the triangles between
    /// them.
    ///
    /// * `keep`: whether to keep a point, or a vertex after the points, by index and position
    pub fn retained(&self, keep: impl Fn(u32, [f64; 3]) -> bool) -> Self {
        let points = kept_bytes(&self.points, 0, &keep, |_| {});
        // Index of each kept vertex among the kept ones.
        let mut places = Vec::with_capacity(self.vertices().len());
        let mut num_kept = 0;
        let vertices = kept_bytes(&self.vertices, self.len() as u32, &keep, |is_kept| {
            places.push(is_kept.then_some(num_kept));
            num_kept += u32::from(is_kept);
        });
        let place = |vertex: u32| *places.get(vertex as usize)?;
        let mut triangles = Vec::new();
        for triangle in self.triangles() {
            if let [Some(a), Some(b), Some(c)] = triangle.map(place) {
                triangles.extend([a, b, c].map(u32::to_le_bytes).into_iter().flatten());
            }
        }
        Self {
            points,
            vertices,
            triangles: triangles.into(),
            ..self.clone()
        }
    }
}

/// Returns the bytes of some points.
///
/// * `first`: index of the first one
/// * `tell`: receives for each point whether it is kept
fn kept_bytes(
    bytes: &[u8],
    first: u32,
    keep: impl Fn(u32, [f64; 3]) -> bool,
    mut tell: impl FnMut(bool),
) -> Blob {
    let (all, _) = bytes.as_chunks::<NUM_BYTES>();
    let mut kept = Vec::new();
    for (index, bytes) in (first..).zip(all) {
        let is_kept = keep(index, CloudVertex::from_bytes(bytes).position);
        tell(is_kept);
        if is_kept {
            kept.extend_from_slice(bytes);
        }
    }
    kept.into()
}
