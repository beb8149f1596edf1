//! Which photographs have their pixels in memory: all of them may exceed the memory of a page. The
//! others keep a thumbnail, and are read again from their files for display or computation.

use super::document::{Given, PhotoId};
use super::keys::Key;
use super::{Project, Step};

/// Maximum size of the pixels in memory, bytes, except for visible photographs.
const MAX_BYTES: usize = 64_000_000;

impl Project {
    /// The photographs of the list, those with visible pixels first.
    pub(super) fn by_need(&self) -> impl Iterator<Item = &Given> {
        let looked_at = self.looked_at();
        let is_looked_at = move |photo: &&Given| looked_at.contains(&photo.id);
        let (first, then): (Vec<_>, Vec<_>) = self.document.photos.iter().partition(is_looked_at);
        first.into_iter().chain(then)
    }

    /// The photographs shown in full, or whose depth is about to be computed.
    fn looked_at(&self) -> Vec<PhotoId> {
        let (a, b) = self.view.pair;
        let mut ids = match self.view.step {
            Step::Features => vec![self.view.photo],
            Step::TwoViews => vec![a, b],
            _ => Vec::new(),
        };
        let pair = (self.view.step == Step::Depth).then_some((a, b));
        for (a, b) in pair.into_iter().chain(self.document.dense.iter().copied()) {
            let of_pair = self.document.pair((a, b));
            let key = of_pair.and_then(|(first, second)| self.depth_key(first, second));
            if key.is_some_and(|key| !self.results.is_settled(key)) {
                ids.extend([a, b]);
            }
        }
        ids
    }

    /// The keys of photographs without features, in the order of the list.
    fn awaited(&self) -> Vec<Key> {
        let to_describe = self.to_describe();
        let is_awaited = |photo: &&&Given| {
            let features = self.features_key(photo);
            to_describe.contains(&photo.id)
                || !(self.results.is_settled(features) || self.brought.contains_key(&features))
        };
        let photos = self.taking_part();
        let awaited = photos.iter().filter(is_awaited);
        awaited.map(|photo| self.photograph_key(photo)).collect()
    }

    /// Drops pixels beyond the memory limit, and selects those to read again.
    pub(super) fn balance_pixels(&mut self) {
        let size = |key: &Key| {
            self.results
                .frame(*key)
                .map_or(0, |found| found.num_bytes())
        };
        let is_gone = |key: &Key| {
            let found = self.results.frame(*key);
            found.is_some_and(|found| found.was_read() && !found.has_pixels())
                && !self.unread.contains(key)
        };
        let at_hand = self.results.at_hand();
        let mut num_bytes: usize = at_hand.iter().map(size).sum();
        let keys = self
            .document
            .photos
            .iter()
            .map(|photo| self.photograph_key(photo));
        let gone: Vec<Key> = keys.filter(is_gone).collect();
        if num_bytes <= MAX_BYTES && gone.is_empty() {
            self.reading.clear();
            return;
        }
        let (looked_at, awaited) = (self.looked_at(), self.awaited());
        let looked_at: Vec<Key> = (looked_at.into_iter())
            .filter_map(|id| Some(self.photograph_key(self.document.photo(id)?)))
            .collect();
        // Drops pixels that no task waits for, oldest first; then those needed last, except for
        // one, so that work can continue.
        let idle = at_hand.iter().filter(|key| !awaited.contains(key));
        let late = awaited
            .iter()
            .skip(1)
            .rev()
            .filter(|key| at_hand.contains(key));
        let mut let_go = Vec::new();
        for key in idle.chain(late).filter(|key| !looked_at.contains(key)) {
            if num_bytes <= MAX_BYTES {
                break;
            }
            num_bytes -= size(key);
            let_go.push(*key);
        }
        // Several in a row, before the last one is waited for: workers have to change their code
        // for it.
        let is_waiting = |key: &&Key| at_hand.contains(key) && !let_go.contains(key);
        let waiting: usize = awaited.iter().filter(is_waiting).map(size).sum();
        let mut reading = self.reading.clone();
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
        self.reading = reading;
        for key in let_go {
            self.results.let_go(key);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::project::{About, Event, Task};
    use crate::tasks::{Answer, Described, Features, Photograph, Thumbnail};

    /// Five megapixels, 15 MB.
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

    /// A project with photographs and no results.
    fn given(count: u8) -> Project {
        let mut project = Project::default();
        let file = |n: u8| (format!("{n}.jpg"), vec![n].into());
        project.update(Event::Add((0..count).map(file).collect()));
        project
    }

    /// Does the first task that is wanted, if it is to read a photograph or to find features.
    fn do_first(project: &mut Project) -> Option<Task> {
        let task = project.wanted().into_iter().next()?;
        let answer = match task.about {
            About::Photograph(_) => Answer::Photograph(photograph()),
            About::Features(id) => {
                let photo = project.document().photo(id).unwrap();
                assert!(project.photograph(photo).is_some());
                Answer::Features(features())
            }
            _ => return None,
        };
        project.done(task.key, Ok(answer.to_bytes()));
        Some(task)
    }

    fn num_at_hand(project: &Project) -> usize {
        project.results.at_hand().len()
    }

    #[test]
    fn pixels_of_many_photographs_are_never_all_at_hand_and_each_is_read_at_most_twice() {
        let mut project = given(20);
        let mut read = [0; 21];
        let mut found = 0;
        while let Some(task) = do_first(&mut project) {
            assert!(num_at_hand(&project) <= 4);
            match task.about {
                About::Photograph(id) => read[id as usize] += 1,
                _ => found += 1,
            }
            // The list is seen before anything is computed.
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
        assert_eq!((count, num_at_hand(&project)), (8, 4));
    }

    #[test]
    fn whoever_looks_at_a_photograph_has_its_pixels_read_first_and_only_once() {
        let mut project = given(9);
        while do_first(&mut project).is_some() {}
        let is_gone = |photo: &&Given| project.photograph(photo).is_none();
        let id = project.document().photos.iter().find(is_gone).unwrap().id;
        project.update(Event::Show(Step::Features));
        project.update(Event::Look(id));
        let task = do_first(&mut project).unwrap();
        assert_eq!(task.about, About::Photograph(id));
        let photo = project.document().photo(id).unwrap();
        assert!(project.photograph(photo).is_some());
        assert_eq!(do_first(&mut project), None);
        // If that fails, it is not tried without end, and it takes part as before.
        let is_gone = |photo: &&Given| project.photograph(photo).is_none();
        let id = project.document().photos.iter().find(is_gone).unwrap().id;
        project.update(Event::Look(id));
        let task = project.wanted().into_iter().next().unwrap();
        assert_eq!(task.about, About::Photograph(id));
        project.broke_down(task.key, "there is not enough memory".to_owned());
        assert!(project.wanted().iter().all(|other| other.key != task.key));
        assert!(project.can_try_again() && project.taking_part().len() == 9);
        project.update(Event::TryAgain);
        assert_eq!(
            do_first(&mut project).map(|task| task.about),
            Some(About::Photograph(id))
        );
    }
}
