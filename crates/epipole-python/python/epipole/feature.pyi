# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types

__all__ = [
    "Features",
    "Keypoints",
    "Matches",
    "Neighbors",
    "ScaleOctave",
    "ScaleSpace",
    "ShiftSurface",
    "StructureTensor",
    "Tracks",
    "WindowTensor",
    "describe_patches",
    "describe_sift",
    "detect_features",
    "detect_orb",
    "detect_sift",
    "good_features_to_track",
    "harris_response",
    "match_descriptors",
    "min_eigenvalue_response",
    "nearest_few",
    "nearest_two",
    "non_maximum_suppression",
    "photo_to_gray",
    "refine_corners",
    "scale_space",
    "shift_surface",
    "sift_directions",
    "structure_tensor",
    "track_lucas_kanade",
]

@final
class Keypoints:
    """Detected positions in an image; row k of each array belongs to keypoint k.

    Parameters
    ----------
    points : array_like, shape (N, 2)
        (u, v) in pixels, pixel centers at integers.
    scales_px : array_like, shape (N,), optional
        Standard deviation of the blur at detection, pixels of the image. 1 by default.
    angles_rad : array_like, shape (N,), optional
        Direction, ``arctan2(v, u)`` with v down. 0 by default.
    responses : array_like, shape (N,), optional
        Response of the detector; larger is better. 0 by default.
    octaves : array_like of int, shape (N,), optional
        Octave or level of the pyramid. 0 by default.

    Notes
    -----
    A slice, a mask or an array of indices selects keypoints: ``keypoints[:100]``.
    """
    def __new__(
        cls,
        points: ArrayLike,
        scales_px: ArrayLike | None = None,
        angles_rad: ArrayLike | None = None,
        responses: ArrayLike | None = None,
        octaves: ArrayLike | None = None,
    ) -> Keypoints: ...
    @property
    def points(self) -> NDArray[np.float64]:
        """(u, v) in pixels, shape (N, 2)."""
    @property
    def scales_px(self) -> NDArray[np.float32]:
        """Standard deviation of the blur at detection, pixels of the image, float32 of shape (N,)."""
    @property
    def angles_rad(self) -> NDArray[np.float32]:
        """Direction, radians, float32 of shape (N,)."""
    @property
    def responses(self) -> NDArray[np.float32]:
        """Response of the detector, float32 of shape (N,)."""
    @property
    def octaves(self) -> NDArray[np.int32]:
        """Octave or level of the pyramid, int32 of shape (N,)."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: slice | ArrayLike, /) -> Keypoints:
        """Selects rows.

        Parameters
        ----------
        index : slice or array_like
            Slice, indices or boolean mask.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Features:
    """Keypoints and their descriptors, in the same order.

    Parameters
    ----------
    keypoints : Keypoints
    descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
        Floating-point numbers, compared by Euclidean distance, or 256 bits, by Hamming distance.

    Notes
    -----
    A slice, a mask or an array of indices selects features: ``features[:100]``.
    """
    def __new__(cls, keypoints: Keypoints, descriptors: ArrayLike) -> Features: ...
    @property
    def keypoints(self) -> Keypoints:
        """Keypoints."""
    @property
    def descriptors(self) -> NDArray[Any]:
        """Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for binary ones."""
    @property
    def points(self) -> NDArray[np.float64]:
        """Positions of the keypoints, (u, v) in pixels, shape (N, 2)."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: slice | ArrayLike, /) -> Features:
        """Selects rows.

        Parameters
        ----------
        index : slice or array_like
            Slice, indices or boolean mask.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Matches:
    """Matches between two lists of features.

    Parameters
    ----------
    indices
        Rows of the first and the second list, int64 of shape (M, 2).
    distances
        Distance between the descriptors: Euclidean, or the number of bits that differ, float32
        of shape (M,).
    ratios
        Ratio of nearest to second nearest distance, in [0, 1], float32 of shape (M,).
    """
    def __new__(
        cls,
        indices: NDArray[np.int64],
        distances: NDArray[np.float32],
        ratios: NDArray[np.float32],
    ) -> Matches: ...
    @property
    def indices(self) -> NDArray[np.int64]:
        """Rows of the first and the second list, int64 of shape (M, 2)."""
    @property
    def distances(self) -> NDArray[np.float32]:
        """Distance between the descriptors: Euclidean, or the number of bits that differ, float32
        of shape (M,).
        """
    @property
    def ratios(self) -> NDArray[np.float32]:
        """Ratio of nearest to second nearest distance, in [0, 1], float32 of shape (M,)."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Neighbors:
    """The two nearest descriptors for each descriptor.

    Parameters
    ----------
    indices
        Row of the nearest descriptor, int64 of shape (N,).
    distances
        Distance to the nearest descriptor, float32 of shape (N,).
    second_distances
        Distance to the second nearest, float32 of shape (N,); infinity if there is none.
    """
    def __new__(
        cls,
        indices: NDArray[np.int64],
        distances: NDArray[np.float32],
        second_distances: NDArray[np.float32],
    ) -> Neighbors: ...
    @property
    def indices(self) -> NDArray[np.int64]:
        """Row of the nearest descriptor, int64 of shape (N,)."""
    @property
    def distances(self) -> NDArray[np.float32]:
        """Distance to the nearest descriptor, float32 of shape (N,)."""
    @property
    def second_distances(self) -> NDArray[np.float32]:
        """Distance to the second nearest, float32 of shape (N,); infinity if there is none."""
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ScaleOctave:
    """Layers of a scale space with the same sampling.

    Parameters
    ----------
    octave
        Binary logarithm of the pixels per sample.
    step_px
        Pixels of the image per sample.
    origin
        Position of the first sample, pixels of the image, shape (2,).
    blurred
        Blurred images, float32 of shape (L, h, w).
    sigmas_px
        Standard deviation of the blur of each image, pixels of the image, shape (L,).
    differences
        Each blurred image minus the previous one, float32 of shape (L - 1, h, w).
    """
    def __new__(
        cls,
        octave: int,
        step_px: float,
        origin: NDArray[np.float64],
        blurred: NDArray[np.float32],
        sigmas_px: NDArray[np.float64],
        differences: NDArray[np.float32],
    ) -> ScaleOctave: ...
    @property
    def octave(self) -> int:
        """Binary logarithm of the pixels per sample."""
    @property
    def step_px(self) -> float:
        """Pixels of the image per sample."""
    @property
    def origin(self) -> NDArray[np.float64]:
        """Position of the first sample, pixels of the image, shape (2,)."""
    @property
    def blurred(self) -> NDArray[np.float32]:
        """Blurred images, float32 of shape (L, h, w)."""
    @property
    def sigmas_px(self) -> NDArray[np.float64]:
        """Standard deviation of the blur of each image, pixels of the image, shape (L,)."""
    @property
    def differences(self) -> NDArray[np.float32]:
        """Each blurred image minus the previous one, float32 of shape (L - 1, h, w)."""
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ScaleSpace:
    """Image at increasing blur, and the differences between neighboring blurs.

    Parameters
    ----------
    octaves : list of ScaleOctave
    """
    def __new__(cls, octaves: Sequence[ScaleOctave]) -> ScaleSpace: ...
    @property
    def octaves(self) -> list[ScaleOctave]:
        """Octaves, each with half as many samples per axis as the previous one."""
    def __eq__(self, other: object, /) -> bool: ...
    def answers(self, u: float, v: float) -> NDArray[np.float64]:
        """Returns the responses of the differences at a pixel.

        Parameters
        ----------
        u, v : float
            Pixels.

        Returns
        -------
        ndarray, shape (K, 2)
            Blur in pixels and difference, by increasing blur.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class StructureTensor:
    """Matrix ``M = sum w [[Iu*Iu, Iu*Iv], [Iu*Iv, Iv*Iv]]`` at each pixel.

    Parameters
    ----------
    uu
        ``sum w Iu*Iu``, float32 of shape (H, W).
    uv
        ``sum w Iu*Iv``, float32 of shape (H, W).
    vv
        ``sum w Iv*Iv``, float32 of shape (H, W).
    """
    def __new__(
        cls,
        uu: NDArray[np.float32],
        uv: NDArray[np.float32],
        vv: NDArray[np.float32],
    ) -> StructureTensor: ...
    @property
    def uu(self) -> NDArray[np.float32]:
        """``sum w Iu*Iu``, float32 of shape (H, W)."""
    @property
    def uv(self) -> NDArray[np.float32]:
        """``sum w Iu*Iv``, float32 of shape (H, W)."""
    @property
    def vv(self) -> NDArray[np.float32]:
        """``sum w Iv*Iv``, float32 of shape (H, W)."""
    def __eq__(self, other: object, /) -> bool: ...
    def eigenvalues(self, u: int, v: int) -> tuple[float, float] | None:
        """Returns the eigenvalues at a pixel, the larger first; None outside the image.

        Parameters
        ----------
        u, v : int
            Column and row.
        """
    def at(self, u: int, v: int) -> WindowTensor | None:
        """Returns the tensor at a pixel; None outside the image.

        Parameters
        ----------
        u, v : int
            Column and row.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ShiftSurface:
    """Squared change of a window under integer shifts up to a maximum.

    Parameters
    ----------
    values
        Squared change under the shift (du, dv) at ``[reach + dv, reach + du]``, shape
        (2 * reach + 1, 2 * reach + 1).
    """
    def __new__(cls, values: NDArray[np.float64]) -> ShiftSurface: ...
    @property
    def values(self) -> NDArray[np.float64]:
        """Squared change under the shift (du, dv) at ``[reach + dv, reach + du]``, shape
        (2 * reach + 1, 2 * reach + 1).
        """
    @property
    def reach(self) -> int:
        """Maximum shift to each side, pixels."""
    def __eq__(self, other: object, /) -> bool: ...
    def at(self, du: int, dv: int) -> float | None:
        """Returns the squared change for a shift (`du`, `dv`); None beyond the reach.

        Parameters
        ----------
        du, dv : int
            Shift along columns and rows, pixels.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class WindowTensor:
    """Matrix ``M = sum [[Iu*Iu, Iu*Iv], [Iu*Iv, Iv*Iv]]`` of one window.

    Parameters
    ----------
    uu
        ``sum Iu*Iu``.
    uv
        ``sum Iu*Iv``.
    vv
        ``sum Iv*Iv``.
    """
    def __new__(cls, uu: float, uv: float, vv: float) -> WindowTensor: ...
    @property
    def uu(self) -> float:
        """``sum Iu*Iu``."""
    @property
    def uv(self) -> float:
        """``sum Iu*Iv``."""
    @property
    def vv(self) -> float:
        """``sum Iv*Iv``."""
    def __eq__(self, other: object, /) -> bool: ...
    @staticmethod
    def from_gradients(gradients: ArrayLike) -> WindowTensor:
        """Computes the tensor from the gradients (Iu, Iv) of a window's pixels.

        Parameters
        ----------
        gradients : array_like, shape (N, 2)
        """
    @staticmethod
    def at(
        image: ArrayLike,
        pixel: tuple[int, int],
        **options: Unpack[option_types.StructureTensorOptions],
    ) -> WindowTensor:
        """Computes the tensor at one pixel of an image, equal to that of `structure_tensor`.

        Parameters
        ----------
        image : array_like, shape (H, W)
            Gray; uint8 values are divided by 255.
        pixel : tuple of int
            Column and row.
        **options : StructureTensorOptions
            See `structure_tensor`.

        Raises
        ------
        ValueError
            If the pixel is outside the image, a box window is outside 1 to 255 pixels, or a
            Gaussian window is outside (0, 31].
        """
    def determinant(self) -> float:
        """Returns the product of the eigenvalues."""
    def trace(self) -> float:
        """Returns the sum of the eigenvalues."""
    def eigenvalues(self) -> tuple[float, float]:
        """Returns the eigenvalues, the larger first."""
    def direction_rad(self) -> float:
        """Returns the direction of the larger eigenvalue, ``arctan2(v, u)`` with v down, radians."""
    def harris(self, k: float) -> float:
        """Returns the Harris response ``det M - k * trace(M)**2``.

        Parameters
        ----------
        k : float
            Weight of the squared trace, such as 0.04.
        """
    def change(self, shift: ArrayLike) -> float:
        """Approximates the squared change of the window under a small shift.

        Parameters
        ----------
        shift : array_like, shape (2,)
            Pixels.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class Tracks:
    """Points tracked from one image to the next; row k belongs to point k.

    Parameters
    ----------
    points
        Positions in the second image, pixels, shape (N, 2); NaN for lost points.
    found
        Whether each point was tracked, boolean array of shape (N,).
    residuals
        Mean absolute difference of gray values between the two windows, float32 of shape (N,);
        NaN for lost points.
    forward_backward_px
        Distance between each point and its position after tracking back, pixels, shape (N,);
        NaN for lost points, and without that check.
    """
    def __new__(
        cls,
        points: NDArray[np.float64],
        found: NDArray[np.bool_],
        residuals: NDArray[np.float32],
        forward_backward_px: NDArray[np.float64],
    ) -> Tracks: ...
    @property
    def points(self) -> NDArray[np.float64]:
        """Positions in the second image, pixels, shape (N, 2); NaN for lost points."""
    @property
    def found(self) -> NDArray[np.bool_]:
        """Whether each point was tracked, boolean array of shape (N,)."""
    @property
    def residuals(self) -> NDArray[np.float32]:
        """Mean absolute difference of gray values between the two windows, float32 of shape (N,);
        NaN for lost points.
        """
    @property
    def forward_backward_px(self) -> NDArray[np.float64]:
        """Distance between each point and its position after tracking back, pixels, shape (N,);
        NaN for lost points, and without that check.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self) -> int: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

