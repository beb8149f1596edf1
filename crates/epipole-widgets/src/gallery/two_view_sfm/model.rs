//! A pair of photographs, the stage of the pipeline that is shown, and where its cloud is seen from.

use super::answer::{Answer, Request, Source};
use super::pipeline;
use super::words;
use crate::contract::{
    Button, ButtonRole, Challenge, Choice, Control, ControlKind, Event, Handle, Job, JobResult,
    Knob, Model, PhotoSlot, Problem, Progress, Readout, Settings, Slider, Space, Value,
    refuse_small,
};
use crate::orbit::{Orbit, RECENTER, SPACE, ZOOM};
use image::RgbImage;

const STAGE: Choice = Choice {
    id: "stage",
    label: "Stage",
    options: &[
        ("detect", "1 Detect features"),
        ("match", "2 Match them"),
        ("ransac", "3 RANSAC"),
        ("pose", "4 Pose of camera 2"),
        ("cloud", "5 Cloud of points"),
    ],
    default: 4,
};
const NEXT: Button = Button {
    id: "next",
    label: "Next stage",
    role: ButtonRole::Step,
};
const PAIR: Choice = Choice {
    id: "pair",
    label: "Photographs",
    options: &[
        ("step", "A step aside"),
        ("turn", "Only turned"),
        ("own", "Yours"),
    ],
    default: 0,
};
const OWN: usize = 2;
const RATIO: Slider = Slider {
    id: "ratio",
    label: "Largest ratio of distances",
    unit: "",
    min: 0.5,
    max: 0.95,
    step: 0.05,
    default: 0.8,
    digits: 2,
    visible: true,
};
const THRESHOLD: Slider = Slider {
    id: "threshold",
    label: "Inliers within ε",
    unit: "px",
    min: 0.5,
    max: 4.0,
    step: 0.5,
    default: 1.5,
    digits: 1,
    visible: true,
};
const FOCAL: Slider = Slider {
    id: "focal",
    label: "Focal length ÷ longer side",
    unit: "",
    min: 0.4,
    max: 3.0,
    step: 0.05,
    default: 1.25,
    digits: 2,
    visible: true,
};
/// What most telephones' main cameras have: 27 mm, in units of 36 mm.
const USUAL_FOCAL: f64 = 0.75;
const KNOBS: &[Knob] = &[
    Knob::Choice(&STAGE),
    Knob::Choice(&PAIR),
    Knob::Slider(&RATIO),
    Knob::Slider(&THRESHOLD),
    Knob::Slider(&FOCAL),
    Knob::Slider(&ZOOM),
];

const SLOTS: &[PhotoSlot] = &[
    PhotoSlot {
        id: "first",
        label: "Your first photograph",
        max_side_px: 800,
    },
    PhotoSlot {
        id: "second",
        label: "Your second photograph",
        max_side_px: 800,
    },
];
/// Smaller pictures have no room for features.
const MIN_SIDE_PX: u32 = 64;

/// How far the pipeline has come; later stages know what earlier ones do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stage {
    Detect,
    Match,
    Ransac,
    Pose,
    Cloud,
}

/// Who says how long the focal length is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FocalFrom {
    /// The photographs are rendered with it.
    Known,
    /// The reader has set it.
    Reader,
    /// The file of a photograph.
    File,
    /// Nobody: it is what most telephones have.
    Guess,
}

/// The model of `two-view-sfm`.
pub(crate) struct TwoViewSfm {
    settings: Settings,
    orbit: Orbit,
    own: [Option<RgbImage>; 2],
    answer: Option<Answer>,
    pending: Option<Job>,
    problem: Option<String>,
    focal_from: FocalFrom,
}

impl TwoViewSfm {
    pub(super) fn stage(&self) -> Stage {
        [
            Stage::Detect,
            Stage::Match,
            Stage::Ransac,
            Stage::Pose,
            Stage::Cloud,
        ][self.settings.chosen(&STAGE)]
    }

    pub(super) fn answer(&self) -> Option<&Answer> {
        self.answer.as_ref()
    }

    pub(super) fn orbit(&self) -> &Orbit {
        &self.orbit
    }

    pub(super) fn zoom(&self) -> f64 {
        self.settings.number(&ZOOM)
    }

    pub(super) fn focal(&self) -> f64 {
        self.settings.number(&FOCAL)
    }

    pub(super) fn focal_from(&self) -> FocalFrom {
        self.focal_from
    }

    pub(super) fn is_own(&self) -> bool {
        self.settings.chosen(&PAIR) == OWN
    }

    /// Photographs that are there before anything is computed.
    pub(super) fn own(&self, index: usize) -> Option<&RgbImage> {
        self.own[index].as_ref().filter(|_| self.is_own())
    }

    pub(super) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    pub(super) fn is_waiting(&self) -> bool {
        self.pending.is_some()
    }

    /// The true angle between the cameras of a rendered pair, degrees.
    pub(super) fn true_turn_deg(&self) -> Option<f64> {
        match self.settings.chosen(&PAIR) {
            0 => pipeline::true_turn_deg(&Source::Step),
            1 => pipeline::true_turn_deg(&Source::Turn),
            _ => None,
        }
    }

