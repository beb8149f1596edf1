//! Fraction of the image covered by boards.

use super::BoardView;
use nalgebra::Point2;

/// Number of cells along the longer side.
const CELLS: u32 = 100;

/// Returns the fraction of the image's area inside the outline of the marks of at least one view.
pub(super) fn coverage(views: &[&BoardView], (width, height): (u32, u32)) -> f64 {
    let cell = f64::from(width.max(height)) / f64::from(CELLS);
    let cells = |side: u32| (f64::from(side) / cell).ceil().max(1.0) as u32;
    let (columns, rows) = (cells(width), cells(height));
    let outlines: Vec<Vec<Point2<f64>>> = views
        .iter()
        .map(|view| convex_hull(view.visible().map(|(_, pixel)| pixel).collect()))
        .collect();
    let mut covered = 0;
    for row in 0..rows {
        for column in 0..columns {
            let center = Point2::new(
                (f64::from(column) + 0.5) * cell - 0.5,
                (f64::from(row) + 0.5) * cell - 0.5,
            );
            covered += u32::from(outlines.iter().any(|hull| is_inside(hull, &center)));
        }
    }
    f64::from(covered) / f64::from(columns * rows)
}

fn cross(a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
fn convex_hull(mut points: Vec<Point2<f64>>) -> Vec<Point2<f64>> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Point2<f64>>| {
        let mut chain: Vec<Point2<f64>> = Vec::new();
        for p in points {
            while chain.len() >= 2
                && cross(&chain[chain.len() - 2], &chain[chain.len() - 1], &p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

fn is_inside(hull: &[Point2<f64>], point: &Point2<f64>) -> bool {
    let count = hull.len();
    count >= 3 && (0..count).all(|i| cross(&hull[i], &hull[(i + 1) % count], point) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_squares_that_overlap_cover_their_union() {
        let view = |u: f64, v: f64, side: f64| BoardView {
            pixels: [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.5)]
                .map(|(x, y)| Some(Point2::new(u + x * side, v + y * side)))
                .to_vec(),
        };
        let (a, b) = (view(0.3, 0.3, 50.0), view(25.3, 25.3, 50.0));
        let ratio = coverage(&[&a, &b], (100, 100));
        let truth = (2500.0 + 2500.0 - 625.0) / 10_000.0;
        assert!((ratio - truth).abs() < 0.01, "{ratio}");
        assert_eq!(coverage(&[], (640, 480)), 0.0);
        let hidden = BoardView {
            pixels: vec![None; 54],
        };
        assert_eq!(coverage(&[&hidden], (640, 480)), 0.0);
    }
}
