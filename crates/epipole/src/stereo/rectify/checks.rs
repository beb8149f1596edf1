//! Checks of sizes and numbers for rectification.

use crate::camera::Camera;
use crate::{Error, Result};

/// Returns the common image size of both cameras.
pub(super) fn common_size([first, second]: &[Camera; 2]) -> Result<(u32, u32)> {
    for (what, first, second) in [
        ("the columns of the two images", first.width, second.width),
        ("the rows of the two images", first.height, second.height),
    ] {
        if first != second {
            return Err(Error::SizeMismatch {
                what,
                first: first as usize,
                second: second as usize,
            });
        }
    }
    Ok((first.width, first.height))
}

pub(super) fn checked_index(index: usize) -> Result<usize> {
    if index < 2 {
        Ok(index)
    } else {
        Err(Error::OutOfRange {
            what: "the number of a rig's camera",
            requirement: "0 or 1",
            value: index as f64,
        })
    }
}

pub(super) fn check(
    width: u32,
    height: u32,
    new_width: u32,
    new_height: u32,
    alpha: f64,
) -> Result<()> {
    for (what, value) in [
        ("the images' width", width),
        ("the images' height", height),
        ("the rectified width", new_width),
        ("the rectified height", new_height),
    ] {
        if value < 2 {
            return Err(Error::OutOfRange {
                what,
                requirement: "at least 2 pixels",
                value: f64::from(value),
            });
        }
    }
    if !(0.0..=1.0).contains(&alpha) {
        return Err(Error::OutOfRange {
            what: "alpha",
            requirement: "from 0 to 1",
            value: alpha,
        });
    }
    Ok(())
}
