//! Dictionaries of square markers.

use super::codes::{APRILTAG_36H11, ARUCO_4X4, ARUCO_5X5, ARUCO_6X6, ARUCO_7X7, Codes};

/// Set of square markers that differ from each other in all four orientations.
///
/// Names and numbers are those of OpenCV; as there, AprilTags are rotated by 180° from those of the
/// AprilTag library.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MarkerDictionary {
    /// 50 markers of 4 × 4 bits.
    #[default]
    Aruco4x4_50,
    /// 100 markers of 4 × 4 bits.
    Aruco4x4_100,
    /// 250 markers of 4 × 4 bits.
    Aruco4x4_250,
    /// 1000 markers of 4 × 4 bits.
    Aruco4x4_1000,
    /// 50 markers of 5 × 5 bits.
    Aruco5x5_50,
    /// 100 markers of 5 × 5 bits.
    Aruco5x5_100,
    /// 250 markers of 5 × 5 bits.
    Aruco5x5_250,
    /// 1000 markers of 5 × 5 bits.
    Aruco5x5_1000,
    /// 50 markers of 6 × 6 bits.
    Aruco6x6_50,
    /// 100 markers of 6 × 6 bits.
    Aruco6x6_100,
    /// 250 markers of 6 × 6 bits.
    Aruco6x6_250,
    /// 1000 markers of 6 × 6 bits.
    Aruco6x6_1000,
    /// 50 markers of 7 × 7 bits.
    Aruco7x7_50,
    /// 100 markers of 7 × 7 bits.
    Aruco7x7_100,
    /// 250 markers of 7 × 7 bits.
    Aruco7x7_250,
    /// 1000 markers of 7 × 7 bits.
    Aruco7x7_1000,
    /// 587 markers of 6 × 6 bits, with a Hamming distance of at least 11.
    AprilTag36h11,
}

/// Properties of a dictionary.
struct Facts {
    name: &'static str,
    codes: Codes,
    side: usize,
    num_markers: usize,
    /// Maximum number of wrong bits for unique identification; from OpenCV.
    unique: u32,
}

/// Returns the original row and column of a bit in a marker rotated clockwise by `quarters` times
/// 90°.
fn rotated_back((row, column): (usize, usize), quarters: usize, side: usize) -> (usize, usize) {
    let last = side - 1;
    match quarters % 4 {
        0 => (row, column),
        1 => (last - column, row),
        2 => (last - row, last - column),
        _ => (column, last - row),
    }
}

impl MarkerDictionary {
    /// All dictionaries.
    pub const ALL: [Self; 17] = [
        Self::Aruco4x4_50,
        Self::Aruco4x4_100,
        Self::Aruco4x4_250,
        Self::Aruco4x4_1000,
        Self::Aruco5x5_50,
        Self::Aruco5x5_100,
        Self::Aruco5x5_250,
        Self::Aruco5x5_1000,
        Self::Aruco6x6_50,
        Self::Aruco6x6_100,
        Self::Aruco6x6_250,
        Self::Aruco6x6_1000,
        Self::Aruco7x7_50,
        Self::Aruco7x7_100,
        Self::Aruco7x7_250,
        Self::Aruco7x7_1000,
        Self::AprilTag36h11,
    ];

