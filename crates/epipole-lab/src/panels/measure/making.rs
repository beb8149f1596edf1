//! Figure that the next clicks make.

use crate::project::{Anchor, ControlPoint, Measure, Project, Shape, ShapeKind};
use crate::session::Event;

/// Kind of the figure that the next clicks make.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Kind {
    #[default]
    Length,
    Shape(ShapeKind),
    Control,
    Floor,
}

impl Kind {
    /// All kinds with their names.
    pub(super) const ALL: [(Self, &str); 7] = [
        (Self::Length, "Length"),
        (Self::Shape(ShapeKind::Angle), "Angle"),
        (Self::Shape(ShapeKind::Area), "Area"),
        (Self::Shape(ShapeKind::Volume), "Volume"),
        (
            Self::Shape(ShapeKind::VolumeOverFloor),
            "Volume over the floor",
        ),
        (Self::Control, "Control point"),
        (Self::Floor, "Floor"),
    ];

    /// Number of points that complete it; `None` for a polygon, which the user finishes.
    fn num_points(self) -> Option<usize> {
        match self {
            Self::Length => Some(2),
            Self::Shape(ShapeKind::Angle) | Self::Floor => Some(3),
            Self::Control => Some(1),
            Self::Shape(_) => None,
        }
    }
}

/// Figure in progress.
#[derive(Default)]
pub(super) struct Making {
    pub(super) kind: Kind,
    /// Points so far.
    pub(super) points: Vec<Anchor>,
}

impl Making {
    /// Starts another figure.
    pub(super) fn start(&mut self, kind: Kind) {
        self.kind = kind;
        self.points.clear();
    }

    /// Adds a point. Returns the change that completes the figure.
    pub(super) fn add(&mut self, project: &Project, point: Anchor) -> Option<Event> {
        if self.points.contains(&point) {
            match self.kind {
                Kind::Length => self.points.clear(),
                // The first corner again closes a polygon.
                _ if self.points.first() == Some(&point) => return self.finish(project),
                _ => {}
            }
            return None;
        }
        self.points.push(point);
        let is_complete = self.kind.num_points() == Some(self.points.len());
        is_complete.then(|| self.complete(project)).flatten()
    }

    /// Whether a polygon has enough corners.
    pub(super) fn can_finish(&self) -> bool {
        self.kind.num_points().is_none() && self.points.len() >= 3
    }

    /// Completes a polygon, if it has enough corners.
    pub(super) fn finish(&mut self, project: &Project) -> Option<Event> {
        self.can_finish().then(|| self.complete(project)).flatten()
    }

    fn complete(&mut self, project: &Project) -> Option<Event> {
        let points = std::mem::take(&mut self.points);
        match self.kind {
            Kind::Length => Some(Event::Measure(Measure {
                ends: points.try_into().ok()?,
                length_m: None,
            })),
            Kind::Shape(kind) => Some(Event::MeasureShape(Shape { kind, points })),
            Kind::Control => Some(Event::AddControl(ControlPoint {
                point: *points.first()?,
                name: new_name(project),
                position_m: None,
            })),
            Kind::Floor => {
                self.kind = Kind::Length;
                Some(Event::Floor(Some(points.try_into().ok()?)))
            }
        }
    }

    /// Describes the next click.
    pub(super) fn instruction(&self, project: &Project) -> String {
        let count = self.points.len();
        match (self.kind, count) {
            (Kind::Length, 1..) => "One end is chosen. Click the other.".to_owned(),
            (Kind::Length, 0) => match project.document().measures.is_empty() {
                true => "Click two points whose distance you know and type it: it sets the scale.",
                false => "Click two points to measure another length.",
            }
            .to_owned(),
            (Kind::Shape(ShapeKind::Angle), _) => format!(
                "Click a point on one side, then the vertex, then a point on the other side: \
                 {count} of 3."
            ),
            (Kind::Shape(ShapeKind::Area), _) => format!(
                "Click the corners in order around the area, then \"Finish\": {count} so far."
            ),
            (Kind::Shape(ShapeKind::VolumeOverFloor), _) if project.floor().is_none() => {
                "Set the floor first: the volume is over it.".to_owned()
            }
            (Kind::Shape(_), _) => format!(
                "Click the corners in order around the volume's base, then \"Finish\": {count} so \
                 far."
            ),
            (Kind::Control, _) => {
                "Click a point whose coordinates you know: three align the model.".to_owned()
            }
            (Kind::Floor, _) => format!("Click three points of the floor: {count} of 3."),
        }
    }
}

/// Returns the first unused name of the form "P1".
fn new_name(project: &Project) -> String {
    let points = &project.document().control_points;
    let is_free = |name: &String| points.iter().all(|point| point.name != *name);
    let mut names = (1..=points.len() + 1).map(|number| format!("P{number}"));
    names.find(is_free).unwrap_or_default()
}
