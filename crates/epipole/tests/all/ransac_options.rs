//! Effects of each option of the RANSAC loop, through the public interface.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{EssentialEstimator, FundamentalEstimator};
use epipole::homography::HomographyEstimator;
use epipole::math::Line2;
use epipole::math::random::Random;
use epipole::robust::{
    Budget, Estimator, LineEstimator, MatchSet, Ransac, RansacOptions, RansacReport, ScoreKind,
    SimilarityEstimator, Step, StopReason, num_trials_with_replacement,
    num_trials_without_replacement, ransac,
};
use nalgebra::{Point2, Point3, Vector3};

/// Points near one line, the others anywhere in a square of 1000 px.
fn points(num_points: usize, num_on_line: usize, noise_px: f64, seed: u64) -> Vec<Point2<f64>> {
    let mut random = Random::new(seed);
    (0..num_points)
        .map(|i| {
            let u = random.uniform(0.0, 1000.0);
            if i < num_on_line {
                Point2::new(u, 0.5 * u + 100.0 + noise_px * random.normal())
            } else {
                Point2::new(u, random.uniform(0.0, 1000.0))
            }
        })
        .collect()
}

fn fit(points: &[Point2<f64>], options: &RansacOptions) -> RansacReport<Line2> {
    ransac(LineEstimator::new(points).unwrap(), options, &mut ()).unwrap()
}

#[test]
fn the_largest_number_of_samples_holds_against_the_least() {
    for (num_on_line, stop) in [(180, StopReason::Confident), (8, StopReason::Exhausted)] {
        let points = points(200, num_on_line, 0.0, 1);
        let options = RansacOptions::default()
            .with_min_iterations(500)
            .with_max_iterations(50);
        let report = fit(&points, &options);
        assert_eq!((report.iterations, report.stop), (50, stop));
        assert_eq!(
            report.required_iterations <= 50,
            stop == StopReason::Confident
        );
    }
}

#[test]
fn the_least_number_of_samples_is_drawn_and_no_more() {
    let points = points(100, 100, 0.0, 1);
    for min_iterations in [0, 1, 2, 77] {
        let options = RansacOptions::default().with_min_iterations(min_iterations);
        let report = fit(&points, &options);
        assert_eq!(report.iterations, min_iterations.max(1));
        assert_eq!(
            (report.required_iterations, report.stop),
            (1, StopReason::Confident)
        );
    }
}

#[test]
fn a_run_that_is_finished_before_any_sample_has_found_nothing() {
    let points = points(100, 60, 0.5, 2);
    let estimator = LineEstimator::new(&points).unwrap();
    let run = Ransac::new(estimator, RansacOptions::default()).unwrap();
    assert!(run.best().is_none());
    assert_eq!((run.iterations(), run.required_iterations()), (0, u64::MAX));
    assert!(matches!(run.finish(), Err(Error::NoConsensus { .. })));
}

#[test]
fn a_run_that_is_finished_early_reports_the_best_model_so_far() {
    let points = points(300, 100, 0.5, 3);
    let estimator = LineEstimator::new(&points).unwrap();
    let mut run = Ransac::new(estimator.clone(), RansacOptions::default()).unwrap();
    let mut drawn = 0;
    while let Step::Trial(trial) = run.step() {
        drawn = trial.iteration;
        if trial.is_best {
            break;
        }
    }
    let (model, score) = run.best().map(|(model, score)| (*model, score)).unwrap();
    let report = run.finish().unwrap();
    assert_eq!(
        (report.iterations, report.stop),
        (drawn, StopReason::Interrupted)
    );
    assert!(report.score >= 0.95 * score, "{} {score}", report.score);
    assert_eq!(report.inliers.len(), 300);
    assert_eq!(
        report.inliers.iter().filter(|is| **is).count(),
        report.num_inliers
    );
    for (point, &inlier) in points.iter().zip(&report.inliers) {
        assert_eq!(report.model.signed_distance(point).abs() < 1.0, inlier);
    }
    // The last refinement starts from that model.
    let angle = (report.model.a * model.b - report.model.b * model.a).abs();
    assert!(angle < 0.05, "{angle}");
}

