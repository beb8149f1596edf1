//! Actions of the reader.

use crate::project::{
    Anchor, Blob, ControlPoint, CropBox, KnownPoses, LensCamera, Measure, PhotoId, PointSet,
    Sample, Saved, Settings, Shape, Step,
};

/// Action of the reader.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Added photographs: names and files.
    Add(Vec<(String, Blob)>),
    /// Replaced all photographs by others.
    Begin(Vec<(String, Blob)>),
    /// Added photographs of a board: names and files.
    AddBoards(Vec<(String, Blob)>),
    /// Opened the sample of a board, replacing all boards.
    OpenBoards,
    /// Removed all photographs of boards.
    ClearBoards,
    /// Used a calibrated camera for photographs of its size, or removed it.
    UseCamera(Option<LensCamera>),
    /// Used cameras and poses of a model of another program, or removed them.
    UsePoses(Option<KnownPoses>),
    /// Opened a sample, replacing all photographs.
    OpenSample(Sample),
    /// Opened a project, replacing everything, with the names and bytes of its files.
    OpenProject(Box<Saved>, Vec<(String, Blob)>),
    /// Removed a photograph, possibly of a board.
    Remove(PhotoId),
    /// Removed all photographs, except for those of boards.
    Clear,
    /// Excluded a photograph, or included it again; possibly of a board.
    Exclude(PhotoId, bool),
    /// Typed a focal length for photographs, in pixels of the full ones, or removed it.
    Focal(Vec<PhotoId>, Option<f64>),
    /// Moved a photograph towards the beginning of the list.
    Earlier(PhotoId),
    /// Changed settings.
    Set(Settings),
    /// Measured a length.
    Measure(Measure),
    /// Typed the length of a measure, meters, which sets the scale.
    Length(usize, Option<f64>),
    /// Removed a measure.
    Forget(usize),
    /// Measured an angle, an area or a volume.
    MeasureShape(Shape),
    /// Removed an angle, an area or a volume.
    ForgetShape(usize),
    /// Added a control point.
    AddControl(ControlPoint),
    /// Changed the name or the coordinates of a control point.
    ChangeControl(usize, String, Option<[f64; 3]>),
    /// Removed a control point.
    ForgetControl(usize),
    /// Chose three points on the floor, or removed them.
    Floor(Option<[Anchor; 3]>),
    /// Added the depth of a pair to the cloud, or removed it.
    Dense(PhotoId, PhotoId, bool),
    /// Added the depth of all views to the cloud, or removed it.
    AllViews(bool),
    /// Limited the model to a box, or removed the box.
    Crop(Option<CropBox>),
    /// Deleted points.
    Delete(PointSet),
    /// Restored all deleted points.
    Restore,
    /// Reverted the last change.
    Undo,
    /// Restored the change reverted last.
    Redo,
    /// Selected a step.
    Show(Step),
    /// Selected a photograph, possibly of a board.
    Look(PhotoId),
    /// Selected a pair.
    LookAtPair(PhotoId, PhotoId),
    /// Selected a component of the reconstruction.
    LookAtComponent(usize),
    /// Retried failed computations.
    TryAgain,
    /// Paused computing, or resumed it.
    Pause(bool),
}
