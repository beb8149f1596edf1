//! Flaws of the data.

/// Flaw of a segment of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// A marker, or the end of the file, is where codes should be.
    Ends,
    /// A code that the table does not have, or a coefficient beyond the block.
    Senseless,
    /// More blocks than the picture has.
    Surplus,
}
