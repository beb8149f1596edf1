//! Two-view triangulation by the direct linear transform.

use super::null_point::{LANES, Row, dot, null_point, null_points};
use super::{BEYOND_NUMBERS, NO_BASELINE};
use crate::math::scaling::power_of_two;
use crate::{Error, Result};
use nalgebra::{Matrix3x4, Point2, Point3};

/// Triangulates a point from two pixels, minimizing the algebraic error `Σ ‖x × P X‖²` over
/// homogeneous X of length 1.
///
/// With noise, the minimum depends on the world's origin and unit of length. An origin near the
/// cameras and a unit similar to the baseline are best.
///
/// * `p1`, `p2`: 3×4 projection matrices, such as
///   [`PosedCamera::projection_matrix`](crate::camera::PosedCamera::projection_matrix)
/// * `pixel1`, `pixel2`: projections of the point
///
/// # Errors
/// [`Error::PointAtInfinity`] for parallel rays, or rays that meet 10¹² baselines away or farther,
/// [`Error::PointBehindCamera`] if the point is not in front of both cameras, [`Error::NotFinite`]
/// for NaN and infinities, [`Error::Degenerate`] if the cameras are at the same place, or a matrix
/// has a rank below 3.
///
/// Source: Hartley & Zisserman 2004, §12.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::triangulation::triangulate_dlt;
/// use nalgebra::{Matrix3x4, Point2, Point3};
/// let p1 = Matrix3x4::identity();
/// let mut p2 = p1;
/// p2[(0, 3)] = -1.0; // one unit to the right
/// let point = triangulate_dlt(&p1, &p2, &Point2::new(0.25, 0.5), &Point2::new(0.0, 0.5))?;
/// assert!((point - Point3::new(1.0, 2.0, 4.0)).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn triangulate_dlt(
    p1: &Matrix3x4<f64>,
    p2: &Matrix3x4<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> Result<Point3<f64>> {
    let (r1, r2) = (rows_of(p1), rows_of(p2));
    let baseline = baseline(&r1, &r2)?;
    let pixels = [pixel1.x, pixel1.y, pixel2.x, pixel2.y];
    accept(&r1, &r2, baseline, &null_point(&r1, &r2, pixels))
}

/// Runs [`triangulate_dlt`] on many matches of one pair of cameras.
///
/// # Errors
/// Each element has its own error; [`Error::SizeMismatch`] if the lists differ in length,
/// [`Error::Degenerate`] and [`Error::NotFinite`] for invalid matrices.
///
/// Source: as [`triangulate_dlt`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::triangulation::triangulate_dlt_all;
/// use nalgebra::{Matrix3x4, Point2, Point3};
/// let p1 = Matrix3x4::identity();
/// let mut p2 = p1;
/// p2[(0, 3)] = -1.0; // one unit to the right
/// let pixels1 = [Point2::new(0.25, 0.5), Point2::new(0.25, 0.5)];
/// // The second match moved the wrong way: its rays meet behind the cameras.
/// let pixels2 = [Point2::new(0.0, 0.5), Point2::new(0.5, 0.5)];
/// let points = triangulate_dlt_all(&p1, &p2, &pixels1, &pixels2)?;
/// assert!((points[0].clone()? - Point3::new(1.0, 2.0, 4.0)).norm() < 1e-12);
/// assert_eq!(points[1], Err(epipole::Error::PointBehindCamera));
/// # Ok(()) }
/// ```
pub fn triangulate_dlt_all(
    p1: &Matrix3x4<f64>,
    p2: &Matrix3x4<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Vec<Result<Point3<f64>>>> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    let (r1, r2) = (rows_of(p1), rows_of(p2));
    let baseline = baseline(&r1, &r2)?;
    let mut points = Vec::with_capacity(pixels1.len());
    for (a, b) in pixels1.chunks(LANES).zip(pixels2.chunks(LANES)) {
        // In an incomplete last block, the lanes beyond its end are unused.
        let mut pixels = [[0.0; LANES]; 4];
        for (l, (a, b)) in a.iter().zip(b).enumerate() {
            [pixels[0][l], pixels[1][l], pixels[2][l], pixels[3][l]] = [a.x, a.y, b.x, b.y];
        }
        let x = null_points(&r1, &r2, &pixels);
        let of_lane = |l: usize| [x[0][l], x[1][l], x[2][l], x[3][l]];
        points.extend((0..a.len()).map(|l| accept(&r1, &r2, baseline, &of_lane(l))));
    }
    Ok(points)
}

