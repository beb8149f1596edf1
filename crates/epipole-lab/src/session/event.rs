//! Actions of the reader.

use crate::project::{
    Anchor, Blob, KnownPoses, LensCamera, Measure, PhotoId, Sample, Saved, Settings, Step,
};

/// Something that the reader did.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Gave photographs: names and files.
    Add(Vec<(String, Blob)>),
    /// Gave photographs in place of all that there are.
    Begin(Vec<(String, Blob)>),
    /// Gave photographs of a board, likewise.
    AddBoards(Vec<(String, Blob)>),
    /// Opened the sample of a board in place of all boards.
    OpenBoards,
    /// Removed all photographs of boards.
    ClearBoards,
    /// Made a calibrated camera that of the photographs of its size, or gave it up.
    UseCamera(Option<LensCamera>),
    /// Took cameras and poses from a model of another program, or gave them up.
    UsePoses(Option<KnownPoses>),
    /// Opened a sample in place of all photographs.
    OpenSample(Sample),
    /// Opened a project in place of everything, with the names and bytes of its files.
    OpenProject(Box<Saved>, Vec<(String, Blob)>),
    /// Removed a photograph, which may be of a board.
    Remove(PhotoId),
    /// Removed all photographs, but for those of boards.
    Clear,
    /// Left a photograph out, or took it in again; it may be of a board.
    Exclude(PhotoId, bool),
    /// Typed a focal length for photographs, pixels of the full ones, or took it back.
    Focal(Vec<PhotoId>, Option<f64>),
    /// Moved a photograph towards the beginning of the list.
    Earlier(PhotoId),
    /// Changed settings.
    Set(Settings),
    /// Measured a length.
    Measure(Measure),
    /// Typed the length of a measure, meters: it sets the scale.
    Length(usize, Option<f64>),
    /// Removed a measure.
    Forget(usize),
    /// Chose three points on the floor, or removed them.
    Floor(Option<[Anchor; 3]>),
    /// Added the depth of a pair to the cloud, or removed it.
    Dense(PhotoId, PhotoId, bool),
    /// Added the depth of all views to the cloud, or removed it.
    AllViews(bool),
    /// Took back the last change.
    Undo,
    /// Restored it.
    Redo,
    /// Looks at a step.
    Show(Step),
    /// Looks at a photograph, which may be of a board.
    Look(PhotoId),
    /// Looks at a pair.
    LookAtPair(PhotoId, PhotoId),
    /// Looks at a part of the reconstruction.
    LookAtComponent(usize),
    /// Retried failed computations.
    TryAgain,
    /// Stopped computing, or went on.
    Pause(bool),
}
