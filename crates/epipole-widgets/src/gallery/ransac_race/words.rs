//! What `ransac-race` says: its readouts and its description.

use super::model::RansacRace;
use crate::contract::{Readout, format_number};

pub(super) fn readouts(model: &RansacRace) -> Vec<Readout> {
    let of = |count: usize| format!("{count} of {}", model.data().len());
    let inliers_now = model.candidate().map_or_else(
        || "no sample yet".to_owned(),
        |candidate| of(candidate.is_inlier.iter().filter(|is| **is).count()),
    );
    let best = model
        .best()
        .map_or_else(|| "none yet".to_owned(), |best| of(best.num_inliers));
    let budget = match model.outcome().budget {
        Some(budget) => Readout::number("budget", "Samples needed (99 %)", budget as f64, 0, ""),
        None => Readout::words("budget", "Samples needed (99 %)", "not known yet"),
    };
    let angle = |id, label, angle: Option<f64>| match angle {
        Some(degrees) => Readout::number(id, label, degrees, 1, "°"),
        None => Readout::words(id, label, "no line yet"),
    };
    let angles = model.angles_deg();
    vec![
        Readout::count("iterations", "Samples drawn", model.outcome().iterations),
        budget,
        Readout::words("inliers", "Inliers of this sample", inliers_now),
        Readout::words("best", "Best so far", best),
        angle("ransac-error", "RANSAC from the truth", angles.ransac),
        angle(
            "least-squares-error",
            "Least squares from the truth",
            angles.least_squares,
        ),
        angle("between", "Between the two fits", angles.between),
    ]
}

pub(super) fn describe(model: &RansacRace) -> String {
    if let Some(problem) = model.problem() {
        return problem.to_owned();
    }
    let angles = model.angles_deg();
    let degrees = |angle: Option<f64>| format_number(angle.unwrap_or(0.0), 1);
    let least_squares = degrees(angles.least_squares);
    let Some(best) = model.best() else {
        return format!(
            "{} points, no sample drawn yet. Least squares is {least_squares}° from the true \
             line.",
            model.data().len()
        );
    };
    let end = if model.outcome().finished {
        " No more samples are needed for 99 % confidence.".to_owned()
    } else {
        match model.outcome().budget {
            Some(budget) => format!(" {budget} samples are needed for 99 % confidence."),
            None => String::new(),
        }
    };
    let plural = if model.outcome().iterations == 1 {
        "sample"
    } else {
        "samples"
    };
    format!(
        "After {} {plural}, RANSAC's best line has {} of {} points within {} px and is {}° \
         from the true line; least squares is {least_squares}° off.{end}",
        model.outcome().iterations,
        best.num_inliers,
        model.data().len(),
        format_number(model.epsilon_px(), 0),
        degrees(angles.ransac),
    )
}