    fn request(&self) -> Option<Request> {
        let source = match self.settings.chosen(&PAIR) {
            0 => Source::Step,
            1 => Source::Turn,
            _ => {
                let [Some(first), Some(second)] = &self.own else {
                    return None;
                };
                Source::Own(Box::new([first.into(), second.into()]))
            }
        };
        Some(Request {
            source,
            focal: self.focal(),
            max_ratio: self.settings.number(&RATIO) as f32,
            max_error_px: self.settings.number(&THRESHOLD),
        })
    }

    /// States the computation that the present settings need.
    fn ask(&mut self) {
        let request = self.request();
        self.problem = None;
        if request.is_none() {
            self.answer = None;
            self.problem = Some(match self.own.iter().flatten().count() {
                0 => words::NO_PHOTOGRAPHS.to_owned(),
                _ => words::ONE_PHOTOGRAPH.to_owned(),
            });
        }
        self.pending = request.map(|request| Job {
            label: words::WAITING,
            request: request.to_bytes(),
        });
    }

    fn is_last_stage(&self) -> bool {
        self.stage() == Stage::Cloud
    }
}

impl Model for TwoViewSfm {
    const NAME: &'static str = "two-view-sfm";
    const TITLE: &'static str = "From two photographs to a cloud";
    const HELP: &'static str = "Go through the stages. Drag in the lower picture, or use the arrow \
        keys on its handle, to look from elsewhere; with Shift, or the small cross, the scene moves; \
        with Ctrl and the wheel, or + and −, it becomes larger. On a touchscreen drag the handle, \
        or use two fingers.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-40.0, 25.0),
            own: [None, None],
            answer: None,
            pending: None,
            problem: None,
            focal_from: FocalFrom::Known,
        };
        model.ask();
        model
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        for control in &mut controls {
            if let (ControlKind::Slider { value, .. }, true) =
                (&control.kind, control.id == FOCAL.id)
            {
                control.value_text = words::focal(*value);
            }
        }
        controls.push(NEXT.control(!self.is_last_stage(), false));
        controls.push(RECENTER.control(true, false));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        self.orbit.handles().into()
    }

    fn spaces(&self) -> &'static [Space] {
        &[SPACE]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event, &mut self.settings)? {
            return Ok(());
        }
        match event {
            Event::Set { id, value } => {
                let changed = self.settings.set(id, value)? == Some(true);
                if changed && id == PAIR.id {
                    self.answer = None;
                }
                if changed && id == FOCAL.id {
                    self.focal_from = FocalFrom::Reader;
                }
                if changed && id != STAGE.id {
                    self.ask();
                }
            }
            Event::Press { id } if id == NEXT.id && !self.is_last_stage() => {
                let next = STAGE.options[self.settings.chosen(&STAGE) + 1].0;
                self.settings.set(STAGE.id, &Value::from(next))?;
            }
            _ => {}
        }
        Ok(())
    }

    fn job(&self) -> Option<Job> {
        self.pending.clone()
    }

    fn compute(request: &[u8], progress: Progress<'_>) -> JobResult {
        pipeline::compute(request, progress)
    }

    fn job_done(&mut self, result: JobResult) {
        self.pending = None;
        let request = self.request();
        let read = |bytes: Vec<u8>| Answer::from_bytes(&bytes, request.as_ref()?);
        match result.map(read) {
            Ok(Some(answer)) => self.answer = Some(answer),
            Ok(None) => self.problem = Some(words::NO_ANSWER.to_owned()),
            Err(problem) => self.problem = Some(words::sentence(&problem.to_string())),
        }
    }

    fn photo_slots(&self) -> &'static [PhotoSlot] {
        SLOTS
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        refuse_small(slot, &photo, MIN_SIDE_PX)?;
        if !self.is_own() {
            // The rendered photographs' focal length is known; that of others is only guessed.
            self.settings.set(FOCAL.id, &Value::Number(USUAL_FOCAL))?;
            self.focal_from = FocalFrom::Guess;
            self.settings
                .set(PAIR.id, &Value::from(PAIR.options[OWN].0))?;
        }
        self.own[usize::from(slot == SLOTS[1].id)] = Some(photo);
        self.answer = None;
        self.ask();
        Ok(())
    }

    fn take_focal(&mut self, _: &str, focal: f64) {
        let focal = focal.clamp(FOCAL.min, FOCAL.max);
        // Within its range every number is taken.
        if self.settings.set(FOCAL.id, &Value::Number(focal)).is_ok() {
            self.focal_from = FocalFrom::File;
            self.ask();
        }
    }

    fn readouts(&self) -> Vec<Readout> {
        words::readouts(self)
    }

    fn describe(&self) -> String {
        words::describe(self)
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "above",
                goal: "Look at the cloud from high above, so that you see the plan of the table.",
                hint: "Drag downwards, to more than 60°.",
                check: |model| model.is_last_stage() && model.orbit.rise_deg() > 60.0,
                solution: || {
                    vec![Event::HandleMoved {
                        id: SPACE.orbit.to_owned(),
                        x: 0.0,
                        y: 75.0,
                    }]
                },
            },
            Challenge {
                id: "no-depth",
                goal: "Find a pair that matches well and still gives no depth.",
                hint: "What if the camera stays where it is?",
                check: |model| {
                    let answer = model.answer.as_ref();
                    answer
                        .is_some_and(|answer| answer.num_inliers() > 50 && answer.motion.is_none())
                },
                solution: || {
                    vec![Event::Set {
                        id: PAIR.id.to_owned(),
                        value: Value::from("turn"),
                    }]
                },
            },
        ]
    }
}
