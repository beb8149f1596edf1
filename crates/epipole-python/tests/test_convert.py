"""Cameras, poses and clouds of other libraries: round trips, and equal pixels on both sides."""

import numpy as np
import pytest
from epipole import Camera, Intrinsics, Lens, PosedCamera, RigidTransform, convert
from epipole.sfm import Reconstruction
from epipole.stereo import PointCloud

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


def test_cameras_of_open3d():
    open3d = pytest.importorskip("open3d")
    other = convert.to_open3d(camera("none"))
    assert isinstance(other, open3d.camera.PinholeCameraIntrinsic)
    assert convert.from_open3d(other) == camera("none")
    with pytest.raises(ValueError, match="brown lens"):
        convert.to_open3d(camera("brown"))
    # Open3D's own projection: a depth image with one pixel gives the point that is seen there.
    depth = np.zeros((480, 640), np.float32)
    depth[100, 200] = 2.0
    cloud = open3d.geometry.PointCloud.create_from_depth_image(
        open3d.geometry.Image(depth), other, depth_scale=1.0, depth_trunc=10.0
    )
    assert np.allclose(camera("none").project(np.asarray(cloud.points)), [[200, 100]], atol=1e-5)


def test_posed_cameras_of_open3d():
    pytest.importorskip("open3d")
    posed = PosedCamera(camera("none"), POSE)
    other = convert.to_open3d(posed)
    assert np.allclose(other.extrinsic, POSE.matrix(), atol=1e-12)
    back = convert.from_open3d(other)
    assert np.allclose(back.project(POINTS), posed.project(POINTS), atol=1e-9)


@pytest.mark.parametrize("colors", [None, np.arange(60, dtype=np.uint8).reshape(20, 3) * 4])
def test_clouds_of_open3d(colors):
    open3d = pytest.importorskip("open3d")
    cloud = PointCloud(POINTS, colors)
    other = convert.to_open3d(cloud)
    assert isinstance(other, open3d.geometry.PointCloud)
    assert np.array_equal(np.asarray(other.points), POINTS)
    assert convert.from_open3d(other) == cloud
    empty = convert.from_open3d(open3d.geometry.PointCloud())
    assert empty.points.shape == (0, 3) and empty.colors is None


def test_a_reconstruction_goes_to_open3d():
    pytest.importorskip("open3d")
    made = Reconstruction([PosedCamera(camera("none"), POSE)], POINTS, np.zeros((0, 3), int))
    other = convert.to_open3d(made)
    assert np.array_equal(np.asarray(other.points), POINTS)
    assert np.allclose(np.asarray(other.colors) * 255, made.colors)


def test_other_classes_of_open3d_are_refused():
    open3d = pytest.importorskip("open3d")
    with pytest.raises(TypeError, match="RigidTransform"):
        convert.to_open3d(POSE)
    with pytest.raises(TypeError, match="TriangleMesh"):
        convert.from_open3d(open3d.geometry.TriangleMesh())
