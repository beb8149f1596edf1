//! Point of a cloud or a surface, and its encoding in bytes.

/// Number of bytes of a point: three floats, normal, color, number of photographs.
pub(super) const NUM_BYTES: usize = 19;
/// Length of a unit normal as bytes.
#[cfg(feature = "vision")]
const NORMAL: f64 = 127.0;

/// A point of a cloud, or a vertex of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudVertex {
    /// Position in the frame of the reconstruction.
    pub position: [f64; 3],
    /// Unit normal, towards the cameras.
    pub normal: [f64; 3],
    /// Red, green, blue.
    pub color: [u8; 3],
    /// Number of photographs that agree on it; 0 for a vertex.
    pub num_views: u8,
}

impl CloudVertex {
    #[cfg(feature = "vision")]
    pub(super) fn to_bytes(self) -> [u8; NUM_BYTES] {
        let mut bytes = [0; NUM_BYTES];
        for (axis, x) in self.position.iter().enumerate() {
            bytes[4 * axis..][..4].copy_from_slice(&(*x as f32).to_le_bytes());
        }
        for (axis, x) in self.normal.iter().enumerate() {
            bytes[12 + axis] = ((x * NORMAL).round() as i8).to_le_bytes()[0];
        }
        bytes[15..18].copy_from_slice(&self.color);
        bytes[18] = self.num_views;
        bytes
    }

    pub(super) fn from_bytes(bytes: &[u8; NUM_BYTES]) -> Self {
        let coordinate = |axis: usize| {
            let at = 4 * axis;
            let bytes = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        let normal = [12, 13, 14].map(|at| f64::from(i8::from_le_bytes([bytes[at]])));
        let norm = nalgebra::Vector3::from(normal).norm().max(1.0);
        Self {
            position: [0, 1, 2].map(coordinate),
            normal: normal.map(|x| x / norm),
            color: [bytes[15], bytes[16], bytes[17]],
            num_views: bytes[18],
        }
    }
}
