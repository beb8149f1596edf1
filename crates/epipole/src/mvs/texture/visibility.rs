//! Views that see a triangle.

use super::super::mesh::Mesh;
use super::super::views::MvsView;
use super::raster::for_each_pixel;
use crate::Result;
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage};
use nalgebra::{Point2, Point3};

/// Maximum number of views that a triangle chooses from.
const MAX_CANDIDATES: usize = 6;
/// Number of views that are rendered at a time, which bounds the memory.
const CHUNK: usize = 8;
/// Distance to the border of a photo, pixels: resampling needs neighbors.
const BORDER_PX: f64 = 1.0;
/// Distance behind the first surface at which a corner still counts as visible, relative to the
/// longest edge of its triangle.
const SLACK: f64 = 2.0;

/// A view that sees a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Candidate {
    pub(super) view: usize,
    /// Area of the triangle in the photo, square pixels.
    pub(super) area_px: f32,
}

/// Returns the views that see each triangle, largest area first.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn candidates(
    mesh: &Mesh,
    views: &[MvsView],
    monitor: &mut dyn Monitor,
) -> Result<Vec<Vec<Candidate>>> {
    let mut found = vec![Vec::new(); mesh.triangles.len()];
    for (chunk, some) in views.chunks(CHUNK).enumerate() {
        let fraction = |n: usize| (n as f32 / views.len() as f32).min(1.0);
        let (from, to) = (chunk * CHUNK, (chunk + 1) * CHUNK);
        let mut part = Part::new(monitor, fraction(from), fraction(to));
        let areas = monitored::map(some, Stage::Blending, &mut part, |view| {
            areas_px(mesh, view)
        })?;
        for (offset, areas) in areas.iter().enumerate() {
            for (list, area_px) in found.iter_mut().zip(areas) {
                if *area_px > 0.0 {
                    let view = chunk * CHUNK + offset;
                    insert(
                        list,
                        Candidate {
                            view,
                            area_px: *area_px,
                        },
                    );
                }
            }
        }
    }
    Ok(found)
}

/// Inserts a candidate behind those that are at least as large.
fn insert(list: &mut Vec<Candidate>, candidate: Candidate) {
    let place = list.partition_point(|other| other.area_px >= candidate.area_px);
    list.insert(place, candidate);
    list.truncate(MAX_CANDIDATES);
}

/// Returns pixel and depth of a vertex; `None` behind the camera.
pub(super) fn project(view: &MvsView, vertex: &Point3<f64>) -> Option<(Point2<f64>, f64)> {
    let in_cam = view.camera.cam_from_world * vertex;
    let pixel = view.camera.camera.intrinsics.project(&in_cam).ok()?;
    Some((pixel, in_cam.z))
}

/// Returns whether a pixel has neighbors on all sides.
pub(super) fn is_inside(view: &MvsView, pixel: &Point2<f64>) -> bool {
    let (width, height) = view.image.dimensions();
    let is_in =
        |place: f64, side: u32| place >= BORDER_PX && place <= f64::from(side) - 1.0 - BORDER_PX;
    is_in(pixel.x, width) && is_in(pixel.y, height)
}

/// Returns the area of each triangle in a photo, square pixels; 0 where it is not visible.
fn areas_px(mesh: &Mesh, view: &MvsView) -> Vec<f32> {
    let vertices = &mesh.vertices.points;
    let projected: Vec<_> = vertices
        .iter()
        .map(|vertex| project(view, vertex))
        .collect();
    let corners = |triangle: &[u32; 3]| -> Option<[(Point2<f64>, f64); 3]> {
        let [a, b, c] = triangle.map(|vertex| projected[vertex as usize]);
        Some([a?, b?, c?])
    };
    let size = view.image.dimensions();
    let place = |u: u32, v: u32| v as usize * size.0 as usize + u as usize;
    // Inverse depths of the first surface: affine in the pixel.
    let mut nearest = vec![0.0_f32; size.0 as usize * size.1 as usize];
    for triangle in &mesh.triangles {
        let Some(corners) = corners(triangle) else {
            continue;
        };
        let inverse = corners.map(|(_, depth)| 1.0 / depth);
        for_each_pixel(&corners.map(|(pixel, _)| pixel), size, |u, v, weights| {
            let here: f64 = (0..3).map(|n| weights[n] * inverse[n]).sum();
            let first = &mut nearest[place(u, v)];
            *first = first.max(here as f32);
        });
    }
    let area_px = |triangle: &[u32; 3]| -> Option<f64> {
        let corners = corners(triangle)?;
        let [a, b, c] = corners.map(|(pixel, _)| pixel);
        // Counterclockwise where v points down.
        let area_px = -0.5 * (b - a).perp(&(c - a));
        let [p, q, r] = triangle.map(|vertex| &vertices[vertex as usize]);
        let longest = (q - p).norm().max((r - q).norm()).max((p - r).norm());
        let is_visible = |(pixel, depth): &(Point2<f64>, f64)| {
            let (u, v) = (pixel.x.round() as u32, pixel.y.round() as u32);
            is_inside(view, pixel)
                && f64::from(nearest[place(u, v)]) * (depth - SLACK * longest) <= 1.0
        };
        (area_px > 0.0 && corners.iter().all(is_visible)).then_some(area_px)
    };
    let areas = mesh.triangles.iter().map(area_px);
    areas.map(|area_px| area_px.unwrap_or(0.0) as f32).collect()
}
