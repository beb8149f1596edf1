//! A pair of photographs, the current stage of the pipeline, and the viewpoint of its cloud.

use crate::contract::{
    Asking, Button, ButtonRole, Challenge, Choice, Compute, Control, Declared, Event, FileOffer,
    Handle, Knob, Model, PhotoSlot, Problem, Settings, Slider, Space, Symbol, format_number, knobs,
};
use crate::kit::geometry::symbols_of_one;
use crate::kit::orbit::{Orbit, SPACE};
use crate::kit::picture::{Own, Picture, pair_slots};
use crate::kit::question::{Computation, carry_out};
use crate::kit::reconstruction::{Answer, CloudPoint, Question, Source, Stage};
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use image::RgbImage;
use nalgebra::Point3;

const STAGE: Choice = Choice::new(
    "stage",
    "Stage",
    &[
        ("detect", "1 Detect"),
        ("match", "2 Match"),
        ("ransac", "3 RANSAC"),
        ("pose", "4 Pose"),
        ("cloud", "5 Triangulate"),
        ("adjust", "6 Adjust"),
        ("surface", "7 Every pixel"),
    ],
)
.at(6);
const NEXT: Button = Button::new("next", "Next stage", ButtonRole::Step);
const PAIR: Choice = Choice::new(
    "pair",
    "Photographs",
    &[
        ("step", "A step aside"),
        ("turn", "Only turned"),
        ("own", "Yours"),
    ],
)
.more();
const OWN: usize = 2;
const RATIO: Slider = Slider::new("ratio", "Ratio test τ")
    .range(0.5, 0.95, 0.05)
    .at(0.8)
    .digits(2)
    .more();
const THRESHOLD: Slider = Slider::new("threshold", "Threshold ε")
    .range(0.5, 4.0, 0.5)
    .at(1.5)
    .digits(1)
    .unit("px")
    .more();
const FOCAL: Slider = Slider::new("focal", "Focal f")
    .range(0.4, 3.0, 0.05)
    .at(1.25)
    .digits(2);
const KNOCK: Slider = Slider::new("knock", "Knock camera 2")
    .range(0.0, 10.0, 0.5)
    .at(2.0)
    .digits(1)
    .unit("°");
/// Usual focal length of a phone's main camera: 27 mm, in units of 36 mm.
const USUAL_FOCAL: f64 = 0.75;
const KNOBS: &[Knob] = knobs![STAGE, PAIR, RATIO, THRESHOLD, KNOCK, FOCAL];

const SLOTS: &[PhotoSlot] = &pair_slots(800);
/// Minimum side of a photograph, pixels; smaller ones have no room for features.
const MIN_SIDE_PX: u32 = 64;

const STAGES: [Stage; 7] = [
    Stage::Detect,
    Stage::Match,
    Stage::Ransac,
    Stage::Pose,
    Stage::Cloud,
    Stage::Adjust,
    Stage::Surface,
];

/// Source of the focal length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FocalFrom {
    /// Exact: the photographs are rendered with it.
    Known,
    /// Set by the reader.
    Reader,
    /// Metadata of a photograph.
    File,
    /// Unknown: assumed to be the usual one of a phone.
    Guess,
}

/// The model of `two-view-sfm`.
pub(crate) struct TwoViewSfm {
    settings: Settings,
    pub(super) orbit: Orbit,
    own: Own<2>,
    focal_from: FocalFrom,
    pub(super) asked: Computation<Question>,
}

impl TwoViewSfm {
    pub(super) fn stage(&self) -> Stage {
        STAGES[self.settings.chosen(&STAGE)]
    }

    pub(super) fn answer(&self) -> Option<&Answer> {
        self.asked.answer()
    }

    pub(super) fn focal(&self) -> f64 {
        self.settings.number(&FOCAL)
    }

    pub(super) fn knock_deg(&self) -> f64 {
        self.settings.number(&KNOCK)
    }

    pub(super) fn focal_from(&self) -> FocalFrom {
        self.focal_from
    }

    pub(super) fn is_own(&self) -> bool {
        self.settings.chosen(&PAIR) == OWN
    }

