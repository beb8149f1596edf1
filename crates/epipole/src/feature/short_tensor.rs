//! Rows of the structure tensor for the usual derivative filters and windows of three weights: one
//! loop from gray values to derivatives, one to their products, one over the window.
//!
//! The sums are those of [`along_and_across`](crate::imaging::rows::along_and_across), in the
//! same order.

use crate::imaging::kernel::Three;
use crate::imaging::short_derivative::{ShortDerivative, pad};
use crate::imaging::{Border, GrayImage32};
use crate::math::simd::dispatched;

/// The tensor row by row.
pub(super) struct ShortTensor<'a> {
    derivative: ShortDerivative<'a>,
    window: Three,
    scale_sq: f32,
    height: usize,
    /// Border of the products.
    border: Border,
    du: Vec<f32>,
    dv: Vec<f32>,
    /// Iu², Iu Iv and Iv² of a row, with an extra pixel at either end.
    products: [Vec<f32>; 3],
    /// Sums along the last two rows of products, the older first.
    along: [[Vec<f32>; 2]; 3],
    /// The tensor: Σ w Iu², Σ w Iu Iv, Σ w Iv².
    pub(super) sums: [Vec<f32>; 3],
}

impl<'a> ShortTensor<'a> {
    /// * `scale_sq`: weight of the products
    /// * `border`: border of the products
    pub(super) fn new(
        image: &GrayImage32,
        derivative: ShortDerivative<'a>,
        window: Three,
        scale_sq: f32,
        border: Border,
    ) -> Self {
        let width = image.width() as usize;
        let row = |len: usize| vec![0.0; len];
        Self {
            derivative,
            window,
            scale_sq,
            height: image.height() as usize,
            border,
            du: row(width),
            dv: row(width),
            products: std::array::from_fn(|_| row(width + 2)),
            along: std::array::from_fn(|_| [row(width), row(width)]),
            sums: std::array::from_fn(|_| row(width)),
        }
    }

    /// Adds a row of products. Once there are three, `sums` belong to the middle one.
    ///
    /// * `row`: may be outside the image
    pub(super) fn push(&mut self, row: isize) {
        match self.border.index(row, self.height) {
            None => {
                for row in &mut self.products {
                    row.fill(self.border.constant());
                }
            }
            Some(y) => {
                self.derivative.row(y, &mut self.du, &mut self.dv);
                let [uu, uv, vv] = &mut self.products;
                multiply(self.scale_sq, &self.du, &self.dv, uu, uv, vv);
                for row in &mut self.products {
                    pad(row, self.border);
                }
            }
        }
        let all = self.products.iter().zip(&mut self.along);
        for ((products, [along, before]), sums) in all.zip(&mut self.sums) {
            sum_window(self.window, products, along, before, sums);
            std::mem::swap(along, before);
        }
    }
}

dispatched! {
    /// Computes the products of the derivatives.
    ///
    /// * `uu`, `uv`, `vv`: one value longer at either end, which is not changed
    fn multiply(
        scale_sq: f32,
        du: &[f32],
        dv: &[f32],
        uu: &mut [f32],
        uv: &mut [f32],
        vv: &mut [f32],
    ) {
        let n = du.len();
        let dv = &dv[..n];
        let (uu, uv, vv) = (&mut uu[1..n + 1], &mut uv[1..n + 1], &mut vv[1..n + 1]);
        for x in 0..n {
            uu[x] = du[x] * du[x] * scale_sq;
            uv[x] = du[x] * dv[x] * scale_sq;
            vv[x] = dv[x] * dv[x] * scale_sq;
        }
    }
}

dispatched! {
    /// Computes the sums over the window around the row before a new one.
    ///
    /// * `products`: the new row, one value longer at either end
    /// * `before`: sums along the previous row
    /// * `along`: sums of the row before that, replaced by those of the new row
    fn sum_window(
        window: Three,
        products: &[f32],
        along: &mut [f32],
        before: &[f32],
        sums: &mut [f32],
    ) {
        let n = along.len();
        let (left, here, right) = (&products[..n], &products[1..n + 1], &products[2..n + 2]);
        let (before, sums) = (&before[..n], &mut sums[..n]);
        for x in 0..n {
            let new = window.sum(left[x], here[x], right[x]);
            sums[x] = window.sum(along[x], before[x], new);
            along[x] = new;
        }
    }
}
