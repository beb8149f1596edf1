//! Description of the current view, for screen readers and as a summary.

use crate::project::{InputPhoto, Outcome, Project, Step, pairs};
use crate::tasks::{
    DepthOf, FeaturesOf, FocalOrigin, MatchesOf, PhotographOf, Query, ReconstructionOfAll, Shows,
    TwoViews, TwoViewsOf, ViewModel,
};

/// Counts items: "1 photograph", "2 photographs".
pub(crate) fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {what}"),
        _ => format!("{number} {what}s"),
    }
}

impl Project {
    /// Describes the current step.
    pub fn describe(&self) -> String {
        if self.document.photos.is_empty() && self.view.step != Step::Calibrate {
            return "No photographs yet. Add two or more of one thing, taken from different places, or open a \
                    sample."
                .to_owned();
        }
        let mut words = match self.view.step {
            Step::Photographs => self.photographs_words(),
            Step::Calibrate => self.calibrate_words(),
            Step::Features => self.features_words(),
            Step::Matches => self.matches_words(),
            Step::TwoViews => self.two_views_words(),
            Step::Reconstruction => self.reconstruction_words(),
            Step::Depth => match self.document.all_views {
                true => format!("{} {}", self.depth_words(), self.all_views_words()),
                false => self.depth_words(),
            },
            Step::Measure => self.measure_words(),
            Step::Export => self.export_words(),
        };
        if self.paused {
            words.push_str(" Computation is stopped.");
        }
        words
    }

    pub(super) fn photographs_words(&self) -> String {
        let mut words = format!("{}.", count(self.document.photos.len(), "photograph"));
        words.push_str(&self.orientation_words());
        for photo in &self.document.photos {
            let outcome = self.outcome(photo);
            if !matches!(outcome, Outcome::Registered(_) | Outcome::Pending) {
                words.push_str(&format!(" {}: {}.", photo.name, self.outcome_words(photo)));
            }
        }
        words
    }

    /// Describes the consequence of mixed portrait and landscape photographs; empty if all are
    /// alike.
    pub fn orientation_words(&self) -> String {
        let sizes = |is_upright: bool| {
            let photos = self.taking_part().into_iter();
            let pixels = photos.filter_map(|photo| self.get(PhotographOf(photo.id)));
            let sizes = pixels.map(|pixels| pixels.full_size);
            sizes
                .filter(move |(w, h)| if is_upright { h > w } else { w > h })
                .count()
        };
        match (sizes(true), sizes(false)) {
            (0, _) | (_, 0) => String::new(),
            (upright, lying) => format!(
                " {upright} are upright and {lying} are landscape. They still go together: each has its principal point at its own \
                 center, and one common factor refines all focal lengths."
            ),
        }
    }

    fn features_words(&self) -> String {
        let Some(photo) = self.document.photo(self.view.photo) else {
            return String::new();
        };
        match self.get(FeaturesOf(photo.id)) {
            Some(found) => format!("{}: {}.", photo.name, count(found.list.len(), "feature")),
            None => match self.outcome(photo) {
                Outcome::Unreadable(_) => format!("{}: {}.", photo.name, self.outcome_words(photo)),
                _ => format!("{}: looking for features.", photo.name),
            },
        }
    }

    fn matches_words(&self) -> String {
        let photos = self.taking_part();
        let (mut count, mut joined, mut strongest) = (0, 0, None);
        for (first, second) in pairs(&photos) {
            count += 1;
            if let Some(pair) = self.get(TwoViewsOf(first.id, second.id)) {
                joined +=
                    usize::from(pair.num_inliers >= self.document.settings.sfm.min_num_inliers);
                if strongest.is_none_or(|(most, _, _)| pair.num_inliers > most) {
                    strongest = Some((pair.num_inliers, first, second));
                }
            }
        }
        let strongest = strongest.map_or(String::new(), |(inliers, first, second)| {
            format!(
                " The strongest pair is {} and {}, with {inliers}.",
                first.name, second.name
            )
        });
        match count {
            0 => "A pair needs two photographs.".to_owned(),
            1 => format!("{joined} of 1 pair shares enough matches.{strongest}"),
            _ => format!("{joined} of {count} pairs share enough matches.{strongest}"),
        }
    }

