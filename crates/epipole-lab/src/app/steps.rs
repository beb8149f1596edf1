//! List of the steps: a column, or a scrolling row on narrow screens.

use crate::panels::Action;
use crate::panels::widgets::look;
use crate::project::{PhotoId, Project, Step};
use crate::session::{Event, StepState};
use egui::scroll_area::ScrollBarVisibility;
use egui::style::ScrollAnimation;
use egui::{
    Align, Align2, Color32, Layout, Rect, Response, ScrollArea, Stroke, TextStyle, Ui, pos2, vec2,
};
use epipole_canvas::theme::Role;
use std::collections::{BTreeMap, BTreeSet};

/// Side of a step's mark, points.
const MARK: f32 = 10.0;

/// The steps, with their states.
#[derive(Default)]
pub(super) struct Steps {
    /// Step that the row was last scrolled to.
    centered: Option<Step>,
    states: BTreeMap<Step, StepState>,
    /// Revision of the project that these values belong to.
    revision: Option<u64>,
    /// Photographs of the project at that revision.
    photos: BTreeSet<PhotoId>,
    /// Time spent on the outputs of each step, seconds.
    seconds: BTreeMap<Step, f64>,
    running: BTreeSet<Step>,
    /// Time of the last frame, seconds.
    last_s: Option<f64>,
}

impl Steps {
    /// Updates from the project, and adds the time since the last frame to running steps.
    ///
    /// * `now_s`: time of the frame, seconds
    pub(super) fn update(&mut self, project: &Project, running: BTreeSet<Step>, now_s: f64) {
        let since_s = now_s - self.last_s.replace(now_s).unwrap_or(now_s);
        for step in &self.running {
            *self.seconds.entry(*step).or_default() += since_s;
        }
        self.running = running;
        if self.revision.replace(project.revision()) != Some(project.revision()) {
            self.states = project.step_states();
            let photos = project.document().photos.iter().map(|photo| photo.id);
            let before = std::mem::replace(&mut self.photos, photos.collect());
            // Other photographs: the times start at zero.
            if before.is_disjoint(&self.photos) {
                self.seconds.clear();
            }
        }
    }

    /// Draws the steps as a column.
    pub(super) fn column(&self, project: &Project, ui: &mut Ui, actions: &mut Vec<Action>) {
        ui.with_layout(Layout::top_down_justified(Align::Min), |ui| {
            for step in Step::ALL {
                let response = self.button(project, ui, step, actions);
                let right = response.rect.right() - MARK;
                let center = pos2(right, response.rect.center().y);
                let rect = Rect::from_center_size(center, vec2(MARK, MARK));
                let color = match project.view().step == step {
                    true => look::color(ui, Role::Background),
                    false => look::color(ui, Role::Muted),
                };
                self.mark(ui, step, rect, color);
                let Some(words) = self.time_words(step) else {
                    continue;
                };
                let painter = ui.painter();
                let width = |text: &str, style: TextStyle| {
                    let font = style.resolve(ui.style());
                    let galley = painter.layout_no_wrap(text.to_owned(), font, color);
                    galley.size().x
                };
                // Beside the longest title there is no room for a time.
                let taken = width(step.title(), TextStyle::Button)
                    + width(&words, TextStyle::Small)
                    + 3.0 * MARK
                    + ui.spacing().button_padding.x;
                if taken < response.rect.width() {
                    let font = TextStyle::Small.resolve(ui.style());
                    let at = center - vec2(MARK, 0.0);
                    painter.text(at, Align2::RIGHT_CENTER, words, font, color);
                }
            }
        });
    }

    /// Draws the steps as a row, scrolled to the current step or to the one that gets the focus.
    pub(super) fn row(&mut self, project: &Project, ui: &mut Ui, actions: &mut Vec<Action>) {
        let current = project.view().step;
        ScrollArea::horizontal()
            .id_salt("steps")
            .scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden)
            .show(ui, |ui| {
                ui.horizontal(|ui| {
                    for step in Step::ALL {
                        let response = self.button(project, ui, step, actions);
                        let room = ui.allocate_exact_size(vec2(MARK, MARK), egui::Sense::hover());
                        self.mark(ui, step, room.0, look::color(ui, Role::Muted));
                        let is_new = step == current && self.centered != Some(step);
                        if is_new || response.gained_focus() {
                            let at_once = ScrollAnimation::none();
                            response.scroll_to_me_animation(Some(Align::Center), at_once);
                        }
                    }
                });
            });
        self.centered = Some(current);
    }

    fn button(
        &self,
        project: &Project,
        ui: &mut Ui,
        step: Step,
        actions: &mut Vec<Action>,
    ) -> Response {
        let response = ui.selectable_label(project.view().step == step, step.title());
        let response = match self.state_words(step) {
            Some(words) => {
                let describe = |node: &mut egui::accesskit::Node| {
                    node.set_description(words.as_str());
                };
                ui.ctx().accesskit_node_builder(response.id, describe);
                response.on_hover_text(words)
            }
            None => response,
        };
        if response.has_focus() {
            // The fill of the current step hides the toolkit's own ring.
            let stroke = Stroke::new(2.0, look::color(ui, Role::Best));
            let ring = response.rect.shrink(1.0);
            ui.painter()
                .rect_stroke(ring, 3.0, stroke, egui::StrokeKind::Inside);
        }
        if response.clicked() {
            actions.push(Action::Send(Event::Show(step)));
        }
        response
    }

    /// Draws the state: a tick, an exclamation mark, or three dots while it is being computed.
    fn mark(&self, ui: &Ui, step: Step, rect: Rect, color: Color32) {
        let at = |x: f32, y: f32| rect.lerp_inside(vec2(x, y));
        let stroke = Stroke::new(2.0, color);
        let painter = ui.painter();
        if self.running.contains(&step) {
            for x in [0.1, 0.5, 0.9] {
                painter.circle_filled(at(x, 0.5), 1.5, color);
            }
            return;
        }
        match self.states.get(&step) {
            Some(StepState::Done) => {
                painter.line_segment([at(0.0, 0.55), at(0.35, 0.9)], stroke);
                painter.line_segment([at(0.35, 0.9), at(1.0, 0.1)], stroke);
            }
            Some(StepState::Failed) => {
                painter.line_segment([at(0.5, 0.0), at(0.5, 0.62)], stroke);
                painter.circle_filled(at(0.5, 0.92), 1.4, color);
            }
            None => {}
        }
    }

    fn state_words(&self, step: Step) -> Option<String> {
        if self.running.contains(&step) {
            return Some("running".to_owned());
        }
        let words = match self.states.get(&step)? {
            StepState::Done => "done",
            StepState::Failed => "failed",
        };
        Some(match self.time_words(step) {
            Some(time) => format!("{words}, {time}"),
            None => words.to_owned(),
        })
    }

    /// Formats the time spent on a step, if it is long enough to notice.
    fn time_words(&self, step: Step) -> Option<String> {
        let seconds = *self.seconds.get(&step)?;
        match seconds {
            ..0.55 => None,
            ..99.5 => Some(format!("{seconds:.0} s")),
            _ => Some(format!("{:.0} min", seconds / 60.0)),
        }
    }
}
