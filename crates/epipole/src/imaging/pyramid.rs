//! Gaussian and Laplacian pyramids.

use super::gray::from_vec;
use super::kernel::Kernel;
use super::separable::Ring;
use super::{Border, GrayImage32};

/// Binomial weights 1 4 6 4 1, divided by sixteen.
const BINOMIAL: [f32; 5] = [1.0 / 16.0, 0.25, 0.375, 0.25, 1.0 / 16.0];

/// Halves the image: blurs by the binomial kernel `[1 4 6 4 1]/16` in both directions and keeps
/// every second pixel, `⌈w/2⌉ × ⌈h/2⌉`. Pixel u of the result is at 2u of the image.
///
/// Source: Burt & Adelson 1983, "The Laplacian pyramid as a compact image code", §2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, pyramid_down};
/// let impulse = gray_from_values(5, 1, vec![0.0, 0.0, 16.0, 0.0, 0.0])?;
/// let half = pyramid_down(&impulse, Border::Reflect101);
/// assert_eq!(half.as_raw(), &[2.0, 6.0, 2.0]); // the mirror doubles the ends
/// # Ok(()) }
/// ```
pub fn pyramid_down(image: &GrayImage32, border: Border) -> GrayImage32 {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (half_width, half_height) = (width.div_ceil(2), height.div_ceil(2));
    let mut values = Vec::with_capacity(half_width * half_height);
    let (mut edge, mut row) = (Vec::new(), vec![0.0; width]);
    let (mut ring, kernel) = (Ring::new(5, width), Kernel::new(&BINOMIAL));
    for y in 0..half_height {
        let newest = 2 * y as isize + 2;
        let first = if y == 0 { newest - 4 } else { newest - 1 };
        for j in first..=newest {
            let source = border.index(j, height);
            let source = source.map(|m| &image.as_raw()[m * width..(m + 1) * width]);
            kernel.along(source, border, &mut edge, ring.push());
        }
        kernel.across(ring.rows(), 0, &mut row);
        values.extend(row.iter().step_by(2));
    }
    from_vec(half_width as u32, half_height as u32, values)
}

/// Doubles an image to the given size: moves pixels to even positions, then blurs by twice the
/// binomial kernel in both directions. The first sample is mirrored, the last repeated, as in
/// OpenCV's `pyrUp`.
///
/// * `width`, `height`: size of the result; each twice that of the image, or one less
///
/// For any other size the result is shifted; there is no panic.
///
/// Source: Burt & Adelson 1983, §3 (EXPAND).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{gray_from_values, pyramid_up};
/// let image = gray_from_values(2, 1, vec![0.0, 8.0])?;
/// assert_eq!(pyramid_up(&image, 3, 1).as_raw(), &[2.0, 4.0, 7.0]);
/// # Ok(()) }
/// ```
pub fn pyramid_up(image: &GrayImage32, width: u32, height: u32) -> GrayImage32 {
    let (w, h) = (image.width() as usize, image.height() as usize);
    let (width, height) = (width as usize, height as usize);
    if w == 0 || h == 0 {
        return GrayImage32::new(width as u32, height as u32);
    }
    let tap = |k: isize, small: usize| {
        let mirrored = if k < 0 { 1 } else { k as usize };
        mirrored.min(small - 1)
    };
    let expand = |at: usize, small: usize| {
        let k = (at / 2) as isize;
        if at.is_multiple_of(2) {
            let taps = [tap(k - 1, small), tap(k, small), tap(k + 1, small)];
            (taps, [0.125f32, 0.75, 0.125])
        } else {
            let taps = [tap(k, small), tap(k + 1, small), 0];
            (taps, [0.5, 0.5, 0.0])
        }
    };
    let columns: Vec<_> = (0..width).map(|u| expand(u, w)).collect();
    let mut values = Vec::with_capacity(width * height);
    let mut row = vec![0.0; w];
    for v in 0..height {
        let (taps, weights) = expand(v, h);
        let source = |k: usize| &image.as_raw()[taps[k] * w..(taps[k] + 1) * w];
        let (a, b, c) = (source(0), source(1), source(2));
        for x in 0..w {
            row[x] = weights[0] * a[x] + weights[1] * b[x] + weights[2] * c[x];
        }
        values.extend(columns.iter().map(|(taps, weights)| {
            weights[0] * row[taps[0]] + weights[1] * row[taps[1]] + weights[2] * row[taps[2]]
        }));
    }
    from_vec(width as u32, height as u32, values)
}

