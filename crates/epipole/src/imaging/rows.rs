//! Application of kernels to rows: along a row, across several rows, or both in one pass, with
//! borders.

use super::Border;
use super::kernel::{Kernel, Row, Symmetry};
use super::weigh::{LANES, across_any, across_short, along_any, along_short, both};
use std::ops::Range;

/// Whether short kernels have specialized loops. WebAssembly omits them for size: there the
/// one-pass loop handles most pixels, and these only the ends.
const SHORT: bool = cfg!(not(target_arch = "wasm32"));

impl Kernel<'_> {
    /// Correlates a row, `None` for a row outside the image:
    /// `out[x] = Σ weights[k] row[x + k − r]`. `edge` is a buffer for the ends of the row with
    /// their border.
    pub(crate) fn along(
        &self,
        row: Option<&[f32]>,
        border: Border,
        edge: &mut Vec<f32>,
        out: &mut [f32],
    ) {
        let width = out.len();
        with_border(
            row,
            self.radius(),
            border,
            edge,
            width,
            |padded, columns| {
                self.inside(padded, &mut out[columns]);
            },
        );
    }

    /// Implements [`along`](Self::along) for a row that extends beyond the requested columns.
    fn inside(&self, padded: &[f32], out: &mut [f32]) {
        match self.radius() {
            1 if SHORT => along_short::<1>(self, padded, out),
            2 if SHORT => along_short::<2>(self, padded, out),
            3 if SHORT => along_short::<3>(self, padded, out),
            _ => along_any(self, padded, out),
        }
    }

    /// Combines rows starting at a column: `out[x] = Σ weights[k] rows[k][from + x]`.
    pub(crate) fn across(&self, rows: &[Vec<f32>], from: usize, out: &mut [f32]) {
        match self.radius() {
            1 if SHORT => across_short::<1>(self, rows, from, out),
            2 if SHORT => across_short::<2>(self, rows, from, out),
            3 if SHORT => across_short::<3>(self, rows, from, out),
            _ => across_any(self, rows, from, out),
        }
    }
}

/// Applies `along` to a row, stores it as the newest and last of `rows`, and then applies `across`
/// to all of them.
///
/// For short kernels in one pass: the newest row is weighted while still in registers.
pub(crate) fn along_and_across(
    [along, across]: [&Kernel; 2],
    row: Option<&[f32]>,
    border: Border,
    edge: &mut Vec<f32>,
    rows: &mut [Vec<f32>],
    mut out: Row,
) {
    use Symmetry::{Even, Odd};
    let newest = across.len() - 1;
    let width = rows[newest].len();
    let radius = along.radius();
    let together: Together = match (along.symmetry, across.symmetry, radius) {
        _ if radius != across.radius() => apart,
        (Even, Even, 1) => both::<1, true, true>,
        (Even, Odd, 1) => both::<1, true, false>,
        (Odd, Even, 1) => both::<1, false, true>,
        (Even, Even, 2) => both::<2, true, true>,
        (Even, Even, 3) => both::<3, true, true>,
        _ => apart,
    };
    with_border(row, radius, border, edge, width, |padded, columns| {
        let pass = if columns.len().is_multiple_of(LANES) {
            together
        } else {
            apart
        };
        pass([along, across], padded, columns, rows, &mut out);
    });
}

/// Function for both directions over columns of a row that extends beyond them.
type Together = fn([&Kernel; 2], &[f32], Range<usize>, &mut [Vec<f32>], &mut Row);

fn apart(
    [along, across]: [&Kernel; 2],
    padded: &[f32],
    columns: Range<usize>,
    rows: &mut [Vec<f32>],
    out: &mut Row,
) {
    along.inside(padded, &mut rows[across.len() - 1][columns.clone()]);
    across.across(rows, columns.start, out.columns(columns));
}

/// Calls `run` with pieces of a row, `radius` pixels longer at both ends than their columns, from
/// left to right. The interior is read in place; `edge` holds the ends.
#[inline]
fn with_border(
    row: Option<&[f32]>,
    radius: usize,
    border: Border,
    edge: &mut Vec<f32>,
    width: usize,
    mut run: impl FnMut(&[f32], Range<usize>),
) {
    edge.clear();
    let Some(row) = row else {
        edge.resize(width + 2 * radius, border.constant());
        return run(edge, 0..width);
    };
    if radius == 0 {
        return run(row, 0..width);
    }
    let at = |x: isize| border.index(x, width).map_or(border.constant(), |x| row[x]);
    let (r, w) = (radius as isize, width as isize);
    edge.extend((-r..0).map(at));
    let end = radius.next_multiple_of(LANES);
    if width < 2 * end {
        edge.extend_from_slice(row);
        edge.extend((w..w + r).map(at));
        return run(edge, 0..width);
    }
    edge.extend_from_slice(&row[..end + radius]);
    run(edge, 0..end);
    let last = width - end - width % LANES;
    run(&row[end - radius..last + radius], end..last);
    edge.clear();
    edge.extend_from_slice(&row[last - radius..]);
    edge.extend((w..w + r).map(at));
    run(edge, last..width);
}
