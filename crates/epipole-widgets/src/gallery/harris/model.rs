//! The picture, its Harris response, the corners above a threshold, and a probe.

use super::answer::{Answer, Request, STILL_LIFE_SIZE, Source};
use crate::contract::{
    Challenge, Choice, Control, Event, Handle, Job, JobResult, Knob, Model, PhotoSlot, Problem,
    Progress, Readout, Settings, Slider, Value, format_number, refuse_small,
};
use crate::scenes::SQUARE_SIZE;
use epipole::feature::WindowTensor;
use image::RgbImage;

const SOURCE: Choice = Choice {
    id: "source",
    label: "Picture",
    options: &[
        ("square", "Square"),
        ("still-life", "Still life"),
        ("own", "Your photograph"),
    ],
    default: 0,
};
const OWN: usize = 2;
const K: Slider = Slider {
    id: "k",
    label: "Harris constant k",
    unit: "",
    min: 0.01,
    max: 0.2,
    step: 0.01,
    default: 0.04,
    digits: 2,
    visible: true,
};
const THRESHOLD: Slider = Slider {
    id: "threshold",
    label: "Threshold, share of the strongest",
    unit: "%",
    min: 1.0,
    max: 90.0,
    step: 1.0,
    default: 20.0,
    digits: 0,
    visible: true,
};
const WINDOW: Slider = Slider {
    id: "window",
    label: "Window",
    unit: "px",
    min: 3.0,
    max: 15.0,
    step: 2.0,
    default: 7.0,
    digits: 0,
    visible: true,
};
const KNOBS: &[Knob] = &[
    Knob::Choice(&SOURCE),
    Knob::Slider(&K),
    Knob::Slider(&THRESHOLD),
    Knob::Slider(&WINDOW),
];

const SLOTS: &[PhotoSlot] = &[PhotoSlot {
    id: "photo",
    label: "Your photograph",
    max_side_px: 640,
}];
/// Smaller pictures have no room for a window.
const MIN_SIDE_PX: u32 = 16;

/// What the neighborhood of a pixel is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Flat,
    Edge,
    Corner,
}

/// The structure tensor under the probe and what follows from it.
struct Probe {
    tensor: WindowTensor,
    lambda1: f64,
    lambda2: f64,
    response: f64,
    verdict: Verdict,
}

/// The model of `harris`.
pub struct Harris {
    settings: Settings,
    own: Option<RgbImage>,
    probe: (f64, f64),
    answer: Option<Answer>,
    pending: Option<Job>,
    problem: Option<String>,
    /// Counts answers, so that the view knows when to color the map anew.
    version: u64,
}

impl Harris {
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

    /// The picture's width and height, pixels, also before it is there.
    pub(super) fn size(&self) -> (u32, u32) {
        match self.settings.chosen(&SOURCE) {
            0 => SQUARE_SIZE,
            1 => STILL_LIFE_SIZE,
            _ => self.own.as_ref().map_or(SQUARE_SIZE, RgbImage::dimensions),
        }
    }

    pub(super) fn probe_place(&self) -> (f64, f64) {
        self.probe
    }

    /// The smallest response that counts as a corner.
    pub(super) fn threshold(&self) -> f32 {
        let share = self.settings.number(&THRESHOLD) as f32 / 100.0;
        self.answer
            .as_ref()
            .map_or(0.0, |answer| share * answer.strongest())
    }

    /// The corners: local maxima above the threshold, strongest first.
    pub(super) fn corners(&self) -> &[(u32, u32)] {
        let Some(answer) = &self.answer else {
            return &[];
        };
        let threshold = self.threshold();
        let strong = |&(u, v): &(u32, u32)| answer.response.get_pixel(u, v).0[0] >= threshold;
        &answer.peaks[..answer.peaks.partition_point(strong)]
    }

    fn probe(&self) -> Option<Probe> {
        let answer = self.answer.as_ref()?;
        let tensor = answer.tensor(self.probe.0 as u32, self.probe.1 as u32)?;
        let (lambda1, lambda2) = tensor.eigenvalues();
        let response = tensor.harris(f64::from(answer.k));
        let verdict = if response >= f64::from(self.threshold()) {
            Verdict::Corner
        } else if lambda1 > 400.0 && lambda1 > 6.0 * lambda2 {
            Verdict::Edge
        } else {
            Verdict::Flat
        };
        Some(Probe {
            tensor,
            lambda1,
            lambda2,
            response,
            verdict,
        })
    }

    fn request(&self) -> Option<Request> {
        let source = match self.settings.chosen(&SOURCE) {
            0 => Source::Pattern,
            1 => Source::StillLife,
            _ => {
                let own = self.own.as_ref()?;
                Source::Own(own.width(), own.height(), own.as_raw().clone())
            }
        };
        let window_px = self.settings.count(&WINDOW);
        Some(Request {
            source,
            k: self.settings.number(&K) as f32,
            window_px,
        })
    }

    /// States the computation that the present settings need.
    fn ask(&mut self) {
        let request = self.request();
        self.problem = None;
        if request.is_none() {
            self.answer = None;
            self.problem = Some("No photograph has been chosen yet.".to_owned());
        }
        self.pending = request.map(|request| Job {
            label: "Looking for corners",
            request: request.to_bytes(),
        });
    }

