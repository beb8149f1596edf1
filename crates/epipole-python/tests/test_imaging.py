"""Images in and out, filters, gradients, pyramids, warps."""

import pickle

import numpy as np
import pytest

import epipole
from epipole import imaging


@pytest.fixture
def gray():
    """Random gray values of float32."""
    return np.random.default_rng(4).random((40, 56), np.float32)


@pytest.fixture
def photo():
    """Random colors of uint8."""
    return np.random.default_rng(5).integers(0, 256, (40, 56, 3), np.uint8)


def blurred(image):
    return imaging.gaussian_blur(image, 1.5)


class Photo:
    """Object that is an image by its array interface, as those of PIL."""

    def __init__(self, array):
        self.__array_interface__ = array.__array_interface__
        self.array = array


@pytest.mark.parametrize(
    "change",
    [
        np.asfortranarray,
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: a[::-1][::-1],
        lambda a: a.T.copy().T,
        lambda a: np.frombuffer(a.tobytes(), a.dtype).reshape(a.shape),
        lambda a: a.view(type("Subclass", (np.ndarray,), {})),
        Photo,
    ],
)
@pytest.mark.parametrize("kind", ["gray", "bytes", "color"])
def test_layouts(gray, photo, change, kind):
    image = {"gray": gray, "bytes": photo[..., 0], "color": photo}[kind]
    shift = [[1, 0, 3.5], [0, 1, 2]]
    expected = imaging.warp_affine(np.ascontiguousarray(image), shift)
    np.testing.assert_array_equal(imaging.warp_affine(change(image), shift), expected)


@pytest.mark.parametrize("dtype", ["float16", "float64", ">f4", "longdouble"])
def test_floats_are_computed_as_float32(gray, dtype):
    image = gray.astype(dtype)
    result = blurred(image)
    assert result.dtype == np.float32
    np.testing.assert_array_equal(result, blurred(image.astype(np.float32)))


def test_bytes_stay_bytes(photo):
    image = photo[..., 0]
    result = blurred(image)
    assert result.dtype == np.uint8
    exact = 255 * blurred(image / 255)
    assert np.abs(result - exact).max() <= 0.501


@pytest.mark.parametrize(
    ("image", "error", "message"),
    [
        (np.zeros((4, 5), np.uint16), TypeError, "image .* uint16; divide by 65535"),
        (np.zeros((4, 5), int), TypeError, "image must be uint8 or float.* int64"),
        (np.zeros((4, 5), bool), TypeError, "image .* bool; convert"),
        (np.zeros((4, 5), complex), TypeError, "image .* complex128"),
        (np.zeros((4, 5), object), TypeError, "image .* object"),
        ("photo.jpg", TypeError, "image .* str"),
        (None, TypeError, "image .* object"),
        (np.zeros(5), ValueError, r"image must be an array of shape .* has shape \(5,\)"),
        (np.zeros((2, 4, 5, 3)), ValueError, r"image .* has shape \(2, 4, 5, 3\)"),
        (np.zeros((4, 5, 4), np.uint8), ValueError, r"image .* has shape \(4, 5, 4\)"),
        (
            np.zeros((4, 5, 3), np.uint8),
            ValueError,
            r"image must be gray, .* epipole\.imaging\.rgb_to_gray",
        ),
        (np.zeros((4, 5, 3)), ValueError, "image must be gray if it is float"),
        (np.zeros((0, 5)), ValueError, r"image has no pixels: its shape is \(0, 5\)"),
        (np.full((4, 5), np.nan), ValueError, "image contains NaN in row 0"),
        ([[0.0, 1.0], [0.0, np.inf]], ValueError, "image contains infinity in row 1"),
        ([[0.0], [0.0, 1.0]], ValueError, "image must be an array"),
    ],
)
def test_bad_images_are_named(image, error, message):
    with pytest.raises(error, match=message):
        blurred(image)


def test_other_bad_arguments(gray, photo):
    with pytest.raises(TypeError, match="border"):
        imaging.sobel(gray, border="wrap")
    with pytest.raises(TypeError, match="unknown option widht.*width, height"):
        imaging.warp_affine(gray, np.eye(2, 3), widht=3)
    with pytest.raises(ValueError, match="out_from_image .* infinity|out_from_image contains NaN"):
        imaging.warp_affine(gray, np.full((2, 3), np.nan))
    with pytest.raises(ValueError, match="odd"):
        imaging.separable_filter(gray, [1, 2], [1])
    with pytest.raises(ValueError, match="kernel_u contains NaN"):
        imaging.separable_filter(gray, [np.nan], [1])
    with pytest.raises(ValueError, match="image must be a color image"):
        imaging.rgb_to_gray(photo[..., 0])
    with pytest.raises(ValueError, match="weights"):
        imaging.rgb_to_gray_f32(photo, [0.5, 0.5])
    with pytest.raises(ValueError, match="width and height"):
        imaging.resize(gray, 2**32 - 1, 2**32 - 1)
    with pytest.raises(ValueError, match="standard deviation"):
        imaging.gaussian_blur(gray, -1.0)
    with pytest.raises(ValueError, match=r"levels\[1\]"):
        imaging.from_laplacian_pyramid([gray, np.zeros(3)])


