//! Cameras and points from all photographs.

use super::convert::{intrinsics, sfm_images};
use super::{
    Answer, CameraFound, Component, ImagePoints, PairOf, PointFound, Progress, Reconstructed,
    SfmOptions, Told,
};
use epipole::camera::PosedCamera;
use epipole::sfm::{PairMatches, Reconstruction, ScenePoint, SfmInput, SfmStep};
use std::cell::RefCell;

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
    let progress = RefCell::new(progress);
    let mut costs = Vec::new();
    let mut last = (0.3, String::new());
    let mut observer = |step: &SfmStep| {
        let (share, words) = match step {
            SfmStep::Verified { done, total } => (
                0.3 * *done as f32 / (*total).max(1) as f32,
                format!("{done} of {total} pairs checked"),
            ),
            SfmStep::Started { num_points, .. } => {
                (0.35, format!("started with two, {num_points} points"))
            }
            SfmStep::Registered {
                num_registered,
                num_points,
                ..
            } => (
                0.35 + 0.6 * *num_registered as f32 / images.len().max(1) as f32,
                format!("{num_registered} photographs, {num_points} points"),
            ),
            SfmStep::Adjusted { cost } => {
                costs.push(*cost);
                return std::ops::ControlFlow::Continue(());
            }
            // Within an adjustment there is nothing new to say, only to ask.
            SfmStep::Refined { .. } => last.clone(),
            SfmStep::Detected { .. } | SfmStep::Matched { .. } => {
                return std::ops::ControlFlow::Continue(());
            }
        };
        last = (share, words.clone());
        (progress.borrow_mut())(Told::Share(share, &words))
    };
    let mut watcher = |so_far: Reconstruction| {
        let answer = Answer::Reconstruction(Reconstructed {
            mean_error_px: vec![so_far.mean_reprojection_px(&input.images)],
            components: vec![component(&so_far)],
            costs: Vec::new(),
        });
        (progress.borrow_mut())(Told::SoFar(answer.to_bytes()))
    };
    let found = epipole::sfm::reconstruct_with(&input, &how, &mut observer, &mut watcher)
        .map_err(sentence)?;
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

fn component(found: &Reconstruction) -> Component {
    let camera = |camera: &PosedCamera| {
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
    // One lens took them all.
    let lens = found.lens(0);
    Component {
        cameras: (found.cameras.iter())
            .map(|c| c.as_ref().map(camera))
            .collect(),
        lens,
        points: found.points.iter().map(point).collect(),
    }
}
