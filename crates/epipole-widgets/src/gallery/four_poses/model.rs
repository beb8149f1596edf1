//! Position and rotation of camera 2 in front of the house.

use super::poses::{Ambiguity, Pose};
use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider,
    format_number, knobs,
};
use crate::kit::probe::Probe;
use epipole::camera::RigidTransform;
use nalgebra::{Translation3, UnitQuaternion, Vector3};

const TURN: Slider = Slider::new("turn", "Turn camera 2")
    .range(-45.0, 45.0, 1.0)
    .at(16.0)
    .unit("°");
const KNOBS: &[Knob] = knobs![TURN];

/// Range of camera 2, scene units: to the right, and forward.
pub(super) const X_RANGE: [f64; 2] = [-1.6, 1.6];
pub(super) const Z_RANGE: [f64; 2] = [-1.0, 1.2];
/// Initially closer to the house than camera 1, so that all corners stay near in all four poses: a
/// corner at equal distances from both cameras goes to infinity in the half-turned poses.
const CAMERA_2: Probe = Probe::new("camera2", "first", "Camera 2")
    .within([X_RANGE, Z_RANGE])
    .step(0.1)
    .digits(2)
    .told(|(x, z)| {
        let side = if x < 0.0 { "left" } else { "right" };
        let way = if z < 0.0 { "behind" } else { "ahead" };
        let [aside, along] = [x, z].map(|value| format_number(value.abs(), 2));
        format!("{aside} to the {side}, {along} {way}")
    })
    .at(-0.8, 0.6);
/// Distance beyond which a corner is treated as infinitely far, scene units.
const FAR: f64 = 20.0;

/// The model of `four-poses`.
pub(crate) struct FourPoses {
    settings: Settings,
    pub(super) camera2: Probe,
    found: epipole::Result<Ambiguity>,
}

impl FourPoses {
    pub(super) fn turn_deg(&self) -> f64 {
        self.settings.number(&TURN)
    }

    pub(super) fn poses(&self) -> &[Pose] {
        self.found.as_ref().map_or(&[], |found| &found.poses)
    }

    pub(super) fn num_matches(&self) -> usize {
        self.found.as_ref().map_or(0, |found| found.num_matches)
    }

    fn refresh(&mut self) {
        self.found = ambiguity(self.camera2.place(), self.turn_deg());
    }
}

fn ambiguity((x, z): (f64, f64), turn_deg: f64) -> epipole::Result<Ambiguity> {
    let world_from_cam = RigidTransform::from_parts(
        Translation3::new(x, 0.0, z),
        UnitQuaternion::from_axis_angle(&Vector3::y_axis(), turn_deg.to_radians()),
    );
    Ambiguity::of(&world_from_cam.inverse())
}

impl Declared for FourPoses {
    const NAME: &'static str = "four-poses";
    const TITLE: &'static str = "Four poses, one in front";
    const HELP: &'static str = "Drag camera 2 in the first picture, or move it with the arrow keys, \
        and turn it. Each picture is the same pair of photographs, explained by another pose.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            camera2: CAMERA_2,
            found: ambiguity(CAMERA_2.place(), TURN.default),
        }
    }
}

impl Model for FourPoses {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.camera2.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        self.settings.update(event)?;
        self.camera2.update(event);
        self.refresh();
        Ok(())
    }
}

const CHALLENGES: &[Challenge<FourPoses>] = &[
    Challenge {
        id: "forward",
        goal: "Step straight forward, and let one pose still stand out.",
        hint: "Right ahead of camera 1, as far as it goes.",
        why: "Any step gives an E with four poses, and one of them has the house in front of both \
              cameras, whatever the direction.",
        check: |model| {
            let first = model.poses().first();
            let (x, z) = model.camera2.place();
            x.abs() < 0.06 && z > 0.5 && first.is_some_and(|pose| pose.num_in_front() > 0)
        },
        solution: || vec![Event::moved("camera2", 0.0, 1.0), Event::set(&TURN, 0.0)],
    },
    Challenge {
        id: "infinity",
        goal: "Send a corner of a half-turned pose to infinity.",
        hint: "Its rays must be parallel there. Stand as far from the corner as camera 1 does.",
        why: "The half-turn reflects one ray about the baseline, so a corner equally far from both \
              cameras has parallel rays.",
        check: |model| {
            let half_turned = model.poses().iter().skip(2);
            half_turned
                .flat_map(|pose| pose.crossings.iter().flatten())
                .any(|crossing| {
                    let distance = crossing.point.coords.norm();
                    distance > FAR
                })
        },
        solution: || vec![Event::moved("camera2", -1.6, 0.2), Event::set(&TURN, 25.0)],
    },
    Challenge {
        id: "nothing",
        goal: "Turn camera 2 until nothing is left to decide by.",
        hint: "It must no longer see the house.",
        why: "Only points that both cameras see can vote on which pose is the true one.",
        check: |model| model.num_matches() == 0,
        solution: || vec![Event::set(&TURN, -45.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_start_every_pose_has_the_whole_house_near() {
        let model = FourPoses::new();
        assert_eq!((model.poses().len(), model.num_matches()), (4, 6));
        for pose in model.poses() {
            assert_eq!(pose.crossings.iter().flatten().count(), 6);
            for crossing in pose.crossings.iter().flatten() {
                let (x, z) = (crossing.point.x, crossing.point.z);
                assert!(x.abs() < 3.0 && z.abs() < 3.8, "{x} {z}");
            }
        }
    }
}
