//! Results, kept by the key of their inputs, so that undo is instant.

use super::keys::Key;
use crate::tasks::{
    Answer, Blob, BoardFound, Calibration, Dense, Features, Match, Photograph, Reconstructed,
    TwoViews,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A result, shared.
#[derive(Debug, Clone)]
pub(super) enum Kept {
    /// A photograph.
    Photograph(Rc<Photograph>),
    /// The features of one.
    Features(Rc<Features>),
    /// The matches of a pair.
    Matches(Rc<Vec<Match>>),
    /// Two-view geometry of a pair.
    TwoViews(Rc<TwoViews>),
    /// Cameras and points.
    Reconstruction(Rc<Reconstructed>),
    /// Every pixel of a pair.
    Depth(Rc<Dense>),
    /// A board in a photograph.
    Board(Rc<BoardFound>),
    /// A camera from boards.
    Calibration(Rc<Calibration>),
}

/// Maximum size of all results, bytes; beyond it the least recently used are dropped.
const MAX_BYTES: usize = 600_000_000;

/// All results, and what failed.
#[derive(Debug, Default)]
pub struct Results {
    kept: BTreeMap<Key, (Kept, usize, u64)>,
    failed: BTreeMap<Key, String>,
    /// Failures of the worker itself, which may succeed another time.
    broken: BTreeSet<Key>,
    bytes: usize,
    age: u64,
}

impl Results {
    /// Keeps an answer. False for one that is not kept here.
    pub(super) fn keep(&mut self, key: Key, answer: Answer, bytes: usize) -> bool {
        let kept = match answer {
            Answer::Photograph(answer) => Kept::Photograph(Rc::new(answer)),
            Answer::Features(answer) => Kept::Features(Rc::new(answer)),
            Answer::Matches(answer) => Kept::Matches(Rc::new(answer)),
            Answer::TwoViews(answer) => Kept::TwoViews(Rc::new(answer)),
            Answer::Reconstruction(answer) => Kept::Reconstruction(Rc::new(answer)),
            Answer::Depth(answer) => Kept::Depth(Rc::new(answer)),
            Answer::Board(answer) => Kept::Board(Rc::new(answer)),
            Answer::Calibration(answer) => Kept::Calibration(Rc::new(answer)),
            Answer::Archive(_) | Answer::Opened { .. } | Answer::Frames(_) => return false,
        };
        self.failed.remove(&key);
        self.age += 1;
        if let Some((_, before, _)) = self.kept.insert(key, (kept, bytes, self.age)) {
            self.bytes -= before;
        }
        self.bytes += bytes;
        true
    }

    pub(super) fn fail(&mut self, key: Key, sentence: String) {
        self.failed.insert(key, sentence);
    }

    /// The same for a failure of the worker itself.
    pub(super) fn break_down(&mut self, key: Key, sentence: String) {
        self.fail(key, sentence);
        self.broken.insert(key);
    }

    /// Forgets that anything broke down.
    pub(super) fn try_again(&mut self) {
        for key in std::mem::take(&mut self.broken) {
            self.failed.remove(&key);
        }
    }

    /// Keys of failed computations.
    pub(super) fn broken(&self) -> &BTreeSet<Key> {
        &self.broken
    }

    /// Drops the oldest results that are not `needed`, if the memory limit is exceeded.
    pub(super) fn tidy(&mut self, needed: impl Fn(Key) -> bool) {
        if self.bytes <= MAX_BYTES {
            return;
        }
        let spare = self.kept.iter().filter(|(key, _)| !needed(**key));
        let mut spare: Vec<(u64, Key)> = spare.map(|(key, (_, _, age))| (*age, *key)).collect();
        spare.sort_unstable();
        for (_, key) in spare {
            if self.bytes <= MAX_BYTES {
                break;
            }
            if let Some((_, bytes, _)) = self.kept.remove(&key) {
                self.bytes -= bytes;
            }
        }
    }

    /// Whether there is an answer, or an error message. A photograph whose pixels were never loaded
    /// does not count.
    pub(super) fn is_settled(&self, key: Key) -> bool {
        let is_there = match self.get(key) {
            Some(Kept::Photograph(found)) => found.was_read(),
            Some(_) => true,
            None => false,
        };
        is_there || self.failed.contains_key(&key)
    }

    /// The error message of a failed result.
    pub fn failure(&self, key: Key) -> Option<&str> {
        self.failed.get(&key).map(String::as_str)
    }

    /// A cached result of any kind.
    pub(super) fn get(&self, key: Key) -> Option<&Kept> {
        self.kept.get(&key).map(|(kept, _, _)| kept)
    }

    /// The photograph of this name, with its pixels.
    pub fn photograph(&self, key: Key) -> Option<&Rc<Photograph>> {
        self.frame(key).filter(|found| found.has_pixels())
    }

    /// The same, with or without its pixels: its size and its lens.
    pub(super) fn frame(&self, key: Key) -> Option<&Rc<Photograph>> {
        match self.get(key)? {
            Kept::Photograph(found) => Some(found),
            _ => None,
        }
    }

    /// The photographs with their pixels, those that came first first.
    pub(super) fn at_hand(&self) -> Vec<Key> {
        let with_pixels = |kept: &Kept| match kept {
            Kept::Photograph(found) => found.has_pixels(),
            _ => false,
        };
        let all = self.kept.iter().filter(|(_, (kept, ..))| with_pixels(kept));
        let mut all: Vec<(u64, Key)> = all.map(|(key, (.., age))| (*age, *key)).collect();
        all.sort_unstable();
        all.into_iter().map(|(_, key)| key).collect()
    }

    /// Drops the pixels of a photograph, but keeps its thumbnail.
    pub(super) fn let_go(&mut self, key: Key) {
        if let Some((Kept::Photograph(found), bytes, _)) = self.kept.get_mut(&key) {
            *bytes = bytes.saturating_sub(found.rgb.len());
            self.bytes = self.bytes.saturating_sub(found.rgb.len());
            let small = Photograph {
                rgb: Blob::default(),
                ..(**found).clone()
            };
            *found = Rc::new(small);
        }
    }

    /// The features of this name.
    pub fn features(&self, key: Key) -> Option<&Rc<Features>> {
        match self.get(key)? {
            Kept::Features(found) => Some(found),
            _ => None,
        }
    }

    /// The matches of this name.
    pub fn matches(&self, key: Key) -> Option<&Rc<Vec<Match>>> {
        match self.get(key)? {
            Kept::Matches(found) => Some(found),
            _ => None,
        }
    }

    /// The pair of this name.
    pub fn two_views(&self, key: Key) -> Option<&Rc<TwoViews>> {
        match self.get(key)? {
            Kept::TwoViews(found) => Some(found),
            _ => None,
        }
    }

    /// The reconstruction of this name.
    pub fn reconstruction(&self, key: Key) -> Option<&Rc<Reconstructed>> {
        match self.get(key)? {
            Kept::Reconstruction(found) => Some(found),
            _ => None,
        }
    }

    /// The depth of this name.
    pub fn depth(&self, key: Key) -> Option<&Rc<Dense>> {
        match self.get(key)? {
            Kept::Depth(found) => Some(found),
            _ => None,
        }
    }

    /// The board of this name.
    pub fn board(&self, key: Key) -> Option<&Rc<BoardFound>> {
        match self.get(key)? {
            Kept::Board(found) => Some(found),
            _ => None,
        }
    }

    /// The calibration of this name.
    pub fn calibration(&self, key: Key) -> Option<&Rc<Calibration>> {
        match self.get(key)? {
            Kept::Calibration(found) => Some(found),
            _ => None,
        }
    }
}
