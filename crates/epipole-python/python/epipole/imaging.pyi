# Written by stubs.py. Do not edit.

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from epipole import options as option_types

__all__ = [
    "BT601_WEIGHTS",
    "BT709_WEIGHTS",
    "Gradient",
    "IntegralImage",
    "box_filter",
    "centered_difference",
    "correlate",
    "derivative",
    "from_laplacian_pyramid",
    "gaussian_blur",
    "gaussian_derivative",
    "gaussian_derivative_kernels",
    "gaussian_kernel",
    "gaussian_pyramid",
    "gray_to_f32",
    "gray_to_u8",
    "laplacian_pyramid",
    "noise_gain",
    "pyramid_down",
    "pyramid_up",
    "reduce_rgb",
    "resize",
    "rgb_to_gray",
    "rgb_to_gray_f32",
    "sample_bicubic",
    "sample_bilinear",
    "separable_filter",
    "sharpness",
    "sobel",
    "warp_affine",
    "warp_perspective",
]

BT601_WEIGHTS: tuple
BT709_WEIGHTS: tuple
@final
class Gradient:
    """Partial derivatives of an image, in units of the filter.

    Parameters
    ----------
    du
        Derivative along u, to the right, float32 of shape (H, W).
    dv
        Derivative along v, downwards, float32 of shape (H, W).
    """
    def __new__(cls, du: NDArray[np.float32], dv: NDArray[np.float32]) -> Gradient: ...
    @property
    def du(self) -> NDArray[np.float32]:
        """Derivative along u, to the right, float32 of shape (H, W)."""
    @property
    def dv(self) -> NDArray[np.float32]:
        """Derivative along v, downwards, float32 of shape (H, W)."""
    def __eq__(self, other: object, /) -> bool: ...
    def magnitude(self) -> NDArray[np.float32]:
        """Returns the steepest slope at each pixel, shape (H, W)."""
    def orientation(self) -> NDArray[np.float32]:
        """Returns the direction of ascent, ``arctan2(dv, du)``, radians, shape (H, W); 0 where flat."""
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class IntegralImage:
    """Sums of all pixels above and to the left, in double precision.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    """
    def __new__(cls, image: ArrayLike) -> IntegralImage: ...
    def __eq__(self, other: object, /) -> bool: ...
    def sum(self, u0: int, v0: int, u1: int, v1: int) -> float:
        """Returns the sum over ``image[v0:v1, u0:u1]``.

        Parameters
        ----------
        u0, v0, u1, v1 : int
            Columns u0 to u1 - 1 and rows v0 to v1 - 1.
        """
    def mean(self, u0: int, v0: int, u1: int, v1: int) -> float:
        """Returns the mean over ``image[v0:v1, u0:u1]``; 0 if it is empty.

        Parameters
        ----------
        u0, v0, u1, v1 : int
            Columns u0 to u1 - 1 and rows v0 to v1 - 1.
        """
    __hash__: ClassVar[None]  # type: ignore[assignment]

def gray_to_f32(image: ArrayLike) -> NDArray[np.float32]:
    """Converts an 8-bit gray image to floats in [0, 1], ``image / 255``; floats do not change.

    Parameters
    ----------
    image : array_like, shape (H, W)

    Returns
    -------
    ndarray of float32, shape (H, W)
    """
def gray_to_u8(image: ArrayLike) -> NDArray[np.uint8]:
    """Converts a gray image of floats in [0, 1] to 8 bits, rounded and clamped.

    Parameters
    ----------
    image : array_like, shape (H, W)

    Returns
    -------
    ndarray of uint8, shape (H, W)
    """
def rgb_to_gray(image: ArrayLike) -> NDArray[np.uint8]:
    """Converts a color image to gray by the weights of ITU-R BT.601, as in OpenCV.

    Parameters
    ----------
    image : array_like, shape (H, W, 3)
        uint8, in the order red, green, blue. For images from `cv2.imread`, pass
        ``image[..., ::-1]``.

    Returns
    -------
    ndarray of uint8, shape (H, W)
    """
def rgb_to_gray_f32(image: ArrayLike, weights: ArrayLike | None = None) -> NDArray[np.float32]:
    """Converts a color image to gray by any weights.

    Parameters
    ----------
    image : array_like, shape (H, W, 3)
        uint8, in the order red, green, blue.
    weights : array_like, shape (3,), optional
        Weights of red, green and blue; `BT601_WEIGHTS` by default. A sum of 1 keeps white at 1.

    Returns
    -------
    ndarray of float32, shape (H, W)
    """
