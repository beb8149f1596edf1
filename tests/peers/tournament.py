"""The tournament of lines once more, in NumPy and from its description alone: how often each method
ends within 2 degrees of the hidden line.

    .venv/bin/python tests/peers/tournament.py > tests/peers/fixtures/tournament.txt

Each row: outlier ratio, threshold in standard deviations of the noise, runs, and the successes of
least squares, Huber's loss, the least median, RANSAC, MSAC, and MSAC with local optimization. The
points are drawn by NumPy, so no run has the points of a run of the figure's: shares are compared. Least
squares and Huber's loss are also asked of OpenCV, on the same points, and must agree with NumPy's; its robust fit starts from
several samples of its own, so it need not find the same minimum where there are two.
"""
import sys
import cv2
import numpy as np

WIDTH, HEIGHT, SIGMA, POINTS, RUNS = 640.0, 400.0, 4.0, 60, 1000
SAMPLES, CONFIDENCE, WITHIN_DEG = 500, 0.99, 2.0
HUBER_PX = 1.345 * SIGMA
CASES = [(0.1, 2.5), (0.3, 2.5), (0.4, 2.5), (0.5, 2.5), (0.6, 2.5), (0.7, 2.5), (0.8, 2.5), (0.4, 20.0)]


def scatter(rng, outlier_ratio):
    """Points near a line through the middle; half of the outliers anywhere, half in one region."""
    angle = rng.uniform(-0.42, 0.42)
    along = np.array([np.cos(angle), np.sin(angle)])
    normal = np.array([-along[1], along[0]])
    middle = np.array([WIDTH / 2, HEIGHT / 2 + rng.uniform(-50, 50)])
    wrong = round(outlier_ratio * POINTS)
    right = POINTS - wrong
    place = rng.uniform(-0.46, 0.46, (right, 1)) * WIDTH * along
    points = [middle + place + SIGMA * rng.normal(size=(right, 1)) * normal]
    for _ in range(wrong):
        share = rng.uniform(size=2)
        if rng.uniform() < 0.5:
            share = np.array([0.55, 0.04]) + np.array([0.42, 0.30]) * share
            if along[1] < 0:                # on the side that the line leaves free
                share[1] = 1 - share[1]
        points.append([share * [WIDTH, HEIGHT]])
    points = np.clip(np.concatenate(points), 4, [WIDTH - 4, HEIGHT - 4])
    return np.round(points, 1), along


def fit(points, weights=None):
    """Total least squares: a point of the line and its direction."""
    weights = np.ones(len(points)) if weights is None else weights
    center = weights @ points / weights.sum()
    moved = (points - center) * np.sqrt(weights)[:, None]
    return center, np.linalg.svd(moved, full_matrices=False)[2][0]


def distances(points, line):
    (u, v), (du, dv) = line
    return np.abs(du * (points[:, 1] - v) - dv * (points[:, 0] - u))


def huber(points):
    """Least squares again and again, far points with the weight that bounds their pull."""
    line = fit(points)
    for _ in range(500):
        e = np.maximum(distances(points, line), 1e-12)
        new = fit(points, np.minimum(1, HUBER_PX / e))
        turned = abs(np.cross(np.append(line[1], 0), np.append(new[1], 0))[2])
        line = new
        if turned < 1e-10:
            break
    return line


def sample(rng, points):
    p, q = points[rng.choice(len(points), 2, replace=False)]
    length = np.linalg.norm(q - p)
    return None if length == 0 else (p, (q - p) / length)


def least_median(rng, points):
    best, least = None, np.inf
    for _ in range(SAMPLES):
        line = sample(rng, points)
        if line is not None and (median := np.median(distances(points, line))) < least:
            best, least = line, median
    reach = 2.5 * 1.4826 * (1 + 5 / (len(points) - 2)) * least
    for _ in range(5):
        near = distances(points, best) <= reach
        if near.sum() < 2:
            break
        best = fit(points[near])
    return best


def vote(rng, points, epsilon, msac, local):
    def score(line):
        e = distances(points, line)
        near = e < epsilon
        return (np.sum(1 - (e[near] / epsilon) ** 2) if msac else near.sum()), near

    best, most, near, drawn, needed = None, -1.0, None, 0, np.inf
    while drawn < min(needed, SAMPLES):
        drawn += 1
        line = sample(rng, points)
        if line is None:
            continue
        votes, voters = score(line)
        if votes <= most:
            continue
        best, most, near = line, votes, voters
        for _ in range(10 if local else 0):
            if near.sum() < 3:
                break
            line = fit(points[near])
            votes, voters = score(line)
            if votes <= most:
                break
            best, most, near = line, votes, voters
        w = near.mean() ** 2
        needed = 1 if w >= 1 else np.ceil(np.log(1 - CONFIDENCE) / np.log(1 - w))
    return best if local or near.sum() < 2 else fit(points[near])


def opencv(points, loss, parameter):
    du, dv, u, v = cv2.fitLine(points.astype(np.float32), loss, parameter, 1e-4, 1e-4).ravel()
    return np.array([u, v]), np.array([du, dv])


def angle_deg(one, other):
    return np.degrees(np.arcsin(min(1.0, abs(one[0] * other[1] - one[1] * other[0]))))


def main():
    print("# ratio threshold runs least-squares huber least-median ransac msac msac-lo")
    for case, (ratio, threshold) in enumerate(CASES):
        rng = np.random.default_rng([7, case])
        wins, cv_wins = np.zeros(6, int), np.zeros(2, int)
        squares_apart = 0.0
        for _ in range(RUNS):
            points, truth = scatter(rng, ratio)
            epsilon = threshold * SIGMA
            lines = [fit(points), huber(points), least_median(rng, points)]
            lines += [vote(rng, points, epsilon, *kind) for kind in ((False, False), (True, False), (True, True))]
            wins += [angle_deg(line[1], truth) <= WITHIN_DEG for line in lines]
            squares = opencv(points, cv2.DIST_L2, 0)
            squares_apart = max(squares_apart, angle_deg(squares[1], lines[0][1]))
            robust = opencv(points, cv2.DIST_HUBER, HUBER_PX)
            cv_wins += [angle_deg(line[1], truth) <= WITHIN_DEG for line in (squares, robust)]
        print(f"{ratio} {threshold} {RUNS}", *wins)
        print(f"{ratio} {threshold}: OpenCV's least squares at most {squares_apart:.4f} degrees apart; successes of "
              f"fitLine {cv_wins[0]} (ours {wins[0]}), with Huber's loss {cv_wins[1]} (ours {wins[1]})", file=sys.stderr)
        assert squares_apart < 0.05
        assert abs(cv_wins - wins[:2]).max() <= 0.1 * RUNS


main()
