//! Selection of the photographs whose pixels are in memory, as all may exceed the memory of a page.
//! The others keep a thumbnail, and are read again from their files for display or computation.

use crate::project::{InputPhoto, Key, PhotoId, Project};
use crate::tasks::{DepthOf, FeaturesOf, Photograph, PhotographOf, Query, ReducedOf};

/// Maximum size of the pixels in memory, bytes, except for visible photographs.
const MAX_BYTES: usize = 64_000_000;

impl Project {
    /// Returns the photographs shown in full, or whose depth is about to be computed.
    fn looked_at(&self) -> Vec<PhotoId> {
        let photos = self.document.photos.iter().map(|photo| photo.id);
        let mut ids: Vec<PhotoId> = photos.filter(|id| self.shows_pixels(*id)).collect();
        for DepthOf(a, b) in DepthOf::all(self) {
            let query = DepthOf(a, b);
            let is_open = query.key(self).is_some() && !query.is_settled(self);
            if is_open && query.is_asked(self) {
                ids.extend([a, b]);
            }
        }
        ids
    }

    /// Returns the keys of photographs whose features or downscaled pixels are to be computed, in
    /// the order of the list.
    fn awaited(&self) -> Vec<Key> {
        let to_describe = self.to_describe();
        let to_reduce = ReducedOf::all(self);
        let is_awaited = |photo: &&&InputPhoto| {
            let features = FeaturesOf(photo.id);
            let reduced = ReducedOf(photo.id);
            to_describe.contains(&photo.id)
                || (to_reduce.contains(&reduced) && !reduced.is_settled(self))
                || !(features.is_settled(self) || self.is_imported(features))
        };
        let photos = self.taking_part();
        let awaited = photos.iter().filter(is_awaited);
        awaited
            .filter_map(|photo| PhotographOf(photo.id).key(self))
            .collect()
    }

