//! Controls and readouts of the depth of all views.

use super::screen::Screen;
use super::widgets::{controls, look};
use super::{edit, view};
use crate::project::{ALL_VIEWS_MEGAPIXELS, Step};
use crate::session::{Event, count};
use crate::tasks::{AllViews, DenseCloud};
use egui::{Button, Slider, Ui};
use epipole_canvas::theme::Role;

/// Draws the button, or the results.
pub(super) fn controls(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let is_asked = project.document().all_views;
    match project.failure(AllViews).filter(|_| is_asked) {
        Some(_) => {
            ui.colored_label(look::color(ui, Role::Outlier), project.all_views_words());
        }
        None => drop(ui.label(project.all_views_words())),
    }
    if let Some((_, cloud)) = project.all_views() {
        numbers(cloud, ui);
        ui.horizontal_wrapped(|ui| {
            ui.weak("Show as");
            let surface = &mut screen.views.cloud.surface;
            ui.radio_value(surface, false, "points");
            let has_surface = cloud.triangles().len() > 0;
            ui.add_enabled_ui(has_surface, |ui| ui.radio_value(surface, true, "surface"));
        });
        view::controls(screen, ui);
        ui.separator();
        edit::controls(screen, ui);
        ui.separator();
    }
    match is_asked {
        false => {
            let is_known = project.component().is_some();
            let button = Button::new("Depth of all views");
            if ui.add_enabled(is_known, button).clicked() {
                screen.send(Event::AllViews(true));
            }
        }
        true => {
            if ui.button("Remove from cloud").clicked() {
                screen.send(Event::AllViews(false));
            }
        }
    }
    ui.separator();
    controls::edit(screen, |settings| {
        let [least, most] = ALL_VIEWS_MEGAPIXELS;
        let megapixels = &mut settings.all_views.max_megapixels;
        let slider = Slider::new(megapixels, least..=most).logarithmic(true);
        controls::slider(ui, "Resolution, megapixels", slider.max_decimals(2))
    });
    if let Some(limited) = project.all_views_limit() {
        ui.weak(format!(
            "At most {limited:.2} megapixels, as so many photographs must fit into memory."
        ));
    }
    controls::book(ui, Step::Depth);
}

fn numbers(cloud: &DenseCloud, ui: &mut Ui) {
    let (width, height) = cloud.size;
    let coverage = format!("{:.0}% of pixels", 100.0 * cloud.density);
    controls::row(ui, "coverage", coverage);
    let maps = format!("{} of {}", cloud.num_maps, cloud.num_registered);
    controls::row(ui, "depth maps", maps);
    controls::row(ui, "size", format!("{width} × {height} px"));
    let triangles = count(cloud.triangles().len(), "triangle");
    controls::row(ui, "surface", triangles);
}
