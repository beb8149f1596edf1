//! Overlap areas of a pixel's footprint with rectangles and disks.

use arrayvec::ArrayVec;
use nalgebra::Point2;

/// The convex quadrilateral of a plane seen by a pixel.
pub(super) struct Footprint {
    corners: [Point2<f64>; 4],
}

impl Footprint {
    /// * `corners`: in order along the outline, in either orientation
    pub(super) fn new(corners: [Point2<f64>; 4]) -> Self {
        Self { corners }
    }

    /// Returns the minimum and maximum coordinates.
    pub(super) fn bounds(&self) -> [Point2<f64>; 2] {
        let first = self.corners[0];
        self.corners
            .iter()
            .fold([first; 2], |[low, high], p| [low.inf(p), high.sup(p)])
    }

    pub(super) fn area(&self) -> f64 {
        area(&self.corners)
    }

    /// Returns the area within the rectangle from `low` to `high`.
    ///
    /// Source: Sutherland and Hodgman 1974, "Reentrant polygon clipping".
    pub(super) fn area_in_rectangle(&self, low: Point2<f64>, high: Point2<f64>) -> f64 {
        // Each of four cuts adds at most one corner.
        let mut polygon: ArrayVec<Point2<f64>, 8> = self.corners.into_iter().collect();
        for axis in 0..2 {
            for (limit, sign) in [(low[axis], 1.0), (high[axis], -1.0)] {
                polygon = cut(&polygon, |p| sign * (p[axis] - limit));
            }
        }
        area(&polygon)
    }

    /// Returns the area within a disk.
    pub(super) fn area_in_disk(&self, center: Point2<f64>, radius: f64) -> f64 {
        let corners = self.corners.map(|p| (p - center) / radius);
        let sum: f64 = (0..4)
            .map(|i| sector(corners[i].into(), corners[(i + 1) % 4].into()))
            .sum();
        sum.abs() * radius * radius
    }
}

/// Returns the part of a convex polygon where the linear function `height` is not negative.
fn cut(polygon: &[Point2<f64>], height: impl Fn(&Point2<f64>) -> f64) -> ArrayVec<Point2<f64>, 8> {
    let mut clipped = ArrayVec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (a, b) = (height(p), height(q));
        if a >= 0.0 {
            clipped.push(*p);
        }
        if (a >= 0.0) != (b >= 0.0) {
            clipped.push(p + (q - p) * (a / (a - b)));
        }
    }
    clipped
}

/// Returns the area of a polygon.
fn area(polygon: &[Point2<f64>]) -> f64 {
    let Some(first) = polygon.first() else {
        return 0.0;
    };
    let twice: f64 = polygon
        .windows(2)
        .map(|pair| (pair[0] - first).perp(&(pair[1] - first)))
        .sum();
    twice.abs() / 2.0
}

/// Returns the signed overlap area of the triangle of the origin, `p` and `q` with the unit disk.
fn sector(p: Point2<f64>, q: Point2<f64>) -> f64 {
    let pie = |a: &Point2<f64>, b: &Point2<f64>| {
        libm::atan2(a.coords.perp(&b.coords), a.coords.dot(&b.coords)) / 2.0
    };
    // Part of the edge within the disk: |p + t (q − p)|² ≤ 1.
    let along = q - p;
    let (a, b, c) = (
        along.norm_squared(),
        p.coords.dot(&along),
        p.coords.norm_squared() - 1.0,
    );
    let discriminant = b * b - a * c;
    if a == 0.0 || discriminant <= 0.0 {
        return pie(&p, &q);
    }
    let root = discriminant.sqrt();
    let (enter, leave) = (((-b - root) / a).max(0.0), ((-b + root) / a).min(1.0));
    if enter >= leave {
        return pie(&p, &q);
    }
    let (first, last) = (p + along * enter, p + along * leave);
    pie(&p, &first) + first.coords.perp(&last.coords) / 2.0 + pie(&last, &q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    fn footprint(corners: [[f64; 2]; 4]) -> Footprint {
        Footprint::new(corners.map(Point2::from))
    }

    /// Fraction of a fine grid of points in the footprint and in `region`.
    fn counted(of: &Footprint, region: impl Fn(&Point2<f64>) -> bool) -> f64 {
        const SIDE: usize = 1000;
        let [low, high] = of.bounds();
        let size = high - low;
        let inside = |p: &Point2<f64>| {
            let side = |i: usize| {
                let (a, b) = (of.corners[i], of.corners[(i + 1) % 4]);
                (b - a).perp(&(p - a))
            };
            (0..4).all(|i| side(i) >= 0.0) || (0..4).all(|i| side(i) <= 0.0)
        };
        let count = (0..SIDE * SIDE)
            .map(|k| [k % SIDE, k / SIDE].map(|i| (i as f64 + 0.5) / SIDE as f64))
            .map(|[x, y]| low + nalgebra::Vector2::new(x * size.x, y * size.y))
            .filter(|p| inside(p) && region(p))
            .count();
        count as f64 / (SIDE * SIDE) as f64 * size.x * size.y
    }

    #[test]
    fn areas_are_those_of_counted_points() {
        for corners in [
            [[0.1, 0.2], [1.3, -0.1], [1.1, 1.2], [-0.2, 0.9]],
            [[0.1, 0.2], [-0.2, 0.9], [1.1, 1.2], [1.3, -0.1]],
            [[-3.0, -3.0], [3.0, -3.1], [3.2, 3.0], [-3.0, 3.0]],
        ] {
            let footprint_of_square = footprint(corners);
            let whole = counted(&footprint_of_square, |_| true);
            assert!((footprint_of_square.area() - whole).abs() < 2e-3 * whole);
            for (x, y) in [(0.0, 0.0), (0.5, 0.5), (1.0, 0.2), (1.4, 0.9), (5.0, 5.0)] {
                let (low, high) = (Point2::new(x - 0.6, y - 0.3), Point2::new(x + 0.2, y + 0.4));
                let exact = counted(&footprint_of_square, |p| {
                    (low.x..high.x).contains(&p.x) && (low.y..high.y).contains(&p.y)
                });
                assert!(
                    (footprint_of_square.area_in_rectangle(low, high) - exact).abs() < 2e-3 * whole
                );
                let center = Point2::new(x, y);
                let exact = counted(&footprint_of_square, |p| (p - center).norm() < 0.55);
                assert!(
                    (footprint_of_square.area_in_disk(center, 0.55) - exact).abs() < 2e-3 * whole
                );
            }
        }
    }

    #[test]
    fn all_of_a_disk_or_none_of_it() {
        let footprint_of_square = footprint([[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
        let whole = footprint_of_square.area_in_disk(Point2::new(0.3, -0.4), 1.5);
        assert!((whole - PI * 2.25).abs() < 1e-12);
        assert!(
            footprint_of_square
                .area_in_disk(Point2::new(4.0, 4.0), 1.5)
                .abs()
                < 1e-12
        );
        // A disk that contains the footprint.
        assert!((footprint_of_square.area_in_disk(Point2::origin(), 9.0) - 16.0).abs() < 1e-12);
        // Centered on an edge, and on a corner.
        let half = footprint_of_square.area_in_disk(Point2::new(2.0, 0.0), 1.0);
        assert!((half - PI / 2.0).abs() < 1e-12);
        let quarter = footprint_of_square.area_in_disk(Point2::new(2.0, 2.0), 1.0);
        assert!((quarter - PI / 4.0).abs() < 1e-12);
    }
}
