//! Rows under a kernel: along a row, across several rows, or both in one walk; and what lies
//! beyond their ends.

use super::Border;
use super::kernel::{Kernel, Row, Symmetry};
use super::weigh::{LANES, across_any, across_short, along_any, along_short, both};
use std::ops::Range;

/// Whether short kernels have loops of their own. What a page downloads does without: there the
/// walk that goes both ways at once has most of the pixels, and these are for its ends.
const SHORT: bool = cfg!(not(target_arch = "wasm32"));

impl Kernel<'_> {
    /// Correlates a row, `None` being one outside the image:
    /// `out[x] = Σ weights[k] row[x + k − r]`. `edge` is memory for the ends of the row with their
    /// border.
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

    /// [`along`](Self::along) where the row goes on beyond what is asked for.
    fn inside(&self, padded: &[f32], out: &mut [f32]) {
        match self.radius() {
            1 if SHORT => along_short::<1>(self, padded, out),
            2 if SHORT => along_short::<2>(self, padded, out),
            3 if SHORT => along_short::<3>(self, padded, out),
            _ => along_any(self, padded, out),
        }
    }

    /// Combines rows from one column on: `out[x] = Σ weights[k] rows[k][from + x]`.
    pub(crate) fn across(&self, rows: &[Vec<f32>], from: usize, out: &mut [f32]) {
        match self.radius() {
            1 if SHORT => across_short::<1>(self, rows, from, out),
            2 if SHORT => across_short::<2>(self, rows, from, out),
            3 if SHORT => across_short::<3>(self, rows, from, out),
            _ => across_any(self, rows, from, out),
        }
    }
}

/// `along` of a row as the newest of `rows`, the last one, and then `across` all of them.
///
/// For short kernels it is one walk: the newest row is weighed while it is still in registers.
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

/// Both ways over columns of a row that goes on beyond them.
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

/// Calls `run` with pieces of a row, `radius` pixels longer at both ends than the columns that
/// they are for, from left to right. The inside is read in place; `edge` holds the ends.
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
