//! Boards, lenses, rigs, undistortion.

#[cfg(feature = "all")]
pub(crate) mod board;
#[cfg(feature = "all")]
pub(crate) mod calibrate;
pub(crate) mod undistort;
