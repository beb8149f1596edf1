"""Dense disparity, depth, point clouds, rectification."""

import copy
import pickle

import numpy as np
import pytest

import epipole
from epipole import imaging, stereo

SHIFT = 9


def texture(seed=11, size=(160, 120)):
    """Random gray values, blurred a little: matchers interpolate between pixels."""
    width, height = size
    noise = np.random.default_rng(seed).random((height, width), np.float32)
    smooth = imaging.gaussian_blur(noise, 1.0)
    return imaging.gray_to_u8((smooth - smooth.min()) / np.ptp(smooth))


@pytest.fixture
def pair():
    """A texture, and the same moved 9 pixels to the left."""
    wide = texture()
    return np.ascontiguousarray(wide[:, :-SHIFT]), np.ascontiguousarray(wide[:, SHIFT:])


@pytest.fixture
def camera():
    return epipole.Camera.pinhole(epipole.Intrinsics.centered(200.0, 160, 120), 160, 120)


def rig(camera, angle=0.05, shift=(-0.1, 0.01, 0.005), **options):
    c, s = np.cos(angle), np.sin(angle)
    motion = epipole.RigidTransform([[c, 0, s], [0, 1, 0], [-s, 0, c]], shift)
    return stereo.rectify_calibrated(camera, camera, motion, **options), motion


@pytest.mark.parametrize("matcher", [stereo.StereoSgm, stereo.StereoBm])
def test_shifted_texture(pair, matcher):
    left, right = pair
    disparity = matcher(num_disparities=32).compute(left, right)
    assert disparity.dtype == np.float32 and disparity.shape == left.shape
    known = ~np.isnan(disparity)
    assert known[10:-10, 45:-10].mean() > 0.95
    assert (np.abs(disparity[known] - SHIFT) < 0.5).mean() > 0.98
    assert np.median(disparity[known]) == pytest.approx(SHIFT, abs=0.05)
    # The left border has no match.
    assert np.isnan(disparity[:, 0]).all()


def test_layouts_and_dtypes(pair):
    sgm = stereo.StereoSgm(num_disparities=16)
    left, right = pair
    expected = sgm.compute(left, right)
    left.flags.writeable = False
    np.testing.assert_array_equal(sgm.compute(np.asfortranarray(left), right), expected)
    np.testing.assert_array_equal(sgm.compute(left[::-1][::-1], right), expected)
    floats = sgm.compute(left / 255, right / np.float32(255))
    np.testing.assert_array_equal(floats, expected)
    # Any range.
    np.testing.assert_array_equal(sgm.compute(left * 16.0 + 3, right * 16.0 + 3), expected)


