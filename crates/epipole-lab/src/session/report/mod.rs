//! Facts and texts about the project: outcomes of photographs, measures, recipes.

mod all_views_words;
mod boards;
mod calibration_words;
mod control;
mod export;
mod figures;
mod floor;
mod known_poses;
mod measure;
mod measures;
mod outcome;
mod recipe;
mod reconstruction_words;
mod scale;
mod shape;
mod step_state;
mod verdict;
mod words;

pub use boards::BoardOutcome;
pub use control::Alignment;
pub use floor::Floor;
pub use measure::Length;
pub use scale::{Disagreement, Scale, ScaleBar, ScaleSource};
pub use step_state::StepState;
pub use verdict::{Suggestion, Verdict};
#[cfg(feature = "panels")]
pub(crate) use words::count;
