//! Separable filters in streaming form: each row is filtered along u once, kept in a ring buffer
//! while the kernel along v needs it, and never stored as a full image.

use super::gray::from_vec;
use super::kernel::{Kernel, Row};
use super::rows::along_and_across;
use super::{Border, GrayImage32};
use crate::math::monitored::Reporter;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Correlates an image with the kernel `kernel_v · kernel_uᵀ`:
/// `out(u, v) = Σⱼ Σᵢ kernel_v[j] kernel_u[i] I(u + i − rᵤ, v + j − rᵥ)`.
///
/// The kernels are not flipped. Sums have a fixed order, with symmetric kernels folded, so that a
/// mirrored image gives the mirrored result bit by bit. The only stage is [`Stage::Filtering`].
///
/// * `kernel_u`, `kernel_v`: weights along u and v, odd numbers of them
///
/// # Errors
/// [`Error::OutOfRange`] for a kernel that is empty or of even length, [`Error::NotFinite`] for
/// weights that are not finite, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, separable_filter};
/// let step = gray_from_values(4, 1, vec![0.0, 0.0, 1.0, 1.0])?;
/// let slope = separable_filter(&step, &[-0.5, 0.0, 0.5], &[1.0], Border::Replicate, &mut ())?;
/// assert_eq!(slope.as_raw(), &[0.0, 0.5, 0.5, 0.0]);
/// # Ok(()) }
/// ```
pub fn separable_filter(
    image: &GrayImage32,
    kernel_u: &[f32],
    kernel_v: &[f32],
    border: Border,
    monitor: &mut dyn Monitor,
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
    let [filtered] = filter(image, [(kernel_u, kernel_v)], border, monitor)?;
    Ok(filtered)
}

/// Applies several separable kernels to an image, in one pass over its rows. Kernel lengths are
/// odd.
///
/// # Errors
/// [`Error::Canceled`].
pub(crate) fn filter<const N: usize>(
    image: &GrayImage32,
    kernels: [(&[f32], &[f32]); N],
    border: Border,
    monitor: &mut dyn Monitor,
) -> Result<[GrayImage32; N]> {
    let mut outputs = std::array::from_fn(|_| GrayImage32::default());
    filter_into(image, kernels, border, outputs.each_mut(), monitor)?;
    Ok(outputs)
}

/// Runs [`filter`] for kernels so short that no monitor is needed.
pub(crate) fn filter_briefly<const N: usize>(
    image: &GrayImage32,
    kernels: [(&[f32], &[f32]); N],
    border: Border,
) -> [GrayImage32; N] {
    filter(image, kernels, border, &mut ()).expect("`()` never cancels")
}

/// Runs [`filter`] into images whose memory is reused; they are empty after an error.
pub(crate) fn filter_into<const N: usize>(
    image: &GrayImage32,
    kernels: [(&[f32], &[f32]); N],
    border: Border,
    mut targets: [&mut GrayImage32; N],
    monitor: &mut dyn Monitor,
) -> Result<()> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let memory = targets
        .each_mut()
        .map(|target| std::mem::take(*target).into_raw());
    let work = |rows: Range<usize>, sink: Sink<N>, reporter: &mut Reporter| {
        let mut filter = RowFilter::new(image, kernels, border);
        let (first, count) = (rows.start, rows.len());
        filter.prepare(first, reporter)?;
        for y in rows {
            reporter.report(y - first, count)?;
            sink(&mut |out| filter.row(y, out));
        }
        Ok(())
    };
    let outputs = in_bands(memory, width, height, Stage::Filtering, monitor, work)?;
    for (target, values) in targets.into_iter().zip(outputs) {
        *target = from_vec(image.width(), image.height(), values);
    }
    Ok(())
}

/// Receiver of a closure that fills the next row of each image.
pub(crate) type Sink<'a, const N: usize> = &'a mut dyn FnMut(&mut dyn FnMut([Row; N]));

