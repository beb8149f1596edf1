//! The open project as data: photographs, settings, view, and the outputs of tasks. No screen, no
//! clock.

mod anchor;
mod board_options;
mod bytes;
mod cache;
mod computed;
mod crop;
mod document;
mod key;
mod known_poses;
mod mask;
mod options;
mod plane;
mod point_set;
mod results;
mod sample;
mod saved;
mod settings;
mod shape;
mod state;
mod step;

pub use anchor::{Anchor, CloudPoint, DensePixel, PhotoId};
pub use board_options::{BoardOptions, BoardPattern, CalibrationOptions, LensCamera, LensModel};
pub use bytes::Blob;
pub(crate) use bytes::to_bytes;
pub use computed::{COMPUTED_BY, Computed};
pub use crop::CropBox;
pub(crate) use document::content_of;
pub use document::{Document, InputPhoto, Measure, Source, pairs};
pub use key::Key;
pub use known_poses::{KnownImage, KnownPoses, Pose, file_stem};
pub use mask::Mask;
pub use options::{
    AllViewsOptions, DepthMethod, DepthOptions, FeatureKind, FeatureOptions, MatchOptions,
    PairOptions, SfmOptions,
};
pub(crate) use plane::{Plane, bounds, height_weights, is_simple, prisms, signed_area};
pub use point_set::PointSet;
pub(crate) use results::Found;
pub use sample::Sample;
pub use saved::{Saved, SavedPhoto, VERSION};
pub use settings::{
    ALL_VIEWS_MEGAPIXELS, MAX_DISPARITY_PX, MAX_FRAMES, MAX_MARKS, RefineFocal, SQUARES_M, Settings,
};
pub use shape::{ControlPoint, Shape, ShapeKind, ShapeValue};
pub use state::{Outcome, Project, View};
pub use step::{Explanation, Step};
