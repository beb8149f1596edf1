//! Table of all pairs, with matches and inliers.

use super::screen::{Panel, Screen};
use super::widgets::{controls, look};
use crate::project::{InputPhoto, Step};
use crate::session::Event;
use crate::tasks::{MatchesOf, Shows, TwoViewsOf};
use egui::{Align2, Color32, FontId, Rect, ScrollArea, Sense, Slider, Ui, pos2, vec2};
use epipole_canvas::theme::Role;

/// Panel of the step "Matches": the table of pairs.
pub(super) struct Matches;

impl Panel for Matches {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        let photos = project.taking_part();
        if photos.len() < 2 {
            return controls::instead(ui, &project.describe());
        }
        let room = ui.available_size() - vec2(130.0, 40.0);
        let side = (room.min_elem() / photos.len() as f32).clamp(34.0, 76.0);
        ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            let size = vec2(130.0, 34.0) + side * vec2(photos.len() as f32, photos.len() as f32);
            let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
            let corner = whole.min + vec2(122.0, 30.0);
            let ink = look::color(ui, Role::Ink);
            for (n, photo) in photos.iter().enumerate() {
                let at = pos2(corner.x - 6.0, corner.y + (n as f32 + 0.5) * side);
                let name = format!("{}   {}", shortened(&photo.name, 12), n + 1);
                ui.painter().text(
                    at,
                    Align2::RIGHT_CENTER,
                    name,
                    FontId::proportional(13.0),
                    ink,
                );
                let at = pos2(corner.x + (n as f32 + 0.5) * side, corner.y - 6.0);
                let number = (n + 1).to_string();
                ui.painter().text(
                    at,
                    Align2::CENTER_BOTTOM,
                    number,
                    FontId::proportional(13.0),
                    ink,
                );
            }
            for (row, first) in photos.iter().enumerate() {
                for (column, second) in photos.iter().enumerate().skip(row + 1) {
                    let min = corner + side * vec2(column as f32, row as f32);
                    let rect = Rect::from_min_size(min, vec2(side - 2.0, side - 2.0));
                    cell(screen, ui, rect, first, second);
                }
            }
        });
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        ui.label(project.describe());
        ui.weak(
        "Each number counts the matches that agree on one camera motion. Click a pair to open it.",
    );
        controls::edit(screen, |settings| {
            let ratio = Slider::new(&mut settings.matching.ratio, 0.3..=1.0);
            let change = controls::slider(ui, "Ratio test threshold", ratio);
            let mutual = ui.checkbox(&mut settings.matching.mutual, "Mutual nearest only");
            change.max(mutual.changed().into())
        });
        controls::book(ui, Step::Matches);
    }
}

fn cell(screen: &mut Screen<'_>, ui: &mut Ui, rect: Rect, first: &InputPhoto, second: &InputPhoto) {
    let project = screen.project;
    let response = ui.interact(
        rect,
        ui.scope_id().with((first.id, second.id)),
        Sense::click(),
    );
    let pair = project.get(TwoViewsOf(first.id, second.id));
    let total = project.get(MatchesOf(first.id, second.id)).map(|m| m.len());
    let words = match (pair, total) {
        (Some(pair), Some(total)) => format!(
            "{} and {}: {} of {total} matches agree. {}",
            first.name,
            second.name,
            pair.num_inliers,
            project.pair_words(first, pair)
        ),
        _ => format!("{} and {}: not computed yet", first.name, second.name),
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &words));
    let enough = project.document().settings.sfm.min_num_inliers;
    let (fill, mark) = match pair {
        None => (look::color(ui, Role::Grid), ""),
        Some(pair) if pair.num_inliers < enough || pair.shows == Shows::Nothing => {
            (look::color(ui, Role::Surface), "")
        }
        Some(pair) => {
            let share = (f64::from(pair.num_inliers) / 1000.0).min(1.0).sqrt();
            let [r, g, b] = look::theme(ui).scale(0.25 + 0.75 * share);
            let mark = match pair.shows {
                Shows::Turn => "turn",
                Shows::Plane => "plane",
                _ => "",
            };
            (Color32::from_rgb(r, g, b), mark)
        }
    };
    ui.painter().rect_filled(rect, 2.0, fill);
    let light = u32::from(fill.r()) * 3 + u32::from(fill.g()) * 6 + u32::from(fill.b()) > 1250;
    let ink = if light {
        Color32::BLACK
    } else {
        Color32::WHITE
    };
    if let Some(pair) = pair {
        let font = FontId::proportional(13.0);
        let text = pair.num_inliers.to_string();
        ui.painter().text(
            rect.center(),
            Align2::CENTER_CENTER,
            text,
            font.clone(),
            ink,
        );
        let under = rect.center_bottom() - vec2(0.0, 2.0);
        ui.painter().text(
            under,
            Align2::CENTER_BOTTOM,
            mark,
            FontId::proportional(11.0),
            ink,
        );
    }
    let current = project.view().pair == (first.id, second.id);
    if current || response.has_focus() || response.hovered() {
        let stroke = egui::Stroke::new(2.5, look::color(ui, Role::Grip));
        ui.painter()
            .rect_stroke(rect, 2.0, stroke, egui::StrokeKind::Inside);
    }
    if response.clicked() {
        screen.send(Event::LookAtPair(first.id, second.id));
        screen.send(Event::Show(Step::TwoViews));
    }
    response.on_hover_text(words);
}

/// Shortens a name to its end, which distinguishes photographs.
fn shortened(name: &str, most: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    match letters.len() > most {
        true => format!(
            "…{}",
            letters[letters.len() - most + 1..]
                .iter()
                .collect::<String>()
        ),
        false => name.to_owned(),
    }
}
