"""Boards, markers, calibration and undistortion, against truth and OpenCV."""

import copy
import pickle

import numpy as np
import pytest
from conftest import rotation

import epipole
from epipole import calibration
from epipole.calibration import Board, BoardView, calibrate, calibrate_rig, find_board

ROTATIONS = [(0.5, 0, 0.1), (-0.5, 0.1, 0), (0, 0.5, 0), (0.1, -0.5, 0.2), (0.3, 0.3, -0.1)]
K = np.array([[600.0, 0, 322], [0, 605.0, 238], [0, 0, 1]])
BROWN = [-0.2, 0.05, 0.001, -0.0005, 0.0]


def pose(rotation_vector, shift=(-0.09, -0.06, 0.4)):
    rotation_vector = np.asarray(rotation_vector, float)
    return epipole.RigidTransform(rotation(rotation_vector, np.linalg.norm(rotation_vector)), shift)


def board_points(board):
    return np.column_stack([board.marks(), np.zeros(board.num_marks)])


@pytest.fixture
def board():
    return Board("chessboard", 7, 5, 0.03)


@pytest.fixture
def camera():
    intrinsics = epipole.Intrinsics.from_matrix(K)
    return epipole.Camera(640, 480, intrinsics, epipole.Lens("brown", BROWN))


def observe(board, camera, pose, noise=0.0, seed=0):
    pixels = camera.project(pose @ board_points(board))
    return BoardView(pixels + noise * np.random.default_rng(seed).normal(size=pixels.shape))


@pytest.fixture
def views(board, camera):
    return [observe(board, camera, pose(rotation_vector), 0.1, seed) for seed, rotation_vector in enumerate(ROTATIONS)]


def test_boards():
    board = Board("chessboard", 9, 6, 0.025)
    assert (board.columns, board.rows, board.num_marks, board.square_m) == (9, 6, 54, 0.025)
    np.testing.assert_allclose(board.mark(10), (0.025, 0.025))
    assert board.marks().shape == (54, 2)
    charuco = Board({"charuco": {"dictionary": "Aruco4x4_50", "marker_ratio": 0.75}}, 7, 5, 0.03)
    assert (charuco.columns, charuco.rows) == (7, 5)
    assert (charuco.mark_columns, charuco.mark_rows) == (6, 4)
    assert charuco.pattern["charuco"]["marker_ratio"] == 0.75
    drawing = Board("chessboard", 3, 3, 0.02).drawing()
    assert drawing.rectangles.shape == (8, 2, 2)
    assert Board("circles", 4, 4, 0.02).drawing().disks.shape == (16, 2)


def test_calibration_finds_the_truth(board, camera, views):
    found = calibrate(board, [views[0], None, *views[1:]], (640, 480))
    assert found.rms_px < 0.2
    np.testing.assert_allclose(found.camera.intrinsics.matrix(), K, atol=2)
    assert found.views[1] is None and len(found.views) == 6
    assert found.views[0].num_marks == 35
    rotated = found.views[0].cam_from_board.rotation
    np.testing.assert_allclose(rotated, pose(ROTATIONS[0]).rotation, atol=0.01)
    assert found.std_dev_k.shape == (4,) and found.std_dev_lens.shape == (5,)
    assert all(isinstance(warning.message, str) for warning in found.warnings)


def test_calibration_as_opencv(board, views):
    cv2 = pytest.importorskip("cv2")
    points = [board_points(board).astype(np.float32)] * len(views)
    pixels = [view.pixels.astype(np.float32)[:, None] for view in views]
    rms, k, distortion, _, _ = cv2.calibrateCamera(points, pixels, (640, 480), None, None)
    found = calibrate(board, views, (640, 480))
    assert found.rms_px == pytest.approx(rms, rel=1e-3)
    np.testing.assert_allclose(found.camera.intrinsics.matrix(), k, rtol=1e-3)
    np.testing.assert_allclose(
        found.camera.lens.coefficients[:2], distortion.ravel()[:2], atol=5e-2
    )


def test_rig(board, camera):
    right_from_left = epipole.RigidTransform(rotation([0, 1, 0], 0.02), [-0.1, 0, 0.01])
    poses = [pose(rotation_vector) for rotation_vector in ROTATIONS]
    left = [observe(board, camera, pose) for pose in poses]
    right = [observe(board, camera, right_from_left @ pose) for pose in poses]
    rig = calibrate_rig(board, (camera, camera), left, right)
    np.testing.assert_allclose(rig.right_from_left.translation, [-0.1, 0, 0.01], atol=1e-6)
    assert rig.baseline_m == pytest.approx(np.hypot(0.1, 0.01), abs=1e-6)
    assert len(rig.pairs_rms_px) == 5 and rig.std_dev_translation_m.shape == (3,)


def test_intrinsics_from_planes():
    columns = [np.column_stack([r[:, 0], r[:, 1], [0.1, 0.2, 3]]) for r in
               (rotation(rotation_vector, np.linalg.norm(rotation_vector)) for rotation_vector in ROTATIONS)]
    found = calibration.intrinsics_from_planes([K @ plane for plane in columns])
    np.testing.assert_allclose(found.matrix(), K, atol=1e-5)
    with pytest.raises(ValueError, match=r"pixels_from_plane\[1\]"):
        calibration.intrinsics_from_planes([K, K[:2], K])


