//! Rulers of the 3D view: a grid on the floor, a scale bar, and the edges of the box.

use super::look;
use crate::project::{CropBox, Project};
use crate::session::Floor;
use egui::{Align2, FontId, Rect, Sense, Stroke, Ui, pos2, vec2};
use epipole_canvas::cloud::{Line, Orbit};
use epipole_canvas::theme::Role;
use nalgebra::{Point3, Vector3};

/// Number of parts of a line, of which those in front of the eye are drawn.
const NUM_PARTS: u32 = 16;
/// Maximum length of the scale bar, points, and relative to the view.
const BAR: f32 = 150.0;
const BAR_RATIO: f32 = 0.3;

/// Returns the largest of 1, 2 and 5 times a power of ten that does not exceed a length.
pub(super) fn round_below(length: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(length)));
    // A length that is round stays as it is.
    let times = length / power * (1.0 + 1e-9);
    power
        * if times >= 5.0 {
            5.0
        } else if times >= 2.0 {
            2.0
        } else {
            1.0
        }
}

/// Writes a round length, in meters or units.
fn length_words(length: f64, is_metric: bool) -> String {
    match (is_metric, length) {
        (false, 0.999..1.001) => "1 unit".to_owned(),
        (false, _) => format!("{} units", plain(length)),
        (true, 1000.0..) => format!("{} km", plain(length / 1000.0)),
        (true, 0.999..) => format!("{} m", plain(length)),
        (true, 0.00999..) => format!("{} cm", plain(length * 100.0)),
        (true, _) => format!("{} mm", plain(length * 1000.0)),
    }
}

/// Writes a round number without the digits of rounding errors.
fn plain(number: f64) -> String {
    let digits = (-libm::floor(libm::log10(number))).clamp(0.0, 12.0) as usize;
    format!("{number:.digits$}")
}

/// Draws the scale bar, which holds at the center of the view.
pub(super) fn scale_bar(
    project: &Project,
    ui: &mut Ui,
    rect: Rect,
    (orbit, size): (&Orbit, (usize, usize)),
) {
    let meters = project.scale().map(|scale| scale.meters_per_unit);
    let pixels_per_unit = orbit.focal_px(size) / orbit.distance;
    let per_length =
        pixels_per_unit / meters.unwrap_or(1.0) * f64::from(rect.width()) / size.0.max(1) as f64;
    let most = f64::from(BAR.min(BAR_RATIO * rect.width())) / per_length;
    if !(most.is_finite() && most > 0.0) {
        return;
    }
    let length = round_below(most);
    let words = length_words(length, meters.is_some());
    let width = (length * per_length) as f32;
    let place = Rect::from_min_size(rect.left_bottom() + vec2(12.0, -36.0), vec2(width, 26.0));
    let response = ui.interact(place, ui.scope_id().with("scale bar"), Sense::hover());
    response.widget_info(|| {
        let words = format!("Scale bar at the center: {words}");
        egui::WidgetInfo::labeled(egui::Role::Label, true, words)
    });
    let painter = ui.painter_at(rect);
    let ink = look::color(ui, Role::Ink);
    let stroke = Stroke::new(2.0, ink);
    let (left, right) = (place.left_bottom(), place.right_bottom());
    painter.line_segment([left, right], stroke);
    for end in [left, right] {
        painter.line_segment([end, end - vec2(0.0, 7.0)], stroke);
    }
    let font = FontId::proportional(13.0);
    let text = painter.layout_no_wrap(words, font, ink);
    let at = Align2::CENTER_BOTTOM.anchor_size(pos2(place.center().x, left.y - 4.0), text.size());
    let at = at.translate(vec2((rect.left() + 4.0 - at.left()).max(0.0), 0.0));
    painter.rect_filled(at.expand(2.0), 3.0, look::color(ui, Role::Background));
    painter.galley(at.min, text, ink);
}