def test_matchers_are_their_options():
    sgm = stereo.StereoSgm(num_disparities=48, paths="four", filter={"speckle_size": 7})
    assert sgm.num_disparities == 48 and sgm.paths == "four"
    assert sgm.filter["speckle_size"] == 7
    assert sgm.filter["uniqueness_percent"] == stereo.StereoSgm().filter["uniqueness_percent"]
    assert "num_disparities" in dir(sgm) and "compute" in dir(sgm)
    for again in (pickle.loads(pickle.dumps(sgm)), copy.copy(sgm), copy.deepcopy(sgm)):
        assert again == sgm
    assert sgm != stereo.StereoSgm() and sgm != stereo.StereoBm()
    assert repr(sgm).startswith("StereoSgm(min_disparity_px=0, num_disparities=48, ")
    with pytest.raises(AttributeError, match="StereoBm has no attribute paths"):
        print(stereo.StereoBm().paths)
    with pytest.raises(AttributeError):
        sgm.paths = "five"


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (
            lambda i: stereo.StereoSgm(blocksize=3),
            TypeError,
            "unknown option blocksize.*num_disparities",
        ),
        (
            lambda i: stereo.StereoSgm(filter={"speckles": 3}),
            TypeError,
            "unknown option filter.speckles",
        ),
        (lambda i: stereo.StereoSgm(paths="nine"), TypeError, "option paths"),
        (
            lambda i: stereo.StereoBm(num_disparities=-1),
            ValueError,
            "num_disparities is out of range",
        ),
        (lambda i: stereo.StereoBm(num_disparities=0).compute(i, i), ValueError, "disparities"),
        (
            lambda i: stereo.StereoSgm().compute(i, i / 255),
            TypeError,
            "left and right must be both",
        ),
        (lambda i: stereo.StereoSgm().compute(i, i[1:]), ValueError, "size"),
        (
            lambda i: stereo.StereoSgm().compute(i, i.astype(np.uint16)),
            TypeError,
            "right .* uint16",
        ),
        (lambda i: stereo.StereoSgm().compute(np.stack([i] * 3, 2), i), TypeError, "rgb_to_gray"),
        (
            lambda i: stereo.remove_speckles(i.astype(np.int16), 2, 1),
            TypeError,
            "disparity .* int16",
        ),
        (lambda i: stereo.remove_speckles(np.zeros(3), 2, 1), ValueError, r"disparity .* \(H, W\)"),
        (lambda i: stereo.fill_gaps(np.zeros((3, 4)), i), ValueError, "size"),
        (
            lambda i: stereo.fill_gaps(np.zeros((3, 4)), np.full((3, 4), 99.0)),
            ValueError,
            "left must have",
        ),
        (lambda i: stereo.point_cloud(np.zeros((3, 4)), np.eye(3)), ValueError, r"q .* \(4, 4\)"),
        (
            lambda i: stereo.point_cloud(np.zeros((3, 4)), np.eye(4), i),
            ValueError,
            "colors must be a color",
        ),
        (lambda i: stereo.PixelMap(np.zeros((3, 4))), ValueError, r"sources .* \(H, W, 2\)"),
        (lambda i: stereo.PixelMap(np.zeros((3, 4, 2), int)), TypeError, "sources"),
        (lambda i: stereo.depth_from_disparity(-1, 1, [1.0]), ValueError, "focal"),
    ],
)
def test_bad_arguments_are_named(call, error, message):
    with pytest.raises(error, match=message):
        call(texture())


@pytest.mark.parametrize("matcher", [stereo.StereoSgm(), stereo.StereoBm()])
def test_progress_and_cancellation(pair, matcher):
    reports = []
    matcher.compute(*pair, progress=lambda *status: reports.append(status))
    assert reports[0][0] == "matching along the rows" and 0 <= reports[0][1] <= 1

    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        matcher.compute(*pair, progress=stop)


def test_cleaning_and_filling():
    disparity = np.array([[5, 5.5, 6, 20]], np.float32)
    clean = stereo.remove_speckles(disparity, 2, 1.0)
    np.testing.assert_array_equal(clean, [[5, 5.5, 6, np.nan]])
    assert disparity[0, 3] == 20
    filled = stereo.fill_gaps([[2, 2, np.nan, 9, 9]], np.zeros((1, 5), np.uint8))
    assert filled.tolist() == [[2, 2, 2, 9, 9]]


def test_depth():
    assert stereo.depth_from_disparity(700, 0.12, 30) == pytest.approx(2.8)
    depths = stereo.depth_from_disparity(700, 0.12, [30, 0, -1])
    np.testing.assert_allclose(depths, [2.8, np.nan, np.nan])
    with pytest.raises(epipole.DegenerateError):
        stereo.depth_from_disparity(700, 0.12, 0)
    interval = stereo.depth_interval(800, 0.1, 4, 1)
    assert (interval.near_m, interval.far_m) == (pytest.approx(16), pytest.approx(80 / 3))
    assert pickle.loads(pickle.dumps(interval)) == interval
    assert stereo.depth_interval(800, 0.1, 0.5, 1).far_m is None
    disparity = np.array([[30, np.nan], [0, 60]])
    depth = stereo.depth_image(disparity, 700, 0.12)
    np.testing.assert_allclose(depth, [[2.8, np.nan], [np.nan, 1.4]], rtol=1e-6)


