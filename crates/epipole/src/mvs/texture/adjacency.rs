//! Triangles that share an edge.

/// No triangle.
pub(super) const NONE: u32 = u32::MAX;

/// Returns the triangle across each edge of each triangle, [`NONE`] at a border and where more than
/// two triangles meet. Edge n leads from corner n to the next.
pub(super) fn neighbors(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        for slot in 0..3 {
            let (a, b) = (triangle[slot], triangle[(slot + 1) % 3]);
            edges.push((a.min(b), a.max(b), index, slot));
        }
    }
    edges.sort_unstable();
    let mut across = vec![[NONE; 3]; triangles.len()];
    for run in edges.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1)) {
        if let [(_, _, first, slot), (_, _, second, other)] = *run {
            across[first][slot] = second as u32;
            across[second][other] = first as u32;
        }
    }
    across
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_an_edge_and_three_do_not() {
        let two = neighbors(&[[0, 1, 2], [2, 1, 3]]);
        assert_eq!(two, [[NONE, 1, NONE], [0, NONE, NONE]]);
        let three = neighbors(&[[0, 1, 2], [2, 1, 3], [1, 2, 4]]);
        assert_eq!(three, [[NONE; 3]; 3]);
    }
}
