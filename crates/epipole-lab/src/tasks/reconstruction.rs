//! Cameras and points from all photographs.

use super::convert::{intrinsics, sentence, sfm_images};
use super::{
    Answer, Calibrated, CameraFound, Component, ImagePoints, PairOf, PointFound, Progress,
    Reconstructed, SfmOptions, Told,
};
use epipole::camera::{Camera, Lens, PosedCamera};
use epipole::feature::Match;
use epipole::progress::Status;
use epipole::sfm::{
    IncrementalReconstruction, PairMatches, Reconstruction, ScenePoint, SfmInput, SfmStep,
};

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
    let plain = |pair: &PairOf| PairMatches {
        image1: pair.first as usize,
        image2: pair.second as usize,
        matches: (pair.matches.iter())
            .map(|&(first, second)| Match::new(first as usize, second as usize))
            .collect(),
    };
    let input = SfmInput {
        images: sfm_images(images),
        cameras: (images.iter())
            .map(|image| {
                let Calibrated { width, height, .. } = image.camera;
                Ok(Camera::pinhole(intrinsics(&image.camera)?, width, height))
            })
            .collect::<Result<_, String>>()?,
        pairs: pairs.iter().map(plain).collect(),
    };
    let how = epipole::sfm::SfmOptions::default()
        .with_min_num_inliers(options.min_num_inliers as usize)
        .with_refine_focal(options.refine_focal)
        .with_refine_distortion(options.refine_distortion)
        .with_seed(options.seed);
    let mut share = 0.0;
    let mut run = IncrementalReconstruction::new(&input, &how, &mut |status: Status| {
        share = status.share;
        progress(Told::Share(share, status.stage.words()))
    })
    .map_err(sentence)?;
    let mut words = String::new();
    loop {
        // Within a step there is nothing new to say, only to ask.
        let step = run.step(&mut |status: Status| {
            share = status.share;
            progress(Told::Share(share, &words))
        });
        words = match step.map_err(sentence)? {
            None => break,
            Some(SfmStep::Started { num_points, .. }) => {
                format!("started with two, {num_points} points")
            }
            Some(SfmStep::Registered {
                num_registered,
                num_points,
                ..
            }) => format!("{num_registered} photographs, {num_points} points"),
            Some(_) => continue,
        };
        let so_far = run.current().unwrap_or_default();
        let answer = Answer::Reconstruction(Reconstructed {
            mean_error_px: vec![so_far.mean_reprojection_px(&input.images)],
            components: vec![component(&so_far)],
            costs: Vec::new(),
        });
        if progress(Told::Share(share, &words)).is_break()
            || progress(Told::SoFar(answer.to_bytes())).is_break()
        {
            return Err("stopped".to_owned());
        }
    }
    let found = run.finish();
    let mean_error_px = (found.components.iter())
        .map(|component| component.mean_reprojection_px(&input.images))
        .collect();
    Ok(Reconstructed {
        components: found.components.iter().map(component).collect(),
        costs: found.steps.iter().filter_map(SfmStep::cost).collect(),
        mean_error_px,
    })
}

fn component(found: &Reconstruction) -> Component {
    let camera = |camera: &PosedCamera| {
        let (k, center) = (
            camera.camera.intrinsics,
            camera.camera.intrinsics.principal_point(),
        );
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
    let lens = (found.cameras.iter().flatten().next()).map_or(Lens::NONE, |c| c.camera.lens);
    Component {
        cameras: (found.cameras.iter())
            .map(|c| c.as_ref().map(camera))
            .collect(),
        lens,
        points: found.points.iter().map(point).collect(),
    }
}
