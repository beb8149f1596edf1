//! Links from each step to the book: an explaining figure, and its chapter.

use super::event::Step;

/// The figure that explains a step, and where the book has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// The figure's name.
    pub figure: &'static str,
    /// The chapter's page, from the folder of the book.
    pub page: &'static str,
    /// The chapter's title.
    pub title: &'static str,
}

impl Step {
    /// The figure that explains the step.
    pub fn explanation(self) -> Explanation {
        let (figure, page, title) = match self {
            Self::Photographs => (
                "same-picture",
                "rays.html",
                "One photo gives directions, not distances",
            ),
            Self::Calibrate => (
                "epipolar-plane",
                "rays.html",
                "One photo gives directions, not distances",
            ),
            Self::Features => (
                "sift-descriptor",
                "matching.html",
                "A fingerprint for each corner",
            ),
            Self::Matches => (
                "ratio-test",
                "matching.html",
                "A fingerprint for each corner",
            ),
            Self::TwoViews => ("epipolar-click", "epipolar.html", "One point, one line"),
            Self::Reconstruction => ("bundle-adjustment", "sfm.html", "Structure from motion"),
            Self::Depth => ("disparity-map", "stereo.html", "Two eyes in a row"),
            Self::Measure => ("scale-ambiguity", "triangulation.html", "Cash in"),
            Self::Export => ("two-view-sfm", "connections.html", "Where this leads"),
        };
        Explanation {
            figure,
            page,
            title,
        }
    }
}
