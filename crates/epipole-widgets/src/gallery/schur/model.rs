//! Numbers of cameras, points, and views of each point.

use super::blocks::Blocks;
use crate::contract::{
    Challenge, Control, Declared, Event, Knob, Model, Problem, Settings, Slider, knobs,
};

const CAMERAS: Slider = Slider::new("cameras", "Cameras")
    .range(2.0, 12.0, 1.0)
    .at(8.0);
const POINTS: Slider = Slider::new("points", "Points")
    .range(10.0, 120.0, 5.0)
    .at(60.0);
const VIEWS: Slider = Slider::new("views", "Views of each")
    .range(2.0, 12.0, 1.0)
    .at(3.0);
const KNOBS: &[Knob] = knobs![CAMERAS, POINTS, VIEWS];

/// The model of `schur`.
pub(crate) struct Schur {
    settings: Settings,
    pub(super) blocks: Blocks,
}

impl Schur {
    /// Returns the number of cameras that see each point.
    pub(super) fn num_views(&self) -> usize {
        self.settings.count(&VIEWS).min(self.blocks.num_cameras)
    }
}

fn blocks(settings: &Settings) -> Blocks {
    Blocks::new(
        settings.count(&CAMERAS),
        settings.count(&POINTS),
        settings.count(&VIEWS),
    )
}

impl Declared for Schur {
    const NAME: &'static str = "schur";
    const TITLE: &'static str = "What the Schur complement saves";
    const HELP: &'static str =
        "Set how many cameras and points there are, and how many cameras see each point.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let settings = Settings::new(KNOBS);
        Self {
            blocks: blocks(&settings),
            settings,
        }
    }
}

impl Model for Schur {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.settings.update(event)?.is_some() {
            self.blocks = blocks(&self.settings);
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<Schur>] = &[
    Challenge {
        id: "full",
        goal: "With eight cameras or more, fill the small matrix completely.",
        hint: "Which two cameras are coupled once the points are gone?",
        why: "Eliminating a point couples all cameras that see it; once every two cameras share a point, no block \
              is zero.",
        check: |model| model.blocks.num_cameras >= 8 && model.blocks.coupled_ratio() >= 1.0,
        solution: || vec![Event::set(&VIEWS, 8.0)],
    },
    Challenge {
        id: "hundred",
        goal: "Make the elimination save more than a hundred times the work.",
        hint: "What makes a point cheap to eliminate?",
        why: "The work for everything at once grows with the cube of all unknowns; eliminated one by one, points \
              cost a fixed amount each, and less the fewer cameras see them.",
        check: |model| model.blocks.saving() > 100.0,
        solution: || vec![Event::set(&POINTS, 120.0), Event::set(&VIEWS, 2.0)],
    },
];