#[test]
fn a_finished_run_draws_no_more() {
    let points = points(100, 90, 0.0, 4);
    let mut run = Ransac::new(
        LineEstimator::new(&points).unwrap(),
        RansacOptions::default(),
    )
    .unwrap();
    while let Step::Trial(_) = run.step() {}
    assert_eq!(run.step(), Step::Finished(StopReason::Confident));
    assert_eq!(run.finish().unwrap().stop, StopReason::Confident);
}

/// After each sample, the required number of samples is the formula's for the best model's inliers;
/// the loop ends with the first sample that reaches it.
#[test]
fn the_loop_follows_the_formula_of_its_budget() {
    for budget in [Budget::WithReplacement, Budget::WithoutReplacement] {
        for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
            for seed in 0..10 {
                // Few enough for a difference between both formulas.
                let points = points(60, 12, 0.2, seed);
                let options = RansacOptions::default()
                    .with_budget(budget)
                    .with_score(score)
                    .with_seed(seed)
                    .with_confidence(0.99)
                    .with_min_iterations(1)
                    // Then a sample's own inliers are those of the best model.
                    .with_local_optimization(false);
                let formula = |num_inliers: usize| match budget {
                    Budget::WithReplacement => {
                        num_trials_with_replacement(num_inliers as f64 / 60.0, 2, 0.99)
                    }
                    Budget::WithoutReplacement => {
                        num_trials_without_replacement(num_inliers, 60, 2, 0.99)
                    }
                };
                let estimator = LineEstimator::new(&points).unwrap();
                let mut run = Ransac::new(estimator, options).unwrap();
                let mut required = u64::MAX;
                let mut drawn = 0;
                loop {
                    let best = match run.step() {
                        Step::Trial(trial) => trial.is_best.then_some(trial.num_inliers),
                        Step::Finished(stop) => {
                            assert_eq!(stop, StopReason::Confident);
                            break;
                        }
                    };
                    assert!(drawn < required, "{drawn} were enough: {required}");
                    drawn += 1;
                    if let Some(num_inliers) = best {
                        required = formula(num_inliers).unwrap();
                    }
                    assert_eq!(run.required_iterations(), required);
                }
                assert!(drawn >= required);
                let report = run.finish().unwrap();
                assert_eq!(report.iterations as u64, drawn);
                assert_eq!(
                    report.required_iterations,
                    formula(report.num_inliers).unwrap()
                );
            }
        }
    }
    let with_budget = |budget| {
        let options = RansacOptions::default().with_budget(budget);
        fit(&points(60, 12, 0.0, 1), &options).required_iterations
    };
    assert!(with_budget(Budget::WithoutReplacement) > with_budget(Budget::WithReplacement));
}

/// Data that repeat others add nothing to the confidence.
#[test]
fn what_is_required_counts_different_data() {
    let mut random = Random::new(6);
    let mut pixel = || Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
    let (mut p1, mut p2) = (Vec::new(), Vec::new());
    for n in 0..40 {
        let p = pixel();
        let q = if n < 20 {
            pixel()
        } else {
            Point2::new(p.x + 5.0, p.y - 3.0)
        };
        // True matches many times over.
        for _ in 0..if n < 20 { 1 } else { 10 } {
            p1.push(p);
            p2.push(q);
        }
    }
    let set = MatchSet::new(&p1, &p2).unwrap();
    let report = ransac(
        SimilarityEstimator::new(set),
        &RansacOptions::default(),
        &mut (),
    )
    .unwrap();
    assert_eq!((report.num_inliers, report.num_unique_inliers), (200, 20));
    let required = num_trials_without_replacement(20, 40, 2, 0.999).unwrap();
    assert_eq!(report.required_iterations, required);
}

