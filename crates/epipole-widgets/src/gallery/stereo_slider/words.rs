//! Readouts and description of `stereo-slider`.

use super::model::StereoSlider;
use super::rig::Sight;
use crate::contract::{Readout, Words, format_number};
use crate::kit::guess::NOT_COMPARED;
use epipole::stereo::DepthInterval;

/// Description of a rig without a baseline.
pub(super) const NO_BASELINE: &str = "The baseline is 0, so both cameras stand at the same place: \
    the photographs are equal, every disparity is 0, and depth cannot be measured.";

/// Text in place of a missing number.
const UNKNOWN: &str = "unknown";

impl Words for StereoSlider {
    fn readouts(&self) -> Vec<Readout> {
        let rig = self.rig();
        let pixels = rig.pixels().ok();
        let measured = rig.measured();
        let is_hidden = !self.reveal().shows_answer();
        let unknown = if is_hidden { "hidden" } else { UNKNOWN };
        let interval = self.shown().map(|measured| measured.interval);
        let digits = interval.map_or(2, |interval| depth_digits(&interval));
        let say = |id, label, value: Option<f64>, digits, unit, otherwise: &str| {
            Readout::number(id, label, value, digits, unit).or(otherwise)
        };
        let column = |index: usize| pixels.map(|pixels| pixels[index].x);
        let right_px = column(1).filter(|_| !is_hidden);
        let disparity_px = column(0).zip(right_px).map(|(left, right)| left - right);
        let depth_m = measured.map(|measured| measured.depth_m);
        let near_m = interval.map(|interval| interval.near_m);
        let far_m = interval.and_then(|interval| interval.far_m);
        let far = interval.map_or(unknown, |_| "infinitely far");
        let reach = interval.map_or_else(|| unknown.to_owned(), |interval| reach(&interval));
        vec![
            say("disparity", "Disparity d", disparity_px, 1, "px", unknown).main(),
            say("depth", "Z = f B / d", depth_m, 2, "m", UNKNOWN).main(),
            Readout::words("interval", "At d ± 1 px", reach).main(),
            say("u-left", "Left column", column(0), 1, "px", UNKNOWN),
            say("u-right", "Right column", right_px, 1, "px", unknown),
            say("near", "Z at d + 1 px", near_m, digits, "m", unknown),
            say("far", "Z at d − 1 px", far_m, digits, "m", far),
            say(
                "off",
                "Guess off",
                self.guess_off_px(),
                0,
                "px",
                NOT_COMPARED,
            ),
        ]
    }

    fn describe(&self) -> String {
        let rig = self.rig();
        let Some(measured) = rig.measured() else {
            return NO_BASELINE.to_owned();
        };
        let number = format_number;
        if let Some(guess) = self.guess().filter(|_| self.shown().is_none()) {
            return format!(
                "The ball is {} m away, and the left photograph shows it in column {}. The right photograph is \
                 hidden; your guess is column {}.",
                number(rig.z_m, 2),
                rig.pixels()
                    .map_or_else(|_| UNKNOWN.to_owned(), |[left, _]| number(left.x, 1)),
                number(guess.x, 0)
            );
        }
        let mut sentence = format!(
            "With a baseline of {} m and a focal length of {} px, the ball at {} m has a disparity of \
             {} px. One pixel of error leaves every depth from {} possible.",
            number(rig.baseline_m, 2),
            number(rig.focal_px, 0),
            number(measured.depth_m, 2),
            number(measured.disparity_px, 1),
            reach(&measured.interval),
        );
        if let Some(off_px) = self.guess_off_px() {
            let off = number(off_px, 0);
            sentence.push_str(&format!(" Your guess is {off} px off."));
        }
        if let Some(trouble) = trouble(rig.sights()) {
            sentence.push(' ');
            sentence.push_str(&trouble);
        }
        sentence
    }
}

/// Returns the reason why a real pair could not measure the ball, as a sentence.
fn trouble(sights: Result<[Sight; 2], epipole::Error>) -> Option<String> {
    let Ok(sights) = sights else {
        return Some("It is not on the table.".to_owned());
    };
    let sides = ["left", "right"];
    match sights {
        [Sight::Clear, Sight::Clear] => None,
        [Sight::Outside, Sight::Outside] => Some("Neither photograph shows it.".to_owned()),
        [Sight::Hidden(by), Sight::Hidden(other)] if by == other => {
            Some(format!("In both photographs {by} hides it."))
        }
        _ => (0..2).find_map(|index| match sights[index] {
            Sight::Clear => None,
            Sight::Outside => Some(format!(
                "The {} photograph does not show it, so a real pair could not measure it.",
                sides[index]
            )),
            Sight::Hidden(by) => Some(format!(
                "In the {} photograph {by} hides it, so a real pair could not measure it.",
                sides[index]
            )),
        }),
    }
}

/// Formats an interval of depths, such as "2.71 to 2.90 m".
pub(super) fn reach(interval: &DepthInterval) -> String {
    let near_m = interval.near_m;
    match interval.far_m {
        Some(far_m) => {
            let digits = depth_digits(interval);
            let (near, far) = (format_number(near_m, digits), format_number(far_m, digits));
            format!("{near} to {far} m")
        }
        None => format!("{} m to infinity", format_number(near_m, 2)),
    }
}

/// Returns the number of digits that distinguishes the ends of an interval.
fn depth_digits(interval: &DepthInterval) -> usize {
    match interval.far_m {
        Some(far_m) if far_m - interval.near_m < 0.1 => 3,
        _ => 2,
    }
}
