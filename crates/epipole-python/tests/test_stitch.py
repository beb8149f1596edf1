"""Panoramas of a turning camera, against ground truth."""

import pickle

import numpy as np
import pytest
from conftest import rotation

import epipole
from epipole import stitch

K = np.array([[300.0, 0, 159.5], [0, 300.0, 119.5], [0, 0, 1]])
ANGLES_RAD = [0.0, 0.3, 0.6]


@pytest.fixture(scope="module")
def matches():
    """Matches of neighbors, a quarter of them wrong, and the rotations."""
    random = np.random.default_rng(1)
    rotations = [rotation([0, 1, 0], -angle_rad) for angle_rad in ANGLES_RAD]
    pairs = []
    for i in range(2):
        relative = K @ rotations[i + 1] @ rotations[i].T @ np.linalg.inv(K)
        pixels1 = random.uniform([100, 0], [319, 239], (200, 2))
        x = np.column_stack([pixels1, np.ones(200)]) @ relative.T
        pixels2 = x[:, :2] / x[:, 2:]
        pixels2[150:] = random.uniform([0, 0], [319, 239], (50, 2))
        pairs.append((pixels1, pixels2))
    return pairs, rotations


@pytest.fixture(scope="module")
def overlaps(matches):
    return [stitch.find_overlap((i, i + 1), *pair) for i, pair in enumerate(matches[0])]


@pytest.fixture(scope="module")
def photos(matches):
    """Photos of a texture at infinity."""
    texture = epipole.imaging.gaussian_blur(
        np.random.default_rng(2).random((400, 700)).astype(np.float32), 3.0
    )
    texture = epipole.imaging.gray_to_u8((texture - texture.min()) / np.ptp(texture))
    # Directions (x, y, 1) on a plane that the middle camera sees.
    plane = np.array([[1 / 300, 0, -350 / 300], [0, 1 / 300, -200 / 300], [0, 0, 1]])
    middle = matches[1][1]
    photos = []
    for r in matches[1]:
        map = K @ r @ middle.T @ plane
        warped = epipole.warp_perspective(texture, map, width=320, height=240)
        photos.append(np.dstack([warped] * 3))
    return photos


def test_overlaps(matches, overlaps):
    for overlap, (pixels1, _) in zip(overlaps, matches[0], strict=True):
        assert overlap.num_matches == 200 and 150 <= len(overlap.pixels1) < 160
        assert not overlap.has_parallax
        assert overlap.pixels1.shape == overlap.pixels2.shape
    noise = np.random.default_rng(3).uniform(0, 300, (2, 40, 2))
    assert stitch.find_overlap((0, 1), *noise) is None


def test_panorama_finds_the_rotations(matches, overlaps):
    k = epipole.Intrinsics.from_matrix(K)
    panorama = stitch.estimate_panorama([k] * 3, overlaps)
    found = [panorama.rotations[i + 1] @ panorama.rotations[i].T for i in range(2)]
    for i, relative in enumerate(found):
        np.testing.assert_allclose(relative, matches[1][i + 1] @ matches[1][i].T, atol=2e-3)
    assert panorama.scale_px == pytest.approx(300) and panorama.focal_factor is None
    guessed = stitch.estimate_panorama([k.zoomed(1.3)] * 3, overlaps, True)
    assert guessed.focal_factor == pytest.approx(1 / 1.3, rel=0.02)
    isolated = stitch.estimate_panorama([k] * 4, overlaps)
    assert isolated.pixel_from_direction[3] is None and isolated.pixel_from_direction[0].shape == (3, 3)


def test_panorama_is_rendered(overlaps, photos):
    k = epipole.Intrinsics.from_matrix(K)
    panorama = stitch.estimate_panorama([k] * 3, overlaps)
    for surface in ("plane", "cylinder", "sphere"):
        image = stitch.render_panorama(panorama, photos, surface=surface, gains=False)
        assert image.dtype == np.uint8 and image.shape[2] == 3
        assert image.shape[1] > 450 and (image > 0).mean() > 0.8
    small = stitch.render_panorama(panorama, photos, max_pixels=20_000, blend="feather")
    assert small.shape[0] * small.shape[1] <= 20_500
    flat = stitch.chain_homographies(3, overlaps)
    image = stitch.render_panorama(flat, photos, surface="plane")
    assert image.shape[1] > 450


def test_wrong_arguments_are_named(overlaps, photos):
    k = epipole.Intrinsics.from_matrix(K)
    panorama = stitch.estimate_panorama([k] * 3, overlaps)
    with pytest.raises(ValueError, match=r"photos\[1\]"):
        stitch.render_panorama(panorama, [photos[0], photos[1][..., 0], photos[2]])
    with pytest.raises(ValueError, match="photos"):
        stitch.render_panorama(panorama, photos[:2])
    with pytest.raises(TypeError, match="surface"):
        stitch.render_panorama(panorama, photos, surface="torus")
    with pytest.raises(ValueError, match="pixels1 and pixels2"):
        stitch.Overlap((0, 1), np.zeros((2, 2)), np.zeros((3, 2)), np.eye(3), 3, False)
    with pytest.raises(ValueError, match="homography"):
        stitch.Overlap((0, 1), np.zeros((2, 2)), np.zeros((2, 2)), np.eye(2), 3, False)
    with pytest.raises(ValueError, match="overlaps has photo 2, but there are 2"):
        stitch.estimate_panorama([k] * 2, overlaps)
    with pytest.raises(ValueError, match="overlaps has photo 1"):
        stitch.chain_homographies(1, overlaps)
    with pytest.raises(epipole.DegenerateError):
        stitch.chain_homographies(3, [])


def test_pickles_are_equal(overlaps):
    k = epipole.Intrinsics.from_matrix(K)
    for value in (overlaps[0], stitch.estimate_panorama([k] * 4, overlaps)):
        assert pickle.loads(pickle.dumps(value)) == value
        assert repr(value).startswith(type(value).__name__)


def test_progress_and_cancellation(overlaps, photos):
    k = epipole.Intrinsics.from_matrix(K)
    panorama = stitch.estimate_panorama([k] * 3, overlaps)
    reports = []
    stitch.render_panorama(panorama, photos, progress=lambda *status: reports.append(status))
    assert reports[0][0] == "blending"

    def stop(stage, fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        stitch.render_panorama(panorama, photos, progress=stop)
