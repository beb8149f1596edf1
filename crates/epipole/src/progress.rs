//! How far a long computation is, and whether it goes on.

use std::ops::ControlFlow;

/// Hears now and then, on the caller's thread, what share of the work is done, in [0, 1]; a share is never
/// less than the one before. [`ControlFlow::Break`] stops the work, and the function returns
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// It is the last argument of every function called `…_with_progress`; the function without goes to its end.
/// Functions called `…_with` show what they do in more detail, each sample of RANSAC for example, and are
/// answered in the same way.
///
/// ```
/// use epipole::feature::{SiftOptions, detect_sift, detect_sift_with_progress};
/// use std::ops::ControlFlow;
/// let image = epipole::imaging::GrayImage32::new(64, 64);
/// let (options, mut last) = (SiftOptions::default(), 0.0);
/// let watched = detect_sift_with_progress(&image, &options, &mut |share| {
///     assert!(share >= last && share <= 1.0);
///     last = share;
///     ControlFlow::Continue(())
/// });
/// assert_eq!(watched, detect_sift(&image, &options));
/// let stopped = detect_sift_with_progress(&image, &options, &mut |_| ControlFlow::Break(()));
/// assert_eq!(stopped, Err(epipole::Error::Canceled));
/// ```
pub type Progress<'a> = &'a mut dyn FnMut(f32) -> ControlFlow<()>;
