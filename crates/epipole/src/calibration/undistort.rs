//! Undistortion of images.

use crate::camera::{Camera, Intrinsics};
use crate::progress::Monitor;
use crate::stereo::{PixelMap, PixelRect, border_outline, farthest_ray, flat};
use crate::{Error, Result};
use nalgebra::{Point2, Vector2, Vector3};

/// Area that an undistorted image keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Keep {
    /// Only valid pixels: no black borders, but the edges are cut off.
    #[default]
    Valid,
    /// The whole image, with black where there is no content.
    All,
}

/// The best undistorted camera for the images of a camera, with the map to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Undistortion {
    /// K of the new camera. Pixels are square, with the largest focal length that fits the image
    /// size.
    pub intrinsics: Intrinsics,
    /// Part of the result in which every pixel has content.
    pub valid: PixelRect,
    /// Source position of every pixel of the result.
    pub map: PixelMap,
}

impl Undistortion {
    /// Computes the undistorted camera of the same image size and with the largest focal length
    /// that keeps the given area. The only stage is
    /// [`Stage::Warping`](crate::progress::Stage::Warping).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an image of less than 2 × 2 pixels, [`Error::Degenerate`] if the
    /// lens model folds less than halfway to the border, so that most of the image has no rays, or
    /// if a fisheye sees too far sideways to keep all of it in a flat image: then keep only valid
    /// pixels. Content beyond a fold closer to the border is left black. [`Error::Canceled`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::{Keep, Undistortion};
    /// use epipole::camera::{Camera, Intrinsics, Lens, LensKind};
    /// let camera = Camera {
    ///     intrinsics: Intrinsics::centered(500.0, 641, 481)?,
    ///     lens: Lens::from_coefficients(LensKind::Brown, &[-0.2, 0.0, 0.0, 0.0, 0.0])?,
    ///     width: 641,
    ///     height: 481,
    /// };
    /// let flat = Undistortion::new(&camera, Keep::Valid, &mut ())?;
    /// // The middle is unchanged, and everything else is read further in.
    /// assert!((flat.map.source(320, 240).unwrap() - nalgebra::Point2::new(320.0, 240.0)).norm() < 1e-3);
    /// assert!(flat.map.source(0, 0).is_some());
    /// # Ok(()) }
    /// ```
    #[doc(alias = "getOptimalNewCameraMatrix")]
    #[doc(alias = "initUndistortRectifyMap")]
    pub fn new(camera: &Camera, keep: Keep, monitor: &mut dyn Monitor) -> Result<Self> {
        let (width, height) = (camera.width, camera.height);
        if width < 2 || height < 2 {
            return Err(Error::OutOfRange {
                what: "the image's shorter side in pixels",
                requirement: "at least 2",
                value: f64::from(width.min(height)),
            });
        }
        let covered = border_outline(width, height, |u, v| {
            let pixel = Point2::new(u, v);
            let ray = farthest_ray(camera, &pixel, FOLDS)?;
            flat(&ray).or_else(|clipped| match keep {
                Keep::Valid => Ok(clipped),
                Keep::All => Err(Error::Degenerate {
                    what: "an undistorted image",
                    why: "the lens sees more than 80° to a side, and no flat picture can keep that; keep what is \
                          valid instead",
                }),
            })
        })?;
        let shown = match keep {
            Keep::Valid => &covered.inner,
            Keep::All => &covered.outer,
        };
        let (span_u, span_v) = (shown.u_max - shown.u_min, shown.v_max - shown.v_min);
        let (last_u, last_v) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
        if !(span_u > 0.0 && span_v > 0.0) {
            return Err(FOLDS);
        }
        let zooms = [last_u / span_u, last_v / span_v];
        let focal_px = match keep {
            Keep::Valid => zooms[0].max(zooms[1]),
            Keep::All => zooms[0].min(zooms[1]),
        };
        let center = Vector2::new(
            last_u / 2.0 - focal_px * (shown.u_min + shown.u_max) / 2.0,
            last_v / 2.0 - focal_px * (shown.v_min + shown.v_max) / 2.0,
        );
        let intrinsics = Intrinsics::new(focal_px, focal_px, center.x, center.y)?;
        let valid = covered.inner.scaled(focal_px, &center);
        let source = |u, v| {
            let ray: Vector3<f64> = intrinsics.ray(&Point2::new(f64::from(u), f64::from(v)));
            let is_visible = camera.lens.is_visible(&ray);
            is_visible.then(|| camera.project(&ray.into()))?.ok()
        };
        Ok(Self {
            intrinsics,
            valid: PixelRect {
                u_min: valid.u_min.max(0.0),
                v_min: valid.v_min.max(0.0),
                u_max: valid.u_max.min(last_u),
                v_max: valid.v_max.min(last_v),
            },
            map: PixelMap::from_fn(width, height, source, monitor)?,
        })
    }
}

