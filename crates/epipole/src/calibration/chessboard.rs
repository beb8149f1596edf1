//! Detection of the inner corners of a chessboard.

use super::board_search::BoardSearch;
use super::lattice::{Cell, Lattice};
use super::saddles::{Saddle, SaddleImage};
use super::{Board, BoardView};
use crate::Result;
use crate::imaging::GrayImage32;
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::{Point2, Vector2};
use std::collections::BTreeMap;

/// Minimum fraction of the board's corners that must be found.
const MIN_RATIO: f64 = 0.5;
/// Minimum number of corners in each outermost row and column, to identify them unambiguously.
const LEAST_IN_A_LINE: usize = 2;
/// Cosine of the maximum angle, about 30°, between an edge at one corner and at the next.
const ALONG: f64 = 0.87;
/// Radius around a corner that must contain only its four squares, relative to the distance to the
/// next corner.
const CLEAR: f64 = 0.36;
/// Radius below which circles were already checked.
const LEAST_RADIUS_PX: f64 = 6.5;
/// Number of candidates to check from each corner.
const NEAREST: usize = 16;

/// Finds a chessboard in an image at its given size; corners are only as accurate as the search
/// needs.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled), and for an invalid pixel.
pub(super) fn find_chessboard(
    image: &GrayImage32,
    board: &Board,
    monitor: &mut dyn Monitor,
) -> Result<BoardSearch> {
    let saddle_image = SaddleImage::new(image, &mut Part::new(monitor, 0.0, 0.2))?;
    let saddles = saddle_image.find(&mut Part::new(monitor, 0.2, 0.5))?;
    let neighbors = neighbors(&saddles, &mut Part::new(monitor, 0.5, 0.8))?;
    let mut taken = vec![false; saddles.len()];
    let mut best = BoardSearch::Nothing;
    let mut in_part = None;
    let num_links = |i: usize| neighbors[i].iter().flatten().count();
    // Corners with all four neighbors first, as they are inside the board.
    let mut seeds: Vec<usize> = (0..saddles.len()).collect();
    seeds.sort_by_key(|&i| (4 - num_links(i), i));
    for (k, seed) in seeds.into_iter().enumerate() {
        let fraction = 0.8 + 0.2 * k as f32 / saddles.len() as f32;
        report(monitor, Stage::FeatureDetection, fraction)?;
        if taken[seed] || num_links(seed) < 2 {
            continue;
        }
        let mut lattice = grow(seed, &saddles, &neighbors, &mut taken);
        lattice.drop_strays();
        fill(&mut lattice, &saddle_image, board);
        lattice.drop_strays();
        match place_on_board(&lattice, board) {
            BoardSearch::Found(view) if view.is_whole() => {
                return Ok(BoardSearch::Found(clear_only(view, &saddle_image, board)));
            }
            BoardSearch::Found(view) => in_part = in_part.or(Some(view)),
            found => best = best.or_more(found),
        }
    }
    Ok(match in_part {
        Some(view) if !best.outdoes(&view, board) => {
            BoardSearch::Found(clear_only(view, &saddle_image, board))
        }
        _ => best,
    })
}

/// Removes corners that an object in front of the board would displace.
fn clear_only(view: BoardView, image: &SaddleImage, board: &Board) -> BoardView {
    let is_clear = |mark: usize, place: &Point2<f64>| {
        let radius = CLEAR * view.spacing(mark, board.columns()).unwrap_or(0.0);
        radius < LEAST_RADIUS_PX || image.is_clear(place, radius)
    };
    let pixels = view.pixels.iter().enumerate();
    BoardView {
        pixels: pixels
            .map(|(mark, place)| place.filter(|place| is_clear(mark, place)))
            .collect(),
    }
}

/// For each corner, returns the next ones along +edge 0, −edge 0, +edge 1 and −edge 1, where both
/// agree.
fn neighbors(saddles: &[Saddle], monitor: &mut dyn Monitor) -> Result<Vec<[Option<usize>; 4]>> {
    let indices: Vec<usize> = (0..saddles.len()).collect();
    let stage = Stage::FeatureDetection;
    let next: Vec<[Option<usize>; 4]> = monitored::map(&indices, stage, monitor, |&i| {
        let mut near: Vec<(f64, usize)> = (0..saddles.len())
            .filter(|&j| j != i)
            .map(|j| ((saddles[j].place - saddles[i].place).norm_squared(), j))
            .collect();
        let count = NEAREST.min(near.len());
        if count == 0 {
            return [None; 4];
        }
        near.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        near.truncate(count);
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        core::array::from_fn(|way| {
            near.iter()
                .map(|(_, j)| *j)
                .find(|&j| is_next(&saddles[i], &saddles[j], way))
        })
    })?;
    let both = |(i, ways): (usize, &[Option<usize>; 4])| {
        ways.map(|way| way.filter(|&j| next[j].contains(&Some(i))))
    };
    Ok(next.iter().enumerate().map(both).collect())
}

