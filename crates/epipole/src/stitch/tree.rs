//! Largest connected set of photos, and its best spanning tree of overlaps.

use super::overlap::Overlap;
use crate::math::UnionFind;
use crate::{Error, Result};

/// A tree of overlaps.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    pub(super) root: usize,
    /// Child, parent and index of their overlap; parents come before their children.
    pub(super) edges: Vec<[usize; 3]>,
}

/// Returns the tree with the most matches over the largest connected set of photos. Its root is in
/// the middle, so that chains of homographies are short.
///
/// # Errors
/// [`Error::OutOfRange`] if an overlap refers to a missing photo, [`Error::Degenerate`] if no
/// photos overlap.
pub(super) fn largest_tree(num_images: usize, overlaps: &[Overlap]) -> Result<Tree> {
    let images = overlaps.iter().flat_map(|overlap| overlap.images);
    if let Some(image) = images.max().filter(|&image| image >= num_images) {
        return Err(Error::OutOfRange {
            what: "the image of an overlap",
            requirement: "the index of one of the photos",
            value: image as f64,
        });
    }
    let mut order: Vec<usize> = (0..overlaps.len()).collect();
    order.sort_by_key(|&index| (usize::MAX - overlaps[index].pixels[0].len(), index));
    let mut sets = UnionFind::new(num_images);
    let mut neighbors: Vec<Vec<[usize; 2]>> = vec![Vec::new(); num_images];
    for index in order {
        let [a, b] = overlaps[index].images;
        if sets.join(a, b) {
            neighbors[a].push([b, index]);
            neighbors[b].push([a, index]);
        }
    }
    let trees = (0..num_images).map(|root| from_root(root, &neighbors));
    // Prefer the most photos, then the lowest tree, then the first root.
    let best = trees.min_by_key(|(tree, depth)| (usize::MAX - tree.edges.len(), *depth, tree.root));
    best.map(|(tree, _)| tree)
        .filter(|tree| !tree.edges.is_empty())
        .ok_or(Error::Degenerate {
            what: "a panorama",
            why: "no two photos overlap",
        })
}

/// Returns the tree below a root, and its depth.
fn from_root(root: usize, neighbors: &[Vec<[usize; 2]>]) -> (Tree, usize) {
    let mut edges = Vec::new();
    let mut depth_of = vec![usize::MAX; neighbors.len()];
    depth_of[root] = 0;
    let mut open = vec![root];
    let mut next = 0;
    while next < open.len() {
        let parent = open[next];
        next += 1;
        for &[child, overlap] in &neighbors[parent] {
            if depth_of[child] == usize::MAX {
                depth_of[child] = depth_of[parent] + 1;
                edges.push([child, parent, overlap]);
                open.push(child);
            }
        }
    }
    let depth = open.iter().map(|&image| depth_of[image]).max();
    (Tree { root, edges }, depth.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Point2};

    fn overlap(images: [usize; 2], count: usize) -> Overlap {
        let pixels = vec![Point2::origin(); count];
        Overlap {
            images,
            pixels: [pixels.clone(), pixels],
            homography: Matrix3::identity(),
            num_matches: count,
            has_parallax: false,
        }
    }

    #[test]
    fn a_row_of_photos_has_its_root_in_the_middle_and_its_best_overlaps() {
        let overlaps = [
            overlap([0, 1], 50),
            overlap([1, 2], 40),
            overlap([0, 2], 20),
            overlap([2, 3], 30),
            overlap([3, 4], 30),
            overlap([5, 6], 900),
        ];
        let tree = largest_tree(8, &overlaps).unwrap();
        assert_eq!(tree.root, 2);
        let mut joined: Vec<usize> = tree.edges.iter().map(|edge| edge[2]).collect();
        joined.sort_unstable();
        assert_eq!(joined, [0, 1, 3, 4]);
        for (num_images, overlaps) in [(3, &[][..]), (0, &[]), (6, &overlaps)] {
            assert!(largest_tree(num_images, overlaps).is_err());
        }
    }
}
