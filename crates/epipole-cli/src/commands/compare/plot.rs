//! Trajectories from above and their error along time, as SVG.

use nalgebra::Point3;
use std::fmt::Write;

/// Colors that differ for every kind of color vision (Okabe & Ito 2008).
const TRUTH: &str = "#444";
const ESTIMATE: &str = "#0072b2";

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 800.0;

/// Compared poses of two trajectories in the frame of the true one.
pub(super) struct Plot<'a> {
    /// Names of the files.
    pub(super) names: [String; 2],
    /// Centers of the cameras, equally many of both trajectories.
    pub(super) truth: &'a [Point3<f64>],
    pub(super) estimate: &'a [Point3<f64>],
    /// Seconds from the first pose, or indices of poses; ascending.
    pub(super) at: &'a [f64],
    /// Name and unit of `at`.
    pub(super) at_label: &'a str,
    pub(super) rmse_m: f64,
}

impl Plot<'_> {
    /// Draws the plot. The view is along the axis on which the true path extends least.
    pub(super) fn svg(&self) -> String {
        let [x, y] = ground(self.truth);
        let path = |points: &[Point3<f64>]| points.iter().map(|p| [p[x], p[y]]).collect::<Vec<_>>();
        let (truth, estimate) = (path(self.truth), path(self.estimate));
        let errors: Vec<[f64; 2]> = (self.truth.iter().zip(self.estimate).zip(self.at))
            .map(|((a, b), &at)| [at, (a - b).norm()])
            .collect();
        let all: Vec<[f64; 2]> = truth.iter().chain(&estimate).copied().collect();
        let above = Chart::new([80.0, 60.0, 650.0, 440.0], &all, true);
        let mut with_zero = errors.clone();
        with_zero.push([errors[0][0], 0.0]);
        let along = Chart::new([80.0, 570.0, 650.0, 170.0], &with_zero, false);
        let axis = |n: usize| format!("{} (m)", ["x", "y", "z"][n]);
        let [first, last] = [errors[0][0], errors[errors.len() - 1][0]];
        let rmse = [[first, self.rmse_m], [last, self.rmse_m]];
        let [truth_name, estimate_name] = self.names.each_ref().map(|name| escape(name));
        [
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
                 font-family=\"sans-serif\" font-size=\"13\">\n\
                 <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
                 <text x=\"80\" y=\"24\" fill=\"{TRUTH}\">– – true: {truth_name}</text>\n\
                 <text x=\"80\" y=\"44\" fill=\"{ESTIMATE}\">—— estimated: {estimate_name}</text>\n"
            ),
            above.frame(&axis(x), &axis(y)),
            above.line(&truth, TRUTH, "6 4"),
            above.line(&estimate, ESTIMATE, "none"),
            along.frame(self.at_label, "error (m)"),
            along.line(&rmse, TRUTH, "2 3"),
            along.line(&errors, ESTIMATE, "none"),
            format!(
                "<text x=\"80\" y=\"562\">dotted: root mean square, {:.6} m</text>\n</svg>\n",
                self.rmse_m
            ),
        ]
        .concat()
    }
}

