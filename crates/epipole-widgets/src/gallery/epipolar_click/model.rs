//! State and mathematics of `epipolar-click`: points of one photograph, their epipolar lines and
//! true matches in another.

use super::knobs::{ADD, BASELINE, FORWARD, KNOBS, MAX_POINTS, REMOVE, SELECTED, TURN};
use super::words;
use crate::contract::{
    Challenge, Control, Event, Handle, Model, Problem, Readout, Settings, Slider, Value,
};
use crate::scenes::{self, PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture, still_life_pair};
use epipole::camera::Camera;
use epipole::epipolar::{
    Epipole, epipolar_line1, epipolar_line2, epipoles, fundamental_from_cameras,
};
use epipole::math::Line2;
use epipole::synthetic::Transfer;
use nalgebra::{Matrix3, Point2};

/// Where points begin, pixels: the first [`NUM_AT_START`] at the start, the others when added. They
/// are on the sun in a picture, the vase's rim, the mug's handle, a corner of the cloth, the tin and
/// the apple.
const PLACES_PX: [(f64, f64); MAX_POINTS] = [
    (216.0, 60.0),
    (332.0, 130.0),
    (479.0, 327.0),
    (142.0, 455.0),
    (505.0, 280.0),
    (100.0, 246.0),
];
const NUM_AT_START: usize = 4;
/// Digits that a point's place is kept with.
const DIGITS: usize = 1;

/// Points clicked in photograph 1, and where camera 2 stands.
pub(crate) struct EpipolarClick {
    settings: Settings,
    points: [Option<Point2<f64>>; MAX_POINTS],
}

/// The epipolar geometry of the two cameras.
#[derive(Debug, Clone, Copy)]
pub(super) struct Geometry {
    pub(super) fundamental: Matrix3<f64>,
    pub(super) epipole1: Epipole,
    pub(super) epipole2: Epipole,
}

/// Where a point of photograph 1 is in photograph 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Match {
    /// There it is.
    Visible(Point2<f64>),
    /// It would be there, but this hides it.
    Hidden(Point2<f64>, &'static str),
    /// It would be beyond the picture's edge.
    Outside(Point2<f64>),
    /// Camera 2 has gone past it.
    Behind,
    /// Camera 1 sees nothing there.
    Nothing,
}

impl Match {
    /// The pixel of photograph 2, inside the picture or not, hidden or not.
    pub(super) fn pixel(self) -> Option<Point2<f64>> {
        match self {
            Self::Visible(pixel) | Self::Hidden(pixel, _) | Self::Outside(pixel) => Some(pixel),
            Self::Behind | Self::Nothing => None,
        }
    }
}

