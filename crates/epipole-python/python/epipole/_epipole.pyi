# Written by stubs.py. Do not edit.

from epipole import absolute_pose as absolute_pose
from epipole import camera as camera
from epipole import epipolar as epipolar
from epipole import homography as homography
from epipole import robust as robust
from epipole import triangulation as triangulation
from epipole import two_view as two_view

__all__ = [
    "DegenerateError",
    "Error",
    "NoConsensusError",
    "TooFewError",
    "__version__",
    "absolute_pose",
    "camera",
    "epipolar",
    "homography",
    "robust",
    "triangulation",
    "two_view",
]

__version__: str

class Error(Exception):
    """Base class of the errors of data without a result."""

class TooFewError(Error):
    """Too few data for a result."""

class DegenerateError(Error):
    """Data that do not determine the result."""

class NoConsensusError(Error):
    """No model with enough support."""
