//! Scale space: octaves of increasingly blurred layers, a few of them in memory at a time.
//!
//! Every step is symmetric about the middle of the image. Doubling puts new samples halfway between
//! old ones, `2w − 1` in total, and none outside. Halving keeps every second sample if their number
//! is odd; if it is even, it interpolates halfway between pairs, so that both ends are treated
//! alike. Sampling every second pixel of an even row would shift the grid by half a pixel between
//! an image and its mirror image, and the usual resizing for up-sampling would shift all keypoints
//! by a quarter.

use super::options::SiftOptions;
use crate::Result;
use crate::imaging::separable::{Sink, filter_into, in_bands};
use crate::imaging::{Border, GrayImage32, from_vec, gaussian_kernel};
use crate::math::monitored::Reporter;
use crate::progress::{Monitor, Part, Stage};
use std::ops::Range;

/// Width of an octave's border that is not searched for extrema, samples.
pub(super) const MARGIN: usize = 5;

/// Minimum side of an octave: smaller ones have no extremum far enough from their border.
const SMALLEST_SIDE: u32 = 2 * MARGIN as u32 + 2;

/// The first layer of an octave, and the positions of its samples in the image.
pub(super) struct OctaveGrid {
    pub(super) base: GrayImage32,
    /// Pixels of the image per sample.
    pub(super) step: f64,
    /// Position of the first sample, pixels of the image.
    pub(super) origin_u: f64,
    pub(super) origin_v: f64,
    /// log₂ of the step.
    pub(super) octave: i32,
}

impl OctaveGrid {
    /// Creates the first octave of an image, if it is large enough.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn first(
        image: &GrayImage32,
        options: &SiftOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>> {
        if image.width().min(image.height()) < 2 {
            return Ok(None);
        }
        let blur_to = |from: f64| (options.sigma_px * options.sigma_px - from * from).sqrt();
        let (unblurred, blur, step, octave);
        if options.upsample {
            unblurred = double_size(image, &mut Part::new(monitor, 0.0, 0.5))?;
            blur = blur_to(2.0 * options.input_blur_px);
            (step, octave) = (0.5, -1);
        } else {
            unblurred = image.clone();
            blur = blur_to(options.input_blur_px);
            (step, octave) = (1.0, 0);
        }
        let mut base = GrayImage32::default();
        // The assumed blur may already be the required one.
        if blur > 0.01 {
            let part = &mut Part::new(monitor, 0.5, 1.0);
            blur_layer(&unblurred, blur, &mut base, part)?;
        } else {
            base = unblurred;
        }
        let grid = Self {
            base,
            step,
            origin_u: 0.0,
            origin_v: 0.0,
            octave,
        };
        Ok(grid.large_enough())
    }

    fn large_enough(self) -> Option<Self> {
        (self.base.width().min(self.base.height()) >= SMALLEST_SIDE).then_some(self)
    }
}

/// An octave: a window of four layers, as needed for the extrema of one layer.
pub(super) struct Octave {
    grid: OctaveGrid,
    /// Additional blur from one layer to the next.
    increments: Vec<f64>,
    layers_per_octave: usize,
    sigma_px: f64,
    /// Ring buffer of the last four layers: `layers[k % 4]` is layer k.
    layers: [GrayImage32; 4],
    newest: usize,
}

impl Octave {
    /// Creates an octave in the memory of the layers of the previous one.
    pub(super) fn new(
        mut grid: OctaveGrid,
        mut layers: [GrayImage32; 4],
        options: &SiftOptions,
    ) -> Self {
        let n = options.layers_per_octave;
        let sigma = |k: usize| options.sigma_px * libm::exp2(k as f64 / n as f64);
        let increments = (1..n + 3)
            .map(|k| (sigma(k) * sigma(k) - sigma(k - 1) * sigma(k - 1)).sqrt())
            .collect();
        layers[0] = std::mem::take(&mut grid.base);
        Self {
            grid,
            increments,
            layers_per_octave: n,
            sigma_px: options.sigma_px,
            layers,
            newest: 0,
        }
    }

    pub(super) fn into_memory(self) -> [GrayImage32; 4] {
        self.layers
    }

    pub(super) fn grid(&self) -> &OctaveGrid {
        &self.grid
    }

