//! Cameras: intrinsics and lenses as other programs store them.
//!
//! [`read_cameras`] recognizes the format by its content; [`write_cameras`] writes some of the
//! formats. Pixels are converted to centers at integers.

mod colmap;
mod epipole_json;
mod flat;
mod format;
mod kalibr;
mod kitti;
mod matlab;
mod metashape;
mod middlebury;
mod named;
pub(crate) mod nerfstudio;
mod opencv;
mod opencv_write;
mod parts;
mod q_matrix;
mod read;
mod ros;
mod ros_write;
mod write;
mod yaml_number;

pub use epipole_json::camera_fields;
pub use format::CameraFormat;
pub use named::{Cameras, NamedCamera};
pub use q_matrix::read_q;
pub use read::{is_camera_file, read_cameras};
pub use write::write_cameras;
