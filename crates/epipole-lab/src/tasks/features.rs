//! Features of a photograph.

use super::{Described, Feature, FeatureKind, FeatureOptions, Features, Photograph};
use epipole::feature::SiftNormalization;
use epipole::sfm::{Photo, PhotoOptions, photo_features};
use image::RgbImage;

/// Finds features just as `epipole sfm` does.
///
/// # Errors
/// As [`photo_features`].
pub(super) fn features(
    photograph: &Photograph,
    options: &FeatureOptions,
) -> Result<Features, String> {
    let photo = Photo {
        name: String::new(),
        image: to_image(photograph)?,
    };
    let mut how = PhotoOptions::default();
    how.sift.max_features = options.max_features as usize;
    how.sift.contrast_threshold = options.contrast;
    how.sift.normalization = match options.kind {
        FeatureKind::RootSift => SiftNormalization::Root,
        FeatureKind::Sift => SiftNormalization::L2,
    };
    let found = photo_features(&photo, &how).map_err(|error| error.to_string())?;
    let list = (found.keypoints.iter().zip(&found.image.colors))
        .map(|(keypoint, color)| Feature {
            u: keypoint.u,
            v: keypoint.v,
            scale_px: keypoint.scale_px,
            angle_rad: keypoint.angle_rad,
            color: *color,
        })
        .collect();
    let values = found.descriptors.as_bytes().map(<[u8]>::to_vec);
    Ok(Features {
        list,
        described: Described {
            dimension: found.descriptors.dimension() as u32,
            values: values.unwrap_or_default().into(),
        },
    })
}

/// The pixels as an image.
pub(crate) fn to_image(photograph: &Photograph) -> Result<RgbImage, String> {
    RgbImage::from_raw(
        photograph.width,
        photograph.height,
        photograph.rgb.0.to_vec(),
    )
    .ok_or_else(|| "the photograph did not arrive whole".to_owned())
}
