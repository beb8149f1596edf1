"""Synthetic cameras and matches, made with NumPy alone."""

from dataclasses import dataclass

import epipole
import numpy as np
import pytest


def rotation(axis, angle_rad):
    """Rotation matrix by Rodrigues' formula."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * k + (1 - np.cos(angle_rad)) * k @ k


def project(k, r, t, points):
    """Pixels of points in the world."""
    x = (points @ r.T + t) @ k.T
    return x[:, :2] / x[:, 2:]


@dataclass
class World:
    """Two cameras, points, their pixels, and the ground truth."""

    k: np.ndarray
    rotation: np.ndarray
    translation: np.ndarray
    points: np.ndarray
    pixels1: np.ndarray
    pixels2: np.ndarray

    @property
    def camera(self):
        return epipole.Camera.pinhole(epipole.Intrinsics.from_matrix(self.k), 640, 480)

    @property
    def intrinsics(self):
        return self.camera.intrinsics

    @property
    def motion(self):
        return epipole.RigidTransform(self.rotation, self.translation)

    @property
    def posed(self):
        first = epipole.PosedCamera(self.camera, epipole.RigidTransform())
        return first, epipole.PosedCamera(self.camera, self.motion)

    @property
    def essential(self):
        return np.cross(np.eye(3), self.translation).T @ self.rotation

    @property
    def fundamental(self):
        inverse = np.linalg.inv(self.k)
        return inverse.T @ self.essential @ inverse

    @property
    def rays1(self):
        return self.points / self.points[:, 2:]

    @property
    def rays2(self):
        x = self.points @ self.rotation.T + self.translation
        return x / x[:, 2:]


def make_world(num_points=60, plane=False):
    random = np.random.default_rng(1)
    k = np.array([[500.0, 0, 320], [0, 510.0, 240], [0, 0, 1]])
    points = random.uniform([-2, -1.5, 4], [2, 1.5, 9], (num_points, 3))
    if plane:
        points[:, 2] = 6 + 0.3 * points[:, 0]
    r, t = rotation([0.2, 1.0, 0.1], 0.1), np.array([-0.8, 0.1, 0.2])
    t /= np.linalg.norm(t)
    pixels1 = project(k, np.eye(3), np.zeros(3), points)
    return World(k, r, t, points, pixels1, project(k, r, t, points))


@pytest.fixture
def world():
    return make_world()


@pytest.fixture
def plane():
    return make_world(plane=True)


@pytest.fixture
def outliers(world):
    """Matches of the world, the last third of them wrong."""
    pixels2 = world.pixels2.copy()
    # The camera moves sideways: a shift along v leaves the epipolar line.
    pixels2[40:, 1] += np.random.default_rng(2).uniform(30, 150, 20)
    return world.pixels1, pixels2


def same_up_to_scale(a, b, tolerance=1e-6):
    """Whether two matrices are proportional."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    return min(np.linalg.norm(a - b), np.linalg.norm(a + b)) < tolerance
