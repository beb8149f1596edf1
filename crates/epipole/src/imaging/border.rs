//! Values of an image beyond its border.

use super::GrayImage32;

/// Border handling: the value of pixels outside the image.
///
/// ```
/// use epipole::imaging::Border;
/// // The row  a b c d  seen two pixels beyond its left end.
/// assert_eq!(Border::Replicate.index(-2, 4), Some(0)); // a a|a b c d
/// assert_eq!(Border::Reflect101.index(-2, 4), Some(2)); // c b|a b c d
/// assert_eq!(Border::Constant(0.5).index(-2, 4), None); // .5 .5|a b c d
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Border {
    /// Repeats the border pixel: `aaa|abcd|ddd`.
    Replicate,
    /// Mirrors about the border pixel, which appears once: `dcb|abcd|cba`. OpenCV's default.
    #[default]
    Reflect101,
    /// A constant value, in the image's own units.
    Constant(f32),
}

impl Border {
    /// Maps `index` to an index in `0..len`, or `None` for a constant border or an empty row.
    pub fn index(self, index: isize, len: usize) -> Option<usize> {
        if len == 0 {
            return None;
        }
        let last = len as isize - 1;
        if (0..=last).contains(&index) {
            return Some(index as usize);
        }
        match self {
            Self::Constant(_) => None,
            Self::Replicate => Some(index.clamp(0, last) as usize),
            Self::Reflect101 => {
                if last == 0 {
                    return Some(0);
                }
                let folded = index.rem_euclid(2 * last);
                Some(folded.min(2 * last - folded) as usize)
            }
        }
    }

    /// Returns the value at column `u`, row `v`, also outside the image; 0 for an image without
    /// pixels, unless the border is constant.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::imaging::{Border, gray_from_values};
    /// let image = gray_from_values(3, 1, vec![7.0, 8.0, 9.0])?;
    /// assert_eq!(Border::Replicate.value(&image, -1, 0), 7.0);
    /// assert_eq!(Border::Reflect101.value(&image, 3, 5), 8.0);
    /// assert_eq!(Border::Constant(0.0).value(&image, 1, -1), 0.0);
    /// # Ok(()) }
    /// ```
    pub fn value(self, image: &GrayImage32, u: isize, v: isize) -> f32 {
        let (width, height) = (image.width() as usize, image.height() as usize);
        match (self.index(u, width), self.index(v, height)) {
            (Some(u), Some(v)) => image.as_raw()[v * width + u],
            _ => self.constant(),
        }
    }

    /// Returns the constant, or zero for other borders.
    pub(crate) fn constant(self) -> f32 {
        match self {
            Self::Constant(value) => value,
            Self::Replicate | Self::Reflect101 => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reflection_wider_than_the_row_folds_back_and_forth() {
        let indices: Vec<usize> = (-5..8)
            .map(|i| Border::Reflect101.index(i, 3).unwrap())
            .collect();
        assert_eq!(indices, [1, 0, 1, 2, 1, 0, 1, 2, 1, 0, 1, 2, 1]);
    }

    #[test]
    fn one_pixel_and_none() {
        for border in [Border::Replicate, Border::Reflect101] {
            assert_eq!(border.index(-9, 1), Some(0));
            assert_eq!(border.index(4, 1), Some(0));
            assert_eq!(border.index(0, 0), None);
        }
    }
}