/// Returns the distance between the camera centers, the null vectors of the matrices; an error if
/// they coincide. 1 if a center is at infinity, since then no entry of the matrices is a length.
fn baseline(p1: &[Row; 3], p2: &[Row; 3]) -> Result<f64> {
    if !p1.iter().chain(p2).flatten().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a pixel or a projection matrix",
        });
    }
    // Neither the scale of a row nor the unit of length in the world matters.
    let size = |row: &Row| {
        let direction = row[0].abs().max(row[1].abs()).max(row[2].abs());
        // The last row of an affine camera has no direction.
        power_of_two(if direction > 0.0 { direction } else { row[3] })
    };
    let scaled = |p: &[Row; 3]| p.map(|row| row.map(|x| x / size(&row)));
    let (mut p1, mut p2) = (scaled(p1), scaled(p2));
    let last_column = p1.iter().chain(&p2).map(|row| row[3].abs());
    let unit = power_of_two(last_column.fold(0.0, f64::max));
    for row in p1.iter_mut().chain(&mut p2) {
        row[3] /= unit;
    }
    for p in [&p1, &p2] {
        let center = null_vector(p);
        if center == [0.0; 4] {
            return Err(Error::Degenerate {
                what: "the distance of a point",
                why: "a projection matrix has a rank below 3",
            });
        }
    }
    let center1 = null_vector(&p1);
    let same = p2.iter().all(|row| {
        let rounding = dot(&row.map(f64::abs), &center1.map(f64::abs));
        dot(row, &center1).abs() <= 1e-13 * rounding
    });
    if same {
        return Err(NO_BASELINE);
    }
    let center2 = null_vector(&p2);
    let mut apart_sq = 0.0;
    for i in 0..3 {
        let apart = center1[i] / center1[3] - center2[i] / center2[3];
        apart_sq += apart * apart;
    }
    let apart = apart_sq.sqrt() * unit;
    Ok(if apart.is_normal() { apart } else { 1.0 })
}

/// Returns the vector orthogonal to three rows, by minors; zero if they are dependent.
fn null_vector(p: &[Row; 3]) -> Row {
    let minor = |i: usize, j: usize, k: usize| {
        p[0][i] * (p[1][j] * p[2][k] - p[1][k] * p[2][j])
            - p[0][j] * (p[1][i] * p[2][k] - p[1][k] * p[2][i])
            + p[0][k] * (p[1][i] * p[2][j] - p[1][j] * p[2][i])
    };
    [
        minor(1, 2, 3),
        -minor(0, 2, 3),
        minor(0, 1, 3),
        -minor(0, 1, 2),
    ]
}

fn rows_of(p: &Matrix3x4<f64>) -> [Row; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| p[(i, j)]))
}

