//! Storage of the project in the browser, if the reader has chosen it: when to write, and the state
//! of what is stored.

use crate::project::Key;

/// Time without changes before they are written, seconds.
const REST_S: f64 = 1.0;

/// State of the stored project.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum State {
    /// Nothing is stored.
    #[default]
    Empty,
    /// A project other than the open one is stored.
    Closed,
    /// The open project is stored, with every change.
    Open,
}

/// Project stored in the browser.
#[derive(Default)]
pub(crate) struct Storage {
    state: State,
    /// Key of the stored version, or of the one being written.
    written: Option<Key>,
    /// Key of the version to be written, and the time of the last change, seconds.
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

    /// Starts to store the open project.
    pub(crate) fn turn_on(&mut self) {
        self.state = State::Open;
        self.is_new = true;
    }

    /// Stops storing.
    pub(crate) fn turn_off(&mut self) {
        *self = Self::default();
    }

    /// Notes that a project is stored which is not open.
    pub(crate) fn close(&mut self) {
        *self = Self::default();
        self.state = State::Closed;
    }

    /// Notes that the stored project was restored, with this key.
    pub(crate) fn restored(&mut self, key: Key) {
        *self = Self {
            state: State::Open,
            written: Some(key),
            is_restored: true,
            ..Self::default()
        };
    }

    /// Returns the seconds until the open project is to be written; `None` if it is unchanged.
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

    /// Notes that the version with this key is being written.
    pub(crate) fn begin(&mut self, key: Key) {
        self.written = Some(key);
    }

    /// Notes that a version was written. True for the first one since [`Storage::turn_on`].
    pub(crate) fn end(&mut self) -> bool {
        std::mem::take(&mut self.is_new)
    }
}
