//! Lines through points, and the number of samples that RANSAC needs.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::options::Options;
use crate::output::records;
use epipole::math::Line2;
use epipole::robust::{
    self, LeastMedian, LeastMedianOptions, LineEstimator, RansacOptions, RansacReport,
};

records! {
    /// Line with the least median of squared distances.
    LeastMedian<Line2> as LeastMedianLine {
        /// Line (a, b, c), fitted to its inliers: `a u + b v + c = 0`, a² + b² = 1.
        model: Line2,
        /// Median distance from the best line of a sample, pixels.
        median_px: f64,
        /// Standard deviation of the noise that follows from the median, pixels.
        sigma_px: f64,
        /// Number of points within 2.5 standard deviations, equal points counted once.
        num_inliers: usize,
    }
}

functions! {
    /// Line of points with outliers, by RANSAC: (a, b, c) with `a u + b v + c = 0`, a² + b² = 1.
    fn estimate_line(
        points: Vectors<2>, options: Options<RansacOptions>; monitor
    ) -> RansacReport<Line2> {
        robust::ransac(LineEstimator::new(&points.points())?, &options.0, monitor)?
    }

    /// Line (a, b, c) with the least sum of squared distances from points.
    fn fit_line_total_least_squares(points: Vectors<2>) -> Line2 {
        robust::fit_line_total_least_squares(&points.points())?
    }

    /// Line (a, b, c) with the least sum of Huber losses of the distances from points, which are
    /// linear beyond `widthPx` pixels.
    fn fit_line_huber(points: Vectors<2>, width_px: f64) -> Line2 {
        robust::fit_line_huber(&points.points(), width_px)?
    }

    /// Line of points of which fewer than half are outliers, by the least median of squares;
    /// needs no threshold.
    fn least_median_line(
        points: Vectors<2>, options: Options<LeastMedianOptions>; monitor
    ) -> LeastMedian<Line2> {
        robust::least_median(LineEstimator::new(&points.points())?, &options.0, monitor)?
    }

    /// Number of samples that suffices for a confidence in (0, 1), if data are drawn with
    /// replacement; `inlierRatio` is in [0, 1]. Infinity if no number does.
    fn num_trials_with_replacement(
        inlier_ratio: f64, sample_size: u32, confidence: f64
    ) -> u64 {
        robust::num_trials_with_replacement(inlier_ratio, sample_size as usize, confidence)?
    }

    /// Number of samples that suffices for a confidence in (0, 1), if data are drawn without
    /// replacement. Infinity if no number does.
    fn num_trials_without_replacement(
        num_inliers: u32, num_data: u32, sample_size: u32, confidence: f64
    ) -> u64 {
        let [inliers, data, size] = [num_inliers, num_data, sample_size].map(|x| x as usize);
        robust::num_trials_without_replacement(inliers, data, size, confidence)?
    }
}
