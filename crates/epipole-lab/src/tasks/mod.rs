//! Long computations, from bytes to bytes, the same in a native thread and in a worker of the
//! browser.
//!
//! Each has a file with its inputs (a [`Task`]), its output, its code and, if the project caches
//! the output, the [`Query`] for it. `list.rs` has a line for each.

mod all_views;
#[cfg(feature = "vision")]
mod all_views_run;
#[cfg(feature = "files")]
mod archive;
mod board;
#[cfg(feature = "files")]
mod board_sample;
mod calibration;
mod camera_file;
mod camera_found;
mod cloud_vertex;
#[cfg(any(feature = "vision", feature = "files"))]
mod convert;
mod dense;
mod dense_cloud;
mod depth;
#[cfg(feature = "vision")]
mod depth_run;
#[cfg(feature = "vision")]
mod depth_size;
mod export;
mod features;
mod frames;
mod known_poses;
#[cfg(feature = "vision")]
mod known_poses_run;
mod list;
mod matches;
mod photograph;
mod picture;
mod project_file;
mod radial_lens;
mod reconstruction;
#[cfg(feature = "vision")]
mod reconstruction_run;
mod reduced;
mod refined;
#[cfg(feature = "files")]
mod rendered;
mod retained;
mod task;
mod thumbnail;
mod two_views;
mod views_to_fuse;

pub use all_views::{AllViews, FuseViews};
pub use board::{BoardFound, BoardOf, FindBoard};
pub use calibration::{Calibrate, Calibration, CalibrationOfBoards, ViewFound};
pub use camera_file::{CameraFormat, CamerasRead, PhotoFile, ReadCameras, WriteCamera};
pub use camera_found::CameraFound;
pub use cloud_vertex::CloudVertex;
pub use dense::Dense;
pub use dense_cloud::DenseCloud;
pub use depth::{DepthOf, FindDepth};
pub use export::{
    Aligned, Export, ExportFormat, Mark, Measured, MeasuredControl, MeasuredShape, Measures, Recipe,
};
pub use features::{Described, Feature, Features, FeaturesOf, FindFeatures};
pub use frames::ChooseFrame;
#[cfg(any(feature = "vision", feature = "files"))]
pub use list::compute;
pub use list::{AnyQuery, Branch, Request};
pub use matches::{Match, MatchFeatures, MatchesOf};
pub use photograph::{Calibrated, FocalOrigin, Photograph, PhotographOf, ReadPhotograph};
pub use picture::WritePicture;
pub use project_file::{OpenProject, Opened, Packed, SaveProject};
pub use reconstruction::{
    Component, ImagePoints, PairOf, PointFound, Reconstruct, Reconstructed, ReconstructionOfAll,
    UnregisteredReason,
};
pub use reduced::{ReducePhotograph, Reduced, ReducedOf};
pub use task::{Destination, Monitor, Output, Progress, Query, Task};
pub use thumbnail::Thumbnail;
pub use two_views::{Shows, TwoViews, TwoViewsOf, VerifyPair, ViewModel};

fn are_finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}
