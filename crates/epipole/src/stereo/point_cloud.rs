//! Depths and 3D points from disparities.

use super::{DisparityImage, depth_from_disparity};
use crate::{Error, Result};
use image::{ImageBuffer, Luma, RgbImage};
use nalgebra::{Matrix4, Point3, Vector3, Vector4};

/// Points in space, optionally with colors, normals and confidences.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PointCloud {
    /// Points in any frame and unit.
    pub points: Vec<Point3<f64>>,
    /// Colors, one per point, or none.
    pub colors: Vec<[u8; 3]>,
    /// Unit normals, one per point, or none.
    pub normals: Vec<Vector3<f64>>,
    /// Number of images that agree on each point, or another measure; one per point, or none.
    pub confidences: Vec<f32>,
}

/// Computes the depth of every pixel, `Z = f B / d`, meters; NaN without disparity or for `d <= 0`.
///
/// * `focal_px`: pixels, > 0; `baseline_m`: meters, > 0
///
/// # Errors
/// [`Error::OutOfRange`] for a focal length or baseline ≤ 0, [`Error::NotFinite`] for NaN or
/// infinities.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityImage, depth_image};
/// let disparity = DisparityImage::from_raw(2, 1, vec![30.0, f32::NAN])?;
/// let depth = depth_image(&disparity, 700.0, 0.12)?;
/// assert!((depth.get_pixel(0, 0).0[0] - 2.8).abs() < 1e-6);
/// assert!(depth.get_pixel(1, 0).0[0].is_nan());
/// # Ok(()) }
/// ```
pub fn depth_image(
    disparity: &DisparityImage,
    focal_px: f64,
    baseline_m: f64,
) -> Result<ImageBuffer<Luma<f32>, Vec<f32>>> {
    // Rejects invalid parameters even if no pixel has a disparity.
    depth_from_disparity(focal_px, baseline_m, 1.0)?;
    let depth = |&d: &f32| {
        if d.is_nan() {
            return f32::NAN;
        }
        let depth = depth_from_disparity(focal_px, baseline_m, f64::from(d));
        depth.map_or(f32::NAN, |z| z as f32)
    };
    let raw = disparity.as_raw().iter().map(depth).collect();
    Ok(
        ImageBuffer::from_raw(disparity.width(), disparity.height(), raw)
            .expect("one depth for every disparity"),
    )
}

/// Computes the points of a rectified pair, `(X, Y, Z, W) = Q (u, v, d, 1)`, in the first camera's
/// rectified frame.
///
/// * `q`: as in [`Rectification::q`](super::Rectification::q) or from
///   [`q_from_rig`](super::q_from_rig)
/// * `colors`: the rectified first image, for colored points
///
/// Pixels without disparity, points at infinity and points behind the camera are left out.
///
/// # Errors
/// [`Error::SizeMismatch`] if the size of `colors` differs from that of the disparities,
/// [`Error::NotFinite`] for a Q with NaN or infinities.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityImage, point_cloud, q_from_rig};
/// let disparity = DisparityImage::from_raw(2, 1, vec![f32::NAN, 30.0])?;
/// let q = q_from_rig(700.0, 0.12, 0.0, 0.0)?;
/// let cloud = point_cloud(&disparity, &q, None)?;
/// assert_eq!(cloud.points.len(), 1);
/// assert!((cloud.points[0].z - 2.8).abs() < 1e-12);
/// assert!((cloud.points[0].x - 0.004).abs() < 1e-12); // 1 px × 2.8 m / 700 px
/// # Ok(()) }
/// ```
pub fn point_cloud(
    disparity: &DisparityImage,
    q: &Matrix4<f64>,
    colors: Option<&RgbImage>,
) -> Result<PointCloud> {
    if !q.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "every entry of Q",
        });
    }
    if let Some(colors) = colors {
        for (what, first, second) in [
            (
                "the rows of the disparities and the colors",
                disparity.width(),
                colors.width(),
            ),
            (
                "the columns of the disparities and the colors",
                disparity.height(),
                colors.height(),
            ),
        ] {
            if first != second {
                return Err(Error::SizeMismatch {
                    what,
                    first: first as usize,
                    second: second as usize,
                });
            }
        }
    }
    let mut cloud = PointCloud::default();
    for v in 0..disparity.height() {
        for u in 0..disparity.width() {
            let Some(d) = disparity.get(u, v) else {
                continue;
            };
            let x = q * Vector4::new(f64::from(u), f64::from(v), f64::from(d), 1.0);
            let point = Point3::new(x.x / x.w, x.y / x.w, x.z / x.w);
            if point.iter().all(|c| c.is_finite()) && point.z > 0.0 {
                cloud.points.push(point);
                if let Some(colors) = colors {
                    cloud.colors.push(colors.get_pixel(u, v).0);
                }
            }
        }
    }
    Ok(cloud)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stereo::q_from_rig;

    #[test]
    fn only_points_in_front_remain_with_their_colors() {
        let values = vec![10.0, 0.0, -5.0, f32::NAN];
        let disparity = DisparityImage::from_raw(4, 1, values).unwrap();
        let q = q_from_rig(100.0, 0.5, 0.0, 0.0).unwrap();
        let colors = RgbImage::from_fn(4, 1, |u, _| image::Rgb([u as u8 + 1, 0, 0]));
        let cloud = point_cloud(&disparity, &q, Some(&colors)).unwrap();
        assert_eq!(cloud.points, [Point3::new(0.0, 0.0, 5.0)]);
        assert_eq!(cloud.colors, [[1, 0, 0]]);
        let depth = depth_image(&disparity, 100.0, 0.5).unwrap();
        assert_eq!(depth.get_pixel(0, 0).0[0], 5.0);
        assert!((1..4).all(|u| depth.get_pixel(u, 0).0[0].is_nan()));
    }

    #[test]
    fn bad_input_is_refused() {
        let disparity = DisparityImage::from_raw(1, 1, vec![f32::NAN]).unwrap();
        let q = q_from_rig(100.0, 0.5, 0.0, 0.0).unwrap();
        assert!(point_cloud(&disparity, &(q * f64::NAN), None).is_err());
        assert!(point_cloud(&disparity, &q, Some(&RgbImage::new(2, 1))).is_err());
        assert!(depth_image(&disparity, 0.0, 0.5).is_err());
        assert!(depth_image(&disparity, 100.0, f64::INFINITY).is_err());
    }
}
