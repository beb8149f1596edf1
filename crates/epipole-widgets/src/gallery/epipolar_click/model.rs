//! Points in photograph 1, and the pose of camera 2.

use crate::contract::{
    Button, ButtonRole, Challenge, Choice, Control, Data, Datum, Declared, Event, Handle, Knob,
    Model, Problem, Settings, Slider, Symbol, knobs, match_data,
};
use crate::kit::geometry::{Geometry, symbols};
use crate::kit::guess::{self, Reveal};
use crate::kit::points::{Points, number_of};
use crate::kit::probe::{Probe, place_words};
use crate::kit::scenes::{PHOTO_SIZE, Seen, in_picture, still_life_pair};
use epipole::camera::PosedCamera;
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use nalgebra::Point2;

const MAX_POINTS: usize = 6;
const BASELINE: Slider = Slider::new("baseline", "Step right")
    .range(0.0, 0.8, 0.02)
    .at(0.2)
    .digits(2)
    .unit("m");
const FORWARD: Slider = Slider::new("forward", "Step ahead")
    .range(-0.6, 0.7, 0.02)
    .at(0.2)
    .digits(2)
    .unit("m");
const TURN: Slider = Slider::new("turn", "Turn camera 2")
    .range(-15.0, 30.0, 1.0)
    .at(4.0)
    .unit("°");
/// Number of the point shown in the readouts; 0 for the last one, until the reader moves a point.
const SELECTED: Slider = Slider::new("selected", "Selected point")
    .range(0.0, MAX_POINTS as f64, 1.0)
    .at(0.0)
    .hidden();
const SHOW: Choice = Choice::new(
    "show",
    "Show",
    &[("lines", "Lines"), guess::GUESS, guess::BOTH],
);
const KNOBS: &[Knob] = knobs![BASELINE, FORWARD, TURN, SHOW, SELECTED];
const ADD: Button = Button::new("add", "Add a point", ButtonRole::Action).more();
const REMOVE: Button = Button::new("remove", "Remove a point", ButtonRole::Action).more();

/// Initial positions of the points, pixels: the first [`NUM_AT_START`] at the start, the others
/// when added. They lie on the sun in a picture, the vase's rim, the mug's handle, the border of
/// the cloth, the tin and an orange.
const PLACES_PX: [(f64, f64); MAX_POINTS] = [
    (216.0, 60.0),
    (332.0, 130.0),
    (479.0, 327.0),
    (300.0, 410.0),
    (505.0, 280.0),
    (291.0, 332.0),
];
const NUM_AT_START: usize = 4;
/// Handle settings shared by all points.
const POINT: Probe = Probe::new("p", "first", "Point # in photograph 1")
    .over(PHOTO_SIZE)
    .step(4.0)
    .digits(1)
    .told(|place| place_words(place, 1));
/// The reader's guess for the match of the selected point.
const GUESS: Probe = Probe::new("guess", "second", "Your guess of the match")
    .over(PHOTO_SIZE)
    .step(4.0)
    .at(320.0, 240.0);
/// Maximum distance of a good guess from the match, pixels.
const GOOD_GUESS_PX: f64 = 25.0;
/// Maximum distance of a point from the epipolar line of another one on the same line, pixels.
const SAME_LINE_PX: f64 = 2.0;
/// Minimum distance between two points that share a line, pixels.
const APART_PX: f64 = 60.0;

/// The model of `epipolar-click`.
pub(crate) struct EpipolarClick {
    settings: Settings,
    points: Points,
    guess: Probe,
}

