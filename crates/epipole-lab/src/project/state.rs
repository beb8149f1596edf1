//! The open project.

use super::bytes::Blob;
use super::cache::Cache;
use super::document::{Document, PhotoId};
use super::key::Key;
use super::step::Step;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// The current view; undo leaves it alone.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The step.
    pub step: Step,
    /// The photograph.
    pub photo: PhotoId,
    /// The pair, the first before the second in the list.
    pub pair: (PhotoId, PhotoId),
    /// The part of the reconstruction.
    pub component: usize,
    /// The photograph of a board.
    pub board: PhotoId,
}

/// Outcome for a photograph.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It is not known yet.
    Pending,
    /// Registered, with the number of its points.
    Registered(usize),
    /// The reader left it out.
    Excluded,
    /// Duplicate of an earlier photograph in the list, by its name.
    Duplicate(String),
    /// It cannot be read.
    Unreadable(String),
    /// No other photograph takes part.
    Alone,
    /// Too few features; their number.
    FewFeatures(usize),
    /// No overlap with any other; the largest number of agreeing matches.
    OverlapsNone(usize),
    /// Only rotation between it and the photographs that it overlaps with; if this holds only for
    /// another focal length than the given one, that focal length, in pixels of the original
    /// photograph.
    OnlyTurned(Option<u32>),
    /// Too few visible points; their number.
    SeesFew(usize),
    /// Number of visible points, which do not agree on a pose.
    NoPlace(usize),
    /// The opened model has no pose of it.
    NoKnownPose,
    /// It belongs to another part.
    OtherPart(usize),
    /// Everything failed.
    Failed(String),
}

/// The open project: its contents, view, history, and outputs of tasks.
#[derive(Debug)]
pub struct Project {
    pub(crate) document: Document,
    pub(crate) view: View,
    pub(crate) cache: Cache,
    /// Outputs from a file that were not needed yet.
    pub(crate) imported: BTreeMap<Key, Blob>,
    pub(crate) past: Vec<Document>,
    pub(crate) future: Vec<Document>,
    pub(crate) next_id: PhotoId,
    pub(crate) paused: bool,
    /// Photographs whose pixels were dropped and are being read again.
    pub(crate) rereading: BTreeSet<Key>,
    /// Those of them whose second read failed.
    pub(crate) unread: BTreeSet<Key>,
    /// Number of changes.
    pub(crate) revision: u64,
    /// Outcomes of photographs, cached per revision, as panels read them in every frame.
    pub(crate) outcomes: RefCell<(u64, BTreeMap<PhotoId, Outcome>)>,
}

impl Default for Project {
    fn default() -> Self {
        Self {
            document: Document::default(),
            view: View {
                step: Step::Photographs,
                photo: 0,
                pair: (0, 0),
                component: 0,
                board: 0,
            },
            cache: Cache::default(),
            imported: BTreeMap::new(),
            past: Vec::new(),
            future: Vec::new(),
            next_id: 0,
            paused: false,
            rereading: BTreeSet::new(),
            unread: BTreeSet::new(),
            revision: 0,
            outcomes: RefCell::default(),
        }
    }
}

impl Project {
    /// Contents of the project.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The current view.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Number of changes; values computed at one revision are valid until the next.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether computing was stopped.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is anything to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}
