//! Search for the marks of a board from their neighbors.

use super::board_markers::{BoardMarkers, MarkerInsets};
use super::crossing::{InsetSide, Insets};
use super::refine_mark::{Reach, refine_mark};
use super::{Board, BoardView};
use crate::Result;
use crate::homography::{fit_homography, transfer};
use crate::imaging::{Border, GrayImage32, sample_bilinear};
use nalgebra::{Matrix3, Point2, Vector2};

/// Maximum distance of neighbors that predict a mark, along rows and columns.
const NEIGHBORHOOD: usize = 3;
/// Number of neighbors that predict a mark.
const NEIGHBORS: core::ops::RangeInclusive<usize> = 5..=10;
/// Maximum distance of a mark from its prediction: this many pixels, and this many times the median
/// of all marks, as lenses bend rows and extrapolation adds errors.
const MOST_STRAYED: (f64, f64) = (0.3, 8.0);
/// Minimum difference of bright and dark around a mark, of a range of 1.
const LEAST_CONTRAST: f64 = 0.04;
/// Distance at which the quadrants are compared, relative to the nearest other edge.
const COLORS_AT: f64 = 0.5;
const LEAST_COLORS_AT_PX: f64 = 2.0;
/// Maximum difference of opposite quadrants, relative to the contrast.
const MOST_UNEVEN: f64 = 0.6;

/// Marks found so far.
pub(super) struct GrownMarks<'a> {
    image: &'a GrayImage32,
    board: &'a Board,
    /// Reach relative to a square.
    reach: Reach,
    /// Distance from a mark to the nearest edge other than its own two, squares.
    clear: f64,
    insets: Option<MarkerInsets>,
    pixels: Vec<Option<Point2<f64>>>,
}

impl<'a> GrownMarks<'a> {
    pub(super) fn new(image: &'a GrayImage32, board: &'a Board, markers: &BoardMarkers) -> Self {
        Self {
            image,
            board,
            reach: Reach::within(
                markers.clear,
                (markers.insets).map_or(markers.clear, |insets| insets.clear),
            ),
            clear: markers.clear,
            insets: markers.insets,
            pixels: vec![None; board.num_marks()],
        }
    }

    /// Searches for a mark at the position predicted by a homography.
    pub(super) fn add(&mut self, mark: usize, pixel_from_square: &Matrix3<f64>) -> Result<bool> {
        self.pixels[mark] = self.at(mark, pixel_from_square)?;
        Ok(self.pixels[mark].is_some())
    }

    /// Searches for the other marks from those found, and drops those that do not fit.
    pub(super) fn grow(&mut self) -> Result<()> {
        self.drop_strays();
        for _ in 0..self.board.columns().max(self.board.rows()) {
            let mut is_done = true;
            for mark in 0..self.pixels.len() {
                if self.pixels[mark].is_none()
                    && let Some(pixel_from_square) = self.around(mark)
                {
                    is_done &= !self.add(mark, &pixel_from_square)?;
                }
            }
            if is_done {
                break;
            }
        }
        self.drop_strays();
        Ok(())
    }

    pub(super) fn into_view(self) -> BoardView {
        BoardView {
            pixels: self.pixels,
        }
    }

    fn at(&self, mark: usize, pixel_from_square: &Matrix3<f64>) -> Result<Option<Point2<f64>>> {
        let Some((pixel, steps)) = self.predicted(mark, pixel_from_square) else {
            return Ok(None);
        };
        let spacing = steps[0].norm().min(steps[1].norm());
        let insets = self.insets.and_then(|insets| {
            self.insets_at(mark, insets.margin, pixel_from_square, &pixel, &steps)
        });
        let refined = refine_mark(self.image, &pixel, steps, spacing, &self.reach, insets)?;
        let radius_px = (COLORS_AT * self.clear * spacing).max(LEAST_COLORS_AT_PX);
        Ok(refined.filter(|pixel| self.has_right_colors(mark, pixel, &steps, radius_px)))
    }

    /// Predicts the insets in the two bright quadrants at a mark.
    fn insets_at(
        &self,
        mark: usize,
        margin: f64,
        pixel_from_square: &Matrix3<f64>,
        pixel: &Point2<f64>,
        steps: &[Vector2<f64>; 2],
    ) -> Option<Insets> {
        let place = self.board.mark_in_squares(mark);
        let directions = steps.map(|step| step.normalize());
        let from_mark = |p: &Point2<f64>| Some(transfer(pixel_from_square, p)? - pixel);
        let inset = |towards: Vector2<f64>| {
            let corner = place + margin * towards;
            let nearest = from_mark(&corner)?;
            let side = |axis: usize| {
                let mut next = corner;
                next[axis] += margin * towards[axis];
                let ends = [nearest, from_mark(&next)?];
                let along = ends.map(|end| directions[axis].dot(&end));
                let across = ends.map(|end| directions[axis].perp(&end));
                let slope = (across[1] - across[0]) / (along[1] - along[0]);
                let sign = across[0].signum();
                Some(InsetSide {
                    sign,
                    offset_px: sign * (across[0] - slope * along[0]),
                    slope: sign * slope,
                })
            };
            Some([side(0)?, side(1)?])
        };
        let first = match self.is_dark_between_steps(mark) {
            true => Vector2::new(1.0, -1.0),
            false => Vector2::new(1.0, 1.0),
        };
        Some([inset(first)?, inset(-first)?])
    }

