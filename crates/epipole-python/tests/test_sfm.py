"""Reconstruction, bundle adjustment, pose graphs and odometry, against ground truth."""

import copy
import pickle

import numpy as np
import pytest
from conftest import rotation

import epipole
from epipole import sfm, synthetic
from epipole.sfm import PairMatches, SfmImage, SfmInput, Similarity3


def make_problem(**options):
    defaults = {
        "num_cameras": 6,
        "num_points": 150,
        "noise_px": 0.3,
        "seed": 1,
        "path": {"arc": {"radius_m": 6.0, "span_rad": 1.2}},
    }
    return synthetic.MultiViewProblem(**{**defaults, **options})


def make_input(problem, reach=None):
    """Keypoints and matches of a problem, between images at most `reach` apart."""
    observed = problem.observations
    count = len(problem.cameras)
    rows = [np.flatnonzero(observed.indices[:, 0] == camera) for camera in range(count)]
    images = [SfmImage(f"{k}.jpg", observed.pixels[row]) for k, row in enumerate(rows)]
    points = [observed.indices[row, 1] for row in rows]
    pairs = []
    for i in range(count):
        for j in range(i + 1, count if reach is None else min(count, i + 1 + reach)):
            _, at1, at2 = np.intersect1d(points[i], points[j], return_indices=True)
            pairs.append(PairMatches(i, j, np.column_stack([at1, at2])))
    return SfmInput(images, [problem.cameras[0].camera], pairs)


def make_bundle(problem):
    observed = problem.observations
    return sfm.Bundle(problem.cameras, problem.points, observed.indices, observed.pixels)


def centers(cameras):
    return np.array([camera.center_in_world() for camera in cameras])


@pytest.fixture(scope="module")
def problem():
    return make_problem()


@pytest.fixture(scope="module")
def input(problem):
    return make_input(problem)


@pytest.fixture(scope="module")
def result(input):
    return sfm.reconstruct(input)


@pytest.fixture(scope="module")
def photos():
    """Photos of a textured plane by a camera that moves sideways."""
    random = np.random.default_rng(3)
    noise = random.random((400, 600)).astype(np.float32)
    texture = epipole.imaging.gaussian_blur(noise, 1.5)
    texture = epipole.imaging.gray_to_u8((texture - texture.min()) / np.ptp(texture))
    k = np.array([[300.0, 0, 159.5], [0, 300.0, 119.5], [0, 0, 1]])
    list_of_photos, poses = [], []
    for step, (angle_rad, shift) in enumerate([(0.0, 0.0), (0.15, -0.5), (0.3, -1.0)]):
        r = rotation([0, 1, 0], angle_rad)
        t = np.array([shift * 1.2, 0.02 * step, 0.1 * step])
        # Plane z = 3 with 100 texture pixels per unit, around (3, 2).
        plane = np.array([[0.01, 0, -3.0], [0, 0.01, -2.0], [0, 0, 3.0]])
        homography = k @ (r @ plane + np.outer(t, [0, 0, 1]))
        warped = epipole.warp_perspective(texture, homography, width=320, height=240)
        list_of_photos.append(sfm.Photo(f"{step}.png", np.dstack([warped] * 3)))
        poses.append(epipole.RigidTransform(r, t))
    camera = epipole.Camera.pinhole(epipole.Intrinsics.from_matrix(k), 320, 240)
    return list_of_photos, camera, poses


def test_reconstruction_finds_the_truth(problem, result):
    assert result.is_complete and result.unregistered == [] and len(result.components) == 1
    found = result.components[0]
    assert found.num_registered() == 6 and not found.is_placed
    errors, _ = sfm.absolute_trajectory_error(centers(found.cameras), centers(problem.cameras))
    assert errors.rmse < 0.02
    assert found.points.shape == (len(found.colors), 3) and len(found.points) > 140
    assert found.tracks.shape == (found.num_observations(), 3)
    assert result.steps[0].kind == "started" and len(result.steps[0].images) == 2
    assert {step.kind for step in result.steps} == {"started", "registered", "adjusted"}


