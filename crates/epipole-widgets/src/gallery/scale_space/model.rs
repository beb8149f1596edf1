//! A position in a photograph, the selected blur, and the responses of all blurs there.

use super::question::{Answer, Question};
use crate::contract::{
    Asking, Challenge, Compute, Control, Declared, Event, Handle, Knob, Model, Problem, Settings,
    Slider, knobs,
};
use crate::kit::features::SIZE;
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};

const SIGMA: Slider = Slider::new("sigma", "Blur σ")
    .range(2.0, 25.0, 0.1)
    .at(4.0)
    .digits(1)
    .unit("px");
const KNOBS: &[Knob] = knobs![SIGMA];
/// Initially on the shaded side of an orange.
const PROBE: Probe = Probe::new("probe", "photograph", "Probe")
    .over(SIZE)
    .step(4.0)
    .at(186.0, 275.0);

/// The strongest local extremum over the blur.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extremum {
    pub(super) sigma_px: f64,
    /// Response in gray levels; negative for bright blobs.
    pub(super) value: f64,
}

/// The model of `scale-space`.
pub(crate) struct ScaleSpace {
    settings: Settings,
    pub(super) asked: Computation<Question>,
    pub(super) probe: Probe,
}

impl ScaleSpace {
    pub(super) fn sigma_px(&self) -> f64 {
        self.settings.number(&SIGMA)
    }

    /// Returns the layer with the blur nearest to the slider's.
    pub(super) fn layer(&self, answer: &Answer) -> usize {
        let far = |index: &usize| libm::log(answer.layers[*index].sigma_px / self.sigma_px()).abs();
        let nearest = (0..answer.layers.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.unwrap_or(0)
    }

    /// Returns the responses at the probe, by increasing blur: blur in pixels, difference in gray
    /// levels.
    pub(super) fn answers(&self) -> Vec<(f64, f64)> {
        let layers = self.asked.answer().map_or(&[][..], |answer| &answer.layers);
        let place = self.probe.place();
        layers
            .iter()
            .map(|layer| (layer.sigma_px, layer.at(place)))
            .collect()
    }

    /// Returns the response at the slider's blur, interpolated between layers.
    pub(super) fn now(&self) -> Option<f64> {
        let (answers, sigma) = (self.answers(), self.sigma_px());
        let above = answers.iter().position(|(blur, _)| *blur >= sigma);
        let above = above.unwrap_or(answers.len().checked_sub(1)?).max(1);
        let (&(s0, d0), &(s1, d1)) = (answers.get(above - 1)?, answers.get(above)?);
        let share = (libm::log(sigma / s0) / libm::log(s1 / s0)).clamp(0.0, 1.0);
        Some(d0 + share * (d1 - d0))
    }

    /// Returns the strongest response that exceeds both neighbors.
    pub(super) fn extremum(&self) -> Option<Extremum> {
        let answers = self.answers();
        let three = answers.windows(3).filter_map(|three| {
            let [left, here, right] = [three[0].1, three[1].1, three[2].1].map(f64::abs);
            let same = three.iter().all(|(_, d)| (*d < 0.0) == (three[1].1 < 0.0));
            if !(same && here >= left && here > right) {
                return None;
            }
            // Fits a parabola to the three responses over the logarithm of the blur.
            let offset = 0.5 * (left - right) / (left - 2.0 * here + right);
            let step = libm::log(three[2].0 / three[1].0);
            let value = here - 0.25 * (left - right) * offset;
            Some(Extremum {
                sigma_px: three[1].0 * libm::exp(offset * step),
                value: value * three[1].1.signum(),
            })
        });
        three.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))
    }
}

impl Declared for ScaleSpace {
    const NAME: &'static str = "scale-space";
    const TITLE: &'static str = "How large is it?";
    const HELP: &'static str = "Move σ through the blurs and watch the point walk along the curve. Drag the \
        probe over the photograph, or click, to ask at another place.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            asked: Computation::of(Question),
            probe: PROBE,
        }
    }
}

impl Model for ScaleSpace {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.probe.update(event);
        self.settings.update(event).map(|_| ())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }
}

const CHALLENGES: &[Challenge<ScaleSpace>] = &[
    Challenge {
        id: "peak",
        goal: "Set σ to the size of what is under the probe, within 5%.",
        hint: "Where is the curve farthest from zero?",
        why: "The difference is strongest where the blur has the size of the thing, so the photograph itself \
              says how large the window must be.",
        check: |model| {
            let extremum = model.extremum();
            extremum.is_some_and(|found| (model.sigma_px() / found.sigma_px - 1.0).abs() < 0.05)
        },
        solution: || vec![Event::set(&SIGMA, 7.6)],
    },
    Challenge {
        id: "bright",
        goal: "Find something bright that is larger than 4 px.",
        hint: "Blur makes a bright spot darker, so its difference is negative.",
        why: "Blur spreads the light of a bright spot, so subtracting the weaker blur from the stronger one leaves \
              less than nothing there. SIFT keeps both kinds of extremum.",
        check: |model| {
            let extremum = model.extremum();
            extremum.is_some_and(|found| found.value < -4.0 && found.sigma_px > 4.0)
        },
        solution: || vec![Event::moved("probe", 210.0, 243.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::features::Pair;
    use crate::kit::question::settled;
    use std::ops::ControlFlow;

    /// Asserts that a SIFT keypoint is at the curve's extremum.
    #[test]
    fn the_extremum_is_the_scale_of_a_keypoint() {
        let mut model: ScaleSpace = settled(&[]);
        let pair = Pair::of_still_life(&mut |_| ControlFlow::Continue(())).unwrap();
        let keypoints = pair.features[0].keypoints.iter();
        let large = keypoints.filter(|one| (3.0..18.0).contains(&one.scale_px));
        let (mut near, mut all) = (0, 0);
        for keypoint in large.take(60) {
            model
                .update(&Event::moved(
                    "probe",
                    keypoint.u.round(),
                    keypoint.v.round(),
                ))
                .unwrap();
            all += 1;
            let scale = f64::from(keypoint.scale_px);
            near += usize::from(
                model
                    .extremum()
                    .is_some_and(|found| libm::log2(found.sigma_px / scale).abs() < 0.25),
            );
            assert!(model.now().is_some_and(f64::is_finite));
        }
        assert!(all > 30 && 4 * near > 3 * all, "{near} of {all}");
    }
}
