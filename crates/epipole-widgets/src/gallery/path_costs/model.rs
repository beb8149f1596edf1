//! A pixel of the left photograph, the penalties, and the paths to it.

use super::costs::{Costs, DIRECTIONS, Penalties, RIGHT_PX, path_winner_px};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, knobs,
};
use crate::kit::picture::Picture;
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use crate::kit::rectified::{PairQuestion, SIZE};
use epipole::imaging::rgb_to_gray;
use epipole::stereo::PathCosts;
use image::GrayImage;

const COUNT: Choice = Choice::new(
    "directions",
    "Directions",
    &[("1", "1"), ("2", "2"), ("4", "4"), ("5", "5"), ("8", "8")],
)
.at(4);
const SMALL: Slider = Slider::new("p1", "P₁").range(0.0, 60.0, 1.0).at(20.0);
const LARGE: Slider = Slider::new("p2", "P₂").range(0.0, 150.0, 1.0).at(100.0);
/// Options in the order of the core's path steps, after the first.
const SHOWN: Choice = Choice::new(
    "path",
    "Marked path",
    &[
        ("none", "None"),
        ("left", "From the left"),
        ("right", "From the right"),
        ("above", "From above"),
        ("below", "From below"),
        ("upper-left", "From upper left"),
        ("lower-right", "From lower right"),
        ("upper-right", "From upper right"),
        ("lower-left", "From lower left"),
    ],
)
.at(1);
const KNOBS: &[Knob] = knobs![COUNT, SMALL, LARGE, SHOWN];

const PLACE: Probe = Probe::new("place", "left", "Pixel")
    .over(SIZE)
    .at(100.0, 64.0);

/// The model of `path-costs`.
pub(crate) struct PathCostsModel {
    settings: Settings,
    pub(super) place: Probe,
    pub(super) asked: Computation<PairQuestion>,
    /// Both photographs in gray, once available.
    grays: Option<[GrayImage; 2]>,
    costs: Option<Costs>,
}

impl PathCostsModel {
    /// Returns the costs, once the photographs are available.
    pub(super) fn costs(&self) -> Option<&Costs> {
        self.costs.as_ref()
    }

    /// Returns the left photograph in gray, the input of the matching.
    pub(super) fn gray(&self) -> Option<&GrayImage> {
        self.grays.as_ref().map(|[left, _]| left)
    }

    /// Returns the penalties, with P2 raised to P1 if it is smaller.
    pub(super) fn penalties(&self) -> Penalties {
        let [small, large] = [&SMALL, &LARGE].map(|slider| self.settings.number(slider) as u8);
        Penalties {
            small,
            large: large.max(small),
        }
    }

    /// Returns the chosen directions, as indices into the core's path steps.
    pub(super) fn directions(&self) -> &'static [usize] {
        DIRECTIONS[self.settings.chosen(&COUNT)]
    }

    /// Returns the index of the marked path, if it is among the chosen directions.
    pub(super) fn marked(&self) -> Option<usize> {
        let index = self.settings.chosen(&SHOWN).checked_sub(1)?;
        self.directions().contains(&index).then_some(index)
    }

    /// Returns the marked path with its costs.
    pub(super) fn marked_path(&self) -> Option<&PathCosts> {
        let marked = self.marked()?;
        let mut paths = self.costs()?.paths();
        paths.find_map(|(index, path)| (index == marked).then_some(path))
    }

    /// Returns the name of the marked path's direction.
    pub(super) fn marked_label(&self) -> Option<&'static str> {
        self.marked().map(|_| self.settings.label(&SHOWN))
    }

    /// Returns the true disparity at the pixel, pixels.
    pub(super) fn truth_px(&self) -> Option<f64> {
        let (u, v) = self.place.pixel();
        self.asked.answer()?.truth.get(u, v).map(f64::from)
    }

    /// Returns whether the pixel is hidden from the right camera.
    pub(super) fn is_hidden(&self) -> Option<bool> {
        let (u, v) = self.place.pixel();
        Some(self.asked.answer()?.is_hidden(u, v))
    }

    /// Returns the distance of a whole disparity from the truth, pixels.
    fn off_px(&self, disparity_px: usize) -> Option<f64> {
        Some((disparity_px as f64 - self.truth_px()?).abs())
    }

    /// Returns errors of the lowest matching cost and of the lowest sum, pixels; `None` if the
    /// pixel is hidden from the right camera.
    fn errors_px(&self) -> Option<[f64; 2]> {
        let costs = self.costs().filter(|_| self.is_hidden() == Some(false))?;
        Some([
            self.off_px(costs.raw_winner_px())?,
            self.off_px(costs.winner_px())?,
        ])
    }

    /// Returns the number of paths whose own minimum is at the truth.
    pub(super) fn num_right(&self) -> Option<usize> {
        let paths = self.costs()?.paths();
        let is_right = |path: &PathCosts| {
            let off_px = self.off_px(path_winner_px(path));
            off_px.is_some_and(|off_px| off_px < RIGHT_PX)
        };
        Some(paths.filter(|(_, path)| is_right(path)).count())
    }

    fn match_pixel(&mut self) {
        let (penalties, directions) = (self.penalties(), self.directions());
        let costs = |grays| Costs::new(grays, self.place.pixel(), penalties, directions).ok();
        self.costs = self.grays.as_ref().and_then(costs);
    }
}

impl Declared for PathCostsModel {
    const NAME: &'static str = "path-costs";
    const TITLE: &'static str = "Costs along eight paths";
    const HELP: &'static str = "Drag the pixel over the photograph, or move it with the arrow keys. Change the \
        penalties and the number of directions, and watch the costs.";
    const COMPUTE: Compute = carry_out::<PairQuestion>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            place: PLACE,
            asked: Computation::of(PairQuestion),
            grays: None,
            costs: None,
        }
    }
}