    fn facts(self) -> Facts {
        let (name, codes, side, num_markers, unique) = match self {
            Self::Aruco4x4_50 => ("4x4_50", ARUCO_4X4, 4, 50, 1),
            Self::Aruco4x4_100 => ("4x4_100", ARUCO_4X4, 4, 100, 1),
            Self::Aruco4x4_250 => ("4x4_250", ARUCO_4X4, 4, 250, 1),
            Self::Aruco4x4_1000 => ("4x4_1000", ARUCO_4X4, 4, 1000, 0),
            Self::Aruco5x5_50 => ("5x5_50", ARUCO_5X5, 5, 50, 3),
            Self::Aruco5x5_100 => ("5x5_100", ARUCO_5X5, 5, 100, 3),
            Self::Aruco5x5_250 => ("5x5_250", ARUCO_5X5, 5, 250, 2),
            Self::Aruco5x5_1000 => ("5x5_1000", ARUCO_5X5, 5, 1000, 2),
            Self::Aruco6x6_50 => ("6x6_50", ARUCO_6X6, 6, 50, 6),
            Self::Aruco6x6_100 => ("6x6_100", ARUCO_6X6, 6, 100, 5),
            Self::Aruco6x6_250 => ("6x6_250", ARUCO_6X6, 6, 250, 5),
            Self::Aruco6x6_1000 => ("6x6_1000", ARUCO_6X6, 6, 1000, 4),
            Self::Aruco7x7_50 => ("7x7_50", ARUCO_7X7, 7, 50, 9),
            Self::Aruco7x7_100 => ("7x7_100", ARUCO_7X7, 7, 100, 8),
            Self::Aruco7x7_250 => ("7x7_250", ARUCO_7X7, 7, 250, 8),
            Self::Aruco7x7_1000 => ("7x7_1000", ARUCO_7X7, 7, 1000, 6),
            Self::AprilTag36h11 => ("36h11", APRILTAG_36H11, 6, 587, 5),
        };
        Facts {
            name,
            codes,
            side,
            num_markers,
            unique,
        }
    }

    /// Returns the name, as in OpenCV without the prefix: "4x4_50", "36h11".
    ///
    /// ```
    /// use epipole::calibration::MarkerDictionary;
    /// let named = |name: &str| MarkerDictionary::ALL.into_iter().find(|d| d.name() == name);
    /// assert_eq!(named("36h11"), Some(MarkerDictionary::AprilTag36h11));
    /// ```
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns the number of markers.
    pub fn num_markers(self) -> usize {
        self.facts().num_markers
    }

    /// Returns the number of bits along a side, without the border.
    pub fn num_bits(self) -> usize {
        self.facts().side
    }

    /// Returns the default maximum number of wrong bits: 0.6 of the maximum for unique
    /// identification, as in OpenCV.
    pub fn max_hamming(self) -> u32 {
        self.facts().unique * 6 / 10
    }

    /// Returns whether a bit is white; `None` if there is no such marker or bit.
    ///
    /// * `row`, `column`: from the upper left bit of an upright marker, without its border
    pub fn is_white(self, id: usize, row: usize, column: usize) -> Option<bool> {
        let facts = self.facts();
        let is_there = id < facts.num_markers && row < facts.side && column < facts.side;
        is_there.then(|| {
            let from_last = facts.side * facts.side - 1 - (row * facts.side + column);
            (facts.codes.get(id) >> from_last) & 1 == 1
        })
    }

    /// Returns the black cells of an upright marker, joined to rectangles without overlaps: column
    /// and row of the upper left and of the lower right corner, in cells from the outer corner of
    /// the border; `None` if there is no such marker.
    ///
    /// * `border_bits`: width of the black border
    ///
    /// ```
    /// use epipole::calibration::MarkerDictionary;
    /// let cells = MarkerDictionary::Aruco4x4_50.black_cells(0, 1).unwrap();
    /// // The upper border, six cells wide; the first row 1011 does not extend it.
    /// assert_eq!(cells[0], [[0, 0], [6, 1]]);
    /// ```
    pub fn black_cells(self, id: usize, border_bits: usize) -> Option<Vec<[[usize; 2]; 2]>> {
        if id >= self.num_markers() {
            return None;
        }
        let side = self.num_bits() + 2 * border_bits;
        let is_black = |row: usize, column: usize| {
            let bit = |k: usize| k.wrapping_sub(border_bits);
            let white = self.is_white(id, bit(row), bit(column));
            !white.unwrap_or(false)
        };
        let row_of = |row: usize| -> Vec<bool> { (0..side).map(|k| is_black(row, k)).collect() };
        let mut rectangles = Vec::new();
        let mut row = 0;
        while row < side {
            let cells = row_of(row);
            let mut end = row + 1;
            while end < side && row_of(end) == cells {
                end += 1;
            }
            let mut column = 0;
            for run in cells.chunk_by(|x, y| x == y) {
                let next = column + run.len();
                if run[0] {
                    rectangles.push([[column, row], [next, end]]);
                }
                column = next;
            }
            row = end;
        }
        Some(rectangles)
    }

