"""transforms.json through the loader of nerfstudio itself, beside COLMAP's cameras: `make test-nerfstudio`."""

import numpy as np
import pytest
from conftest import NAMES, quaternion

SKIPPED = "nerfstudio is not installed: make test-nerfstudio"
torch = pytest.importorskip("torch", reason=SKIPPED)
parser = pytest.importorskip("nerfstudio.data.dataparsers.nerfstudio_dataparser", reason=SKIPPED)
pycolmap = pytest.importorskip("pycolmap", reason="pycolmap is not installed: pip install -r tests/requirements.txt")

PINHOLE = ("PINHOLE", [700.25, 698.5, 321.5, 239.125])
BROWN = ("OPENCV", [700.25, 698.5, 321.5, 239.125, -0.11, 0.03, 0.001, -0.002])
FISHEYE = ("OPENCV_FISHEYE", [400.25, 398.5, 321.5, 239.125, -0.02, 0.01, -0.003, 0.0004])
WIDE = ("OPENCV_FISHEYE", [300.25, 298.5, 311.5, 229.125, -0.01, 0.01, -0.002, 0.0003])


def load(folder):
    """The parsed outputs in the world of the file: without centering, turning or scaling."""
    config = parser.NerfstudioDataParserConfig(
        data=folder / "transforms.json",
        orientation_method="none",
        center_method="none",
        auto_scale_poses=False,
        downscale_factor=1,
        eval_mode="all",
        load_3D_points=True,
    )
    return config.setup().get_dataparser_outputs(split="train")


@pytest.mark.parametrize("cameras", [[PINHOLE], [BROWN], [FISHEYE], [FISHEYE, WIDE]])
def test_rays_and_points_are_those_of_colmap(epipole, tmp_path, cameras):
    random = np.random.default_rng(7)
    truth = pycolmap.Reconstruction()
    for index, (model, params) in enumerate(cameras):
        camera = pycolmap.Camera(model=model, width=640, height=480, params=params, camera_id=index + 1)
        truth.add_camera_with_trivial_rig(camera)
    for index, name in enumerate(NAMES):
        image = pycolmap.Image(name=name, camera_id=index % len(cameras) + 1, image_id=index + 1)
        pose = pycolmap.Rigid3d(pycolmap.Rotation3d(quaternion(random)), random.normal(size=3))
        truth.add_image_with_trivial_frame(image, pose)
    points = random.normal(size=(5, 3))
    for point in points:
        truth.add_point3D(point, pycolmap.Track(), np.array([10, 20, 30], np.uint8))
    (tmp_path / "colmap").mkdir()
    truth.write_binary(tmp_path / "colmap")
    epipole("convert", tmp_path / "colmap", tmp_path / "out", "--to", "transforms")

    outputs = load(tmp_path / "out")
    names = [str(path.relative_to(tmp_path / "out")) for path in outputs.image_filenames]
    assert names == sorted(NAMES)
    images = {image.name: image for image in truth.images.values()}
    pixels = random.uniform([100, 100], [540, 380], (20, 2))
    # nerfstudio's coordinates are row and column, with pixel centers at halves.
    coordinates = torch.tensor(pixels[:, ::-1].copy(), dtype=torch.float32)
    for index, name in enumerate(names):
        image = images[name]
        world_from_cam = image.cam_from_world().inverse()
        flat = image.camera.cam_from_img(pixels)
        directions = np.column_stack([flat, np.ones(len(flat))]) @ world_from_cam.rotation.matrix().T
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        rays = outputs.cameras.generate_rays(camera_indices=index, coords=coordinates)
        # In single precision.
        assert np.abs(rays.origins.numpy() - world_from_cam.translation).max() < 1e-6
        assert np.abs(rays.directions.numpy() - directions).max() < 3e-6
    loaded = outputs.metadata["points3D_xyz"].numpy()
    assert np.abs(loaded[np.lexsort(loaded.T)] - points[np.lexsort(points.T)]).max() < 1e-6
    assert (outputs.metadata["points3D_rgb"].numpy() == [10, 20, 30]).all()
