//! Geometry of measured figures: best-fitting planes, outlines in them, and volumes over them.

use epipole::math::svd3;
use nalgebra::{Matrix2, Matrix3, Point3, Vector2, Vector3};

/// Minimum ratio of the width of a set of points to its length: narrower ones determine no plane.
const LEAST_WIDTH: f64 = 0.01;

/// A plane with a frame in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    /// Origin of the frame.
    pub(crate) origin: Point3<f64>,
    /// Orthonormal axes; the third is the normal.
    pub(crate) axes: Matrix3<f64>,
}

impl Plane {
    /// Fits a plane to points by the sum of squared distances; `None` for points nearly on a line.
    pub(crate) fn fit(points: &[Point3<f64>]) -> Option<Self> {
        let count = points.len() as f64;
        let mean = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count;
        let around = points.iter().map(|p| p.coords - mean);
        let scatter = svd3(&around.map(|a| a * a.transpose()).sum());
        let values = scatter.singular_values;
        let is_plane = values[1] > LEAST_WIDTH * LEAST_WIDTH * values[0] && values[0].is_finite();
        if points.len() < 3 || !is_plane {
            return None;
        }
        let right = scatter.v.column(0).normalize();
        let normal = right.cross(&scatter.v.column(1)).normalize();
        Some(Self::from_axes(mean.into(), right, normal))
    }

    /// Returns the plane through a point with a unit normal.
    pub(crate) fn through(origin: Point3<f64>, normal: Vector3<f64>) -> Self {
        // The axis least along the normal.
        let least = normal.iamin();
        let mut axis = Vector3::zeros();
        axis[least] = 1.0;
        Self::from_axes(origin, normal.cross(&axis).normalize(), normal)
    }

    fn from_axes(origin: Point3<f64>, right: Vector3<f64>, normal: Vector3<f64>) -> Self {
        let axes = Matrix3::from_columns(&[right, normal.cross(&right), normal]);
        Self { origin, axes }
    }

    /// Returns the plane with its normal on the side of a point.
    pub(crate) fn facing(self, point: &Point3<f64>) -> Self {
        match self.local(point)[2] < 0.0 {
            true => Self::from_axes(self.origin, self.axes.column(0).into(), -self.normal()),
            false => self,
        }
    }

    /// Returns the unit normal.
    pub(crate) fn normal(&self) -> Vector3<f64> {
        self.axes.column(2).into()
    }

    /// Returns a point in the frame of the plane; the third coordinate is its height.
    pub(crate) fn local(&self, point: &Point3<f64>) -> [f64; 3] {
        self.axes.tr_mul(&(point - self.origin)).into()
    }

    /// Returns the points of an outline in the plane, without their heights.
    pub(crate) fn outline(&self, points: &[Point3<f64>]) -> Vec<[f64; 2]> {
        let flat = |point| {
            let [x, y, _] = self.local(point);
            [x, y]
        };
        points.iter().map(flat).collect()
    }

    /// Returns the largest distance of the points from the plane.
    pub(crate) fn deviation(&self, points: &[Point3<f64>]) -> f64 {
        let heights = points.iter().map(|point| self.local(point)[2].abs());
        heights.fold(0.0, f64::max)
    }
}

