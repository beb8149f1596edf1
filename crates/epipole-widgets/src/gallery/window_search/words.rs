//! Readouts and description of `window-search`.

use super::model::WindowSearch;
use super::search::{Curve, Refinement};
use crate::contract::{Readout, Words, format_number};
use crate::kit::rectified::{BASELINE_M, depth_m};

impl Words for WindowSearch {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let (found, truth) = (self.found_px(), self.truth_px());
        let depth_m = |disparity_px| depth_m(BASELINE_M, disparity_px);
        let whole = self.curve().map(|curve| curve.winner() as f64);
        let cost = |disparity: usize| self.curve()?.costs().get(disparity).copied();
        let lowest = self.curve().and_then(|curve| cost(curve.winner()));
        let highest = self.curve().map(Curve::highest);
        let rival = self.rival().map_or(missing.to_owned(), |(at, ratio)| {
            format!("{at} px, {} times the cost", format_number(ratio, 2))
        });
        let visibility = self
            .is_hidden()
            .map_or(missing, |is_hidden| match is_hidden {
                true => "hidden on the right",
                false => "both cameras see it",
            });
        vec![
            number("found", "Minimum", found, 2, "px").main(),
            number("truth", "True d", truth, 2, "px").main(),
            number("error", "Off by", self.error_px().map(f64::abs), 2, "px").main(),
            number(
                "cost",
                "Candidate's cost",
                cost(self.candidate_px()),
                1,
                "levels",
            )
            .main(),
            number("whole", "Whole pixels", whole, 0, "px"),
            number("lowest", "Lowest cost", lowest, 1, "levels"),
            number("highest", "Highest cost", highest, 1, "levels"),
            Readout::words("rival", "Second minimum", rival),
            number("depth", "Depth found", found.and_then(depth_m), 3, "m"),
            number("true-depth", "True depth", truth.and_then(depth_m), 3, "m"),
            Readout::words("hidden", "Visibility", visibility),
        ]
    }

    fn describe(&self) -> String {
        let (Some(curve), Some(found), Some(truth)) =
            (self.curve(), self.found_px(), self.truth_px())
        else {
            return self.asked.sentence();
        };
        let side = 2 * self.half_px() + 1;
        let by = match self.refinement() {
            Refinement::TwoLines => "two lines",
            Refinement::Parabola => "a parabola",
        };
        let candidate = self.candidate_px();
        let costs = curve.costs();
        format!(
            "A window of {side} by {side} px at {}. Its cost is lowest at a disparity of {} px, {} by {by}; {} px \
             is true. The candidate at {candidate} px costs {} gray levels per pixel, the lowest {}.",
            self.place.text(),
            curve.winner(),
            format_number(found, 2),
            format_number(truth, 2),
            format_number(costs[candidate], 1),
            format_number(costs[curve.winner()], 1),
        )
    }
}
