//! The board, the calibrated camera with its uncertainty, and the error of each photograph.

use crate::panels::screen::{Action, Screen};
use crate::panels::widgets::controls::{self, Change};
use crate::panels::widgets::look;
use crate::project::{BoardPattern, InputPhoto, LensModel, MAX_MARKS, SQUARES_M, Step};
use crate::session::{BoardOutcome, Event};
use crate::tasks::{Calibration, CalibrationOfBoards, CameraFormat};
use egui::{DragValue, Rect, Sense, Stroke, Ui, vec2};
use epipole_canvas::theme::Role;

/// Draws the board, the camera and the photographs.
pub(super) fn controls(screen: &mut Screen<'_>, all_marks: &mut bool, ui: &mut Ui) {
    let project = screen.project;
    ui.horizontal_wrapped(|ui| {
        if ui.button("Open the sample").clicked() {
            screen.send(Event::OpenBoards);
        }
        if ui.button("Take photographs…").clicked() {
            screen.actions.push(Action::TakePhotographs);
        }
        if ui.button("Open a camera file…").clicked() {
            screen.actions.push(Action::OpenCameras);
        }
        let any = !project.document().boards.is_empty();
        let remove = egui::Button::new("Remove all");
        if ui.add_enabled(any, remove).clicked() {
            screen.send(Event::ClearBoards);
        }
    });
    board(screen, ui);
    ui.separator();
    let used = project.use_words();
    if !used.is_empty() {
        ui.label(used.trim());
        if ui.button("Stop using it").clicked() {
            screen.send(Event::UseCamera(None));
        }
    }
    match project.get(CalibrationOfBoards) {
        Some(found) => camera(screen, found, all_marks, ui),
        None => drop(ui.label(project.calibrate_status())),
    }
    let current = project.document().board(project.view().board);
    if let Some(given) = current {
        ui.separator();
        one(screen, ui, given);
    }
    ui.separator();
    ui.weak("The same on the command line:");
    ui.label(egui::RichText::new(project.calibrate_command()).small());
    controls::book(ui, Step::Calibrate);
}

/// Draws the controls of board and lens.
fn board(screen: &mut Screen<'_>, ui: &mut Ui) {
    controls::edit(screen, |settings| {
        let options = &mut settings.calibration;
        let mut change = Change::No;
        ui.horizontal_wrapped(|ui| {
            for (pattern, name) in [
                (BoardPattern::Chessboard, "chessboard"),
                (BoardPattern::Circles, "asymmetric circles"),
            ] {
                let radio = ui.radio_value(&mut options.board.pattern, pattern, name);
                change = change.max(radio.changed().into());
            }
        });
        let (marks, side) = match options.board.pattern {
            BoardPattern::Chessboard => ("Inner corners:", "Square side, mm"),
            BoardPattern::Circles => ("Circles:", "Row spacing, mm"),
        };
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 5.0;
            ui.weak(marks);
            for (name, value) in [
                ("columns", &mut options.board.columns),
                ("rows", &mut options.board.rows),
            ] {
                let field = DragValue::new(value).range(2..=MAX_MARKS);
                change = change.max(number(ui, name, field));
            }
        });
        let mut side_mm = 1e3 * options.square_m;
        let [least, most] = SQUARES_M.map(|side_m| 1e3 * side_m);
        let field = DragValue::new(&mut side_mm)
            .range(least..=most)
            .speed(0.1)
            .max_decimals(3);
        let moved = ui.horizontal(|ui| number(ui, side, field)).inner;
        if moved != Change::No {
            // Rounded to what a reader types: 25 mm are 0.025 m, without further digits.
            options.square_m = (side_mm * 1e6).round() / 1e9;
        }
        change = change.max(moved);
        ui.weak("Lens:");
        ui.horizontal_wrapped(|ui| {
            for (lens, name) in [
                (LensModel::Brown, "standard (Brown)"),
                (LensModel::Rational, "wide angle (rational)"),
                (LensModel::Fisheye, "fisheye"),
            ] {
                let radio = ui.radio_value(&mut options.lens, lens, name);
                change = change.max(radio.changed().into());
            }
        });
        change
    });
}

fn number(ui: &mut Ui, name: &str, field: DragValue<'_>) -> Change {
    let label = ui.label(name);
    let response = ui
        .add(field.update_while_editing(false))
        .labelled_by(label.id);
    controls::change_of(&response)
}

