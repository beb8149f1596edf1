//! Features of a photograph.

use super::convert::{sentence, to_image};
use super::{
    Described, Feature, FeatureKind, FeatureOptions, Features, Photograph, Progress, Told,
};
use epipole::feature;
use epipole::sfm::{Photo, PhotoOptions, photo_features};

/// Finds features just as `epipole sfm` does.
///
/// # Errors
/// As [`photo_features`], if `progress` wants no more, too.
pub(super) fn features(
    photograph: &Photograph,
    options: &FeatureOptions,
    progress: Progress<'_>,
) -> Result<Features, String> {
    let photo = Photo {
        image: to_image(photograph)?,
        ..Photo::default()
    };
    let mut how = PhotoOptions::default();
    how.features.max_features = options.max_features as usize;
    how.features.contrast_threshold = Some(options.contrast);
    how.features.kind = match options.kind {
        FeatureKind::RootSift => feature::FeatureKind::RootSift,
        FeatureKind::Sift => feature::FeatureKind::Sift,
    };
    let mut watch = |_| progress(Told::Share(0.0, ""));
    let found = photo_features(&photo, &how, &mut watch).map_err(sentence)?;
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
