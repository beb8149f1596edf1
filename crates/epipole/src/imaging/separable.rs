//! Separable filters in row-streaming form: each row is filtered along u once, kept in a ring
//! while the kernel along v needs it, and never written to memory as an image of its own.

use super::gray::from_vec;
use super::simd::dispatched;
use super::{Border, GrayImage32};
use crate::{Error, Result};
use std::ops::Range;

/// The image correlated with the kernel `kernel_v · kernel_uᵀ`:
/// `out(u, v) = Σⱼ Σᵢ kernel_v[j] kernel_u[i] I(u + i − rᵤ, v + j − rᵥ)`.
///
/// It is a correlation: the kernels are not flipped. Sums run in a fixed order, symmetric kernels
/// folded, so that a mirrored image gives the mirrored result bit by bit.
///
/// * `kernel_u`, `kernel_v`: weights along u and v, odd numbers of them
///
/// # Errors
/// [`Error::OutOfRange`] for a kernel of even length or none, [`Error::NotFinite`] for weights
/// that are not finite.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, separable_filter};
/// let step = gray_from_values(4, 1, vec![0.0, 0.0, 1.0, 1.0])?;
/// let slope = separable_filter(&step, &[-0.5, 0.0, 0.5], &[1.0], Border::Replicate)?;
/// assert_eq!(slope.as_raw(), &[0.0, 0.5, 0.5, 0.0]);
/// # Ok(()) }
/// ```
pub fn separable_filter(
    image: &GrayImage32,
    kernel_u: &[f32],
    kernel_v: &[f32],
    border: Border,
) -> Result<GrayImage32> {
    for kernel in [kernel_u, kernel_v] {
        if kernel.len() % 2 == 0 {
            return Err(Error::OutOfRange {
                what: "the length of a filter kernel",
                requirement: "odd",
                value: kernel.len() as f64,
            });
        }
        if kernel.iter().any(|w| !w.is_finite()) {
            return Err(Error::NotFinite {
                what: "every weight of a filter kernel",
            });
        }
    }
    let [filtered] = filter(image, [(kernel_u, kernel_v)], border);
    Ok(filtered)
}

/// The image under several separable kernels, in one walk over its rows. Kernel lengths are odd.
pub(crate) fn filter<const N: usize>(
    image: &GrayImage32,
    kernels: [(&[f32], &[f32]); N],
    border: Border,
) -> [GrayImage32; N] {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut outputs = [const { Vec::new() }; N];
    for output in &mut outputs {
        *output = vec![0.0f32; width * height];
    }
    if width > 0 && height > 0 {
        in_bands(&mut outputs, width, |rows, band| {
            filter_rows(image, &kernels, border, rows, band);
        });
    }
    outputs.map(|values| from_vec(image.width(), image.height(), values))
}

/// The image under one kernel along both axes, into an image whose memory is used again.
pub(crate) fn filter_into(
    image: &GrayImage32,
    kernel: &[f32],
    border: Border,
    target: &mut GrayImage32,
) {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut outputs = [std::mem::take(target).into_raw()];
    outputs[0].resize(width * height, 0.0);
    if width > 0 && height > 0 {
        in_bands(&mut outputs, width, |rows, band| {
            filter_rows(image, &[(kernel, kernel)], border, rows, band);
        });
    }
    let [values] = outputs;
    *target = from_vec(image.width(), image.height(), values);
}

