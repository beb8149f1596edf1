//! Two cameras before a house, the essential matrix between them, and its four poses.

use crate::contract::{
    Challenge, Control, Event, Handle, Knob, Model, Problem, Readout, Settings, Slider, Value,
    format_number,
};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::epipolar::{decompose_essential, essential_from_motion};
use epipole::triangulation::triangulate_midpoint;
use nalgebra::{Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

const TURN: Slider = Slider {
    id: "turn",
    label: "Turn of camera 2",
    unit: "°",
    min: -45.0,
    max: 45.0,
    step: 1.0,
    default: -16.0,
    digits: 0,
    visible: true,
};
const KNOBS: &[Knob] = &[Knob::Slider(&TURN)];

/// Where camera 2 may stand, in steps of the page's world: to the right, and forward.
pub(super) const X_RANGE: [f64; 2] = [-1.6, 1.6];
pub(super) const Z_RANGE: [f64; 2] = [-1.0, 1.2];
const PLACE: (f64, f64) = (1.0, 0.2);
/// Nearer to camera 1 than this there is no step, so no E.
const SHORTEST: f64 = 0.05;

/// Corners of the house: the four of its base, then the two ends of its ridge.
const HOUSE: [[f64; 3]; 6] = [
    [-0.75, 0.5, -0.45],
    [0.75, 0.5, -0.45],
    [0.75, 0.5, 0.45],
    [-0.75, 0.5, 0.45],
    [-0.75, -0.5, 0.0],
    [0.75, -0.5, 0.0],
];
/// Corners that walls and ridge join.
pub(super) const EDGES: [(usize, usize); 5] = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5)];
/// Where the house stands, and how far it is turned, degrees.
const HOUSE_AT: [f64; 3] = [0.15, 0.0, 3.0];
const HOUSE_TURN_DEG: f64 = 24.0;

/// A corner, where the rays of one pose cross.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Where, in the frame of camera 1.
    pub(super) point: Point3<f64>,
    /// Whether that is in front of camera 1, and of camera 2.
    pub(super) in_front: [bool; 2],
}

impl Crossing {
    pub(super) fn is_good(&self) -> bool {
        self.in_front == [true, true]
    }
}

/// One of the four poses.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pose {
    pub(super) cam2_from_cam1: RigidTransform,
    /// For each corner, if both cameras see it and its rays cross.
    pub(super) crossings: Vec<Option<Crossing>>,
}

impl Pose {
    pub(super) fn num_in_front(&self) -> usize {
        let crossings = self.crossings.iter().flatten();
        crossings.filter(|crossing| crossing.is_good()).count()
    }
}

/// The model of `four-poses`.
pub(crate) struct FourPoses {
    settings: Settings,
    place: (f64, f64),
    corners: Vec<Point3<f64>>,
    /// R and t; R and −t; the half-turned R and t; that and −t. Empty without a step.
    poses: Vec<Pose>,
    num_matches: usize,
}

impl FourPoses {
    pub(super) fn place(&self) -> (f64, f64) {
        self.place
    }

    pub(super) fn poses(&self) -> &[Pose] {
        &self.poses
    }

    pub(super) fn num_matches(&self) -> usize {
        self.num_matches
    }

    /// Camera 2 in the frame of camera 1, as it really stands.
    fn motion(&self) -> RigidTransform {
        let turn = self.settings.number(&TURN).to_radians();
        let world_from_cam = RigidTransform::from_parts(
            Translation3::new(self.place.0, 0.0, self.place.1),
            UnitQuaternion::from_axis_angle(&Vector3::y_axis(), turn),
        );
        world_from_cam.inverse()
    }