impl EpipolarClick {
    /// The first and the second camera. The second is the first, moved and turned in its own
    /// horizontal plane.
    pub(super) fn cameras(&self) -> [Camera; 2] {
        let (right_m, forward_m, left_deg) = self.motion();
        still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg)
    }

    /// Camera 2 in the frame of camera 1: meters to the right, meters forward, and degrees to the
    /// left.
    pub(super) fn motion(&self) -> (f64, f64, f64) {
        (
            self.settings.number(&BASELINE),
            self.settings.number(&FORWARD),
            self.settings.number(&TURN),
        )
    }

    /// None while both cameras stand at the same place.
    pub(super) fn geometry(&self) -> Option<Geometry> {
        if self.settings.number(&BASELINE) == 0.0 && self.settings.number(&FORWARD) == 0.0 {
            return None;
        }
        let [first, second] = self.cameras();
        let fundamental = fundamental_from_cameras(&first, &second).ok()?;
        let (epipole1, epipole2) = epipoles(&fundamental).ok()?;
        Some(Geometry {
            fundamental,
            epipole1,
            epipole2,
        })
    }

    /// The points with their index.
    pub(super) fn points(&self) -> impl Iterator<Item = (usize, Point2<f64>)> {
        let points = self.points.iter().enumerate();
        points.filter_map(|(index, point)| Some((index, (*point)?)))
    }

    pub(super) fn point(&self, index: usize) -> Option<Point2<f64>> {
        self.points[index]
    }

    /// The index of the point that the readouts speak of.
    pub(super) fn selected(&self) -> Option<usize> {
        let chosen = self.settings.count(&SELECTED).checked_sub(1);
        chosen
            .filter(|&index| self.points[index].is_some())
            .or_else(|| self.points().last().map(|(index, _)| index))
    }

    /// Where a pixel of photograph 1 is in photograph 2, by the scene's exact depth.
    pub(super) fn find_match(&self, pixel1: &Point2<f64>) -> Match {
        let [first, second] = self.cameras();
        match scenes::still_life().transfer(&first, &second, pixel1) {
            Transfer::Visible { pixel2, .. } | Transfer::Occluded { pixel2, .. }
                if !in_picture(&pixel2) =>
            {
                Match::Outside(pixel2)
            }
            Transfer::Visible { pixel2, .. } => Match::Visible(pixel2),
            Transfer::Occluded { pixel2, by, .. } => Match::Hidden(pixel2, by),
            Transfer::BehindCamera { .. } => Match::Behind,
            Transfer::Nothing => Match::Nothing,
        }
    }

    /// The epipolar line of a pixel of photograph 1; `None` for the epipole itself, too.
    pub(super) fn line2(&self, geometry: &Geometry, pixel1: &Point2<f64>) -> Option<Line2> {
        epipolar_line2(&geometry.fundamental, pixel1).ok()
    }

    /// The line of photograph 1 through a pixel and the epipole: all its points share one line in
    /// photograph 2.
    pub(super) fn line1(&self, geometry: &Geometry, pixel1: &Point2<f64>) -> Option<Line2> {
        let line2 = self.line2(geometry, pixel1)?;
        // Any point of the line in photograph 2 gives it, unless it is the epipole there.
        let center = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) * 0.5;
        let foot = line2.nearest(&center);
        let other = Point2::new(foot.x - 500.0 * line2.b, foot.y + 500.0 * line2.a);
        let nearness = |line: &Line2| line.signed_distance(pixel1).abs();
        [foot, other]
            .iter()
            .filter_map(|pixel2| epipolar_line1(&geometry.fundamental, pixel2).ok())
            .min_by(|a, b| nearness(a).total_cmp(&nearness(b)))
    }

    fn select(&mut self, index: usize) {
        // A number within the slider's range is accepted.
        let _ = self
            .settings
            .set(SELECTED.id, &Value::Number((index + 1) as f64));
    }

    fn handle(&self, index: usize, point: Point2<f64>) -> Handle {
        Handle {
            id: POINT_IDS[index].to_owned(),
            panel: "first",
            label: format!("Point {} in photograph 1", index + 1),
            value_text: format!("column {:.1}, row {:.1}", point.x, point.y),
            x: point.x,
            y: point.y,
            x_range: [0.0, f64::from(PHOTO_WIDTH) - 1.0],
            y_range: [0.0, f64::from(PHOTO_HEIGHT) - 1.0],
            step: [4.0, 4.0],
            digits: DIGITS,
            removable: true,
        }
    }

    fn put(&mut self, index: usize, x: f64, y: f64) {
        let wanted = Point2::new(x, y);
        if let Some((x, y)) = self.handle(index, wanted).admit(x, y) {
            self.points[index] = Some(Point2::new(x, y));
            self.select(index);
        }
    }

    fn free(&self) -> Option<usize> {
        self.points.iter().position(Option::is_none)
    }

    fn remove(&mut self, index: usize) {
        self.points[index] = None;
        // The selection is said in full from now on, so that a permalink restores it.
        let next = self.selected().unwrap_or(0);
        self.select(next);
    }
}

const POINT_IDS: [&str; MAX_POINTS] = ["p1", "p2", "p3", "p4", "p5", "p6"];

fn index_of(id: &str) -> Option<usize> {
    POINT_IDS.iter().position(|known| *known == id)
}

impl Model for EpipolarClick {
    const NAME: &'static str = "epipolar-click";
    const TITLE: &'static str = "One point, one line";
    const HELP: &'static str = "Click in photograph 1 to add a point, and drag points or move them \
        with the arrow keys: each has its epipolar line in photograph 2. Move and turn the second \
        camera with the sliders.";

