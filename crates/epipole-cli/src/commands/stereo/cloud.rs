//! The cloud of `epipole stereo --ply`.

use crate::failure::Failure;
use crate::files;
use crate::matrices::{number, positive};
use clap::Args;
use epipole::stereo::{DisparityImage, point_cloud, q_from_rig};
use epipole_io::camera::read_q;
use epipole_io::cloud::write_ply;
use image::RgbImage;
use nalgebra::Matrix4;
use std::path::PathBuf;

/// Geometry of the rectified pair.
#[derive(Debug, Args)]
pub(super) struct CloudArguments {
    /// Also write a colored point cloud; needs --q, or --focal-px and --baseline-m.
    #[arg(long, value_name = "CLOUD.ply")]
    ply: Option<PathBuf>,
    /// Focal length, pixels.
    #[arg(long, value_name = "F", value_parser = positive)]
    focal_px: Option<f64>,
    /// Distance between the cameras, meters.
    #[arg(long, value_name = "B", value_parser = positive)]
    baseline_m: Option<f64>,
    /// Column of the left principal point, pixels [default: the center].
    #[arg(long, value_name = "PX", value_parser = number, allow_hyphen_values = true, requires = "ply")]
    cx: Option<f64>,
    /// Row of the principal points, pixels [default: the center].
    #[arg(long, value_name = "PX", value_parser = number, allow_hyphen_values = true, requires = "ply")]
    cy: Option<f64>,
    /// Column of the right principal point minus that of the left, pixels: doffs of Middlebury.
    #[arg(long, value_name = "PX", default_value_t = 0.0, value_parser = number, allow_hyphen_values = true, requires = "ply")]
    doffs: f64,
    /// File with Q: output of `epipole rectify --json`, an OpenCV file, 16 numbers row by row, or
    /// `calib.txt` of Middlebury or KITTI. The cloud has the unit of the file.
    #[arg(long, value_name = "FILE", requires = "ply", conflicts_with_all = ["focal_px", "baseline_m", "cx", "cy", "doffs"])]
    q: Option<PathBuf>,
}

impl CloudArguments {
    /// Returns the matrix from pixels with disparities to points; `None` without --ply.
    ///
    /// # Errors
    /// If the options do not suffice or the file has no Q.
    pub(super) fn matrix(
        &self,
        (width, height): (u32, u32),
    ) -> Result<Option<Matrix4<f64>>, Failure> {
        if self.ply.is_none() {
            return Ok(None);
        }
        if let Some(path) = &self.q {
            let q = read_q(&files::read_bytes(path)?);
            return Ok(Some(q.map_err(|error| Failure::from(error).about(path))?));
        }
        let (Some(focal_px), Some(baseline_m)) = (self.focal_px, self.baseline_m) else {
            return Err(Failure::usage(
                "--ply needs the geometry of the pair: give --q, or --focal-px and --baseline-m",
            ));
        };
        let center = |side: u32| (f64::from(side) - 1.0) / 2.0;
        let cx = self.cx.unwrap_or_else(|| center(width));
        let cy = self.cy.unwrap_or_else(|| center(height));
        let mut q = q_from_rig(focal_px, baseline_m, cx, cy)?;
        // Z = f B/(d + doffs).
        q[(3, 3)] = self.doffs / baseline_m;
        Ok(Some(q))
    }

    /// Writes the cloud.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(super) fn write(
        &self,
        disparity: &DisparityImage,
        q: &Matrix4<f64>,
        colors: &RgbImage,
    ) -> Result<(), Failure> {
        let Some(path) = &self.ply else {
            return Ok(());
        };
        let cloud = point_cloud(disparity, q, Some(colors))?;
        files::write(path, &write_ply(&cloud))
    }
}
