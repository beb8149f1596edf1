//! Titled panels in rows, with common breakpoints for all figures, and notices in place of
//! pictures.
//!
//! A view requests rows from a [`Grid`], from the top down, and creates panels in the returned
//! rectangles.

use crate::canvas::{Canvas, TextStyle, paragraph_height, text_width};
use crate::contract::{Layout, Panel, Rect};
use crate::theme::Role;

/// Gap between panels, CSS pixels.
pub(crate) const GAP: f64 = 12.0;
/// Height of a panel's title line, CSS pixels.
pub(crate) const TITLE: f64 = 24.0;
/// Font size of titles and labels, CSS pixels.
pub(crate) const TEXT: f64 = 13.0;
/// Font size of axes and legends, CSS pixels.
pub(crate) const SMALL: f64 = 12.0;
/// Width below which panels are stacked, as on phones, CSS pixels.
const NARROW: f64 = 560.0;
/// Width from which panels are arranged side by side, CSS pixels.
const BROAD: f64 = 900.0;

/// Maximum height of a picture on a phone, CSS pixels, so that sliders fit on the screen.
const PHONE: f64 = 376.0;

/// Returns whether a picture of this width is for a phone.
pub(crate) fn is_narrow(width: f64) -> bool {
    width < NARROW
}

/// Returns whether a picture of this width is for a wide page.
pub(crate) fn is_broad(width: f64) -> bool {
    width >= BROAD
}

/// Returns height over width of a picture.
pub(crate) const fn aspect((width, height): (u32, u32)) -> f64 {
    height as f64 / width as f64
}

/// Rows of titled cells, from the top down.
pub(crate) struct Grid {
    width: f64,
    bottom: f64,
}

impl Grid {
    /// Creates an empty grid, `width` CSS pixels wide.
    pub(crate) fn new(width: f64) -> Self {
        Self { width, bottom: 0.0 }
    }

    /// Returns the top of the next row's cells, below their titles.
    fn next_top(&self) -> f64 {
        let gap = if self.bottom > 0.0 { GAP } else { 0.0 };
        self.bottom + gap + TITLE
    }

    /// Adds cells of equal height that fill the width; if taller than `tallest`, they are shrunk
    /// and centered.
    ///
    /// * `aspects`: height over width of each
    pub(crate) fn row<const N: usize>(&mut self, aspects: [f64; N], tallest: f64) -> [Rect; N] {
        let room = (self.width - GAP * (N - 1) as f64).max(1.0);
        let widths: f64 = aspects.iter().map(|aspect| 1.0 / aspect).sum();
        let height = (room / widths).min(tallest);
        let y = self.next_top();
        let mut x = ((room - height * widths) / 2.0).max(0.0);
        let cells = aspects.map(|aspect| {
            let cell = Rect::new(x, y, height / aspect, height);
            x = cell.right() + GAP;
            cell
        });
        self.bottom = y + height;
        cells
    }

    /// Adds cells with these fractions of the width, `height` tall.
    pub(crate) fn shares<const N: usize>(&mut self, shares: [f64; N], height: f64) -> [Rect; N] {
        let row = Rect::new(0.0, self.next_top(), self.width, height);
        self.bottom = row.bottom();
        columns(row, shares)
    }

    /// Adds a panel with two photographs beside it, or on a phone above it.
    ///
    /// * `aspect`: height over width of a photograph
    /// * `tallest`: maximum height of the panel if the photographs are beside it
    pub(crate) fn beside_photographs(&mut self, aspect: f64, tallest: f64) -> (Rect, [Rect; 2]) {
        if is_narrow(self.width) {
            let photographs = self.row([aspect; 2], PHONE / 2.0);
            let [panel] = self.shares([1.0], (PHONE - self.next_top()).max(120.0));
            return (panel, photographs);
        }
        let between = GAP + TITLE;
        let widest = 0.45 * self.width;
        let height = ((tallest - between) / 2.0).min(widest * aspect);
        let width = height / aspect;
        let shares = [self.width - GAP - width, width];
        let [panel, column] = self.shares(shares, 2.0 * height + between);
        (panel, stack(column, [1.0; 2]))
    }

    /// Adds two photographs and two smaller panels: on a wide page stacked beside the photographs,
    /// otherwise in a low row below them.
    ///
    /// * `aspect`: height over width of a photograph
    /// * `shares`: fractions of the smaller panels: of the height if beside, then of the width if
    ///   below
    pub(crate) fn photographs_and_two(&mut self, aspect: f64, shares: [[f64; 2]; 2]) -> [Rect; 4] {
        const BESIDE: f64 = 404.0;
        const ABOVE: f64 = 254.0;
        const LOW: f64 = 104.0;
        if is_broad(self.width) {
            let [first, second, side] = self.row([aspect, aspect, 1.05], BESIDE);
            let [upper, lower] = stack(side, shares[0]);
            return [first, second, upper, lower];
        }
        let [first, second] = self.row([aspect; 2], ABOVE);
        let [left, right] = self.shares(shares[1], LOW);
        [first, second, left, right]
    }

    /// Adds a full-width strip for a legend or a line of text.
    pub(crate) fn strip(&mut self, height: f64) -> Rect {
        let strip = Rect::new(0.0, self.bottom, self.width, height);
        self.bottom = strip.bottom();
        strip
    }

    /// Returns the layout of the picture with these panels.
    pub(crate) fn layout(self, panels: Vec<Panel>) -> Layout {
        // Half of the border of the lowest panel is outside of it.
        let height = self.bottom + 1.0;
        Layout {
            width: self.width,
            height,
            panels,
        }
    }
}

