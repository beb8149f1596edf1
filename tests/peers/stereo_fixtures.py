#!/usr/bin/env python3
"""Writes tests/peers/fixtures/stereo_rectify.txt: what OpenCV measures on two calibrated rigs.

  python stereo_fixtures.py DATA_DIRECTORY

The fixture holds positions alone, no images: SIFT matches of one EuRoC pair (ratio 0.8), and the
chessboard corners of one pair of OpenCV's sample photographs with the calibration computed from
all of them. Lines: a name, then numbers.
"""
import json
import sys

import cv2
import numpy as np

data = sys.argv[1]
lines = []


def add(name, values, digits):
    lines.append(name + ' ' + ' '.join(f'{float(x):.{digits}g}' for x in np.ravel(values)))


rig = json.load(open(f'{data}/calib/euroc_v101/rig.json'))
for side in ('left', 'right'):
    c = rig[side]
    add(f'euroc_{side}', [c['fx'], c['fy'], c['cx'], c['cy'], *c['dist_k1k2p1p2'], 0], 17)
add('euroc_rotation', rig['R'], 17)
add('euroc_translation', rig['t'], 17)
add('euroc_size', rig['image_size'], 17)
stamp = '1403715273262142976'
images = [cv2.imread(f'{data}/calib/euroc_v101/{s}_{stamp}.png', 0) for s in ('left', 'right')]
(k1, d1), (k2, d2) = [cv2.SIFT_create().detectAndCompute(i, None) for i in images]
for a, b in (m for m in cv2.BFMatcher().knnMatch(d1, d2, k=2) if len(m) == 2):
    if a.distance < 0.8 * b.distance:
        add('euroc_match', [*k1[a.queryIdx].pt, *k2[a.trainIdx].pt], 7)

board = json.load(open(f'{data}/calib/opencv_chessboard/board.json'))
c, r = board['inner_corners']
grid = np.zeros((c * r, 3), np.float32)
grid[:, :2] = np.mgrid[0:c, 0:r].T.reshape(-1, 2) * board['square_m']
grids, corners = [], {'left': [], 'right': []}
for i in board['pairs']:
    found = []
    for side in ('left', 'right'):
        image = cv2.imread(f'{data}/calib/opencv_chessboard/{side}{i:02d}.jpg', 0)
        flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
        ok, p = cv2.findChessboardCorners(image, (c, r), flags=flags)
        found.append(cv2.cornerSubPix(image, p, (11, 11), (-1, -1), (3, 30, 0.01)) if ok else None)
    if all(p is not None for p in found):
        grids.append(grid)
        corners['left'].append(found[0])
        corners['right'].append(found[1])
size = image.shape[::-1]
cameras = []
for side in ('left', 'right'):
    _, K, D, _, _ = cv2.calibrateCamera(grids, corners[side], size, None, None)
    cameras.append((K, D))
    add(f'chess_{side}', [K[0, 0], K[1, 1], K[0, 2], K[1, 2], *D.ravel()[:5]], 17)
(K1, D1), (K2, D2) = cameras
_, _, _, _, _, R, t, _, _ = cv2.stereoCalibrate(
    grids, corners['left'], corners['right'], K1, D1, K2, D2, size, flags=cv2.CALIB_FIX_INTRINSIC)
add('chess_rotation', R, 17)
add('chess_translation', t, 17)
add('chess_size', size, 17)
for i in (0, 5, 10):
    for a, b in zip(corners['left'][i], corners['right'][i]):
        add('chess_match', [*a.ravel(), *b.ravel()], 7)
with open(__file__.rsplit('/', 1)[0] + '/fixtures/stereo_rectify.txt', 'w') as f:
    f.write('\n'.join(lines) + '\n')
