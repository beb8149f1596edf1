#!/usr/bin/env python3
"""Our robust estimators beside OpenCV's USAC_MAGSAC and PoseLib on real pairs with ground truth.

    python compare_geometry.py DATA path/to/geometry_fit [ORDERS]

Everybody gets the same matches, threshold, confidence (0.999) and budget of samples, in ORDERS
(5) seeded orders of the matches; who takes a seed gets the number of the order. The rest are the
defaults of each library: PoseLib draws at least 1000 samples, OpenCV takes no seed.

Pairs, for E and again for F, 1 px, at most 10 000 samples:
  fountain, dino  photographs of multiview/, neighbors and every second, turned at most 60°
  fountain 1-5    the given matches of correspondences/essential, of 3072 × 2048 pixels
  euroc           the stereo pairs of calib/euroc_v101, without their distortion
  boards          calib/opencv_chessboard: corners of two boards at a time, without distortion, and
                  wrong matches, uniform over both images, until they are 30 %
  kitti_turn      photographs of vo/kitti_turn, 1, 2 and 3 frames apart: a car drives round a corner
  vgg_house       corners of vgg_house, 1, 2 and 3 views apart, made harder: Gaussian noise of
                  0.5 px, and wrong matches as above
Matches of photographs are OpenCV's SIFT with ratio 0.8. The pixels of both views are brought to
those of one camera without skew. Columns: AUC up to 5, 10 and 20 degrees of the larger error of
rotation and of direction, in percent, over all pairs and orders; ±: how far AUC@10 spreads over
the orders (standard deviation); the median error in degrees; precision and recall of the matches
called inliers, in percent, where the true ones are those nearer than the threshold to their true
epipolar lines (mean over both images). A pose is had from F with the known camera. No model counts
as 180°.

Other problems, with measures in percent or pixels:
  adelaide        recall of labels ≥ 1, and the share accepted of label 0: Sampson error < 1.5 px
  kusvod2         median distance of annotated matches from their epipolar lines; 1 px
  homogr          root mean square error of annotated matches; 3 px
  evd             recall of label 1 at 4 px; at most 20 000 samples
  homography      mean error over a grid on image 1, where image 2 shows it; SIFT as above; 3 px
They are given as the mean over problems of the median over orders, then as the mean over both,
then as the worst of all. An error of more than 100 px, or no model, counts as 100 px.

The last table has the first measure of each, ours beside that of the better peer. "Other draws" is
the share of 1000 sets of as many pairs, drawn from these with repetition, in which ours is not
behind: near 50 % the pairs cannot tell who is better, and fewer than five never can.

Milliseconds are processor time of one thread, mean over problems of the median over orders; those
of E include the choice among the four poses.
"""
import collections, glob, itertools, json, os, re, subprocess, sys, tempfile, time
import cv2
import numpy as np
import poselib

cv2.setNumThreads(1)
root, binary = sys.argv[1], sys.argv[2]
orders = int(sys.argv[3]) if len(sys.argv) > 3 else 5
CONFIDENCE, POSE_PX, WORST_DEG, WORST_PX, MIN_MATCHES = 0.999, 1.0, 180.0, 100.0, 15
WHO = ("ours", "MAGSAC", "PoseLib")
# Measures of the problems without a pose, the main one first; "+": more is better.
MEASURES = {
    "adelaide": ["+recall %", "-label 0 %"], "kusvod2": ["-epipolar px"],
    "homogr": ["-rms px"], "evd": ["+recall %"], "homography": ["-grid px"],
}
# Groups of one kind of data, told together as well.
TOGETHER = {"fountain": "multiview", "dino": "multiview", "euroc": "calib", "boards": "calib"}
# `judge(model, inliers, order)` gives the measures of an answer to the rows in that order; the model
# is None if there is none.
Problem = collections.namedtuple("Problem", "group kind threshold_px trials k rows judge")
problems = []


def homogeneous(p):
    return np.c_[p, np.ones(len(p))]


def move(h, p):
    q = homogeneous(p) @ h.T
    return q[:, :2] / q[:, 2:]


def cross(t):
    return np.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])


