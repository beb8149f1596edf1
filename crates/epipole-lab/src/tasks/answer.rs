//! What can be answered.

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
    /// Red, green, blue, row by row. None where only its size and lens are known and the pixels are to come, or where they
    /// were let go of and can be read once more.
    pub rgb: Blob,
    /// The same, small; nothing where pixels are to come, and of a board, which is in no list.
    pub small: Thumbnail,
    /// The focal length that the file tells, in pixels of this size.
    pub focal_px: Option<f64>,
    /// Focal lengths and principal point, in pixels of this size, if the photograph was redrawn as the calibrated
    /// camera would show it without its distortion.
    pub k: Option<[f64; 4]>,
    /// Width and height before it was reduced, upright.
    pub full_size: (u32, u32),
    /// Width and height as the sensor gave it, before it was turned upright.
    pub sensor_size: (u32, u32),
    /// Whether its file shows just these pixels: neither reduced nor turned nor redrawn.
    pub as_given: bool,
}

impl Photograph {
    /// Whether its pixels are there.
    pub fn has_pixels(&self) -> bool {
        !self.rgb.is_empty()
    }

    /// Whether its pixels are there, or were and can be read once more: it can be shown, small at least.
    pub fn was_read(&self) -> bool {
        self.has_pixels() || !self.small.rgb.is_empty()
    }

    /// How many bytes its pixels take, wherever they are.
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
    /// Where, strongest first.
    pub list: Vec<Feature>,
    /// What they look like, in the same order; nothing where that is to be found out once it is asked for.
    pub described: Described,
}

impl Features {
    /// Whether what they look like is there.
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

/// What two photographs show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shows {
    /// A scene with depth, from two places.
    Depth,
    /// A plane, from two places.
    Plane,
    /// The camera only turned, or did not move at all.
    Turn,
    /// No more matches agree than might by chance.
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

/// What two photographs say about each other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TwoViews {
    /// What they show.
    pub shows: Shows,
    /// The matrix chosen.
    pub model: ViewModel,
    /// F in pixels, where there is one.
    pub fundamental: Option<[f64; 9]>,
    /// Whether each match fits.
    pub inliers: Vec<bool>,
    /// How many do.
    pub num_inliers: u32,
    /// Samples drawn.
    pub iterations: u32,
    /// The turn of the camera, degrees, where it is known.
    pub turn_deg: Option<f64>,
    /// So many times the focal lengths given are those by which the camera only turned, where the given ones do not tell.
    pub focal_factor: Option<f64>,
    /// The median angle at which rays meet, degrees, where it is known.
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
    /// Where it is.
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
    /// How many photographs it has.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }
}

/// What was found in all photographs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Reconstructed {
    /// Largest first.
    pub components: Vec<Component>,
    /// Cost after each adjustment, square pixels.
    pub costs: Vec<f64>,
    /// Mean length of all reprojection errors of each component, pixels.
    pub mean_error_px: Vec<f64>,
}

/// What came of a request.
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
