//! Texture of the surface of all views from the photographs.

use super::contents::Export;
use crate::tasks::convert::sentence;
use crate::tasks::task::{Monitor, Progress};
use epipole::Error;
use epipole::mvs::{Mesh, MeshTexture, MvsOptions, TextureOptions, prepare_views, texture_mesh};
use epipole::progress::{Part, Status};
use epipole::sfm::Reconstruction;
use image::RgbImage;

/// Maximum longer side of a photograph, pixels, and of the texture: what browsers show anywhere.
const MAX_PHOTO_PX: u32 = 2048;
const MAX_TEXTURE_PX: u32 = 4096;
/// Progress when the photographs are prepared.
const PREPARED: f32 = 0.2;

/// Whether the format of the surface has a texture, and there is a surface.
pub(super) fn is_needed(export: &Export, surface: &Mesh) -> bool {
    export.format.has_texture() && !surface.triangles.is_empty()
}

/// Textures the surface; `None` if no photographs show the same points.
///
/// * `model`, `surface`: in the frame of the files
/// * `photos`: one for each image of the model, with the size of its camera
///
/// # Errors
/// A message for cancellation and for photographs of another size.
pub(super) fn texture(
    model: &Reconstruction,
    surface: &Mesh,
    photos: &[RgbImage],
    monitor: Monitor<'_>,
) -> Result<Option<MeshTexture>, String> {
    let mut watch = |status: Status| monitor(Progress::Share(status.fraction, "texturing"));
    let options = MvsOptions::default().with_max_size_px(MAX_PHOTO_PX);
    let part = &mut Part::new(&mut watch, 0.0, PREPARED);
    let views = match prepare_views(model, photos, &options, part) {
        Err(Error::Degenerate { .. } | Error::TooFew { .. }) => return Ok(None),
        views => views.map_err(sentence)?,
    };
    let options = TextureOptions::default().with_max_size_px(MAX_TEXTURE_PX);
    let part = &mut Part::new(&mut watch, PREPARED, 1.0);
    let texture = texture_mesh(surface, &views, &options, part).map_err(sentence)?;
    Ok(Some(texture))
}
