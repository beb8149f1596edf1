//! Detection of a circle grid.

use super::blobs::{Blob, find_blobs};
use super::board_search::BoardSearch;
use super::chessboard::slope;
use super::lattice::{Cell, Lattice};
use super::{Board, BoardView, Pattern};
use crate::Result;
use crate::imaging::GrayImage32;
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::{Point2, Vector2};
use std::collections::{BTreeMap, VecDeque};

/// Minimum fraction of a grid's disks that must be found.
const MIN_RATIO: f64 = 0.6;
/// Maximum distance of a disk from the prediction by its neighbors, relative to a step.
const NEAR: f64 = 0.3;
/// Range of the ratio of areas of adjacent disks.
const AREAS: core::ops::Range<f64> = 0.4..2.5;

/// Finds a circle grid in an image at its given size.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn find_circle_grid(
    image: &GrayImage32,
    board: &Board,
    monitor: &mut dyn Monitor,
) -> Result<BoardSearch> {
    let mut best = BoardSearch::Nothing;
    for (bright, from) in [(false, 0.0), (true, 0.5)] {
        let part = &mut Part::new(monitor, from, from + 0.5);
        let blobs = find_blobs(image, bright, &mut Part::new(part, 0.0, 0.5))?;
        let mut taken = vec![false; blobs.len()];
        for seed in 0..blobs.len() {
            let fraction = 0.5 + 0.5 * seed as f32 / blobs.len() as f32;
            report(part, Stage::FeatureDetection, fraction)?;
            let Some(frame) = frame_of(seed, &blobs).filter(|_| !taken[seed]) else {
                continue;
            };
            let mut lattice = grow(seed, frame, &blobs, &mut taken);
            lattice.drop_strays();
            let found = match board.pattern() {
                Pattern::Circles => place_in_rows(&lattice, board),
                _ => place_shifted(&lattice, board),
            };
            if matches!(found, BoardSearch::Found(_)) {
                return Ok(found);
            }
            best = best.or_more(found);
        }
    }
    Ok(best)
}

/// Returns the steps to a disk's nearest neighbors if these form a cross: two pairs of opposite
/// ones. The second step is clockwise from the first.
fn frame_of(seed: usize, blobs: &[Blob]) -> Option<[Vector2<f64>; 2]> {
    let here = &blobs[seed];
    let mut near: Vec<Vector2<f64>> = blobs
        .iter()
        .enumerate()
        .filter(|(i, other)| *i != seed && AREAS.contains(&(other.area / here.area)))
        .map(|(_, other)| other.center - here.center)
        .collect();
    near.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let [a, b, c, d] = *near.get(..4)?.first_chunk::<4>()?;
    let others = [(b, c, d), (c, b, d), (d, b, c)];
    others.into_iter().find_map(|(opposite, e, f)| {
        let is_opposite =
            |x: &Vector2<f64>, y: &Vector2<f64>| (x + y).norm() < NEAR * x.norm().min(y.norm());
        if !is_opposite(&a, &opposite) || !is_opposite(&e, &f) {
            return None;
        }
        let (first, second) = ((a - opposite) / 2.0, (e - f) / 2.0);
        let orientation = first.perp(&second);
        (orientation.abs() > 0.2 * first.norm() * second.norm())
            .then(|| [first, second * orientation.signum()])
    })
}

fn grow(seed: usize, frame: [Vector2<f64>; 2], blobs: &[Blob], taken: &mut [bool]) -> Lattice {
    let mut cells: BTreeMap<Cell, usize> = BTreeMap::from([((0, 0), seed)]);
    let mut frames = BTreeMap::from([((0, 0), frame)]);
    let mut open = VecDeque::from([(0, 0)]);
    taken[seed] = true;
    while let Some(cell) = open.pop_front() {
        let (here, frame): (&Blob, [Vector2<f64>; 2]) = (&blobs[cells[&cell]], frames[&cell]);
        for (axis, sign) in [(0, 1), (0, -1), (1, 1), (1, -1)] {
            let target = if axis == 0 {
                (cell.0 + sign, cell.1)
            } else {
                (cell.0, cell.1 + sign)
            };
            if cells.contains_key(&target) {
                continue;
            }
            let step = frame[axis] * f64::from(sign);
            let expected = here.center + step;
            let nearest = (0..blobs.len())
                .filter(|&i| !taken[i] && AREAS.contains(&(blobs[i].area / here.area)))
                .map(|i| ((blobs[i].center - expected).norm(), i))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, next)) = nearest.filter(|(off, _)| *off < NEAR * step.norm()) else {
                continue;
            };
            let mut carried = frame;
            carried[axis] = (blobs[next].center - here.center) * f64::from(sign);
            taken[next] = true;
            cells.insert(target, next);
            frames.insert(target, carried);
            open.push_back(target);
        }
    }
    let points: BTreeMap<Cell, Point2<f64>> = cells
        .iter()
        .map(|(cell, i)| (*cell, blobs[*i].center))
        .collect();
    Lattice { points }
}