    fn two_views_words(&self) -> String {
        let (first, second) = self.view.pair;
        let (Some(first), Some(second)) = (self.document.photo(first), self.document.photo(second))
        else {
            return "A pair needs two photographs.".to_owned();
        };
        let names = format!("{} and {}", first.name, second.name);
        if let Some(why) = self.no_pair_words([first, second]) {
            return why;
        }
        let (Some(pair), Some(matches)) = (
            self.get(TwoViewsOf(first.id, second.id)),
            self.get(MatchesOf(first.id, second.id)),
        ) else {
            return format!("{names}: not computed yet.");
        };
        format!(
            "{names}: {} of {} agree. {}",
            pair.num_inliers,
            count(matches.len(), "match").replace("matchs", "matches"),
            self.pair_words(first, pair)
        )
    }

    /// Explains why a pair is not computed: one of its photographs takes no part. `None` if both
    /// do.
    fn no_pair_words(&self, pair: [&InputPhoto; 2]) -> Option<String> {
        let absent = pair
            .into_iter()
            .find(|photo| self.place(photo.id).is_none())?;
        Some(format!("{}: {}.", absent.name, self.outcome_words(absent)))
    }

    /// Explains the result of a pair, and the choice of its matrix.
    ///
    /// * `first`: first photograph of the pair
    pub fn pair_words(&self, first: &InputPhoto, pair: &TwoViews) -> String {
        let turn = pair.turn_deg.unwrap_or(0.0);
        let is_guessed = self.focal_origin(first) == Some(FocalOrigin::Guessed);
        match (pair.shows, pair.model) {
            (Shows::Nothing, _) => {
                "No more matches agree than chance would give: the two most likely show different \
                 things."
                    .to_owned()
            }
            (Shows::Turn, _) if turn < 0.05 => {
                "The camera did not move at all: H explains everything, and there is no depth."
                    .to_owned()
            }
            (Shows::Turn, _) if let Some(factor) = pair.focal_factor => format!(
                "With a focal length near {:.0} px, not {:.0} px, the camera only turned, by {turn:.1}°: H explains \
                 everything, and turning shows no depth.",
                self.focal_px(first, factor),
                self.focal_px(first, 1.0)
            ),
            (Shows::Turn, _) => format!(
                "The camera only turned, by {turn:.1}°: H explains everything, and turning shows no depth."
            ),
            (Shows::Plane, _) => {
                "A plane, seen from two places: H explains nearly all matches.".to_owned()
            }
            (Shows::Depth, ViewModel::Essential(_)) => format!(
                "A scene with depth, seen from two places: E explains it as well as F does. Rays meet at {:.1}°.{}",
                pair.angle_deg.unwrap_or(0.0),
                match is_guessed {
                    true =>
                        " Two photographs hardly tell whether the guessed focal length is right.",
                    false => "",
                }
            ),
            (Shows::Depth, _) => format!(
                "A scene with depth, seen from two places: F explains more matches than E.{}",
                match is_guessed {
                    true => " The focal length is a guess and may be wrong.",
                    false => " Lens distortion does this, and a few wrong matches.",
                }
            ),
        }
    }

