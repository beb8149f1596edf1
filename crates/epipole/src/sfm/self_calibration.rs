//! Self-calibration: focal lengths and radial distortion from the reconstruction itself.

use super::bundle::{Bundle, BundleOptions, adjust_bundle, focal_sensitivity};
use super::reconstruction::{LOSS, Reconstruction, SfmImage};
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Least relative increase of the cost by a wrong focal length. Errors that repeat from photograph
/// to photograph, such as those of the lens, move the minimum of anything flatter.
const MIN_FOCAL_RISE: f64 = 0.02;

/// Minimum number of photographs of a lens that is corrected.
const MIN_IMAGES_OF_LENS: usize = 5;

/// The lenses are corrected if that lowers the cost to this share at least. The cost is of second
/// order in the error: a share of 0.9 is an error of 5 %.
const MAX_COST_SHARE: f64 = 0.9;

impl Reconstruction {
    /// Whether the observations determine the focal length of every lens: a change by 20 %, with
    /// cameras and points refined again, would raise the cost by at least 2 %. The focal lengths of
    /// a camera that moves along a straight line without turning, or only sees one plane head on,
    /// are arbitrary, and with them the depth of the scene. Assumes a refined model.
    ///
    /// * `images`: the photographs of the reconstruction
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
    /// lowers the robust cost by at least a tenth and the photographs
    /// [determine](Self::determines_focal) the focal lengths. Returns whether it did; otherwise the
    /// reconstruction is unchanged, as it is where a lens has fewer than five photographs.
    ///
    /// * `images`: the photographs of the reconstruction
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
        // The model may have been refined less far than this, which is no merit of the lens.
        let before = unless_degenerate(adjust_bundle(&mut bundle, &fixed, monitor))?;
        let after = unless_degenerate(adjust_bundle(&mut bundle, &free, monitor))?;
        let has_helped = (before.zip(after))
            .is_some_and(|(before, after)| after.final_cost < MAX_COST_SHARE * before.final_cost);
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

/// `None` for any failure but a cancellation.
fn unless_degenerate<T>(found: Result<T>) -> Result<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Error::Canceled) => Err(Error::Canceled),
        Err(_) => Ok(None),
    }
}
