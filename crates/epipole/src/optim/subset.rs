//! Weighted subsets of the data.

/// Data used by a least-squares problem, with weights.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Subset<'a> {
    /// Indices of the data.
    pub(crate) indices: &'a [usize],
    /// Their weights, in the same order; `None` if all are equal.
    pub(crate) weights: Option<&'a [f64]>,
}

impl<'a> Subset<'a> {
    /// Creates a subset with equal weights.
    pub(crate) fn alike(indices: &'a [usize]) -> Self {
        Self {
            indices,
            weights: None,
        }
    }

    /// Creates a subset with individual weights.
    pub(crate) fn weighted(indices: &'a [usize], weights: &'a [f64]) -> Self {
        Self {
            indices,
            weights: Some(weights),
        }
    }

    /// Iterates over indices and square roots of weights, the factors of residual and Jacobian.
    pub(crate) fn iter(self) -> impl Iterator<Item = (usize, f64)> + use<'a> {
        let root = move |place: usize| self.weights.map_or(1.0, |weights| weights[place].sqrt());
        let indices = self.indices.iter().enumerate();
        indices.map(move |(place, &index)| (index, root(place)))
    }
}
