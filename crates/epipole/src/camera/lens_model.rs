//! What every model of a lens can do.

use super::{Distortion, Lens};
use crate::Result;
use nalgebra::{Point2, Vector3};

/// A lens between the camera frame and the image plane at distance 1: [`Distortion`] where no other model is needed,
/// [`Lens`] where it may be any. What takes either, as rectification does, carries no model that nobody asks for.
///
/// ```
/// use epipole::camera::{Distortion, Lens, LensKind, LensModel};
/// use nalgebra::Vector3;
/// fn seen_at(lens: &impl LensModel, x_in_cam: Vector3<f64>) -> f64 {
///     lens.project(&x_in_cam).map_or(f64::NAN, |seen| seen.x)
/// }
/// # fn main() -> Result<(), epipole::Error> {
/// let fisheye = Lens::from_coefficients(LensKind::Fisheye, &[0.0; 4])?;
/// let x = Vector3::new(1.0, 0.0, 1.0);
/// assert_eq!(seen_at(&Distortion::NONE, x), 1.0);
/// // A fisheye shows angles: 45° are π/4.
/// assert!((seen_at(&fisheye, x) - 0.785_398).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub trait LensModel: Copy {
    /// Where a point of the camera frame is seen, in units of the focal length; `None` for what the lens does not see.
    fn project(&self, x_in_cam: &Vector3<f64>) -> Option<Point2<f64>>;

    /// The ray that is seen at a place, in the camera frame, of any length.
    ///
    /// # Errors
    /// As [`Distortion::undistort`], and as [`Lens::ray`] for other models.
    fn ray(&self, seen: &Point2<f64>) -> Result<Vector3<f64>>;

    /// Whether the lens sees a ray inside of where its model folds.
    fn is_seen(&self, x_in_cam: &Vector3<f64>) -> bool;

    /// Whether the model is one for views of 180° and more, which no flat picture can show.
    fn is_wide(&self) -> bool;
}

impl LensModel for Distortion {
    fn project(&self, x_in_cam: &Vector3<f64>) -> Option<Point2<f64>> {
        let seen = self.distort(&flat(x_in_cam)?);
        (seen.x.is_finite() && seen.y.is_finite()).then_some(seen)
    }

    fn ray(&self, seen: &Point2<f64>) -> Result<Vector3<f64>> {
        self.undistort(seen)
            .map(|ray| Vector3::new(ray.x, ray.y, 1.0))
    }

    fn is_seen(&self, x_in_cam: &Vector3<f64>) -> bool {
        flat(x_in_cam).is_some_and(|ray| Distortion::is_seen(self, &ray))
    }

    fn is_wide(&self) -> bool {
        false
    }
}

impl LensModel for Lens {
    fn project(&self, x_in_cam: &Vector3<f64>) -> Option<Point2<f64>> {
        Lens::project(self, x_in_cam)
    }

    fn ray(&self, seen: &Point2<f64>) -> Result<Vector3<f64>> {
        Lens::ray(self, seen)
    }

    fn is_seen(&self, x_in_cam: &Vector3<f64>) -> bool {
        Lens::is_seen(self, x_in_cam)
    }

    fn is_wide(&self) -> bool {
        matches!(self, Lens::Fisheye(_))
    }
}

/// Where a ray in front meets the image plane at distance 1.
fn flat(ray: &Vector3<f64>) -> Option<Point2<f64>> {
    (ray.z > 0.0).then(|| Point2::new(ray.x / ray.z, ray.y / ray.z))
}
