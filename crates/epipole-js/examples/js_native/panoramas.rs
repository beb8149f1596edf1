//! Calls of functions of panoramas.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::Value;

impl Calls {
    pub(super) fn add_panoramas(&mut self) -> Result<(), Failure> {
        let photos = [texture(160, 120, 0), texture(160, 120, 40)];
        let photos = Value::List(photos.map(|photo| colors(&photo, 3)).to_vec());
        let steps =
            (0..60).map(|step| (f64::from(40 + step * 37 % 119), f64::from(step * 71 % 120)));
        let pixels1 = Value::Doubles(steps.clone().flat_map(|(u, v)| [u, v]).collect());
        let pixels2 = Value::Doubles(steps.flat_map(|(u, v)| [u - 40.0, v]).collect());
        let (first, second) = (Value::Number(0.0), Value::Number(1.0));
        let images = [first.clone(), second.clone()];
        let [given1, given2] = [pixels1.clone(), pixels2];
        let flat = self.add("findOverlap", &[first, second, given1, given2.clone()])?;
        if doubles(&get(&flat, "pixels1")).len() != 120 {
            return Err("all matches of a shift agree".into());
        }
        let overlaps = Value::List(vec![flat.clone()]);
        let count = Value::Number(2.0);
        let placed = self.add("chainHomographies", &[count, overlaps.clone()])?;
        self.fail("chainHomographies", &[Value::Number(1.0), overlaps])?;
        let plane = record([("surface", text("plane")), ("gains", Value::Flag(false))]);
        self.add("renderPanorama", &[placed.clone(), photos.clone(), plane])?;
        let few = Value::List(vec![texture(160, 120, 0)]);
        self.fail("renderPanorama", &[placed, few])?;

        let k = record([
            ("fuPx", Value::Number(150.0)),
            ("fvPx", Value::Number(150.0)),
            ("cuPx", Value::Number(79.5)),
            ("cvPx", Value::Number(59.5)),
        ]);
        let rotated = tilted(&pixels1, &k);
        let [first, second] = images;
        let overlap = self.add(
            "findOverlap",
            &[first.clone(), second.clone(), pixels1.clone(), rotated],
        )?;
        let overlaps = Value::List(vec![overlap]);
        let guess = Value::List(vec![k.clone(), k]);
        for find_focal in [false, true] {
            let given = [guess.clone(), overlaps.clone(), Value::Flag(find_focal)];
            let panorama = self.add("estimatePanorama", &given)?;
            if (numbers(&panorama, "scalePx") - 150.0).abs() > 0.01 {
                return Err("the focal length is found".into());
            }
            for blend in ["bands", "feather"] {
                let options = record([("surface", text("sphere")), ("blend", text(blend))]);
                self.add(
                    "renderPanorama",
                    &[panorama.clone(), photos.clone(), options],
                )?;
            }
        }
        // Matches without a common homography.
        let strange = Value::Doubles((0..120).map(|k| f64::from(k * k * 31 % 117)).collect());
        self.add("findOverlap", &[first, second, pixels1, strange])?;
        Ok(())
    }
}
