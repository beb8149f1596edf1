//! An edge or a photograph, smoothed or not, its gradient, and a probe. The edge is computed
//! immediately, a photograph by a job.

use super::field::{Arrow, Edge, Field, GRID, noise_left, slope_left};
use super::question::{Question, STILL_LIFE_SIZE, Source};
use crate::contract::{
    Asking, Challenge, Choice, Compute, Control, Declared, Event, Handle, Knob, Model, PhotoSlot,
    Problem, Settings, Slider, Space, Toggle, knobs,
};
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::picture::{Own, Picture, slot};
use crate::kit::probe::Probe;
use crate::kit::question::{Computation, carry_out};
use image::RgbImage;
use std::cell::OnceCell;

const SOURCE: Choice = Choice::new(
    "source",
    "Image",
    &[
        ("edge", "Edge"),
        ("still-life", "Still life"),
        ("own", "Your photograph"),
    ],
);
const OWN: usize = 2;
const ANGLE: Slider = Slider::new("angle", "Edge angle")
    .range(0.0, 180.0, 5.0)
    .at(120.0)
    .unit("°");
const NOISE: Slider = Slider::new("noise", "Noise σ")
    .range(0.0, 30.0, 1.0)
    .at(4.0)
    .unit("levels");
const SMOOTH: Toggle = Toggle::new("smooth", "Smoothing");
pub(super) const SIGMA: Slider = Slider::new("sigma", "Smoothing σ")
    .range(0.5, 5.0, 0.1)
    .at(1.5)
    .digits(1)
    .unit("px");
const BESIDE: Choice = Choice::new(
    "beside",
    "Beside it",
    &[("surface", "Surface"), ("curve", "Noise and slope")],
);
const SEED: Slider = Slider::seed(3.0);
const KNOBS: &[Knob] = knobs![SOURCE, ANGLE, NOISE, SMOOTH, SIGMA, BESIDE, SEED];
/// Ids of the settings that apply only to the edge.
const OF_EDGE: [&str; 4] = [ANGLE.id, NOISE.id, SEED.id, BESIDE.id];
const SLOTS: &[PhotoSlot] = &[slot(480)];
/// Minimum side of a photograph, pixels: the width of its surface patch.
const MIN_SIDE_PX: u32 = GRID.0;

/// Content of the panel beside the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Beside {
    Surface,
    Curve,
}

/// Slope of the edge and noise of a slope at some smoothing, gray levels per pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quality {
    pub(super) slope: f64,
    pub(super) noise: f64,
}

/// Initially on the edge at any of its angles, slightly off the center.
const PROBE: Probe = Probe::new("probe", "image", "Probe")
    .over(GRID)
    .at(11.0, 10.0);

/// The model of `gradient-field`.
pub(crate) struct GradientField {
    settings: Settings,
    own: Own<1>,
    pub(super) probe: Probe,
    pub(super) orbit: Orbit,
    edge: OnceCell<Result<Field, String>>,
    /// The still life, once rendered.
    taken: Option<Picture>,
    asked: Computation<Question>,
}

impl GradientField {
    /// Returns the edge, if it is the image shown.
    pub(super) fn edge(&self) -> Option<Edge> {
        (self.settings.chosen(&SOURCE) == 0).then(|| Edge {
            angle_deg: self.settings.number(&ANGLE),
            noise: self.settings.number(&NOISE),
            seed: self.settings.count(&SEED) as u64,
        })
    }

    /// Returns the gradient shown, or a message why there is none.
    pub(super) fn field(&self) -> Result<&Field, &str> {
        if let Some(edge) = self.edge() {
            let look = || {
                let field = edge.field(self.smooth_px());
                field.map_err(|error| format!("There is no gradient: {error}."))
            };
            let field = self.edge.get_or_init(look).as_ref();
            return field.map_err(|sentence| &**sentence);
        }
        let waiting = <Question as crate::kit::question::Question>::LABEL;
        let answer = self.asked.answer().map(|answer| &answer.field);
        answer.ok_or(self.asked.problem().unwrap_or(waiting))
    }

