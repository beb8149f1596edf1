//! Steps of the Lab, with links to their explanations in the book.

/// Step of the Lab, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Step {
    /// The photographs.
    Photographs,
    /// Calibration from photographs of a board.
    Calibrate,
    /// Their features.
    Features,
    /// All pairs.
    Matches,
    /// One pair.
    TwoViews,
    /// Cameras and points.
    Reconstruction,
    /// Every pixel of one pair.
    Depth,
    /// Lengths.
    Measure,
    /// Files.
    Export,
}

impl Step {
    /// All steps, in order.
    pub const ALL: [Self; 9] = [
        Self::Photographs,
        Self::Calibrate,
        Self::Features,
        Self::Matches,
        Self::TwoViews,
        Self::Reconstruction,
        Self::Depth,
        Self::Measure,
        Self::Export,
    ];

    /// Returns its title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Photographs => "Photographs",
            Self::Calibrate => "Calibrate",
            Self::Features => "Features",
            Self::Matches => "Matches",
            Self::TwoViews => "Two views",
            Self::Reconstruction => "Reconstruction",
            Self::Depth => "Depth",
            Self::Measure => "Measure",
            Self::Export => "Export",
        }
    }

    /// Returns its name in an address.
    pub fn name(self) -> String {
        self.title().to_lowercase().replace(' ', "-")
    }

    /// Returns the figure that explains the step.
    pub fn explanation(self) -> Explanation {
        let (figure, page, title) = match self {
            Self::Photographs => (
                "same-picture",
                "rays.html",
                "The pinhole camera: one photo gives directions, not distances",
            ),
            Self::Calibrate => (
                "epipolar-plane",
                "rays.html",
                "The pinhole camera: one photo gives directions, not distances",
            ),
            Self::Features => (
                "sift-descriptor",
                "matching.html",
                "Descriptors and matching: a fingerprint for each corner",
            ),
            Self::Matches => (
                "ratio-test",
                "matching.html",
                "Descriptors and matching: a fingerprint for each corner",
            ),
            Self::TwoViews => (
                "epipolar-click",
                "epipolar.html",
                "Epipolar geometry: one point, one line",
            ),
            Self::Reconstruction => ("bundle-adjustment", "sfm.html", "Structure from motion"),
            Self::Depth => ("disparity-map", "stereo.html", "Stereo: two eyes in a row"),
            Self::Measure => (
                "scale-ambiguity",
                "triangulation.html",
                "Triangulation: cash in your matches",
            ),
            Self::Export => (
                "two-view-sfm",
                "connections.html",
                "Where this leads: SLAM, recent methods, cheat sheet",
            ),
        };
        Explanation {
            figure,
            page,
            title,
        }
    }
}

/// Figure of the book that explains a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// Name of the figure.
    pub figure: &'static str,
    /// Page of the chapter, relative to the book's folder.
    pub page: &'static str,
    /// Title of the chapter.
    pub title: &'static str,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_those_of_the_chapters() {
        for step in Step::ALL {
            let Explanation { page, title, .. } = step.explanation();
            let chapter = page.replace(".html", ".md");
            let path = format!("{}/../../content/{chapter}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(path).unwrap();
            assert_eq!(text.lines().next(), Some(&*format!("# {title}")), "{page}");
        }
    }
}
