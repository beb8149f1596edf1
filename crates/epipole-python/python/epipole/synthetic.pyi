# Written by stubs.py. Do not edit.

from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import PosedCamera

__all__ = [
    "MultiViewProblem",
    "Sightings",
    "TwoViewProblem",
]

@final
class TwoViewProblem:
    """Matches between two images of 640 x 480 pixels, with ground truth.

    Parameters
    ----------
    **options : TwoViewProblemOptions
        ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``, ``"plane"`` and
        ``"corner"`` likewise; ``baseline_m``, ``distance_m``, ``noise_px``, ``outlier_fraction``,
        ``seed``.

    Raises
    ------
    epipole.DegenerateError
        If the overlap of the cameras is too small for ``num_points`` points.
    ValueError
        If an option is out of range.

    Examples
    --------
    >>> TwoViewProblem(num_points=50, seed=1).pixels1.shape
    (50, 2)
    """
    def __new__(cls, **options: Unpack[option_types.TwoViewProblemOptions]) -> TwoViewProblem: ...
    @property
    def camera1(self) -> PosedCamera:
        """First camera, at (0, 0, -distance), which looks along +z."""
    @property
    def camera2(self) -> PosedCamera:
        """Second camera, to the right of the first, which looks at the origin of the world."""
    @property
    def pixels1(self) -> NDArray[np.float64]:
        """Measured pixels in the first image, shape (N, 2)."""
    @property
    def pixels2(self) -> NDArray[np.float64]:
        """Matching pixels in the second image, shape (N, 2)."""
    @property
    def is_inlier(self) -> NDArray[np.bool_]:
        """Whether each match is correct up to noise, boolean array of shape (N,)."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points in the world, shape (N, 3)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class MultiViewProblem:
    """Cameras, points and observations, in images of 640 x 480 pixels, with ground truth.

    Parameters
    ----------
    **options : MultiViewProblemOptions
        ``num_cameras``, ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``,
        ``"plane"`` and ``"corner"`` likewise; ``path``, such as ``{"arc": {"radius_m": 6.0,
        "span_rad": 1.0}}`` or ``{"line": {"distance_m": 6.0, "spacing_m": 0.5}}``;
        ``visible_fraction``, ``noise_px``, ``outlier_fraction``, ``seed``.

    Raises
    ------
    epipole.TooFewError
        If there are fewer than 2 cameras.
    epipole.DegenerateError
        If too few points are visible in two cameras.
    ValueError
        If an option is out of range.
    """
    def __new__(
        cls,
        **options: Unpack[option_types.MultiViewProblemOptions],
    ) -> MultiViewProblem: ...
    @property
    def cameras(self) -> list[PosedCamera]:
        """Ground-truth cameras, a list of `epipole.camera.PosedCamera`."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Ground-truth points in the world, shape (P, 3)."""
    @property
    def observations(self) -> Sightings:
        """All observations, sorted by point, then by camera."""
    def tracks(self) -> list[Any]:
        """Returns the observations of each point.

        Returns
        -------
        list of Any
            Slices of the observations.
        """
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Sightings:
    """Observations of points by cameras; row k of each array belongs to observation k.

    Parameters
    ----------
    indices
        Indices of the camera and the point, int64 of shape (M, 2).
    pixels
        Measured pixels, shape (M, 2).
    is_inlier
        Whether each observation is correct up to noise, boolean array of shape (M,).
    """
    def __new__(
        cls,
        indices: NDArray[np.int64],
        pixels: NDArray[np.float64],
        is_inlier: NDArray[np.bool_],
    ) -> Sightings: ...
    @property
    def indices(self) -> NDArray[np.int64]:
        """Indices of the camera and the point, int64 of shape (M, 2)."""
    @property
    def pixels(self) -> NDArray[np.float64]:
        """Measured pixels, shape (M, 2)."""
    @property
    def is_inlier(self) -> NDArray[np.bool_]:
        """Whether each observation is correct up to noise, boolean array of shape (M,)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
