//! Pieces of the texture, and their places in the image.

use super::super::mesh::Mesh;
use super::super::views::MvsView;
use super::labels::pieces;
use super::visibility::project;
use crate::{Error, Result};
use nalgebra::Point2;

/// Pixels around a piece, so that interpolation and smaller levels of detail stay in it.
pub(super) const PADDING: u32 = 2;
/// Factor by which all pieces shrink until the image is small enough.
const SHRINK: f64 = 0.9;
/// Minimum scale.
const MIN_SCALE: f64 = 0.02;

/// Connected triangles that take their colors from one photo.
#[derive(Debug, Clone)]
pub(super) struct Chart {
    pub(super) view: usize,
    /// Indices of the triangles, ascending.
    pub(super) triangles: Vec<usize>,
    /// Pixels of the corners in the photo.
    pub(super) pixels: Vec<[Point2<f64>; 3]>,
    /// Minimum and maximum of the pixels.
    bounds: [Point2<f64>; 2],
    /// First column and row in the texture.
    pub(super) place: [u32; 2],
    /// Width and height in the texture, with the padding.
    pub(super) size: [u32; 2],
}

impl Chart {
    /// Returns the pixel of the photo at the first column and row within the padding.
    fn origin(&self) -> Point2<f64> {
        self.bounds[0].map(f64::floor)
    }

    /// Returns the position of a pixel of the photo in the piece.
    pub(super) fn in_chart(&self, pixel: &Point2<f64>, scale: f64) -> Point2<f64> {
        let padding = f64::from(PADDING);
        (pixel - self.origin())
            .map(|offset| offset * scale + padding)
            .into()
    }

    /// Returns the pixel of the photo at a position in the piece.
    pub(super) fn in_photo(&self, u: u32, v: u32, scale: f64) -> Point2<f64> {
        let offset = [u, v].map(|place| (f64::from(place) - f64::from(PADDING)) / scale);
        self.origin() + nalgebra::Vector2::from(offset)
    }

    fn set_size(&mut self, scale: f64) {
        let side = |axis: usize| {
            let length = self.bounds[1][axis] - self.origin()[axis];
            (length * scale).ceil() as u32 + 1 + 2 * PADDING
        };
        self.size = [side(0), side(1)];
    }
}

/// Returns the pieces of a mesh, without places.
pub(super) fn charts(
    mesh: &Mesh,
    views: &[MvsView],
    across: &[[u32; 3]],
    labels: &[Option<usize>],
) -> Vec<Chart> {
    let chart = |triangles: Vec<usize>| -> Option<Chart> {
        let view = labels[*triangles.first()?]?;
        let pixels: Option<Vec<[Point2<f64>; 3]>> = triangles
            .iter()
            .map(|&index| {
                let corners = mesh.triangles[index].map(|vertex| {
                    let vertex = &mesh.vertices.points[vertex as usize];
                    project(&views[view], vertex).map(|(pixel, _)| pixel)
                });
                let [a, b, c] = corners;
                Some([a?, b?, c?])
            })
            .collect();
        let pixels = pixels?;
        let all = || pixels.iter().flatten().map(|pixel| pixel.coords);
        let low = all().reduce(|a, b| a.inf(&b))?;
        let high = all().reduce(|a, b| a.sup(&b))?;
        Some(Chart {
            view,
            triangles,
            bounds: [low.into(), high.into()],
            place: [0; 2],
            size: [0; 2],
            pixels,
        })
    };
    pieces(across, labels)
        .into_iter()
        .filter_map(chart)
        .collect()
}

