#!/usr/bin/env python3
"""Times our image and feature rooms and OpenCV's, in turns, on the same numbers: one table.

    python time_features.py path/to/features_time [THREADS] [TURNS]

The frame is 1280 x 720 floats; matching is on 2048 x 2048 random descriptors of 128 whole numbers;
features are those of EPIPOLE_DATA/homography/graf/img1.png, ours limited to as many as OpenCV finds.
Each turn runs both, so that whatever else the machine does hits both; times are the least of all
turns (of long work on one thread: time on the processor), ratios are OpenCV's time over ours (above
1: ours is faster), of the least and of the medians.
The last column says how well the two agree.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import cv2
import numpy as np

binary = sys.argv[1]
threads = int(sys.argv[2]) if len(sys.argv) > 2 else 1
turns = int(sys.argv[3]) if len(sys.argv) > 3 else 5
cv2.setNumThreads(threads)
rng = np.random.default_rng(1)
folder = tempfile.TemporaryDirectory()
room = pathlib.Path(folder.name)


def rectangles(width, height):
    """Gray rectangles, a little blurred: edges and corners everywhere."""
    image = np.full((height, width), 0.5, np.float32)
    for _ in range(width * height // 300):
        u, v = rng.integers(0, width), rng.integers(0, height)
        image[v : v + rng.integers(2, 32), u : u + rng.integers(2, 32)] = rng.random()
    return cv2.GaussianBlur(image, (0, 0), 0.8)


data = os.environ.get("EPIPOLE_DATA")
photograph = pathlib.Path(data, "homography/graf/img1.png") if data else None
gray = cv2.imread(str(photograph), 0) if photograph and photograph.exists() else None
if gray is None:
    print("no EPIPOLE_DATA/homography/graf/img1.png: features and frame of made-up rectangles")
    gray = (255 * rectangles(800, 640)).round().astype(np.uint8)
frame = cv2.resize(gray, (1280, 720), interpolation=cv2.INTER_LINEAR).astype(np.float32) / np.float32(255)
a, b = (rng.integers(0, 160, (2048, 128)).astype(np.float32) for _ in range(2))
broken = [x * np.float32(0.37) for x in (a, b)]
sift, orb, matcher = cv2.SIFT_create(), cv2.ORB_create(nfeatures=1000), cv2.BFMatcher(cv2.NORM_L2)
found = {}


# As ours, all results go into new images.
def both_derivatives():
    found["sobel"] = [cv2.Sobel(frame, cv2.CV_32F, 1, 0), cv2.Sobel(frame, cv2.CV_32F, 0, 1)]


def blur():
    found["gaussian5"] = cv2.GaussianBlur(frame, (5, 5), 1.1)


def harris():
    found["harris"] = cv2.cornerHarris(frame, 3, 3, 0.04)


def detect(name, detector):
    found[name] = detector.detectAndCompute(gray, None)[0]


def match(name, first, second):
    found[name] = matcher.knnMatch(first, second, k=2)


work = {
    "sobel": ("Sobel 3×3, both derivatives, 1280×720", both_derivatives, 100),
    "gaussian5": ("Gaussian 5×5, 1280×720", blur, 100),
    "harris": ("Harris response, 1280×720", harris, 50),
    "sift": ("SIFT, graf 800×640", lambda: detect("sift", sift), 8),
    "orb": ("ORB, graf 800×640", lambda: detect("orb", orb), 10),
    "match_sift": ("Two nearest, 2048² × 128, whole numbers", lambda: match("match_sift", a, b), 8),
    "match_f32": ("Two nearest, 2048² × 128, floats", lambda: match("match_f32", *broken), 8),
}
frame.tofile(room / "frame.f32")
a.tofile(room / "a.f32")
b.tofile(room / "b.f32")
cv2.imwrite(str(room / "photograph.png"), gray)
num_keypoints = len(sift.detect(gray, None))

ours, theirs, notes = {n: [] for n in work}, {n: [] for n in work}, {}
for _ in range(turns):
    text = subprocess.run([binary, str(room), "10", str(num_keypoints)], capture_output=True, text=True, check=True,
                          env={**os.environ, "RAYON_NUM_THREADS": str(threads)}).stdout
    for line in text.splitlines():
        name, median, least, note = line.split()
        ours[name].append((float(median), float(least)))
        notes[name] = note
    for name, (_, run, rounds) in work.items():
        run()
        times = []
        # Other work on the machine interrupts: on one thread, time on the processor counts.
        clock = time.process_time if threads == 1 else time.perf_counter
        for _ in range(rounds):
            start = clock()
            run()
            times.append(1e3 * (clock() - start))
        theirs[name].append((np.median(times), min(times)))


def difference(name, expected):
    mine = np.fromfile(room / f"{name}.f32", np.float32).reshape(expected.shape)
    return f"largest difference {100 * np.abs(mine - expected).max() / np.abs(expected).max():.0e} %"


def nearest(name):
    mine = np.fromfile(room / f"{name}.f32", np.float32)
    same = np.mean(mine == [pair[0].trainIdx for pair in found[name]])
    return f"{100 * same:.1f} % the same nearest"


quality = {
    "sobel": difference("sobel", np.stack(found["sobel"])),
    "gaussian5": difference("gaussian5", found["gaussian5"]),
    "harris": difference("harris", found["harris"]),
    "sift": f"{notes['sift']} features, OpenCV {len(found['sift'])}",
    "orb": f"{notes['orb']} features, OpenCV {len(found['orb'])}",
    "match_sift": nearest("match_sift"),
    "match_f32": nearest("match_f32"),
}
title = "one thread" if threads == 1 else f"{threads} threads"
head = [f"images and features, {title}", "ours", "OpenCV", "ratio", "of medians", "quality"]
rows = [head]
for name, (label, _, _) in work.items():
    o, t = np.array(ours[name]), np.array(theirs[name])
    least, median = (o[:, 1].min(), t[:, 1].min()), (np.median(o[:, 0]), np.median(t[:, 0]))
    rows.append([label, f"{least[0]:.3f} ms", f"{least[1]:.3f} ms", f"{least[1] / least[0]:.2f} ×",
                 f"{median[1] / median[0]:.2f} ×", quality[name]])
widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
for row in rows:
    print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
