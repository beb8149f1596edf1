//! Missing outputs, most urgent first, and their arrival.

use crate::project::{InputPhoto, Key, PhotoId, Project, Step, pairs};
use crate::tasks::{AnyQuery, FeaturesOf, MatchesOf, Query, Request};
use std::collections::{BTreeMap, BTreeSet};

/// A missing output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pending {
    /// Its key.
    pub key: Key,
    /// The query to answer.
    pub query: AnyQuery,
}

impl Pending {
    /// Returns the task that computes it; `None` if the project has changed since.
    pub fn request(&self, project: &Project) -> Option<Request> {
        self.query.request(project)
    }
}

impl Project {
    /// Returns missing outputs whose inputs are available, most urgent first.
    pub fn pending(&self) -> Vec<Pending> {
        match self.paused {
            true => Vec::new(),
            false => self.missing(),
        }
    }

    /// Body of [`Project::pending`], also valid while computing is paused.
    pub(super) fn missing(&self) -> Vec<Pending> {
        let to_describe = self.to_describe();
        let mut queries = AnyQuery::all(self);
        queries.sort_by_key(|query| query.priority(self));
        let mut keys = BTreeSet::new();
        let mut pending = Vec::new();
        for query in queries {
            let Some(key) = query.key(self) else { continue };
            let is_incomplete = match query {
                AnyQuery::Photograph(_) => self.rereading.contains(&key),
                AnyQuery::Features(FeaturesOf(id)) => to_describe.contains(&id),
                _ => false,
            };
            if (is_incomplete || !query.is_settled(self))
                && query.is_ready(self, self.imported.contains_key(&key))
                && keys.insert(key)
            {
                pending.push(Pending { key, query });
            }
        }
        pending
    }

    /// Returns photographs whose features came without descriptors that are now needed for display
    /// or for new matches.
    pub(super) fn to_describe(&self) -> BTreeSet<PhotoId> {
        let photos = self.taking_part();
        let is_bare = |photo: &InputPhoto| {
            let found = self.get(FeaturesOf(photo.id));
            self.shown(photo).is_some() && found.is_some_and(|found| !found.has_descriptors())
        };
        if !photos.iter().any(|photo| is_bare(photo)) {
            return BTreeSet::new();
        }
        let is_open = |first: &InputPhoto, second: &InputPhoto| {
            let query = MatchesOf(first.id, second.id);
            !query.is_settled(self) && !self.is_imported(query)
        };
        let open = pairs(&photos).filter(|(first, second)| is_open(first, second));
        let looked_at = (self.view.step == Step::Features).then_some(self.view.photo);
        (open.flat_map(|(first, second)| [first, second]))
            .chain(looked_at.and_then(|id| self.document.photo(id)))
            .filter(|photo| is_bare(photo))
            .map(|photo| photo.id)
            .collect()
    }

    /// Whether an output is available from the project's file but has not been needed yet.
    pub(super) fn is_imported(&self, query: impl Query) -> bool {
        let key = query.key(self);
        key.is_some_and(|key| self.imported.contains_key(&key))
    }

    /// Returns all queries of the current document whose keys are known.
    pub(super) fn needed(&self) -> BTreeMap<Key, AnyQuery> {
        let queries = AnyQuery::all(self).into_iter();
        queries
            .filter_map(|query| Some((query.key(self)?, query)))
            .collect()
    }

    /// Takes an output as bytes, or the error message of its task. Keeps outputs that are no longer
    /// needed: undo may need them.
    pub fn done(&mut self, pending: &Pending, result: Result<Vec<u8>, String>) {
        let Pending { key, query } = *pending;
        self.revision += 1;
        self.cache.drop_partial(key);
        let num_bytes = result.as_ref().map_or(0, Vec::len);
        match result.and_then(|bytes| query.read(&bytes)) {
            Ok(output) => self.cache.insert(key, output, num_bytes),
            Err(_) if self.rereading.contains(&key) => drop(self.unread.insert(key)),
            Err(sentence) => self.cache.fail(key, sentence),
        }
        self.note_result();
        let needed = self.needed();
        self.cache.evict(|key| needed.contains_key(&key));
        self.take_imported();
        self.balance_pixels();
    }

    /// Takes the message of a failure that is not due to the input, such as lack of memory or a
    /// bug. [`Event::TryAgain`](super::Event::TryAgain) computes the output again.
    pub fn broke_down(&mut self, pending: &Pending, sentence: String) {
        let key = pending.key;
        self.revision += 1;
        self.cache.drop_partial(key);
        match self.rereading.contains(&key) {
            true => drop(self.unread.insert(key)),
            false => self.cache.crash(key, sentence),
        }
        self.balance_pixels();
    }

    /// Takes an intermediate output of a running task. Invalid ones are ignored.
    pub fn so_far(&mut self, pending: &Pending, bytes: &[u8]) {
        if let Ok(output) = pending.query.read(bytes) {
            // The revision does not change, since no pending output has changed.
            self.cache.set_partial(pending.key, output);
        }
    }

    /// Whether the worker failed for an output that is needed.
    pub fn can_try_again(&self) -> bool {
        let crashed = self.cache.crashed();
        let mut failed = crashed.iter().chain(&self.unread).peekable();
        failed.peek().is_some() && {
            let needed = self.needed();
            failed.any(|key| needed.contains_key(key))
        }
    }
}
