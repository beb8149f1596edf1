import numpy as np
from epipole import Camera, Intrinsics, PosedCamera, imaging
from epipole.camera import look_at

TEXTURE_PIXELS_PER_M = 80
DOWN = np.array([0, 1, 0])


def texture(side_m, seed):
    """Gray noise with details of all sizes, in [0, 1]."""
    size = min(800, int(TEXTURE_PIXELS_PER_M * side_m) + 2)
    noise = np.random.default_rng(seed).random((size, size), np.float32)
    layers = [
        imaging.gaussian_blur(noise, sigma_px) for sigma_px in (1.0, 3, 9, 27)
    ]
    total = sum(layer / layer.std() for layer in layers)
    return np.clip(0.55 + 0.16 * (total - total.mean()) / total.std(), 0, 1)


def surface(corner, along_a, along_b, tint, seed):
    """Rectangle in the world, in meters: a corner and the edges from it."""
    corner, a, b = np.array([corner, along_a, along_b], float)
    side_m = max(np.linalg.norm(a), np.linalg.norm(b))
    return corner, a, b, np.array(tint), texture(side_m, seed)


def box(corner, size, tint, seed):
    """Front, sides and top of a box: x points right, y down and z away."""
    corner, tint = np.array(corner, float), np.array(tint)
    x, y, z = np.diag(size)
    return [
        surface(corner, x, y, tint, seed),
        surface(corner, z, y, 0.75 * tint, seed + 1),
        surface(corner + x, z, y, 0.75 * tint, seed + 2),
        surface(corner, x, z, 0.9 * tint, seed + 3),
    ]


# Floor, ceiling, and two walls that meet in a corner.
ROOM = [
    surface([-7, 1.2, -2], [14, 0, 0], [0, 0, 10], [0.85, 0.75, 0.6], 10),
    surface([-7, -2.5, -2], [14, 0, 0], [0, 0, 10], [0.95, 0.95, 0.9], 11),
    surface([-7, -2.5, 2], [7.5, 0, 5], [0, 3.7, 0], [0.75, 0.85, 0.95], 12),
    surface([0.5, -2.5, 7], [6.5, 0, -5], [0, 3.7, 0], [0.8, 0.95, 0.8], 13),
    *box([-1.8, 0.1, 4.0], [1.1, 1.1, 0.9], [1.0, 0.55, 0.4], 20),
    *box([0.3, -0.5, 4.6], [0.8, 1.7, 0.8], [0.5, 0.7, 1.0], 30),
    *box([0.9, 0.5, 3.1], [0.9, 0.7, 0.7], [1.0, 0.85, 0.4], 40),
]


def photograph(posed, noise=2.0, seed=0):
    """Photo of the room, uint8, and the depth of each pixel, meters."""
    camera, world_from_cam = posed.camera, posed.cam_from_world.inverse()
    v, u = np.indices((camera.height, camera.width))
    rays_in_cam = camera.unproject(np.column_stack([u.ravel(), v.ravel()]))
    rays = rays_in_cam @ world_from_cam.rotation.T
    center = world_from_cam.translation
    nearest = np.full(len(rays), np.inf)
    colors = np.zeros((len(rays), 3))
    for corner, a, b, tint, gray in ROOM:
        normal, sides = np.cross(a, b), np.linalg.norm([a, b], axis=1)
        distance = np.dot(corner - center, normal) / (rays @ normal)
        rows = np.flatnonzero((0 < distance) & (distance < nearest))
        hit = center + distance[rows, None] * rays[rows] - corner
        # Along the edges of the rectangle, from its corner, in meters.
        place = hit @ np.column_stack([a / sides[0], b / sides[1]])
        inside = np.all((place >= 0) & (place <= sides), axis=1)
        rows, pixels = rows[inside], TEXTURE_PIXELS_PER_M * place[inside]
        nearest[rows] = distance[rows]
        value = imaging.sample_bilinear(gray, pixels, "reflect101")
        colors[rows] = 255 * value[:, None] * tint
    colors += np.random.default_rng(seed).normal(0, noise, colors.shape)
    shape = (camera.height, camera.width)
    photo = np.clip(np.round(colors), 0, 255).astype(np.uint8)
    depth = nearest * rays_in_cam[:, 2]
    return photo.reshape(*shape, 3), depth.reshape(shape)