    /// Drops pixels beyond the memory limit, and selects those to read again.
    pub(super) fn balance_pixels(&mut self) {
        let found = |key: &Key| self.cache.get::<Photograph>(*key);
        let size = |key: &Key| found(key).map_or(0, Photograph::num_bytes);
        let is_gone = |key: &Key| {
            found(key).is_some_and(|found| found.was_read() && !found.has_pixels())
                && !self.unread.contains(key)
        };
        let photographs = self.cache.of_type::<Photograph>().into_iter();
        let with_pixels = photographs.filter(|(_, found)| found.has_pixels());
        let in_memory: Vec<Key> = with_pixels.map(|(key, _)| key).collect();
        let mut num_bytes: usize = in_memory.iter().map(size).sum();
        let key = |id| PhotographOf(id).key(self);
        let keys = self
            .document
            .photos
            .iter()
            .filter_map(|photo| key(photo.id));
        let gone: Vec<Key> = keys.filter(is_gone).collect();
        if num_bytes <= MAX_BYTES && gone.is_empty() {
            self.rereading.clear();
            return;
        }
        let (looked_at, awaited) = (self.looked_at(), self.awaited());
        let looked_at: Vec<Key> = looked_at.into_iter().filter_map(key).collect();
        // Drops pixels that no task waits for, oldest first; then those needed last, but for one,
        // so that computation can proceed.
        let idle = in_memory.iter().filter(|key| !awaited.contains(key));
        let late = awaited
            .iter()
            .skip(1)
            .rev()
            .filter(|key| in_memory.contains(key));
        let mut dropped = Vec::new();
        for key in idle.chain(late).filter(|key| !looked_at.contains(key)) {
            if num_bytes <= MAX_BYTES {
                break;
            }
            num_bytes -= size(key);
            dropped.push(*key);
        }
        // Reads several in a row before waiting for the last: switching between reading and other
        // tasks makes a worker load other code.
        let is_waiting = |key: &&Key| in_memory.contains(key) && !dropped.contains(key);
        let waiting: usize = awaited.iter().filter(is_waiting).map(size).sum();
        let mut reading = self.rereading.clone();
        reading.retain(|key| gone.contains(key));
        if waiting <= MAX_BYTES / 2 && !awaited.iter().any(|key| reading.contains(key)) {
            let others = looked_at.iter().filter(|key| !awaited.contains(key));
            let mut taken = waiting + others.map(size).sum::<usize>();
            for key in awaited.iter().filter(|key| gone.contains(key)) {
                taken += size(key);
                let is_first = waiting == 0 && Some(key) == awaited.first();
                if taken > MAX_BYTES && !is_first {
                    break;
                }
                reading.insert(*key);
            }
        }
        reading.extend(looked_at.iter().filter(|key| gone.contains(key)));
        self.rereading = reading;
        for key in dropped {
            self.cache.shrink(key, |found: &mut Photograph| {
                std::mem::take(&mut found.rgb).len()
            });
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::project::{Step, to_bytes};
    use crate::session::{Event, Pending};
    use crate::tasks::{
        AllViews, AnyQuery, CameraFound, Component, Described, Features, Reconstructed,
        ReconstructionOfAll, Reduced, Thumbnail,
    };

    /// A photograph of five megapixels, 15 MB.
    fn photograph() -> Photograph {
        let (width, height) = (2500, 2000);
        Photograph {
            width,
            height,
            rgb: vec![7; 15_000_000].into(),
            small: Thumbnail {
                width: 1,
                height: 1,
                rgb: vec![7; 3].into(),
            },
            focal_px: Some(2000.0),
            k: None,
            full_size: (width, height),
            sensor_size: (width, height),
            quarters: Some(0),
            as_given: true,
        }
    }

    fn features() -> Features {
        Features {
            list: Vec::new(),
            described: Described {
                dimension: 128,
                values: Vec::new().into(),
            },
        }
    }

    /// Creates a project with photographs and no results.
    fn given(count: u8) -> Project {
        let mut project = Project::default();
        let file = |n: u8| (format!("{n}.jpg"), vec![n].into());
        project.update(Event::Add((0..count).map(file).collect()));
        project
    }

    /// Finishes the first pending task, if it reads a photograph or finds features.
    fn do_first(project: &mut Project) -> Option<Pending> {
        let pending = project.pending().into_iter().next()?;
        let output = match pending.query {
            AnyQuery::Photograph(_) => to_bytes(&photograph()),
            AnyQuery::Features(FeaturesOf(id)) => {
                let photo = project.document().photo(id).unwrap();
                assert!(project.photograph(photo).is_some());
                to_bytes(&features())
            }
            _ => return None,
        };
        project.done(&pending, Ok(output));
        Some(pending)
    }

    fn num_in_memory(project: &Project) -> usize {
        {
            let photographs = project.cache.of_type::<Photograph>().into_iter();
            photographs.filter(|(_, found)| found.has_pixels()).count()
        }
    }

    #[test]
    fn pixels_of_many_photographs_are_never_all_at_hand_and_each_is_read_at_most_twice() {
        let mut project = given(20);
        let mut read = [0; 21];
        let mut found = 0;
        while let Some(pending) = do_first(&mut project) {
            assert!(num_in_memory(&project) <= 4);
            match pending.query {
                AnyQuery::Photograph(PhotographOf(id)) => read[id as usize] += 1,
                _ => found += 1,
            }
            // All thumbnails are visible before anything is computed.
            let is_shown = |photo| project.shown(photo).is_some();
            assert!(found == 0 || project.document().photos.iter().all(is_shown));
        }
        assert_eq!(found, 20);
        assert_eq!(read.iter().sum::<usize>(), 20 + 16);
        assert!(read.iter().all(|times| *times <= 2));
    }

    #[test]
    fn few_photographs_are_read_once() {
        let mut project = given(4);
        let mut count = 0;
        while do_first(&mut project).is_some() {
            count += 1;
        }
        assert_eq!((count, num_in_memory(&project)), (8, 4));
    }

    #[test]
    fn whoever_looks_at_a_photograph_has_its_pixels_read_first_and_only_once() {
        let mut project = given(9);
        while do_first(&mut project).is_some() {}
        let is_gone = |photo: &&InputPhoto| project.photograph(photo).is_none();
        let id = project.document().photos.iter().find(is_gone).unwrap().id;
        project.update(Event::Show(Step::Features));
        project.update(Event::Look(id));
        let read = AnyQuery::Photograph(PhotographOf(id));
        assert_eq!(do_first(&mut project).unwrap().query, read);
        let photo = project.document().photo(id).unwrap();
        assert!(project.photograph(photo).is_some());
        assert_eq!(do_first(&mut project), None);
        // A failed read is not repeated, and the photograph still takes part.
        let is_gone = |photo: &&InputPhoto| project.photograph(photo).is_none();
        let id = project.document().photos.iter().find(is_gone).unwrap().id;
        project.update(Event::Look(id));
        let read = AnyQuery::Photograph(PhotographOf(id));
        let pending = project.pending().into_iter().next().unwrap();
        assert_eq!(pending.query, read);
        project.broke_down(&pending, "there is not enough memory".to_owned());
        assert!(
            project
                .pending()
                .iter()
                .all(|other| other.key != pending.key)
        );
        assert!(project.can_try_again() && project.taking_part().len() == 9);
        project.update(Event::TryAgain);
        assert_eq!(
            do_first(&mut project).map(|pending| pending.query),
            Some(read)
        );
    }

    #[test]
    fn all_views_are_downscaled_without_all_pixels_in_memory() {
        let mut project = given(20);
        while do_first(&mut project).is_some() {}
        let camera = CameraFound {
            intrinsics: [2000.0, 2000.0, 1249.5, 999.5],
            rotation: [0.0, 0.0, 0.0, 1.0],
            translation: [0.0; 3],
        };
        let found = Reconstructed {
            components: vec![Component {
                cameras: vec![Some(camera); 20],
                lens: epipole::camera::Lens::NONE,
                points: Vec::new(),
            }],
            ..Reconstructed::default()
        };
        let key = ReconstructionOfAll.key(&project).unwrap();
        (project.cache).insert(key, Box::new(found), 1000);
        project.update(Event::AllViews(true));
        let mut read = 0;
        let mut num_reduced = 0;
        let is_wanted =
            |query: &AnyQuery| matches!(query, AnyQuery::Photograph(_) | AnyQuery::Reduced(_));
        while let Some(pending) = (project.pending().into_iter()).find(|p| is_wanted(&p.query)) {
            assert!(num_in_memory(&project) <= 5, "{}", num_in_memory(&project));
            let output = match pending.query {
                AnyQuery::Photograph(_) => {
                    read += 1;
                    to_bytes(&photograph())
                }
                _ => {
                    num_reduced += 1;
                    assert!(pending.request(&project).is_some());
                    to_bytes(&Reduced {
                        width: 1,
                        height: 1,
                        from: (2500, 2000),
                        rgb: vec![7; 3].into(),
                    })
                }
            };
            project.done(&pending, Ok(output));
        }
        assert_eq!(num_reduced, 20);
        assert!(read <= 20, "each is read at most once more: {read}");
        assert!(AllViews.is_ready(&project, false));
    }
}