    /// Returns a photograph, even before the computation.
    pub(super) fn picture(&self, index: usize) -> Option<&Picture> {
        let answered = self.answer().map(|answer| &answer.pictures[index]);
        answered.or_else(|| self.own.get(index).filter(|_| self.is_own()))
    }

    /// Returns the source of the photographs; `None` while the reader has not chosen both.
    fn source(&self) -> Option<Source> {
        match self.settings.chosen(&PAIR) {
            0 => Some(Source::Step),
            1 => Some(Source::Turn),
            _ => self.own.all().map(Source::Own),
        }
    }

    /// Returns the rotation of camera 2 relative to camera 1 at the current stage, degrees.
    pub(super) fn turn_deg(&self) -> Option<f64> {
        let (question, answer) = self.asked.answered()?;
        let motion = question.motion(answer, self.stage())?;
        Some(motion.rotation.angle().to_degrees())
    }

    /// Returns the true angle between the cameras of a rendered pair, degrees.
    pub(super) fn true_turn_deg(&self) -> Option<f64> {
        self.source()?.true_turn_deg()
    }

    /// Returns the points of the current stage, in the frame of camera 1 and in units of the
    /// baseline.
    fn cloud(&self) -> Option<PointCloud> {
        let motion = self.answer()?.motion.as_ref()?;
        let (points, colors) = match (self.stage(), &motion.surface) {
            (Stage::Surface, Ok(surface)) => {
                let points = surface.points.iter();
                points
                    .map(|(place, color)| (Point3::from(*place).cast(), *color))
                    .unzip()
            }
            (Stage::Cloud, _) => (motion.points.iter()).map(CloudPoint::before).unzip(),
            (Stage::Adjust | Stage::Surface, _) => (motion.points.iter())
                .map(|point| (point.place, point.color))
                .unzip(),
            _ => return None,
        };
        Some(PointCloud {
            points,
            colors,
            ..PointCloud::default()
        })
    }

    /// Requests the computation for the current settings.
    fn ask(&mut self) {
        let Some(source) = self.source() else {
            return self.asked.refuse(self.own.wanted());
        };
        self.asked.ask(Question {
            source,
            focal: self.focal(),
            max_ratio: self.settings.number(&RATIO) as f32,
            max_error_px: self.settings.number(&THRESHOLD),
            knock_deg: self.knock_deg(),
        });
    }

    /// Discards all results, since the photographs have changed.
    fn begin(&mut self) {
        self.asked.forget();
        self.ask();
    }

    fn is_last_stage(&self) -> bool {
        self.stage() == Stage::Surface
    }
}

/// Formats a focal length in units of the longer side, with its full-frame equivalent.
pub(super) fn focal_text(value: f64) -> String {
    let mm = format_number(36.0 * value, 0);
    format!("{} ({mm} mm)", format_number(value, 2))
}

impl Declared for TwoViewSfm {
    const NAME: &'static str = "two-view-sfm";
    const TITLE: &'static str = "Two photographs, one cloud";
    const HELP: &'static str = "Go through the stages. Drag in the view of space, or use the arrow \
        keys on its handle, to look from elsewhere; with Shift, or the small cross, the scene moves; \
        with Ctrl and the wheel, or + and −, it becomes larger. On a touchscreen drag the handle, \
        or use two fingers.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;
    const SPACES: &'static [Space] = &[SPACE];
    const PHOTO_SLOTS: &'static [PhotoSlot] = SLOTS;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            orbit: Orbit::new(-56.0, 22.0),
            own: Own::new(SLOTS, MIN_SIDE_PX),
            focal_from: FocalFrom::Known,
            asked: Computation::default(),
        };
        model.ask();
        model
    }
}

impl Model for TwoViewSfm {
    fn controls(&self) -> Vec<Control> {
        let mut controls = self.settings.controls();
        for control in controls.iter_mut().filter(|control| control.id == FOCAL.id) {
            control.value_text = focal_text(self.focal());
        }
        controls.push(NEXT.control(!self.is_last_stage(), false));
        controls.extend(self.orbit.controls());
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        self.orbit.handles().into()
    }