def constraint(f, rows):
    """Of each match: |x2ᵀ F x1|, and the squared lengths of the normals of both lines."""
    a, b = homogeneous(rows[:, :2]), homogeneous(rows[:, 2:])
    l2, l1 = a @ f.T, b @ f
    return np.abs(np.sum(b * l2, 1)), np.sum(l1[:, :2] ** 2, 1), np.sum(l2[:, :2] ** 2, 1)


def epipolar_px(f, rows):
    """Distances from the epipolar lines, mean over both images."""
    error, n1, n2 = constraint(f, rows)
    return (error / np.sqrt(n1) + error / np.sqrt(n2)) / 2


def sampson_px(f, rows):
    error, n1, n2 = constraint(f, rows)
    return error / np.sqrt(n1 + n2)


def transfer_px(h, rows):
    if h is None:
        return np.full(len(rows), WORST_PX)
    with np.errstate(all="ignore"):
        error = np.linalg.norm(move(h, rows[:, :2]) - rows[:, 2:], axis=1)
    return np.nan_to_num(error, nan=np.inf)


def angle_deg(cosine):
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def turn_deg(rotation):
    return angle_deg((np.trace(rotation) - 1) / 2)


def auc(errors, limit):
    """Area under the share of errors below x, for x up to a limit, in percent of the most it can be."""
    errors = np.sort(errors)
    share = np.arange(len(errors) + 1) / len(errors)
    below = np.searchsorted(errors, limit)
    area = np.trapezoid(np.r_[share[:below + 1], share[below]], np.r_[0, errors[:below], limit])
    return 100 * area / limit


def there(*parts):
    path = os.path.join(root, *parts)
    if not os.path.exists(path):
        print(f"left out: {path} is not there")
    return os.path.exists(path)


features = {}


def sift(path):
    if path not in features:
        gray = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
        keypoints, descriptors = cv2.SIFT_create().detectAndCompute(gray, None)
        features[path] = np.array([k.pt for k in keypoints]), descriptors
    return features[path]


def match(path1, path2):
    (p1, d1), (p2, d2) = sift(path1), sift(path2)
    near = [m for m in cv2.BFMatcher().knnMatch(d1, d2, k=2) if len(m) == 2]
    good = [m for m, second in near if m.distance < 0.8 * second.distance]
    return np.array([[*p1[m.queryIdx], *p2[m.trainIdx]] for m in good]).reshape(-1, 4)


def pose_judge(kind, k, rows, r, t):
    from_pixels = np.linalg.inv(k)
    right = epipolar_px(from_pixels.T @ cross(t) @ r @ from_pixels, rows) < POSE_PX

    def judge(model, inliers, order):
        hits = 100 * np.sum(inliers & right[order])
        counts = [hits / max(np.sum(inliers), 1), hits / max(np.sum(right), 1)]
        if model is None:
            return [WORST_DEG, *counts]
        if kind == "F":
            # The nearest essential matrix has the same singular vectors, and these give the pose.
            a, b = rows[order, :2], rows[order, 2:]
            model = np.hstack(cv2.recoverPose(k.T @ model @ k, a, b, k, mask=inliers.astype(np.uint8))[1:3])
        cosine = model[:, 3] @ t / np.linalg.norm(t) / np.linalg.norm(model[:, 3])
        return [max(turn_deg(model[:, :3] @ r.T), angle_deg(cosine)), *counts]

    return judge


def add_pair(group, rows, k1, k2, r, t):
    """E and F of matches in pixels of cameras `k1` and `k2`; `r`, `t` lead from camera 1 to 2."""
    if len(rows) < MIN_MATCHES:
        print(f"{group}: a pair with no more than {len(rows)} matches is left out")
        return
    # Not every library takes two cameras, or skew.
    k = np.array([[k1[0, 0], 0, k1[0, 2]], [0, k1[1, 1], k1[1, 2]], [0, 0, k1[2, 2]]]) / k1[2, 2]
    rows = np.c_[move(k @ np.linalg.inv(k1), rows[:, :2]), move(k @ np.linalg.inv(k2), rows[:, 2:])]
    for kind in "EF":
        problems.append(Problem(group, kind, POSE_PX, 10_000, k, rows, pose_judge(kind, k, rows, r, t)))


