//! Matches of two photographs, of which some are wrong, and the loop that finds F all the same.
//!
//! The photographs and their matches come from a job. How many samples have been drawn is part of
//! the settings; the loop is deterministic, so a permalink replays it.

use super::answer::{Answer, Match, Request, STILL_LIFE_SIZE};
use super::knobs::{EPSILON, ITERATIONS, KNOBS, LOCAL, OWN, RATIO, SEED, SHOW, SLOTS, SOURCE};
use super::run::{MAX_SAMPLES, Question, Run};
use super::words;
use crate::contract::{
    Challenge, Control, Event, Handle, Job, JobResult, Model, PhotoSlot, Problem, Progress,
    Readout, Settings, Slider, Value, format_number, refuse_small,
};
use crate::running::Running;
use image::RgbImage;

/// Smaller photographs have no features to speak of.
const MIN_SIDE_PX: u32 = 32;
const SAMPLES_PER_SECOND: f64 = 8.0;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Show {
    Matches,
    Outliers,
    Lines,
}

/// The model of `ransac-epipolar`.
pub struct RansacEpipolar {
    settings: Settings,
    own: [Option<RgbImage>; 2],
    answer: Option<Answer>,
    pending: Option<Job>,
    run: Option<Run>,
    problem: Option<String>,
    running: Running,
    /// A place in photograph 1 whose epipolar line is drawn, pixels.
    probe: (f64, f64),
}

/// Where the probe is at first: on the jug of the still life.
const PROBE: (f64, f64) = (244.0, 170.0);

impl RansacEpipolar {
    pub(super) fn photographs(&self) -> Option<&[RgbImage; 2]> {
        Some(&self.answer.as_ref()?.photographs)
    }

    /// Width and height of both photographs, pixels, also before they are there.
    pub(super) fn sizes(&self) -> [(u32, u32); 2] {
        if self.settings.chosen(&SOURCE) != OWN {
            return [STILL_LIFE_SIZE; 2];
        }
        let size = |photograph: &Option<RgbImage>| {
            photograph
                .as_ref()
                .map_or(STILL_LIFE_SIZE, RgbImage::dimensions)
        };
        [size(&self.own[0]), size(&self.own[1])]
    }

    /// A place in photograph 1, pixels; photographs of another size may have moved it.
    pub(super) fn probe(&self) -> (f64, f64) {
        let [(width, height), _] = self.sizes();
        let within = |value: f64, size: u32| value.clamp(0.0, f64::from(size - 1));
        (within(self.probe.0, width), within(self.probe.1, height))
    }

    /// The matches that pass the ratio test.
    pub(super) fn matches(&self) -> Vec<&Match> {
        let most = self.settings.number(&RATIO) as f32;
        let passes = |found: &&Match| found.ratio <= most;
        let answer = self.answer.iter();
        answer
            .flat_map(|answer| answer.matches.iter().filter(passes))
            .collect()
    }

    pub(super) fn run(&self) -> Option<&Run> {
        self.run.as_ref()
    }

    pub(super) fn show(&self) -> Show {
        [Show::Matches, Show::Outliers, Show::Lines][self.settings.chosen(&SHOW)]
    }

    /// Why there is nothing to see, as a sentence.
    pub(super) fn epsilon_px(&self) -> f64 {
        self.settings.number(&EPSILON)
    }

    pub(super) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    pub(super) fn is_finished(&self) -> bool {
        self.run.as_ref().is_some_and(Run::is_finished)
    }

    /// States the search for matches that the present photographs need.
    fn ask(&mut self) {
        (self.answer, self.run, self.problem) = (None, None, None);
        let request = match (self.settings.chosen(&SOURCE), &self.own) {
            (OWN, [Some(first), Some(second)]) => {
                let bytes = |photograph: &RgbImage| {
                    let (width, height) = photograph.dimensions();
                    (width, height, photograph.as_raw().clone())
                };
                Some(Request::Own([bytes(first), bytes(second)]))
            }
            (OWN, own) => {
                let sentence = match own {
                    [None, None] => "Choose two photographs of one scene, taken from two places.",
                    [None, _] => "Photograph 2 is there; now choose photograph 1.",
                    _ => "Photograph 1 is there; now choose photograph 2.",
                };
                self.problem = Some(sentence.to_owned());
                None
            }
            _ => Some(Request::StillLife),
        };
        self.pending = request.map(|request| Job {
            label: "Matching features",
            request: request.to_bytes(),
        });
    }

