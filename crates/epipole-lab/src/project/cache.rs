//! Outputs of tasks, cached under a hash of their inputs, so that undo is instant.

use super::key::Key;
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

/// Maximum size of all outputs, bytes; beyond it the oldest are dropped.
const MAX_BYTES: usize = 600_000_000;

#[derive(Debug)]
struct Entry {
    output: Box<dyn Any>,
    num_bytes: usize,
    /// Number of outputs inserted before.
    age: u64,
}

/// Outputs and error messages of tasks.
#[derive(Debug, Default)]
pub(crate) struct Cache {
    outputs: BTreeMap<Key, Entry>,
    failures: BTreeMap<Key, String>,
    /// Tasks whose worker failed; they may succeed when retried.
    crashed: BTreeSet<Key>,
    /// Intermediate output of a running task.
    partial: Option<(Key, Box<dyn Any>)>,
    num_bytes: usize,
    age: u64,
}

impl Cache {
    /// Returns the output of a key, if it exists with this type.
    pub(crate) fn get<T: Any>(&self, key: Key) -> Option<&T> {
        self.outputs.get(&key)?.output.downcast_ref()
    }

    /// Inserts an output of this size.
    pub(crate) fn insert(&mut self, key: Key, output: Box<dyn Any>, num_bytes: usize) {
        self.failures.remove(&key);
        self.age += 1;
        let entry = Entry {
            output,
            num_bytes,
            age: self.age,
        };
        if let Some(before) = self.outputs.insert(key, entry) {
            self.num_bytes -= before.num_bytes;
        }
        self.num_bytes += num_bytes;
    }

    /// Stores the error message of a failed task.
    pub(crate) fn fail(&mut self, key: Key, sentence: String) {
        self.failures.insert(key, sentence);
    }

    /// Stores the message of a worker that failed.
    pub(crate) fn crash(&mut self, key: Key, sentence: String) {
        self.fail(key, sentence);
        self.crashed.insert(key);
    }

    /// Error message of a failed task.
    pub(crate) fn failure(&self, key: Key) -> Option<&str> {
        self.failures.get(&key).map(String::as_str)
    }

    /// Keys of tasks whose worker failed.
    pub(crate) fn crashed(&self) -> &BTreeSet<Key> {
        &self.crashed
    }

    /// Forgets the failures of workers.
    pub(crate) fn retry(&mut self) {
        for key in std::mem::take(&mut self.crashed) {
            self.failures.remove(&key);
        }
    }

    /// Intermediate output of a running task.
    pub(crate) fn partial<T: Any>(&self, key: Key) -> Option<&T> {
        let (of, output) = self.partial.as_ref()?;
        output.downcast_ref().filter(|_| *of == key)
    }

    /// Replaces the intermediate output.
    pub(crate) fn set_partial(&mut self, key: Key, output: Box<dyn Any>) {
        self.partial = Some((key, output));
    }

    /// Drops the intermediate output of a task that has ended.
    pub(crate) fn drop_partial(&mut self, key: Key) {
        self.partial.take_if(|(of, _)| *of == key);
    }

    /// Returns all outputs of one type, oldest first.
    pub(crate) fn of_type<T: Any>(&self) -> Vec<(Key, &T)> {
        let outputs = self.outputs.iter();
        let of_type = |(key, entry): (&Key, &Entry)| (entry.age, *key);
        let mut ages: Vec<(u64, Key)> = outputs.map(of_type).collect();
        ages.sort_unstable();
        let output = |(_, key)| Some((key, self.get(key)?));
        ages.into_iter().filter_map(output).collect()
    }

    /// Shrinks an output.
    ///
    /// * `shrink`: changes the output; returns the number of bytes freed
    pub(crate) fn shrink<T: Any>(&mut self, key: Key, shrink: impl FnOnce(&mut T) -> usize) {
        if let Some(entry) = self.outputs.get_mut(&key)
            && let Some(output) = entry.output.downcast_mut()
        {
            let freed = shrink(output).min(entry.num_bytes);
            entry.num_bytes -= freed;
            self.num_bytes -= freed;
        }
    }

    /// Drops the oldest outputs that are not needed, if the memory limit is exceeded.
    pub(crate) fn evict(&mut self, is_needed: impl Fn(Key) -> bool) {
        if self.num_bytes <= MAX_BYTES {
            return;
        }
        let spare = self.outputs.iter().filter(|(key, _)| !is_needed(**key));
        let mut spare: Vec<(u64, Key)> = spare.map(|(key, entry)| (entry.age, *key)).collect();
        spare.sort_unstable();
        for (_, key) in spare {
            if self.num_bytes <= MAX_BYTES {
                break;
            }
            if let Some(entry) = self.outputs.remove(&key) {
                self.num_bytes -= entry.num_bytes;
            }
        }
    }
}