/// Returns the two axes on which a path extends most, in order.
fn ground(points: &[Point3<f64>]) -> [usize; 2] {
    let extent = |axis: usize| {
        let [low, high] = range(points.iter().map(|p| p[axis]));
        high - low
    };
    // If extents are equal, the last axis is up.
    let up = (0..3)
        .rev()
        .min_by(|&a, &b| extent(a).total_cmp(&extent(b)));
    match up {
        Some(0) => [1, 2],
        Some(1) => [0, 2],
        _ => [0, 1],
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

/// A frame with axes.
struct Chart {
    /// Left, top, width and height.
    place: [f64; 4],
    x: [f64; 2],
    y: [f64; 2],
}

impl Chart {
    /// * `is_square`: equal scales on both axes
    fn new(place: [f64; 4], points: &[[f64; 2]], is_square: bool) -> Self {
        let [_, _, width, height] = place;
        let mut ranges = [0, 1].map(|axis| range(points.iter().map(|p| p[axis])));
        let sizes = [width, height];
        let scale = |n: usize| (ranges[n][1] - ranges[n][0]) / sizes[n];
        let common = scale(0).max(scale(1));
        for n in 0..2 {
            let [low, high] = ranges[n];
            let mut extent = if is_square {
                common * sizes[n]
            } else {
                high - low
            };
            if extent <= 0.0 {
                extent = 1.0;
            }
            let middle = f64::midpoint(low, high);
            ranges[n] = [middle - 0.54 * extent, middle + 0.54 * extent];
        }
        let [x, y] = ranges;
        Self { place, x, y }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top, width, height] = self.place;
        let fraction = |[low, high]: [f64; 2], value: f64| (value - low) / (high - low);
        [
            left + width * fraction(self.x, x),
            top + height * (1.0 - fraction(self.y, y)),
        ]
    }

    fn line(&self, points: &[[f64; 2]], color: &str, dashes: &str) -> String {
        let mut text = String::new();
        for point in points {
            let [u, v] = self.at(*point);
            // Writing to a string does not fail.
            let _ = write!(text, "{u:.2},{v:.2} ");
        }
        format!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\" \
             stroke-dasharray=\"{dashes}\"/>\n",
            text.trim_end()
        )
    }

    fn frame(&self, x_label: &str, y_label: &str) -> String {
        let [left, top, width, height] = self.place;
        let (right, bottom) = (left + width, top + height);
        let mut text = format!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#999\"/>\n"
        );
        for (value, label) in ticks(self.x) {
            let [u, _] = self.at([value, self.y[0]]);
            let below = bottom + 18.0;
            let _ = writeln!(
                text,
                "<path d=\"M{u:.2} {top}V{bottom}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{u:.2}\" y=\"{below}\" text-anchor=\"middle\">{label}</text>"
            );
        }
        for (value, label) in ticks(self.y) {
            let [_, v] = self.at([self.x[0], value]);
            let (beside, base) = (left - 6.0, v + 4.0);
            let _ = writeln!(
                text,
                "<path d=\"M{left} {v:.2}H{right}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{beside}\" y=\"{base:.2}\" text-anchor=\"end\">{label}</text>"
            );
        }
        let (middle, below) = (left + width / 2.0, bottom + 38.0);
        let (beside, level) = (left - 62.0, top + height / 2.0);
        let _ = write!(
            text,
            "<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{x_label}</text>\n\
             <text transform=\"translate({beside} {level}) rotate(-90)\" text-anchor=\"middle\">{y_label}</text>\n"
        );
        text
    }
}

/// Returns round values within a range, with their labels.
fn ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let rough = (high - low) / 6.0;
    let exponent = libm::floor(libm::log10(rough));
    let power = libm::pow(10.0, exponent);
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|&step| step >= rough)
        .unwrap_or(rough);
    let decimals = (-exponent).clamp(0.0, 12.0) as usize;
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first).clamp(0.0, 20.0) as u32;
    (0..=count)
        .map(|n| (first + f64::from(n)) * step)
        .map(|value| (value, format!("{:.decimals$}", value + 0.0)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let labels = |range| ticks(range).into_iter().map(|t| t.1).collect::<Vec<_>>();
        assert_eq!(labels([0.0, 6.0]), ["0", "1", "2", "3", "4", "5", "6"]);
        assert_eq!(
            labels([-0.11, 0.1]),
            ["-0.10", "-0.05", "0.00", "0.05", "0.10"]
        );
        assert_eq!(
            labels([98.0, 203.0]),
            ["100", "120", "140", "160", "180", "200"]
        );
    }

    #[test]
    fn a_path_is_drawn_along_its_least_extent() {
        let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
        assert_eq!(ground(&[at(0.0, 0.0, 0.0), at(5.0, 1.0, 9.0)]), [0, 2]);
        assert_eq!(ground(&[at(1.0, 1.0, 1.0)]), [0, 1]);
    }

    #[test]
    fn both_axes_have_one_scale_from_above() {
        let chart = Chart::new([0.0, 0.0, 650.0, 440.0], &[[0.0, 0.0], [2.0, 1.0]], true);
        let [a, b] = [[0.0, 0.0], [1.0, 1.0]].map(|p| chart.at(p));
        assert!((b[0] - a[0] - (a[1] - b[1])).abs() < 1e-9);
    }
}
