//! Rendered photographs: one set that works, and some that cannot, each with its reason.

use serde::{Deserialize, Serialize};

/// The photographs of [`Sample::Mixed`] from this one on show another place.
pub(super) const MIRRORED_FROM: u8 = 4;

/// A set of rendered photographs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Sample {
    /// Nine photographs around a table.
    Table,
    /// A camera that only turns.
    Turned,
    /// Two places mixed: a room, and one that is its mirror image.
    Mixed,
    /// One photograph alone.
    Alone,
    /// One photograph twice.
    Twice,
}

impl Sample {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Table,
        Self::Turned,
        Self::Mixed,
        Self::Alone,
        Self::Twice,
    ];

    /// What it is, in a few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Table => "A table, nine photographs",
            Self::Turned => "A camera that only turned",
            Self::Mixed => "Two places mixed",
            Self::Alone => "One photograph alone",
            Self::Twice => "One photograph twice",
        }
    }

    /// How many photographs it has.
    pub fn len(self) -> u8 {
        match self {
            Self::Table => 9,
            Self::Turned => 4,
            Self::Mixed => 7,
            Self::Alone => 1,
            Self::Twice => 2,
        }
    }

    /// False: every sample has a photograph.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The name of a photograph.
    pub fn name(self, index: u8) -> String {
        let place = match self {
            Self::Table => "table",
            Self::Turned => "turned",
            Self::Mixed if index >= MIRRORED_FROM => "mirror",
            Self::Mixed | Self::Alone => "table",
            Self::Twice => "twice",
        };
        format!("{place}-{}.png", index + 1)
    }
}
