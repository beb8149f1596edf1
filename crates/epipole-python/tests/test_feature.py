"""Corners, SIFT, ORB, matching and tracking."""

import copy
import pickle

import numpy as np
import pytest

import epipole
from epipole import feature, imaging


def picture(seed=6, shift=(0.0, 0.0), size=(240, 200)):
    """Random blobs of many sizes, float32 in [0, 1]; `shift` moves them, pixels."""
    random = np.random.default_rng(seed)
    width, height = size
    v, u = np.mgrid[:height, :width].astype(float)
    image = np.full((height, width), 0.5)
    for _ in range(120):
        x, y = random.uniform(0, width), random.uniform(0, height)
        sigma, contrast = random.uniform(1.5, 7), random.uniform(-0.4, 0.4)
        distance_sq = (u - x - shift[0]) ** 2 + (v - y - shift[1]) ** 2
        image += contrast * np.exp(-distance_sq / (2 * sigma**2))
    return image.clip(0, 1).astype(np.float32)


@pytest.fixture
def image():
    return picture()


@pytest.fixture
def square():
    image = np.zeros((90, 90), np.float32)
    image[30:60, 30:60] = 1
    return image


def test_sift_finds_a_blob_where_it_is():
    v, u = np.mgrid[:65, :65]
    blob = 1 / (1 + ((u - 32.25) ** 2 + (v - 30) ** 2) / 60)
    features = feature.detect_sift(blob, upright=True)
    np.testing.assert_allclose(features.points[0], [32.25, 30], atol=0.05)
    keypoints = features.keypoints
    assert keypoints.points.shape == (len(features), 2)
    assert keypoints.scales_px.dtype == keypoints.responses.dtype == np.float32
    assert keypoints.octaves.dtype == np.int32 and not keypoints.angles_rad.any()
    assert features.descriptors.shape == (len(features), 128)
    assert features.descriptors.dtype == np.float32


def test_bytes_and_floats_give_the_same_features(image):
    byte = imaging.gray_to_u8(image)
    first = feature.detect_sift(byte)
    assert first == feature.detect_sift(byte / np.float32(255))
    color = np.repeat(byte[..., None], 3, axis=2)
    assert first == feature.detect_sift(feature.photo_to_gray(color))


@pytest.mark.parametrize(
    ("kind", "dtype", "length"),
    [
        ("root_sift", np.float32, 128),
        ("sift", np.float32, 128),
        ("orb", np.uint8, 32),
        ("harris", np.float32, 121),
    ],
)
def test_features_of_every_kind_match_under_a_shift(kind, dtype, length):
    pair = picture(), picture(shift=(7, 4))
    first, second = (epipole.detect_features(i, kind=kind, max_features=300) for i in pair)
    assert first.descriptors.dtype == dtype and first.descriptors.shape[1] == length
    matches = epipole.match_descriptors(first, second)
    assert len(matches) >= 10 and matches.indices.shape == (len(matches), 2)
    move = second.points[matches.indices[:, 1]] - first.points[matches.indices[:, 0]]
    assert np.median(np.abs(move - [7, 4]).max(1)) < 0.7
    assert (matches.ratios <= 1).all() and (matches.distances >= 0).all()


def test_detectors_of_one_kind_equal_detect_features(image):
    orb = feature.detect_orb(image, max_features=200)
    assert orb == feature.detect_features(image, kind="orb", max_features=200)
    assert len(orb) > 20


def test_descriptions_at_keypoints(image):
    features = feature.detect_sift(image)
    keypoints = features.keypoints
    again = feature.describe_sift(image, keypoints)
    assert (again == features.descriptors).mean() > 0.99
    directions = feature.sift_directions(image, keypoints, max_orientations=1)
    rotation = np.array([d[0] for d in directions]) - keypoints.angles_rad
    assert np.median(np.abs(np.exp(1j * rotation) - 1)) < 1e-3
    patches = feature.describe_patches(image, [(60, 50), (90.5, 70)], 9)
    assert patches.shape == (2, 81)
    patch = image[46:55, 56:65] - image[46:55, 56:65].mean()
    np.testing.assert_allclose(patches[0], (patch / np.linalg.norm(patch)).ravel(), atol=1e-5)


