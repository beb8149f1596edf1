//! Tasks to compute now, most urgent first.

use super::document::{Given, PhotoId};
use super::keys::Key;
use super::{Fate, Project, Step};
use crate::tasks::{Described, ImagePoints, Packed, PairOf, Request};
use std::collections::BTreeSet;

/// Something to compute.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Task {
    /// The name of its result.
    pub key: Key,
    /// Subject of the task.
    pub about: About,
}

/// Subject of a task.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// A photograph.
    Photograph(PhotoId),
    /// Its features.
    Features(PhotoId),
    /// A pair.
    Matches(PhotoId, PhotoId),
    /// A pair.
    TwoViews(PhotoId, PhotoId),
    /// All.
    Reconstruction,
    /// Every pixel of a pair.
    Depth(PhotoId, PhotoId),
    /// The board in a photograph.
    Board(PhotoId),
    /// The camera of all boards.
    Calibration,
}

impl Project {
    /// Missing results whose inputs are available.
    pub fn wanted(&self) -> Vec<Task> {
        if self.paused {
            return Vec::new();
        }
        let mut tasks: Vec<Task> = Vec::new();
        let to_describe = self.to_describe();
        let mut want = |key: Key, about: About| {
            let is_whole = match about {
                About::Features(id) => !to_describe.contains(&id),
                About::Photograph(_) => !self.reading.contains(&key),
                _ => true,
            };
            let is_settled = is_whole && self.results.is_settled(key);
            if !is_settled && tasks.iter().all(|task| task.key != key) {
                tasks.push(Task { key, about });
            }
        };
        let of_boards = self.wanted_of_boards();
        if self.view.step == Step::Calibrate {
            for (key, about) in &of_boards {
                want(*key, *about);
            }
        }
        for photo in self.by_need() {
            want(self.photograph_key(photo), About::Photograph(photo.id));
        }
        let photos = self.taking_part();
        for photo in &photos {
            let key = self.features_key(photo);
            if self.photograph(photo).is_some() || self.brought.contains_key(&key) {
                want(key, About::Features(photo.id));
            }
        }
        let mut all_matched = photos.len() >= 2;
        let mut judged = Vec::new();
        for (first, second) in pairs(&photos) {
            let key = self.matches_key(first, second);
            all_matched &= self.results.matches(key).is_some();
            let (Some(one), Some(two)) = (self.features(first), self.features(second)) else {
                continue;
            };
            let is_described = one.has_descriptors() && two.has_descriptors();
            if is_described || self.brought.contains_key(&key) {
                want(key, About::Matches(first.id, second.id));
            }
            if self.results.matches(key).is_some()
                && let Some(key) = self.two_views_key(first, second)
            {
                judged.push((key, About::TwoViews(first.id, second.id)));
            }
        }
        // The pair that is looked at first, then everything in one, then all other pairs.
        let (a, b) = self.view.pair;
        judged.sort_by_key(|(_, about)| *about != About::TwoViews(a, b));
        let looked_at = judged.iter().take(1);
        for (key, about) in looked_at {
            want(*key, *about);
        }
        if all_matched && let Some(key) = self.reconstruction_key() {
            want(key, About::Reconstruction);
        }
        // Every pixel of the pair that is looked at, and of those that are part of the cloud.
        let looked_at = (self.view.step == Step::Depth).then_some(&self.view.pair);
        for pair in looked_at.into_iter().chain(&self.document.dense) {
            if let Some((first, second)) = self.document.pair(*pair)
                && self.photograph(first).is_some()
                && self.photograph(second).is_some()
                && let Some(key) = self.depth_key(first, second)
            {
                want(key, About::Depth(first.id, second.id));
            }
        }
        for (key, about) in judged.into_iter().chain(of_boards) {
            want(key, about);
        }
        tasks
    }

    /// Photographs whose features came without descriptors, which are now needed for display or for
    /// new matches.
    pub(super) fn to_describe(&self) -> BTreeSet<PhotoId> {
        let photos = self.taking_part();
        let is_bare = |photo: &Given| {
            let found = self.features(photo);
            self.shown(photo).is_some() && found.is_some_and(|found| !found.has_descriptors())
        };
        if !photos.iter().any(|photo| is_bare(photo)) {
            return BTreeSet::new();
        }
        let is_open = |first: &Given, second: &Given| {
            let key = self.matches_key(first, second);
            !self.results.is_settled(key) && !self.brought.contains_key(&key)
        };
        let open = pairs(&photos).filter(|(first, second)| is_open(first, second));
        let looked_at = (self.view.step == Step::Features).then_some(self.view.photo);
        (open.flat_map(|(first, second)| [first, second]))
            .chain(looked_at.and_then(|id| self.document.photo(id)))
            .filter(|photo| is_bare(photo))
            .map(|photo| photo.id)
            .collect()
    }