def test_point_cloud():
    q = stereo.q_from_rig(700, 0.12, 320, 240)
    disparity = np.full((3, 4), np.nan, np.float32)
    disparity[1, 2] = 30
    cloud = stereo.point_cloud(disparity, q)
    expected = (np.array([2, 1, 0]) - [320, 240, -700]) * 0.12 / 30
    np.testing.assert_allclose(cloud.points, [expected])
    assert cloud.colors is None and len(cloud) == 1
    colors = np.arange(36, dtype=np.uint8).reshape(3, 4, 3)
    colored = stereo.point_cloud(disparity, q, colors)
    assert colored.colors.tolist() == [colors[1, 2].tolist()] and colored.colors.dtype == np.uint8
    for result in (cloud, colored):
        assert pickle.loads(pickle.dumps(result)) == result
    assert stereo.point_cloud(disparity * np.nan, q, colors).colors.shape == (0, 3)


def test_rectification(camera):
    rectified, motion = rig(camera)
    points = np.random.default_rng(3).uniform([-0.3, -0.2, 1], [0.3, 0.2, 2], (30, 3))
    pixels1, pixels2 = camera.project(points), camera.project(motion @ points)
    first, second = rectified.rectify_pixel(0, pixels1), rectified.rectify_pixel(1, pixels2)
    np.testing.assert_allclose(first[:, 1], second[:, 1], atol=1e-9)
    disparity = first[:, 0] - second[:, 0]
    of_points = rectified.disparity_of(points)
    np.testing.assert_allclose(of_points, np.column_stack([first, disparity]), atol=1e-9)
    np.testing.assert_allclose(rectified.source_pixel(0, first), pixels1, atol=1e-9)
    x = rectified.q @ np.vstack([first.T, disparity, np.ones(30)])
    np.testing.assert_allclose((x[:3] / x[3]).T, points @ rectified.rect_from_cam[0].T, atol=1e-9)
    low, high = rectified.disparity_range(points)
    assert low <= disparity.min() + 1 and high >= disparity.max() - 1
    assert rectified.baseline_m == pytest.approx(np.linalg.norm([-0.1, 0.01, 0.005]))
    assert (rectified.width, rectified.height) == (160, 120) and not rectified.is_vertical
    assert rectified.homographies.shape == rectified.rect_from_cam.shape == (2, 3, 3)
    assert rectified.valid[0].u_min < rectified.valid[0].u_max
    assert pickle.loads(pickle.dumps(rectified)) == rectified
    assert rectified != rig(camera, angle=0.06)[0]
    larger, _ = rig(camera, size=(200, 150), alpha=1.0)
    assert (larger.width, larger.height) == (200, 150)
    with pytest.raises(ValueError, match="0 or 1"):
        rectified.rectify_pixel(2, pixels1)
    with pytest.raises(epipole.TooFewError):
        rectified.disparity_range(points[:3])
    with pytest.raises(epipole.DegenerateError):
        stereo.rectify_calibrated(camera, camera, epipole.RigidTransform())


def test_pixel_maps(camera):
    shift = stereo.PixelMap.from_homography(3, 1, [[1, 0, 1], [0, 1, 0], [0, 0, 1]])
    assert (shift.width, shift.height) == (3, 1)
    row = np.array([[10, 20, 30]], np.uint8)
    assert shift.warp(row).tolist() == [[0, 10, 20]]
    np.testing.assert_array_equal(shift.source(2, 0), [1, 0])
    sources = np.array([[(1, 0), (np.nan, 0), (0.5, 0)]], np.float32)
    plain = stereo.PixelMap(sources)
    assert plain.warp(row).tolist() == [[20, 0, 15]] and plain.source(1, 0) is None
    np.testing.assert_allclose(plain.warp(row / 255.0), [[20 / 255, 0, 15 / 255]], rtol=1e-6)
    assert plain.warp(np.stack([row] * 3, 2)).shape == (1, 3, 3)
    assert plain.mask(3, 1).tolist() == [[255, 0, 255]]
    again = pickle.loads(pickle.dumps(plain))
    np.testing.assert_array_equal(again.sources, plain.sources)
    rectified, _ = rig(camera)
    place = rectified.map(1)
    np.testing.assert_allclose(
        place.sources[20, 30], rectified.source_pixel(1, (30, 20)), atol=1e-4
    )


