#!/usr/bin/env python3
"""Times robust estimation, triangulation and the minimal solvers beside OpenCV, PoseLib and SupeRANSAC.

    python time_geometry.py path/to/geometry_time [TURNS]

Everybody gets the same 20 problems of each kind: 1000 matches, 40 % of them wrong, half a pixel of
noise, a threshold of one pixel, a confidence of 0.999, at most 10 000 samples, one thread. Each
turn runs all of them one after the other; the least time over all turns is printed, with the
error that is left against the truth. Times of the solvers include the way from Python into the
peer's library, which for the quickest ones is most of it.
"""
import os, pathlib, subprocess, sys, tempfile, time
import cv2
import numpy as np
import poselib
import superansac

binary = sys.argv[1]
turns = int(sys.argv[2]) if len(sys.argv) > 2 else 3
cv2.setNumThreads(1)
NUM_PROBLEMS, NUM_MATCHES, FOCAL_PX, CENTER = 20, 1000, 800.0, (319.5, 239.5)
K = np.array([[FOCAL_PX, 0, CENTER[0]], [0, FOCAL_PX, CENTER[1]], [0, 0, 1]])
R = cv2.Rodrigues(np.array([0.03, 0.12, -0.05]))[0]
T = np.array([-0.6, 0.1, 0.1])


def project(x, rotation, translation):
    y = (x @ rotation.T + translation) @ K.T
    return y[:, :2] / y[:, 2:]


def problem(seed, count, share_wrong, plane, noise_px):
    """Rows u1 v1 u2 v2 X Y Z, and the pixels without noise."""
    rng = np.random.default_rng(seed)
    rows, exact = [], []
    while len(rows) < count:
        depth = 5.0 if plane else rng.uniform(3.0, 7.0)
        x = np.array([[rng.uniform(-1.5, 1.5), rng.uniform(-1.1, 1.1), depth]])
        a, b = project(x, np.eye(3), np.zeros(3))[0], project(x, R, T)[0]
        wrong = rng.random() < share_wrong
        seen = np.array([rng.uniform(0, 640), rng.uniform(0, 480)]) if wrong else b
        rows.append(np.concatenate([a + rng.normal(0, noise_px, 2), seen + rng.normal(0, noise_px, 2), x[0]]))
        if not wrong:
            exact.append(np.concatenate([a, b]))
    return np.array(rows), np.array(exact)


general = [problem(100 + i, NUM_MATCHES, 0.4, False, 0.5) for i in range(NUM_PROBLEMS)]
planar = [problem(200 + i, NUM_MATCHES, 0.4, True, 0.5) for i in range(NUM_PROBLEMS)]
clean = [problem(300, 100_000, 0.0, False, 0.5)]
minimal = [problem(400, 1000, 0.0, False, 0.0)]


def distance_px(f, exact):
    """Mean distance of the exact pixels from their epipolar lines."""
    f = np.asarray(f)[:3]
    one = np.ones((len(exact), 1))
    a, b = np.hstack([exact[:, :2], one]), np.hstack([exact[:, 2:], one])
    l2, l1 = a @ f.T, b @ f
    error = np.abs(np.sum(b * l2, 1))
    return np.mean(error / np.hypot(l2[:, 0], l2[:, 1]) + error / np.hypot(l1[:, 0], l1[:, 1])) / 2


def transfer_px(h, exact):
    y = np.hstack([exact[:, :2], np.ones((len(exact), 1))]) @ np.asarray(h).T
    return np.mean(np.linalg.norm(y[:, :2] / y[:, 2:] - exact[:, 2:], axis=1))


def turn_deg(rotation):
    return np.degrees(np.arccos(np.clip((np.trace(rotation @ R.T) - 1) / 2, -1, 1)))


