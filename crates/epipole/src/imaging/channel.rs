//! Channels of pixels as floats, for interpolation.

use image::Primitive;

/// A channel of a pixel that can be interpolated.
pub trait Channel: Primitive + Send + Sync {
    /// Converts the value to a float.
    fn to_float(self) -> f32;
    /// Returns the nearest value of the type.
    fn from_float(value: f32) -> Self;
}

impl Channel for f32 {
    fn to_float(self) -> f32 {
        self
    }

    fn from_float(value: f32) -> Self {
        value
    }
}

impl Channel for u8 {
    fn to_float(self) -> f32 {
        self.into()
    }

    fn from_float(value: f32) -> Self {
        // Casts saturate.
        (value + 0.5) as Self
    }
}

impl Channel for u16 {
    fn to_float(self) -> f32 {
        self.into()
    }

    fn from_float(value: f32) -> Self {
        (value + 0.5) as Self
    }
}