impl EpipolarClick {
    pub(super) fn cameras(&self) -> [PosedCamera; 2] {
        let (right_m, forward_m, left_deg) = self.motion();
        still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg)
    }

    /// Returns the motion from camera 1 to camera 2: meters right, meters forward, and degrees of
    /// rotation to the left.
    pub(super) fn motion(&self) -> (f64, f64, f64) {
        let number = |slider| self.settings.number(slider);
        (number(&BASELINE), number(&FORWARD), number(&TURN))
    }

    /// Returns the epipolar geometry; `None` while both cameras are at the same position.
    pub(super) fn geometry(&self) -> Option<Geometry> {
        Geometry::of(&self.cameras())
    }

    /// Returns the points with their index.
    pub(super) fn points(&self) -> impl Iterator<Item = (usize, Point2<f64>)> {
        let points = self.points.iter();
        points.map(|point| (point.number - 1, point.place))
    }

    /// Returns the point shown in the readouts, with its index.
    pub(super) fn selected(&self) -> Option<(usize, Point2<f64>)> {
        let chosen = self.settings.count(&SELECTED).checked_sub(1);
        self.points()
            .find(|(index, _)| chosen == Some(*index))
            .or_else(|| self.points().last())
    }

    /// Whether lines and matches are shown, rather than only the guess.
    pub(super) fn shows_lines(&self) -> bool {
        Reveal::of(&self.settings, &SHOW).shows_answer()
    }

    /// Returns the guess for the match of the selected point, if it is shown.
    pub(super) fn guess(&self) -> Option<Point2<f64>> {
        Reveal::of(&self.settings, &SHOW)
            .shows_guess()
            .then(|| self.guess.point())
    }

    /// Returns the guess and the selected point, if the guess is compared with its match.
    fn compared(&self) -> Option<[Point2<f64>; 2]> {
        let guess = self.guess().filter(|_| self.shows_lines())?;
        Some([guess, self.selected()?.1])
    }

    /// Returns the distance of the guess from the match, pixels, if they are compared.
    pub(super) fn guess_off_px(&self) -> Option<f64> {
        let [guess, point] = self.compared()?;
        Some((guess - self.seen(&point).pixel()?).norm())
    }

    /// Returns the distance of the guess from the epipolar line, pixels, if they are compared.
    pub(super) fn guess_across_px(&self) -> Option<f64> {
        let [guess, point] = self.compared()?;
        let line = self.geometry()?.line2(&point)?;
        Some(line.signed_distance(&guess).abs())
    }

    /// Returns the visibility in camera 2 of the scene point at a pixel of photograph 1.
    pub(super) fn seen(&self, pixel1: &Point2<f64>) -> Seen {
        Seen::of(&self.cameras(), pixel1)
    }

    /// Whether two distant points share an epipolar line.
    fn shares_a_line(&self) -> bool {
        let Some(geometry) = self.geometry() else {
            return false;
        };
        self.points().any(|(_, point)| {
            let is_on = |line: Line2| {
                self.points().any(|(_, other)| {
                    (other - point).norm() >= APART_PX
                        && line.signed_distance(&other).abs() <= SAME_LINE_PX
                })
            };
            geometry.line1(&point).is_some_and(is_on)
        })
    }

    /// Writes the selection to the settings, so that a permalink restores it.
    fn keep_selection(&mut self) {
        let index = self.selected().map_or(0, |(index, _)| index);
        self.settings.slide(&SELECTED, (index + 1) as f64);
    }

    fn put(&mut self, number: usize, x: f64, y: f64) {
        self.points.put(number, x, y);
        self.settings.slide(&SELECTED, number as f64);
    }

    /// Returns the smallest unused point number.
    fn free(&self) -> Option<usize> {
        (1..=MAX_POINTS).find(|number| !self.points.has(*number))
    }
}

impl Declared for EpipolarClick {
    const NAME: &'static str = "epipolar-click";
    const TITLE: &'static str = "One point, one line";
    const HELP: &'static str = "Click in photograph 1 to add a point. Drag points, or move them with \
        the arrow keys: each has its epipolar line in photograph 2. Move and turn the second camera \
        with the sliders. Or choose Your guess, put the crosshair where you expect the match, and compare.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let places = PLACES_PX[..NUM_AT_START].iter();
        let places = places.map(|&(u, v)| Point2::new(u, v));
        Self {
            settings: Settings::new(KNOBS),
            points: Points::new(POINT, 0, places),
            guess: GUESS,
        }
    }
}

impl Model for EpipolarClick {
    fn controls(&self) -> Vec<Control> {
        let count = self.points.len();
        let add = ADD.control(count < MAX_POINTS, false);
        self.settings
            .controls_and([add, REMOVE.control(count > 0, false)])
    }

    fn handles(&self) -> Vec<Handle> {
        let mut handles = self.points.handles();
        handles.extend(self.guess().map(|_| self.guess.handle()));
        handles
    }

    /// Returns the symbols of the selected point.
    fn symbols(&self) -> Vec<Symbol> {
        let pixel1 = self.selected().map(|(_, point)| point);
        if !self.shows_lines() {
            return symbols([pixel1, None], None);
        }
        let pixel2 = pixel1.and_then(|point| self.seen(&point).pixel());
        symbols([pixel1, pixel2], self.geometry().as_ref())
    }

