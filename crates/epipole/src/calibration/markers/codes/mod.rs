//! Tables of the codes.

mod apriltag_36h11;
mod aruco_4x4;
mod aruco_5x5;
mod aruco_6x6;
mod aruco_7x7;

/// Codes of one family, in the smallest integers that hold them.
#[derive(Debug, Clone, Copy)]
pub(super) enum Codes {
    Short(&'static [u16]),
    Middle(&'static [u32]),
    Long(&'static [u64]),
}

impl Codes {
    /// Returns the code of a marker, whose number must be less than the size of the family.
    pub(super) fn get(self, id: usize) -> u64 {
        match self {
            Self::Short(codes) => codes[id].into(),
            Self::Middle(codes) => codes[id].into(),
            Self::Long(codes) => codes[id],
        }
    }
}

pub(super) const ARUCO_4X4: Codes = Codes::Short(&aruco_4x4::CODES);
pub(super) const ARUCO_5X5: Codes = Codes::Middle(&aruco_5x5::CODES);
pub(super) const ARUCO_6X6: Codes = Codes::Long(&aruco_6x6::CODES);
pub(super) const ARUCO_7X7: Codes = Codes::Long(&aruco_7x7::CODES);
pub(super) const APRILTAG_36H11: Codes = Codes::Long(&apriltag_36h11::CODES);
