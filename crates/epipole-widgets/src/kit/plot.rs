//! Plots: axes with ticks, linear or in decades, curves on them, and a line that says where one is.
//!
//! A panel's world is linear, so an axis in [`Scale::Decades`] has the logarithm to base 10 as its
//! world; [`decade`] takes values there.

use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Layout, Panel, Rect, format_number};
use crate::kit::grid::{SMALL, fitting_title};
use crate::kit::labels::Labels;
use crate::theme::Role;

/// Room for the numbers of the vertical axis.
pub(crate) const LEFT: f64 = 42.0;
/// Room for those of the horizontal one.
const BELOW: f64 = 22.0;
/// Room to the right of a plot.
const RIGHT: f64 = 6.0;
/// Room for the name of the horizontal axis.
const NAME: f64 = 17.0;
/// Size of raised letters.
const RAISED: f64 = 9.0;
/// Least distance of ticks along the horizontal and the vertical axis.
const ACROSS: f64 = 58.0;
const DOWN: f64 = 30.0;
/// Least distance of names along an axis that counts things.
const NAMES: f64 = 20.0;

/// The names of nine singular values.
pub(crate) const SIGMAS: &[&str] = &["σ₁", "σ₂", "σ₃", "σ₄", "σ₅", "σ₆", "σ₇", "σ₈", "σ₉"];

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    /// Each power of ten takes as much room as the next.
    Decades,
}

/// An axis of a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ruler {
    /// From where to where, in the panel's world.
    from: f64,
    to: f64,
    scale: Scale,
    /// What stands below a horizontal axis; a vertical axis is named by the plot's title.
    name: &'static str,
    /// What stands behind each number.
    unit: &'static str,
    /// By how much numbers are multiplied before they are shown.
    times: f64,
    /// What stands at 1, 2, 3 … instead of numbers.
    names: &'static [&'static str],
}

impl Ruler {
    /// From `from` to `to`, evenly.
    pub(crate) fn linear(from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            scale: Scale::Linear,
            name: "",
            unit: "",
            times: 1.0,
            names: &[],
        }
    }

    /// Things that are counted from 1, with their names.
    pub(crate) fn things(names: &'static [&'static str]) -> Self {
        Self {
            names,
            ..Self::linear(0.5, names.len() as f64 + 0.5)
        }
    }

    /// From `10^from` to `10^to`.
    pub(crate) fn decades(from: f64, to: f64) -> Self {
        Self {
            scale: Scale::Decades,
            ..Self::linear(from, to)
        }
    }

    /// The same axis with a name below it.
    pub(crate) fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// The same axis with numbers in a unit, such as shares in percent.
    pub(crate) fn shown(self, times: f64, unit: &'static str) -> Self {
        Self {
            times,
            unit,
            ..self
        }
    }

    /// Where the ticks are, and what they say, so that the axis of this length has room for them.
    ///
    /// * `apart`: least distance of numbers
    fn ticks(&self, length: f64, apart: f64) -> Vec<(f64, String)> {
        if !self.names.is_empty() {
            let every = (self.names.len() as f64 * NAMES / length.max(1.0)).ceil();
            let names = self.names.iter().enumerate().step_by(every as usize);
            return names
                .map(|(k, name)| (k as f64 + 1.0, (*name).to_owned()))
                .collect();
        }
        let most = length / apart;
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        if self.scale == Scale::Decades && high - low < 2.0 {
            return within_decades(low, high);
        }
        let step = match self.scale {
            Scale::Linear => round_step(self.times * (high - low) / most.max(1.0)) / self.times,
            Scale::Decades => ((high - low) / most.max(1.0)).ceil().max(1.0),
        };
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let text = |at: f64| match self.scale {
            Scale::Linear => {
                let step = step * self.times;
                let digits = (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 6.0) as usize;
                format!("{}{}", format_number(at * self.times, digits), self.unit)
            }
            // One notation for all numbers of an axis.
            Scale::Decades if first as f64 * step < -3.0 || last as f64 * step > 3.0 => {
                format!("10^{}", format_number(at, 0))
            }
            Scale::Decades => power_of_ten(at as i32),
        };
        (first..=last.min(first + 100))
            .map(|index| {
                let at = index as f64 * step;
                (at, text(at))
            })
            .collect()
    }
}

/// The next larger of 1, 2, 5, 10, 20 …
fn round_step(step: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(step.max(1e-300))));
    let times = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|n| n * power >= step * (1.0 - 1e-9));
    times.unwrap_or(10.0) * power
}

/// A power of ten in full.
fn power_of_ten(power: i32) -> String {
    format_number(libm::exp10(f64::from(power)), (-power).max(0) as usize)
}