def test_reconstruction_gives_its_parts(input, result):
    found = result.components[0]
    assert found.mean_reprojection_px(input.images) < 1
    bundle, image_of_camera = found.to_bundle(input.images)
    assert image_of_camera.tolist() == list(range(6))
    assert bundle.observations.shape == (found.num_observations(), 2)
    residual = bundle.residual_px(0)
    camera, point = bundle.observations[0]
    expected = bundle.cameras[camera].project(bundle.points[point]) - bundle.pixels[0]
    assert min(np.abs(residual - expected).max(), np.abs(residual + expected).max()) < 1e-9
    twice = found.moved(Similarity3(epipole.RigidTransform(), 2.0))
    np.testing.assert_allclose(twice.points, 2 * found.points)
    np.testing.assert_allclose(twice.project(0, twice.points[0]), found.project(0, found.points[0]))
    with pytest.raises(ValueError, match="images and cameras"):
        found.mean_reprojection_px(input.images[:2])
    with pytest.raises(IndexError, match="no keypoint"):
        found.mean_reprojection_px([SfmImage("", np.zeros((1, 2)))] * 6)


def test_steps_of_a_reconstruction(input, result):
    work = sfm.IncrementalReconstruction(input)
    steps = []
    while (step := work.step()) is not None:
        steps.append(step)
        current = work.current()
        assert current is None or current.num_registered() >= 2
    assert steps == result.steps
    assert work.finish() == result
    with pytest.raises(RuntimeError, match="finished"):
        work.step()


def test_known_poses_give_points(problem, input):
    poses = [camera.cam_from_world for camera in problem.cameras]
    fractions = []
    found = sfm.triangulate_tracks(input, poses, progress=lambda _, fraction: fractions.append(fraction))
    assert [camera.cam_from_world for camera in found.cameras] == poses
    assert 0 < fractions[0] <= 1 and len(found.points) > 140
    distances = np.linalg.norm(found.points[:, None] - problem.points[None], axis=2).min(axis=1)
    assert np.median(distances) < 0.02
    some = sfm.triangulate_tracks(input, [None, *poses[1:]], min_track_length=6)
    assert some.cameras[0] is None and len(some.points) == 0
    with pytest.raises(epipole.TooFewError, match="known poses"):
        sfm.triangulate_tracks(input, [poses[0]] + [None] * 5)
    with pytest.raises(ValueError, match="images and of their poses"):
        sfm.triangulate_tracks(input, poses[:2])


def test_unregistered_images_have_reasons(input):
    isolated = SfmImage("isolated.jpg", np.random.default_rng(1).uniform(0, 400, (40, 2)))
    more = SfmInput([*input.images, isolated], input.cameras, input.pairs)
    result = sfm.reconstruct(more)
    assert result.unregistered == [6] and result.components[0].cameras[6] is None
    (why,) = sfm.why_unregistered(more, result)
    assert why.kind == "few_matches" and "matches" in why.message


def test_known_positions_place_the_scene(problem, input):
    images = [
        SfmImage(image.name, image.keypoints, position=sfm.PositionPrior(center, [0.01] * 3))
        for image, center in zip(input.images, centers(problem.cameras), strict=True)
    ]
    found = sfm.reconstruct(SfmInput(images, input.cameras, input.pairs)).components[0]
    assert found.is_placed
    np.testing.assert_allclose(centers(found.cameras), centers(problem.cameras), atol=0.03)


def test_tracks_and_verified_pairs(problem, input):
    counts = [len(image.keypoints) for image in input.images]
    tracks = sfm.build_tracks(counts, input.pairs)
    assert tracks.shape[1] == 3 and len(np.unique(tracks[:, 0])) == 150
    assert sfm.build_tracks([2, 2], []).shape == (0, 3)
    pair = input.pairs[2]
    images = (input.images[pair.image1], input.images[pair.image2])
    verified = sfm.verify_matches(pair, images, (input.cameras[0],) * 2)
    assert len(verified.pair) > 0.9 * len(pair) and not verified.is_flat
    assert np.linalg.norm(verified.cam2_from_cam1.translation) == pytest.approx(1)
    few = PairMatches(0, 1, pair.matches.indices[:5])
    assert sfm.verify_matches(few, images, (input.cameras[0],) * 2) is None


