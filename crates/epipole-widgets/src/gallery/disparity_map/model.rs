//! How disparities are looked for, what is found, and a probe.

use super::answer::{Answer, Method, Request, SIZE};
use crate::contract::{
    Challenge, Choice, Control, Event, Handle, Job, JobResult, Knob, Model, Problem, Progress,
    Readout, Settings, Slider, Toggle, Value, format_number,
};

const METHOD: Choice = Choice {
    id: "method",
    label: "Method",
    options: &[("bm", "Block matching"), ("sgm", "Semi-global")],
    default: 0,
};
const WINDOW: Slider = Slider {
    id: "window",
    label: "Window (block matching)",
    unit: "px",
    min: 5.0,
    max: 21.0,
    step: 2.0,
    default: 11.0,
    digits: 0,
    visible: true,
};
const RANGE: Slider = Slider {
    id: "range",
    label: "Disparities looked for",
    unit: "px",
    min: 16.0,
    max: 96.0,
    step: 8.0,
    default: 48.0,
    digits: 0,
    visible: true,
};
const BASELINE: Slider = Slider {
    id: "baseline",
    label: "Baseline",
    unit: "m",
    min: 0.02,
    max: 0.2,
    step: 0.02,
    default: 0.08,
    digits: 2,
    visible: true,
};
const CHECKS: Toggle = Toggle {
    id: "checks",
    label: "Leave out uncertain answers",
    default: true,
};
const KNOBS: &[Knob] = &[
    Knob::Choice(&METHOD),
    Knob::Slider(&WINDOW),
    Knob::Slider(&RANGE),
    Knob::Slider(&BASELINE),
    Knob::Toggle(&CHECKS),
];

/// On the mug, where both cameras see it.
const PROBE: (f64, f64) = (228.0, 165.0);

/// The model of `disparity-map`.
pub(crate) struct DisparityMap {
    settings: Settings,
    probe: (f64, f64),
    answer: Option<Answer>,
    pending: Option<Job>,
    problem: Option<String>,
    /// Counts answers, so that the maps are colored anew when they change.
    version: u64,
}

impl DisparityMap {
    pub(super) fn answer(&self) -> Option<&Answer> {
        self.answer.as_ref()
    }

    pub(super) fn version(&self) -> u64 {
        self.version
    }

    pub(super) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    pub(super) fn is_waiting(&self) -> bool {
        self.pending.is_some()
    }

    pub(super) fn probe(&self) -> (f64, f64) {
        self.probe
    }

    /// The side of the window that is compared, pixels.
    pub(super) fn window_px(&self) -> Option<u32> {
        let window_px = self.settings.number(&WINDOW) as u32;
        (self.settings.chosen(&METHOD) == 0).then_some(window_px)
    }

    fn request(&self) -> Request {
        Request {
            baseline_m: self.settings.number(&BASELINE),
            method: match self.window_px() {
                Some(window_px) => Method::Blocks(window_px),
                None => Method::SemiGlobal,
            },
            num_disparities: self.settings.number(&RANGE) as u32,
            checks: self.settings.flag(&CHECKS),
        }
    }

    fn ask(&mut self) {
        self.problem = None;
        self.pending = Some(Job {
            label: "Matching every pixel",
            request: self.request().to_bytes(),
        });
    }

    /// What is found and what is true at the probe.
    fn probed(&self) -> Option<(Option<f32>, f32, bool)> {
        let answer = self.answer.as_ref()?;
        let (u, v) = (self.probe.0 as u32, self.probe.1 as u32);
        let truth = answer.truth.get(u, v)?;
        Some((answer.found.get(u, v), truth, answer.is_hidden(u, v)))
    }
}

