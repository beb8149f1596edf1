"""Homographies, absolute poses, triangulation and two views."""

import numpy as np
import pytest
from conftest import rotation, same_up_to_scale

import epipole
from epipole import absolute_pose, homography, triangulation, two_view


def plane_homography(world):
    """H of the plane z = 6 + 0.3 x: n·x = -d with n towards the camera."""
    normal = np.array([0.3, 0.0, -1.0])
    length = np.linalg.norm(normal)
    normal, distance = normal / length, 6 / length
    h = world.rotation - np.outer(world.translation, normal) / distance
    return world.k @ h @ np.linalg.inv(world.k), normal, distance


def test_homography(plane):
    truth, normal, distance = plane_homography(plane)
    matches = (plane.pixels1, plane.pixels2)
    assert same_up_to_scale(epipole.estimate_homography(*matches).model, truth)
    assert same_up_to_scale(homography.fit_homography(*matches), truth)
    four = homography.homography_4point(plane.pixels1[:4], plane.pixels2[:4])
    assert four.shape == (1, 3, 3) and same_up_to_scale(four[0], truth)
    assert same_up_to_scale(homography.refine_homography(truth, *matches), truth)
    np.testing.assert_allclose(epipole.transfer(truth, plane.pixels1), plane.pixels2)
    assert homography.transfer_error_px(truth, *matches).max() < 1e-9
    assert homography.homography_sampson_px(truth, *matches).max() < 1e-9
    k = plane.intrinsics
    made = homography.homography_from_motion(plane.motion, normal, distance, k, k)
    assert same_up_to_scale(made, truth)
    motions = homography.decompose_homography(truth, k, k)
    assert any(np.allclose(m.cam2_from_cam1.rotation, plane.rotation, atol=1e-6) for m in motions)
    calibrated = homography.estimate_homography_calibrated(*matches, plane.camera, plane.camera)
    inverse = np.linalg.inv(plane.k)
    of_rays = inverse @ truth @ plane.k
    assert same_up_to_scale(calibrated.model, of_rays) or same_up_to_scale(calibrated.model, truth)


def test_absolute_pose(world):
    pixels = world.pixels2.copy()
    pixels[40:] += 100
    report = epipole.estimate_absolute_pose(world.points, pixels, world.camera, seed=1)
    assert report.num_inliers == 40
    np.testing.assert_allclose(report.model.matrix(), world.motion.matrix(), atol=1e-6)


def test_absolute_pose_solvers(world):
    pixels, points, camera = world.pixels2, world.points, world.camera
    loss = {"cauchy": {"width": 1}}
    for pose in (
        absolute_pose.pose_dlt(points, pixels, world.intrinsics),
        absolute_pose.fit_absolute_pose(points, pixels, camera),
        absolute_pose.refine_absolute_pose(world.motion, points, pixels, camera, loss),
    ):
        np.testing.assert_allclose(pose.matrix(), world.motion.matrix(), atol=1e-6)
    three = absolute_pose.pose_p3p(world.rays2[:3], points[:3])
    assert any(np.allclose(p.matrix(), world.motion.matrix(), atol=1e-6) for p in three)
    errors = absolute_pose.reprojection_error_px(world.posed[1], points, pixels)
    assert errors.shape == (60,) and errors.max() < 1e-9
    assert absolute_pose.find_flipped_pose(world.motion, points, pixels, camera) is None


def test_absolute_pose_and_focal(world):
    principal = np.array([320.0, 240.0])
    pixels = 500 * world.rays2[:, :2] + principal
    report = absolute_pose.estimate_absolute_pose_and_focal(world.points, pixels, principal)
    assert report.model.focal_px == pytest.approx(500) and report.model.constrains_focal()
    four = absolute_pose.pose_p4pf(pixels[:4], world.points[:4], principal)
    assert any(abs(found.focal_px - 500) < 1e-3 for found in four)


def test_triangulation_of_two_views(world):
    cam1, cam2 = world.posed
    matches = (world.pixels1, world.pixels2)
    rays = (world.rays1, world.rays2)
    for points in (
        epipole.triangulate_dlt(cam1.projection_matrix(), cam2.projection_matrix(), *matches),
        triangulation.triangulate_optimal(cam1, cam2, *matches),
        triangulation.triangulate_midpoint(world.motion, *rays),
        triangulation.triangulate_weighted_midpoint(world.motion, *rays),
        triangulation.triangulate_angular(world.motion, *rays),
    ):
        np.testing.assert_allclose(points, world.points, atol=1e-6)
    corrected = triangulation.correct_matches(world.fundamental, *matches)
    np.testing.assert_allclose(corrected, np.c_[matches], atol=1e-6)
    one = triangulation.triangulate_optimal(cam1, cam2, world.pixels1[0], world.pixels2[0])
    np.testing.assert_allclose(one, world.points[0], atol=1e-6)


def test_triangulation_of_many_views(world):
    cameras = [
        epipole.PosedCamera(world.camera, epipole.RigidTransform(translation=[x, 0, 0]))
        for x in (0, -0.5, -1)
    ]
    point = world.points[0]
    pixels = [camera.project(point) for camera in cameras]
    np.testing.assert_allclose(triangulation.triangulate_nview_dlt(cameras, pixels), point)
    found = epipole.triangulate_nview(cameras, pixels, {"huber": {"width": 2.0}})
    np.testing.assert_allclose(found.point_in_world, point)
    assert found.rms_error_px < 1e-6
    covariance = triangulation.point_covariance(cameras, point, 1.0)
    assert covariance.shape == (3, 3) and np.linalg.eigvalsh(covariance).min() > 0
    angle = triangulation.triangulation_angle_rad([0, 0, 0], [2, 0, 0], [1, 0, 1])
    assert angle == pytest.approx(np.pi / 2)


def test_two_views(world, plane, outliers):
    report = epipole.estimate_two_view(*outliers)
    assert (report.configuration, report.kind) == ("general", "fundamental")
    assert same_up_to_scale(report.fundamental, world.fundamental, 1e-5)
    report = epipole.estimate_two_view_calibrated(*outliers, world.camera, world.camera)
    assert (report.configuration, report.kind) == ("general", "essential")
    np.testing.assert_allclose(report.cam2_from_cam1.rotation, world.rotation, atol=1e-5)
    assert epipole.estimate_two_view(plane.pixels1, plane.pixels2).configuration == "planar"


def test_rotations(world):
    step = rotation([0, 1, 0], 0.1)
    pixels2 = world.rays1 @ step.T @ world.k.T
    matches = (world.pixels1, pixels2[:, :2] / pixels2[:, 2:])
    cameras = (world.camera, world.camera)
    found = two_view.estimate_rotation(*matches, *cameras).model
    np.testing.assert_allclose(found, step, atol=1e-6)
    all_inliers = np.ones(60, bool)
    explaining = two_view.find_explaining_rotation(*matches, *cameras, all_inliers)
    assert explaining.num_explained == 60
    assert two_view.find_degeneracy(*matches, all_inliers).kind == "homography"
    still = (world.pixels1, world.pixels1)
    assert two_view.find_unmoved(*still, all_inliers).kind == "unmoved"
    assert two_view.find_rotation_and_focal(*matches, *cameras, all_inliers).focal_factor > 0.5
    with pytest.raises(TypeError, match="inliers must be a boolean array"):
        two_view.find_unmoved(*still, np.ones(60))
