//! Sparse Cholesky factorization with blocks of one size.

use crate::math::order::sort_indices;
use nalgebra::{SMatrix, SVector};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Elimination order of the vertices, and the resulting nonzero blocks. Independent of the block
/// size, so it is compiled once.
struct Pattern {
    /// Position of each vertex in the elimination order.
    place: Vec<usize>,
    /// Vertex at each position.
    vertex: Vec<usize>,
    /// Positions of the blocks below the diagonal in each column, ascending.
    rows: Vec<Vec<usize>>,
    /// Columns left of the diagonal with a block in each row.
    left: Vec<Vec<usize>>,
}

impl Pattern {
    fn new(count: usize, pairs: &[(u32, u32)]) -> Self {
        let mut neighbors: Vec<Vec<usize>> = vec![Vec::new(); count];
        for &(a, b) in pairs {
            if a != b {
                neighbors[a as usize].push(b as usize);
                neighbors[b as usize].push(a as usize);
            }
        }
        for list in &mut neighbors {
            sort_indices(list, &mut |a, b| a.cmp(&b));
            list.dedup();
        }
        let mut queue: BinaryHeap<Reverse<(usize, usize)>> = (0..count)
            .map(|vertex| Reverse((neighbors[vertex].len(), vertex)))
            .collect();
        let mut eliminated = vec![false; count];
        let mut vertex = Vec::with_capacity(count);
        let mut pattern = Vec::with_capacity(count);
        while let Some(Reverse((degree, v))) = queue.pop() {
            // Entries from before a change of degree are still in the queue.
            if eliminated[v] || degree != neighbors[v].len() {
                continue;
            }
            eliminated[v] = true;
            let clique = std::mem::take(&mut neighbors[v]);
            for &u in &clique {
                neighbors[u] = merged_without(&neighbors[u], &clique, v, u);
                queue.push(Reverse((neighbors[u].len(), u)));
            }
            vertex.push(v);
            pattern.push(clique);
        }
        let mut place = vec![0; count];
        for (index, &v) in vertex.iter().enumerate() {
            place[v] = index;
        }
        let mut left = vec![Vec::new(); count];
        let rows: Vec<Vec<usize>> = pattern
            .iter()
            .enumerate()
            .map(|(column, clique)| {
                let mut rows: Vec<usize> = clique.iter().map(|&v| place[v]).collect();
                sort_indices(&mut rows, &mut |a, b| a.cmp(&b));
                for &row in &rows {
                    left[row].push(column);
                }
                rows
            })
            .collect();
        Self {
            place,
            vertex,
            rows,
            left,
        }
    }
}

/// Lower triangular factor of a symmetric matrix of `D × D` blocks, most of them zero.
///
/// The minimum-degree order is computed once; values can be factorized repeatedly.
pub(crate) struct BlockCholesky<const D: usize> {
    pattern: Pattern,
    diagonal: Vec<SMatrix<f64, D, D>>,
    blocks: Vec<Vec<SMatrix<f64, D, D>>>,
}

impl<const D: usize> BlockCholesky<D> {
    /// Computes the order and the pattern for blocks at the `pairs` of `count` vertices.
    pub(crate) fn new(count: usize, pairs: &[(u32, u32)]) -> Self {
        let pattern = Pattern::new(count, pairs);
        let blocks = (pattern.rows.iter())
            .map(|rows| vec![SMatrix::zeros(); rows.len()])
            .collect();
        Self {
            pattern,
            diagonal: vec![SMatrix::zeros(); count],
            blocks,
        }
    }

    /// Sets every block to zero.
    pub(crate) fn clear(&mut self) {
        for block in &mut self.diagonal {
            *block = SMatrix::zeros();
        }
        for column in &mut self.blocks {
            column.fill(SMatrix::zeros());
        }
    }

    /// Adds a diagonal block.
    pub(crate) fn add_diagonal(&mut self, vertex: usize, block: &SMatrix<f64, D, D>) {
        self.diagonal[self.pattern.place[vertex]] += block;
    }

    /// Adds a block in row `a` and column `b`, and its transpose in row `b`, column `a`.
    pub(crate) fn add(&mut self, a: usize, b: usize, block: &SMatrix<f64, D, D>) {
        let (a, b) = (self.pattern.place[a], self.pattern.place[b]);
        let (row, column) = (a.max(b), a.min(b));
        if let Ok(index) = self.pattern.rows[column].binary_search(&row) {
            if a > b {
                self.blocks[column][index] += block;
            } else {
                self.blocks[column][index] += block.transpose();
            }
        }
    }

