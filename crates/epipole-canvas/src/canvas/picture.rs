//! The result of drawing.

use super::coverage::Coverage;
use super::scaled::Scaled;
use tiny_skia::Pixmap;

/// A finished picture: opaque RGBA, 8 bits per channel, rows from top to bottom. Empty by default.
#[derive(Default)]
pub struct Picture {
    pub(super) pixmap: Option<Pixmap>,
    /// Memory reused by the next drawing.
    pub(super) coverage: Coverage,
    pub(super) scaled: Scaled,
}

impl Picture {
    /// Width, device pixels.
    pub fn width(&self) -> u32 {
        self.pixmap.as_ref().map_or(0, Pixmap::width)
    }

    /// Height, device pixels.
    pub fn height(&self) -> u32 {
        self.pixmap.as_ref().map_or(0, Pixmap::height)
    }

    /// Returns `width * height * 4` bytes. All pixels are opaque, so premultiplication does not
    /// matter.
    pub fn rgba(&self) -> &[u8] {
        self.pixmap.as_ref().map_or(&[], Pixmap::data)
    }

    /// Returns the FNV-1a hash of size and pixels, to compare pictures across platforms.
    pub fn hash(&self) -> u64 {
        let sizes = [self.width(), self.height()].map(u32::to_le_bytes);
        sizes
            .iter()
            .flatten()
            .chain(self.rgba())
            .fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
            })
    }
}