def test_find_board(board, camera):
    flat = pose((0.1, 0.2, 0.05), (-0.09, -0.06, 0.35))
    photo = calibration.render_board(board, camera, flat, noise=0.01)
    assert photo.shape == (480, 640) and photo.dtype == np.float32
    search = find_board(photo, board)
    assert search.kind == "found" and search.problem(board) is None
    truth = observe(board, camera, flat).pixels
    # The board may be found half a turn round.
    error = min(np.abs(search.view.pixels - t).max() for t in (truth, truth[::-1]))
    assert error < 0.2
    marks, pixels = search.view.visible()
    assert len(marks) == search.view.num_visible() == 35 and pixels.shape == (35, 2)
    nothing = find_board(np.full((100, 100), 128, np.uint8), board)
    assert nothing.kind == "nothing" and nothing.view is None
    assert "no board" in nothing.problem(board)


def test_find_board_as_opencv(board, camera):
    cv2 = pytest.importorskip("cv2")
    flat = pose((0.1, 0.2, 0.05), (-0.09, -0.06, 0.35))
    photo = calibration.render_board(board, camera, flat)
    photo = (photo * 255).astype(np.uint8)
    is_found, corners = cv2.findChessboardCornersSB(photo, (7, 5))
    assert is_found
    ours = find_board(photo, board).view.pixels
    theirs = corners.reshape(-1, 2)
    assert min(np.abs(ours - t).max() for t in (theirs, theirs[::-1])) < 0.25


def test_markers_as_opencv():
    cv2 = pytest.importorskip("cv2")
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    photo = np.full((200, 400), 255, np.uint8)
    photo[50:146, 40:136] = cv2.aruco.generateImageMarker(dictionary, 7, 96)
    photo[50:146, 240:336] = cv2.aruco.generateImageMarker(dictionary, 23, 96)
    found = calibration.detect_markers(photo, "4x4_50")
    assert [(marker.id, marker.hamming) for marker in found] == [(7, 0), (23, 0)]
    expected = np.array([(39.5, 49.5), (135.5, 49.5), (135.5, 145.5), (39.5, 145.5)])
    np.testing.assert_allclose(found[0].corners, expected, atol=0.2)
    assert calibration.detect_markers(photo, "Aruco4x4_50") == found
    kind = calibration.MarkerDictionary("36h11")
    assert (kind.name, kind.num_markers, kind.num_bits) == ("36h11", 587, 6)
    assert len(kind.all()) == 17 and isinstance(kind.is_white(0, 0, 0), bool)
    with pytest.raises(IndexError):
        kind.is_white(587, 0, 0)


def test_undistortion_as_opencv(camera):
    cv2 = pytest.importorskip("cv2")
    flat = calibration.Undistortion(camera, "all")
    new = flat.intrinsics.matrix()
    maps = cv2.initUndistortRectifyMap(K, np.array(BROWN), None, new, (640, 480), cv2.CV_32FC1)
    sources = flat.map.sources
    known = ~np.isnan(sources[..., 0])
    assert known.mean() > 0.9
    np.testing.assert_allclose(sources[known], np.dstack(maps)[known], atol=0.01)
    photo = np.random.default_rng(1).integers(0, 255, (480, 640), dtype=np.uint8)
    assert flat.map.warp(photo).shape == (480, 640)
    assert calibration.Undistortion(camera).valid.u_max == 639
    assert flat.keep == "all"


def test_wrong_arguments_are_named(board, camera, views):
    with pytest.raises(TypeError, match="pattern"):
        Board("checkers", 7, 5, 0.03)
    with pytest.raises(ValueError, match="board's columns"):
        Board("chessboard", 2, 5, 0.03)
    with pytest.raises(IndexError, match="35"):
        board.mark(35)
    with pytest.raises(ValueError, match=r"pixels must be .* \(N, 2\)"):
        BoardView(np.zeros((4, 3)))
    with pytest.raises(ValueError, match="image"):
        find_board(np.zeros((10, 10, 3), np.uint8), board)
    with pytest.raises(TypeError, match="dictionary"):
        calibration.detect_markers(np.zeros((10, 10), np.uint8), "5x4")
    with pytest.raises(TypeError, match="unknown option lense"):
        calibrate(board, views, (640, 480), lense="fisheye")
    with pytest.raises(TypeError, match="keep"):
        calibration.Undistortion(camera, "some")
    with pytest.raises(epipole.TooFewError):
        calibrate(board, views[:1], (640, 480))
    with pytest.raises(ValueError, match="marks"):
        calibrate(Board("chessboard", 8, 5, 0.03), views, (640, 480))


def test_pickles_are_equal(board, camera, views):
    hidden = views[0].pixels
    hidden[3] = np.nan
    photo = calibration.render_board(board, camera, pose((0.1, 0, 0)))
    for value in (
        board,
        Board({"april_grid": {"spacing": 0.25}}, 6, 6, 0.08),
        board.drawing(),
        BoardView(hidden),
        find_board(photo, board),
        calibrate(board, views, (640, 480)),
        calibrate_rig(board, (camera, camera), views, views),
        calibration.MarkerDictionary("4x4_50"),
        calibration.Undistortion(camera),
    ):
        for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
            assert again == value and type(again) is type(value)
        assert value != 3
        assert repr(value).startswith(type(value).__name__)


def test_progress_and_cancellation(board, camera, views):
    reports = []
    calibrate(board, views, (640, 480), progress=lambda *status: reports.append(status))
    assert reports[0][0] == "fitting the lens"

    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        calibrate(board, views, (640, 480), progress=stop)
