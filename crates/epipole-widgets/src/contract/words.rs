//! What a figure says: its numbers and its sentences.

use super::Readout;

/// What a model shows in numbers and in words. Implemented beside the model, which never needs it.
pub trait Words {
    /// The numbers beside the picture; two to four of them are [`main`](Readout::main). Every number
    /// is finite.
    fn readouts(&self) -> Vec<Readout>;

    /// What the figure shows now, in one or two plain sentences.
    fn describe(&self) -> String;
}
