//! Matches of two photographs with outliers, and the RANSAC loop that estimates F from them.
//!
//! The photographs, their matches and all votes come from a worker. The number of samples is one of
//! the settings; the loop is deterministic, so a permalink replays it.

use super::matches::Match;
use super::question::{Answer, Matched, Question, STILL_LIFE_SIZE};
use super::votes::{Best, LeftOpen, Moment, Voters, Votes};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Data, Datum, Declared, Event, Handle, Knob, Model,
    PhotoSlot, Problem, Settings, Slider, Symbol, Toggle, knobs, match_data,
};
use crate::kit::geometry::symbols_of_one;
use crate::kit::picture::{Own, pair_slots};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, Question as _, carry_out};
use crate::kit::running::Running;
use crate::kit::samples::{Drawn, Rules};
use image::RgbImage;
use nalgebra::Point2;

const SOURCE: Choice = Choice::new(
    "source",
    "Photographs",
    &[("still-life", "Still life"), ("own", "Your photographs")],
)
.more();
const OWN: usize = 1;
const SHOW: Choice = Choice::new(
    "show",
    "Show",
    &[
        ("matches", "Matches"),
        ("outliers", "Outliers only"),
        ("lines", "Epipolar lines"),
    ],
);
const RATIO: Slider = Slider::new("ratio", "Ratio test τ")
    .range(0.5, 1.0, 0.05)
    .at(0.9)
    .digits(2);
const EPSILON: Slider = Slider::new("epsilon", "Threshold ε")
    .range(0.2, 10.0, 0.2)
    .at(1.0)
    .digits(1)
    .unit("px");
const LOCAL: Toggle = Toggle::new("local", "Local optimization").more();
const SEED: Slider = Slider::seed(1.0);
const MAX_SAMPLES: usize = 1000;
/// Requested number of samples; the loop ends earlier when enough are drawn.
const ITERATIONS: Slider = Slider::new("iterations", "Samples drawn")
    .range(0.0, MAX_SAMPLES as f64, 1.0)
    .at(MAX_SAMPLES as f64)
    .hidden();
const KNOBS: &[Knob] = knobs![SOURCE, SHOW, EPSILON, RATIO, LOCAL, SEED, ITERATIONS];

const SLOTS: &[PhotoSlot] = &pair_slots(640);
/// Minimum side of a photograph, pixels; smaller ones have no useful features.
const MIN_SIDE_PX: u32 = 32;
const SAMPLES_PER_SECOND: f64 = 8.0;
/// Initially on the jug of the still life.
const PROBE: Probe = Probe::new("probe", "first", "Probe in photograph 1")
    .over(STILL_LIFE_SIZE)
    .step(4.0)
    .at(244.0, 170.0);

/// Content of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Show {
    Matches,
    Outliers,
    Lines,
}

/// The model of `ransac-epipolar`.
pub struct RansacEpipolar {
    settings: Settings,
    own: Own<2>,
    matched: Computation<Question>,
    votes: Computation<Question>,
    running: Running,
    probe: Probe,
}

impl RansacEpipolar {
    /// Returns the photographs with all matches.
    pub(super) fn matched(&self) -> Option<&Matched> {
        match self.matched.answer()? {
            Answer::Matched(found) => Some(found),
            Answer::Votes(_) => None,
        }
    }

    /// Returns width and height of both photographs, pixels, even before they are available.
    pub(super) fn sizes(&self) -> [(u32, u32); 2] {
        let is_own = self.settings.chosen(&SOURCE) == OWN;
        let own = |index| self.own.get(index).filter(|_| is_own);
        [0, 1].map(|index| own(index).map_or(STILL_LIFE_SIZE, |picture| picture.size()))
    }

    /// Returns the probe's position in photograph 1, pixels.
    pub(super) fn probe(&self) -> Point2<f64> {
        self.probe.point()
    }

    /// Returns the matches that have voted; before the votes, those that pass the ratio test.
    pub(super) fn matches(&self) -> Vec<&Match> {
        let most = match self.votes.answered() {
            Some((Question::Votes(voters), _)) => voters.most_ratio,
            _ => self.most_ratio(),
        };
        self.passing(most)
    }

    fn most_ratio(&self) -> f32 {
        self.settings.number(&RATIO) as f32
    }

    fn passing(&self, most_ratio: f32) -> Vec<&Match> {
        let all = self.matched().into_iter().flat_map(|found| &found.matches);
        all.filter(|found| found.ratio <= most_ratio).collect()
    }

    fn votes(&self) -> Option<&Votes> {
        match self.votes.answer()? {
            Answer::Votes(votes) => Some(votes),
            Answer::Matched(_) => None,
        }
    }

