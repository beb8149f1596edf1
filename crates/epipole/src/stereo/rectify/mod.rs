//! Calibrated rectification: both pictures redrawn as if the cameras stood parallel.

mod cover;
mod q_matrix;
mod turn;

use super::PixelMap;
use crate::camera::{Distortion, Intrinsics, RigidTransform};
use crate::{Error, Result};
pub(crate) use cover::outline as border_outline;
use cover::{around_principal_points, around_what_is_seen, turned_outline};
use nalgebra::{Matrix3, Matrix4, Point2, Rotation3, Vector2, Vector3};
use q_matrix::q_matrix;
use turn::turn_parallel;

pub use q_matrix::q_from_rig;

/// A camera of a stereo rig: how rays become pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StereoCamera {
    /// K.
    pub intrinsics: Intrinsics,
    /// The lens; [`Distortion::NONE`] for an ideal one.
    pub distortion: Distortion,
}

/// With principal points in the middle the results may be enlarged so many times as much as they have to be.
const LARGEST_CROP: f64 = 2.0;

/// Choices of [`rectify_calibrated`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectifyOptions {
    /// 0: zoomed in until every pixel of the results is seen by the camera. 1: zoomed out until
    /// every pixel of the photographs is shown. Between: in between.
    pub alpha: f64,
    /// Size of the results, pixels; none: that of the photographs.
    pub size: Option<(u32, u32)>,
    /// Whether both results have the same principal point, so that points at infinity have
    /// disparity 0. Otherwise each shows what its own camera sees best.
    pub zero_disparity_at_infinity: bool,
}

impl Default for RectifyOptions {
    /// Only valid pixels, the photographs' size, disparity 0 at infinity.
    fn default() -> Self {
        Self {
            alpha: 0.0,
            size: None,
            zero_disparity_at_infinity: true,
        }
    }
}

/// A rectangle of pixel coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelRect {
    /// Left end.
    pub u_min: f64,
    /// Upper end.
    pub v_min: f64,
    /// Right end.
    pub u_max: f64,
    /// Lower end.
    pub v_max: f64,
}

/// A rectified rig: two virtual cameras that stand parallel and share a focal length, so that
/// matches share a row (or, if `is_vertical`, a column).
#[derive(Debug, Clone, PartialEq)]
pub struct Rectification {
    /// The photographs' cameras.
    pub cameras: [StereoCamera; 2],
    /// Rotation of each camera's rays into the rectified frame.
    pub rect_from_cam: [Rotation3<f64>; 2],
    /// Intrinsics of the rectified pictures.
    pub intrinsics: [Intrinsics; 2],
    /// Homography from undistorted pixels of each photograph to rectified pixels,
    /// `H = K_rect R K⁻¹`.
    pub homographies: [Matrix3<f64>; 2],
    /// `(X, Y, Z, W) = Q (u, v, d, 1)` in the rectified frame of the first camera, where (u, v)
    /// is a pixel of the first picture and d its disparity `u1 − u2` (`v1 − v2` if vertical).
    pub q: Matrix4<f64>,
    /// Whether the second camera stands above or below the first: then matches share a column.
    pub is_vertical: bool,
    /// Distance between the cameras, meters.
    pub baseline_m: f64,
    /// Size of the rectified pictures, pixels.
    pub width: u32,
    /// See `width`.
    pub height: u32,
    /// The largest rectangle in each rectified picture that its camera saw whole.
    pub valid: [PixelRect; 2],
}