/// Adds the grid of the floor around some points. Returns the side of a cell in meters or units.
pub(super) fn grid(
    lines: &mut Vec<Line>,
    floor: &Floor,
    places: impl Iterator<Item = [f32; 3]>,
    meters_per_unit: f64,
    color: [u8; 3],
) {
    let any = match floor.up.x.abs() < 0.6 {
        true => Vector3::x(),
        false => Vector3::z(),
    };
    let x = (any - floor.up * any.dot(&floor.up)).normalize();
    let axes = [x, floor.up.cross(&x)];
    let mut along = [Vec::new(), Vec::new()];
    for place in places.filter(|place| place.iter().all(|x| x.is_finite())) {
        let away = Point3::from(place.map(f64::from)) - floor.origin;
        for (values, axis) in along.iter_mut().zip(&axes) {
            values.push(away.dot(axis));
        }
    }
    let range = |mut values: Vec<f64>| {
        let last = values.len().checked_sub(1)?;
        values.sort_unstable_by(f64::total_cmp);
        Some([values[last / 20], values[last - last / 20]])
    };
    let [across, ahead] = along.map(range);
    let (Some(across), Some(ahead)) = (across, ahead) else {
        return;
    };
    let width = (across[1] - across[0]).max(ahead[1] - ahead[0]);
    let cell = round_below(width * meters_per_unit / 6.0) / meters_per_unit;
    if !(cell.is_finite() && cell > 0.0) {
        return;
    }
    let cells = |[low, high]: [f64; 2]| {
        let [low, high] = [libm::floor(low / cell), libm::ceil(high / cell)];
        (low as i32)..=(high as i32)
    };
    let (columns, rows) = (cells(across), cells(ahead));
    let at =
        |a: i32, b: i32| floor.origin + (axes[0] * f64::from(a) + axes[1] * f64::from(b)) * cell;
    for a in columns.clone() {
        dashes(lines, [at(a, *rows.start()), at(a, *rows.end())], color);
    }
    for b in rows.clone() {
        dashes(
            lines,
            [at(*columns.start(), b), at(*columns.end(), b)],
            color,
        );
    }
}

/// Adds the edges of the box.
pub(super) fn edges(lines: &mut Vec<Line>, crop: &CropBox, color: [u8; 3]) {
    for edge in crop.edges() {
        dashes(lines, edge, color);
    }
}

/// Adds a line in parts, as one that is partly behind the eye is not drawn.
fn dashes(lines: &mut Vec<Line>, [from, to]: [Point3<f64>; 2], color: [u8; 3]) {
    let at = |part: u32| {
        let ratio = f64::from(part) / f64::from(NUM_PARTS);
        from.lerp(&to, ratio).cast::<f32>().into()
    };
    lines.extend((0..NUM_PARTS).map(|part| Line {
        from: at(part),
        to: at(part + 1),
        color,
    }));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        for (length, round) in [
            (1.0, 1.0),
            (1.99, 1.0),
            (4.2, 2.0),
            (0.0049, 0.002),
            (0.005, 0.005),
            (730.0, 500.0),
        ] {
            let found = round_below(length);
            assert!((found / round - 1.0).abs() < 1e-9, "{length}: {found}");
        }
        assert_eq!(length_words(0.2, false), "0.2 units");
        assert_eq!(length_words(1.0, false), "1 unit");
        let metric = [2000.0, 5.0, 1.0, 0.5, 0.01, 0.002].map(|m| length_words(m, true));
        assert_eq!(metric, ["2 km", "5 m", "1 m", "50 cm", "1 cm", "2 mm"]);
    }

    #[test]
    fn a_grid_lies_on_its_floor_and_has_square_cells() {
        let up = Vector3::new(0.0, -0.6, 0.8);
        let floor = Floor {
            origin: Point3::new(1.0, 2.0, 3.0),
            up,
        };
        let places = (0..100_u32).map(|n| [n % 10, n / 10, 0].map(|k| k as f32));
        let mut lines = Vec::new();
        grid(&mut lines, &floor, places, 0.5, [0; 3]);
        assert!(lines.len() > 100);
        for line in &lines {
            for end in [line.from, line.to] {
                let height = (Point3::from(end.map(f64::from)) - floor.origin).dot(&up);
                assert!(height.abs() < 1e-5, "{height}");
            }
        }
    }
}