def add(group, kind, threshold_px, trials, rows, judge):
    problems.append(Problem(group, kind, threshold_px, trials, np.eye(3), rows, lambda model, *_: judge(model)))


def add_multiview(group, folder):
    if not there("multiview", folder, "cameras.json"):
        return
    folder = os.path.join(root, "multiview", folder)
    with open(os.path.join(folder, "cameras.json")) as file:
        views = json.load(file)["views"]
    for view in views:
        view.update({key: np.array(view[key]) for key in "KRt"})
    for step in 1, 2:
        for one, two in zip(views, views[step:]):
            r = two["R"] @ one["R"].T
            if turn_deg(r) <= 60:
                rows = match(*(os.path.join(folder, view["file"]) for view in (one, two)))
                add_pair(group, rows, one["K"], two["K"], r, two["t"] - r @ one["t"])


def add_essential():
    if not there("correspondences", "essential"):
        return
    for path in sorted(glob.glob(os.path.join(root, "correspondences", "essential", "*.json"))):
        with open(path) as file:
            told = json.load(file)
        rows = np.loadtxt(path.replace(".json", ".txt"))[:, :4]
        add_pair("fountain 1-5", rows, *(np.array(told[key]) for key in ("K1", "K2", "R", "t")))


def add_euroc():
    if not there("calib", "euroc_v101", "rig.json"):
        return
    folder = os.path.join(root, "calib", "euroc_v101")
    with open(os.path.join(folder, "rig.json")) as file:
        rig = json.load(file)
    sides = [rig["left"], rig["right"]]
    k = [np.array([[s["fx"], 0, s["cx"]], [0, s["fy"], s["cy"]], [0, 0, 1]]) for s in sides]
    bent = [np.array(s["dist_k1k2p1p2"]) for s in sides]
    for left in sorted(glob.glob(os.path.join(folder, "left_*.png"))):
        seen = np.hsplit(match(left, left.replace("left_", "right_")), 2)
        straight = [undistorted(seen[i], k[i], bent[i], k[0]) for i in (0, 1)]
        add_pair("euroc", np.hstack(straight), k[0], k[0], np.array(rig["R"]), np.array(rig["t"]))


def undistorted(pixels, k, bent, new_k):
    # The few rounds that OpenCV makes by itself leave an error near the corners of the image.
    until = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-12)
    return cv2.undistortPoints(np.ascontiguousarray(pixels), k, bent, P=new_k, criteria=until).reshape(-1, 2)


def add_boards():
    """Corners of two boards at a time as a stereo rig saw them; the truth is its calibration from all."""
    if not there("calib", "opencv_chessboard", "board.json"):
        return
    folder = os.path.join(root, "calib", "opencv_chessboard")
    with open(os.path.join(folder, "board.json")) as file:
        board = json.load(file)
    size, (across, down) = tuple(board["image_size"]), board["inner_corners"]
    until = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-6)
    seen = {"left": [], "right": []}
    for side, corners in seen.items():
        for path in sorted(glob.glob(os.path.join(folder, side + "*.jpg"))):
            gray = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
            found = cv2.findChessboardCorners(gray, (across, down))[1]
            corners.append(cv2.cornerSubPix(gray, found, (5, 5), (-1, -1), until).reshape(-1, 2))
    flat = np.stack([*np.meshgrid(np.arange(across), np.arange(down)), np.zeros((down, across))], -1)
    world = [(board["square_m"] * flat.reshape(-1, 3)).astype(np.float32)] * len(seen["left"])
    lenses = [cv2.calibrateCamera(world, corners, size, None, None)[1:3] for corners in seen.values()]
    (k1, bent1), (k2, bent2) = lenses
    r, t = cv2.stereoCalibrate(world, *seen.values(), k1, bent1, k2, bent2, size, flags=cv2.CALIB_FIX_INTRINSIC)[5:7]
    straight = [np.hstack([undistorted(a, k1, bent1, k1), undistorted(b, k2, bent2, k2)]) for a, b in zip(*seen.values())]
    for pair, (one, two) in enumerate(itertools.combinations(straight, 2)):
        add_pair("boards", with_wrong(np.vstack([one, two]), np.random.default_rng(pair)), k1, k2, r, t[:, 0])


