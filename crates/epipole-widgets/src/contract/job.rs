//! Jobs: computations too long for a frame, as plain data in and plain data out.

use super::problem::Problem;
use std::ops::ControlFlow;

/// A computation that a model waits for.
///
/// The model states what it needs; who runs it is not its business. A page runs it in a Web Worker,
/// posters, tests and the command line at once: both give the same bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// What the page says while it runs, such as "Looking for corners".
    pub label: &'static str,
    /// Everything that the computation depends on.
    pub request: Vec<u8>,
}

impl Job {
    /// A number that tells requests apart, so that an answer that comes too late is recognized.
    pub fn key(&self) -> u64 {
        // FNV-1a.
        self.request
            .iter()
            .fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
            })
    }
}

/// Told the share that is done, 0 to 1; answers whether to go on.
pub type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// What a job gives: bytes that only its model understands.
pub type JobResult = Result<Vec<u8>, Problem>;

/// A place for a photograph of the reader's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct PhotoSlot {
    /// Permanent name.
    pub id: &'static str,
    /// What the reader reads, such as "Left photograph".
    pub label: &'static str,
    /// The largest width or height that is useful here; a page scales larger ones down and says so.
    pub max_side_px: u32,
}

/// Refuses a photograph for a slot of which a side is shorter than `min_side_px`.
pub(crate) fn refuse_small(
    slot: &str,
    photo: &image::RgbImage,
    min_side_px: u32,
) -> Result<(), Problem> {
    let (width, height) = photo.dimensions();
    if width.min(height) >= min_side_px {
        return Ok(());
    }
    Err(Problem::BadValue {
        name: slot.to_owned(),
        value: format!("{width} × {height} pixels"),
        expected: format!("photographs of at least {min_side_px} pixels on each side"),
    })
}
