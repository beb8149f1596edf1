//! How far a long computation is, and whether it goes on.

use std::ops::ControlFlow;

/// What a long function is at. Each says in its documentation which stages it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// Keypoints are found in photographs and described.
    FeatureDetection,
    /// Descriptors are compared.
    FeatureMatching,
    /// The matches of pairs are tested by epipolar geometry.
    PairVerification,
    /// Photographs are added to a reconstruction, or frames to a path, one after the other.
    Registration,
    /// Cameras and points are refined together.
    BundleAdjustment,
    /// The poses of a graph are refined together.
    PoseGraph,
    /// Rows of a rectified pair are matched, pixel by pixel.
    DenseMatching,
    /// Intrinsics, distortion and the poses of boards are refined.
    Calibration,
}

impl Stage {
    /// The stage in words for people, to stand before a share: "matching features", 40 %.
    ///
    /// ```
    /// use epipole::progress::Stage;
    /// assert_eq!(Stage::FeatureMatching.words(), "matching features");
    /// ```
    pub const fn words(self) -> &'static str {
        match self {
            Self::FeatureDetection => "finding features",
            Self::FeatureMatching => "matching features",
            Self::PairVerification => "testing pairs",
            Self::Registration => "adding photographs",
            Self::BundleAdjustment => "refining cameras and points",
            Self::PoseGraph => "refining poses",
            Self::DenseMatching => "matching along the rows",
            Self::Calibration => "fitting the lens",
        }
    }
}

/// How far a long function is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Status {
    /// What it is at.
    pub stage: Stage,
    /// The share of the whole work, of all stages, that is done, in [0, 1].
    pub share: f32,
}

/// Hears now and then, on the caller's thread, how far the work is; a share is never less than the one
/// before. [`ControlFlow::Break`] stops the work, and the function returns
/// [`Error::Canceled`](crate::Error::Canceled), or what there is so far where that is of use and its
/// documentation says so.
///
/// It is the last argument of every function called `…_with_progress`; the function without goes to its end.
/// Functions that take an observer show what they do in more detail, each sample of RANSAC for example, and
/// are answered in the same way.
///
/// ```
/// use epipole::feature::{SiftOptions, detect_sift, detect_sift_with_progress};
/// use epipole::progress::{Stage, Status};
/// use std::ops::ControlFlow;
/// let image = epipole::imaging::GrayImage32::new(64, 64);
/// let (options, mut last) = (SiftOptions::default(), 0.0);
/// let watched = detect_sift_with_progress(&image, &options, &mut |Status { stage, share }| {
///     assert_eq!(stage, Stage::FeatureDetection);
///     assert!(share >= last && share <= 1.0);
///     last = share;
///     ControlFlow::Continue(())
/// });
/// assert_eq!(watched, detect_sift(&image, &options));
/// let stopped = detect_sift_with_progress(&image, &options, &mut |_| ControlFlow::Break(()));
/// assert_eq!(stopped, Err(epipole::Error::Canceled));
/// ```
pub type Progress<'a> = &'a mut dyn FnMut(Status) -> ControlFlow<()>;