/// Splits a rectangle into columns with these fractions of its width and gaps between them.
pub(crate) fn columns<const N: usize>(rect: Rect, shares: [f64; N]) -> [Rect; N] {
    let room = (rect.width - GAP * (N - 1) as f64).max(1.0);
    let all: f64 = shares.iter().sum();
    let mut x = rect.x;
    shares.map(|share| {
        let column = Rect::new(x, rect.y, room * share / all, rect.height);
        x = column.right() + GAP;
        column
    })
}

/// Splits a rectangle into stacked cells with these fractions of its height, leaving room for a
/// title above each; the first title is above the rectangle.
pub(crate) fn stack<const N: usize>(rect: Rect, shares: [f64; N]) -> [Rect; N] {
    let between = GAP + TITLE;
    let room = (rect.height - between * (N - 1) as f64).max(1.0);
    let all: f64 = shares.iter().sum();
    let mut y = rect.y;
    shares.map(|share| {
        let cell = Rect::new(rect.x, y, rect.width, room * share / all);
        y = cell.bottom() + between;
        cell
    })
}

/// Draws the title line above a panel.
pub(crate) fn title(canvas: &mut Canvas, rect: Rect, text: &str) {
    let place = (rect.x, rect.y - TITLE / 2.0);
    canvas.label(place, text, TextStyle::new(Role::Ink, TEXT).cased());
}

/// Draws the title line above a panel: the first of these texts, longest first, that fits.
pub(crate) fn fitting_title(canvas: &mut Canvas, rect: Rect, wordings: &[&str]) {
    title(canvas, rect, fitting(rect.width, wordings));
}

/// Draws a panel's border and title: the first of these texts that fits.
pub(crate) fn open(canvas: &mut Canvas, panel: &Panel, wordings: &[&str]) {
    fitting_title(canvas, panel.rect, wordings);
    canvas.panel(panel.rect);
}

/// Opens panels with [`open`], each given by its name and titles.
pub(crate) fn open_all<'a, const N: usize>(
    canvas: &mut Canvas,
    layout: &'a Layout,
    panels: [(&str, &[&str]); N],
) -> [&'a Panel; N] {
    panels.map(|(id, wordings)| {
        let panel = layout.panel(id);
        open(canvas, panel, wordings);
        panel
    })
}

/// Returns the first of these texts that fits the width, or else the last.
pub(crate) fn fitting<'a>(width: f64, wordings: &[&'a str]) -> &'a str {
    let fits = |text: &&&str| text_width(text, TEXT) <= width;
    wordings
        .iter()
        .find(fits)
        .or(wordings.last())
        .unwrap_or(&"")
}

/// Draws a notice over the lower part of a panel.
pub(crate) fn notice(canvas: &mut Canvas, rect: Rect, text: &str) {
    let width = rect.inset(12.0).width;
    let height = paragraph_height(text, TEXT, width) + 16.0;
    let plate = Rect::new(rect.x, rect.bottom() - height, rect.width, height);
    canvas.fill_rect(plate, Role::Background, 0.92);
    let inside = Rect::new(rect.x + 12.0, plate.y + 8.0, width, height);
    canvas.paragraph(inside, text, TextStyle::new(Role::Ink, TEXT));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_fill_the_width_or_stand_in_its_middle() {
        let mut grid = Grid::new(800.0);
        let [left, right] = grid.row([0.75, 0.75], 1000.0);
        assert_eq!((left.x, left.y, left.width), (0.0, TITLE, 394.0));
        assert_eq!((right.right(), right.height), (800.0, left.height));
        let [alone] = grid.row([0.5], 100.0);
        assert_eq!((alone.width, alone.height, alone.x), (200.0, 100.0, 300.0));
        assert_eq!(alone.y, left.bottom() + GAP + TITLE);
        let [wide, narrow] = grid.shares([3.0, 1.0], 80.0);
        assert_eq!((wide.width, narrow.right()), (591.0, 800.0));
        let strip = grid.strip(20.0);
        assert_eq!((strip.y, strip.width), (wide.bottom(), 800.0));
        assert_eq!(grid.layout(Vec::new()).height, strip.bottom() + 1.0);
    }

    #[test]
    fn a_title_is_as_long_as_there_is_room_for() {
        let wordings = [
            "Where the lines meet in photograph 2",
            "Where they meet",
            "Meet",
        ];
        assert_eq!(fitting(500.0, &wordings), wordings[0]);
        assert_eq!(fitting(120.0, &wordings), wordings[1]);
        assert_eq!(fitting(2.0, &wordings), wordings[2]);
    }

    #[test]
    fn photographs_keep_their_shape_beside_a_panel() {
        for (width, tallest) in [(1088.0, 440.0), (720.0, 440.0), (360.0, 440.0)] {
            let mut grid = Grid::new(width);
            let (panel, photographs) = grid.beside_photographs(0.5, tallest);
            for photograph in photographs {
                assert!((photograph.height - 0.5 * photograph.width).abs() < 1e-9);
                assert!(photograph.right() <= width + 1e-9);
            }
            let height = grid.layout(Vec::new()).height;
            assert!(panel.bottom() < height && height < if width < 400.0 { 380.0 } else { 466.0 });
        }
    }

    #[test]
    fn cells_below_each_other_leave_room_for_titles() {
        let [first, second] = stack(Rect::new(0.0, 10.0, 50.0, 136.0), [1.0, 1.0]);
        assert_eq!((first.y, first.height), (10.0, 50.0));
        assert_eq!((second.y, second.bottom()), (60.0 + GAP + TITLE, 146.0));
    }
}
