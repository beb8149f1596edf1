//! Point where epipolar lines intersect, exactly or nearly.

use crate::kit::matches::line2;
use epipole::math::Line2;
use nalgebra::{Matrix2, Matrix3, Point2, Vector2};

/// Mean distance below which the lines intersect in a point, pixels.
const MEETS_PX: f64 = 1e-6;

/// The least-squares intersection of many lines.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    pub(crate) place: Point2<f64>,
    /// Mean distance of the lines from it, pixels.
    pub(crate) miss_px: f64,
}

impl Meeting {
    /// Intersects the epipolar lines of these pixels; `None` if they are nearly parallel.
    pub(crate) fn of(fundamental: &Matrix3<f64>, pixels1: &[Point2<f64>]) -> Option<Self> {
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
        Some(Self {
            place,
            miss_px: lines.iter().map(distance).sum::<f64>() / lines.len() as f64,
        })
    }

    /// Returns whether the lines intersect in a point, up to rounding.
    pub(crate) fn is_exact(&self) -> bool {
        self.miss_px < MEETS_PX
    }

    /// Returns the mean distance of the lines from their intersection, pixels; 0 up to rounding.
    pub(crate) fn shown_px(self) -> f64 {
        if self.is_exact() { 0.0 } else { self.miss_px }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_lines_meet_nowhere() {
        // For a sideways translation the lines are rows.
        let fundamental = Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
        let pixels = [(10.0, 20.0), (300.0, 50.0), (90.0, 400.0)];
        let pixels = pixels.map(|(u, v)| Point2::new(u, v));
        assert!(Meeting::of(&fundamental, &pixels).is_none());
    }
}
