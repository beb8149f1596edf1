//! Progress and cancellation of long computations.

use crate::{Error, Result};
use std::ops::ControlFlow;

/// Stage of a long computation. Each function documents its stages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// Detection and description of keypoints.
    FeatureDetection,
    /// Comparison of descriptors.
    FeatureMatching,
    /// Geometric verification of the matches of pairs.
    PairVerification,
    /// Registration of images in a reconstruction, or of frames in a path, one after the other.
    Registration,
    /// Joint refinement of cameras and points.
    BundleAdjustment,
    /// Joint refinement of the poses of a graph.
    PoseGraph,
    /// Drawing of samples, and scoring of their models.
    RobustEstimation,
    /// Dense matching of the rows of a rectified pair.
    DenseMatching,
    /// Refinement of intrinsics, distortion and the poses of boards.
    Calibration,
    /// Refinement of the parameters of a least-squares problem.
    Refinement,
    /// Blending of photos into one image.
    Blending,
    /// Estimation of depths and normals from many views.
    DepthEstimation,
    /// Fusion of depth maps to a point cloud or mesh.
    Fusion,
    /// Filtering of an image.
    Filtering,
    /// Warping of an image.
    Warping,
    /// Tracking of points from one image to the next.
    Tracking,
    /// Rendering of a known scene.
    Rendering,
}

impl Stage {
    /// Returns the stage in words, for display before a percentage: "matching features", 40 %.
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
            Self::Registration => "registering images",
            Self::BundleAdjustment => "refining cameras and points",
            Self::PoseGraph => "refining poses",
            Self::RobustEstimation => "drawing samples",
            Self::DenseMatching => "matching along the rows",
            Self::Calibration => "fitting the lens",
            Self::Refinement => "refining",
            Self::Blending => "blending",
            Self::DepthEstimation => "estimating depths",
            Self::Fusion => "fusing depth maps",
            Self::Filtering => "filtering",
            Self::Warping => "warping",
            Self::Tracking => "following points",
            Self::Rendering => "rendering",
        }
    }
}

/// State of a long computation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Status {
    /// Current stage.
    pub stage: Stage,
    /// Completed fraction of the whole work, over all stages, in [0, 1].
    pub fraction: f32,
}

/// Observer of a long computation, which can cancel it.
///
/// Every function that can take longer than 0.1 s for an image of 12 megapixels or for 30 000
/// features takes a `&mut dyn Monitor` as its last argument. `&mut ()` runs to the end without
/// reports; a closure receives each [`Status`] and can return [`ControlFlow::Break`], so that the
/// function returns [`Error::Canceled`].
///
/// Reports are made on the caller's thread. The fraction never decreases.
///
/// ```
/// use epipole::progress::{Monitor, Part, Stage, Status, report};
/// use std::ops::ControlFlow;
/// fn two_halves(monitor: &mut dyn Monitor) -> epipole::Result<()> {
///     for half in 0..2 {
///         report(monitor, Stage::Calibration, 0.5 * half as f32)?;
///     }
///     Ok(())
/// }
/// assert_eq!(two_halves(&mut ()), Ok(()));
///
/// let mut fractions = Vec::new();
/// let mut watch = |status: Status| {
///     fractions.push(status.fraction);
///     ControlFlow::Continue(())
/// };
/// two_halves(&mut Part::new(&mut watch, 0.5, 1.0))?;
/// assert_eq!(fractions, [0.5, 0.75]);
///
/// let canceled = two_halves(&mut |_| ControlFlow::Break(()));
/// assert_eq!(canceled, Err(epipole::Error::Canceled));
/// # Ok::<(), epipole::Error>(())
/// ```
pub trait Monitor {
    /// Receives the current stage and the fraction of the work; [`ControlFlow::Break`] cancels it.
    fn report(&mut self, status: Status) -> ControlFlow<()>;
}

/// Ignores progress and never cancels.
impl Monitor for () {
    fn report(&mut self, _: Status) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(Status) -> ControlFlow<()>> Monitor for F {
    fn report(&mut self, status: Status) -> ControlFlow<()> {
        self(status)
    }
}

/// Reports `stage` and `fraction`, the completed part of the whole work in [0, 1], to `monitor`.
///
/// # Errors
/// [`Error::Canceled`] if the monitor cancels.
pub fn report(monitor: &mut dyn Monitor, stage: Stage, fraction: f32) -> Result<()> {
    match monitor.report(Status { stage, fraction }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Canceled),
    }
}

/// Monitor of one part of a longer computation: maps the fraction of the part, 0 to 1, to the range
/// `from` to `to` of the whole.
///
/// See [`Monitor`] for an example.
pub struct Part<'a> {
    monitor: &'a mut dyn Monitor,
    from: f32,
    to: f32,
    stage: Option<Stage>,
}

impl<'a> Part<'a> {
    /// Passes reports of the part to `monitor` with their stage.
    pub fn new(monitor: &'a mut dyn Monitor, from: f32, to: f32) -> Self {
        Self {
            monitor,
            from,
            to,
            stage: None,
        }
    }

    /// Passes reports with the stage `stage`, whatever the stages of the part.
    #[must_use]
    pub fn of_stage(mut self, stage: Stage) -> Self {
        self.stage = Some(stage);
        self
    }
}

impl Monitor for Part<'_> {
    fn report(&mut self, status: Status) -> ControlFlow<()> {
        self.monitor.report(Status {
            stage: self.stage.unwrap_or(status.stage),
            fraction: self.from + (self.to - self.from) * status.fraction,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_nest_and_pass_cancellation_on() {
        let mut reports = Vec::new();
        let mut watch = |status: Status| {
            reports.push(status);
            match reports.len() {
                2 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        };
        let mut half = Part::new(&mut watch, 0.5, 1.0).of_stage(Stage::Registration);
        let mut quarter = Part::new(&mut half, 0.0, 0.5);
        assert_eq!(report(&mut quarter, Stage::PoseGraph, 0.0), Ok(()));
        let end = report(&mut quarter, Stage::PoseGraph, 1.0);
        assert_eq!(end, Err(Error::Canceled));
        let stage = Stage::Registration;
        let expected = [0.5, 0.75].map(|fraction| Status { stage, fraction });
        assert_eq!(reports, expected);
    }
}
