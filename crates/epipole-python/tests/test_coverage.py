"""Every public name of the library has its place in Python, or a reason why not."""

import re
from pathlib import Path

import epipole
import epipole.options
import pytest

REPOSITORY = Path(__file__).parents[3]
SOURCE = REPOSITORY / "crates" / "epipole" / "src"

# Names that are not in Python, by the reason.
LEFT_OUT = {
    "arrays have any length": "triangulation::triangulate_dlt_all",
    "Lens takes a kind and coefficients": """
        camera::Distortion camera::Division camera::Fisheye camera::LensKind
        camera::RationalDistortion""",
    "columns of arrays": """
        feature::Descriptors feature::Keypoint feature::Match feature::Track imaging::GrayImage32
        imaging::gray_from_values sfm::BalCamera sfm::BundleObservation sfm::Edge sfm::Graph
        sfm::RelativeRotation sfm::ScenePoint sfm::TrackElement stereo::DisparityImage
        synthetic::Sighting""",
    "strings, dicts, numbers and attributes of results": """
        calibration::Keep calibration::Pattern epipolar::Epipole feature::CornerMeasure
        feature::FeatureKind feature::Scaling feature::SiftNormalization feature::Window
        imaging::Border imaging::DerivativeFilter imaging::Interpolation optim::RobustLoss
        optim::Termination sfm::AlignmentKind sfm::Gauge sfm::LoopMotion stereo::StereoCost
        stereo::StereoPaths stereo::StereoPrefilter stitch::Blend stitch::Surface synthetic::Path
        robust::Budget robust::SamplerKind robust::ScoreKind robust::StopReason
        robust::ThresholdKind two_view::Configuration two_view::TwoViewModel""",
    "traits and parts of Rust estimators; in Python, ransac and Ransac take callables": """
        absolute_pose::AbsolutePoseEstimator epipolar::EssentialEstimator
        epipolar::FundamentalEstimator epipolar::GravityEstimator homography::HomographyEstimator
        robust::Data robust::Estimator robust::Evidence robust::MatchSet
        robust::Problem robust::SimilarityEstimator robust::Step robust::Support robust::Unique two_view::RotationEstimator optim::DenseProblem
        optim::EdgeTerms sfm::GraphPose""",
    "robust.estimate_line runs it": "robust::LineEstimator",
    "numpy.linalg.svd does the same": "math::right_singular_vectors",
    "steps of an algorithm that figures show": """
        feature::sift_orientation_histograms stereo::PATH_STEPS stereo::PathCosts
        stereo::PixelCosts""",
    "a pose graph read from a file keeps its priors": "sfm::PosePrior",
    "steps inside the eight-point method and the refinement": """
        camera::Observation epipolar::Normalization""",
}


def rooms():
    """Rooms of the library, whose `mod.rs` exports names."""
    declared = re.findall(r"^pub mod (\w+);", (SOURCE / "lib.rs").read_text("utf-8"), re.M)
    return [room for room in declared if (SOURCE / room / "mod.rs").exists()]


def public_names(room):
    """Names that `pub use` exports from a room."""
    text = re.sub(r"//.*", "", (SOURCE / room / "mod.rs").read_text("utf-8"))
    names = []
    for declaration in re.findall(r"^pub use ([^;]+);", text, re.M):
        # The part before the last `::` is the path.
        names += re.findall(r"\w+", declaration.rsplit("::", 1)[-1])
    return names


def is_in_python(room, name):
    """Options are keywords, and their types are in `epipole.options`."""
    return hasattr(getattr(epipole, room, None), name) or hasattr(epipole.options, name)


@pytest.fixture(autouse=True)
def in_the_repository():
    if not SOURCE.exists():
        pytest.skip("there is no source of the library")


def test_every_public_name_is_in_python_or_left_out():
    left_out = " ".join(LEFT_OUT.values()).split()
    missing = [
        f"{room}::{name}"
        for room in rooms()
        for name in public_names(room)
        if not is_in_python(room, name) and f"{room}::{name}" not in left_out
    ]
    assert not missing, f"neither bound nor left out for a reason: {' '.join(missing)}"


def test_names_left_out_are_public_and_not_in_python():
    for path in " ".join(LEFT_OUT.values()).split():
        room, name = path.split("::")
        assert name in public_names(room), f"{path} is not in the library"
        assert not is_in_python(room, name), f"{path} is bound, but in the list of those left out"


def test_the_reader_finds_names():
    assert {"sampson_px", "epipolar_line2", "EightPoint"} <= set(public_names("epipolar"))
    assert "have_same_center" not in public_names("epipolar")
    assert {"camera", "two_view"} <= set(rooms())


def test_names_of_the_guide_are_in_python():
    left_out = " ".join(LEFT_OUT.values()).split()
    page = (REPOSITORY / "docs" / "names.md").read_text("utf-8")
    # The last column of tables, and the text.
    ours = "\n".join(re.split(r"(?<= )\| ", line)[-1] for line in page.splitlines())
    paths = re.findall(r"`(\w+)::(\w+)`", ours)
    assert len(paths) > 60
    for room, name in paths:
        path = f"{room}::{name}"
        assert path in left_out or is_in_python(room, name), f"docs/names.md names {path}"


def test_functions_of_the_formulas_are_in_python():
    formulas = (REPOSITORY / "content" / "formulas.toml").read_text("utf-8")
    paths = re.findall(r'^function = "(\w+)::(\w+)"$', formulas, re.MULTILINE)
    assert len(paths) > 35
    for room, name in paths:
        assert is_in_python(room, name), f"content/formulas.toml names {room}::{name}"


def test_functions_of_the_formulas_are_in_opencv():
    cv2 = pytest.importorskip("cv2")
    formulas = (REPOSITORY / "content" / "formulas.toml").read_text("utf-8")
    names = re.findall(r'^opencv = "(.+)"$', formulas, re.MULTILINE)
    assert len(names) > 25
    for name in names:
        function, *flags = re.findall(r"[\w.]+", name)
        parent, _, method = function.partition(".")
        assert all(hasattr(cv2, flag) for flag in flags), name
        assert hasattr(getattr(cv2, parent), method or "__name__"), name