def test_conversions(gray, photo):
    byte = photo[..., 0]
    np.testing.assert_array_equal(imaging.gray_to_f32(byte), byte.astype(np.float32) / 255)
    np.testing.assert_array_equal(imaging.gray_to_u8(imaging.gray_to_f32(byte)), byte)
    assert imaging.gray_to_u8([[-1.0, 0.2, 7.0]]).tolist() == [[0, 51, 255]]
    assert imaging.BT601_WEIGHTS == (0.299, 0.587, 0.114)
    weighted = photo @ np.array(imaging.BT709_WEIGHTS) / 255
    found = imaging.rgb_to_gray_f32(photo, imaging.BT709_WEIGHTS)
    np.testing.assert_allclose(found, weighted, atol=1e-6)
    assert np.abs(imaging.rgb_to_gray(photo) - photo @ [0.299, 0.587, 0.114]).max() < 0.51
    assert imaging.reduce_rgb(photo, 560).shape == (20, 28, 3)


def test_kernels_and_filters(gray):
    kernel = imaging.gaussian_kernel(1.0, 3)
    np.testing.assert_allclose(kernel, [0.27406862, 0.45186276, 0.27406862], rtol=1e-6)
    assert imaging.noise_gain([-0.5, 0, 0.5]) == pytest.approx(0.5**0.5)
    smooth, slope = imaging.gaussian_derivative_kernels(1.0)
    assert smooth.shape == slope.shape == (9,) and smooth.sum() == pytest.approx(1)
    # Sums by hand, with zeros outside.
    weights = np.arange(6).reshape(3, 2).repeat(2, axis=1)[:, :3]
    padded = np.pad(gray, 1)
    by_hand = sum(
        weights[j, i] * padded[j : j + gray.shape[0], i : i + gray.shape[1]]
        for j in range(3)
        for i in range(3)
    )
    found = imaging.correlate(gray, weights, {"constant": 0})
    np.testing.assert_allclose(found, by_hand, atol=1e-5)
    outer = imaging.correlate(gray, np.outer([1, 2, 1], [-1, 0, 1]), "replicate")
    both = imaging.separable_filter(gray, [-1, 0, 1], [1, 2, 1], "replicate")
    np.testing.assert_allclose(outer, both, atol=1e-5)
    mean = imaging.box_filter(gray, 3)
    assert mean[5, 7] == pytest.approx(gray[4:7, 6:9].mean(), abs=1e-6)


def test_constant_borders_are_in_units_of_the_image():
    white = np.full((9, 9), 200, np.uint8)
    assert (imaging.gaussian_blur(white, 2.0, {"constant": 200}) == 200).all()
    assert (
        imaging.warp_affine(white, [[1, 0, 3], [0, 1, 0]], border={"constant": 7})[:, 0] == 7
    ).all()


def test_gradients():
    v, u = np.mgrid[:9, :11]
    ramp = (3 * u - 4 * v).astype(np.float32)
    for gradient, gain in [
        (imaging.sobel(ramp), 8),
        (imaging.derivative(ramp, "sobel5"), 128),
        (imaging.derivative(ramp, "scharr"), 32),
        (imaging.centered_difference(ramp), 1),
    ]:
        np.testing.assert_allclose(gradient.du[3:-3, 3:-3], 3 * gain)
        np.testing.assert_allclose(gradient.dv[3:-3, 3:-3], -4 * gain)
        np.testing.assert_allclose(gradient.magnitude()[3:-3, 3:-3], 5 * gain, rtol=1e-6)
        np.testing.assert_allclose(gradient.orientation()[4, 5], np.arctan2(-4, 3), atol=1e-6)
        again = pickle.loads(pickle.dumps(gradient))
        assert again == gradient and again != imaging.sobel(ramp[::-1])
        assert (
            repr(gradient)
            == "Gradient(du=<float32 array of shape (9, 11)>, dv=<float32 array of shape (9, 11)>)"
        )
    wide = np.tile(np.arange(41, dtype=float), (3, 1))
    assert imaging.gaussian_derivative(wide, 2.0).du[1, 20] == pytest.approx(1, abs=1e-5)


def test_integral_image(gray):
    integral = imaging.IntegralImage(gray)
    assert integral.sum(3, 4, 20, 17) == pytest.approx(gray[4:17, 3:20].sum(dtype=float))
    assert integral.mean(3, 4, 900, 900) == pytest.approx(gray[4:, 3:].mean(dtype=float))
    assert integral == imaging.IntegralImage(gray)


def test_pyramids(gray):
    levels = imaging.gaussian_pyramid(gray, 3)
    assert [level.shape for level in levels] == [(40, 56), (20, 28), (10, 14)]
    np.testing.assert_array_equal(levels[1], imaging.pyramid_down(gray))
    laplacian = imaging.laplacian_pyramid(gray, 3)
    up = imaging.pyramid_up(levels[1], 56, 40)
    np.testing.assert_allclose(laplacian[0], gray - up, atol=1e-6)
    np.testing.assert_allclose(imaging.from_laplacian_pyramid(laplacian), gray, atol=1e-6)
    assert imaging.from_laplacian_pyramid([]).shape == (0, 0)
    assert imaging.pyramid_down((255 * gray).astype(np.uint8)).dtype == np.uint8
    assert imaging.sharpness(gray) > 2 * imaging.sharpness(blurred(gray))


