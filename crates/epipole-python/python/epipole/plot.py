"""Plots of results with matplotlib (``pip install epipole[plot]``).

Each function draws on ``ax``, or on new axes by default, and returns the axes. Pixel centers are
at integers, as everywhere in Epipole, so that ``imshow`` and points agree.
"""

from __future__ import annotations

import base64
import io
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from epipole import sfm
from epipole._orbit import orbit as _orbit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from mpl_toolkits.mplot3d.axes3d import Axes3D  # type: ignore[import-untyped]
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "cameras",
    "coverage",
    "disparity",
    "epipolar_lines",
    "matches",
    "reconstruction",
    "residuals",
]

# Blue and vermilion from the color-blind-safe palette of Okabe and Ito.
_INLIER = "#0072B2"
_OUTLIER = "#D55E00"


def matches(
    image1: ArrayLike,
    image2: ArrayLike,
    points1: ArrayLike,
    points2: ArrayLike,
    *,
    inliers: ArrayLike | None = None,
    max_lines: int = 300,
    ax: Axes | None = None,
) -> Axes:
    """Draws two images side by side, with a line for each match.

    Parameters
    ----------
    image1, image2 : array, shape (H, W) or (H, W, 3)
    points1, points2 : array, shape (N, 2)
        Pixels of the matches.
    inliers : boolean array, shape (N,), optional
        Inliers are drawn in blue, outliers dashed in vermilion below them.
    max_lines : int
        Maximum number of lines, for matches evenly spaced in the list.
    ax : Axes, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes
    """
    one, two = _image("image1", image1), _image("image2", image2)
    first, second = _points("points1", points1), _points("points2", points2)
    if len(first) != len(second):
        raise ValueError(
            "points1 and points2 must have the same length, but have "
            f"{len(first)} and {len(second)} points"
        )
    mask = _mask("inliers", inliers, len(first))
    if max_lines < 1:
        raise ValueError(f"max_lines must be at least 1, but is {max_lines}")
    ax = _axes(ax)
    height = max(one.shape[0], two.shape[0])
    offset = one.shape[1]
    both = np.ones((height, offset + two.shape[1], 3))
    both[: one.shape[0], :offset] = _rgb(one)
    both[: two.shape[0], offset:] = _rgb(two)
    ax.imshow(both)
    step = max(1, -(-len(first) // max_lines))
    shown = np.arange(0, len(first), step)
    for keep, color, style in [(~mask, _OUTLIER, "--"), (mask, _INLIER, "-")]:
        rows = shown[keep[shown]]
        ends = np.stack([first[rows], second[rows] + [offset, 0]], axis=1)
        for (u1, v1), (u2, v2) in ends:
            ax.plot([u1, u2], [v1, v2], style, color=color, linewidth=0.8, alpha=0.7)
    ax.set_axis_off()
    counted = f"{len(first)} matches"
    ax.set_title(counted if inliers is None else f"{counted}, {int(mask.sum())} inliers")
    return ax


def epipolar_lines(
    image: ArrayLike,
    lines: ArrayLike,
    *,
    points: ArrayLike | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draws epipolar lines over an image.

    Parameters
    ----------
    image : array, shape (H, W) or (H, W, 3)
    lines : array, shape (N, 3)
        Lines a u + b v + c = 0, as from ``epipolar_line2``.
    points : array, shape (N, 2), optional
        Pixels, each drawn in the color of its line.
    ax : Axes, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes
    """
    picture = _image("image", image)
    coefficients = _finite("lines", lines)
    if coefficients.ndim != 2 or coefficients.shape[1] != 3:
        raise ValueError(f"lines must have shape (N, 3), but have shape {coefficients.shape}")
    marks = None if points is None else _points("points", points)
    if marks is not None and len(marks) != len(coefficients):
        raise ValueError(
            "lines and points must have the same length, but have "
            f"{len(coefficients)} and {len(marks)}"
        )
    ax = _axes(ax)
    height, width = picture.shape[:2]
    ax.imshow(_rgb(picture))
    colors = _distinct(len(coefficients))
    for n, line in enumerate(coefficients):
        ends = _across(line, width, height)
        if ends is not None:
            ax.plot(ends[:, 0], ends[:, 1], color=colors[n], linewidth=1)
        if marks is not None:
            ax.plot(*marks[n], "o", color=colors[n], markeredgecolor="white")
    ax.set_xlim(-0.5, width - 0.5)
    ax.set_ylim(height - 0.5, -0.5)
    ax.set_axis_off()
    return ax


def disparity(
    values: ArrayLike, *, label: str = "disparity, pixels", ax: Axes | None = None
) -> Axes:
    """Draws a disparity or depth image with a color bar. NaN is gray.

    Parameters
    ----------
    values : array, shape (H, W)
    label : str
        Label of the color bar.
    ax : Axes, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes
    """
    image = np.asarray(values, dtype=float)
    if image.ndim != 2:
        raise ValueError(f"values must have shape (H, W), but have shape {image.shape}")
    ax = _axes(ax)
    ax.set_facecolor("0.75")
    known = np.isfinite(image)
    # Percentiles keep a few outliers from compressing the color range.
    low, high = np.percentile(image[known], [1, 99]) if known.any() else (0.0, 1.0)
    shown = ax.imshow(np.where(known, image, np.nan), cmap="viridis", vmin=low, vmax=high)
    ax.figure.colorbar(shown, ax=ax, label=label)
    ax.set_xticks([])
    ax.set_yticks([])
    return ax


def cameras(
    cam_from_world: Sequence[Any],
    *,
    points: ArrayLike | None = None,
    colors: ArrayLike | None = None,
    size: float | None = None,
    ax: Axes3D | None = None,
) -> Axes3D:
    """Draws cameras as pyramids, and points, in 3D.

    Parameters
    ----------
    cam_from_world : sequence
        Poses: 3×4 or 4×4 matrices, or objects with ``rotation`` and ``translation``.
    points : array, shape (N, 3), optional
        Points in the world.
    colors : array, shape (N, 3), optional
        Colors of the points: floats from 0 to 1, or integers from 0 to 255.
    size : float, optional
        Depth of the pyramids, world units [default: a tenth of the extent].
    ax : Axes3D, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes3D
    """
    poses = [_pose(f"cam_from_world[{n}]", pose) for n, pose in enumerate(cam_from_world)]
    centers = np.array([-r.T @ t for r, t in poses]).reshape(-1, 3)
    cloud = np.empty((0, 3)) if points is None else _finite("points", points)
    if cloud.ndim != 2 or cloud.shape[1] != 3:
        raise ValueError(f"points must have shape (N, 3), but have shape {cloud.shape}")
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.figure().add_subplot(projection="3d")
    all_points = np.vstack([centers, cloud])
    extent = float(np.ptp(all_points, axis=0).max()) if len(all_points) else 1.0
    depth = size if size is not None else 0.1 * (extent or 1.0)
    for (rotation, _), center in zip(poses, centers):
        corners = np.array([[-0.8, -0.6, 1], [0.8, -0.6, 1], [0.8, 0.6, 1], [-0.8, 0.6, 1]])
        corners = center + depth * corners @ rotation
        for line in [*([center, corner] for corner in corners), [*corners, corners[0]]]:
            ax.plot(*np.array(line).T, color=_INLIER, linewidth=1)
    if len(cloud):
        shades: Any = _OUTLIER
        if colors is not None:
            shades = np.asarray(colors)
            shades = shades / 255 if shades.dtype.kind in "iu" else shades
        ax.scatter(*cloud.T, c=shades, s=2)
    ax.set_aspect("equal")
    return ax


def reconstruction(result: sfm.Reconstruction, *, ax: Axes3D | None = None) -> Axes3D:
    """Draws the cameras and colored points of a reconstruction in 3D.

    Parameters
    ----------
    result : epipole.sfm.Reconstruction
    ax : Axes3D, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes3D
    """
    poses = [camera.cam_from_world for camera in result.cameras if camera is not None]
    return cameras(poses, points=result.points, colors=result.colors, ax=ax)


def residuals(
    errors_px: ArrayLike, *, max_error_px: float | None = None, ax: Axes | None = None
) -> Axes:
    """Draws a histogram of residuals on a logarithmic axis.

    Parameters
    ----------
    errors_px : array, shape (N,)
        Residuals, pixels.
    max_error_px : float, optional
        Inlier threshold, drawn as a line.
    ax : Axes, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes
    """
    errors = _finite("errors_px", errors_px).ravel()
    if (errors < 0).any():
        raise ValueError(f"errors_px must not be negative, but the smallest is {errors.min():g}")
    ax = _axes(ax)
    positive = errors[errors > 0]
    if len(positive):
        ends = max(positive.min(), 1e-6), max(positive.max(), 2e-6)
        bins = np.geomspace(*ends, 50)
        ax.hist(np.maximum(errors, ends[0]), bins=list(bins), color=_INLIER)
        ax.set_xscale("log")
    if max_error_px is not None:
        ax.axvline(max_error_px, color=_OUTLIER, linestyle="--", label="inlier threshold")
        ax.legend()
    ax.set_xlabel("residual, pixels")
    ax.set_ylabel("number")
    return ax


def coverage(
    views: Sequence[ArrayLike], width: int, height: int, *, ax: Axes | None = None
) -> Axes:
    """Draws the positions of the marks in calibration images.

    Parameters
    ----------
    views : sequence of arrays, shape (N, 2)
        Pixels of the marks in each image; rows of NaN for marks that were not found.
    width, height : int
        Size of the images, pixels.
    ax : Axes, optional
        Axes to draw on [default: new axes].

    Returns
    -------
    Axes
    """
    ax = _axes(ax)
    for n, (view, color) in enumerate(zip(views, _distinct(len(views)))):
        marks = np.asarray(view, dtype=float)
        if marks.ndim != 2 or marks.shape[1] != 2:
            raise ValueError(f"views[{n}] must have shape (N, 2), but has shape {marks.shape}")
        ax.plot(marks[:, 0], marks[:, 1], ".", color=color, markersize=3)
    ax.set_xlim(-0.5, width - 0.5)
    ax.set_ylim(height - 0.5, -0.5)
    ax.set_aspect("equal")
    ax.set_title(f"{len(views)} images")
    return ax


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


def _finite(name: str, values: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(values, dtype=float)
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, but has NaN or infinite values")
    return array


def _points(name: str, values: ArrayLike) -> NDArray[np.float64]:
    array = _finite(name, values)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name} must have shape (N, 2), but has shape {array.shape}")
    return array


def _mask(name: str, values: ArrayLike | None, length: int) -> NDArray[np.bool_]:
    mask = np.ones(length, bool) if values is None else np.asarray(values, dtype=bool)
    if mask.shape != (length,):
        raise ValueError(f"{name} must have shape ({length},), but has shape {mask.shape}")
    return mask


def _image(name: str, values: ArrayLike) -> NDArray[Any]:
    array = np.asarray(values)
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] != 3):
        raise ValueError(
            f"{name} must have shape (H, W) or (H, W, 3), but has shape {array.shape}"
        )
    return array


def _rgb(image: NDArray[Any]) -> NDArray[np.float64]:
    """Returns an image with three channels and values in [0, 1]."""
    scaled = image / 255 if image.dtype.kind in "iu" else image.astype(float)
    scaled = np.clip(scaled, 0, 1)
    return scaled if scaled.ndim == 3 else np.repeat(scaled[:, :, None], 3, axis=2)


def _pose(name: str, pose: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if hasattr(pose, "rotation") and hasattr(pose, "translation"):
        return _finite(name, pose.rotation), _finite(name, pose.translation).ravel()
    matrix = _finite(name, pose)
    if matrix.shape not in ((3, 4), (4, 4)):
        raise ValueError(
            f"{name} must have shape (3, 4) or (4, 4), but has shape {matrix.shape}"
        )
    return matrix[:3, :3], matrix[:3, 3]


def _across(
    line: NDArray[np.float64], width: int, height: int
) -> NDArray[np.float64] | None:
    """Returns the points where a line enters and leaves an image, or None if it misses."""
    a, b, c = line
    left, right, top, bottom = -0.5, width - 0.5, -0.5, height - 0.5
    ends = []
    if b != 0:
        ends += [(u, -(a * u + c) / b) for u in (left, right)]
    if a != 0:
        ends += [(-(b * v + c) / a, v) for v in (top, bottom)]
    inside = [
        (u, v)
        for u, v in ends
        if left - 1e-9 <= u <= right + 1e-9 and top - 1e-9 <= v <= bottom + 1e-9
    ]
    if len(inside) < 2:
        return None
    array = np.array(sorted(inside))
    return array[[0, -1]]


def _distinct(count: int) -> list[Any]:
    import matplotlib

    shades = matplotlib.colormaps["viridis"]
    return [shades(n / max(count - 1, 1)) for n in range(count)]


def _html_picture(result: object) -> str:
    """Returns the notebook view of a result as HTML; empty for results without a view."""
    if not isinstance(result, sfm.Reconstruction):
        return ""
    return _orbit(result, _still(result))


def _still(result: sfm.Reconstruction) -> str:
    """Returns a static image of a reconstruction as HTML; empty without matplotlib."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    # Avoid pyplot, which would show the figure again.
    figure = Figure(figsize=(6, 4), layout="tight")
    reconstruction(result, ax=figure.add_subplot(projection="3d"))
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=100)
    data = base64.b64encode(file.getvalue()).decode()
    text = f"{result.num_registered()} cameras and {len(result.points)} points"
    return f'<img alt="{text}" src="data:image/png;base64,{data}">'
