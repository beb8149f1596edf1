//! Extrema of the differences of Gaussians, with sub-sample accuracy.

use super::options::SiftOptions;
use super::scale_space::{MARGIN, Octave};
use crate::Result;
use crate::math::simd::dispatched;
use crate::math::{monitored, parallel};
use crate::progress::{Monitor, Stage};
use nalgebra::{Matrix3, Vector3};

/// Maximum number of steps of a search.
const MAX_MOVES: usize = 5;

/// An extremum of the scale space, in samples of its octave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extremum {
    pub(super) x: f32,
    pub(super) y: f32,
    /// Blur of the extremum.
    pub(super) sigma: f32,
    /// Layer whose gradients describe the extremum.
    pub(super) layer: usize,
    pub(super) response: f32,
}

/// Finds all extrema of one layer of differences, in reading order.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn find(
    octave: &Octave,
    layer: usize,
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Extremum>> {
    let height = octave.layer(layer).height() as usize;
    let rows = parallel::pieces(height.saturating_sub(2 * MARGIN), 32);
    let found = monitored::map(&rows, Stage::FeatureDetection, monitor, |rows| {
        find_in_rows(octave, layer, options, rows.clone())
    })?;
    let mut extrema: Vec<Extremum> = found.into_iter().flatten().collect();
    // Two equal neighbors may both lead to the same position.
    extrema.dedup();
    Ok(extrema)
}

fn find_in_rows(
    octave: &Octave,
    layer: usize,
    options: &SiftOptions,
    rows: std::ops::Range<usize>,
) -> Vec<Extremum> {
    let differences = Differences::new(octave, layer);
    let width = differences.width;
    // An extremum between samples may exceed the largest sample, but not twofold.
    let threshold = 0.5 * options.contrast_threshold / options.layers_per_octave as f32;
    let mut ring: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; width]);
    let mut flags = vec![0u8; width - 2];
    let mut found = Vec::new();
    for y in rows.start + MARGIN..rows.end + MARGIN {
        let first = if y == rows.start + MARGIN {
            y - 1
        } else {
            y + 1
        };
        for row in first..=y + 1 {
            differences.row(row, &mut ring[row % 3]);
        }
        let [above, here, below] = [&ring[(y - 1) % 3], &ring[y % 3], &ring[(y + 1) % 3]];
        flag_extrema(above, here, below, threshold, &mut flags);
        let inner = &flags[MARGIN - 1..width - MARGIN - 1];
        for (k, piece) in inner.chunks(8).enumerate() {
            let mut bytes = [0; 8];
            bytes[..piece.len()].copy_from_slice(piece);
            // Each byte is 0 or 1.
            let mut flagged = u64::from_le_bytes(bytes);
            while flagged != 0 {
                let x = 8 * k + flagged.trailing_zeros() as usize / 8 + MARGIN;
                flagged &= flagged - 1;
                if differences.is_extreme_across(x, y, here[x]) {
                    found.extend(locate(&differences, octave, layer, options, x, y));
                }
            }
        }
    }
    found
}

dispatched! {
    /// Marks samples beyond the threshold that no neighbor in their own layer exceeds; flag k is
    /// that of sample k + 1.
    fn flag_extrema(above: &[f32], here: &[f32], below: &[f32], threshold: f32, flags: &mut [u8]) {
        let n = flags.len();
        let (a0, a1, a2) = (&above[..n], &above[1..n + 1], &above[2..n + 2]);
        let (h0, h1, h2) = (&here[..n], &here[1..n + 1], &here[2..n + 2]);
        let (b0, b1, b2) = (&below[..n], &below[1..n + 1], &below[2..n + 2]);
        let max = |a: f32, b: f32| if a > b { a } else { b };
        let min = |a: f32, b: f32| if a < b { a } else { b };
        for x in 0..n {
            let value = h1[x];
            let high = max(max(max(a0[x], a1[x]), max(a2[x], h0[x])),
                max(max(h2[x], b0[x]), max(b1[x], b2[x])));
            let low = min(min(min(a0[x], a1[x]), min(a2[x], h0[x])),
                min(min(h2[x], b0[x]), min(b1[x], b2[x])));
            let peak = (value > threshold) & (value >= high);
            let dip = (value < -threshold) & (value <= low);
            flags[x] = u8::from(peak | dip);
        }
    }
}

/// Three consecutive layers of differences, computed on demand from the Gaussian layers.
struct Differences<'a> {
    gaussians: [&'a [f32]; 4],
    width: usize,
    height: usize,
}

impl<'a> Differences<'a> {
    fn new(octave: &'a Octave, layer: usize) -> Self {
        let image = octave.layer(layer);
        Self {
            gaussians: std::array::from_fn(|k| octave.layer(layer + k - 1).as_raw().as_slice()),
            width: image.width() as usize,
            height: image.height() as usize,
        }
    }

