//! Readouts and description of `homography-drag`.

use super::model::HomographyDrag;
use crate::contract::{Readout, Words, format_number};
use crate::kit::words;

impl Words for HomographyDrag {
    fn readouts(&self) -> Vec<Readout> {
        let homography = self.plane_from_photo();
        let length_cm = homography.is_ok().then(|| self.length_cm());
        let is_own = self.is_own();
        let truth = Readout::number("truth", "True distance", self.true_length_cm(), 1, "cm");
        let off = Readout::number("off", "Off cloth", self.off_cloth_px(), 1, "px");
        let matrix = homography.map_or_else(str::to_owned, |matrix| words::matrix(&matrix));
        vec![
            Readout::number("ruler", "Ruler", length_cm, 1, "cm").main(),
            truth.or("not known").main_if(!is_own),
            off.or("not known").main_if(!is_own),
            Readout::words("homography", "H, by rows", matrix),
        ]
    }

    fn describe(&self) -> String {
        if let Err(sentence) = self.plane_from_photo() {
            return sentence.to_owned();
        }
        let (width, height) = self.sides_cm();
        let length = format_number(self.length_cm(), 1);
        let truth = match self.true_length_cm() {
            Some(truth) => format!(
                " In the scene, its ends are {} cm apart.",
                format_number(truth, 1)
            ),
            None => String::new(),
        };
        format!(
            "A, B, C and D count as the corners of a rectangle of {width:.0} cm by {height:.0} cm, and the \
             homography that they give shows its plane from straight above. The ruler on it reads {length} \
             cm.{truth}"
        )
    }
}
