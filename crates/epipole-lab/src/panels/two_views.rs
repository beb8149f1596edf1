//! Matches of a pair, and the epipolar line of a clicked point.

use super::screen::{Panel, Screen};
use super::widgets::{controls, look, photo};
use crate::project::{InputPhoto, Step};
use crate::tasks::{FeaturesOf, MatchesOf, TwoViewsOf, ViewModel};
use egui::{Align, Layout, Rect, Slider, Ui, vec2};
use epipole_canvas::theme::{Role, Theme};

/// Maximum number of matches drawn.
const MAX_DRAWN: usize = 400;

/// Panel of the step "Two views".
#[derive(Default)]
pub(super) struct TwoViews {
    /// Clicked pixel of the first photograph.
    probe: Option<[f64; 2]>,
    /// Index of the clicked match.
    selected: Option<usize>,
}

impl Panel for TwoViews {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let (project, views) = (screen.project, &mut *screen.views);
        let (first, second) = project.view().pair;
        let document = project.document();
        let (Some(first), Some(second)) = (document.photo(first), document.photo(second)) else {
            return controls::instead(ui, "A pair needs two photographs.");
        };
        let (Some(one), Some(two)) = (project.shown(first), project.shown(second)) else {
            return controls::instead(ui, &project.describe());
        };
        let whole = ui.available_rect_before_wrap();
        let (left, right) = halves(whole);
        let [lens1, lens2] = &mut views.lenses;
        let full = views
            .pictures
            .full(ui, project.key_of_photograph(first), one);
        let shown1 = photo::show(ui, left, &full, lens1, &first.name);
        let full = views
            .pictures
            .full(ui, project.key_of_photograph(second), two);
        let shown2 = photo::show(ui, right, &full, lens2, &second.name);
        let (Some(places), Some(pair)) = (
            MatchesOf(first.id, second.id).places(project),
            project.get(TwoViewsOf(first.id, second.id)),
        ) else {
            return;
        };
        if let Some([u, v]) = shown1.clicked() {
            let away = |p: &[f64; 4]| libm::hypot(p[0] - u, p[1] - v);
            let near =
                (0..places.len()).min_by(|&a, &b| away(&places[a]).total_cmp(&away(&places[b])));
            let reach = f64::from(10.0 / shown1.scale());
            self.selected = near.filter(|&n| away(&places[n]) <= reach);
            self.probe = Some(match self.selected {
                Some(n) => [places[n][0], places[n][1]],
                None => [u, v],
            });
        }
        let (inlier, outlier) = (
            look::of(Theme::Dark, Role::Inlier),
            look::of(Theme::Dark, Role::Outlier),
        );
        let every = places.len().div_ceil(MAX_DRAWN).max(1);
        let mut shapes = Vec::new();
        for (place, is_inlier) in places.iter().zip(&pair.inliers).step_by(every) {
            let [u1, v1, u2, v2] = *place;
            for at in [shown1.at(u1, v1), shown2.at(u2, v2)] {
                if *is_inlier {
                    shapes.push(egui::Shape::circle_stroke(
                        at,
                        3.0,
                        egui::Stroke::new(1.2, inlier),
                    ));
                } else {
                    // A cross, so that color is not the only distinction.
                    for d in [vec2(3.0, 3.0), vec2(3.0, -3.0)] {
                        shapes.push(egui::Shape::line_segment(
                            [at - d, at + d],
                            egui::Stroke::new(1.2, outlier),
                        ));
                    }
                }
            }
        }
        let (of_first, of_second): (Vec<_>, Vec<_>) = shapes
            .into_iter()
            .partition(|shape| left.contains(shape.visual_bounding_rect().center()));
        shown1.add(of_first);
        shown2.add(of_second);
        let grip = look::of(Theme::Dark, Role::Grip);
        if let Some([u, v]) = self.probe {
            shown1.ring(shown1.at(u, v), 6.0, grip);
            if let Some(f) = pair.fundamental
                && let Some((from, to)) = epipolar_line(&f, [u, v], [two.width, two.height])
            {
                shown2.line(shown2.at(from[0], from[1]), shown2.at(to[0], to[1]), grip);
            } else if let ViewModel::Homography(h) = pair.model
                && let Some([u2, v2]) = mapped(&h, [u, v])
            {
                shown2.ring(shown2.at(u2, v2), 9.0, grip);
            }
        }
        if let Some(place) = self.selected.and_then(|n| places.get(n)) {
            shown2.ring(shown2.at(place[2], place[3]), 5.0, grip);
        }
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        let project = screen.project;
        let (a, b) = project.view().pair;
        if controls::choose_pair(screen, ui) {
            self.probe = None;
            self.selected = None;
        }
        ui.label(project.describe());
        let document = project.document();
        if let (Some(first), Some(second)) = (document.photo(a), document.photo(b))
            && let (Some(pair), Some(matches)) = (
                project.get(TwoViewsOf(first.id, second.id)),
                project.get(MatchesOf(first.id, second.id)),
            )
        {
            let (name, values) = match &pair.model {
                ViewModel::Essential(e) => ("E", e),
                ViewModel::Fundamental(f) => ("F", f),
                ViewModel::Homography(h) => ("H", h),
            };
            controls::row(
                ui,
                "inliers",
                format!("{} of {}", pair.num_inliers, matches.len()),
            );
            controls::row(ui, "RANSAC samples", pair.iterations.to_string());
            if let Some(turn) = pair.turn_deg {
                controls::row(ui, "camera rotation", format!("{turn:.1}°"));
            }
            ui.weak(format!("{name}, scaled to norm 1"));
            egui::Grid::new("matrix").show(ui, |ui| {
                for row in values.chunks(3) {
                    for value in row {
                        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                            ui.label(scientific(*value));
                        });
                    }
                    ui.end_row();
                }
            });
            if let Some(m) = self.selected.and_then(|n| matches.get(n).map(|m| (n, m))) {
                let fits = match pair.inliers.get(m.0) {
                    Some(true) => "an inlier",
                    _ => "an outlier",
                };
                controls::row(ui, "match", format!("ratio {:.2}, {fits}", m.1.ratio));
                patches(screen, ui, [first, second], [m.1.first, m.1.second]);
            }
        }
        ui.weak("Click in the first photograph: the same point must lie on the line in the second. Circles are inliers, crosses are outliers.");
        controls::edit(screen, |settings| {
            let error = Slider::new(&mut settings.pairs.max_error_px, 0.1..=10.0).logarithmic(true);
            let change = controls::slider(ui, "Inlier threshold ε, px", error.max_decimals(2));
            let seed = Slider::new(&mut settings.pairs.seed, 0..=20);
            change.max(controls::slider(ui, "Seed", seed))
        });
        controls::book(ui, Step::TwoViews);
    }
}

