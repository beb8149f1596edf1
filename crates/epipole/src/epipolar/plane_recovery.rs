//! Recovery of F when most matches lie on one plane.

use super::coordinates::Coordinates;
use super::sampson::support;
use super::sampson_sq;
use crate::camera::cross_matrix;
use crate::math::null_space::right_singular_vectors;
use crate::math::random::Random;
use crate::math::svd3;
use nalgebra::{Matrix3, Point2, Vector3};

/// Replaces fundamental matrices from samples that lie mostly on a plane.
///
/// Many fundamental matrices fit seven matches if five or more are on a plane, and RANSAC draws
/// these samples when a plane dominates. But the plane's homography H is correct, and two matches
/// off the plane give the epipole: `F = [e2]ₓ H`.
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

/// Maximum number of pairs off the plane to try.
const MAX_PAIRS: usize = 400;

/// Minimum fraction of the inliers on a dominant plane.
const DOMINANT_FRACTION: f64 = 0.75;

/// Number of triples of inliers to try in search of a dominant plane: one in ten thousand searches
/// finds no triple on it.
const TRIPLES_TRIED: usize = 20;

/// Number of inliers on which the plane of a triple is tested.
const INLIERS_TRIED: usize = 200;

/// Maximum number of pairs off a dominant plane to try at the end.
const MAX_LAST_PAIRS: usize = 4000;

/// Number of epipoles of the best pairs to refine.
const REFINED_EPIPOLES: usize = 8;

/// Minimum gain in matches off the plane, by the MSAC score, to replace a matrix.
const CLEARLY_MORE: f64 = 1.0;

impl PlaneRecovery {
    pub(crate) fn new(num_matches: usize) -> Self {
        Self {
            on_plane: Vec::with_capacity(num_matches),
            off_plane: Vec::with_capacity(num_matches),
        }
    }

