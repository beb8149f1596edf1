//! The features of a photograph: circles of their size with a stroke in their direction.

use super::app::Memory;
use super::knobs::{self, Turned};
use super::{look, photo};
use crate::project::{Event, Project, Step};
use crate::tasks::{Feature, FeatureKind};
use egui::{Shape, Slider, Stroke, Ui};
use epipole_canvas::theme::Role;

/// Maximum number of features drawn, the strongest.
const MAX_DRAWN: usize = 1500;

/// The photograph with its features.
pub(super) fn picture(project: &Project, memory: &mut Memory, ui: &mut Ui) {
    let Some(given) = project.document().photo(project.view().photo) else {
        return;
    };
    let Some(pixels) = project.shown(given) else {
        return knobs::instead(ui, &project.describe());
    };
    let rect = ui.available_rect_before_wrap();
    let full = memory
        .pictures
        .full(ui, project.key_of_photograph(given), pixels);
    let shown = photo::show(ui, rect, &full, &mut memory.lenses[0], &given.name);
    let Some(found) = project.features(given) else {
        return;
    };
    if let Some([u, v]) = shown.clicked() {
        memory.feature = nearest(&found.list, u, v, f64::from(14.0 / shown.scale()));
    }
    let stroke = Stroke::new(
        1.0,
        look::of(epipole_canvas::theme::Theme::Dark, Role::Inlier),
    );
    let mut shapes = Vec::new();
    for feature in found.list.iter().take(MAX_DRAWN) {
        let center = shown.at(feature.u, feature.v);
        if shown.shows(center) {
            let radius = (2.0 * feature.scale_px * shown.scale()).max(2.0);
            let end = center + radius * egui::Vec2::angled(feature.angle_rad);
            shapes.push(Shape::circle_stroke(center, radius, stroke));
            shapes.push(Shape::line_segment([center, end], stroke));
        }
    }
    shown.add(shapes);
    if let Some(feature) = memory.feature.and_then(|index| found.list.get(index)) {
        let radius = (2.0 * feature.scale_px * shown.scale()).max(6.0);
        let color = look::of(epipole_canvas::theme::Theme::Dark, Role::Grip);
        shown.ring(shown.at(feature.u, feature.v), radius, color);
    }
}

/// The feature nearest to a pixel, within `reach` pixels.
pub(super) fn nearest(list: &[Feature], u: f64, v: f64, reach: f64) -> Option<usize> {
    let away = |f: &Feature| (f.u - u) * (f.u - u) + (f.v - v) * (f.v - v);
    let all = list.iter().enumerate().map(|(index, f)| (away(f), index));
    let best = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 <= reach * reach).then_some(best.1)
}

/// Draws the feature settings, and details of the selected feature.
pub(super) fn knobs(project: &Project, memory: &mut Memory, ui: &mut Ui, events: &mut Vec<Event>) {
    let current = project.view().photo;
    if let Some(id) = knobs::choose(project, ui, "Photograph", current, None) {
        events.push(Event::Look(id));
        memory.feature = None;
    }
    let given = project.document().photo(current);
    let found = given.and_then(|given| project.features(given)).cloned();
    if let Some(found) = &found {
        let shown = match found.list.len() > MAX_DRAWN {
            true => format!("{}; the {MAX_DRAWN} strongest are drawn", found.list.len()),
            false => found.list.len().to_string(),
        };
        knobs::row(ui, "features", shown);
    }
    knobs::edit(project, memory, events, |settings| {
        let options = &mut settings.features;
        let mut turned = Turned::No;
        ui.horizontal(|ui| {
            for (kind, name) in [
                (FeatureKind::RootSift, "RootSIFT"),
                (FeatureKind::Sift, "SIFT"),
            ] {
                turned = turned.max(
                    ui.radio_value(&mut options.kind, kind, name)
                        .changed()
                        .into(),
                );
            }
        });
        let number = Slider::new(&mut options.max_features, 100..=20_000).logarithmic(true);
        turned = turned.max(knobs::slider(ui, "Most features", number));
        let contrast = Slider::new(&mut options.contrast, 0.001..=0.2).logarithmic(true);
        turned.max(knobs::slider(ui, "Contrast threshold", contrast))
    });
    match found.as_ref().zip(memory.feature) {
        Some((found, index)) if index < found.list.len() => {
            let feature = &found.list[index];
            ui.separator();
            knobs::row(
                ui,
                "position",
                format!("({:.1}, {:.1}) px", feature.u, feature.v),
            );
            knobs::row(ui, "scale", format!("{:.2} px", feature.scale_px));
            let degrees = f64::from(feature.angle_rad).to_degrees();
            knobs::row(ui, "direction", format!("{degrees:.0}°"));
            let dimension = found.described.dimension as usize;
            let values = found
                .described
                .values
                .get(index * dimension..(index + 1) * dimension);
            descriptor(ui, values.unwrap_or_default());
        }
        _ => {
            ui.weak("Click a feature to see its scale, direction and descriptor.");
        }
    }
    knobs::book(ui, Step::Features);
}

/// A descriptor as bars.
fn descriptor(ui: &mut Ui, values: &[u8]) {
    let size = egui::vec2(ui.available_width().min(280.0), 64.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    response.widget_info(|| {
        let words = format!("Descriptor of {} numbers", values.len());
        egui::WidgetInfo::labeled(egui::Role::Image, true, words)
    });
    let most = f32::from(values.iter().copied().max().unwrap_or(1).max(1));
    let width = rect.width() / values.len().max(1) as f32;
    let color = look::color(ui, Role::Series(0));
    for (n, value) in values.iter().enumerate() {
        let left = rect.left() + n as f32 * width;
        let top = rect.bottom() - rect.height() * f32::from(*value) / most;
        let bar = egui::Rect::from_min_max(
            egui::pos2(left, top),
            egui::pos2(left + 0.8 * width, rect.bottom()),
        );
        ui.painter().rect_filled(bar, 0.0, color);
    }
}