    /// Returns the symbols of one of the inliers, once matches are shown.
    fn symbols(&self) -> Vec<Symbol> {
        let shown = (self.stage() > Stage::Detect).then(|| self.answer());
        let (Some(answer), Some(picture)) = (shown.flatten(), self.picture(0)) else {
            return Vec::new();
        };
        let inliers = answer.matches_that(true).map(|pair| answer.pixels(pair));
        symbols_of_one(inliers, picture.size())
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.orbit.update(event)? {
            return Ok(());
        }
        let changed = self.settings.update(event)?;
        if changed == Some(FOCAL.id) {
            self.focal_from = FocalFrom::Reader;
        }
        match changed {
            Some(id) if id == PAIR.id => self.begin(),
            Some(id) if id != STAGE.id => self.ask(),
            _ => {}
        }
        if *event == Event::press(NEXT.id) && !self.is_last_stage() {
            self.settings
                .choose(&STAGE, self.settings.chosen(&STAGE) + 1);
        }
        Ok(())
    }

    fn asking(&mut self) -> Option<&mut dyn Asking> {
        Some(&mut self.asked)
    }

    fn file(&self) -> Option<FileOffer> {
        // Offered from the start, since a button that appears later would shift the toolbar.
        Some(FileOffer {
            label: "Save points",
            hint: "Save the points in color as a PLY file, which MeshLab, CloudCompare and Blender open",
            extension: "ply",
            is_ready: self.stage() >= Stage::Cloud && self.cloud().is_some(),
        })
    }

    fn file_bytes(&self) -> Vec<u8> {
        self.cloud()
            .map_or_else(Vec::new, |cloud| write_ply(&cloud))
    }

    fn wants_photos(&self) -> bool {
        self.is_own() && self.own.all().is_none()
    }

    fn take_photo(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        self.own.take(slot, photo)?;
        if !self.is_own() {
            // The focal length of rendered photographs is known; that of others is only guessed.
            self.settings.slide(&FOCAL, USUAL_FOCAL);
            self.settings.slide(&KNOCK, 0.0);
            self.focal_from = FocalFrom::Guess;
            self.settings.choose(&PAIR, OWN);
        }
        self.begin();
        Ok(())
    }

    fn take_focal(&mut self, _: &str, focal: f64) {
        self.settings.slide(&FOCAL, focal);
        self.focal_from = FocalFrom::File;
        self.ask();
    }
}

