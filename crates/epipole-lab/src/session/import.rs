//! Outputs in files of projects and of the sample. Files are untrusted: an output is read when it
//! is needed, and used only if it is valid.

use crate::project::{COMPUTED_BY, Computed, Key, Project};
use crate::tasks::Destination;

impl Project {
    /// Imports outputs, replacing unused ones of an earlier call. Invalid outputs, and those of
    /// another build, are ignored and computed again.
    pub fn import(&mut self, computed: Computed) {
        self.imported.clear();
        if computed.by == COMPUTED_BY {
            let results = computed.results.into_iter();
            self.imported = results.map(|(key, bytes)| (Key(key), bytes)).collect();
        }
        self.revision += 1;
        self.take_imported();
    }

    /// Takes the outputs needed now, repeatedly, as each can make further ones possible.
    pub(super) fn take_imported(&mut self) {
        let mut is_new = true;
        while is_new && !self.imported.is_empty() {
            is_new = false;
            for pending in self.pending() {
                let Some(bytes) = self.imported.remove(&pending.key) else {
                    continue;
                };
                if let Some(output) = pending.query.import(self, &bytes) {
                    self.cache.insert(pending.key, output, bytes.len());
                    is_new = true;
                }
            }
        }
    }

    /// Returns outputs worth saving, without pixels, which come from the files.
    pub(super) fn computed(&self) -> Computed {
        self.computed_for(Destination::Project)
    }

    /// Returns the outputs of a sample, in a compact form.
    pub fn light_computed(&self) -> Computed {
        self.computed_for(Destination::Sample)
    }

    fn computed_for(&self, destination: Destination) -> Computed {
        let needed = self.needed().into_iter();
        let bytes = |(key, query): (Key, crate::tasks::AnyQuery)| {
            Some((key.0, query.stored(self, destination)?.into()))
        };
        Computed {
            by: COMPUTED_BY.to_owned(),
            results: needed.filter_map(bytes).collect(),
        }
    }
}
