//! The photographs: their metadata, their outcomes, and which of them take part.

use super::screen::{Action, Panel, Screen};
use super::widgets::{controls, look, verdict};
use crate::project::{InputPhoto, MAX_FRAMES, Outcome, PhotoId, Step};
use crate::session::Event;
use crate::tasks::FocalOrigin;
use egui::{DragValue, Frame, ScrollArea, Sense, Slider, Ui, vec2};
use epipole_canvas::theme::Role;

/// Width of a thumbnail if more than two fit in a row, points; then its minimum.
const SMALL: f32 = 176.0;
const SMALLEST: f32 = 96.0;
/// Height of a thumbnail's name, points.
const NAME: f32 = 24.0;

/// Panel of the step "Photographs".
#[derive(Default)]
pub(super) struct Photographs {
    /// Whether a typed focal length applies to one photograph only.
    is_for_one: bool,
}

impl Panel for Photographs {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            // Space for the frame around the selected thumbnail.
            Frame::new().inner_margin(4.0).show(ui, |ui| {
                // At least two in a row: phones have no room for two wide ones.
                let half = (ui.available_width() - ui.spacing().item_spacing.x) / 2.0;
                let width = half.floor().clamp(SMALLEST, SMALL);
                ui.horizontal_wrapped(|ui| {
                    for photo in &project.document().photos {
                        card(screen, ui, photo, width);
                    }
                });
            });
        });
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        verdict::show(screen, ui);
        if ui.button("Take photographs…").clicked() {
            screen.actions.push(Action::TakePhotographs);
        }
        if let Some(photo) = project.document().photo(project.view().photo) {
            one(screen, ui, photo, &mut self.is_for_one);
            ui.separator();
        }
        let held = project.orientation_words();
        if !held.is_empty() {
            ui.weak(held.trim());
            ui.separator();
        }
        let left_out = project.left_out();
        // The state of the selected photograph is shown above.
        let is_other = |(id, _): &&(PhotoId, Outcome)| *id != project.view().photo;
        if left_out.iter().any(|photo| is_other(&photo)) {
            ui.strong(format!("Left out: {}", left_out.len()));
            for (id, _) in left_out.iter().filter(is_other) {
                if let Some(photo) = project.document().photo(*id) {
                    let words = format!("{}: {}", photo.name, project.outcome_words(photo));
                    ui.colored_label(look::color(ui, Role::Outlier), words);
                }
            }
            ui.separator();
        }
        controls::edit(screen, |settings| {
            let size = Slider::new(&mut settings.max_megapixels, 0.1..=12.0).logarithmic(true);
            let change = controls::slider(ui, "Largest size, megapixels", size.max_decimals(1));
            let frames = Slider::new(&mut settings.num_frames, 2..=MAX_FRAMES);
            change.max(controls::slider(ui, "Frames from a video", frames))
        });
        ui.weak("You can add a video instead. The Lab cuts it into this many equal parts and takes the sharpest frame of each.");
        ui.weak("Nothing is uploaded. Your photographs stay on this machine.");
        controls::book(ui, Step::Photographs);
    }
}

