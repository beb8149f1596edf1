//! Cells with numbers: small images and tables with readable values.

use crate::canvas::{Canvas, TextStyle, text_width};
use crate::contract::{Panel, Rect};
use crate::kit::grid::TEXT;
use crate::theme::Rgb;

/// Minimum width of a cell with a number, CSS pixels.
const SMALLEST: f64 = 17.0;

/// Returns the rectangle of a pixel and its `reach` neighbors on each side, in a panel of an image.
pub(crate) fn around(panel: &Panel, (u, v): (f64, f64), reach: u32) -> Rect {
    let half = f64::from(reach) + 0.5;
    panel.rect_between((u - half, v - half), (u + half, v + half))
}

/// Returns the cells of a 3 × 3 table, row by row, horizontally centered at the top of a rectangle;
/// `broadest` limits their width over height.
pub(crate) fn three_by_three(room: Rect, broadest: f64) -> [Rect; 9] {
    let height = (room.width / 3.0).min(room.height / 3.0);
    let width = (broadest * height).min(room.width / 3.0);
    let left = room.center().0 - 1.5 * width;
    std::array::from_fn(|k| {
        let (column, row) = ((k % 3) as f64, (k / 3) as f64);
        Rect::new(left + column * width, room.y + row * height, width, height)
    })
}

/// Returns a gray level from 0 to 255 as a color.
pub(crate) fn gray(level: f64) -> Rgb {
    [level.round().clamp(0.0, 255.0) as u8; 3]
}

/// Draws a filled cell with its number, if there is room.
pub(crate) fn draw(canvas: &mut Canvas, rect: Rect, color: Rgb, text: &str) {
    canvas.fill_color(rect, color);
    if rect.width < SMALLEST {
        return;
    }
    let role = canvas.theme().readable_on(color);
    let size = fitting_size(text, rect.width - 4.0).min(rect.height * 0.8);
    canvas.label(rect.center(), text, TextStyle::new(role, size).middle());
}

/// Returns the largest font size at which a text fits the width.
pub(crate) fn fitting_size(text: &str, width: f64) -> f64 {
    TEXT.min(width / text_width(text, 1.0).max(1e-9))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_stays_in_its_cell() {
        for width in [10.0, 30.0, 300.0] {
            let size = fitting_size("−12.75", width);
            assert!(size <= TEXT && text_width("−12.75", size) <= width + 1e-9);
        }
        assert_eq!(fitting_size("0", 300.0), TEXT);
        assert_eq!([-3.0, 127.6, 300.0].map(gray), [[0; 3], [128; 3], [255; 3]]);
    }

    #[test]
    fn a_table_stands_in_the_middle() {
        let room = Rect::new(10.0, 5.0, 90.0, 30.0);
        let cells = three_by_three(room, f64::INFINITY);
        assert_eq!(
            (cells[0].x, cells[8].right(), cells[8].bottom()),
            (10.0, 100.0, 35.0)
        );
        let cells = three_by_three(room, 1.5);
        assert_eq!((cells[4].width, cells[4].center()), (15.0, room.center()));
    }

    #[test]
    fn cells_of_pixels_touch() {
        let panel = Panel::photograph("image", Rect::new(0.0, 0.0, 40.0, 20.0), (4, 2));
        let [left, right] = [(1.0, 0.0), (2.0, 0.0)].map(|pixel| around(&panel, pixel, 0));
        assert_eq!((left.width, left.right()), (10.0, right.x));
        let window = around(&panel, (1.0, 1.0), 1);
        assert_eq!((window.x, window.y, window.width), (0.0, 0.0, 30.0));
    }
}