    /// Begins the loop if its question is a new one, and draws as many samples as the settings say.
    fn draw(&mut self) {
        if self.answer.is_none() {
            return;
        }
        let question = Question {
            epsilon_px: self.settings.number(&EPSILON),
            seed: self.settings.count(&SEED) as u64,
            local_optimization: self.settings.flag(&LOCAL),
        };
        let iterations = self.settings.count(&ITERATIONS);
        let goes_on = |run: &Run| run.question() == question && run.iterations() <= iterations;
        if !self.run.as_ref().is_some_and(goes_on) {
            self.problem = None;
            match Run::new(&self.matches(), question) {
                Ok(run) => self.run = Some(run),
                Err(error) => {
                    self.run = None;
                    self.problem = Some(format!("There is no F: {error}."));
                }
            }
        }
        if let Some(run) = &mut self.run {
            run.draw_to(iterations);
        }
        self.running
            .stop_if(self.run.is_none() || self.is_finished());
    }

    /// Draws to so many samples in all. The number asked for is kept: another question may need
    /// more of them.
    fn draw_to(&mut self, iterations: usize) -> Result<(), Problem> {
        let value = Value::Number(iterations.min(MAX_SAMPLES) as f64);
        self.settings.set(ITERATIONS.id, &value)?;
        self.draw();
        Ok(())
    }

    fn iterations(&self) -> usize {
        self.run.as_ref().map_or(0, Run::iterations)
    }

    /// How many inliers of the best so far are right, where the truth is known.
    pub(super) fn num_right(&self) -> Option<usize> {
        let best = self.run.as_ref()?.best()?;
        let mut count = 0;
        for (found, is_inlier) in self.matches().iter().zip(&best.is_inlier) {
            count += usize::from(found.is_right? && *is_inlier);
        }
        Some(count)
    }
}

