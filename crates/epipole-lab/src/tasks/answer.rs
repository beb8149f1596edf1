//! Results of computations.

use super::{Blob, BoardFound, Calibration, Dense, Described, Thumbnail};
use crate::project::{Computed, Saved};
use epipole::camera::Lens;
use serde::{Deserialize, Serialize};

/// A photograph, upright and of a size to work with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Photograph {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Red, green, blue, row by row. Empty if only size and lens are known so far, or if the pixels
    /// were dropped and can be read again.
    pub rgb: Blob,
    /// The same, small; nothing where pixels are to come, and of a board, which is in no list.
    pub small: Thumbnail,
    /// Focal length from the file, in pixels of this size.
    pub focal_px: Option<f64>,
    /// Focal lengths and principal point, in pixels of this size, if the photograph was redrawn as
    /// the calibrated camera would show it without its distortion.
    pub k: Option<[f64; 4]>,
    /// Width and height before it was reduced, upright.
    pub full_size: (u32, u32),
    /// Width and height in the sensor's orientation, before it was turned upright.
    pub sensor_size: (u32, u32),
    /// Whether the pixels are those of the file: not downscaled, rotated or undistorted.
    pub as_given: bool,
}

impl Photograph {
    /// Whether its pixels are there.
    pub fn has_pixels(&self) -> bool {
        !self.rgb.is_empty()
    }

    /// Whether its pixels are or were in memory: it can be shown, at least as a thumbnail.
    pub fn was_read(&self) -> bool {
        self.has_pixels() || !self.small.rgb.is_empty()
    }

    /// Size of its pixels in bytes, whether loaded or not.
    pub fn num_bytes(&self) -> usize {
        3 * self.width as usize * self.height as usize
    }
}

/// A feature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Feature {
    /// Column, pixels.
    pub u: f64,
    /// Row, pixels.
    pub v: f64,
    /// Its scale, pixels.
    pub scale_px: f32,
    /// Its direction, v down.
    pub angle_rad: f32,
    /// The color of its place.
    pub color: [u8; 3],
}

/// The features of a photograph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Features {
    /// Keypoints, strongest first.
    pub list: Vec<Feature>,
    /// Descriptors, in the same order; empty if they are to be computed on demand.
    pub described: Described,
}

impl Features {
    /// Whether the descriptors are available.
    pub fn has_descriptors(&self) -> bool {
        self.list.is_empty() || !self.described.values.is_empty()
    }
}

/// A match.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Match {
    /// Index in the first photograph.
    pub first: u32,
    /// Index in the second photograph.
    pub second: u32,
    /// Distance of the descriptors over that of the second nearest.
    pub ratio: f32,
}

/// Kind of scene and motion of two photographs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shows {
    /// A scene with depth, from two places.
    Depth,
    /// A plane, from two places.
    Plane,
    /// The camera only rotated, or did not move at all.
    Turn,
    /// No more matches agree than by chance.
    Nothing,
}

/// The matrix that was chosen for two photographs, row by row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ViewModel {
    /// E.
    Essential([f64; 9]),
    /// F.
    Fundamental([f64; 9]),
    /// H.
    Homography([f64; 9]),
}

/// Two-view geometry.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TwoViews {
    /// Kind of scene and motion.
    pub shows: Shows,
    /// The matrix chosen.
    pub model: ViewModel,
    /// F in pixels, where there is one.
    pub fundamental: Option<[f64; 9]>,
    /// Whether each match fits.
    pub inliers: Vec<bool>,
    /// Number of inliers.
    pub num_inliers: u32,
    /// Samples drawn.
    pub iterations: u32,
    /// The rotation of the camera, degrees, if known.
    pub turn_deg: Option<f64>,
    /// Factor of the given focal lengths for which the camera only rotated, if it did not with the
    /// given ones.
    pub focal_factor: Option<f64>,
    /// The median triangulation angle, degrees, if known.
    pub angle_deg: Option<f64>,
}

/// A camera that was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CameraFound {
    /// Focal lengths and principal point, pixels.
    pub intrinsics: [f64; 4],
    /// Rotation of camera from world, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Translation of camera from world.
    pub translation: [f64; 3],
}

/// A point that was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointFound {
    /// Position in the world.
    pub position: [f64; 3],
    /// Its color.
    pub color: [u8; 3],
    /// Image and keypoint of each place where it was seen.
    pub track: Vec<(u32, u32)>,
    /// Root mean square of its reprojection errors, pixels.
    pub error_px: f64,
}

/// Cameras and points in one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Component {
    /// The camera of each image, or none.
    pub cameras: Vec<Option<CameraFound>>,
    /// The lens of all.
    #[serde(rename = "distortion", with = "super::radial_lens")]
    pub lens: Lens,
    /// The points.
    pub points: Vec<PointFound>,
}

impl Component {
    /// Number of registered photographs.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }
}

/// The reconstruction from all photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Reconstructed {
    /// Largest first.
    pub components: Vec<Component>,
    /// Cost after each adjustment, square pixels.
    pub costs: Vec<f64>,
    /// Mean length of all reprojection errors of each component, pixels.
    pub mean_error_px: Vec<f64>,
}

/// Answer to a request.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// Of [`Request::Photograph`](super::Request::Photograph).
    Photograph(Photograph),
    /// Of [`Request::Features`](super::Request::Features).
    Features(Features),
    /// Of [`Request::Matches`](super::Request::Matches).
    Matches(Vec<Match>),
    /// Of [`Request::TwoViews`](super::Request::TwoViews).
    TwoViews(TwoViews),
    /// Of [`Request::Reconstruction`](super::Request::Reconstruction).
    Reconstruction(Reconstructed),
    /// Of [`Request::Depth`](super::Request::Depth).
    Depth(Dense),
    /// Of [`Request::Board`](super::Request::Board).
    Board(BoardFound),
    /// Of [`Request::Calibration`](super::Request::Calibration).
    Calibration(Calibration),
    /// Of [`Request::Export`](super::Request::Export) and [`Request::Save`](super::Request::Save).
    Archive(Blob),
    /// Of [`Request::Frames`](super::Request::Frames): names and files.
    Frames(Vec<(String, Blob)>),
    /// Of [`Request::Open`](super::Request::Open).
    Opened {
        /// The rest of the project.
        project: Saved,
        /// Names and files.
        files: Vec<(String, Blob)>,
        /// Results that came with it.
        computed: Computed,
    },
}
