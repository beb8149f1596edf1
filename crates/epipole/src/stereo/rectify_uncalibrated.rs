//! Rectification without calibration: homographies from F and matches.

use super::PixelRect;
use crate::epipolar::{Epipole, epipoles};
use crate::{Error, Result};
use nalgebra::{Matrix2, Matrix3, Point2, Vector2, Vector3};

/// Homographies that put matches into the same row (or, if `is_vertical`, column).
#[derive(Debug, Clone, PartialEq)]
pub struct UncalibratedRectification {
    /// Homographies from pixels of each image to rectified pixels.
    pub homographies: [Matrix3<f64>; 2],
    /// Whether matches share a column instead of a row.
    pub is_vertical: bool,
    /// Minimum and maximum disparity of the matches, pixels: `u1 − u2`, or `v1 − v2` if vertical.
    /// Of either sign, since the depths are known only up to a projective map.
    pub disparity_range_px: (f64, f64),
    /// Bounding rectangle of each rectified image.
    pub outlines: [PixelRect; 2],
}

/// Rectifies a pair from its fundamental matrix and matches (Hartley's method).
///
/// The second image is rotated about its middle until its epipole is in the direction of the rows
/// (or of the columns, if closer), by at most 45°, and the epipole is sent to infinity. The first
/// image gets the matching homography, sheared to minimize `Σ (u1 − u2)²` over the matches.
///
/// * `fundamental`: `x2ᵀ F x1 = 0`
/// * `pixels1`, `pixels2`: matches, inliers of F, at least 3
/// * `width`, `height`: size of both images, pixels
///
/// # Errors
/// [`Error::Degenerate`] if an epipole lies in its image or so close that the warp would turn it
/// inside out, F has rank 1 or 0, or all matches lie on one line; [`Error::SizeMismatch`] for lists
/// of different length, [`Error::TooFew`] for fewer than 3 matches, [`Error::NotFinite`] for NaN or
/// infinities.
///
/// Source: Hartley 1999, "Theory and practice of projective rectification"; Hartley & Zisserman
/// 2004, §11.12.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::rectify_uncalibrated;
/// use nalgebra::{Matrix3, Point2};
/// // Already a rectified pair, but the second image is 5 pixels lower: v2 = v1 + 5.
/// let f = Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 5.0);
/// let pixels1 = [(30.0, 20.0), (60.0, 70.0), (90.0, 40.0)].map(|(u, v)| Point2::new(u, v));
/// let pixels2 = pixels1.map(|p| Point2::new(p.x - 8.0, p.y + 5.0));
/// let rectified = rectify_uncalibrated(&f, &pixels1, &pixels2, 128, 96)?;
/// let [h1, h2] = rectified.homographies;
/// let (x1, x2) = (h1 * pixels1[0].to_homogeneous(), h2 * pixels2[0].to_homogeneous());
/// assert!((x1.y / x1.z - x2.y / x2.z).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn rectify_uncalibrated(
    fundamental: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    width: u32,
    height: u32,
) -> Result<UncalibratedRectification> {
    check(pixels1, pixels2, width, height)?;
    let (_, epipole2) = epipoles(fundamental)?;
    let middle = Vector2::new(f64::from(width) - 1.0, f64::from(height) - 1.0) / 2.0;
    let towards = match epipole2 {
        Epipole::Finite(e) => e.coords - middle,
        Epipole::AtInfinity(direction) => direction,
    };
    if towards.y.abs() <= towards.x.abs() {
        return along_rows(fundamental, pixels1, pixels2, width, height);
    }
    // The same with u and v exchanged.
    let exchange = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let exchanged = |pixels: &[Point2<f64>]| -> Vec<_> {
        pixels.iter().map(|p| Point2::new(p.y, p.x)).collect()
    };
    let rows = along_rows(
        &(exchange * fundamental * exchange),
        &exchanged(pixels1),
        &exchanged(pixels2),
        height,
        width,
    )?;
    Ok(UncalibratedRectification {
        homographies: rows.homographies.map(|h| exchange * h * exchange),
        is_vertical: true,
        disparity_range_px: rows.disparity_range_px,
        outlines: rows.outlines.map(|r| PixelRect {
            u_min: r.v_min,
            v_min: r.u_min,
            u_max: r.v_max,
            v_max: r.u_max,
        }),
    })
}