/// Splits equally large images into bands of rows and works on the bands, in parallel where the
/// feature allows. The work on a band must not depend on where bands begin.
pub(crate) fn in_bands<const N: usize, T: Send>(
    images: &mut [Vec<T>; N],
    width: usize,
    work: impl Fn(Range<usize>, [&mut [T]; N]) + Sync,
) {
    let height = images[0].len() / width;
    #[cfg(feature = "parallel")]
    {
        // Below about a quarter of a megapixel the threads cost more than they give.
        let threads = rayon::current_num_threads().min(width * height / (1 << 17));
        if threads > 1 {
            let rows_each = height.div_ceil(threads);
            let mut rest = images.each_mut().map(|image| image.as_mut_slice());
            rayon::scope(|scope| {
                for from in (0..height).step_by(rows_each) {
                    let to = (from + rows_each).min(height);
                    let mut band: [&mut [T]; N] = std::array::from_fn(|_| <&mut [T]>::default());
                    for (piece, rest) in band.iter_mut().zip(&mut rest) {
                        let (head, tail) = std::mem::take(rest).split_at_mut((to - from) * width);
                        *piece = head;
                        *rest = tail;
                    }
                    let work = &work;
                    scope.spawn(move |_| work(from..to, band));
                }
            });
            return;
        }
    }
    work(
        0..height,
        images.each_mut().map(|image| image.as_mut_slice()),
    );
}

fn filter_rows<const N: usize>(
    image: &GrayImage32,
    kernels: &[(&[f32], &[f32]); N],
    border: Border,
    rows: Range<usize>,
    band: [&mut [f32]; N],
) {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut padded = Vec::new();
    let mut rings = kernels.map(|(_, kernel_v)| Ring::new(kernel_v.len(), width));
    for y in rows.clone() {
        for (k, (kernel_u, kernel_v)) in kernels.iter().enumerate() {
            let radius = (kernel_v.len() / 2) as isize;
            let newest = y as isize + radius;
            let first = if y == rows.start {
                newest - 2 * radius
            } else {
                newest
            };
            for row in first..=newest {
                let source = border
                    .index(row, height)
                    .map(|m| &image.as_raw()[m * width..(m + 1) * width]);
                pad_row(source, width, kernel_u.len() / 2, border, &mut padded);
                filter_along_row(&padded, kernel_u, rings[k].push());
            }
            let from = (y - rows.start) * width;
            rings[k].combine(kernel_v, &mut band[k][from..from + width]);
        }
    }
}

/// A row with `radius` border pixels on both sides; `None` is a row outside the image.
pub(crate) fn pad_row(
    row: Option<&[f32]>,
    width: usize,
    radius: usize,
    border: Border,
    padded: &mut Vec<f32>,
) {
    padded.clear();
    let Some(row) = row else {
        padded.resize(width + 2 * radius, border.constant());
        return;
    };
    let beyond = |x: isize| border.index(x, width).map_or(border.constant(), |x| row[x]);
    padded.extend((0..radius).map(|x| beyond(x as isize - radius as isize)));
    padded.extend_from_slice(row);
    padded.extend((0..radius).map(|x| beyond((width + x) as isize)));
}

/// Correlates a padded row with a kernel: `out[x] = Σ kernel[k] padded[x + k]`.
pub(crate) fn filter_along_row(padded: &[f32], kernel: &[f32], out: &mut [f32]) {
    let width = out.len();
    with_slices(
        kernel.len(),
        |k| &padded[k..k + width],
        |taps| {
            weigh(taps, kernel, out);
        },
    );
}

/// The last rows of a stream, as many as the kernel along v is long.
pub(crate) struct Ring {
    rows: Vec<f32>,
    width: usize,
    length: usize,
    next: usize,
}

impl Ring {
    pub(crate) fn new(length: usize, width: usize) -> Self {
        Self {
            rows: vec![0.0; length * width],
            width,
            length,
            next: 0,
        }
    }

    /// The oldest row, to be overwritten by the newest.
    pub(crate) fn push(&mut self) -> &mut [f32] {
        let at = self.next * self.width;
        self.next = (self.next + 1) % self.length;
        &mut self.rows[at..at + self.width]
    }

    /// `out[x] = Σ kernel[k] rowₖ[x]`, oldest row first.
    pub(crate) fn combine(&self, kernel: &[f32], out: &mut [f32]) {
        let row = |k: usize| {
            let slot = self.next + k;
            let slot = if slot < self.length {
                slot
            } else {
                slot - self.length
            };
            &self.rows[slot * self.width..(slot + 1) * self.width]
        };
        with_slices(self.length, row, |taps| weigh(taps, kernel, out));
    }
}

