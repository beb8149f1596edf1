#!/usr/bin/env python3
"""Times our dense stereo beside OpenCV's and our bundle adjustment beside Ceres', in turns.

    python time_depth.py path/to/depth_time [THREADS] [TURNS] [stereo|ba]

Stereo works on a rendered pair of 640 x 480 pixels with 64 disparities, whose truth is known. Each
row ends with the quality of both: the share of pixels that have an answer, and the share of answers
that are more than two pixels off, in percent. Bundle adjustment takes the published problem Ladybug
49, if EPIPOLE_DATA says where the data are, without the points that start behind a camera: COLMAP
leaves those out. Ceres runs first, through COLMAP; ours runs until it has reached Ceres' cost, to a
millionth. They take turns, once each, for as long as a minute is not over. The word `stereo` or `ba`
leaves out the other part. Ratios are the peer's time over ours: above 1, ours is faster.
"""
import os, pathlib, subprocess, sys, tempfile, time
import cv2
import numpy as np

binary = sys.argv[1]
threads = int(sys.argv[2]) if len(sys.argv) > 2 else 1
turns = int(sys.argv[3]) if len(sys.argv) > 3 else 5
part = sys.argv[4] if len(sys.argv) > 4 else "both"
BA_SECONDS = 60  # Further turns of bundle adjustment begin only within this time.
cv2.setNumThreads(threads)
folder = pathlib.Path(tempfile.mkdtemp())
environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
# On one thread: time on a processor, which other work on the machine disturbs less.
clock = time.process_time if threads == 1 else time.perf_counter


def ours(*arguments):
    text = subprocess.run([binary, *map(str, arguments)], capture_output=True, text=True, check=True, env=environment).stdout
    rows = (line.split() for line in text.splitlines())
    return {name: (float(median), float(least), note) for name, median, least, note in rows}


def read_pfm(path):
    header, size, scale, data = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert header == b"Pf" and float(scale) < 0
    return np.frombuffer(data, "<f4").reshape(height, width)[::-1]


def quality(disparity):
    answered = np.isfinite(disparity)
    wrong = np.abs(disparity - truth)[answered] > 2
    return f"{100 * answered.mean():.1f} % answered, {100 * wrong.mean():.2f} % wrong"


def row(name, mine, other, note):
    (m, l), (pm, pl) = mine, other
    print(f"{name:34}{m:10.2f}{pm:10.2f}{pm / m:7.2f}   least: {l:9.2f}{pl:10.2f}{pl / l:7.2f}   {note}", flush=True)


ours("scene", folder)
left, right = (cv2.imread(str(folder / name), 0) for name in ("left.png", "right.png"))
truth = read_pfm(folder / "truth.pfm")


def sgbm(mode):
    # The penalties that OpenCV's documentation proposes for one channel and a block of 5 pixels.
    return cv2.StereoSGBM_create(0, 64, 5, 8 * 25, 32 * 25, 1, 63, 10, 100, 2, mode)


plain = cv2.StereoBM_create(64, 15)
checked = cv2.StereoBM_create(64, 15)
checked.setDisp12MaxDiff(1)
checked.setSpeckleWindowSize(100)
checked.setSpeckleRange(2)
# Ours, OpenCV's and what is equal about them.
work = {
    "bm_plain": (plain, "StereoBM, no checks"),
    "bm": (checked, "StereoBM, left-right, speckles"),
    "sgm_4": (sgbm(cv2.STEREO_SGBM_MODE_SGBM_3WAY), "SGBM: 4 paths / 3-way"),
    "sgm_5": (sgbm(cv2.STEREO_SGBM_MODE_SGBM), "SGBM: 5 paths / 5"),
    "sgm_8": (sgbm(cv2.STEREO_SGBM_MODE_HH), "SGBM: 8 paths / HH"),
}
mine, theirs = {n: [] for n in work}, {n: [] for n in work}
for _ in range(turns if part != "ba" else 0):
    for name, (median, least, _) in ours("stereo", folder, 10).items():
        mine[name].append((median, least))
    for name, (matcher, _) in work.items():
        times = []
        for _ in range(11):
            start = clock()
            found = matcher.compute(left, right)
            times.append(1e3 * (clock() - start))
        theirs[name].append((np.median(times[1:]), min(times[1:])))
print(f"{'':34}{'ours':>10}{'peer':>10}{'ratio':>7}          {'ours':>9}{'peer':>10}{'ratio':>7}   ({threads} thread{'s' * (threads > 1)}, ms)")
for name, (matcher, label) in work.items() if part != "ba" else ():
    found = matcher.compute(left, right).astype(np.float32) / 16
    found[found < 0] = np.nan
    m, t = np.array(mine[name]), np.array(theirs[name])
    note = f"ours {quality(read_pfm(folder / f'ours_{name}.pfm'))}; OpenCV {quality(found)}"
    row(label, (np.median(m[:, 0]), m[:, 1].min()), (np.median(t[:, 0]), t[:, 1].min()), note)

if part == "stereo":
    sys.exit()
published = pathlib.Path(os.environ.get("EPIPOLE_DATA", "")) / "ba/ladybug-problem-49-7776-pre.txt"
if not os.environ.get("EPIPOLE_DATA") or not published.exists():
    print("bundle adjustment: skipped, EPIPOLE_DATA does not say where the problem is")
    sys.exit()
import pycolmap