def test_sizes_and_samples(gray):
    halves = gray.reshape(20, 2, 28, 2).mean((1, 3))
    np.testing.assert_allclose(imaging.resize(gray, 28, 20), halves, atol=1e-6)
    middle = gray[3:5, 6:8].mean()
    assert imaging.sample_bilinear(gray, (6.5, 3.5)) == pytest.approx(middle, abs=1e-6)
    many = imaging.sample_bilinear(gray, [(6.5, 3.5), (0, 0)])
    np.testing.assert_allclose(many, [middle, gray[0, 0]], atol=1e-6)
    squares = np.array([[0, 1, 4, 9, 16]], float)
    assert imaging.sample_bicubic(squares, (2.5, 0), "replicate") == 6.25


def test_warps(gray, photo):
    h = [[1, 0, 3], [0, 1, 2], [0, 0, 1]]
    for image in (gray, photo, photo[..., 1]):
        moved = imaging.warp_perspective(image, h)
        assert moved.dtype == image.dtype and moved.shape == image.shape
        np.testing.assert_allclose(moved[2:, 3:], image[:-2, :-3], atol=1e-6)
        assert not moved[:2].any()
        small = epipole.warp_perspective(image, h, width=9, height=5, interpolation="bicubic")
        assert small.shape[:2] == (5, 9)
    with pytest.raises(epipole.DegenerateError):
        imaging.warp_perspective(gray, np.zeros((3, 3)))


def test_opencv(gray, photo):
    cv2 = pytest.importorskip("cv2")
    close = {"atol": 1e-5, "rtol": 0}
    np.testing.assert_allclose(
        imaging.gaussian_blur(gray, 1.7), cv2.GaussianBlur(gray, (0, 0), 1.7), **close
    )
    byte = photo[..., 0]
    # OpenCV's fixed point is off by one gray value at most.
    difference = cv2.GaussianBlur(byte, (15, 15), 1.7).astype(int) - imaging.gaussian_blur(
        byte, 1.7
    )
    assert np.abs(difference).max() <= 1
    sobel, scharr = imaging.sobel(gray), imaging.derivative(gray, "scharr")
    np.testing.assert_allclose(sobel.du, cv2.Sobel(gray, cv2.CV_32F, 1, 0), **close)
    np.testing.assert_allclose(sobel.dv, cv2.Sobel(gray, cv2.CV_32F, 0, 1), **close)
    np.testing.assert_allclose(scharr.du, cv2.Scharr(gray, cv2.CV_32F, 1, 0), atol=1e-4)
    np.testing.assert_allclose(imaging.pyramid_down(gray), cv2.pyrDown(gray), **close)
    np.testing.assert_allclose(imaging.pyramid_up(gray, 112, 80), cv2.pyrUp(gray), **close)
    np.testing.assert_allclose(
        imaging.box_filter(gray, 5, "replicate"),
        cv2.blur(gray, (5, 5), borderType=cv2.BORDER_REPLICATE),
        **close,
    )
    np.testing.assert_allclose(
        imaging.resize(gray, 28, 20),
        cv2.resize(gray, (28, 20), interpolation=cv2.INTER_AREA),
        **close,
    )
    np.testing.assert_array_equal(
        imaging.rgb_to_gray(photo), cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
    )
    h = np.array([[1.1, 0.1, -3], [-0.05, 0.9, 4], [1e-3, 2e-4, 1]])
    # OpenCV rounds places to 1/32 pixel.
    smooth = imaging.gaussian_blur(gray, 3.0)
    expected = cv2.warpPerspective(smooth, h, (56, 40))
    found = imaging.warp_perspective(smooth, h)
    assert np.abs(found - expected)[5:-5, 5:-5].max() < 0.02


def test_samples_read_the_part_of_an_image_that_they_need():
    """Equal bits, whether a part is read or the whole image, which far pixels need."""
    image = np.random.default_rng(6).integers(0, 255, (40, 60)).astype(np.uint8)
    pixels = np.array([[20.25, 11.5], [21.0, 12.75], [3.0, 3.5], [55.9, 35.1]])
    corners = np.array([[0.0, 0.0], [59.0, 39.0]])
    for array in (image, image / np.float32(255), image.astype(float)[::-1, ::-1]):
        for sample in (imaging.sample_bilinear, imaging.sample_bicubic):
            whole = sample(array, np.r_[pixels, corners])
            for i, pixel in enumerate(pixels):
                assert sample(array, pixel) == whole[i]
            np.testing.assert_array_equal(sample(array, pixels[:2]), whole[:2])
    assert imaging.sample_bilinear(image, np.empty((0, 2))).shape == (0,)
    with pytest.raises(ValueError, match="image"):
        imaging.sample_bilinear(np.zeros(5), (1, 1))
