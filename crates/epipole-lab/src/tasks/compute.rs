//! The one door through which everything that takes long is computed.

use super::{Answer, Progress, Request, features, matching, photograph, reconstruction, two_views};
use crate::export;

/// Carries out a request.
///
/// # Errors
/// A sentence for people.
pub fn compute(request: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, String> {
    let answer = match Request::from_bytes(request)? {
        Request::Photograph { source, max_pixels } => {
            Answer::Photograph(photograph::photograph(&source, max_pixels)?)
        }
        Request::Features {
            photograph,
            options,
        } => Answer::Features(features::features(&photograph, &options)?),
        Request::Matches {
            first,
            second,
            options,
        } => Answer::Matches(matching::matches(first, second, &options)?),
        Request::TwoViews {
            places,
            cameras,
            options,
        } => Answer::TwoViews(two_views::two_views(&places, &cameras, &options)?),
        Request::Reconstruction {
            images,
            pairs,
            options,
        } => Answer::Reconstruction(reconstruction::reconstruct(
            &images, &pairs, &options, progress,
        )?),
        Request::Export {
            images,
            photographs,
            found,
            component,
            meters_per_unit,
            options,
            features,
            matching,
        } => Answer::Archive(
            export::reconstruction(&export::Order {
                images: &images,
                photographs: &photographs,
                found: &found,
                component: component as usize,
                meters_per_unit,
                options,
                features,
                matching,
            })?
            .into(),
        ),
        Request::Save {
            photographs,
            project,
        } => Answer::Archive(export::save(&photographs, &project)?.into()),
        Request::Open { archive } => {
            let (project, files) = export::open(&archive)?;
            Answer::Opened { project, files }
        }
    };
    Ok(answer.to_bytes())
}
