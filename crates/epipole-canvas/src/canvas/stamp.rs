//! Small shapes that are covered once and then only blended: glyphs and markers.

use super::coverage::{AT_ONCE, Ink};
use crate::theme::Rgb;
use tiny_skia::Pixmap;

/// Steps of a place within a pixel.
pub(super) const STEPS: i32 = 4;

/// The pixel of a place and its step within, the place moved to the nearest step.
pub(super) fn pixel_and_step(at: f64) -> (i32, u8) {
    let steps = (at * f64::from(STEPS)).round() as i32;
    (steps.div_euclid(STEPS), steps.rem_euclid(STEPS) as u8)
}

/// Stamps kept before all are forgotten: a page that is zoomed needs new ones each time.
const MOST_KEPT: usize = 2048;

/// Stamps in the order of their keys: in a list, because a page would download a map's code for each kind of key. What
/// is kept changes no pixel: a stamp is the same whenever it is made.
pub(super) struct Kept<K>(Vec<(K, Stamp)>);

impl<K: Copy + Ord> Kept<K> {
    pub(super) const fn new() -> Self {
        Self(Vec::new())
    }

    /// The stamp of a key, made if it is not there.
    pub(super) fn stamp(&mut self, key: K, make: impl FnOnce(K) -> Stamp) -> &Stamp {
        if self.0.len() > MOST_KEPT {
            self.forget();
        }
        let place = match self.0.binary_search_by(|(kept, _)| kept.cmp(&key)) {
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

/// How broad a stamp is made for a shape of this width: its rows are blended without anything left over.
pub(super) fn stamp_width(width: usize) -> usize {
    width.next_multiple_of(AT_ONCE)
}

/// How much of each pixel a shape covers.
#[derive(Default)]
pub(super) struct Stamp {
    /// Where the first column is, from the shape's place, pixels.
    pub(super) left: i32,
    /// Where the first row is.
    pub(super) top: i32,
    pub(super) width: usize,
    /// Rows of `width` pixels, 0 to 255.
    pub(super) alpha: Vec<u8>,
}

impl Stamp {
    /// Blends a color where the shape covers the picture.
    pub(super) fn blend(&self, pixmap: &mut Pixmap, (x, y): (i32, i32), color: Rgb) {
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
        let ink = Ink::new(color);
        for (row, alphas) in self.alpha.chunks_exact(self.width).enumerate() {
            let row = top + row as i64;
            if !(0..height).contains(&row) {
                continue;
            }
            let start = ((row * width + left + from) * 4) as usize;
            let alphas = &alphas[from as usize..to as usize];
            ink.blend_row(&mut data[start..][..alphas.len() * 4], alphas);
        }
    }
}
