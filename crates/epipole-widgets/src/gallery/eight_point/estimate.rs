//! F from matches by the core's eight-point algorithm, and its quality.

use crate::kit::matches::{Match, distance_px, line2};
use epipole::epipolar::{
    EightPoint, fundamental_8point_explained, fundamental_8point_unnormalized,
};
use epipole::math::Line2;
use nalgebra::{Matrix2, Matrix3, Point2, Vector2};

/// F with and without normalization, and the quality of the chosen one.
pub(super) struct Estimate {
    /// Matches that F was estimated from.
    pub(super) used: Vec<Match>,
    pub(super) normalized: EightPoint,
    pub(super) raw: EightPoint,
    is_normalized: bool,
    /// F with the normalization and the rank that the toggles choose.
    pub(super) fundamental: Matrix3<f64>,
    /// Intersection of the matches' epipolar lines, exact or nearly so.
    pub(super) meeting: Option<Meeting>,
    /// Mean distance of a match from its epipolar line in photograph 2, pixels.
    pub(super) used_px: f64,
    /// The same for exact matches held out of the estimation.
    pub(super) held_out_px: f64,
}

/// The least-squares intersection of many lines.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) place: Point2<f64>,
    /// Mean distance of the lines from it, pixels.
    pub(super) miss_px: f64,
}

impl Estimate {
    /// Estimates F from `used`, and evaluates it on `held_out`.
    ///
    /// # Errors
    /// As [`fundamental_8point_explained`].
    pub(super) fn new(
        used: Vec<Match>,
        held_out: &[Match],
        is_normalized: bool,
        has_rank2: bool,
    ) -> Result<Self, epipole::Error> {
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = used.iter().copied().unzip();
        let normalized = fundamental_8point_explained(&pixels1, &pixels2)?;
        let raw = fundamental_8point_unnormalized(&pixels1, &pixels2)?;
        let chosen = if is_normalized { &normalized } else { &raw };
        let fundamental = if has_rank2 {
            chosen.fundamental
        } else {
            chosen.full_rank
        };
        Ok(Self {
            fundamental,
            meeting: meeting(&fundamental, &pixels1),
            used_px: mean_distance_px(&fundamental, &used),
            held_out_px: mean_distance_px(&fundamental, held_out),
            used,
            normalized,
            raw,
            is_normalized,
        })
    }

    /// Returns the singular values of the stacked rows without and with normalization, largest
    /// first.
    pub(super) fn singular_values(&self) -> [&[f64; 9]; 2] {
        [&self.raw.singular_values, &self.normalized.singular_values]
    }

    /// Returns the solution in use.
    pub(super) fn chosen(&self) -> &EightPoint {
        if self.is_normalized {
            &self.normalized
        } else {
            &self.raw
        }
    }
}

/// Returns the mean distance of the second pixels from the lines of the first, pixels.
fn mean_distance_px(fundamental: &Matrix3<f64>, matches: &[Match]) -> f64 {
    let distances = matches
        .iter()
        .filter_map(|found| distance_px(fundamental, found));
    let distances: Vec<f64> = distances.collect();
    distances.iter().sum::<f64>() / distances.len().max(1) as f64
}

/// Returns the least-squares intersection of the epipolar lines of these pixels; `None` if they are
/// nearly parallel.
fn meeting(fundamental: &Matrix3<f64>, pixels1: &[Point2<f64>]) -> Option<Meeting> {
    let lines: Vec<Line2> = pixels1
        .iter()
        .filter_map(|pixel1| line2(fundamental, pixel1))
        .collect();
    let (mut normals, mut offsets) = (Matrix2::zeros(), Vector2::zeros());
    for line in &lines {
        let normal = Vector2::new(line.a, line.b);
        normals += normal * normal.transpose();
        offsets -= normal * line.c;
    }
    let trace = normals.trace();
    // Nearly parallel lines, or none at all.
    if normals.determinant().max(0.0) <= 1e-6 * trace * trace {
        return None;
    }
    let place = Point2::from(normals.try_inverse()? * offsets);
    let distance = |line: &Line2| line.signed_distance(&place).abs();
    Some(Meeting {
        place,
        miss_px: lines.iter().map(distance).sum::<f64>() / lines.len() as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_lines_meet_nowhere() {
        // For a step to the right the lines are rows.
        let fundamental = Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
        let pixels = [(10.0, 20.0), (300.0, 50.0), (90.0, 400.0)];
        assert!(meeting(&fundamental, &pixels.map(|(u, v)| Point2::new(u, v))).is_none());
    }
}
