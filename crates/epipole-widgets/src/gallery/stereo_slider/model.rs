//! State and mathematics of `stereo-slider`: a point seen by a rectified stereo pair.

use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider, Value,
    format_number,
};
use crate::scenes::{self, PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::camera::{Camera, Intrinsics};
use epipole::stereo::{DepthInterval, depth_from_disparity, depth_interval};
use nalgebra::{Isometry3, Point2, Point3};

pub(super) const BASELINE: Slider = Slider {
    id: "baseline",
    label: "Baseline",
    unit: "m",
    min: 0.0,
    max: 0.4,
    step: 0.01,
    default: 0.12,
    digits: 2,
    visible: true,
};
pub(super) const FOCAL: Slider = Slider {
    id: "focal",
    label: "Focal length",
    unit: "px",
    min: 400.0,
    max: 1000.0,
    step: 20.0,
    default: 700.0,
    digits: 0,
    visible: true,
};
const KNOBS: &[Knob] = &[Knob::Slider(&BASELINE), Knob::Slider(&FOCAL)];

/// The smallest and largest distance of the object from the line between the cameras, meters.
pub(super) const DEPTH_RANGE_M: [f64; 2] = [0.8, 10.0];
/// How far the object can stand to either side of the left camera's axis, meters.
pub(super) const SIDE_RANGE_M: [f64; 2] = [-0.8, 0.8];
/// The error of a disparity that the figure asks about, pixels.
pub(super) const ERROR_PX: f64 = 1.0;

/// Digits that the object's place is kept with.
const DIGITS: usize = 3;

/// A point in front of two cameras that look the same way, side by side.
pub(crate) struct StereoSlider {
    settings: Settings,
    /// Place of the object along the row of cameras and away from it, meters.
    x_m: f64,
    z_m: f64,
}

/// What the two photographs measure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured {
    pub(super) disparity_px: f64,
    pub(super) depth_m: f64,
    pub(super) interval: DepthInterval,
}

/// How a photograph shows the middle of the object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sight {
    /// Nothing is in the way.
    Clear,
    /// This is in the way.
    Hidden(&'static str),
    /// It is beyond the picture's edge.
    Outside,
}

impl StereoSlider {
    pub(super) fn baseline_m(&self) -> f64 {
        self.settings.number(&BASELINE)
    }

    pub(super) fn focal_px(&self) -> f64 {
        self.settings.number(&FOCAL)
    }

    /// Place of the object seen from above: to the right of the left camera, and its depth.
    pub(super) fn object_m(&self) -> (f64, f64) {
        (self.x_m, self.z_m)
    }

    /// The middle of the object in the frame of the left camera, which is the world's.
    pub(super) fn object_in_world(&self) -> Point3<f64> {
        Point3::new(self.x_m, scenes::BALL_Y_M, self.z_m)
    }

    /// The left and the right camera.
    pub(super) fn cameras(&self) -> Result<[Camera; 2], epipole::Error> {
        let intrinsics = Intrinsics::centered(self.focal_px(), PHOTO_WIDTH, PHOTO_HEIGHT)?;
        Ok([0.0, self.baseline_m()].map(|x_m| Camera {
            intrinsics,
            cam_from_world: Isometry3::translation(-x_m, 0.0, 0.0),
        }))
    }

    /// Where the left and the right camera see the middle of the object.
    pub(super) fn pixels(&self) -> Result<[Point2<f64>; 2], epipole::Error> {
        let [left, right] = self.cameras()?;
        let object = self.object_in_world();
        Ok([left.project(&object)?, right.project(&object)?])
    }

    /// Disparity and depth, computed from the two pixels alone; `None` without a baseline.
    pub(super) fn measured(&self) -> Option<Measured> {
        let [left, right] = self.pixels().ok()?;
        let disparity_px = left.x - right.x;
        let (focal_px, baseline_m) = (self.focal_px(), self.baseline_m());
        Some(Measured {
            disparity_px,
            depth_m: depth_from_disparity(focal_px, baseline_m, disparity_px).ok()?,
            interval: depth_interval(focal_px, baseline_m, disparity_px, ERROR_PX).ok()?,
        })
    }

