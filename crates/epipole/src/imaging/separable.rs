//! Separable filters in row-streaming form: each row is filtered along u once, kept in a ring
//! while the kernel along v needs it, and never written to memory as an image of its own.

use super::gray::from_vec;
use super::{Border, GrayImage32};
use crate::math::simd::dispatched;
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
    let mut outputs = std::array::from_fn(|_| GrayImage32::default());
    filter_into(image, kernels, border, outputs.each_mut());
    outputs
}

/// [`filter`] into images whose memory is used again.
pub(crate) fn filter_into<const N: usize>(
    image: &GrayImage32,
    kernels: [(&[f32], &[f32]); N],
    border: Border,
    mut targets: [&mut GrayImage32; N],
) {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let memory = targets
        .each_mut()
        .map(|target| std::mem::take(*target).into_raw());
    let outputs = in_bands(memory, width, height, |rows, sink| {
        let mut filter = RowFilter::new(image, kernels, border);
        for y in rows {
            sink(&mut |out| filter.row(y, out));
        }
    });
    for (target, values) in targets.into_iter().zip(outputs) {
        *target = from_vec(image.width(), image.height(), values);
    }
}

/// Takes a closure that fills the next row of each image.
pub(crate) type Sink<'a, const N: usize> = &'a mut dyn FnMut(&mut dyn FnMut([&mut [f32]; N]));

/// Makes equally large images row by row: `work` gets a range of rows and a sink that it calls for
/// each of them in turn. Ranges are shared between threads where the feature allows; a row must
/// not depend on where its range begins. Vectors that are large enough are used again.
pub(crate) fn in_bands<const N: usize>(
    mut images: [Vec<f32>; N],
    width: usize,
    height: usize,
    work: impl Fn(Range<usize>, Sink<N>) + Sync,
) -> [Vec<f32>; N] {
    let size = width * height;
    if size == 0 {
        return [const { Vec::new() }; N];
    }
    // Below about a quarter of a megapixel threads cost more than they give.
    #[cfg(feature = "parallel")]
    let threads = rayon::current_num_threads().min(size / (1 << 17));
    #[cfg(not(feature = "parallel"))]
    let threads = 1;
    let used_again = images.iter().all(|image| image.len() >= size);
    if threads <= 1 && !used_again {
        // New memory is written once, not first filled with zeros.
        let mut rows = vec![0.0; N * width];
        for image in &mut images {
            image.clear();
            image.reserve_exact(size);
        }
        work(0..height, &mut |fill| {
            let mut pieces = rows.chunks_exact_mut(width);
            fill(std::array::from_fn(|_| pieces.next().unwrap_or_default()));
            for (image, row) in images.iter_mut().zip(rows.chunks_exact(width)) {
                image.extend_from_slice(row);
            }
        });
        return images;
    }
    for image in &mut images {
        image.resize(size, 0.0);
    }
    let band = |rows: Range<usize>, mut pieces: [&mut [f32]; N]| {
        work(rows, &mut |fill| {
            fill(pieces.each_mut().map(|piece| {
                let (row, rest) = std::mem::take(piece).split_at_mut(width);
                *piece = rest;
                row
            }));
        });
    };
    let mut rest = images.each_mut().map(|image| image.as_mut_slice());
    #[cfg(feature = "parallel")]
    if threads > 1 {
        rayon::scope(|scope| {
            for rows in crate::imaging::bands(height, threads) {
                let pieces = rest.each_mut().map(|rest| {
                    let (head, tail) =
                        std::mem::take(rest).split_at_mut((rows.end - rows.start) * width);
                    *rest = tail;
                    head
                });
                let band = &band;
                scope.spawn(move |_| band(rows, pieces));
            }
        });
        return images;
    }
    band(0..height, rest.each_mut().map(std::mem::take));
    images
}

/// Rows of an image under several separable kernels. Asked for rows in order it filters each
/// source row along u once.
pub(crate) struct RowFilter<'a, const N: usize> {
    image: &'a GrayImage32,
    kernels: [(&'a [f32], &'a [f32]); N],
    border: Border,
    rings: [Ring; N],
    last: Option<usize>,
    edge: Vec<f32>,
}

impl<'a, const N: usize> RowFilter<'a, N> {
    pub(crate) fn new(
        image: &'a GrayImage32,
        kernels: [(&'a [f32], &'a [f32]); N],
        border: Border,
    ) -> Self {
        let width = image.width() as usize;
        Self {
            image,
            kernels,
            border,
            rings: kernels.map(|(_, kernel_v)| Ring::new(kernel_v.len(), width)),
            last: None,
            edge: Vec::new(),
        }
    }

    /// Row `y` under each kernel.
    pub(crate) fn row(&mut self, y: usize, out: [&mut [f32]; N]) {
        let (width, height) = (self.image.width() as usize, self.image.height() as usize);
        let follows = y > 0 && self.last == Some(y - 1);
        self.last = Some(y);
        for (k, out) in out.into_iter().enumerate() {
            let (kernel_u, kernel_v) = self.kernels[k];
            let radius = (kernel_v.len() / 2) as isize;
            let newest = y as isize + radius;
            let first = if follows { newest } else { newest - 2 * radius };
            for row in first..=newest {
                let source = self
                    .border
                    .index(row, height)
                    .map(|m| &self.image.as_raw()[m * width..(m + 1) * width]);
                let target = self.rings[k].push();
                filter_along_row(source, kernel_u, self.border, &mut self.edge, target);
            }
            self.rings[k].combine(kernel_v, out);
        }
    }
}

