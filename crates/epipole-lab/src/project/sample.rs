//! Samples of rendered photographs: sets that work, sets that fail for different reasons, and a
//! board.

use serde::{Deserialize, Serialize};

/// Set of rendered photographs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Sample {
    /// Nine photographs around a table.
    Table,
    /// A camera that only rotates.
    Turned,
    /// A single photograph.
    Alone,
    /// The same photograph twice.
    Twice,
    /// A poster from four positions.
    Plane,
    /// Three photographs of one scene, and three of another.
    Mixed,
    /// Five photographs by one camera, two of them in portrait format.
    Upright,
    /// A chessboard for calibration.
    Board,
}

impl Sample {
    /// All samples except for the board.
    pub const ALL: [Self; 7] = [
        Self::Table,
        Self::Upright,
        Self::Plane,
        Self::Mixed,
        Self::Turned,
        Self::Twice,
        Self::Alone,
    ];

    /// Returns its title.
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

    /// Returns the number of photographs.
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

    /// Returns false: every sample has a photograph.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Returns the name of a photograph.
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
