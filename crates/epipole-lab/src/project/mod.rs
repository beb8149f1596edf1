//! The state of the Lab: photographs, settings, and results. Plain data, without a screen or a
//! clock.
//!
//! State changes only by [`Project::update`] and [`Project::done`]. [`Project::wanted`] lists the
//! tasks to compute, and [`Project::request`] gives a worker the bytes of each.

mod brought;
mod calibration;
mod calibration_words;
mod document;
mod event;
mod explanation;
mod fate;
mod floor;
mod keys;
mod link;
mod measure;
mod pairs;
mod pixels;
mod recipe;
mod reconstruction_words;
mod results;
mod saved;
mod stages;
mod update;
mod wanted;
mod words;

pub use brought::{COMPUTED_BY, Computed};
pub use calibration::BoardFate;
pub use document::{
    Anchor, Document, Given, MAX_DISPARITY_PX, MAX_FRAMES, MAX_MARKS, Measure, PhotoId,
    RefineFocal, SQUARES_M, Settings,
};
pub use event::{Event, Step};
pub use explanation::Explanation;
pub use fate::Fate;
pub use floor::Floor;
pub use keys::Key;
pub use measure::{Length, Scale};
use results::Kept;
pub use results::Results;
pub use saved::{Saved, SavedPhoto, VERSION};
pub use stages::FocalOrigin;
pub use wanted::{About, Task};
#[cfg(feature = "panels")]
pub(crate) use words::count;

use crate::tasks::{Answer, Blob, Component, Reconstructed};
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

/// Everything that the Lab knows.
#[derive(Debug)]
pub struct Project {
    pub(crate) document: Document,
    pub(crate) view: View,
    results: Results,
    /// Results that came with a project or the sample, and were not wanted yet.
    brought: BTreeMap<Key, Blob>,
    past: Vec<Document>,
    future: Vec<Document>,
    next_id: PhotoId,
    paused: bool,
    /// Photographs whose pixels were dropped and are being read again.
    reading: BTreeSet<Key>,
    /// Those of them whose second read failed.
    unread: BTreeSet<Key>,
    /// Intermediate result of the running reconstruction.
    growing: Option<(Key, Reconstructed)>,
    /// Number of changes.
    revision: u64,
    /// Outcomes of photographs, cached per revision, as panels read them in every frame.
    fates: RefCell<(u64, BTreeMap<PhotoId, Fate>)>,
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
            results: Results::default(),
            brought: BTreeMap::new(),
            past: Vec::new(),
            future: Vec::new(),
            next_id: 0,
            paused: false,
            reading: BTreeSet::new(),
            unread: BTreeSet::new(),
            growing: None,
            revision: 0,
            fates: RefCell::default(),
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

    /// Whether there is something to take back.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is anything to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Takes a result, or its error message. A result that is no longer needed is also kept: undo
    /// may need it.
    pub fn done(&mut self, key: Key, result: Result<Vec<u8>, String>) {
        self.revision += 1;
        let size = result.as_ref().map_or(0, Vec::len);
        if self.growing.as_ref().is_some_and(|(of, _)| *of == key) {
            self.growing = None;
        }
        match result.and_then(|bytes| Answer::from_bytes(&bytes)) {
            Ok(answer) => {
                if !self.results.keep(key, answer, size) {
                    self.results
                        .fail(key, "an unexpected answer arrived".to_owned());
                }
            }
            Err(_) if self.reading.contains(&key) => drop(self.unread.insert(key)),
            Err(sentence) => self.results.fail(key, sentence),
        }
        let needed = self.needed();
        self.results.tidy(|key| needed.contains(&key));
        self.take_brought();
        self.balance_pixels();
    }

    /// Takes the message of a failure that is not due to the input: out of memory, or a bug of the
    /// Lab. [`Event::TryAgain`] computes the result again.
    pub fn broke_down(&mut self, key: Key, sentence: String) {
        self.revision += 1;
        if self.growing.as_ref().is_some_and(|(of, _)| *of == key) {
            self.growing = None;
        }
        match self.reading.contains(&key) {
            true => drop(self.unread.insert(key)),
            false => self.results.break_down(key, sentence),
        }
        self.balance_pixels();
    }

    /// Whether computing something that is needed broke down.
    pub fn can_try_again(&self) -> bool {
        let broken = self.results.broken();
        let is_needed = |keys: &BTreeSet<Key>| {
            !keys.is_empty() && self.needed().intersection(keys).next().is_some()
        };
        is_needed(broken) || is_needed(&self.unread)
    }

    /// Takes an intermediate result of the running reconstruction. Others are ignored.
    pub fn so_far(&mut self, key: Key, bytes: &[u8]) {
        if let Ok(Answer::Reconstruction(found)) = Answer::from_bytes(bytes) {
            // The revision stays: nothing that is to be computed has changed.
            self.growing = Some((key, found));
        }
    }

    /// Cameras and points of the reconstruction that is on its way.
    pub fn growing(&self) -> Option<&Component> {
        let (key, found) = self.growing.as_ref()?;
        let wanted = self.reconstruction_key() == Some(*key) && self.reconstruction().is_none();
        found.components.first().filter(|_| wanted)
    }

    /// Why a result is missing for good.
    pub fn failure(&self, key: Key) -> Option<&str> {
        self.results.failure(key)
    }

    /// Why the reconstruction failed, if it did: an error, not photographs that do not fit.
    pub fn reconstruction_failure(&self) -> Option<&str> {
        self.results.failure(self.reconstruction_key()?)
    }

    /// The keys of all results of the current contents.
    fn needed(&self) -> BTreeSet<Key> {
        let mut keys = BTreeSet::new();
        let photos = &self.document.photos;
        for photo in photos {
            keys.insert(self.photograph_key(photo));
            keys.insert(self.features_key(photo));
        }
        for (first, second) in wanted::pairs(&self.taking_part()) {
            keys.insert(self.matches_key(first, second));
            keys.extend(self.two_views_key(first, second));
        }
        keys.extend(self.reconstruction_key());
        keys.extend(
            self.document
                .boards
                .iter()
                .map(|photo| self.board_key(photo)),
        );
        keys.extend(self.calibration_key());
        for pair in self.document.dense.iter().chain([&self.view.pair]) {
            if let Some((first, second)) = self.document.pair(*pair) {
                keys.extend(self.depth_key(first, second));
            }
        }
        keys
    }
}