    /// Returns the state of the loop after the samples drawn so far.
    pub(super) fn moment(&self) -> Option<Moment<'_>> {
        let votes = self.votes()?;
        Some(votes.after(self.settings.count(&ITERATIONS)))
    }

    /// Returns the F with the most votes so far.
    pub(super) fn best(&self) -> Option<&Best> {
        self.moment()?.best
    }

    /// Returns the degeneracy of the final F, if any.
    pub(super) fn left_open(&self) -> Option<LeftOpen> {
        let votes = self.votes().filter(|_| self.is_finished())?;
        votes.left_open
    }

    pub(super) fn show(&self) -> Show {
        [Show::Matches, Show::Outliers, Show::Lines][self.settings.chosen(&SHOW)]
    }

    pub(super) fn epsilon_px(&self) -> f64 {
        self.settings.number(&EPSILON)
    }

    /// Returns the reason why nothing can be shown, as a sentence.
    pub(super) fn problem(&self) -> Option<&str> {
        let refusal = || self.votes()?.refusal.as_deref();
        let problem = self.matched.problem().or(self.votes.problem());
        problem.or_else(refusal)
    }

    /// Returns the status while nothing can be shown yet.
    pub(super) fn label(&self) -> Option<&'static str> {
        self.votes().is_none().then_some(Question::LABEL)
    }

    /// Returns the progress of the loop, once there are votes.
    pub(super) fn drawn(&self) -> Option<Drawn> {
        let last = self.moment()?.last;
        Some(last.map_or(Drawn::nothing(MAX_SAMPLES), |trial| trial.drawn))
    }

    pub(super) fn is_finished(&self) -> bool {
        self.drawn().is_some_and(|drawn| drawn.is_finished())
    }

    pub(super) fn num_samples(&self) -> usize {
        let num_all = self.votes().map_or(0, Votes::len);
        self.settings.count(&ITERATIONS).min(num_all)
    }

    /// Requests the matches of the current photographs.
    fn ask(&mut self) {
        self.running.stop();
        self.probe = self.probe.over(self.sizes()[0]);
        self.votes.forget();
        self.matched.forget();
        match (self.settings.chosen(&SOURCE), self.own.all()) {
            (OWN, Some(photographs)) => self.matched.ask(Question::Own(photographs)),
            (OWN, None) => self.matched.refuse(self.own.wanted()),
            _ => self.matched.ask(Question::StillLife),
        }
    }

    /// Requests the votes under the current settings.
    fn ask_for_votes(&mut self) {
        if self.matched().is_none() {
            return;
        }
        let rules = Rules {
            epsilon_px: self.epsilon_px(),
            seed: self.settings.count(&SEED) as u64,
            max_samples: MAX_SAMPLES,
            msac: false,
            local_optimization: self.settings.flag(&LOCAL),
        };
        let most = self.most_ratio();
        let voters = Voters::new(&self.passing(most), most, rules);
        self.votes.ask(Question::Votes(voters));
    }

    /// Draws until there are `count` samples. The requested number is kept, since other settings
    /// may need more.
    fn draw_to(&mut self, count: usize) {
        self.settings.slide(&ITERATIONS, count as f64);
        self.running
            .stop_if(self.votes().is_none() || self.is_finished());
    }

    /// Returns the number of correct matches among the best F's inliers, if the truth is known.
    pub(super) fn num_right(&self) -> Option<usize> {
        let best = self.best()?;
        let mut count = 0;
        for (found, is_inlier) in self.matches().iter().zip(&best.is_inlier) {
            count += usize::from(found.is_right? && *is_inlier);
        }
        Some(count)
    }
}

impl Declared for RansacEpipolar {
    const NAME: &'static str = "ransac-epipolar";
    const TITLE: &'static str = "Votes for a geometry";
    const HELP: &'static str = "Run or step through the samples: seven matches give F, and the others \
        vote. Change the threshold, let more wrong matches in with the ratio test, or choose two \
        photographs of your own. Drag the probe in photograph 1: its epipolar line is in photograph 2.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            matched: Computation::default(),
            votes: Computation::default(),
            running: Running::at(SAMPLES_PER_SECOND),
            probe: PROBE,
        };
        model.ask();
        model
    }
}

impl Model for RansacEpipolar {
    /// Returns the matches that have voted.
    fn data(&self) -> Data {
        let matches = self.matches();
        let pixels: Vec<_> = matches
            .iter()
            .map(|found| (found.pixel1(), found.pixel2()))
            .collect();
        let mut data = Data::from(match_data(pixels.iter().map(|(one, two)| (one, two))));
        data.insert("thresholdPx", Datum::Number(self.epsilon_px()));
        data
    }