fn check(pixels1: &[Point2<f64>], pixels2: &[Point2<f64>], width: u32, height: u32) -> Result<()> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    if pixels1.len() < 3 {
        return Err(Error::TooFew {
            what: "a rectification from matches",
            needed: 3,
            got: pixels1.len(),
        });
    }
    let finite = |p: &Point2<f64>| p.x.is_finite() && p.y.is_finite();
    if !pixels1.iter().chain(pixels2).all(finite) {
        return Err(Error::NotFinite {
            what: "every pixel of the matches",
        });
    }
    if width < 2 || height < 2 {
        return Err(Error::OutOfRange {
            what: "the shorter side of the images",
            requirement: "at least 2 pixels",
            value: f64::from(width.min(height)),
        });
    }
    Ok(())
}

/// Rectifies if the epipole is closer to the rows than to the columns.
fn along_rows(
    fundamental: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    width: u32,
    height: u32,
) -> Result<UncalibratedRectification> {
    let h2 = send_epipole_to_infinity(fundamental, width, height)?;
    let matching = matching_homography(fundamental, &h2)?;
    let h1 = shear(&matching, &h2, pixels1, pixels2)? * matching;
    let outlines = [outline(&h1, width, height)?, outline(&h2, width, height)?];
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for (p1, p2) in pixels1.iter().zip(pixels2) {
        let d = apply(&h1, p1)?.x - apply(&h2, p2)?.x;
        range = (range.0.min(d), range.1.max(d));
    }
    Ok(UncalibratedRectification {
        homographies: [h1, h2],
        is_vertical: false,
        disparity_range_px: range,
        outlines,
    })
}

/// Returns H2: near the middle of the image a rotation, to first order.
fn send_epipole_to_infinity(
    fundamental: &Matrix3<f64>,
    width: u32,
    height: u32,
) -> Result<Matrix3<f64>> {
    let middle = Vector2::new(f64::from(width) - 1.0, f64::from(height) - 1.0) / 2.0;
    let (_, epipole) = epipoles(fundamental)?;
    let (direction, inverse_distance) = match epipole {
        Epipole::Finite(e) => {
            let offset = e.coords - middle;
            if offset.norm() < 1.1 * middle.norm() {
                return Err(Error::Degenerate {
                    what: "a rectification",
                    why: "the epipole lies in the image",
                });
            }
            (offset.normalize(), 1.0 / offset.norm())
        }
        Epipole::AtInfinity(direction) => (direction, 0.0),
    };
    // To the right or left, whichever is closer: nothing is turned upside down.
    let side = if direction.x < 0.0 { -1.0 } else { 1.0 };
    let (cos, sin) = (side * direction.x, side * direction.y);
    let to_middle = Matrix3::new_translation(&-middle);
    let from_middle = Matrix3::new_translation(&middle);
    #[rustfmt::skip]
    let rotation = Matrix3::new(
        cos,  sin, 0.0,
        -sin, cos, 0.0,
        0.0,  0.0, 1.0,
    );
    // (e, 0, 1) maps to (e, 0, 0) for e = side × distance.
    #[rustfmt::skip]
    let stretch = Matrix3::new(
        1.0,                     0.0, 0.0,
        0.0,                     1.0, 0.0,
        -side * inverse_distance, 0.0, 1.0,
    );
    Ok(from_middle * stretch * rotation * to_middle)
}

/// Returns H2 M with M = [e2]ₓ F + e2 vᵀ: every match gets its row of the second image.
fn matching_homography(fundamental: &Matrix3<f64>, h2: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    let degenerate = Error::Degenerate {
        what: "a rectification",
        why: "no homography matches the epipolar lines",
    };
    // F = H2ᵀ [i]ₓ H1 up to scale, with i = (1, 0, 0): so H2⁻ᵀ F = [i]ₓ H1 gives rows 2 and 3 of
    // H1 directly; row 1 is free.
    let h2_inverse = h2.try_inverse().ok_or(degenerate.clone())?;
    let product = h2_inverse.transpose() * fundamental;
    let (row2, row3) = (product.row(2).transpose(), -product.row(1).transpose());
    let free = row2.cross(&row3);
    let scale = free.norm();
    if scale.is_nan() || scale <= 0.0 {
        return Err(degenerate);
    }
    // A first row perpendicular to the other two, as long as the second, avoids squeezing.
    let row1 = free * (row2.norm() / scale);
    Ok(Matrix3::from_rows(&[
        row1.transpose(),
        row2.transpose(),
        row3.transpose(),
    ]))
}