    /// The rays of a corner in both cameras; `None` unless both see it.
    fn rays(corner: &Point3<f64>, motion: &RigidTransform) -> Option<[Vector3<f64>; 2]> {
        let lens = Intrinsics::centered(500.0, 640, 480).ok()?;
        let camera = |cam_from_world| Camera {
            intrinsics: lens,
            cam_from_world,
        };
        let ray = |camera: Camera| {
            let pixel = camera.project(corner).ok()?;
            let inside = (0.0..640.0).contains(&pixel.x) && (0.0..480.0).contains(&pixel.y);
            inside.then(|| lens.ray(&pixel))
        };
        Some([
            ray(camera(RigidTransform::identity()))?,
            ray(camera(*motion))?,
        ])
    }

    fn refresh(&mut self) -> Result<(), Problem> {
        let motion = self.motion();
        let step = motion.translation.vector.norm();
        let rays: Vec<_> = (self.corners.iter())
            .map(|corner| Self::rays(corner, &motion))
            .collect();
        self.num_matches = rays.iter().flatten().count();
        self.poses.clear();
        if step < SHORTEST {
            return Ok(());
        }
        let found = decompose_essential(&essential_from_motion(&motion)?)?;
        // The true rotation first, and of each the true direction first.
        let key = |pose: &RigidTransform| {
            let turned = pose.rotation.angle_to(&motion.rotation) > 1e-3;
            let ahead = pose.translation.vector.dot(&motion.translation.vector) > 0.0;
            (turned, !ahead)
        };
        let order = [(false, false), (false, true), (true, false), (true, true)];
        self.poses = order
            .into_iter()
            .flat_map(|wanted| found.iter().filter(move |pose| key(pose) == wanted))
            .copied()
            .map(|mut pose| {
                // E has no length; the picture takes that of the true step.
                pose.translation.vector *= step;
                let crossing = |rays: &Option<[Vector3<f64>; 2]>| crossing(&pose, &(*rays)?);
                Pose {
                    cam2_from_cam1: pose,
                    crossings: rays.iter().map(crossing).collect(),
                }
            })
            .collect();
        Ok(())
    }

    /// Where camera 2 stands, seen from camera 1.
    fn place_words(&self) -> String {
        let (x, z) = self.place;
        let side = if x < 0.0 { "left" } else { "right" };
        let way = if z < 0.0 { "behind" } else { "ahead" };
        let length = |value: f64| format_number(value.abs(), 2);
        format!("{} to the {side}, {} {way}", length(x), length(z))
    }

    fn turn_deg(&self) -> f64 {
        self.settings.number(&TURN)
    }
}

/// Where two rays cross, forward or backward. A ray meets another behind its camera just where the
/// reversed ray meets it in front.
fn crossing(pose: &RigidTransform, rays: &[Vector3<f64>; 2]) -> Option<Crossing> {
    let sides = [[true, true], [false, false], [true, false], [false, true]];
    sides.into_iter().find_map(|in_front| {
        let ray = |index: usize| {
            if in_front[index] {
                rays[index]
            } else {
                -rays[index]
            }
        };
        let point = triangulate_midpoint(pose, &ray(0), &ray(1)).ok()?;
        Some(Crossing { point, in_front })
    })
}

fn house() -> Vec<Point3<f64>> {
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), HOUSE_TURN_DEG.to_radians());
    let corner = |corner: &[f64; 3]| Point3::from(HOUSE_AT) + turn * Vector3::from(*corner);
    HOUSE.iter().map(corner).collect()
}

