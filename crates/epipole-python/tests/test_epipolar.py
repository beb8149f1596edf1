import numpy as np
import pytest
from conftest import same_up_to_scale

import epipole
from epipole import epipolar


def test_fundamental_of_matches_with_outliers(world, outliers):
    report = epipole.estimate_fundamental(*outliers, max_error_px=0.5, seed=3)
    assert same_up_to_scale(report.model, world.fundamental, 1e-5)
    assert report.inliers.dtype == bool and report.inliers.shape == (60,)
    assert report.inliers[:40].all() and report.num_inliers == report.inliers.sum()
    assert report.max_error_px == 0.5 and not report.could_be_random()


def test_equal_seeds_give_equal_reports(outliers):
    first = epipole.estimate_fundamental(*outliers, seed=5)
    assert first == epipole.estimate_fundamental(*outliers, seed=5)


def test_essential_and_relative_pose(world, outliers):
    cameras = (world.camera, world.camera)
    report = epipole.estimate_essential(*outliers, *cameras)
    assert same_up_to_scale(report.model, world.essential, 1e-5)
    pose = epipole.estimate_relative_pose(*outliers, *cameras).model
    np.testing.assert_allclose(pose.rotation, world.rotation, atol=1e-5)
    np.testing.assert_allclose(pose.direction, world.translation, atol=1e-5)
    assert same_up_to_scale(pose.fundamental(world.intrinsics, world.intrinsics), world.fundamental)


def test_pose_with_gravity(world, outliers):
    down1 = np.array([0.0, 1.0, 0.0])
    report = epipolar.estimate_relative_pose_with_gravity(
        *outliers, world.camera, world.camera, down1, world.rotation @ down1
    )
    np.testing.assert_allclose(report.model.rotation, world.rotation, atol=1e-5)


def test_pose_and_focal(world):
    k = world.k.copy()
    k[1, 1] = 500
    pixels1 = (world.rays1 @ k.T)[:, :2]
    pixels2 = (world.rays2 @ k.T)[:, :2]
    report = epipolar.estimate_relative_pose_and_focal(pixels1, pixels2, k[:2, 2], k[:2, 2])
    assert report.model.focal_px == pytest.approx(500, rel=1e-3)
    assert isinstance(report.model.constrains_focal(), bool)
    six = epipolar.essential_6point(pixels1[:6], pixels2[:6], k[:2, 2], k[:2, 2])
    assert any(abs(found.focal_px - 500) < 1e-3 for found in six)


@pytest.mark.parametrize("solver", ["fundamental_7point", "fundamental_8point"])
def test_fundamental_solvers(world, solver):
    num = 7 if "7" in solver else 20
    found = getattr(epipolar, solver)(world.pixels1[:num], world.pixels2[:num])
    candidates = found.reshape(-1, 3, 3)
    assert any(same_up_to_scale(f, world.fundamental) for f in candidates)


def test_eight_point_explained(world):
    found = epipolar.fundamental_8point_explained(world.pixels1, world.pixels2)
    assert found.singular_values.shape == (9,) and found.condition_number > 1
    assert same_up_to_scale(found.fundamental, world.fundamental)
    raw = epipolar.fundamental_8point_unnormalized(world.pixels1, world.pixels2)
    assert raw.condition_number > found.condition_number


def test_essential_solvers(world):
    five = epipolar.essential_5point(world.rays1[:5], world.rays2[:5])
    assert five.ndim == 3 and any(same_up_to_scale(e, world.essential) for e in five)
    assert same_up_to_scale(epipolar.essential_8point(world.rays1, world.rays2), world.essential)


def test_three_point(world):
    down1 = np.array([0.0, 1.0, 0.0])
    found = epipolar.relative_pose_3point(
        world.rays1[:3], world.rays2[:3], down1, world.rotation @ down1
    )
    assert any(np.allclose(motion.rotation, world.rotation, atol=1e-6) for motion in found)


