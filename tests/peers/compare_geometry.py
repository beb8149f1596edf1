#!/usr/bin/env python3
"""Our robust estimators beside OpenCV's USAC_MAGSAC, PoseLib and SupeRANSAC on real pairs with ground truth.

    python compare_geometry.py DATA path/to/geometry_fit [ORDERS]

Everybody gets the same matches, threshold, confidence (0.999) and budget of samples, in ORDERS
(5) seeded orders of the matches; who takes a seed gets the number of the order. The rest are the
defaults of each library: PoseLib draws at least 1000 samples, OpenCV takes no seed. SupeRANSAC has
the settings of its own examples: PROSAC, of which random orders leave little, MAGSAC scores, nested
RANSAC, at least 1000 samples; it takes no seed either.

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
  drawn planes    the same with exact truth, over noise, share of wrong matches and overlap; 3 px
They are given as the mean over problems of the median over orders, then as the mean over both,
then as the worst of all. An error of more than 100 px, or no model, counts as 100 px.

The last table has the first measure of each, ours beside that of the better peer. "Other draws" is
the share of 1000 sets of as many pairs, drawn from these with repetition, in which ours is not
behind: near 50 % the pairs cannot tell who is better, and fewer than five never can.

Milliseconds are processor time of one thread, mean over problems of the median over orders; those
of E include the choice among the four poses.
"""
import os, subprocess, sys, tempfile, time
import cv2
import numpy as np
import superansac
from two_view_peers import CONFIDENCE, intrinsics, opencv, pose_lib
from two_view_problems import MEASURES, WORST_PX, collect

cv2.setNumThreads(1)
binary = sys.argv[2]
orders = int(sys.argv[3]) if len(sys.argv) > 3 else 5
WHO = ("ours", "MAGSAC", "PoseLib", "SupeR.")
# Groups of one kind of data, told together as well.
TOGETHER = {"fountain": "multiview", "dino": "multiview", "euroc": "calib", "boards": "calib"}


def auc(errors, limit):
    """Area under the share of errors below x, for x up to a limit, in percent of the most it can be."""
    errors = np.sort(errors)
    share = np.arange(len(errors) + 1) / len(errors)
    below = np.searchsorted(errors, limit)
    area = np.trapezoid(np.r_[share[:below + 1], share[below]], np.r_[0, errors[:below], limit])
    return 100 * area / limit


def super_ransac(p, a, b, _):
    settings = superansac.settings(p.threshold_px, CONFIDENCE, p.trials)
    if p.kind == "F":
        return superansac.fundamental(a, b, settings)
    if p.kind == "H":
        return superansac.homography(a, b, settings)
    return superansac.relative_pose(a, b, p.k, settings)


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


problems = collect(sys.argv[1])
tasks = [(p, np.random.default_rng(seed).permutation(len(p.rows)), seed) for p in problems for seed in range(orders)]
results = {}  # (kind, group, who): problems × orders × measures
for who, answers in zip(WHO, (our_answers(tasks), *(answers_of(fit, tasks) for fit in (opencv, pose_lib, super_ransac)))):
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
