//! Matches of a scene of adjustable depth, every F that fits them, and a probe.

use super::fit::{FITS, Fit};
use super::scene::{Scene, cameras, pixel2};
use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, Symbol,
    knobs,
};
use crate::kit::geometry::match_symbols;
use crate::kit::matches::{Match, line2};
use crate::kit::probe::Probe;
use crate::kit::scenes::PHOTO_SIZE;
use epipole::epipolar::fundamental_from_cameras;
use epipole::math::Line2;
use nalgebra::{Point2, Point3};

const SPREAD: Slider = Slider::new("spread", "Depth spread")
    .range(0.0, 1.0, 0.01)
    .at(1.0)
    .digits(2);
const NOISE: Slider = Slider::new("noise", "Pixel noise σ")
    .range(0.0, 1.0, 0.1)
    .at(0.3)
    .digits(1)
    .unit("px");
const SEED: Slider = Slider::seed(1.0);
const KNOBS: &[Knob] = knobs![SPREAD, NOISE, SEED];

const PROBE: Probe = Probe::new("probe", "first", "Probe in image 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .at(320.0, 200.0);

/// Maximum spread of the challenge to determine F in a nearly flat scene.
const NEARLY_FLAT: f64 = 0.1;

/// Matches, and every F that fits them.
pub(super) struct State {
    pub(super) matches: Vec<Match>,
    pub(super) points: Vec<Point3<f64>>,
    pub(super) fit: Fit,
    /// Singular values at full spread, for comparison.
    pub(super) deep: [f64; 9],
    /// Mean distance of the matches from their lines by the best F, pixels.
    pub(super) used_px: f64,
    /// The same for exact matches of points with depth that were not used, pixels.
    pub(super) new_px: f64,
}

/// The model of `flat-scene`.
pub(crate) struct FlatScene {
    settings: Settings,
    probe: Probe,
    state: Result<State, String>,
}

impl FlatScene {
    /// Returns the matches and every F, or a message why there is none.
    pub(super) fn state(&self) -> Result<&State, &str> {
        self.state.as_ref().map_err(String::as_str)
    }

    pub(super) fn spread(&self) -> f64 {
        self.settings.number(&SPREAD)
    }

    pub(super) fn noise_px(&self) -> f64 {
        self.settings.number(&NOISE)
    }

    pub(super) fn probe(&self) -> Point2<f64> {
        self.probe.point()
    }

    /// Returns the pixel of image 2 at which the probe's ray meets the plane.
    pub(super) fn on_plane(&self) -> Option<Point2<f64>> {
        pixel2(&self.probe(), 0.0)
    }

    /// Returns the epipolar line of the probe by the true cameras.
    pub(super) fn true_line(&self) -> Option<Line2> {
        let [first, second] = cameras()?;
        line2(
            &fundamental_from_cameras(&first, &second).ok()?,
            &self.probe(),
        )
    }

    /// Returns the maximum angle between two lines of the probe by F that fit, degrees.
    pub(super) fn fan_deg(&self) -> Option<f64> {
        self.state().ok()?.fit.fan_deg(&self.probe())
    }

    fn compute(&mut self) {
        let state = self.solve();
        self.state = state.map_err(|error| format!("There is no F: {error}."));
    }

    fn solve(&self) -> Result<State, epipole::Error> {
        let scene = Scene::draw(self.settings.count(&SEED) as u64);
        let (spread, noise_px) = (self.spread(), self.noise_px());
        let matches = scene.matches(spread, noise_px);
        let fit = Fit::new(&matches)?;
        Ok(State {
            deep: Fit::new(&scene.matches(SPREAD.max, noise_px))?.singular_values,
            used_px: fit.mean_px(&matches),
            new_px: fit.mean_px(&scene.new_points()),
            points: scene.points(spread),
            matches,
            fit,
        })
    }

    fn fits(&self, check: impl Fn(&Fit) -> bool) -> bool {
        self.state().is_ok_and(|state| check(&state.fit))
    }
}

impl Declared for FlatScene {
    const NAME: &'static str = "flat-scene";
    const TITLE: &'static str = "A scene goes flat";
    const HELP: &'static str = "Flatten the scene with the first slider. Drag the probe over image 1, or move it \
        with the arrow keys: image 2 shows its epipolar line by the best F, and by others that fit \
        about as well.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            probe: PROBE,
            state: Err(String::new()),
        };
        model.compute();
        model
    }
}

impl Model for FlatScene {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle()]
    }

    /// Returns the symbols of the probe.
    fn symbols(&self) -> Vec<Symbol> {
        let state = self.state().ok();
        let line = state.and_then(|state| line2(&state.fit.best, &self.probe()));
        match_symbols([Some(self.probe()), None], line)
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if !self.probe.update(event) && self.settings.update(event)?.is_some() {
            self.compute();
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<FlatScene>] = &[
    Challenge {
        id: "flat",
        goal: "Make the scene so flat that σ₈ is less than 1.5 times σ₉.",
        hint: "It need not be quite a plane. How much depth drowns in the noise?",
        why: "The second best F now fits as well as the best, up to noise. On a plane the third does, too: it \
              leaves all of e' open.",
        check: |model| model.fits(|fit| fit.ratio() < FITS),
        solution: || vec![Event::set(&SPREAD, 0.0)],
    },
    Challenge {
        id: "known",
        goal: "With a spread of 0.10 or less, keep σ₈ more than 30 times as large as σ₉.",
        hint: "Flat compared with what?",
        why: "Exact matches determine F from the slightest depth. What counts as flat is decided by the noise.",
        check: |model| model.spread() <= NEARLY_FLAT && model.fits(|fit| fit.ratio() > 30.0),
        solution: || vec![Event::set(&SPREAD, NEARLY_FLAT), Event::set(&NOISE, 0.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(events: &[Event]) -> FlatScene {
        let mut model = FlatScene::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn flattening_takes_three_singular_values_down_and_hides_it_from_the_fit() {
        for seed in 1..=20 {
            let seed = Event::set(&SEED, f64::from(seed));
            let deep = changed(std::slice::from_ref(&seed));
            let flat = changed(&[seed, Event::set(&SPREAD, 0.0)]);
            let [deep, flat] = [&deep, &flat].map(|model| model.state().unwrap());
            let (before, after) = (deep.fit.singular_values, flat.fit.singular_values);
            assert_eq!(deep.deep, before);
            assert!(after[7] < 0.2 * before[7] && after[6] < 0.2 * before[6]);
            assert!(after[5] > 0.5 * before[5]);
            // The matches used still fit; points off the plane do not.
            assert!(flat.used_px < 1.5 * deep.used_px);
            assert!(
                flat.new_px > 5.0 * deep.new_px,
                "{} {}",
                flat.new_px,
                deep.new_px
            );
        }
    }

    #[test]
    fn the_lines_of_the_probe_fan_out() {
        let fan = |events: &[Event]| changed(events).fan_deg().unwrap();
        let (deep, flat) = (fan(&[]), fan(&[Event::set(&SPREAD, 0.0)]));
        assert!(deep < 3.0 && flat > 20.0, "{deep} {flat}");
    }

    #[test]
    fn the_true_line_passes_through_the_plane() {
        let model = FlatScene::new();
        let distance = model
            .true_line()
            .unwrap()
            .signed_distance(&model.on_plane().unwrap());
        assert!(distance.abs() < 1e-9);
    }
}
