"""Small mathematics, least squares, and synthetic worlds."""

import pickle

import numpy as np
import pytest

import epipole
from epipole import math, optim, synthetic


def test_least_squares_of_callables():
    x = np.linspace(0, 1, 20)
    y = 2 * np.exp(-1.5 * x)

    def residuals(p):
        return p[0] * np.exp(p[1] * x) - y

    def jacobian(p):
        return np.column_stack([np.exp(p[1] * x), p[0] * x * np.exp(p[1] * x)])

    found, report = optim.minimize_dense(residuals, jacobian, [1.0, 0.0])
    np.testing.assert_allclose(found, [2, -1.5], atol=1e-6)
    assert report.is_converged() and pickle.loads(pickle.dumps(report)) == report
    held, _ = optim.minimize_dense(residuals, jacobian, [1.0, 0.0], held=[True])
    assert held[0] == 1
    at = np.array([1.0, 0.5])
    assert optim.check_jacobian(jacobian(at), lambda d: residuals(at + d)) < 1e-6
    with pytest.raises(ZeroDivisionError):
        optim.minimize_dense(residuals, lambda p: 1 / 0, [1.0, 0.0])
    with pytest.raises(ValueError, match="result of residuals"):
        optim.minimize_dense(lambda p: 3.0, jacobian, [1.0, 0.0])
    with pytest.raises(ValueError, match="result of jacobian"):
        optim.minimize_dense(residuals, lambda p: np.zeros((3, 2)), [1.0, 0.0])


def test_math():
    munich, north = math.Geodetic(48.0, 11.0, 500.0), math.Geodetic(48.001, 11.0, 500.0)
    local = math.local_from_geodetic(north, munich)
    np.testing.assert_allclose(local, [0, 111.2, 0], atol=0.1)
    line = math.Line2.through([0, 1], [4, 1])
    assert abs(line.signed_distance([2, 3])) == 2
    np.testing.assert_allclose(line.nearest([2, 3]), [2, 1])
    assert pickle.loads(pickle.dumps(line)) == line
    a = np.random.default_rng(1).normal(size=(3, 3))
    svd = math.svd3(a)
    np.testing.assert_allclose(svd.u @ np.diag(svd.singular_values) @ svd.v.T, a, atol=1e-12)
    assert math.length([3, 4]) == 5
    first, second = math.Random(7), math.Random(7)
    assert [first.unit(), first.below(9)] == [second.unit(), second.below(9)]
    with pytest.raises(ValueError, match="latitude"):
        math.local_from_geodetic(math.Geodetic(95.0, 0.0, 0.0), munich)


def test_synthetic_worlds():
    problem = synthetic.MultiViewProblem(num_points=150, noise_px=0.3)
    again = synthetic.MultiViewProblem(num_points=150, noise_px=0.3)
    assert again == problem != synthetic.MultiViewProblem(num_points=150, seed=5)
    assert pickle.loads(pickle.dumps(problem)) == problem
    observations = problem.observations
    camera, point = observations.indices[0]
    assert np.abs(problem.cameras[camera].project(problem.points[point]) - observations.pixels[0]).max() < 3
    assert observations.is_inlier.all() and len(problem.tracks()) == 150
    assert set(observations.indices[problem.tracks()[3], 1]) == {3}
    views = synthetic.TwoViewProblem(
        num_points=50, outlier_fraction=0.2, structure={"plane": {"half_side_m": 1.0}}
    )
    assert views.is_inlier.sum() == 40 and views.pixels1.shape == views.pixels2.shape == (50, 2)
    assert pickle.loads(pickle.dumps(views)) == views
    with pytest.raises(TypeError, match="unknown option num_views"):
        synthetic.MultiViewProblem(num_views=3)


def test_every_class_and_function_has_a_docstring_and_a_home():
    for name in ("calibration", "sfm", "io", "stitch", "math", "optim", "synthetic"):
        module = getattr(epipole, name)
        for attribute in vars(module).values():
            if callable(attribute) and not isinstance(attribute, type(np)):
                assert attribute.__doc__, attribute
                assert attribute.__module__ == f"epipole.{name}", attribute
