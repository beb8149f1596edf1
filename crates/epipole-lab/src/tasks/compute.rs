//! The one door through which everything that takes long is computed.

use super::{Answer, Branch, Progress, Request};

/// Carries out a request.
///
/// # Errors
/// A sentence for people; also if the code for it is in the other module of the Lab.
pub fn compute(request: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, String> {
    let request = Request::from_bytes(request)?;
    let answer = match request.branch() {
        Branch::Vision => vision(request, progress)?,
        Branch::Files => files(request, progress)?,
    };
    Ok(answer.to_bytes())
}

/// For a request that came to a module without the code for it, which is a fault of whoever asked.
const ELSEWHERE: &str = "this computation belongs to the other module of the Lab";

#[cfg(not(feature = "vision"))]
fn vision(_request: Request, _progress: Progress<'_>) -> Result<Answer, String> {
    Err(ELSEWHERE.to_owned())
}

#[cfg(feature = "vision")]
fn vision(request: Request, progress: Progress<'_>) -> Result<Answer, String> {
    use super::{calibration, depth, features, matching, reconstruction, two_views};
    Ok(match request {
        Request::Features {
            photograph,
            options,
        } => Answer::Features(features::features(&photograph, &options, progress)?),
        Request::Matches {
            first,
            second,
            options,
        } => Answer::Matches(matching::matches(first, second, &options, progress)?),
        Request::TwoViews {
            places,
            ratios,
            cameras,
            options,
        } => Answer::TwoViews(two_views::two_views(
            &places, &ratios, &cameras, &options, progress,
        )?),
        Request::Reconstruction {
            images,
            pairs,
            options,
        } => Answer::Reconstruction(reconstruction::reconstruct(
            &images, &pairs, &options, progress,
        )?),
        Request::Depth {
            photographs,
            cameras,
            lens,
            points,
            options,
        } => {
            let pair = depth::Pair {
                photographs: &photographs,
                cameras: &cameras,
                lens,
                points: &points,
            };
            Answer::Depth(depth::depth(&pair, &options, progress)?)
        }
        Request::Calibration {
            options,
            size,
            views,
        } => Answer::Calibration(calibration::calibration(&options, size, &views, progress)?),
        _ => return Err(ELSEWHERE.to_owned()),
    })
}

#[cfg(not(feature = "files"))]
fn files(_request: Request, _progress: Progress<'_>) -> Result<Answer, String> {
    Err(ELSEWHERE.to_owned())
}

#[cfg(feature = "files")]
fn files(request: Request, progress: Progress<'_>) -> Result<Answer, String> {
    use super::{board, frames, photograph};
    use crate::export;
    use std::cell::RefCell;
    Ok(match request {
        Request::Photograph {
            source,
            max_pixels,
            camera,
        } => Answer::Photograph(photograph::photograph(
            &source,
            max_pixels,
            camera.as_ref(),
            progress,
        )?),
        Request::Board { source, options } => {
            Answer::Board(board::board(&source, &options, progress)?)
        }
        Request::Frames { name, part, frames } => {
            Answer::Frames(frames::sharpest(&name, part, frames, progress)?)
        }
        Request::Picture { width, rgba } => Answer::Archive(export::picture(width, &rgba)?.into()),
        Request::Export {
            images,
            photographs,
            found,
            component,
            meters_per_unit,
            focal_refined,
            left_out,
            recipe,
            max_pixels,
            camera,
            dense,
        } => {
            // Each of them asks in turn whether somebody still waits for the archive.
            let progress = RefCell::new(progress);
            let order = export::Order {
                images: &images,
                photographs: &photographs,
                found: &found,
                component: component as usize,
                meters_per_unit,
                focal_refined,
                left_out: &left_out,
                recipe: &recipe,
                read: &|source| {
                    let mut progress = progress.borrow_mut();
                    photograph::photograph(source, max_pixels, camera.as_ref(), &mut **progress)
                },
                dense: &dense,
            };
            Answer::Archive(export::reconstruction(&order)?.into())
        }
        Request::Save {
            photographs,
            project,
            computed,
        } => Answer::Archive(export::save(&photographs, &project, &computed)?.into()),
        Request::Open { archive } => {
            let (project, files, computed) = export::open(&archive)?;
            Answer::Opened {
                project,
                files,
                computed,
            }
        }
        _ => return Err(ELSEWHERE.to_owned()),
    })
}
