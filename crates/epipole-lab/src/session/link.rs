//! Conversion of step, sample and settings to and from parameters of an address:
//! `step=matches&ratio=0.8`.

use super::event::Event;
use crate::project::{
    BoardPattern, DepthMethod, FeatureKind, LensModel, Project, RefineFocal, Sample, Settings,
    Source, Step,
};

/// A setting in an address: its name, a function that writes it, and one that sets it and returns
/// false for an invalid value.
struct Parameter {
    name: &'static str,
    write: fn(&Settings) -> String,
    read: fn(&mut Settings, &str) -> bool,
}

/// Numbers are clamped to their range, as by a slider.
macro_rules! number {
    ($name:literal, $($field:tt).+) => {
        Parameter {
            name: $name,
            write: |settings| settings.$($field).+.to_string(),
            read: |settings, value| put(&mut settings.$($field).+, value),
        }
    };
}

/// Toggles are 0 or 1.
macro_rules! toggle {
    ($name:literal, $($field:tt).+) => {
        Parameter {
            name: $name,
            write: |settings| u8::from(settings.$($field).+).to_string(),
            read: |settings, value| {
                settings.$($field).+ = value == "1";
                value == "0" || value == "1"
            },
        }
    };
}

/// Declares a setting with named values.
macro_rules! choice {
    ($name:literal, $($field:tt).+, $names:expr) => {
        Parameter {
            name: $name,
            write: |settings| {
                let now = settings.$($field).+;
                let name = $names.into_iter().find(|(_, value)| *value == now);
                name.map_or_else(String::new, |(name, _)| name.to_owned())
            },
            read: |settings, written| match $names.into_iter().find(|(name, _)| *name == written) {
                Some((_, value)) => {
                    settings.$($field).+ = value;
                    true
                }
                None => false,
            },
        }
    };
}

const REFINE: [(&str, RefineFocal); 3] = [
    ("guessed", RefineFocal::WhenGuessed),
    ("always", RefineFocal::Always),
    ("never", RefineFocal::Never),
];

const KINDS: [(&str, FeatureKind); 2] = [
    ("root-sift", FeatureKind::RootSift),
    ("sift", FeatureKind::Sift),
];

const PARAMETERS: [Parameter; 21] = [
    number!("megapixels", max_megapixels),
    number!("frames", num_frames),
    choice!("descriptor", features.kind, KINDS),
    number!("max-features", features.max_features),
    number!("contrast", features.contrast),
    number!("ratio", matching.ratio),
    toggle!("mutual", matching.mutual),
    number!("max-error", pairs.max_error_px),
    number!("pair-seed", pairs.seed),
    number!("min-inliers", sfm.min_num_inliers),
    choice!("refine-focal", refine_focal, REFINE),
    toggle!("refine-distortion", sfm.refine_distortion),
    number!("seed", sfm.seed),
    choice!("depth-method", depth.method, METHODS),
    toggle!("fill", depth.fill),
    number!("all-views-megapixels", all_views.max_megapixels),
    Parameter {
        name: "disparities",
        write: |settings| match settings.depth.range_px {
            Some([low, high]) => format!("{low}-{high}"),
            None => "proposed".to_owned(),
        },
        read: |settings, written| {
            settings.depth.range_px = range(written);
            settings.depth.range_px.is_some() || written == "proposed"
        },
    },
    choice!("pattern", calibration.board.pattern, PATTERNS),
    Parameter {
        name: "board",
        write: |settings| {
            let board = settings.calibration.board;
            format!("{}x{}", board.columns, board.rows)
        },
        read: |settings, written| {
            let sides = written.split_once('x');
            let sides = sides.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
            let board = &mut settings.calibration.board;
            sides.is_some_and(|sides| {
                (board.columns, board.rows) = sides;
                true
            })
        },
    },
    number!("square-m", calibration.square_m),
    choice!("lens", calibration.lens, LENSES),
];

const PATTERNS: [(&str, BoardPattern); 2] = [
    ("chessboard", BoardPattern::Chessboard),
    ("circles", BoardPattern::Circles),
];

const LENSES: [(&str, LensModel); 3] = [
    ("brown", LensModel::Brown),
    ("rational", LensModel::Rational),
    ("fisheye", LensModel::Fisheye),
];

const METHODS: [(&str, DepthMethod); 2] =
    [("sgm", DepthMethod::SemiGlobal), ("bm", DepthMethod::Block)];

const SAMPLES: [(&str, Sample); 7] = [
    ("table", Sample::Table),
    ("turned", Sample::Turned),
    ("alone", Sample::Alone),
    ("twice", Sample::Twice),
    ("plane", Sample::Plane),
    ("mixed", Sample::Mixed),
    ("upright", Sample::Upright),
];

/// Parses two integers, as in "12-90".
fn range(written: &str) -> Option<[i32; 2]> {
    let (low, high) = written.split_once('-')?;
    Some([low.parse().ok()?, high.parse().ok()?])
}

/// Parses a number and sets it. False if it is invalid or not finite.
fn put<T: std::str::FromStr + PartialEq + Copy>(place: &mut T, written: &str) -> bool {
    let finite = written.parse::<f64>().is_ok_and(f64::is_finite);
    match written.parse() {
        Ok(value) if finite => {
            *place = value;
            true
        }
        _ => false,
    }
}