    /// The request of a task; `None` if the project has changed since.
    pub fn request(&self, task: &Task) -> Option<Request> {
        let settings = &self.document.settings;
        Some(match task.about {
            About::Photograph(id) => Request::Photograph {
                source: self.document.photo(id)?.source.clone(),
                max_pixels: self.max_pixels(),
                camera: self.document.camera.clone(),
            },
            About::Board(id) => Request::Board {
                source: self.document.board(id)?.source.clone(),
                options: settings.calibration.board,
            },
            About::Calibration => self.calibration_request()?,
            About::Features(id) => Request::Features {
                photograph: (**self.photograph(self.document.photo(id)?)?).clone(),
                options: settings.features,
            },
            About::Matches(first, second) => Request::Matches {
                first: self.described(first)?,
                second: self.described(second)?,
                options: settings.matching,
            },
            About::TwoViews(first, second) => {
                let (first, second) = (self.document.photo(first)?, self.document.photo(second)?);
                Request::TwoViews {
                    places: self.match_places(first, second)?,
                    ratios: (self.matches(first, second)?.iter())
                        .map(|m| m.ratio)
                        .collect(),
                    cameras: [self.camera(first)?, self.camera(second)?],
                    options: settings.pairs,
                }
            }
            About::Depth(first, second) => {
                self.depth_request(self.document.photo(first)?, self.document.photo(second)?)?
            }
            About::Reconstruction => Request::Reconstruction {
                images: self.image_points()?,
                pairs: self.all_matches()?,
                options: self.sfm_options(),
            },
        })
    }

    fn described(&self, id: PhotoId) -> Option<Described> {
        Some(self.features(self.document.photo(id)?)?.described.clone())
    }

    /// `u1, v1, u2, v2` of each match of a pair.
    pub fn match_places(&self, first: &Given, second: &Given) -> Option<Vec<[f64; 4]>> {
        let matches = self.matches(first, second)?;
        let (one, two) = (self.features(first)?, self.features(second)?);
        let place = |m: &crate::tasks::Match| {
            let a = one.list.get(m.first as usize)?;
            let b = two.list.get(m.second as usize)?;
            Some([a.u, a.v, b.u, b.v])
        };
        matches.iter().map(place).collect()
    }

    fn image_points(&self) -> Option<Vec<ImagePoints>> {
        let image = |photo: &&Given| {
            let features = self.features(photo)?;
            Some(ImagePoints {
                name: photo.name.clone(),
                camera: self.camera(photo)?,
                points: features.list.iter().map(|f| [f.u, f.v]).collect(),
                colors: features.list.iter().map(|f| f.color).collect(),
            })
        };
        self.taking_part().iter().map(image).collect()
    }

    fn all_matches(&self) -> Option<Vec<PairOf>> {
        let photos = self.taking_part();
        let mut found = Vec::new();
        for (i, first) in photos.iter().enumerate() {
            for (j, second) in photos.iter().enumerate().skip(i + 1) {
                let matches = self.matches(first, second)?;
                found.push(PairOf {
                    first: i as u32,
                    second: j as u32,
                    matches: matches.iter().map(|m| (m.first, m.second)).collect(),
                });
            }
        }
        Some(found)
    }

    /// Whether there is a reconstruction to save, and all of its photographs.
    pub fn can_export(&self) -> bool {
        let mut photos = self.taking_part().into_iter();
        self.component().is_some() && photos.all(|photo| self.shown(photo).is_some())
    }

    /// The request for the zip file of the current component; `None` without a reconstruction.
    pub fn export_request(&self) -> Option<Request> {
        let found = self.reconstruction()?;
        found.components.get(self.view.component)?;
        let pack = |photo: &&Given| {
            Some(Packed {
                name: photo.name.clone(),
                source: photo.source.clone(),
                used: Some((**self.shown(photo)?).clone()),
            })
        };
        Some(Request::Export {
            images: self.image_points()?,
            photographs: (self.taking_part().iter())
                .map(pack)
                .collect::<Option<_>>()?,
            found: (**found).clone(),
            component: self.view.component as u32,
            meters_per_unit: self.scale().map(|scale| scale.meters_per_unit),
            focal_refined: self.sfm_options().refine_focal,
            left_out: (self.taking_part().iter())
                .filter(|photo| !matches!(self.fate(photo), Fate::Registered(_)))
                .map(|photo| (photo.name.clone(), self.fate_words(photo)))
                .collect(),
            recipe: self.recipe()?,
            max_pixels: self.max_pixels(),
            camera: self.document.camera.clone(),
            dense: (self.dense_pairs().into_iter())
                .map(|(_, first, second, dense)| {
                    (Self::pair_name(first, second), (**dense).clone())
                })
                .collect(),
        })
    }
}

/// All pairs, the first before the second in the list.
pub(super) fn pairs<'a>(photos: &'a [&'a Given]) -> impl Iterator<Item = (&'a Given, &'a Given)> {
    let after = |(i, first): (usize, &'a &'a Given)| {
        photos[i + 1..].iter().map(move |second| (*first, *second))
    };
    photos.iter().enumerate().flat_map(after)
}