def test_bundle_adjustment(problem):
    exact = make_bundle(make_problem(noise_px=0.0))
    random = np.random.default_rng(2)
    moved = sfm.Bundle(exact.cameras, exact.points + random.normal(0, 0.02, exact.points.shape),
                       exact.observations, exact.pixels)
    adjusted, report = sfm.adjust_bundle(moved, lm={"max_iterations": 50})
    assert report.is_converged() and report.final_cost < 1e-10 < report.initial_cost
    assert report.history[0].index == 0 and report.history[-1].cost == report.final_cost
    aligned = sfm.align_points(adjusted.points, exact.points)
    np.testing.assert_allclose(aligned @ adjusted.points, exact.points, atol=1e-5)
    np.testing.assert_array_equal(moved.pixels, exact.pixels)
    held, _ = sfm.adjust_bundle(moved, held_points=np.ones(150, bool))
    np.testing.assert_array_equal(held.points, moved.points)
    priors = [sfm.PositionPrior(center, [0.01] * 3) for center in centers(exact.cameras)]
    placed, _ = sfm.adjust_bundle(moved, position_priors=[*priors[:5], None])
    np.testing.assert_allclose(centers(placed.cameras), centers(exact.cameras), atol=1e-4)


def test_bundle_with_sensors(problem):
    right = epipole.RigidTransform(np.eye(3), [-0.2, 0, 0])
    camera, points = problem.cameras[0], problem.points
    pixels = camera.camera.project(right @ (camera.cam_from_world @ points))
    sensor = sfm.Sensor(right, camera.camera)
    indices = [(0, k) for k in range(len(points))] * 2
    pixels = np.vstack([camera.project(points), pixels])
    sensors = [0] * len(points) + [1] * len(points)
    bundle = sfm.Bundle([camera], points, indices, pixels, None, [sensor], sensors)
    assert np.abs(bundle.residual_px(len(points))).max() < 1e-9
    assert pickle.loads(pickle.dumps(bundle)) == bundle


def test_bal():
    random = np.random.default_rng(4)
    cameras = np.zeros((3, 9))
    cameras[:, 3], cameras[:, 5], cameras[:, 6] = [0, 0.5, 1], -8, 500
    points = random.uniform(-1, 1, (30, 3))
    indices = [(c, p) for c in range(3) for p in range(30)]
    x = np.array([points[p] + cameras[c, 3:6] for c, p in indices])
    pixels = -500 * x[:, :2] / x[:, 2:]
    exact = sfm.BalProblem(cameras, points, indices, pixels)
    assert exact.cost() < 1e-18
    start = sfm.BalProblem(cameras, points + random.normal(0, 0.01, (30, 3)), indices, pixels)
    adjusted, report = sfm.adjust_bal(start, loss={"huber": {"width": 1.0}}, max_iterations=100)
    assert report.final_cost < 1e-8 < start.cost() and adjusted.cost() < 1e-8
    with pytest.raises(IndexError, match="observations"):
        sfm.BalProblem(cameras, points, [(9, 0)], pixels[:1]).cost()


def test_two_view_reconstruction(world):
    found = sfm.two_view_reconstruction(
        world.pixels1, world.pixels2, world.camera, world.camera, world.motion
    )
    assert found.rms_px < 1e-6 and found.num_in_front[0] == 60
    np.testing.assert_allclose(found.points, world.points[found.match_of_point], atol=1e-6)
    assert pickle.loads(pickle.dumps(found)) == found


def test_alignment():
    random = np.random.default_rng(5)
    points = random.normal(size=(20, 3))
    truth = Similarity3(epipole.RigidTransform(rotation([1, 2, 3], 0.7), [1, 2, 3]), 1.5)
    moved = truth @ points
    np.testing.assert_allclose(sfm.align_points(points, moved).matrix(), truth.matrix(), atol=1e-12)
    assert sfm.align_points(points, moved, "rigid").scale == 1
    np.testing.assert_allclose((truth.inverse() @ truth).matrix(), np.eye(4), atol=1e-12)
    moved[15:] += 5
    found, inliers = sfm.estimate_similarity_of_points(points, moved, 0.01)
    assert found.scale == pytest.approx(1.5) and inliers.sum() == 15
    poses = [epipole.RigidTransform(np.eye(3), [k, 0, 0]) for k in range(5)]
    error = sfm.relative_pose_error(poses, poses)
    assert error.translation.max == 0 and error.rotation_deg.rmse == 0


def circle(count=12):
    """``world_from_cam`` on a circle, and the path by measured steps with a drift."""
    truth = [
        epipole.RigidTransform(rotation([0, 0, 1], a), [np.cos(a), np.sin(a), 0])
        for a in np.linspace(0, 2 * np.pi, count, endpoint=False)
    ]
    drift = epipole.RigidTransform(rotation([0, 0, 1], 0.01), [0.005, 0, 0])
    path = [truth[0]]
    for a, b in zip(truth, truth[1:], strict=False):
        path.append(path[-1] @ a.inverse() @ b @ drift)
    return truth, path


