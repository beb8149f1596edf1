//! Tools of the 3D view, and the selected points.

use crate::project::{PointSet, Project};
use egui::Pos2;

/// Tool of the 3D view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Tool {
    /// Looking around.
    #[default]
    Look,
    /// The box that limits the model.
    Box,
    /// Selection of points: a drag draws a line around them.
    Select,
}

/// Selected points, and the line around further ones.
pub(crate) struct Selection {
    pub(crate) points: PointSet,
    /// Number of points.
    pub(crate) count: usize,
    /// Rules for sparse points: fewer images than this; larger errors than this, pixels.
    pub(crate) min_images: usize,
    pub(crate) max_error_px: f64,
    /// Line that is being drawn.
    pub(super) line: Vec<Pos2>,
}

impl Default for Selection {
    fn default() -> Self {
        Self {
            points: PointSet::default(),
            count: 0,
            min_images: 3,
            max_error_px: 1.0,
            line: Vec::new(),
        }
    }
}

impl Selection {
    /// Replaces the selection.
    pub(crate) fn set(&mut self, project: &Project, points: PointSet) {
        self.count = project.num_in(&points);
        self.points = points;
    }

    /// Adds points.
    pub(crate) fn add(&mut self, project: &Project, points: &PointSet) {
        self.set(project, self.points.with(points));
    }
}