/// Aligns the grid with the board's rows and columns of disks, the first disk at the upper left of
/// the image; or returns the reason why it does not fit.
fn place_in_rows(grid: &Lattice, board: &Board) -> BoardSearch {
    let (columns, rows) = (board.columns(), board.rows());
    let Some((across, down)) = grid.extent().map(|extent| extent.size()) else {
        return BoardSearch::Nothing;
    };
    let rotated = (0..4).map(|quarters| match quarters {
        0 => grid.clone(),
        1 => grid.mapped(|(i, j)| (-j, i)),
        2 => grid.mapped(|(i, j)| (-i, -j)),
        _ => grid.mapped(|(i, j)| (j, -i)),
    });
    let views = rotated.filter_map(|lattice| {
        let extent = lattice.extent()?;
        let first = extent.least;
        let at = |mark: usize| {
            let cell = (
                first.0 + (mark % columns) as i32,
                first.1 + (mark / columns) as i32,
            );
            lattice.points.get(&cell).copied()
        };
        let view = BoardView {
            pixels: (0..board.num_marks()).map(at).collect(),
        };
        let is_most = view.num_visible() as f64 >= MIN_RATIO * board.num_marks() as f64;
        (extent.size() == (columns, rows) && is_most).then_some(view)
    });
    let upright = views.min_by(|a, b| slope(a).total_cmp(&slope(b)));
    upright.map_or(
        BoardSearch::Partial {
            columns: across.max(down),
            rows: across.min(down),
            num_visible: grid.points.len(),
        },
        BoardSearch::Found,
    )
}

/// Aligns the grid with the board's shifted disks, or returns the reason why it does not fit.
fn place_shifted(grid: &Lattice, board: &Board) -> BoardSearch {
    let (columns, rows) = (board.columns(), board.rows());
    let mut partial = BoardSearch::Nothing;
    // Neighbors are diagonal: a lattice step is one step along x and one along y.
    for quarters in 0..4 {
        let diagonal = grid.mapped(|(a, b)| match quarters {
            0 => (a - b, a + b),
            1 => (-a - b, a - b),
            2 => (b - a, -a - b),
            _ => (a + b, b - a),
        });
        let Some(extent) = diagonal.extent() else {
            continue;
        };
        let (across, down) = extent.size();
        if quarters < 2 {
            partial = partial.or_more(BoardSearch::Partial {
                columns: across.div_ceil(2).max(down),
                rows: across.div_ceil(2).min(down),
                num_visible: diagonal.points.len(),
            });
        }
        let first = extent.least;
        // The first row begins leftmost, every second one a step further.
        let has_parity = diagonal
            .points
            .keys()
            .all(|(x, y)| (x - first.0 + y - first.1) % 2 == 0);
        if (across, down) != (2 * columns, rows) || !has_parity {
            continue;
        }
        let pixels: Vec<Option<Point2<f64>>> = (0..board.num_marks())
            .map(|mark| {
                let (column, row) = (mark % columns, mark / columns);
                let x = first.0 + (2 * column + row % 2) as i32;
                diagonal.points.get(&(x, first.1 + row as i32)).copied()
            })
            .collect();
        let view = BoardView { pixels };
        if view.num_visible() as f64 >= MIN_RATIO * board.num_marks() as f64 {
            return BoardSearch::Found(view);
        }
    }
    partial
}
