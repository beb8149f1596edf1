//! A magnified view of the match in a corner of the right photograph, in which single pixels are
//! visible.

use super::style::UNCERTAIN;
use crate::canvas::{Align, Canvas, Place, Stroke, TextStyle};
use crate::contract::{Panel, Rect};
use crate::gallery::stereo_slider::rig::ERROR_PX;
use crate::kit::grid::TEXT;
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::theme::Role;
use image::RgbImage;
use nalgebra::Point2;

/// Size of the magnified region, pixels of the photograph.
const COLUMNS: u32 = 17;
const ROWS: u32 = 11;
/// Side of the square that each pixel is enlarged to, pixels.
const SQUARE: u32 = 12;
/// Width of the magnified view relative to the photograph.
const SHARE: f64 = 0.36;
/// Margin to the borders of the photograph, CSS pixels.
const MARGIN: f64 = 6.0;
/// Gap between the leader line and the match, CSS pixels.
const CLEAR: f64 = 8.0;

/// Neighborhood of a pixel.
pub(super) struct Magnifier {
    squares: RgbImage,
    /// Position of the match in the region, pixels of the photograph.
    at: Point2<f64>,
}

impl Magnifier {
    /// Copies the region around `pixel`, shifted inward at the borders; `None` outside of the
    /// photograph.
    pub(super) fn over(photograph: &RgbImage, pixel: &Point2<f64>) -> Option<Self> {
        let first = |at: f64, shown: u32, all: u32| {
            let is_inside = (-0.5..f64::from(all) - 0.5).contains(&at) && all >= shown;
            is_inside.then(|| {
                (at.round() as u32)
                    .saturating_sub(shown / 2)
                    .min(all - shown)
            })
        };
        let left = first(pixel.x, COLUMNS, photograph.width())?;
        let top = first(pixel.y, ROWS, photograph.height())?;
        let squares = RgbImage::from_fn(COLUMNS * SQUARE, ROWS * SQUARE, |u, v| {
            *photograph.get_pixel(left + u / SQUARE, top + v / SQUARE)
        });
        Some(Self {
            squares,
            at: Point2::new(pixel.x - f64::from(left), pixel.y - f64::from(top)),
        })
    }

    /// Draws it into the upper right corner of `photograph`; a line leads to the match at `place`.
    pub(super) fn draw(&self, photograph: Rect, place: Place, canvas: &mut Canvas) {
        let width = SHARE * photograph.width;
        let glass = Rect {
            x: photograph.right() - MARGIN - width,
            y: photograph.y + MARGIN,
            width,
            height: width * f64::from(ROWS) / f64::from(COLUMNS),
        };
        let frame = Stroke::solid(Role::Ink, 1.0).cased();
        let corner = (place.0.clamp(glass.x, glass.right()), glass.bottom());
        let (across, down) = (corner.0 - place.0, corner.1 - place.1);
        let clear = (CLEAR / libm::hypot(across, down).max(CLEAR)).min(1.0);
        let from = (place.0 + clear * across, place.1 + clear * down);
        canvas.line(from, corner, frame);
        canvas.photograph(glass, &self.squares);
        let panel = Panel::photograph("magnifier", glass, (COLUMNS, ROWS));
        let column = |off: f64| panel.canvas_from_world((self.at.x + off, self.at.y)).0;
        let [low, high] = [column(-ERROR_PX), column(ERROR_PX)];
        canvas.clipped(glass, |canvas| {
            let band = [
                (low, glass.y),
                (high, glass.y),
                (high, glass.bottom()),
                (low, glass.bottom()),
            ];
            canvas.polygon(&band, UNCERTAIN, 0.35);
            for x in [low, high] {
                let edge = Stroke::solid(UNCERTAIN, 2.0).cased();
                canvas.line((x, glass.y), (x, glass.bottom()), edge);
            }
            let (role, shape) = CAMERAS[1];
            let middle = panel.place_of(&self.at);
            canvas.marker(middle, 3.0, shape, role, true);
        });
        canvas.stroke_rect(glass, frame);
        let style = TextStyle::new(UNCERTAIN, TEXT).cased();
        let below = (((low + high) / 2.0, glass.bottom() + 12.0), Align::Middle);
        Labels::new(photograph.inset(2.0)).draw(canvas, &[below], "±1 px", style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn the_pixel_is_in_the_middle_or_where_the_border_leaves_it() {
        let photograph = RgbImage::from_fn(40, 30, |u, v| Rgb([u as u8, v as u8, 0]));
        let seen = |u, v| {
            let magnifier = Magnifier::over(&photograph, &Point2::new(u, v))?;
            let inside = |at: f64| at.round() as u32 * SQUARE + SQUARE / 2;
            let Rgb([u, v, _]) =
                *(magnifier.squares).get_pixel(inside(magnifier.at.x), inside(magnifier.at.y));
            Some((magnifier.at, (u, v)))
        };
        assert_eq!(seen(20.0, 15.0), Some((Point2::new(8.0, 5.0), (20, 15))));
        assert_eq!(seen(39.25, 0.0), Some((Point2::new(16.25, 0.0), (39, 0))));
        assert_eq!(seen(0.25, 29.25), Some((Point2::new(0.25, 10.25), (0, 29))));
        for (u, v) in [(-1.0, 5.0), (40.0, 5.0), (5.0, 29.6), (f64::NAN, 5.0)] {
            assert_eq!(seen(u, v), None);
        }
    }
}
