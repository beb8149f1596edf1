//! What a reader can do.

use super::document::{Measure, PhotoId, Settings};
use super::saved::Saved;
use crate::tasks::{Blob, Sample};

/// The steps, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Step {
    /// The photographs.
    Photographs,
    /// Their features.
    Features,
    /// All pairs.
    Matches,
    /// One pair.
    TwoViews,
    /// Cameras and points.
    Reconstruction,
    /// Lengths.
    Measure,
    /// Files.
    Export,
}

impl Step {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Photographs,
        Self::Features,
        Self::Matches,
        Self::TwoViews,
        Self::Reconstruction,
        Self::Measure,
        Self::Export,
    ];

    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Photographs => "Photographs",
            Self::Features => "Features",
            Self::Matches => "Matches",
            Self::TwoViews => "Two views",
            Self::Reconstruction => "Reconstruction",
            Self::Measure => "Measure",
            Self::Export => "Export",
        }
    }
}

/// Something that the reader did.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Gave photographs: names and files.
    Add(Vec<(String, Blob)>),
    /// Asked for a sample in place of everything.
    OpenSample(Sample),
    /// Opened a project in place of everything, with the names and bytes of its files.
    OpenProject(Saved, Vec<(String, Blob)>),
    /// Removed a photograph.
    Remove(PhotoId),
    /// Removed everything.
    Clear,
    /// Left a photograph out, or took it in again.
    Exclude(PhotoId, bool),
    /// Typed a focal length, pixels of the full photograph, or took it back.
    Focal(PhotoId, Option<f64>),
    /// Moved a photograph towards the beginning of the list.
    Earlier(PhotoId),
    /// Turned knobs.
    Set(Settings),
    /// Measured a length.
    Measure(Measure),
    /// Typed the length of a measure, meters: it sets the scale.
    Length(usize, Option<f64>),
    /// Removed a measure.
    Forget(usize),
    /// Took back the last change.
    Undo,
    /// Brought it back.
    Redo,
    /// Looks at a step.
    Show(Step),
    /// Looks at a photograph.
    Look(PhotoId),
    /// Looks at a pair.
    LookAtPair(PhotoId, PhotoId),
    /// Looks at a part of the reconstruction.
    LookAtComponent(usize),
    /// Stopped computing, or went on.
    Pause(bool),
}
