//! Drawing order: far to near, with lines and faces depth-tested against the points of surfaces,
//! and hidden lines dashed.

use super::depths::Depths;
use crate::canvas::{Dash, Place, Shape, Stroke};
use crate::contract::Rect;
use crate::kit::standing::{Screen, Standing};
use crate::theme::{Rgb, Role};
use nalgebra::Point3;

/// Spacing of the positions at which a line is tested, CSS pixels, and their maximum number.
const STEP: f64 = 4.0;
const MOST_STEPS: f64 = 300.0;
/// Minimum number of steps of a hidden piece, so that isolated points do not cut a line.
const FEWEST: usize = 3;
/// Minimum width of a line whose hidden pieces are drawn dashed, CSS pixels.
const LEAST_WIDTH: f64 = 1.0;

pub(super) enum Mark {
    Dot(Place, f64, Rgb),
    Speck(Place, f64, Rgb),
    Marker(Place, f64, Shape, Role),
    /// A line, by its ends in the eye's frame and on the page.
    Line([Point3<f64>; 2], [Place; 2], Stroke),
    Facet([Place; 4], Rgb, Stroke),
    Face(Screen, Role, f64),
}

/// A mark in the scene.
pub(super) struct Placed {
    /// Number of photographs drawn before it.
    pub(super) layer: usize,
    /// Its center in the eye's frame.
    pub(super) in_eye: Point3<f64>,
    pub(super) mark: Mark,
}

/// Stages of drawing within a layer.
mod stage {
    /// Surfaces, far to near, interleaved with faces that hide some of their points.
    pub(super) const SURFACES: u64 = 0;
    /// Lines in front of the surfaces, and hidden ones, dashed.
    pub(super) const LINES: u64 = 1;
    /// Markers in front of the surfaces.
    pub(super) const MARKERS: u64 = 2;
}