def test_rectified_pair(camera):
    rectified, _ = rig(camera, angle=0.0, shift=(-0.1, 0.0, 0.0))
    wide = np.stack([texture(size=(160 + SHIFT, 120))] * 3, 2)
    photos = wide[:, :-SHIFT], wide[:, SHIFT:]
    pair = stereo.RectifiedPair(rectified, *photos)
    assert pair.num_shown == 160 * 120 and pair.rig == rectified
    np.testing.assert_array_equal(pair.pictures[0], photos[0])
    sgm, reports = stereo.StereoSgm(num_disparities=16), []
    disparity = pair.disparity(sgm, progress=lambda *status: reports.append(status))
    assert reports and np.nanmedian(disparity) == pytest.approx(SHIFT, abs=0.1)
    np.testing.assert_array_equal(pair.disparity(sgm.compute), disparity)
    filled = pair.filled(disparity)
    assert not np.isnan(filled).any()
    assert pickle.loads(pickle.dumps(pair)) == pair
    with pytest.raises(ZeroDivisionError):
        pair.disparity(lambda left, right: 1 / 0)
    with pytest.raises(ValueError, match="result of matching"):
        pair.disparity(lambda left, right: np.zeros((2, 2)))
    with pytest.raises(ValueError, match="image2"):
        stereo.RectifiedPair(rectified, photos[0], photos[1][..., 0])


def test_uncalibrated():
    f = [[0, 0, 0], [0, 0, -1], [0, 1, 5]]
    pixels1 = np.array([(30, 20), (60, 70), (90, 40), (20, 80)], float)
    pixels2 = pixels1 + [-8, 5]
    found = stereo.rectify_uncalibrated(f, pixels1, pixels2, 128, 96)
    rows = []
    for h, pixels in zip(found.homographies, (pixels1, pixels2)):
        rows.append(epipole.transfer(h, pixels)[:, 1])
    np.testing.assert_allclose(rows[0], rows[1], atol=1e-9)
    assert not found.is_vertical and found.outlines[0].u_max > found.outlines[0].u_min
    low, high = found.disparity_range_px
    assert low <= high
    assert pickle.loads(pickle.dumps(found)) == found


def test_opencv(pair):
    cv2 = pytest.importorskip("cv2")
    left, right = pair
    theirs = cv2.StereoSGBM_create(0, 32, 5, 200, 800).compute(left, right) / 16
    ours = stereo.StereoSgm(num_disparities=32).compute(left, right)
    both = (theirs > 0) & ~np.isnan(ours)
    assert both.mean() > 0.6 and np.median(np.abs(ours - theirs)[both]) < 0.2
    q = stereo.q_from_rig(700, 0.12, 70, 60)
    points = cv2.reprojectImageTo3D(ours, q)[~np.isnan(ours)]
    np.testing.assert_allclose(stereo.point_cloud(ours, q).points, points, rtol=1e-4, atol=1e-6)
    sources = np.random.default_rng(2).uniform(5, 100, (30, 40, 2)).astype(np.float32)
    smooth = cv2.GaussianBlur(left / np.float32(255), (0, 0), 3)
    expected = cv2.remap(smooth, sources, None, cv2.INTER_LINEAR)
    assert np.abs(stereo.PixelMap(sources).warp(smooth) - expected).max() < 0.01
