//! Selections of points, by position or by quality.

use super::remaining::Remaining;
use crate::project::{CropBox, Key, Mask, PhotoId, PointSet, Project};
use crate::tasks::PointFound;
use std::collections::BTreeMap;

/// Layers of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layers {
    /// Sparse points.
    pub sparse: bool,
    /// Points of all views and of pairs.
    pub dense: bool,
    /// Surface of all views in place of its points.
    pub surface: bool,
}

impl Layers {
    /// All layers.
    pub const ALL: [Self; 2] = [
        Self {
            sparse: true,
            dense: true,
            surface: false,
        },
        Self {
            sparse: false,
            dense: true,
            surface: true,
        },
    ];
}

impl Project {
    /// Selects remaining points by their position.
    pub fn select(&self, layers: Layers, is_in: impl Fn([f64; 3]) -> bool) -> PointSet {
        self.select_from(&self.remaining(), layers, is_in)
    }

    /// Selects the points of all layers outside the box, which are not shown.
    pub fn select_outside(&self) -> PointSet {
        let Some(inside) = self.crop().map(CropBox::inside) else {
            return PointSet::default();
        };
        let [points, surface] = Layers::ALL;
        let of = |layers| self.select_from(&self.not_deleted(), layers, |place| !inside(place));
        of(points).with(&of(surface))
    }

    /// Selects remaining sparse points.
    pub fn select_sparse(&self, is_in: impl Fn(&PointFound) -> bool) -> PointSet {
        let remaining = self.remaining();
        self.sparse(|point| remaining.has_point(point) && is_in(point))
    }

    /// Returns the number of points of a set in the current component.
    pub fn num_in(&self, set: &PointSet) -> usize {
        let (members, component) = (self.members(set), self.component());
        let points = component.map_or(&[][..], |component| &component.points);
        let num_sparse = points.iter().filter(|p| members.has_point(p)).count();
        let pairs = self.dense_pairs();
        let keys = (self.all_views().map(|(key, _)| key).into_iter())
            .chain(pairs.iter().map(|(key, ..)| *key));
        let masks = keys.filter_map(|key| set.points_of(key.0));
        num_sparse + masks.map(Mask::len).sum::<usize>()
    }

    fn sparse(&self, is_in: impl Fn(&PointFound) -> bool) -> PointSet {
        let photos = self.taking_part();
        let mut keypoints: BTreeMap<PhotoId, Vec<u32>> = BTreeMap::new();
        let points = self
            .component()
            .map_or(&[][..], |component| &component.points);
        for point in points.iter().filter(|point| is_in(point)) {
            for (image, keypoint) in &point.track {
                if let Some(photo) = photos.get(*image as usize) {
                    keypoints.entry(photo.id).or_default().push(*keypoint);
                }
            }
        }
        let masks = keypoints.into_iter();
        PointSet {
            keypoints: masks.map(|(photo, list)| (photo, Mask::of(list))).collect(),
            clouds: Vec::new(),
        }
    }

    fn select_from(
        &self,
        remaining: &Remaining<'_>,
        layers: Layers,
        is_in: impl Fn([f64; 3]) -> bool,
    ) -> PointSet {
        let mut selected = match layers.sparse {
            true => self.sparse(|point| remaining.has_point(point) && is_in(point.position)),
            false => PointSet::default(),
        };
        let mut add = |key: Key, mask: Mask| {
            if !mask.is_empty() {
                selected.clouds.push((key.0, mask));
            }
        };
        if let Some((key, cloud)) = self.all_views().filter(|_| layers.dense) {
            let has = remaining.of_cloud(key);
            let is_chosen = |(index, place): &(u32, [f64; 3])| is_in(*place) && has(*index, *place);
            let mask = match layers.surface {
                true => {
                    let vertices = (cloud.len() as u32..).zip(cloud.vertices());
                    let vertices = vertices.map(|(index, vertex)| (index, vertex.position));
                    Mask::of(vertices.filter(is_chosen).map(|(index, _)| index))
                }
                false => {
                    let points = (0..).zip(cloud.points(1));
                    let points = points.map(|(index, point)| (index, point.position));
                    Mask::of(points.filter(is_chosen).map(|(index, _)| index))
                }
            };
            add(key, mask);
        }
        for (key, _, _, pair) in self.dense_pairs().into_iter().filter(|_| layers.dense) {
            let has = remaining.of_cloud(key);
            let is_chosen = |(index, place): &(u32, [f64; 3])| is_in(*place) && has(*index, *place);
            let chosen = pair.places(1).filter(is_chosen);
            add(key, Mask::of(chosen.map(|(index, _)| index)));
        }
        selected
    }
}