impl Model for DisparityMap {
    const NAME: &'static str = "disparity-map";
    const TITLE: &'static str = "A disparity for every pixel";
    const HELP: &'static str = "Change how matches are looked for. Drag the probe over the left \
        photograph, or move it with the arrow keys, and compare what was found with what is true.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            probe: PROBE,
            answer: None,
            pending: None,
            problem: None,
            version: 0,
        };
        model.ask();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        for control in &mut controls {
            control.enabled = control.id != WINDOW.id || self.window_px().is_some();
        }
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let (u, v) = self.probe;
        vec![Handle {
            id: "probe".to_owned(),
            panel: "left",
            label: "Probe".to_owned(),
            value_text: format!("column {u}, row {v}"),
            x: u,
            y: v,
            x_range: [0.0, f64::from(SIZE.0 - 1)],
            y_range: [0.0, f64::from(SIZE.1 - 1)],
            step: [2.0, 2.0],
            digits: 0,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } if self.settings.set(id, value)? == Some(true) => self.ask(),
            Event::HandleMoved { x, y, .. } => self.probe = (*x, *y),
            Event::Clicked { x, y, .. } => {
                let keep = |value: f64, size: u32| value.round().clamp(0.0, f64::from(size - 1));
                self.probe = (keep(*x, SIZE.0), keep(*y, SIZE.1));
            }
            _ => {}
        }
        Ok(())
    }

    fn job(&self) -> Option<Job> {
        self.pending.clone()
    }

    fn compute(request: &[u8], progress: Progress<'_>) -> JobResult {
        Request::compute(request, progress)
    }

    fn job_done(&mut self, result: JobResult) {
        self.pending = None;
        let request = self.request();
        match result.map(|bytes| Answer::from_bytes(&bytes, &request)) {
            Ok(Some(answer)) => {
                self.answer = Some(answer);
                self.version += 1;
            }
            Ok(None) => self.problem = Some("The disparity could not be computed.".to_owned()),
            Err(problem) => self.problem = Some(format!("No disparity: {problem}.")),
        }
    }

    fn readouts(&self) -> Vec<Readout> {
        let (Some(answer), Some((found, truth, hidden))) = (&self.answer, self.probed()) else {
            return vec![Readout::words("state", "State", self.describe())];
        };
        let words = |id, label, text: &str| Readout::words(id, label, text);
        let mut readouts = vec![
            Readout::number("bad", "Bad-2.0, of the answers", 100.0 * answer.bad, 1, "%"),
            Readout::number("coverage", "Coverage", 100.0 * answer.coverage, 1, "%"),
            Readout::number("error", "Mean error", answer.mean_error_px, 2, "px"),
        ];
        readouts.push(match found {
            Some(found) => Readout::number("found", "d at the probe", found.into(), 2, "px"),
            None => words("found", "d at the probe", "no answer"),
        });
        readouts.push(Readout::number("truth", "True d", truth.into(), 2, "px"));
        readouts.push(match found.and_then(|found| answer.depth_m(found)) {
            Some(depth_m) => Readout::number("depth", "Depth found", depth_m, 3, "m"),
            None => words("depth", "Depth found", "no answer"),
        });
        if let Some(depth_m) = answer.depth_m(truth) {
            readouts.push(Readout::number("true-depth", "True depth", depth_m, 3, "m"));
        }
        if hidden {
            readouts.push(words("hidden", "Here", "hidden from the right camera"));
        }
        readouts
    }

    fn describe(&self) -> String {
        if let Some(problem) = &self.problem {
            return problem.clone();
        }
        let (Some(answer), Some((found, truth, _))) = (&self.answer, self.probed()) else {
            return "Matching every pixel.".to_owned();
        };
        let method = match self.window_px() {
            Some(window_px) => format!("Block matching with {window_px} px windows"),
            None => "Semi-global matching".to_owned(),
        };
        let at = match found {
            Some(found) => format!("{} px is found", format_number(found.into(), 1)),
            None => "nothing is found".to_owned(),
        };
        let range = match answer.reaches_nearest() {
            true => "",
            false => " The nearest things lie beyond the range of the search.",
        };
        format!(
            "{method} answers for {} % of what both cameras see; {} % of the answers are more than \
             2 px off. At the probe {at}, {} px is true.{range}",
            format_number(100.0 * answer.coverage, 1),
            format_number(100.0 * answer.bad, 1),
            format_number(truth.into(), 1),
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "better",
                goal: "Answer for 99 % of what both cameras see, with fewer than 1 % bad.",
                hint: "Windows smear. Which method has none to speak of?",
                check: |model| {
                    let answer = model.answer.as_ref();
                    answer.is_some_and(|answer| answer.coverage >= 0.99 && answer.bad < 0.01)
                },
                solution: || {
                    vec![Event::Set {
                        id: METHOD.id.to_owned(),
                        value: Value::from("sgm"),
                    }]
                },
            },
            Challenge {
                id: "too-near",
                goal: "Make the nearest things too near for the search.",
                hint: "Their disparity must be larger than all that are looked for.",
                check: |model| {
                    let answer = model.answer.as_ref();
                    answer.is_some_and(|answer| !answer.reaches_nearest())
                },
                solution: || {
                    vec![Event::Set {
                        id: RANGE.id.to_owned(),
                        value: Value::Number(16.0),
                    }]
                },
            },
        ]
    }
}
