//! A model together with its view, with the types erased, so that figures can stand in one list.

use crate::canvas::Canvas;
use crate::contract::{
    Control, Event, Handle, Job, JobResult, Layout, Model, PhotoSlot, Problem, Readout, Space, View,
};
use crate::figure::ChallengeStatus;
use image::RgbImage;

/// What [`Figure`](crate::Figure) needs of any model and view.
pub(crate) trait Stage {
    fn controls(&self) -> Vec<Control>;
    fn handles(&self) -> Vec<Handle>;
    fn spaces(&self) -> &'static [Space];
    fn readouts(&self) -> Vec<Readout>;
    fn describe(&self) -> String;
    fn challenges(&self) -> Vec<ChallengeStatus>;
    fn solution(&self, challenge: &str) -> Option<Vec<Event>>;
    fn is_running(&self) -> bool;
    fn update(&mut self, event: &Event) -> Result<(), Problem>;
    fn restore_handle(&mut self, id: &str, x: f64, y: f64) -> bool;
    fn job(&self) -> Option<Job>;
    fn job_done(&mut self, result: JobResult);
    fn photo_slots(&self) -> &'static [PhotoSlot];
    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem>;
    fn take_focal(&mut self, slot: &str, focal: f64);
    fn layout(&self, width: f64) -> Layout;
    fn draw(&mut self, layout: &Layout, canvas: &mut Canvas);
    fn refine(&mut self) -> bool;
}

struct Pair<V: View> {
    model: V::Model,
    view: V,
}

/// A model in its default state, with its view.
pub(crate) fn set_up<V: View>() -> Box<dyn Stage> {
    Box::new(Pair::<V> {
        model: V::Model::new(),
        view: V::default(),
    })
}

impl<V: View> Stage for Pair<V> {
    fn controls(&self) -> Vec<Control> {
        self.model.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        self.model.handles()
    }

    fn spaces(&self) -> &'static [Space] {
        self.model.spaces()
    }

    fn readouts(&self) -> Vec<Readout> {
        self.model.readouts()
    }

    fn describe(&self) -> String {
        self.model.describe()
    }

    fn challenges(&self) -> Vec<ChallengeStatus> {
        let status = |challenge: &crate::contract::Challenge<V::Model>| ChallengeStatus {
            id: challenge.id,
            goal: challenge.goal,
            hint: challenge.hint,
            solved: (challenge.check)(&self.model),
        };
        V::Model::challenges().iter().map(status).collect()
    }

    fn solution(&self, challenge: &str) -> Option<Vec<Event>> {
        let found = V::Model::challenges()
            .iter()
            .find(|known| known.id == challenge);
        found.map(|known| (known.solution)())
    }

    fn is_running(&self) -> bool {
        self.model.is_running()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.model.update(event)
    }

    fn restore_handle(&mut self, id: &str, x: f64, y: f64) -> bool {
        self.model.restore_handle(id, x, y)
    }

    fn job(&self) -> Option<Job> {
        self.model.job()
    }

    fn job_done(&mut self, result: JobResult) {
        self.model.job_done(result);
    }

    fn photo_slots(&self) -> &'static [PhotoSlot] {
        self.model.photo_slots()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.model.take_photo(slot, photo)
    }

    fn take_focal(&mut self, slot: &str, focal: f64) {
        self.model.take_focal(slot, focal);
    }

    fn layout(&self, width: f64) -> Layout {
        self.view.layout(&self.model, width)
    }

    fn draw(&mut self, layout: &Layout, canvas: &mut Canvas) {
        self.view.draw(&self.model, layout, canvas);
    }

    fn refine(&mut self) -> bool {
        self.view.refine(&self.model)
    }
}