const FOLDS: Error = Error::Degenerate {
    what: "an undistorted image",
    why: "the lens model folds inside of the picture, far from its edges; calibrate once more, with boards up to the \
          edges, or with another model of the lens",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Lens, LensKind};

    fn camera(kind: LensKind, coefficients: &[f64]) -> Camera {
        Camera {
            intrinsics: Intrinsics::new(458.654, 457.296, 367.215, 248.375).unwrap(),
            lens: Lens::from_coefficients(kind, coefficients).unwrap(),
            width: 752,
            height: 480,
        }
    }

    fn lenses() -> [Camera; 4] {
        [
            camera(LensKind::Brown, &[-0.2834, 0.074, 0.0002, 1.8e-5, 0.0]),
            camera(
                LensKind::Rational,
                &[0.3, 0.02, 0.0, 0.001, 0.0, 0.6, 0.1, 0.0],
            ),
            camera(LensKind::Fisheye, &[-0.02, 0.008, -0.004, 6e-4]),
            camera(LensKind::Division, &[-0.25]),
        ]
    }

    #[test]
    fn valid_is_full_and_all_keeps_every_corner() {
        for camera in lenses() {
            let valid = Undistortion::new(&camera, Keep::Valid, &mut ()).unwrap();
            let mask = valid.map.mask(752, 480);
            let black = mask.as_raw().iter().filter(|v| **v == 0).count();
            assert!(black < 40, "{black}");
            let all = Undistortion::new(&camera, Keep::All, &mut ()).unwrap();
            assert!(all.intrinsics.fu_px() < valid.intrinsics.fu_px());
            for (u, v) in [
                (0.0, 0.0),
                (751.0, 0.0),
                (0.0, 479.0),
                (751.0, 479.0),
                (376.0, 0.0),
            ] {
                let ray = camera.ray(&Point2::new(u, v)).unwrap();
                let pixel = all.intrinsics.project(&ray.into()).unwrap();
                let inside = (-0.5..=751.5).contains(&pixel.x) && (-0.5..=479.5).contains(&pixel.y);
                assert!(inside, "{pixel}");
            }
            let middle = |a: f64, b: f64| (0.5 * (a + b)) as u32;
            let (u, v) = (
                middle(all.valid.u_min, all.valid.u_max),
                middle(all.valid.v_min, all.valid.v_max),
            );
            assert!(all.map.source(u, v).is_some());
            for (u, v) in [
                (all.valid.u_min.ceil() as u32 + 1, v),
                (u, all.valid.v_max as u32 - 1),
            ] {
                assert!(all.map.source(u, v).is_some());
            }
        }
    }

    /// `cv2.initUndistortRectifyMap` of OpenCV 5.0, for the same new camera.
    #[test]
    fn the_map_is_that_of_another_implementation() {
        let [brown, ..] = lenses();
        let k = Intrinsics::new(400.0, 400.0, 370.0, 250.0).unwrap();
        for (u, v, source) in REFERENCE {
            let ray = k.ray(&Point2::new(u, v));
            let pixel = brown.project(&ray.into()).unwrap();
            assert!((pixel - Point2::from(source)).norm() < 1e-3, "{pixel}");
        }
    }

    const REFERENCE: [(f64, f64, [f64; 2]); 2] = [
        (20.0, 30.0, [53.603397, 51.923534]),
        (700.0, 400.0, [676.4973, 388.61365]),
    ];

    #[test]
    fn what_cannot_be_flat_is_refused() {
        let mut wide = camera(LensKind::Fisheye, &[0.0; 4]);
        wide.intrinsics = Intrinsics::new(200.0, 200.0, 376.0, 240.0).unwrap();
        assert!(Undistortion::new(&wide, Keep::All, &mut ()).is_err());
        assert!(Undistortion::new(&wide, Keep::Valid, &mut ()).is_ok());
        // Folds at a third of the focal length.
        let folded = camera(LensKind::Brown, &[-3.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(matches!(
            Undistortion::new(&folded, Keep::Valid, &mut ()),
            Err(Error::Degenerate { .. })
        ));
        // Folds 394 px from the middle; the corners are 443 away.
        let corners = camera(LensKind::Brown, &[-0.2, 0.0, 0.0, 0.0, 0.0]);
        assert!(corners.ray(&Point2::new(0.0, 0.0)).is_err());
        assert!(corners.ray(&Point2::new(60.0, 50.0)).is_ok());
        for keep in [Keep::Valid, Keep::All] {
            let flat = Undistortion::new(&corners, keep, &mut ()).unwrap();
            assert!(flat.valid.u_max - flat.valid.u_min > 400.0);
            assert!(flat.map.source(376, 240).is_some());
        }
        let tiny = Camera { width: 1, ..wide };
        assert!(Undistortion::new(&tiny, Keep::Valid, &mut ()).is_err());
    }
}