def test_loops_are_closed():
    truth, path = circle()
    loop = sfm.LoopClosure(0, 11, Similarity3(truth[0].inverse() @ truth[11]))
    for motion in ("rigid", "similarity"):
        closed = sfm.close_loops(path, [loop], motion)
        before = np.linalg.norm(path[-1].translation - truth[-1].translation)
        after = np.linalg.norm(closed.world_from_cam[-1].translation - truth[-1].translation)
        assert after < 0.4 * before and closed.scale.shape == (12,)
    assert closed.report.final_chi2 < closed.report.initial_chi2


def row(pose):
    return [*pose.translation, *pose.quaternion]


def test_pose_graphs():
    truth, path = circle()
    edges = [(k, k + 1) for k in range(11)] + [(0, 11)]
    measured = [row(truth[a].inverse() @ truth[b]) for a, b in edges]
    graph = sfm.PoseGraph("se3", [row(pose) for pose in path], edges, measured)
    assert graph.size() == (12, 12) and graph.chi2() > 1e-3
    optimized, report = graph.optimize(loss={"huber": {"width": 1.0}})
    assert optimized.chi2() < 1e-12 and report.num_components == 1
    assert report.initial_chi2 == pytest.approx(graph.chi2())
    np.testing.assert_allclose(optimized.vertices[:, :3], [p.translation for p in truth], atol=1e-6)
    assert graph.initialize().chi2() < 1e-12
    angles = np.linspace(0, 1, 4)
    flat = sfm.PoseGraph("se2", np.column_stack([angles, angles, angles]), [(0, 1)], [(0, 0, 0.1)])
    assert flat.information.shape == (1, 3, 3) and flat.kind == "se2"


def test_rotations_are_averaged():
    measured = [rotation([0, 1, 0], angle) for angle in (0.1, 0.2, 0.36)]
    views, errors = sfm.average_rotations(3, [(0, 1), (1, 2), (0, 2)], measured)
    np.testing.assert_allclose(views[2], rotation([0, 1, 0], 0.34), atol=1e-6)
    np.testing.assert_allclose(errors, 0.02, atol=1e-6)


def test_monocular_odometry():
    problem = make_problem(num_cameras=8, num_points=200)
    input = make_input(problem, reach=4)
    result = sfm.monocular_odometry(input)
    assert result.is_complete and result.lost == [] and len(result.keyframes) >= 2
    path = np.array([pose.translation for pose in result.world_from_cam])
    errors, _ = sfm.absolute_trajectory_error(path, centers(problem.cameras))
    assert errors.rmse < 0.02
    work = sfm.Odometry.monocular(input)
    while work.step() is not None:
        pass
    assert work.finish() == result


def test_stereo_odometry():
    problem = make_problem(num_points=200, noise_px=0.1)
    left = make_input(problem, reach=3)
    motion = epipole.RigidTransform(np.eye(3), [-0.3, 0, 0])
    camera = problem.cameras[0].camera
    right, matches = [], []
    for k, posed in enumerate(problem.cameras):
        observed = problem.observations.indices
        points = problem.points[observed[observed[:, 0] == k, 1]]
        pixels = camera.project(motion @ (posed.cam_from_world @ points))
        right.append(SfmImage(f"right{k}", pixels))
        matches.append(np.column_stack([np.arange(len(points))] * 2))
    result = sfm.stereo_odometry(left, right, matches, motion, camera)
    path = np.array([pose.translation for pose in result.world_from_cam])
    errors, aligned = sfm.absolute_trajectory_error(path, centers(problem.cameras), "rigid")
    assert errors.rmse < 0.05 and aligned.scale == 1
    work = sfm.Odometry.stereo(left, right, matches, motion, camera)
    assert work.step().kind in {"started", "registered", "adjusted"}


def test_photos(photos):
    photos, camera, poses = photos
    features = [sfm.photo_features(photo) for photo in photos]
    assert len(features[0]) == len(features[0].keypoints) > 100
    assert features[0].descriptors.shape == (len(features[0]), 128)
    pairs = sfm.match_features(features)
    assert [(pair.image1, pair.image2) for pair in pairs] == [(0, 1), (0, 2), (1, 2)]
    images, again = sfm.match_photos(photos)
    assert again == pairs and images == [feature.image for feature in features]
    matches = pairs[0].matches
    homography = epipole.estimate_homography(
        images[0].keypoints[matches.indices[:, 0]], images[1].keypoints[matches.indices[:, 1]]
    )
    assert homography.num_inliers > 50
    rectified = sfm.match_rectified(features[0], features[0])
    assert rectified.indices.shape[1] == 2
    assert pickle.loads(pickle.dumps(features[0])) == features[0]


