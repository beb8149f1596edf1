//! A photograph small enough for a list of many.

use serde::{Deserialize, Serialize};

use crate::project::Blob;

/// Maximum width of a thumbnail, pixels.
#[cfg(feature = "files")]
const WIDTH: u32 = 352;

/// A small copy of a photograph, for lists of many.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Thumbnail {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Red, green, blue, row by row.
    pub rgb: Blob,
}

impl Thumbnail {
    /// Averages square blocks of a photograph.
    ///
    /// * `rgb`: red, green, blue, row by row, of a photograph with this width and height
    #[cfg(feature = "files")]
    pub(super) fn new((width, height): (u32, u32), rgb: &[u8]) -> Self {
        let factor = width.div_ceil(WIDTH).min(height).max(1);
        let (columns, rows) = (width / factor, height / factor);
        let mut pixels = Vec::with_capacity(3 * (columns * rows) as usize);
        for row in 0..rows {
            for column in 0..columns {
                let mut sum = [0_u32; 3];
                for v in row * factor..(row + 1) * factor {
                    let first = 3 * (v as usize * width as usize + (column * factor) as usize);
                    let run = rgb.get(first..first + 3 * factor as usize);
                    for rgb in run.unwrap_or_default().chunks_exact(3) {
                        for (total, value) in sum.iter_mut().zip(rgb) {
                            *total += u32::from(*value);
                        }
                    }
                }
                pixels.extend(sum.map(|total| (total / (factor * factor)) as u8));
            }
        }
        Self {
            width: columns,
            height: rows,
            rgb: pixels.into(),
        }
    }
}

#[cfg(all(test, feature = "files"))]
mod tests {
    use super::*;

    #[test]
    fn each_pixel_is_the_mean_of_a_block() {
        // Two blocks of two columns each; the odd row and further columns are dropped.
        let (width, height) = (2 * WIDTH, 3);
        let level = |u: u32, v: u32| [(u / 2 % 200) as u8, (10 * v) as u8, (u % 2 * 8) as u8];
        let pixels = (0..height).flat_map(|v| (0..width).map(move |u| level(u, v)));
        let rgb: Vec<u8> = pixels.flatten().collect();
        let small = Thumbnail::new((width, height), &rgb);
        assert_eq!((small.width, small.height), (WIDTH, 1));
        assert_eq!(small.rgb[..6], [0, 5, 4, 1, 5, 4]);
        // A small image is not changed.
        let same = Thumbnail::new((2, 1), &[1, 2, 3, 4, 5, 6]);
        assert_eq!(
            (same.width, same.height, &*same.rgb),
            (2, 1, &[1, 2, 3, 4, 5, 6][..])
        );
    }
}
