//! Level of detail of textures and light maps.

/// Level of detail of textures and light maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Detail {
    /// Every cell.
    Full,
    /// For drafts: a sixteenth of the light cells and a 64th of the texels.
    Sketch,
}

impl Detail {
    pub(crate) fn side(self, cells: usize) -> usize {
        match self {
            Self::Full => cells,
            Self::Sketch => cells.div_ceil(4),
        }
    }
}
