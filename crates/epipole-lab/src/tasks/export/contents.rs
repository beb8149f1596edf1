//! Contents of the zip file of a reconstruction.

use super::measured::Measures;
use crate::project::Blob;
use crate::tasks::dense::Dense;
use crate::tasks::dense_cloud::DenseCloud;
use crate::tasks::project_file::Packed;
use crate::tasks::reconstruction::{Component, ImagePoints, Reconstructed};
use crate::tasks::task::Task;
use serde::{Deserialize, Serialize};

/// Recipe for the same result elsewhere.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Recipe {
    /// Command line, to be run in the folder of the photographs.
    pub command: String,
    /// Description of the photographs to use.
    pub photographs: String,
    /// Calibrated camera in the format of `--camera`.
    pub camera_json: Option<String>,
    /// Equivalent program, if there is one.
    pub program: Option<String>,
}

/// Format of cameras and points in the zip file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum ExportFormat {
    /// COLMAP's text files.
    #[default]
    ColmapText,
    /// COLMAP's binary files.
    ColmapBinary,
    /// nerfstudio's `transforms.json`.
    Transforms,
    /// Bundler's `bundle.out`.
    Bundler,
    /// openMVG's `sfm_data.json`.
    OpenMvg,
    /// Binary glTF.
    Glb,
}

impl ExportFormat {
    /// All formats, the default first.
    pub const ALL: [Self; 6] = [
        Self::ColmapText,
        Self::ColmapBinary,
        Self::Transforms,
        Self::Bundler,
        Self::OpenMvg,
        Self::Glb,
    ];

    /// Returns the names of programs that open it.
    pub fn programs(self) -> &'static str {
        match self {
            Self::ColmapText => "COLMAP (text)",
            Self::ColmapBinary => "COLMAP (binary)",
            Self::Transforms => "nerfstudio, Brush",
            Self::Bundler => "Metashape (Bundler)",
            Self::OpenMvg => "openMVG, openMVS",
            Self::Glb => "Blender (glTF)",
        }
    }

    /// Returns its main file or folder in the zip file.
    pub fn place(self) -> &'static str {
        match self {
            Self::ColmapText | Self::ColmapBinary => "sparse/0/",
            Self::Transforms => "transforms.json",
            Self::Bundler => "bundle.out",
            Self::OpenMvg => "sfm_data.json",
            Self::Glb => "model.glb",
        }
    }

    /// Whether its file of the surface has a texture.
    pub fn has_texture(self) -> bool {
        matches!(self, Self::Glb | Self::Bundler)
    }

    /// Returns the file of the surface of all views in the zip file.
    pub fn mesh(self) -> &'static str {
        match self {
            Self::Glb => "mesh.glb",
            Self::Bundler => "mesh.obj",
            Self::ColmapText | Self::ColmapBinary | Self::Transforms | Self::OpenMvg => "mesh.ply",
        }
    }
}

/// Writes a reconstruction to a zip file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Export {
    /// Format of cameras and points.
    pub format: ExportFormat,
    /// Photographs, as they were reconstructed.
    pub images: Vec<ImagePoints>,
    /// Their pixels; those without are read again.
    pub photographs: Vec<Packed>,
    /// The reconstruction.
    pub found: Reconstructed,
    /// Index of the component.
    pub component: u32,
    /// The component with all points, if some are left out: what photographs see in common, for
    /// the texture.
    pub uncropped: Option<Component>,
    /// File of the known poses that determine the unit of length.
    pub unit_of: Option<String>,
    /// Meters per unit of the reconstruction, if the scale is known.
    pub meters_per_unit: Option<f64>,
    /// A point of the floor and the up direction, which is z in all files; `None` with an alignment
    /// to control points.
    pub floor: Option<[[f64; 3]; 2]>,
    /// All measures.
    pub measures: Measures,
    /// Whether focal lengths were refined.
    pub focal_refined: bool,
    /// Names of photographs without a camera, with the reason.
    pub left_out: Vec<(String, String)>,
    /// Recipe for the same result elsewhere.
    pub recipe: Recipe,
    /// Maximum number of pixels of a photograph.
    pub max_pixels: u32,
    /// Names of pairs, with their depth.
    pub dense: Vec<(String, Dense)>,
    /// Depth of all views.
    pub all_views: Option<DenseCloud>,
}

impl Task for Export {
    /// A zip file.
    type Output = Blob;
}
