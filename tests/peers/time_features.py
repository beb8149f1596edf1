#!/usr/bin/env python3
"""Times our image and feature rooms and OpenCV's, in turns, and prints their ratios.

    python time_features.py IMAGE path/to/features_time [THREADS] [TURNS]

Both work on the same image; filters on 1280 x 720 floats; matching on 2048 x 2048 random
descriptors of 128 whole numbers. Each turn runs both; the median and the least over all turns are
printed, and OpenCV's time over ours (above 1: ours is faster).
"""
import os, subprocess, sys, time
import cv2
import numpy as np

path, binary = sys.argv[1], sys.argv[2]
threads = int(sys.argv[3]) if len(sys.argv) > 3 else 1
turns = int(sys.argv[4]) if len(sys.argv) > 4 else 5
cv2.setNumThreads(threads)
gray = cv2.imread(path, 0)
frame = cv2.resize(gray, (1280, 720), interpolation=cv2.INTER_LINEAR).astype(np.float32) / np.float32(255)
rng = np.random.default_rng(1)
a, b = (rng.integers(0, 160, (2048, 128)).astype(np.float32) for _ in range(2))
sift, orb, matcher = cv2.SIFT_create(), cv2.ORB_create(nfeatures=1000), cv2.BFMatcher(cv2.NORM_L2)
found = {}
# On one thread: time on a processor, which other work on the machine disturbs less.
clock = time.process_time if threads == 1 else time.perf_counter


def both_derivatives():
    return cv2.Sobel(frame, cv2.CV_32F, 1, 0), cv2.Sobel(frame, cv2.CV_32F, 0, 1)


du, dv = np.empty_like(frame), np.empty_like(frame)


def both_derivatives_again():
    cv2.Sobel(frame, cv2.CV_32F, 1, 0, dst=du)
    cv2.Sobel(frame, cv2.CV_32F, 0, 1, dst=dv)


def detect(name, detector):
    found[name] = len(detector.detectAndCompute(gray, None)[0])


work = {
    "sobel": (both_derivatives, 100),
    "sobel_into": (both_derivatives_again, 100),
    "gaussian5": (lambda: cv2.GaussianBlur(frame, (5, 5), 1.1), 100),
    "harris": (lambda: cv2.cornerHarris(frame, 3, 3, 0.04), 50),
    "sift": (lambda: detect("sift", sift), 10),
    "orb": (lambda: detect("orb", orb), 10),
    "match_sift": (lambda: matcher.knnMatch(a, b, k=2), 10),
    "match_f32": (lambda: matcher.knnMatch(a, b, k=2), 10),
}
ours, theirs, notes = {n: [] for n in work}, {n: [] for n in work}, {}
for _ in range(turns):
    text = subprocess.run([binary, path, "10"], capture_output=True, text=True, check=True,
                          env={**os.environ, "RAYON_NUM_THREADS": str(threads)}).stdout
    for line in text.splitlines():
        name, median, least, note = line.split()
        ours[name].append((float(median), float(least)))
        notes[name] = note
    for name, (run, rounds) in work.items():
        run()
        times = []
        for _ in range(rounds):
            start = clock()
            run()
            times.append(1e3 * (clock() - start))
        theirs[name].append((np.median(times), min(times)))
print(f"{'':11}{'ours':>9}{'OpenCV':>9}{'ratio':>7}   least: {'ours':>8}{'OpenCV':>9}{'ratio':>7}   ({threads} thread{'s' * (threads > 1)}, ms)")
for name in work:
    o, t = np.array(ours[name]), np.array(theirs[name])
    m, l = (np.median(o[:, 0]), np.median(t[:, 0])), (o[:, 1].min(), t[:, 1].min())
    note = f"features {notes[name]} / {found[name]}" if name in found else ""
    print(f"{name:11}{m[0]:9.3f}{m[1]:9.3f}{m[1] / m[0]:7.2f}          {l[0]:8.3f}{l[1]:9.3f}{l[1] / l[0]:7.2f}   {note}")
