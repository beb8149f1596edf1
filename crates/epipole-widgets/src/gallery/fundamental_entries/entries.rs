//! The true F of two photographs, its modified entries, and their epipolar lines.

use crate::kit::geometry::Geometry;
use crate::kit::matches::{Match, mean_distance_px};
use crate::kit::meeting::Meeting;
use crate::kit::scenes::{PHOTO_SIZE, Seen, still_life_pair};
use epipole::camera::PosedCamera;
use epipole::epipolar::{Normalization, enforce_rank2};
use epipole::math::svd3;
use nalgebra::{Matrix3, Point2, Vector3};

/// Pose of the second camera: meters to the right, meters forward, degrees to the left. Its
/// photograph shows the first camera's position.
const MOTION: (f64, f64, f64) = (0.25, -0.6, 10.0);
/// Pixels of photograph 1 with a match: the sun in a picture, the vase's rim, the mug's handle, the
/// border of the cloth, a poster and the table.
const PLACES_PX: [(f64, f64); 6] = [
    (216.0, 60.0),
    (332.0, 130.0),
    (479.0, 327.0),
    (300.0, 410.0),
    (560.0, 120.0),
    (130.0, 380.0),
];
/// Maximum third singular value of a matrix of rank 2, relative to the first.
const ROUNDING: f64 = 1e-12;

/// Returns both cameras.
pub(super) fn cameras() -> [PosedCamera; 2] {
    let (right_m, forward_m, left_deg) = MOTION;
    still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg)
}

/// Exact matches, the F of the cameras, and the normalization.
pub(super) struct Truth {
    pub(super) matches: Vec<Match>,
    pub(super) fundamental: Matrix3<f64>,
    /// Hartley's normalization of the matches in both photographs.
    normalizations: [Matrix3<f64>; 2],
    /// F in normalized coordinates, of norm 1.
    normalized: Matrix3<f64>,
}

impl Truth {
    /// Computes the matches and F; `None` only for cameras without epipolar geometry.
    pub(super) fn new() -> Option<Self> {
        let cameras = cameras();
        let matched = |&(u, v): &(f64, f64)| {
            let pixel1 = Point2::new(u, v);
            match Seen::of(&cameras, &pixel1) {
                Seen::Visible(pixel2) => Some((pixel1, pixel2)),
                _ => None,
            }
        };
        let matches: Vec<Match> = PLACES_PX.iter().filter_map(matched).collect();
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = matches.iter().copied().unzip();
        let [n1, n2] = [&pixels1, &pixels2].map(|pixels| Normalization::new(pixels).ok());
        let (n1, n2) = (n1?, n2?);
        let fundamental = Geometry::of(&cameras)?.fundamental;
        let normalized = n2.inverse_matrix().transpose() * fundamental * n1.inverse_matrix();
        Some(Self {
            matches,
            fundamental: fundamental.normalize(),
            normalizations: [n1.matrix(), n2.matrix()],
            normalized: normalized.normalize(),
        })
    }

    /// Returns the nine entries without changes.
    pub(super) fn numbers(&self, is_normalized: bool) -> &Matrix3<f64> {
        if is_normalized {
            &self.normalized
        } else {
            &self.fundamental
        }
    }
}

/// Changes of the nine entries, and a common factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    pub(super) is_normalized: bool,
    /// Added to the entries.
    pub(super) by: Matrix3<f64>,
    pub(super) has_rank2: bool,
    /// Multiplies all entries at the end.
    pub(super) scale: f64,
}

/// The nine entries after a change, and their epipolar lines.
pub(super) struct Entries {
    /// The entries, in normalized coordinates or in pixels.
    pub(super) numbers: Matrix3<f64>,
    /// F for pixels.
    pub(super) fundamental: Matrix3<f64>,
    /// Singular values of the entries, largest first.
    pub(super) singular_values: Vector3<f64>,
    /// Mean distance of the matches from their lines, pixels; `None` if there are no lines.
    pub(super) mean_px: Option<f64>,
    pub(super) meeting: Option<Meeting>,
}

