//! Exposure compensation: one gain per photo.

use super::canvas::{Canvas, View};
use super::layer::{color, weight};
use image::RgbImage;
use nalgebra::{DMatrix, DVector};

/// Distance between canvas positions to compare, pixels.
const STEP_PX: usize = 8;

/// Standard deviation of the difference of two photos, of 255.
const NOISE: f64 = 10.0;

/// Standard deviation of a gain from 1.
const SPREAD: f64 = 0.1;

/// Computes the gain of each view that best equalizes overlapping photos.
///
/// Source: Brown & Lowe 2007, §6.
pub(super) fn gains(canvas: &Canvas, views: &[View], photos: &[&RgbImage]) -> Vec<f32> {
    let count = views.len();
    let mut sums = DMatrix::<f64>::zeros(count, count);
    let mut numbers = DMatrix::<f64>::zeros(count, count);
    for v in (0..canvas.height()).step_by(STEP_PX) {
        for u in (0..canvas.width()).step_by(STEP_PX) {
            let mut visible: Vec<(usize, f64)> = Vec::new();
            for (n, view) in views.iter().enumerate() {
                let photo = photos[view.image];
                let is_near = view.columns.contains(&u) && view.rows.contains(&v);
                if is_near && weight(canvas, view, photo.dimensions(), u, v) > 0.0 {
                    let sum: f32 = color(canvas, view, photo, u, v).iter().sum();
                    visible.push((n, f64::from(sum) / 3.0));
                }
            }
            for &(i, value) in &visible {
                for &(j, _) in visible.iter().filter(|(j, _)| *j != i) {
                    sums[(i, j)] += value;
                    numbers[(i, j)] += 1.0;
                }
            }
        }
    }
    let mut normal = DMatrix::<f64>::zeros(count, count);
    let mut right = DVector::<f64>::zeros(count);
    for i in 0..count {
        // A photo without overlap keeps its exposure.
        let mut prior = 1e-9;
        for j in (0..count).filter(|&j| numbers[(i, j)] > 0.0) {
            let number = numbers[(i, j)];
            let (own, other) = (sums[(i, j)] / number, sums[(j, i)] / number);
            normal[(i, i)] += 2.0 * number * own * own / (NOISE * NOISE);
            normal[(i, j)] -= 2.0 * number * own * other / (NOISE * NOISE);
            prior += number / (SPREAD * SPREAD);
        }
        normal[(i, i)] += prior;
        right[i] = prior;
    }
    match normal.cholesky() {
        Some(factors) => factors
            .solve(&right)
            .iter()
            .map(|gain| *gain as f32)
            .collect(),
        None => vec![1.0; count],
    }
}
