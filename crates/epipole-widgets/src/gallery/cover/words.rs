//! Readouts and description of `cover`.

use super::model::Cover;
use crate::contract::{Readout, Words, format_number};
use crate::kit::reconstruction::Answer;

fn num_points(answer: &Answer) -> usize {
    answer
        .motion
        .as_ref()
        .map_or(0, |motion| motion.points.len())
}

fn num_pixels(answer: &Answer) -> usize {
    let surface = answer.motion.as_ref().map(|motion| &motion.surface);
    surface
        .and_then(|surface| surface.as_ref().ok())
        .map_or(0, |surface| surface.points.len())
}

impl Words for Cover {
    fn readouts(&self) -> Vec<Readout> {
        let count = |id, label, get: fn(&Answer) -> usize| {
            let count = self.answer().map(|answer| get(answer) as f64);
            Readout::number(id, label, count, 0, "").or("not yet")
        };
        vec![
            count("features", "Points found", |answer| {
                answer.keypoints.iter().map(Vec::len).sum()
            })
            .main(),
            count("matches", "Matches", |answer| answer.matches.len()).main(),
            count("inliers", "Inliers", Answer::num_inliers).main(),
            count("points", "3-D points", num_points).main(),
            count("pixels", "Dense points", num_pixels),
        ]
    }

    fn describe(&self) -> String {
        let Some(answer) = self.answer() else {
            return match self.asked.problem() {
                Some(problem) => problem.to_owned(),
                None => "Two photographs are being taken.".to_owned(),
            };
        };
        let near = match (self.orbit.zoom() - 1.0).abs() < 1e-9 {
            true => String::new(),
            false => format!(", {}× as large", format_number(self.orbit.zoom(), 1)),
        };
        let place = format!("{}{near}", self.orbit.words());
        let words = match self.step() {
            0 => "One camera photographs the still life, takes a step aside, and photographs it again.".to_owned(),
            1 => format!(
                "In both photographs, points are found that can be found again: {} and {} of them.",
                answer.keypoints[0].len(),
                answer.keypoints[1].len()
            ),
            2 => format!(
                "{} points of one photograph have a match in the other; {} of these agree on one motion of the camera.",
                answer.matches.len(),
                answer.num_inliers()
            ),
            3 => "Each match sends a ray from either camera. Where the two rays cross, there is the point.".to_owned(),
            _ => match num_pixels(answer) {
                0 => format!("A cloud of {} points, and the two cameras that saw them.", num_points(answer)),
                pixels => format!(
                    "{} points tell where the two cameras stood. With that known, {pixels} pixels find their \
                     partners, and the table stands in space.",
                    num_points(answer)
                ),
            },
        };
        format!("{words} Seen from {place}.")
    }
}