def photo_to_gray(photo: ArrayLike) -> NDArray[np.float32]:
    """Converts a photo to gray in [0, 1], as input for the detectors.

    Parameters
    ----------
    photo : array_like, shape (H, W, 3)
        uint8, in the order red, green, blue. For images from `cv2.imread`, pass
        ``photo[..., ::-1]``.

    Returns
    -------
    ndarray of float32, shape (H, W)
    """
def detect_features(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.FeatureOptions],
) -> Features:
    """Detects the features of an image, strongest first.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : FeatureOptions
        ``kind``: ``"root_sift"`` (the default), ``"sift"``, ``"orb"`` or ``"harris"``;
        ``max_features=8192``, 0 for no limit; ``upright=False``; and options of each kind.

    Returns
    -------
    Features
        Descriptors are float32, or uint8 (bits) for ORB.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], or an option is out of range.
    """
def detect_sift(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SiftOptions],
) -> Features:
    """Detects the SIFT features of an image, strongest first.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SiftOptions
        For example ``max_features`` (0 for no limit), ``contrast_threshold``, ``upsample``,
        ``upright``, ``normalization="root"`` for RootSIFT.

    Returns
    -------
    Features
        Descriptors are float32 of shape (N, 128), integers from 0 to 255.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], or an option is out of range.
    """