/// Rectifies a calibrated rig.
///
/// Each camera turns by half of the rotation between them, so both pictures suffer equally; then
/// both turn, by the smallest angle, until the baseline lies along the rows (or along the
/// columns, if the second camera stands rather above or below). The smallest angle never turns a
/// picture upside down: a second camera on the left gives negative disparities instead.
///
/// * `cameras`: of the first (left) and second (right) photograph
/// * `cam2_from_cam1`: `x2 = R x1 + t`, meters
/// * `width`, `height`: of both photographs, pixels
///
/// # Errors
/// [`Error::Degenerate`] if the cameras stand at one place; if the baseline is more than 60° off the image plane
/// halfway between the cameras; and if a pixel of a photograph looks along the baseline, which with a baseline
/// θ off that plane it does as soon as the photographs reach 90° − θ from their middle: no common image plane
/// sees all of it. [`Error::OutOfRange`] for an alpha outside 0 to 1 or an
/// empty size.
///
/// Source: Bouguet's method as described in Bradski & Kaehler 2008, "Learning OpenCV", ch. 12;
/// Fusiello, Trucco & Verri 2000, "A compact algorithm for rectification of stereo pairs".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Distortion, Intrinsics, RigidTransform};
/// use epipole::stereo::{RectifyOptions, StereoCamera, rectify_calibrated};
/// // Two ideal cameras that stand parallel, 0.1 m apart: nothing needs to change.
/// let intrinsics = Intrinsics::centered(500.0, 640, 480)?;
/// let camera = StereoCamera { intrinsics, distortion: Distortion::NONE };
/// let cam2_from_cam1 = RigidTransform::translation(-0.1, 0.0, 0.0);
/// let rig = rectify_calibrated(
///     &[camera, camera], &cam2_from_cam1, 640, 480, &RectifyOptions::default())?;
/// assert!((rig.intrinsics[0].fu_px() - 500.0).abs() < 1e-6);
/// // A disparity of 25 px in the middle is 500 × 0.1 / 25 = 2 m away.
/// let x = rig.q * nalgebra::Vector4::new(319.5, 239.5, 25.0, 1.0);
/// assert!((x.z / x.w - 2.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn rectify_calibrated(
    cameras: &[StereoCamera; 2],
    cam2_from_cam1: &RigidTransform,
    width: u32,
    height: u32,
    options: &RectifyOptions,
) -> Result<Rectification> {
    let (new_width, new_height) = options.size.unwrap_or((width, height));
    check(width, height, new_width, new_height, options.alpha)?;
    let turned = turn_parallel(cam2_from_cam1)?;
    let rect_from_cam = turned.rect_from_cam;

    // A focal length to begin with; the zoom follows.
    let focal_px = cameras
        .iter()
        .flat_map(|c| [c.intrinsics.fu_px(), c.intrinsics.fv_px()])
        .fold(f64::INFINITY, f64::min);
    let outlines = [0, 1].map(|i| turned_outline(&cameras[i], &rect_from_cam[i], width, height));
    let [outline1, outline2] = outlines;
    let outlines = [outline1?, outline2?];

    let new_size = Vector2::new(f64::from(new_width), f64::from(new_height));
    let middle = (new_size - Vector2::new(1.0, 1.0)) / 2.0;
    // The direction that each photograph's middle looks to, seen in the result's middle.
    let mut centers = outlines.each_ref().map(|o| middle - o.center * focal_px);
    let mean = (centers[0] + centers[1]) / 2.0;
    if options.zero_disparity_at_infinity {
        centers = [mean; 2];
    } else if turned.is_vertical {
        centers.iter_mut().for_each(|c| c.x = mean.x);
    } else {
        centers.iter_mut().for_each(|c| c.y = mean.y);
    }
    let axis = usize::from(turned.is_vertical);
    let shared = [0, 1].map(|a| options.zero_disparity_at_infinity || a != axis);
    let seen = around_what_is_seen(&outlines, shared, &new_size, options.alpha)?;
    // The principal points stay where they are, as is usual, unless that costs too much of the view.
    let (focal_px, centers) =
        around_principal_points(&outlines, &centers, focal_px, &new_size, options.alpha)
            .filter(|(focal_px, _)| *focal_px <= LARGEST_CROP * seen.0)
            .unwrap_or(seen);
    let new_intrinsics = |c: &Vector2<f64>| Intrinsics::new(focal_px, focal_px, c.x, c.y);
    let intrinsics = [new_intrinsics(&centers[0])?, new_intrinsics(&centers[1])?];
    let homographies = [0, 1].map(|i| {
        let k_inverse = cameras[i].intrinsics.inverse_matrix();
        intrinsics[i].matrix() * rect_from_cam[i].matrix() * k_inverse
    });
    let valid = [0, 1].map(|i| {
        let rect = outlines[i].inner.scaled(focal_px, &centers[i]);
        PixelRect {
            u_min: rect.u_min.max(0.0),
            v_min: rect.v_min.max(0.0),
            u_max: rect.u_max.min(new_size.x - 1.0),
            v_max: rect.v_max.min(new_size.y - 1.0),
        }
    });
    Ok(Rectification {
        cameras: *cameras,
        rect_from_cam,
        intrinsics,
        homographies,
        q: q_matrix(
            focal_px,
            &centers[0],
            turned.translation[axis],
            centers[0][axis] - centers[1][axis],
        ),
        is_vertical: turned.is_vertical,
        baseline_m: turned.translation.norm(),
        width: new_width,
        height: new_height,
        valid,
    })
}

