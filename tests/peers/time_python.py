"""Times the Python package beside OpenCV, PoseLib and scikit-image, with the quality of the results.

    python time_python.py DATA [TURNS]

Everybody uses one thread and gets the same arrays; times are medians of whole calls from Python. F, E and H
come from the problems of two_view_problems.py, whose measures are those of compare_geometry.py: medians over the
problems of a kind. Recall and precision compare with homographies of the data, disparities with measured ones.
"""
import pathlib, statistics, sys, time
import cv2
import epipole
import numpy as np
import poselib
import skimage.feature
import two_view_peers as peers
from two_view_problems import MEASURES, collect

data = pathlib.Path(sys.argv[1])
turns = int(sys.argv[2]) if len(sys.argv) > 2 else 5
cv2.setNumThreads(1)
# Largest distance of a match from the homography, and of a disparity from the measured one.
NEAR_PX, WRONG_PX = 3.0, 2.0
MAX_RATIO, NUM_DISPARITIES = 0.8, 64


def timed(call, turns=turns):
    """Median time in milliseconds, and the result."""
    times = []
    for _ in range(turns):
        start = time.perf_counter()
        result = call()
        times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times), result


def row(task, found):
    """One line: milliseconds and quality of each package."""
    cells = [f"{who} {ms:9.3f} ms  {quality}" for who, (ms, quality) in found.items()]
    first = next(iter(found.values()))[0]
    ratios = [f"{ms / first:.2f}" for ms, _ in list(found.values())[1:]]
    print(f"{task:38}" + "   ".join([*cells, "ratio " + " ".join(ratios)]), flush=True)


def gray(path):
    return cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)


def features():
    folder = data / "homography/graf"
    first, second = (gray(next(folder.glob(f"img{i}.*"))) for i in (1, 3))
    truth = np.loadtxt(folder / "H_1_3.txt")
    sift = cv2.SIFT_create()

    def by_skimage(image):
        detector = skimage.feature.SIFT()
        detector.detect_and_extract(image)
        return detector.keypoints[:, ::-1], detector.descriptors

    ours = [timed(lambda i=i: epipole.detect_sift(i)) for i in (first, second)]
    theirs = [timed(lambda i=i: sift.detectAndCompute(i, None)) for i in (first, second)]
    others = [timed(lambda i=i: by_skimage(i), 1) for i in (first, second)]
    height, width = first.shape
    row(f"SIFT, {width}×{height}", {
        "epipole": (ours[0][0], f"{len(ours[0][1])} features"),
        "cv2": (theirs[0][0], f"{len(theirs[0][1][0])} features"),
        "skimage": (others[0][0], f"{len(others[0][1][0])} features"),
    })

    def quality(pixels1, pixels2, pairs):
        x = np.c_[pixels1[pairs[:, 0]], np.ones(len(pairs))] @ truth.T
        near = np.linalg.norm(x[:, :2] / x[:, 2:] - pixels2[pairs[:, 1]], axis=1) < NEAR_PX
        return f"{near.sum()} of {len(pairs)} right"

    (points1, descriptors1), (points2, descriptors2) = (
        (cv2.KeyPoint_convert(points), descriptors) for _, (points, descriptors) in theirs
    )
    descriptors1, descriptors2 = (np.asarray(d, np.float32) for d in (descriptors1, descriptors2))

    def by_opencv():
        found = cv2.BFMatcher(cv2.NORM_L2).knnMatch(descriptors1, descriptors2, k=2)
        return np.array([(m.queryIdx, m.trainIdx) for m, n in found if m.distance < MAX_RATIO * n.distance])

    def by_epipole():
        found = epipole.match_descriptors(descriptors1, descriptors2, max_ratio=MAX_RATIO, mutual=False, unique=False)
        return found.indices

    found = {
        "epipole": timed(by_epipole),
        "cv2": timed(by_opencv),
        "skimage": timed(lambda: skimage.feature.match_descriptors(
            descriptors1, descriptors2, cross_check=False, max_ratio=MAX_RATIO), 1),
    }
    row("ratio test, the same descriptors", {
        who: (ms, quality(points1, points2, np.asarray(pairs))) for who, (ms, pairs) in found.items()
    })


def ours(p, a, b, seed):
    options = {"max_error_px": p.threshold_px, "confidence": peers.CONFIDENCE, "max_iterations": p.trials, "seed": seed}
    try:
        if p.kind == "F":
            report = epipole.estimate_fundamental(a, b, **options)
        elif p.kind == "H":
            report = epipole.estimate_homography(a, b, **options)
        else:
            camera = epipole.Camera.pinhole(epipole.Intrinsics.from_matrix(p.k), 640, 480)
            report = epipole.estimate_relative_pose(a, b, camera, camera, **options)
    except epipole.Error:
        return None, None
    model = report.model
    if p.kind == "E":
        pose = model.cam2_from_cam1()
        model = np.c_[pose.rotation, pose.translation]
    return model, report.inliers


