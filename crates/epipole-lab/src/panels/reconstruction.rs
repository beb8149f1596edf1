//! Cameras and points, why photographs were left out, and how the cost fell.

use super::screen::{Action, Panel, Screen};
use super::widgets::cloud::CloudView;
use super::widgets::controls::{self, Change};
use super::widgets::scene_inputs::Coloring;
use super::widgets::{look, observations, verdict};
use super::{edit, view};
use crate::project::{Project, RefineFocal, Step};
use crate::session::Event;
use crate::tasks::ReconstructionOfAll;
use egui::{Slider, Ui};
use epipole_canvas::theme::Role;

/// Panel of the step "Reconstruction".
pub(super) struct Reconstruction;

impl Panel for Reconstruction {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        space(screen, ui);
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        verdict::show(screen, ui);
        numbers(screen, ui);
        // Without a component, a message in place of the image gives the reason.
        if project.component().is_some() {
            for (id, _) in &project.left_out() {
                if let Some(photo) = project.document().photo(*id) {
                    let words = format!("{}: {}", photo.name, project.outcome_words(photo));
                    ui.colored_label(look::color(ui, Role::Outlier), words);
                }
            }
            ui.separator();
            colors(project, &mut screen.views.cloud, ui);
            view::controls(screen, ui);
            ui.separator();
            edit::controls(screen, ui);
            ui.separator();
        }
        cameras(screen, ui);
        let is_posed = project.document().poses.is_some();
        controls::edit(screen, |settings| {
            let mut change = Change::No;
            if is_posed {
                return change;
            }
            ui.weak("Refine focal lengths");
            ui.horizontal_wrapped(|ui| {
                for (when, name) in [
                    (RefineFocal::WhenGuessed, "if guessed"),
                    (RefineFocal::Always, "always"),
                    (RefineFocal::Never, "never"),
                ] {
                    let radio = ui.radio_value(&mut settings.refine_focal, when, name);
                    change = change.max(radio.changed().into());
                }
            });
            let distortion = ui.checkbox(
                &mut settings.sfm.refine_distortion,
                "Refine radial distortion",
            );
            change = change.max(distortion.changed().into());
            let enough = Slider::new(&mut settings.sfm.min_num_inliers, 6..=200);
            change = change.max(controls::slider(ui, "Fewest inliers", enough));
            let seed = Slider::new(&mut settings.sfm.seed, 0..=20);
            change.max(controls::slider(ui, "Seed", seed))
        });
        controls::book(ui, Step::Reconstruction);
    }
}

/// Shows the source of the cameras: estimated, or from a model of another program.
fn cameras(screen: &mut Screen<'_>, ui: &mut Ui) {
    let words = screen.project.poses_words();
    if words.is_empty() {
        if ui.button("Open known cameras…").clicked() {
            screen.actions.push(Action::OpenCameras);
        }
        ui.weak("Models of COLMAP, nerfstudio or openMVG: then only points are found.");
        return;
    }
    ui.label(words);
    if ui.button("Find the cameras instead").clicked() {
        screen.send(Event::UsePoses(None));
    }
}

/// Draws the point cloud, or the reason why there is none.
pub(super) fn space(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    if project.component().or(project.growing()).is_none() {
        return controls::instead(ui, &why_none(project));
    }
    let rect = ui.available_rect_before_wrap();
    screen.views.cloud.show(project, ui, rect);
}

/// Returns the reason for an empty view, with one line for each photograph left out.
fn why_none(project: &Project) -> String {
    let mut words = project.describe();
    for (id, _) in project.left_out() {
        if let Some(photo) = project.document().photo(id) {
            let line = format!("{}: {}", photo.name, project.outcome_words(photo));
            words = words.replace(&format!(" {line}"), &format!("\n{line}"));
        }
    }
    words
}

/// Draws the selected point, and the choice of colors.
fn colors(project: &Project, cloud: &mut CloudView, ui: &mut Ui) {
    point(project, cloud.point, ui);
    ui.horizontal_wrapped(|ui| {
        ui.weak("Color by");
        for (coloring, name) in [
            (Coloring::Photographs, "image"),
            (Coloring::Error, "error"),
            (Coloring::Track, "track length"),
        ] {
            ui.radio_value(&mut cloud.coloring, coloring, name);
        }
    });
    match cloud.coloring {
        Coloring::Photographs => {}
        Coloring::Error => drop(ui.weak("dark: 0 px, yellow: 2 px or more")),
        Coloring::Track => drop(ui.weak("dark: two photographs, yellow: eight or more")),
    }
}

fn numbers(screen: &mut Screen<'_>, ui: &mut Ui) {
    let project = screen.project;
    let Some(found) = project.get(ReconstructionOfAll) else {
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
                    screen.send(Event::LookAtComponent(n));
                }
            }
        });
    }
    let Some(component) = found.components.get(current) else {
        return;
    };
    let photos = project.document().photos.len();
    controls::row(
        ui,
        "photographs",
        format!("{} of {photos}", component.num_registered()),
    );
    controls::row(ui, "points", component.points.len().to_string());
    if let Some(mean_px) = found.mean_error_px.get(current) {
        controls::row(ui, "mean reprojection error", format!("{mean_px:.3} px"));
    }
    if let Some(words) = project.change_words() {
        ui.weak(words);
    }
    let is_corrected = project.before_correction_px().is_some();
    if (project.sfm_options().refine_focal || is_corrected)
        && let Some(camera) = component.cameras.iter().flatten().next()
    {
        let name = match project.knows_focal() {
            true => "focal length, refined",
            false => "focal length, not determined",
        };
        controls::row(ui, name, format!("{:.1} px", camera.intrinsics[0]));
    }
    if let Some(before_px) = project.before_correction_px() {
        controls::row(
            ui,
            "before the lens was corrected",
            format!("{before_px:.3} px"),
        );
    }
    if project.sfm_options().refine_distortion || is_corrected {
        let terms = component.lens.coefficients();
        let words = format!("{:.4}, {:.4}", terms[0], terms[1]);
        controls::row(ui, "radial distortion", words);
    }
    costs(ui, &found.costs);
}

/// Plots the cost after each adjustment: it grows with each photograph, and falls as outliers
/// leave.
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

/// Shows the selected point.
fn point(project: &Project, point: Option<usize>, ui: &mut Ui) {
    let Some(index) = point else {
        ui.weak(
            "Drag to orbit, with Shift or two fingers to pan. Scroll or pinch to zoom. Click a point to see which photographs \
             see it.",
        );
        return;
    };
    let all = observations(project, index);
    ui.strong(format!(
        "Point {}, seen in {} photographs",
        index + 1,
        all.len()
    ));
    for (name, [u, v], error_px) in all {
        ui.label(format!(
            "{name}: ({u:.1}, {v:.1}) px, error {error_px:.2} px"
        ));
    }
}
