#!/usr/bin/env python3
"""Writes the histograms of scikit-image that our SIFT descriptors are tested against.

    python sift_histograms.py            # writes into fixtures/ beside this file

The image and the places are those of `images_and_features.py`, which comes first. scikit-image 0.25 made the
committed file. It describes only what it has detected itself, so the places are put where it keeps its own.
"""
import os
import numpy as np
from skimage.feature import SIFT

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "fixtures")
image = np.load(os.path.join(HERE, "sift_image.npy"))
u, v, blur, degrees = np.load(os.path.join(HERE, "sift_described.npy"))[:, :4].astype(np.float64).T

sift = SIFT(upsampling=1)
gray = sift._preprocess(image)
sift.positions = np.stack([v, u], axis=1)
sift.scales = np.round(sift.n_scales * np.log2(blur / sift.sigma_min)).astype(int)
sift.sigmas, sift.octaves = blur, np.zeros(len(blur), int)
# scikit-image measures directions from down towards right, and rotates patches by 180° more.
sift.orientations = np.pi - np.radians(degrees)
sift._compute_descriptor([np.gradient(octave) for octave in sift._create_scalespace(gray)])
cells = sift.descriptors.reshape(-1, 4, 4, 8).astype(np.float64)
# Its numbers are rounded down.
cells[cells > 0] += 0.5
ours = cells[:, ::-1, ::-1, (6 - np.arange(8)) % 8].reshape(-1, 128)
np.save(os.path.join(HERE, "sift_described_by_scikit_image.npy"), ours.astype(np.float32))
print(len(ours), "descriptors")
