"""Trajectories: what evo reads of ours and ours of evo, and the errors that both find."""

import numpy as np
import pytest
from conftest import quaternion, rotation

pytest.importorskip("evo", reason="evo is not installed: pip install -r tests/requirements.txt")
from evo.core import metrics, sync, trajectory  # noqa: E402
from evo.tools import file_interface  # noqa: E402


def make_path(count=40, noise_m=0.0):
    random = np.random.default_rng(5)
    angles = np.linspace(0, 3, count)
    places = np.column_stack([np.cos(angles), np.sin(angles), 0.2 * angles])
    places += noise_m * np.random.default_rng(6).normal(size=places.shape)
    turns = np.array([quaternion(random) for _ in angles])
    # evo has w first.
    return trajectory.PoseTrajectory3D(places, turns[:, [3, 0, 1, 2]], 1403636579.25 + 0.05 * np.arange(count))


def matrices(path):
    return np.array(path.poses_se3)


def test_tum_returns(epipole, tmp_path):
    truth = make_path()
    file_interface.write_tum_trajectory_file(tmp_path / "theirs.txt", truth)
    epipole("convert", tmp_path / "theirs.txt", tmp_path / "euroc.csv")
    epipole("convert", tmp_path / "euroc.csv", tmp_path / "ours.txt")
    for name in ("theirs.txt", "ours.txt"):
        found = file_interface.read_tum_trajectory_file(tmp_path / name)
        assert np.abs(found.timestamps - truth.timestamps).max() < 1e-6
        assert np.abs(matrices(found) - matrices(truth)).max() < 1e-12
    euroc = file_interface.read_euroc_csv_trajectory(tmp_path / "euroc.csv")
    assert np.abs(matrices(euroc) - matrices(truth)).max() < 1e-12


def test_kitti_returns(epipole, tmp_path):
    truth = make_path()
    file_interface.write_kitti_poses_file(tmp_path / "theirs.txt", truth)
    epipole("convert", tmp_path / "theirs.txt", tmp_path / "ours.txt", "--to", "kitti")
    found = file_interface.read_kitti_poses_file(tmp_path / "ours.txt")
    assert np.abs(matrices(found) - matrices(truth)).max() < 1e-12


@pytest.mark.parametrize("align", ["se3", "sim3"])
def test_errors_are_those_of_evo(epipole, tmp_path, align):
    truth, estimate = make_path(), make_path(noise_m=0.02)
    estimate.transform(np.block([[rotation(0.1, 0.5, -0.2, 0.8), np.array([[1], [2], [3]])], [np.zeros(3), 1]]))
    if align == "sim3":
        estimate.scale(1.7)
    for name, path in (("truth", truth), ("estimate", estimate)):
        file_interface.write_tum_trajectory_file(tmp_path / name, path)
    result = epipole("compare", tmp_path / "truth", tmp_path / "estimate", "--align", align)
    truth, estimate = (file_interface.read_tum_trajectory_file(tmp_path / name) for name in ("truth", "estimate"))
    truth, estimate = sync.associate_trajectories(truth, estimate)
    _, _, scale = estimate.align(truth, correct_scale=align == "sim3")
    assert abs(result["scale"] - scale) < 1e-9
    ape = metrics.APE(metrics.PoseRelation.translation_part)
    rpe = metrics.RPE(metrics.PoseRelation.translation_part, delta=1, delta_unit=metrics.Unit.frames, all_pairs=True)
    for metric, key in ((ape, "ape"), (rpe, "rpe")):
        metric.process_data((truth, estimate))
        found = result[key]["translation_m"]
        for statistic, value in metric.get_all_statistics().items():
            assert abs(found[statistic] - value) < 1e-9, (key, statistic)
