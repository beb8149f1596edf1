"""Points moved by homographies."""
import numpy as np


def homogeneous(p):
    return np.c_[p, np.ones(len(p))]


def move(h, p):
    q = homogeneous(p) @ h.T
    return q[:, :2] / q[:, 2:]


def inside(p, size):
    """Which points lie in an image of this width and height."""
    return ((p >= 0) & (p <= np.array(size) - 1)).all(1)


def shared_grid(h, size1, size2):
    """A grid of 40 × 40 on image 1, as far as image 2 shows it."""
    lines = (np.linspace(0, length - 1, 40) for length in size1)
    grid = np.stack(np.meshgrid(*lines), -1).reshape(-1, 2)
    return grid[inside(move(h, grid), size2)]