    /// Puts the object, without changing its depth, where a camera sees it in column `u_px`.
    fn move_to_column(&mut self, camera_x_m: f64, u_px: f64) {
        let center_px = (f64::from(PHOTO_WIDTH) - 1.0) / 2.0;
        let x_m = camera_x_m + (u_px - center_px) * self.z_m / self.focal_px();
        if let Some((x_m, z_m)) = self.handle().admit(x_m, self.z_m) {
            (self.x_m, self.z_m) = (x_m, z_m);
        }
    }

    fn handle(&self) -> Handle {
        let side = if self.x_m < 0.0 { "left" } else { "right" };
        Handle {
            id: "object".to_owned(),
            panel: "top",
            label: "Ball, seen from above".to_owned(),
            value_text: format!(
                "{:.2} m away, {:.2} m to the {side}",
                self.z_m,
                self.x_m.abs()
            ),
            x: self.x_m,
            y: self.z_m,
            x_range: SIDE_RANGE_M,
            y_range: DEPTH_RANGE_M,
            step: [0.05, 0.05],
            digits: DIGITS,
            removable: false,
        }
    }

    /// How each photograph shows the middle of the object.
    pub(super) fn sights(&self) -> Result<[Sight; 2], epipole::Error> {
        let scene = scenes::long_table(self.object_m())?;
        let (cameras, pixels) = (self.cameras()?, self.pixels()?);
        let sight = |index: usize| {
            if !scenes::in_picture(&pixels[index]) {
                return Sight::Outside;
            }
            let center = cameras[index].center_in_world();
            let hit = scene.cast(&center, &(self.object_in_world() - center));
            match hit {
                Some(hit) if hit.object != scenes::BALL => Sight::Hidden(hit.object),
                _ => Sight::Clear,
            }
        };
        Ok([sight(0), sight(1)])
    }

    /// What keeps a real pair from measuring the object, as a sentence.
    fn trouble(&self) -> Option<String> {
        let Ok(sights) = self.sights() else {
            return Some("It is not on the table.".to_owned());
        };
        let sides = ["left", "right"];
        match sights {
            [Sight::Clear, Sight::Clear] => None,
            [Sight::Outside, Sight::Outside] => Some("Neither photograph shows it.".to_owned()),
            [Sight::Hidden(by), Sight::Hidden(other)] if by == other => {
                Some(format!("In both photographs it is hidden by {by}."))
            }
            _ => (0..2).find_map(|index| match sights[index] {
                Sight::Clear => None,
                Sight::Outside => Some(format!(
                    "The {} photograph does not show it, so a real pair could not measure it.",
                    sides[index]
                )),
                Sight::Hidden(by) => Some(format!(
                    "In the {} photograph it is hidden by {by}, so a real pair could not measure it.",
                    sides[index]
                )),
            }),
        }
    }
}

impl Model for StereoSlider {
    const NAME: &'static str = "stereo-slider";
    const TITLE: &'static str = "Depth from disparity";
    const HELP: &'static str = "Drag the ball in the view from above, or move it with the arrow \
        keys; a click in a photograph moves it sideways. Set the baseline and the focal length \
        with the sliders.";

