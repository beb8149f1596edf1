//! Every public name of the library is in the npm package, or left out for a reason.

use super::names::{camel_case, public_names, rooms};
use std::path::Path;

/// Names that are not in JavaScript, by the reason.
const LEFT_OUT: &[(&str, &str)] = &[
    (
        "a lens is its kind and coefficients",
        "camera::Distortion camera::Division camera::Fisheye camera::LensKind
         camera::RationalDistortion",
    ),
    (
        "arrays, and fields of plain objects",
        "calibration::BoardView feature::Keypoint feature::Match feature::Track
         imaging::GrayImage32 math::Line2 robust::Trial sfm::BundleObservation sfm::Edge sfm::Graph
         sfm::PoseGraph sfm::PosePrior sfm::Photo sfm::ScenePoint sfm::SfmInput sfm::TrackElement
         stereo::DisparityImage synthetic::Sighting",
    ),
    (
        "strings, and unions of plain objects",
        "calibration::Keep calibration::MarkerDictionary calibration::Pattern
         feature::CornerMeasure feature::FeatureKind feature::Scaling feature::SiftNormalization
         feature::Window imaging::Border imaging::DerivativeFilter imaging::Interpolation
         optim::RobustLoss optim::Termination robust::Budget robust::SamplerKind robust::ScoreKind
         robust::StopReason robust::ThresholdKind sfm::AlignmentKind sfm::Gauge sfm::LoopMotion
         sfm::WhyUnregistered stereo::StereoCost stereo::StereoPaths stereo::StereoPrefilter
         stitch::Blend stitch::Surface synthetic::Path two_view::Configuration
         two_view::TwoViewModel",
    ),
    ("the two epipoles are one object", "epipolar::Epipole"),
    (
        "a search that JavaScript watches by `progress` and ends by `signal`",
        "robust::Ransac robust::Step sfm::IncrementalReconstruction sfm::Odometry",
    ),
    (
        "arguments are functions, which do not cross to WebAssembly in a worker",
        "absolute_pose::AbsolutePoseEstimator epipolar::EssentialEstimator
         epipolar::FundamentalEstimator epipolar::GravityEstimator homography::HomographyEstimator
         optim::DenseProblem optim::EdgeTerms optim::check_jacobian optim::minimize_dense
         robust::Data robust::Estimator robust::Evidence robust::LineEstimator robust::MatchSet
         robust::Problem robust::SimilarityEstimator robust::Support robust::Unique robust::ransac
         sfm::GraphPose two_view::RotationEstimator",
    ),
    (
        "`leastMedianLine` runs it",
        "robust::LeastMedian robust::least_median",
    ),
    (
        "fields of a report",
        "robust::log10_false_alarms robust::FARTHEST_PX",
    ),
    ("defaults of the options", "two_view::PHOTO_MAX_ERROR_PX"),
    (
        "a line of JavaScript",
        "camera::cross_matrix camera::pixel_from_colmap camera::pixel_to_colmap math::length
         imaging::noise_gain imaging::gray_from_values imaging::gray_to_f32 imaging::gray_to_u8",
    ),
    (
        "functions of images take colors; `photoToGray` converts them",
        "imaging::BT601_WEIGHTS imaging::BT709_WEIGHTS imaging::rgb_to_gray
         imaging::rgb_to_gray_f32",
    ),
    ("a canvas downscales photos", "imaging::reduce_rgb"),
    (
        "`boxFilter`, `correlate`, `gaussianBlur`, `gaussianDerivative` and `remap` run them",
        "imaging::IntegralImage imaging::gaussian_derivative_kernels imaging::gaussian_kernel
         imaging::sample_bicubic imaging::sample_bilinear imaging::separable_filter",
    ),
    (
        "`nearestTwo` and `matchDescriptors` search descriptors",
        "feature::nearest_few",
    ),
    (
        "steps of an algorithm that figures show",
        "feature::ScaleOctave feature::ScaleSpace feature::StructureTensor feature::scale_space
         feature::sift_directions feature::sift_orientation_histograms feature::structure_tensor
         stereo::PATH_STEPS stereo::PathCosts stereo::PixelCosts",
    ),
    (
        "steps inside the eight-point method and the refinement",
        "camera::Observation epipolar::Normalization math::Svd3 math::right_singular_vectors
         math::svd3",
    ),
    (
        "a file of a benchmark, which a page does not read; `adjustBundle` takes cameras and points",
        "sfm::BalCamera sfm::BalProblem sfm::adjust_bal",
    ),
    ("`rectifyImages` gives both", "stereo::RectifiedPair"),
    (
        "objects of another name: `FoundBoard`, `LmIteration`",
        "calibration::BoardSearch optim::Iteration",
    ),
    (
        "arrays have any length",
        "triangulation::triangulate_dlt_all",
    ),
];

fn left_out() -> Vec<&'static str> {
    let lists = LEFT_OUT.iter().map(|(_, names)| *names);
    lists.flat_map(str::split_whitespace).collect()
}

/// Declarations of the npm package; the published crate comes without them.
fn declarations() -> Option<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::fs::read_to_string(root.join("web/vision/src/api.ts")).ok()
}

/// Whether a function or a type has its place among the declarations.
fn is_bound(declarations: &str, name: &str) -> bool {
    let name = match name.starts_with(|first: char| first.is_ascii_uppercase()) {
        true => name.to_owned(),
        false => camel_case(name),
    };
    let heads = [
        format!("\n  {name}: ["),
        format!("\nexport interface {name} "),
        format!("\nexport interface {name}<"),
        format!("\nexport type {name} "),
    ];
    heads.iter().any(|head| declarations.contains(head))
}

#[test]
fn every_public_name_is_in_javascript_or_left_out() {
    let Some(declarations) = declarations() else {
        return;
    };
    let left_out = left_out();
    let mut missing = Vec::new();
    for room in rooms() {
        for name in public_names(&room) {
            let path = format!("{room}::{name}");
            if !is_bound(&declarations, &name) && !left_out.contains(&&*path) {
                missing.push(path);
            }
        }
    }
    assert!(
        missing.is_empty(),
        "neither bound in epipole-js nor left out for a reason: {}",
        missing.join(" ")
    );
}

#[test]
fn names_left_out_are_public_and_not_in_javascript() {
    let Some(declarations) = declarations() else {
        return;
    };
    for path in left_out() {
        let (room, name) = path.split_once("::").expect("a path of two parts");
        let is_public = public_names(room).contains(&name.to_owned());
        assert!(is_public, "{path} is not in the library");
        let is_bound = is_bound(&declarations, name);
        assert!(
            !is_bound,
            "{path} is bound, but in the list of those left out"
        );
    }
}

#[test]
fn the_test_would_notice_a_name_that_is_missing() {
    let text = "\n  sampsonPx: [\nexport interface RansacReport<M> {\nexport interface Board {";
    for name in ["sampson_px", "RansacReport", "Board"] {
        assert!(is_bound(text, name), "{name}");
    }
    for name in ["sampson", "Boards", "M"] {
        assert!(!is_bound(text, name), "{name}");
    }
    assert!(rooms().contains(&"stitch".to_owned()));
}