impl Rectification {
    /// Where pixel `pixel` of photograph 0 or 1 lies in the rectified picture.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `index` is 0 or 1, [`Error::PointBehindCamera`] if the
    /// rectified camera looks away from it, and as [`Distortion::undistort`].
    pub fn rectify_pixel(&self, index: usize, pixel: &Point2<f64>) -> Result<Point2<f64>> {
        let i = checked_index(index)?;
        let ray = self.cameras[i].intrinsics.ray(pixel);
        let ray = self.cameras[i].distortion.undistort(&ray.xy().into())?;
        let turned = self.rect_from_cam[i] * Vector3::new(ray.x, ray.y, 1.0);
        self.intrinsics[i].project(&turned.into())
    }

    /// The place in photograph 0 or 1 that a rectified pixel is read from: rotation and lens in
    /// one step. None where the camera could not see it.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `index` is 0 or 1.
    pub fn source_pixel(
        &self,
        index: usize,
        rectified: &Point2<f64>,
    ) -> Result<Option<Point2<f64>>> {
        let i = checked_index(index)?;
        let ray = self.rect_from_cam[i].inverse() * self.intrinsics[i].ray(rectified);
        if ray.z <= 0.0 {
            return Ok(None);
        }
        let distortion = &self.cameras[i].distortion;
        let ray = Point2::new(ray.x / ray.z, ray.y / ray.z);
        // Beyond its fold the lens model shows the same place twice.
        if !distortion.is_seen(&ray) {
            return Ok(None);
        }
        let bent = distortion.distort(&ray);
        let k = &self.cameras[i].intrinsics;
        let center = k.principal_point();
        Ok(Some(Point2::new(
            k.fu_px() * bent.x + center.x,
            k.fv_px() * bent.y + center.y,
        )))
    }

    /// The map that redraws photograph 0 or 1.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `index` is 0 or 1.
    pub fn map(&self, index: usize) -> Result<PixelMap> {
        checked_index(index)?;
        Ok(PixelMap::from_fn(self.width, self.height, |u, v| {
            let rectified = Point2::new(f64::from(u), f64::from(v));
            self.source_pixel(index, &rectified).ok().flatten()
        }))
    }
}

fn checked_index(index: usize) -> Result<usize> {
    if index < 2 {
        Ok(index)
    } else {
        Err(Error::OutOfRange {
            what: "the number of a rig's camera",
            requirement: "0 or 1",
            value: index as f64,
        })
    }
}

