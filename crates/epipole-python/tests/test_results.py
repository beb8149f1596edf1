"""repr, equality, pickling and copies of every class."""

import base64
import copy
import json
import pickle
import re

import numpy as np
import pytest

import epipole
from epipole import absolute_pose, epipolar, homography, robust, triangulation, two_view


def results(world, plane, outliers):
    k, camera = world.intrinsics, world.camera
    yield from (k, camera, camera.lens, world.posed[1], world.motion)
    yield epipole.estimate_fundamental(*outliers)
    yield epipole.estimate_relative_pose(*outliers, camera, camera)
    yield epipole.estimate_two_view_calibrated(*outliers, camera, camera)
    yield epipole.estimate_absolute_pose(world.points, world.pixels2, camera)
    yield robust.fit_similarity(*outliers)
    yield epipolar.RelativePose(world.rotation, world.translation)
    yield epipolar.fundamental_8point_explained(world.pixels1, world.pixels2)
    yield epipolar.select_pose([world.motion], world.pixels1, world.pixels2, k, k)
    yield homography.PlaneMotion(world.motion, np.array([0.0, 0.0, 1.0]))
    yield absolute_pose.AbsolutePoseWithFocal(world.motion, 500.0, None)
    yield triangulation.NviewPoint(np.zeros(3), 0.5)
    yield two_view.Degeneracy("unmoved", 3, 4)


def test_pickles_and_copies_are_equal(world, plane, outliers):
    for result in results(world, plane, outliers):
        for again in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
            assert again == result and type(again) is type(result)
        assert result != 3
        with pytest.raises(AttributeError):
            result.model = 1


def test_repr_names_the_attributes(world, plane, outliers):
    for result in results(world, plane, outliers):
        assert repr(result).startswith(type(result).__name__ + "(")
        assert len(repr(result)) < 1200
    assert repr(world.intrinsics) == "Intrinsics(fu_px=500.0, fv_px=510.0, cu_px=320.0, cv_px=240.0)"
    text = repr(epipole.estimate_fundamental(*outliers))
    assert "inliers=<bool array of shape (60,), 40 true>" in text


def test_classes_of_different_values_differ(world):
    assert epipole.Lens("fisheye") != epipole.Lens("brown")
    assert world.motion != world.motion.inverse()
    assert world.posed[0] != world.posed[1]


def test_every_class_and_function_has_a_docstring_and_a_home():
    for name in ("camera", "robust", "epipolar", "homography", "absolute_pose", "triangulation"):
        module = getattr(epipole, name)
        for attribute in vars(module).values():
            if callable(attribute) and not isinstance(attribute, type(np)):
                assert attribute.__doc__, attribute
                assert attribute.__module__ == f"epipole.{name}", attribute


def test_notebooks_show_a_table(outliers):
    report = epipole.estimate_fundamental(*outliers)
    html = report._repr_html_()
    assert html.startswith("<table><caption>RansacReport</caption>")
    assert "<th>num_inliers</th><td><code>" in html
    assert "&lt;bool array" in html or "[True" in html


def test_notebooks_show_a_rotating_view_of_a_reconstruction():
    intrinsics = epipole.Intrinsics(500, 500, 319.5, 239.5)
    camera = epipole.Camera.pinhole(intrinsics, 640, 480)
    posed = epipole.PosedCamera(camera, epipole.RigidTransform())
    points, tracks = [[0, 0, 4], [1, 0, 5], [-1, 0, 3]], [[0, 0, 0], [1, 0, 1]]
    html = epipole.sfm.Reconstruction([posed, None], points, tracks)._repr_html_()
    assert html.startswith('<div id="epipole-')
    assert "<caption>Reconstruction</caption>" in html
    data = json.loads(re.search(r'\), (\{"points".*?\})\);</script>', html)[1])
    assert (data["points"], data["cameras"]) == (3, 1)
    content = base64.b64decode(data["bytes"])
    places = np.frombuffer(content[: 6 * 8], "<i2").reshape(8, 3)
    assert len(content) == 6 * 8 + 3 * 3
    # Around the median, in the axes of the camera, whose center is straight behind.
    np.testing.assert_array_equal(places[0], 0)
    np.testing.assert_array_equal(places[1], -places[2])
    assert places[3][0] == 0 == places[3][1] and places[3][2] < 0
    pytest.importorskip("matplotlib")
    assert '<img alt="1 cameras and 3 points" src="data:image/png;base64,iVBOR' in html
    empty = epipole.sfm.Reconstruction([None], np.empty((0, 3)), np.empty((0, 3), int))
    assert "0 cameras and 0 points" in empty._repr_html_()