/// Places all pieces in an image; returns its width and height, and the scale of the pieces.
///
/// # Errors
/// [`Error::OutOfRange`] if they do not fit at any scale.
pub(super) fn pack(charts: &mut [Chart], max_size_px: u32) -> Result<([u32; 2], f64)> {
    let mut scale = 1.0;
    while scale > MIN_SCALE {
        charts.iter_mut().for_each(|chart| chart.set_size(scale));
        if let Some(size) = place_in_rows(charts, max_size_px) {
            return Ok((size, scale));
        }
        scale *= SHRINK;
    }
    Err(Error::OutOfRange {
        what: "the maximum size of a texture",
        requirement: "large enough for all pieces of the mesh",
        value: f64::from(max_size_px),
    })
}

/// Places the pieces in rows, tall ones first; `None` if the image would be larger than allowed.
fn place_in_rows(charts: &mut [Chart], max_size_px: u32) -> Option<[u32; 2]> {
    let mut order: Vec<usize> = (0..charts.len()).collect();
    order.sort_by_key(|&index| (std::cmp::Reverse(charts[index].size[1]), index));
    let area: f64 = (charts.iter())
        .map(|chart| f64::from(chart.size[0]) * f64::from(chart.size[1]))
        .sum();
    let widest = charts.iter().map(|chart| chart.size[0]).max().unwrap_or(1);
    let width = widest
        .max((1.02 * area.sqrt()).ceil() as u32)
        .min(max_size_px.max(widest));
    let (mut column, mut row, mut height) = (0, 0, 0);
    for index in order {
        let chart = &mut charts[index];
        if column + chart.size[0] > width {
            (column, row, height) = (0, row + height, 0);
        }
        chart.place = [column, row];
        column += chart.size[0];
        height = height.max(chart.size[1]);
        if row + height > max_size_px {
            return None;
        }
    }
    (width <= max_size_px).then_some([width, row + height])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    fn rectangle(width: f64, height: f64) -> Chart {
        let [low, high] = [
            Point2::new(10.5, 20.25),
            Point2::new(10.5 + width, 20.25 + height),
        ];
        Chart {
            view: 0,
            triangles: vec![0],
            pixels: vec![[low, high, Point2::new(low.x, high.y)]],
            bounds: [low, high],
            place: [0; 2],
            size: [0; 2],
        }
    }

    #[test]
    fn pieces_do_not_overlap() {
        let sides = (1..40).map(|n| (f64::from(n * 7 % 31), f64::from(n * 11 % 17)));
        let mut charts: Vec<Chart> = sides.map(|(w, h)| rectangle(w, h)).collect();
        let ([width, height], scale) = pack(&mut charts, 512).unwrap();
        assert_eq!(scale, 1.0);
        let mut owner = vec![0; (width * height) as usize];
        for (index, chart) in charts.iter().enumerate() {
            for v in 0..chart.size[1] {
                for u in 0..chart.size[0] {
                    let place = ((chart.place[1] + v) * width + chart.place[0] + u) as usize;
                    assert_eq!(owner[place], 0);
                    owner[place] = index + 1;
                }
            }
        }
        let used = owner.iter().filter(|index| **index > 0).count();
        assert!(
            used as f64 > 0.7 * owner.len() as f64,
            "{used} of {}",
            owner.len()
        );
    }

    #[test]
    fn large_pieces_shrink_and_corners_stay_inside() {
        let mut charts = vec![rectangle(300.0, 90.0), rectangle(50.0, 200.0)];
        let (size, scale) = pack(&mut charts, 128).unwrap();
        assert!(scale < 0.5 && size[0] <= 128 && size[1] <= 128);
        for chart in &charts {
            for pixel in &chart.pixels[0] {
                let place = chart.in_chart(pixel, scale);
                let inside = [place.x, place.y].into_iter().zip(chart.size);
                for (at, side) in inside {
                    let padding = f64::from(PADDING);
                    assert!(at >= padding && at <= f64::from(side) - 1.0 - padding);
                }
            }
            let back = chart.in_photo(PADDING, PADDING, scale);
            assert_eq!(back, Point2::new(10.0, 20.0));
        }
        let mut many = vec![rectangle(1.0, 1.0); 1000];
        assert!(pack(&mut many, 64).is_err());
    }
}
