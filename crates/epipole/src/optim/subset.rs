//! A part of the data, with weights.

/// Data that a least-squares problem uses, and the weight of each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Subset<'a> {
    /// Indices of the data.
    pub(crate) indices: &'a [usize],
    /// Their weights, in the same order; `None` if all count alike.
    pub(crate) weights: Option<&'a [f64]>,
}

impl<'a> Subset<'a> {
    /// Data that count alike.
    pub(crate) fn alike(indices: &'a [usize]) -> Self {
        Self {
            indices,
            weights: None,
        }
    }

    /// Data with a weight each.
    pub(crate) fn weighted(indices: &'a [usize], weights: &'a [f64]) -> Self {
        Self {
            indices,
            weights: Some(weights),
        }
    }

    /// The indices, each with the root of its weight: the factor of residual and Jacobian.
    pub(crate) fn iter(self) -> impl Iterator<Item = (usize, f64)> + use<'a> {
        let root = move |place: usize| self.weights.map_or(1.0, |weights| weights[place].sqrt());
        let indices = self.indices.iter().enumerate();
        indices.map(move |(place, &index)| (index, root(place)))
    }
}