def test_scale_space(image):
    space = feature.scale_space(image)
    first = space.octaves[0]
    assert first.step_px == 0.5 and first.octave == -1
    assert first.blurred.shape[0] == 6 and first.sigmas_px.shape == (6,)
    np.testing.assert_allclose(first.differences, np.diff(first.blurred, axis=0), atol=1e-6)
    answers = space.answers(100, 100)
    assert answers.shape[1] == 2 and (np.diff(answers[:, 0]) > 0).all()
    again = pickle.loads(pickle.dumps(space))
    assert again == space
    np.testing.assert_array_equal(again.answers(100, 100), answers)


def test_corners(square):
    corners = feature.good_features_to_track(square)
    found = {tuple(point) for point in corners.points}
    assert found == {(30, 30), (30, 59), (59, 30), (59, 59)}
    response = feature.harris_response(square, 0.04)
    assert response.dtype == np.float32 and response.shape == square.shape
    peaks = feature.non_maximum_suppression(response, 3, 0.5 * response.max())
    assert len(peaks) == 4
    assert feature.min_eigenvalue_response(square)[45, 30] == 0
    refined = feature.refine_corners(square, [(30, 30), (75, 75)])
    np.testing.assert_allclose(refined[0], [29.5, 29.5], atol=0.15)
    assert np.isnan(refined[1]).all()
    sparse = feature.good_features_to_track(
        square, max_corners=2, measure={"harris": 0.04}, grid={"columns": 2, "rows": 1}
    )
    assert sorted(sparse.points[:, 0]) == [30, 59]


def test_tensors():
    step = np.zeros((9, 12))
    step[:, 6:] = 1
    tensor = feature.structure_tensor(step, window={"box": 3})
    # Sobel answers 4 on both sides of the step.
    assert tensor.uu[4, 6] == 6 * 16 and not tensor.vv[4].any()
    assert tensor.eigenvalues(6, 4) == (96, 0) and tensor.eigenvalues(99, 4) is None
    window = tensor.at(6, 4)
    assert (window.uu, window.trace(), window.determinant()) == (96, 96, 0)
    assert window == feature.WindowTensor.at(step, (6, 4), window={"box": 3})
    assert window.eigenvalues() == (96, 0) and window.direction_rad() == 0
    assert window.harris(0.05) == pytest.approx(-460.8)
    assert window.change([1, 5]) == 96
    of_pixels = feature.WindowTensor.from_gradients([(1, 2), (3, 4)])
    assert (of_pixels.uu, of_pixels.uv, of_pixels.vv) == (10, 14, 20)
    surface = feature.shift_surface(step, (6, 4), 1, 2)
    assert surface.reach == 2 and surface.values.shape == (5, 5)
    assert surface.at(0, 2) == 0 and surface.at(-1, 0) == surface.values[2, 1] == 3
    assert surface.at(3, 0) is None and surface.at(-3, 0) is None


def test_matching_of_plain_arrays():
    random = np.random.default_rng(8)
    first = random.random((50, 16))
    order = random.permutation(50)
    second = first[order] + 1e-3
    matches = feature.match_descriptors(first, second)
    np.testing.assert_array_equal(order[matches.indices[:, 1]], matches.indices[:, 0])
    np.testing.assert_allclose(matches.distances, 4e-3, rtol=1e-2)
    distances = np.linalg.norm(first[:, None] - second[None], axis=2)
    neighbors = feature.nearest_two(first, second)
    np.testing.assert_array_equal(neighbors.indices, distances.argmin(1))
    np.testing.assert_allclose(neighbors.second_distances, np.sort(distances)[:, 1], rtol=1e-4)
    assert np.isinf(feature.nearest_two(first, second[:1]).second_distances).all()
    indices, near = feature.nearest_few(first[0], second, 3)
    np.testing.assert_array_equal(indices, distances[0].argsort()[:3])
    np.testing.assert_allclose(near, np.sort(distances[0])[:3], rtol=1e-3)
    assert feature.match_descriptors(first, np.zeros((0, 16))).indices.shape == (0, 2)


