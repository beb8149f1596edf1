//! Depth of every pixel: of one pair, rectified, under a ruler; or of all views, as one cloud.

use super::all_views;
use super::depth_controls::{disparities, legend, pixel};
use super::reconstruction::space;
use super::screen::{Panel, Screen};
use super::widgets::controls::{self, Change};
use super::widgets::strips::Strips;
use super::widgets::{look, photo};
use crate::project::{DepthMethod, Key, Step};
use crate::session::Event;
use crate::tasks::{Dense, DepthOf, Query};
use egui::{Color32, ColorImage, Rect, Slider, Ui};
use epipole_canvas::theme::{Role, Theme};
use std::ops::Range;

/// Panel of the step "Depth".
#[derive(Default)]
pub(super) struct Depth {
    /// Whether all views are shown instead of a pair.
    all_views: bool,
    lens: photo::Lens,
    /// Row of the ruler; column for a vertical pair.
    row: u32,
    /// Clicked pixel of the first image.
    probe: Option<[u32; 2]>,
    made: Option<(Key, Theme)>,
    pictures: Vec<Strips>,
    range: Option<[f64; 2]>,
}

impl Depth {
    fn make(&mut self, ui: &Ui, key: Key, pair: &Dense) {
        let theme = look::theme(ui);
        let size = [pair.width as usize, pair.height as usize];
        if self.made != Some((key, theme)) {
            if self.made.is_none_or(|(before, _)| before != key) {
                self.row = if pair.is_vertical {
                    pair.width / 2
                } else {
                    pair.height / 2
                };
                self.probe = None;
                self.range = pair.depth_range();
            }
            self.made = Some((key, theme));
            self.pictures = vec![Strips::new(size, None); 3];
        }
        let range = self.range;
        for (n, picture) in self.pictures.iter_mut().enumerate() {
            match n {
                0 => picture.bring(ui, "rectified first", |rows| {
                    unbordered(size[0], rows, &pair.left)
                }),
                1 => picture.bring(ui, "rectified second", |rows| {
                    unbordered(size[0], rows, &pair.right)
                }),
                _ => picture.bring(ui, "depth", |rows| heat(pair, rows, range, theme)),
            }
        }
    }
}

impl Panel for Depth {
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        if self.all_views {
            return space(screen, ui);
        }
        let project = screen.project;
        let document = project.document();
        let pair = document.pair(project.view().pair);
        let found = pair.and_then(|(first, second)| {
            Some((
                DepthOf(first.id, second.id).key(project)?,
                project.get(DepthOf(first.id, second.id))?,
            ))
        });
        let Some((key, found)) = found else {
            return controls::instead(ui, &project.describe());
        };
        self.make(ui, key, found);
        let [first, second, depth] = rooms(ui.available_rect_before_wrap());
        let names = match found.is_swapped {
            false => pair,
            true => pair.map(|(first, second)| (second, first)),
        };
        let names = names.map_or(["", ""], |(first, second)| {
            [first.name.as_str(), second.name.as_str()]
        });
        let labels = [
            format!("{}, rectified", names[0]),
            format!("{}, rectified", names[1]),
            "depth of every pixel".to_owned(),
        ];
        let mut shown = Vec::new();
        for ((rect, picture), label) in [first, second, depth]
            .into_iter()
            .zip(&self.pictures)
            .zip(&labels)
        {
            shown.push(photo::show(ui, rect, picture, &mut self.lens, label));
        }
        for (index, shown) in shown.iter().enumerate() {
            if let Some([u, v]) = shown.clicked() {
                let pixel = [(u + 0.5).max(0.0) as u32, (v + 0.5).max(0.0) as u32];
                self.row = pixel[usize::from(!found.is_vertical)];
                self.probe = (index != 1).then_some(pixel);
            }
        }
        let grip = look::of(Theme::Dark, Role::Grip);
        let row = f64::from(self.row);
        let (right, bottom) = (f64::from(found.width) - 0.5, f64::from(found.height) - 0.5);
        for shown in &shown {
            match found.is_vertical {
                true => shown.line(shown.at(row, -0.5), shown.at(row, bottom), grip),
                false => shown.line(shown.at(-0.5, row), shown.at(right, row), grip),
            }
        }
        if let Some([u, v]) = self.probe {
            for index in [0, 2] {
                shown[index].ring(shown[index].at(f64::from(u), f64::from(v)), 6.0, grip);
            }
            if let Some([u, v]) = found.matched(u, v) {
                shown[1].ring(shown[1].at(u, v), 6.0, grip);
            }
        }
    }

    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            ui.selectable_value(&mut self.all_views, false, "One pair");
            ui.selectable_value(&mut self.all_views, true, "All views");
        });
        if self.all_views {
            return all_views::controls(screen, ui);
        }
        let project = screen.project;
        let (a, b) = project.view().pair;
        controls::choose_pair(screen, ui);
        ui.label(project.describe());
        let pair = project.document().pair((a, b));
        let found = pair.and_then(|(first, second)| project.get(DepthOf(first.id, second.id)));
        if let Some(found) = found {
            let mut is_part = project.document().is_dense((a, b));
            if ui
                .checkbox(&mut is_part, "Add to cloud and export")
                .changed()
            {
                screen.send(Event::Dense(a, b, is_part));
            }
            legend(project, self.range, ui);
            let most = if found.is_vertical {
                found.width
            } else {
                found.height
            }
            .max(1)
                - 1;
            let name = if found.is_vertical {
                "Ruler column"
            } else {
                "Ruler row"
            };
            controls::slider(ui, name, Slider::new(&mut self.row, 0..=most));
            pixel(project, self.probe, found, ui);
        }
        ui.separator();
        let proposed = found.and_then(|found| found.proposed_px);
        controls::edit(screen, |settings| {
            let options = &mut settings.depth;
            let mut change = Change::No;
            ui.horizontal_wrapped(|ui| {
                for (method, name) in [
                    (DepthMethod::SemiGlobal, "semi-global"),
                    (DepthMethod::Block, "block matching"),
                ] {
                    change = change.max(
                        ui.radio_value(&mut options.method, method, name)
                            .changed()
                            .into(),
                    );
                }
            });
            change = change.max(ui.checkbox(&mut options.fill, "Fill gaps").changed().into());
            change.max(disparities(ui, &mut options.range_px, proposed))
        });
        controls::book(ui, Step::Depth);
    }
}

