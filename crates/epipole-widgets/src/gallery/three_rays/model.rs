//! The columns of one point in three cameras side by side, and the point nearest to the rays.

use crate::contract::{
    Challenge, Control, Declared, Event, Handle, Knob, Model, Problem, Settings, Slider, Toggle,
    knobs,
};
use crate::kit::probe::Probe;
use nalgebra::{Matrix3, Point2, RowVector3, Vector2, Vector3};

pub(super) const NUM_CAMERAS: usize = 3;
/// Centers of the first two cameras along the baseline, meters.
const CENTERS_M: [f64; 2] = [0.0, 0.4];
/// Width of a photograph, its middle column and the focal length, pixels.
pub(super) const WIDTH_PX: f64 = 640.0;
pub(super) const MIDDLE_PX: f64 = 320.0;
pub(super) const FOCAL_PX: f64 = 500.0;
/// The point, meters to the right and away.
pub(super) const POINT_M: Point2<f64> = Point2::new(0.3, 2.0);
/// Panels of the photographs' rows, and their handles.
pub(super) const ROWS: [&str; NUM_CAMERAS] = ["row1", "row2", "row3"];
const COLUMNS: [Probe; NUM_CAMERAS] = [
    column("u1", ROWS[0], "Column in camera 1", 395.0),
    column("u2", ROWS[1], "Column in camera 2", 295.0),
    column("u3", ROWS[2], "Column in camera 3", 215.0),
];

const THIRD: Toggle = Toggle::new("third", "Camera 3").on();
const PLACE: Slider = Slider::new("place", "Camera 3 at")
    .range(0.5, 1.4, 0.05)
    .at(0.8)
    .digits(2)
    .unit("m");
const KNOBS: &[Knob] = knobs![PLACE, THIRD];

const fn column(id: &'static str, panel: &'static str, label: &'static str, at: f64) -> Probe {
    Probe::new(id, panel, label)
        .within([[0.0, WIDTH_PX - 1.0], [0.0; 2]])
        .told(|(u, _)| format!("column {u:.0}"))
        .at(at, 0.0)
}

/// The model of `three-rays`.
pub(crate) struct ThreeRays {
    settings: Settings,
    columns: [Probe; NUM_CAMERAS],
}

/// The singular value decomposition of the rays' equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    /// Singular values, largest first.
    pub(super) sigma: [f64; NUM_CAMERAS],
    /// The last column of V, a unit vector.
    h: Vector3<f64>,
}

impl Meeting {
    /// Returns the point nearest to the rays, meters to the right and away; `None` at infinity.
    pub(super) fn place(&self) -> Option<Point2<f64>> {
        (self.h.z.abs() > 1e-9).then(|| Point2::new(self.h.x / self.h.z, self.h.y / self.h.z))
    }
}

impl ThreeRays {
    /// Returns the number of cameras used.
    pub(super) fn num_used(&self) -> usize {
        NUM_CAMERAS - usize::from(!self.settings.flag(&THIRD))
    }

    /// Returns the centers of the cameras along the baseline, meters.
    pub(super) fn centers_m(&self) -> [f64; NUM_CAMERAS] {
        let [first, second] = CENTERS_M;
        [first, second, self.settings.number(&PLACE)]
    }

    /// Returns the columns, pixels.
    pub(super) fn columns(&self) -> [f64; NUM_CAMERAS] {
        self.columns.map(|column| column.place().0)
    }

    /// Returns the directions of the rays, to the right and away.
    pub(super) fn directions(&self) -> [Vector2<f64>; NUM_CAMERAS] {
        self.columns()
            .map(|u| Vector2::new((u - MIDDLE_PX) / FOCAL_PX, 1.0))
    }

    /// Returns the column in which a camera sees the point, pixels.
    pub(super) fn true_column(&self, camera: usize) -> f64 {
        MIDDLE_PX + FOCAL_PX * (POINT_M.x - self.centers_m()[camera]) / POINT_M.y
    }

    /// Returns the equations X − m Z − B = 0 of the rays, one per row; 0 = 0 for an unused camera.
    fn rows(&self) -> Matrix3<f64> {
        let (directions, centers_m) = (self.directions(), self.centers_m());
        let row = |camera: usize| match camera < self.num_used() {
            true => RowVector3::new(1.0, -directions[camera].x, -centers_m[camera]),
            false => RowVector3::zeros(),
        };
        Matrix3::from_rows(&[row(0), row(1), row(2)])
    }