fn halves(whole: Rect) -> (Rect, Rect) {
    let gap = 4.0;
    match whole.width() > whole.height() {
        true => whole.split_left_right_at_fraction(0.5),
        false => whole.split_top_bottom_at_fraction(0.5),
    }
    .map_each(|rect| rect.shrink(gap / 2.0))
}

/// Pairs whose values are both known.
trait Both {
    fn map_each(self, f: impl Fn(Rect) -> Rect) -> Self;
}

impl Both for (Rect, Rect) {
    fn map_each(self, f: impl Fn(Rect) -> Rect) -> Self {
        (f(self.0), f(self.1))
    }
}

/// Returns the end points of a pixel's epipolar line in the other photograph.
fn epipolar_line(f: &[f64; 9], [u, v]: [f64; 2], size: [u32; 2]) -> Option<([f64; 2], [f64; 2])> {
    let line = [0, 3, 6].map(|row| f[row] * u + f[row + 1] * v + f[row + 2]);
    let [a, b, c] = line;
    let (right, bottom) = (f64::from(size[0]) - 0.5, f64::from(size[1]) - 0.5);
    let mut ends = Vec::new();
    for x in [-0.5, right] {
        ends.push([x, -(a * x + c) / b]);
    }
    for y in [-0.5, bottom] {
        ends.push([-(b * y + c) / a, y]);
    }
    let hair = 1e-6;
    ends.retain(|[x, y]| {
        (-0.5 - hair..=right + hair).contains(x) && (-0.5 - hair..=bottom + hair).contains(y)
    });
    let first = *ends.first()?;
    let far = |end: &[f64; 2]| libm::hypot(end[0] - first[0], end[1] - first[1]);
    let last = ends
        .iter()
        .copied()
        .max_by(|p, q| far(p).total_cmp(&far(q)))?;
    (far(&last) > 0.0).then_some((first, last))
}

fn mapped(h: &[f64; 9], [u, v]: [f64; 2]) -> Option<[f64; 2]> {
    let [x, y, w] = [0, 3, 6].map(|row| h[row] * u + h[row + 1] * v + h[row + 2]);
    let place = [x / w, y / w];
    place.iter().all(|x| x.is_finite()).then_some(place)
}

/// Formats a number with sign and power of ten, for aligned rows.
fn scientific(value: f64) -> String {
    format!("{value:.3e}").replace('-', "−")
}

/// Side of a patch, points.
const SIDE: f32 = 136.0;

/// Draws the descriptor windows of both features, each in the orientation of its photograph.
fn patches(screen: &mut Screen<'_>, ui: &mut Ui, photos: [&InputPhoto; 2], features: [u32; 2]) {
    let project = screen.project;
    ui.horizontal(|ui| {
        for (photo, index) in photos.into_iter().zip(features) {
            let (Some(pixels), Some(found)) =
                (project.shown(photo), project.get(FeaturesOf(photo.id)))
            else {
                continue;
            };
            let Some(feature) = found.list.get(index as usize) else {
                continue;
            };
            let key = project.key_of_photograph(photo);
            let full = screen.views.pictures.full(ui, key, pixels);
            let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), egui::Sense::hover());
            let words = format!("Patch of the match in {}", photo.name);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &words));
            // 4 × 4 cells, each three times the scale wide.
            let half = (6.0 * feature.scale_px).max(4.0);
            let size = full.size();
            let middle = (vec2(feature.u as f32, feature.v as f32) + vec2(0.5, 0.5)) / size;
            let painter = ui.painter_at(rect);
            painter.rect_filled(rect, 0.0, look::color(ui, Role::Surface));
            let whole = size * SIDE / (2.0 * half);
            full.paint(
                &painter,
                Rect::from_min_size(rect.center() - middle * whole, whole),
            );
            let grip = egui::Stroke::new(1.6, look::of(Theme::Dark, Role::Grip));
            let radius = SIDE / 2.0 * feature.scale_px / half;
            painter.circle_stroke(rect.center(), radius, grip);
            let end = rect.center() + 0.45 * SIDE * egui::Vec2::angled(feature.angle_rad);
            painter.line_segment([rect.center(), end], grip);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_at_the_edges_of_the_photograph() {
        // v2 = v1: a sideways translation.
        let f = [0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0];
        let (from, to) = epipolar_line(&f, [10.0, 7.0], [100, 50]).expect("it is in the picture");
        assert_eq!((from, to), ([-0.5, 7.0], [99.5, 7.0]));
        assert_eq!(epipolar_line(&f, [10.0, 70.0], [100, 50]), None);
        assert_eq!(epipolar_line(&[0.0; 9], [1.0, 1.0], [100, 50]), None);
    }
}
