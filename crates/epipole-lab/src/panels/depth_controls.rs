//! Controls and readouts of the step "Depth".

use super::widgets::controls::{self, Change};
use super::widgets::look;
use crate::project::{MAX_DISPARITY_PX, Project};
use crate::tasks::Dense;
use egui::{Color32, DragValue, Rect, Ui};

/// Draws the controls of the disparity range.
pub(super) fn disparities(
    ui: &mut Ui,
    range_px: &mut Option<[i32; 2]>,
    proposed: Option<[i32; 2]>,
) -> Change {
    let mut as_proposed = range_px.is_none();
    let mut change = Change::No;
    let label = match proposed {
        Some([low, high]) => format!("Range from the points: {low} to {high} px"),
        None => "Range from the points".to_owned(),
    };
    if ui.checkbox(&mut as_proposed, label).changed() {
        *range_px = match as_proposed {
            true => None,
            false => Some(proposed.unwrap_or([0, 63])),
        };
        change = Change::Done;
    }
    if let Some(range) = range_px {
        for (end, name) in range
            .iter_mut()
            .zip(["Smallest disparity, px", "Largest disparity, px"])
        {
            ui.horizontal_wrapped(|ui| {
                let label = ui.label(name);
                let field = DragValue::new(end)
                    .range(0..=MAX_DISPARITY_PX)
                    .update_while_editing(false);
                let response = ui.add(field).labelled_by(label.id);
                change = change.max(controls::change_of(&response));
            });
        }
    }
    change
}

/// Draws the legend of the depth colors.
pub(super) fn legend(project: &Project, range: Option<[f64; 2]>, ui: &mut Ui) {
    let Some([near, far]) = range else { return };
    let (rect, response) = ui.allocate_exact_size(egui::vec2(280.0, 12.0), egui::Sense::hover());
    let words = format!(
        "bright: {}, dark: {}, blank: no answer",
        length(project, near),
        length(project, far)
    );
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &words));
    let theme = look::theme(ui);
    for n in 0..70 {
        let strip = Rect::from_min_size(
            rect.min + egui::vec2(4.0 * n as f32, 0.0),
            egui::vec2(4.5, rect.height()),
        );
        let [r, g, b] = theme.scale(1.0 - f64::from(n) / 69.0);
        ui.painter()
            .rect_filled(strip, 0.0, Color32::from_rgb(r, g, b));
    }
    ui.weak(words);
}

fn length(project: &Project, units: f64) -> String {
    match project.scale() {
        Some(scale) => format!("{:.3} m", units * scale.meters_per_unit),
        None => format!("{units:.3} units"),
    }
}

/// Shows the values of the clicked pixel.
pub(super) fn pixel(project: &Project, probe: Option<[u32; 2]>, found: &Dense, ui: &mut Ui) {
    let Some([u, v]) = probe else {
        ui.weak("Click a pixel: its match must lie on the same line of the other photograph.");
        return;
    };
    controls::row(ui, "pixel", format!("({u}, {v})"));
    match (found.disparity(u, v), found.depth(u, v)) {
        (Some(disparity), Some(depth)) => {
            controls::row(ui, "disparity", format!("{disparity:.2} px"));
            controls::row(ui, "depth", length(project, depth));
            // σ_Z = Z² σ_d / (f B), for half a pixel.
            let step = depth * depth * 0.5 / (found.focal_px() * found.baseline);
            controls::row(ui, "error for half a pixel", length(project, step));
        }
        (Some(disparity), None) => controls::row(
            ui,
            "disparity",
            format!("{disparity:.2} px: infinitely far"),
        ),
        _ => {
            drop(ui.weak("No answer here: hidden from the other camera, too smooth, or ambiguous."))
        }
    }
}