/// Returns rows of a rectified photograph, without the black outside of its rotated outline.
fn unbordered(width: usize, rows: Range<usize>, rgb: &[u8]) -> ColorImage {
    let size = [width, rows.len()];
    let mut image = ColorImage::from_rgb(size, &rgb[3 * width * rows.start..3 * width * rows.end]);
    for row in image.pixels.chunks_mut(width.max(1)) {
        let is_beyond = |pixel: &&mut Color32| **pixel == Color32::BLACK;
        let ends = row.iter_mut().take_while(is_beyond);
        ends.for_each(|pixel| *pixel = Color32::TRANSPARENT);
        let ends = row.iter_mut().rev().take_while(is_beyond);
        ends.for_each(|pixel| *pixel = Color32::TRANSPARENT);
    }
    image
}

/// Colors the depth: near is bright, far is dark, linear in inverse depth; pixels without depth get
/// the background.
fn heat(pair: &Dense, rows: Range<usize>, range: Option<[f64; 2]>, theme: Theme) -> ColorImage {
    let none = look::of(theme, Role::Surface);
    let size = [pair.width as usize, rows.len()];
    let pixels = rows.flat_map(|v| (0..pair.width).map(move |u| (u, v as u32)));
    let color = |(u, v)| match (pair.depth(u, v), range) {
        (Some(depth), Some(range)) => {
            let [r, g, b] = theme.scale(nearness(depth, range));
            Color32::from_rgb(r, g, b)
        }
        _ => none,
    };
    ColorImage::new(size, pixels.map(color).collect())
}

/// Returns 0 for the far end of the range and 1 for the near end.
fn nearness(depth: f64, [near, far]: [f64; 2]) -> f64 {
    let all = 1.0 / near - 1.0 / far;
    match all > 0.0 {
        true => ((1.0 / depth - 1.0 / far) / all).clamp(0.0, 1.0),
        false => 0.5,
    }
}

/// Lays out the two photographs side by side, so that rows agree, with the depth below them; all
/// three in a column if the space is narrow.
fn rooms(whole: Rect) -> [Rect; 3] {
    let gap = 2.0;
    let (above, below) = whole.split_top_bottom_at_fraction(0.45);
    let (first, second) = above.split_left_right_at_fraction(0.5);
    [first, second, below].map(|rect| rect.shrink(gap))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_the_edges_of_a_turned_photograph_is_left_out() {
        let gray = |level: u8| [level; 3];
        let rows = [[0, 7, 0, 7, 0], [0, 0, 0, 0, 0]].concat();
        let rgb: Vec<u8> = rows.into_iter().flat_map(gray).collect();
        let image = unbordered(5, 0..2, &rgb);
        let is_out: Vec<bool> = image.pixels.iter().map(|p| p.a() == 0).collect();
        assert_eq!(is_out[..5], [true, false, false, false, true]);
        assert_eq!(is_out[5..], [true; 5]);
    }

    #[test]
    fn near_is_bright_and_far_is_dark() {
        assert_eq!(nearness(1.0, [1.0, 3.0]), 1.0);
        assert_eq!(nearness(3.0, [1.0, 3.0]), 0.0);
        assert!((nearness(1.5, [1.0, 3.0]) - 0.5).abs() < 1e-12);
        assert_eq!(nearness(9.0, [1.0, 3.0]), 0.0);
        assert_eq!(nearness(2.0, [2.0, 2.0]), 0.5);
    }
}
