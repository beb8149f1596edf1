//! Sizes of images that a model names, where its file has none.

use super::Beside;

/// Width and height of an image, if its file is there; its name may lack the ending.
#[cfg(feature = "photos")]
pub(super) fn image_size(name: &str, beside: &Beside<'_>) -> Option<(u32, u32)> {
    let name = name.trim_start_matches("./");
    let endings = ["", ".png", ".jpg", ".jpeg"];
    let bytes = endings
        .iter()
        .find_map(|ending| beside(&format!("{name}{ending}")))?;
    crate::photo::sensor_size(&bytes).ok()
}

/// Without the reader of photographs.
#[cfg(not(feature = "photos"))]
pub(super) fn image_size(_: &str, _: &Beside<'_>) -> Option<(u32, u32)> {
    None
}
