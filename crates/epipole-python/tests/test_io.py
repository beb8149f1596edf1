"""Round trips of files, and broken ones."""

import pathlib
import pickle

import numpy as np
import pytest
from conftest import rotation

import epipole
from epipole import io, sfm, stereo
from epipole.math import Geodetic


@pytest.fixture
def camera():
    intrinsics = epipole.Intrinsics(600.0, 605.5, 322.25, 238.0)
    lens = epipole.Lens("brown", [-0.2, 0.05, 0.001, 0.0, 0.0])
    return epipole.Camera(640, 480, intrinsics, lens)


@pytest.fixture
def motion():
    return epipole.RigidTransform(rotation([0.1, 1, 0.2], 0.3), [0.5, -0.1, 2.0])


@pytest.fixture
def model(camera, motion):
    random = np.random.default_rng(1)
    points = random.uniform(-1, 1, (20, 3)) + [0, 0, 5]
    # Some formats have one focal length.
    pinhole = epipole.Camera.pinhole(epipole.Intrinsics.centered(600.0, 640, 480), 640, 480)
    images = [
        io.ModelImage(k + 1, f"{k}.jpg", 0, pose, pinhole.project(pose @ points))
        for k, pose in enumerate([epipole.RigidTransform(), motion])
    ]
    tracks = [(p, i, p) for p in range(20) for i in range(2)]
    colors = random.integers(0, 255, (20, 3), dtype=np.uint8)
    return io.Model([pinhole], images, points, tracks, colors)


@pytest.mark.parametrize("format", ["epipole", "opencv", "ros", "colmap"])
def test_cameras(tmp_path, camera, format):
    path = tmp_path / "camera.txt"
    cameras = io.Cameras.of(camera)
    io.write_cameras(path, cameras, format)
    for source in (path, str(path), path.read_bytes()):
        found, again = io.read_cameras(source)
        assert found == format and again.cameras[0].camera == camera
    assert len(again) == 1 and again.right_from_left is None


def test_rig_of_cameras(tmp_path, camera, motion):
    rig = io.Cameras.of_rig([camera, camera], motion)
    io.write_cameras(tmp_path / "rig.json", rig)
    _, again = io.read_cameras(tmp_path / "rig.json")
    assert again.named("left") == camera
    np.testing.assert_allclose(again.right_from_left.rotation, motion.rotation, atol=1e-12)
    with pytest.raises(KeyError):
        again.named("middle")


def test_opencv_reads_our_camera(tmp_path, camera):
    cv2 = pytest.importorskip("cv2")
    path = tmp_path / "camera.yml"
    io.write_cameras(path, io.Cameras.of(camera), "opencv")
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    k = storage.getNode("camera_matrix").mat()
    np.testing.assert_array_equal(k, camera.intrinsics.matrix())


def write_noise(path, height, width):
    image = np.random.default_rng(2).integers(0, 255, (height, width, 3), dtype=np.uint8)
    pytest.importorskip("cv2").imwrite(str(path), image[..., ::-1])
    return image


def test_photos_as_opencv(tmp_path):
    cv2 = pytest.importorskip("cv2")
    path = tmp_path / "photo.png"
    image = write_noise(path, 40, 60)
    decoded = io.decode_rgb(path)
    np.testing.assert_array_equal(decoded.image, image)
    assert decoded.focal_px is None and decoded.place is None and decoded.orientation == 1
    assert io.sensor_size(str(path)) == (60, 40)
    gray = io.decode_gray(path.read_bytes()).image
    assert gray.dtype == np.float32 and gray.shape == (40, 60)
    np.testing.assert_allclose(gray * 255, cv2.cvtColor(image, cv2.COLOR_RGB2GRAY), atol=1)
    deep = np.arange(2400, dtype=np.uint16).reshape(40, 60) * 20
    cv2.imwrite(str(path), deep)
    full = io.decode_gray(path, range="full").image
    np.testing.assert_allclose(full, deep / 65535, atol=1e-6)
    between = io.decode_gray(path, range=(0, 47980)).image
    assert between.max() == pytest.approx(1, abs=1e-4)
    with pytest.raises(ValueError, match="range"):
        io.decode_gray(path, range="some")
    with pytest.raises(ValueError, match="2400 pixels"):
        io.decode_gray(path, max_pixels=100)