    /// Returns the reason why the requested photograph is missing, while an older one may be shown.
    pub(super) fn problem(&self) -> Option<&str> {
        self.asked.problem().filter(|_| self.edge().is_none())
    }

    /// Returns width and height of the image, pixels, even before it is available.
    pub(super) fn size(&self) -> (u32, u32) {
        match self.settings.chosen(&SOURCE) {
            0 => GRID,
            1 => STILL_LIFE_SIZE,
            _ => self.own.get(0).map_or(STILL_LIFE_SIZE, Picture::size),
        }
    }

    pub(super) fn beside(&self) -> Beside {
        match self.edge().is_some() && self.settings.chosen(&BESIDE) == 1 {
            true => Beside::Curve,
            false => Beside::Surface,
        }
    }

    pub(super) fn sigma_px(&self) -> f64 {
        self.settings.number(&SIGMA)
    }

    pub(super) fn smooth_px(&self) -> Option<f64> {
        self.settings.flag(&SMOOTH).then(|| self.sigma_px())
    }

    /// Returns the gradient at the probe.
    pub(super) fn probed(&self) -> Option<Arrow> {
        let field = self.field().ok()?;
        Some(field.at(self.probe.pixel()))
    }

    /// Returns the upper left pixel of the surface patch.
    pub(super) fn surface_from(&self) -> (u32, u32) {
        let (width, height) = self.size();
        let (u, v) = self.probe.pixel();
        let from = |at: u32, size: u32, part: u32| {
            at.saturating_sub(part / 2).min(size.saturating_sub(part))
        };
        (from(u, width, GRID.0), from(v, height, GRID.1))
    }

    /// Returns the RMS direction error of the arrows on the edge, degrees.
    pub(super) fn off_deg(&self) -> Option<f64> {
        Some(self.edge()?.off_deg(self.field().ok()?))
    }

    /// Returns slope and noise of the edge at this smoothing.
    pub(super) fn quality(&self, smooth_px: Option<f64>) -> Option<Quality> {
        Some(Quality {
            slope: slope_left(smooth_px).ok()?,
            noise: self.edge()?.noise * noise_left(smooth_px).ok()?,
        })
    }

    fn look(&mut self) {
        self.edge.take();
        if self.edge().is_some() {
            return;
        }
        let smooth_px = self.smooth_px();
        let taken = match self.settings.chosen(&SOURCE) {
            1 => self.taken.as_ref(),
            _ => self.own.get(0),
        };
        let source = match taken {
            Some(picture) => Source::Taken(picture.clone()),
            None if self.settings.chosen(&SOURCE) == OWN => {
                return self.asked.refuse(self.own.wanted());
            }
            None => Source::StillLife,
        };
        self.asked.ask(Question { source, smooth_px });
    }

    /// Resets the probe and drops the last result, because the image has changed.
    fn begin(&mut self) {
        self.probe = match self.settings.chosen(&SOURCE) {
            0 => PROBE,
            _ => PROBE.in_middle(self.size()),
        };
        self.asked.forget();
        self.look();
    }
}

impl Declared for GradientField {
    const NAME: &'static str = "gradient-field";
    const TITLE: &'static str = "Which way is up?";
    const HELP: &'static str = "Drag the probe over the image, or move it with the arrow keys, and read the \
        gradient under it. Drag the surface to turn it.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            probe: PROBE,
            orbit: Orbit::new(-28.0, 38.0),
            edge: OnceCell::new(),
            taken: None,
            asked: Computation::default(),
        };
        model.begin();
        model
    }
}

