#!/usr/bin/env python3
"""Writes the fixtures that the image and feature rooms are tested against.

    python images_and_features.py            # writes into fixtures/ beside this file

Every input is made here from formulas and a seed; no photograph is involved. The references come
from NumPy, SciPy and OpenCV (the versions that made the committed files: NumPy 2.4, SciPy 1.17,
OpenCV 5.0). All arrays are little-endian .npy files, rows first.
"""
import os
import cv2
import numpy as np
from scipy import ndimage

cv2.setNumThreads(1)
OUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "fixtures")
os.makedirs(OUT, exist_ok=True)


def save(name, array):
    np.save(os.path.join(OUT, name + ".npy"), np.ascontiguousarray(array))


def texture(width, height, seed, smooth):
    """Blobs, a few rectangles and some noise, in [0, 1]."""
    rng = np.random.default_rng(seed)
    image = ndimage.gaussian_filter(rng.normal(size=(height, width)), smooth)
    image = (image - image.min()) / (image.max() - image.min())
    for _ in range(max(2, width * height // 600)):
        x, y = rng.integers(0, width - 4), rng.integers(0, height - 4)
        w, h = rng.integers(3, max(4, width // 4)), rng.integers(3, max(4, height // 4))
        image[y:y + h, x:x + w] = 0.5 * image[y:y + h, x:x + w] + 0.5 * rng.random()
    return np.clip(image + 0.02 * rng.normal(size=image.shape), 0, 1).astype(np.float32)


# ---------------------------------------------------------------- images
image = texture(40, 31, 1, 1.5)
save("texture", image)
REFLECT, REPLICATE, CONSTANT = cv2.BORDER_REFLECT_101, cv2.BORDER_REPLICATE, cv2.BORDER_CONSTANT
for suffix, border in (("reflect101", REFLECT), ("replicate", REPLICATE), ("constant", CONSTANT)):
    save("u8_gauss_5_s1.1", cv2.GaussianBlur(bytes_, (5, 5), 1.1))
save("u8_gauss_auto_s2", cv2.GaussianBlur(bytes_, (0, 0), 2.0, borderType=REPLICATE))
save("u8_gauss_7_s1.4", cv2.GaussianBlur(bytes_, (7, 7), 1.4, borderType=CONSTANT))
save("u8_gauss_3_s0.6", cv2.GaussianBlur(bytes_, (3, 3), 0.6))
save("u8_gauss_11_s3", cv2.GaussianBlur(bytes_, (11, 11), 3.0))
rgb = rng.integers(0, 256, (64, 64, 3), dtype=np.uint8)
save("rgb", rgb)
save("rgb_gray", cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY))

# ---------------------------------------------------------------- corners
board = np.kron(np.indices((5, 6)).sum(0) % 2, np.ones((12, 12)))
corners = cv2.GaussianBlur(np.clip(0.15 + 0.7 * board + 0.05 * rng.normal(size=board.shape), 0, 1), (0, 0), 1.0)
shear = np.array([[0.95, 0.12, 2.3], [-0.08, 1.02, 6.4]])
corners = cv2.warpAffine(corners.astype(np.float32), shear, (80, 76), borderMode=cv2.BORDER_REPLICATE).astype(np.float32)
save("corners", corners)
save("harris_3_3", cv2.cornerHarris(corners, 3, 3, 0.04))
save("harris_2_3", cv2.cornerHarris(corners, 2, 3, 0.04))
save("harris_5_5", cv2.cornerHarris(corners, 5, 5, 0.06))
save("harris_scharr", cv2.cornerHarris(corners, 3, -1, 0.04))
save("min_eigen_3_3", cv2.cornerMinEigenVal(corners, 3, ksize=3))
found = cv2.goodFeaturesToTrack(corners, 60, 0.05, 7, blockSize=3)[:, 0]
save("good_features", found.astype(np.float32))
found = cv2.goodFeaturesToTrack(corners, 25, 0.01, 10, blockSize=5, useHarrisDetector=True, k=0.04)[:, 0]
save("good_features_harris", found.astype(np.float32))
start = cv2.goodFeaturesToTrack(corners, 40, 0.2, 9, blockSize=3)[:, :]
fine = cv2.cornerSubPix(corners, start.copy(), (4, 4), (-1, -1), (3, 100, 1e-5))
save("subpix_start", start[:, 0].astype(np.float32))
save("subpix_refined", fine[:, 0].astype(np.float32))

# ---------------------------------------------------------------- SIFT
blobs = np.zeros((120, 150))
v, u = np.mgrid[0:120, 0:150].astype(np.float64)
for _ in range(45):
    x, y, size, height = rng.uniform(0, 150), rng.uniform(0, 120), rng.uniform(1.5, 7), rng.uniform(-0.5, 0.5)
    blobs += height * np.exp(-((u - x) ** 2 + (v - y) ** 2 + 0.5 * (u - x) * (v - y)) / (2 * size * size))
blobs = np.round(255 * (blobs - blobs.min()) / (blobs.max() - blobs.min())).astype(np.uint8)
save("sift_image", blobs)
sift = cv2.SIFT_create(enable_precise_upscale=True)
keypoints = sift.detect(blobs, None)
# OpenCV's size is the diameter, twice the blur.
save("sift_keypoints", np.array([[k.pt[0], k.pt[1], k.size / 2] for k in keypoints], np.float32))
# Descriptors at whole pixels, which OpenCV need not round: u, v, blur, angle in degrees (v down),
# then 128 numbers. Its directions run against ours: bin 8 - k is our bin k.
given = [(40 + 12 * (k % 6), 40 + 13 * (k // 6), 1.6 * 2 ** ((1 + k % 3) / 3), 37.0 * k % 360) for k in range(24)]
at = [cv2.KeyPoint(u, v, 2 * blur, angle, 1, (1 + k % 3) << 8, k) for k, (u, v, blur, angle) in enumerate(given)]
at, described = sift.compute(blobs, at)
described = described.reshape(-1, 4, 4, 8)[..., -np.arange(8) % 8].reshape(-1, 128)
rows = [[*k.pt, k.size / 2, k.angle, *d] for k, d in zip(at, described)]
save("sift_described", np.array(rows, np.float32))

# ---------------------------------------------------------------- FAST and tracking
fast = np.round(255 * texture(96, 80, 7, 1.0)).astype(np.uint8)
fast = cv2.GaussianBlur(fast, (3, 3), 0.6)
save("fast_image", fast)
found = cv2.FastFeatureDetector_create(threshold=15, nonmaxSuppression=True).detect(fast)
save("fast_corners", np.array([k.pt for k in found], np.float32))
found = cv2.FastFeatureDetector_create(threshold=15, nonmaxSuppression=False).detect(fast)
save("fast_all", np.array([k.pt for k in found], np.float32))

big = 0.5 * texture(160, 130, 8, 2.0) + 0.5 * texture(160, 130, 9, 4.0)
motion = np.array([[1.01, 0.02, 3.4], [-0.015, 0.99, -2.2]])
one = np.round(255 * big).astype(np.uint8)
# The second picture is sampled by a cubic spline, which is exact for smooth images.
v, u = np.mgrid[0:130, 0:160].astype(np.float64)
inverse = np.linalg.inv(np.vstack([motion, [0, 0, 1]]))
at = [inverse[1, 0] * u + inverse[1, 1] * v + inverse[1, 2], inverse[0, 0] * u + inverse[0, 1] * v + inverse[0, 2]]
two = ndimage.map_coordinates(one.astype(np.float64), at, order=3, mode="mirror")
two = np.clip(np.round(two), 0, 255).astype(np.uint8)
save("track_1", one)
save("track_2", two)
start = cv2.goodFeaturesToTrack(one, 40, 0.05, 9)[:, 0]
start = start[(np.abs(start - [80, 65]) < [60, 45]).all(1)].astype(np.float32)
truth = start @ motion[:, :2].T + motion[:, 2]
found, _, _ = cv2.calcOpticalFlowPyrLK(one, two, start[:, None], None, winSize=(21, 21), maxLevel=3)
save("track_points", np.hstack([start, truth, found[:, 0]]).astype(np.float32))
total = sum(os.path.getsize(os.path.join(OUT, f)) for f in os.listdir(OUT))
print(len(os.listdir(OUT)), "files,", total, "bytes")