def with_wrong(rows, rng):
    """Three matches of ten are wrong."""
    wrong = rng.uniform(rows.min(0), rows.max(0), (round(len(rows) * 0.3 / 0.7), 4))
    return np.vstack([rows, wrong])


def add_drive():
    if not there("vo", "kitti_turn", "poses.txt"):
        return
    folder = os.path.join(root, "vo", "kitti_turn")
    photos = sorted(glob.glob(os.path.join(folder, "*.png")))
    with open(os.path.join(folder, "calib.txt")) as file:
        k = np.array(file.readline().split()[-12:], float).reshape(3, 4)[:, :3]
    places = np.loadtxt(os.path.join(folder, "poses.txt")).reshape(-1, 3, 4)
    for step in 1, 2, 3:
        for i in range(len(photos) - step):
            (r1, c1), (r2, c2) = ((p[:, :3], p[:, 3]) for p in (places[i], places[i + step]))
            add_pair("kitti_turn", match(photos[i], photos[i + step]), k, k, r2.T @ r1, r2.T @ (c1 - c2))


def add_house():
    if not there("vgg_house", "house.nview-corners"):
        return
    folder = os.path.join(root, "vgg_house")
    files = lambda end: sorted(glob.glob(os.path.join(folder, "house.*." + end)))
    corners = [np.loadtxt(path) for path in files("corners")]
    points = np.loadtxt(os.path.join(folder, "house.p3d"))
    cameras = []
    for path in files("P"):
        k, r, center = cv2.decomposeProjectionMatrix(np.loadtxt(path))[:3]
        center = center[:3, 0] / center[3, 0]
        # The given world is mirrored: with focal lengths above zero the house is behind the cameras.
        front = np.sign(np.median((points - center) @ r[2]))
        mirror = np.diag([*front * np.sign(np.diag(k)[:2] / k[2, 2]), front])
        cameras.append((k @ mirror / (k @ mirror)[2, 2], mirror @ r, -mirror @ r @ center))
    with open(os.path.join(folder, "house.nview-corners")) as file:
        tracks = np.array([[-1 if x == "*" else int(x) for x in line.split()] for line in file if line.strip()])
    for step in 1, 2, 3:
        for i in range(len(cameras) - step):
            j = i + step
            both = tracks[(tracks[:, i] >= 0) & (tracks[:, j] >= 0)]
            rows = np.c_[corners[i][both[:, i]], corners[j][both[:, j]]]
            rng = np.random.default_rng([step, i])
            rows = with_wrong(rows + rng.normal(0, 0.5, rows.shape), rng)
            (k1, r1, t1), (k2, r2, t2) = cameras[i], cameras[j]
            add_pair("vgg_house", rows, k1, k2, r2 @ r1.T, t2 - r2 @ r1.T @ t1)


def labeled(name):
    """Matches and labels of each file of a folder."""
    if there("correspondences", name):
        for path in sorted(glob.glob(os.path.join(root, "correspondences", name, "*.txt"))):
            if "_H_" not in path:
                numbers = np.loadtxt(path)
                yield numbers[:, :4], numbers[:, 4]


def accepted(f, rows):
    return 0.0 if f is None else 100 * np.mean(sampson_px(f, rows) < 1.5)


def add_labeled():
    for rows, label in labeled("adelaide"):
        add("adelaide", "F", 1.5, 10_000, rows,
            lambda f, good=rows[label >= 1], bad=rows[label == 0]: [accepted(f, good), accepted(f, bad)])
    for rows, label in labeled("kusvod2"):
        if np.sum(label == 0) < 8:
            print("kusvod2: a pair with annotated matches only is left out")
            continue
        add("kusvod2", "F", 1.0, 10_000, rows[label == 0],
            lambda f, true=rows[label == 1]: [WORST_PX if f is None else np.median(epipolar_px(f, true))])
    for rows, label in labeled("homogr"):
        add("homogr", "H", 3.0, 10_000, rows[label == 0],
            lambda h, true=rows[label == 1]: [np.sqrt(np.mean(transfer_px(h, true) ** 2))])
    for rows, label in labeled("evd"):
        add("evd", "H", 4.0, 20_000, rows,
            lambda h, true=rows[label == 1]: [100 * np.mean(transfer_px(h, true) < 4)])


