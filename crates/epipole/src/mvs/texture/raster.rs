//! Pixels of a triangle.

use nalgebra::Point2;

/// Calls `f(u, v, weights)` for each pixel center in a triangle, with the barycentric weights of
/// its corners.
///
/// * `size`: width and height of the image, pixels
pub(super) fn for_each_pixel(
    corners: &[Point2<f64>; 3],
    (width, height): (u32, u32),
    mut f: impl FnMut(u32, u32, [f64; 3]),
) {
    let [a, b, c] = corners;
    let doubled = (b - a).perp(&(c - a));
    let spread = corners.iter().map(|corner| corner.coords.amax());
    if doubled == 0.0 || !doubled.is_finite() || spread.fold(0.0, f64::max) > 1e6 {
        return;
    }
    let range = |axis: usize, side: u32| {
        let values = corners.map(|corner| corner[axis]);
        let low = values.into_iter().fold(f64::INFINITY, f64::min).ceil();
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max).floor();
        (low.max(0.0) as i64)..(high.min(f64::from(side) - 1.0) as i64 + 1)
    };
    for v in range(1, height) {
        for u in range(0, width) {
            let pixel = Point2::new(u as f64, v as f64);
            let of_a = (c - b).perp(&(pixel - b)) / doubled;
            let of_b = (a - c).perp(&(pixel - c)) / doubled;
            let of_c = (b - a).perp(&(pixel - a)) / doubled;
            if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                f(u as u32, v as u32, [of_a, of_b, of_c]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(corners: [(f64, f64); 3]) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        let corners = corners.map(|(u, v)| Point2::new(u, v));
        for_each_pixel(&corners, (4, 3), |u, v, weights| {
            let total: f64 = weights.iter().sum();
            assert!((total - 1.0).abs() < 1e-12);
            let place: f64 = (0..3).map(|n| weights[n] * corners[n].x).sum();
            assert!((place - f64::from(u)).abs() < 1e-12);
            found.push((u, v));
        });
        found
    }

    #[test]
    fn pixels_in_a_triangle_are_found_once_and_clipped() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (0.0, 1.5)];
        let inside = [(0, 0), (1, 0), (2, 0), (0, 1)];
        assert_eq!(pixels(corners), inside);
        assert_eq!(pixels([corners[0], corners[2], corners[1]]), inside);
        assert_eq!(pixels([(-9.0, -9.0), (99.0, -9.0), (-9.0, 99.0)]).len(), 12);
        assert!(pixels([(-3.0, -3.0), (-1.0, -3.0), (-2.0, -0.5)]).is_empty());
        assert!(pixels([(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]).is_empty());
    }
}