def test_matching_of_bits():
    random = np.random.default_rng(9)
    first, second = random.integers(0, 256, (2, 40, 32), np.uint8)
    bits = np.unpackbits(first[:, None] ^ second[None], axis=2).sum(2)
    matches = feature.match_descriptors(first, second, max_ratio=None, mutual=False, unique=False)
    np.testing.assert_array_equal(matches.indices[:, 1], bits.argmin(1))
    np.testing.assert_array_equal(matches.distances, bits.min(1))
    query = np.unpackbits(first[3], bitorder="little")
    (index,), (distance,) = feature.nearest_few(query, first, 1)
    assert (index, distance) == (3, 0)
    features = feature.Features(feature.Keypoints(np.zeros((40, 2))), first)
    assert feature.match_descriptors(features, second).indices.dtype == np.int64
    np.testing.assert_array_equal(features.descriptors, first)


def test_tracking():
    first, second = picture(), picture(shift=(3.4, -2.2))
    points = np.vstack([feature.good_features_to_track(first, max_corners=30).points, [(0, 0)]])
    tracks = feature.track_lucas_kanade(first, second, points)
    assert tracks.found.sum() > 20 and len(tracks) == len(points)
    moves = (tracks.points - points)[tracks.found]
    assert np.median(np.abs(moves - [3.4, -2.2])) < 0.05
    assert (np.isnan(tracks.points[:, 0]) == ~tracks.found).all()
    assert (np.isnan(tracks.residuals) == ~tracks.found).all()
    again = pickle.loads(pickle.dumps(tracks))
    np.testing.assert_array_equal(again.points, tracks.points)
    np.testing.assert_array_equal(again.forward_backward_px, tracks.forward_backward_px)


def test_selection_and_construction(image):
    features = feature.detect_sift(image, max_features=50)
    assert len(features[:10]) == 10
    few = features[features.keypoints.octaves < 1]
    assert (few.keypoints.octaves < 1).all() and len(few.descriptors) == len(few)
    assert features[np.array([3, 1])].points.tolist() == features.points[[3, 1]].tolist()
    with pytest.raises(TypeError, match="slice, a mask or an array"):
        features[0]
    plain = feature.Keypoints([(1, 2), (3, 4)], octaves=[0, 1])
    assert plain.scales_px.tolist() == [1, 1] and plain.octaves.tolist() == [0, 1]


def results(image):
    features = feature.detect_sift(image, max_features=40)
    orb = feature.detect_orb(image)
    yield from (features, features.keypoints, orb, feature.match_descriptors(orb, orb))
    yield feature.nearest_two(features, features)
    yield feature.structure_tensor(image)
    yield feature.WindowTensor(1.0, 2.0, 3.0)
    yield feature.shift_surface(image, (20, 20), 2, 3)


def test_pickles_and_copies_are_equal(image):
    for result in results(image):
        for again in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
            assert again == result and type(again) is type(result)
        assert repr(result).startswith(type(result).__name__ + "(") and result != 3
        with pytest.raises(AttributeError):
            result.points = 1


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (
            lambda i: feature.detect_sift(255 * i),
            ValueError,
            r"image must have gray values in \[0, 1\]",
        ),
        (lambda i: feature.detect_orb(i[None]), ValueError, "image must be an array of shape"),
        (
            lambda i: feature.detect_sift(i, max_feature=3),
            TypeError,
            "unknown option max_feature.*max_features",
        ),
        (
            lambda i: feature.detect_sift(i, max_features=-3),
            ValueError,
            "max_features is out of range",
        ),
        (lambda i: feature.detect_features(i, kind="surf"), TypeError, "kind"),
        (
            lambda i: feature.track_lucas_kanade(i, i * np.nan, [(1, 2)]),
            ValueError,
            "second contains NaN",
        ),
        (lambda i: feature.track_lucas_kanade(i, i[1:], [(1, 2)]), ValueError, "size"),
        (lambda i: feature.describe_sift(i, [1, 2]), ValueError, r"keypoints must be .* \(N, 2\)"),
        (lambda i: feature.match_descriptors(None, i), TypeError, "descriptors1"),
        (lambda i: feature.match_descriptors(i, i[0]), ValueError, r"descriptors2 .* \(N, D\)"),
        (
            lambda i: feature.match_descriptors(i * np.nan, i),
            ValueError,
            "descriptors1 contains NaN in row 0",
        ),
        (
            lambda i: feature.match_descriptors(i, np.zeros((3, 128), np.uint8)),
            ValueError,
            r"descriptors2 .* \(N, 32\)",
        ),
        (
            lambda i: feature.Keypoints([(1, 2)], scales_px=[1, 2]),
            ValueError,
            "scales_px must have one number",
        ),
        (lambda i: feature.Keypoints([(1, 2)], octaves=[0.5]), TypeError, "octaves"),
        (
            lambda i: feature.Features(feature.Keypoints([(1, 2)]), i),
            ValueError,
            "descriptors must have one row",
        ),
    ],
)
def test_bad_arguments_are_named(image, call, error, message):
    with pytest.raises(error, match=message):
        call(image)


