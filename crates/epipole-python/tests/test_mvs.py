"""Multi-view stereo of a plane, against its depth."""

import pickle

import numpy as np
import pytest

import epipole
from epipole import io, mvs, sfm
from epipole.camera import Camera, Intrinsics, PosedCamera, RigidTransform

DEPTH, FOCAL_PX, STEP = 2.0, 200.0, 0.1
WIDTH, HEIGHT = 120, 90


@pytest.fixture(scope="module")
def scene():
    """Four photos of a plane, each STEP to the right of the one before: 10 px further left."""
    noise = np.random.default_rng(1).uniform(0, 1, (HEIGHT, WIDTH + 30)).astype(np.float32)
    blurred = epipole.imaging.gaussian_blur(noise, 1.2)
    gray = np.clip(255 * (0.5 + 3 * (blurred - 0.5)), 0, 255).astype(np.uint8)
    photos = [np.repeat(gray[:, 10 * n : 10 * n + WIDTH, None], 3, axis=2) for n in range(4)]
    camera = Camera(WIDTH, HEIGHT, Intrinsics(FOCAL_PX, FOCAL_PX, 59.5, 44.5))
    cameras = [
        PosedCamera(camera, RigidTransform(np.eye(3), [-STEP * n, 0.0, 0.0])) for n in range(4)
    ]
    rays = np.random.default_rng(2).uniform([-0.1, -0.2, 1], [0.3, 0.2, 1], (60, 3))
    points = DEPTH * rays
    tracks = [(point, image, 0) for point in range(60) for image in range(4)]
    return sfm.Reconstruction(cameras, points, tracks), photos


@pytest.fixture(scope="module")
def result(scene):
    views = mvs.prepare_views(*scene)
    return views, mvs.estimate_depth_maps(views)


def test_depth_is_that_of_the_plane(result):
    views, maps = result
    assert [view.photo for view in views] == [0, 1, 2, 3]
    assert all(len(view.neighbors) == 3 for view in views)
    for depth_map in maps[1:3]:
        assert depth_map.density > 0.6
        known = depth_map.depth[~np.isnan(depth_map.depth)]
        assert abs(np.median(known) - DEPTH) < 0.005
        assert np.mean(np.abs(known - DEPTH) < 0.03) > 0.95
        normals = depth_map.normals[depth_map.num_views > 0]
        assert np.median(normals[:, 2]) < -0.99


def test_cloud_lies_on_the_plane(result, tmp_path):
    cloud = mvs.fuse_depth_maps(*result)
    assert len(cloud) > 5000
    assert abs(np.median(cloud.points[:, 2]) - DEPTH) < 0.005
    assert cloud.normals.shape == cloud.points.shape
    assert cloud.confidences.min() >= 3
    io.write_ply(tmp_path / "fused.ply", cloud)
    read, notes = io.read_ply(tmp_path / "fused.ply")
    assert notes == []
    assert np.allclose(read.normals, cloud.normals, atol=1e-6)
    assert np.array_equal(read.confidences, cloud.confidences)


def test_mesh_lies_on_the_plane(result, tmp_path):
    mesh = mvs.mesh_depth_maps(*result, voxel_size=0.03)
    points, triangles = mesh.vertices.points, mesh.triangles
    assert len(mesh) == len(triangles) > 500
    assert triangles.dtype == np.uint32 and triangles.max() == len(points) - 1
    assert abs(np.median(points[:, 2]) - DEPTH) < 0.005
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.mean(normals[:, 2] < 0) > 0.99
    assert pickle.loads(pickle.dumps(mesh)) == mesh
    for ending, start in [("ply", b"ply"), ("glb", b"glTF"), ("obj", b"v ")]:
        io.write_mesh(tmp_path / f"mesh.{ending}", mesh)
        assert (tmp_path / f"mesh.{ending}").read_bytes().startswith(start)
    assert np.allclose(io.read_ply(tmp_path / "mesh.ply")[0].points, points, atol=1e-5)
    with pytest.raises(ValueError, match="does not end in"):
        io.write_mesh(tmp_path / "mesh.stl", mesh)
    wrong = mvs.Mesh(mesh.vertices, triangles + np.uint32(1))
    with pytest.raises(ValueError, match="there is no vertex"):
        io.write_mesh(tmp_path / "mesh.ply", wrong)
    with pytest.raises(ValueError, match="voxel"):
        mvs.mesh_depth_maps(*result, voxel_size=0.0)


