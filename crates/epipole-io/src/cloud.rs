//! Point clouds.

pub(crate) mod ply;

pub use ply::{read_ply, write_ply};

/// Returns a sentence on points that were left out, if any.
pub(crate) fn not_finite(count: usize) -> Option<String> {
    let points = match count {
        0 => return None,
        1 => "1 point has".to_owned(),
        _ => format!("{count} points have"),
    };
    Some(format!("{points} NaN or infinite coordinates: left out"))
}