fn way_vector(saddle: &Saddle, way: usize) -> Vector2<f64> {
    saddle.edges[way / 2] * if way.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Returns whether `to` may be the next corner from `from` along an edge: it lies in that
/// direction, the edge continues through it, and dark and bright have changed sides.
fn is_next(from: &Saddle, to: &Saddle, way: usize) -> bool {
    let step = to.place - from.place;
    let along = step / step.norm();
    // A step along edge 0 of one corner is along edge 1 of the next.
    way_vector(from, way).dot(&along) > ALONG && to.edges[1 - way / 2].dot(&along).abs() > ALONG
}

/// Grows the grid around a corner: i along its edge 0 and j along its edge 1, so that the quadrants
/// towards +i and +j are dark in cells whose coordinates have an even sum, and j is clockwise from
/// i in the image.
fn grow(
    seed: usize,
    saddles: &[Saddle],
    neighbors: &[[Option<usize>; 4]],
    taken: &mut [bool],
) -> Lattice {
    let length = |a: usize, b: usize| (saddles[a].place - saddles[b].place).norm();
    let shortest = |i: usize| {
        let links = neighbors[i].iter().flatten();
        links.fold(f64::INFINITY, |least, &j| least.min(length(i, j)))
    };
    let mut cells: BTreeMap<Cell, usize> = BTreeMap::new();
    let mut frames: BTreeMap<Cell, [Vector2<f64>; 2]> = BTreeMap::new();
    cells.insert((0, 0), seed);
    frames.insert((0, 0), saddles[seed].edges);
    taken[seed] = true;
    // Short steps first: a step over an object that hides two corners must not come before the path
    // around it.
    let mut links: Vec<(f64, Cell, usize)> = Vec::new();
    let mut arrived = Some((0, 0));
    loop {
        if let Some(cell) = arrived.take() {
            let here: usize = cells[&cell];
            let usual = shortest(here);
            let to = neighbors[here].iter().flatten();
            links.extend(to.map(|&next| {
                let relative = length(here, next) / usual.min(shortest(next));
                (relative, cell, next)
            }));
        }
        let Some(place) = (0..links.len()).min_by(|&a, &b| links[a].0.total_cmp(&links[b].0))
        else {
            break;
        };
        let (_, cell, next) = links.swap_remove(place);
        if taken[next] {
            continue;
        }
        let (here, frame) = (cells[&cell], frames[&cell]);
        let step = saddles[next].place - saddles[here].place;
        let along = step / step.norm();
        let dots = frame.map(|axis| axis.dot(&along));
        let axis = usize::from(dots[1].abs() > dots[0].abs());
        let sign = if dots[axis] > 0.0 { 1 } else { -1 };
        let target = if axis == 0 {
            (cell.0 + sign, cell.1)
        } else {
            (cell.0, cell.1 + sign)
        };
        // The local edges continue the frame.
        let edges = saddles[next].edges;
        let carried = frame.map(|axis| {
            let is_first = edges[0].dot(&axis).abs() > edges[1].dot(&axis).abs();
            let nearest = if is_first { edges[0] } else { edges[1] };
            nearest * nearest.dot(&axis).signum()
        });
        if cells.contains_key(&target) || carried[0].dot(&carried[1]).abs() > 0.95 {
            continue;
        }
        taken[next] = true;
        cells.insert(target, next);
        frames.insert(target, carried);
        arrived = Some(target);
    }
    Lattice {
        points: cells
            .iter()
            .map(|(cell, i)| (*cell, saddles[*i].place))
            .collect(),
    }
}

/// Searches again where the grid should have corners.
fn fill(lattice: &mut Lattice, image: &SaddleImage, board: &Board) {
    let longest = board.columns().max(board.rows()) as i32;
    for _ in 0..longest {
        let mut found = Vec::new();
        for cell in lattice.open_cells() {
            // A single neighbor is not enough for a prediction.
            let Some(place) = lattice.predict(cell) else {
                continue;
            };
            let Some(spacing) = lattice.spacing(cell, &place) else {
                continue;
            };
            let Some(saddle) = image.examine(&place) else {
                continue;
            };
            let is_free = lattice
                .points
                .values()
                .all(|other| (other - saddle.place).norm() > 0.5 * spacing);
            if (saddle.place - place).norm() < 0.2 * spacing
                && is_free
                && has_right_colors(lattice, cell, &saddle)
            {
                found.push((cell, saddle.place));
            }
        }
        if found.is_empty() {
            break;
        }
        lattice.points.extend(found);
    }
}

/// Returns whether a corner's dark quadrant agrees with the grid: towards +i and +j in even cells.
fn has_right_colors(lattice: &Lattice, (i, j): Cell, saddle: &Saddle) -> bool {
    let toward = |di: i32, dj: i32| -> Option<Vector2<f64>> {
        let ahead = lattice.points.get(&(i + di, j + dj));
        let behind = lattice.points.get(&(i - di, j - dj));
        match (ahead, behind) {
            (Some(p), _) => Some(p - saddle.place),
            (None, Some(p)) => Some(saddle.place - p),
            // From adjacent rows.
            (None, None) => {
                let (a, b) = (dj, di);
                [1, -1].iter().find_map(|s| {
                    let from = lattice.points.get(&(i + s * a, j + s * b))?;
                    let to = lattice.points.get(&(i + s * a + di, j + s * b + dj));
                    let back = lattice.points.get(&(i + s * a - di, j + s * b - dj));
                    to.map(|to| to - from).or(back.map(|back| from - back))
                })
            }
        }
    };
    let (Some(right), Some(down)) = (toward(1, 0), toward(0, 1)) else {
        return false;
    };
    let is_even = (i + j).rem_euclid(2) == 0;
    let [first, second] = if is_even {
        [right, down]
    } else {
        [down, right]
    };
    // The dark quadrant is between edge 0 and edge 1, or between their opposites.
    let matches = |edge: &Vector2<f64>, axis: &Vector2<f64>| edge.dot(&axis.normalize());
    let (a, b) = (
        matches(&saddle.edges[0], &first),
        matches(&saddle.edges[1], &second),
    );
    a.abs() > ALONG && b.abs() > ALONG
}

/// Aligns the grid with the board, or returns the reason why it does not fit.
fn place_on_board(grid: &Lattice, board: &Board) -> BoardSearch {
    let (columns, rows) = (board.columns(), board.rows());
    let Some(extent) = grid.extent() else {
        return BoardSearch::Nothing;
    };
    let (a, b) = extent.size();
    let partial = BoardSearch::Partial {
        columns: a.max(b),
        rows: a.min(b),
        num_visible: grid.points.len(),
    };
    // Prefer the fewest hidden corners, then a dark quadrant inside the first corner, then upright.
    let mut best: Option<((usize, bool, f64), BoardView)> = None;
    for quarter in 0..4 {
        let lattice = grid.mapped(|cell| rotated(cell, quarter));
        let Some(extent) = lattice.extent() else {
            continue;
        };
        let size = extent.size();
        if size.0 < columns || size.1 < rows {
            continue;
        }
        for (left, top) in
            (0..=size.0 - columns).flat_map(|l| (0..=size.1 - rows).map(move |t| (l, t)))
        {
            let first = (extent.least.0 + left as i32, extent.least.1 + top as i32);
            let cell = |k: usize| {
                (
                    first.0 + (k % columns) as i32,
                    first.1 + (k / columns) as i32,
                )
            };
            let view = BoardView {
                pixels: (0..rows * columns)
                    .map(|k| lattice.points.get(&cell(k)).copied())
                    .collect(),
            };
            let inside = view.num_visible();
            if goes_on(&lattice, first, columns, rows)
                || (inside as f64) < MIN_RATIO * (rows * columns) as f64
                || !reaches_all_sides(&view, columns, rows)
            {
                continue;
            }
            let is_bright = (first.0 + first.1 + quarter).rem_euclid(2) != 0;
            let rank = (rows * columns - inside, is_bright, slope(&view));
            if best.as_ref().is_none_or(|(least, _)| rank < *least) {
                best = Some((rank, view));
            }
        }
    }
    best.map_or(partial, |(_, view)| BoardSearch::Found(view))
}

/// Returns whether more than half of a row or column next to the window is filled, so that the
/// board is larger. A few corners there are background.
fn goes_on(lattice: &Lattice, (left, top): Cell, columns: usize, rows: usize) -> bool {
    let (right, bottom) = (left + columns as i32, top + rows as i32);
    let is_filled = |cells: &mut dyn Iterator<Item = Cell>, count: usize| {
        2 * cells
            .filter(|cell| lattice.points.contains_key(cell))
            .count()
            > count
    };
    [top - 1, bottom]
        .iter()
        .any(|&j| is_filled(&mut (left..right).map(|i| (i, j)), columns))
        || [left - 1, right]
            .iter()
            .any(|&i| is_filled(&mut (top..bottom).map(|j| (i, j)), rows))
}

/// Returns a cell in axes rotated by `quarters` times 90°.
fn rotated((i, j): Cell, quarters: i32) -> Cell {
    match quarters {
        0 => (i, j),
        1 => (-j, i),
        2 => (-i, -j),
        _ => (j, -i),
    }
}

/// Returns u + v of the first corner minus that of the last, pixels.
pub(super) fn slope(view: &BoardView) -> f64 {
    let mut sums = view.pixels.iter().flatten().map(|p| p.x + p.y);
    let first = sums.next().unwrap_or(0.0);
    first - sums.next_back().unwrap_or(first)
}

/// Returns whether the outermost rows and columns are visible, so that corners are identified
/// unambiguously.
fn reaches_all_sides(view: &BoardView, columns: usize, rows: usize) -> bool {
    let count = |cells: &mut dyn Iterator<Item = usize>| {
        cells.filter(|&k| view.pixels[k].is_some()).count() >= LEAST_IN_A_LINE
    };
    count(&mut (0..columns))
        && count(&mut ((rows - 1) * columns..rows * columns))
        && count(&mut (0..rows).map(|r| r * columns))
        && count(&mut (0..rows).map(|r| r * columns + columns - 1))
}
