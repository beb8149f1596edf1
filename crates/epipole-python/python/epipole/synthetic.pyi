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
    """Matches between two images of 640 x 480 pixels, with the truth about them.

    Parameters
    ----------
    **options : TwoViewProblemOptions
        ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``, ``"plane"`` or
        ``"corner"`` likewise; ``baseline_m``, ``distance_m``, ``noise_px``,
        ``outlier_fraction``, ``seed``.

    Raises
    ------
    epipole.DegenerateError
        Cameras that have too little in common to see ``num_points`` points.
    ValueError
        Option out of range.

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
        """Second camera, to the right of it, which looks at the world's origin."""
    @property
    def pixels1(self) -> NDArray[np.float64]:
        """Measured pixels in the first image, shape (N, 2)."""
    @property
    def pixels2(self) -> NDArray[np.float64]:
        """Their matches in the second image, shape (N, 2)."""
    @property
    def is_inlier(self) -> NDArray[np.bool_]:
        """Whether a match is right up to noise, boolean array of shape (N,)."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Points in the world, shape (N, 3)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class MultiViewProblem:
    """Cameras, points and observations, in images of 640 x 480 pixels, with the truth about them.

    Parameters
    ----------
    **options : MultiViewProblemOptions
        ``num_cameras``, ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``,
        ``"plane"`` or ``"corner"`` likewise; ``path``, such as
        ``{"arc": {"radius_m": 6.0, "span_rad": 1.0}}`` or
        ``{"line": {"distance_m": 6.0, "spacing_m": 0.5}}``; ``visible_fraction``, ``noise_px``,
        ``outlier_fraction``, ``seed``.

    Raises
    ------
    epipole.TooFewError
        Fewer than 2 cameras.
    epipole.DegenerateError
        Too few points that two cameras see.
    ValueError
        Option out of range.
    """
    def __new__(
        cls,
        **options: Unpack[option_types.MultiViewProblemOptions],
    ) -> MultiViewProblem: ...
    @property
    def cameras(self) -> list[PosedCamera]:
        """True cameras, a list of `epipole.camera.PosedCamera`."""
    @property
    def points(self) -> NDArray[np.float64]:
        """True points, in the world, shape (P, 3)."""
    @property
    def observations(self) -> Sightings:
        """All observations, by point, and of one point by camera."""
    def tracks(self) -> list[Any]:
        """Observations of each point.

        Returns
        -------
        list of Any
            Slices into the observations.
        """
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Sightings:
    """Points seen by cameras; row k of each array belongs to observation k.

    Parameters
    ----------
    indices
        Index of the camera and of the point, int64 of shape (M, 2).
    pixels
        Measured pixels, shape (M, 2).
    is_inlier
        Whether an observation is right up to noise, boolean array of shape (M,).
    """
    def __new__(
        cls,
        indices: NDArray[np.int64],
        pixels: NDArray[np.float64],
        is_inlier: NDArray[np.bool_],
    ) -> Sightings: ...
    @property
    def indices(self) -> NDArray[np.int64]:
        """Index of the camera and of the point, int64 of shape (M, 2)."""
    @property
    def pixels(self) -> NDArray[np.float64]:
        """Measured pixels, shape (M, 2)."""
    @property
    def is_inlier(self) -> NDArray[np.bool_]:
        """Whether an observation is right up to noise, boolean array of shape (M,)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