const CHALLENGES: &[Challenge<TwoViewSfm>] = &[
    Challenge {
        id: "plan",
        goal: "Look down on the table from more than 60° and find the books.",
        hint: "Drag downward in the view of space.",
        why: "Two photographs taken side by side hold the plan of the table, which neither of them \
              shows.",
        check: |model| {
            let has_cloud =
                !model.is_own() && model.answer().is_some_and(|answer| answer.motion.is_some());
            has_cloud && model.stage() >= Stage::Cloud && model.orbit.rise_deg() > 60.0
        },
        solution: || vec![Event::moved(SPACE.orbit, 0.0, 75.0)],
    },
    Challenge {
        id: "lens",
        goal: "Get the rotation wrong by 2° or more without disturbing a single match.",
        hint: "What do the pixels not say by themselves?",
        why: "A focal length turns pixels into angles: a wrong one bends every ray, and the pose \
              bends with them.",
        check: |model| {
            let wrong = model.turn_deg().zip(model.true_turn_deg());
            model.stage() >= Stage::Adjust
                && wrong.is_some_and(|(found, truth)| (found - truth).abs() >= 2.0)
        },
        solution: || vec![Event::set(&FOCAL, 2.5)],
    },
    Challenge {
        id: "purer",
        goal: "Make 95% of the matches inliers, and leave ε as it is.",
        hint: "Accept fewer matches, and only clear ones.",
        why: "The ratio test drops features that look like several others, and those are where the \
              wrong matches come from.",
        check: |model| {
            let is_step = model.settings.chosen(&PAIR) == 0;
            let untouched = model.settings.number(&THRESHOLD) == THRESHOLD.default;
            let pure = |answer: &Answer| 100 * answer.num_inliers() >= 95 * answer.matches.len();
            is_step && untouched && model.answer().is_some_and(pure)
        },
        solution: || vec![Event::set(&RATIO, 0.6)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;
    use crate::kit::question::{settle, settled};
    use image::imageops::crop_imm;

    #[test]
    fn photographs_of_two_sizes_give_points_and_say_what_they_do_not_give() {
        let mut model: TwoViewSfm = settled(&[Event::set(&STAGE, "surface")]);
        let pictures = &model.answer().unwrap().pictures;
        let [first, second] = pictures.each_ref().map(|picture| picture.image().clone());
        let (width, height) = second.dimensions();
        let second = crop_imm(&second, 0, 12, width, height - 24).to_image();
        model.take_photo("first", first).unwrap();
        model.take_photo("second", second).unwrap();
        model.update(&Event::set(&FOCAL, FOCAL.default)).unwrap();
        settle(&mut model);
        let motion = model.answer().unwrap().motion.as_ref().unwrap();
        assert!(motion.points.len() > 300 && motion.surface.is_err());
        let words = model.describe();
        assert!(
            words.contains("the same size") && words.contains("all there is"),
            "{words}"
        );
    }

    #[test]
    fn the_adjustment_undoes_what_knocking_a_camera_did() {
        let errors = [0.0, KNOCK.default, KNOCK.max].map(|knock| {
            let model: TwoViewSfm = settled(&[Event::set(&KNOCK, knock)]);
            let motion = model.answer().unwrap().motion.as_ref().unwrap();
            let truth = model.true_turn_deg().unwrap();
            assert!((model.turn_deg().unwrap() - truth).abs() < 0.1, "{knock}");
            motion.error_px
        });
        // RANSAC has refined its pose with all inliers, so bundle adjustment has nothing to
        // improve.
        assert!((errors[0][0] - errors[0][1]).abs() < 0.002, "{errors:?}");
        assert!(errors[1][0] > 5.0 && errors[2][0] > 25.0, "{errors:?}");
        assert!(errors.iter().all(|error| error[1] < 0.2), "{errors:?}");
    }

    #[test]
    fn the_points_of_each_stage_can_be_saved() {
        let lengths = ["ransac", "cloud", "adjust", "surface"].map(|stage| {
            let model: TwoViewSfm = settled(&[Event::set(&STAGE, stage)]);
            assert_eq!(
                model.file().is_some_and(|file| file.is_ready),
                stage != "ransac"
            );
            let bytes = model.file_bytes();
            let text = String::from_utf8_lossy(&bytes[..bytes.len().min(400)]).into_owned();
            let number = text
                .split("element vertex ")
                .nth(1)?
                .split_whitespace()
                .next()?;
            let number: usize = number.parse().ok()?;
            // Three floats and a color per point.
            let header = text.find("end_header\n")? + "end_header\n".len();
            assert_eq!(bytes.len(), header + 15 * number);
            Some(number)
        });
        let [None, Some(cloud), Some(adjusted), Some(surface)] = lengths else {
            panic!("{lengths:?}");
        };
        assert!(
            cloud == adjusted && adjusted > 500 && surface > 20 * adjusted,
            "{lengths:?}"
        );
    }

    #[test]
    fn a_camera_that_only_turned_gives_no_cloud_and_solves_nothing() {
        let model: TwoViewSfm = settled(&[Event::set(&PAIR, "turn")]);
        let answer = model.answer().unwrap();
        assert!(answer.num_inliers() > 1000 && answer.motion.is_none());
        assert!(!CHALLENGES.iter().any(|challenge| (challenge.check)(&model)));
    }

    #[test]
    fn a_turn_is_told_though_the_focal_length_is_wrong() {
        for focal in [0.75, 1.0, 1.5, 1.6, 2.5] {
            let model: TwoViewSfm = settled(&[
                Event::set(&PAIR, "turn"),
                Event::set(&FOCAL, focal),
                Event::set(&STAGE, "adjust"),
            ]);
            assert!(model.answer().unwrap().motion.is_none());
            let words = model.describe();
            assert!(words.starts_with("The camera only turned, by "), "{words}");
            let near = words.split(" is near ").nth(1).expect(&words);
            let near: f64 = near.split_whitespace().next().unwrap().parse().unwrap();
            assert!((near - FOCAL.default).abs() < 0.05, "{words}");
        }
    }
}
