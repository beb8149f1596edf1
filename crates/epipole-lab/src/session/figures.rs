//! Changes of angles, areas, volumes and control points.

use crate::project::{Anchor, ControlPoint, PhotoId, Project, Shape};

/// Maximum number of figures, and of control points.
const MAX_FIGURES: usize = 1000;

impl Project {
    pub(super) fn measure_shape(&mut self, shape: Shape) {
        let document = &mut self.document;
        let is_there = |point: &Anchor| document.has_all_of(point);
        let has_room = document.shapes.len() < MAX_FIGURES;
        if shape.is_valid() && shape.points.iter().all(is_there) && has_room {
            document.shapes.push(shape);
        }
    }

    pub(super) fn forget_shape(&mut self, index: usize) {
        if index < self.document.shapes.len() {
            self.document.shapes.remove(index);
        }
    }

    pub(super) fn add_control(&mut self, control: ControlPoint) {
        let document = &mut self.document;
        let mut others = document.control_points.iter();
        let is_new = others.all(|other| other.point != control.point);
        let has_room = document.control_points.len() < MAX_FIGURES;
        if control.is_valid() && is_new && document.has_all_of(&control.point) && has_room {
            document.control_points.push(control);
        }
    }

    pub(super) fn change_control(
        &mut self,
        index: usize,
        name: String,
        position_m: Option<[f64; 3]>,
    ) {
        if let Some(control) = self.document.control_points.get_mut(index) {
            let changed = ControlPoint {
                point: control.point,
                name,
                position_m,
            };
            if changed.is_valid() {
                *control = changed;
            }
        }
    }

    pub(super) fn forget_control(&mut self, index: usize) {
        if index < self.document.control_points.len() {
            self.document.control_points.remove(index);
        }
    }

    /// Removes figures and control points that depend on a photograph.
    pub(super) fn forget_figures_of(&mut self, id: PhotoId) {
        let is_of = |point: &Anchor| point.photos().any(|photo| photo == id);
        let document = &mut self.document;
        (document.shapes).retain(|shape| !shape.points.iter().any(is_of));
        (document.control_points).retain(|control| !control.is_of(id));
    }
}
