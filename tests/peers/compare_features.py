#!/usr/bin/env python3
"""Our features beside OpenCV's on photographs of planes with known homographies.

    python compare_features.py DATA path/to/features_dump [sift|rootsift|orb] [N ...]

DATA holds folders with img1.png, img2.png, ... and H_1_2.txt, .... For each pair and each N both
detectors give at most N features (0: as many as OpenCV finds by itself). Columns:
repeatability at 3 px in the shared part, mean matching accuracy of mutual nearest neighbors at
1, 3 and 5 px, matches with ratio 0.8 and their precision at 3 px, and how far a homography from
those matches is off, in the mean over the overlap and over the corners of image 1: as OpenCV's
USAC_MAGSAC (3 px) fits it, and PoseLib (1.5 px), to twenty random selections of four fifths of the
matches. They differ because the wall of graf is not quite flat: the first settles for a plane
between its parts. ±: the standard deviation of the error in the overlap, had other matches been
found (delete-d jackknife, Shao & Wu 1989), for a pair and N; that of a mean over N is hardly smaller.
"""
import glob, os, re, subprocess, sys
import cv2
import numpy as np
import poselib
from planes import inside, move, shared_grid

cv2.setNumThreads(1)
root, binary = sys.argv[1], sys.argv[2]
kind = sys.argv[3] if len(sys.argv) > 3 else "sift"
counts = [int(n) for n in sys.argv[4:]] or [0, 2000, 1000, 500]


def ours(path, n):
    text = subprocess.run([binary, path, kind, str(n)], capture_output=True, text=True, check=True).stdout
    a = np.array([np.array(line.split(), float) for line in text.splitlines()])
    return a[:, :5], a[:, 5:].astype(np.uint8 if kind == "orb" else np.float32)


def opencv(path, n):
    gray = cv2.imread(path, 0)
    if kind == "orb":
        detector = cv2.ORB_create(nfeatures=n or 1000)
    else:
        detector = cv2.SIFT_create(nfeatures=n)
    keypoints, d = detector.detectAndCompute(gray, None)
    order = np.argsort([-k.response for k in keypoints], kind="stable")[: n or None]
    if kind == "rootsift":
        d = np.sqrt(d / np.maximum(d.sum(1, keepdims=True), 1e-9)) * 512
    return np.array([[*keypoints[i].pt, keypoints[i].size / 2, 0, keypoints[i].response] for i in order]), d[order]


def evaluate(H, size1, size2, one, two):
    (k1, d1), (k2, d2) = one, two
    p1, p2 = k1[:, :2], k2[:, :2]
    a, b = move(H, p1), p2
    a = np.unique(a[inside(a, size2)].round(3), axis=0)
    b = np.unique(b[inside(move(np.linalg.inv(H), b), size1)].round(3), axis=0)
    distance = np.linalg.norm(a[:, None] - b[None], axis=2)
    repeatability = ((distance.min(1) <= 3).sum() + (distance.min(0) <= 3).sum()) / (len(a) + len(b))
    matcher = cv2.BFMatcher(cv2.NORM_HAMMING if kind == "orb" else cv2.NORM_L2)
    near = matcher.knnMatch(d1, d2, k=2)
    back = [m[0].trainIdx for m in matcher.knnMatch(d2, d1, k=1)]
    mutual = [m[0] for m in near if back[m[0].trainIdx] == m[0].queryIdx]
    error = lambda ms: np.linalg.norm(move(H, p1[[m.queryIdx for m in ms]]) - p2[[m.trainIdx for m in ms]], axis=1)
    e = error(mutual)
    good = [m for m, n in near if m.distance < 0.8 * n.distance]
    g = error(good)
    grid = shared_grid(H, size1, size2)
    corners = np.array([[0, 0], [size1[0] - 1, 0], [0, size1[1] - 1], [size1[0] - 1, size1[1] - 1]], float)
    x1, x2 = (p[index].astype(float) for p, index in ((p1, [m.queryIdx for m in good]), (p2, [m.trainIdx for m in good])))
    fits = {magsac: [], with_poselib: []}
    kept = len(good) * 4 // 5
    for seed in range(20):
        order = np.random.default_rng(seed).permutation(len(good))[:kept]
        for fit, off in fits.items():
            He = fit(x1[order].copy(), x2[order].copy(), seed)
            off.append([np.linalg.norm(move(He, p) - move(H, p), axis=1).mean() for p in (grid, corners)] if He is not None else [np.inf] * 2)
    jackknife = np.sqrt(kept / max(len(good) - kept, 1))
    off = [x for found in fits.values() for x in (*np.mean(found, axis=0), jackknife * np.std(found, axis=0)[0])]
    return [repeatability, *[(e < t).mean() for t in (1, 3, 5)], len(good), (g < 3).mean(), (g < 3).sum(), *off]


def magsac(x1, x2, seed):
    return cv2.findHomography(x1, x2, cv2.USAC_MAGSAC, 3, maxIters=10000, confidence=0.999)[0]


def with_poselib(x1, x2, seed):
    options = {"max_reproj_error": 1.5, "success_prob": 0.999, "max_iterations": 10000, "seed": seed}
    return poselib.estimate_homography(x1, x2, options, {})[0]


NAMES = ["repeat@3", "MMA@1", "MMA@3", "MMA@5", "ratio", "prec@3", "right", "magsac", "corners", "±", "poselib", "corners", "±"]
print(f"{'pair':10} {'N':>5} {'who':7}", *[f"{n:>8}" for n in NAMES])
rows, by_pair = [], {}
for n in counts:
    for folder in sorted(glob.glob(root + "/*/")):
        for hf in sorted(glob.glob(folder + "H_1_*.txt")):
            i = re.search(r"H_1_(\d)", hf).group(1)
            H = np.loadtxt(hf)
            f1, f2 = folder + "img1.png", folder + f"img{i}.png"
            s1, s2 = [cv2.imread(f, 0).shape[::-1] for f in (f1, f2)]
            theirs = [opencv(f, n) for f in (f1, f2)]
            mine = [ours(f, len(t[0])) for f, t in zip((f1, f2), theirs)]
            item = os.path.basename(folder[:-1]) + "_1_" + i
            r = [evaluate(H, s1, s2, *x) for x in (mine, theirs)]
            rows.append(r)
            by_pair.setdefault(item, []).append(r)
            for who, x, k in (("ours", r[0], mine), ("opencv", r[1], theirs)):
                print(f"{item:10} {len(k[0][0]):5} {who:7}", *[f"{v:8.3f}" if isinstance(v, float) or v != int(v) else f"{v:8d}" for v in x])
for item, found in [*by_pair.items(), ("mean", rows)]:
    for k, who in enumerate(("ours", "opencv")):
        print(f"{item:10} {'all':>5} {who:7}", *[f"{v:8.3f}" for v in np.array(found, float)[:, k].mean(0)])
