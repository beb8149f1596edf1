//! Readouts and description of `panorama`.

use super::model::{MOVED_PX, PanoramaFigure};
use super::question::{Answer, Joint};
use crate::contract::{Readout, Words, format_number};
use epipole::stitch::{Blend, Surface};

impl Answer {
    /// Returns the inlier ratio of all homographies.
    fn inlier_ratio(&self) -> f64 {
        let sum = |count: fn(&Joint) -> usize| self.joints.iter().map(count).sum::<usize>();
        let (inliers, matches) = (
            sum(|joint| joint.num_inliers),
            sum(|joint| joint.num_matches),
        );
        inliers as f64 / matches.max(1) as f64
    }
}

impl Words for PanoramaFigure {
    fn readouts(&self) -> Vec<Readout> {
        let answer = self.answer();
        let missing = self.asked.missing();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let placed = answer.map(|answer| answer.turns_deg.iter().flatten().count() as f64);
        let turn = answer.and_then(|answer| answer.turns_deg.get(1).copied().flatten());
        let ratio = answer.map(|answer| 100.0 * answer.inlier_ratio());
        vec![
            number("focal", "Focal found", answer.map(|a| a.focal_px), 0, "px").main(),
            number("misfit", "Misfit", answer.map(|a| a.misfit_px), 2, "px").main(),
            number("inliers", "Inlier ratio", ratio, 0, "%").main(),
            number("turn", "Turn found", turn, 1, "°"),
            number("placed", "Photographs joined", placed, 0, ""),
        ]
    }

    fn describe(&self) -> String {
        let Some(answer) = self.answer() else {
            return self.asked.sentence();
        };
        let placed = answer.turns_deg.iter().flatten().count();
        let all = answer.turns_deg.len();
        let surface = match self.surface() {
            Surface::Plane => "a plane",
            _ => "a cylinder",
        };
        let blend = match self.blend() {
            Blend::Bands => "blended in bands",
            Blend::Feather => "as their mean",
            Blend::Seams => "with seams",
        };
        let left_out = match placed < all {
            true => format!(" {} of {all} overlap too little.", all - placed),
            false => String::new(),
        };
        let moved = match answer.misfit_px > MOVED_PX {
            true => {
                " A camera that only turned would fit better: it stepped aside, and near things shift \
                     against far ones."
            }
            false => "",
        };
        format!(
            "{placed} photographs joined on {surface}, {blend}: a focal length of {} px, and matches {} px from where \
             the turns put them.{left_out}{moved}",
            format_number(answer.focal_px, 0),
            format_number(answer.misfit_px, 2)
        )
    }
}