/// Ticks at 1, 2, 5, 10, 20 … where an axis spans hardly a decade.
fn within_decades(low: f64, high: f64) -> Vec<(f64, String)> {
    let powers = libm::floor(low) as i32..=libm::floor(high) as i32;
    let ticks = powers.flat_map(|power| {
        [1.0, 2.0, 5.0].map(|times| {
            let value = times * libm::exp10(f64::from(power));
            (
                libm::log10(value),
                format_number(value, (-power).max(0) as usize),
            )
        })
    });
    let is_inside = |(at, _): &(f64, String)| (low - 1e-9..=high + 1e-9).contains(at);
    ticks.filter(is_inside).collect()
}

/// The number of a tick; what follows a "^" is raised. The font has no raised minus.
fn draw_number(canvas: &mut Canvas, (x, y): Place, text: &str, style: TextStyle) {
    let (base, raised) = text.split_once('^').unwrap_or((text, ""));
    if raised.is_empty() {
        return canvas.label((x, y), base, style);
    }
    let small = TextStyle {
        size: RAISED,
        align: Align::Start,
        ..style
    };
    let left = match style.align {
        Align::Start => x,
        Align::Middle => x - number_width(text) / 2.0,
        Align::End => x - number_width(text),
    };
    let base_style = TextStyle {
        size: SMALL,
        ..small
    };
    canvas.label((left, y), base, base_style);
    let beside = (left + text_width(base, SMALL) + 1.0, y - 4.0);
    canvas.label(beside, raised, small);
}

fn number_width(text: &str) -> f64 {
    let (base, raised) = text.split_once('^').unwrap_or((text, ""));
    text_width(base, SMALL) + text_width(raised, RAISED) + 1.0
}

/// Where a value is on an axis in decades; zero and less are far below.
pub(crate) fn decade(value: f64) -> f64 {
    libm::log10(value.max(1e-300))
}

/// A plot's panel within a cell, with room for the numbers of its axes.
pub(crate) fn panel(id: &'static str, cell: Rect, x: &Ruler, y: &Ruler) -> Panel {
    let below = if x.name.is_empty() {
        BELOW
    } else {
        BELOW + NAME
    };
    let rect = Rect::new(
        cell.x + LEFT,
        cell.y,
        (cell.width - LEFT - RIGHT).max(1.0),
        (cell.height - below).max(1.0),
    );
    Panel::new(id, rect, [x.from, x.to], [y.to, y.from])
}

/// A plot's panel with its title, in the first wording that fits, and its axes.
pub(crate) fn open<'a>(
    canvas: &mut Canvas,
    layout: &'a Layout,
    id: &str,
    titles: &[&str],
    [x, y]: &[Ruler; 2],
) -> &'a Panel {
    let panel = layout.panel(id);
    fitting_title(canvas, panel.rect, titles);
    draw_axes(canvas, panel, x, y);
    panel
}

/// The title of a plot, in the first wording that fits, from where the numbers of its vertical axis begin.
pub(crate) fn title_from_left(canvas: &mut Canvas, panel: &Panel, titles: &[&str]) {
    let Rect { x, width, .. } = panel.rect;
    let above = Rect {
        x: x - LEFT,
        width: width + LEFT,
        ..panel.rect
    };
    fitting_title(canvas, above, titles);
}

/// The surface, the ticks and their numbers.
pub(crate) fn draw_axes(canvas: &mut Canvas, panel: &Panel, x: &Ruler, y: &Ruler) {
    let rect = panel.rect;
    canvas.panel(rect);
    let style = TextStyle::new(Role::Muted, SMALL);
    let grid = Stroke::solid(Role::Grid, 1.0);
    for (at, text) in y.ticks(rect.height, DOWN) {
        let v = panel.canvas_from_world((x.from, at)).1;
        canvas.line((rect.x + 1.0, v), (rect.right() - 1.0, v), grid);
        // Half of a number at the very end would run into the title.
        let beside = v.max(rect.y + 4.0);
        draw_number(canvas, (rect.x - 6.0, beside), &text, style.end());
    }
    for (at, text) in x.ticks(rect.width, ACROSS) {
        let u = panel.canvas_from_world((at, y.from)).0;
        canvas.line((u, rect.y + 1.0), (u, rect.bottom() - 1.0), grid);
        // The last number may stand at the very end, where half of it has no room.
        let middle = u.min(rect.right() + RIGHT - number_width(&text) / 2.0);
        draw_number(
            canvas,
            (middle, rect.bottom() + 12.0),
            &text,
            style.middle(),
        );
    }
    if !x.name.is_empty() {
        let place = (rect.center().0, rect.bottom() + BELOW + 7.0);
        canvas.label(place, x.name, style.middle());
    }
}

