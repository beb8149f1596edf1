//! Color maps of numbers: cached maps, stripes for missing values, and the color bar.

use crate::canvas::{Canvas, Stroke, TextStyle, text_width};
use crate::contract::Rect;
use crate::theme::{Rgb, Role, Theme, mix};
use image::RgbImage;

/// Period of the stripes, pixels.
const STRIPE_PX: u32 = 6;
/// Number of steps of a color bar.
const NUM_STEPS: u32 = 40;
/// Size of a legend's text and swatches, CSS pixels.
const TEXT: f64 = 12.0;
const SWATCH: f64 = 14.0;

/// Cached color maps of one result.
pub(crate) struct Heat<const N: usize = 1> {
    kept: Option<(u64, Theme, [RgbImage; N])>,
}

impl<const N: usize> Default for Heat<N> {
    fn default() -> Self {
        Self { kept: None }
    }
}

impl<const N: usize> Heat<N> {
    /// Returns the maps for this version and theme, calling `color` only if they are not cached.
    pub(crate) fn maps(
        &mut self,
        version: u64,
        theme: Theme,
        color: impl FnOnce() -> [RgbImage; N],
    ) -> &[RgbImage; N] {
        let fresh = self.kept.take();
        let fresh = fresh.filter(|(v, t, _)| (*v, *t) == (version, theme));
        let kept = fresh.unwrap_or_else(|| (version, theme, color()));
        &self.kept.insert(kept).2
    }
}

/// Returns whether a pixel is in a stripe.
pub(crate) fn is_stripe(u: u32, v: u32) -> bool {
    (u + v) % STRIPE_PX < STRIPE_PX / 2
}

/// Returns the color of a missing value at a pixel.
pub(crate) fn nothing(theme: Theme, u: u32, v: u32) -> Rgb {
    let role = if is_stripe(u, v) {
        Role::Surface
    } else {
        Role::Edge
    };
    theme.color(role)
}

/// Colors of signed numbers: warm for positive, cool for negative ones.
pub(crate) struct Signed {
    zero: Rgb,
    warm: Rgb,
    cool: Rgb,
}

impl Signed {
    pub(crate) fn of(theme: Theme) -> Self {
        let [zero, warm, cool] =
            [Role::Surface, Role::Outlier, Role::Candidate].map(|role| theme.color(role));
        Self { zero, warm, cool }
    }

    /// * `share`: saturation, 0 to 1
    pub(crate) fn color(&self, is_negative: bool, share: f32) -> Rgb {
        let full = if is_negative { self.cool } else { self.warm };
        mix(self.zero, full, share)
    }

    /// Returns the color at a pixel of a map whose negative parts are also striped.
    ///
    /// * `faint`: fraction of the saturation between the stripes, 0 to 1
    pub(crate) fn at(&self, (u, v): (u32, u32), is_negative: bool, share: f32, faint: f32) -> Rgb {
        let left = if is_negative && is_stripe(u, v) {
            faint
        } else {
            1.0
        };
        self.color(is_negative, left * share)
    }
}

/// Draws a color bar from 0 to 1 with labels at its ends.
pub(crate) fn bar(
    canvas: &mut Canvas,
    rect: Rect,
    ends: [&str; 2],
    color: impl Fn(Theme, f64) -> Rgb,
) {
    let theme = canvas.theme();
    for step in 0..NUM_STEPS {
        let x = |at: u32| rect.x + rect.width * f64::from(at) / f64::from(NUM_STEPS);
        let piece = Rect::new(x(step), rect.y, x(step + 1) - x(step), rect.height);
        let share = (f64::from(step) + 0.5) / f64::from(NUM_STEPS);
        canvas.fill_color(piece, color(theme, share));
    }
    canvas.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
    let style = TextStyle::new(Role::Ink, TEXT);
    let y = rect.bottom() + TEXT;
    canvas.label((rect.x, y), ends[0], style);
    canvas.label((rect.right(), y), ends[1], style.end());
}

/// Fill of a legend's swatch.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Fill {
    /// A role's color with an opacity.
    Role(Role, f64),
    /// Stripes, for a missing value.
    Stripes,
}

/// Draws labeled swatches in a row at intervals of `apart` CSS pixels; the position is the middle
/// of the left edge.
pub(crate) fn swatches(
    canvas: &mut Canvas,
    (mut x, y): (f64, f64),
    apart: f64,
    entries: &[(Fill, &str)],
) {
    for (fill, words) in entries {
        swatch(canvas, (x, y), *fill, words);
        x += SWATCH + apart + text_width(words, TEXT);
    }
}

/// Draws a labeled swatch; the position is the middle of its left edge.
pub(crate) fn swatch(canvas: &mut Canvas, (x, y): (f64, f64), fill: Fill, words: &str) {
    let rect = Rect::new(x, y - SWATCH / 2.0, SWATCH, SWATCH);
    match fill {
        Fill::Role(role, opacity) => canvas.fill_rect(rect, role, opacity),
        Fill::Stripes => {
            canvas.fill_rect(rect, Role::Surface, 1.0);
            for index in 0..4 {
                let stripe = Rect::new(x + 4.0 * f64::from(index), rect.y, 2.0, SWATCH);
                canvas.fill_rect(stripe, Role::Edge, 1.0);
            }
        }
    }
    canvas.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
    let place = (x + SWATCH + 5.0, y);
    canvas.label(place, words, TextStyle::new(Role::Ink, TEXT));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_colored_once_for_each_version_and_theme() {
        let mut heat = Heat::<1>::default();
        let mut count = 0;
        for (version, theme) in [
            (1, Theme::Light),
            (1, Theme::Light),
            (2, Theme::Light),
            (2, Theme::Dark),
            (2, Theme::Dark),
        ] {
            heat.maps(version, theme, || {
                count += 1;
                [RgbImage::new(2, 2)]
            });
        }
        assert_eq!(count, 3);
    }

    #[test]
    fn signs_differ_in_hue_and_negative_numbers_have_stripes() {
        let colors = Signed::of(Theme::Light);
        assert_eq!(colors.color(false, 0.0), colors.color(true, 0.0));
        assert_ne!(colors.color(false, 1.0), colors.color(true, 1.0));
        let row = |is_negative| [0, 3].map(|u| colors.at((u, 0), is_negative, 1.0, 0.5));
        assert_eq!(row(false), [colors.color(false, 1.0); 2]);
        assert_eq!(row(true), [0.5, 1.0].map(|share| colors.color(true, share)));
    }

    #[test]
    fn stripes_differ() {
        let colors: Vec<Rgb> = (0..6).map(|u| nothing(Theme::Light, u, 0)).collect();
        assert_eq!(colors[0], colors[2]);
        assert_ne!(colors[0], colors[3]);
    }
}
