//! Panel of an empty project: a drop area for photographs, and samples.

use super::look;
use crate::panels::screen::{Action, Screen};
use crate::project::{Sample, Step};
use crate::session::Event;
use egui::{Align, Button, Layout, RichText, Shape, Stroke, Ui, UiBuilder, pos2, vec2};
use epipole_canvas::theme::Role;

/// Samples to start with.
const SAMPLES: [Sample; 3] = [Sample::Table, Sample::Upright, Sample::Plane];
/// Length of a dash and of a gap, points.
const DASH: f32 = 7.0;

/// Draws the drop area for photographs.
pub(crate) fn show(screen: &mut Screen<'_>, ui: &mut Ui) {
    let whole = ui.available_rect_before_wrap();
    let zone = whole.shrink(16.0_f32.min(whole.width() / 8.0));
    let [left, top, right, bottom] = [zone.left(), zone.top(), zone.right(), zone.bottom()];
    let corners = [
        (left, top),
        (right, top),
        (right, bottom),
        (left, bottom),
        (left, top),
    ];
    let outline = corners.map(|(x, y)| pos2(x, y));
    let stroke = Stroke::new(2.0, look::color(ui, Role::Muted));
    ui.painter()
        .extend(Shape::dashed_line(&outline, stroke, DASH, DASH));
    let inside = UiBuilder::new()
        .max_rect(zone.shrink(12.0))
        .layout(Layout::top_down(Align::Center));
    ui.scope_builder(inside, |ui| {
        ui.add_space((0.5 * ui.available_height() - 130.0).max(0.0));
        ui.heading("Drop photographs here");
        ui.label("Two or more of one thing, taken from different places.");
        ui.add_space(6.0);
        let choose = Button::new(RichText::new("Choose photographs…").heading());
        if ui.add(choose.min_size(vec2(0.0, 40.0))).clicked() {
            screen.actions.push(Action::AddPhotographs);
        }
        ui.add_space(14.0);
        ui.weak("Or open a sample:");
        for sample in SAMPLES {
            if ui.button(sample.title()).clicked() {
                screen.send(Event::OpenSample(sample));
                screen.send(Event::Show(Step::Reconstruction));
            }
        }
    });
}