impl Model for FourPoses {
    const NAME: &'static str = "four-poses";
    const TITLE: &'static str = "Four poses, one in front";
    const HELP: &'static str = "Drag camera 2 in the first picture, or move it with the arrow keys, \
        and turn it. Each picture is the same pair of photographs, explained by another pose.";

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            place: PLACE,
            corners: house(),
            poses: Vec::new(),
            num_matches: 0,
        };
        // The default step is long enough, which a test confirms.
        let _ = model.refresh();
        model
    }

    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        let (x, z) = self.place;
        vec![Handle {
            id: "camera2".to_owned(),
            panel: "first",
            label: "Camera 2".to_owned(),
            value_text: self.place_words(),
            x,
            y: z,
            x_range: X_RANGE,
            y_range: Z_RANGE,
            step: [0.1, 0.1],
            digits: 2,
            removable: false,
        }]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        match event {
            Event::Set { id, value } => {
                self.settings.set(id, value)?;
            }
            Event::HandleMoved { x, y, .. } => self.place = (*x, *y),
            _ => return Ok(()),
        }
        self.refresh()
    }

    fn readouts(&self) -> Vec<Readout> {
        let mut readouts = vec![Readout::count("matches", "Matches", self.num_matches)];
        let names = [
            ("first", "In front: R, t"),
            ("second", "R, −t"),
            ("third", "half-turned R, t"),
            ("fourth", "half-turned R, −t"),
        ];
        for ((id, label), pose) in names.into_iter().zip(&self.poses) {
            readouts.push(Readout::count(id, label, pose.num_in_front()));
        }
        readouts.push(Readout::words("step", "Step", self.place_words()));
        readouts.push(Readout::number("turn", "Turn", self.turn_deg(), 0, "°"));
        readouts
    }

    fn describe(&self) -> String {
        let counts: Vec<String> = (self.poses.iter())
            .map(|pose| pose.num_in_front().to_string())
            .collect();
        let [first, others @ ..] = &counts[..] else {
            return "Camera 2 stands where camera 1 does: without a step there is no essential \
                matrix."
                .to_owned();
        };
        if self.num_matches == 0 {
            return "Camera 2 looks past the house, so there is no match to decide by.".to_owned();
        }
        format!(
            "Four poses explain {} matches equally well. The first puts {first} of them in front of \
             both cameras, the others {}. Camera 2 is turned by {}°.",
            self.num_matches,
            others.join(", "),
            format_number(self.turn_deg(), 0)
        )
    }

    fn challenges() -> &'static [Challenge<Self>] {
        &[
            Challenge {
                id: "forward",
                goal: "Let camera 2 step straight forward. Does one pose still stand out?",
                hint: "Right ahead of camera 1, as far as it goes.",
                check: |model| {
                    model.place.0.abs() < 0.06
                        && model.place.1 > 0.5
                        && model
                            .poses
                            .first()
                            .is_some_and(|pose| pose.num_in_front() > 0)
                },
                solution: || {
                    vec![
                        Event::HandleMoved {
                            id: "camera2".to_owned(),
                            x: 0.0,
                            y: 1.0,
                        },
                        Event::Set {
                            id: TURN.id.to_owned(),
                            value: Value::Number(0.0),
                        },
                    ]
                },
            },
            Challenge {
                id: "nothing",
                goal: "Turn camera 2 until nothing is left to decide by.",
                hint: "It must not see the house any more.",
                check: |model| model.num_matches == 0,
                solution: || {
                    vec![Event::Set {
                        id: TURN.id.to_owned(),
                        value: Value::Number(45.0),
                    }]
                },
            },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wherever_camera_2_stands_only_the_true_pose_has_all_in_front() {
        let mut model = FourPoses::new();
        assert_eq!((model.poses.len(), model.num_matches), (4, 6));
        for (x, y) in [(1.0, 0.2), (-1.0, -0.5), (0.3, 1.0), (0.0, -1.0)] {
            let id = "camera2".to_owned();
            model.update(&Event::HandleMoved { id, x, y }).unwrap();
            let counts: Vec<usize> = model.poses.iter().map(Pose::num_in_front).collect();
            assert_eq!(counts[0], model.num_matches, "at {x}, {y}");
            assert_eq!(counts[1..], [0, 0, 0], "at {x}, {y}");
            for (corner, crossing) in model.corners.iter().zip(&model.poses[0].crossings) {
                let near = |c: &Crossing| (c.point - corner).norm() < 1e-6;
                assert!(crossing.as_ref().is_none_or(near), "at {x}, {y}");
            }
        }
    }
}
