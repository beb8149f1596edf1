"""OpenCV's FileStorage: cameras and rigs, read by OpenCV and from it."""

import json
import pathlib

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2", reason="OpenCV is not installed: pip install -r tests/requirements.txt")

ROOT = pathlib.Path(__file__).parents[2]
K = np.array([[601.5, 0, 322.25], [0, 605.125, 238.5], [0, 0, 1]])
LENSES = {
    "brown": [-0.2, 0.05, 0.001, -0.002, 0.01],
    "rational": [-0.2, 0.05, 0.001, -0.002, 0.01, 0.02, -0.01, 0.003],
    "fisheye": [-0.02, 0.01, -0.003, 0.0004],
}


def write_yaml(path, entries):
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for key, value in entries.items():
        storage.write(key, value)
    storage.release()


def read_yaml(path, keys):
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    values = [storage.getNode(key) for key in keys]
    values = [node.mat() if node.isMap() else node.real() for node in values]
    storage.release()
    return values


@pytest.mark.parametrize("lens", LENSES)
def test_a_camera_returns(epipole, tmp_path, lens):
    entries = {
        "image_width": 640,
        "image_height": 480,
        "fisheye_model": int(lens == "fisheye"),
        "camera_matrix": K,
        "distortion_coefficients": np.array([LENSES[lens]]),
    }
    write_yaml(tmp_path / "theirs.yml", entries)
    epipole("convert", tmp_path / "theirs.yml", tmp_path / "camera.json")
    camera = json.loads((tmp_path / "camera.json").read_text())
    assert camera["k"] == [K[0, 0], K[1, 1], K[0, 2], K[1, 2]]
    assert camera["distortion"] == {"model": lens, "coefficients": LENSES[lens]}
    epipole("convert", tmp_path / "camera.json", tmp_path / "ours.yml")
    width, height, k, d = read_yaml(
        tmp_path / "ours.yml", ["image_width", "image_height", "camera_matrix", "distortion_coefficients"]
    )
    assert (width, height) == (640, 480)
    assert np.array_equal(k, K) and np.array_equal(d.ravel(), LENSES[lens])


def test_a_rig_returns(epipole, tmp_path):
    rotation, _ = cv2.Rodrigues(np.array([0.02, -0.1, 0.03]))
    translation = np.array([[-0.12], [0.001], [0.002]])
    d = np.array([LENSES["brown"]])
    entries = {"image_width": 640, "image_height": 480}
    entries |= {"M1": K, "D1": d, "M2": K + np.diag([1.0, 2.0, 0.0]), "D2": -d, "R": rotation, "T": translation}
    write_yaml(tmp_path / "theirs.yml", entries)
    epipole("convert", tmp_path / "theirs.yml", tmp_path / "rig.json")
    epipole("convert", tmp_path / "rig.json", tmp_path / "ours.yml")
    keys = ["M1", "D1", "M2", "D2", "R", "T"]
    for key, found in zip(keys, read_yaml(tmp_path / "ours.yml", keys)):
        tolerance = 1e-15 if key == "R" else 0
        assert np.abs(found.reshape(entries[key].shape) - entries[key]).max() <= tolerance, key


def test_the_yaml_of_a_calibrated_rig_is_its_json(epipole, tmp_path):
    board = draw_board()
    poses = [
        ([0.3, 0.1, 0.02], [-0.1, -0.07, 0.62]), ([-0.3, 0.2, -0.1], [-0.12, -0.05, 0.7]),
        ([0.1, -0.4, 0.1], [-0.08, -0.09, 0.6]), ([0.4, 0.3, 0.2], [-0.1, -0.06, 0.65]),
        ([-0.2, -0.3, 0.0], [-0.11, -0.08, 0.66]), ([0.05, 0.45, -0.2], [-0.09, -0.05, 0.72]),
    ]
    sides = {"left": [], "right": []}
    right_from_left = np.eye(4)
    right_from_left[:3, :3] = cv2.Rodrigues(np.array([0.0, 0.03, 0.01]))[0]
    right_from_left[:3, 3] = [-0.05, 0.001, 0.002]
    for index, (turn, place) in enumerate(poses):
        cam_from_board = np.eye(4)
        cam_from_board[:3, :3] = cv2.Rodrigues(np.array(turn))[0]
        cam_from_board[:3, 3] = place
        for side, pose in (("left", cam_from_board), ("right", right_from_left @ cam_from_board)):
            path = tmp_path / f"{side}{index}.png"
            cv2.imwrite(str(path), photograph(board, pose))
            sides[side].append(path)
    calibrate = ["calibrate", *sides["left"], "--right", *sides["right"], "--board", "9x6", "--square-m", "0.025"]
    result = epipole(*calibrate, "-o", tmp_path / "rig.yml")
    epipole(*calibrate, "-o", tmp_path / "rig.json")
    assert abs(result["stereo"]["baseline_m"] - np.linalg.norm(right_from_left[:3, 3])) < 5e-4
    rig = json.loads((tmp_path / "rig.json").read_text())
    keys = ["image_width", "M1", "D1", "M2", "D2", "R", "T"]
    width, m1, d1, m2, d2, rotation, translation = read_yaml(tmp_path / "rig.yml", keys)
    assert width == rig["image"]["width"] == 640
    for m, d, camera in ((m1, d1, rig), (m2, d2, rig["right"])):
        assert [m[0, 0], m[1, 1], m[0, 2], m[1, 2]] == camera["k"]
        assert d.ravel().tolist() == camera["distortion"]["coefficients"]
    motion = rig["stereo"]["right_from_left"]
    assert np.abs(rotation - np.array(motion["rotation"]).reshape(3, 3)).max() < 1e-15
    assert translation.ravel().tolist() == motion["translation"]
    # Ours reads the YAML as the same rig.
    epipole("convert", tmp_path / "rig.yml", tmp_path / "again.json")
    again = json.loads((tmp_path / "again.json").read_text())
    assert (again["k"], again["right"]["k"]) == (rig["k"], rig["right"]["k"])
    assert again["distortion"] == rig["distortion"]


def draw_board():
    """A board of 10 × 7 squares of 40 pixels with a margin of one square."""
    cells = np.indices((7, 10)).sum(axis=0) % 2 == 0
    board = np.full((9, 12), 255, np.uint8)
    board[1:-1, 1:-1][cells] = 0
    return np.kron(board, np.ones((40, 40), np.uint8))


def photograph(board, cam_from_board):
    """The board through a pinhole; its first inner corner is the origin, squares are 25 mm."""
    k = np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]])
    # Pixel (80 − ½, 80 − ½) of the board is its first inner corner.
    meters = np.array([[0.025 / 40, 0, -79.5 * 0.025 / 40], [0, 0.025 / 40, -79.5 * 0.025 / 40], [0, 0, 1]])
    homography = k @ cam_from_board[:3, [0, 1, 3]] @ meters
    # Four times as large, then averaged, so that edges are as a lens gives them.
    larger = np.array([[4, 0, 1.5], [0, 4, 1.5], [0, 0, 1.0]])
    large = cv2.warpPerspective(board, larger @ homography, (2560, 1920), borderValue=255, flags=cv2.INTER_LINEAR)
    return cv2.resize(large, (640, 480), interpolation=cv2.INTER_AREA)
