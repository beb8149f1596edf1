//! What `ransac-epipolar` says: its readouts and its description.

use super::model::{RansacEpipolar, Show};
use crate::contract::{Readout, format_number};
use crate::words;
use epipole::epipolar::epipolar_line2;
use nalgebra::Point2;

pub(super) fn readouts(model: &RansacEpipolar) -> Vec<Readout> {
    let Some(run) = model.run() else {
        return vec![Readout::words("state", "State", describe(model))];
    };
    let of = |count: usize| format!("{count} of {}", model.matches().len());
    let votes = match run.candidate() {
        Some(candidate) => of(candidate.num_inliers),
        None => "no sample yet".to_owned(),
    };
    let needed = "Samples needed (99 %)";
    let mut readouts = vec![
        Readout::count("matches", "Matches", model.matches().len()),
        Readout::count("iterations", "Samples drawn", run.iterations()),
        match run.budget() {
            Some(budget) => Readout::number("budget", needed, budget as f64, 0, ""),
            None => Readout::words("budget", needed, "more than a million"),
        },
        Readout::words("inliers", "Inliers of the last sample", votes),
    ];
    match run.best() {
        Some(best) => readouts.extend([
            Readout::words("best", "Inliers of the best", of(best.num_inliers)),
            Readout::number(
                "sampson",
                "Their mean Sampson distance",
                best.mean_px,
                3,
                "px",
            ),
        ]),
        None => readouts.push(Readout::words("best", "Inliers of the best", "none yet")),
    }
    if let (Some(best), Some(num_right)) = (run.best(), model.num_right()) {
        let all = model.matches();
        let right = all
            .iter()
            .filter(|found| found.is_right == Some(true))
            .count();
        readouts.push(Readout::words(
            "right",
            "Right matches among the inliers",
            format!("{num_right} of {}", best.num_inliers),
        ));
        readouts.push(Readout::words(
            "found",
            "Right matches in all",
            right.to_string(),
        ));
    }
    if let Some(best) = run.best() {
        let (u, v) = model.probe();
        if let Ok(line) = epipolar_line2(&best.fundamental, &Point2::new(u, v)) {
            readouts.push(Readout::words(
                "line",
                "Line of the probe",
                words::line(&line),
            ));
        }
        let f = words::matrix(&best.fundamental);
        readouts.push(Readout::words("f", "F refitted to the inliers, by rows", f));
    }
    readouts
}

pub(super) fn describe(model: &RansacEpipolar) -> String {
    if let Some(problem) = model.problem() {
        return problem.to_owned();
    }
    let Some(run) = model.run() else {
        return "Matching the features of two photographs.".to_owned();
    };
    let num_matches = model.matches().len();
    let Some(best) = run.best() else {
        return format!("{num_matches} matches, some of them wrong; no F found yet.");
    };
    let plural = if run.iterations() == 1 {
        "sample"
    } else {
        "samples"
    };
    let right = model.num_right().map_or_else(String::new, |count| {
        format!(", {count} of which are right by the scene's true geometry")
    });
    let end = match run.budget() {
        _ if run.is_confident() => " That is enough for 99 % confidence.".to_owned(),
        _ if run.is_finished() => {
            " More would be needed for 99 % confidence, but the figure stops here.".to_owned()
        }
        Some(budget) => format!(" {budget} samples are needed for 99 % confidence."),
        None => String::new(),
    };
    let show = match model.show() {
        Show::Matches => "",
        Show::Outliers => " Outliers are shown.",
        Show::Lines => " Epipolar lines are shown.",
    };
    format!(
        "After {} {plural}, {} of {num_matches} matches agree on one F within {} px{right}. \
             Their mean Sampson distance is {} px.{end}{show}",
        run.iterations(),
        best.num_inliers,
        format_number(model.epsilon_px(), 1),
        format_number(best.mean_px, 2),
    )
}
