//! Success rates of the rivals, updated as runs come in.

use super::question::{NUM_BATCHES, Question, RUNS_AT_ONCE, Subject, Wins, outlier_ratio};
use crate::contract::{
    Asking, Button, ButtonRole, Challenge, Choice, Compute, Control, Declared, Event, Knob, Model,
    Problem, Settings, Slider, knobs,
};
use crate::kit::question::{Computation, carry_out};

const SUBJECT: Choice = Choice::new(
    "fit",
    "Fit",
    &[("line", "A line"), ("fundamental", "F of two photographs")],
);
const RATIO: Slider = Slider::new("outliers", "Outlier ratio")
    .range(0.0, 0.8, 0.1)
    .at(0.3)
    .digits(1);
const THRESHOLD: Slider = Slider::new("threshold", "Threshold")
    .range(0.5, 20.0, 0.5)
    .at(2.5)
    .digits(1)
    .unit("σ");
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![SUBJECT, RATIO, THRESHOLD, SEED];
const AGAIN: Button = Button::new("again", "Run again", ButtonRole::Restart);

/// The model of `tournament`.
pub(crate) struct Tournament {
    settings: Settings,
    pub(super) asked: Computation<Question>,
    wins: Wins,
    num_batches: usize,
}

impl Tournament {
    /// Returns the number of runs so far at each ratio.
    pub(super) fn num_runs(&self) -> usize {
        self.num_batches * RUNS_AT_ONCE
    }

    pub(super) fn is_finished(&self) -> bool {
        self.num_batches == NUM_BATCHES
    }

    pub(super) fn subject(&self) -> Subject {
        match self.settings.chosen(&SUBJECT) {
            0 => Subject::Line,
            _ => Subject::Fundamental,
        }
    }

    /// Returns the index and the value of the outlier ratio shown in the readouts.
    pub(super) fn ratio(&self) -> (usize, f64) {
        let index = (10.0 * self.settings.number(&RATIO)).round() as usize;
        (index, outlier_ratio(index))
    }

    /// Returns a rival's success rate, 0 to 1; `None` before the first runs.
    pub(super) fn share(&self, rival: usize, ratio: usize) -> Option<f64> {
        let runs = self.num_runs();
        (runs > 0).then(|| self.wins.0[ratio][rival] as f64 / runs as f64)
    }

    fn question(&self) -> Question {
        Question {
            subject: self.subject(),
            threshold: self.settings.number(&THRESHOLD),
            seed: self.settings.count(&SEED) as u64,
            batch: self.num_batches,
        }
    }

    fn start(&mut self) {
        self.asked.forget();
        (self.wins, self.num_batches) = (Wins::none(), 0);
        self.asked.ask(self.question());
    }

    /// Returns the success rates of two rivals at the selected ratio, once all runs are complete.
    fn final_ratios(&self, rivals: [usize; 2]) -> Option<[f64; 2]> {
        let (ratio, _) = self.ratio();
        let [one, other] = rivals.map(|rival| self.share(rival, ratio));
        self.is_finished().then_some([one?, other?])
    }
}

impl Declared for Tournament {
    const NAME: &'static str = "tournament";
    const TITLE: &'static str = "Two hundred races";
    const HELP: &'static str = "Choose what is fitted and the threshold of those that vote. Click in the plot, \
        or move the slider, to read the shares at an outlier ratio.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            asked: Computation::default(),
            wins: Wins::none(),
            num_batches: 0,
        };
        model.start();
        model
    }
}

