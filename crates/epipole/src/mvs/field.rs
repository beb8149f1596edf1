//! Hypotheses of all pixels of a photo.

use super::level::Level;
use super::plane::Plane;

/// Plane at a pixel and its cost.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Hypothesis {
    pub(super) plane: Plane,
    pub(super) cost: f32,
    /// Bit mask of the neighbors used.
    pub(super) views: u32,
}

/// Hypotheses in a checkerboard pattern: the fields of one color are updated from those of the
/// other, so that the order of updates does not matter.
#[derive(Debug, Clone)]
pub(super) struct Field {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Pixel (u, v) is entry u/2 in row v of color (u + v) mod 2.
    pub(super) colors: [Vec<Hypothesis>; 2],
}

/// Returns the number of pixels of one color per row.
pub(super) const fn row_len(width: usize) -> usize {
    width.div_ceil(2)
}

impl Field {
    pub(super) fn new(level: &Level) -> Self {
        let (width, height) = (level.width, level.height);
        let color = || vec![Hypothesis::default(); row_len(width) * height];
        Self {
            width,
            height,
            colors: [color(), color()],
        }
    }

    pub(super) fn into_surface(self) -> Surface {
        let half = row_len(self.width);
        let pixels = (0..self.height).flat_map(|v| (0..self.width).map(move |u| (u, v)));
        let at = |(u, v): (usize, usize)| &self.colors[(u + v) % 2][v * half + u / 2];
        Surface {
            width: self.width,
            height: self.height,
            planes: pixels.clone().map(|pixel| at(pixel).plane).collect(),
            costs: pixels.map(|pixel| at(pixel).cost).collect(),
        }
    }
}

/// Result of a pass: the plane of each pixel, row by row.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) planes: Vec<Plane>,
    pub(super) costs: Vec<f32>,
}

impl Surface {
    /// Returns the plane at a position in an image of any resolution, from the nearest pixel.
    ///
    /// * `scale`: resolution of the surface relative to the image, by column and row
    #[inline(always)]
    pub(super) fn plane_at(&self, x: f32, y: f32, scale: [f32; 2]) -> Plane {
        let (x, y) = ((x + 0.5) * scale[0] - 0.5, (y + 0.5) * scale[1] - 0.5);
        let nearest = |x: f32, size: usize| ((x + 0.5).max(0.0) as usize).min(size - 1);
        let (u, v) = (nearest(x, self.width), nearest(y, self.height));
        let plane = self.planes[v * self.width + u];
        plane.moved(x - u as f32, y - v as f32)
    }

    /// Returns the resolution relative to an image.
    pub(super) fn scale(&self, level: &Level) -> [f32; 2] {
        let ratio = |a: usize, b: usize| a as f32 / b as f32;
        [
            ratio(self.width, level.width),
            ratio(self.height, level.height),
        ]
    }
}