    /// Computes a row of the middle layer.
    fn row(&self, y: usize, out: &mut [f32]) {
        let range = y * self.width..(y + 1) * self.width;
        let (lower, upper) = (&self.gaussians[1][range.clone()], &self.gaussians[2][range]);
        for ((out, a), b) in out.iter_mut().zip(upper).zip(lower) {
            *out = a - b;
        }
    }

    /// Returns the difference at a sample of layer 0, 1 or 2 of the three.
    fn at(&self, layer: usize, x: usize, y: usize) -> f32 {
        let k = y * self.width + x;
        self.gaussians[layer + 1][k] - self.gaussians[layer][k]
    }

    /// Returns whether no sample of the two adjacent layers exceeds `value`.
    fn is_extreme_across(&self, x: usize, y: usize, value: f32) -> bool {
        let neighbors = |layer: usize, row: usize| {
            let from = row * self.width + x - 1;
            let lower = &self.gaussians[layer][from..from + 3];
            let upper = &self.gaussians[layer + 1][from..from + 3];
            [
                upper[0] - lower[0],
                upper[1] - lower[1],
                upper[2] - lower[2],
            ]
        };
        let places = [
            (0, y),
            (2, y),
            (0, y - 1),
            (0, y + 1),
            (2, y - 1),
            (2, y + 1),
        ];
        if value > 0.0 {
            (places.iter()).all(|&(layer, row)| neighbors(layer, row).iter().all(|&d| d <= value))
        } else {
            (places.iter()).all(|&(layer, row)| neighbors(layer, row).iter().all(|&d| d >= value))
        }
    }
}

/// Fits a quadratic around a sample and moves to its extremum; `None` if there is none nearby, if
/// it is weak, or if it lies on an edge.
///
/// Source: Brown & Lowe 2002, "Invariant features from interest point groups", eq. 3; Lowe 2004,
/// §4 and §4.1.
fn locate(
    differences: &Differences,
    octave: &Octave,
    layer: usize,
    options: &SiftOptions,
    mut x: usize,
    mut y: usize,
) -> Option<Extremum> {
    let (width, height) = (differences.width, differences.height);
    for _ in 0..MAX_MOVES {
        let d = |l: usize, i: usize, j: usize| f64::from(differences.at(l, x + i - 1, y + j - 1));
        let value = d(1, 1, 1);
        let gradient = Vector3::new(
            0.5 * (d(1, 2, 1) - d(1, 0, 1)),
            0.5 * (d(1, 1, 2) - d(1, 1, 0)),
            0.5 * (d(2, 1, 1) - d(0, 1, 1)),
        );
        let xx = d(1, 2, 1) + d(1, 0, 1) - 2.0 * value;
        let yy = d(1, 1, 2) + d(1, 1, 0) - 2.0 * value;
        let ss = d(2, 1, 1) + d(0, 1, 1) - 2.0 * value;
        let xy = 0.25 * (d(1, 2, 2) + d(1, 0, 0) - d(1, 0, 2) - d(1, 2, 0));
        let xs = 0.25 * (d(2, 2, 1) + d(0, 0, 1) - d(2, 0, 1) - d(0, 2, 1));
        let ys = 0.25 * (d(2, 1, 2) + d(0, 1, 0) - d(2, 1, 0) - d(0, 1, 2));
        let hessian = Matrix3::new(xx, xy, xs, xy, yy, ys, xs, ys, ss);
        let offset = -(hessian.try_inverse()? * gradient);
        if !offset.iter().all(|o| o.is_finite()) {
            return None;
        }
        // Move only in position: a neighbor in scale would have been found in its own layer.
        if offset.x.abs() > 0.6 || offset.y.abs() > 0.6 {
            let toward = |k: usize, o: f64| {
                let step = if o > 0.6 {
                    1
                } else if o < -0.6 {
                    -1
                } else {
                    0
                };
                k.checked_add_signed(step)
            };
            (x, y) = (toward(x, offset.x)?, toward(y, offset.y)?);
            let inside = |k: usize, size: usize| k >= MARGIN && k < size - MARGIN;
            if !inside(x, width) || !inside(y, height) {
                return None;
            }
            continue;
        }
        if offset.z.abs() > 1.0 {
            return None;
        }
        let response = (value + 0.5 * gradient.dot(&offset)).abs() as f32;
        if response * (options.layers_per_octave as f32) < options.contrast_threshold {
            return None;
        }
        let (trace, determinant) = (xx + yy, xx * yy - xy * xy);
        let ratio = f64::from(options.edge_threshold);
        if determinant <= 0.0
            || trace * trace * ratio >= (ratio + 1.0) * (ratio + 1.0) * determinant
        {
            return None;
        }
        return Some(Extremum {
            x: (x as f64 + offset.x) as f32,
            y: (y as f64 + offset.y) as f32,
            sigma: octave.sigma_at(layer as f64 + offset.z) as f32,
            // Within one layer of the middle one, so still in memory.
            layer: (layer as f64 + offset.z.round()) as usize,
            response,
        });
    }
    None
}