/// Makes images of equal size row by row: `work` gets a range of rows, a sink to call for each row
/// in order, and a reporter to call before that. Ranges are distributed to threads if the feature
/// is enabled; a row must not depend on the start of its range. Sufficiently large vectors are
/// reused.
///
/// # Errors
/// Those of `work`.
pub(crate) fn in_bands<const N: usize>(
    mut images: [Vec<f32>; N],
    width: usize,
    height: usize,
    stage: Stage,
    monitor: &mut dyn Monitor,
    work: impl Fn(Range<usize>, Sink<N>, &mut Reporter) -> Result<()> + Sync,
) -> Result<[Vec<f32>; N]> {
    let size = width * height;
    if size == 0 {
        return Ok([const { Vec::new() }; N]);
    }
    let canceled = &AtomicBool::new(false);
    let reporter = &mut Reporter::of_caller(stage, monitor, canceled, 0.0..1.0);
    // Below about a quarter of a megapixel threads do not pay off.
    #[cfg(feature = "parallel")]
    let threads = rayon::current_num_threads().min(size / (1 << 17));
    #[cfg(not(feature = "parallel"))]
    let threads = 1;
    let used_again = images.iter().all(|image| image.len() >= size);
    if threads <= 1 && !used_again {
        for image in &mut images {
            image.clear();
            image.reserve_exact(size);
        }
        let sink: Sink<N> = &mut |fill| fill(images.each_mut().map(Row::End));
        work(0..height, sink, reporter)?;
        return Ok(images);
    }
    for image in &mut images {
        if image.capacity() < size {
            // The system provides zeros lazily, page by page.
            *image = vec![0.0; size];
        }
        image.resize(size, 0.0);
    }
    let band = |rows: Range<usize>, mut pieces: [&mut [f32]; N], reporter: &mut Reporter| {
        let sink: Sink<N> = &mut |fill| {
            fill(pieces.each_mut().map(|piece| {
                let (row, rest) = std::mem::take(piece).split_at_mut(width);
                *piece = rest;
                Row::Over(row)
            }));
        };
        work(rows, sink, reporter)
    };
    let mut rest = images.each_mut().map(|image| image.as_mut_slice());
    #[cfg(feature = "parallel")]
    if threads > 1 {
        let mut bands = crate::imaging::bands(height, threads).into_iter();
        let mut pieces_of = |rows: &Range<usize>| {
            rest.each_mut().map(|rest| {
                let (head, tail) = std::mem::take(rest).split_at_mut(rows.len() * width);
                *rest = tail;
                head
            })
        };
        let own = bands.next().map(|rows| (pieces_of(&rows), rows));
        // The other threads fail only if the caller's reporter cancels.
        rayon::in_place_scope(|scope| {
            for rows in bands {
                let (band, pieces) = (&band, pieces_of(&rows));
                scope.spawn(move |_| {
                    let _ = band(rows, pieces, &mut Reporter::of_other(stage, canceled));
                });
            }
            own.map_or(Ok(()), |(pieces, rows)| band(rows, pieces, reporter))
        })?;
        return Ok(images);
    }
    band(0..height, rest.each_mut().map(std::mem::take), reporter)?;
    Ok(images)
}

/// Rows of an image under several separable kernels. If rows are requested in order, each source
/// row is filtered along u once.
pub(crate) struct RowFilter<'a, const N: usize> {
    image: &'a GrayImage32,
    kernels: [[Kernel<'a>; 2]; N],
    border: Border,
    rings: [Ring; N],
    /// Row for which the rings are filled.
    next: Option<usize>,
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
            kernels: kernels.map(|(u, v)| [Kernel::new(u), Kernel::new(v)]),
            border,
            rings: kernels.map(|(_, kernel_v)| Ring::new(kernel_v.len(), width)),
            next: None,
            edge: Vec::new(),
        }
    }

    /// Fills the rings for row `y`. For a long kernel this takes longer than the following rows.
    ///
    /// # Errors
    /// [`Error::Canceled`].
    pub(crate) fn prepare(&mut self, y: usize, reporter: &mut Reporter) -> Result<()> {
        for (k, row) in self.rows_before(y) {
            reporter.report(0, 1)?;
            self.push(k, row);
        }
        self.next = Some(y);
        Ok(())
    }

    /// Computes row `y` for each kernel.
    pub(crate) fn row(&mut self, y: usize, out: [Row; N]) {
        if self.next != Some(y) {
            for (k, row) in self.rows_before(y) {
                self.push(k, row);
            }
        }
        self.next = Some(y + 1);
        for (k, out) in out.into_iter().enumerate() {
            let [along, across] = &self.kernels[k];
            let source = self.source(y as isize + (across.len() / 2) as isize);
            let (ring, edge) = (&mut self.rings[k], &mut self.edge);
            ring.push();
            let kernels = [along, across];
            along_and_across(kernels, source, self.border, edge, ring.rows(), out);
        }
    }

    /// Iterates over the kernels and source rows that the rings hold before row `y`.
    fn rows_before(&self, y: usize) -> impl Iterator<Item = (usize, isize)> + use<N> {
        let radii = self.kernels.each_ref().map(|[_, across]| across.len() / 2);
        radii.into_iter().enumerate().flat_map(move |(k, radius)| {
            let (y, radius) = (y as isize, radius as isize);
            (y - radius..y + radius).map(move |row| (k, row))
        })
    }

    /// Filters a source row along u into the ring of a kernel.
    fn push(&mut self, k: usize, row: isize) {
        let source = self.source(row);
        let (along, ring) = (&self.kernels[k][0], &mut self.rings[k]);
        along.along(source, self.border, &mut self.edge, ring.push());
    }

    fn source(&self, row: isize) -> Option<&'a [f32]> {
        let (width, height) = (self.image.width() as usize, self.image.height() as usize);
        let row = self.border.index(row, height);
        row.map(|m| &self.image.as_raw()[m * width..(m + 1) * width])
    }
}

