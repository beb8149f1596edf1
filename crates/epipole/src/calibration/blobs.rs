//! Detection of disks, seen as ellipses.

use crate::Result;
use crate::imaging::{Border, GrayImage32, box_filter};
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::{Matrix2, Point2};

/// An ellipse-like spot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blob {
    pub(super) center: Point2<f64>,
    pub(super) area: f64,
}

/// Size of the surroundings with which a pixel is compared, relative to the longer side.
const SURROUNDINGS: f64 = 0.06;
/// Minimum difference between a pixel and its surroundings, of a range of 1.
const LEAST_CONTRAST: f32 = 0.04;
const LEAST_AREA: f64 = 9.0;
/// Ratio of area to 4π √det of the second moments: 1 for a filled ellipse, less for other shapes.
const ROUNDNESS: core::ops::Range<f64> = 0.85..1.12;
const MOST_SLANTED: f64 = 5.0;

/// Finds the spots that are darker, or brighter, than their surroundings.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn find_blobs(
    image: &GrayImage32,
    bright: bool,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Blob>> {
    let stage = Stage::FeatureDetection;
    let (width, height) = (image.width() as usize, image.height() as usize);
    let longer = width.max(height) as f64;
    let size = 2 * ((SURROUNDINGS * longer) as usize).clamp(4, 500) + 1;
    let part = &mut Part::new(monitor, 0.0, 0.8).of_stage(stage);
    let mean = box_filter(image, size, Border::Replicate, part)?;
    let sign = if bright { 1.0 } else { -1.0 };
    // Contrast with the surroundings, positive in a spot.
    let contrast: Vec<f32> = image
        .as_raw()
        .iter()
        .zip(mean.as_raw())
        .map(|(value, mean)| sign * (value - mean))
        .collect();
    let mut visited = vec![false; contrast.len()];
    let mut blobs = Vec::new();
    let mut stack = Vec::new();
    for start in 0..contrast.len() {
        if start % width == 0 {
            let fraction = 0.8 + 0.2 * start as f32 / contrast.len() as f32;
            report(monitor, stage, fraction)?;
        }
        if visited[start] || contrast[start] < LEAST_CONTRAST {
            continue;
        }
        visited[start] = true;
        stack.push(start);
        let mut spot = Vec::new();
        let mut at_border = false;
        while let Some(at) = stack.pop() {
            spot.push(at);
            let (u, v) = (at % width, at / width);
            at_border |= u == 0 || v == 0 || u + 1 == width || v + 1 == height;
            let ways = [
                (u > 0).then(|| at - 1),
                (u + 1 < width).then(|| at + 1),
                (v > 0).then(|| at - width),
                (v + 1 < height).then(|| at + width),
            ];
            for next in ways.into_iter().flatten() {
                if !visited[next] && contrast[next] >= LEAST_CONTRAST {
                    visited[next] = true;
                    stack.push(next);
                }
            }
        }
        if !at_border {
            blobs.extend(as_ellipse(image, &spot, width, sign));
        }
    }
    Ok(blobs)
}

/// Fits an ellipse to a spot, with pixels weighted by their gray between board and disk, as the
/// disk covers its edge pixels only in part.
fn as_ellipse(image: &GrayImage32, spot: &[usize], width: usize, sign: f32) -> Option<Blob> {
    let (u_min, u_max) = (
        spot.iter().map(|at| at % width).min()?,
        spot.iter().map(|at| at % width).max()?,
    );
    let (v_min, v_max) = (spot.iter().min()? / width, spot.iter().max()? / width);
    let height = image.height() as usize;
    let value = |u: usize, v: usize| sign * image.as_raw()[v * width + u];
    // Gray of the disk: the upper quartile of the spot. Gray of the board: the minimum around it.
    let mut inside: Vec<f32> = spot
        .iter()
        .map(|at| value(at % width, at / width))
        .collect();
    inside.sort_by(f32::total_cmp);
    let disk = inside[inside.len() * 3 / 4];
    let reach = 2;
    let (u0, u1) = (u_min.saturating_sub(reach), (u_max + reach).min(width - 1));
    let (v0, v1) = (v_min.saturating_sub(reach), (v_max + reach).min(height - 1));
    let mut around = Vec::new();
    for u in u0..=u1 {
        around.extend([value(u, v0), value(u, v1)]);
    }
    around.sort_by(f32::total_cmp);
    let board = around[around.len() / 2];
    let span = f64::from(disk - board);
    if span <= f64::from(LEAST_CONTRAST) {
        return None;
    }
    let (mut sum, mut center) = (0.0, nalgebra::Vector2::zeros());
    let mut moments = Matrix2::zeros();
    // Pixels of the spot and their neighbors.
    let is_near = near_mask(spot, width, (u0, u1), (v0, v1));
    let weight = |u: usize, v: usize| {
        if is_near[(v - v0) * (u1 - u0 + 1) + u - u0] {
            (f64::from(value(u, v) - board) / span).clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    for v in v0..=v1 {
        for u in u0..=u1 {
            let w = weight(u, v);
            sum += w;
            center += nalgebra::Vector2::new(u as f64, v as f64) * w;
        }
    }
    if sum < LEAST_AREA {
        return None;
    }
    center /= sum;
    for v in v0..=v1 {
        for u in u0..=u1 {
            let off = nalgebra::Vector2::new(u as f64, v as f64) - center;
            moments += off * off.transpose() * (weight(u, v) / sum);
        }
    }
    // Correct for the extent of a pixel.
    moments -= Matrix2::identity() / 12.0;
    let (determinant, trace) = (moments.determinant(), moments.trace());
    if determinant <= 0.0 {
        return None;
    }
    let root = (0.25 * trace * trace - determinant).max(0.0).sqrt();
    let slant = ((0.5 * trace + root) / (0.5 * trace - root)).sqrt();
    let ellipse = 4.0 * core::f64::consts::PI * determinant.sqrt();
    (slant < MOST_SLANTED && ROUNDNESS.contains(&(sum / ellipse))).then(|| Blob {
        center: center.into(),
        area: sum,
    })
}

fn near_mask(
    spot: &[usize],
    width: usize,
    (u0, u1): (usize, usize),
    (v0, v1): (usize, usize),
) -> Vec<bool> {
    let columns = u1 - u0 + 1;
    let mut mask = vec![false; columns * (v1 - v0 + 1)];
    for at in spot {
        let (u, v) = (at % width, at / width);
        for y in v.saturating_sub(2).max(v0)..=(v + 2).min(v1) {
            for x in u.saturating_sub(2).max(u0)..=(u + 2).min(u1) {
                mask[(y - v0) * columns + x - u0] = true;
            }
        }
    }
    mask
}