def add_planes():
    if not there("homography"):
        return
    for path in sorted(glob.glob(os.path.join(root, "homography", "*", "H_1_*.txt"))):
        number = re.search(r"H_1_(\d+)", path).group(1)
        photos = [os.path.join(os.path.dirname(path), f"img{i}.png") for i in (1, number)]
        (h1, w1), (h2, w2) = [cv2.imread(photo, cv2.IMREAD_GRAYSCALE).shape for photo in photos]
        grid = np.stack(np.meshgrid(np.linspace(0, w1 - 1, 40), np.linspace(0, h1 - 1, 40)), -1).reshape(-1, 2)
        moved = move(np.loadtxt(path), grid)
        seen = np.hstack([grid, moved])[((moved >= 0) & (moved <= [w2 - 1, h2 - 1])).all(1)]
        add("homography", "H", 3.0, 10_000, match(*photos), lambda h, seen=seen: [np.mean(transfer_px(h, seen))])


def opencv(p, a, b, _):
    if p.kind == "F":
        f, inliers = cv2.findFundamentalMat(a, b, cv2.USAC_MAGSAC, p.threshold_px, CONFIDENCE, p.trials)
        return None if f is None else f[:3], inliers
    if p.kind == "H":
        return cv2.findHomography(a, b, cv2.USAC_MAGSAC, p.threshold_px, maxIters=p.trials, confidence=CONFIDENCE)
    e, inliers = cv2.findEssentialMat(a, b, p.k, cv2.USAC_MAGSAC, CONFIDENCE, p.threshold_px, maxIters=p.trials)
    if e is None:
        return None, None
    return np.hstack(cv2.recoverPose(e[:3], a, b, p.k, mask=inliers.copy())[1:3]), inliers


def lib(p, a, b, seed):
    ransac = {"max_epipolar_error": p.threshold_px, "max_reproj_error": p.threshold_px, "success_prob": CONFIDENCE,
              "max_iterations": p.trials, "seed": seed}
    if p.kind == "F":
        model, told = poselib.estimate_fundamental(a, b, ransac, {})
    elif p.kind == "H":
        model, told = poselib.estimate_homography(a, b, ransac, {})
    else:
        camera = {"model": "PINHOLE", "width": -1, "height": -1, "params": intrinsics(p.k)}
        pose, told = poselib.estimate_relative_pose(a, b, camera, camera, ransac, {})
        model = pose.Rt
    return model, told["inliers"]


def intrinsics(k):
    return [k[0, 0], k[1, 1], k[0, 2], k[1, 2]]


def answers_of(fit, tasks):
    for p, order, seed in tasks:
        a, b = p.rows[order, :2], p.rows[order, 2:]
        start = time.thread_time()
        model, inliers = fit(p, a, b, seed)
        yield model, inliers, 1e3 * (time.thread_time() - start)


def our_answers(tasks):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "problems.f64")
        with open(path, "wb") as file:
            for p, order, seed in tasks:
                head = ["FEH".index(p.kind), p.threshold_px, p.trials, CONFIDENCE, seed, *intrinsics(p.k), len(order)]
                np.r_[head, p.rows[order].ravel()].astype("<f8").tofile(file)
        # One thread, so that the program tells processor time.
        alone = {**os.environ, "RAYON_NUM_THREADS": "1"}
        text = subprocess.run([binary, path], capture_output=True, text=True, check=True, env=alone).stdout
    for line in text.splitlines():
        ms, model, inliers = line.split("\t")
        model = np.array(model.split(), float).reshape(3, -1) if model else None
        yield model, np.array(list(inliers), int), float(ms)


def judged(p, order, model, inliers, ms):
    """The measures of an answer, then its milliseconds."""
    if model is None or inliers is None or not np.isfinite(model).all() or not np.any(model):
        return [*p.judge(None, np.zeros(len(order), bool), order), ms]
    return [*p.judge(np.asarray(model), np.ravel(inliers).astype(bool), order), ms]


add_multiview("fountain", "fountain_p11")
add_multiview("dino", "dinoSparseRing")
add_essential()
add_euroc()
add_boards()
add_house()
add_drive()
add_labeled()
add_planes()