fn check(width: u32, height: u32, new_width: u32, new_height: u32, alpha: f64) -> Result<()> {
    for (what, value) in [
        ("the photographs' width", width),
        ("the photographs' height", height),
        ("the rectified width", new_width),
        ("the rectified height", new_height),
    ] {
        if value < 2 {
            return Err(Error::OutOfRange {
                what,
                requirement: "at least 2 pixels",
                value: f64::from(value),
            });
        }
    }
    if !(0.0..=1.0).contains(&alpha) {
        return Err(Error::OutOfRange {
            what: "alpha",
            requirement: "from 0 to 1",
            value: alpha,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::{Point3, UnitQuaternion, Vector4};

    fn camera(fu: f64, fv: f64, cu: f64, cv: f64, k: [f64; 5]) -> StereoCamera {
        StereoCamera {
            intrinsics: Intrinsics::new(fu, fv, cu, cv).unwrap(),
            distortion: Distortion::from_coefficients(k).unwrap(),
        }
    }

    fn motion(rotation: [f64; 3], translation: [f64; 3]) -> RigidTransform {
        RigidTransform::from_parts(
            Vector3::from(translation).into(),
            UnitQuaternion::from_scaled_axis(Vector3::from(rotation)),
        )
    }

    fn photograph(camera: &StereoCamera, x_in_cam: &Point3<f64>) -> Point2<f64> {
        let bent = camera.distortion.distort(&Point2::new(
            x_in_cam.x / x_in_cam.z,
            x_in_cam.y / x_in_cam.z,
        ));
        camera
            .intrinsics
            .project(&Point3::new(bent.x, bent.y, 1.0))
            .unwrap()
    }

    fn wide_rig() -> [StereoCamera; 2] {
        [
            camera(
                458.654,
                457.296,
                367.215,
                248.375,
                [-0.2834, 0.074, 0.0002, 1.8e-5, 0.0],
            ),
            camera(
                457.587,
                456.134,
                379.999,
                255.238,
                [-0.2837, 0.0745, -0.0001, -3.6e-5, 0.0],
            ),
        ]
    }

    /// Points of the world land in the same row or column, at the disparity that Q turns back
    /// into their place, the right way up.
    #[test]
    fn matches_share_a_line_and_q_gives_them_back() {
        let mut random = Random::new(5);
        for (rotation, translation, vertical) in [
            ([0.0141, -0.0004, -0.0023], [-0.11, 0.0004, -0.0009], false),
            ([0.1, 0.15, -0.2], [-0.2, 0.05, 0.06], false),
            ([0.02, -0.1, 0.1], [0.03, -0.15, 0.02], true),
            ([0.02, 0.1, 0.1], [0.01, 0.15, 0.02], true),
            ([0.0, 0.0, 0.0], [0.3, 0.0, 0.0], false),
        ] {
            let cam2_from_cam1 = motion(rotation, translation);
            for (alpha, same) in [(0.0, true), (1.0, true), (0.5, false)] {
                let options = RectifyOptions {
                    alpha,
                    zero_disparity_at_infinity: same,
                    ..Default::default()
                };
                let cameras = wide_rig();
                let rig =
                    rectify_calibrated(&cameras, &cam2_from_cam1, 752, 480, &options).unwrap();
                assert_eq!(rig.is_vertical, vertical);
                let mut tested = 0;
                for _ in 0..200 {
                    let x1 = Point3::new(
                        random.uniform(-1.0, 1.0),
                        random.uniform(-0.7, 0.7),
                        random.uniform(1.5, 6.0),
                    );
                    let x2 = cam2_from_cam1 * x1;
                    if x2.z < 1.0 || x2.x.abs() > 0.9 * x2.z || x2.y.abs() > 0.7 * x2.z {
                        continue;
                    }
                    tested += 1;
                    let [p1, p2] = [(0, x1), (1, x2)].map(|(i, x)| {
                        let seen = photograph(&cameras[i], &x);
                        let p = rig.rectify_pixel(i, &seen).unwrap();
                        let back = rig.source_pixel(i, &p).unwrap().unwrap();
                        assert!((back - seen).norm() < 1e-7);
                        p
                    });
                    let d = p1 - p2;
                    let (along, across) = if vertical { (d.y, d.x) } else { (d.x, d.y) };
                    assert!(across.abs() < 1e-7, "off by {across}");
                    let x = rig.q * Vector4::new(p1.x, p1.y, along, 1.0);
                    let found = Point3::new(x.x / x.w, x.y / x.w, x.z / x.w);
                    assert!((found - rig.rect_from_cam[0] * x1).norm() < 1e-6);
                }
                assert!(tested > 50);
                for (rotation, h) in rig.rect_from_cam.iter().zip(&rig.homographies) {
                    assert!(rotation.angle() < 0.6, "turned by {}", rotation.angle());
                    // Up stays up.
                    let m = rotation.matrix();
                    assert!(m[(0, 0)] > 0.7 && m[(1, 1)] > 0.7);
                    assert!(h.determinant() > 0.0);
                }
            }
        }
    }

    /// The second camera stands to the side and ahead: up to 60° off the image plane there is a region that both
    /// saw, or the error says what the limit is.
    #[test]
    fn a_baseline_far_off_the_image_plane_is_rectified() {
        for off_deg in [30.0_f64, 37.0, 45.0, 55.0] {
            let off = off_deg.to_radians();
            let mut num_rectified = 0;
            for focal_px in [300.0, 500.0, 700.0, 1000.0, 2000.0, 5000.0] {
                let lens = camera(focal_px, focal_px, 319.5, 239.5, [0.0; 5]);
                let (sideways, ahead) = (-0.3 * libm::cos(off), -0.3 * libm::sin(off));
                let corner = libm::atan(319.5 / focal_px);
                for translation in [[sideways, 0.0, ahead], [0.0, -sideways, ahead]] {
                    let cam2_from_cam1 = motion([0.0; 3], translation);
                    for alpha in [0.0, 1.0] {
                        let options = RectifyOptions {
                            alpha,
                            ..Default::default()
                        };
                        let rig =
                            rectify_calibrated(&[lens; 2], &cam2_from_cam1, 640, 480, &options);
                        let rig = match rig {
                            Ok(rig) => rig,
                            Err(error) => {
                                assert!(
                                    corner + off > 1.45,
                                    "{off_deg}° at {focal_px} px: {error}"
                                );
                                assert!(error.to_string().contains("along the baseline"));
                                continue;
                            }
                        };
                        num_rectified += 1;
                        for i in 0..2 {
                            let valid = rig.valid[i];
                            let size = (valid.u_max - valid.u_min, valid.v_max - valid.v_min);
                            let least = (1.0 - alpha) * 0.999;
                            assert!(size.0 > least * 639.0, "{focal_px} {valid:?}");
                            assert!(size.1 > least * 479.0, "{focal_px} {valid:?}");
                            for (u, v) in [
                                (valid.u_min, valid.v_min),
                                (valid.u_max, valid.v_min),
                                (valid.u_min, valid.v_max),
                                (valid.u_max, valid.v_max),
                            ] {
                                let source = rig.source_pixel(i, &Point2::new(u, v)).unwrap();
                                let p = source.unwrap();
                                assert!((-1e-6..639.0 + 1e-6).contains(&p.x), "{p}");
                                assert!((-1e-6..479.0 + 1e-6).contains(&p.y), "{p}");
                            }
                        }
                        let x1 = Point3::new(0.1, -0.2, 9.0);
                        let x2 = cam2_from_cam1 * x1;
                        let p1 = rig.rectify_pixel(0, &photograph(&lens, &x1)).unwrap();
                        let p2 = rig.rectify_pixel(1, &photograph(&lens, &x2)).unwrap();
                        let across = 1 - usize::from(rig.is_vertical);
                        assert!((p1 - p2)[across].abs() < 1e-6);
                        let d = (p1 - p2)[1 - across];
                        let x = rig.q * Vector4::new(p1.x, p1.y, d, 1.0);
                        let found = Point3::new(x.x / x.w, x.y / x.w, x.z / x.w);
                        assert!((found - rig.rect_from_cam[0] * x1).norm() < 1e-6);
                    }
                }
            }
            assert!(num_rectified >= 12, "{off_deg}°: {num_rectified}");
        }
        // Beyond, the error names the limit.
        let lens = camera(700.0, 700.0, 319.5, 239.5, [0.0; 5]);
        let ahead = motion([0.0; 3], [-0.1, 0.0, -0.3]);
        let error = rectify_calibrated(&[lens; 2], &ahead, 640, 480, &RectifyOptions::default());
        assert!(error.unwrap_err().to_string().contains("60°"));
    }

    #[test]
    fn alpha_zero_shows_only_what_was_seen_and_one_shows_all() {
        let cam2_from_cam1 = motion([0.0141, -0.0004, -0.0023], [-0.11, 0.0004, -0.0009]);
        let mut options = RectifyOptions::default();
        let tight = rectify_calibrated(&wide_rig(), &cam2_from_cam1, 752, 480, &options).unwrap();
        for i in 0..2 {
            let mask = tight.map(i).unwrap().mask(752, 480);
            assert!(mask.as_raw().iter().all(|&m| m == 255));
            let valid = tight.valid[i];
            assert_eq!((valid.u_min, valid.v_min), (0.0, 0.0));
            assert_eq!((valid.u_max, valid.v_max), (751.0, 479.0));
        }
        options.alpha = 1.0;
        let wide = rectify_calibrated(&wide_rig(), &cam2_from_cam1, 752, 480, &options).unwrap();
        for i in 0..2 {
            for (u, v) in [
                (0.0, 0.0),
                (751.0, 0.0),
                (0.0, 479.0),
                (751.0, 479.0),
                (375.0, 0.0),
            ] {
                let p = wide.rectify_pixel(i, &Point2::new(u, v)).unwrap();
                assert!(p.x > -1e-6 && p.y > -1e-6 && p.x < 751.000001 && p.y < 479.000001);
            }
            assert!(wide.map(i).unwrap().mask(752, 480).as_raw().contains(&0));
        }
        assert!(wide.intrinsics[0].fu_px() < tight.intrinsics[0].fu_px());
    }

    #[test]
    fn hopeless_rigs_are_refused() {
        let options = RectifyOptions::default();
        let rig = |m: RigidTransform, w, h, o: &RectifyOptions| {
            rectify_calibrated(&wide_rig(), &m, w, h, o)
        };
        let side = motion([0.0; 3], [-0.1, 0.0, 0.0]);
        assert!(matches!(
            rig(motion([0.1, 0.0, 0.0], [0.0; 3]), 752, 480, &options),
            Err(Error::Degenerate { .. })
        ));
        assert!(matches!(
            rig(motion([0.0; 3], [0.01, 0.0, -0.5]), 752, 480, &options),
            Err(Error::Degenerate { .. })
        ));
        assert!(
            rig(
                motion([0.0, 3.0, 0.0], [-0.1, 0.0, 0.0]),
                752,
                480,
                &options
            )
            .is_err()
        );
        assert!(rig(motion([0.0; 3], [f64::NAN, 0.0, 0.0]), 752, 480, &options).is_err());
        assert!(rig(side, 0, 480, &options).is_err());
        for alpha in [-0.1, 1.1, f64::NAN] {
            assert!(rig(side, 752, 480, &RectifyOptions { alpha, ..options }).is_err());
        }
        let good = rig(side, 752, 480, &options).unwrap();
        assert!(good.map(2).is_err());
        assert!(good.rectify_pixel(2, &Point2::new(0.0, 0.0)).is_err());
        assert!(q_from_rig(0.0, 1.0, 0.0, 0.0).is_err());
        assert!(q_from_rig(1.0, f64::NAN, 0.0, 0.0).is_err());
    }
}