def test_texture_has_the_colors_of_the_photos(result, tmp_path):
    views, maps = result
    mesh = mvs.mesh_depth_maps(views, maps, voxel_size=0.03)
    texture = mvs.texture_mesh(mesh, views)
    assert texture.corners.shape == (len(mesh), 3, 2) and texture.corners.dtype == np.float32
    height, width, _ = texture.image.shape
    assert (texture.corners >= 0).all() and (texture.corners <= [width - 1, height - 1]).all()
    # The mean color of a triangle's middle in the texture and in the photo of view 1.
    middle = mesh.vertices.points[mesh.triangles].mean(axis=1)
    u, v = 59.5 + FOCAL_PX * (middle[:, 0] - STEP) / DEPTH, 44.5 + FOCAL_PX * middle[:, 1] / DEPTH
    inside = (u > 3) & (u < WIDTH - 4) & (v > 3) & (v < HEIGHT - 4)
    place = texture.corners[inside].mean(axis=1).round().astype(int)
    found = texture.image[place[:, 1], place[:, 0], 0].astype(float)
    truth = views[1].image[v[inside].round().astype(int), u[inside].round().astype(int), 0]
    assert inside.sum() > 500
    assert np.corrcoef(found, truth)[0, 1] > 0.9
    assert pickle.loads(pickle.dumps(texture)) == texture
    io.write_mesh(tmp_path / "mesh.glb", mesh, texture)
    assert b"image/jpeg" in (tmp_path / "mesh.glb").read_bytes()
    io.write_mesh(tmp_path / "mesh.obj", mesh, texture)
    assert (tmp_path / "mesh.obj").read_text().startswith("mtllib mesh.mtl\n")
    assert "map_Kd mesh.jpg" in (tmp_path / "mesh.mtl").read_text()
    assert (tmp_path / "mesh.jpg").read_bytes().startswith(b"\xff\xd8")
    with pytest.raises(ValueError, match="colors of vertices only"):
        io.write_mesh(tmp_path / "mesh.ply", mesh, texture)
    with pytest.raises(ValueError, match="size of a texture"):
        mvs.texture_mesh(mesh, views, max_size_px=3)
    wrong = mvs.MeshTexture(texture.image, texture.corners[1:])
    with pytest.raises(ValueError, match="triangles, but the mesh has"):
        io.write_mesh(tmp_path / "mesh.glb", mesh, wrong)


def test_options_and_progress(scene, result):
    views, _ = result
    stages = []
    mvs.estimate_depth_maps(
        views, min_views=2, num_rounds=1, progress=lambda stage, fraction: stages.append(stage)
    )
    assert set(stages) == {"estimating depths"}
    small = mvs.prepare_views(*scene, max_size_px=60)
    assert small[0].image.shape == (45, 60, 3)
    with pytest.raises(ValueError, match="number of neighbors"):
        mvs.estimate_depth_maps(views, num_neighbors=0)
    still = sfm.Reconstruction([scene[0].cameras[0]] * 4, scene[0].points, scene[0].tracks)
    with pytest.raises(epipole.DegenerateError, match="no two of them"):
        mvs.prepare_views(still, scene[1])


def test_views_and_maps_are_pickled(result):
    views, maps = result
    assert pickle.loads(pickle.dumps(views[0])) == views[0]
    again = pickle.loads(pickle.dumps(maps[0]))
    assert np.array_equal(again.depth, maps[0].depth, equal_nan=True)
    assert np.array_equal(again.num_views, maps[0].num_views)
