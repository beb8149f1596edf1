//! Disjoint sets.

/// Disjoint sets over `0..n` with union.
///
/// Source: Tarjan 1975, with path halving and union by size.
#[derive(Debug, Clone)]
pub(crate) struct UnionFind {
    parent: Vec<u32>,
    size: Vec<u32>,
}

impl UnionFind {
    pub(crate) fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
            size: vec![1; count],
        }
    }

    /// Returns the representative of the set that contains `item`.
    pub(crate) fn root(&mut self, item: usize) -> usize {
        let mut item = item;
        while self.parent[item] as usize != item {
            self.parent[item] = self.parent[self.parent[item] as usize];
            item = self.parent[item] as usize;
        }
        item
    }

    /// Joins two sets; returns false if they were already joined.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> bool {
        let (mut a, mut b) = (self.root(a), self.root(b));
        if a == b {
            return false;
        }
        if self.size[a] < self.size[b] {
            std::mem::swap(&mut a, &mut b);
        }
        self.parent[b] = a as u32;
        self.size[a] += self.size[b];
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_joined() {
        let mut sets = UnionFind::new(6);
        assert!(sets.join(0, 1));
        assert!(sets.join(2, 3));
        assert!(sets.join(1, 3));
        assert!(!sets.join(0, 2));
        assert_eq!(sets.root(0), sets.root(3));
        assert_ne!(sets.root(0), sets.root(4));
    }
}
