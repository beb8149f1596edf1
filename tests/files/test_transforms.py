"""transforms.json against the poses that it was made from, by nerfstudio's conventions."""

import json

import numpy as np
import pytest
from conftest import NAMES, quaternion, rotation

# OpenCV's camera looks along z with y down, nerfstudio's along −z with y up.
FLIP = np.diag([1.0, -1.0, -1.0])


def write_colmap(folder, turns, places, names=NAMES, digits=17):
    """COLMAP's text files of one camera."""
    folder.mkdir()
    (folder / "cameras.txt").write_text("1 OPENCV 640 480 700.25 698.5 321.5 239.125 -0.11 0.03 0.001 -0.002\n")
    lines = []
    for index, (name, (x, y, z, w), place) in enumerate(zip(names, turns, places)):
        turn = " ".join(f"{value:.{digits}g}" for value in (w, x, y, z))
        lines.append(f"{index + 1} {turn} {' '.join(map(str, place))} 1 {name}\n\n")
    (folder / "images.txt").write_text("".join(lines))
    (folder / "points3D.txt").write_text("1 1 2 3 10 20 30 0.5\n")


def check_frames(path, turns, places, tolerance, names=NAMES):
    document = json.loads(path.read_text())
    camera = {key: document[key] for key in ("camera_model", "w", "h", "fl_x", "fl_y", "cx", "cy")}
    assert camera == dict(camera_model="OPENCV", w=640, h=480, fl_x=700.25, fl_y=698.5, cx=321.5, cy=239.125)
    assert [document[key] for key in ("k1", "k2", "p1", "p2")] == [-0.11, 0.03, 0.001, -0.002]
    assert [frame["file_path"] for frame in document["frames"]] == list(names)
    for frame, turn, place in zip(document["frames"], turns, places):
        cam_from_world = rotation(*turn)
        matrix = np.array(frame["transform_matrix"])
        assert np.array_equal(matrix[3], [0, 0, 0, 1])
        assert np.abs(matrix[:3, :3] - cam_from_world.T @ FLIP).max() < tolerance
        assert np.abs(matrix[:3, 3] + cam_from_world.T @ place).max() < 10 * tolerance
        assert np.abs(matrix[:3, :3].T @ matrix[:3, :3] - np.eye(3)).max() < 1e-14


# Quaternions of few digits are not of length 1; their rotation is that of the normalized one.
@pytest.mark.parametrize("digits", [17, 9, 5, 3])
def test_poses_are_those_of_the_model(epipole, tmp_path, digits):
    random = np.random.default_rng(8)
    turns = [quaternion(random) for _ in NAMES]
    turns = np.array([[float(f"{value:.{digits}g}") for value in turn] for turn in turns])
    places = np.round(random.normal(size=(len(NAMES), 3)), 3)
    write_colmap(tmp_path / "colmap", turns, places, digits=digits)
    epipole("convert", tmp_path / "colmap", tmp_path / "transforms.json")
    check_frames(tmp_path / "transforms.json", turns, places, 1e-14)
    # From COLMAP's files to ours, to transforms.json and back.
    epipole("convert", tmp_path / "transforms.json", tmp_path / "back", "--to", "colmap-text")
    epipole("convert", tmp_path / "back", tmp_path / "again.json", "--to", "transforms")
    again = tmp_path / "again.json"
    check_frames(again / "transforms.json" if again.is_dir() else again, turns, places, 1e-13)


def test_frames_of_instant_ngp_are_read(epipole, tmp_path):
    random = np.random.default_rng(9)
    turn, center = quaternion(random), random.normal(size=3)
    world_from_cam = rotation(*turn).T
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = world_from_cam @ FLIP, center
    frame = {"file_path": "./images/a b.png", "transform_matrix": matrix.tolist()}
    document = {"camera_angle_x": 0.9, "w": 640, "h": 480, "frames": [frame]}
    (tmp_path / "transforms.json").write_text(json.dumps(document))
    epipole("convert", tmp_path / "transforms.json", tmp_path / "path.txt", "--to", "kitti")
    pose = np.loadtxt(tmp_path / "path.txt").reshape(3, 4)
    assert np.abs(pose[:, :3] - world_from_cam).max() < 1e-14
    assert np.abs(pose[:, 3] - center).max() < 1e-14
    epipole("convert", tmp_path / "transforms.json", tmp_path / "camera.json")
    k = json.loads((tmp_path / "camera.json").read_text())["k"]
    assert np.allclose(k, [320 / np.tan(0.45), 320 / np.tan(0.45), 319.5, 239.5], rtol=0, atol=1e-10)