def test_flat_images_have_no_features():
    assert len(feature.detect_sift(np.full((80, 80), 0.5))) == 0
    assert feature.detect_sift(np.zeros((5, 5), np.uint8)).descriptors.shape == (0, 128)
    assert feature.detect_orb(np.zeros((50, 50))).descriptors.shape == (0, 32)


@pytest.mark.parametrize("work", ["sift", "orb", "corners", "matching"])
def test_progress_and_cancellation(image, work):
    descriptors = np.random.default_rng(1).random((500, 32))
    run, stage = {
        "sift": (lambda p: feature.detect_sift(image, progress=p), "finding features"),
        "orb": (lambda p: feature.detect_orb(image, progress=p), "finding features"),
        "corners": (
            lambda p: feature.good_features_to_track(image, progress=p),
            "finding features",
        ),
        "matching": (
            lambda p: feature.match_descriptors(descriptors, descriptors, progress=p),
            "matching features",
        ),
    }[work]
    reports = []
    run(lambda *status: reports.append(status))
    assert reports[0][0] == stage and 0 <= reports[0][1] <= 1

    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        run(stop)


def test_opencv_features_can_be_matched():
    cv2 = pytest.importorskip("cv2")
    pair = [imaging.gray_to_u8(picture()), imaging.gray_to_u8(picture(shift=(7, 4)))]
    for detector, norm in [
        (cv2.SIFT_create(), cv2.NORM_L2),
        (cv2.ORB_create(fastThreshold=5), cv2.NORM_HAMMING),
    ]:
        (_, first), (_, second) = (detector.detectAndCompute(image, None) for image in pair)
        expected = cv2.BFMatcher(norm, crossCheck=True).match(first, second)
        expected = {(m.queryIdx, m.trainIdx) for m in expected}
        found = feature.match_descriptors(first, second, max_ratio=None, mutual=True)
        found = set(map(tuple, found.indices.tolist()))
        # Ties are broken in different ways.
        assert len(found & expected) >= 0.95 * len(expected) > 10


def test_sift_agrees_with_opencv(image):
    cv2 = pytest.importorskip("cv2")
    byte = imaging.gray_to_u8(image)
    theirs = cv2.SIFT_create(contrastThreshold=0.04).detect(byte, None)
    theirs = np.array([keypoint.pt for keypoint in theirs])
    ours = feature.detect_sift(byte, contrast_threshold=0.04).points
    assert 0.7 < len(ours) / len(theirs) < 1.4
    nearest = np.linalg.norm(theirs[:, None] - ours[None], axis=2).min(1)
    assert (nearest < 1).mean() > 0.8


def test_corners_agree_with_opencv(image):
    cv2 = pytest.importorskip("cv2")
    byte = imaging.gray_to_u8(image)
    response = feature.harris_response(byte, 0.04, window={"box": 3}, scaling="open_cv")
    expected = cv2.cornerHarris(byte, 3, 3, 0.04)
    np.testing.assert_allclose(response, expected, atol=1e-4 * np.abs(expected).max())
    options = {
        "max_corners": 50,
        "quality": 0.01,
        "min_distance_px": 5,
        "tensor": {"scaling": "open_cv"},
    }
    ours = feature.good_features_to_track(byte, **options).points
    theirs = cv2.goodFeaturesToTrack(byte, 50, 0.01, 5)[:, 0]
    assert len({tuple(p) for p in ours} & {tuple(p) for p in theirs.astype(float)}) >= 48
