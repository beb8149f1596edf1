//! Cameras and points from all photographs, and the way between plain messages and the core.

use super::two_views::intrinsics;
use super::{
    CameraFound, Component, ImagePoints, PairOf, PointFound, Progress, Reconstructed, SfmOptions,
};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::sfm::{
    PairMatches, RadialDistortion, Reconstruction, ScenePoint, SfmImage, SfmInput, SfmProgress,
    TrackElement,
};
use nalgebra::{Point2, Point3, Quaternion, Translation3, UnitQuaternion};

/// Reconstructs just as `epipole sfm` does.
///
/// # Errors
/// As [`epipole::sfm::reconstruct`], and if `progress` wants no more.
pub(super) fn reconstruct(
    images: &[ImagePoints],
    pairs: &[PairOf],
    options: &SfmOptions,
    progress: Progress<'_>,
) -> Result<Reconstructed, String> {
    let sentence = |error: epipole::Error| error.to_string();
    let plain = |pair: &PairOf| PairMatches {
        image1: pair.first as usize,
        image2: pair.second as usize,
        matches: pair.matches.clone(),
    };
    let input = SfmInput {
        images: sfm_images(images),
        intrinsics: (images.iter())
            .map(|image| intrinsics(&image.camera))
            .collect::<Result<_, _>>()?,
        pairs: pairs.iter().map(plain).collect(),
    };
    let how = epipole::sfm::SfmOptions {
        min_num_inliers: options.min_num_inliers as usize,
        refine_focal: options.refine_focal,
        refine_distortion: options.refine_distortion,
        seed: options.seed,
        ..epipole::sfm::SfmOptions::default()
    };
    let mut costs = Vec::new();
    let mut observer = |step: &SfmProgress| {
        let (share, words) = match step {
            SfmProgress::Verified { done, total } => (
                0.3 * *done as f32 / (*total).max(1) as f32,
                format!("{done} of {total} pairs checked"),
            ),
            SfmProgress::Started { num_points, .. } => {
                (0.35, format!("started with two, {num_points} points"))
            }
            SfmProgress::Registered {
                num_registered,
                num_points,
                ..
            } => (
                0.35 + 0.6 * *num_registered as f32 / images.len().max(1) as f32,
                format!("{num_registered} photographs, {num_points} points"),
            ),
            SfmProgress::Adjusted { cost } => {
                costs.push(*cost);
                return std::ops::ControlFlow::Continue(());
            }
            SfmProgress::Detected { .. } | SfmProgress::Matched { .. } => {
                return std::ops::ControlFlow::Continue(());
            }
        };
        progress(share, &words)
    };
    let found = epipole::sfm::reconstruct(&input, &how, &mut observer).map_err(sentence)?;
    if found.canceled {
        return Err("stopped".to_owned());
    }
    let mean_error_px = (found.components.iter())
        .map(|component| component.mean_reprojection_px(&input.images))
        .collect();
    Ok(Reconstructed {
        components: found.components.iter().map(component).collect(),
        costs,
        mean_error_px,
    })
}

/// The photographs as the core has them.
pub(crate) fn sfm_images(images: &[ImagePoints]) -> Vec<SfmImage> {
    let plain = |image: &ImagePoints| SfmImage {
        name: image.name.clone(),
        width: image.camera.width,
        height: image.camera.height,
        keypoints: image
            .points
            .iter()
            .map(|p| Point2::new(p[0], p[1]))
            .collect(),
        colors: image.colors.clone(),
    };
    images.iter().map(plain).collect()
}

fn component(found: &Reconstruction) -> Component {
    let camera = |camera: &Camera| {
        let (k, center) = (camera.intrinsics, camera.intrinsics.principal_point());
        CameraFound {
            intrinsics: [k.fu_px(), k.fv_px(), center.x, center.y],
            rotation: camera.cam_from_world.rotation.coords.into(),
            translation: camera.cam_from_world.translation.vector.into(),
        }
    };
    let point = |point: &ScenePoint| PointFound {
        position: point.position.coords.into(),
        color: point.color,
        track: point.track.iter().map(|e| (e.image, e.keypoint)).collect(),
        error_px: point.error_px,
    };
    Component {
        cameras: (found.cameras.iter())
            .map(|c| c.as_ref().map(camera))
            .collect(),
        distortion: [found.distortion.k1, found.distortion.k2],
        points: found.points.iter().map(point).collect(),
    }
}

/// A camera as the core has it, the same to the last bit.
///
/// # Errors
/// A sentence, if its numbers are no camera's.
pub(crate) fn core_camera(camera: &CameraFound) -> Result<Camera, String> {
    let [fu, fv, cu, cv] = camera.intrinsics;
    let [i, j, k, w] = camera.rotation;
    let [x, y, z] = camera.translation;
    Ok(Camera {
        intrinsics: Intrinsics::new(fu, fv, cu, cv).map_err(|error| error.to_string())?,
        cam_from_world: RigidTransform::from_parts(
            Translation3::new(x, y, z),
            UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
        ),
    })
}

/// A component as the core has it.
///
/// # Errors
/// As [`core_camera`].
pub(crate) fn core_reconstruction(component: &Component) -> Result<Reconstruction, String> {
    let camera = |camera: &Option<CameraFound>| camera.as_ref().map(core_camera).transpose();
    let element = |&(image, keypoint): &(u32, u32)| TrackElement { image, keypoint };
    let point = |point: &PointFound| ScenePoint {
        position: Point3::from(point.position),
        color: point.color,
        track: point.track.iter().map(element).collect(),
        error_px: point.error_px,
    };
    let [k1, k2] = component.distortion;
    Ok(Reconstruction {
        cameras: component
            .cameras
            .iter()
            .map(camera)
            .collect::<Result<_, _>>()?,
        distortion: RadialDistortion { k1, k2 },
        points: component.points.iter().map(point).collect(),
    })
}