fn card(screen: &mut Screen<'_>, ui: &mut Ui, photo: &InputPhoto, width: f32) {
    let project = screen.project;
    let selected = project.view().photo == photo.id;
    let (whole, response) =
        ui.allocate_exact_size(vec2(width, 0.75 * width + NAME), Sense::click());
    let (rect, below) = whole.split_top_bottom_at_y(whole.bottom() - NAME);
    let outcome = project.outcome(photo);
    let words = format!("{}: {}", photo.name, project.outcome_words(photo));
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, selected, &words));
    ui.painter()
        .rect_filled(rect, 3.0, look::color(ui, Role::Surface));
    let is_out = !matches!(outcome, Outcome::Registered(_) | Outcome::Pending);
    if let Some(pixels) = project.shown(photo) {
        let key = project.key_of_photograph(photo);
        let texture = screen.views.pictures.small(ui, key, pixels);
        let size = texture.size_vec2();
        let fit = (rect.width() / size.x).min(rect.height() / size.y);
        let place = egui::Rect::from_center_size(rect.center(), size * fit);
        let all = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
        let tint = match is_out {
            true => egui::Color32::from_gray(110),
            false => egui::Color32::WHITE,
        };
        ui.painter().image(texture.id(), place, all, tint);
    }
    if selected || response.has_focus() {
        let stroke = egui::Stroke::new(3.0, look::color(ui, Role::Grip));
        ui.painter()
            .rect_stroke(rect, 3.0, stroke, egui::StrokeKind::Outside);
    }
    let (name, role) = match is_out {
        true => (format!("left out: {}", photo.name), Role::Outlier),
        false => (photo.name.clone(), Role::Ink),
    };
    let font = egui::FontId::proportional(13.0);
    let mut job = egui::text::LayoutJob::simple_singleline(name, font, look::color(ui, role));
    job.wrap = egui::text::TextWrapping::truncate_at_width(width);
    let text = ui.painter().layout_job(job);
    let at = below.left_top() + vec2(0.0, 5.0);
    ui.painter().galley(at, text, look::color(ui, role));
    if response.clicked() {
        screen.send(Event::Look(photo.id));
    }
    response.on_hover_text(words);
}

/// * `is_for_one`: whether a typed focal length applies to this photograph only
fn one(screen: &mut Screen<'_>, ui: &mut Ui, photo: &InputPhoto, is_for_one: &mut bool) {
    let project = screen.project;
    ui.strong(&photo.name);
    ui.label(project.outcome_words(photo));
    if let (Some(pixels), Some(camera)) = (project.shown(photo), project.camera(photo)) {
        let (width, height) = pixels.full_size;
        let mut size = format!("{width} × {height}");
        if (pixels.width, pixels.height) != pixels.full_size {
            size.push_str(&format!(
                ", reduced to {} × {}",
                pixels.width, pixels.height
            ));
        }
        controls::row(ui, "size", size);
        let origin = match project.focal_origin(photo) {
            Some(FocalOrigin::Typed) => "you typed it",
            Some(FocalOrigin::Calibration) => {
                "from the opened camera, whose lens distortion was removed"
            }
            Some(FocalOrigin::File) => "from the file",
            _ => "a guess: 1.2 × the longer side",
        };
        let alike = project.alike(photo);
        let typed_for = match *is_for_one {
            true => vec![photo.id],
            false => alike.clone(),
        };
        let factor = f64::from(width) / f64::from(pixels.width.max(1));
        let mut focal_px = camera.k[0] * factor;
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("focal length, px");
            let field = DragValue::new(&mut focal_px)
                .range(1.0..=1e5)
                .max_decimals(1);
            let response = ui
                .add(field.update_while_editing(false))
                .labelled_by(label.id);
            if (response.changed() && !response.dragged()) || response.drag_stopped() {
                screen.send(Event::Focal(typed_for.clone(), Some(focal_px)));
            }
        });
        ui.weak(origin);
        let unused = project.unused_camera_words(photo);
        if !unused.is_empty() {
            ui.weak(unused);
        }
        if photo.focal_px.is_some() && ui.button("Reset focal length").clicked() {
            screen.send(Event::Focal(typed_for, None));
        }
        if alike.len() > 1 {
            let mut is_for_all = !*is_for_one;
            let words = format!("The same for all {} photographs of this size", alike.len());
            ui.checkbox(&mut is_for_all, words);
            *is_for_one = !is_for_all;
        }
    }
    ui.horizontal_wrapped(|ui| {
        let mut takes_part = !photo.excluded;
        if ui
            .checkbox(&mut takes_part, "Use this photograph")
            .changed()
        {
            screen.send(Event::Exclude(photo.id, !takes_part));
        }
        if ui.button("Move earlier").clicked() {
            screen.send(Event::Earlier(photo.id));
        }
        if ui.button("Remove").clicked() {
            screen.send(Event::Remove(photo.id));
        }
    });
}