def detect_orb(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.OrbOptions],
) -> Features:
    """Detects the ORB features of an image, strongest first.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : OrbOptions
        For example ``max_features``, ``num_levels``, ``scale_factor``, ``fast_threshold`` (for gray
        values in [0, 1]), ``upright``.

    Returns
    -------
    Features
        Descriptors are bits in uint8, shape (N, 32).

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], or an option is out of range.
    """
def describe_sift(
    image: ArrayLike,
    keypoints: Keypoints | ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SiftOptions],
) -> NDArray[np.float32]:
    """Computes SIFT descriptors at given positions, scales and directions.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    keypoints : Keypoints or array_like, shape (N, 2)
        Points without scale and direction get a scale of 1 pixel and the direction 0.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SiftOptions
        See `detect_sift`.

    Returns
    -------
    ndarray of float32, shape (N, 128)

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], an option is out of range, or the scale of a
        keypoint is not above 0.
    """
def sift_directions(
    image: ArrayLike,
    keypoints: Keypoints | ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SiftOptions],
) -> list[NDArray[np.float32]]:
    """Computes the dominant gradient directions around given positions.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    keypoints : Keypoints or array_like, shape (N, 2)
        Points without scale get a scale of 1 pixel.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SiftOptions
        See `detect_sift`.

    Returns
    -------
    list of ndarray of float32
        Directions of each keypoint, radians, strongest first.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], an option is out of range, or the scale of a
        keypoint is not above 0.
    """