    /// Whether the quadrant between the steps along both axes is dark. Squares with an even sum of
    /// column and row are; so are the quadrants at tags.
    fn is_dark_between_steps(&self, mark: usize) -> bool {
        let columns = self.board.columns();
        (mark % columns + mark / columns).is_multiple_of(2)
    }

    /// Predicts the pixel of a mark, and that of a step of one square along the board's axes there;
    /// `None` if outside the image.
    fn predicted(
        &self,
        mark: usize,
        pixel_from_square: &Matrix3<f64>,
    ) -> Option<(Point2<f64>, [Vector2<f64>; 2])> {
        const STEP: f64 = 0.2;
        let place = self.board.mark_in_squares(mark);
        let to_pixel = |x: f64, y: f64| transfer(pixel_from_square, &(place + Vector2::new(x, y)));
        let pixel = to_pixel(0.0, 0.0)?;
        let (width, height) = self.image.dimensions();
        let is_inside = pixel.x > 0.0
            && pixel.y > 0.0
            && pixel.x < f64::from(width) - 1.0
            && pixel.y < f64::from(height) - 1.0;
        let steps = [
            (to_pixel(STEP, 0.0)? - to_pixel(-STEP, 0.0)?) / (2.0 * STEP),
            (to_pixel(0.0, STEP)? - to_pixel(0.0, -STEP)?) / (2.0 * STEP),
        ];
        is_inside.then_some((pixel, steps))
    }

    /// Returns whether the two dark quadrants agree with the board.
    fn has_right_colors(
        &self,
        mark: usize,
        pixel: &Point2<f64>,
        steps: &[Vector2<f64>; 2],
        radius_px: f64,
    ) -> bool {
        let [a, b] = steps.map(|step| step.normalize());
        let gray = |direction: Vector2<f64>| {
            let p = pixel + direction.normalize() * radius_px;
            f64::from(sample_bilinear(self.image, p.x, p.y, Border::Replicate))
        };
        let mut pairs = [[gray(a + b), gray(-a - b)], [gray(a - b), gray(b - a)]];
        if !self.is_dark_between_steps(mark) {
            pairs.swap(0, 1);
        }
        let [dark, bright] = pairs;
        let contrast = 0.5 * (bright[0] + bright[1] - dark[0] - dark[1]);
        let off = (dark[0] - dark[1]).abs().max((bright[0] - bright[1]).abs());
        contrast >= LEAST_CONTRAST && off <= MOST_UNEVEN * contrast
    }

    /// Returns the homography of the nearest marks around one, without itself.
    fn around(&self, mark: usize) -> Option<Matrix3<f64>> {
        let columns = self.board.columns();
        let (column, row) = (mark % columns, mark / columns);
        let last_row = (row + NEIGHBORHOOD).min(self.board.rows() - 1);
        let last_column = (column + NEIGHBORHOOD).min(columns - 1);
        let mut near = Vec::new();
        for j in row.saturating_sub(NEIGHBORHOOD)..=last_row {
            for i in column.saturating_sub(NEIGHBORHOOD)..=last_column {
                let other = j * columns + i;
                if let Some(pixel) = self.pixels[other]
                    && other != mark
                {
                    let far = i.abs_diff(column).pow(2) + j.abs_diff(row).pow(2);
                    near.push((far, other, pixel));
                }
            }
        }
        near.sort_by_key(|(far, other, _)| (*far, *other));
        near.truncate(*NEIGHBORS.end());
        if near.len() < *NEIGHBORS.start() {
            return None;
        }
        let squares: Vec<_> = (near.iter())
            .map(|(_, other, _)| self.board.mark_in_squares(*other))
            .collect();
        let pixels: Vec<_> = near.iter().map(|(.., pixel)| *pixel).collect();
        fit_homography(&squares, &pixels).ok()
    }

    /// Drops the mark farthest from its prediction, until all are close.
    fn drop_strays(&mut self) {
        loop {
            let strayed = |mark: usize| {
                let pixel = self.pixels[mark]?;
                let (expected, _) = self.predicted(mark, &self.around(mark)?)?;
                Some(((pixel - expected).norm(), mark))
            };
            let mut strayed: Vec<(f64, usize)> =
                (0..self.pixels.len()).filter_map(strayed).collect();
            strayed.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (floor_px, times) = MOST_STRAYED;
            let median_px = strayed.get(strayed.len() / 2).map_or(0.0, |(px, _)| *px);
            match strayed.last() {
                Some(&(px, mark)) if px > floor_px.max(times * median_px) => {
                    self.pixels[mark] = None;
                }
                _ => break,
            }
        }
    }
}
