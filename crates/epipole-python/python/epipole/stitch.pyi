# Written by stubs.py. Do not edit.

from collections.abc import Callable, Sequence
from typing import ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types
from epipole.camera import Intrinsics

__all__ = [
    "Overlap",
    "Panorama",
    "chain_homographies",
    "estimate_panorama",
    "find_overlap",
    "render_panorama",
]

@final
class Overlap:
    """Two photos that overlap, and the matches that agree.

    Parameters
    ----------
    images : tuple of int
        Indices of the photos.
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches that agree.
    homography : array_like, shape (3, 3)
        From the first photo to the second, up to scale.
    num_matches : int
        Number of matches, with those that do not agree.
    has_parallax : bool
        Whether no homography fits all matches, since the camera moved.
    """
    def __new__(
        cls,
        images: Sequence[int],
        pixels1: ArrayLike,
        pixels2: ArrayLike,
        homography: ArrayLike,
        num_matches: int,
        has_parallax: bool,
    ) -> Overlap: ...
    @property
    def images(self) -> tuple[int, int]:
        """Indices of the photos."""
    @property
    def pixels1(self) -> NDArray[np.float64]:
        """Pixels of the matches that agree in the first photo, shape (N, 2)."""
    @property
    def pixels2(self) -> NDArray[np.float64]:
        """Pixels of the matches that agree in the second photo, shape (N, 2)."""
    @property
    def homography(self) -> NDArray[np.float64]:
        """H from the first photo to the second, shape (3, 3)."""
    @property
    def num_matches(self) -> int:
        """Number of matches, with those that do not agree."""
    @property
    def has_parallax(self) -> bool:
        """Whether the matches show depth: the camera moved."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Panorama:
    """Photos in the frame of a panorama, which looks along z with y down.

    Parameters
    ----------
    pixel_from_direction : list of array_like or None
        For each photo M, shape (3, 3), which maps a direction to a homogeneous pixel.
    rotations : list of array_like or None
        Rotation of each camera that turned: ``d_in_cam = R @ d``.
    scale_px : float
        Pixels per unit of a direction at z = 1.
    focal_factor : float, optional
        Factor of all focal lengths, if one was found.
    """
    def __new__(
        cls,
        pixel_from_direction: Sequence[ArrayLike] | None,
        rotations: Sequence[ArrayLike] | None,
        scale_px: float,
        focal_factor: float | None = None,
    ) -> Panorama: ...
    @property
    def pixel_from_direction(self) -> list[NDArray[np.float64] | None]:
        """For each photo M, shape (3, 3), which maps a direction to a homogeneous pixel, or None for
        photos that overlap no other.
        """
    @property
    def rotations(self) -> list[NDArray[np.float64] | None]:
        """Rotation of each camera that turned, shape (3, 3), or None."""
    @property
    def scale_px(self) -> float:
        """Pixels per unit of a direction at z = 1: the focal length, for cameras that turned."""
    @property
    def focal_factor(self) -> float | None:
        """Factor of all focal lengths, or None."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def find_overlap(
    images: Sequence[int],
    pixels1: ArrayLike,
    pixels2: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.OverlapOptions],
) -> Overlap | None:
    """Homography that the matches of two photos agree on, and whether there is parallax.

    Parameters
    ----------
    images : tuple of int
        Indices of the photos.
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, wrong ones among them.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : OverlapOptions
        ``ransac``, a dict such as ``{"max_error_px": 3.0}``; ``min_num_inliers``.

    Returns
    -------
    Overlap or None
        None if no more matches agree than wrong ones might.

    Raises
    ------
    epipole.DegenerateError
        All pixels of an image on one line.
    ValueError
        ``max_error_px``, ``confidence`` or ``max_iterations`` of ``ransac`` out of range.

    Examples
    --------
    >>> steps = np.arange(60)
    >>> pixels = np.column_stack([200 + steps * 37 % 440, steps * 71 % 480])
    >>> h = find_overlap((0, 1), pixels, pixels - [200, 0]).homography
    >>> round(float(h[0, 2] / h[2, 2]), 3)
    -200.0
    """
def estimate_panorama(
    intrinsics: Sequence[Intrinsics],
    overlaps: Sequence[Overlap],
    find_focal: bool = False,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> Panorama:
    """Rotations of photos taken from one place, with one factor of their focal lengths.

    Parameters
    ----------
    intrinsics : list of Intrinsics
        K of each photo; focal lengths are known or guessed.
    overlaps : list of Overlap
    find_focal : bool, optional
        Whether to find one factor of all focal lengths, from 1/4 to 4.
    progress : callable, optional
        Called with the stage and the completed share.

    Returns
    -------
    Panorama

    Raises
    ------
    epipole.DegenerateError
        No overlaps, or one whose matches meet in a point.
    ValueError
        Overlap of a photo that does not exist.
    """
def chain_homographies(num_images: int, overlaps: Sequence[Overlap]) -> Panorama:
    """Places of photos of one plane, by homographies from one to the next.

    Parameters
    ----------
    num_images : int
        Number of photos.
    overlaps : list of Overlap

    Returns
    -------
    Panorama
        To be rendered with ``surface="plane"``.

    Raises
    ------
    epipole.DegenerateError
        No overlaps.
    ValueError
        Overlap of a photo that does not exist.
    """
def render_panorama(
    panorama: Panorama,
    photos: Sequence[ArrayLike],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RenderOptions],
) -> NDArray[np.uint8]:
    """Image of all photos of a panorama on a surface; black where there is none.

    Parameters
    ----------
    panorama : Panorama
    photos : list of array_like of uint8, shape (H, W, 3)
        In the order of the panorama.
    progress : callable, optional
        Called with the stage and the completed share.
    **options : RenderOptions
        ``surface``, ``"cylinder"``, ``"plane"`` or ``"sphere"``; ``blend``, ``"bands"``,
        ``"feather"`` or ``"seams"``; ``gains``, whether exposures are made alike; ``max_pixels``.

    Returns
    -------
    ndarray of uint8, shape (H, W, 3)

    Raises
    ------
    epipole.DegenerateError
        Photo that looks beyond the surface.
    """