#[test]
fn without_local_optimization_the_model_is_that_of_a_sample() {
    let points = points(200, 100, 0.5, 7);
    let plain = RansacOptions::default().with_local_optimization(false);
    let mut run = Ransac::new(LineEstimator::new(&points).unwrap(), plain).unwrap();
    let mut of_best = Vec::new();
    while let Step::Trial(trial) = run.step() {
        assert!(trial.refined.is_none());
        if trial.is_best {
            of_best = trial.sample.to_vec();
        }
    }
    let report = run.finish().unwrap();
    assert_eq!(report.refinements, 0);
    for index in of_best {
        assert!(report.model.signed_distance(&points[index]).abs() < 1e-9);
    }
    let improved = fit(&points, &RansacOptions::default());
    assert!(improved.refinements > 0);
    // Distance from the true line at both ends of the image.
    let off = |line: &Line2| -> f64 {
        [(0.0, 100.0), (1000.0, 600.0)]
            .map(|(u, v)| line.signed_distance(&Point2::new(u, v)).abs())
            .iter()
            .sum()
    };
    assert!(
        off(&improved.model) < off(&report.model),
        "{improved:?} {report:?}"
    );
    assert!(off(&improved.model) < 0.3);
}

/// Matches of two cameras, every third of them wrong.
fn matches() -> (Vec<Point2<f64>>, Vec<Point2<f64>>, Intrinsics) {
    let mut random = Random::new(8);
    let intrinsics = Intrinsics::centered(700.0, 640, 480).unwrap();
    let camera = |cam_from_world| PosedCamera {
        camera: Camera::pinhole(intrinsics, 640, 480),
        cam_from_world,
    };
    let left = camera(RigidTransform::identity());
    let right = camera(RigidTransform::new(
        Vector3::new(-0.5, 0.1, 0.2),
        Vector3::new(0.02, 0.1, -0.03),
    ));
    let (mut p1, mut p2) = (Vec::new(), Vec::new());
    while p1.len() < 150 {
        let mut within = |low, high| random.uniform(low, high);
        let point = Point3::new(within(-2.0, 2.0), within(-1.5, 1.5), within(3.0, 8.0));
        let (Ok(a), Ok(mut b)) = (left.project(&point), right.project(&point)) else {
            continue;
        };
        if p1.len() % 3 == 0 {
            b = Point2::new(within(0.0, 640.0), within(0.0, 480.0));
        }
        let mut noisy =
            |p: Point2<f64>| Point2::new(p.x + 0.3 * random.normal(), p.y + 0.3 * random.normal());
        p1.push(noisy(a));
        p2.push(noisy(b));
    }
    (p1, p2, intrinsics)
}

/// Scoring every model in full shows more and decides nothing.
#[test]
fn scores_of_losers_change_nothing() {
    fn check<E: Estimator>(prepare: impl Fn() -> E)
    where
        E::Model: PartialEq + std::fmt::Debug,
    {
        let estimator = prepare();
        for score in [ScoreKind::Msac, ScoreKind::InlierCount] {
            for seed in 0..3 {
                let brief = RansacOptions::default()
                    .with_score(score)
                    .with_seed(seed)
                    .with_max_iterations(400);
                let full = brief.with_score_every_trial(true);
                let name = estimator.problem().name;
                let mut runs =
                    [brief, full].map(|options| Ransac::new(prepare(), options).unwrap());
                loop {
                    let [brief, full] = runs.each_mut().map(Ransac::step);
                    let (brief, full) = match (brief, full) {
                        (Step::Trial(brief), Step::Trial(full)) => (brief, full),
                        (brief, full) => {
                            assert_eq!(brief, full, "{name}");
                            break;
                        }
                    };
                    assert_eq!(brief.sample, full.sample, "{name}");
                    assert_eq!(brief.num_models, full.num_models, "{name}");
                    assert_eq!(brief.is_best, full.is_best, "{name}");
                    assert_eq!(brief.refined, full.refined, "{name}");
                    assert!(brief.score >= full.score, "{name}: an upper bound");
                    if full.is_best {
                        assert_eq!(brief, full, "{name}");
                    }
                    if let (Some(model), ScoreKind::Msac) = (&full.model, score) {
                        let support = estimator.support(model, 1.0, f64::INFINITY);
                        let num_data = estimator.problem().data.len() as f64;
                        assert_eq!(full.num_inliers, support.num_inliers, "{name}");
                        assert!(
                            (full.score - (num_data - support.cost)).abs() < 1e-9,
                            "{name}"
                        );
                    }
                }
                let [brief, full] = runs.map(|run| run.finish().unwrap());
                assert_eq!(brief, full, "{name}");
            }
        }
    }
    let (p1, p2, k) = matches();
    let set = || MatchSet::new(&p1, &p2).unwrap();
    let camera = Camera::pinhole(k, 640, 480);
    check(|| LineEstimator::new(&p1).unwrap());
    check(|| SimilarityEstimator::new(set()));
    check(|| HomographyEstimator::new(set()).unwrap());
    check(|| FundamentalEstimator::new(set()).unwrap());
    check(|| EssentialEstimator::new(&p1, &p2, [&camera; 2]).unwrap());
}

