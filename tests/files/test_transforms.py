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
