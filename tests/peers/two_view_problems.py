"""Two-view problems with ground truth, from the photographs, corners and matches of DATA; what they
are stands in compare_geometry.py."""
import collections, glob, itertools, json, os, re
import cv2
import numpy as np
from planes import homogeneous, inside, move, shared_grid

POSE_PX, WORST_DEG, WORST_PX, MIN_MATCHES = 1.0, 180.0, 100.0, 15
# Measures of the problems without a pose, the main one first; "+": more is better.
MEASURES = {
    "adelaide": ["+recall %", "-label 0 %"], "kusvod2": ["-epipolar px"],
    "homogr": ["-rms px"], "evd": ["+recall %"], "homography": ["-grid px"], "drawn planes": ["-grid px"],
}
# `judge(model, inliers, order)` returns the measures of an answer to the rows in that order.
# `model` is None if nothing was found.
Problem = collections.namedtuple("Problem", "group kind threshold_px trials k rows judge")
problems = []


def collect(root):
    add_multiview(root, "fountain", "fountain_p11")
    add_multiview(root, "dino", "dinoSparseRing")
    for add_some in (add_essential, add_euroc, add_boards, add_house, add_drive, add_labeled, add_planes):
        add_some(root)
    add_drawn_planes()
    return problems


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


def there(root, *parts):
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


def add_multiview(root, group, folder):
    if not there(root, "multiview", folder, "cameras.json"):
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


def add_essential(root):
    if not there(root, "correspondences", "essential"):
        return
    for path in sorted(glob.glob(os.path.join(root, "correspondences", "essential", "*.json"))):
        with open(path) as file:
            told = json.load(file)
        rows = np.loadtxt(path.replace(".json", ".txt"))[:, :4]
        add_pair("fountain 1-5", rows, *(np.array(told[key]) for key in ("K1", "K2", "R", "t")))


def add_euroc(root):
    if not there(root, "calib", "euroc_v101", "rig.json"):
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


def add_boards(root):
    """Corners of two boards at a time as a stereo rig saw them; the truth is its calibration from all."""
    if not there(root, "calib", "opencv_chessboard", "board.json"):
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


def add_drive(root):
    if not there(root, "vo", "kitti_turn", "poses.txt"):
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


def add_house(root):
    if not there(root, "vgg_house", "house.nview-corners"):
        return
    folder = os.path.join(root, "vgg_house")
    files = lambda end: sorted(glob.glob(os.path.join(folder, "house.*." + end)))
    corners = [np.loadtxt(path) for path in files("corners")]
    points = np.loadtxt(os.path.join(folder, "house.p3d"))
    cameras = []
    for path in files("P"):
        k, r, center = cv2.decomposeProjectionMatrix(np.loadtxt(path))[:3]
        center = center[:3, 0] / center[3, 0]
        # The given world is mirrored: positive focal lengths put the house behind the cameras.
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


def labeled(root, name):
    """Matches and labels of each file of a folder."""
    if there(root, "correspondences", name):
        for path in sorted(glob.glob(os.path.join(root, "correspondences", name, "*.txt"))):
            if "_H_" not in path:
                numbers = np.loadtxt(path)
                yield numbers[:, :4], numbers[:, 4]


def accepted(f, rows):
    return 0.0 if f is None else 100 * np.mean(sampson_px(f, rows) < 1.5)


def add_labeled(root):
    for rows, label in labeled(root, "adelaide"):
        add("adelaide", "F", 1.5, 10_000, rows,
            lambda f, good=rows[label >= 1], bad=rows[label == 0]: [accepted(f, good), accepted(f, bad)])
    for rows, label in labeled(root, "kusvod2"):
        if np.sum(label == 0) < 8:
            print("kusvod2: a pair with annotated matches only is left out")
            continue
        add("kusvod2", "F", 1.0, 10_000, rows[label == 0],
            lambda f, true=rows[label == 1]: [WORST_PX if f is None else np.median(epipolar_px(f, true))])
    for rows, label in labeled(root, "homogr"):
        add("homogr", "H", 3.0, 10_000, rows[label == 0],
            lambda h, true=rows[label == 1]: [np.sqrt(np.mean(transfer_px(h, true) ** 2))])
    for rows, label in labeled(root, "evd"):
        add("evd", "H", 4.0, 20_000, rows,
            lambda h, true=rows[label == 1]: [100 * np.mean(transfer_px(h, true) < 4)])


def add_planes(root):
    if not there(root, "homography"):
        return
    for path in sorted(glob.glob(os.path.join(root, "homography", "*", "H_1_*.txt"))):
        number = re.search(r"H_1_(\d+)", path).group(1)
        photos = [os.path.join(os.path.dirname(path), f"img{i}.png") for i in (1, number)]
        grid = shared_grid(np.loadtxt(path), *(cv2.imread(photo, cv2.IMREAD_GRAYSCALE).shape[::-1] for photo in photos))
        seen = np.hstack([grid, move(np.loadtxt(path), grid)])
        add("homography", "H", 3.0, 10_000, match(*photos), lambda h, seen=seen: [np.mean(transfer_px(h, seen))])


def add_drawn_planes():
    """Planes with exact truth: 200 matches, over noise, share of wrong ones and how much both images share."""
    size, k = np.array([640, 480]), np.array([[600, 0, 319.5], [0, 600, 239.5], [0, 0, 1]])
    for noise_px, wrong, overlap in itertools.product((0.3, 1.0, 2.0), (0.2, 0.5, 0.8), (0.3, 0.8)):
        for number in range(3):
            rng = np.random.default_rng([int(10 * noise_px), int(10 * wrong), int(10 * overlap), number])
            while True:
                h = plane_between(rng, k)
                grid = shared_grid(h, size, size)
                in_front = homogeneous(np.array([[0, 0], [639, 0], [0, 479], [639, 479]])) @ h[2] > 0
                if in_front.all() and abs(len(grid) / 1600 - overlap) < 0.1:
                    break
            # Inliers are visible in both images; one in five has three times the noise.
            num_right = round(200 * (1 - wrong))
            a = np.empty((0, 2))
            while len(a) < num_right:
                more = rng.uniform(0, size - 1, (500, 2))
                a = np.vstack([a, more[inside(move(h, more), size)]])
            a = a[:num_right]
            scale = noise_px * np.where(rng.random(num_right) < 0.2, 3, 1)[:, None]
            right = np.hstack([a, move(h, a)]) + scale * rng.normal(0, 1, (num_right, 4))
            rows = np.vstack([right, rng.uniform(0, np.tile(size - 1, 2), (200 - num_right, 4))])
            seen = np.hstack([grid, move(h, grid)])
            add("drawn planes", "H", 3.0, 10_000, rows, lambda h, seen=seen: [np.mean(transfer_px(h, seen))])


def plane_between(rng, k):
    """What a plane 1 away, leaning by up to 60°, does between two cameras that see it."""
    r = cv2.Rodrigues(rng.normal(0, 0.25, 3) * [1, 1, 2])[0]
    normal = np.append(np.tan(np.radians(60)) * rng.uniform(-0.7, 0.7, 2), 1)
    shift = rng.normal(0, 0.4, 3)
    return k @ (r + np.outer(shift, normal / np.linalg.norm(normal))) @ np.linalg.inv(k)
