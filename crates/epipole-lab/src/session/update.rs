//! State changes by events.

use super::event::Event;
use crate::project::{
    Anchor, Blob, CropBox, Document, InputPhoto, Measure, PhotoId, PointSet, Project, Sample,
    Source, Step, content_of,
};
use crate::tasks::ReconstructionOfAll;

/// Maximum number of undo steps.
const MAX_PAST: usize = 200;

impl Project {
    /// Applies an event. An invalid event leaves the state unchanged.
    pub fn update(&mut self, event: Event) {
        self.revision += 1;
        self.carry_out(event);
        self.note_result();
        self.balance_pixels();
    }

    fn carry_out(&mut self, event: Event) {
        let before = self.document.clone();
        match event {
            Event::Undo => return self.step_back(),
            Event::Redo => return self.step_forward(),
            Event::Show(step) => self.view.step = step,
            Event::Look(id) => self.look(id),
            Event::LookAtPair(first, second) => self.look_at_pair(first, second),
            Event::LookAtComponent(component) => self.view.component = component,
            Event::TryAgain => {
                self.cache.retry();
                self.unread.clear();
            }
            Event::Pause(paused) => self.paused = paused,
            Event::Add(files) => self.add(files),
            Event::Begin(files) => {
                self.clear();
                self.add(files);
            }
            Event::OpenSample(sample) => self.open_sample(sample),
            Event::AddBoards(files) => self.add_boards(files),
            Event::OpenBoards => self.open_boards(),
            Event::ClearBoards => self.document.boards.clear(),
            Event::UseCamera(camera) => self.use_camera(camera),
            Event::UsePoses(poses) => self.use_poses(poses),
            Event::OpenProject(saved, files) => {
                self.document = self.restored(*saved, files);
                self.view.step = Step::Photographs;
            }
            Event::Remove(id) => {
                self.document.photos.retain(|photo| photo.id != id);
                self.document.boards.retain(|photo| photo.id != id);
                let is_of = |end: &Anchor| end.photos().any(|photo| photo == id);
                let gone = |m: &Measure| m.ends.iter().any(is_of);
                self.document.measures.retain(|measure| !gone(measure));
                self.forget_figures_of(id);
                let floor = self.document.floor.take();
                self.document.floor = floor.filter(|ends| !ends.iter().any(is_of));
                self.document.dense.retain(|(a, b)| *a != id && *b != id);
                (self.document.deleted.keypoints).retain(|(photo, _)| *photo != id);
            }
            Event::Clear => {
                self.clear();
                self.view.step = Step::Photographs;
            }
            Event::Exclude(id, excluded) => {
                if let Some(photo) = self.photo_mut(id) {
                    photo.excluded = excluded;
                }
            }
            Event::Focal(ids, focal_px) => {
                if focal_px.is_none_or(|f| f.is_finite() && f > 0.0) {
                    for id in ids {
                        if let Some(photo) = self.photo_mut(id) {
                            photo.focal_px = focal_px;
                        }
                    }
                }
            }
            Event::Earlier(id) => {
                let photos = &mut self.document.photos;
                if let Some(place @ 1..) = photos.iter().position(|photo| photo.id == id) {
                    photos.swap(place, place - 1);
                }
            }
            Event::Set(settings) => self.document.settings = settings.checked(),
            Event::Measure(measure) => self.measure(measure),
            Event::Length(index, length_m) => {
                let is_length = length_m.is_none_or(|m| m.is_finite() && m > 0.0);
                let measure = self.document.measures.get_mut(index);
                if let Some(measure) = measure.filter(|_| is_length) {
                    measure.length_m = length_m;
                }
            }
            Event::Forget(index) => {
                if index < self.document.measures.len() {
                    self.document.measures.remove(index);
                }
            }
            Event::MeasureShape(shape) => self.measure_shape(shape),
            Event::ForgetShape(index) => self.forget_shape(index),
            Event::AddControl(control) => self.add_control(control),
            Event::ChangeControl(index, name, position_m) => {
                self.change_control(index, name, position_m);
            }
            Event::ForgetControl(index) => self.forget_control(index),
            Event::Floor(ends) => {
                let known = |ends: &[Anchor; 3]| {
                    let [a, b, c] = ends;
                    let there = ends.iter().all(|end| self.document.has_all_of(end));
                    a != b && b != c && a != c && there
                };
                if ends.as_ref().is_none_or(known) {
                    self.document.floor = ends;
                }
            }
            Event::Dense(a, b, is_part) => {
                let known = self.document.pair((a, b)).is_some();
                self.document
                    .dense
                    .retain(|pair| *pair != (a, b) && *pair != (b, a));
                if is_part && known {
                    self.document.dense.push((a, b));
                }
            }
            Event::AllViews(is_part) => self.document.all_views = is_part,
            Event::Crop(crop) => {
                if crop.as_ref().is_none_or(CropBox::is_valid) {
                    self.document.crop = crop;
                }
            }
            Event::Delete(mut points) => {
                let photos = &self.document.photos;
                let is_known = |id: PhotoId| photos.iter().any(|photo| photo.id == id);
                points.keypoints.retain(|(photo, _)| is_known(*photo));
                let deleted = self.document.deleted.with(&points);
                self.document.deleted = deleted;
            }
            Event::Restore => self.document.deleted = PointSet::default(),
        }
        if self.document != before {
            self.remember(before);
        }
        self.take_imported();
        self.look_at_what_is_there();
    }

