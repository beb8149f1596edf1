//! `epipole sfm`: cameras and points from photos.

mod arguments;
pub(crate) mod growth;
mod input;
mod known_poses;
mod output;
pub(crate) mod positions;
pub(crate) mod refined;

pub(crate) use self::arguments::Arguments;

use self::output::{LeftOut, Pictures, check_models, component_folder, images_json, write_model};
use self::positions::rms_m;
use crate::camera::{sentence, some_unknown};
use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::report::Report;
use epipole::camera::Camera;
use epipole::progress::{Monitor, Part};
use epipole::sfm::{
    IncrementalReconstruction, SfmInput, SfmOptions, SfmResult, WhyUnregistered, match_photos,
    why_unregistered,
};
use serde_json::json;

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let mut output = OutputFolder::new(&arguments.output, "sfm");
    check_models(&output)?;
    if let Some(model) = &arguments.input.poses {
        return known_poses::run(arguments, model, output, context);
    }
    let input::Input {
        mut photos,
        cameras,
        lenses,
        places,
        guesses,
        used,
    } = arguments.input.read(context)?;
    let pictures = match arguments.images {
        true => Some(Pictures::within(&arguments.output, &used)?),
        false => None,
    };
    let positions = arguments.positions.give(&mut photos, &places)?;
    (arguments.growth).number_lenses(&mut photos, &cameras, &lenses);
    (arguments.growth.refined).warn_of_nothing_to_refine(&cameras, context);
    let options = (arguments.growth).options(&arguments.robust, context, some_unknown(&guesses));
    let refine_focal = options.refine_focal;
    if let Some(sentence) = sentence(&guesses) {
        let then = if refine_focal { ", to be refined" } else { "" };
        context.warn(&format!("{sentence}{then}"));
    }
    let photo_options = arguments.photo_options(&options);
    let progress = Progress::new(context, "structure from motion");
    let watch = &mut |status| progress.show(status);
    let (images, pairs) =
        match_photos(&photos, &photo_options, &mut Part::new(watch, 0.0, MATCHED))?;
    let mut input = SfmInput {
        images,
        cameras,
        pairs,
    };
    let mut result = reconstruct(&input, &options, &mut Part::new(watch, MATCHED, REFINED))?;
    let all_unknown = guesses.len() == photos.len();
    let mut errors_before_px = vec![None; result.components.len()];
    if (arguments.growth.refined).corrects_lenses(all_unknown) && result.is_complete {
        for (component, before) in result.components.iter_mut().zip(&mut errors_before_px) {
            let mean_px = component.mean_reprojection_px(&input.images);
            let watch = &mut Part::new(watch, REFINED, 1.0);
            match component.refine_lenses(&input.images, watch) {
                Ok(has_helped) => *before = has_helped.then_some(mean_px),
                Err(epipole::Error::Canceled) => {
                    result.is_complete = false;
                    break;
                }
                Err(error) => return Err(error.into()),
            }
        }
    }
    drop(progress);
    let Some(largest) = result.components.first() else {
        if !result.is_complete {
            return Err(epipole::Error::Canceled.into());
        }
        return Err(no_start(&input, &options, &result)?);
    };
    if !result.is_complete {
        context.warn(interrupt::ENDED_EARLY);
    }
    let unregistered = explain_unregistered(&input, &options, &result)?;
    let mean_px = largest.mean_reprojection_px(&input.images);
    let registered = images_json(&input.images, largest);
    if let Some(pictures) = &pictures {
        pictures.write(&photos, &mut output)?;
        for (image, name) in input.images.iter_mut().zip(&pictures.names) {
            image.name.clone_from(name);
        }
    }
    let mut written = write_model(&mut output, "", largest, &input.images)?;
    for (index, component) in result.components.iter().enumerate().skip(1) {
        let folder = component_folder(index + 1);
        written.extend(write_model(&mut output, &folder, component, &input.images)?);
    }
    output.finish_anew()?;
    let components: Vec<serde_json::Value> = result
        .components
        .iter()
        .map(|c| json!({ "num_registered": c.num_registered(), "num_points": c.points.len() }))
        .collect();
    let registered_count = largest.num_registered();
    let focals: Vec<(f64, f64)> = (input.cameras.iter().zip(&largest.cameras))
        .filter_map(|(initial, found)| {
            let focal_px = |camera: &Camera| camera.intrinsics.fu_px();
            Some((focal_px(initial), focal_px(&found.as_ref()?.camera)))
        })
        .collect();
    let mut report = Report::default();
    if positions.num_known > 0 && !largest.is_placed {
        context.warn(&format!(
            "the positions of {} images do not determine the frame of the result: three registered images that \
             are not collinear are needed",
            positions.num_known
        ));
    }
    if let Some(rms_m) = rms_m(largest, &photos) {
        report = report.row(
            "off known positions",
            format!("{rms_m:.3} m (root mean square)"),
        );
    }
    if positions.num_known > 0 {
        for (name, value) in positions.fields(largest, &photos) {
            report = report.field(name, value);
        }
    }
    let lens_refined = errors_before_px[0].is_some();
    let refine_focal = refine_focal || lens_refined;
    let focal_determined = match refine_focal {
        true => Some(largest.determines_focal(&input.images)?),
        false => None,
    };
    if let (true, Some((from, to))) = (refine_focal, focals.first()) {
        if focal_determined == Some(false) {
            context.warn(&format!(
                "these images do not determine the focal length: {to:.0} px may be far off, and so may all depths. Give \
                 --focal-px or --camera, or add images from other sides (cameras that move along a line without \
                 rotation fit any focal length)"
            ));
        }
        let sure = match focal_determined {
            Some(false) => "not determined: ",
            _ => "",
        };
        // One factor for all photos of this lens.
        report = report.row(
            "focal length",
            format!(
                "{sure}{to:.1} px, refined from {from:.1} ({:.3} times)",
                to / from
            ),
        );
    }
    if let Some(before_px) = errors_before_px[0] {
        report = report.row(
            "lens corrected",
            format!("mean reprojection error {before_px:.3} px before, {mean_px:.3} px now"),
        );
    }
    for left_out in &unregistered {
        report = report.row(&format!("without {}", left_out.name), &left_out.reason);
    }
    Ok(report
        .field("focal_refined", refine_focal)
        .field("focal_determined", focal_determined)
        .field("lens_refined", lens_refined)
        .field("num_registered", registered_count)
        .field("num_images", photos.len())
        .field("num_points", largest.points.len())
        .field("mean_reprojection_px", mean_px)
        .field("images", registered)
        .field("unregistered", &unregistered)
        .field("components", components)
        .field("complete", result.is_complete)
        .row(
            "registered",
            format!("{registered_count} of {}", photos.len()),
        )
        .row("points", largest.points.len())
        .row("mean reprojection error", format!("{mean_px:.3} px"))
        .row("components", result.components.len())
        .row("written", written.join(", ")))
}