/// Collects short lists of slices on the stack, long ones on the heap.
fn with_slices<'a>(
    count: usize,
    slice: impl Fn(usize) -> &'a [f32],
    run: impl FnOnce(&[&'a [f32]]),
) {
    let mut few = [&[] as &[f32]; 33];
    if count <= few.len() {
        for (k, tap) in few[..count].iter_mut().enumerate() {
            *tap = slice(k);
        }
        run(&few[..count]);
    } else {
        run(&Vec::from_iter((0..count).map(slice)));
    }
}

/// `out[x] = Σ weights[k] taps[k][x]`, with symmetric and antisymmetric weights folded.
fn weigh(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
    let n = weights.len();
    let mirrored = || (0..n / 2).map(|k| (weights[k], weights[n - 1 - k]));
    if mirrored().all(|(a, b)| a == b) {
        match n {
            3 => weigh_even::<1>(taps, weights, out),
            5 => weigh_even::<2>(taps, weights, out),
            7 => weigh_even::<3>(taps, weights, out),
            _ => weigh_even_any(taps, weights, out),
        }
    } else if weights[n / 2] == 0.0 && mirrored().all(|(a, b)| a == -b) {
        match n {
            3 => weigh_odd::<1>(taps, weights, out),
            5 => weigh_odd::<2>(taps, weights, out),
            _ => weigh_odd_any(taps, weights, out),
        }
    } else {
        weigh_any(taps, weights, out);
    }
}

dispatched! {
    fn weigh_even<const R: usize>(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
        even_body(taps, weights, R, out);
    }
}
dispatched! {
    fn weigh_even_any(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
        even_body(taps, weights, weights.len() / 2, out);
    }
}
dispatched! {
    fn weigh_odd<const R: usize>(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
        odd_body(taps, weights, R, out);
    }
}
dispatched! {
    fn weigh_odd_any(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
        odd_body(taps, weights, weights.len() / 2, out);
    }
}
dispatched! {
    fn weigh_any(taps: &[&[f32]], weights: &[f32], out: &mut [f32]) {
        in_blocks(out, |x, block| {
            *block = [0.0; LANES];
            for (tap, w) in taps.iter().zip(weights) {
                let tap = lanes(tap, x);
                for i in 0..LANES {
                    block[i] += w * tap[i];
                }
            }
        }, |x| {
            let mut sum = 0.0;
            for (tap, w) in taps.iter().zip(weights) {
                sum += w * tap[x];
            }
            sum
        });
    }
}

/// Pixels whose sums are kept in registers at once.
const LANES: usize = 32;

#[inline(always)]
fn lanes(slice: &[f32], from: usize) -> &[f32; LANES] {
    slice[from..from + LANES]
        .try_into()
        .expect("the slice has this length")
}

/// Fills `out` by blocks, and what is left pixel by pixel with the same operations.
#[inline(always)]
fn in_blocks(
    out: &mut [f32],
    block: impl Fn(usize, &mut [f32; LANES]),
    single: impl Fn(usize) -> f32,
) {
    let (blocks, rest) = out.as_chunks_mut::<LANES>();
    let done = blocks.len() * LANES;
    for (k, out) in blocks.iter_mut().enumerate() {
        let mut values = [0.0; LANES];
        block(k * LANES, &mut values);
        *out = values;
    }
    for (k, out) in rest.iter_mut().enumerate() {
        *out = single(done + k);
    }
}

#[inline(always)]
fn even_body(taps: &[&[f32]], weights: &[f32], r: usize, out: &mut [f32]) {
    let (taps, weights) = (&taps[..2 * r + 1], &weights[..2 * r + 1]);
    in_blocks(
        out,
        |x, block| {
            let center = lanes(taps[r], x);
            for i in 0..LANES {
                block[i] = weights[r] * center[i];
            }
            for j in 1..=r {
                let (a, b) = (lanes(taps[r - j], x), lanes(taps[r + j], x));
                let w = weights[r + j];
                for i in 0..LANES {
                    block[i] += w * (a[i] + b[i]);
                }
            }
        },
        |x| {
            let mut sum = weights[r] * taps[r][x];
            for j in 1..=r {
                sum += weights[r + j] * (taps[r - j][x] + taps[r + j][x]);
            }
            sum
        },
    );
}

#[inline(always)]
fn odd_body(taps: &[&[f32]], weights: &[f32], r: usize, out: &mut [f32]) {
    let (taps, weights) = (&taps[..2 * r + 1], &weights[..2 * r + 1]);
    in_blocks(
        out,
        |x, block| {
            *block = [0.0; LANES];
            for j in 1..=r {
                let (a, b) = (lanes(taps[r - j], x), lanes(taps[r + j], x));
                let w = weights[r + j];
                for i in 0..LANES {
                    block[i] += w * (b[i] - a[i]);
                }
            }
        },
        |x| {
            let mut sum = 0.0;
            for j in 1..=r {
                sum += weights[r + j] * (taps[r + j][x] - taps[r - j][x]);
            }
            sum
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    /// Textbook double loop in f64.
    fn reference(image: &GrayImage32, ku: &[f32], kv: &[f32], border: Border) -> GrayImage32 {
        let (w, h) = (image.width() as usize, image.height() as usize);
        GrayImage32::from_fn(image.width(), image.height(), |u, v| {
            let mut sum = 0.0;
            for (j, b) in kv.iter().enumerate() {
                for (i, a) in ku.iter().enumerate() {
                    let x = u as isize + i as isize - (ku.len() / 2) as isize;
                    let y = v as isize + j as isize - (kv.len() / 2) as isize;
                    let value = match (border.index(x, w), border.index(y, h)) {
                        (Some(x), Some(y)) => image.get_pixel(x as u32, y as u32).0[0],
                        _ => border.constant(),
                    };
                    sum += f64::from(*a) * f64::from(*b) * f64::from(value);
                }
            }
            image::Luma([sum as f32])
        })
    }

    #[test]
    fn every_kernel_shape_on_every_image_shape() {
        let texture = fixture::gray32("texture.npy");
        let kernels: [&[f32]; 6] = [
            &[2.0],
            &[1.0, 2.0, 1.0],
            &[-1.0, 0.0, 1.0],
            &[0.1, -0.2, 0.7, 0.3, 0.4],
            &[-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0],
            &[1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0],
        ];
        for (w, h) in [(1, 1), (1, 7), (7, 1), (2, 3), (40, 31), (67, 5)] {
            let image = image::imageops::crop_imm(&texture, 0, 0, w, h).to_image();
            for ku in kernels {
                for kv in kernels {
                    for border in [Border::Replicate, Border::Reflect101, Border::Constant(0.3)] {
                        let ours = separable_filter(&image, ku, kv, border).unwrap();
                        let expected = reference(&image, ku, kv, border);
                        for (a, b) in ours.as_raw().iter().zip(expected.as_raw()) {
                            assert!((a - b).abs() < 2e-4, "{w}x{h} {ku:?} {kv:?}: {a} {b}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn bad_kernels_and_empty_images() {
        let image = GrayImage32::new(3, 3);
        for (ku, kv) in [(&[1.0f32, 1.0][..], &[1.0f32][..]), (&[1.0], &[])] {
            assert!(separable_filter(&image, ku, kv, Border::Replicate).is_err());
        }
        assert!(separable_filter(&image, &[f32::NAN], &[1.0], Border::Replicate).is_err());
        let empty = separable_filter(&GrayImage32::new(0, 5), &[1.0], &[1.0], Border::Reflect101);
        assert_eq!(empty.unwrap().dimensions(), (0, 5));
    }

    #[test]
    fn a_mirrored_image_gives_the_mirrored_bits() {
        let image = fixture::gray32("texture.npy");
        let kernel = [0.1, 0.2, 0.4, 0.2, 0.1];
        let flip = image::imageops::flip_horizontal::<GrayImage32>;
        let a = flip(&separable_filter(&image, &kernel, &kernel, Border::Reflect101).unwrap());
        let b = separable_filter(&flip(&image), &kernel, &kernel, Border::Reflect101).unwrap();
        assert_eq!(a, b);
    }
}
