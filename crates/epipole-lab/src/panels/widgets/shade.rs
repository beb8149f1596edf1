//! Places and colors of points in the 3D view: those outside the box and deleted ones have no
//! place, and selected ones a color of their own.

use crate::project::Key;
use crate::session::{Members, Remaining};
use crate::tasks::PointFound;

/// Position and color of a point of the scene.
type Shown = ([f32; 3], [u8; 3]);

/// Points that are kept, and those that are selected.
pub(super) struct Shade<'a> {
    pub(super) kept: Remaining<'a>,
    pub(super) selected: Members<'a>,
    /// Color of selected points.
    pub(super) color: [u8; 3],
}

impl Shade<'_> {
    /// Returns a sparse point of this color.
    pub(super) fn point(&self, point: &PointFound, color: [u8; 3]) -> Shown {
        let is_selected = self.selected.has_point(point);
        self.shown(
            self.kept.has_point(point),
            is_selected,
            point.position,
            color,
        )
    }

    /// Returns a function for the points of a dense cloud, by index, position and color.
    pub(super) fn of_cloud(&self, key: Key) -> impl Fn(u32, [f64; 3], [u8; 3]) -> Shown {
        let (kept, selected) = (self.kept.of_cloud(key), self.selected.of_cloud(key));
        move |index, place, color| self.shown(kept(index, place), selected(index), place, color)
    }

    fn shown(&self, is_kept: bool, is_selected: bool, place: [f64; 3], color: [u8; 3]) -> Shown {
        let color = if is_selected { self.color } else { color };
        match is_kept {
            true => (place.map(|x| x as f32), color),
            false => ([f32::NAN; 3], color),
        }
    }
}