    /// Returns the closest marker to the bits of an image: its number, its number of clockwise 90°
    /// rotations, and the number of wrong bits, if at most `max_hamming`.
    ///
    /// * `bits`: row by row, the first the most significant; 1 is white
    pub(super) fn nearest(self, bits: u64, max_hamming: u32) -> Option<(usize, usize, u32)> {
        let facts = self.facts();
        let num_bits = facts.side * facts.side;
        // The bits as in an upright marker.
        let upright: [u64; 4] = core::array::from_fn(|quarters| {
            (0..num_bits).fold(0, |code, k| {
                // A bit of the upright marker is at the position given by the remaining rotation.
                let place = (k / facts.side, k % facts.side);
                let (row, column) = rotated_back(place, 4 - quarters, facts.side);
                code << 1 | bits >> (num_bits - 1 - (row * facts.side + column)) & 1
            })
        });
        let all = (0..facts.num_markers).flat_map(|id| {
            let code = facts.codes.get(id);
            (0..4).map(move |quarters| (id, quarters, (upright[quarters] ^ code).count_ones()))
        });
        all.min_by_key(|(_, _, hamming)| *hamming)
            .filter(|(_, _, hamming)| *hamming <= max_hamming)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bits of a marker that is rotated clockwise.
    fn bits(dictionary: MarkerDictionary, id: usize, quarters: usize) -> u64 {
        let side = dictionary.num_bits();
        (0..side * side).fold(0, |bits, k| {
            let (row, column) = rotated_back((k / side, k % side), quarters, side);
            bits << 1 | u64::from(dictionary.is_white(id, row, column).unwrap())
        })
    }

    /// First rows of `cv2.aruco.generateImageMarker`, one pixel per bit.
    #[test]
    fn bits_are_those_of_opencv() {
        for (dictionary, id, first_row) in [
            (MarkerDictionary::Aruco4x4_50, 0, "1011"),
            (MarkerDictionary::Aruco5x5_100, 7, "01110"),
            (MarkerDictionary::Aruco6x6_250, 23, "100110"),
            (MarkerDictionary::Aruco7x7_1000, 999, "1110011"),
            (MarkerDictionary::AprilTag36h11, 0, "001000"),
        ] {
            let row: String = (0..dictionary.num_bits())
                .map(|column| match dictionary.is_white(id, 0, column) {
                    Some(true) => '1',
                    _ => '0',
                })
                .collect();
            assert_eq!(row, first_row, "{dictionary:?} {id}");
        }
    }

    #[test]
    fn markers_are_read_in_every_rotation() {
        for dictionary in MarkerDictionary::ALL {
            for id in (0..dictionary.num_markers()).step_by(7) {
                for quarters in 0..4 {
                    let bits = bits(dictionary, id, quarters);
                    assert_eq!(dictionary.nearest(bits, 0), Some((id, quarters, 0)));
                }
            }
        }
    }

    #[test]
    fn wrong_bits_are_corrected_up_to_the_limit() {
        for dictionary in MarkerDictionary::ALL {
            let most = dictionary.max_hamming();
            let wrong = bits(dictionary, 3, 1) ^ ((1 << most) - 1);
            assert_eq!(dictionary.nearest(wrong, most), Some((3, 1, most)));
            let worse = bits(dictionary, 3, 1) ^ ((2 << most) - 1);
            let found = dictionary.nearest(worse, most);
            assert_ne!(found.map(|(id, ..)| id), Some(3), "{dictionary:?}");
        }
    }

    #[test]
    fn there_is_no_bit_outside() {
        let dictionary = MarkerDictionary::Aruco4x4_50;
        assert_eq!(dictionary.is_white(50, 0, 0), None);
        assert_eq!(dictionary.is_white(0, 4, 0), None);
    }
}
