//! A model with its view as a trait object, so that one list can contain all figures.

use crate::canvas::Canvas;
use crate::contract::{
    Aspect, Challenge, ChallengeStatus, Declared, Event, Layout, Model, PhotoSlot, Space, View,
    Words,
};
use image::RgbImage;

/// Interface of [`Figure`](crate::Figure) to any model and view.
pub(crate) trait Stage {
    fn model(&self) -> &dyn Model;
    fn model_mut(&mut self) -> &mut dyn Model;
    fn words(&self) -> &dyn Words;
    fn challenges(&self) -> Vec<ChallengeStatus>;
    fn solution(&self, challenge: &str) -> Option<Vec<Event>>;
    fn spaces(&self) -> &'static [Space];
    fn photo_slots(&self) -> &'static [PhotoSlot];
    fn aspect(&self) -> Aspect;
    fn layout(&self, width: f64) -> Layout;
    fn draw(&mut self, layout: &Layout, canvas: &mut Canvas);
    fn photograph(&mut self, panel: &str) -> Option<RgbImage>;
    fn prepare(&mut self) -> bool;
    fn refine(&mut self) -> bool;
}

struct Pair<V: View> {
    model: V::Model,
    view: V,
}

/// Creates a model in its default state with its view.
pub(crate) fn set_up<V: View>() -> Box<dyn Stage> {
    Box::new(Pair::<V> {
        model: V::Model::new(),
        view: V::default(),
    })
}

impl<V: View> Stage for Pair<V> {
    fn model(&self) -> &dyn Model {
        &self.model
    }

    fn model_mut(&mut self) -> &mut dyn Model {
        &mut self.model
    }

    fn words(&self) -> &dyn Words {
        &self.model
    }

    fn challenges(&self) -> Vec<ChallengeStatus> {
        let status = |challenge: &Challenge<V::Model>| ChallengeStatus {
            id: challenge.id,
            goal: challenge.goal,
            hint: challenge.hint,
            why: challenge.why,
            solved: (challenge.check)(&self.model),
        };
        V::Model::CHALLENGES.iter().map(status).collect()
    }

    fn solution(&self, challenge: &str) -> Option<Vec<Event>> {
        let mut known = V::Model::CHALLENGES.iter();
        let found = known.find(|known| known.id == challenge);
        found.map(|known| (known.solution)())
    }

    fn spaces(&self) -> &'static [Space] {
        V::Model::SPACES
    }

    fn photo_slots(&self) -> &'static [PhotoSlot] {
        V::Model::PHOTO_SLOTS
    }

    fn aspect(&self) -> Aspect {
        V::ASPECT
    }

    fn layout(&self, width: f64) -> Layout {
        self.view.layout(&self.model, width)
    }

    fn draw(&mut self, layout: &Layout, canvas: &mut Canvas) {
        self.view.draw(&self.model, layout, canvas);
    }

    fn photograph(&mut self, panel: &str) -> Option<RgbImage> {
        self.view.photograph(&self.model, panel)
    }

    fn prepare(&mut self) -> bool {
        self.view.prepare(&self.model)
    }

    fn refine(&mut self) -> bool {
        self.view.refine(&self.model)
    }
}