impl Project {
    /// Applies the step, the sample and the settings of an address. Returns a message for each
    /// parameter that is unknown or has an invalid value.
    pub fn open_link(&mut self, parameters: &[(String, String)]) -> Vec<String> {
        let mut problems = Vec::new();
        let mut settings = self.document.settings.clone();
        let mut step = None;
        for (name, value) in parameters {
            let known = |names: Vec<String>| {
                format!(
                    "{name} has no value \"{value}\", only {}.",
                    names.join(", ")
                )
            };
            if name == "step" {
                step = Step::ALL.into_iter().find(|step| step.name() == *value);
                if step.is_none() {
                    problems.push(known(Step::ALL.map(Step::name).into()));
                }
            } else if name == "sample" {
                match SAMPLES.iter().find(|(sample, _)| sample == value) {
                    Some((_, sample)) => self.update(Event::OpenSample(*sample)),
                    None => problems.push(known(SAMPLES.map(|(name, _)| name.to_owned()).into())),
                }
            } else if let Some(parameter) =
                PARAMETERS.iter().find(|parameter| parameter.name == name)
            {
                let before = settings.clone();
                if !(parameter.read)(&mut settings, value) {
                    settings = before;
                    problems.push(format!("{name} cannot be \"{value}\"."));
                }
            } else {
                problems.push(format!("The Lab knows no \"{name}\"."));
            }
        }
        if settings.clone().checked() != self.document.settings {
            self.update(Event::Set(settings));
        }
        if let Some(step) = step {
            self.update(Event::Show(step));
        }
        problems
    }

    /// Returns the parameters that restore the step, the sample and every setting that differs from
    /// its default. Photographs of the reader cannot be part of an address.
    pub fn link(&self) -> String {
        let mut parameters = vec![format!("step={}", self.view.step.name())];
        let first = self.document.photos.first();
        if let Some(Source::Rendered(sample, _)) = first.map(|photo| &photo.source)
            && *sample != Sample::Table
            && let Some((name, _)) = SAMPLES.iter().find(|(_, other)| other == sample)
        {
            parameters.push(format!("sample={name}"));
        }
        let (now, beginning) = (&self.document.settings, Settings::default());
        for parameter in &PARAMETERS {
            let value = (parameter.write)(now);
            if value != (parameter.write)(&beginning) {
                parameters.push(format!("{}={value}", parameter.name));
            }
        }
        parameters.join("&")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(link: &str) -> Vec<(String, String)> {
        let pairs = link.split('&').filter_map(|pair| pair.split_once('='));
        pairs
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect()
    }

    #[test]
    fn a_link_opens_a_step_with_its_settings() {
        let mut project = Project::default();
        let problems = project.open_link(&parameters("step=two-views&ratio=0.7&mutual=0&seed=3"));
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!(project.view.step, Step::TwoViews);
        let settings = &project.document.settings;
        assert_eq!(
            (settings.matching.ratio, settings.matching.mutual),
            (0.7, false)
        );
        assert_eq!(settings.sfm.seed, 3);
        // A single event, so that one undo reverts it.
        project.update(Event::Undo);
        assert_eq!(project.document.settings, Settings::default());
    }

    #[test]
    fn what_is_not_known_is_told_and_the_rest_is_shown() {
        let mut project = Project::default();
        let link = "step=nowhere&disparities=3&bogus=1&board=9&ratio=NaN&mutual=2&refine-focal=x&contrast=0.01&ratio=9";
        let problems = project.open_link(&parameters(link));
        assert_eq!(problems.len(), 7, "{problems:?}");
        assert!(problems[0].contains("two-views"), "{problems:?}");
        assert!(problems[2].contains("bogus"), "{problems:?}");
        let settings = &project.document.settings;
        assert_eq!(settings.features.contrast, 0.01);
        assert_eq!(settings.matching.ratio, 1.0, "the nearest end of its range");
        assert!(settings.matching.mutual);
        assert_eq!(settings.refine_focal, RefineFocal::WhenGuessed);
    }

    #[test]
    fn every_setting_comes_back_from_the_link_that_is_written() {
        let other = Settings {
            max_megapixels: 1.5,
            num_frames: 31,
            refine_focal: RefineFocal::Never,
            features: crate::project::FeatureOptions {
                kind: FeatureKind::Sift,
                max_features: 500,
                contrast: 0.013,
            },
            matching: crate::project::MatchOptions {
                ratio: 0.71,
                mutual: false,
            },
            pairs: crate::project::PairOptions {
                max_error_px: 2.25,
                seed: 4,
            },
            sfm: crate::project::SfmOptions {
                min_num_inliers: 20,
                refine_focal: false,
                refine_distortion: true,
                correct_lens: false,
                seed: 6,
            },
            depth: crate::project::DepthOptions {
                method: DepthMethod::Block,
                fill: true,
                range_px: Some([12, 90]),
            },
            all_views: crate::project::AllViewsOptions {
                max_megapixels: 0.75,
            },
            calibration: crate::project::CalibrationOptions {
                board: crate::project::BoardOptions {
                    pattern: BoardPattern::Circles,
                    columns: 4,
                    rows: 11,
                },
                square_m: 0.0173,
                lens: LensModel::Fisheye,
            },
        };
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Turned));
        project.update(Event::Set(other.clone()));
        project.update(Event::Show(Step::Measure));
        let mut again = Project::default();
        assert_eq!(
            again.open_link(&parameters(&project.link())),
            Vec::<String>::new()
        );
        assert_eq!(again.document.settings, other.checked());
        assert_eq!(again.view.step, Step::Measure);
        assert_eq!(again.link(), project.link());
        assert_eq!(again.document.photos.len(), 4);
    }
}
