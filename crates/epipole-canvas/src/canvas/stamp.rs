//! Small shapes with cached coverage: glyphs and markers.

use super::coverage::{AT_ONCE, Ink};
use crate::theme::Rgb;
use std::ops::Range;
use tiny_skia::Pixmap;

/// Subpixel steps along each axis.
pub(super) const STEPS: i32 = 4;

/// Returns the pixel of a position and its subpixel step, rounded to the nearest.
pub(super) fn pixel_and_step(at: f64) -> (i32, u8) {
    let steps = (at * f64::from(STEPS)).round() as i32;
    (steps.div_euclid(STEPS), steps.rem_euclid(STEPS) as u8)
}

/// Maximum number of stamps, at which the cache is cleared: each zoom level of a page needs new
/// ones.
const MAX_CACHED: usize = 2048;

/// Stamps sorted by key. A sorted list, since a map would add code to the download for every key
/// type. Equal keys give equal stamps, so caching does not affect any pixel.
pub(super) struct StampCache<K>(Vec<(K, Stamp)>);

impl<K: Copy + Ord> StampCache<K> {
    pub(super) const fn new() -> Self {
        Self(Vec::new())
    }

    /// Returns the stamp of a key, created on the first call.
    pub(super) fn stamp(&mut self, key: K, make: impl FnOnce(K) -> Stamp) -> &Stamp {
        if self.0.len() > MAX_CACHED {
            self.forget();
        }
        let place = match self.0.binary_search_by(|(cached, _)| cached.cmp(&key)) {
            Ok(place) => place,
            Err(place) => {
                self.0.insert(place, (key, make(key)));
                place
            }
        };
        &self.0[place].1
    }

    pub(super) fn forget(&mut self) {
        self.0.clear();
    }
}

/// Rounds the width of a stamp up to whole vectors, so that blending has no remainder.
pub(super) fn stamp_width(width: usize) -> usize {
    width.next_multiple_of(AT_ONCE)
}

/// Coverage of each pixel by a shape.
#[derive(Default)]
pub(super) struct Stamp {
    /// First column relative to the shape's position, pixels.
    pub(super) left: i32,
    /// First row relative to the shape's position, pixels.
    pub(super) top: i32,
    pub(super) width: usize,
    /// Coverage in rows of `width` pixels, 0 to 255.
    pub(super) alpha: Vec<u8>,
    /// Coverage of the shape on top; empty without one.
    pub(super) over: Vec<u8>,
}

impl Stamp {
    /// Creates a stamp without uncovered rows and columns at the border.
    ///
    /// * `left`, `top`: first column and row relative to the shape's position
    /// * `alpha`: coverage in rows of `width` pixels
    pub(super) fn trimmed((left, top): (i32, i32), width: usize, alpha: &[u8]) -> Self {
        let is_covered = |alphas: &[u8]| alphas.iter().any(|&alpha| alpha != 0);
        let rows: Vec<&[u8]> = alpha.chunks_exact(width.max(1)).collect();
        let columns = |column: &usize| rows.iter().any(|row| row[*column] != 0);
        let first_row = rows.iter().position(|row| is_covered(row));
        let last_row = rows.iter().rposition(|row| is_covered(row));
        let (first, last) = ((0..width).find(columns), (0..width).rev().find(columns));
        let (Some(first_row), Some(last_row), Some(first), Some(last)) =
            (first_row, last_row, first, last)
        else {
            return Self::default();
        };
        let stride = stamp_width(last + 1 - first);
        let mut alpha = vec![0; stride * (last_row + 1 - first_row)];
        for (target, row) in alpha.chunks_exact_mut(stride).zip(&rows[first_row..]) {
            target[..=last - first].copy_from_slice(&row[first..=last]);
        }
        Self {
            left: left + first as i32,
            top: top + first_row as i32,
            width: stride,
            alpha,
            over: Vec::new(),
        }
    }

    /// Puts another shape of the same position on top, clipped to this shape's rows and columns.
    pub(super) fn bearing(mut self, other: &Self) -> Self {
        self.over = vec![0; self.alpha.len()];
        if self.width == 0 || other.width == 0 {
            return self;
        }
        let (own, others) = (
            self.over.chunks_exact_mut(self.width),
            other.alpha.chunks_exact(other.width),
        );
        let right = (other.left - self.left).max(0) as usize;
        let down = (other.top - self.top).max(0) as usize;
        for (own, other) in own.skip(down).zip(others) {
            let own = &mut own[right.min(self.width)..];
            let count = own.len().min(other.len());
            own[..count].copy_from_slice(&other[..count]);
        }
        self
    }

    /// Blends a color by the coverage.
    pub(super) fn blend(&self, pixmap: &mut Pixmap, at: (i32, i32), color: Rgb) {
        let ink = Ink::new(color);
        self.rows(pixmap, at, |pixels, places| {
            ink.blend_row(pixels, &self.alpha[places]);
        });
    }

    /// Blends a color by the coverage, and another one over it by that of the shape on top.
    pub(super) fn blend_both(&self, pixmap: &mut Pixmap, at: (i32, i32), colors: [Rgb; 2]) {
        let [under, over] = colors.map(Ink::new);
        self.rows(pixmap, at, |pixels, places| {
            let (alphas, alphas_over) = (&self.alpha[places.clone()], &self.over[places]);
            under.blend_row_under(&over, pixels, alphas, alphas_over);
        });
    }

    /// Iterates over the visible part of each row: its bytes in the picture, and its range in the
    /// stamp.
    #[inline(always)]
    fn rows(
        &self,
        pixmap: &mut Pixmap,
        (x, y): (i32, i32),
        mut draw: impl FnMut(&mut [u8], Range<usize>),
    ) {
        if self.width == 0 {
            return;
        }
        let (width, height) = (i64::from(pixmap.width()), i64::from(pixmap.height()));
        let left = i64::from(x) + i64::from(self.left);
        let top = i64::from(y) + i64::from(self.top);
        let from = (-left).clamp(0, self.width as i64);
        let to = (width - left).clamp(from, self.width as i64);
        if from == to {
            return;
        }
        let data = pixmap.data_mut();
        for (index, first) in (0..self.alpha.len()).step_by(self.width).enumerate() {
            let row = top + index as i64;
            if !(0..height).contains(&row) {
                continue;
            }
            let start = ((row * width + left + from) * 4) as usize;
            let places = first + from as usize..first + to as usize;
            draw(&mut data[start..][..places.len() * 4], places);
        }
    }
}