/// Shows the calibrated camera.
fn camera(screen: &mut Screen<'_>, found: &Calibration, all_marks: &mut bool, ui: &mut Ui) {
    let project = screen.project;
    ui.horizontal_wrapped(|ui| {
        let is_used = project.document().camera.as_ref() == Some(&found.camera);
        let button = egui::Button::new("Use for my photographs");
        if ui.add_enabled(!is_used, button).clicked() {
            screen.send(Event::UseCamera(Some(found.camera.clone())));
        }
        if ui.button("Save camera.json").clicked() {
            screen.actions.push(Action::SaveCamera);
        }
        for (format, button) in [
            (CameraFormat::OpenCv, "Save for OpenCV"),
            (CameraFormat::Ros, "Save for ROS"),
            (CameraFormat::Colmap, "Save for COLMAP"),
        ] {
            if ui.button(button).clicked() {
                screen.actions.push(Action::SaveCameraAs(format));
            }
        }
    });
    controls::row(ui, "error", format!("{:.3} px", found.rms_px));
    controls::row(
        ui,
        "coverage",
        format!("{:.0}% of the image", 100.0 * found.coverage),
    );
    ui.checkbox(all_marks, "Show marks of all photographs");
    for warning in project.calibration_warnings() {
        ui.colored_label(look::color(ui, Role::Outlier), format!("{warning}."));
    }
    let sure = |value: f64, deviation: f64| format!("{value:.2} ± {deviation:.2} px");
    let rows = ["fu", "fv", "cu", "cv"];
    for (n, name) in rows.into_iter().enumerate() {
        controls::row(ui, name, sure(found.camera.k[n], found.std_dev_k[n]));
    }
    let numbers = (found.camera.coefficients.iter()).zip(&found.std_dev_lens);
    for (name, (value, deviation)) in found.camera.lens.coefficients().iter().zip(numbers) {
        controls::row(ui, name, format!("{value:.5} ± {deviation:.5}"));
    }
    errors(screen, found, ui);
}

/// Draws the error of each photograph as a bar; a click selects the photograph.
fn errors(screen: &mut Screen<'_>, found: &Calibration, ui: &mut Ui) {
    let project = screen.project;
    let errors = found.views.iter().flatten().map(|view| view.rms_px);
    let most = errors.fold(f64::MIN_POSITIVE, f64::max);
    ui.weak("Error by photograph");
    for (given, view) in project.boards_taking_part().into_iter().zip(&found.views) {
        let Some(view) = view else { continue };
        let size = vec2(ui.available_width().min(280.0), 22.0);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let words = format!("{}: {:.3} px", given.name, view.rms_px);
        let selected = project.view().board == given.id;
        response
            .widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, selected, &words));
        let share = (view.rms_px / most) as f32;
        let bar = Rect::from_min_size(rect.min, vec2(share * rect.width(), rect.height()));
        ui.painter().rect_filled(
            bar.shrink2(vec2(0.0, 2.0)),
            2.0,
            look::color(ui, Role::Grid),
        );
        let ink = look::color(ui, Role::Ink);
        let font = egui::FontId::proportional(13.0);
        let at = rect.left_center() + vec2(6.0, 0.0);
        ui.painter()
            .text(at, egui::Align2::LEFT_CENTER, words, font, ink);
        if selected || response.has_focus() {
            let stroke = Stroke::new(1.5, look::color(ui, Role::Grip));
            ui.painter()
                .rect_stroke(rect, 2.0, stroke, egui::StrokeKind::Inside);
        }
        if response.clicked() {
            screen.send(Event::Look(given.id));
        }
    }
}

/// Shows the selected photograph.
fn one(screen: &mut Screen<'_>, ui: &mut Ui, given: &InputPhoto) {
    let project = screen.project;
    ui.strong(&given.name);
    let words = project.board_words(given);
    match project.board_outcome(given) {
        BoardOutcome::Found(_) | BoardOutcome::Pending => ui.label(words),
        _ => ui.colored_label(look::color(ui, Role::Outlier), words),
    };
    ui.horizontal_wrapped(|ui| {
        let mut takes_part = !given.excluded;
        if ui
            .checkbox(&mut takes_part, "Use this photograph")
            .changed()
        {
            screen.send(Event::Exclude(given.id, !takes_part));
        }
        if ui.button("Remove").clicked() {
            screen.send(Event::Remove(given.id));
        }
    });
}