#[inline(always)]
fn accept(p1: &[Row; 3], p2: &[Row; 3], baseline: f64, x: &Row) -> Result<Point3<f64>> {
    let (z1, z2) = (dot(&p1[2], x), dot(&p2[2], x));
    let in_space = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    if !(z1.is_finite() && z2.is_finite()) {
        return Err(Error::NotFinite {
            what: "a pixel or a projection matrix",
        });
    }
    // At least 10¹² baselines away.
    if x[3].abs() * baseline <= 1e-12 * in_space {
        return Err(Error::PointAtInfinity);
    }
    // Depths have the sign of z w, for projection matrices K [R t]. At the center of a camera the
    // depth is only rounding error.
    let in_front = |p: &[Row; 3], z: f64| {
        let rounding = 1e-13 * dot(&p[2].map(f64::abs), &x.map(f64::abs));
        z * x[3].signum() > rounding
    };
    if !(in_front(p1, z1) && in_front(p2, z2)) {
        return Err(Error::PointBehindCamera);
    }
    let per_w = 1.0 / x[3];
    let point = Point3::new(x[0] * per_w, x[1] * per_w, x[2] * per_w);
    if point.iter().all(|x| x.is_finite()) {
        Ok(point)
    } else {
        Err(BEYOND_NUMBERS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at};
    use crate::math::null_space::right_singular_vectors;
    use crate::math::random::Random;
    use nalgebra::{Quaternion, UnitQuaternion, Vector3};

    fn projection(m: &RigidTransform) -> Matrix3x4<f64> {
        m.to_matrix().fixed_view::<3, 4>(0, 0).into_owned()
    }

    /// COLMAP's src/colmap/geometry/triangulation_test.cc: published points, within 1e-10.
    #[test]
    fn published_points() {
        let points = [
            (0.0, 0.1, 0.1),
            (0.0, 1.0, 3.0),
            (0.0, 1.0, 2.0),
            (0.01, 0.2, 3.0),
            (-1.0, 0.1, 1.0),
            (0.1, 0.1, 0.2),
        ];
        let p1 = projection(&RigidTransform::identity());
        let (mut in_front, mut behind) = (0, 0);
        for z in 0..5 {
            for tx in (0..10).step_by(2) {
                // The test's quaternion is not of unit length; only its direction matters here.
                let rotation = UnitQuaternion::from_quaternion(Quaternion::new(
                    0.2,
                    0.3,
                    0.4,
                    f64::from(z) / 5.0,
                ));
                let t = Vector3::new(f64::from(tx), 2.0, 3.0);
                let cam2 = RigidTransform::from_parts(t.into(), rotation);
                let p2 = projection(&cam2);
                for (x, y, z) in points {
                    let point = Point3::new(x, y, z);
                    let in_cam2 = cam2 * point;
                    let pixel1 = Point2::new(x / z, y / z);
                    let pixel2 = Point2::new(in_cam2.x / in_cam2.z, in_cam2.y / in_cam2.z);
                    let found = triangulate_dlt(&p1, &p2, &pixel1, &pixel2);
                    if in_cam2.z > 0.0 {
                        assert!((found.unwrap() - point).norm() < 1e-10);
                        in_front += 1;
                    } else {
                        assert_eq!(found, Err(Error::PointBehindCamera));
                        behind += 1;
                    }
                }
            }
        }
        assert!(in_front > 100 && in_front + behind == 150);
    }

    #[test]
    fn published_parallel_rays() {
        let p1 = projection(&RigidTransform::identity());
        let p2 = projection(&RigidTransform::translation(1.0, 0.0, 0.0));
        let o = Point2::origin();
        assert_eq!(
            triangulate_dlt(&p1, &p2, &o, &o),
            Err(Error::PointAtInfinity)
        );
    }

    /// Agrees with the singular value decomposition, also with noise.
    #[test]
    fn agrees_with_the_singular_vector() {
        let mut random = Random::new(1);
        for _ in 0..500 {
            let up = Vector3::new(0.0, -1.0, 0.1);
            let mut near = || random.uniform(-1.0, 1.0);
            let camera = |center: Point3<f64>| {
                projection(&look_at(&center, &Point3::new(0.0, 0.0, 5.0), &up).unwrap())
            };
            let (p1, p2) = (
                camera(Point3::new(near(), near(), near())),
                camera(Point3::new(near(), near(), near())),
            );
            let x = nalgebra::Vector4::new(near(), near(), near() + 5.0, 1.0);
            let (a, b) = (p1 * x, p2 * x);
            let noisy = |v: Vector3<f64>, n: f64, m: f64| {
                Point2::new(v.x / v.z + 1e-3 * n, v.y / v.z + 1e-3 * m)
            };
            let (q1, q2) = (noisy(a, near(), near()), noisy(b, near(), near()));
            let (r1, r2) = (rows_of(&p1), rows_of(&p2));
            let found = null_point(&r1, &r2, [q1.x, q1.y, q2.x, q2.y]);
            let rows = [
                (&r1, q1.x, 0),
                (&r1, q1.y, 1),
                (&r2, q2.x, 0),
                (&r2, q2.y, 1),
            ];
            let (_, vectors) = right_singular_vectors(4, |i| {
                let (p, value, axis) = rows[i];
                core::array::from_fn(|j| value * p[2][j] - p[axis][j])
            });
            assert!(dot(&found, &vectors[3]).abs() > 1.0 - 1e-12);
        }
    }

    /// Compares blocks of eight, the last incomplete, with single matches; also next to pixels
    /// without a point or not finite.
    #[test]
    fn many_give_the_bits_of_one() {
        let mut random = Random::new(3);
        let p1 = projection(&RigidTransform::identity());
        let p2 = projection(&RigidTransform::translation(-1.0, 0.2, 0.1));
        let extreme = [f64::NAN, f64::INFINITY, 1e308, 1e-300, 0.0, -0.0];
        let mut pixel = |k: usize| match extreme.get(k % 40) {
            Some(&value) => Point2::new(value, random.uniform(-1.0, 1.0)),
            None => Point2::new(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)),
        };
        let pixels1: Vec<_> = (0..501).map(&mut pixel).collect();
        let pixels2: Vec<_> = (3..504).map(&mut pixel).collect();
        let all = triangulate_dlt_all(&p1, &p2, &pixels1, &pixels2).unwrap();
        let bits = |p: &Result<Point3<f64>>| p.as_ref().map(|p| p.coords.map(f64::to_bits)).ok();
        for (k, found) in all.iter().enumerate() {
            let one = triangulate_dlt(&p1, &p2, &pixels1[k], &pixels2[k]);
            assert_eq!(bits(found), bits(&one), "{k}");
            assert_eq!(found.as_ref().err(), one.as_ref().err(), "{k}");
        }
        assert!(all.iter().filter(|found| found.is_ok()).count() > 50);
    }

    #[test]
    fn bad_input_is_refused() {
        let p1 = projection(&RigidTransform::identity());
        let p2 = projection(&RigidTransform::translation(-1.0, 0.0, 0.0));
        let (o, nan) = (Point2::origin(), Point2::new(f64::NAN, 0.0));
        assert!(triangulate_dlt(&p1, &p2, &o, &nan).is_err());
        assert!(triangulate_dlt(&p1, &(p2 * f64::INFINITY), &o, &o).is_err());
        assert!(triangulate_dlt(&Matrix3x4::zeros(), &Matrix3x4::zeros(), &o, &o).is_err());
        let flat = Matrix3x4::from_fn(|i, j| if i == 2 { 0.0 } else { p1[(i, j)] });
        assert!(triangulate_dlt(&p1, &flat, &o, &o).is_err());
        assert!(triangulate_dlt_all(&p1, &p2, &[o], &[]).is_err());
    }

    /// The whole ray fits if the pixels agree, and nothing otherwise.
    #[test]
    fn cameras_at_the_same_place_are_refused() {
        let mut random = Random::new(5);
        let (o, other) = (Point2::new(320.0, 240.0), Point2::new(300.0, 240.0));
        for far in [0.0, 1.0, 1e7] {
            for _ in 0..100 {
                let mut near = |size: f64| random.uniform(-size, size);
                let center = Point3::new(far + near(1.0), near(1.0) - 2.0 * far, near(1.0));
                let mut camera = |center: &Point3<f64>| {
                    let k = Intrinsics::new(700.0 + near(50.0), 700.0, 320.0, 240.0).unwrap();
                    let up = Vector3::new(0.3, -1.0, 0.0);
                    let target = center + Vector3::new(near(1.0), near(1.0), 5.0);
                    PosedCamera {
                        camera: Camera::pinhole(k, 640, 480),
                        cam_from_world: look_at(center, &target, &up).unwrap(),
                    }
                };
                let cameras = [camera(&center), camera(&center)];
                let [p1, p2] = cameras.map(|c| c.projection_matrix());
                for pixel2 in [o, other] {
                    // Rotated and computed, so that the centers are equal only up to rounding.
                    assert_eq!(triangulate_dlt(&p1, &p2, &o, &pixel2), Err(NO_BASELINE));
                    assert_eq!(triangulate_dlt(&p1, &p1, &o, &pixel2), Err(NO_BASELINE));
                    let scaled = p2 * -1e-3;
                    assert_eq!(triangulate_dlt(&p1, &scaled, &o, &pixel2), Err(NO_BASELINE));
                }
                assert_eq!(triangulate_dlt_all(&p1, &p2, &[o], &[o]), Err(NO_BASELINE));
                // A small step suffices, even far from the origin.
                let moved = camera(&(center + Vector3::new(1e-3, 0.0, 0.0)));
                let found = triangulate_dlt(&p1, &moved.projection_matrix(), &o, &o);
                assert_ne!(found, Err(NO_BASELINE));
            }
        }
    }
}