/// A curve through places of the panel's world; what is outside is cut off.
pub(crate) fn draw_curve(
    canvas: &mut Canvas,
    panel: &Panel,
    places: impl IntoIterator<Item = (f64, f64)>,
    stroke: Stroke,
) {
    let places: Vec<Place> = (places.into_iter())
        .map(|place| panel.canvas_from_world(place))
        .collect();
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        canvas.polyline(&places, stroke)
    });
}

/// Values of an axis that counts things, in decades: a curve with a mark for each.
pub(crate) struct List<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) stroke: Stroke,
    /// Shape and radius of its marks.
    pub(crate) mark: (Shape, f64),
    /// Its name, and the index of the value beside which it stands.
    pub(crate) name: (&'a str, usize),
}

/// Draws lists, and then their names beside them. A value beyond the axis is drawn at its edge.
pub(crate) fn draw_lists(canvas: &mut Canvas, panel: &Panel, lists: &[List]) {
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let world = |(k, value): (usize, &f64)| {
        let decade = decade(*value).clamp(panel.y_axis.end, panel.y_axis.start);
        (k as f64 + 1.0, decade)
    };
    for list in lists {
        let places = || list.values.iter().enumerate().map(world);
        draw_curve(canvas, panel, places(), list.stroke);
        for place in places() {
            let (x, y) = panel.canvas_from_world(place);
            let place = (x, y.clamp(panel.rect.y + 5.0, panel.rect.bottom() - 5.0));
            let (shape, radius) = list.mark;
            canvas.marker(place, radius, shape, list.stroke.role, false);
            labels.keep_free(place, 6.0);
        }
    }
    for list in lists {
        let (name, index) = list.name;
        let place = panel.canvas_from_world(world((index, &list.values[index])));
        labels.name(canvas, (place, 8.0), name, (list.stroke.role, SMALL));
    }
}

/// The line that says where along the horizontal axis the figure is now.
pub(crate) fn draw_now(canvas: &mut Canvas, panel: &Panel, x: f64) {
    let u = panel.canvas_from_world((x, 0.0)).0;
    let rect = panel.rect;
    let stroke = Stroke::solid(Role::Grip, 1.5).dashed();
    canvas.clipped(rect.inset(1.0), |canvas| {
        canvas.line((u, rect.y), (u, rect.bottom()), stroke);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ruler: &Ruler, most: f64) -> Vec<String> {
        ruler
            .ticks(most, 1.0)
            .into_iter()
            .map(|(_, text)| text)
            .collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(
            texts(&Ruler::linear(0.0, 8.3), 5.0),
            ["0", "2", "4", "6", "8"]
        );
        assert_eq!(
            texts(&Ruler::linear(-0.3, 0.3), 3.0),
            ["−0.2", "0.0", "0.2"]
        );
        let shares = Ruler::linear(0.1, 0.9).shown(100.0, " %");
        assert_eq!(texts(&shares, 5.0), ["20 %", "40 %", "60 %", "80 %"]);
    }

    #[test]
    fn things_have_names_as_far_as_there_is_room() {
        let ruler = Ruler::things(&["a", "b", "c", "d", "e"]);
        assert_eq!(ruler.ticks(200.0, 1.0).len(), 5);
        let few = ruler.ticks(60.0, 1.0);
        let few: Vec<_> = few.iter().map(|(at, name)| (*at, &**name)).collect();
        assert_eq!(few, [(1.0, "a"), (3.0, "c"), (5.0, "e")]);
    }

    #[test]
    fn decades_are_powers_of_ten() {
        let ruler = Ruler::decades(-1.2, 4.4);
        assert_eq!(
            texts(&ruler, 10.0),
            ["10^−1", "10^0", "10^1", "10^2", "10^3", "10^4"]
        );
        assert_eq!(texts(&ruler, 2.0), ["1", "1000"]);
        assert_eq!(
            texts(&Ruler::decades(-3.0, 1.0), 4.0),
            ["0.001", "0.01", "0.1", "1", "10"]
        );
        assert_eq!(
            texts(&Ruler::decades(-0.4, 0.7), 3.0),
            ["0.5", "1", "2", "5"]
        );
        assert!((decade(1000.0) - 3.0).abs() < 1e-12 && decade(0.0) < -200.0);
    }

    #[test]
    fn a_panel_leaves_room_for_numbers() {
        let (x, y) = (Ruler::linear(0.0, 10.0), Ruler::decades(-1.0, 3.0));
        let panel = panel("cost", Rect::new(0.0, 24.0, 300.0, 180.0), &x, &y);
        assert_eq!(panel.canvas_from_world((0.0, 3.0)), (LEFT, 24.0));
        assert_eq!(panel.rect.bottom(), 24.0 + 180.0 - BELOW);
    }
}