/// Fractions of the work after which all photos are matched, and registered.
const MATCHED: f32 = 0.6;
const REFINED: f32 = 0.95;

/// Reconstructs; Ctrl-C ends with the result so far.
fn reconstruct(
    input: &SfmInput,
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<SfmResult, epipole::Error> {
    let mut run = IncrementalReconstruction::new(input, options, monitor)?;
    loop {
        match run.step(monitor) {
            Ok(Some(_)) => {}
            Ok(None) | Err(epipole::Error::Canceled) => return Ok(run.finish()),
            Err(error) => return Err(error),
        }
    }
}

/// Explains an empty result, by the photo that came farthest.
fn no_start(
    input: &SfmInput,
    options: &SfmOptions,
    result: &SfmResult,
) -> Result<Failure, Failure> {
    let reasons = why_unregistered(input, options, result, &mut ())?;
    let begins = |why: &WhyUnregistered| {
        matches!(why, WhyUnregistered::NoBaseline | WhyUnregistered::NoStart)
    };
    let farthest = reasons.iter().position(begins);
    let what = match farthest {
        Some(_) => "no two images can start a reconstruction",
        None => "no two images overlap enough",
    };
    let place = farthest.unwrap_or(0);
    let reason = (result.unregistered.get(place).zip(reasons.get(place)))
        .map(|(image, why)| format!("; {}: {why}", input.images[*image].name));
    let message = format!("{what}{}", reason.unwrap_or_default());
    Ok(Failure::new("no-consensus", message))
}

fn explain_unregistered(
    input: &SfmInput,
    options: &SfmOptions,
    result: &SfmResult,
) -> Result<Vec<LeftOut>, Failure> {
    let reasons = why_unregistered(input, options, result, &mut ())?;
    let mut left_out: Vec<(usize, String)> = result
        .unregistered
        .iter()
        .zip(reasons)
        .map(|(image, why)| (*image, why.to_string()))
        .collect();
    for (index, component) in result.components.iter().enumerate().skip(1) {
        for (image, camera) in component.cameras.iter().enumerate() {
            if camera.is_some() {
                let number = index + 1;
                let reason = format!(
                    "it is in component {number}, which shares too few points with the largest one"
                );
                left_out.push((image, reason));
            }
        }
    }
    left_out.sort_by_key(|(image, _)| *image);
    let named = left_out.into_iter().map(|(image, reason)| LeftOut {
        name: input.images[image].name.clone(),
        reason,
    });
    Ok(named.collect())
}