impl Model for PathCostsModel {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.place.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.place.update(event) || self.settings.update(event)?.is_some() {
            self.match_pixel();
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        let pictures = self.asked.answer().map(|pair| &pair.pictures);
        let gray = |picture: &Picture| rgb_to_gray(picture.image());
        self.grays = pictures.map(|pictures| pictures.each_ref().map(gray));
        self.match_pixel();
    }
}

const CHALLENGES: &[Challenge<PathCostsModel>] = &[
    Challenge {
        id: "no-neighbors",
        goal: "Make the sum agree with a raw minimum that is more than 2 px wrong.",
        hint: "What if a jump costs nothing?",
        why: "Without penalties a path brings no news: each L is the raw cost itself, and so is their mean.",
        check: |model| {
            let agrees = |costs: &Costs| costs.raw_winner_px() == costs.winner_px();
            model.costs().is_some_and(agrees) && model.errors_px().is_some_and(|[raw, _]| raw > 2.0)
        },
        solution: || vec![Event::set(&SMALL, 0.0), Event::set(&LARGE, 0.0)],
    },
    Challenge {
        id: "outvoted",
        goal: "Find a pixel that both cameras see where the raw minimum is right and the sum is 2 px off.",
        hint: "Which pixels of the wall have a nearer thing beside them?",
        why: "Half of the paths arrive across the near thing and bring its disparity. To leave it costs P₂, and a \
              surface without texture gives no reason to pay.",
        check: |model| {
            model
                .errors_px()
                .is_some_and(|[raw, sum]| raw < 1.0 && sum > 2.0)
        },
        solution: || vec![Event::moved(PLACE.id(), 188.0, 92.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::super::costs::matcher;
    use super::*;
    use crate::kit::question::settled;
    use epipole::stereo::{DisparityFilter, StereoPaths};

    fn at(u: f64, v: f64) -> PathCostsModel {
        settled(&[Event::moved(PLACE.id(), u, v)])
    }

    #[test]
    fn on_the_blank_mat_the_sum_is_right_where_the_raw_cost_is_not() {
        let mut model: PathCostsModel = settled(&[]);
        let costs = model.costs().unwrap();
        assert_eq!((costs.raw_winner_px(), costs.winner_px()), (20, 14));
        assert!(costs.num_minima() > 10);
        assert_eq!(model.num_right(), Some(8));
        // Without penalties, the mean of the paths is the raw cost.
        for slider in [&SMALL, &LARGE] {
            model.update(&Event::set(slider, 0.0)).unwrap();
        }
        let costs = model.costs().unwrap();
        assert_eq!(costs.means(), costs.raw());
        assert_eq!(model.num_right(), Some(0));
    }

    #[test]
    fn the_sum_agrees_with_the_core_s_map() {
        let mut model: PathCostsModel = settled(&[]);
        let [left, right] = model.grays.clone().unwrap();
        let filter = DisparityFilter::default()
            .with_left_right_max_px(None)
            .with_uniqueness_percent(0)
            .with_speckle_size(0)
            .with_max_gap_px(0);
        for (option, paths) in [
            ("4", StereoPaths::Four),
            ("5", StereoPaths::Five),
            ("8", StereoPaths::Eight),
        ] {
            model.update(&Event::set(&COUNT, option)).unwrap();
            let matcher = matcher(model.penalties())
                .with_paths(paths)
                .with_filter(filter);
            let map = matcher.compute(&left, &right, &mut ()).unwrap();
            let places = (50..310)
                .step_by(20)
                .flat_map(|u| (10..230).step_by(20).map(move |v| (u, v)));
            let mut compared = 0;
            for (u, v) in places {
                let moved = Event::moved(PLACE.id(), f64::from(u), f64::from(v));
                model.update(&moved).unwrap();
                let costs = model.costs().unwrap();
                let (means, winner) = (costs.means(), costs.winner_px());
                let others = (0..means.len()).filter(|d| *d != winner);
                let next = others.map(|d| means[d]).fold(f64::INFINITY, f64::min);
                // The core rounds the mean of half of the paths.
                if next - means[winner] <= 1.0 {
                    continue;
                }
                let core = map.get(u, v).unwrap();
                assert!((core - winner as f32).abs() <= 0.5, "({u}, {v}): {core}");
                compared += 1;
            }
            assert!(compared > 100, "{option}: {compared}");
        }
    }

    #[test]
    fn a_path_brings_the_disparity_of_what_it_crossed() {
        // On the wall to the right of the vase.
        let mut model = at(196.0, 108.0);
        assert_eq!(model.marked_path().map(path_winner_px), Some(21));
        assert_eq!(model.num_right(), Some(4));
        let [raw, sum] = model.errors_px().unwrap();
        assert!(raw > 5.0 && sum < 0.5, "{raw} {sum}");
        model.update(&Event::set(&COUNT, "1")).unwrap();
        assert_eq!(model.costs().unwrap().winner_px(), 21);
        // A direction that is not chosen has no mark.
        model.update(&Event::set(&SHOWN, "above")).unwrap();
        assert_eq!(model.marked(), None);
    }

    #[test]
    fn p2_is_at_least_p1() {
        let model: PathCostsModel = settled(&[Event::set(&SMALL, 50.0), Event::set(&LARGE, 10.0)]);
        let Penalties { small, large } = model.penalties();
        assert_eq!((small, large), (50, 50));
        assert!(model.costs().is_some());
    }
}
