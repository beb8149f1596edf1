//! Points that neither the box nor a deletion removes.

use crate::project::{Anchor, CropBox, Key, Mask, PointSet, Project};
use crate::tasks::{DepthOf, PointFound, Query, ReconstructionOfAll};

/// Points of a set, found in the current component.
pub struct Members<'a> {
    set: &'a PointSet,
    /// Keypoints of each image.
    keypoints: Vec<Option<&'a Mask>>,
}

impl Members<'_> {
    /// Whether it has a sparse point.
    pub fn has_point(&self, point: &PointFound) -> bool {
        let has = |&(image, keypoint): &(u32, u32)| {
            let mask = self.keypoints.get(image as usize).copied().flatten();
            mask.is_some_and(|mask| mask.has(keypoint))
        };
        !self.set.keypoints.is_empty() && point.track.iter().any(has)
    }

    /// Returns a function that tells whether it has a point of a dense cloud, by index.
    pub fn of_cloud(&self, key: Key) -> impl Fn(u32) -> bool {
        let mask = self.set.points_of(key.0);
        move |index| mask.is_some_and(|mask| mask.has(index))
    }
}

/// Points of the current component that are shown, selected and exported.
pub struct Remaining<'a> {
    inside: Option<Box<dyn Fn([f64; 3]) -> bool>>,
    deleted: Members<'a>,
}

impl Remaining<'_> {
    /// Whether it has all points.
    pub fn is_all(&self) -> bool {
        self.inside.is_none() && self.deleted.set.is_empty()
    }

    /// Whether it has a sparse point.
    pub fn has_point(&self, point: &PointFound) -> bool {
        !self.deleted.has_point(point) && self.has_place(point.position)
    }

    /// Returns a function that tells whether it has a point of a dense cloud, by index and
    /// position.
    pub fn of_cloud(&self, key: Key) -> impl Fn(u32, [f64; 3]) -> bool {
        let is_deleted = self.deleted.of_cloud(key);
        move |index, place| !is_deleted(index) && self.has_place(place)
    }

    fn has_place(&self, place: [f64; 3]) -> bool {
        self.inside.as_ref().is_none_or(|inside| inside(place))
    }
}

impl Project {
    /// Returns the box, if it belongs to the current component.
    pub fn crop(&self) -> Option<&CropBox> {
        let crop = self.document.crop.as_ref()?;
        let is_its = |key: Key| (crop.of, crop.component) == (key.0, self.view.component as u32);
        ReconstructionOfAll
            .key(self)
            .is_some_and(is_its)
            .then_some(crop)
    }

    /// Returns the points that are neither deleted nor outside the box.
    pub fn remaining(&self) -> Remaining<'_> {
        let inside = self.crop().map(CropBox::inside);
        Remaining {
            inside: inside.map(|inside| Box::new(inside) as Box<dyn Fn([f64; 3]) -> bool>),
            ..self.not_deleted()
        }
    }

    /// Returns the points that are not deleted.
    pub(super) fn not_deleted(&self) -> Remaining<'_> {
        Remaining {
            inside: None,
            deleted: self.members(&self.document.deleted),
        }
    }

    /// Finds the points of a set.
    pub fn members<'a>(&self, set: &'a PointSet) -> Members<'a> {
        let photos = self.taking_part().into_iter();
        Members {
            set,
            keypoints: photos.map(|photo| set.keypoints_of(photo.id)).collect(),
        }
    }

    /// Whether the point of an anchor is neither deleted nor outside the box.
    pub fn is_remaining(&self, anchor: &Anchor) -> bool {
        let Some(place) = self.anchored(anchor) else {
            return false;
        };
        let deleted = &self.document.deleted;
        let has = |key: u64, index: u32| deleted.points_of(key).is_some_and(|m| m.has(index));
        let is_deleted = match (anchor.cloud, anchor.pixel) {
            (Some(point), _) => has(point.cloud, point.index),
            (None, Some(pixel)) => {
                let query = DepthOf(anchor.photo, pixel.second);
                let found = query.key(self).zip(self.get(query));
                found.is_some_and(|(key, pair)| has(key.0, pair.index(pixel.at)))
            }
            (None, None) => {
                (deleted.keypoints_of(anchor.photo)).is_some_and(|mask| mask.has(anchor.keypoint))
            }
        };
        !is_deleted
            && self
                .crop()
                .is_none_or(|crop| crop.inside()(place.coords.into()))
    }
}
