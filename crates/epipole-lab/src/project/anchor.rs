//! Points of the model by what they were found from.

use serde::{Deserialize, Serialize};

/// Permanent number of a photograph in its project.
pub type PhotoId = u32;

/// End of a measure: a keypoint that belongs to a point, a pixel with dense depth, or a point of
/// the cloud of all views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Anchor {
    /// Its photograph; for a pixel the first of the pair, for a point of the cloud the first
    /// registered one.
    pub photo: PhotoId,
    /// Its keypoint; 0 for a pixel and a point of the cloud.
    pub keypoint: u32,
    /// The pixel, for an anchor with dense depth.
    #[serde(default)]
    pub pixel: Option<DensePixel>,
    /// The point of the cloud of all views, for an anchor in it.
    #[serde(default)]
    pub cloud: Option<CloudPoint>,
}

impl Anchor {
    /// Returns the photographs that it depends on.
    pub fn photos(&self) -> impl Iterator<Item = PhotoId> {
        [Some(self.photo), self.pixel.map(|pixel| pixel.second)]
            .into_iter()
            .flatten()
    }
}

/// Pixel of the first rectified image of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct DensePixel {
    /// The second photograph.
    pub second: PhotoId,
    /// Column and row.
    pub at: [u32; 2],
}

/// Point of the cloud of all views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CloudPoint {
    /// Key of its cloud; in another cloud the index would be meaningless.
    pub cloud: u64,
    /// Its index.
    pub index: u32,
}
