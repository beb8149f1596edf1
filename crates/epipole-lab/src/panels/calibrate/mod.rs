//! Calibration from photographs of a board: detected marks, and the uncertainty of the camera.

use crate::project::InputPhoto;
use crate::session::{BoardOutcome, Event};
use crate::tasks::{BoardFound, BoardOf};
mod camera;

use super::screen::{Panel, Screen};
use super::widgets::{controls, look, photo};
use egui::{Rect, ScrollArea, Sense, Shape, Stroke, Ui, vec2};
use epipole_canvas::theme::{Role, Theme};

/// Width of a thumbnail, points.
const SMALL: f32 = 112.0;

/// Panel of the step "Calibrate".
#[derive(Default)]
pub(super) struct Calibrate {
    lens: photo::Lens,
    /// Whether the marks of all photographs are shown.
    all_marks: bool,
}

impl Panel for Calibrate {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        let document = project.document();
        let Some(given) = document.board(project.view().board) else {
            let words = "Add photographs of a chessboard, or drop them here, or open the sample.";
            return controls::instead(ui, words);
        };
        let whole = ui.available_rect_before_wrap();
        let strip = (0.75 * SMALL + 34.0).min(0.4 * whole.height());
        let (above, below) = whole.split_top_bottom_at_y(whole.bottom() - strip);
        self.large(screen, ui, above.shrink(2.0), given);
        ui.scope_builder(egui::UiBuilder::new().max_rect(below), |ui| {
            ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
                ui.horizontal(|ui| {
                    for given in &document.boards {
                        card(screen, ui, given);
                    }
                });
            });
        });
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        camera::controls(screen, &mut self.all_marks, ui);
    }
}

impl Calibrate {
    fn large(&mut self, screen: &mut Screen<'_>, ui: &mut Ui, rect: Rect, given: &InputPhoto) {
        let project = screen.project;
        let Some(found) = project.get(BoardOf(given.id)) else {
            ui.painter()
                .rect_filled(rect, 0.0, look::color(ui, Role::Surface));
            return;
        };
        let key = project.key_of_board(given);
        let full = screen.views.pictures.full(ui, key, &found.picture);
        let shown = photo::show(ui, rect, &full, &mut self.lens, &given.name);
        let grip = look::of(Theme::Dark, Role::Grip);
        let at = |found: &BoardFound, mark: [f64; 2]| {
            let [u, v] = found.in_picture(mark);
            shown.at(u, v)
        };
        if self.all_marks {
            let dot = look::of(Theme::Dark, Role::Inlier);
            let others = project.boards_taking_part();
            let others = others
                .iter()
                .filter_map(|other| project.get(BoardOf(other.id)));
            let same = others.filter(|other| other.picture.full_size == found.picture.full_size);
            let dots =
                same.flat_map(|other| other.marks.iter().flatten().map(|mark| at(other, *mark)));
            shown.add(dots.map(|at| Shape::circle_filled(at, 2.0, dot)).collect());
        }
        // Along the rows, to show the order of the marks.
        let mut before = None;
        for mark in found.marks.iter().flatten() {
            let here = at(found, *mark);
            if let Some(before) = before {
                shown.line(before, here, grip);
            }
            before = Some(here);
        }
        // The first is larger; where marks are near each other, all are smaller.
        let mut marks = found.marks.iter().flatten().map(|mark| at(found, *mark));
        let (first, second) = (marks.next(), marks.next());
        let apart = first.zip(second).map_or(0.0, |(a, b)| a.distance(b));
        let radius = (0.3 * apart).clamp(1.5, 4.0);
        for (index, mark) in found.marks.iter().flatten().enumerate() {
            let radius = if index == 0 { 2.0 * radius } else { radius };
            shown.ring(at(found, *mark), radius, grip);
        }
    }
}

fn card(screen: &mut Screen<'_>, ui: &mut Ui, given: &InputPhoto) {
    let project = screen.project;
    let selected = project.view().board == given.id;
    ui.vertical(|ui| {
        ui.set_width(SMALL);
        let (rect, response) = ui.allocate_exact_size(vec2(SMALL, 0.75 * SMALL), Sense::click());
        let words = format!("{}: {}", given.name, project.board_words(given));
        response
            .widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, selected, &words));
        let painter = ui.painter();
        painter.rect_filled(rect, 3.0, look::color(ui, Role::Surface));
        let outcome = project.board_outcome(given);
        if let Some(found) = project.get(BoardOf(given.id)) {
            let texture = (screen.views.pictures)
                .small(ui, project.key_of_board(given), &found.picture)
                .clone();
            let size = texture.size_vec2();
            let fit = (rect.width() / size.x).min(rect.height() / size.y);
            let place = Rect::from_center_size(rect.center(), size * fit);
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            let tint = match outcome {
                BoardOutcome::Found(_) => egui::Color32::WHITE,
                _ => egui::Color32::from_gray(110),
            };
            ui.painter().image(texture.id(), place, whole, tint);
        }
        if selected || response.has_focus() {
            let stroke = Stroke::new(3.0, look::color(ui, Role::Grip));
            ui.painter()
                .rect_stroke(rect, 3.0, stroke, egui::StrokeKind::Inside);
        }
        if response.clicked() {
            screen.send(Event::Look(given.id));
        }
        let short = match outcome {
            BoardOutcome::Found(_) => match project.view_of(given) {
                Some(rms_px) => format!("found, {rms_px:.2} px"),
                None => "found".to_owned(),
            },
            BoardOutcome::Pending => "…".to_owned(),
            BoardOutcome::Excluded => "left out".to_owned(),
            BoardOutcome::OtherSize(..) => "another size".to_owned(),
            BoardOutcome::NotFound(_) | BoardOutcome::Unreadable(_) => "not found".to_owned(),
        };
        ui.add(egui::Label::new(egui::RichText::new(short).small()).truncate());
    });
}
