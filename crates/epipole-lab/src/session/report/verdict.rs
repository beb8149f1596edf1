//! Verdict on the reconstruction: whether it is sound, and the next step if it is not.

use super::words::count;
use crate::project::{Outcome, Project, Step};
use crate::session::Event;
use crate::tasks::ReconstructionOfAll;

/// Verdict on the current component of the reconstruction. The first that applies is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No photographs could be joined.
    Nothing,
    /// The photographs do not determine the focal length.
    FocalUnsure,
    /// All pairs show a plane, which does not determine the focal length.
    Flat,
    /// Several components, with their number.
    Parts(usize),
    /// Photographs without a camera, with their number.
    LeftOut(usize),
    /// Lens distortion was found and corrected.
    LensCorrected,
    /// None of these.
    Sound,
}

/// Step that a verdict suggests.
#[derive(Debug, Clone, PartialEq)]
pub enum Suggestion {
    /// Change the project or the view, with a label.
    Send(&'static str, Vec<Event>),
    /// Add photographs.
    AddPhotographs,
}

impl Project {
    /// Returns the verdict on the reconstruction; `None` until it has ended.
    pub fn verdict(&self) -> Option<Verdict> {
        if self.failure(ReconstructionOfAll).is_some() {
            return Some(Verdict::Nothing);
        }
        let found = self.get(ReconstructionOfAll)?;
        if self.component().is_none() {
            return Some(Verdict::Nothing);
        }
        let counts = |outcome: &Outcome| !matches!(outcome, Outcome::Excluded);
        let left_out = self.left_out();
        let num_left_out = left_out
            .iter()
            .filter(|(_, outcome)| counts(outcome))
            .count();
        Some(match found.components.len() {
            _ if self.is_flat() => Verdict::Flat,
            _ if !self.knows_focal() => Verdict::FocalUnsure,
            parts @ 2.. => Verdict::Parts(parts),
            _ if num_left_out > 0 => Verdict::LeftOut(num_left_out),
            _ if self.before_correction_px().is_some() => Verdict::LensCorrected,
            _ => Verdict::Sound,
        })
    }

    /// Returns the next steps that the verdict suggests, most useful first.
    pub fn suggestions(&self, verdict: Verdict) -> Vec<Suggestion> {
        let show = |label, step| Suggestion::Send(label, vec![Event::Show(step)]);
        match verdict {
            Verdict::Nothing | Verdict::LeftOut(_) => vec![
                show("See why", Step::Photographs),
                Suggestion::AddPhotographs,
            ],
            Verdict::FocalUnsure | Verdict::Flat => vec![
                show("Type focal length", Step::Photographs),
                show("Calibrate the camera", Step::Calibrate),
                Suggestion::AddPhotographs,
            ],
            Verdict::Parts(parts) => {
                let other = (self.view.component + 1) % parts;
                vec![
                    Suggestion::Send("Other part", vec![Event::LookAtComponent(other)]),
                    Suggestion::AddPhotographs,
                ]
            }
            Verdict::LensCorrected | Verdict::Sound => {
                let mut all = vec![show("Measure a length", Step::Measure)];
                if !self.document.all_views {
                    let events = vec![Event::AllViews(true), Event::Show(Step::Depth)];
                    all.push(Suggestion::Send("Depth of all views", events));
                }
                all.push(show("Save files", Step::Export));
                all
            }
        }
    }
}

impl Verdict {
    /// Whether the reconstruction can be used without changes.
    pub fn is_sound(self) -> bool {
        matches!(self, Self::Sound | Self::LensCorrected)
    }

    /// Returns its title.
    pub fn title(self) -> String {
        match self {
            Self::Nothing => "Nothing reconstructed".to_owned(),
            Self::FocalUnsure | Self::Flat => "Focal length unsure".to_owned(),
            Self::Parts(parts) => count(parts, "part"),
            Self::LeftOut(photos) => format!("{} left out", count(photos, "photograph")),
            Self::LensCorrected => "Sound reconstruction, lens corrected".to_owned(),
            Self::Sound => "Sound reconstruction".to_owned(),
        }
    }

    /// Explains reason and consequence in a sentence.
    pub fn explanation(self) -> &'static str {
        match self {
            Self::Nothing => "No photographs could be joined. Each says why.",
            Self::FocalUnsure => {
                "The photographs do not tell the focal length: the one found may be far off, and so may all depths. Cameras \
                 that move along a line without turning fit any. Type it, calibrate, or add photographs from other sides."
            }
            Self::Flat => {
                "Every pair shows a plane and nothing else, and a plane does not tell the focal length: cameras and points are \
                 right only if the focal length is. Type it, calibrate, or add photographs of something with depth."
            }
            Self::Parts(_) => {
                "Nothing joins them: sizes and positions of one say nothing of the others. Add photographs that show both."
            }
            Self::LeftOut(_) => "The others agree. Photographs in between may bring these in.",
            Self::LensCorrected => {
                "Cameras and points agree after the radial distortion of the lens was corrected. Sizes are known up to scale."
            }
            Self::Sound => "Cameras and points agree. Sizes are known up to scale.",
        }
    }
}