impl Model for RansacEpipolar {
    const NAME: &'static str = "ransac-epipolar";
    const TITLE: &'static str = "Votes for a geometry";
    const HELP: &'static str = "Run or step through the samples: each is seven matches, which give \
        F, for which the other matches vote. Change the threshold, let more wrong matches in with \
        the ratio test, or choose two photographs of your own. The probe in photograph 1 has its \
        epipolar line in photograph 2.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: [None, None],
            answer: None,
            pending: None,
            run: None,
            problem: None,
            running: Running::at(SAMPLES_PER_SECOND),
            probe: PROBE,
        };
        model.ask();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let (can_run, drawn) = (self.run.is_some(), self.iterations());
        let mut controls = self.settings.controls();
        controls.extend(self.running.controls(can_run, drawn, self.is_finished()));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let (u, v) = self.probe();
        let [(width, height), _] = self.sizes();
        vec![Handle {
            id: "probe".to_owned(),
            panel: "first",
            label: "Probe in photograph 1".to_owned(),
            value_text: format!(
                "column {}, row {}",
                format_number(u, 0),
                format_number(v, 0)
            ),
            x: u,
            y: v,
            x_range: [0.0, f64::from(width - 1)],
            y_range: [0.0, f64::from(height - 1)],
            step: [4.0, 4.0],
            digits: 0,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::HandleMoved { x, y, .. } => self.probe = (*x, *y),
            Event::Set { id, value } => {
                let has_changed = self.settings.set(id, value)? == Some(true);
                match &**id {
                    _ if !has_changed => {}
                    id if id == SOURCE.id => {
                        self.running.stop();
                        self.ask();
                    }
                    id if id == RATIO.id => {
                        self.run = None;
                        self.draw();
                    }
                    _ => self.draw(),
                }
            }
            Event::Press { id } => {
                let (drawn, finished) = (self.iterations(), self.is_finished());
                if let Some(iterations) = self.running.press(id, drawn, finished) {
                    self.draw_to(iterations)?;
                }
            }
            Event::Tick { dt_s } => {
                if let Some(iterations) = self.running.tick(*dt_s, self.iterations()) {
                    self.draw_to(iterations)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn is_running(&self) -> bool {
        self.running.is_running()
    }

    fn job(&self) -> Option<Job> {
        self.pending.clone()
    }

    fn compute(request: &[u8], progress: Progress<'_>) -> JobResult {
        Request::compute(request, progress)
    }

    fn job_done(&mut self, result: JobResult) {
        self.pending = None;
        match result.map(|bytes| Answer::from_bytes(&bytes)) {
            Ok(Some(answer)) => {
                self.answer = Some(answer);
                self.draw();
            }
            Ok(None) => self.problem = Some("The matches could not be found.".to_owned()),
            Err(problem) => self.problem = Some(format!("There are no matches: {problem}.")),
        }
    }

    fn photo_slots(&self) -> &'static [PhotoSlot] {
        SLOTS
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        refuse_small(slot, &photo, MIN_SIDE_PX)?;
        let index = usize::from(slot != SLOTS[0].id);
        self.own[index] = Some(photo);
        self.settings
            .set(SOURCE.id, &Value::from(SOURCE.options[OWN].0))?;
        self.running.stop();
        self.ask();
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        words::readouts(self)
    }

    fn describe(&self) -> String {
        words::describe(self)
    }

    fn challenges() -> &'static [Challenge<Self>] {
        CHALLENGES
    }
}

const CHALLENGES: &[Challenge<RansacEpipolar>] = &[
    Challenge {
        id: "expensive",
        goal: "Let in so many wrong matches that more than 500 samples are needed.",
        hint: "Which test had kept them out?",
        check: |model| {
            let budget = model.run.as_ref().and_then(Run::budget);
            model.is_finished() && budget.is_some_and(|budget| budget > 500)
        },
        solution: || vec![set(&RATIO, 1.0), set(&EPSILON, 0.4)],
    },
    Challenge {
        id: "bribed",
        goal: "Make at least 20 wrong matches vote for the best F.",
        hint: "How near is near enough?",
        check: |model| {
            let best = model.run.as_ref().and_then(Run::best);
            match (best, model.num_right()) {
                (Some(best), Some(num_right)) => best.num_inliers - num_right >= 20,
                _ => false,
            }
        },
        solution: || vec![set(&EPSILON, 8.0), set(&RATIO, 1.0)],
    },
];

fn set(slider: &Slider, value: f64) -> Event {
    Event::Set {
        id: slider.id.to_owned(),
        value: Value::Number(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{photograph, still_life_pair};
    use std::ops::ControlFlow;

    fn finish(model: &mut RansacEpipolar) {
        while let Some(job) = model.job() {
            let result = RansacEpipolar::compute(&job.request, &mut |_| ControlFlow::Continue(()));
            model.job_done(result);
        }
    }

    #[test]
    fn the_vote_is_right_about_the_still_life() {
        let mut model = RansacEpipolar::new();
        finish(&mut model);
        let run = model.run().unwrap();
        let best = run.best().unwrap();
        assert!(run.is_confident());
        let num_right = model.num_right().unwrap();
        assert!(best.num_inliers > 100 && 20 * num_right > 19 * best.num_inliers);
        // The outliers are wrong: right matches are hardly ever outvoted.
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
        finish(&mut model);
        assert!(model.run().unwrap().best().unwrap().num_inliers > 20);
        assert_eq!(model.num_right(), None, "nobody knows the truth");
        // A gray card has no features, and that is no reason to fail.
        model.take_photo("first", RgbImage::new(64, 64)).unwrap();
        finish(&mut model);
        assert!(model.problem().unwrap().starts_with("There is no F"));
        assert!(model.take_photo("first", RgbImage::new(3, 64)).is_err());
    }
}