/// Returns the area of an outline; negative if it is clockwise.
pub(crate) fn signed_area(outline: &[[f64; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let twice: f64 = (outline.iter().zip(next))
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum();
    0.5 * twice
}

/// Whether no two sides of an outline cross.
pub(crate) fn is_simple(outline: &[[f64; 2]]) -> bool {
    let count = outline.len();
    let side = |i: usize| [outline[i], outline[(i + 1) % count]];
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let crosses = |[a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]| {
        turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
    };
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    pairs.into_iter().all(|(i, j)| !crosses(side(i), side(j)))
}

/// Returns the weights by which the height of a fitted plane at a place follows the heights of its
/// points: `1/n + (x − c)ᵀ M⁻¹ (pᵢ − c)`.
pub(crate) fn height_weights(points: &[[f64; 2]], at: [f64; 2]) -> Option<Vec<f64>> {
    let count = points.len() as f64;
    let center = points
        .iter()
        .map(|p| Vector2::from(*p))
        .sum::<Vector2<f64>>()
        / count;
    let around = || points.iter().map(|p| Vector2::from(*p) - center);
    let moments: Matrix2<f64> = around().map(|a| a * a.transpose()).sum();
    let slope = moments.try_inverse()? * (Vector2::from(at) - center);
    Some(around().map(|a| 1.0 / count + slope.dot(&a)).collect())
}

/// Volume between a surface and a plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Prisms {
    /// The volume: positive above the plane, negative below.
    pub(crate) volume: f64,
    /// Area of the outline that the surface covers; layers that face down count negative.
    pub(crate) covered: f64,
    /// First moments of the covered area.
    pub(crate) moments: [f64; 2],
}

/// Sums the prisms between a plane and triangles, clipped to an outline in the plane.
///
/// * `triangles`: corners in the frame of the plane, counterclockwise from outside
pub(crate) fn prisms(
    outline: &[[f64; 2]],
    triangles: impl IntoIterator<Item = [[f64; 3]; 3]>,
) -> Prisms {
    let mut outline = outline.to_vec();
    if signed_area(&outline) < 0.0 {
        outline.reverse();
    }
    let (low, high) = bounds(&outline);
    let mut sum = Prisms::default();
    let (mut clipped, mut spare) = (Vec::new(), Vec::new());
    for triangle in triangles {
        let misses = |axis: usize| {
            let values = triangle.map(|corner| corner[axis]);
            values.iter().all(|x| *x < low[axis]) || values.iter().all(|x| *x > high[axis])
        };
        if misses(0) || misses(1) {
            continue;
        }
        let flat = triangle.map(|[x, y, _]| [x, y]);
        let twice = 2.0 * signed_area(&flat);
        // NaN and triangles that stand upright cover nothing.
        if twice == 0.0 || twice.is_nan() {
            continue;
        }
        let [a, b, c] = match twice > 0.0 {
            true => flat,
            false => [flat[0], flat[2], flat[1]],
        };
        clipped.clear();
        clipped.extend(outline.iter().map(|p| [p[0] - a[0], p[1] - a[1]]));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let shifted = |p: [f64; 2]| [p[0] - a[0], p[1] - a[1]];
            clip(&clipped, shifted(from), shifted(to), &mut spare);
            std::mem::swap(&mut clipped, &mut spare);
        }
        let (area, moments) = area_and_moments(&clipped);
        let sign = twice.signum();
        sum.volume += sign * integral(&triangle, area, moments);
        sum.covered += sign * area;
        for axis in 0..2 {
            sum.moments[axis] += sign * (moments[axis] + area * a[axis]);
        }
    }
    sum
}

/// Returns the bounding box of an outline.
pub(crate) fn bounds(outline: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let along = |axis: usize| outline.iter().map(move |p| p[axis]);
    let low = [0, 1].map(|axis| along(axis).fold(f64::INFINITY, f64::min));
    let high = [0, 1].map(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max));
    (low, high)
}

/// Clips an outline to the left of a line. Parts of a concave one stay joined by sides that cancel.
fn clip(outline: &[[f64; 2]], from: [f64; 2], to: [f64; 2], clipped: &mut Vec<[f64; 2]>) {
    clipped.clear();
    let side =
        |p: [f64; 2]| (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
    let Some(last) = outline.last() else { return };
    let (mut before, mut side_before) = (*last, side(*last));
    for &point in outline {
        let side_now = side(point);
        if (side_now >= 0.0) != (side_before >= 0.0) {
            let t = side_before / (side_before - side_now);
            clipped.push([0, 1].map(|axis| before[axis] + t * (point[axis] - before[axis])));
        }
        if side_now >= 0.0 {
            clipped.push(point);
        }
        (before, side_before) = (point, side_now);
    }
}

fn area_and_moments(outline: &[[f64; 2]]) -> (f64, [f64; 2]) {
    let next = outline.iter().cycle().skip(1);
    let (mut twice, mut six) = (0.0, [0.0; 2]);
    for (a, b) in outline.iter().zip(next) {
        let cross = a[0] * b[1] - a[1] * b[0];
        twice += cross;
        for axis in 0..2 {
            six[axis] += cross * (a[axis] + b[axis]);
        }
    }
    (0.5 * twice, six.map(|x| x / 6.0))
}

/// Integral of a triangle's height over a part of it with this area and these moments about its
/// first corner.
fn integral(triangle: &[[f64; 3]; 3], area: f64, moments: [f64; 2]) -> f64 {
    if area == 0.0 {
        return 0.0;
    }
    let [a, b, c] = triangle;
    let rise = |corner: &[f64; 3]| [0, 1, 2].map(|axis| corner[axis] - a[axis]);
    let (b, c) = (rise(b), rise(c));
    let cross = b[0] * c[1] - b[1] * c[0];
    let slope = [
        (b[2] * c[1] - b[1] * c[2]) / cross,
        (b[0] * c[2] - b[2] * c[0]) / cross,
    ];
    let mean = a[2] + (slope[0] * moments[0] + slope[1] * moments[1]) / area;
    // In a nearly upright triangle, rounding would move the mean out of it.
    let heights = triangle.iter().map(|corner| corner[2]);
    let low = heights.clone().fold(f64::INFINITY, f64::min);
    let high = heights.fold(f64::NEG_INFINITY, f64::max);
    area * mean.max(low).min(high)
}

#[cfg(test)]
#[path = "plane_tests.rs"]
mod tests;
