//! Code that estimates cameras and points, photograph by photograph.

use super::convert::sentence;
use super::known_poses_run::triangulate;
use super::photograph::Calibrated;
use super::reconstruction::{
    Component, ImagePoints, PairOf, Reconstruct, Reconstructed, UnregisteredReason,
};
use super::task::{Monitor, Progress, Run, Task};
use epipole::camera::Camera;
use epipole::feature::Match;
use epipole::progress::Status;
use epipole::sfm::{
    IncrementalReconstruction, PairMatches, SfmInput, SfmStep, WhyUnregistered as Why,
    why_unregistered,
};

impl Run for Reconstruct {
    /// Reconstructs just as `epipole sfm` does, with an intermediate output after each photograph.
    fn run(self, monitor: Monitor<'_>) -> Result<Reconstructed, String> {
        let Self {
            images,
            pairs,
            options,
            poses,
        } = self;
        let plain = |pair: &PairOf| PairMatches {
            image1: pair.first as usize,
            image2: pair.second as usize,
            matches: (pair.matches.iter())
                .map(|&(first, second)| Match::new(first as usize, second as usize))
                .collect(),
        };
        let input = SfmInput {
            images: images.iter().map(ImagePoints::sfm_image).collect(),
            cameras: (images.iter())
                .map(|image| {
                    let Calibrated { width, height, .. } = image.camera;
                    Ok(Camera::pinhole(image.camera.intrinsics()?, width, height))
                })
                .collect::<Result<_, String>>()?,
            pairs: pairs.iter().map(plain).collect(),
        };
        let how = epipole::sfm::SfmOptions::default()
            .with_min_num_inliers(options.min_num_inliers as usize)
            .with_refine_focal(options.refine_focal)
            .with_refine_distortion(options.refine_distortion)
            .with_seed(options.seed);
        if !poses.is_empty() {
            return triangulate(&input, &poses, &how, monitor);
        }
        let mut share = 0.0;
        let mut run = IncrementalReconstruction::new(&input, &how, &mut |status: Status| {
            share = status.fraction;
            monitor(Progress::Share(share, status.stage.words()))
        })
        .map_err(sentence)?;
        let mut words = String::new();
        loop {
            // Within a step the stage does not change; the monitor is only asked whether to cancel.
            let step = run.step(&mut |status: Status| {
                share = status.fraction;
                monitor(Progress::Share(share, &words))
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
            let partial = Reconstructed {
                mean_error_px: vec![so_far.mean_reprojection_px(&input.images)],
                components: vec![Component::from_core(&so_far)],
                ..Reconstructed::default()
            };
            if monitor(Progress::Share(share, &words)).is_break()
                || monitor(Progress::Partial(Self::write(&partial))).is_break()
            {
                return Err("stopped".to_owned());
            }
        }
        let mut found = run.finish();
        let mut before_correction_px = vec![None; found.components.len()];
        if options.correct_lens {
            for (component, before) in found.components.iter_mut().zip(&mut before_correction_px) {
                let mean_px = component.mean_reprojection_px(&input.images);
                let mut watch = |_: Status| monitor(Progress::Share(share, "correcting the lens"));
                let has_helped = component.refine_lenses(&input.images, &mut watch);
                *before = has_helped.map_err(sentence)?.then_some(mean_px);
            }
        }
        let mut watch =
            |_: Status| monitor(Progress::Share(share, "finding the reasons of the rest"));
        let why = why_unregistered(&input, &how, &found, &mut watch).map_err(sentence)?;
        let mut reasons = vec![None; images.len()];
        for (image, why) in found.unregistered.iter().zip(&why) {
            reasons[*image] = Some(reason(why));
        }
        let mean_error_px = (found.components.iter())
            .map(|component| component.mean_reprojection_px(&input.images))
            .collect();
        let determines_focal = (found.components.iter())
            .zip(&before_correction_px)
            .map(
                |(component, before)| match options.refine_focal || before.is_some() {
                    true => component.determines_focal(&input.images),
                    false => Ok(true),
                },
            )
            .collect::<Result<_, _>>()
            .map_err(sentence)?;
        Ok(Reconstructed {
            determines_focal,
            before_correction_px,
            components: found.components.iter().map(Component::from_core).collect(),
            costs: found.steps.iter().filter_map(SfmStep::cost).collect(),
            mean_error_px,
            reasons,
        })
    }
}

fn reason(why: &Why) -> UnregisteredReason {
    match *why {
        Why::FewFeatures { num_keypoints, .. } => {
            UnregisteredReason::FewFeatures(num_keypoints as u32)
        }
        Why::FewMatches { .. } | Why::NoMotion => UnregisteredReason::NoOverlap,
        Why::NoBaseline => UnregisteredReason::NoBaseline,
        Why::FewPoints { visible, .. } => UnregisteredReason::FewPoints(visible as u32),
        Why::NoPose { visible } => UnregisteredReason::NoPose(visible as u32),
        // Only cancellation ends a task early, so `NotTried` does not occur.
        _ => UnregisteredReason::NoStart,
    }
}