/// Correlates a row with a kernel, `None` being a row outside the image: `out[x] = Σ kernel[k]
/// row[x + k − r]`. The inside is read in place; `edge` holds the ends with their border.
pub(crate) fn filter_along_row(
    row: Option<&[f32]>,
    kernel: &[f32],
    border: Border,
    edge: &mut Vec<f32>,
    out: &mut [f32],
) {
    let (width, radius) = (out.len(), kernel.len() / 2);
    let run = |padded: &[f32], out: &mut [f32]| {
        let n = out.len();
        with_slices(
            kernel.len(),
            |k| &padded[k..k + n],
            |taps| weigh(taps, kernel, out),
        );
    };
    let Some(row) = row else {
        edge.clear();
        edge.resize(width + 2 * radius, border.constant());
        run(edge, out);
        return;
    };
    let at = |x: isize| border.index(x, width).map_or(border.constant(), |x| row[x]);
    let r = radius as isize;
    if width <= 4 * radius {
        edge.clear();
        edge.extend((-r..width as isize + r).map(at));
        run(edge, out);
        return;
    }
    if radius > 0 {
        edge.clear();
        edge.extend((-r..2 * r).map(at));
        run(edge, &mut out[..radius]);
        edge.clear();
        edge.extend((width as isize - 2 * r..width as isize + r).map(at));
        run(edge, &mut out[width - radius..]);
    }
    run(row, &mut out[radius..width - radius]);
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

/// Fills `out` by blocks of `L` pixels, the last of which may overlap the one before it: each
/// pixel's sum is the same wherever its block begins. Gives `false` if there are fewer pixels.
//
// No closures in these: a closure is a function of its own, compiled for the baseline only.
macro_rules! in_blocks {
    ($block:ident, $taps:expr, $weights:expr, $r:expr, $out:expr) => {{
        let n = $out.len();
        if n >= LANES {
            let mut x = 0;
            while x < n {
                let from = x.min(n - LANES);
                $out[from..from + LANES]
                    .copy_from_slice(&$block::<LANES>($taps, $weights, $r, from));
                x += LANES;
            }
        } else if n >= FEW {
            let mut x = 0;
            while x < n {
                let from = x.min(n - FEW);
                $out[from..from + FEW].copy_from_slice(&$block::<FEW>($taps, $weights, $r, from));
                x += FEW;
            }
        } else {
            for x in 0..n {
                $out[x] = $block::<1>($taps, $weights, $r, x)[0];
            }
        }
    }};
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
        in_blocks!(any_block, taps, weights, 0, out);
    }
}

/// Pixels whose sums are kept in registers at once.
const LANES: usize = 32;
/// The same for rows too short for that.
const FEW: usize = 8;

#[inline(always)]
fn lanes<const L: usize>(slice: &[f32], from: usize) -> &[f32; L] {
    slice[from..from + L]
        .try_into()
        .expect("the slice has this length")
}

#[inline(always)]
fn even_body(taps: &[&[f32]], weights: &[f32], r: usize, out: &mut [f32]) {
    in_blocks!(
        even_block,
        &taps[..2 * r + 1],
        &weights[..2 * r + 1],
        r,
        out
    );
}

#[inline(always)]
fn odd_body(taps: &[&[f32]], weights: &[f32], r: usize, out: &mut [f32]) {
    in_blocks!(odd_block, &taps[..2 * r + 1], &weights[..2 * r + 1], r, out);
}

#[inline(always)]
fn even_block<const L: usize>(taps: &[&[f32]], weights: &[f32], r: usize, x: usize) -> [f32; L] {
    let center = lanes::<L>(taps[r], x);
    let mut sums = [0.0; L];
    for i in 0..L {
        sums[i] = weights[r] * center[i];
    }
    for j in 1..=r {
        let (a, b) = (lanes::<L>(taps[r - j], x), lanes::<L>(taps[r + j], x));
        let w = weights[r + j];
        for i in 0..L {
            sums[i] += w * (a[i] + b[i]);
        }
    }
    sums
}

#[inline(always)]
fn odd_block<const L: usize>(taps: &[&[f32]], weights: &[f32], r: usize, x: usize) -> [f32; L] {
    let mut sums = [0.0; L];
    for j in 1..=r {
        let (a, b) = (lanes::<L>(taps[r - j], x), lanes::<L>(taps[r + j], x));
        let w = weights[r + j];
        for i in 0..L {
            sums[i] += w * (b[i] - a[i]);
        }
    }
    sums
}

#[inline(always)]
fn any_block<const L: usize>(taps: &[&[f32]], weights: &[f32], _: usize, x: usize) -> [f32; L] {
    let mut sums = [0.0; L];
    for (tap, w) in taps.iter().zip(weights) {
        let tap = lanes::<L>(tap, x);
        for i in 0..L {
            sums[i] += w * tap[i];
        }
    }
    sums
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
