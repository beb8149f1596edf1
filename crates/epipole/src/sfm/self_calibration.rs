//! Self-calibration: focal lengths and radial distortion from the reconstruction itself.

use super::bundle::{Bundle, BundleOptions, adjust_bundle, focal_sensitivity};
use super::reconstruction::{LOSS, Reconstruction, SfmImage};
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Minimum relative increase of the cost by a wrong focal length. Systematic errors, such as from
/// the lens, shift any flatter minimum.
const MIN_FOCAL_RISE: f64 = 0.02;

/// Minimum number of images to correct a lens.
const MIN_IMAGES_OF_LENS: usize = 5;

/// The lenses are corrected if the cost falls at least to this fraction. The cost is quadratic in
/// the error: 0.9 corresponds to an error of 5 %.
const MAX_COST_RATIO: f64 = 0.9;

impl Reconstruction {
    /// Returns whether the observations determine the focal length of every lens: changing it by 20
    /// % and refining cameras and points again would raise the cost by at least 2 %. For a camera
    /// that moves along a straight line without rotating, or sees a single plane head-on, the focal
    /// length and the depth of the scene are arbitrary. Assumes a refined model.
    ///
    /// * `images`: images of the reconstruction
    ///
    /// # Errors
    /// [`Error::TooFew`] without observations.
    ///
    /// Source: Sturm 1997, "Critical motion sequences for monocular self-calibration and
    /// uncalibrated Euclidean reconstruction".
    ///
    /// ```
    /// # use epipole::sfm::{Reconstruction, SfmImage};
    /// # fn judge(found: &Reconstruction, images: &[SfmImage]) -> Result<(), epipole::Error> {
    /// if !found.determines_focal(images)? {
    ///     println!("the focal length may be far off, and so may all depths");
    /// }
    /// # Ok(()) }
    /// ```
    pub fn determines_focal(&self, images: &[SfmImage]) -> Result<bool> {
        let (bundle, _) = self.to_bundle(images);
        let sensitivity = focal_sensitivity(&bundle, LOSS)?;
        Ok(sensitivity.iter().all(|rise| *rise >= MIN_FOCAL_RISE))
    }

    /// Corrects the focal lengths and radial terms of all lenses, with cameras and points, if that
    /// lowers the robust cost by at least a tenth and the images
    /// [determine](Self::determines_focal) the focal lengths. Returns whether it did; otherwise the
    /// reconstruction is unchanged, also if any lens has fewer than five images.
    ///
    /// * `images`: images of the reconstruction
    /// * `monitor`: as of [`adjust_bundle`]
    ///
    /// # Errors
    /// [`Error::Canceled`]; the reconstruction is then unchanged.
    ///
    /// ```
    /// # use epipole::sfm::{Reconstruction, SfmImage};
    /// # fn refine(found: &mut Reconstruction, images: &[SfmImage]) -> Result<(), epipole::Error> {
    /// if found.refine_lenses(images, &mut ())? {
    ///     println!("mean error now: {:.2} px", found.mean_reprojection_px(images));
    /// }
    /// # Ok(()) }
    /// ```
    pub fn refine_lenses(
        &mut self,
        images: &[SfmImage],
        monitor: &mut dyn Monitor,
    ) -> Result<bool> {
        let (mut bundle, image_of_camera) = self.to_bundle(images);
        if !has_enough_of_each(&bundle) || bundle.observations.is_empty() {
            return Ok(false);
        }
        let priors = image_of_camera.iter().map(|image| images[*image].position);
        let fixed = BundleOptions {
            lm: LmOptions {
                max_iterations: 50,
                cost_tolerance: 1e-7,
                ..LmOptions::default()
            },
            loss: LOSS,
            position_priors: priors.filter(|_| self.is_placed).collect(),
            position_loss: RobustLoss::Cauchy { width: 2.0 },
            ..BundleOptions::default()
        };
        let free = BundleOptions {
            refine_focal: true,
            refine_distortion: true,
            ..fixed.clone()
        };
        // Adjust with fixed lenses first: the model may not have converged, and that gain is not
        // due to the lenses.
        let before = unless_degenerate(adjust_bundle(&mut bundle, &fixed, monitor))?;
        let after = unless_degenerate(adjust_bundle(&mut bundle, &free, monitor))?;
        let has_helped = (before.zip(after))
            .is_some_and(|(before, after)| after.final_cost < MAX_COST_RATIO * before.final_cost);
        if !has_helped {
            return Ok(false);
        }
        let mut refined = self.clone();
        for (image, camera) in image_of_camera.into_iter().zip(&bundle.cameras) {
            refined.cameras[image] = Some(*camera);
        }
        for (point, position) in refined.points.iter_mut().zip(&bundle.points) {
            point.position = *position;
        }
        if !refined.determines_focal(images)? {
            return Ok(false);
        }
        refined.finish_points(images);
        *self = refined;
        Ok(true)
    }
}

fn has_enough_of_each(bundle: &Bundle) -> bool {
    let mut counts = Vec::new();
    for lens in &bundle.lens_of_camera {
        counts.resize(counts.len().max(lens + 1), 0);
        counts[*lens] += 1;
    }
    counts.iter().all(|count| *count >= MIN_IMAGES_OF_LENS)
}

/// Converts any error except cancellation to `None`.
fn unless_degenerate<T>(found: Result<T>) -> Result<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Error::Canceled) => Err(Error::Canceled),
        Err(_) => Ok(None),
    }
}