tasks = [(p, np.random.default_rng(seed).permutation(len(p.rows)), seed) for p in problems for seed in range(orders)]
results = {}  # (kind, group, who): problems × orders × measures
for who, answers in zip(WHO, (our_answers(tasks), answers_of(opencv, tasks), answers_of(lib, tasks))):
    for (p, order, seed), answer in zip(tasks, answers, strict=True):
        if seed == 0:
            results.setdefault((p.kind, p.group, who), []).append([])
        results[p.kind, p.group, who][-1].append(judged(p, order, *answer))
results = {key: np.array(value) for key, value in results.items()}
for (kind, group, who), found in list(results.items()):
    if group in TOGETHER:
        both = TOGETHER[group]
        results[kind, both, who] = np.concatenate([results[kind, both, who], found]) if (kind, both, who) in results else found
ranks = []


def main_measure(kind, group, who, pairs):
    """The first measure of a group, over some of its pairs; more is better."""
    error = results[kind, group, who][pairs, :, 0]
    if group not in MEASURES:
        return auc(error.ravel(), 10)
    value = np.minimum(error, WORST_PX).mean()
    return value if MEASURES[group][0][0] == "+" else -value


def rank(kind, group, measure):
    """Ours beside the better of the others, on these pairs and on others like them."""
    count = len(results[kind, group, "ours"])
    value = {who: main_measure(kind, group, who, slice(None)) for who in WHO}
    peer = max(WHO[1:], key=value.get)
    draws = np.random.default_rng(0).integers(0, count, (1000, count))
    ahead = [main_measure(kind, group, "ours", pairs) >= main_measure(kind, group, peer, pairs) for pairs in draws]
    share = f"{100 * np.mean(ahead):3.0f} %" if count >= 5 else "    -"
    ranks.append(f"{kind} {group:12} {measure:17} {count:5} {abs(value['ours']):9.3f} {peer:>9} {abs(value[peer]):9.3f}"
                 f"   {'ahead' if value['ours'] >= value[peer] else 'behind':6} {share}")


for kind in "EFH":
    groups = [group for k, group, who in results if k == kind and who == "ours"]
    posed = [group for group in groups if group not in MEASURES]
    if groups:
        print()
    if posed:
        print(f"{kind:12} {'pairs':>5} {'who':7} {'AUC@5':>7} {'AUC@10':>7} {'±':>5} {'AUC@20':>7} {'median°':>8}"
              f" {'precis.':>7} {'recall':>7} {'ms':>7}")
    for group in posed:
        for who in WHO:
            r = results[kind, group, who]
            auc5, auc10, auc20 = (auc(r[:, :, 0].ravel(), limit) for limit in (5, 10, 20))
            spread = np.std([auc(r[:, i, 0], 10) for i in range(orders)])
            print(f"{group:12} {len(r):5} {who:7} {auc5:7.2f} {auc10:7.2f} {spread:5.2f} {auc20:7.2f}"
                  f" {np.median(r[:, :, 0]):8.3f} {r[:, :, 1].mean():7.2f} {r[:, :, 2].mean():7.2f}"
                  f" {np.median(r[:, :, -1], 1).mean():7.2f}")
        rank(kind, group, "AUC@10")
    if len(posed) < len(groups):
        print(f"{kind:12} {'pairs':>5} {'who':7} {'measure':12} {'median':>8} {'mean':>8} {'worst':>8} {'ms':>25}")
    for group in (group for group in groups if group in MEASURES):
        for column, measure in enumerate(MEASURES[group]):
            for who in WHO:
                r = results[kind, group, who]
                value = np.minimum(r[:, :, column], WORST_PX)
                print(f"{group:12} {len(r):5} {who:7} {measure[1:]:12} {np.median(value, 1).mean():8.3f}"
                      f" {value.mean():8.3f} {value.min() if measure[0] == '+' else value.max():8.3f}"
                      f" {np.median(r[:, :, -1], 1).mean():25.2f}")
        rank(kind, group, "mean " + MEASURES[group][0][1:])
print(f"\n{'':14} {'first measure':17} {'pairs':>5} {'ours':>9} {'best peer':>19}          other draws")
print("\n".join(ranks))
