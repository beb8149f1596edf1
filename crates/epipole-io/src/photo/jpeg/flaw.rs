//! Flaws of the data.

/// Flaw of a data segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// A marker or the end of the file in place of codes.
    Ends,
    /// A code missing in the table, or a coefficient beyond the block.
    Senseless,
    /// More blocks than the image has.
    Surplus,
}