def pose_deg(pose, _):
    """The larger of the errors of rotation and of direction."""
    cosine = pose[:, 3] @ T / np.linalg.norm(T) / np.linalg.norm(pose[:, 3])
    return max(turn_deg(pose[:, :3]), np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def place_mm(pose, _):
    return 1e3 * np.linalg.norm(-pose[:, :3].T @ pose[:, 3] + R.T @ T)


ransac = {"max_epipolar_error": 1.0, "max_reproj_error": 1.0, "success_prob": 0.999, "max_iterations": 10_000}
camera = {"model": "PINHOLE", "width": 640, "height": 480, "params": [FOCAL_PX, FOCAL_PX, *CENTER]}


def cv_pose(rows, method):
    a, b = rows[:, :2], rows[:, 2:4]
    e, inliers = cv2.findEssentialMat(a, b, K, method, 0.999, 1.0, maxIters=10_000)
    _, rotation, translation, _ = cv2.recoverPose(e[:3], a, b, K, mask=inliers)
    return np.hstack([rotation, translation])


def cv_place(rows, method):
    found = cv2.solvePnPRansac(rows[:, 4:], rows[:, 2:4], K, None, reprojectionError=1.0, confidence=0.999,
                               iterationsCount=10_000, flags=method)
    return np.hstack([cv2.Rodrigues(found[1])[0], found[2]])


def lib_pose(rows):
    pair, _ = poselib.estimate_relative_pose(rows[:, :2], rows[:, 2:4], camera, camera, ransac, {})
    return np.asarray((pair.pose if hasattr(pair, "pose") else pair).Rt)


def lib_place(rows):
    found = poselib.estimate_absolute_pose(rows[:, 2:4], rows[:, 4:], camera, ransac, {})[0]
    return np.asarray((found.pose if hasattr(found, "pose") else found).Rt)


def super_settings():
    return superansac.settings(1.0, 0.999, 10_000)


def fundamental(method):
    return lambda r: cv2.findFundamentalMat(r[:, :2], r[:, 2:4], method, 1.0, 0.999, 10_000)[0]


def homography(method):
    return lambda r: cv2.findHomography(r[:, :2], r[:, 2:4], method, 1.0, maxIters=10_000, confidence=0.999)[0]


P1, P2 = K @ np.hstack([np.eye(3), np.zeros((3, 1))]), K @ np.hstack([R, T[:, None]])


def triangulate(rows):
    x = cv2.triangulatePoints(P1, P2, rows[:, :2].T, rows[:, 2:4].T)
    return (x[:3] / x[3]).T


def triangulation_mm(points, _):
    return 1e3 * np.median(np.linalg.norm(points - clean[0][0][:, 4:], axis=1))


def rays(pixels):
    y = np.hstack([(pixels - CENTER) / FOCAL_PX, np.ones((len(pixels), 1))])
    return y / np.linalg.norm(y, axis=1)[:, None]


SAMPLES = [slice(7 * i, 7 * i + 8) for i in range(100)]
rays1, rays2 = rays(minimal[0][0][:, :2]), rays(minimal[0][0][:, 2:4])


def each(solve):
    """A solver on 100 samples."""
    return lambda rows: [solve(rows, s) for s in SAMPLES] and None


def cut(s, n):
    return slice(s.start, s.start + n)


WORK = {
    "F RANSAC": (general, distance_px, "px", {
        "USAC_MAGSAC": fundamental(cv2.USAC_MAGSAC), "FM_RANSAC": fundamental(cv2.FM_RANSAC),
        "PoseLib": lambda r: poselib.estimate_fundamental(r[:, :2], r[:, 2:4], ransac, {})[0],
        "SupeRANSAC": lambda r: superansac.fundamental(r[:, :2], r[:, 2:4], super_settings())[0]}),
    "E RANSAC": (general, pose_deg, "°", {
        "USAC_MAGSAC": lambda r: cv_pose(r, cv2.USAC_MAGSAC), "RANSAC": lambda r: cv_pose(r, cv2.RANSAC),
        "PoseLib": lib_pose,
        "SupeRANSAC": lambda r: superansac.relative_pose(r[:, :2], r[:, 2:4], K, super_settings())[0]}),
    "H RANSAC": (planar, transfer_px, "px", {
        "USAC_MAGSAC": homography(cv2.USAC_MAGSAC), "RANSAC": homography(cv2.RANSAC),
        "PoseLib": lambda r: poselib.estimate_homography(r[:, :2], r[:, 2:4], ransac, {})[0],
        "SupeRANSAC": lambda r: superansac.homography(r[:, :2], r[:, 2:4], super_settings())[0]}),
    "P3P RANSAC": (general, place_mm, "mm", {
        "USAC_MAGSAC": lambda r: cv_place(r, cv2.USAC_MAGSAC), "PoseLib": lib_place,
        "SupeRANSAC": lambda r: superansac.absolute_pose(r[:, 2:4], r[:, 4:], FOCAL_PX, CENTER, super_settings())}),
    "triangulation": (clean, triangulation_mm, "mm", {"triangulatePoints": triangulate}),
    "F7 × 100": (minimal, None, "", {"OpenCV": each(
        lambda r, s: cv2.findFundamentalMat(r[cut(s, 7), :2], r[cut(s, 7), 2:4], cv2.FM_7POINT))}),
    "F8 × 100": (minimal, None, "", {"OpenCV": each(
        lambda r, s: cv2.findFundamentalMat(r[s, :2], r[s, 2:4], cv2.FM_8POINT)),
        "PoseLib (E)": each(lambda r, s: poselib.essential_matrix_8pt(rays1[s], rays2[s]))}),
    "E5 × 100": (minimal, None, "", {"PoseLib": each(
        lambda r, s: poselib.essential_matrix_5pt(rays1[cut(s, 5)], rays2[cut(s, 5)]))}),
    "P3P × 100": (minimal, None, "", {"PoseLib": each(
        lambda r, s: poselib.p3p(rays2[cut(s, 3)], r[cut(s, 3), 4:]))}),
    "H4 × 100": (minimal, None, "", {"OpenCV": each(
        lambda r, s: cv2.getPerspectiveTransform(r[cut(s, 4), :2].astype(np.float32), r[cut(s, 4), 2:4].astype(np.float32)))}),
}
times, errors = {}, {}
clock = time.thread_time
with tempfile.TemporaryDirectory() as folder:
    for name, problems in (("general", general), ("planar", planar), ("clean", clean), ("minimal", minimal)):
        for index, (rows, _) in enumerate(problems):
            rows.astype("<f8").tofile(pathlib.Path(folder) / f"{name}-{index}.f64")
    for turn in range(turns):
        text = subprocess.run([binary, folder], capture_output=True, text=True, check=True,
                              env={**os.environ, "RAYON_NUM_THREADS": "1"}).stdout
        for line in text.splitlines():
            name, index, _, least_ms, *numbers = line.split("\t")
            problems, judge, *_ = WORK[name]
            times.setdefault((name, "ours"), {}).setdefault(int(index), []).append(float(least_ms))
            if turn == 0 and judge:
                columns = 4 if judge in (pose_deg, place_mm) else 3
                answer = np.array([float(x) for x in numbers[0].split()]).reshape(-1, columns)
                errors.setdefault((name, "ours"), []).append(judge(answer, problems[int(index)][1]))
        for name, (problems, judge, _, peers) in WORK.items():
            for peer, run in peers.items():
                for index, (rows, exact) in enumerate(problems):
                    spent = []
                    for _ in range(3):
                        start = clock()
                        answer = run(rows)
                        spent.append(1e3 * (clock() - start))
                    times.setdefault((name, peer), {}).setdefault(index, []).append(min(spent))
                    if turn == 0 and judge:
                        errors.setdefault((name, peer), []).append(judge(answer, exact))
print(f"{'work':14} {'who':18} {'time':>10} {'ours faster':>12}   error left (mean, worst of {NUM_PROBLEMS})")
for name, (_, judge, unit, peers) in WORK.items():
    mean = lambda who: np.mean([min(t) for t in times[name, who].values()])
    for who in ("ours", *peers):
        ratio = "" if who == "ours" else f"{mean(who) / mean('ours'):.2f} ×"
        left = f"{np.mean(errors[name, who]):.3g} {unit}, {np.max(errors[name, who]):.3g} {unit}" if judge else ""
        print(f"{name:14} {who:18} {mean(who):7.3f} ms {ratio:>12}   {left}")
