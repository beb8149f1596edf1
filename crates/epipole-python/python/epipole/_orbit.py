"""Notebook view of a reconstruction: an image that a script replaces by a rotatable view."""

import base64
import functools
import html
import json
import pathlib
import uuid

import numpy as np

from epipole import sfm
from epipole.camera import PosedCamera

# Limits the size of the notebook, which stores each output.
_MAX_POINTS = 4000
# Units of a position per radius of the cloud, as in `_orbit.js`.
_UNIT = 8000
# Depth of the frusta of cameras, radii of the cloud.
_DEPTH = 0.12


@functools.cache
def _script() -> str:
    return (pathlib.Path(__file__).parent / "_orbit.js").read_text(encoding="utf-8")


def orbit(result: sfm.Reconstruction, picture: str) -> str:
    """Returns the HTML of a reconstruction; viewers without scripts show `picture`."""
    cameras = [camera for camera in result.cameras if camera is not None]
    text = f"{len(cameras)} cameras and {len(result.points)} points"
    is_finite = np.isfinite(result.points).all(axis=1)
    points, colors = result.points[is_finite], result.colors[is_finite]
    step = max(1, -(-len(points) // _MAX_POINTS))
    points, colors = points[::step], colors[::step]
    if not len(points) or not cameras:
        return picture
    center = np.median(points, axis=0)
    radius = np.quantile(np.linalg.norm(points - center, axis=1), 0.9) or 1.0
    frusta = [_frustum(camera, _DEPTH * radius) for camera in cameras]
    places = np.concatenate([points, *frusta])
    # Upright like the cameras, and viewed from their side.
    axes = _axes([camera.cam_from_world.rotation for camera in cameras])
    places = (places - center) @ axes.T * (_UNIT / radius)
    content = np.clip(np.rint(places), -32767, 32767).astype("<i2").tobytes() + colors.tobytes()
    data = {
        "points": len(points),
        "cameras": len(cameras),
        "bytes": base64.b64encode(content).decode(),
        "text": text,
    }
    name = f"epipole-{uuid.uuid4().hex}"
    return (
        f'<div id="{name}" style="max-width:600px" title="{html.escape(text)}">{picture}</div>'
        f'<script>{_script()}(document.getElementById("{name}"), {json.dumps(data)});</script>'
    )


def _frustum(camera: PosedCamera, depth: float) -> np.ndarray:
    """Returns the center of a camera and the corners of its image plane, in the world."""
    width, height = camera.camera.width - 1, camera.camera.height - 1
    k = camera.camera.intrinsics
    corners = [[0, 0], [width, 0], [width, height], [0, height]]
    rays = np.column_stack([np.asarray(corners, dtype=float), np.ones(4)])
    rays = rays @ np.linalg.inv(k.matrix()).T * depth
    return camera.cam_from_world.inverse() @ np.vstack([np.zeros(3), rays])


def _axes(rotations: list[np.ndarray]) -> np.ndarray:
    """Returns the mean right, down and forward directions of the cameras, as rows."""
    u, _, vt = np.linalg.svd(np.mean(rotations, axis=0))
    return u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