/// Sorts marks for drawing. Marks at equal depth keep their order. `photographs` are far to near.
pub(super) fn arrange(
    marks: Vec<Placed>,
    photographs: &[Standing<'_>],
    panel: Rect,
) -> Vec<Placed> {
    let mut depths = Depths::new(panel);
    for Placed { in_eye, mark, .. } in &marks {
        if let Mark::Dot(place, reach, _) | Mark::Speck(place, reach, _) = mark {
            depths.cover(*place, *reach, in_eye.z);
        }
    }
    let placed: Vec<Placed> = match depths.is_empty() {
        true => marks,
        false => marks
            .into_iter()
            .flat_map(|mark| cut(mark, photographs, &depths))
            .collect(),
    };
    let faces = faces(&placed, &depths);
    // Sorts keys instead of marks, which are ten times as large.
    let mut order: Vec<(u64, u64, u32)> = (placed.iter().enumerate())
        .map(|(index, mark)| {
            let rank = rank(index, mark, &placed, &faces, &depths);
            (rank, far_first(mark.in_eye.z), index as u32)
        })
        .collect();
    order.sort_unstable();
    let mut marks: Vec<Option<Placed>> = placed.into_iter().map(Some).collect();
    order
        .into_iter()
        .filter_map(|(.., index)| marks[index as usize].take())
        .collect()
}

/// Returns the faces that may hide points, far to near; none without a surface.
fn faces(placed: &[Placed], depths: &Depths) -> Vec<usize> {
    let is_face = |index: &usize| matches!(placed[*index].mark, Mark::Face(..));
    let mut faces: Vec<usize> = match depths.is_empty() {
        true => Vec::new(),
        false => (0..placed.len()).filter(is_face).collect(),
    };
    faces.sort_by_key(|index| far_first(placed[*index].in_eye.z));
    faces
}

/// Returns a sort key: layer, stage, and rank among the faces.
fn rank(index: usize, mark: &Placed, placed: &[Placed], faces: &[usize], depths: &Depths) -> u64 {
    let is_visible = |place: Place| !depths.is_empty() && !depths.hides(place, mark.in_eye.z);
    let (stage, behind) = match &mark.mark {
        Mark::Face(..) => {
            let at = faces.iter().position(|face| *face == index);
            (stage::SURFACES, at.map_or(0, |at| 2 * at + 1))
        }
        Mark::Dot(place, ..) | Mark::Speck(place, ..) => {
            let hides = |face: &usize| match &placed[*face].mark {
                Mark::Face(screen, ..) => screen.hides(&mark.in_eye, &[*place]),
                _ => false,
            };
            let at = faces.iter().position(hides);
            (stage::SURFACES, 2 * at.unwrap_or(faces.len()))
        }
        Mark::Marker(place, ..) if is_visible(*place) => (stage::MARKERS, 0),
        Mark::Line(..) if !depths.is_empty() => (stage::LINES, 0),
        _ => (stage::SURFACES, 2 * faces.len()),
    };
    (mark.layer as u64) << 32 | stage << 24 | behind as u64
}

/// Cuts a line into visible and hidden pieces; hidden ones are dashed, or dropped if thin.
fn cut(placed: Placed, photographs: &[Standing<'_>], depths: &Depths) -> Vec<Placed> {
    let Mark::Line(ends, places, stroke) = placed.mark else {
        return vec![placed];
    };
    let runs = runs(&ends, &places, photographs, depths).into_iter();
    let shown = runs.filter(|run| !run.is_hidden || stroke.width >= LEAST_WIDTH);
    shown
        .map(|run| {
            let stroke = match (run.is_hidden, stroke.dash) {
                (true, Dash::Solid) => Stroke {
                    width: 1.0,
                    ..stroke.dashed()
                },
                (true, _) => Stroke {
                    width: 1.0,
                    ..stroke
                },
                (false, _) => stroke,
            };
            let ends = [run.from, run.to].map(|share| at(&ends, share));
            let places = [run.from, run.to].map(|share| between(&places, share));
            let in_eye = nalgebra::center(&ends[0], &ends[1]);
            let mark = Mark::Line(ends, places, stroke);
            Placed {
                layer: run.layer,
                in_eye,
                mark,
            }
        })
        .collect()
}

/// A piece of a line, by fractions of its length on the page.
struct Run {
    from: f64,
    to: f64,
    /// Number of photographs drawn before it.
    layer: usize,
    is_hidden: bool,
}

fn runs(
    ends: &[Point3<f64>; 2],
    places: &[Place; 2],
    photographs: &[Standing<'_>],
    depths: &Depths,
) -> Vec<Run> {
    let length = libm::hypot(places[1].0 - places[0].0, places[1].1 - places[0].1);
    let count = (length / STEP).ceil().clamp(1.0, MOST_STEPS);
    let state = |step: usize| {
        let share = (step as f64 + 0.5) / count;
        let (place, in_eye) = (between(places, share), at(ends, share));
        let behind = photographs
            .iter()
            .position(|photo| photo.hides(&in_eye, &[place]));
        (
            behind.unwrap_or(photographs.len()),
            depths.hides(place, in_eye.z),
        )
    };
    let states: Vec<_> = (0..count as usize).map(state).collect();
    let mut runs: Vec<Run> = Vec::new();
    let mut from = 0;
    for run in states.chunk_by(|a, b| a == b) {
        let (layer, is_hidden) = (run[0].0, run[0].1 && run.len() >= FEWEST);
        let to = from + run.len();
        match runs.last_mut() {
            Some(last) if (last.layer, last.is_hidden) == (layer, is_hidden) => {
                last.to = to as f64 / count;
            }
            _ => runs.push(Run {
                from: from as f64 / count,
                to: to as f64 / count,
                layer,
                is_hidden,
            }),
        }
        from = to;
    }
    runs
}

/// Interpolates between the ends of a line on the page.
fn between([from, to]: &[Place; 2], share: f64) -> Place {
    (
        from.0 + (to.0 - from.0) * share,
        from.1 + (to.1 - from.1) * share,
    )
}

/// Returns the point of a segment at a fraction of its image, along which inverse depth is linear.
fn at([from, to]: &[Point3<f64>; 2], share: f64) -> Point3<f64> {
    let along = share * from.z / (to.z + share * (from.z - to.z));
    from + (to - from) * along
}

/// Maps a depth to an integer that decreases with it, in the order of `f64::total_cmp`.
fn far_first(depth: f64) -> u64 {
    let bits = depth.to_bits();
    // The bits of negative numbers increase with their magnitude.
    let is_negative = bits >> 63 == 1;
    let rising = if is_negative { !bits } else { bits | 1 << 63 };
    !rising
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Rect = Rect {
        x: 0.0,
        y: 0.0,
        width: 400.0,
        height: 300.0,
    };

    fn placed(z: f64, mark: Mark) -> Placed {
        Placed {
            layer: 0,
            in_eye: Point3::new(0.0, 0.0, z),
            mark,
        }
    }

    /// Cuts a line at a depth of 2 across the panel, with a wall in its middle third at another
    /// depth.
    fn pieces(wall: f64) -> Vec<(bool, f64, f64)> {
        let stroke = Stroke::solid(Role::Ink, 2.0);
        let ends = [Point3::new(-1.0, 0.0, 2.0), Point3::new(1.0, 0.0, 2.0)];
        let mut marks = vec![placed(
            2.0,
            Mark::Line(ends, [(50.0, 150.0), (350.0, 150.0)], stroke),
        )];
        for x in 150..250 {
            marks.push(placed(wall, Mark::Dot((f64::from(x), 150.0), 2.0, [0; 3])));
        }
        let lines = arrange(marks, &[], PANEL)
            .into_iter()
            .filter_map(|placed| match placed.mark {
                Mark::Line(_, [from, to], stroke) => {
                    Some((stroke.dash == Dash::Dashed, from.0, to.0))
                }
                _ => None,
            });
        let mut lines: Vec<_> = lines.collect();
        lines.sort_by(|a, b| a.1.total_cmp(&b.1));
        lines
    }

    #[test]
    fn a_line_is_dashed_exactly_where_a_surface_hides_it() {
        let hidden = pieces(1.0);
        assert_eq!(
            hidden.iter().map(|piece| piece.0).collect::<Vec<_>>(),
            [false, true, false]
        );
        assert_eq!((hidden[0].1, hidden[2].2), (50.0, 350.0));
        assert!((hidden[1].1 - 150.0).abs() <= 6.0 && (hidden[1].2 - 250.0).abs() <= 6.0);
        assert_eq!(pieces(3.0), [(false, 50.0, 350.0)]);
    }

    #[test]
    fn places_of_a_line_have_the_depths_of_perspective() {
        let ends = [Point3::new(-1.0, 0.0, 1.0), Point3::new(3.0, 0.0, 3.0)];
        // Projections at −1 and 1: their middle, 0, shows the point at a quarter of the way.
        let middle = at(&ends, 0.5);
        assert!((middle - Point3::new(0.0, 0.0, 1.5)).norm() < 1e-12);
        assert_eq!([at(&ends, 0.0), at(&ends, 1.0)], ends);
    }

    #[test]
    fn points_behind_a_face_are_drawn_before_it_and_others_after_it() {
        // A face slanted in depth: its center is farther than the point in front of its near part.
        let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, 5.0), (-1.0, 5.0)]
            .map(|(x, z)| Point3::new(x, 2.0 - 0.3 * z, z));
        let places = corners.map(|corner| {
            (
                200.0 + 100.0 * corner.x / corner.z,
                150.0 + 100.0 * corner.y / corner.z,
            )
        });
        let face = || {
            Mark::Face(
                Screen::new(&corners, places.to_vec()).unwrap(),
                Role::Ink,
                0.2,
            )
        };
        let dot = |x: f64, y: f64, z: f64| Placed {
            layer: 0,
            in_eye: Point3::new(x, y, z),
            mark: Mark::Dot((200.0 + 100.0 * x / z, 150.0 + 100.0 * y / z), 2.0, [0; 3]),
        };
        let behind = dot(0.0, 1.6, 1.8);
        let before = dot(0.0, 1.1, 2.4);
        let order = arrange(vec![before, placed(3.0, face()), behind], &[], PANEL);
        let kinds: Vec<f64> = order.iter().map(|placed| placed.in_eye.z).collect();
        assert_eq!(kinds, [1.8, 3.0, 2.4]);
    }
}
