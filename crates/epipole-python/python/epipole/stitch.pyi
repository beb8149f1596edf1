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
    """Two overlapping photos and their inliers.

    Parameters
    ----------
    images : tuple of int
        Indices of the photos.
    pixels1, pixels2 : array_like, shape (N, 2)
        Inlier matches.
    homography : array_like, shape (3, 3)
        From the first photo to the second, at any scale.
    num_matches : int
        Number of matches, including outliers.
    has_parallax : bool
        Whether the matches show parallax: the camera moved, and no homography fits all of them.
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
        """Pixels of the inliers in the first photo, shape (N, 2)."""
    @property
    def pixels2(self) -> NDArray[np.float64]:
        """Pixels of the inliers in the second photo, shape (N, 2)."""
    @property
    def homography(self) -> NDArray[np.float64]:
        """H from the first photo to the second, shape (3, 3)."""
    @property
    def num_matches(self) -> int:
        """Number of matches, including outliers."""
    @property
    def has_parallax(self) -> bool:
        """Whether the matches show parallax, because the camera moved."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Panorama:
    """Photos in the frame of a panorama, which looks along z with y down.

    Parameters
    ----------
    pixel_from_direction : list of array_like or None
        Matrix M of each photo, shape (3, 3), which maps a direction to a homogeneous pixel.
    rotations : list of array_like or None
        Rotation of each camera, for rotating cameras: ``d_in_cam = R @ d``.
    scale_px : float
        Pixels per unit of a direction at z = 1.
    focal_factor : float, optional
        Common factor of the focal lengths, if it was estimated.
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
        """Matrix of each photo, direction to homogeneous pixel, shape (3, 3); None without overlap."""
    @property
    def rotations(self) -> list[NDArray[np.float64] | None]:
        """Rotation of each camera, shape (3, 3), for rotating cameras, or None."""
    @property
    def scale_px(self) -> float:
        """Pixels per unit of a direction at z = 1: the focal length, for rotating cameras."""
    @property
    def focal_factor(self) -> float | None:
        """Common factor of the focal lengths, or None."""
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
    """Finds the homography on which the matches of two photos agree, and detects parallax.

    Parameters
    ----------
    images : tuple of int
        Indices of the photos.
    pixels1, pixels2 : array_like, shape (N, 2)
        Matches, including outliers.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : OverlapOptions
        ``ransac``, a dict such as ``{"max_error_px": 3.0}``; ``min_num_inliers``.

    Returns
    -------
    Overlap or None
        None if no more matches agree than wrong ones might by chance.

    Raises
    ------
    epipole.DegenerateError
        If all pixels of an image are on a line.
    ValueError
        If ``max_error_px``, ``confidence`` or ``max_iterations`` of ``ransac`` is out of range.

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
    """Estimates the rotations of photos from one position, with a common focal length factor.

    Parameters
    ----------
    intrinsics : list of Intrinsics
        K of each photo; focal lengths are known or guessed.
    overlaps : list of Overlap
    find_focal : bool, optional
        Whether to estimate a common factor of all focal lengths, from 1/4 to 4.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    Panorama

    Raises
    ------
    epipole.DegenerateError
        If there are no overlaps, or the matches of an overlap coincide.
    ValueError
        If an overlap refers to a missing photo.
    """
def chain_homographies(num_images: int, overlaps: Sequence[Overlap]) -> Panorama:
    """Aligns photos of a plane by homographies from one to the next.

    Parameters
    ----------
    num_images : int
        Number of photos.
    overlaps : list of Overlap

    Returns
    -------
    Panorama
        To render with ``surface="plane"``.

    Raises
    ------
    epipole.DegenerateError
        If there are no overlaps.
    ValueError
        If an overlap refers to a missing photo.
    """
def render_panorama(
    panorama: Panorama,
    photos: Sequence[ArrayLike],
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RenderOptions],
) -> NDArray[np.uint8]:
    """Renders all photos of a panorama on a surface; black where there is none.

    Parameters
    ----------
    panorama : Panorama
    photos : list of array_like of uint8, shape (H, W, 3)
        In the order of the panorama.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RenderOptions
        ``surface``, ``"cylinder"``, ``"plane"`` or ``"sphere"``; ``blend``, ``"bands"``,
        ``"feather"`` or ``"seams"``; ``gains``, whether to compensate exposure; ``max_pixels``.

    Returns
    -------
    ndarray of uint8, shape (H, W, 3)

    Raises
    ------
    epipole.DegenerateError
        If a photo extends beyond the surface.
    """
