//! Cameras that only rotated or hardly moved, for which E and F are meaningless.

use crate::failure::Failure;
use epipole::camera::Camera;
use epipole::robust::{LineEstimator, RansacOptions};
use epipole::two_view::{
    Degeneracy, ExplainingRotation, TwoViewOptions, find_degeneracy, find_explaining_rotation,
    find_rotation_and_focal, find_unmoved,
};
use nalgebra::Point2;

/// Finds a rotation that explains the inliers of another model equally well, if there is one.
///
/// * `ransac`: options of the search for that model
pub(crate) fn find_rotation_only(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    inliers: &[bool],
    ransac: &RansacOptions,
) -> epipole::Result<Option<ExplainingRotation>> {
    find_explaining_rotation(pixels1, pixels2, cameras, inliers, &judging(ransac))
}

/// Returns a warning about a rotation that explains the inliers.
pub(crate) fn sentence(rotation: &ExplainingRotation) -> String {
    format!(
        "a pure rotation explains {} of the {} inliers: whether and in which direction the camera \
         moved cannot be determined",
        rotation.num_explained, rotation.num_inliers
    )
}

/// Returns a warning if the inliers of a homography fit a rotation with another focal length
/// equally well.
///
/// * `cameras`: known or guessed
/// * `inliers`: those of the homography
pub(crate) fn sentence_of_other_focal(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    inliers: &[bool],
    options: &TwoViewOptions,
) -> epipole::Result<Option<String>> {
    let rotation = find_rotation_and_focal(pixels1, pixels2, cameras, inliers, options)?;
    Ok(rotation.map(|rotation| {
        format!(
            "a pure rotation by {:.1}° with a focal length near {:.0} px also explains {} of the {} inliers: \
             then there is no plane, and no depth",
            rotation.cam2_from_cam1.rotation.angle().to_degrees(),
            rotation.focal_factor * cameras[0].intrinsics.fu_px(),
            rotation.num_explained,
            rotation.num_inliers
        )
    }))
}

/// Returns a warning if the inliers do not determine F, such as those of a plane or a rotation.
pub(crate) fn left_open(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
    ransac: &RansacOptions,
) -> epipole::Result<Option<String>> {
    let found = find_degeneracy(pixels1, pixels2, inliers, &judging(ransac))?;
    Ok(found.map(|found| sentence_of_degeneracy(&found)))
}

/// Returns a warning if the inliers are on a line, which does not determine a homography.
pub(crate) fn left_open_by_homography(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    inliers: &[bool],
    ransac: &RansacOptions,
) -> epipole::Result<Option<String>> {
    if let Some(found) = find_unmoved(pixels1, pixels2, inliers, &judging(ransac))? {
        return Ok(Some(sentence_of_degeneracy(&found)));
    }
    for (image, pixels) in [(1, pixels1), (2, pixels2)] {
        let inlier_pixels = pixels.iter().zip(inliers).filter(|(_, fits)| **fits);
        let inlier_pixels: Vec<Point2<f64>> = inlier_pixels.map(|(pixel, _)| *pixel).collect();
        if let Some(num_collinear) = num_on_one_line(&inlier_pixels, ransac) {
            return Ok(Some(format!(
                "{num_collinear} of the {} inliers are collinear in image {image}, within the noise: beside their line the homography is \
                 not determined",
                inlier_pixels.len()
            )));
        }
    }
    Ok(None)
}

/// Returns the number of pixels on one line, if too few others constrain the model. A homography
/// fits any two others, with any mapping on the line.
fn num_on_one_line(pixels: &[Point2<f64>], ransac: &RansacOptions) -> Option<usize> {
    const OTHERS: usize = 2;
    /// Fewer lie on a line by chance.
    const LEAST: usize = 5;
    // If all but two lie on a line, nearly every sample finds it.
    let options = ransac
        .within(2.0 * ransac.max_error_px)
        .with_max_iterations(ransac.max_iterations.min(1000));
    // Identical pixels define no line and need no further warning.
    let lines = LineEstimator::new(pixels).ok()?;
    let found = epipole::robust::ransac(lines, &options, &mut ()).ok()?;
    let has_too_few_others =
        found.num_inliers >= LEAST && found.num_inliers + OTHERS >= pixels.len();
    has_too_few_others.then_some(found.num_inliers)
}

/// Adds the reason to a failure with known gravity: three matches that did not move define no
/// model.
pub(crate) fn if_unmoved(
    failure: Failure,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    options: &RansacOptions,
) -> Failure {
    let all = vec![true; pixels1.len()];
    match find_unmoved(pixels1, pixels2, &all, &judging(options)) {
        Ok(Some(open)) if failure.kind == "no-consensus" => Failure {
            message: format!("{failure}: {}", sentence_of_degeneracy(&open)),
            ..failure
        },
        _ => failure,
    }
}

/// * `ransac`: options of the search for the model
fn judging(ransac: &RansacOptions) -> TwoViewOptions {
    TwoViewOptions::default().with_ransac(*ransac)
}

fn sentence_of_degeneracy(found: &Degeneracy) -> String {
    match found {
        Degeneracy::Unmoved {
            num_unmoved,
            num_inliers,
        } => format!(
            "{num_unmoved} of the {num_inliers} inliers are at the same pixels in both images, within the noise: the \
             camera hardly moved, or the matches are on an object that moves with it"
        ),
        Degeneracy::Homography {
            num_explained,
            num_inliers,
        } => format!(
            "a homography explains {num_explained} of the {num_inliers} inliers: they show a plane, or the camera \
             only rotated, and the fundamental matrix is not determined"
        ),
    }
}
