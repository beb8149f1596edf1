//! H from four matches.

use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Point2, Vector3};

/// Solves for the homography that maps four points to four points, unit Frobenius norm.
///
/// Three points and a suitably scaled fourth are a basis of the projective plane: with
/// `A = [λ1 x1, λ2 x2, λ3 x3]`, `A (1, 1, 1) = x4`, and B likewise for image 2, `H = B A⁻¹`.
///
/// * `pixels1`, `pixels2`: matching pixels
///
/// Returns a list, as every minimal solver does: with one element, or none if three of the points
/// of an image are collinear, or for NaN.
///
/// Source: Heckbert 1989, "Fundamentals of texture mapping and image warping", §2.2.3; Semple &
/// Kneebone 1952.
///
/// ```
/// use epipole::homography::{homography_4point, transfer};
/// use nalgebra::Point2;
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Point2::new(u, v));
/// let kite = [(0.0, 0.0), (2.0, 0.0), (3.0, 3.0), (0.0, 2.0)].map(|(u, v)| Point2::new(u, v));
/// let solutions = homography_4point(&square, &kite);
/// assert_eq!(solutions.len(), 1); // no three points in line
/// let h = solutions[0];
/// let corner = transfer(&h, &Point2::new(1.0, 1.0)).expect("a finite point");
/// assert!((corner - Point2::new(3.0, 3.0)).norm() < 1e-12);
/// ```
pub fn homography_4point(
    pixels1: &[Point2<f64>; 4],
    pixels2: &[Point2<f64>; 4],
) -> ArrayVec<Matrix3<f64>, 1> {
    about_middles(pixels1, pixels2).into_iter().collect()
}

fn about_middles(pixels1: &[Point2<f64>; 4], pixels2: &[Point2<f64>; 4]) -> Option<Matrix3<f64>> {
    // Move the origin to the middle, so that the cross products do not cancel.
    let center =
        |p: &[Point2<f64>; 4]| (p[0].coords + p[1].coords + p[2].coords + p[3].coords) * 0.25;
    let (c1, c2) = (center(pixels1), center(pixels2));
    let h = solve(
        &pixels1.map(|p| [p.x - c1.x, p.y - c1.y]),
        &pixels2.map(|p| [p.x - c2.x, p.y - c2.y]),
    )?;
    // T2⁻¹ H T1.
    let moved = Matrix3::new(1.0, 0.0, c2.x, 0.0, 1.0, c2.y, 0.0, 0.0, 1.0)
        * h
        * Matrix3::new(1.0, 0.0, -c1.x, 0.0, 1.0, -c1.y, 0.0, 0.0, 1.0);
    let norm = moved.norm();
    (norm.is_finite() && norm > 0.0).then(|| moved / norm)
}

/// Returns twice the signed area of a triangle.
#[inline(always)]
fn area(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Solves for points near the origin; the result is not scaled.
#[inline]
pub(crate) fn solve(p1: &[[f64; 2]; 4], p2: &[[f64; 2]; 4]) -> Option<Matrix3<f64>> {
    let coefficients = |p: &[[f64; 2]; 4]| {
        let whole = area(&p[0], &p[1], &p[2]);
        let parts = [
            area(&p[3], &p[1], &p[2]),
            area(&p[0], &p[3], &p[2]),
            area(&p[0], &p[1], &p[3]),
        ];
        // Three collinear points: an area at the level of rounding relative to the largest squared
        // distance.
        let reach = p
            .iter()
            .fold(0.0_f64, |m, q| m.max(q[0].abs()).max(q[1].abs()));
        let smallest = parts.iter().fold(whole.abs(), |m, x| m.min(x.abs()));
        (smallest > 1e-12 * reach * reach).then_some(parts)
    };
    let (l1, l2) = (coefficients(p1)?, coefficients(p2)?);
    // Columns of B, and rows of A⁻¹ up to a common factor.
    let column = |p: &[f64; 2], factor: f64| Vector3::new(p[0] * factor, p[1] * factor, factor);
    let x1 = [0, 1, 2].map(|i: usize| Vector3::new(p1[i][0], p1[i][1], 1.0));
    let mut h = Matrix3::zeros();
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        h += column(&p2[i], l2[i] / l1[i]) * x1[j].cross(&x1[k]).transpose();
    }
    h.iter().all(|x| x.is_finite()).then_some(h)
}

/// Returns whether corresponding triangles have the same orientation, as in two images of the same
/// side of a plane.
#[inline]
pub(crate) fn same_orientation(p1: &[[f64; 2]; 4], p2: &[[f64; 2]; 4]) -> bool {
    [(0, 1, 2), (3, 1, 2), (0, 3, 2), (0, 1, 3)]
        .into_iter()
        .all(|(i, j, k)| {
            (area(&p1[i], &p1[j], &p1[k]) > 0.0) == (area(&p2[i], &p2[j], &p2[k]) > 0.0)
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homography::transfer;
    use crate::math::random::Random;

    /// Ten thousand problems as from PoseLib's generator: a plane seen by two cameras with a field
    /// of view of 75°.
    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let reach = libm::tan(37.5_f64.to_radians());
        let (mut found, mut total) = (0, 0);
        while total < 10_000 {
            let rotation = nalgebra::Rotation3::from_scaled_axis(Vector3::from_fn(|_, _| {
                random.uniform(-1.5, 1.5)
            }));
            let t = Vector3::from_fn(|_, _| random.normal()).normalize();
            let normal = Vector3::from_fn(|_, _| random.normal()).normalize();
            let distance = random.uniform(0.1, 10.0);
            let truth = rotation.into_inner() + t * normal.transpose() / distance;
            let (mut p1, mut p2) = ([Point2::origin(); 4], [Point2::origin(); 4]);
            let mut count = 0;
            for _ in 0..40 {
                let x1 = Vector3::new(
                    random.uniform(-reach, reach),
                    random.uniform(-reach, reach),
                    1.0,
                );
                let depth = distance / normal.dot(&x1);
                let x2 = truth * x1;
                if !(0.1..=10.0).contains(&depth) || x2.z <= 0.0 {
                    continue;
                }
                let projected = Point2::new(x2.x / x2.z, x2.y / x2.z);
                if count < 4 && projected.x.abs() < reach && projected.y.abs() < reach {
                    (p1[count], p2[count]) = (Point2::new(x1.x, x1.y), projected);
                    count += 1;
                }
            }
            if count < 4 {
                continue;
            }
            total += 1;
            let truth = truth / truth.norm();
            found += usize::from(
                homography_4point(&p1, &p2)
                    .first()
                    .is_some_and(|h| (h - truth).norm().min((h + truth).norm()) < 1e-6),
            );
        }
        println!("four points: {found} of {total}");
        assert!(found >= 9990, "{found}");
    }

    #[test]
    fn three_in_line_have_none() {
        let p = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (0.0, 5.0)].map(|(u, v)| Point2::new(u, v));
        let q = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Point2::new(u, v));
        let not_a_number = [Point2::new(f64::NAN, 0.0); 4];
        for (p1, p2) in [(p, q), (q, p), ([q[0]; 4], [q[1]; 4]), (not_a_number, q)] {
            assert!(homography_4point(&p1, &p2).is_empty());
        }
        let far = q.map(|p| Point2::new(p.x + 3000.0, p.y + 2000.0));
        let h = homography_4point(&far, &q)[0];
        assert!((transfer(&h, &far[2]).unwrap() - q[2]).norm() < 1e-9);
    }
}