    fn controls(&self) -> Vec<Control> {
        let can_run = self.votes().is_some_and(|votes| votes.len() > 0);
        let drawn = self.num_samples();
        let mut controls = self.settings.controls();
        controls.extend(self.running.controls(can_run, drawn, self.is_finished()));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    /// Returns the symbols of one inlier of the best F.
    fn symbols(&self) -> Vec<Symbol> {
        let elected = self.best().into_iter().flat_map(|best| {
            let matches = self.matches().into_iter().zip(&best.is_inlier);
            matches.filter_map(|(found, is_inlier)| is_inlier.then_some(found))
        });
        let pixels = elected.map(|found| [found.pixel1(), found.pixel2()]);
        symbols_of_one(pixels, self.sizes()[0])
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.probe.update(event) {
            return Ok(());
        }
        let (drawn, is_finished) = (self.num_samples(), self.is_finished());
        if let Some(count) = self.running.update(event, drawn, is_finished) {
            self.draw_to(count);
        }
        match self.settings.update(event)? {
            Some(id) if id == SOURCE.id => self.ask(),
            Some(id) if id != SHOW.id && id != ITERATIONS.id => self.ask_for_votes(),
            _ => {}
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.running.is_running()
    }

    /// Requests the matches first, since the votes depend on them.
    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(match self.matched.is_waiting() {
            true => &mut self.matched,
            false => &mut self.votes,
        })
    }

    fn answered(&mut self) {
        match self.votes() {
            None => self.ask_for_votes(),
            Some(_) => self.running.stop_if(self.is_finished()),
        }
    }

    fn wants_photos(&self) -> bool {
        self.settings.chosen(&SOURCE) == OWN && self.own.all().is_none()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        self.settings.choose(&SOURCE, OWN);
        self.ask();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<RansacEpipolar>] = &[
    Challenge {
        id: "expensive",
        goal: "Let in so many wrong matches that more than 500 samples are needed.",
        hint: "Which test had kept them out?",
        why: "Seven matches must all be right at once, so a few more wrong ones cost many more samples.",
        check: |model| {
            let budget = model.drawn().and_then(|drawn| drawn.budget);
            model.is_finished() && budget.is_some_and(|budget| budget > 500)
        },
        solution: || vec![Event::set(&RATIO, 1.0), Event::set(&EPSILON, 0.4)],
    },
    Challenge {
        id: "bribed",
        goal: "Make at least 20 wrong matches vote for the best F.",
        hint: "How near is near enough?",
        why: "A wide band along each epipolar line is a large part of the picture, and wrong matches \
              land in it by chance.",
        check: |model| match (model.best(), model.num_right()) {
            (Some(best), Some(num_right)) => best.num_votes - num_right >= 20,
            _ => false,
        },
        solution: || vec![Event::set(&EPSILON, 8.0), Event::set(&RATIO, 1.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::settle;
    use crate::kit::scenes::{photograph, still_life_pair};
    use epipole::camera::RigidTransform;
    use nalgebra::Vector3;
    use std::ops::ControlFlow;

    #[test]
    fn the_vote_is_right_about_the_still_life() {
        let mut model = RansacEpipolar::new();
        settle(&mut model);
        let moment = model.moment().unwrap();
        let best = moment.best.unwrap();
        assert!(model.drawn().unwrap().is_confident());
        let num_right = model.num_right().unwrap();
        assert!(best.num_votes > 100 && 20 * num_right > 19 * best.num_votes);
        // Nearly all outliers are wrong matches.
        let matches = model.matches();
        let all_right = matches
            .iter()
            .filter(|found| found.is_right == Some(true))
            .count();
        assert!(20 * num_right > 19 * all_right && all_right < matches.len() * 4 / 5);
    }

    #[test]
    fn two_photographs_of_the_readers_own_are_matched() {
        let size = (240, 180);
        let cameras = still_life_pair(size, 0.15, 0.0, 4.0);
        let photographs = cameras
            .map(|camera| photograph(&camera, size, &mut |_| ControlFlow::Continue(())).unwrap());
        let [first, second] = photographs;
        let mut model = RansacEpipolar::new();
        model.take_photo("second", second).unwrap();
        assert!(model.job().is_none());
        assert!(
            model.describe().contains("choose photograph 1"),
            "{}",
            model.describe()
        );
        model.take_photo("first", first).unwrap();
        settle(&mut model);
        assert!(model.best().unwrap().num_votes > 20);
        assert_eq!(model.num_right(), None, "nobody knows the truth");
        assert_eq!(model.left_open(), None);
        // A uniform image has no features, which must not be an error.
        model.take_photo("first", RgbImage::new(64, 64)).unwrap();
        settle(&mut model);
        assert!(model.problem().unwrap().starts_with("There is no F"));
        assert!(model.take_photo("first", RgbImage::new(3, 64)).is_err());
    }

    #[test]
    fn one_photograph_twice_and_a_turn_say_that_f_is_not_determined() {
        let size = (240, 180);
        let [first, _] = still_life_pair(size, 0.15, 0.0, 4.0);
        let mut turned = first;
        turned.cam_from_world =
            RigidTransform::rotation(Vector3::new(0.0, 0.08, 0.0)) * first.cam_from_world;
        let [first, turned] = [first, turned]
            .map(|camera| photograph(&camera, size, &mut |_| ControlFlow::Continue(())).unwrap());
        for (second, expected) in [
            (&first, "the camera did not move"),
            (&turned, "the camera only turned, or"),
        ] {
            let mut model = RansacEpipolar::new();
            model.take_photo("first", first.clone()).unwrap();
            model.take_photo("second", second.clone()).unwrap();
            settle(&mut model);
            let words = model.describe();
            assert!(words.contains(expected), "{words}");
            assert!(words.contains("Take a step aside"), "{words}");
            // Degeneracy is only reported after the last sample.
            model.update(&Event::press("restart")).unwrap();
            model.update(&Event::press("step")).unwrap();
            assert!(model.is_finished() || !model.describe().contains(expected));
        }
    }
}
