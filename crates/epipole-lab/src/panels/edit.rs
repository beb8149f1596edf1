//! Tools that edit the model: the box that limits it, and selection and deletion of points.

use super::screen::Screen;
use super::widgets::controls::{Change, change_of};
use super::widgets::look;
use super::widgets::selection::Tool;
use crate::project::{CropBox, PointSet, Project};
use crate::session::{Event, count};
use egui::{Button, DragValue, Key, Ui};
use epipole_canvas::theme::Role;

/// Draws the choice of a tool, and its controls.
pub(super) fn controls(screen: &mut Screen<'_>, ui: &mut Ui) {
    if screen.project.component().is_none() {
        return;
    }
    screen.views.cloud.has_tools = true;
    ui.horizontal_wrapped(|ui| {
        ui.weak("Tool");
        for (tool, name) in [
            (Tool::Look, "look"),
            (Tool::Box, "box"),
            (Tool::Select, "select"),
        ] {
            ui.radio_value(&mut screen.views.cloud.tool, tool, name);
        }
    });
    match screen.views.cloud.tool {
        Tool::Look => {}
        Tool::Box => crop(screen, ui),
        Tool::Select => select(screen, ui),
    }
    let words = screen.project.edit_words();
    if !words.is_empty() {
        ui.weak(words);
    }
}

/// Fits, changes and removes the box.
fn crop(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let current = project.crop().copied();
    if project.document().crop.is_some() && current.is_none() {
        let words = "The box belongs to another result: fit it again.";
        ui.colored_label(look::color(ui, Role::Outlier), words);
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button("Fit to the model").clicked()
            && let Some(crop) = project.fitted_crop()
        {
            screen.send(Event::Crop(Some(crop)));
        }
        let button = Button::new("Remove the box");
        if ui
            .add_enabled(project.document().crop.is_some(), button)
            .clicked()
        {
            screen.send(Event::Crop(None));
        }
    });
    let Some(crop) = screen.views.cloud.draft.or(current) else {
        ui.weak("The box limits what is shown, clicked and exported. Nothing is computed again.");
        return;
    };
    let mut edited = crop;
    match sides(project, &mut edited, ui) {
        Change::No => {}
        Change::Dragged => screen.views.cloud.draft = Some(edited),
        Change::Done => {
            screen.views.cloud.draft = None;
            screen.send(Event::Crop(Some(edited)));
        }
    }
    ui.weak(
        match (project.floor().is_some(), project.scale().is_some()) {
            (true, true) => "Meters along the sides; z is up from the floor.",
            (true, false) => "Units along the sides; z is up from the floor.",
            (false, true) => "Meters along the sides.",
            (false, false) => "Units along the sides.",
        },
    );
}

/// Draws the six sides of the box as numbers.
fn sides(project: &Project, crop: &mut CropBox, ui: &mut Ui) -> Change {
    let meters = project.scale().map_or(1.0, |scale| scale.meters_per_unit);
    let mut change = Change::No;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let width = crop.high[axis] - crop.low[axis];
        // A side stays on its own side of the other one.
        let gap = 1e-3 * width;
        ui.horizontal_wrapped(|ui| {
            let limits = [
                (f64::NEG_INFINITY, crop.high[axis] - gap),
                (crop.low[axis] + gap, f64::INFINITY),
            ];
            let sides = [(&mut crop.low, "from"), (&mut crop.high, "to")];
            for ((side, end), (least, most)) in sides.into_iter().zip(limits) {
                let label = ui.label(format!("{name} {end}"));
                let mut shown = side[axis] * meters;
                let field = DragValue::new(&mut shown)
                    .range(least * meters..=most * meters)
                    .speed(4e-3 * width * meters)
                    .max_decimals(4)
                    .update_while_editing(false);
                let response = ui.add(field).labelled_by(label.id);
                let changed = change_of(&response);
                if changed != Change::No {
                    side[axis] = shown / meters;
                    change = change.max(changed);
                }
            }
        });
    }
    change
}

/// Selects points by line and by rules, and deletes them.
fn select(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    ui.weak(
        "Drag a line around points, also hidden ones; with Shift or two fingers, a drag moves the view. \
         Each selection adds to the last.",
    );
    let cloud = &mut screen.views.cloud;
    let mut chosen: Option<PointSet> = None;
    let crop = Button::new("Select outside the box");
    if ui.add_enabled(project.crop().is_some(), crop).clicked() {
        chosen = Some(project.select_outside());
    }
    ui.horizontal_wrapped(|ui| {
        let least = cloud.selection.min_images;
        if ui.button("Select points seen by fewer than").clicked() {
            chosen = Some(project.select_sparse(|point| point.track.len() < least));
        }
        let field = DragValue::new(&mut cloud.selection.min_images).range(3..=50);
        let label = ui.add(field);
        name(&label, "fewer images than");
        ui.label("images");
    });
    ui.horizontal_wrapped(|ui| {
        let most_px = cloud.selection.max_error_px;
        if ui.button("Select points with an error above").clicked() {
            chosen = Some(project.select_sparse(|point| point.error_px > most_px));
        }
        let field = DragValue::new(&mut cloud.selection.max_error_px);
        let label = ui.add(field.range(0.05..=20.0).speed(0.02).max_decimals(2));
        name(&label, "larger error than, pixels");
        ui.label("px");
    });
    if let Some(points) = chosen {
        cloud.selection.add(project, &points);
    }
    ui.strong(format!(
        "{} selected",
        count(cloud.selection.count, "point")
    ));
    let (mut is_deleting, mut is_inverting, mut is_clearing) = (false, false, false);
    ui.horizontal_wrapped(|ui| {
        let any = cloud.selection.count > 0;
        is_deleting = ui.add_enabled(any, Button::new("Delete")).clicked();
        is_inverting = ui.button("Invert").clicked();
        is_clearing = ui.add_enabled(any, Button::new("Clear")).clicked();
        let typing = ui.ctx().text_edit_focused();
        is_deleting |= any && !typing && ui.input(|input| input.key_pressed(Key::Delete));
    });
    if is_inverting {
        let all = project.select(cloud.layers(project), |_| true);
        let points = all.without(&cloud.selection.points);
        cloud.selection.set(project, points);
    }
    if is_deleting || is_clearing {
        let points = std::mem::take(&mut cloud.selection.points);
        cloud.selection.set(project, PointSet::default());
        if is_deleting {
            screen.send(Event::Delete(points));
        }
    }
    let deleted = &project.document().deleted;
    if !deleted.is_empty() && ui.button("Restore deleted points").clicked() {
        screen.send(Event::Restore);
    }
}

/// Names a field without a label of its own.
fn name(response: &egui::Response, name: &str) {
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_label(name));
}
