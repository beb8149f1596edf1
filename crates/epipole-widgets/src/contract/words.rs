//! Text of a figure: its numbers and its description.

use super::Readout;

/// A model's numbers and description. Implemented in a separate file, which the model never calls.
pub trait Words {
    /// Returns the numbers beside the picture, all finite; two to four of them are
    /// [`main`](Readout::main).
    fn readouts(&self) -> Vec<Readout>;

    /// Describes the current state in one or two plain sentences.
    fn describe(&self) -> String;
}