    fn new() -> Self {
        // With the default rig the object is seen in columns 410 and 380.
        Self {
            settings: Settings::new(KNOBS),
            x_m: 0.362,
            z_m: 2.8,
        }
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
            }
            Event::HandleMoved { x, y, .. } => (self.x_m, self.z_m) = (*x, *y),
            Event::Clicked { panel, x, y } => match panel.as_str() {
                "left" => self.move_to_column(0.0, *x),
                "right" => self.move_to_column(self.baseline_m(), *x),
                _ => {
                    if let Some(place) = self.handle().admit(*x, *y) {
                        (self.x_m, self.z_m) = place;
                    }
                }
            },
            _ => {}
        }
        Ok(())
    }

    fn readouts(&self) -> Vec<Readout> {
        let pixels = self.pixels().ok();
        let measured = self.measured();
        let interval = measured.map(|measured| measured.interval);
        let digits = interval.map_or(2, |interval| depth_digits(&interval));
        let say = |id, label, value: Option<f64>, digits, unit, otherwise: &str| match value {
            Some(value) => Readout::number(id, label, value, digits, unit),
            None => Readout::words(id, label, otherwise),
        };
        let column = |index: usize| pixels.map(|pixels| pixels[index].x);
        let disparity_px = pixels.map(|[left, right]| left.x - right.x);
        let depth_m = measured.map(|measured| measured.depth_m);
        let near_m = interval.map(|interval| interval.near_m);
        let far_m = interval.and_then(|interval| interval.far_m);
        let unknown = "not determined";
        let far = if interval.is_some() {
            "infinitely far"
        } else {
            unknown
        };
        vec![
            say("u-left", "Column on the left", column(0), 1, "px", unknown),
            say(
                "u-right",
                "Column on the right",
                column(1),
                1,
                "px",
                unknown,
            ),
            say("disparity", "Disparity d", disparity_px, 1, "px", unknown),
            say("depth", "Depth Z = f B / d", depth_m, 2, "m", unknown),
            say(
                "near",
                "Depth if d is 1 px larger",
                near_m,
                digits,
                "m",
                unknown,
            ),
            say("far", "Depth if d is 1 px smaller", far_m, digits, "m", far),
        ]
    }

    fn describe(&self) -> String {
        let Some(measured) = self.measured() else {
            return NO_BASELINE.to_owned();
        };
        let number = format_number;
        let mut sentence = format!(
            "With a baseline of {} m and a focal length of {} px, the ball at {} m has a \
             disparity of {} px. With one pixel of error the depth could be anything from {}.",
            number(self.baseline_m(), 2),
            number(self.focal_px(), 0),
            number(measured.depth_m, 2),
            number(measured.disparity_px, 1),
            reach(&measured.interval),
        );
        if let Some(trouble) = self.trouble() {
            sentence.push(' ');
            sentence.push_str(&trouble);
        }
        sentence
    }

    fn challenges() -> &'static [Challenge<Self>] {
        CHALLENGES
    }
}

/// An interval of depths in words, such as "2.71 to 2.90 m".
pub(super) fn reach(interval: &DepthInterval) -> String {
    let near_m = interval.near_m;
    match interval.far_m {
        Some(far_m) => {
            let digits = depth_digits(interval);
            let (near, far) = (format_number(near_m, digits), format_number(far_m, digits));
            format!("{near} to {far} m")
        }
        None => format!("{} m to infinity", format_number(near_m, 2)),
    }
}

/// Digits that tell the ends of an interval apart.
fn depth_digits(interval: &DepthInterval) -> usize {
    match interval.far_m {
        Some(far_m) if far_m - interval.near_m < 0.1 => 3,
        _ => 2,
    }
}

/// What the figure says when both cameras stand at one place.
pub(super) const NO_BASELINE: &str = "The baseline is 0, so both cameras stand at the same place: \
    the photographs are equal, every disparity is 0, and depth cannot be measured.";

const CHALLENGES: &[Challenge<StereoSlider>] = &[
    Challenge {
        id: "double",
        goal: "Double the disparity to 60 px without touching the sliders.",
        hint: "Disparity and depth are inversely proportional.",
        check: |model| {
            model.baseline_m() == BASELINE.default
                && model.focal_px() == FOCAL.default
                && disparity_is(model, 60.0)
        },
        solution: || vec![moved(0.2, 1.4)],
    },
    Challenge {
        id: "one-meter",
        goal: "Find a place where one pixel of error can put the object more than 1 m too far \
               away, without touching the sliders.",
        hint: "The error grows with the square of the depth.",
        check: |model| {
            let measured = model.measured();
            model.baseline_m() == BASELINE.default
                && model.focal_px() == FOCAL.default
                && measured.is_some_and(|measured| {
                    let far_m = measured.interval.far_m.unwrap_or(f64::INFINITY);
                    far_m - measured.depth_m > 1.0
                })
        },
        solution: || vec![moved(0.3, 9.2)],
    },
    Challenge {
        id: "same-disparity",
        goal: "Move the object to 5 m (4.9 to 5.1 m) and find the baseline that gives it 28 px of \
               disparity at f = 700 px.",
        hint: "B = d Z / f.",
        check: |model| {
            (4.9..=5.1).contains(&model.z_m)
                && model.focal_px() == FOCAL.default
                && disparity_is(model, 28.0)
        },
        solution: || {
            vec![
                moved(0.3, 5.0),
                Event::Set {
                    id: BASELINE.id.to_owned(),
                    value: Value::Number(0.2),
                },
            ]
        },
    },
];