/// The last refinement may give up inliers for smaller errors, but not where inliers are the score.
#[test]
fn a_count_of_inliers_never_falls_at_the_end() {
    for seed in 0..30 {
        let points = points(200, 100, 0.6, seed);
        let options = RansacOptions::default()
            .with_score(ScoreKind::InlierCount)
            .with_seed(seed);
        let mut run = Ransac::new(LineEstimator::new(&points).unwrap(), options).unwrap();
        while let Step::Trial(_) = run.step() {}
        let (_, best) = run.best().unwrap();
        let report = run.finish().unwrap();
        assert!(
            report.score >= best,
            "{seed}: {} after {best}",
            report.score
        );
        assert_eq!(report.score, report.num_inliers as f64);
    }
}

/// The chance of a fit depends on the location of most data: neither a few outliers far away nor a
/// line along a row of pixels changes it.
#[test]
fn significance_is_judged_by_the_extent_of_most_data() {
    let mut random = Random::new(1);
    let mut anywhere = |num: usize| -> Vec<Point2<f64>> {
        let mut pixel = || Point2::new(random.uniform(0.0, 1000.0), random.uniform(0.0, 1000.0));
        (0..num).map(|_| pixel()).collect()
    };
    for far in [1e5, 1e6, 1e8] {
        let (mut p1, mut p2) = (anywhere(200), anywhere(200));
        p1.push(Point2::new(far, 0.5 * far));
        p2.push(Point2::new(-far, far));
        let options = RansacOptions::default();
        let set = || MatchSet::new(&p1, &p2).unwrap();
        let similarity = ransac(SimilarityEstimator::new(set()), &options, &mut ());
        let homography = ransac(HomographyEstimator::new(set()).unwrap(), &options, &mut ());
        let fundamental = ransac(FundamentalEstimator::new(set()).unwrap(), &options, &mut ());
        assert!(
            similarity.is_ok_and(|report| report.could_be_random()),
            "{far}"
        );
        assert!(
            homography.is_ok_and(|report| report.could_be_random()),
            "{far}"
        );
        assert!(
            fundamental.is_ok_and(|report| report.could_be_random()),
            "{far}"
        );
    }
    let along = [Vector3::x(), Vector3::y(), Vector3::new(0.6, 0.8, 0.0)];
    for direction in along {
        let on_line: Vec<_> = (0..40)
            .map(|i| {
                Point2::from(
                    direction.xy() * (20.0 * f64::from(i)) + Vector3::new(5.0, 9.0, 0.0).xy(),
                )
            })
            .collect();
        let report = fit(&on_line, &RansacOptions::default());
        assert_eq!((report.num_inliers, report.could_be_random()), (40, false));
    }
}
