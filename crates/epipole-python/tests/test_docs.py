"""The pages of the documentation, and the errors that docstrings name."""

import builtins
import inspect
import os
import pkgutil
import re
import tempfile
import warnings
from pathlib import Path

import epipole
import pytest
from test_doctests import MODULES, public_callables

DOCS = Path(__file__).parents[1] / "docs"
PAGES = DOCS / "pages"
pytestmark = pytest.mark.skipif(
    not DOCS.exists(), reason="the documentation is beside the sources of the package only"
)

# Callables that raise only by the rule in the docstring of the package, by the reason.
BY_RULE = {
    "points, vectors and matrices in, numbers and arrays out": """
        absolute_pose.reprojection_error_px camera.Intrinsics.ray camera.PosedCamera.ray_in_world
        camera.cross_matrix camera.pixel_from_colmap camera.pixel_to_colmap epipolar.enforce_rank2
        epipolar.epipolar_row epipolar.sampson_px epipolar.symmetric_epipolar_px
        epipolar.tangent_sampson_px feature.WindowTensor.change feature.WindowTensor.from_gradients
        homography.homography_from_motion homography.homography_sampson_px
        homography.transfer_error_px imaging.noise_gain math.Line2.nearest
        math.Line2.signed_distance math.length math.svd3 robust.PlaneSimilarity.apply
        sfm.PositionPrior sfm.Reconstruction.project triangulation.triangulation_angle_rad""",
    "minimal solvers return no models for degenerate data": """
        absolute_pose.pose_p3p absolute_pose.pose_p4pf epipolar.essential_5point
        epipolar.essential_6point epipolar.fundamental_7point epipolar.relative_pose_3point
        homography.homography_4point""",
    "images in, images and numbers out": """
        feature.photo_to_gray imaging.IntegralImage imaging.centered_difference imaging.derivative
        imaging.from_laplacian_pyramid imaging.gaussian_pyramid imaging.gray_to_f32
        imaging.gray_to_u8 imaging.laplacian_pyramid imaging.pyramid_down imaging.reduce_rgb
        imaging.rgb_to_gray imaging.rgb_to_gray_f32 imaging.sample_bicubic imaging.sample_bilinear
        imaging.sharpness imaging.sobel stereo.PixelMap stereo.PixelMap.warp""",
    "arguments of matching lengths and sizes": """
        calibration.BoardView calibration.MarkerDictionary feature.Features feature.Keypoints
        feature.ScaleSpace feature.nearest_few io.Model.from_reconstruction io.ModelImage
        io.PreparedPhoto io.Trajectory mvs.DepthMap mvs.MvsView sfm.BalProblem sfm.Bundle
        sfm.PairMatches sfm.Photo sfm.PhotoFeatures sfm.SfmImage stereo.RectifiedPair
        stereo.RectifiedPair.filled stereo.fill_gaps stereo.point_cloud stitch.Overlap
        stitch.Panorama""",
    "results from valid attributes": """
        calibration.Board.drawing calibration.Board.marks calibration.BoardView.visible
        camera.Intrinsics.inverse_matrix camera.Intrinsics.matrix
        camera.PosedCamera.projection_matrix camera.RigidTransform.matrix
        epipolar.PoseWithFocal.constrains_focal epipolar.RelativePose.essential
        epipolar.RelativePose.fundamental feature.ScaleSpace.answers feature.StructureTensor.at
        feature.StructureTensor.eigenvalues imaging.Gradient.magnitude
        imaging.Gradient.orientation io.Model.cloud io.PreparedPhoto.camera
        robust.PlaneSimilarity.matrix sfm.Similarity3.matrix stereo.PixelMap.mask
        synthetic.MultiViewProblem.tracks""",
}
SECTIONS = ["Parameters", "Returns", "Raises", "Notes", "References", "Examples"]


def pages_with_cells():
    return [
        page
        for page in sorted(PAGES.glob("*.md"))
        if "\n```python" in page.read_text(encoding="utf-8")
    ]


