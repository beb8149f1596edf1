//! Rendered photographs: one set that works, and some that cannot, each with its reason; and one of
//! a board.

use serde::{Deserialize, Serialize};

/// A set of rendered photographs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Sample {
    /// Nine photographs around a table.
    Table,
    /// A camera that only rotates.
    Turned,
    /// One photograph alone.
    Alone,
    /// One photograph twice.
    Twice,
    /// A poster from four places.
    Plane,
    /// Three photographs of one place, and three of another.
    Mixed,
    /// Five photographs by one camera, two of them in portrait format.
    Upright,
    /// A chessboard, to calibrate a camera with.
    Board,
}

impl Sample {
    /// All that can be reconstructed, or not.
    pub const ALL: [Self; 7] = [
        Self::Table,
        Self::Upright,
        Self::Plane,
        Self::Mixed,
        Self::Turned,
        Self::Twice,
        Self::Alone,
    ];

    /// Title in a few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Table => "A table, nine photographs",
            Self::Turned => "A camera that only turned",
            Self::Alone => "One photograph alone",
            Self::Twice => "One photograph twice",
            Self::Plane => "A flat poster",
            Self::Mixed => "Two places mixed",
            Self::Upright => "Mixed orientations",
            Self::Board => "A chessboard, ten photographs",
        }
    }

    /// Number of photographs.
    pub fn len(self) -> u8 {
        match self {
            Self::Table => 9,
            Self::Turned => 4,
            Self::Alone => 1,
            Self::Twice => 2,
            Self::Plane => 4,
            Self::Mixed => 6,
            Self::Upright => 5,
            Self::Board => 10,
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
            Self::Alone => "alone",
            Self::Twice => "twice",
            Self::Plane => "poster",
            Self::Mixed => "mixed",
            Self::Upright => "held",
            Self::Board => "board",
        };
        format!("{place}-{}.png", index + 1)
    }
}