def test_prepared_photo(tmp_path, camera):
    path = tmp_path / "photo.png"
    image = write_noise(path, 480, 640)
    prepared = io.prepare_photo(path)
    np.testing.assert_array_equal(prepared.image, image)
    assert prepared.is_as_stored and prepared.full_size == (640, 480) and prepared.quarters == 0
    small = io.prepare_photo(path, max_pixels=320 * 240)
    assert small.image.shape == (240, 320, 3) and small.reduced_focal_px(600) == 300
    assert small.camera(camera).intrinsics.fu_px == pytest.approx(300)
    flat = io.prepare_photo(path, undistortion=epipole.calibration.Undistortion(camera))
    assert flat.intrinsics is not None and not flat.is_as_stored
    assert pickle.loads(pickle.dumps(flat)) == flat


@pytest.mark.parametrize("format", ["colmap-text", "colmap-binary", "openmvg"])
def test_models(tmp_path, model, format):
    paths = model.write(tmp_path / "model", format)
    assert all(isinstance(path, pathlib.Path) and path.exists() for path in paths)
    read = io.read_model_folder(tmp_path / "model")
    again = read.model
    assert read.format == format and again.cameras == model.cameras
    np.testing.assert_allclose(again.points, model.points)
    assert [image.name for image in again.images] == ["0.jpg", "1.jpg"]
    assert again.num_observations() == model.num_observations() == 40
    assert again.mean_reprojection_px() < 1e-6
    np.testing.assert_allclose(again.images[1].keypoints, model.images[1].keypoints)
    if format != "openmvg":
        np.testing.assert_array_equal(again.colors, model.colors)


def test_other_models(tmp_path, model):
    assert set(model.to_files("colmap-text")) == {"cameras.txt", "images.txt", "points3D.txt"}
    assert model.losses("ply") == ["only the points are written"]
    (glb,) = model.to_files("glb").values()
    assert glb[:4] == b"glTF"
    (path,) = model.write(tmp_path, "ply")
    assert io.read_model_file(path).format == "ply"
    assert isinstance(model.oddities(), list)
    reconstruction, images = model.to_reconstruction()
    assert reconstruction.num_registered() == 2
    again = io.Model.from_reconstruction(reconstruction, images)
    np.testing.assert_allclose(again.points, model.points)


def test_numbers_and_rigs_of_models(tmp_path, model, motion):
    assert model.camera_ids == [1] and model.point_ids == list(range(1, 21)) and model.rigs == []
    other = epipole.Camera.pinhole(epipole.Intrinsics.centered(500.0, 640, 480), 640, 480)
    images = [model.images[0], io.ModelImage(2, "1.jpg", 1, motion, model.images[1].keypoints)]
    rig = io.Rig(4, [(0, epipole.RigidTransform()), (1, motion)], [(9, epipole.RigidTransform(), [0, 1])])
    ids = list(range(100, 80, -1))
    parts = (model.points, model.tracks, model.colors, None, [7, 5], ids, [rig])
    in_rig = io.Model([model.cameras[0], other], images, *parts)
    assert pickle.loads(pickle.dumps(in_rig)) == in_rig
    for format in ["colmap-text", "colmap-binary"]:
        in_rig.write(tmp_path / format, format)
        again = io.read_model_folder(tmp_path / format).model
        assert again.camera_ids == [7, 5] and again.point_ids == ids
        assert again.rigs == [rig] and again.rigs[0].id == 4
        assert again.rigs[0].frames[0][2] == [0, 1]
        np.testing.assert_allclose(again.rigs[0].cameras[1][1].translation, motion.translation)
    moved = [images[0], io.ModelImage(2, "1.jpg", 1, epipole.RigidTransform(), model.images[1].keypoints)]
    with pytest.raises(ValueError, match="is not where frame 9"):
        io.Model([model.cameras[0], other], moved, *parts).to_files("colmap-text")


