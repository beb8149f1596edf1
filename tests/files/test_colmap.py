"""COLMAP's models through pycolmap: binary and text, every camera model, names of all kinds."""

import subprocess

import numpy as np
import pytest
from conftest import NAMES, quaternion

pycolmap = pytest.importorskip("pycolmap", reason="pycolmap is not installed: pip install -r tests/requirements.txt")

F, C = [700.25], [321.5, 239.125]
FF = [700.25, 698.5]
# Parameters of each model that has a lens of ours.
MODELS = {
    "SIMPLE_PINHOLE": F + C,
    "PINHOLE": FF + C,
    "SIMPLE_RADIAL": F + C + [-0.11],
    "RADIAL": F + C + [-0.11, 0.03],
    "OPENCV": FF + C + [-0.11, 0.03, 0.001, -0.002],
    "FULL_OPENCV": FF + C + [-0.11, 0.03, 0.001, -0.002, 0.004, 0.01, -0.02, 0.003],
    "OPENCV_FISHEYE": FF + C + [-0.02, 0.01, -0.003, 0.0004],
    "SIMPLE_RADIAL_FISHEYE": F + C + [-0.02],
    "RADIAL_FISHEYE": F + C + [-0.02, 0.01],
    "THIN_PRISM_FISHEYE": FF + C + [-0.02, 0.01, 0, 0, -0.003, 0.0004, 0, 0],
    "RAD_TAN_THIN_PRISM_FISHEYE": FF + C + [-0.02, 0.01, -0.003, 0.0004] + 8 * [0],
    "SIMPLE_DIVISION": F + C + [-0.1],
    "DIVISION": FF + C + [-0.1],
    "SIMPLE_FISHEYE": F + C,
    "FISHEYE": FF + C,
}
OTHERS = {"FOV": FF + C + [0.9], "EUCM": FF + C + [0.5, 1.1], "EQUIRECTANGULAR": [640, 480]}


def make_model(name, params, names=NAMES):
    """A reconstruction with one camera, tracks and keypoints without a point."""
    random = np.random.default_rng(3)
    model = pycolmap.Reconstruction()
    camera = pycolmap.Camera(model=name, width=640, height=480, params=params, camera_id=3)
    model.add_camera_with_trivial_rig(camera)
    positions = random.uniform([-1, -1, 4], [1, 1, 6], (12, 3))
    for index, image_name in enumerate(names):
        pixels = random.uniform([0, 0], [640, 480], (len(positions) + 2, 2))
        image = pycolmap.Image(name=image_name, keypoints=pixels, camera_id=3, image_id=2 * index + 1)
        pose = pycolmap.Rigid3d(pycolmap.Rotation3d(quaternion(random)), random.normal(size=3))
        model.add_image_with_trivial_frame(image, pose)
    for index, position in enumerate(positions):
        track = pycolmap.Track()
        for image in range(len(names)):
            track.add_element(2 * image + 1, index)
        model.add_point3D(position, track, random.integers(0, 255, 3, dtype=np.uint8))
    return model


def check_same(found, truth):
    """Asserts that two reconstructions agree in all that both formats store."""
    assert found.num_cameras() == truth.num_cameras()
    assert found.num_images() == truth.num_images()
    assert found.num_points3D() == truth.num_points3D()
    rays = np.random.default_rng(4).uniform(-0.4, 0.4, (50, 2))
    rays = np.column_stack([rays, np.ones(50)])
    for key, image in truth.images.items():
        # Cameras are numbered anew.
        camera, other = image.camera, found.images[key].camera
        assert (other.width, other.height) == (camera.width, camera.height)
        assert np.abs(other.img_from_cam(rays) - camera.img_from_cam(rays)).max() < 1e-9
    for key, image in truth.images.items():
        other = found.images[key]
        assert other.name == image.name
        ours, theirs = other.cam_from_world().matrix(), image.cam_from_world().matrix()
        assert np.abs(ours - theirs).max() < 1e-14
        ours = np.array([point.xy for point in other.points2D])
        theirs = np.array([point.xy for point in image.points2D])
        # Half a pixel is subtracted and added again.
        assert np.abs(ours - theirs).max() < 2e-13
        assert [p.point3D_id for p in other.points2D] == [p.point3D_id for p in image.points2D]
    for key, point in truth.points3D.items():
        other = found.points3D[key]
        assert np.array_equal(other.xyz, point.xyz) and np.array_equal(other.color, point.color)
        elements = [{(e.image_id, e.point2D_idx) for e in p.track.elements} for p in (other, point)]
        assert elements[0] == elements[1]


@pytest.mark.parametrize("kind", ["colmap-binary", "colmap-text"])
@pytest.mark.parametrize("name", MODELS)
def test_every_camera_model_returns(epipole, tmp_path, name, kind):
    # COLMAP cuts names at blanks in its text files.
    names = NAMES if kind == "colmap-binary" else [name for name in NAMES if " " not in name]
    truth = make_model(name, MODELS[name], names)
    for folder in ("theirs", "again"):
        (tmp_path / folder).mkdir()
    truth.write_binary(tmp_path / "theirs") if kind == "colmap-binary" else truth.write_text(tmp_path / "theirs")
    result = epipole("convert", tmp_path / "theirs", tmp_path / "ours", "--to", kind)
    assert result["counts"] == {"cameras": 1, "images": len(names), "points": 12}
    found = pycolmap.Reconstruction(tmp_path / "ours")
    check_same(found, truth)
    # Once more through both: nothing drifts.
    found.write_binary(tmp_path / "again")
    epipole("convert", tmp_path / "again", tmp_path / "twice", "--to", kind)
    check_same(pycolmap.Reconstruction(tmp_path / "twice"), truth)


@pytest.mark.parametrize("name", OTHERS)
def test_other_camera_models_are_named(epipole, tmp_path, name):
    make_model(name, OTHERS[name]).write_binary(tmp_path)
    with pytest.raises(subprocess.CalledProcessError) as failure:
        epipole("convert", tmp_path, tmp_path / "out")
    assert f"camera model {name} is not supported" in failure.value.stdout.decode() + failure.value.stderr.decode()


def test_names_with_blanks_are_told_in_text_files(epipole, tmp_path):
    truth = make_model("PINHOLE", MODELS["PINHOLE"])
    truth.write_binary(tmp_path)
    result = epipole("convert", tmp_path, tmp_path / "text", "--to", "colmap-text")
    assert any("2 names have blanks" in note and "use colmap-binary" in note for note in result["notes"])
    # Ours reads them back whole.
    epipole("convert", tmp_path / "text", tmp_path / "binary", "--to", "colmap-binary")
    names = {image.name for image in pycolmap.Reconstruction(tmp_path / "binary").images.values()}
    assert names == set(NAMES)