impl Entries {
    /// Applies a change.
    ///
    /// # Errors
    /// As [`enforce_rank2`].
    pub(super) fn new(truth: &Truth, change: &Change) -> Result<Self, epipole::Error> {
        let mut numbers = truth.numbers(change.is_normalized) + change.by;
        if change.has_rank2 {
            numbers = enforce_rank2(&numbers)?;
        }
        numbers *= change.scale;
        let [n1, n2] = &truth.normalizations;
        let fundamental = if change.is_normalized {
            n2.transpose() * numbers * n1
        } else {
            numbers
        };
        let pixels1: Vec<_> = truth.matches.iter().map(|(pixel1, _)| *pixel1).collect();
        let has_lines = numbers.amax() > 0.0;
        Ok(Self {
            numbers,
            fundamental,
            singular_values: svd3(&numbers).singular_values,
            mean_px: has_lines.then(|| mean_distance_px(&fundamental, &truth.matches)),
            meeting: Meeting::of(&fundamental, &pixels1),
        })
    }

    /// Returns the rank, up to rounding.
    pub(super) fn rank(&self) -> usize {
        let largest = self.singular_values[0];
        let is_zero = |value: f64| value <= ROUNDING * largest;
        self.singular_values
            .iter()
            .filter(|value| !is_zero(**value))
            .count()
    }

    /// Returns the determinant, 0 up to rounding for a rank below 3.
    pub(super) fn determinant(&self) -> f64 {
        if self.rank() < 3 {
            0.0
        } else {
            self.numbers.determinant()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::matches::line2;

    fn apply(truth: &Truth, edit: impl Fn(&mut Change)) -> Entries {
        let mut change = Change {
            is_normalized: true,
            by: Matrix3::zeros(),
            has_rank2: false,
            scale: 1.0,
        };
        edit(&mut change);
        Entries::new(truth, &change).unwrap()
    }

    #[test]
    fn without_a_change_every_match_is_on_its_line() {
        let truth = Truth::new().unwrap();
        assert_eq!(truth.matches.len(), PLACES_PX.len());
        for is_normalized in [true, false] {
            for scale in [-2.0, 0.5, 1.0] {
                let entries = apply(&truth, |change| {
                    change.is_normalized = is_normalized;
                    change.scale = scale;
                });
                assert!((entries.numbers.norm() - f64::abs(scale)).abs() < 1e-12);
                assert!(entries.mean_px.unwrap() < 1e-9 && entries.meeting.unwrap().is_exact());
                assert_eq!((entries.rank(), entries.determinant()), (2, 0.0));
            }
        }
        let zero = apply(&truth, |change| change.scale = 0.0);
        assert!(zero.mean_px.is_none() && zero.meeting.is_none() && zero.rank() == 0);
    }

    #[test]
    fn an_entry_of_the_third_row_shifts_lines_and_turns_none() {
        let truth = Truth::new().unwrap();
        let turned_deg = |row: usize| {
            let entries = apply(&truth, |change| change.by[(row, 2)] = 0.1);
            let turned = truth.matches.iter().map(|(pixel1, _)| {
                let [before, after] = [&truth.fundamental, &entries.fundamental]
                    .map(|fundamental| line2(fundamental, pixel1).unwrap());
                libm::asin(before.a * after.b - before.b * after.a)
                    .to_degrees()
                    .abs()
            });
            turned.fold(0.0, f64::max)
        };
        assert!(turned_deg(2) < 1e-9 && turned_deg(0) > 3.0 && turned_deg(1) > 3.0);
    }

    #[test]
    fn rank_2_makes_the_lines_meet_again_at_another_place() {
        let truth = Truth::new().unwrap();
        let broken = apply(&truth, |change| change.by[(0, 0)] = 0.2);
        assert!(broken.rank() == 3 && broken.determinant() > 0.01);
        assert!(broken.meeting.unwrap().miss_px > 20.0);
        let repaired = apply(&truth, |change| {
            change.by[(0, 0)] = 0.2;
            change.has_rank2 = true;
        });
        let [before, after] = [
            apply(&truth, |_| ()).meeting.unwrap(),
            repaired.meeting.unwrap(),
        ];
        assert!(repaired.rank() == 2 && after.is_exact());
        assert!((after.place - before.place).norm() > 5.0);
    }

    #[test]
    fn the_same_change_does_more_to_an_entry_that_multiplies_large_pixels() {
        let truth = Truth::new().unwrap();
        let mean_px = |is_normalized, place: (usize, usize)| {
            let entries = apply(&truth, |change| {
                change.is_normalized = is_normalized;
                change.by[place] = 0.01;
            });
            entries.mean_px.unwrap()
        };
        assert!(mean_px(false, (0, 0)) > 100.0 * mean_px(false, (2, 2)));
        let ratio = mean_px(true, (0, 0)) / mean_px(true, (2, 2));
        assert!((0.3..3.0).contains(&ratio), "{ratio}");
    }
}
