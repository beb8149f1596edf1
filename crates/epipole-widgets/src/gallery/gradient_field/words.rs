//! Readouts and description of `gradient-field`.

use super::model::{Beside, GradientField};
use crate::contract::{Readout, Words, format_number};

impl GradientField {
    fn shown_beside(&self) -> String {
        match self.beside() {
            Beside::Surface => format!("surface, {}", self.orbit.seen_from()),
            Beside::Curve => "noise and slope over smoothing".to_owned(),
        }
    }
}

impl Words for GradientField {
    fn readouts(&self) -> Vec<Readout> {
        let Some(arrow) = self.probed() else {
            return vec![Readout::words("state", "State", self.describe()).main()];
        };
        let slope = |id, label, value| Readout::number(id, label, value, 1, "");
        let mut readouts = vec![
            slope("iu", "Iu", arrow.du).main(),
            slope("iv", "Iv", arrow.dv).main(),
            slope("magnitude", "Magnitude |∇I|", arrow.magnitude()).main(),
            match arrow.magnitude() > 0.0 {
                true => Readout::number("direction", "Angle", arrow.angle_deg(), 1, "°"),
                false => Readout::words("direction", "Angle", "none"),
            }
            .main(),
        ];
        if let Some(off_deg) = self.off_deg() {
            readouts.push(Readout::number("off", "Arrow error", off_deg, 1, "°"));
        }
        for (smooth_px, ids, labels) in [
            (
                self.smooth_px(),
                ["slope", "left", "ratio"],
                ["Edge slope", "Slope noise", "Ratio"],
            ),
            (
                Some(self.sigma_px()),
                ["smooth-slope", "smooth-left", "smooth-ratio"],
                ["Smoothed slope", "Smoothed noise", "Smoothed ratio"],
            ),
        ] {
            if let Some(quality) = self.quality(smooth_px) {
                readouts.push(Readout::number(ids[0], labels[0], quality.slope, 2, ""));
                readouts.push(Readout::number(ids[1], labels[1], quality.noise, 2, ""));
                readouts.push(if quality.noise > 0.0 {
                    Readout::number(ids[2], labels[2], quality.slope / quality.noise, 1, "")
                } else {
                    Readout::words(ids[2], labels[2], "no noise")
                });
            }
        }
        readouts.push(Readout::words(
            "beside-it",
            "Beside it",
            self.shown_beside(),
        ));
        readouts
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.problem() {
            return problem.to_owned();
        }
        let Some(arrow) = self.probed() else {
            return format!("{}.", self.field().err().unwrap_or("There is no image"));
        };
        let (u, v) = arrow.at;
        let what = match self.edge() {
            Some(edge) => format!(
                "An edge at {}° with noise of {} gray levels",
                format_number(edge.angle_deg, 0),
                format_number(edge.noise, 0)
            ),
            None => "A photograph".to_owned(),
        };
        let smoothed = match self.smooth_px() {
            Some(sigma_px) => format!("smoothed by {} px", format_number(sigma_px, 1)),
            None => "not smoothed".to_owned(),
        };
        let off = self.off_deg().map_or(String::new(), |off| {
            format!(
                " The arrows on the edge are off by {}° (root mean square).",
                format_number(off, 1)
            )
        });
        if arrow.magnitude() == 0.0 {
            return format!(
                "{what}, {smoothed}. At column {u}, row {v} it is flat: the gradient is zero.{off}"
            );
        }
        format!(
            "{what}, {smoothed}. At column {u}, row {v} the gradient is ({}, {}), of magnitude {} and angle \
             {}°.{off}",
            format_number(arrow.du, 1),
            format_number(arrow.dv, 1),
            format_number(arrow.magnitude(), 1),
            format_number(arrow.angle_deg(), 1),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::{Event, Model};
    use crate::kit::question::{settle, settled};
    use image::RgbImage;

    #[test]
    fn a_photograph_of_one_color_has_no_direction() {
        let own = Event::Set {
            id: "source".into(),
            value: "own".into(),
        };
        let mut model: GradientField = settled(&[own]);
        model.take_photo("photo", RgbImage::new(40, 30)).unwrap();
        settle(&mut model);
        let readouts = model.readouts();
        let direction = readouts.iter().find(|readout| readout.id == "direction");
        assert_eq!(direction.unwrap().text, "none");
        assert!(model.describe().contains("it is flat"));
    }
}
