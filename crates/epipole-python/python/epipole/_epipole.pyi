# Written by stubs.py. Do not edit.

from typing import final


from epipole import absolute_pose as absolute_pose
from epipole import calibration as calibration
from epipole import camera as camera
from epipole import epipolar as epipolar
from epipole import feature as feature
from epipole import homography as homography
from epipole import imaging as imaging
from epipole import io as io
from epipole import math as math
from epipole import mvs as mvs
from epipole import optim as optim
from epipole import robust as robust
from epipole import sfm as sfm
from epipole import stereo as stereo
from epipole import stitch as stitch
from epipole import synthetic as synthetic
from epipole import triangulation as triangulation
from epipole import two_view as two_view

__all__ = [
    "DegenerateError",
    "Error",
    "NoConsensusError",
    "Threads",
    "TooFewError",
    "__version__",
    "absolute_pose",
    "calibration",
    "camera",
    "epipolar",
    "feature",
    "homography",
    "imaging",
    "io",
    "math",
    "mvs",
    "num_threads",
    "optim",
    "robust",
    "sfm",
    "stereo",
    "stitch",
    "synthetic",
    "threads",
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

@final
class Threads:
    """Block with a number of threads, created by `epipole.threads`."""
    def __enter__(self, /) -> None: ...
    def __exit__(self, /, *exception: object) -> None: ...

def threads(count: int) -> Threads:
    """Limits the number of threads for calls inside a `with` block, in the current Python thread.

    Results do not depend on the number of threads.

    Parameters
    ----------
    count : int
        1 to 1024.

    Returns
    -------
    Threads

    Raises
    ------
    ValueError
        If ``count`` is outside 1 to 1024.
    OSError
        If the system cannot start more threads.

    Examples
    --------
    >>> with epipole.threads(1):
    ...     epipole.num_threads()
    1
    """
def num_threads() -> int:
    """Returns the number of threads that calls use.

    Returns
    -------
    int
        Set by the enclosing `epipole.threads`, else by `RAYON_NUM_THREADS`, else by the number of
        cores.
    """
