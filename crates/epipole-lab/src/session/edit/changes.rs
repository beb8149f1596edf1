//! Difference between the current reconstruction and the one before.

use crate::project::{Found, Project};
use crate::tasks::{Query, ReconstructionOfAll};

impl Project {
    /// Takes the numbers of the current reconstruction, if there is one.
    pub(in crate::session) fn note_result(&mut self) {
        let Some(key) = ReconstructionOfAll.key(self) else {
            return;
        };
        if (self.results.now.as_ref()).is_some_and(|now| now.key == key) {
            return;
        }
        let Some(found) = self.get(ReconstructionOfAll) else {
            return;
        };
        let component = found.components.first();
        let found = Found {
            key,
            photos: self.taking_part().iter().map(|photo| photo.id).collect(),
            num_registered: component.map_or(0, |component| component.num_registered()),
            num_points: component.map_or(0, |component| component.points.len()),
            mean_error_px: found.mean_error_px.first().copied().unwrap_or(0.0),
        };
        self.results.take(found);
    }

    /// Describes the difference between the current reconstruction and the one before, of their
    /// largest components; `None` without one before.
    pub fn change_words(&self) -> Option<String> {
        let (now, before) = (self.results.now.as_ref()?, self.results.before.as_ref()?);
        if ReconstructionOfAll.key(self) != Some(now.key) {
            return None;
        }
        Some(format!(
            "Change since the last result: {} to {} registered, {} to {} points, mean error {:.3} to {:.3} px.",
            before.num_registered,
            now.num_registered,
            before.num_points,
            now.num_points,
            before.mean_error_px,
            now.mean_error_px
        ))
    }
}
