import numpy as np
import pytest

import epipole
from epipole import camera


def test_projection_as_numpy(world):
    np.testing.assert_allclose(world.camera.project(world.points), world.pixels1)
    np.testing.assert_allclose(world.posed[1].project(world.points), world.pixels2)
    p = world.posed[1].projection_matrix()
    assert p.shape == (3, 4)
    x = np.c_[world.points, np.ones(60)] @ p.T
    np.testing.assert_allclose(x[:, :2] / x[:, 2:], world.pixels2)


def test_one_point_and_points_without_a_pixel(world):
    assert world.camera.project([0, 0, 2]).tolist() == [320, 240]
    with pytest.raises(epipole.DegenerateError, match="in front of the camera"):
        world.camera.project([0, 0, -2])
    pixels = world.camera.project([[0, 0, 2], [0, 0, -2]])
    assert pixels[0].tolist() == [320, 240] and np.isnan(pixels[1]).all()


def test_rays_lead_back(world):
    lens = epipole.Lens("brown", [0.1, -0.02, 0, 0, 0])
    bent = epipole.Camera(640, 480, world.intrinsics, lens)
    assert not bent.is_pinhole() and bent.lens.kind == "brown"
    pixels = bent.project(world.points)
    rays = bent.unproject(pixels)
    np.testing.assert_allclose(rays / rays[:, 2:], world.rays1, atol=1e-9)
    np.testing.assert_allclose(bent.pinhole_pixel(pixels), world.pixels1, atol=1e-6)


def test_intrinsics(world):
    k = world.intrinsics
    np.testing.assert_array_equal(k.matrix(), world.k)
    np.testing.assert_allclose(k.inverse_matrix() @ world.k, np.eye(3), atol=1e-12)
    assert k.principal_point().tolist() == [320, 240]
    assert epipole.Intrinsics.from_colmap(k.to_colmap()) == k
    assert epipole.Intrinsics.centered(500, 640, 480).cu_px == 319.5
    with pytest.raises(ValueError, match="k must be of the form"):
        epipole.Intrinsics.from_matrix(np.ones((3, 3)))
    with pytest.raises(ValueError, match="focal"):
        epipole.Intrinsics(-1, 1, 0, 0)


def test_rigid_transforms(world):
    motion = world.motion
    np.testing.assert_allclose(motion.rotation, world.rotation, atol=1e-15)
    moved = motion @ world.points
    np.testing.assert_allclose(moved, world.points @ world.rotation.T + world.translation)
    np.testing.assert_allclose(motion.inverse() @ moved, world.points)
    both = motion @ motion
    np.testing.assert_allclose(both.matrix(), motion.matrix() @ motion.matrix(), atol=1e-12)
    assert epipole.RigidTransform.from_quaternion([1, 0, 0, 0]) == epipole.RigidTransform()
    with pytest.raises(ValueError, match="rotation must be a rotation matrix"):
        epipole.RigidTransform(2 * np.eye(3))
    with pytest.raises(ValueError, match="quaternion must have length 1"):
        epipole.RigidTransform.from_quaternion([2, 0, 0, 0])


def test_functions_of_poses(world):
    pose = camera.look_at([0, 0, -5], [0, 0, 0], [0, -1, 0])
    np.testing.assert_allclose(pose @ [0, 0, 0], [0, 0, 5], atol=1e-12)
    relative = camera.relative_motion(pose, world.motion @ pose)
    np.testing.assert_allclose(relative.matrix(), world.motion.matrix(), atol=1e-12)
    t = np.array([1.0, 2.0, 3.0])
    np.testing.assert_array_equal(camera.cross_matrix(t) @ [4, 5, 6], np.cross(t, [4, 5, 6]))
    np.testing.assert_array_equal(camera.pixel_to_colmap([[1, 2]]), [[1.5, 2.5]])
    np.testing.assert_array_equal(camera.pixel_from_colmap([1.5, 2.5]), [1, 2])


def test_unknown_lens():
    with pytest.raises(TypeError, match="kind.*brown.*fisheye"):
        epipole.Lens("barrel")


@pytest.mark.parametrize("angle_rad", [0.0, 0.3, 3.0, np.pi])
def test_angle_of_a_rotation(angle_rad):
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    motion = epipole.RigidTransform([[c, 0, s], [0, 1, 0], [-s, 0, c]], [1, 2, 3])
    assert motion.angle_rad == pytest.approx(angle_rad, abs=1e-12)
    assert motion.inverse().angle_rad == pytest.approx(angle_rad, abs=1e-12)
