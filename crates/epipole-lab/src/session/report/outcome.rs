//! Outcome for each photograph, with advice.

use crate::project::{InputPhoto, Outcome, PhotoId, Project};
use crate::tasks::{
    Component, FeaturesOf, FocalOrigin, PhotographOf, ReconstructionOfAll, Shows, TwoViewsOf,
    UnregisteredReason,
};
use std::collections::BTreeMap;

impl Project {
    /// Returns the outcome for a photograph.
    pub fn outcome(&self, photo: &InputPhoto) -> Outcome {
        let mut cached = self.outcomes.borrow_mut();
        if cached.0 != self.revision {
            *cached = (self.revision, BTreeMap::new());
        }
        let outcome = cached.1.entry(photo.id);
        outcome.or_insert_with(|| self.find_outcome(photo)).clone()
    }

    fn find_outcome(&self, photo: &InputPhoto) -> Outcome {
        if photo.excluded {
            return Outcome::Excluded;
        }
        if let Some(twin) = self.document.twin(photo) {
            return Outcome::Duplicate(twin.name.clone());
        }
        let failure = self.failure(PhotographOf(photo.id));
        if let Some(why) = failure.or_else(|| self.failure(FeaturesOf(photo.id))) {
            return Outcome::Unreadable(why.to_owned());
        }
        let all = self.taking_part();
        if all.len() < 2 {
            return match self.get(PhotographOf(photo.id)) {
                Some(_) => Outcome::Alone,
                None => Outcome::Pending,
            };
        }
        if let Some(why) = self.failure(ReconstructionOfAll) {
            return Outcome::Failed(why.to_owned());
        }
        let (Some(found), Some(place)) = (self.get(ReconstructionOfAll), self.place(photo.id))
        else {
            return Outcome::Pending;
        };
        let looked_at = found.components.get(self.view.component);
        if let Some(component) = looked_at
            && component.cameras.get(place).is_some_and(Option::is_some)
        {
            let sees = |track: &[(u32, u32)]| track.iter().any(|(of, _)| *of as usize == place);
            let points = component.points.iter();
            return Outcome::Registered(points.filter(|point| sees(&point.track)).count());
        }
        let has = |c: &Component| c.cameras.get(place).is_some_and(Option::is_some);
        if let Some(part) = found.components.iter().position(has) {
            return Outcome::OtherPart(part);
        }
        match found.reasons.get(place).copied().flatten() {
            Some(reason) => self.unregistered(photo, reason, &all),
            None => Outcome::Pending,
        }
    }

    /// Returns the outcome for a photograph without a camera. Its pairs show whether the camera
    /// only rotated, possibly for another focal length than the given one.
    fn unregistered(
        &self,
        photo: &InputPhoto,
        reason: UnregisteredReason,
        all: &[&InputPhoto],
    ) -> Outcome {
        match reason {
            UnregisteredReason::FewFeatures(count) => {
                return Outcome::FewFeatures(count as usize);
            }
            UnregisteredReason::NoKnownPose => return Outcome::NoKnownPose,
            _ => {}
        }
        let enough = self.document.settings.sfm.min_num_inliers;
        let (mut most, mut turns, mut moves) = (0, 0, 0);
        // Focal factors of the pairs with pure rotation: a small rotation fits with any factor.
        let mut factors = Vec::new();
        let others = all.iter().filter(|other| other.id != photo.id);
        let pairs = others.filter_map(|other| self.document.pair((photo.id, other.id)));
        for (first, second) in pairs {
            let Some(pair) = self.get(TwoViewsOf(first.id, second.id)) else {
                return Outcome::Pending;
            };
            most = most.max(pair.num_inliers);
            match pair.shows {
                _ if pair.num_inliers < enough => {}
                Shows::Turn => {
                    turns += 1;
                    factors.extend(pair.focal_factor);
                }
                Shows::Depth | Shows::Plane => moves += 1,
                Shows::Nothing => {}
            }
        }
        match reason {
            _ if turns > 0 && moves == 0 => {
                let focal_px = |factor| self.focal_px(photo, factor).round() as u32;
                Outcome::RotationOnly(median(factors).map(focal_px))
            }
            _ if turns + moves == 0 => Outcome::OverlapsNone(most as usize),
            UnregisteredReason::NoBaseline => Outcome::RotationOnly(None),
            UnregisteredReason::FewPoints(count) => Outcome::SeesFew(count as usize),
            UnregisteredReason::NoPose(count) => Outcome::NoPlace(count as usize),
            _ => Outcome::SeesFew(0),
        }
    }

    /// Describes the outcome for a photograph, with advice.
    pub fn outcome_words(&self, photo: &InputPhoto) -> String {
        let enough = self.document.settings.sfm.min_num_inliers;
        let guessed = self.focal_origin(photo) == Some(FocalOrigin::Guessed);
        match self.outcome(photo) {
            Outcome::Pending => "being processed".to_owned(),
            Outcome::Registered(points) => format!("has a camera, sees {points} points"),
            Outcome::Excluded => "left out by you".to_owned(),
            Outcome::Duplicate(name) => {
                format!("the same file as {name}. The same photograph twice shows no depth: take another, a step to the side")
            }
            Outcome::Unreadable(why) => format!("cannot be read: {why}"),
            Outcome::Alone => {
                "alone. One photograph gives directions, not distances: add another, taken a step to the side".to_owned()
            }
            Outcome::FewFeatures(count) => format!(
                "only {count} features, which is too few: take it sharper, find more texture, or lower the contrast threshold"
            ),
            Outcome::OverlapsNone(most) => format!(
                "overlaps no other photograph: at best {most} matches agree, and {enough} are needed. \
                 Take one in between"
            ),
            Outcome::RotationOnly(focal_px) => format!(
                "the camera only turned between this one and the others{}, and turning shows no depth. Take a step to the \
                 side between photographs",
                focal_px.map_or(String::new(), |focal_px| format!(
                    " if its focal length is near {focal_px} px"
                ))
            ),
            Outcome::SeesFew(count) => format!(
                "sees {count} of the {enough} points it needs. Take one between it and its neighbor"
            ),
            Outcome::NoPlace(count) if guessed => format!(
                "sees {count} points, but they do not agree on where it was taken. Its focal length is only a guess: type the right one"
            ),
            Outcome::NoPlace(count) => {
                format!("sees {count} points, but they do not agree on where it was taken. Something may have moved")
            }
            Outcome::NoKnownPose => self.no_pose_words(photo),
            Outcome::OtherPart(part) => format!(
                "belongs to part {}, which nothing joins to the part shown. Take one that shows both",
                part + 1
            ),
            Outcome::Failed(why) => format!("nothing could be reconstructed: {why}"),
        }
    }

    /// Returns the photographs outside the current component, with their outcomes.
    pub fn left_out(&self) -> Vec<(PhotoId, Outcome)> {
        let photos = self.document.photos.iter();
        photos
            .map(|photo| (photo.id, self.outcome(photo)))
            .filter(|(_, outcome)| !matches!(outcome, Outcome::Registered(_) | Outcome::Pending))
            .collect()
    }
}

/// Returns the median.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