def test_photos_are_reconstructed_and_localized(photos):
    photos, camera, poses = photos
    input, result = sfm.reconstruct_photos(
        photos, [camera], photo_options={"best_first": True}, min_start_angle_deg=8.0
    )
    assert len(input.images) == 3 and len(input.pairs) == 3
    features = [sfm.photo_features(photo) for photo in photos]
    rays = camera.unproject(features[0].image.keypoints)
    on_plane = rays * (3 / rays[:, 2:])
    tracks = [(k, 0, k) for k in range(len(rays))]
    first = epipole.PosedCamera(camera, epipole.RigidTransform())
    scene = sfm.Reconstruction([first], on_plane, tracks)
    found = scene.localize(features[:1], features[1], camera)
    assert len(found.inliers) > 50 and found.num_matches >= len(found.inliers)
    center = found.cam_from_world.inverse().translation
    np.testing.assert_allclose(center, poses[1].inverse().translation, atol=0.05)


def test_wrong_arguments_are_named(problem, input):
    with pytest.raises(ValueError, match="keypoints"):
        SfmImage("a", [1, 2, 3])
    with pytest.raises(TypeError, match="matches must be an array of integers"):
        PairMatches(0, 1, [(0.5, 1.0)])
    with pytest.raises(ValueError, match="matches must not be negative"):
        PairMatches(0, 1, [(0, -1)])
    with pytest.raises(ValueError, match="observations and pixels"):
        sfm.Bundle(problem.cameras, problem.points, [(0, 0)], np.zeros((2, 2)))
    with pytest.raises(ValueError, match="tracks has point 9"):
        sfm.Reconstruction([None], np.zeros((2, 3)), [(9, 0, 0)])
    with pytest.raises(TypeError, match="colors must be uint8"):
        SfmImage("a", np.zeros((2, 2)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match="scale"):
        Similarity3(epipole.RigidTransform(), 0.0)
    with pytest.raises(ValueError, match='kind must be "se2"'):
        sfm.PoseGraph("se4", np.zeros((1, 3)), [], [])
    with pytest.raises(ValueError, match="edges, fixed, landmarks and prior_vertices"):
        sfm.PoseGraph("se2", np.zeros((1, 3)), [(0, 1)], np.zeros((1, 3)))
    with pytest.raises(TypeError, match="unknown option refine_focus"):
        sfm.reconstruct(input, refine_focus=True)
    with pytest.raises(TypeError, match="motion"):
        sfm.close_loops([], [], "free")
    with pytest.raises(epipole.TooFewError):
        sfm.reconstruct(SfmInput([], input.cameras, []))
    with pytest.raises(ValueError, match="result has images"):
        sfm.why_unregistered(input, sfm.SfmResult([], [9], [], True))
    with pytest.raises(ValueError, match="index"):
        sfm.reconstruct(SfmInput(input.images[:2], input.cameras, input.pairs))


def test_pickles_are_equal(problem, input, result):
    values = [
        input, result, result.components[0], *result.steps[:3], *result.steps[-1:], input.images[0],
        input.pairs[0], make_bundle(problem), problem, Similarity3(),
        sfm.PositionPrior([1, 2, 3], [1, 1, 1]), sfm.LoopClosure(0, 3, Similarity3()),
        sfm.PoseGraph("se2", np.zeros((2, 3)), [(0, 1)], np.zeros((1, 3))),
        sfm.Photo("a", np.zeros((4, 5, 3), np.uint8)),
        sfm.absolute_trajectory_error(np.eye(3), np.eye(3))[0],
    ]
    for value in values:
        for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
            assert again == value and type(again) is type(value)
        assert value != 3 and len(repr(value)) < 3000
        assert repr(value).startswith(type(value).__name__)


def test_progress_and_cancellation(input):
    reports = []
    sfm.reconstruct(input, progress=lambda *status: reports.append(status))
    assert reports[0][0] == "testing pairs" and all(0 <= fraction <= 1 for _, fraction in reports)

    def stop(stage, fraction):
        raise RuntimeError("enough")

    for function in (sfm.reconstruct, sfm.monocular_odometry):
        with pytest.raises(RuntimeError, match="enough"):
            function(input, progress=stop)