impl Model for Tournament {
    fn controls(&self) -> Vec<Control> {
        let again = AGAIN.control(self.num_batches > 0, false);
        self.settings.controls_and([again])
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let changed = self.settings.update(event)?;
        if changed.is_some_and(|id| id != RATIO.id) {
            self.start();
        }
        match event {
            Event::Press { id } if id == AGAIN.id => self.start(),
            Event::Clicked { x, .. } => self.settings.slide(&RATIO, *x),
            _ => {}
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        if let Some(wins) = self.asked.answer() {
            self.wins.add(wins);
            self.num_batches += 1;
        }
        if !self.is_finished() {
            self.asked.ask(self.question());
        }
    }
}

const LEAST_MEDIAN: usize = 2;
const RANSAC: usize = 3;
const LOCAL: usize = 5;

const CHALLENGES: &[Challenge<Tournament>] = &[
    Challenge {
        id: "half",
        goal: "Find an outlier ratio at which MSAC + LO succeeds in 9 of 10 runs, and the least median in \
               fewer than 4 of 10.",
        hint: "What is the middle one of the errors when most data are wrong?",
        why: "Once more than half of the data are outliers the middle error belongs to one of them; a vote \
              only needs the true ones to agree more than chance does.",
        check: |model| {
            let shares = model.final_ratios([LOCAL, LEAST_MEDIAN]);
            shares.is_some_and(|[local, median]| local >= 0.9 && median < 0.4)
        },
        solution: || vec![Event::set(&RATIO, 0.7)],
    },
    Challenge {
        id: "threshold",
        goal: "With four in ten outliers, make the least median succeed more often than RANSAC.",
        hint: "What does RANSAC need to be told that the least median finds out for itself?",
        why: "RANSAC is only as good as its threshold: too wide, and outliers vote; too narrow, and good \
              points do not. The least median takes its measure from the data.",
        check: |model| {
            let shares = model.final_ratios([LEAST_MEDIAN, RANSAC]);
            model.ratio().0 == 4 && shares.is_some_and(|[median, ransac]| median > ransac + 0.05)
        },
        solution: || vec![Event::set(&RATIO, 0.4), Event::set(&THRESHOLD, 20.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::super::question::NUM_RATIOS;
    use super::*;
    use epipole::Error;
    use std::ops::ControlFlow;

    const LEAST_SQUARES: usize = 0;

    fn advance(model: &mut Tournament) {
        let request = model.job().unwrap().request();
        let result = (Tournament::COMPUTE)(&request, &mut |_| ControlFlow::Continue(()));
        model.job_done(result);
    }

    #[test]
    fn runs_come_in_one_by_one_and_stopping_loses_none() {
        let mut model = Tournament::new();
        assert_eq!(model.share(0, 0), None);
        for batch in 1..=3 {
            advance(&mut model);
            assert_eq!(model.num_runs(), batch * RUNS_AT_ONCE);
        }
        let before = model.share(LOCAL, 5);
        model.job_done(Err(Error::Canceled.into()));
        assert_eq!((model.share(LOCAL, 5), model.num_runs()), (before, 60));
        assert!(model.job().is_none() && model.asked.problem().is_some());
        model.update(&Event::press(AGAIN.id)).unwrap();
        assert_eq!(model.num_runs(), 0);
        assert!(model.job().is_some());
    }

    #[test]
    fn all_runs_show_who_holds_out_how_long() {
        let mut model = Tournament::new();
        while model.job().is_some() {
            advance(&mut model);
        }
        let share = |rival, ratio| model.share(rival, ratio).unwrap();
        assert_eq!(model.num_runs(), 200);
        assert!((0..NUM_RATIOS).all(|ratio| share(LEAST_SQUARES, ratio) <= 1.0));
        assert!(share(LEAST_SQUARES, 0) > 0.98 && share(LEAST_SQUARES, 3) < 0.5);
        assert!(share(LEAST_MEDIAN, 3) > 0.95 && share(LEAST_MEDIAN, 7) < 0.5);
        assert!(share(LOCAL, 6) >= 0.95, "{}", share(LOCAL, 6));
    }

    #[test]
    fn another_question_starts_over() {
        let mut model = Tournament::new();
        advance(&mut model);
        model.update(&Event::set(&RATIO, 0.6)).unwrap();
        assert_eq!(model.num_runs(), RUNS_AT_ONCE, "the runs are the same");
        model.update(&Event::set(&THRESHOLD, 4.0)).unwrap();
        assert_eq!(model.num_runs(), 0);
        model.update(&Event::clicked("plot", 0.52, 0.4)).unwrap();
        assert_eq!(model.ratio(), (5, 0.5));
    }
}
