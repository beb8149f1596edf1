//! The open project.

use super::anchor::PhotoId;
use super::bytes::Blob;
use super::cache::Cache;
use super::document::Document;
use super::key::Key;
use super::results::Results;
use super::shape::ShapeValue;
use super::step::Step;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// Current view, which undo does not change.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Current step.
    pub step: Step,
    /// Selected photograph.
    pub photo: PhotoId,
    /// Selected pair, in the order of the list.
    pub pair: (PhotoId, PhotoId),
    /// Selected component of the reconstruction.
    pub component: usize,
    /// Selected photograph of a board.
    pub board: PhotoId,
}

/// Outcome for a photograph.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// Not known yet.
    Pending,
    /// Registered, with the number of its points.
    Registered(usize),
    /// Left out by the reader.
    Excluded,
    /// Duplicate of an earlier photograph, with the name of that one.
    Duplicate(String),
    /// Unreadable, with an error message.
    Unreadable(String),
    /// The only photograph that takes part.
    Alone,
    /// Too few features, with their number.
    FewFeatures(usize),
    /// No overlap with any other, with the largest number of agreeing matches.
    OverlapsNone(usize),
    /// Only rotation relative to all overlapping photographs. If this holds only for another focal
    /// length than the given one, that focal length in pixels of the original photograph.
    RotationOnly(Option<u32>),
    /// Too few visible points, with their number.
    SeesFew(usize),
    /// Visible points that do not agree on a pose, with their number.
    NoPlace(usize),
    /// No pose in the opened model.
    NoKnownPose,
    /// Registered in another component.
    OtherPart(usize),
    /// The reconstruction failed, with an error message.
    Failed(String),
}

/// The open project: its contents, view, history, and outputs of tasks.
#[derive(Debug)]
pub struct Project {
    pub(crate) document: Document,
    pub(crate) view: View,
    pub(crate) cache: Cache,
    /// Outputs from a file that have not been needed yet.
    pub(crate) imported: BTreeMap<Key, Blob>,
    pub(crate) past: Vec<Document>,
    pub(crate) future: Vec<Document>,
    pub(crate) next_id: PhotoId,
    pub(crate) paused: bool,
    /// Photographs whose pixels were dropped and are being read again.
    pub(crate) rereading: BTreeSet<Key>,
    /// Those whose second read failed.
    pub(crate) unread: BTreeSet<Key>,
    /// Number of changes.
    pub(crate) revision: u64,
    /// Volumes by the key of their inputs.
    pub(crate) volumes: RefCell<BTreeMap<Key, Result<ShapeValue, String>>>,
    /// Current reconstruction and the one before.
    pub(crate) results: Results,
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
            volumes: RefCell::default(),
            results: Results::default(),
            outcomes: RefCell::default(),
        }
    }
}

impl Project {
    /// Returns the contents of the project.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The current view.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Returns the number of changes; values computed at a revision are valid until the next.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether computing is paused.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Whether there is a change to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is a change to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}