    /// Returns a better matrix than `f` if the sample is on a plane; all in one frame.
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
        self.find_off_plane(matches, &homography, max_error);
        self.best_epipole(matches, &homography, max_error, random)
    }

    /// Returns fundamental matrices that fit a dominant plane as well as `f` and more matches off
    /// it; all in one frame, not refined. Empty if no plane dominates.
    ///
    /// The matches on the plane fit `[e2]ₓ H` for any e2. But their distances to its lines depend
    /// on e2, and hundreds of them outweigh the few matches off the plane that determine e2: the
    /// best sum belongs to an e2 that happens to suit the noise. So the plane's matches are not
    /// scored here.
    pub(crate) fn alternatives(
        &mut self,
        matches: &Coordinates,
        f: &Matrix3<f64>,
        inliers: &[usize],
        max_error: f64,
        random: &mut Random,
    ) -> Vec<Matrix3<f64>> {
        let Some(homography) = self.dominant_plane(matches, f, inliers, max_error, random) else {
            return Vec::new();
        };
        self.find_off_plane(matches, &homography, max_error);
        let num_off = self.off_plane.len();
        if num_off < 2 {
            return Vec::new();
        }
        let mut ranked: Vec<(f64, Matrix3<f64>)> = Vec::new();
        let mut try_pair = |first: usize, second: usize| {
            let pair = [self.off_plane[first], self.off_plane[second]];
            if let Some(f) = through_pair(matches, &homography, pair) {
                // Two noisy matches give a rough epipole, so the threshold is doubled.
                let cost = self.cost_off_plane(matches, &f, 2.0 * max_error);
                let place = ranked.partition_point(|(other, _)| *other <= cost);
                if place < REFINED_EPIPOLES {
                    ranked.insert(place, (cost, f));
                    ranked.truncate(REFINED_EPIPOLES);
                }
            }
        };
        if num_off * (num_off - 1) / 2 <= MAX_LAST_PAIRS {
            for first in 1..num_off {
                (0..first).for_each(|second| try_pair(first, second));
            }
        } else {
            for _ in 0..MAX_LAST_PAIRS {
                let first = random.below(num_off);
                try_pair(first, (first + 1 + random.below(num_off - 1)) % num_off);
            }
        }
        ranked.into_iter().map(|(_, f)| f).collect()
    }

    /// Returns whether `other` fits clearly more of the matches off the last plane.
    pub(crate) fn fits_more_off_plane(
        &self,
        matches: &Coordinates,
        other: &Matrix3<f64>,
        than: &Matrix3<f64>,
        max_error: f64,
    ) -> bool {
        self.cost_off_plane(matches, other, max_error) + CLEARLY_MORE
            < self.cost_off_plane(matches, than, max_error)
    }

    /// Returns the MSAC cost of the matches off the plane.
    fn cost_off_plane(&self, matches: &Coordinates, f: &Matrix3<f64>, max_error: f64) -> f64 {
        let per_threshold_sq = 1.0 / (max_error * max_error);
        let cost = |&i: &usize| {
            let [u1, v1, u2, v2] = matches.at(i);
            let (x1, x2) = (Point2::new(u1, v1), Point2::new(u2, v2));
            (sampson_sq(f, &x1, &x2) * per_threshold_sq).min(1.0)
        };
        self.off_plane.iter().map(cost).sum()
    }

    /// Returns the homography of a plane that holds most of the inliers of `f`.
    pub(crate) fn dominant_plane(
        &mut self,
        matches: &Coordinates,
        f: &Matrix3<f64>,
        inliers: &[usize],
        max_error: f64,
        random: &mut Random,
    ) -> Option<Matrix3<f64>> {
        let near = |h: &Matrix3<f64>, i: usize| {
            transfer_error_sq(h, matches.at(i)) < 4.0 * max_error * max_error
        };
        let tried = inliers.len().min(INLIERS_TRIED);
        let mut best: Option<(usize, Matrix3<f64>)> = None;
        let epipole2 = svd3(f).u.column(2).into_owned();
        for _ in 0..TRIPLES_TRIED {
            let triple = [(); 3].map(|()| inliers[random.below(inliers.len())]);
            let Some(h) = homography_of_triple(matches, f, &epipole2, triple) else {
                continue;
            };
            let count = (0..tried)
                .filter(|k| near(&h, inliers[k * inliers.len() / tried]))
                .count();
            if best.is_none_or(|(most, _)| count > most) {
                best = Some((count, h));
            }
        }
        // Three matches give a rough plane; the fit finds more.
        let (count, h) = best?;
        if (count as f64) < 0.5 * DOMINANT_FRACTION * tried as f64 {
            return None;
        }
        let h = self.fit_plane(matches, h, max_error)?;
        let count = inliers.iter().filter(|&&i| near(&h, i)).count();
        (count as f64 >= DOMINANT_FRACTION * inliers.len() as f64).then_some(h)
    }

    /// Collects the matches off the plane, except those so close to it that they hardly constrain
    /// the epipole.
    fn find_off_plane(&mut self, matches: &Coordinates, homography: &Matrix3<f64>, max_error: f64) {
        self.off_plane.clear();
        for i in 0..matches.len() {
            if transfer_error_sq(homography, matches.at(i)) > 9.0 * max_error * max_error {
                self.off_plane.push(i);
            }
        }
    }

    /// Fits by least squares over the matches near the plane, twice.
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

    /// Returns the best `[e2]ₓ H` over pairs of matches off the plane.
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
        let mut best = None;
        let mut best_cost = f64::INFINITY;
        let mut needed = MAX_PAIRS;
        let mut tried = 0;
        while tried < needed {
            tried += 1;
            let first = random.below(num_off);
            let second = (first + 1 + random.below(num_off - 1)) % num_off;
            let pair = [self.off_plane[first], self.off_plane[second]];
            let Some(f) = through_pair(matches, h, pair) else {
                continue;
            };
            let found = support(matches, &f, max_error, best_cost);
            if found.cost < best_cost {
                best_cost = found.cost;
                best = Some(f);
                // Inliers beyond those of the plane are off it; a pair of them must be drawn with
                // probability 0.99.
                let off = found.num_inliers.saturating_sub(self.on_plane.len()).max(2);
                let fraction = (off as f64 / num_off as f64).min(1.0);
                let trials = libm::log(0.01) / libm::log1p(-(fraction * fraction).min(0.999_999));
                needed = needed.min((trials.ceil() as usize).max(tried));
            }
        }
        best
    }
}

/// Returns `[e2]ₓ H` with the epipole from two matches off the plane.
fn through_pair(matches: &Coordinates, h: &Matrix3<f64>, pair: [usize; 2]) -> Option<Matrix3<f64>> {
    let [first, second] = pair.map(|i| {
        let [u1, v1, u2, v2] = matches.at(i);
        (h * Vector3::new(u1, v1, 1.0)).cross(&Vector3::new(u2, v2, 1.0))
    });
    let epipole2 = first.cross(&second).try_normalize(1e-300)?;
    Some(cross_matrix(&epipole2) * h)
}

/// Returns the homography of the plane through three matches that agrees with F:
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

/// Returns the squared distance in image 2; infinite if H maps the point to infinity.
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
