//! Outermost points, which determine how near a view can be: only few of many points ever touch an
//! edge of the picture.

use super::perspective::{FOCAL, NEAREST};
use nalgebra::Vector3;

/// Outermost points in the frame of a camera that translates but does not rotate.
///
/// The point at an edge of the picture has the smallest or largest `x / z`, wherever the camera is,
/// so it is on the convex hull of all `(x, z)`, or of all `(y, z)`.
pub(super) struct Outermost {
    /// Hulls of `(x, z)` and `(y, z)`.
    hulls: [Vec<[f64; 2]>; 2],
}

impl Outermost {
    /// Selects them from points; ignores points that are not finite.
    pub(super) fn of(places: impl Iterator<Item = Vector3<f64>>) -> Self {
        let places: Vec<Vector3<f64>> = places
            .filter(|place| place.iter().all(|x| x.is_finite()))
            .collect();
        let hull_along = |axis: usize| hull(places.iter().map(|p| [p[axis], p.z]).collect());
        Self {
            hulls: [hull_along(0), hull_along(1)],
        }
    }

    /// Returns the range of the points along an axis of a square picture, as fractions of its side;
    /// `None` if one of them is not visible, or there is none.
    fn reach(&self, axis: usize, aside: f64, distance: f64, nearest: f64) -> Option<[f64; 2]> {
        let mut reach = None;
        for [across, ahead] in &self.hulls[axis] {
            let depth = ahead + distance;
            if depth <= nearest {
                return None;
            }
            let at = FOCAL * (across - aside) / depth + 0.5;
            let [low, high] = reach.unwrap_or([at, at]);
            reach = Some([low.min(at), high.max(at)]);
        }
        reach
    }

    /// Returns the sideways shift that centers the points in the picture, if all are then inside
    /// and they do not coincide.
    ///
    /// * `aside`: initial guess
    /// * `distance`: distance from the orbit's center
    /// * `size`: size of the scene
    pub(super) fn centered(
        &self,
        mut aside: Vector3<f64>,
        distance: f64,
        size: f64,
    ) -> Option<Vector3<f64>> {
        /// Border, as a fraction of the picture's side.
        const BORDER: f64 = 0.04;
        let mut is_inside = false;
        for _ in 0..32 {
            let along = |axis: usize| self.reach(axis, aside[axis], distance, NEAREST * size);
            let reaches = [along(0)?, along(1)?];
            if reaches.iter().all(|[low, high]| high - low < 1e-9) {
                return None;
            }
            let inside = |x: &f64| (BORDER..=1.0 - BORDER).contains(x);
            is_inside = reaches.iter().flatten().all(inside);
            for (axis, [low, high]) in reaches.into_iter().enumerate() {
                // Near points move more than the average, so damp each step.
                aside[axis] -= 0.4 * (0.5 - 0.5 * (low + high)) * distance / FOCAL;
            }
        }
        is_inside.then_some(aside)
    }
}

/// Returns the corners of the convex hull of points in a plane.
///
/// Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
fn hull(mut places: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    places.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    places.dedup();
    let mut corners: Vec<[f64; 2]> = Vec::new();
    // One side of the hull, then back along the other.
    let there_and_back = [places.clone(), places.into_iter().rev().collect()];
    for way in there_and_back {
        let begun = corners.len();
        for place in way {
            while let [.., a, b] = corners[begun..]
                && (b[0] - a[0]) * (place[1] - a[1]) <= (b[1] - a[1]) * (place[0] - a[0])
            {
                corners.pop();
            }
            corners.push(place);
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_has_the_corners_and_nothing_within() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let within = (1..99).map(|n| {
            let n = f64::from(n);
            [0.5 + 0.3 * libm::cos(n), 0.5 + 0.4 * libm::sin(3.0 * n)]
        });
        let edges = [[0.5, 0.0], [1.0, 0.25]];
        let mut corners = hull(square.into_iter().chain(within).chain(edges).collect());
        corners.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
        corners.dedup();
        assert_eq!(corners, [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]);
        assert_eq!(hull(Vec::new()), Vec::<[f64; 2]>::new());
        let once = hull(vec![[1.0, 2.0]; 3]);
        assert!(once.iter().all(|corner| *corner == [1.0, 2.0]) && !once.is_empty());
    }

    #[test]
    fn a_few_places_decide_as_all_do() {
        let place = |n: i32| {
            let n = f64::from(n);
            let [x, y, z] = [1.0, 2.0, 3.0].map(|k: f64| libm::sin(k * n) * libm::cos(n * n));
            Vector3::new(2.0 * x, y, z)
        };
        let places: Vec<Vector3<f64>> = (0..2000).map(place).collect();
        let outermost = Outermost::of(places.iter().copied());
        assert!(outermost.hulls.iter().all(|hull| hull.len() < 100));
        for (aside, distance) in [(0.0, 2.0), (0.7, 1.3), (-2.0, 9.0)] {
            for axis in 0..2 {
                let at = |p: &Vector3<f64>| FOCAL * (p[axis] - aside) / (p.z + distance) + 0.5;
                let low = places.iter().map(at).fold(f64::INFINITY, f64::min);
                let high = places.iter().map(at).fold(f64::NEG_INFINITY, f64::max);
                let reach = outermost.reach(axis, aside, distance, 1e-3);
                assert_eq!(reach, Some([low, high]));
            }
        }
        assert_eq!(outermost.reach(0, 0.0, 0.5, 1e-3), None, "one is behind");
    }
}