    /// Replaces the matrix by its factor; returns false unless it is positive definite.
    pub(crate) fn factorize(&mut self) -> bool {
        let count = self.diagonal.len();
        let mut position = vec![usize::MAX; count];
        for column in 0..count {
            for (index, &row) in self.pattern.rows[column].iter().enumerate() {
                position[row] = index;
            }
            let (before, after) = self.blocks.split_at_mut(column);
            let target = &mut after[0];
            for &source in &self.pattern.left[column] {
                let rows = &self.pattern.rows[source];
                // Every row in a list of `left` has its block.
                let Ok(at) = rows.binary_search(&column) else {
                    continue;
                };
                let factor = before[source][at].transpose();
                self.diagonal[column] -= before[source][at] * factor;
                for (row, block) in rows[at + 1..].iter().zip(&before[source][at + 1..]) {
                    target[position[*row]] -= block * factor;
                }
            }
            if !super::fixed::cholesky_in_place(&mut self.diagonal[column]) {
                return false;
            }
            let lower = self.diagonal[column];
            for block in target.iter_mut() {
                // X Lᵀ = B, column by column of X.
                for j in 0..D {
                    for k in 0..j {
                        for i in 0..D {
                            block[(i, j)] -= block[(i, k)] * lower[(j, k)];
                        }
                    }
                    for i in 0..D {
                        block[(i, j)] /= lower[(j, j)];
                    }
                }
            }
        }
        true
    }

    /// Solves for one vector per vertex, in place, after [`factorize`](Self::factorize).
    pub(crate) fn solve(&self, b: &mut [SVector<f64, D>]) {
        let mut x: Vec<SVector<f64, D>> = self.pattern.vertex.iter().map(|&v| b[v]).collect();
        for column in 0..x.len() {
            let lower = &self.diagonal[column];
            let mut value = x[column];
            for i in 0..D {
                for k in 0..i {
                    value[i] -= lower[(i, k)] * value[k];
                }
                value[i] /= lower[(i, i)];
            }
            x[column] = value;
            for (&row, block) in self.pattern.rows[column].iter().zip(&self.blocks[column]) {
                x[row] -= block * value;
            }
        }
        for column in (0..x.len()).rev() {
            let mut value = x[column];
            for (&row, block) in self.pattern.rows[column].iter().zip(&self.blocks[column]) {
                value -= block.tr_mul(&x[row]);
            }
            let lower = &self.diagonal[column];
            for i in (0..D).rev() {
                for k in i + 1..D {
                    value[i] -= lower[(k, i)] * value[k];
                }
                value[i] /= lower[(i, i)];
            }
            x[column] = value;
        }
        for (&v, value) in self.pattern.vertex.iter().zip(&x) {
            b[v] = *value;
        }
    }
}

/// Merges two ascending lists, without two of their members.
fn merged_without(a: &[usize], b: &[usize], first: usize, second: usize) -> Vec<usize> {
    let mut merged = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let next = match (a.get(i), b.get(j)) {
            (Some(&x), Some(&y)) => x.min(y),
            (Some(&x), None) => x,
            (None, Some(&y)) => y,
            (None, None) => break,
        };
        i += usize::from(a.get(i) == Some(&next));
        j += usize::from(b.get(j) == Some(&next));
        if next != first && next != second {
            merged.push(next);
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn solves_what_the_dense_factor_solves() {
        let mut random = Random::new(31);
        let count = 40;
        let mut pairs: Vec<(u32, u32)> = (1..count as u32).map(|i| (i - 1, i)).collect();
        for _ in 0..25 {
            let (a, b) = (random.below(count) as u32, random.below(count) as u32);
            if a != b {
                pairs.push((a, b));
            }
        }
        let mut sparse = BlockCholesky::<3>::new(count, &pairs);
        let mut dense = DMatrix::zeros(3 * count, 3 * count);
        sparse.clear();
        for &(a, b) in &pairs {
            let (a, b) = (a as usize, b as usize);
            let block = SMatrix::<f64, 3, 3>::from_fn(|_, _| random.normal());
            sparse.add(a, b, &block);
            let mut view = dense.fixed_view_mut::<3, 3>(3 * a, 3 * b);
            view += block;
            let mut view = dense.fixed_view_mut::<3, 3>(3 * b, 3 * a);
            view += block.transpose();
        }
        for v in 0..count {
            let block = SMatrix::<f64, 3, 3>::identity() * 40.0;
            sparse.add_diagonal(v, &block);
            let mut view = dense.fixed_view_mut::<3, 3>(3 * v, 3 * v);
            view += block;
        }
        let b = DVector::from_fn(3 * count, |_, _| random.normal());
        let expected = dense.cholesky().unwrap().solve(&b);
        let mut x: Vec<_> = (0..count)
            .map(|v| SVector::<f64, 3>::new(b[3 * v], b[3 * v + 1], b[3 * v + 2]))
            .collect();
        assert!(sparse.factorize());
        sparse.solve(&mut x);
        for v in 0..count {
            for k in 0..3 {
                assert!((x[v][k] - expected[3 * v + k]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_long_chain_has_no_fill() {
        let pairs: Vec<(u32, u32)> = (1..5000).map(|i| (i - 1, i)).collect();
        let sparse = BlockCholesky::<2>::new(5000, &pairs);
        assert_eq!(
            sparse.pattern.rows.iter().map(Vec::len).sum::<usize>(),
            4999
        );
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut sparse = BlockCholesky::<1>::new(2, &[(0, 1)]);
        sparse.add_diagonal(0, &SMatrix::<f64, 1, 1>::new(1.0));
        sparse.add_diagonal(1, &SMatrix::<f64, 1, 1>::new(1.0));
        sparse.add(0, 1, &SMatrix::<f64, 1, 1>::new(2.0));
        assert!(!sparse.factorize());
    }
}
