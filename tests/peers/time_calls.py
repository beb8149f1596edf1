"""Times calls from Python beside the same functions of the library, on the same data.

    python time_calls.py NATIVE [SECONDS [NAMES]]

NATIVE is the example native_times of epipole-python, which makes the data below in Rust; SECONDS is the time for
each function and turn. Both take the shortest call of all turns, with one thread. The table marks calls that are
slower than the function by more than 5 % and more than 20 µs.
"""
import os, subprocess, sys, time

# Before the library starts its threads.
os.environ["RAYON_NUM_THREADS"] = "1"
import epipole
import numpy as np
from epipole import absolute_pose, calibration, epipolar, feature, homography, imaging, robust, sfm, stereo
from epipole import synthetic, triangulation, two_view

native, seconds = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.2
only = sys.argv[3:]
MAX_SHARE, MAX_S = 0.05, 20e-6
MIN_CALLS, TURNS = 3, 3
MANY, SOME = 100_000, 1000
WIDTH, HEIGHT, SHIFT = 1000, 750, 9


def shortest(call):
    """Seconds of the shortest of some calls, which other processes disturb least."""
    times, begin = [], time.perf_counter()
    while len(times) < MIN_CALLS or time.perf_counter() - begin < seconds:
        start = time.perf_counter()
        result = call()
        times.append(time.perf_counter() - start)
        del result
    return min(times)


def problem(num_points, outlier_fraction):
    return synthetic.TwoViewProblem(
        num_points=num_points, noise_px=0.5, outlier_fraction=outlier_fraction, seed=1
    )


def points():
    many = problem(MANY, 0)
    one, two, points = many.pixels1, many.pixels2, many.points
    cam1, cam2 = many.camera1, many.camera2
    camera, f = cam1.camera, epipolar.fundamental_from_cameras(cam1, cam2)
    motion = epipole.camera.relative_motion(cam1.cam_from_world, cam2.cam_from_world)
    h, in_cam = homography.fit_homography(one, two), cam1.cam_from_world @ points
    p1, p2 = cam1.projection_matrix(), cam2.projection_matrix()
    rays1, rays2 = camera.unproject(one), camera.unproject(two)
    return {
        "sampson_px": lambda: epipolar.sampson_px(f, one, two),
        "symmetric_epipolar_px": lambda: epipolar.symmetric_epipolar_px(f, one, two),
        "epipolar_line2": lambda: epipolar.epipolar_line2(f, one),
        "transfer": lambda: homography.transfer(h, one),
        "transfer_error_px": lambda: homography.transfer_error_px(h, one, two),
        "Camera.project": lambda: camera.project(in_cam),
        "Camera.unproject": lambda: camera.unproject(one),
        "RigidTransform @ points": lambda: motion @ points,
        "reprojection_error_px": lambda: absolute_pose.reprojection_error_px(cam1, points, one),
        "triangulate_dlt": lambda: triangulation.triangulate_dlt(p1, p2, one, two),
        "triangulate_optimal": lambda: triangulation.triangulate_optimal(cam1, cam2, one, two),
        "correct_matches": lambda: triangulation.correct_matches(f, one, two),
        "triangulate_angular": lambda: triangulation.triangulate_angular(motion, rays1, rays2),
        "fundamental_8point": lambda: epipolar.fundamental_8point(one, two),
        "fit_homography": lambda: homography.fit_homography(one, two),
    }


def handful():
    some = problem(SOME, 0)
    camera, f = some.camera1.camera, epipolar.fundamental_from_cameras(some.camera1, some.camera2)
    one, two, points = some.pixels1, some.pixels2, some.points
    pixel1, pixel2, seven1, seven2 = one[0], two[0], one[:7], two[:7]
    rays1, rays2 = camera.unproject(one[:5]), camera.unproject(two[:5])
    return {
        "sampson_px, one pair": lambda: epipolar.sampson_px(f, pixel1, pixel2),
        "Camera.unproject, one pixel": lambda: camera.unproject(pixel1),
        "fundamental_7point": lambda: epipolar.fundamental_7point(seven1, seven2),
        "essential_5point": lambda: epipolar.essential_5point(rays1, rays2),
        "pose_p3p": lambda: absolute_pose.pose_p3p(rays1[:3], points[:3]),
    }