    fn place_probe_by_default(&mut self) {
        let (width, height) = self.size();
        self.probe = match self.settings.chosen(&SOURCE) {
            // On a corner of the square.
            0 => (150.0, 143.0),
            _ => (f64::from(width / 2), f64::from(height / 2)),
        };
    }
}

impl Model for Harris {
    const NAME: &'static str = "harris";
    const TITLE: &'static str = "Where are the corners?";
    const HELP: &'static str = "Drag the probe over the picture, or move it with the arrow keys, \
        and read the structure tensor under it. Click to put it elsewhere.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: None,
            probe: (0.0, 0.0),
            answer: None,
            pending: None,
            problem: None,
            version: 0,
        };
        model.place_probe_by_default();
        model.ask();
        model
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let (width, height) = self.size();
        let (u, v) = self.probe;
        vec![Handle {
            id: "probe".to_owned(),
            panel: "picture",
            label: "Probe".to_owned(),
            value_text: format!("column {u}, row {v}"),
            x: u,
            y: v,
            x_range: [0.0, f64::from(width - 1)],
            y_range: [0.0, f64::from(height - 1)],
            step: [2.0, 2.0],
            digits: 0,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                let changed = self.settings.set(id, value)? == Some(true);
                if changed && id == SOURCE.id {
                    self.answer = None;
                    self.place_probe_by_default();
                }
                if changed && id != THRESHOLD.id {
                    self.ask();
                }
            }
            Event::HandleMoved { x, y, .. } => self.probe = (*x, *y),
            Event::Clicked { x, y, .. } => {
                let (width, height) = self.size();
                let keep = |value: f64, size: u32| value.round().clamp(0.0, f64::from(size - 1));
                self.probe = (keep(*x, width), keep(*y, height));
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
        let read = |bytes: Vec<u8>| Answer::from_bytes(&bytes, request.as_ref()?);
        match result.map(read) {
            Ok(Some(answer)) => {
                self.answer = Some(answer);
                self.version += 1;
            }
            Ok(None) => self.problem = Some("The response could not be computed.".to_owned()),
            Err(problem) => self.problem = Some(format!("{problem}.")),
        }
    }

    fn photo_slots(&self) -> &'static [PhotoSlot] {
        SLOTS
    }

    fn take_photo(&mut self, _: &str, photo: RgbImage) -> Result<(), Problem> {
        refuse_small("photo", &photo, MIN_SIDE_PX)?;
        self.own = Some(photo);
        self.answer = None;
        self.settings
            .set(SOURCE.id, &Value::from(SOURCE.options[OWN].0))?;
        self.place_probe_by_default();
        self.ask();
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        let Some(probe) = self.probe() else {
            return vec![Readout::words("state", "State", self.describe())];
        };
        let verdict = match probe.verdict {
            Verdict::Flat => "flat",
            Verdict::Edge => "edge",
            Verdict::Corner => "corner",
        };
        vec![
            Readout::count("corners", "Corners", self.corners().len()),
            Readout::words("verdict", "At the probe", verdict),
            Readout::number("a", "A = Σ Iu²", probe.tensor.uu, 0, ""),
            Readout::number("b", "B = Σ Iv²", probe.tensor.vv, 0, ""),
            Readout::number("c", "C = Σ Iu Iv", probe.tensor.uv, 0, ""),
            Readout::number("lambda1", "λ₁", probe.lambda1, 0, ""),
            Readout::number("lambda2", "λ₂", probe.lambda2, 0, ""),
            Readout::number("response", "R", probe.response / 1e6, 2, "million"),
        ]
    }

    fn describe(&self) -> String {
        if let Some(problem) = &self.problem {
            return problem.clone();
        }
        let Some(probe) = self.probe() else {
            return "Looking for corners.".to_owned();
        };
        let what = match probe.verdict {
            Verdict::Flat => "a flat place",
            Verdict::Edge => "an edge",
            Verdict::Corner => "a corner",
        };
        let corners = self.corners().len();
        format!(
            "{corners} {} above {} % of the strongest response. The probe at column {}, row {} is \
             on {what}: λ₁ is {}, λ₂ is {}, R is {} million.",
            if corners == 1 { "corner" } else { "corners" },
            format_number(self.settings.number(&THRESHOLD), 0),
            self.probe.0,
            self.probe.1,
            format_number(probe.lambda1, 0),
            format_number(probe.lambda2, 0),
            format_number(probe.response / 1e6, 2),
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "edge",
                goal: "Put the probe where the response is negative.",
                hint: "One large eigenvalue and one small one.",
                check: |model| {
                    model
                        .probe()
                        .is_some_and(|probe| probe.verdict == Verdict::Edge && probe.response < 0.0)
                },
                solution: || {
                    vec![Event::HandleMoved {
                        id: "probe".to_owned(),
                        x: 165.0,
                        y: 102.0,
                    }]
                },
            },
            Challenge {
                id: "hundred",
                goal: "Find a hundred corners or more in the still life.",
                hint: "Lower the bar.",
                check: |model| model.settings.chosen(&SOURCE) == 1 && model.corners().len() >= 100,
                solution: || {
                    vec![
                        Event::Set {
                            id: "source".to_owned(),
                            value: Value::from("still-life"),
                        },
                        Event::Set {
                            id: "threshold".to_owned(),
                            value: Value::Number(2.0),
                        },
                    ]
                },
            },
        ]
    }
}