    /// Returns the points visible in both photographs.
    fn data(&self) -> Data {
        let [first, second] = self.cameras();
        let matches: Vec<_> = self
            .points()
            .filter_map(|(_, pixel1)| match self.seen(&pixel1) {
                Seen::Visible(pixel2) => Some((pixel1, pixel2)),
                _ => None,
            })
            .collect();
        let mut data = Data::from(match_data(matches.iter().map(|(one, two)| (one, two))));
        if let Some(geometry) = self.geometry() {
            data.insert("fundamental", Datum::matrix(&geometry.fundamental));
        }
        data.insert("camera1", Datum::camera(&first));
        data.insert("camera2", Datum::camera(&second));
        data
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        if self.guess().is_some() && self.guess.update(event) {
            return Ok(());
        }
        match event {
            Event::Set { id, .. } if id == SELECTED.id => self.keep_selection(),
            Event::Press { id } if id == ADD.id => {
                if let Some(number) = self.free() {
                    let (u, v) = PLACES_PX[number - 1];
                    self.put(number, u, v);
                }
            }
            Event::Press { id } if id == REMOVE.id => {
                if let Some((index, _)) = self.points().last() {
                    self.points.remove(index + 1);
                    self.keep_selection();
                }
            }
            // With all points in use, a click moves the selected one.
            Event::Clicked { x, y, .. } => {
                let selected = self.selected().map(|(index, _)| index + 1);
                if let Some(number) = self.free().or(selected) {
                    self.put(number, *x, *y);
                }
            }
            _ => {
                if let Some(number) = self.points.update(event) {
                    self.settings.slide(&SELECTED, number as f64);
                    self.keep_selection();
                }
            }
        }
        Ok(())
    }

    fn restore_handle(&mut self, id: &str, x: f64, y: f64) -> bool {
        if id == GUESS.id() {
            self.guess.put(x, y);
            return true;
        }
        let number = number_of(id).filter(|number| (1..=MAX_POINTS).contains(number));
        if let Some(number) = number {
            self.put(number, x, y);
        }
        number.is_some()
    }
}

