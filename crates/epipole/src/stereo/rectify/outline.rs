//! Outline of a rectified image.

use super::rect::PixelRect;
use crate::camera::{Camera, Lens};
use crate::{Error, Result};
use nalgebra::{Point2, Rotation3, Vector2, Vector3};

/// Maximum angle of rays to the axis in a rectified image, degrees: at 80° it extends 5.7 focal
/// lengths, and soon beyond it would be infinite.
const WIDEST_DEG: f64 = 80.0;

/// Minimum range of the lens model, relative to the distance from the middle to the border, for
/// rectification to be useful.
const LEAST_VISIBLE: f64 = 0.5;

const FOLDS: Error = Error::Degenerate {
    what: "a rectification",
    why: "the lens model folds inside of the picture, far from its edges; calibrate once more, with boards up to the \
          edges, or with another model of the lens",
};

/// Area of an image in the rectified frame, in units of the focal length.
pub(crate) struct Outline {
    /// Rectangle between the innermost points of the four sides; for a slanted image it may be
    /// empty, its end before its begin.
    pub(crate) inner: PixelRect,
    /// Bounding rectangle.
    pub(crate) outer: PixelRect,
    /// Points along the whole border, in order.
    pub(super) border: Vec<Vector2<f64>>,
    /// Mean of the image's corners.
    pub(crate) center: Vector2<f64>,
}

/// Traces the border of an image.
///
/// * `place`: position of a border pixel in the rectified image, in units of the focal length
pub(crate) fn outline(
    width: u32,
    height: u32,
    place: impl Fn(f64, f64) -> Result<Vector2<f64>>,
) -> Result<Outline> {
    const STEPS: u32 = 64;
    let (last_u, last_v) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
    let around = f64::INFINITY;
    let mut inner = PixelRect {
        u_min: -around,
        v_min: -around,
        u_max: around,
        v_max: around,
    };
    let mut outer = PixelRect {
        u_min: around,
        v_min: around,
        u_max: -around,
        v_max: -around,
    };
    let mut sides: [Vec<Vector2<f64>>; 4] = Default::default();
    for k in 0..=STEPS {
        let fraction = f64::from(k) / f64::from(STEPS);
        let (u, v) = (fraction * last_u, fraction * last_v);
        let (left, right) = (place(0.0, v)?, place(last_u, v)?);
        let (top, bottom) = (place(u, 0.0)?, place(u, last_v)?);
        inner.u_min = inner.u_min.max(left.x);
        inner.u_max = inner.u_max.min(right.x);
        inner.v_min = inner.v_min.max(top.y);
        inner.v_max = inner.v_max.min(bottom.y);
        for (side, p) in sides.iter_mut().zip([top, right, bottom, left]) {
            outer.u_min = outer.u_min.min(p.x);
            outer.u_max = outer.u_max.max(p.x);
            outer.v_min = outer.v_min.min(p.y);
            outer.v_max = outer.v_max.max(p.y);
            side.push(p);
        }
    }
    let corners = [
        place(0.0, 0.0)?,
        place(last_u, 0.0)?,
        place(0.0, last_v)?,
        place(last_u, last_v)?,
    ];
    let center = corners.iter().sum::<Vector2<f64>>() / 4.0;
    // Clockwise: the lower and left sides are reversed.
    sides[2].reverse();
    sides[3].reverse();
    Ok(Outline {
        inner,
        outer,
        border: sides.concat(),
        center,
    })
}

/// Returns the ray of a pixel, or, if the lens model folds on the way to it, of the last pixel
/// before the fold: a model fitted to marks in the middle often has no rays at the very corners,
/// nor does a fisheye outside its circle.
///
/// # Errors
/// `folds`, if the model folds less than halfway to the pixel; as [`Lens::ray`] for other failures.
pub(crate) fn farthest_ray(
    camera: &Camera,
    pixel: &Point2<f64>,
    folds: Error,
) -> Result<Vector3<f64>> {
    let missing = match camera.ray(pixel) {
        Ok(ray) => return Ok(ray),
        Err(missing) => missing,
    };
    let center = camera.intrinsics.principal_point();
    let toward = |fraction: f64| camera.ray(&(center + (pixel - center) * fraction));
    let (mut visible, mut beyond) = (LEAST_VISIBLE, 1.0);
    let mut ray = toward(visible).map_err(|_| match missing {
        Error::Degenerate { .. } => folds,
        missing => missing,
    })?;
    for _ in 0..30 {
        let middle = 0.5 * (visible + beyond);
        match toward(middle) {
            Ok(found) => (visible, ray) = (middle, found),
            Err(_) => beyond = middle,
        }
    }
    Ok(ray)
}

/// Intersects a ray with the image plane at distance 1. `Err` for a ray more than [`WIDEST_DEG`]
/// off the axis: the point in the same direction at that limit.
pub(crate) fn flat(ray: &Vector3<f64>) -> core::result::Result<Vector2<f64>, Vector2<f64>> {
    let (widest, across) = (libm::tan(WIDEST_DEG.to_radians()), ray.xy().norm());
    match across <= widest * ray.z {
        true => Ok(ray.xy() / ray.z),
        false => Err(ray.xy() * (widest / across)),
    }
}

/// Returns the outline of an image with rotated rays.
pub(super) fn rotated_outline(camera: &Camera, rect_from_cam: &Rotation3<f64>) -> Result<Outline> {
    outline(camera.width, camera.height, |u, v| {
        let pixel = Point2::new(u, v);
        let ray = rect_from_cam * farthest_ray(camera, &pixel, FOLDS)?;
        if matches!(camera.lens, Lens::Fisheye(_)) {
            return Ok(flat(&ray).unwrap_or_else(|clipped| clipped));
        }
        if ray.z < 1e-3 {
            return Err(Error::Degenerate {
                what: "a rectification",
                why: "a part of an image looks along the baseline or backwards from it; a narrower part \
                      of the images, or cameras side by side, can be rectified",
            });
        }
        Ok(ray.xy() / ray.z)
    })
}
