//! Places of photos in a panorama.

use super::arguments::{Arguments, Model};
use super::input::Input;
use crate::context::Context;
use crate::failure::Failure;
use crate::progress::Progress;
use epipole::stitch::{Overlap, Panorama, chain_homographies, estimate_panorama};

/// Places the photos, and reports the focal length.
///
/// # Errors
/// As [`estimate_panorama`].
pub(super) fn photos(
    arguments: &Arguments,
    input: &Input,
    overlaps: &[Overlap],
    context: &Context,
) -> Result<Panorama, Failure> {
    if arguments.model == Model::Homography {
        return Ok(chain_homographies(input.photos.len(), overlaps)?);
    }
    let progress = Progress::new(context, "rotations");
    let watch = &mut |status| progress.show(status);
    let find_focal = !input.is_known;
    let panorama = estimate_panorama(&input.intrinsics, overlaps, find_focal, watch)?;
    drop(progress);
    if find_focal && panorama.focal_factor.is_none() {
        context.warn(&format!(
            "the matches do not determine the focal length: {:.0} px is a guess; give --focal-px or --k",
            panorama.scale_px
        ));
    }
    Ok(panorama)
}
