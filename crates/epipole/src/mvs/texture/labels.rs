//! Choice of a view for each triangle.

use super::super::mesh::Mesh;
use super::super::views::MvsView;
use super::adjacency::NONE;
use super::visibility::{Candidate, is_inside, project};
use crate::Result;
use crate::math::UnionFind;
use crate::progress::{Monitor, Stage, report};
use std::collections::VecDeque;

/// Maximum number of sweeps over all triangles.
const MAX_SWEEPS: usize = 30;
/// Number of triangles below which a piece takes the view of a neighboring piece, if that sees it.
const SMALL: usize = 40;
/// Number of rounds in which small pieces are absorbed.
const ROUNDS: usize = 3;

/// Returns the view of each triangle: a large area in the photo, and few seams. `None` where no
/// view is near.
///
/// * `across`: neighbors of each triangle
/// * `seam_cost`: cost of an edge between views, where the cost of a view is 0 to 1
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Waechter, Moehrle & Goesele 2014, "Let there be color! Large-scale texturing of 3D
/// reconstructions"; by iterated conditional modes (Besag 1986).
pub(super) fn choose(
    mesh: &Mesh,
    views: &[MvsView],
    candidates: &[Vec<Candidate>],
    across: &[[u32; 3]],
    seam_cost: f64,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Option<usize>>> {
    let mut labels: Vec<Option<usize>> = (candidates.iter())
        .map(|list| list.first().map(|best| best.view))
        .collect();
    for number in 0..MAX_SWEEPS {
        report(monitor, Stage::Blending, number as f32 / MAX_SWEEPS as f32)?;
        if !sweep(candidates, across, seam_cost, &mut labels) {
            break;
        }
    }
    for _ in 0..ROUNDS {
        report(monitor, Stage::Blending, 1.0)?;
        absorb_small(candidates, across, &mut labels);
    }
    spread(mesh, views, across, &mut labels);
    Ok(labels)
}

/// Gives each triangle its best view among those of its neighbors and its own; returns whether any
/// changed.
fn sweep(
    candidates: &[Vec<Candidate>],
    across: &[[u32; 3]],
    seam_cost: f64,
    labels: &mut [Option<usize>],
) -> bool {
    let mut has_changed = false;
    for (index, list) in candidates.iter().enumerate() {
        let Some(best) = list.first() else { continue };
        let cost = |candidate: &Candidate| {
            let others = across[index].iter().filter(|&&other| other != NONE);
            let num_seams = others
                .filter_map(|&other| labels[other as usize])
                .filter(|label| *label != candidate.view)
                .count();
            let of_view = 1.0 - f64::from(candidate.area_px / best.area_px);
            of_view + seam_cost * num_seams as f64
        };
        let cheapest = list
            .iter()
            .map(|candidate| (cost(candidate), candidate.view))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let label = cheapest.map(|(_, view)| view);
        has_changed |= label != labels[index];
        labels[index] = label;
    }
    has_changed
}

/// Gives small pieces the view with which they share most edges, if it sees all their triangles.
fn absorb_small(candidates: &[Vec<Candidate>], across: &[[u32; 3]], labels: &mut [Option<usize>]) {
    for piece in pieces(across, labels) {
        if piece.len() >= SMALL {
            continue;
        }
        let mut borders: Vec<usize> = Vec::new();
        for &index in &piece {
            let others = across[index].iter().filter(|&&other| other != NONE);
            let others = others.filter_map(|&other| labels[other as usize]);
            borders.extend(others.filter(|view| Some(*view) != labels[index]));
        }
        borders.sort_unstable();
        let shows_all = |view: usize| {
            let mut lists = piece.iter().map(|&index| &candidates[index]);
            lists.all(|list| list.iter().any(|candidate| candidate.view == view))
        };
        let most = borders
            .chunk_by(|a, b| a == b)
            .filter(|run| shows_all(run[0]))
            .max_by_key(|run| (run.len(), std::cmp::Reverse(run[0])));
        if let Some(run) = most {
            piece.iter().for_each(|&index| labels[index] = Some(run[0]));
        }
    }
}

/// Returns connected triangles with one view, in the order of their first triangles. Triangles
/// without a view are left out.
pub(super) fn pieces(across: &[[u32; 3]], labels: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut sets = UnionFind::new(labels.len());
    for (index, others) in across.iter().enumerate() {
        for &other in others.iter().filter(|&&other| other != NONE) {
            if labels[index].is_some() && labels[index] == labels[other as usize] {
                sets.join(index, other as usize);
            }
        }
    }
    let mut place = vec![NONE; labels.len()];
    let mut pieces: Vec<Vec<usize>> = Vec::new();
    for index in (0..labels.len()).filter(|&index| labels[index].is_some()) {
        let root = sets.root(index);
        if place[root] == NONE {
            place[root] = pieces.len() as u32;
            pieces.push(Vec::new());
        }
        pieces[place[root] as usize].push(index);
    }
    pieces
}

/// Gives triangles that no view sees the view of a neighbor, where they project into its photo:
/// mostly strips along occlusions.
fn spread(mesh: &Mesh, views: &[MvsView], across: &[[u32; 3]], labels: &mut [Option<usize>]) {
    let mut open: VecDeque<usize> = (0..labels.len())
        .filter(|&index| labels[index].is_some())
        .collect();
    while let Some(index) = open.pop_front() {
        let Some(view) = labels[index] else { continue };
        for other in across[index].map(|other| other as usize) {
            if other == NONE as usize || labels[other].is_some() {
                continue;
            }
            let corners = mesh.triangles[other].map(|vertex| vertex as usize);
            let projects = corners.iter().all(|&vertex| {
                let projected = project(&views[view], &mesh.vertices.points[vertex]);
                projected.is_some_and(|(pixel, _)| is_inside(&views[view], &pixel))
            });
            if projects {
                labels[other] = Some(view);
                open.push_back(other);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles in a row, each with candidates of these areas by view.
    fn row(areas: &[&[f32]]) -> (Vec<Vec<Candidate>>, Vec<[u32; 3]>) {
        let candidates = areas.iter().map(|areas| {
            let mut list: Vec<Candidate> = areas
                .iter()
                .enumerate()
                .filter(|(_, area_px)| **area_px > 0.0)
                .map(|(view, area_px)| Candidate {
                    view,
                    area_px: *area_px,
                })
                .collect();
            list.sort_by(|a, b| b.area_px.total_cmp(&a.area_px));
            list
        });
        let last = areas.len() - 1;
        let across = (0..areas.len()).map(|n| {
            let before = n.checked_sub(1).map_or(NONE, |n| n as u32);
            [before, if n < last { n as u32 + 1 } else { NONE }, NONE]
        });
        (candidates.collect(), across.collect())
    }

    fn chosen(areas: &[&[f32]], seam_cost: f64) -> Vec<Option<usize>> {
        let (candidates, across) = row(areas);
        let mut labels: Vec<Option<usize>> = (candidates.iter())
            .map(|list| list.first().map(|best| best.view))
            .collect();
        while sweep(&candidates, &across, seam_cost, &mut labels) {}
        labels
    }

    #[test]
    fn seams_cost_more_than_a_slightly_larger_area() {
        let areas: [&[f32]; 5] = [
            &[4.0, 1.0],
            &[4.0, 1.0],
            &[4.0, 4.5],
            &[4.0, 1.0],
            &[4.0, 1.0],
        ];
        assert_eq!(chosen(&areas, 0.5), [Some(0); 5]);
        assert_eq!(chosen(&areas, 0.0)[2], Some(1));
        let hidden: [&[f32]; 3] = [&[4.0, 1.0], &[0.0, 1.0], &[0.0, 0.0]];
        assert_eq!(chosen(&hidden, 0.5), [Some(0), Some(1), None]);
    }

    #[test]
    fn pieces_are_connected_and_small_ones_are_absorbed() {
        let areas: [&[f32]; 4] = [&[2.0], &[1.0, 9.0], &[2.0], &[0.0]];
        let (candidates, across) = row(&areas);
        let mut labels = vec![Some(0), Some(1), Some(0), None];
        assert_eq!(pieces(&across, &labels), [vec![0], vec![1], vec![2]]);
        absorb_small(&candidates, &across, &mut labels);
        assert_eq!(labels, [Some(0), Some(0), Some(0), None]);
    }
}
