//! Lists of lengths, figures and control points, with the values that are typed.

use super::super::screen::Screen;
use super::super::widgets::look;
use crate::session::Event;
use egui::{DragValue, Response, TextEdit, Ui};
use epipole_canvas::theme::Role;

/// Control point whose name is being typed.
pub(super) type NameDraft = Option<(usize, String)>;

/// Whether a field has a new value.
fn is_done(response: &Response) -> bool {
    (response.changed() && !response.dragged()) || response.drag_stopped()
}

/// Shows the lengths, with the field for a known one.
pub(super) fn lengths(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let is_known = |index: &usize| project.document().measures[*index].length_m.is_some();
    for (index, measure) in project.document().measures.iter().enumerate() {
        ui.separator();
        ui.strong(format!("{}: {}", index + 1, project.length_words(index)));
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("known length, m");
            let mut meters = measure.length_m.unwrap_or(0.0);
            let field = DragValue::new(&mut meters)
                .range(0.0..=1e6)
                .speed(0.01)
                .max_decimals(4);
            let response = ui
                .add(field.update_while_editing(false))
                .labelled_by(label.id);
            if is_done(&response) {
                let known = (meters > 0.0).then_some(meters);
                screen.send(Event::Length(index, known));
            }
            if ui.button("Remove").clicked() {
                screen.send(Event::Forget(index));
            }
        });
        if let Some(words) = project.residual_words(index) {
            ui.weak(words);
        } else if is_known(&index) && project.scale().is_some() {
            ui.weak("sets the scale");
        }
    }
    if let Some(words) = project.disagreement_words() {
        ui.colored_label(look::color(ui, Role::Outlier), words);
    }
}

/// Shows the angles, areas and volumes.
pub(super) fn shapes(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    for index in 0..project.document().shapes.len() {
        ui.separator();
        let (name, words) = (project.shape_name(index), project.shape_words(index));
        ui.strong(format!("{name}: {words}"));
        if ui
            .button(format!("Remove {}", name.to_lowercase()))
            .clicked()
        {
            screen.send(Event::ForgetShape(index));
        }
    }
}

/// Shows the control points, with the fields of their names and coordinates.
pub(super) fn control_points(screen: &mut Screen<'_>, ui: &mut Ui, draft: &mut NameDraft) {
    let project = screen.project;
    for (index, control) in project.document().control_points.iter().enumerate() {
        ui.separator();
        let name = &control.name;
        ui.strong(format!("{name}: {}", project.control_words(index)));
        let mut change = None;
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("name");
            let typed = draft.as_ref().filter(|(other, _)| *other == index);
            let mut text = typed.map_or(name.clone(), |(_, text)| text.clone());
            let field = TextEdit::singleline(&mut text).desired_width(90.0);
            let response = ui.add(field).labelled_by(label.id);
            if response.changed() {
                *draft = Some((index, text.clone()));
            }
            if response.lost_focus() && draft.take().is_some() && text != *name {
                change = Some((text, control.position_m));
            }
            if ui.button(format!("Remove {name}")).clicked() {
                screen.send(Event::ForgetControl(index));
            }
        });
        let mut is_known = control.position_m.is_some();
        if ui
            .checkbox(&mut is_known, format!("coordinates of {name} are known"))
            .changed()
        {
            change = Some((name.clone(), is_known.then_some([0.0; 3])));
        }
        if let Some(mut position_m) = control.position_m {
            ui.horizontal_wrapped(|ui| {
                for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                    let label = ui.label(format!("{name} {letter}, m"));
                    let field = DragValue::new(&mut position_m[axis])
                        .speed(0.01)
                        .max_decimals(6);
                    let response = ui
                        .add(field.update_while_editing(false))
                        .labelled_by(label.id);
                    if is_done(&response) {
                        change = Some((name.clone(), Some(position_m)));
                    }
                }
            });
        }
        if let Some((name, position_m)) = change {
            screen.send(Event::ChangeControl(index, name, position_m));
        }
    }
    let words = project.alignment_words();
    if !words.is_empty() {
        match project.bad_control() {
            Some(_) => ui.colored_label(look::color(ui, Role::Outlier), words),
            None => ui.label(words),
        };
    }
}
