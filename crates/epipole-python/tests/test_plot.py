"""Pictures: what is drawn where, and sentences for bad arrays."""

import numpy as np
import pytest
from epipole import plot

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

GRAY = np.zeros((40, 60), np.uint8)
POINTS = np.array([[10.0, 20.0], [30.0, 5.0], [50.0, 39.0]])


@pytest.fixture(autouse=True)
def no_figures_stay_open():
    yield
    import matplotlib.pyplot as plt

    plt.close("all")


def test_lines_of_matches_end_at_their_points_side_by_side():
    ax = plot.matches(GRAY, GRAY, POINTS, POINTS + 1, inliers=[True, False, True])
    lines = {tuple(line.get_xdata()): line.get_color() for line in ax.lines}
    assert set(lines) == {(10, 71), (30, 91), (50, 111)}
    assert lines[(30, 91)] != lines[(10, 71)] == lines[(50, 111)]
    assert "2 inliers" in ax.get_title()


def test_many_matches_are_thinned_evenly():
    points = np.random.default_rng(1).uniform(0, 40, (1000, 2))
    assert len(plot.matches(GRAY, GRAY, points, points, max_lines=100).lines) == 100


def test_images_of_two_sizes_and_kinds():
    plot.matches(GRAY, np.ones((20, 30, 3)), POINTS, POINTS / 2)


def test_an_epipolar_line_crosses_the_whole_image():
    # v = 12, and one that misses the image.
    ax = plot.epipolar_lines(GRAY, [[0, 2, -24], [0, 1, -100]])
    (line,) = ax.lines
    assert np.allclose(line.get_xdata(), [-0.5, 59.5]) and np.allclose(line.get_ydata(), 12)


def test_disparity_leaves_nan_out_of_its_colors():
    values = np.linspace(5, 9, 100).reshape(10, 10)
    values[0, 0] = np.nan
    (image,) = plot.disparity(values).images
    assert 5 < image.norm.vmin < image.norm.vmax < 9
    plot.disparity(np.full((4, 4), np.nan))


def test_the_apex_of_a_camera_is_its_center():
    rotated = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    pose = np.column_stack([rotated, -rotated @ [1.0, 2, 3]])
    ax = plot.cameras([pose], points=np.eye(3), size=1)
    apex = [line.get_data_3d() for line in ax.lines[:4]]
    assert all(np.allclose([x[0], y[0], z[0]], [1, 2, 3]) for x, y, z in apex)
    plot.cameras([])


def test_residuals_and_coverage():
    ax = plot.residuals([0, 0.1, 0.5, 2.0], max_error_px=1)
    assert sum(bar.get_height() for bar in ax.patches) == 4
    ax = plot.coverage([POINTS, np.full((2, 2), np.nan)], 60, 40)
    assert ax.get_xlim() == (-0.5, 59.5) and ax.get_ylim() == (39.5, -0.5)


@pytest.mark.parametrize(
    ("draw", "name"),
    [
        (lambda: plot.matches(GRAY, GRAY, POINTS[:, :1], POINTS), "points1"),
        (lambda: plot.matches(GRAY, GRAY, POINTS, POINTS[:2]), "same length"),
        (lambda: plot.matches(GRAY, GRAY, POINTS, POINTS, inliers=[True]), "inliers"),
        (lambda: plot.matches(np.zeros(3), GRAY, POINTS, POINTS), "image1"),
        (lambda: plot.matches(GRAY, GRAY, POINTS * np.nan, POINTS), "points1"),
        (lambda: plot.matches(GRAY, GRAY, POINTS, POINTS, max_lines=0), "max_lines"),
        (lambda: plot.epipolar_lines(GRAY, POINTS), "lines"),
        (lambda: plot.epipolar_lines(GRAY, np.eye(3), points=POINTS[:1]), "points"),
        (lambda: plot.disparity(np.zeros(3)), "values"),
        (lambda: plot.cameras([np.eye(3)]), r"cam_from_world\[0\]"),
        (lambda: plot.cameras([], points=POINTS), "points"),
        (lambda: plot.residuals([-1.0]), "errors_px"),
        (lambda: plot.coverage([POINTS[0]], 60, 40), r"views\[0\]"),
    ],
)
def test_bad_arrays_are_named(draw, name):
    with pytest.raises(ValueError, match=name):
        draw()