impl Model for GradientField {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        controls.extend(self.orbit.controls());
        let is_edge = self.edge().is_some();
        for control in &mut controls {
            control.enabled = is_edge || !OF_EDGE.contains(&control.id);
        }
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles = vec![self.probe.handle()];
        if self.beside() == Beside::Surface {
            handles.extend(self.orbit.handles());
        }
        handles
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? || self.probe.update(event) {
            return Ok(());
        }
        match self.settings.update(event)? {
            Some(id) if id == SOURCE.id => self.begin(),
            Some(_) => self.look(),
            None => {}
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn answered(&mut self) {
        if self.settings.chosen(&SOURCE) == 1 {
            self.taken = self.asked.answer().map(|answer| answer.picture.clone());
        }
    }

    fn wants_photos(&self) -> bool {
        self.settings.chosen(&SOURCE) == OWN && self.own.get(0).is_none()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        self.settings.choose(&SOURCE, OWN);
        self.begin();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<GradientField>] = &[
    Challenge {
        id: "down",
        goal: "Turn the edge until the gradient at the probe points straight down.",
        hint: "Which way is the edge when the gradient is down? And which side must be the bright one?",
        why: "The gradient is perpendicular to the edge and points to the brighter side, so on a level edge with \
              the bright side below it points straight down: 90°.",
        check: |model| {
            let probed = model.probed().filter(|arrow| arrow.magnitude() > 10.0);
            let is_edge = model.edge().is_some();
            is_edge && probed.is_some_and(|arrow| (arrow.angle_deg() - 90.0).abs() < 12.0)
        },
        solution: || vec![Event::set(&ANGLE, 180.0)],
    },
    Challenge {
        id: "noise",
        goal: "With noise of 20 gray levels or more, bring the arrows on the edge to within 6°.",
        hint: "An average is calmer than a single pixel.",
        why: "The noise of a slope falls with the square of σ, and the slope of the edge falls far more slowly.",
        check: |model| {
            let is_noisy = model.edge().is_some_and(|edge| edge.noise >= 20.0);
            is_noisy && model.off_deg().is_some_and(|off| off <= 6.0)
        },
        solution: || {
            vec![
                Event::set(&NOISE, 20.0),
                Event::set(&SMOOTH, true),
                Event::set(&SIGMA, 2.5),
            ]
        },
    },
    Challenge {
        id: "half",
        goal: "Smooth until the edge has lost half of its slope.",
        hint: "The ramp is 6 pixels wide. How wide is the Gaussian?",
        why: "Smoothing spreads the same step over more pixels, and a Gaussian as wide as the ramp begins to \
              flatten it.",
        check: |model| {
            let slope = |smooth_px| model.quality(smooth_px).map(|quality| quality.slope);
            let before = slope(None);
            slope(model.smooth_px())
                .zip(before)
                .is_some_and(|(now, before)| now <= before / 2.0)
        },
        solution: || vec![Event::set(&SMOOTH, true), Event::set(&SIGMA, 4.8)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settle;

    fn settled(events: &[Event]) -> GradientField {
        let mut model = GradientField::new();
        for event in events {
            model.update(event).unwrap();
            settle(&mut model);
        }
        model
    }

    #[test]
    fn the_default_reads_the_edge_within_its_noise() {
        let arrow = GradientField::new().probed().unwrap();
        assert!((arrow.magnitude() - 20.0).abs() < 5.0 && (arrow.angle_deg() - 30.0).abs() < 15.0);
    }

    #[test]
    fn a_photograph_is_rendered_once_and_its_surface_stays_inside() {
        let source = Event::set(&SOURCE, "still-life");
        let mut model = settled(&[source, Event::set(&SMOOTH, true)]);
        assert!(model.field().is_ok() && model.taken.is_some() && model.job().is_none());
        assert!(model.off_deg().is_none() && model.beside() == Beside::Surface);
        for (u, v) in [(0.0, 0.0), (479.0, 359.0), (240.0, 3.0)] {
            model.update(&Event::moved("probe", u, v)).unwrap();
            let (left, top) = model.surface_from();
            assert!(left + GRID.0 <= 480 && top + GRID.1 <= 360);
            assert!(model.probed().unwrap().magnitude().is_finite());
        }
    }

    #[test]
    fn own_photographs_are_asked_for_and_small_ones_refused() {
        let mut model = settled(&[Event::set(&SOURCE, "own")]);
        assert_eq!(model.field().err(), Some("Choose a photograph."));
        assert!(model.take_photo("photo", RgbImage::new(10, 400)).is_err());
        model.take_photo("photo", RgbImage::new(24, 24)).unwrap();
        settle(&mut model);
        assert_eq!(model.probed().unwrap().magnitude(), 0.0);
    }
}