/// Ring buffer of the last rows of a stream, as many as the kernel along v is long, oldest first.
pub(crate) struct Ring(Vec<Vec<f32>>);

impl Ring {
    pub(crate) fn new(length: usize, width: usize) -> Self {
        Self(vec![vec![0.0; width]; length])
    }

    /// Returns the oldest row, now the newest, to be overwritten.
    pub(crate) fn push(&mut self) -> &mut [f32] {
        self.0.rotate_left(1);
        self.0.last_mut().map_or(&mut [], |row| row)
    }

    pub(crate) fn rows(&mut self) -> &mut [Vec<f32>] {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    /// Straightforward double loop in f64.
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

    /// The texture, repeated.
    fn tiled(width: u32, height: u32) -> GrayImage32 {
        let texture = fixture::gray32("texture.npy");
        let (w, h) = texture.dimensions();
        GrayImage32::from_fn(width, height, |u, v| *texture.get_pixel(u % w, v % h))
    }

    #[test]
    fn every_kernel_shape_on_every_image_shape() {
        let kernels: [&[f32]; 6] = [
            &[2.0],
            &[1.0, 2.0, 1.0],
            &[-1.0, 0.0, 1.0],
            &[0.1, -0.2, 0.7, 0.3, 0.4],
            &[-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0],
            &[1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0],
        ];
        for (w, h) in [(1, 1), (1, 7), (7, 1), (2, 3), (40, 31), (67, 5), (96, 4)] {
            let image = tiled(w, h);
            for ku in kernels {
                for kv in kernels {
                    for border in [Border::Replicate, Border::Reflect101, Border::Constant(0.3)] {
                        let ours = separable_filter(&image, ku, kv, border, &mut ()).unwrap();
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
    fn one_walk_gives_the_bits_of_two() {
        let (even, odd, skew) = ([0.2, 0.7, 0.2], [-0.3, 0.0, 0.3], [0.1, 0.3, 0.7]);
        let longer = [0.1, 0.2, 0.4, 0.2, 0.1];
        let pairs: [(&[f32], &[f32]); 5] = [
            (&even, &even),
            (&even, &odd),
            (&odd, &even),
            (&longer, &longer),
            (&skew, &odd),
        ];
        for width in [63, 64, 67, 96] {
            let image = tiled(width, 9);
            for (ku, kv) in pairs {
                let border = Border::Reflect101;
                let [once] = filter_briefly(&image, [(ku, kv)], border);
                let [along] = filter_briefly(&image, [(ku, &[1.0])], border);
                let [twice] = filter_briefly(&along, [(&[1.0], kv)], border);
                assert_eq!(once, twice, "{width} {ku:?} {kv:?}");
                let mut again = GrayImage32::from_pixel(200, 9, image::Luma([7.0]));
                filter_into(&image, [(ku, kv)], border, [&mut again], &mut ()).unwrap();
                assert_eq!(once, again, "{width} {ku:?} {kv:?}");
            }
        }
    }

    #[test]
    fn bad_kernels_and_empty_images() {
        let image = GrayImage32::new(3, 3);
        for (ku, kv) in [(&[1.0f32, 1.0][..], &[1.0f32][..]), (&[1.0], &[])] {
            assert!(separable_filter(&image, ku, kv, Border::Replicate, &mut ()).is_err());
        }
        assert!(separable_filter(&image, &[f32::NAN], &[1.0], Border::Replicate, &mut ()).is_err());
        let empty = separable_filter(
            &GrayImage32::new(0, 5),
            &[1.0],
            &[1.0],
            Border::Reflect101,
            &mut (),
        );
        assert_eq!(empty.unwrap().dimensions(), (0, 5));
    }

    #[test]
    fn a_mirrored_image_gives_the_mirrored_bits() {
        let image = fixture::gray32("texture.npy");
        let kernel = [0.1, 0.2, 0.4, 0.2, 0.1];
        let flip = image::imageops::flip_horizontal::<GrayImage32>;
        let a =
            flip(&separable_filter(&image, &kernel, &kernel, Border::Reflect101, &mut ()).unwrap());
        let b =
            separable_filter(&flip(&image), &kernel, &kernel, Border::Reflect101, &mut ()).unwrap();
        assert_eq!(a, b);
    }
}