def correlate(
    image: ArrayLike,
    kernel: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Correlates an image with a kernel, which is not flipped.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    kernel : array_like, shape (K, L)
        Weights, with odd side lengths.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (H, W)

    Raises
    ------
    ValueError
        If a side of the kernel is even.
    """
def separable_filter(
    image: ArrayLike,
    kernel_u: ArrayLike,
    kernel_v: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[np.float32]:
    """Correlates an image with ``np.outer(kernel_v, kernel_u)``, which is not flipped.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    kernel_u, kernel_v : array_like, shape (K,)
        Weights along the rows and along the columns, an odd number each.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of float32, shape (H, W)

    Raises
    ------
    ValueError
        If the length of the kernel is even.
    """
def noise_gain(weights: ArrayLike) -> float:
    """Computes the noise gain of a filter: standard deviation of its response to unit white noise.

    Parameters
    ----------
    weights : array_like, shape (N,)

    Returns
    -------
    float
    """
def gaussian_kernel(sigma_px: float, size: int) -> NDArray[np.float32]:
    """Samples a Gaussian, with a sum of 1.

    Parameters
    ----------
    sigma_px : float
        Standard deviation, pixels, in (0, 1000].
    size : int
        Odd number of samples.

    Returns
    -------
    ndarray of float32, shape (size,)

    Raises
    ------
    ValueError
        If ``sigma_px`` is outside (0, 1000], or ``size`` is even or above 20001.

    Examples
    --------
    >>> [round(float(sample), 4) for sample in gaussian_kernel(1.0, 3)]
    [0.2741, 0.4519, 0.2741]
    """
def gaussian_derivative_kernels(
    sigma_px: float,
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Returns the kernels of `gaussian_derivative`: a Gaussian and its derivative.

    Parameters
    ----------
    sigma_px : float
        Standard deviation, pixels, in (0, 1000].

    Returns
    -------
    smooth, slope : ndarray of float32, shape (N,)
        ``smooth`` sums to 1; ``slope`` has the response 1 to a ramp of slope 1.

    Raises
    ------
    ValueError
        If ``sigma_px`` is outside (0, 1000].
    """
def gaussian_blur(
    image: ArrayLike,
    sigma_px: float,
    border: str | Mapping[str, Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[Any]:
    """Blurs an image by a Gaussian, truncated at about 4 sigma.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    sigma_px : float
        Standard deviation, pixels, in (0, 1000].
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of uint8 or float32, shape (H, W)
        uint8 for a uint8 image, else float32.

    Raises
    ------
    ValueError
        If ``sigma_px`` is outside (0, 1000].
    """
def box_filter(
    image: ArrayLike,
    size: int,
    border: str | Mapping[str, Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> NDArray[Any]:
    """Computes the mean of the ``size x size`` window around each pixel.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    size : int
        Odd number of pixels, at most 1001.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    ndarray of uint8 or float32, shape (H, W)
        uint8 for a uint8 image, else float32.

    Raises
    ------
    ValueError
        If ``size`` is even or above 1001.
    """
def derivative(
    image: ArrayLike,
    kind: str | None = None,
    border: str | Mapping[str, Any] | None = None,
) -> Gradient:
    """Computes the gradient by an integer filter, not divided by its gain.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    kind : str, optional
        ``"sobel3"`` (gain 8), ``"sobel5"`` (128) or ``"scharr"`` (32).
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    Gradient
    """
def centered_difference(
    image: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
) -> Gradient:
    """Computes the gradient by central differences, as slopes per pixel.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    Gradient
    """
def sobel(image: ArrayLike, border: str | Mapping[str, Any] | None = None) -> Gradient:
    """Computes the gradient by the 3x3 Sobel filter, 8 times the slope per pixel.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    Gradient
    """
def gaussian_derivative(
    image: ArrayLike,
    sigma_px: float,
    border: str | Mapping[str, Any] | None = None,
    *,
    progress: Callable[[str, float], object] | None = None,
) -> Gradient:
    """Computes the gradient of the image blurred by a Gaussian, as slopes per pixel.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    sigma_px : float
        Standard deviation of the Gaussian, pixels, in (0, 1000].
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
    progress : callable, optional
        Called with the stage and the completed fraction.

    Returns
    -------
    Gradient

    Raises
    ------
    ValueError
        If ``sigma_px`` is outside (0, 1000].
    """
def pyramid_down(
    image: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
) -> NDArray[Any]:
    """Halves an image, after a blur with the binomial kernel ``[1, 4, 6, 4, 1] / 16``.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    ndarray of uint8 or float32, shape (ceil(H / 2), ceil(W / 2))
        uint8 for a uint8 image, else float32. Pixel u of the result is at 2u of the image.
    """
def pyramid_up(image: ArrayLike, width: int, height: int) -> NDArray[Any]:
    """Doubles an image, interpolated by the binomial kernel.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    width, height : int
        Size of the result, pixels: twice the size of the image, or one less.

    Returns
    -------
    ndarray of uint8 or float32, shape (height, width)
        uint8 for a uint8 image, else float32.

    Raises
    ------
    ValueError
        If the result has more than 2**32 pixels.
    """
def gaussian_pyramid(image: ArrayLike, num_levels: int) -> list[NDArray[Any]]:
    """Downscales an image repeatedly by `pyramid_down`; the list starts with the image.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    num_levels : int
        Maximum number of levels; a single pixel ends the pyramid.

    Returns
    -------
    list of ndarray of uint8 or float32
        uint8 for a uint8 image, else float32.
    """
def laplacian_pyramid(image: ArrayLike, num_levels: int) -> list[NDArray[np.float32]]:
    """Computes the Laplacian pyramid: differences of successive Gaussian levels, and the last level.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    num_levels : int
        Maximum number of levels; a single pixel ends the pyramid.

    Returns
    -------
    list of ndarray of float32
    """
def from_laplacian_pyramid(levels: Sequence[ArrayLike]) -> NDArray[np.float32]:
    """Reconstructs the image of a Laplacian pyramid.

    Parameters
    ----------
    levels : list of array_like
        Result of `laplacian_pyramid`, possibly modified.

    Returns
    -------
    ndarray of float32, shape (H, W)
        Shape (0, 0) for no levels.
    """
def sharpness(image: ArrayLike) -> float:
    """Measures the sharpness of a photo: mean square of its details of a few pixels.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.

    Returns
    -------
    float
        Comparable between photos of equal size and similar content, such as frames of a video.
    """
def resize(image: ArrayLike, width: int, height: int) -> NDArray[Any]:
    """Resizes an image without aliasing: area averages to shrink, linear interpolation to enlarge.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray.
    width, height : int
        Size of the result, pixels, > 0.

    Returns
    -------
    ndarray of uint8 or float32, shape (height, width)
        uint8 for a uint8 image, else float32. Pixel u is at ``(u + 0.5) * W / width - 0.5``.

    Raises
    ------
    ValueError
        If a side is 0 pixels long, or the result has more than 2**32 pixels.
    """
def reduce_rgb(image: ArrayLike, max_pixels: int) -> NDArray[np.uint8]:
    """Downscales a color image to at most `max_pixels` pixels, if it has more.

    Parameters
    ----------
    image : array_like, shape (H, W, 3)
        uint8.
    max_pixels : int

    Returns
    -------
    ndarray of uint8, shape (h, w, 3)
        `Intrinsics.resized` returns the matching intrinsics.
    """
def sample_bilinear(
    image: ArrayLike,
    pixel: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
) -> Any:
    """Interpolates gray values between pixels bilinearly.

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    pixel : array_like, shape (2,) or (N, 2)
        (u, v), pixel centers at integers.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    float or ndarray, shape (N,)
    """
def sample_bicubic(
    image: ArrayLike,
    pixel: ArrayLike,
    border: str | Mapping[str, Any] | None = None,
) -> Any:
    """Interpolates gray values between pixels by bicubic interpolation (Catmull-Rom).

    Parameters
    ----------
    image : array_like, shape (H, W)
        Gray; uint8 values are divided by 255.
    pixel : array_like, shape (2,) or (N, 2)
        (u, v), pixel centers at integers.
    border : str or dict, optional
        ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.

    Returns
    -------
    float or ndarray, shape (N,)
    """
def warp_affine(
    image: ArrayLike,
    out_from_image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.WarpOptions],
) -> NDArray[Any]:
    """Warps an image by an affine map, as OpenCV's `warpAffine`.

    Parameters
    ----------
    image : array_like, shape (H, W) or (H, W, 3)
    out_from_image : array_like, shape (2, 3)
        Affine map from pixels of the image to pixels of the result.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : WarpOptions
        ``width`` and ``height``, pixels, those of the image by default; ``interpolation``,
        ``"bilinear"`` or ``"bicubic"``; ``border={"constant": 0.0}``, in units of the image.

    Returns
    -------
    ndarray of uint8 or float32, shape (height, width) or (height, width, 3)
        uint8 for a uint8 image, else float32.

    Raises
    ------
    epipole.DegenerateError
        If the map has no inverse.
    ValueError
        If the result has more than 2**32 pixels.
    """
def warp_perspective(
    image: ArrayLike,
    out_from_image: ArrayLike,
    *,
    progress: Callable[[str, float], object] | None = None,
    **options: Unpack[option_types.WarpOptions],
) -> NDArray[Any]:
    """Warps an image by a homography, as OpenCV's `warpPerspective`.

    Parameters
    ----------
    image : array_like, shape (H, W) or (H, W, 3)
    out_from_image : array_like, shape (3, 3)
        Homography from pixels of the image to pixels of the result, at any scale.
    progress : callable, optional
        Called with the stage and the completed fraction.
    **options : WarpOptions
        ``width`` and ``height``, pixels, those of the image by default; ``interpolation``,
        ``"bilinear"`` or ``"bicubic"``; ``border={"constant": 0.0}``, in units of the image.

    Returns
    -------
    ndarray of uint8 or float32, shape (height, width) or (height, width, 3)
        uint8 for a uint8 image, else float32.

    Raises
    ------
    epipole.DegenerateError
        If the map has no inverse.
    ValueError
        If the result has more than 2**32 pixels.
    """
