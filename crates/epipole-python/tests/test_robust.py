import numpy as np
import pytest

import epipole
from epipole import robust


@pytest.fixture
def points():
    """Twenty points of v = 0.5 u + 2, and five elsewhere."""
    u = np.arange(20.0)
    wrong = [[3, 40], [7, 90], [12, 33], [15, 70], [1, 55]]
    return np.r_[np.c_[u, 0.5 * u + 2], wrong]


def test_model_of_python_callables(points):
    def fit(sample):
        p, q = points[sample]
        slope = (q[1] - p[1]) / (q[0] - p[0]) if q[0] != p[0] else None
        return None if slope is None else (slope, p[1] - slope * p[0])

    def errors(line):
        return points[:, 1] - line[0] * points[:, 0] - line[1]

    def refine(line, inliers):
        return tuple(np.polyfit(*points[inliers].T, 1))

    for options in ({}, {"refine": refine}):
        report = epipole.ransac(25, 2, fit, errors, max_error_px=0.1, **options)
        np.testing.assert_allclose(report.model, (0.5, 2), atol=1e-9)
        assert report.num_inliers == 20 and report.inliers[:20].all()


def test_exceptions_of_callables_are_raised(points):
    def broken(sample):
        raise KeyError("fit")

    with pytest.raises(KeyError, match="fit"):
        epipole.ransac(25, 2, broken, lambda model: np.zeros(25))
    with pytest.raises(ValueError, match=r"errors must return an array of shape \(25,\)"):
        epipole.ransac(25, 2, lambda sample: 1, lambda model: np.zeros(3))
    with pytest.raises(epipole.NoConsensusError):
        epipole.ransac(25, 2, lambda sample: None, lambda model: np.zeros(25))


def test_least_median_needs_no_threshold(points):
    def fit(sample):
        p, q = points[sample]
        return None if q[0] == p[0] else np.polyfit(*points[sample].T, 1)

    def errors(line):
        return points[:, 1] - np.polyval(line, points[:, 0])

    found = robust.least_median(25, 2, fit, errors, num_samples=200, seed=1)
    np.testing.assert_allclose(found.model, (0.5, 2), atol=1e-9)
    assert found.num_inliers == 20
    assert found.sigma_px < 1e-9
    with pytest.raises(KeyError, match="fit"):
        robust.least_median(25, 2, lambda sample: {}["fit"], errors)
    with pytest.raises(epipole.DegenerateError):
        robust.least_median(25, 2, lambda sample: None, errors)


def test_line_with_outliers(points):
    report = robust.estimate_line(points, max_error_px=0.1)
    a, b, c = report.model
    assert abs(a * 4 + b * 4 + c) < 1e-9 and a * a + b * b == pytest.approx(1)
    assert report.num_inliers == 20
    with pytest.raises(ValueError, match="points"):
        robust.estimate_line(points[:, :1])


def test_reports_name_their_model_in_annotations():
    assert robust.RansacReport[int].__origin__ is robust.RansacReport
    assert robust.LeastMedian[int].__args__ == (int,)


def test_lines(points):
    a, b, c = robust.fit_line_total_least_squares(points[:20])
    assert abs(a * 4 + b * 4 + c) < 1e-9 and a * a + b * b == pytest.approx(1)
    a, b, c = robust.fit_line_huber(points[:20], 1.0)
    assert abs(a * 4 + b * 4 + c) < 1e-9


def test_similarity(points):
    angle, scale, shift = 0.3, 1.5, [4, -2]
    turn = scale * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    moved = points @ turn.T + shift
    similarity = robust.fit_similarity(points, moved)
    assert similarity.scale() == pytest.approx(scale)
    assert similarity.angle_rad() == pytest.approx(angle)
    np.testing.assert_allclose(similarity.apply(points), moved)
    moved[20:] += 50
    report = robust.estimate_similarity(points, moved)
    assert report.num_inliers == 20
    np.testing.assert_allclose(report.model.matrix()[:2, :2], turn, atol=1e-9)


def test_numbers_of_samples():
    assert robust.num_trials_with_replacement(0.5, 2, 0.99) == 17
    assert robust.num_trials_without_replacement(50, 100, 2, 0.99) >= 16
    assert robust.log10_false_alarms(90, 100, 7, 3, 0.01) < 0
    with pytest.raises(ValueError, match="confidence"):
        robust.num_trials_with_replacement(0.5, 2, 1.5)
