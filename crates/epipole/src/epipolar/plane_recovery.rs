//! F when most matches lie on one plane.

use super::coordinates::Coordinates;
use super::sampson::support;
use crate::camera::cross_matrix;
use crate::math::null_space::right_singular_vectors;
use crate::math::random::Random;
use crate::math::svd3;
use nalgebra::{Matrix3, Vector3};

/// Replaces fundamental matrices from samples that lie mostly on a plane.
///
/// Seven matches of which five or more are on a plane are fitted by many fundamental matrices, and
/// a sample of such matches is what RANSAC draws when a plane dominates. The plane's homography H is
/// right, though, and two matches off the plane give the epipole: `F = [e2]ₓ H`.
///
/// Source: Chum, Werner & Matas 2005, "Two-view geometry estimation unaffected by a dominant
/// plane".
#[derive(Debug, Clone)]
pub(crate) struct PlaneRecovery {
    on_plane: Vec<usize>,
    off_plane: Vec<usize>,
}

/// Triples of a seven-match sample such that any five matches contain one of them.
const TRIPLES: [[usize; 3]; 5] = [[0, 1, 2], [3, 4, 5], [0, 1, 6], [3, 4, 6], [2, 5, 6]];

/// Pairs off the plane that are tried at most.
const MAX_PAIRS: usize = 400;

impl PlaneRecovery {
    pub(crate) fn new(num_matches: usize) -> Self {
        Self {
            on_plane: Vec::with_capacity(num_matches),
            off_plane: Vec::with_capacity(num_matches),
        }
    }

    /// A better matrix than `f` if the sample is on a plane; all in one frame.
    pub(crate) fn recover(
        &mut self,
        matches: &Coordinates,
        f: &Matrix3<f64>,
        sample: &[usize],
        max_error: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>> {
        let epipole2 = svd3(f).u.column(2).into_owned();
        let homography = TRIPLES.iter().find_map(|triple| {
            let h = homography_of_triple(matches, f, &epipole2, triple.map(|i| sample[i]))?;
            let on_plane = sample
                .iter()
                .filter(|&&i| transfer_error_sq(&h, matches.at(i)) < 4.0 * max_error * max_error)
                .count();
            (on_plane >= 5).then_some(h)
        })?;
        let homography = self.fit_plane(matches, homography, max_error)?;
        // Matches off the plane by so little say next to nothing about the epipole.
        self.off_plane.clear();
        for i in 0..matches.len() {
            if transfer_error_sq(&homography, matches.at(i)) > 9.0 * max_error * max_error {
                self.off_plane.push(i);
            }
        }
        self.best_epipole(matches, &homography, max_error, random)
    }

    /// Least squares over the matches near the plane, twice.
    fn fit_plane(
        &mut self,
        matches: &Coordinates,
        mut h: Matrix3<f64>,
        max_error: f64,
    ) -> Option<Matrix3<f64>> {
        for _ in 0..2 {
            self.on_plane.clear();
            for i in 0..matches.len() {
                if transfer_error_sq(&h, matches.at(i)) < 4.0 * max_error * max_error {
                    self.on_plane.push(i);
                }
            }
            if self.on_plane.len() < 5 {
                return None;
            }
            let on_plane = &self.on_plane;
            let (_, vectors) = right_singular_vectors(2 * on_plane.len(), |row| {
                let [u1, v1, u2, v2] = matches.at(on_plane[row / 2]);
                if row % 2 == 0 {
                    [u1, v1, 1.0, 0.0, 0.0, 0.0, -u2 * u1, -u2 * v1, -u2]
                } else {
                    [0.0, 0.0, 0.0, u1, v1, 1.0, -v2 * u1, -v2 * v1, -v2]
                }
            });
            h = Matrix3::from_row_slice(&vectors[8]);
        }
        Some(h)
    }

    /// The best `[e2]ₓ H` over pairs of matches off the plane.
    fn best_epipole(
        &self,
        matches: &Coordinates,
        h: &Matrix3<f64>,
        max_error: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>> {
        let num_off = self.off_plane.len();
        if num_off < 2 {
            return None;
        }
        let line = |i: usize| {
            let [u1, v1, u2, v2] = matches.at(i);
            (h * Vector3::new(u1, v1, 1.0)).cross(&Vector3::new(u2, v2, 1.0))
        };
        let mut best = None;
        let mut best_cost = f64::INFINITY;
        let mut needed = MAX_PAIRS;
        let mut tried = 0;
        while tried < needed {
            tried += 1;
            let first = random.below(num_off);
            let second = (first + 1 + random.below(num_off - 1)) % num_off;
            let epipole2 = line(self.off_plane[first]).cross(&line(self.off_plane[second]));
            let Some(epipole2) = epipole2.try_normalize(1e-300) else {
                continue;
            };
            let f = cross_matrix(&epipole2) * h;
            let found = support(matches, &f, max_error, best_cost);
            if found.cost < best_cost {
                best_cost = found.cost;
                best = Some(f);
                // Inliers beyond those of the plane are off it; pairs of them must be met with
                // probability 0.99.
                let off = found.num_inliers.saturating_sub(self.on_plane.len()).max(2);
                let share = (off as f64 / num_off as f64).min(1.0);
                let trials = libm::log(0.01) / libm::log1p(-(share * share).min(0.999_999));
                needed = needed.min((trials.ceil() as usize).max(tried));
            }
        }
        best
    }
}

/// The homography of the plane through three matches that agrees with F:
/// `H = A − e2 (M⁻¹ b)ᵀ`, `A = [e2]ₓ F`.
///
/// Source: Hartley & Zisserman 2004, result 13.6.
fn homography_of_triple(
    matches: &Coordinates,
    f: &Matrix3<f64>,
    epipole2: &Vector3<f64>,
    triple: [usize; 3],
) -> Option<Matrix3<f64>> {
    let a = cross_matrix(epipole2) * f;
    let mut m = Matrix3::zeros();
    let mut b = Vector3::zeros();
    for (row, i) in triple.into_iter().enumerate() {
        let [u1, v1, u2, v2] = matches.at(i);
        let (x1, x2) = (Vector3::new(u1, v1, 1.0), Vector3::new(u2, v2, 1.0));
        let across = x2.cross(epipole2);
        b[row] = x2.cross(&(a * x1)).dot(&across) / across.norm_squared();
        m.set_row(row, &x1.transpose());
    }
    let determinant = m.determinant();
    if determinant.abs() < 1e-9 {
        return None;
    }
    let h = a - epipole2 * (m.try_inverse()? * b).transpose();
    h.iter().all(|x| x.is_finite()).then_some(h)
}

/// Squared distance in image 2; infinite where H sends the point to infinity.
fn transfer_error_sq(h: &Matrix3<f64>, [u1, v1, u2, v2]: [f64; 4]) -> f64 {
    let x = h * Vector3::new(u1, v1, 1.0);
    let (du, dv) = (x.x / x.z - u2, x.y / x.z - v2);
    let error_sq = du * du + dv * dv;
    if error_sq.is_nan() {
        f64::INFINITY
    } else {
        error_sq
    }
}
