//! The formats of camera files.

/// Format of a file of cameras.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CameraFormat {
    /// JSON of `epipole calibrate`.
    Epipole,
    /// OpenCV's `FileStorage`: YAML, XML or JSON.
    OpenCv,
    /// ROS `camera_info`, YAML.
    Ros,
    /// Kalibr's camera chain, YAML.
    Kalibr,
    /// COLMAP's `cameras.txt` or `cameras.bin`.
    Colmap,
    /// `transforms.json` of nerfstudio and instant-ngp.
    NerfStudio,
    /// XML of Agisoft Metashape.
    Metashape,
    /// MATLAB's `cameraParameters` or `stereoParameters`, as JSON.
    Matlab,
    /// Calibration of KITTI: projections, or cameras with lenses.
    Kitti,
    /// `calib.txt` of the Middlebury and ETH3D stereo benchmarks.
    Middlebury,
    /// Numbers named `fx`, `fy`, `cx`, `cy`: settings of ORB-SLAM, JSON of depth cameras.
    Flat,
}

impl CameraFormat {
    /// Returns the name of the program.
    pub fn name(self) -> &'static str {
        match self {
            Self::Epipole => "Epipole",
            Self::OpenCv => "OpenCV",
            Self::Ros => "ROS",
            Self::Kalibr => "Kalibr",
            Self::Colmap => "COLMAP",
            Self::NerfStudio => "nerfstudio",
            Self::Metashape => "Metashape",
            Self::Matlab => "MATLAB",
            Self::Kitti => "KITTI",
            Self::Middlebury => "Middlebury",
            Self::Flat => "plain numbers",
        }
    }
    /// Describes the pixel convention of the format in a sentence. Readers convert to centers at
    /// integers.
    pub fn convention(self) -> &'static str {
        match self {
            Self::Epipole
            | Self::OpenCv
            | Self::Ros
            | Self::Kalibr
            | Self::Kitti
            | Self::Middlebury
            | Self::Flat => "pixel centers at integers",
            Self::Colmap | Self::NerfStudio => {
                "pixel centers at halves in the file, converted to integers"
            }
            Self::Metashape => {
                "principal point from the middle of the image in the file, converted to pixel \
                 centers at integers"
            }
            Self::Matlab => "pixels from 1 in the file, converted to pixels from 0",
        }
    }
}