def test_refinement(world):
    f = epipolar.fundamental_8point(world.pixels1, world.pixels2)
    for loss in (None, "trivial", {"huber": {"width": 1.0}}):
        refined = epipolar.refine_fundamental(f, world.pixels1, world.pixels2, loss)
        assert same_up_to_scale(refined, world.fundamental)
    with pytest.raises(TypeError, match="loss"):
        epipolar.refine_fundamental(f, world.pixels1, world.pixels2, "squared")
    pose = epipolar.RelativePose(world.rotation, world.translation)
    cameras = (world.camera, world.camera)
    refined = epipolar.refine_relative_pose(pose, world.pixels1, world.pixels2, *cameras)
    np.testing.assert_allclose(refined.rotation, world.rotation, atol=1e-9)


def test_distances_and_lines(world):
    f = world.fundamental
    assert epipole.sampson_px(f, world.pixels1, world.pixels2).max() < 1e-9
    shifted = world.pixels2 + [0, 3]
    distances = epipolar.symmetric_epipolar_px(f, world.pixels1, shifted)
    assert distances.shape == (60,) and distances.min() > 0
    one = epipole.sampson_px(f, world.pixels1[4], shifted[4])
    assert isinstance(one, float) and one == epipole.sampson_px(f, world.pixels1, shifted)[4]
    lines2 = epipolar.epipolar_line2(f, world.pixels1)
    on_line = np.sum(lines2 * np.c_[world.pixels2, np.ones(60)], axis=1)
    assert lines2.shape == (60, 3) and np.abs(on_line).max() < 1e-9
    lines1 = epipolar.epipolar_line1(f, world.pixels2)
    np.testing.assert_allclose(np.hypot(lines1[:, 0], lines1[:, 1]), 1)


def test_epipoles(world):
    e1, e2 = epipolar.epipoles(world.fundamental)
    assert np.linalg.norm(world.fundamental @ e1) < 1e-9 * np.linalg.norm(e1)
    assert np.linalg.norm(e2 @ world.fundamental) < 1e-9 * np.linalg.norm(e2)
    sideways = epipolar.essential_from_motion(epipole.RigidTransform(translation=[1, 0, 0]))
    assert epipolar.epipoles(sideways)[0][2] == 0


def test_decomposition(world):
    motions = epipole.decompose_essential(world.essential)
    assert len(motions) == 4
    k = world.intrinsics
    selected = epipolar.select_pose(motions, world.pixels1, world.pixels2, k, k)
    np.testing.assert_allclose(selected.cam2_from_cam1.rotation, world.rotation, atol=1e-9)
    assert selected.num_in_front == 60


def test_matrices_from_cameras(world):
    k = world.intrinsics
    assert same_up_to_scale(epipolar.fundamental_from_cameras(*world.posed), world.fundamental)
    assert same_up_to_scale(epipolar.essential_from_motion(world.motion), world.essential)
    f = epipolar.fundamental_from_essential(world.essential, k, k)
    assert same_up_to_scale(f, world.fundamental)
    assert same_up_to_scale(epipolar.essential_from_fundamental(f, k, k), world.essential)
    noisy = world.essential + 1e-3
    singular = np.linalg.svd(epipolar.project_to_essential(noisy))[1]
    np.testing.assert_allclose(singular, np.array([1, 1, 0]) / np.sqrt(2), atol=1e-9)
    assert np.linalg.svd(epipolar.enforce_rank2(noisy))[1][2] < 1e-12


def test_focal_lengths(world):
    principal = world.k[:2, 2]
    k = np.diag([500.0, 500.0, 1.0])
    k[:2, 2] = principal
    inverse = np.linalg.inv(k)
    f = inverse.T @ world.essential @ inverse
    focals = epipolar.focal_lengths_from_fundamental(f, principal, principal)
    np.testing.assert_allclose(focals, 500, rtol=1e-6)


def test_tangent_sampson_error_is_that_of_pinhole_cameras(world):
    pixels2 = world.pixels2 + [1.5, -2]
    cameras = world.motion, world.camera, world.camera
    tangent = epipolar.tangent_sampson_px(*cameras, world.pixels1, pixels2)
    np.testing.assert_allclose(
        tangent, epipolar.sampson_px(world.fundamental, world.pixels1, pixels2), rtol=1e-4
    )
    bent = epipole.Camera(640, 480, world.intrinsics, epipole.Lens("brown", [-0.5, 0, 0, 0, 0]))
    beyond = epipolar.tangent_sampson_px(world.motion, bent, world.camera, [5000, 5000], [0, 0])
    assert np.isnan(beyond)
