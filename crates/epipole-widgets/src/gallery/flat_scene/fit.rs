//! Singular values of the normalized rows, and every F that fits about as well as the best.

use crate::kit::matches::{Match, line2, mean_distance_px};
use epipole::Error;
use epipole::epipolar::{Normalization, epipolar_row};
use epipole::math::{Line2, right_singular_vectors};
use nalgebra::{Matrix3, Point2};

/// Maximum residual `‖A f‖` of an F that fits, relative to that of the best, σ₉.
pub(super) const FITS: f64 = 1.5;
/// Residual of rounding errors, relative to σ₁.
const ROUNDING: f64 = 1e-9;
/// Number of other F around the best one.
const NUM_OTHERS: usize = 8;
/// Maximum angle between the best f and another one.
const WIDEST_DEG: f64 = 60.0;

/// The eight-point algorithm before rank 2, and its neighbors.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    /// Singular values of the normalized rows, largest first.
    pub(super) singular_values: [f64; 9],
    /// Best F.
    pub(super) best: Matrix3<f64>,
    /// Other F that fit within [`FITS`], as far from the best as that allows.
    pub(super) others: Vec<Matrix3<f64>>,
}

impl Fit {
    /// Solves `A f = 0`, `‖f‖ = 1`.
    ///
    /// # Errors
    /// As [`Normalization::new`].
    pub(super) fn new(matches: &[Match]) -> Result<Self, Error> {
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = matches.iter().copied().unzip();
        let (n1, n2) = (Normalization::new(&pixels1)?, Normalization::new(&pixels2)?);
        let (singular_values, vectors) = right_singular_vectors(matches.len(), |i| {
            epipolar_row(&n1.apply(&pixels1[i]), &n2.apply(&pixels2[i]))
        });
        let vector = |k: usize| Matrix3::from_row_slice(&vectors[k]);
        let undo = |f: Matrix3<f64>| n2.matrix().transpose() * f * n1.matrix();
        let turned = directions(&singular_values)
            .map(|[a, b, c]| undo(vector(8) * a + vector(7) * b + vector(6) * c));
        Ok(Self {
            singular_values,
            best: undo(vector(8)),
            others: turned.collect(),
        })
    }

    /// Returns `σ₈ / σ₉`, with rounding in place of a σ₉ of zero.
    pub(super) fn ratio(&self) -> f64 {
        let sigma = &self.singular_values;
        sigma[7] / least(sigma)
    }

    /// Returns the largest angle between the line of a pixel by the best F and by another one,
    /// degrees.
    pub(super) fn fan_deg(&self, pixel1: &Point2<f64>) -> Option<f64> {
        let best = line2(&self.best, pixel1)?;
        let lines = self.others.iter().filter_map(|other| line2(other, pixel1));
        Some(
            lines
                .map(|line| angle_deg(&best, &line))
                .fold(0.0, f64::max),
        )
    }

    /// Returns the mean distance of matches from their lines by the best F, pixels.
    pub(super) fn mean_px(&self, matches: &[Match]) -> f64 {
        mean_distance_px(&self.best, matches)
    }
}

/// Returns the residual of the best f, or that of rounding errors if it is smaller.
fn least(sigma: &[f64; 9]) -> f64 {
    sigma[8].max(ROUNDING * sigma[0])
}

/// Returns the unit vectors `f = a v₉ + b v₈ + c v₇` with `‖A f‖ ≤ FITS σ₉` that are farthest from
/// v₉, in several directions.
fn directions(sigma: &[f64; 9]) -> impl Iterator<Item = [f64; 3]> {
    let squares = [sigma[8], sigma[7], sigma[6]].map(|sigma| sigma * sigma);
    let allowed = FITS * least(sigma);
    let allowed_sq = allowed * allowed;
    (0..NUM_OTHERS).map(move |k| {
        let turn = std::f64::consts::TAU * k as f64 / NUM_OTHERS as f64;
        let (b, c) = (libm::cos(turn), libm::sin(turn));
        // `‖A f‖² = cos²φ σ₉² + sin²φ (b² σ₈² + c² σ₇²)`.
        let other_sq = b * b * squares[1] + c * c * squares[2];
        let sin_sq = (allowed_sq - squares[0]) / (other_sq - squares[0]).max(1e-300);
        let widest = libm::sin(WIDEST_DEG.to_radians());
        let sin = sin_sq.sqrt().min(widest);
        [(1.0 - sin * sin).sqrt(), sin * b, sin * c]
    })
}

