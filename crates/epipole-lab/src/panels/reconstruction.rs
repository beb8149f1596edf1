//! Cameras and points, why photographs were left out, and how the cost fell.

use super::app::Memory;
use super::cloud::Coloring;
use super::knobs::{self, Turned};
use super::look;
use super::marks::sights;
use crate::project::{Event, Project, RefineFocal, Step};
use egui::{Slider, Ui};
use epipole_canvas::theme::Role;

/// The space.
pub(super) fn picture(project: &Project, memory: &mut Memory, ui: &mut Ui) {
    if project.component().or(project.growing()).is_none() {
        return knobs::instead(ui, &why_none(project));
    }
    let rect = ui.available_rect_before_wrap();
    memory.cloud.show(project, ui, rect);
}

/// Reason for an empty view, with one line for each photograph left out.
fn why_none(project: &Project) -> String {
    let mut words = project.describe();
    for (id, _) in project.left_out() {
        if let Some(photo) = project.document().photo(id) {
            let told = format!("{}: {}", photo.name, project.fate_words(photo));
            words = words.replace(&format!(" {told}"), &format!("\n{told}"));
        }
    }
    words
}

/// Numbers, reasons, knobs.
pub(super) fn knobs(project: &Project, memory: &mut Memory, ui: &mut Ui, events: &mut Vec<Event>) {
    numbers(project, ui, events);
    // Without any, a message in place of the image gives the reason.
    if project.component().is_some() {
        for (id, _) in &project.left_out() {
            if let Some(photo) = project.document().photo(*id) {
                let words = format!("{}: {}", photo.name, project.fate_words(photo));
                ui.colored_label(look::color(ui, Role::Outlier), words);
            }
        }
        ui.separator();
        view(project, memory, ui);
        ui.separator();
    }
    knobs::edit(project, memory, events, |settings| {
        let mut turned = Turned::No;
        ui.weak("Refine focal lengths");
        ui.horizontal_wrapped(|ui| {
            for (when, name) in [
                (RefineFocal::WhenGuessed, "if guessed"),
                (RefineFocal::Always, "always"),
                (RefineFocal::Never, "never"),
            ] {
                let radio = ui.radio_value(&mut settings.refine_focal, when, name);
                turned = turned.max(radio.changed().into());
            }
        });
        let distortion = ui.checkbox(
            &mut settings.sfm.refine_distortion,
            "Refine radial distortion",
        );
        turned = turned.max(distortion.changed().into());
        let enough = Slider::new(&mut settings.sfm.min_num_inliers, 6..=200);
        turned = turned.max(knobs::slider(ui, "Fewest inliers", enough));
        let seed = Slider::new(&mut settings.sfm.seed, 0..=20);
        turned.max(knobs::slider(ui, "Seed", seed))
    });
    knobs::book(ui, Step::Reconstruction);
}

/// Draws the view options of the point cloud.
fn view(project: &Project, memory: &mut Memory, ui: &mut Ui) {
    point(project, memory, ui);
    ui.horizontal_wrapped(|ui| {
        ui.weak("Color by");
        for (coloring, name) in [
            (Coloring::Photographs, "image"),
            (Coloring::Error, "error"),
            (Coloring::Track, "track length"),
        ] {
            ui.radio_value(&mut memory.cloud.coloring, coloring, name);
        }
    });
    ui.checkbox(&mut memory.cloud.photographs, "Show photographs");
    match memory.cloud.coloring {
        Coloring::Photographs => {}
        Coloring::Error => drop(ui.weak("dark: 0 px, yellow: 2 px or more")),
        Coloring::Track => drop(ui.weak("dark: two photographs, yellow: eight or more")),
    }
    if ui.button("Reset view").clicked() {
        memory.cloud.look_at_all();
    }
}

fn numbers(project: &Project, ui: &mut Ui, events: &mut Vec<Event>) {
    let Some(found) = project.reconstruction() else {
        // The view grows meanwhile, without a progress bar.
        if project.growing().is_some() {
            ui.label(project.describe());
        }
        return;
    };
    let current = project.view().component;
    if found.components.len() > 1 {
        ui.horizontal_wrapped(|ui| {
            for n in 0..found.components.len() {
                let label = format!("Part {}", n + 1);
                if ui.selectable_label(n == current, label).clicked() {
                    events.push(Event::LookAtComponent(n));
                }
            }
        });
    }
    let Some(component) = found.components.get(current) else {
        return;
    };
    let photos = project.document().photos.len();
    knobs::row(
        ui,
        "photographs",
        format!("{} of {photos}", component.num_registered()),
    );
    knobs::row(ui, "points", component.points.len().to_string());
    if let Some(mean_px) = found.mean_error_px.get(current) {
        knobs::row(ui, "mean reprojection error", format!("{mean_px:.3} px"));
    }
    if project.sfm_options().refine_focal
        && let Some(camera) = component.cameras.iter().flatten().next()
    {
        knobs::row(
            ui,
            "focal length, refined",
            format!("{:.1} px", camera.intrinsics[0]),
        );
    }
    if project.sfm_options().refine_distortion {
        let terms = component.lens.coefficients();
        let words = format!("{:.4}, {:.4}", terms[0], terms[1]);
        knobs::row(ui, "radial distortion", words);
    }
    costs(ui, &found.costs);
}

/// The cost after each adjustment: it grows with each photograph, and falls as outliers leave.
fn costs(ui: &mut Ui, costs: &[f64]) {
    let most = costs.iter().copied().fold(0.0, f64::max);
    if costs.len() < 2 || most <= 0.0 {
        return;
    }
    ui.weak("Cost after each bundle adjustment, px²");
    let (rect, response) = ui.allocate_exact_size(egui::vec2(280.0, 56.0), egui::Sense::hover());
    let last = costs.last().copied().unwrap_or(0.0);
    response.widget_info(|| {
        let words = format!(
            "Cost after each of {} bundle adjustments, {last:.0} at the end",
            costs.len()
        );
        egui::WidgetInfo::labeled(egui::Role::Image, true, words)
    });
    let at = |(n, cost): (usize, &f64)| {
        let right = n as f32 / (costs.len() - 1) as f32;
        rect.left_bottom() + egui::vec2(right * rect.width(), -(cost / most) as f32 * rect.height())
    };
    let stroke = egui::Stroke::new(1.6, look::color(ui, Role::Series(0)));
    let points: Vec<egui::Pos2> = costs.iter().enumerate().map(at).collect();
    ui.painter().add(egui::Shape::line(points, stroke));
    ui.weak(format!(
        "first {:.0}, highest {most:.0}, last {last:.0}",
        costs[0]
    ));
}

/// The point that was clicked.
fn point(project: &Project, memory: &Memory, ui: &mut Ui) {
    let Some(index) = memory.cloud.point else {
        ui.weak(
            "Drag to orbit, with Shift or two fingers to pan. Scroll or pinch to zoom. Click a point to see which photographs \
             see it.",
        );
        return;
    };
    let sights = sights(project, index);
    ui.strong(format!(
        "Point {}, seen in {} photographs",
        index + 1,
        sights.len()
    ));
    for (name, [u, v], error_px) in sights {
        ui.label(format!(
            "{name}: ({u:.1}, {v:.1}) px, error {error_px:.2} px"
        ));
    }
}