@pytest.mark.parametrize("page", pages_with_cells(), ids=lambda page: page.stem)
def test_code_of_a_page(page, tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib", reason="the pages draw with matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    monkeypatch.syspath_prepend(DOCS)
    from cells import split

    monkeypatch.setattr(tempfile, "tempdir", os.fspath(tmp_path))
    namespace = {"__name__": "__main__"}
    parts = split(page.read_text(encoding="utf-8"))
    cells = [part.code for part in parts if not isinstance(part, str)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for n, code in enumerate(cells):
            exec(compile(code, f"{page.name}, cell {n + 1}", "exec"), namespace)
    pyplot.close("all")


def modules():
    found = [module.name for module in pkgutil.iter_modules(epipole.__path__)]
    native = [
        name for name, value in vars(epipole._epipole).items() if type(value) is type(epipole)
    ]
    return sorted({name for name in found + native if not name.startswith("_")})


@pytest.mark.parametrize("name", modules())
def test_a_module_has_its_page(name):
    page = PAGES / "reference" / f"{name}.md"
    assert f"::: epipole.{name}\n" in page.read_text(encoding="utf-8")
    assert f"reference/{name}.md\n" in (DOCS / "mkdocs.yml").read_text(encoding="utf-8")
    assert f"({name}.md)" in (PAGES / "reference" / "index.md").read_text(encoding="utf-8")


def test_pages_are_in_the_navigation():
    navigation = (DOCS / "mkdocs.yml").read_text(encoding="utf-8")
    for page in PAGES.rglob("*.md"):
        assert f": {page.relative_to(PAGES).as_posix()}\n" in navigation


def sections(docstring):
    """Sections in NumPy's style, in their order."""
    parts = re.split(r"^(\w+)\n-{3,}\n", inspect.cleandoc(docstring or ""), flags=re.M)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def raised(docstring):
    """Classes under `Raises`, with their descriptions."""
    text = sections(docstring).get("Raises", "")
    found = re.findall(r"^(\S.*)\n((?:    .+\n*)*)", f"{text}\n", re.M)
    return [(error, " ".join(description.split())) for error, description in found]


def fallible():
    """Functions of the Rust source that return a `PyResult`: room, owner or None, name."""
    pattern = r"^ *impl (?:\w+ for )?(\S+) \{$|^(\})|^ *(?:pub\S* )?fn (\w+)[^{]*?\) -> (\w+)"
    found = set()
    for file in (DOCS.parent / "src").rglob("*.rs"):
        room, owner = file.relative_to(DOCS.parent / "src").parts[0].removesuffix(".rs"), None
        for match in re.finditer(pattern, file.read_text(encoding="utf-8"), re.M):
            if match[3] is None:
                owner = match[1]
            elif match[4] == "PyResult":
                found.add((room, owner, match[3]))
    return found


def callables():
    """Names, docstrings, and whether the binding in Rust is fallible."""
    found = fallible()
    for module in MODULES:
        room = "threads" if module is epipole._epipole else module.__name__.rpartition(".")[2]
        for name, value in public_callables(module):
            owner, _, last = name.rpartition(".")
            keys = {(room, owner or None, last), (room, owner and "$class", last)}
            if isinstance(value, type):
                keys = {(room, name, "new")}
            yield f"{room}.{name}", value.__doc__, not found.isdisjoint(keys)


def without_errors(arguments):
    """Fallible callables that name no class with a description, but for those by rule."""
    by_rule = " ".join(BY_RULE.values()).split()
    return [
        name
        for name, docstring, is_fallible in arguments
        if is_fallible
        and name not in by_rule
        and not (raised(docstring) and all(text for _, text in raised(docstring)))
    ]


def test_docstrings_name_their_errors():
    assert without_errors(callables()) == []


def test_a_missing_error_is_found():
    end = "\n\nNotes\n-----\nNone."
    whole = f"Sum.\n\nRaises\n------\nepipole.TooFewError\n    Fewer than 2.{end}"
    assert raised(whole) == [("epipole.TooFewError", "Fewer than 2.")]
    assert without_errors([("math.sum", whole, True), ("math.sum", None, False)]) == []
    for docstring in (whole.replace("    Fewer than 2.", ""), f"Sum.{end}", None):
        assert without_errors([("math.sum", docstring, True)]) == ["math.sum"]


def test_errors_that_docstrings_name_exist():
    for name, docstring, _ in callables():
        for error, text in raised(docstring):
            home, _, last = error.rpartition(".")
            found = getattr({"": builtins, "epipole": epipole}[home], last)
            assert issubclass(found, Exception), f"{name}: {error}"
            assert re.fullmatch(r"[A-Z`].*\.", text), f"{name}: {text}"
        order = [section for section in sections(docstring) if section in SECTIONS]
        assert order == sorted(order, key=SECTIONS.index), name


def test_callables_by_rule_are_fallible_and_name_no_error():
    found = {name: docstring for name, docstring, is_fallible in callables() if is_fallible}
    for name in " ".join(BY_RULE.values()).split():
        assert name in found, f"{name} is not fallible"
        assert not raised(found[name]), f"{name} names errors"