def describe_patches(
    image: ArrayLike,
    keypoints: Keypoints | ArrayLike,
    size: int,
    spacing_px: float = 1.0,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Computes zero-mean, unit-length patches of gray values around keypoints.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    keypoints : Keypoints or array_like, shape (N, 2)
    size : int
        Samples along a side, 2 to 64.
    spacing_px : float, optional
        Distance between samples, pixels, > 0.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (N, size**2)
        Inner products are normalized cross-correlations.

    Raises
    ------
    ValueError
        If ``size`` is outside 2 to 64, or ``spacing_px`` is not above 0.
    """
def scale_space(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.SiftOptions],
) -> ScaleSpace:
    """Computes the scale space of an image.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : SiftOptions
        See `detect_sift`.

    Returns
    -------
    ScaleSpace
        No octaves for an image smaller than about a dozen pixels.

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], or an option is out of range.
    """
def harris_response(
    image: ArrayLike,
    k: float,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.StructureTensorOptions],
) -> NDArray[np.float32]:
    """Computes the Harris response at each pixel, ``det M - k * trace(M)**2`` (structure tensor M).

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    k : float
        In [0, 0.25), usually 0.04 to 0.06.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : StructureTensorOptions
        See `structure_tensor`.

    Returns
    -------
    ndarray of float32, shape (H, W)
        Positive at corners, negative along edges.

    Raises
    ------
    ValueError
        If ``k`` is outside [0, 0.25), a box window is outside 1 to 255 pixels, or a Gaussian window
        is outside (0, 31].
    """
def min_eigenvalue_response(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.StructureTensorOptions],
) -> NDArray[np.float32]:
    """Computes the smaller eigenvalue of the structure tensor at each pixel (Shi and Tomasi).

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : StructureTensorOptions
        See `structure_tensor`.

    Returns
    -------
    ndarray of float32, shape (H, W)

    Raises
    ------
    ValueError
        If a box window is outside 1 to 255 pixels, or a Gaussian window is outside (0, 31].
    """
def good_features_to_track(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.GoodFeaturesOptions],
) -> Keypoints:
    """Finds the corners of an image, strongest first, at integer pixels.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : GoodFeaturesOptions
        For example ``max_corners`` (0 for no limit), ``quality`` (relative to the strongest
        response), ``min_distance_px``, ``measure={"harris": 0.04}``, ``grid={"columns": 4, "rows":
        3}``.

    Returns
    -------
    Keypoints

    Raises
    ------
    ValueError
        If ``quality`` is outside (0, 1], ``min_distance_px`` is below 0, the grid has no cells, or
        ``measure`` or ``tensor`` is out of range.
    """
def non_maximum_suppression(
    response: ArrayLike,
    radius: int,
    threshold: float,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> Keypoints:
    """Finds the local maxima of a response, strongest first.

    Parameters
    ----------
    response : array_like, shape (H, W)
    radius : int
        Pixels, >= 1: the window is ``2 * radius + 1`` wide.
    threshold : float
        Smaller responses are ignored.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    Keypoints

    Raises
    ------
    ValueError
        If ``radius`` is 0.
    """
def refine_corners(
    image: ArrayLike,
    corners: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.RefineOptions],
) -> NDArray[np.float64]:
    """Refines corners to subpixel positions, from the gradients around them.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    corners : array_like, shape (N, 2)
        Pixels.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : RefineOptions
        ``half_window``, pixels; ``max_iterations``; ``tolerance_px``.

    Returns
    -------
    ndarray, shape (N, 2)
        Rows of NaN where the window contains no corner.

    Raises
    ------
    ValueError
        If ``half_window`` is outside 1 to 50, or ``tolerance_px`` is not above 0.
    """
def structure_tensor(
    image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.StructureTensorOptions],
) -> StructureTensor:
    """Computes the structure tensor of an image.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : StructureTensorOptions
        ``derivative``: ``"sobel3"``, ``"sobel5"`` or ``"scharr"``; ``window``: ``{"box": 3}`` or
        ``{"gaussian": 1.5}``, pixels; ``scaling``: ``"textbook"`` or ``"open_cv"``; ``border``.

    Returns
    -------
    StructureTensor

    Raises
    ------
    ValueError
        If a box window is outside 1 to 255 pixels, or a Gaussian window is outside (0, 31].
    """
def shift_surface(
    image: ArrayLike,
    center: tuple[int, int],
    half_window: int,
    reach: int,
    border: str | Mapping[str, Any] | None = None,
) -> ShiftSurface:
    """Computes the squared change of a window of an image under shifts.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    center : tuple of int
        Column and row of the window's center.
    half_window : int
        The window is ``2 * half_window + 1`` pixels wide; at most 127.
    reach : int
        Maximum shift to each side, pixels, at most 127.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    ShiftSurface

    Raises
    ------
    ValueError
        If ``center`` is outside the image, or ``half_window`` or ``reach`` is above 127.
    """
def match_descriptors(
    descriptors1: Features | ArrayLike,
    descriptors2: Features | ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.MatchOptions],
) -> Matches:
    """Matches two lists of descriptors, in the order of the first.

    Parameters
    ----------
    descriptors1, descriptors2 : Features or array_like
        Floats of shape (N, D), or bits in uint8 of shape (N, 32), as in OpenCV.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : MatchOptions
        ``max_ratio``, in (0, 1], or None for no ratio test; ``mutual``; ``max_distance``;
        ``unique``.

    Returns
    -------
    Matches

    Raises
    ------
    epipole.DegenerateError
        If one list has float and the other binary descriptors.
    ValueError
        If ``max_ratio`` is outside (0, 1], or ``max_distance`` is below 0.

    Examples
    --------
    >>> match_descriptors(np.eye(2, 4), np.eye(2, 4)).indices.tolist()
    [[0, 0], [1, 1]]
    """
def nearest_two(
    descriptors1: Features | ArrayLike,
    descriptors2: Features | ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> Neighbors:
    """Finds the two nearest descriptors in the second list for each in the first, exactly.

    Parameters
    ----------
    descriptors1, descriptors2 : Features or array_like
        Floats of shape (N, D), or bits in uint8 of shape (N, 32).
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    Neighbors

    Raises
    ------
    epipole.DegenerateError
        If one list has float and the other binary descriptors.
    """
def nearest_few(
    query: ArrayLike,
    list: Features | ArrayLike,
    count: int,
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """Finds the descriptors in a list that are nearest to one descriptor, nearest first.

    Parameters
    ----------
    query : array_like, shape (D,)
    list : Features or array_like
        Floats of shape (N, D), or bits in uint8 of shape (N, 32), which count as D = 256 numbers 0
        and 1, lowest bit first.
    count : int
        Maximum number of entries.

    Returns
    -------
    indices : ndarray of int64, shape (K,)
    distances : ndarray of float32, shape (K,)
        Euclidean distances.
    """
def track_lucas_kanade(
    first: ArrayLike,
    second: ArrayLike,
    points: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.TrackOptions],
) -> Tracks:
    """Tracks points from one image to the next (Lucas and Kanade, on a pyramid).

    Parameters
    ----------
    first, second : array_like, shape (H, W)
        Gray, uint8 or float in [0, 1].
    points : array_like, shape (N, 2)
        Pixels of the first image.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : TrackOptions
        ``half_window``, pixels; ``num_levels``; ``max_iterations``; ``tolerance_px``;
        ``min_eigenvalue``; ``max_forward_backward_px``, or None for no check.

    Returns
    -------
    Tracks

    Raises
    ------
    ValueError
        If gray values are outside [-0.5, 1.5], or an option is out of range.
    """