    /// Computes the layers that extrema of `layer` need, up to `layer + 2`.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn advance_to(&mut self, layer: usize, monitor: &mut dyn Monitor) -> Result<()> {
        let count = (layer + 2).saturating_sub(self.newest);
        for k in 0..count {
            let [start, end] = [k, k + 1].map(|k| k as f32 / count as f32);
            let part = &mut Part::new(monitor, start, end);
            let from = self.newest % 4;
            let to = (self.newest + 1) % 4;
            let mut target = std::mem::take(&mut self.layers[to]);
            let blur = self.increments[self.newest];
            blur_layer(&self.layers[from], blur, &mut target, part)?;
            self.layers[to] = target;
            self.newest += 1;
        }
        Ok(())
    }

    /// Returns a layer among the last four.
    pub(super) fn layer(&self, k: usize) -> &GrayImage32 {
        debug_assert!(k <= self.newest && self.newest < k + 4);
        &self.layers[k % 4]
    }

    /// Returns the blur of a fractional layer, samples of this octave.
    pub(super) fn sigma_at(&self, layer: f64) -> f64 {
        self.sigma_px * libm::exp2(layer / self.layers_per_octave as f64)
    }

    /// Creates the next octave, from the layer with twice the blur of the first.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn next_grid(&self, monitor: &mut dyn Monitor) -> Result<Option<OctaveGrid>> {
        let n = self.layers_per_octave;
        // With more layers than the window holds, it is computed now and once more later.
        let mut further = GrayImage32::default();
        for k in self.newest..n {
            let mut target = GrayImage32::default();
            let from = if k == self.newest {
                self.layer(k)
            } else {
                &further
            };
            let [start, end] = [k, k + 1].map(|k| (k - self.newest) as f32 / (n + 1) as f32);
            let part = &mut Part::new(monitor, start, end);
            blur_layer(from, self.increments[k], &mut target, part)?;
            further = target;
        }
        let source = if n <= self.newest {
            self.layer(n)
        } else {
            &further
        };
        let shift = |size: u32| if size % 2 == 1 { 0.0 } else { 0.5 };
        let next = OctaveGrid {
            step: 2.0 * self.grid.step,
            origin_u: self.grid.origin_u + shift(source.width()) * self.grid.step,
            origin_v: self.grid.origin_v + shift(source.height()) * self.grid.step,
            octave: self.grid.octave + 1,
            base: halve_size(
                source,
                &mut Part::new(monitor, n as f32 / (n + 1) as f32, 1.0),
            )?,
        };
        Ok(next.large_enough())
    }
}

/// Blurs into an image whose memory is reused.
fn blur_layer(
    image: &GrayImage32,
    sigma: f64,
    target: &mut GrayImage32,
    monitor: &mut dyn Monitor,
) -> Result<()> {
    let radius = (4.0 * sigma).ceil() as usize;
    let kernel = gaussian_kernel(sigma, 2 * radius + 1).expect("the blur is positive and small");
    let kernels = [(&*kernel, &*kernel)];
    filter_into(image, kernels, Border::Reflect101, [target], monitor)
}

/// Doubles the samples, less one, along each axis; the new ones are means of their neighbors.
fn double_size(image: &GrayImage32, monitor: &mut dyn Monitor) -> Result<GrayImage32> {
    let (w, h) = (image.width() as usize, image.height() as usize);
    let source = |v: usize| &image.as_raw()[v * w..(v + 1) * w];
    let size = [2 * w - 1, 2 * h - 1];
    row_by_row(size, w, monitor, |y, between, out| {
        let from = if y % 2 == 0 {
            source(y / 2)
        } else {
            let pairs = source(y / 2).iter().zip(source(y / 2 + 1));
            for (mean, (a, b)) in between.iter_mut().zip(pairs) {
                *mean = 0.5 * (a + b);
            }
            &*between
        };
        out[2 * w - 2] = from[w - 1];
        for (pair, two) in from.windows(2).zip(out.as_chunks_mut::<2>().0) {
            *two = [pair[0], 0.5 * (pair[0] + pair[1])];
        }
    })
}

/// Halves the samples along each axis, symmetrically.
fn halve_size(image: &GrayImage32, monitor: &mut dyn Monitor) -> Result<GrayImage32> {
    let (w, h) = (image.width() as usize, image.height() as usize);
    // The cubic through four samples, halfway between the middle two.
    let middle = |a: f32, b: f32, c: f32, d: f32| 0.5625 * (b + c) - 0.0625 * (a + d);
    let at = |k: isize, size: usize| k.clamp(0, size as isize - 1) as usize;
    let size = [w.div_ceil(2), h.div_ceil(2)];
    row_by_row(size, w, monitor, |y, row, out| {
        let source = |k: isize| {
            let v = at(2 * y as isize + k, h);
            &image.as_raw()[v * w..(v + 1) * w]
        };
        if h % 2 == 1 {
            row.copy_from_slice(source(0));
        } else {
            let (a, b, c, d) = (source(-1), source(0), source(1), source(2));
            for x in 0..w {
                row[x] = middle(a[x], b[x], c[x], d[x]);
            }
        }
        for (x, out) in out.iter_mut().enumerate() {
            let tap = |k: isize| row[at(2 * x as isize + k, w)];
            *out = if w % 2 == 1 {
                row[2 * x]
            } else {
                middle(tap(-1), tap(0), tap(1), tap(2))
            };
        }
    })
}

/// Computes an image row by row with `fill(y, memory, row)`, which must depend only on y; `memory`
/// holds `memory_len` numbers with the values of other rows.
fn row_by_row(
    [width, height]: [usize; 2],
    memory_len: usize,
    monitor: &mut dyn Monitor,
    fill: impl Fn(usize, &mut [f32], &mut [f32]) + Sync,
) -> Result<GrayImage32> {
    let work = |rows: Range<usize>, sink: Sink<1>, reporter: &mut Reporter| {
        let mut memory = vec![0.0; memory_len];
        for y in rows.clone() {
            reporter.report(y - rows.start, rows.len())?;
            sink(&mut |[mut row]| fill(y, &mut memory, row.columns(0..width)));
        }
        Ok(())
    };
    let stage = Stage::FeatureDetection;
    let [values] = in_bands([Vec::new()], width, height, stage, monitor, work)?;
    Ok(from_vec(width as u32, height as u32, values))
}
