//! Features of a photograph: circles with the radius of their scale and a stroke in their
//! direction.

use super::screen::{Panel, Screen};
use super::widgets::controls::{self, Change};
use super::widgets::{look, photo};
use crate::project::{FeatureKind, Step};
use crate::session::Event;
use crate::tasks::{Feature, FeaturesOf};
use egui::{Shape, Slider, Stroke, Ui};
use epipole_canvas::theme::Role;

/// Maximum number of features drawn, the strongest.
const MAX_DRAWN: usize = 1500;

/// Panel of the step "Features".
#[derive(Default)]
pub(super) struct Features {
    /// Index of the selected feature.
    selected: Option<usize>,
}

impl Panel for Features {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let (project, views) = (screen.project, &mut *screen.views);
        let Some(given) = project.document().photo(project.view().photo) else {
            return;
        };
        let Some(pixels) = project.shown(given) else {
            return controls::instead(ui, &project.describe());
        };
        let rect = ui.available_rect_before_wrap();
        let full = views
            .pictures
            .full(ui, project.key_of_photograph(given), pixels);
        let shown = photo::show(ui, rect, &full, &mut views.lenses[0], &given.name);
        let Some(found) = project.get(FeaturesOf(given.id)) else {
            return;
        };
        if let Some([u, v]) = shown.clicked() {
            self.selected = nearest(&found.list, u, v, f64::from(14.0 / shown.scale()));
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
        if let Some(feature) = self.selected.and_then(|index| found.list.get(index)) {
            let radius = (2.0 * feature.scale_px * shown.scale()).max(6.0);
            let color = look::of(epipole_canvas::theme::Theme::Dark, Role::Grip);
            shown.ring(shown.at(feature.u, feature.v), radius, color);
        }
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        let current = project.view().photo;
        if let Some(id) = controls::choose_photograph(project, ui, "Photograph", current, None) {
            screen.send(Event::Look(id));
            self.selected = None;
        }
        let given = project.document().photo(current);
        let found = given.and_then(|given| project.get(FeaturesOf(given.id)));
        if let Some(found) = found {
            let shown = match found.list.len() > MAX_DRAWN {
                true => format!("{}; the {MAX_DRAWN} strongest are drawn", found.list.len()),
                false => found.list.len().to_string(),
            };
            controls::row(ui, "features", shown);
        }
        controls::edit(screen, |settings| {
            let options = &mut settings.features;
            let mut change = Change::No;
            ui.horizontal(|ui| {
                for (kind, name) in [
                    (FeatureKind::RootSift, "RootSIFT"),
                    (FeatureKind::Sift, "SIFT"),
                ] {
                    change = change.max(
                        ui.radio_value(&mut options.kind, kind, name)
                            .changed()
                            .into(),
                    );
                }
            });
            let number = Slider::new(&mut options.max_features, 100..=20_000).logarithmic(true);
            change = change.max(controls::slider(ui, "Most features", number));
            let contrast = Slider::new(&mut options.contrast, 0.001..=0.2).logarithmic(true);
            change.max(controls::slider(ui, "Contrast threshold", contrast))
        });
        match found.zip(self.selected) {
            Some((found, index)) if index < found.list.len() => {
                let feature = &found.list[index];
                ui.separator();
                controls::row(
                    ui,
                    "position",
                    format!("({:.1}, {:.1}) px", feature.u, feature.v),
                );
                controls::row(ui, "scale", format!("{:.2} px", feature.scale_px));
                let degrees = f64::from(feature.angle_rad).to_degrees();
                controls::row(ui, "direction", format!("{degrees:.0}°"));
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
        controls::book(ui, Step::Features);
    }
}

/// Finds the feature nearest to a pixel, within `reach` pixels.
fn nearest(list: &[Feature], u: f64, v: f64, reach: f64) -> Option<usize> {
    let away = |f: &Feature| (f.u - u) * (f.u - u) + (f.v - v) * (f.v - v);
    let all = list.iter().enumerate().map(|(index, f)| (away(f), index));
    let best = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 <= reach * reach).then_some(best.1)
}

/// Draws a descriptor as bars.
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