def loaded_by_nerfstudio(path):
    """The rays that nerfstudio 1.1.5 sees through pixels, by its loader `nerfstudio_dataparser.py` and its
    `cameras.py`, which `test_nerfstudio.py` asks where they are installed: keys of the file before those of frames, frames sorted by name, one
    camera model for all, and from OpenCV's camera to one that looks along −z with y up.

    Returns file names, and a function from a frame and pixels with centers at halves to centers and directions."""
    cv2 = pytest.importorskip("cv2", reason="OpenCV is not installed: pip install -r tests/requirements.txt")
    meta = json.loads(path.read_text())
    frames = sorted(meta["frames"], key=lambda frame: path.parent / frame["file_path"])
    is_fisheye = {"PERSPECTIVE": False, "PINHOLE": False, "OPENCV": False, "OPENCV_FISHEYE": True}[
        meta.get("camera_model", "PERSPECTIVE")
    ]
    lens_of_file = any(key in meta for key in ["k1", "k2", "k3", "p1", "p2", "distortion_params"])

    def rays(index, pixels):
        frame = frames[index]
        number = lambda key: float(meta[key] if key in meta else frame[key])
        k1, k2, k3, k4, p1, p2 = ((meta if lens_of_file else frame).get(k, 0.0) for k in "k1 k2 k3 k4 p1 p2".split())
        matrix = np.array([[number("fl_x"), 0, number("cx")], [0, number("fl_y"), number("cy")], [0, 0, 1]])
        pixels = np.asarray(pixels, float)[:, None]
        if is_fisheye:
            x, y = cv2.fisheye.undistortPoints(pixels, matrix, np.array([k1, k2, k3, k4]))[:, 0].T
        else:
            assert k4 == 0
            stop = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-15)
            lens = np.array([k1, k2, p1, p2, k3])
            x, y = cv2.undistortPoints(pixels, matrix, lens, criteria=stop)[:, 0].T
        world_from_cam = np.array(frame["transform_matrix"], float)
        directions = np.column_stack([x, -y, -np.ones_like(x)]) @ world_from_cam[:3, :3].T
        return world_from_cam[:3, 3], directions / np.linalg.norm(directions, axis=1)[:, None]

    return [frame["file_path"] for frame in frames], rays


BROWN = ("OPENCV", [700.25, 698.5, 321.5, 239.125, -0.11, 0.03, 0.001, -0.002])
K3 = ("FULL_OPENCV", [700.25, 698.5, 321.5, 239.125, -0.11, 0.03, 0.001, -0.002, 0.004, 0, 0, 0])
FISHEYE = ("OPENCV_FISHEYE", [400.25, 398.5, 321.5, 239.125, -0.02, 0.01, -0.003, 0.0004])
WIDE = ("OPENCV_FISHEYE", [300.25, 298.5, 311.5, 229.125, -0.01, 0.01, -0.002, 0.0003])


@pytest.mark.parametrize("cameras", [[BROWN], [K3], [FISHEYE], [BROWN, K3], [FISHEYE, WIDE]])
def test_nerfstudio_sees_the_rays_of_colmap(epipole, tmp_path, cameras):
    pycolmap = pytest.importorskip("pycolmap", reason="pycolmap is not installed: pip install -r tests/requirements.txt")
    random = np.random.default_rng(7)
    truth = pycolmap.Reconstruction()
    for index, (name, params) in enumerate(cameras):
        camera = pycolmap.Camera(model=name, width=640, height=480, params=params, camera_id=index + 1)
        truth.add_camera_with_trivial_rig(camera)
    for index, name in enumerate(NAMES):
        image = pycolmap.Image(name=name, camera_id=index % len(cameras) + 1, image_id=index + 1)
        pose = pycolmap.Rigid3d(pycolmap.Rotation3d(quaternion(random)), random.normal(size=3))
        truth.add_image_with_trivial_frame(image, pose)
    truth.write_binary(tmp_path)
    result = epipole("convert", tmp_path, tmp_path / "transforms.json")
    assert result["notes"] == []
    names, rays = loaded_by_nerfstudio(tmp_path / "transforms.json")
    assert names == sorted(NAMES)
    images = {image.name: image for image in truth.images.values()}
    pixels = random.uniform([100, 100], [540, 380], (20, 2))
    for index, name in enumerate(names):
        image = images[name]
        world_from_cam = image.cam_from_world().inverse()
        flat = image.camera.cam_from_img(pixels)
        directions = np.column_stack([flat, np.ones(len(flat))]) @ world_from_cam.rotation.matrix().T
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        center, found = rays(index, pixels)
        assert np.abs(center - world_from_cam.translation).max() < 1e-13
        assert np.abs(found - directions).max() < 1e-8


def test_two_camera_models_are_told(epipole, tmp_path):
    lines = ["1 OPENCV 640 480 700 700 320 240 -0.1 0 0 0", "2 OPENCV_FISHEYE 640 480 400 400 320 240 0.01 0 0 0"]
    (tmp_path / "cameras.txt").write_text("\n".join(lines) + "\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 0 1 a.jpg\n\n2 1 0 0 0 0 0 1 2 b.jpg\n\n")
    result = epipole("convert", tmp_path, tmp_path / "transforms.json")
    assert any("one camera model for all images" in note for note in result["notes"]), result
