//! Panels: one per step, in egui. A panel reads the project and sends actions to the app.

mod all_views;
mod calibrate;
mod depth;
mod depth_controls;
mod edit;
mod export;
mod features;
mod matches;
mod measure;
mod photographs;
mod reconstruction;
mod screen;
mod two_views;
mod view;
pub(crate) mod widgets;

pub(crate) use screen::{Action, Panel, Screen, Views};

use crate::project::Step;

/// All panels, each with its step and in its initial state.
pub(crate) fn all() -> [(Step, Box<dyn Panel>); 9] {
    [
        (
            Step::Photographs,
            Box::new(photographs::Photographs::default()),
        ),
        (Step::Calibrate, Box::new(calibrate::Calibrate::default())),
        (Step::Features, Box::new(features::Features::default())),
        (Step::Matches, Box::new(matches::Matches)),
        (Step::TwoViews, Box::new(two_views::TwoViews::default())),
        (
            Step::Reconstruction,
            Box::new(reconstruction::Reconstruction),
        ),
        (Step::Depth, Box::new(depth::Depth::default())),
        (Step::Measure, Box::new(measure::Measuring::default())),
        (Step::Export, Box::new(export::Export::default())),
    ]
}