def two_views():
    problems = collect(str(data))
    fits = {"epipole": ours, "cv2 MAGSAC": peers.opencv, "poselib": peers.pose_lib}
    for kind in "FEH":
        own = [p for p in problems if p.kind == kind]
        groups = sorted({p.group for p in own})
        for group in groups:
            found = {}
            for who, fit in fits.items():
                times, measures = [], []
                for p in (p for p in own if p.group == group):
                    order = np.random.default_rng(0).permutation(len(p.rows))
                    a, b = p.rows[order, :2], p.rows[order, 2:]
                    ms, (model, inliers) = timed(lambda: fit(p, a, b, 0), 1)
                    times.append(ms)
                    bad = model is None or inliers is None
                    inliers = np.zeros(len(order), bool) if bad else np.ravel(inliers).astype(bool)
                    measures.append(p.judge(None if bad else np.asarray(model), inliers, order)[0])
                unit = MEASURES.get(group, ["-°"])[0][1:]
                found[who] = (statistics.median(times), f"{statistics.median(measures):.3g} {unit}")
            row(f"{kind}, {group}, {sum(p.group == group for p in own)} pairs", found)


def points():
    random = np.random.default_rng(1)
    k = np.array([[800.0, 0, 320], [0, 800, 240], [0, 0, 1]])
    world = random.uniform([-2, -1.5, 4], [2, 1.5, 9], (100_000, 3))
    motion = epipole.RigidTransform(np.eye(3), [-1.0, 0, 0.1])
    camera = epipole.Camera.pinhole(epipole.Intrinsics.from_matrix(k), 640, 480)
    matrices = [k @ np.c_[np.eye(3), t] for t in (np.zeros(3), motion.translation)]
    pixels = []
    for p in matrices:
        x = np.c_[world, np.ones(len(world))] @ p.T
        pixels.append(x[:, :2] / x[:, 2:] + random.normal(0, 0.5, (len(world), 2)))

    def error(points):
        return f"{np.median(np.linalg.norm(points - world, axis=1)):.4f} off"

    def by_opencv():
        x = cv2.triangulatePoints(*matrices, pixels[0].T, pixels[1].T)
        return (x[:3] / x[3]).T

    ours = timed(lambda: epipole.triangulate_dlt(*matrices, *pixels))
    theirs = timed(by_opencv)
    row("triangulate_dlt, 100 000 points", {"epipole": (ours[0], error(ours[1])), "cv2": (theirs[0], error(theirs[1]))})

    seen = world[:500]
    observed = pixels[1][:500].copy()
    observed[:200] = random.uniform(0, 480, (200, 2))

    def turned(translation):
        return f"{np.linalg.norm(np.ravel(translation) - motion.translation):.4f} off"

    found = {
        "epipole": timed(lambda: epipole.estimate_absolute_pose(
            seen, observed, camera, max_error_px=2.0, confidence=peers.CONFIDENCE)),
        "cv2 MAGSAC": timed(lambda: cv2.solvePnPRansac(
            seen, observed, k, None, reprojectionError=2.0, confidence=peers.CONFIDENCE, flags=cv2.USAC_MAGSAC)),
        "poselib": timed(lambda: poselib.estimate_absolute_pose(
            observed, seen, {"model": "PINHOLE", "width": 640, "height": 480, "params": peers.intrinsics(k)},
            {"max_reproj_error": 2.0, "success_prob": peers.CONFIDENCE}, {})),
    }
    translations = {
        "epipole": found["epipole"][1].model.translation,
        "cv2 MAGSAC": found["cv2 MAGSAC"][1][2],
        "poselib": found["poselib"][1][0].t,
    }
    row("absolute pose, 500 points, 40 % wrong", {who: (ms, turned(translations[who])) for who, (ms, _) in found.items()})


def stereo():
    folder = data / "stereo/teddy"
    left, right = gray(folder / "left.png"), gray(folder / "right.png")
    # Quarter pixels; 0 is unknown.
    truth = gray(folder / "disp.png") / 4.0

    def quality(disparity):
        known = truth > 0
        answered = known & np.isfinite(disparity) & (disparity >= 0)
        wrong = np.abs(disparity - truth)[answered] > WRONG_PX
        return f"{100 * answered.sum() / known.sum():.1f} % answered, {100 * wrong.mean():.2f} % wrong"

    sgbm = cv2.StereoSGBM_create(0, NUM_DISPARITIES, 5, 8 * 25, 32 * 25, 1, 63, 10, 100, 2, cv2.STEREO_SGBM_MODE_SGBM)
    matcher = epipole.StereoSgm(num_disparities=NUM_DISPARITIES)
    ours = timed(lambda: matcher.compute(left, right))
    theirs = timed(lambda: sgbm.compute(left, right) / 16.0)
    row("semi-global matching, teddy", {"epipole": (ours[0], quality(np.asarray(ours[1]))), "cv2": (theirs[0], quality(theirs[1]))})


def small_calls():
    camera = epipole.Camera.pinhole(epipole.Intrinsics(800, 800, 320, 240), 640, 480)
    f = np.diag([0, 1.0, -1.0])[[0, 2, 1]]
    calls = {
        "sampson_px, one pair": lambda: epipole.sampson_px(f, (10, 20), (30, 40)),
        "project, one point": lambda: camera.project((0.1, 0.2, 2.0)),
    }
    for name, call in calls.items():
        count = 2000
        ms, _ = timed(lambda call=call: [call() for _ in range(count)])
        print(f"{name:38}epipole {1e3 * ms / count:9.3f} µs")


with epipole.threads(1):
    if data.is_dir():
        for bench in (features, two_views, stereo):
            bench()
    else:
        print(f"features, two views, stereo: skipped, {data} is not there")
    points()
    small_calls()
