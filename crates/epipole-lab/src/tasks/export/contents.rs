//! Contents of the zip file of a reconstruction.

use crate::project::Blob;
use crate::project::LensCamera;
use crate::tasks::dense::Dense;
use crate::tasks::dense_cloud::DenseCloud;
use crate::tasks::project_file::Packed;
use crate::tasks::reconstruction::{ImagePoints, Reconstructed};
use crate::tasks::task::Task;
use serde::{Deserialize, Serialize};

/// Recipe for the same result elsewhere.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Recipe {
    /// The command line, in the folder of the photographs.
    pub command: String,
    /// Which photographs these are, in words.
    pub photographs: String,
    /// The calibrated camera, as `--camera` reads it.
    pub camera_json: Option<String>,
    /// The same as a program.
    pub program: String,
}

/// A measured length, in units of the reconstruction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Positions of both ends.
    pub ends: [[f64; 3]; 2],
    /// The length, in meters if the scale is known.
    pub length: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// The length that was typed, meters.
    pub typed_m: Option<f64>,
}

/// Writes a reconstruction to a zip file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Export {
    /// The photographs, as they were reconstructed.
    pub images: Vec<ImagePoints>,
    /// The same with their pixels, or without: then those are read once more.
    pub photographs: Vec<Packed>,
    /// The reconstruction.
    pub found: Reconstructed,
    /// Index of the component.
    pub component: u32,
    /// Meters in a unit of the reconstruction, where something was measured.
    pub meters_per_unit: Option<f64>,
    /// A point of the floor and the direction up: z points up from there in all files.
    pub floor: Option<[[f64; 3]; 2]>,
    /// Measured lengths.
    pub measures: Vec<Measured>,
    /// Whether focal lengths were refined.
    pub focal_refined: bool,
    /// Names of photographs that have no camera in it, and why.
    pub left_out: Vec<(String, String)>,
    /// Recipe for the same result elsewhere.
    pub recipe: Recipe,
    /// The largest number of pixels of a photograph.
    pub max_pixels: u32,
    /// Camera whose distortion was removed from photographs of its size.
    pub camera: Option<LensCamera>,
    /// Names of pairs, and the depth of their pixels.
    pub dense: Vec<(String, Dense)>,
    /// Depth of all views.
    pub all_views: Option<DenseCloud>,
}

impl Task for Export {
    /// A zip file.
    type Output = Blob;
}