def estimators():
    some = problem(SOME, 0.3)
    one, two, points = some.pixels1, some.pixels2, some.points
    camera, camera2 = some.camera1.camera, some.camera2.camera
    f = epipolar.fundamental_from_cameras(some.camera1, some.camera2)
    return {
        "estimate_fundamental": lambda: epipolar.estimate_fundamental(one, two),
        "estimate_essential": lambda: epipolar.estimate_essential(one, two, camera, camera2),
        "estimate_relative_pose": lambda: epipolar.estimate_relative_pose(one, two, camera, camera2),
        "estimate_homography": lambda: homography.estimate_homography(one, one),
        "estimate_similarity": lambda: robust.estimate_similarity(one, one),
        "estimate_absolute_pose": lambda: absolute_pose.estimate_absolute_pose(points, two, camera),
        "fit_absolute_pose": lambda: absolute_pose.fit_absolute_pose(points, one, camera),
        "estimate_two_view": lambda: two_view.estimate_two_view(one, two),
        "estimate_two_view_calibrated": lambda: two_view.estimate_two_view_calibrated(one, two, camera, camera2),
        "refine_fundamental": lambda: epipolar.refine_fundamental(f, one, two),
    }


def gray(u, v):
    """Squares of eight pixels, of gray values that look random."""
    return ((u // 8 * 73_856_093 ^ v // 8 * 19_349_663) % 251).astype(np.uint8)


def images():
    v, u = np.mgrid[:HEIGHT, :WIDTH].astype(np.uint64)
    left, right = gray(u, v), gray(u + np.uint64(SHIFT), v)
    color = np.dstack([left, gray(v, u), gray(u + np.uint64(8), v)])
    floats, other = imaging.gray_to_f32(left), imaging.gray_to_f32(right)
    matrix = np.array([[1.01, 0.02, -5], [-0.02, 0.99, 4], [1e-5, 0, 1]])
    pixel_map = stereo.PixelMap.from_homography(WIDTH, HEIGHT, matrix)
    corners = feature.good_features_to_track(floats).points
    sift = [feature.detect_sift(image).descriptors for image in (floats, other)]
    orb = [feature.detect_orb(image).descriptors for image in (floats, other)]
    block, semi_global = stereo.StereoBm(num_disparities=32), stereo.StereoSgm(num_disparities=32)
    disparity = block.compute(left, right)
    q = np.array([[1, 0, 0, -500], [0, 1, 0, -375], [0, 0, 0, 700], [0, 0, 5.0, 0]])
    return {
        "gaussian_blur": lambda: imaging.gaussian_blur(floats, 2.0),
        "gaussian_blur, uint8": lambda: imaging.gaussian_blur(left, 2.0),
        "sobel": lambda: imaging.sobel(floats),
        "resize": lambda: imaging.resize(floats, WIDTH // 2, HEIGHT // 2),
        "gaussian_pyramid": lambda: imaging.gaussian_pyramid(floats, 5),
        "rgb_to_gray": lambda: imaging.rgb_to_gray(color),
        "photo_to_gray": lambda: feature.photo_to_gray(color),
        "gray_to_u8": lambda: imaging.gray_to_u8(floats),
        "warp_perspective": lambda: imaging.warp_perspective(color, matrix),
        "PixelMap.warp": lambda: pixel_map.warp(color),
        "harris_response": lambda: feature.harris_response(floats, 0.04),
        "good_features_to_track": lambda: feature.good_features_to_track(floats),
        "track_lucas_kanade": lambda: feature.track_lucas_kanade(floats, other, corners),
        "detect_sift": lambda: feature.detect_sift(left),
        "detect_orb": lambda: feature.detect_orb(left),
        "match_descriptors, SIFT": lambda: feature.match_descriptors(*sift),
        "match_descriptors, ORB": lambda: feature.match_descriptors(*orb),
        "StereoBm.compute": lambda: block.compute(left, right),
        "StereoSgm.compute": lambda: semi_global.compute(left, right),
        "depth_image": lambda: stereo.depth_image(disparity, 700.0, 0.2),
        "point_cloud": lambda: stereo.point_cloud(disparity, q),
    }


def scenes():
    world = synthetic.MultiViewProblem(num_cameras=10, num_points=500, noise_px=0.5, seed=2)
    seen, count = world.observations, len(world.points)
    bundle = sfm.Bundle(world.cameras, np.round(world.points * 10) / 10, seen.indices, seen.pixels)
    indices, pixels = seen.indices, seen.pixels
    keypoints = [pixels[indices[:, 0] == camera] for camera in range(len(world.cameras))]
    frames = [sfm.SfmImage(str(camera), own) for camera, own in enumerate(keypoints)]
    # Every camera sees every point: keypoint k is point k.
    same = np.c_[np.arange(count), np.arange(count)]
    pairs = [sfm.PairMatches(i, j, same) for i in range(len(frames)) for j in range(i + 1, len(frames))]
    counts = [count] * len(frames)
    given = sfm.SfmInput(frames, [world.cameras[0].camera], pairs)

    t = np.arange(100_000) * 1e-3
    places = np.c_[t, t * t * 1e-2, -t]
    moved = 2 * places

    board = calibration.Board("chessboard", 9, 6, 0.03)
    marks = np.c_[board.marks(), np.zeros(board.num_marks)]
    camera = epipole.Camera.pinhole(epipole.Intrinsics(600, 600, 319.5, 239.5), 640, 480)
    turns = 0.1 * np.arange(12) - 0.5
    views = []
    for turn in turns:
        x, y, z = np.array([1, -0.5, 0.1]) * np.sin(turn * np.sqrt(1.26) / 2) / np.sqrt(1.26)
        motion = epipole.RigidTransform.from_quaternion([np.sqrt(1 - x*x - y*y - z*z), x, y, z], [-0.12, -0.08, 0.5])
        views.append(calibration.BoardView(epipole.PosedCamera(camera, motion).project(marks)))
    return {
        "adjust_bundle": lambda: sfm.adjust_bundle(bundle),
        "build_tracks": lambda: sfm.build_tracks(counts, pairs),
        "reconstruct": lambda: sfm.reconstruct(given),
        "monocular_odometry": lambda: sfm.monocular_odometry(given),
        "align_points": lambda: sfm.align_points(places, moved, "similarity"),
        "absolute_trajectory_error": lambda: sfm.absolute_trajectory_error(places, moved, "similarity"),
        "calibrate": lambda: calibration.calibrate(board, views, (640, 480)),
    }


class Native:
    """The example, which answers a name with seconds."""

    def __init__(self):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        self.process = subprocess.Popen([native, str(seconds)], text=True, **pipes)

    def time(self, name):
        print(name, file=self.process.stdin, flush=True)
        return float(self.process.stdout.readline())


calls = points() | handful() | estimators() | images() | scenes()
library = Native()
print(f"{'':32}{'native µs':>12}{'Python µs':>12}{'more µs':>10}{'more %':>9}")
for name, call in calls.items():
    if only and not any(part in name for part in only):
        continue
    ours = theirs = np.inf
    for _ in range(TURNS):
        theirs = min(theirs, library.time(name))
        ours = min(ours, shortest(call))
    more = ours - theirs
    is_slow = more > max(MAX_S, MAX_SHARE * theirs)
    print(
        f"{name:32}{1e6 * theirs:12.1f}{1e6 * ours:12.1f}{1e6 * more:10.1f}{100 * more / theirs:9.1f}"
        f"{'  slow' if is_slow else ''}",
        flush=True,
    )