    fn new() -> Self {
        let mut points = [None; MAX_POINTS];
        for index in 0..NUM_AT_START {
            let (u, v) = PLACES_PX[index];
            points[index] = Some(Point2::new(u, v));
        }
        Self {
            settings: Settings::new(KNOBS),
            points,
        }
    }

    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        let count = self.points().count();
        controls.push(ADD.control(count < MAX_POINTS, false));
        controls.push(REMOVE.control(count > 0, false));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        self.points()
            .map(|(index, point)| self.handle(index, point))
            .collect()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
                if id == SELECTED.id {
                    let effective = self.selected().unwrap_or(0);
                    self.select(effective);
                }
            }
            Event::Press { id } if id == ADD.id => {
                if let Some(index) = self.free() {
                    let (u, v) = PLACES_PX[index];
                    self.put(index, u, v);
                }
            }
            Event::Press { id } if id == REMOVE.id => {
                if let Some((index, _)) = self.points().last() {
                    self.remove(index);
                }
            }
            Event::HandleMoved { id, x, y } => {
                if let Some(index) = index_of(id) {
                    self.put(index, *x, *y);
                }
            }
            Event::HandleRemoved { id } => {
                if let Some(index) = index_of(id) {
                    self.remove(index);
                }
            }
            // With every point in use, a click moves the selected one.
            Event::Clicked { x, y, .. } => {
                if let Some(index) = self.free().or_else(|| self.selected()) {
                    self.put(index, *x, *y);
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn restore_handle(&mut self, id: &str, x: f64, y: f64) -> bool {
        let Some(index) = index_of(id) else {
            return false;
        };
        self.put(index, x, y);
        true
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

const CHALLENGES: &[Challenge<EpipolarClick>] = &[
    Challenge {
        id: "epipole-inside",
        goal: "Bring the epipole e₂ into photograph 2.",
        hint: "The epipole is where camera 2 sees camera 1, before or behind it. Which motion puts \
               one camera in front of the other?",
        check: |model| {
            let geometry = model.geometry();
            geometry.is_some_and(|geometry| match geometry.epipole2 {
                Epipole::Finite(pixel) => in_picture(&pixel),
                Epipole::AtInfinity(_) => false,
            })
        },
        solution: || vec![set(&BASELINE, 0.1), set(&FORWARD, 0.4), set(&TURN, 0.0)],
    },
    Challenge {
        id: "rows",
        goal: "Make the epipolar lines of both photographs rows, so that every match is on the \
               row of its point.",
        hint: "Both epipoles must be infinitely far to the side.",
        check: |model| {
            let geometry = model.geometry();
            geometry.is_some_and(|geometry| {
                [geometry.epipole1, geometry.epipole2]
                    .iter()
                    .all(|epipole| matches!(epipole, Epipole::AtInfinity(d) if d.y.abs() < 1e-6))
            })
        },
        solution: || vec![set(&FORWARD, 0.0), set(&TURN, 0.0)],
    },
    Challenge {
        id: "hidden",
        goal: "Find a point whose match is hidden behind something.",
        hint: "Try the wall or the table just beside a near thing.",
        check: |model| {
            let mut points = model.points();
            points.any(|(_, point)| matches!(model.find_match(&point), Match::Hidden(..)))
        },
        solution: || {
            vec![Event::HandleMoved {
                id: "p1".to_owned(),
                x: 262.0,
                y: 205.0,
            }]
        },
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
    use epipole::epipolar::sampson_px;

    fn changed(events: &[Event]) -> EpipolarClick {
        let mut model = EpipolarClick::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn every_match_is_on_its_line() {
        for (right, forward, turn) in [(0.5, -0.4, 14.0), (0.1, 0.4, 0.0), (0.8, 0.0, 30.0)] {
            let model = changed(&[
                set(&BASELINE, right),
                set(&FORWARD, forward),
                set(&TURN, turn),
            ]);
            let geometry = model.geometry().unwrap();
            for (_, point) in model.points() {
                let Some(pixel2) = model.find_match(&point).pixel() else {
                    continue;
                };
                let line = model.line2(&geometry, &point).unwrap();
                assert!(line.signed_distance(&pixel2).abs() < 1e-6);
                assert!(sampson_px(&geometry.fundamental, &point, &pixel2) < 1e-6);
                let line1 = model.line1(&geometry, &point).unwrap();
                assert!(line1.signed_distance(&point).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn every_place_to_begin_is_seen_by_both_cameras() {
        let model = EpipolarClick::new();
        for (u, v) in PLACES_PX {
            let found = model.find_match(&Point2::new(u, v));
            assert!(matches!(found, Match::Visible(_)), "({u}, {v}): {found:?}");
        }
    }

    #[test]
    fn the_epipole_is_camera_1_seen_by_camera_2() {
        let model = EpipolarClick::new();
        let [first, second] = model.cameras();
        let seen = second.project(&first.center_in_world()).unwrap();
        let Epipole::Finite(pixel) = model.geometry().unwrap().epipole2 else {
            panic!("it is finite");
        };
        assert!((pixel - seen).norm() < 1e-6);
    }

    #[test]
    fn turned_left_means_that_things_move_right_in_the_picture() {
        let still = changed(&[set(&BASELINE, 0.0), set(&FORWARD, 0.0), set(&TURN, 0.0)]);
        let turned = changed(&[set(&BASELINE, 0.0), set(&FORWARD, 0.0), set(&TURN, 10.0)]);
        let point = Point2::new(300.0, 240.0);
        let (a, b) = (still.find_match(&point), turned.find_match(&point));
        assert!(b.pixel().unwrap().x > a.pixel().unwrap().x + 50.0);
        assert!(turned.geometry().is_none());
        assert_eq!(turned.describe(), words::NO_BASELINE);
    }

    #[test]
    fn points_are_added_until_there_is_no_room() {
        let mut model = EpipolarClick::new();
        let click = |x: f64| Event::Clicked {
            panel: "first".into(),
            x,
            y: 33.333,
        };
        for x in [10.0, 20.0, 30.04] {
            model.update(&click(x)).unwrap();
        }
        assert_eq!(model.points().count(), MAX_POINTS);
        assert_eq!(model.points[5], Some(Point2::new(30.0, 33.3)));
        assert_eq!(model.selected(), Some(5));
        model
            .update(&Event::Press {
                id: "remove".into(),
            })
            .unwrap();
        assert_eq!(model.selected(), Some(4));
    }
}