fn disparity_is(model: &StereoSlider, wanted_px: f64) -> bool {
    let measured = model.measured();
    measured.is_some_and(|measured| (measured.disparity_px - wanted_px).abs() <= 0.8)
}

fn moved(x: f64, y: f64) -> Event {
    Event::HandleMoved {
        id: "object".to_owned(),
        x,
        y,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_state_is_the_worked_example() {
        let model = StereoSlider::new();
        let [left, right] = model.pixels().unwrap();
        assert!((left.x - 410.0).abs() < 1e-9 && (right.x - 380.0).abs() < 1e-9);
        let measured = model.measured().unwrap();
        assert!((measured.disparity_px - 30.0).abs() < 1e-9);
        assert!((measured.depth_m - 2.8).abs() < 1e-9);
        // 84 / 31 and 84 / 29.
        assert!((measured.interval.near_m - 84.0 / 31.0).abs() < 1e-9);
        assert!((measured.interval.far_m.unwrap() - 84.0 / 29.0).abs() < 1e-9);
        assert_eq!(left.y, right.y, "rows are aligned");
    }

    #[test]
    fn without_a_baseline_there_is_a_sentence() {
        let mut model = StereoSlider::new();
        let value = Value::Number(0.0);
        model
            .update(&Event::Set {
                id: "baseline".into(),
                value,
            })
            .unwrap();
        assert!(model.measured().is_none());
        assert_eq!(model.describe(), NO_BASELINE);
    }

    #[test]
    fn what_hides_the_ball_is_named() {
        let mut model = StereoSlider::new();
        assert_eq!(model.sights(), Ok([Sight::Clear, Sight::Clear]));
        model.update(&moved(-0.3, 0.9)).unwrap();
        let value = Value::Number(0.4);
        let id = "baseline".into();
        model.update(&Event::Set { id, value }).unwrap();
        assert_eq!(model.sights().unwrap()[1], Sight::Outside);
        assert!(
            model
                .describe()
                .contains("The right photograph does not show it")
        );
        let hidden = (8..100).any(|tenths| {
            model.update(&moved(0.6, f64::from(tenths) / 10.0)).unwrap();
            matches!(model.sights(), Ok([Sight::Hidden(by), _]) if model.describe().contains(by))
        });
        assert!(hidden);
    }

    #[test]
    fn the_interval_can_reach_infinity() {
        let mut model = StereoSlider::new();
        for (id, value) in [("baseline", 0.01), ("focal", 400.0)] {
            let value = Value::Number(value);
            model
                .update(&Event::Set {
                    id: id.into(),
                    value,
                })
                .unwrap();
        }
        model.update(&moved(0.0, 8.0)).unwrap();
        assert_eq!(model.measured().unwrap().interval.far_m, None);
        assert!(model.describe().contains("from") && model.describe().contains("infinity"));
    }

    #[test]
    fn a_click_in_a_photograph_moves_the_object_there() {
        let mut model = StereoSlider::new();
        for (panel, index) in [("left", 0), ("right", 1)] {
            let event = Event::Clicked {
                panel: panel.into(),
                x: 250.0,
                y: 10.0,
            };
            model.update(&event).unwrap();
            assert!((model.pixels().unwrap()[index].x - 250.0).abs() < 0.2);
            assert_eq!(model.object_m().1, 2.8);
        }
    }
}
