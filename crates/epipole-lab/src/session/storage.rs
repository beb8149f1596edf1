//! The project that the browser stores at the choice of the reader: when it is written, and what is
//! known about it.

use crate::project::Key;

/// Time without changes after which they are stored, seconds.
const REST_S: f64 = 1.0;

/// State of the stored project.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum State {
    /// None is stored.
    #[default]
    Empty,
    /// A project that is not open.
    Closed,
    /// The open project, with every change.
    Open,
}

/// Storage of the project in the browser.
#[derive(Default)]
pub(crate) struct Storage {
    state: State,
    /// Key of the stored version, or of the one being written.
    written: Option<Key>,
    /// Key of a changed version, and the time of the change in seconds.
    changed: Option<(Key, f64)>,
    /// Whether to confirm the first write to the reader.
    is_new: bool,
    /// Whether the open project was just restored.
    pub(crate) is_restored: bool,
}

impl Storage {
    /// Whether nothing is stored.
    pub(crate) fn is_empty(&self) -> bool {
        self.state == State::Empty
    }

    /// Whether a project is stored that is not open.
    pub(crate) fn is_closed(&self) -> bool {
        self.state == State::Closed
    }

    /// Whether the open project is stored with every change.
    pub(crate) fn is_open(&self) -> bool {
        self.state == State::Open
    }

    /// Stores the open project from now on.
    pub(crate) fn turn_on(&mut self) {
        self.state = State::Open;
        self.is_new = true;
    }

    /// Stores nothing from now on.
    pub(crate) fn turn_off(&mut self) {
        *self = Self::default();
    }

    /// A project is stored that is not open.
    pub(crate) fn close(&mut self) {
        *self = Self::default();
        self.state = State::Closed;
    }

    /// The stored project was restored; its version has this key.
    pub(crate) fn restored(&mut self, key: Key) {
        *self = Self {
            state: State::Open,
            written: Some(key),
            is_restored: true,
            ..Self::default()
        };
    }

    /// Seconds until the open project is to be written; `None` if it is stored as it is.
    ///
    /// * `key`: key of the open project
    /// * `now_s`: current time, seconds
    pub(crate) fn wait_s(&mut self, key: Key, now_s: f64) -> Option<f64> {
        if self.written == Some(key) {
            self.changed = None;
            return None;
        }
        let since_s = match self.changed {
            Some((changed, since_s)) if changed == key => since_s,
            _ => {
                self.changed = Some((key, now_s));
                now_s
            }
        };
        Some(since_s + REST_S - now_s)
    }

    /// The version of this key is being written.
    pub(crate) fn begin(&mut self, key: Key) {
        self.written = Some(key);
    }

    /// A version was written. True for the first one since [`Storage::turn_on`].
    pub(crate) fn end(&mut self) -> bool {
        std::mem::take(&mut self.is_new)
    }
}