    fn depth_words(&self) -> String {
        let Some((first, second)) = self.document.pair(self.view.pair) else {
            return "A pair needs two photographs.".to_owned();
        };
        let names = format!("{} and {}", first.name, second.name);
        if let Some(why) = self.no_pair_words([first, second]) {
            return why;
        }
        if self.get(ReconstructionOfAll).is_none() {
            return match self.failure(ReconstructionOfAll) {
                Some(why) => format!("{names}: nothing could be reconstructed: {why}."),
                None => format!("{names}: waiting for the cameras."),
            };
        }
        if DepthOf(first.id, second.id).key(self).is_none() {
            return format!("{names}: depth needs both cameras, and one of them is missing here.");
        }
        if let Some(why) = self.failure(DepthOf(first.id, second.id)) {
            return format!("{names}: {why}.");
        }
        let Some(found) = self.get(DepthOf(first.id, second.id)) else {
            return format!("{names}: computing the depth of every pixel.");
        };
        let mut words = format!(
            "{names}: {:.0}% of {} pixels have a depth",
            100.0 * found.density,
            found.num_shown
        );
        if let Some([near, far]) = found.depth_range() {
            let (scale, unit) = match self.scale() {
                Some(scale) => (scale.meters_per_unit, "m"),
                None => (1.0, "units"),
            };
            words.push_str(&format!(
                ", from {:.3} to {:.3} {unit}",
                near * scale,
                far * scale
            ));
        }
        words.push('.');
        if found.factor > 1 {
            words.push_str(&format!(
                " Width and height were divided by {}: at full size, pixels and disparities would not fit into memory.",
                found.factor
            ));
        }
        if found.is_vertical {
            words.push_str(" One camera stands above the other, so matches share a column.");
        }
        words
    }

    fn measure_words(&self) -> String {
        if self.component().is_none() {
            return "There is nothing to measure yet.".to_owned();
        }
        if !self.document.has_measures() {
            return format!(
                "Choose two points and type the length between them: it sets the scale.{}",
                self.floor_words()
            );
        }
        let mut words = self.scale_words();
        for index in 0..self.document.measures.len() {
            words.push_str(&format!(" {}: {}.", index + 1, self.length_words(index)));
        }
        words.push_str(&self.figure_words());
        words.push_str(self.floor_words());
        words
    }

    /// Formats the length of a measure.
    pub fn length_words(&self, index: usize) -> String {
        let Some(measure) = self.document.measures.get(index) else {
            return String::new();
        };
        if let Some(length) = self.length_in_meters(index) {
            return match length.sigma > 0.0 {
                true => format!("{} m", with_sigma(length.value, length.sigma)),
                false => format!("{:.4} m, as typed", length.value),
            };
        }
        match self.length_in_units(measure) {
            Some(units) => format!("{} units", with_sigma(units.value, units.sigma)),
            None => "one of its points is gone".to_owned(),
        }
    }

    fn export_words(&self) -> String {
        match self.component() {
            Some(_) if !self.can_export() => {
                "Ready to save as soon as all photographs are read.".to_owned()
            }
            Some(component) => {
                let dense = self.dense_pairs().len();
                let depth = match dense {
                    0 => String::new(),
                    _ => format!(" Dense depth of {}.", count(dense, "pair")),
                };
                let all_views = match self.all_views() {
                    Some((_, cloud)) => format!(" {} from all views.", count(cloud.len(), "point")),
                    None => String::new(),
                };
                let mut words = format!(
                    "Ready to save: {} and {}.{depth}{all_views}",
                    count(component.num_registered(), "camera"),
                    count(component.points.len(), "point")
                );
                let waiting = self.document.dense.len().saturating_sub(dense);
                if waiting > 0 {
                    words.push_str(&format!(
                        " The depth of {} is not ready and stays out.",
                        count(waiting, "pair")
                    ));
                }
                if self.document.all_views && self.all_views().is_none() {
                    words.push_str(" The depth of all views is not ready and stays out.");
                }
                words
            }
            None => "There is no reconstruction to save yet.".to_owned(),
        }
    }
}

/// Formats a value with as many digits as its standard deviation justifies.
pub(super) fn with_sigma(value: f64, sigma: f64) -> String {
    let digits = (1.0 - libm::floor(libm::log10(sigma.max(1e-9)))).clamp(0.0, 9.0) as usize;
    format!("{value:.digits$} ± {sigma:.digits$}")
}
