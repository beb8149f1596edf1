//! Sets of points of the model.

use super::anchor::PhotoId;
use super::mask::Mask;
use serde::{Deserialize, Serialize};

/// Set of points: sparse ones by their keypoints, so that they are found again in another
/// reconstruction, dense ones by index.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct PointSet {
    /// Keypoints of its sparse points in each photograph.
    pub keypoints: Vec<(PhotoId, Mask)>,
    /// Points of each dense cloud by its key, since in another cloud the indices would be
    /// meaningless: points, then vertices of all views; pixels of a pair.
    pub clouds: Vec<(u64, Mask)>,
}

impl PointSet {
    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        let is_empty = |mask: &Mask| mask.is_empty();
        self.keypoints.iter().all(|(_, mask)| is_empty(mask))
            && self.clouds.iter().all(|(_, mask)| is_empty(mask))
    }

    /// Returns the keypoints in a photograph.
    pub fn keypoints_of(&self, photo: PhotoId) -> Option<&Mask> {
        find(&self.keypoints, photo)
    }

    /// Returns the points of a dense cloud.
    ///
    /// * `key`: key of the cloud
    pub fn points_of(&self, key: u64) -> Option<&Mask> {
        find(&self.clouds, key)
    }

    /// Returns the union with another set.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        self.combined(other, Mask::with)
    }

    /// Returns the set without the points of another one.
    #[must_use]
    pub fn without(&self, other: &Self) -> Self {
        self.combined(other, Mask::without)
    }

    fn combined(&self, other: &Self, combine: fn(&Mask, &Mask) -> Mask) -> Self {
        Self {
            keypoints: combined(&self.keypoints, &other.keypoints, combine),
            clouds: combined(&self.clouds, &other.clouds, combine),
        }
    }
}

fn find<K: Copy + PartialEq>(masks: &[(K, Mask)], key: K) -> Option<&Mask> {
    let found = masks.iter().find(|(other, _)| *other == key);
    found.map(|(_, mask)| mask)
}

fn combined<K: Copy + Ord>(
    one: &[(K, Mask)],
    two: &[(K, Mask)],
    combine: fn(&Mask, &Mask) -> Mask,
) -> Vec<(K, Mask)> {
    let mut keys: Vec<K> = one.iter().chain(two).map(|(key, _)| *key).collect();
    keys.sort_unstable();
    keys.dedup();
    let none = Mask::default();
    let mask = |key: K| {
        let of = |masks| find(masks, key).unwrap_or(&none);
        (key, combine(of(one), of(two)))
    };
    let masks = keys.into_iter().map(mask);
    masks.filter(|(_, mask)| !mask.is_empty()).collect()
}