const CHALLENGES: &[Challenge<EpipolarClick>] = &[
    Challenge {
        id: "epipole-inside",
        goal: "Bring the epipole e′ into photograph 2.",
        hint: "The epipole is where camera 2 sees camera 1, before or behind it. Which motion puts one \
               in front of the other?",
        why: "Moving forward turns the baseline toward the optical axis, and the epipole is where the \
              baseline meets the image.",
        check: |model| {
            let geometry = model.geometry();
            geometry.is_some_and(|geometry| match geometry.epipole2 {
                Epipole::Finite(pixel) => in_picture(&pixel),
                Epipole::AtInfinity(_) => false,
            })
        },
        solution: || vec![Event::set(&FORWARD, 0.7)],
    },
    Challenge {
        id: "same-line",
        goal: "Give two points of photograph 1 the same epipolar line.",
        hint: "The dotted line through a point holds all points that share its line.",
        why: "A plane through the baseline cuts both images in a line each, so all points of one line \
              share the other.",
        check: EpipolarClick::shares_a_line,
        solution: || {
            let model = EpipolarClick::new();
            let (_, point) = model.points().next().unwrap_or_default();
            let line = model.geometry().and_then(|geometry| geometry.line1(&point));
            let place = line.map_or(point, |line| line.nearest(&Point2::new(400.0, 90.0)));
            vec![Event::moved("p2", place.x, place.y)]
        },
    },
    Challenge {
        id: "guess",
        goal: "Hide the lines, guess where the match of a point is, and compare: be off by less than 25 px.",
        hint: "Look at the thing, not at the place: the match shows the same thing.",
        why: "You had to search the whole photograph. The line leaves one direction to search.",
        check: |model| model.guess_off_px().is_some_and(|px| px < GOOD_GUESS_PX),
        solution: || {
            let model = EpipolarClick::new();
            let point = model.selected().map(|(_, point)| point);
            let pixel2 = point.and_then(|point| model.seen(&point).pixel());
            let pixel2 = pixel2.unwrap_or_default();
            vec![
                Event::set(&SHOW, "guess"),
                Event::moved(GUESS.id(), pixel2.x, pixel2.y),
                Event::set(&SHOW, "both"),
            ]
        },
    },
    Challenge {
        id: "hidden",
        goal: "Find a point whose match is hidden behind something.",
        hint: "Try the wall or the table just beside something near.",
        why: "The line says where a match would be, not whether camera 2 sees it: near things hide \
              different places from different cameras.",
        check: |model| {
            let mut points = model.points();
            points.any(|(_, point)| matches!(model.seen(&point), Seen::Hidden(..)))
        },
        solution: || vec![Event::moved("p1", 262.0, 205.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use epipole::camera::Camera;
    use epipole_scenes::{Sampling, Scene};

    fn changed(events: &[Event]) -> EpipolarClick {
        let mut model = EpipolarClick::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    fn epipole_column(model: &EpipolarClick) -> f64 {
        match model.geometry().unwrap().epipole2 {
            Epipole::Finite(pixel) => pixel.x,
            Epipole::AtInfinity(_) => f64::INFINITY,
        }
    }

    #[test]
    fn every_place_to_begin_is_seen_by_both_cameras() {
        let model = EpipolarClick::new();
        for (u, v) in PLACES_PX {
            let found = model.seen(&Point2::new(u, v));
            assert!(matches!(found, Seen::Visible(_)), "({u}, {v}): {found:?}");
        }
    }

    /// Asserts the caption's claim that the forward slider alone moves the epipole steadily into
    /// the photograph.
    #[test]
    fn moving_camera_2_forward_brings_the_epipole_into_the_picture() {
        let mut last = epipole_column(&EpipolarClick::new());
        assert!(last > 700.0, "{last}");
        let num_steps = ((FORWARD.max - FORWARD.default) / FORWARD.step).round() as usize;
        for step in 1..=num_steps {
            let forward_m = FORWARD.snap(FORWARD.default + step as f64 * FORWARD.step);
            let column = epipole_column(&changed(&[Event::set(&FORWARD, forward_m)]));
            assert!(column < last, "{column} {last}");
            last = column;
        }
        assert!((0.0..639.0).contains(&last), "{last}");
    }

    #[test]
    fn camera_2_is_never_inside_a_thing() {
        let ends = |slider: &Slider| [slider.min, 0.5 * (slider.min + slider.max), slider.max];
        for right_m in ends(&BASELINE) {
            for forward_m in ends(&FORWARD) {
                let [_, second] = still_life_pair(PHOTO_SIZE, right_m, forward_m, 0.0);
                let small = PosedCamera {
                    camera: Camera::pinhole(second.camera.intrinsics.scaled(0.0125).unwrap(), 8, 6),
                    ..second
                };
                let photograph = Scene::still_life().render(&small, 8, 6, Sampling::Draft);
                assert!(photograph.is_ok(), "{right_m} {forward_m}");
            }
        }
    }

    #[test]
    fn without_a_step_there_is_a_sentence() {
        let model = changed(&[Event::set(&BASELINE, 0.0), Event::set(&FORWARD, 0.0)]);
        assert!(model.geometry().is_none());
        assert!(model.describe().starts_with("Both photographs"));
        let ids = |model: &EpipolarClick| {
            let main = model.readouts().into_iter().filter(|readout| readout.main);
            main.map(|readout| readout.id).collect::<Vec<_>>()
        };
        assert_eq!(ids(&model), ids(&EpipolarClick::new()));
    }

    #[test]
    fn points_are_added_until_there_is_no_room() {
        let mut model = EpipolarClick::new();
        for x in [10.0, 20.0, 30.04] {
            model.update(&Event::clicked("first", x, 33.333)).unwrap();
        }
        assert_eq!(model.points().count(), MAX_POINTS);
        assert_eq!(model.points.places()[5], Point2::new(30.0, 33.3));
        assert_eq!(model.selected().unwrap().0, 5);
        model.update(&Event::press(REMOVE.id)).unwrap();
        assert_eq!(model.selected().unwrap().0, 4);
    }

    #[test]
    fn a_guess_hides_the_lines_until_it_is_compared() {
        let shown = |model: &EpipolarClick, id: &str| {
            let readout = model
                .readouts()
                .into_iter()
                .find(|readout| readout.id == id);
            readout.unwrap().text
        };
        let mut model = changed(&[
            Event::set(&SHOW, "guess"),
            Event::moved("guess", 100.0, 50.0),
        ]);
        assert_eq!(shown(&model, "off"), "not compared");
        assert_eq!(shown(&model, "match"), "hidden");
        assert_eq!(model.handles().len(), NUM_AT_START + 1);
        assert!(model.symbols().iter().all(|symbol| symbol.panel == "first"));
        model.update(&Event::set(&SHOW, "both")).unwrap();
        let [guess, point] = model.compared().unwrap();
        assert_eq!(guess, Point2::new(100.0, 50.0));
        let pixel2 = model.seen(&point).pixel().unwrap();
        assert!((model.guess_off_px().unwrap() - (guess - pixel2).norm()).abs() < 1e-12);
        assert!(model.describe().contains("Your guess"));
        model
            .update(&Event::clicked("second", 200.0, 60.0))
            .unwrap();
        assert_eq!(model.compared().unwrap()[0], Point2::new(200.0, 60.0));
        for _ in 0..NUM_AT_START {
            model.update(&Event::press(REMOVE.id)).unwrap();
        }
        assert!(model.describe().contains("no match to guess"));
        assert_eq!(
            (model.guess_off_px(), model.guess_across_px()),
            (None, None)
        );
        model.update(&Event::set(&SHOW, "lines")).unwrap();
        assert_eq!((model.guess(), model.compared()), (None, None));
    }

    #[test]
    fn no_goal_is_reached_by_standing_to_the_side() {
        let model = changed(&[
            Event::set(&BASELINE, 0.3),
            Event::set(&TURN, 0.0),
            Event::set(&FORWARD, 0.0),
        ]);
        for challenge in CHALLENGES {
            assert!(!(challenge.check)(&model), "{}", challenge.id);
        }
    }
}
