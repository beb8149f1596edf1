"""Cameras and poses of other libraries: round trips, and equal pixels on both sides."""

import numpy as np
import pytest
from epipole import Camera, Intrinsics, Lens, RigidTransform, convert

K = Intrinsics(500.0, 510.0, 320.0, 240.0)
LENSES = {
    "none": None,
    "brown": Lens("brown", [-0.2, 0.05, 1e-3, -2e-3, 0.0]),
    "brown with k3": Lens("brown", [-0.2, 0.05, 1e-3, -2e-3, 0.01]),
    "rational": Lens("rational", [0.3, 0.02, 0.0, 1e-3, 0.0, 0.6, 0.1, 0.0]),
    "fisheye": Lens("fisheye", [-0.02, 8e-3, -4e-3, 6e-4]),
}
POINTS = np.random.default_rng(3).uniform(-0.4, 0.4, (20, 3)) + [0, 0, 1]
POSE = RigidTransform.from_quaternion([0.8, 0.36, -0.48, 0.0], [1.0, -2.0, 3.0])


def camera(name):
    return Camera(640, 480, K, LENSES[name])


@pytest.mark.parametrize("name", LENSES)
def test_opencv_projects_to_the_same_pixels(name):
    cv2 = pytest.importorskip("cv2")
    matrix, coefficients = convert.to_opencv(camera(name))
    if name == "fisheye":
        pixels, _ = cv2.fisheye.projectPoints(
            POINTS[:, None], np.zeros(3), np.zeros(3), matrix, coefficients
        )
    else:
        pixels, _ = cv2.projectPoints(POINTS, np.zeros(3), np.zeros(3), matrix, coefficients)
    assert np.allclose(pixels.reshape(-1, 2), camera(name).project(POINTS), atol=1e-9)
    back = convert.from_opencv(matrix, coefficients, 640, 480, fisheye=name == "fisheye")
    assert np.allclose(back.project(POINTS), camera(name).project(POINTS), atol=1e-12)


def test_short_coefficients_of_opencv_are_filled_up():
    made = convert.from_opencv(K.matrix(), [-0.2, 0.05, 0, 0], 640, 480)
    assert made.lens.coefficients == [-0.2, 0.05, 0, 0, 0]
    assert convert.from_opencv(K.matrix(), None, 640, 480).is_pinhole()


@pytest.mark.parametrize(
    ("coefficients", "options", "sentence"),
    [
        ([0.1, 0, 0, 0, 0, 0, 0, 0, 0.2], {}, "thin-prism"),
        ([0.1] * 5, {"fisheye": True}, "4 coefficients"),
        ([np.nan] * 4, {}, "finite"),
    ],
)
def test_coefficients_without_a_lens_are_refused(coefficients, options, sentence):
    with pytest.raises(ValueError, match=sentence):
        convert.from_opencv(K.matrix(), coefficients, 640, 480, **options)


def test_key_points_go_to_opencv_and_back():
    pytest.importorskip("cv2")
    pixels = np.array([[1.5, 2.25], [100.0, 7.0]])
    assert np.array_equal(convert.points_from_opencv(convert.points_to_opencv(pixels)), pixels)
    assert convert.points_from_opencv([]).shape == (0, 2)


@pytest.mark.parametrize("name", LENSES)
def test_colmap_projects_to_pixels_half_a_pixel_on(name):
    pytest.importorskip("pycolmap")
    other = convert.to_pycolmap(camera(name))
    pixels = other.img_from_cam(POINTS)
    assert np.allclose(pixels - 0.5, camera(name).project(POINTS), atol=1e-9)
    back = convert.from_pycolmap(other)
    assert np.allclose(back.project(POINTS), camera(name).project(POINTS), atol=1e-9)


def test_poses_of_colmap():
    pytest.importorskip("pycolmap")
    other = convert.to_pycolmap(POSE)
    assert np.allclose(other.matrix(), POSE.matrix()[:3], atol=1e-12)
    assert np.allclose(convert.from_pycolmap(other).matrix(), POSE.matrix(), atol=1e-12)


@pytest.mark.parametrize("name", LENSES)
def test_cameras_of_poselib(name):
    back = convert.from_poselib(convert.to_poselib(camera(name)))
    assert np.allclose(back.project(POINTS), camera(name).project(POINTS), atol=1e-9)


def test_poses_of_poselib():
    pytest.importorskip("poselib")
    other = convert.to_poselib(POSE)
    assert np.allclose(other.Rt, POSE.matrix()[:3], atol=1e-12)
    assert np.allclose(convert.from_poselib(other).matrix(), POSE.matrix(), atol=1e-12)


def test_a_division_lens_is_refused():
    made = Camera(640, 480, K, Lens("division", [-0.2]))
    pytest.importorskip("pycolmap")
    for go in (convert.to_opencv, convert.to_pycolmap, convert.to_poselib):
        with pytest.raises(ValueError, match="division"):
            go(made)


def test_models_without_an_equal_are_refused():
    with pytest.raises(ValueError, match="FOV"):
        convert.from_poselib({"model": "FOV", "width": 1, "height": 1, "params": [1] * 5})
