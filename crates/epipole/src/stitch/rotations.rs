//! Rotations of cameras at one position, with a common focal factor.

use super::jacobian::{PixelMatch, RotationParameters, RotationsProblem};
use super::overlap::Overlap;
use super::tree::Tree;
use crate::camera::Intrinsics;
use crate::optim::{LmOptions, minimize_dense};
use crate::progress::Monitor;
use crate::two_view::align_rays;
use crate::{Error, Result};
use nalgebra::{DVector, Matrix3, Point2, Vector3};

/// Maximum ratio between the estimated focal length and the given one, either way.
const WIDEST: f64 = 4.0;

/// Number of factors tried, evenly spaced by logarithm: steps of 9 %.
const NUM_TRIED: usize = 33;

/// Maximum number of matches over all overlaps, to limit the dense Jacobian.
const MAX_MATCHES: usize = 6000;

/// Minimum number of matches kept per overlap when there are too many.
const MIN_OF_OVERLAP: usize = 30;

/// Squared error at which the cost of a match is truncated, px².
const CLIPPED_SQ: f64 = 25.0;

/// Rotation of each photo; `None` for photos outside the tree.
pub(super) type Rotations = Vec<Option<Matrix3<f64>>>;

/// Estimates the rotations and the focal length that best explain the overlaps of a tree.
///
/// * `intrinsics`: intrinsics of each photo; focal lengths are known or guessed
/// * `find_focal`: whether to estimate a common factor of all focal lengths
///
/// If the matches do not determine the factor, `None` is returned for it, and 1 is used.
///
/// # Errors
/// [`Error::Degenerate`] if the matches of an overlap do not determine its rotation;
/// [`Error::Canceled`].
pub(super) fn estimate_rotations(
    intrinsics: &[Intrinsics],
    overlaps: &[Overlap],
    tree: &Tree,
    find_focal: bool,
    monitor: &mut dyn Monitor,
) -> Result<(Rotations, Option<f64>)> {
    let mut number_of = vec![None; intrinsics.len()];
    let children = tree.edges.iter().map(|edge| edge[0]);
    for (number, image) in std::iter::once(tree.root).chain(children).enumerate() {
        number_of[image] = Some(number);
    }
    let joined = |overlap: &&Overlap| {
        overlap
            .images
            .iter()
            .all(|&image| number_of[image].is_some())
    };
    let used: Vec<&Overlap> = overlaps.iter().filter(joined).collect();
    let each = (MAX_MATCHES / used.len().max(1)).max(MIN_OF_OVERLAP);
    let thinned = |overlap: &Overlap| -> Vec<[Point2<f64>; 2]> {
        let step = overlap.pixels[0].len().div_ceil(each).max(1);
        let pairs = overlap.pixels[0].iter().zip(&overlap.pixels[1]);
        pairs.step_by(step).map(|(a, b)| [*a, *b]).collect()
    };
    let pairs: Vec<Vec<[Point2<f64>; 2]>> = used.iter().map(|overlap| thinned(overlap)).collect();
    let of = |overlap: &Overlap| overlap.images.map(|image| &intrinsics[image]);
    let cost = |factor: f64| -> f64 {
        let each = used.iter().zip(&pairs);
        each.map(|(overlap, pairs)| cost_of(of(overlap), pairs, factor))
            .sum()
    };
    let start = match find_focal {
        true => best_factor(cost),
        false => None,
    };
    let factor = start.unwrap_or(1.0);

    let mut rotations = vec![None; intrinsics.len()];
    rotations[tree.root] = Some(Matrix3::identity());
    for &[child, parent, index] in &tree.edges {
        let overlap = &overlaps[index];
        let rotation =
            rotation_of(of(overlap), &thinned(overlap), factor).ok_or(Error::Degenerate {
                what: "the rotation of a photo",
                why: "its matches meet in a point",
            })?;
        let rotation = match overlap.images[0] == parent {
            true => rotation,
            false => rotation.transpose(),
        };
        rotations[child] = rotations[parent].map(|of_parent: Matrix3<f64>| rotation * of_parent);
    }
    let order = std::iter::once(tree.root).chain(tree.edges.iter().map(|edge| edge[0]));
    let order: Vec<usize> = order.collect();
    let matches = used.iter().zip(&pairs).flat_map(|(overlap, pairs)| {
        let [a, b] = overlap.images;
        let numbers = [a, b].map(|image| number_of[image].unwrap_or(0));
        pairs.iter().map(move |pixels| PixelMatch {
            images: numbers,
            pixels: *pixels,
        })
    });
    let problem = RotationsProblem {
        matches: matches.collect(),
        rotations: RotationParameters {
            intrinsics: order.iter().map(|&image| intrinsics[image]).collect(),
            starts: (order.iter())
                .map(|&image| rotations[image].unwrap_or_default())
                .collect(),
            factor,
        },
        is_focal_held: start.is_none(),
    };
    let mut parameters = DVector::zeros(problem.num_parameters());
    minimize_dense(&problem, &mut parameters, &LmOptions::default(), monitor)?;
    for (number, &image) in order.iter().enumerate() {
        rotations[image] = Some(problem.rotations.rotation(&parameters, number));
    }
    Ok((
        rotations,
        start.map(|_| problem.rotations.factor(&parameters)),
    ))
}

/// Returns the factor with the least cost; `None` at the end of the range, where every longer focal
/// length fits.
fn best_factor(cost: impl Fn(f64) -> f64) -> Option<f64> {
    let at = |n: usize| {
        let fraction = n as f64 / (NUM_TRIED - 1) as f64;
        libm::exp((2.0 * fraction - 1.0) * libm::log(WIDEST))
    };
    let costs: Vec<f64> = (0..NUM_TRIED).map(|n| cost(at(n))).collect();
    let best = (0..NUM_TRIED).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
    (best > 0 && best + 1 < NUM_TRIED).then(|| at(best))
}

fn ray(k: &Intrinsics, pixel: &Point2<f64>, factor: f64) -> Vector3<f64> {
    let ray = k.ray(pixel);
    Vector3::new(ray.x, ray.y, ray.z * factor).normalize()
}

/// Returns the rotation from the first image to the second that best aligns the rays.
fn rotation_of(
    [k1, k2]: [&Intrinsics; 2],
    pairs: &[[Point2<f64>; 2]],
    factor: f64,
) -> Option<Matrix3<f64>> {
    let rays: Vec<[Vector3<f64>; 2]> = (pairs.iter())
        .map(|[a, b]| [ray(k1, a, factor), ray(k2, b, factor)])
        .collect();
    align_rays(rays.iter())
}

/// Returns the sum of truncated squared errors in image 2, px².
fn cost_of([k1, k2]: [&Intrinsics; 2], pairs: &[[Point2<f64>; 2]], factor: f64) -> f64 {
    let most = CLIPPED_SQ * pairs.len() as f64;
    let Some(rotation) = rotation_of([k1, k2], pairs, factor) else {
        return most;
    };
    let error_sq = |[a, b]: &[Point2<f64>; 2]| {
        let rotated = rotation * ray(k1, a, factor);
        // As from a camera whose focal length is multiplied by the factor.
        let rotated = Vector3::new(rotated.x, rotated.y, rotated.z / factor);
        match rotated.z > 0.0 {
            true => (k2.matrix() * rotated / rotated.z - b.to_homogeneous())
                .norm_squared()
                .min(CLIPPED_SQ),
            false => CLIPPED_SQ,
        }
    };
    pairs.iter().map(error_sq).sum()
}

#[cfg(test)]
mod tests;
