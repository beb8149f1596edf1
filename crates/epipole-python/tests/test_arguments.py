"""Arrays of every kind, and the messages for those that do not fit."""

import numpy as np
import pytest

import epipole
from conftest import make_world
from epipole import epipolar

SHAPE = r"pixels1 must be an array of shape \(N, 2\)"


@pytest.mark.parametrize(
    "change",
    [
        np.asfortranarray,
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: a[::-1][::-1],
        lambda a: a.astype(">f8"),
        lambda a: a.tolist(),
        lambda a: [tuple(row) for row in a],
        lambda a: np.frombuffer(a.tobytes()).reshape(a.shape),
        lambda a: np.frombuffer(b"x" + a.tobytes(), offset=1).reshape(a.shape),
        lambda a: a.view(type("Subclass", (np.ndarray,), {})),
    ],
)
def test_layouts(world, change):
    expected = epipolar.fundamental_8point(world.pixels1, world.pixels2)
    found = epipolar.fundamental_8point(change(world.pixels1), change(world.pixels2))
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("dtype", ["float16", "float32", "int32", "int64", "uint16", "longdouble"])
def test_dtypes(world, dtype):
    pixels = world.pixels1.astype(dtype)
    found = epipole.sampson_px(world.fundamental, pixels, world.pixels2)
    expected = epipole.sampson_px(world.fundamental, pixels.astype(float), world.pixels2)
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize(
    ("pixels1", "error", "message"),
    [
        (np.zeros((3, 5)), ValueError, SHAPE + r", but has shape \(3, 5\)"),
        (np.zeros(8), ValueError, r"but has shape \(8,\)"),
        (3.0, ValueError, r"pixels1 .* has shape \(\)"),
        ([], ValueError, r"pixels1 .* has shape \(0,\)"),
        ([[1, 2], [3]], ValueError, "pixels1 must be an array of shape"),
        ([[1, 2], [3, np.nan]], ValueError, "pixels1 contains NaN in row 1"),
        (np.zeros((9, 2), object), TypeError, "pixels1 .* real numbers.* object"),
        (np.zeros((9, 2), complex), TypeError, "pixels1 .* complex128"),
        (np.zeros((9, 2), bool), TypeError, "pixels1 .* bool"),
        ([["a", "b"]], TypeError, "pixels1"),
        (None, TypeError, "pixels1"),
    ],
)
def test_bad_points_are_named(world, pixels1, error, message):
    with pytest.raises(error, match=message):
        epipole.estimate_fundamental(pixels1, world.pixels2)


def test_other_bad_shapes(world):
    with pytest.raises(ValueError, match=r"pixels2 must be an array of shape \(7, 2\)"):
        epipolar.fundamental_7point(world.pixels1[:7], world.pixels2[:8])
    with pytest.raises(ValueError, match=r"fundamental must be an array of shape \(3, 3\)"):
        epipole.sampson_px(np.eye(4), world.pixels1, world.pixels2)
    with pytest.raises(ValueError, match="pixel1 and pixel2 must have the same number"):
        epipole.sampson_px(np.eye(3), world.pixels1, world.pixels2[1:])
    with pytest.raises(ValueError, match="same size"):
        epipole.estimate_fundamental(world.pixels1, world.pixels2[1:])
    with pytest.raises(TypeError, match="camera1"):
        epipole.estimate_essential(world.pixels1, world.pixels2, world.k, world.camera)


def test_empty_arrays(world):
    empty = np.zeros((0, 2))
    assert epipole.sampson_px(world.fundamental, empty, empty).shape == (0,)
    assert epipolar.epipolar_line1(world.fundamental, empty).shape == (0, 3)
    with pytest.raises(epipole.TooFewError, match="there are none"):
        epipole.estimate_fundamental(empty, empty)
    same = np.ones((9, 2))
    with pytest.raises(epipole.TooFewError, match="at least 7 that differ, but the 9 given are equal"):
        epipole.estimate_fundamental(same, same)


def test_errors_have_one_base(world):
    assert issubclass(epipole.NoConsensusError, epipole.Error)
    assert not issubclass(epipole.Error, ValueError)
    with pytest.raises(epipole.Error):
        epipolar.fundamental_8point(world.pixels1[:8], np.zeros((8, 2)))


def test_options(world, outliers):
    arguments = {"score": "inlier_count", "max_iterations": np.int32(7)}
    report = epipole.estimate_fundamental(*outliers, **arguments)
    assert report.iterations == 7 and report.stop == "exhausted"
    for bad, error, message in [
        ({"max_eror_px": 1}, TypeError, "unknown option max_eror_px.*max_error_px.*confidence"),
        ({"max_error_px": "a"}, TypeError, "option max_error_px"),
        ({"sampler": "best"}, TypeError, "option sampler.*prosac"),
        ({"max_error_px": -1}, ValueError, "must be greater than 0"),
        ({"confidence": 2}, ValueError, "confidence must be"),
        ({"seed": -1}, ValueError, "option seed is out of range"),
    ]:
        with pytest.raises(error, match=message):
            epipole.estimate_fundamental(*outliers, **bad)


def test_nested_options(outliers):
    report = epipole.estimate_two_view(*outliers, ransac={"max_error_px": 0.25}, min_num_inliers=20)
    assert report.max_error_px == 0.25
    with pytest.raises(TypeError, match=r"unknown option ransac\.sed"):
        epipole.estimate_two_view(*outliers, ransac={"sed": 0.25})


@pytest.mark.parametrize("count", [1023, 1024, 1025, 30_000])
def test_long_arrays_are_computed_as_single_points(count):
    """Blocks of rows: fast functions read them where they are, slow ones copies of them."""
    world = make_world(count)
    p1, p2 = (camera.projection_matrix() for camera in world.posed)
    some = np.r_[0:3, count // 2, count - 3 : count]
    lines = epipolar.epipolar_line2(world.fundamental, world.pixels1)
    points = epipole.triangulate_dlt(p1, p2, world.pixels1, world.pixels2)
    errors = epipole.sampson_px(world.fundamental, world.pixels1, world.pixels2)
    for i in some:
        one, two = world.pixels1[i], world.pixels2[i]
        np.testing.assert_array_equal(lines[i], epipolar.epipolar_line2(world.fundamental, one))
        np.testing.assert_array_equal(points[i], epipole.triangulate_dlt(p1, p2, one, two))
        assert errors[i] == epipole.sampson_px(world.fundamental, one, two)
    bad = world.pixels1.copy()
    bad[-1, 1] = np.nan
    for call in (
        lambda: epipole.triangulate_dlt(p1, p2, bad, world.pixels2),
        lambda: epipole.sampson_px(world.fundamental, bad, world.pixels2),
    ):
        with pytest.raises(ValueError, match=f"pixel1 contains NaN in row {count - 1}"):
            call()
