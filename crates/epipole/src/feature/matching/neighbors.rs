//! Nearest neighbors of a descriptor, of two lists, and of a piece of the first list.

/// The two nearest descriptors in the second list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbors {
    /// Index of the nearest descriptor; of equally near ones the lowest.
    pub index: usize,
    /// Distance of the nearest descriptor.
    pub distance: f32,
    /// Distance of the second nearest; `None` if the second list has only one entry.
    pub second_distance: Option<f32>,
}

impl Neighbors {
    pub(super) fn ratio(&self) -> f32 {
        match self.second_distance {
            None => 0.0,
            Some(second) if second > 0.0 => self.distance / second,
            Some(_) => 1.0,
        }
    }
}

/// Nearest neighbors in both directions.
pub(super) struct Found {
    /// Neighbors of each descriptor of the first list.
    pub(super) rows: Vec<Neighbors>,
    /// For each descriptor of the second list, the index of its nearest in the first.
    pub(super) columns: Vec<usize>,
}

/// Neighbors in the second list of a piece of the first.
pub(super) struct Scanned<D> {
    /// Index of the nearest, its squared distance, and that of the second nearest.
    pub(super) rows: Vec<(usize, D, D)>,
    /// For each descriptor of the second list, the squared distance and index of its nearest in the
    /// piece.
    pub(super) columns: Vec<(D, usize)>,
}