    fn photo_mut(&mut self, id: PhotoId) -> Option<&mut InputPhoto> {
        let document = &mut self.document;
        let mut all = document.photos.iter_mut().chain(&mut document.boards);
        all.find(|photo| photo.id == id)
    }

    fn remember(&mut self, before: Document) {
        self.future.clear();
        self.past.push(before);
        if self.past.len() > MAX_PAST {
            self.past.remove(0);
        }
    }

    fn step_back(&mut self) {
        if let Some(before) = self.past.pop() {
            self.future
                .push(std::mem::replace(&mut self.document, before));
            self.look_at_what_is_there();
        }
    }

    fn step_forward(&mut self) {
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(&mut self.document, after));
            self.look_at_what_is_there();
        }
    }

    fn add(&mut self, files: Vec<(String, Blob)>) {
        for (name, bytes) in files {
            let source = Source::File(bytes);
            self.give(&name, source);
        }
    }

    fn give(&mut self, name: &str, source: Source) {
        let given = self.given(&self.document.photos, name, source);
        self.next_id = given.id;
        self.document.photos.push(given);
    }

    /// Creates a photograph with a number and a name that are unique in the list.
    pub(super) fn given(&self, list: &[InputPhoto], name: &str, source: Source) -> InputPhoto {
        InputPhoto {
            id: self.next_id + 1,
            name: unique_name(list, name),
            content: content_of(&source),
            source,
            excluded: false,
            focal_px: None,
        }
    }

    /// Removes all photographs, and what depends on them.
    fn clear(&mut self) {
        self.document.photos.clear();
        self.document.measures.clear();
        self.document.shapes.clear();
        self.document.control_points.clear();
        self.document.floor = None;
        self.document.dense.clear();
        self.document.all_views = false;
        self.document.poses = None;
        self.document.crop = None;
        self.document.deleted = PointSet::default();
    }

    /// Clears the undo history.
    pub fn clear_history(&mut self) {
        self.past.clear();
        self.future.clear();
    }

    fn open_sample(&mut self, sample: Sample) {
        self.clear();
        for index in 0..sample.len() {
            self.give(&sample.name(index), Source::Rendered(sample, index));
        }
    }

    fn measure(&mut self, measure: Measure) {
        let [a, b] = measure.ends;
        let known = self.document.has_all_of(&a) && self.document.has_all_of(&b);
        let is_length = measure.length_m.is_none_or(|m| m.is_finite() && m > 0.0);
        if a != b && known && is_length {
            self.document.measures.push(measure);
        }
    }

    fn look(&mut self, id: PhotoId) {
        if self.document.photo(id).is_some() {
            self.view.photo = id;
        } else if self.document.board(id).is_some() {
            self.view.board = id;
        }
    }

    fn look_at_pair(&mut self, first: PhotoId, second: PhotoId) {
        let place = |id| self.document.photos.iter().position(|photo| photo.id == id);
        if let (Some(a), Some(b)) = (place(first), place(second))
            && a != b
        {
            self.view.pair = if a < b {
                (first, second)
            } else {
                (second, first)
            };
        }
    }

    /// Repairs the view: selected photographs must exist, and pairs be in order.
    fn look_at_what_is_there(&mut self) {
        let photos = &self.document.photos;
        if self.document.photo(self.view.photo).is_none() {
            self.view.photo = photos.first().map_or(0, |photo| photo.id);
        }
        if self.document.board(self.view.board).is_none() {
            self.view.board = (self.document.boards.first()).map_or(0, |photo| photo.id);
        }
        let place = |id| photos.iter().position(|photo| photo.id == id);
        let (a, b) = self.view.pair;
        match (place(a), place(b)) {
            (Some(first), Some(second)) if first < second => {}
            (Some(first), Some(second)) if first > second => self.view.pair = (b, a),
            _ => {
                let id = |place: usize| photos.get(place).map_or(0, |photo| photo.id);
                self.view.pair = (id(0), id(1));
            }
        }
        let components = self
            .get(ReconstructionOfAll)
            .map_or(0, |r| r.components.len());
        if components > 0 {
            self.view.component = self.view.component.min(components - 1);
        }
    }
}

/// Returns the name without folders, with a number appended if another photograph has it already.
/// Extensions are ignored, as an exported photograph may get another one.
pub(super) fn unique_name(list: &[InputPhoto], name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let clean: String = (name.chars())
        .map(|c| if c.is_control() { '_' } else { c })
        .collect();
    let name = if clean.trim().is_empty() {
        "photograph"
    } else {
        clean.trim()
    };
    let split = |name: &str| match name.rsplit_once('.') {
        Some((stem, end)) if !stem.is_empty() => (stem.to_lowercase(), format!(".{end}")),
        _ => (name.to_lowercase(), String::new()),
    };
    let taken = |name: &str| {
        let stem = split(name).0;
        list.iter().any(|photo| split(&photo.name).0 == stem)
    };
    if !taken(name) {
        return name.to_owned();
    }
    let ending = split(name).1;
    let stem = &name[..name.len() - ending.len()];
    let mut number = 2;
    loop {
        let other = format!("{stem}-{number}{ending}");
        if !taken(&other) {
            return other;
        }
        number += 1;
    }
}