/// Returns the image and its halves by [`pyramid_down`], largest first, at most `num_levels`; stops
/// early at a single pixel.
///
/// ```
/// use epipole::imaging::{GrayImage32, gaussian_pyramid};
/// let sizes: Vec<_> = gaussian_pyramid(&GrayImage32::new(9, 4), 3)
///     .iter()
///     .map(|level| level.dimensions())
///     .collect();
/// assert_eq!(sizes, [(9, 4), (5, 2), (3, 1)]);
/// ```
pub fn gaussian_pyramid(image: &GrayImage32, num_levels: usize) -> Vec<GrayImage32> {
    let mut levels: Vec<GrayImage32> = Vec::new();
    while levels.len() < num_levels {
        let next = match levels.last() {
            None => image.clone(),
            Some(last) if last.width().max(last.height()) <= 1 => break,
            Some(last) => pyramid_down(last, Border::Reflect101),
        };
        levels.push(next);
    }
    levels
}

/// Computes the Laplacian pyramid: the differences between each Gaussian level and the upsampled
/// next one, `Lₖ = Gₖ − up(Gₖ₊₁)`, and finally the smallest Gaussian level.
/// [`from_laplacian_pyramid`] inverts it.
///
/// Source: Burt & Adelson 1983, §3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{from_laplacian_pyramid, gray_from_values, laplacian_pyramid};
/// let image = gray_from_values(4, 1, vec![0.0, 1.0, 4.0, 2.0])?;
/// let back = from_laplacian_pyramid(&laplacian_pyramid(&image, 3));
/// assert!(back.as_raw().iter().zip(image.as_raw()).all(|(a, b)| (a - b).abs() < 1e-6));
/// # Ok(()) }
/// ```
pub fn laplacian_pyramid(image: &GrayImage32, num_levels: usize) -> Vec<GrayImage32> {
    let mut levels = gaussian_pyramid(image, num_levels);
    for k in 1..levels.len() {
        let (head, tail) = levels.split_at_mut(k);
        let level = &mut head[k - 1];
        let coarse = pyramid_up(&tail[0], level.width(), level.height());
        for (value, coarse) in level.as_mut().iter_mut().zip(coarse.as_raw()) {
            *value -= coarse;
        }
    }
    levels
}

/// Reconstructs the image of a Laplacian pyramid; an empty image for no levels.
///
/// ```
/// use epipole::imaging::from_laplacian_pyramid;
/// assert_eq!(from_laplacian_pyramid(&[]).dimensions(), (0, 0));
/// ```
pub fn from_laplacian_pyramid(levels: &[GrayImage32]) -> GrayImage32 {
    let mut levels = levels.iter().rev();
    let mut image = levels.next().cloned().unwrap_or_default();
    for level in levels {
        image = pyramid_up(&image, level.width(), level.height());
        for (value, detail) in image.as_mut().iter_mut().zip(level.as_raw()) {
            *value += detail;
        }
    }
    image
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn levels_equal_opencv() {
        let image = fixture::gray32("texture.npy");
        let down = pyramid_down(&image, Border::Reflect101);
        fixture::assert_close(&down, &fixture::gray32("pyr_down.npy"), 1e-6, "down");
        let twice = pyramid_down(&down, Border::Reflect101);
        fixture::assert_close(
            &twice,
            &fixture::gray32("pyr_down2.npy"),
            1e-6,
            "down twice",
        );
        let up = pyramid_up(&down, image.width(), image.height());
        fixture::assert_close(&up, &fixture::gray32("pyr_up.npy"), 1e-6, "up");
    }

    #[test]
    fn every_size_comes_back() {
        for (w, h) in [(1, 1), (1, 5), (2, 2), (13, 8), (0, 0)] {
            let image = GrayImage32::from_fn(w, h, |u, v| image::Luma([(u * 3 + v * v) as f32]));
            let levels = laplacian_pyramid(&image, 9);
            let back = from_laplacian_pyramid(&levels);
            assert_eq!(back.dimensions(), (w, h));
            for (a, b) in back.as_raw().iter().zip(image.as_raw()) {
                assert!((a - b).abs() < 1e-4);
            }
        }
        assert!(gaussian_pyramid(&GrayImage32::new(3, 3), 0).is_empty());
    }
}
