//! Command-line options of `epipole mvs`.

use crate::context::Context;
use crate::matrices::{number, positive};
use crate::reading::ReadArguments;
use clap::{Args, ValueEnum};
use epipole::mvs::{MeshOptions, MvsOptions};
use std::path::PathBuf;

const EXAMPLE: &str = "Example: epipole mvs reconstruction/ photos/ -o dense";

fn default() -> MvsOptions {
    MvsOptions::default()
}

/// File of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum MeshFormat {
    /// `mesh.ply`: binary, for CloudCompare and MeshLab.
    Ply,
    /// `mesh.glb`: binary glTF, for Blender and viewers.
    Glb,
    /// `mesh.obj`: text.
    Obj,
    /// `model.html`: an offline page that shows cameras, points and mesh, and measures lengths.
    Html,
}

/// Compute depth maps and a dense cloud of a model and its photos.
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLE,
    after_long_help = "Example: epipole mvs reconstruction/ photos/ -o dense\n\n\
    The model is one of `epipole sfm`, COLMAP (text, binary), Bundler or openMVG, with observations of its points.\n\
    The observations determine which photos are compared, and the range of depths. Lens distortion is removed.\n\n\
    Writes fused.ply (points with normals, colors and confidence, the number of photos that agree),\n\
    stereo/depth_maps and stereo/normal_maps in COLMAP's format, and sparse/ (the cameras of these maps). --mesh\n\
    adds a colored surface of triangles, with holes where no photo sees it; --texture gives it the pixels of the\n\
    photos, adjusted to agree along seams.\n\n\
    JSON: num_images, num_depth_maps, density (fraction of pixels with a depth), num_points, mean_views (mean\n\
    number of photos that agree on a point), images (name, width, height, num_neighbors, density, min_depth and\n\
    max_depth of each depth map, null if it is empty), file; with --mesh also num_triangles, num_vertices, mesh\n\
    (its file), with --texture also texture_size (width and height, pixels)."
)]
pub(crate) struct Arguments {
    /// File or folder of a model.
    pub(super) model: PathBuf,
    /// Folder of its images [default: images/, in the model or above it].
    pub(super) images: Option<PathBuf>,
    /// Output folder.
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Limit the longer side of the images (pixels).
    #[arg(long, value_name = "PX", default_value_t = default().max_size_px, value_parser = clap::value_parser!(u32).range(32..=16384))]
    pub(super) max_size: u32,
    /// Number of neighbors of each photo.
    #[arg(long, value_name = "N", default_value_t = default().num_neighbors)]
    num_neighbors: usize,
    /// Number of best-fitting neighbors that count at a pixel.
    #[arg(long, value_name = "N", default_value_t = default().num_best_neighbors)]
    num_best_neighbors: usize,
    /// Minimum number of photos that agree (on a depth).
    #[arg(long, value_name = "N", default_value_t = default().min_views)]
    min_views: usize,
    /// Minimum angle between rays of compared photos, degrees.
    #[arg(long, value_name = "DEG", default_value_t = default().min_angle_deg, value_parser = number)]
    min_angle_deg: f64,
    /// Number of rounds of propagation at each resolution after the coarsest.
    #[arg(long, value_name = "N", default_value_t = default().num_rounds)]
    num_rounds: usize,
    /// Minimum correlation of patches at a depth, -1 to 1.
    #[arg(long, value_name = "C", default_value_t = default().min_correlation, value_parser = number, allow_hyphen_values = true)]
    min_correlation: f64,
    /// Maximum reprojection error between photos that agree, pixels.
    #[arg(long, value_name = "PX", default_value_t = default().max_reprojection_error_px, value_parser = positive)]
    max_reprojection_error_px: f64,
    /// Maximum relative difference of depths between photos that agree.
    #[arg(long, value_name = "RATIO", default_value_t = default().max_depth_difference, value_parser = positive)]
    max_depth_difference: f64,
    /// Maximum angle between the normals of photos that agree, degrees.
    #[arg(long, value_name = "DEG", default_value_t = default().max_normal_angle_deg, value_parser = positive)]
    max_normal_angle_deg: f64,
    /// Also write a mesh of triangles.
    #[arg(long, value_name = "FORMAT", value_enum)]
    pub(super) mesh: Option<MeshFormat>,
    /// Texture the mesh from the images, instead of colors of vertices (glb and obj).
    #[arg(long, requires = "mesh")]
    pub(super) texture: bool,
    /// Edge length of a voxel, in the unit of the model [default: 1.5 pixels].
    #[arg(long, value_name = "SIZE", value_parser = positive, requires = "mesh")]
    voxel_size: Option<f64>,
    /// Minimum number of triangles of a connected component.
    #[arg(long, value_name = "N", default_value_t = MeshOptions::default().min_triangles, requires = "mesh")]
    min_triangles: usize,
    #[command(flatten)]
    pub(super) reading: ReadArguments,
}

impl Arguments {
    pub(super) fn options(&self, context: &Context) -> MvsOptions {
        default()
            .with_max_size_px(self.max_size)
            .with_num_neighbors(self.num_neighbors)
            .with_num_best_neighbors(self.num_best_neighbors)
            .with_min_views(self.min_views)
            .with_min_angle_deg(self.min_angle_deg)
            .with_num_rounds(self.num_rounds)
            .with_min_correlation(self.min_correlation)
            .with_max_reprojection_error_px(self.max_reprojection_error_px)
            .with_max_depth_difference(self.max_depth_difference)
            .with_max_normal_angle_deg(self.max_normal_angle_deg)
            .with_seed(context.seed)
    }

    pub(super) fn mesh_options(&self) -> MeshOptions {
        MeshOptions::default()
            .with_voxel_size(self.voxel_size)
            .with_min_triangles(self.min_triangles)
    }
}