/// Returns the shear `u → a u + b v + c` that brings the first image's matches closest to the
/// second's.
fn shear(
    matching: &Matrix3<f64>,
    h2: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Matrix3<f64>> {
    let mut moved = Vec::with_capacity(pixels1.len());
    for (p1, p2) in pixels1.iter().zip(pixels2) {
        moved.push((apply(matching, p1)?, apply(h2, p2)?.x));
    }
    let count = moved.len() as f64;
    let mean = moved.iter().map(|(p, _)| p.coords).sum::<Vector2<f64>>() / count;
    let mean_target = moved.iter().map(|(_, u)| u).sum::<f64>() / count;
    let mut normal = Matrix2::zeros();
    let mut right_side = Vector2::zeros();
    for (p, u) in &moved {
        let p = p.coords - mean;
        normal += p * p.transpose();
        right_side += p * (u - mean_target);
    }
    let determinant = normal.determinant();
    let solution = (determinant > 1e-12 * normal.trace() * normal.trace())
        .then(|| normal.try_inverse())
        .flatten()
        .map(|inverse| inverse * right_side)
        // No scene mirrors an image.
        .filter(|s| s.x.abs() > 1e-9)
        .ok_or(Error::Degenerate {
            what: "a rectification",
            why: "all matches lie on one line",
        })?;
    #[rustfmt::skip]
    let shear = Matrix3::new(
        solution.x, solution.y, mean_target - solution.dot(&mean),
        0.0,        1.0,        0.0,
        0.0,        0.0,        1.0,
    );
    Ok(shear)
}

/// Returns the bounding rectangle of a warped image.
fn outline(h: &Matrix3<f64>, width: u32, height: u32) -> Result<PixelRect> {
    let (u, v) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
    let corners = [(0.0, 0.0), (u, 0.0), (0.0, v), (u, v)].map(|(u, v)| Point2::new(u, v));
    let depths = corners.map(|p| (h * p.to_homogeneous()).z);
    let one_side = depths.iter().all(|&w| w > 0.0) || depths.iter().all(|&w| w < 0.0);
    if !one_side {
        return Err(Error::Degenerate {
            what: "a rectification",
            why: "the epipole lies in the image",
        });
    }
    let mut rect = PixelRect {
        u_min: f64::INFINITY,
        v_min: f64::INFINITY,
        u_max: f64::NEG_INFINITY,
        v_max: f64::NEG_INFINITY,
    };
    for corner in corners {
        let p = apply(h, &corner)?;
        rect.u_min = rect.u_min.min(p.x);
        rect.u_max = rect.u_max.max(p.x);
        rect.v_min = rect.v_min.min(p.y);
        rect.v_max = rect.v_max.max(p.y);
    }
    Ok(rect)
}

fn apply(h: &Matrix3<f64>, p: &Point2<f64>) -> Result<Point2<f64>> {
    let x: Vector3<f64> = h * p.to_homogeneous();
    let out = Point2::new(x.x / x.z, x.y / x.z);
    if out.x.is_finite() && out.y.is_finite() {
        Ok(out)
    } else {
        Err(Error::Degenerate {
            what: "a rectification",
            why: "a match lies on the line that is sent to infinity",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, PosedCamera, look_at};
    use crate::epipolar::fundamental_from_cameras;
    use crate::math::random::Random;
    use nalgebra::Point3;

    /// A scene seen by two cameras; matches and F.
    fn scene(
        center2: [f64; 3],
        target2: [f64; 3],
    ) -> (Matrix3<f64>, Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let up = Vector3::new(0.05, -1.0, 0.1);
        let camera = |center: [f64; 3], target: [f64; 3]| PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(600.0, 640, 480).unwrap(), 640, 480),
            cam_from_world: look_at(&Point3::from(center), &Point3::from(target), &up).unwrap(),
        };
        let camera1 = camera([0.0; 3], [0.0, 0.0, 5.0]);
        let camera2 = camera(center2, target2);
        let mut random = Random::new(3);
        let (mut pixels1, mut pixels2) = (vec![], vec![]);
        while pixels1.len() < 60 {
            let x = Point3::new(
                random.uniform(-2.0, 2.0),
                random.uniform(-1.5, 1.5),
                random.uniform(3.0, 8.0),
            );
            let (p1, p2) = (camera1.project(&x).unwrap(), camera2.project(&x).unwrap());
            let inside = |p: &Point2<f64>| p.x >= 0.0 && p.y >= 0.0 && p.x <= 639.0 && p.y <= 479.0;
            if inside(&p1) && inside(&p2) {
                pixels1.push(p1);
                pixels2.push(p2);
            }
        }
        let f = fundamental_from_cameras(&camera1, &camera2).unwrap();
        (f, pixels1, pixels2)
    }

    #[test]
    fn matches_share_a_line_and_nothing_is_flipped() {
        for (center2, target2, vertical) in [
            ([0.5, 0.1, 0.1], [0.1, 0.0, 5.0], false),
            ([-0.5, 0.1, -0.1], [0.1, 0.2, 5.0], false),
            ([0.05, 0.6, 0.1], [0.1, 0.0, 5.0], true),
            ([0.05, -0.6, 0.0], [0.1, 0.0, 5.0], true),
        ] {
            let (f, pixels1, pixels2) = scene(center2, target2);
            for sign in [1.0, -7.0] {
                let rectified =
                    rectify_uncalibrated(&(f * sign), &pixels1, &pixels2, 640, 480).unwrap();
                assert_eq!(rectified.is_vertical, vertical);
                let [h1, h2] = rectified.homographies;
                let (low, high) = rectified.disparity_range_px;
                for (p1, p2) in pixels1.iter().zip(&pixels2) {
                    let d = apply(&h1, p1).unwrap() - apply(&h2, p2).unwrap();
                    let (along, across) = if vertical { (d.y, d.x) } else { (d.x, d.y) };
                    assert!(across.abs() < 1e-8, "off by {across}");
                    assert!(along >= low - 1e-9 && along <= high + 1e-9);
                }
                assert!(high - low < 200.0);
                for h in [h1, h2] {
                    // Right stays right, and down stays down.
                    let middle = Point2::new(319.5, 239.5);
                    let at = apply(&h, &middle).unwrap();
                    let right = apply(&h, &(middle + Vector2::x())).unwrap() - at;
                    let down = apply(&h, &(middle + Vector2::y())).unwrap() - at;
                    assert!(right.x > 0.5 && right.x < 2.0, "{right}");
                    assert!(down.y > 0.5 && down.y < 2.0, "{down}");
                }
            }
        }
    }

    #[test]
    fn hopeless_pairs_are_refused() {
        let (f, pixels1, pixels2) = scene([0.5, 0.1, 0.1], [0.1, 0.0, 5.0]);
        let rectify = |f: &Matrix3<f64>, a: &[_], b: &[_]| rectify_uncalibrated(f, a, b, 640, 480);
        assert!(matches!(
            rectify(&f, &pixels1[..2], &pixels2[..2]),
            Err(Error::TooFew { .. })
        ));
        assert!(matches!(
            rectify(&f, &pixels1, &pixels2[1..]),
            Err(Error::SizeMismatch { .. })
        ));
        assert!(rectify(&Matrix3::zeros(), &pixels1, &pixels2).is_err());
        assert!(rectify(&(f * f64::NAN), &pixels1, &pixels2).is_err());
        let mut broken = pixels1.clone();
        broken[7].x = f64::NAN;
        assert!(rectify(&f, &broken, &pixels2).is_err());
        let (one, other) = (vec![pixels1[0]; 9], vec![pixels2[0]; 9]);
        assert!(matches!(
            rectify(&f, &one, &other),
            Err(Error::Degenerate { .. })
        ));
        // Straight ahead the epipole is in the image.
        let (f, pixels1, pixels2) = scene([0.0, 0.0, 0.5], [0.0, 0.0, 5.0]);
        assert!(matches!(
            rectify(&f, &pixels1, &pixels2),
            Err(Error::Degenerate { .. })
        ));
        assert!(rectify_uncalibrated(&f, &pixels1, &pixels2, 1, 480).is_err());
    }
}
