//! Downscaling of a pair to limit its cells.

/// Maximum number of cells, pixels times disparities; larger pairs are halved. The core admits
/// twice as many on 32-bit systems, but a cell takes two bytes, and the photographs need memory as
/// well.
const MAX_CELLS: u64 = 1 << 27;
/// Maximum number of disparities in the core.
const MAX_DISPARITIES: i64 = 4096;

/// Returns the size that both photographs of a pair are resized to: a pixel spans the same angle as
/// one of the coarser photograph, and no side is downscaled further. If the shapes differ, a side
/// of each is stretched, which is harmless, as rectification resamples along rays.
pub(super) fn common_size(sizes: [[u32; 2]; 2], focals_px: [f64; 2]) -> [u32; 2] {
    if sizes[0] == sizes[1] {
        return sizes[0];
    }
    let coarser_px = focals_px[0].min(focals_px[1]);
    let side = |axis: usize, index: usize| {
        let side = f64::from(sizes[index][axis]) * coarser_px / focals_px[index];
        (side.round() as u32).max(1)
    };
    [0, 1].map(|axis| side(axis, 0).max(side(axis, 1)))
}

/// Returns the factor by which width and height are divided: 1, 2, 4 and so on.
pub(super) fn reduced_factor(size: [u32; 2], range_px: [i32; 2]) -> u32 {
    let mut factor = 1;
    loop {
        let [width, height] = size.map(|side| u64::from((side / factor).max(1)));
        let (_, count) = span(range_px, factor);
        let cells = width * height * u64::from(count.next_multiple_of(16));
        if cells <= MAX_CELLS || width.min(height) < 2 {
            return factor;
        }
        factor *= 2;
    }
}

/// Returns the smallest disparity and the number of disparities, in images downscaled by `factor`.
pub(super) fn span(range_px: [i32; 2], factor: u32) -> (i32, u32) {
    let [low, high] = range_px.map(i64::from);
    let factor = i64::from(factor.max(1));
    let first = low.div_euclid(factor);
    let last = (high + factor - 1).div_euclid(factor);
    let count = (last - first + 1).clamp(1, MAX_DISPARITIES);
    // Division keeps the values within an i32.
    (first as i32, count as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_pairs_are_halved_until_they_fit() {
        assert_eq!(reduced_factor([480, 360], [0, 63]), 1);
        // 3 megapixels and 64 disparities: 192 million cells.
        assert_eq!(reduced_factor([2000, 1500], [0, 63]), 2);
        assert_eq!(reduced_factor([4000, 3000], [0, 511]), 4);
        assert_eq!(reduced_factor([1, 1], [0, i32::MAX - 9]), 1);
    }

    #[test]
    fn two_sizes_meet_where_pixels_span_the_same() {
        assert_eq!(common_size([[480, 360]; 2], [500.0, 900.0]), [480, 360]);
        // The second has half the resolution and portrait format.
        let fine = common_size([[960, 720], [480, 360]], [1000.0, 500.0]);
        assert_eq!(fine, [480, 360]);
        let upright = common_size([[480, 360], [360, 480]], [500.0, 500.0]);
        assert_eq!(upright, [480, 480]);
    }

    #[test]
    fn a_range_of_smaller_pictures_holds_all_of_it() {
        assert_eq!(span([10, 21], 1), (10, 12));
        assert_eq!(span([11, 21], 2), (5, 7));
        assert_eq!(span([-7, -3], 2), (-4, 4));
        assert_eq!(span([5, 5], 4), (1, 2));
        assert_eq!(span([9, 3], 1), (9, 1));
        assert_eq!(span([i32::MIN, i32::MAX], 1), (i32::MIN, 4096));
    }
}