/// Returns the angle between two lines, 0° to 90°.
fn angle_deg(one: &Line2, other: &Line2) -> f64 {
    let (cos, sin) = (
        one.a * other.a + one.b * other.b,
        one.a * other.b - one.b * other.a,
    );
    libm::atan2(sin.abs(), cos.abs()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::super::scene::{Scene, cameras, pixel2};
    use super::*;
    use crate::kit::matches::distance_px;
    use epipole::epipolar::{fundamental_8point_explained, fundamental_from_cameras};

    fn same(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
        let (a, b) = (a / a.norm(), b / b.norm());
        (a - b).norm().min((a + b).norm())
    }

    #[test]
    fn it_is_the_eight_point_algorithm_of_the_core() {
        for seed in 1..=20 {
            for (spread, noise_px) in [(1.0, 0.0), (1.0, 0.3), (0.2, 1.0), (0.01, 0.5), (0.0, 1.0)]
            {
                let matches = Scene::draw(seed).matches(spread, noise_px);
                let (pixels1, pixels2): (Vec<_>, Vec<_>) = matches.iter().copied().unzip();
                let fit = Fit::new(&matches).unwrap();
                let core = fundamental_8point_explained(&pixels1, &pixels2).unwrap();
                for (one, other) in fit.singular_values.iter().zip(core.singular_values) {
                    assert!((one - other).abs() < 1e-12 * fit.singular_values[0]);
                }
                let off = same(&fit.best, &core.full_rank);
                assert!(off < 1e-6, "{seed} {spread} {noise_px}: {off}");
            }
        }
    }

    #[test]
    fn the_others_fit_as_well_as_promised() {
        for (spread, noise_px) in [(1.0, 0.3), (0.1, 0.3), (0.0, 0.3), (0.0, 1.0)] {
            let sigma = Fit::new(&Scene::draw(1).matches(spread, noise_px))
                .unwrap()
                .singular_values;
            for [a, b, c] in directions(&sigma) {
                assert!((a * a + b * b + c * c - 1.0).abs() < 1e-12);
                let terms = [a * sigma[8], b * sigma[7], c * sigma[6]];
                let residual = terms.iter().map(|x| x * x).sum::<f64>().sqrt();
                assert!(residual < 1.5000001 * sigma[8], "{residual} {sigma:?}");
            }
        }
    }

    #[test]
    fn exact_points_in_depth_give_the_true_f_alone() {
        let [first, second] = cameras().unwrap();
        let truth = fundamental_from_cameras(&first, &second).unwrap();
        let scene = Scene::draw(1);
        let fit = Fit::new(&scene.matches(1.0, 0.0)).unwrap();
        assert!(same(&fit.best, &truth) < 1e-9);
        assert!(fit.ratio() > 1e6 && fit.mean_px(&scene.new_points()) < 1e-6);
        assert!(fit.fan_deg(&Point2::new(300.0, 200.0)).unwrap() < 1e-3);
    }

    #[test]
    fn a_plane_leaves_three_directions_open_and_fixes_the_match() {
        let scene = Scene::draw(1);
        let matches = scene.matches(0.0, 0.0);
        let fit = Fit::new(&matches).unwrap();
        let sigma = fit.singular_values;
        assert!(
            sigma[6] < 1e-12 * sigma[0] && sigma[5] > 1e-3 * sigma[0],
            "{sigma:?}"
        );
        assert!(fit.ratio() < FITS);
        // Every F that fits draws its line through the match of a point on the plane.
        let pixel1 = Point2::new(300.0, 200.0);
        let pair = (pixel1, pixel2(&pixel1, 0.0).unwrap());
        for other in &fit.others {
            assert!(distance_px(other, &pair).unwrap() < 1e-6);
        }
        assert!(fit.fan_deg(&pixel1).unwrap() > 20.0);
        assert!(fit.mean_px(&matches) < 1e-6);
        assert!(fit.mean_px(&scene.new_points()) > 5.0);
    }
}
