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
    linear = scale * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    moved = points @ linear.T + shift
    similarity = robust.fit_similarity(points, moved)
    assert similarity.scale() == pytest.approx(scale)
    assert similarity.angle_rad() == pytest.approx(angle)
    np.testing.assert_allclose(similarity.apply(points), moved)
    moved[20:] += 50
    report = robust.estimate_similarity(points, moved)
    assert report.num_inliers == 20
    np.testing.assert_allclose(report.model.matrix()[:2, :2], linear, atol=1e-9)


def test_numbers_of_samples():
    assert robust.num_trials_with_replacement(0.5, 2, 0.99) == 17
    assert robust.num_trials_without_replacement(50, 100, 2, 0.99) >= 16
    assert robust.log10_false_alarms(90, 100, 7, 3, 0.01) < 0
    with pytest.raises(ValueError, match="confidence"):
        robust.num_trials_with_replacement(0.5, 2, 1.5)


def test_ransac_by_steps_is_ransac(points):
    other = points + [4, -2]
    other[20:] += 50
    runs = [
        (robust.Ransac.line(points, seed=3), robust.estimate_line(points, seed=3)),
        (robust.Ransac.similarity(points, other), robust.estimate_similarity(points, other)),
        (robust.Ransac.homography(points, other), epipole.estimate_homography(points, other)),
    ]
    for run, expected in runs:
        trials = list(run)
        assert [trial.iteration for trial in trials] == list(range(1, expected.iterations + 1))
        assert run.iterations == expected.iterations
        assert any(trial.is_best for trial in trials)
        assert run.finish() == expected


def test_fundamental_matrix_by_steps(outliers):
    run = robust.Ransac.fundamental(*outliers, max_error_px=0.5)
    for trial in run:
        assert len(set(trial.sample)) == 7 and trial.num_models <= 3
        assert trial.model is None or trial.model.shape == (3, 3)
    assert run.finish() == epipole.estimate_fundamental(*outliers, max_error_px=0.5)


def line_problem(points):
    def fit(sample):
        p, q = points[sample]
        return None if q[0] == p[0] else np.polyfit(*points[sample].T, 1)

    return len(points), 2, fit, lambda line: points[:, 1] - np.polyval(line, points[:, 0])


def test_a_model_of_your_own_by_steps(points):
    problem = line_problem(points)
    run = robust.Ransac(*problem, max_error_px=0.1)
    assert run.best_model is None and run.best_score is None and run.required_iterations is None
    best = None
    for trial in run:
        if trial.is_best:
            best = trial.model if trial.refined is None else trial.refined
            assert run.best_model is best
            assert run.required_iterations == trial.required_iterations
    np.testing.assert_allclose(best, (0.5, 2), atol=1e-9)
    assert run.step() is None
    report, expected = run.finish(), epipole.ransac(*problem, max_error_px=0.1)
    np.testing.assert_array_equal(report.model, expected.model)
    assert report.iterations == expected.iterations and report.stop == expected.stop
    with pytest.raises(RuntimeError, match="finished"):
        run.step()


def test_a_run_ends_when_its_caller_has_enough(points):
    run = robust.Ransac.line(points, max_error_px=0.1)
    while not run.best_score or run.best_score < 15:
        run.step()
    assert run.iterations < run.expected_iterations
    report = run.finish()
    assert report.stop == "interrupted" and report.num_inliers == 20
    unstarted = robust.Ransac.line(points)
    with pytest.raises(epipole.NoConsensusError):
        unstarted.finish()


def test_a_run_starts_from_a_model(points):
    run = robust.Ransac.line(points, max_error_px=0.5)
    run.start_from(np.array([-0.5, 1, -2.2]) / np.hypot(0.5, 1))
    assert run.finish().num_inliers == 20
    similarity = robust.Ransac.similarity(points, points)
    similarity.start_from(robust.PlaneSimilarity(1, 0, 0, 0))
    assert similarity.required_iterations == 1
    own = robust.Ransac(*line_problem(points), max_error_px=0.1)
    own.start_from((0.5, 2))
    assert own.best_model == (0.5, 2)
    with pytest.raises(TypeError, match="PlaneSimilarity, but is tuple"):
        similarity.start_from((1, 0, 0, 0))
    with pytest.raises(ValueError, match=r"model must be an array of shape \(3,\)"):
        run = robust.Ransac.line(points)
        run.start_from(np.eye(3))


def test_exceptions_of_callables_are_raised_by_the_step(points):
    num_data, size, fit, errors = line_problem(points)
    is_broken = True

    def broken(sample):
        if is_broken:
            raise KeyError("fit")
        return fit(sample)

    run = robust.Ransac(num_data, size, broken, errors)
    with pytest.raises(KeyError, match="fit"):
        run.step()
    is_broken = False
    assert run.step().iteration == 2
    run = robust.Ransac(num_data, size, fit, lambda model: errors(model)[1:])
    with pytest.raises(ValueError, match=r"shape \(25,\)"):
        run.start_from((0.5, 2))
    run = robust.Ransac(num_data, size, lambda sample: run.step(), errors)
    with pytest.raises(RuntimeError, match="another thread"):
        run.step()
    with pytest.raises(epipole.TooFewError):
        robust.Ransac(1, 2, fit, errors)
    with pytest.raises(TypeError, match="unknown option sed"):
        robust.Ransac.line(points, sed=3)
