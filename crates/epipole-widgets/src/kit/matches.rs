//! Matches of the still life's two photographs: exact from the scene geometry, or noisy.

use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, Seen, still_life_pair};
use epipole::camera::PosedCamera;
use epipole::epipolar::epipolar_line2;
use epipole::math::{Line2, random::Random};
use nalgebra::{Matrix3, Point2};
use std::cell::RefCell;
use std::rc::Rc;

/// Maximum number of matches for estimating F.
pub(crate) const MAX_USED: usize = 60;
/// Number of exact held-out matches that evaluate F.
const NUM_HELD_OUT: usize = 100;
/// Maximum number of pixels tried in photograph 1.
const MAX_TRIED: usize = 4000;
/// Minimum distance between matches for estimating F, pixels.
const APART_PX: f64 = 24.0;
/// Minimum distance of a match from the photograph's edge, pixels.
const MARGIN_PX: f64 = 8.0;

/// Pose of the second camera: meters to the right, meters forward, degrees to the left.
const MOTION: (f64, f64, f64) = (0.5, -0.6, 24.0);

/// A pixel of photograph 1 and its match in photograph 2.
pub(crate) type Match = (Point2<f64>, Point2<f64>);

/// Returns both cameras.
pub(crate) fn cameras() -> [PosedCamera; 2] {
    let (right_m, forward_m, left_deg) = MOTION;
    still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg)
}

/// Returns the exact match of a pixel of photograph 1, if it is visible in photograph 2.
pub(crate) fn exact_match(pixel1: &Point2<f64>) -> Option<Point2<f64>> {
    match Seen::of(&cameras(), pixel1) {
        Seen::Visible(pixel2) => Some(pixel2),
        _ => None,
    }
}

/// Returns the epipolar line of a pixel of photograph 1; `None` at the epipole.
pub(crate) fn line2(fundamental: &Matrix3<f64>, pixel1: &Point2<f64>) -> Option<Line2> {
    epipolar_line2(fundamental, pixel1).ok()
}

/// Returns the distance of a match's second pixel from the epipolar line of the first, pixels;
/// `None` if the first is the epipole, which has no line.
pub(crate) fn distance_px(fundamental: &Matrix3<f64>, (pixel1, pixel2): &Match) -> Option<f64> {
    let line = line2(fundamental, pixel1)?;
    Some(line.signed_distance(pixel2).abs())
}

/// Returns the mean distance of the second pixels from the lines of the first, pixels.
pub(crate) fn mean_distance_px(fundamental: &Matrix3<f64>, matches: &[Match]) -> f64 {
    let distances = matches
        .iter()
        .filter_map(|found| distance_px(fundamental, found));
    let distances: Vec<f64> = distances.collect();
    distances.iter().sum::<f64>() / distances.len().max(1) as f64
}

/// Cache size in seeds: the first ones, used by new figures, and the last one.
const MOST_KEPT: usize = 8;

thread_local! {
    static KEPT: RefCell<Vec<(u64, Rc<Matches>)>> = const { RefCell::new(Vec::new()) };
}

/// Matches for estimating F and for evaluating it.
pub(crate) struct Matches {
    exact: Vec<Match>,
    /// Standard normal noise for each coordinate of each match.
    disturbances: Vec<[f64; 4]>,
    pub(crate) held_out: Vec<Match>,
}

impl Matches {
    /// Draws pixels of photograph 1 and their matches. The result is cached, since after every
    /// change the state is compared with that of a new figure.
    pub(crate) fn draw(seed: u64) -> Rc<Self> {
        KEPT.with_borrow_mut(|kept| {
            if let Some((_, known)) = kept.iter().find(|(of, _)| *of == seed) {
                return Rc::clone(known);
            }
            let matches = Rc::new(Self::drawn(seed));
            kept.truncate(MOST_KEPT - 1);
            kept.push((seed, Rc::clone(&matches)));
            matches
        })
    }

    fn drawn(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let (mut exact, mut held_out): (Vec<Match>, Vec<Match>) = (Vec::new(), Vec::new());
        for _ in 0..MAX_TRIED {
            if held_out.len() == NUM_HELD_OUT {
                break;
            }
            let mut along = |size: u32| random.uniform(MARGIN_PX, f64::from(size) - MARGIN_PX);
            let pixel1 = Point2::new(along(PHOTO_WIDTH), along(PHOTO_HEIGHT));
            let near = |other: &Match| (other.0 - pixel1).norm() < APART_PX;
            let for_use = exact.len() < MAX_USED;
            if for_use && exact.iter().any(near) {
                continue;
            }
            if let Some(pixel2) = exact_match(&pixel1) {
                let list = if for_use { &mut exact } else { &mut held_out };
                list.push((pixel1, pixel2));
            }
        }
        let disturbances = exact
            .iter()
            .map(|_| core::array::from_fn(|_| random.normal()))
            .collect();
        Self {
            exact,
            disturbances,
            held_out,
        }
    }

    /// Returns the first `count` matches with normal noise on their coordinates.
    pub(crate) fn noisy(&self, count: usize, noise_px: f64) -> Vec<Match> {
        let disturbed = self.exact.iter().zip(&self.disturbances).take(count);
        let moved = |p: &Point2<f64>, by: &[f64]| {
            Point2::new(p.x + noise_px * by[0], p.y + noise_px * by[1])
        };
        disturbed
            .map(|((x1, x2), by)| (moved(x1, &by[..2]), moved(x2, &by[2..])))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::in_picture;
    use epipole::epipolar::{fundamental_from_cameras, sampson_px};

    #[test]
    fn every_seed_gives_enough_matches_that_obey_the_cameras() {
        let [first, second] = cameras();
        let fundamental = fundamental_from_cameras(&first, &second).unwrap();
        for seed in [1, 2, 99] {
            let matches = Matches::draw(seed);
            assert_eq!(matches.exact.len(), MAX_USED);
            assert_eq!(matches.held_out.len(), NUM_HELD_OUT);
            for (x1, x2) in matches.exact.iter().chain(&matches.held_out) {
                assert!(sampson_px(&fundamental, x1, x2) < 1e-9);
                assert!(in_picture(x1) && in_picture(x2));
            }
            assert_eq!(matches.noisy(9, 0.0), matches.exact[..9]);
        }
    }
}