def test_notes(tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 640 480 500 500 320 240\n2 FOV 640 480 500 500 320 240 0.9\n")
    _, cameras = io.read_cameras(path)
    (note,) = cameras.notes
    assert len(cameras) == 1 and note.startswith("camera 2 is left out: camera model FOV")
    _, trajectory = io.read_trajectory(b"0,0,0,0,1,0,0,0\n5000000,0,0,0,1,0,0,0\n")
    assert "w, x, y, z" in trajectory.notes[0]
    assert pickle.loads(pickle.dumps(trajectory)) == trajectory
    mesh = (
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        b"element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n1 0\n"
    )
    cloud, notes = io.read_ply(mesh)
    assert len(cloud.points) == 1 and notes == ["1 face is not read: a mesh becomes points"]


def test_q(tmp_path):
    q = np.array([[1, 0, 0, -320.5], [0, 1, 0, -240], [0, 0, 0, 700], [0, 0, 8.25, 0]])
    np.savetxt(tmp_path / "q.txt", q)
    np.testing.assert_array_equal(io.read_q(tmp_path / "q.txt"), q)
    cv2 = pytest.importorskip("cv2")
    storage = cv2.FileStorage(str(tmp_path / "q.yml"), cv2.FILE_STORAGE_WRITE)
    storage.write("Q", q)
    storage.release()
    np.testing.assert_array_equal(io.read_q(tmp_path / "q.yml"), q)
    with pytest.raises(ValueError, match="has 4 numbers, not 16"):
        io.read_q(b"1 2 3 4")


def test_sensor_width(tmp_path):
    image = pytest.importorskip("PIL.Image")
    photo = image.new("RGB", (600, 400), (90, 90, 90))
    exif = photo.getexif()
    # FocalLength, of the IFD of the camera.
    exif[0x8769] = {0x920A: pytest.importorskip("PIL.TiffImagePlugin").IFDRational(50)}
    photo.save(tmp_path / "photo.jpg", exif=exif)
    prepared = io.prepare_photo(tmp_path / "photo.jpg")
    assert prepared.focal_mm == 50.0 and prepared.focal_px is None
    assert io.decode_rgb(tmp_path / "photo.jpg").focal_mm == 50.0
    # 50 mm on a sensor of 25 mm are two widths.
    prepared = io.prepare_photo(tmp_path / "photo.jpg", sensor_width_mm=25.0)
    assert prepared.focal_px == pytest.approx(1200)
    assert pickle.loads(pickle.dumps(prepared)) == prepared


def test_clouds(tmp_path):
    points = np.random.default_rng(3).normal(size=(30, 3)).astype(np.float32)
    colors = np.arange(90, dtype=np.uint8).reshape(30, 3)
    path = tmp_path / "cloud.ply"
    io.write_ply(path, stereo.PointCloud(points.astype(float), colors))
    cloud, notes = io.read_ply(path)
    assert notes == []
    np.testing.assert_array_equal(cloud.points, points)
    np.testing.assert_array_equal(cloud.colors, colors)
    io.write_ply(path, points)
    assert io.read_ply(path)[0].colors is None


def test_disparities(tmp_path):
    disparity = np.random.default_rng(4).uniform(1, 60, (12, 17)).astype(np.float32)
    disparity[3, 5] = np.nan
    path = tmp_path / "disparity.pfm"
    io.write_pfm(path, disparity)
    np.testing.assert_array_equal(io.read_pfm(path), disparity)
    cv2 = pytest.importorskip("cv2")
    io.write_png16(tmp_path / "disparity.png", disparity)
    read = cv2.imread(str(tmp_path / "disparity.png"), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(read, np.nan_to_num(np.round(disparity * 256)).astype(np.uint16))


def test_pose_graphs(tmp_path):
    random = np.random.default_rng(5)
    quaternions = random.normal(size=(4, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    poses = np.column_stack([random.normal(size=(4, 3)), quaternions])
    edges = [(0, 1), (1, 2), (2, 3)]
    graphs = [
        sfm.PoseGraph("se2", poses[:, :3], edges, random.normal(size=(3, 3)), fixed=[2]),
        sfm.PoseGraph("se3", poses, edges, poses[:3], ids=[4, 5, 7, 9]),
        sfm.PoseGraph("sim3", np.column_stack([poses, [1, 2, 3, 4]]), edges,
                      np.column_stack([poses[:3], [1, 1, 2]])),
    ]
    for graph in graphs:
        io.write_g2o(tmp_path / "graph.g2o", graph)
        again = io.read_g2o(tmp_path / "graph.g2o")
        assert again.kind == graph.kind and again.size() == (4, 3)
        np.testing.assert_allclose(again.vertices, graph.vertices, atol=1e-12)
        np.testing.assert_allclose(again.measurements, graph.measurements, atol=1e-12)
        np.testing.assert_array_equal(again.edges, graph.edges)
        np.testing.assert_array_equal(again.fixed, graph.fixed)
        np.testing.assert_array_equal(again.ids, graph.ids)


def test_g2o_has_priors_and_landmarks(tmp_path):
    text = (b"VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_XY 2 4 4\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
            b"EDGE_SE2_XY 0 2 4 5 1 0 1\nEDGE_BEARING_SE2_XY 0 2 1 1\nEDGE_PRIOR_SE2 0 5 6 0 1 0 0 1 0 1\n")
    with pytest.warns(UserWarning, match="left out: 1 measurement"):
        graph = io.read_g2o(text)
    assert list(graph.landmarks) == [2] and list(graph.prior_vertices) == [0]
    np.testing.assert_array_equal(graph.priors, [[5, 6, 0]])
    assert pickle.loads(pickle.dumps(graph)) == graph
    graph, _ = graph.optimize()
    np.testing.assert_allclose(graph.vertices, [[5, 6, 0], [6, 6, 0], [9, 11, 0]], atol=1e-6)
    io.write_g2o(tmp_path / "graph.g2o", graph)
    again = io.read_g2o(tmp_path / "graph.g2o")
    assert again.chi2() < 1e-12 and list(again.landmarks) == [2]


def test_bal(tmp_path):
    random = np.random.default_rng(6)
    problem = sfm.BalProblem(random.normal(size=(2, 9)), random.normal(size=(3, 3)),
                             [(0, 0), (1, 2)], random.normal(size=(2, 2)))
    io.write_bal(tmp_path / "problem.txt", problem)
    assert io.read_bal(tmp_path / "problem.txt") == problem


@pytest.mark.parametrize("layout", ["text", "csv"])
def test_matches(tmp_path, layout):
    pixels1, pixels2 = np.random.default_rng(7).uniform(0, 600, (2, 9, 2))
    path = tmp_path / "matches.txt"
    io.write_matches(path, pixels1, pixels2, np.ones(9), np.full(9, 0.5), layout)
    again = io.read_matches(path)
    np.testing.assert_array_equal(again[0], pixels1)
    np.testing.assert_array_equal(again[1], pixels2)
    np.testing.assert_array_equal(io.read_points(b"1 2\n3 4\n"), [(1, 2), (3, 4)])
    pixels, points = io.read_points_with_pixels(b"1 2 3 4 5\n")
    assert (pixels.tolist(), points.tolist()) == ([[4, 5]], [[1, 2, 3]])


@pytest.mark.parametrize("format", ["tum", "kitti", "euroc"])
def test_trajectories(tmp_path, motion, format):
    trajectory = io.Trajectory([epipole.RigidTransform(), motion], [10**9, 2 * 10**9])
    path = tmp_path / "path.txt"
    io.write_trajectory(path, trajectory, format)
    found, again = io.read_trajectory(path)
    assert found == format and len(again) == 2
    np.testing.assert_allclose(again.world_from_cam[1].matrix(), motion.matrix(), atol=1e-9)
    if format == "kitti":
        assert again.stamps_ns is None
    else:
        np.testing.assert_array_equal(again.stamps_ns, trajectory.stamps_ns)


def test_missing_and_broken_files(tmp_path, camera):
    missing = tmp_path / "missing"
    readers = [io.read_cameras, io.decode_rgb, io.decode_gray, io.sensor_size, io.prepare_photo,
               io.read_model_file, io.read_ply, io.read_pfm, io.read_g2o, io.read_bal,
               io.read_matches, io.read_points, io.read_points_with_pixels, io.read_trajectory]
    broken = tmp_path / "broken"
    broken.write_bytes(b"\xff\xfe?\x00")
    for reader in readers:
        with pytest.raises(FileNotFoundError) as error:
            reader(missing)
        assert error.value.filename == str(missing)
        with pytest.raises(ValueError, match="broken: "):
            reader(broken)
        with pytest.raises(TypeError, match="path must be str or os.PathLike, but is int"):
            reader(3)
    with pytest.raises(FileNotFoundError):
        io.read_model_folder(missing)
    with pytest.raises(FileNotFoundError, match="no model"):
        io.read_model_folder(tmp_path)
    with pytest.raises(IsADirectoryError):
        io.write_cameras(tmp_path, io.Cameras.of(camera))
    with pytest.raises(ValueError, match='format must be one of "epipole"'):
        io.write_cameras(broken, io.Cameras.of(camera), "other")
    with pytest.raises(ValueError, match="line 1"):
        io.read_g2o(b"VERTEX_SE2 a\n")


def test_pickles_are_equal(camera, motion, model):
    for value in (
        io.NamedCamera("left", camera, motion),
        io.Cameras.of_rig([camera, camera], motion),
        io.Trajectory([motion], [5]),
        io.Trajectory([motion]),
        model,
        model.images[0],
        Geodetic(48.0, 11.0, 500.0),
    ):
        assert pickle.loads(pickle.dumps(value)) == value
        assert repr(value).startswith(type(value).__name__)
