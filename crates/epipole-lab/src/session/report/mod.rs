//! Facts and texts about the project: outcomes of photographs, measures, recipes.

mod all_views_words;
mod boards;
mod calibration_words;
mod export;
mod floor;
mod known_poses;
mod measure;
mod outcome;
mod recipe;
mod reconstruction_words;
mod step_state;
mod verdict;
mod words;

pub use boards::BoardOutcome;
pub use floor::Floor;
pub use measure::{Length, Scale};
pub use step_state::StepState;
pub use verdict::{Suggestion, Verdict};
#[cfg(feature = "panels")]
pub(crate) use words::count;