    pub(super) fn meeting(&self) -> Option<Meeting> {
        let svd = self.rows().svd(false, true);
        Some(Meeting {
            sigma: svd.singular_values.into(),
            h: svd.v_t?.row(2).transpose(),
        })
    }
}

impl Declared for ThreeRays {
    const NAME: &'static str = "three-rays";
    const TITLE: &'static str = "Three rays that nearly meet";
    const HELP: &'static str = "Drag the column in which a camera sees P, and watch the ray, the smallest singular \
        value, and the place that its vector gives.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            columns: COLUMNS,
        }
    }
}

impl Model for ThreeRays {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        self.columns.iter().map(Probe::handle).collect()
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if !(self.columns.iter_mut()).any(|column| column.update(event)) {
            self.settings.update(event)?;
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<ThreeRays>] = &[
    Challenge {
        id: "meet",
        goal: "Make the three rays meet: bring σ₃ below 0.001.",
        hint: "Two rays always meet. To which column must the third one go?",
        why: "Where one point lies on all three rays, a vector solves all three equations, and nothing is left \
              of the smallest singular value.",
        check: |model| {
            let found = model.meeting().filter(|found| found.sigma[2] < 1e-3);
            model.num_used() == NUM_CAMERAS && found.is_some_and(|found| found.place().is_some())
        },
        solution: || {
            vec![Event::moved(
                COLUMNS[2].id(),
                ThreeRays::new().true_column(2),
                0.0,
            )]
        },
    },
    Challenge {
        id: "infinity",
        goal: "Send the meeting place to infinity.",
        hint: "Rays that meet nowhere have the same direction.",
        why: "Parallel rays meet in a direction. Its vector ends in 0, and σ₃ is 0 all the same: homogeneous \
              coordinates have a name for that place.",
        check: |model| model.meeting().is_some_and(|found| found.place().is_none()),
        solution: || {
            COLUMNS
                .iter()
                .map(|column| Event::moved(column.id(), MIDDLE_PX, 0.0))
                .collect()
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Words;

    fn with_columns(columns: [f64; NUM_CAMERAS]) -> ThreeRays {
        let mut model = ThreeRays::new();
        for (probe, u) in COLUMNS.iter().zip(columns) {
            model.update(&Event::moved(probe.id(), u, 0.0)).unwrap();
        }
        model
    }

    #[test]
    fn true_columns_meet_in_the_point() {
        let columns = [0, 1, 2].map(|camera| ThreeRays::new().true_column(camera));
        assert_eq!(columns, [395.0, 295.0, 195.0]);
        let found = with_columns(columns).meeting().unwrap();
        assert!(found.sigma[2] < 1e-12);
        assert!((found.place().unwrap() - POINT_M).norm() < 1e-12);
    }

    #[test]
    fn the_smallest_singular_value_is_the_least_residual() {
        let model = ThreeRays::new();
        let found = model.meeting().unwrap();
        let residual = |h: Vector3<f64>| (model.rows() * h.normalize()).norm();
        assert!((residual(found.h) - found.sigma[2]).abs() < 1e-12);
        for other in [(0.31, 2.0), (0.3, 2.1), (0.0, 1.0), (0.25, 1.8)] {
            assert!(residual(Vector3::new(other.0, other.1, 1.0)) > found.sigma[2]);
        }
    }

    #[test]
    fn two_rays_always_meet() {
        let mut model = ThreeRays::new();
        model.update(&Event::set(&THIRD, false)).unwrap();
        let found = model.meeting().unwrap();
        assert!(found.sigma[2] < 1e-12 && found.sigma[1] > 0.1);
        assert!((found.place().unwrap() - POINT_M).norm() < 1e-12);
    }

    #[test]
    fn parallel_rays_meet_at_infinity() {
        let model = with_columns([400.0; NUM_CAMERAS]);
        let found = model.meeting().unwrap();
        assert!(found.place().is_none() && found.sigma[2] < 1e-12);
        assert!(model.describe().contains("infinity"));
    }
}
