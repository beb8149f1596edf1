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
    add_points(model, positions, random)
    return model


def add_points(model, positions, random):
    """Points that every image sees, numbered with gaps."""
    for index, position in enumerate(positions):
        track = pycolmap.Track()
        for image in model.images:
            track.add_element(image, index)
        model.add_point3D(position, track, random.integers(0, 255, 3, dtype=np.uint8))
    for point in list(model.points3D)[::3]:
        model.delete_point3D(point)


def make_rigs():
    """Two cameras in a rig that took two pairs and a single image, and one alone."""
    random = np.random.default_rng(5)
    model = pycolmap.Reconstruction()
    sensor = lambda camera: pycolmap.sensor_t(type=pycolmap.SensorType.CAMERA, id=camera)
    pose = lambda: pycolmap.Rigid3d(pycolmap.Rotation3d(quaternion(random)), random.normal(size=3))
    for camera, name in [(3, "OPENCV"), (5, "PINHOLE"), (9, "SIMPLE_RADIAL")]:
        model.add_camera(pycolmap.Camera(model=name, width=640, height=480, params=MODELS[name], camera_id=camera))
    pair, single = pycolmap.Rig(rig_id=7), pycolmap.Rig(rig_id=8)
    pair.add_ref_sensor(sensor(3))
    pair.add_sensor(sensor(5), pose())
    single.add_ref_sensor(sensor(9))
    model.add_rig(pair)
    model.add_rig(single)
    positions = random.uniform([-1, -1, 4], [1, 1, 6], (12, 3))
    image_id = 1
    for frame_id, rig, cameras in [(11, 7, [3, 5]), (14, 7, [3, 5]), (17, 8, [9]), (20, 7, [5])]:
        frame = pycolmap.Frame(frame_id=frame_id, rig_id=rig)
        frame.rig_from_world = pose()
        images = []
        for camera in cameras:
            pixels = random.uniform([0, 0], [640, 480], (len(positions), 2))
            name = f"cam{camera}/f {frame_id}.jpg"
            images.append(pycolmap.Image(name=name, keypoints=pixels, camera_id=camera, image_id=image_id))
            frame.add_data_id(pycolmap.data_t(sensor(camera), image_id))
            image_id += 2
        model.add_frame(frame)
        for image in images:
            image.frame_id = frame_id
            model.add_image(image)
        model.register_frame(frame_id)
    add_points(model, positions, random)
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
    assert result["counts"] == {"cameras": 1, "images": len(names), "points": 8}
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


@pytest.mark.parametrize("kind", ["colmap-binary", "colmap-text"])
def test_rigs_return(epipole, tmp_path, kind):
    truth = make_rigs()
    (tmp_path / "theirs").mkdir()
    if kind == "colmap-binary":
        truth.write_binary(tmp_path / "theirs")
    else:
        for image in truth.images.values():
            image.name = image.name.replace(" ", "_")
        truth.write_text(tmp_path / "theirs")
    # The list of images is for older programs: poses are those of rigs and frames.
    if kind == "colmap-text":
        path = tmp_path / "theirs" / "images.txt"
        lines = path.read_text().splitlines()
        heads = [line.split() for line in lines if line.endswith(".jpg")]
        moved = {" ".join(head): " ".join([*head[:5], "9", "9", "9", *head[8:]]) for head in heads}
        path.write_text("\n".join(moved.get(line, line) for line in lines) + "\n")
    result = epipole("convert", tmp_path / "theirs", tmp_path / "ours", "--to", kind)
    assert result["counts"] == {"cameras": 3, "images": 6, "points": 8} and result["notes"] == []
    found = pycolmap.Reconstruction(tmp_path / "ours")
    check_same(found, truth)
    assert set(found.rigs) == {7, 8} and set(found.frames) == {11, 14, 17, 20}
    for key, frame in truth.frames.items():
        ours = found.frames[key]
        assert ours.rig_id == frame.rig_id
        assert np.abs(ours.rig_from_world.matrix() - frame.rig_from_world.matrix()).max() < 1e-14
        assert {data.id for data in ours.data_ids} == {data.id for data in frame.data_ids}
    sensor = pycolmap.sensor_t(type=pycolmap.SensorType.CAMERA, id=5)
    ours, theirs = (model.rigs[7].sensor_from_rig(sensor).matrix() for model in (found, truth))
    assert np.abs(ours - theirs).max() < 1e-14
    # Formats without rigs have the poses.
    result = epipole("convert", tmp_path / "theirs", tmp_path / "transforms.json")
    assert any("rigs are not written" in note for note in result["notes"])


def test_one_unsupported_camera_leaves_the_others(epipole, tmp_path):
    truth = make_rigs()
    truth.cameras[9].model = pycolmap.CameraModelId.FOV
    truth.cameras[9].params = OTHERS["FOV"]
    truth.write_binary(tmp_path)
    result = epipole("convert", tmp_path, tmp_path / "out", "--to", "colmap-binary")
    assert result["counts"] == {"cameras": 2, "images": 5, "points": 8}
    (note,) = result["notes"]
    assert note.startswith("camera 9: camera model FOV is not supported") and '"cam9/f 17.jpg"' in note
    found = pycolmap.Reconstruction(tmp_path / "out")
    assert set(found.images) == set(truth.images) - {9}
