//! Nearest neighbors: of one descriptor, of two lists, of a piece of the first list.

/// The two nearest descriptors in the second list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbors {
    /// Index of the nearest; of equally near ones the lowest.
    pub index: usize,
    /// Its distance.
    pub distance: f32,
    /// Distance of the second nearest; `None` if the second list has one entry only.
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

/// Nearest neighbors both ways.
pub(super) struct Found {
    /// For each of the first list.
    pub(super) rows: Vec<Neighbors>,
    /// For each of the second list the index of its nearest in the first.
    pub(super) columns: Vec<usize>,
}

/// Neighbors in the second list of a piece of the first.
pub(super) struct Scanned<D> {
    /// Nearest index, its squared distance, that of the second nearest.
    pub(super) rows: Vec<(usize, D, D)>,
    /// For each of the second list: squared distance and place in the piece.
    pub(super) columns: Vec<(D, usize)>,
}