FLIP = np.diag([1.0, -1, -1])  # The format's cameras look along -z, v up; COLMAP's along z, v down.


def read_problem(path):
    words = np.array(path.read_text().split(), float)
    cameras, points, count = words[:3].astype(int)
    seen = words[3 : 3 + 4 * count].reshape(-1, 4)
    rest = words[3 + 4 * count :]
    return seen[:, :2].astype(int), seen[:, 2:], rest[: 9 * cameras].reshape(-1, 9), rest[9 * cameras :].reshape(-1, 3)


def in_front(index, cameras, points):
    """The points that every camera that sees them has in front of it, renumbered."""
    turned = np.array([cv2.Rodrigues(c[:3])[0][2] for c in cameras])
    z = (turned[index[:, 0]] * points[index[:, 1]]).sum(1) + cameras[index[:, 0], 5]
    bad = np.zeros(len(points), bool)
    bad[index[z >= 0, 1]] = True
    return ~bad


def write_problem(path, index, pixels, cameras, points):
    with open(path, "w", encoding="ascii") as file:
        print(len(cameras), len(points), len(index), file=file)
        for (camera, point), (u, v) in zip(index, pixels):
            print(camera, point, repr(float(u)), repr(float(v)), file=file)
        for value in np.concatenate([cameras.ravel(), points.ravel()]):
            print(repr(float(value)), file=file)


def ceres(index, pixels, cameras, points):
    """Seconds and the cost reached."""
    scene = pycolmap.Reconstruction()
    place = np.zeros(len(index), int)
    for number, c in enumerate(cameras, 1):
        own = np.flatnonzero(index[:, 0] == number - 1)
        place[own] = np.arange(len(own))
        scene.add_camera_with_trivial_rig(pycolmap.Camera(camera_id=number, model="RADIAL", width=10, height=10, params=[c[6], 0, 0, c[7], c[8]]))
        image = pycolmap.Image(name=str(number), camera_id=number, image_id=number, keypoints=pixels[own] * [1, -1])
        turn = pycolmap.Rotation3d(FLIP @ cv2.Rodrigues(c[:3])[0])
        scene.add_image_with_trivial_frame(image, pycolmap.Rigid3d(turn, FLIP @ c[3:6]))
    tracks = [pycolmap.Track() for _ in points]
    for (camera, point), at in zip(index, place):
        tracks[point].add_element(int(camera) + 1, int(at))
    for point, track in zip(points, tracks):
        scene.add_point3D(point, track)
    config = pycolmap.BundleAdjustmentConfig()
    for number in range(1, len(cameras) + 1):
        config.add_image(number)
    options = pycolmap.BundleAdjustmentOptions()
    options.refine_focal_length = options.refine_extra_params = True
    options.refine_principal_point = options.print_summary = False
    solver = options.ceres.solver_options
    # Ceres' own tolerances: it ends once a step lowers the cost by less than a millionth.
    solver.max_num_iterations, solver.num_threads = 200, threads
    solver.function_tolerance, solver.gradient_tolerance, solver.parameter_tolerance = 1e-6, 1e-10, 1e-8
    adjuster = pycolmap.create_default_bundle_adjuster(options, config, scene)
    start = clock()
    adjuster.solve()
    seconds = clock() - start
    # Counts as in the file format, from our own sum over all observations.
    poses = [scene.images[n].cam_from_world() for n in range(1, len(cameras) + 1)]
    rotation = np.array([FLIP @ pose.rotation.matrix() for pose in poses])
    shift = np.array([FLIP @ pose.translation for pose in poses])
    lens = np.array([scene.cameras[n].params for n in range(1, len(cameras) + 1)])[:, [0, 3, 4]]
    xyz = np.array([scene.points3D[n].xyz for n in sorted(scene.points3D)])
    p = np.einsum("nij,nj->ni", rotation[index[:, 0]], xyz[index[:, 1]]) + shift[index[:, 0]]
    p = -p[:, :2] / p[:, 2:]
    square = (p**2).sum(1)
    f, k1, k2 = lens[index[:, 0]].T
    cost = 0.5 * (((f * (1 + square * (k1 + square * k2)))[:, None] * p - pixels) ** 2).sum()
    return seconds, cost


index, pixels, cameras, points = read_problem(published)
keep = in_front(index, cameras, points)
number = np.cumsum(keep) - 1
use = keep[index[:, 1]]
index, pixels, points = index[use], pixels[use], points[keep]
index[:, 1] = number[index[:, 1]]
write_problem(folder / "problem.txt", index, pixels, cameras, points)
mine, theirs, costs = [], [], []
begin = time.perf_counter()
while len(theirs) < turns and (not theirs or time.perf_counter() - begin < BA_SECONDS):
    seconds, cost = ceres(index, pixels, cameras, points)
    theirs.append(1e3 * seconds)
    costs.append(cost)
    median, _, reached = ours("ba", folder / "problem.txt", repr(float(max(costs)) * (1 + 1e-6)), 1)["ba"]
    mine.append(median)
mine, theirs = np.array(mine), np.array(theirs)
note = f"cost: ours {reached}, Ceres {max(costs):.3f}; {len(cameras)} cameras, {len(points)} points; {len(mine)} turns, ratio of each {np.round(theirs / mine, 2).tolist()}"
row("bundle adjustment to Ceres' cost", (np.median(mine), mine.min()), (np.median(theirs), theirs.min()), note)
