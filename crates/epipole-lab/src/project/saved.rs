//! Saved form of a project, without its photographs.

use super::anchor::{Anchor, PhotoId};
use super::board_options::LensCamera;
use super::crop::CropBox;
use super::document::Measure;
use super::known_poses::KnownPoses;
use super::point_set::PointSet;
use super::sample::Sample;
use super::settings::Settings;
use super::shape::{ControlPoint, Shape};
use serde::{Deserialize, Serialize};

/// Version of the format that is written.
pub const VERSION: u32 = 1;

/// A project without its photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Saved {
    /// Version of the format.
    pub version: u32,
    /// All settings.
    pub settings: Settings,
    /// The photographs, in order.
    pub photos: Vec<SavedPhoto>,
    /// Measurements; photographs are identified by index.
    pub measures: Vec<Measure>,
    /// Measured angles, areas and volumes, likewise.
    #[serde(default)]
    pub shapes: Vec<Shape>,
    /// Points with known coordinates, likewise.
    #[serde(default)]
    pub control_points: Vec<ControlPoint>,
    /// Three points of the floor, likewise.
    #[serde(default)]
    pub floor: Option<[Anchor; 3]>,
    /// Pairs whose depth is part of the cloud, likewise.
    #[serde(default)]
    pub dense: Vec<(PhotoId, PhotoId)>,
    /// Whether the depth of all views is part of the cloud.
    #[serde(default)]
    pub all_views: bool,
    /// Photographs of a board, in order. Their files are in a separate folder.
    #[serde(default)]
    pub boards: Vec<SavedPhoto>,
    /// Calibrated camera.
    #[serde(default)]
    pub camera: Option<LensCamera>,
    /// Cameras and poses of a model of another program.
    #[serde(default)]
    pub poses: Option<KnownPoses>,
    /// Box that limits the model.
    #[serde(default)]
    pub crop: Option<CropBox>,
    /// Deleted points; photographs are identified by index.
    #[serde(default)]
    pub deleted: PointSet,
}

/// A photograph of a saved project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedPhoto {
    /// Its name, also of its file.
    pub name: String,
    /// Photograph of a sample, which has no file.
    pub rendered: Option<(Sample, u8)>,
    /// Whether the reader left it out.
    pub excluded: bool,
    /// Focal length typed by the reader, pixels.
    pub focal_px: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Mask;

    #[test]
    fn a_file_from_before_there_were_boxes_and_deletions_opens() {
        let with = Saved {
            version: VERSION,
            crop: Some(CropBox {
                of: u64::MAX,
                component: 1,
                origin: [0.5; 3],
                rotation: [0.0, 0.0, 0.0, 1.0],
                low: [-1.0; 3],
                high: [2.0; 3],
            }),
            deleted: PointSet {
                keypoints: vec![(0, Mask::of([5, 900]))],
                clouds: vec![(7, Mask::of([1]))],
            },
            ..Saved::default()
        };
        let mut json = serde_json::to_value(&with).unwrap_or_default();
        assert_eq!(
            serde_json::from_value::<Saved>(json.clone()).ok(),
            Some(with)
        );
        let fields = json.as_object_mut().map(|fields| {
            [fields.remove("crop"), fields.remove("deleted")].map(|field| field.is_some())
        });
        assert_eq!(fields, Some([true, true]));
        let older = serde_json::from_value::<Saved>(json).ok();
        let without = Saved {
            version: VERSION,
            ..Saved::default()
        };
        assert_eq!(older, Some(without));
    }
}
