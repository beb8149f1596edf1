//! Loop closing: a revisited place reveals the drift of the path, including that of the scale.

use super::alignment::{AlignmentKind, align_points};
use super::pose_graph::{Edge, Graph, GraphPose, PoseGraphReport};
use crate::camera::RigidTransform;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::{Error, Result};
use nalgebra::{Point3, SMatrix, Similarity3};

/// Motion between two frames that show the same place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopClosure {
    /// Index of the earlier frame.
    pub from: usize,
    /// Index of the later frame.
    pub to: usize,
    /// Pose of the later camera in the frame of the earlier one, with the ratio of their scales:
    /// points that both reconstructed satisfy `x_in_from = from_from_to * x_in_to`.
    pub from_from_to: Similarity3<f64>,
    /// Weight relative to one step of odometry.
    pub weight: f64,
}

/// A path after its loops are closed.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedPath {
    /// `world_from_cam` of each frame, in the unit of the first one.
    pub world_from_cam: Vec<RigidTransform>,
    /// Factor for lengths around each frame.
    pub scale: Vec<f64>,
    /// Report of the optimization.
    pub report: PoseGraphReport,
}

/// Estimates the similarity between two reconstructions of the same points from matches with
/// outliers. Also returns the inliers: `to_from_from * from[i]` is within `max_distance` of
/// `to[i]`.
///
/// Samples of three points are aligned; the similarity with the most inliers is refitted to them.
/// Pairs with an infinite coordinate are outliers.
///
/// * `max_distance`: inlier threshold in the unit of `to`, > 0
/// * `seed`: equal seeds give equal results
///
/// # Errors
/// As [`align_points`]; [`Error::OutOfRange`] for a distance ≤ 0, [`Error::NoConsensus`] if fewer
/// than four points agree.
///
/// Source: Horn 1987 and Umeyama 1991 on samples; Mur-Artal, Montiel & Tardós 2015, "ORB-SLAM",
/// §VII (its use for loops).
pub fn estimate_similarity_of_points(
    from: &[Point3<f64>],
    to: &[Point3<f64>],
    max_distance: f64,
    seed: u64,
) -> Result<(Similarity3<f64>, Vec<bool>)> {
    if !(max_distance > 0.0 && max_distance.is_finite()) {
        return Err(Error::OutOfRange {
            what: "the largest distance of matched points",
            requirement: "greater than 0 and finite",
            value: max_distance,
        });
    }
    if from.len() != to.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matched points",
            first: from.len(),
            second: to.len(),
        });
    }
    let is_usable: Vec<bool> = (from.iter().zip(to))
        .map(|(a, b)| !a.iter().chain(b.iter()).any(|x| x.is_infinite()))
        .collect();
    let usable = |list: &[Point3<f64>]| -> Vec<Point3<f64>> {
        let selected = list.iter().zip(&is_usable).filter(|(_, is)| **is);
        selected.map(|(point, _)| *point).collect()
    };
    let (usable_from, usable_to) = (usable(from), usable(to));
    let estimator = SimilarityOfPoints::new(&usable_from, &usable_to)?;
    let options = crate::robust::RansacOptions {
        max_error_px: max_distance,
        seed,
        ..crate::robust::RansacOptions::default()
    };
    let report = crate::robust::ransac(estimator, &options, &mut ())?;
    if report.num_inliers < 4 {
        return Err(Error::NoConsensus {
            needed: 4,
            got: from.len(),
            iterations: report.iterations,
        });
    }
    let mut fits = report.inliers.into_iter();
    let inliers = (is_usable.iter())
        .map(|is_usable| *is_usable && fits.next().unwrap_or(false))
        .collect();
    Ok((report.model, inliers))
}

struct SimilarityOfPoints<'a> {
    from: &'a [Point3<f64>],
    to: &'a [Point3<f64>],
}

impl<'a> SimilarityOfPoints<'a> {
    fn new(from: &'a [Point3<f64>], to: &'a [Point3<f64>]) -> Result<Self> {
        // The alignment of all points reports invalid lists.
        align_points(from, to, AlignmentKind::Similarity).or_else(|error| match error {
            Error::Degenerate { .. } => Ok(Similarity3::identity()),
            other => Err(other),
        })?;
        Ok(Self { from, to })
    }

    fn fit(&self, chosen: &[usize]) -> Option<Similarity3<f64>> {
        let pick = |list: &[Point3<f64>]| chosen.iter().map(|&i| list[i]).collect::<Vec<_>>();
        align_points(&pick(self.from), &pick(self.to), AlignmentKind::Similarity).ok()
    }
}

impl crate::robust::Estimator for SimilarityOfPoints<'_> {
    type Model = Similarity3<f64>;

    fn problem(&self) -> crate::robust::Problem<'_> {
        crate::robust::Problem {
            name: "a similarity from matched points",
            sample_size: 3,
            max_models: 1,
            codimension: 1,
            data: crate::robust::Data::Other(self.from.len()),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Similarity3<f64>>) {
        models.extend(self.fit(sample));
    }
    fn error_sq(&self, model: &Similarity3<f64>, index: usize) -> f64 {
        (model * self.from[index] - self.to[index]).norm_squared()
    }
    fn refine(
        &mut self,
        _: &Similarity3<f64>,
        inliers: &[usize],
        _: f64,
    ) -> Option<Similarity3<f64>> {
        self.fit(inliers)
    }
}

/// Degrees of freedom of the frames of a path when a loop is closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum LoopMotion {
    /// Position and orientation, SE(3), if the scale is measured, as by a stereo rig.
    Rigid,
    /// Position, orientation and scale, Sim(3), for a single moving camera.
    #[default]
    Similarity,
}

/// Spreads the error of closed loops over a path with a pose graph: each step of the path is an
/// edge, each loop another.
///
/// * `world_from_cam`: the path, frame by frame
/// * `loops`: pairs of frames at the same place, with their motion
/// * `motion`: free components; [`LoopMotion::Rigid`] leaves every scale at 1 and ignores the
///   scales of the loops
/// * `loss`: robust to wrong loops; width in standard deviations of a step
/// * `monitor`: as in [`Graph::optimize`]
///
/// The first frame is fixed. Translations are weighted relative to the mean step length.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two frames or no loop, and as [`Graph::optimize`].
///
/// Source: Strasdat, Montiel & Davison 2010, "Scale drift-aware large scale monocular SLAM".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::optim::RobustLoss;
/// use epipole::sfm::{LoopClosure, LoopMotion, close_loops};
/// use nalgebra::{Similarity3, Vector3};
/// // Two steps straight ahead; the second seems twice as long as the first.
/// let path = [0.0, 1.0, 3.0].map(|z| RigidTransform::translation(0.0, 0.0, z));
/// // The last frame is really 2 ahead of the first, and its reconstruction is 4 times too large.
/// let closure = LoopClosure {
///     from: 0,
///     to: 2,
///     from_from_to: Similarity3::new(Vector3::new(0.0, 0.0, 2.0), Vector3::zeros(), 0.25),
///     weight: 1e6,
/// };
/// let close = |motion| {
///     close_loops(&path, &[closure], motion, RobustLoss::Trivial, &mut ())
/// };
/// // Rigid motions shorten both steps by the same length, similarities halve the scale twice.
/// for (motion, z, scale) in [
///     (LoopMotion::Rigid, [0.0, 0.5, 2.0], [1.0, 1.0, 1.0]),
///     (LoopMotion::Similarity, [0.0, 1.0, 2.0], [1.0, 0.5, 0.25]),
/// ] {
///     let closed = close(motion)?;
///     for i in 0..3 {
///         assert!((closed.world_from_cam[i].translation.z - z[i]).abs() < 1e-5);
///         assert!((closed.scale[i] - scale[i]).abs() < 1e-5);
///     }
/// }
/// # Ok(()) }
/// ```
pub fn close_loops(
    world_from_cam: &[RigidTransform],
    loops: &[LoopClosure],
    motion: LoopMotion,
    loss: RobustLoss,
    monitor: &mut dyn Monitor,
) -> Result<ClosedPath> {
    for (what, needed, got) in [
        (
            "closing the loops of a path of frames",
            2,
            world_from_cam.len(),
        ),
        ("closing the loops of a path from loops", 1, loops.len()),
    ] {
        if got < needed {
            return Err(Error::TooFew { what, needed, got });
        }
    }
    if let Some(bad) = loops
        .iter()
        .find(|l| !(l.weight > 0.0 && l.weight.is_finite()))
    {
        return Err(Error::OutOfRange {
            what: "the weight of a loop",
            requirement: "greater than 0 and finite",
            value: bad.weight,
        });
    }
    match motion {
        LoopMotion::Rigid => {
            let mut graph = graph_of_path(world_from_cam, loops, |pose| pose.isometry);
            let report = optimize(&mut graph, loss, monitor)?;
            Ok(ClosedPath {
                scale: vec![1.0; graph.vertices.len()],
                world_from_cam: graph.vertices,
                report,
            })
        }
        LoopMotion::Similarity => {
            let mut graph = graph_of_path(world_from_cam, loops, |pose| pose);
            let report = optimize(&mut graph, loss, monitor)?;
            let (world_from_cam, scale) = (graph.vertices.iter())
                .map(|vertex| (vertex.isometry, vertex.scaling()))
                .unzip();
            Ok(ClosedPath {
                world_from_cam,
                scale,
                report,
            })
        }
    }
}

/// Builds the graph whose vertices are the frames; `vertex` makes a graph pose from one with a
/// scale.
fn graph_of_path<T: GraphPose<D>, const D: usize>(
    world_from_cam: &[RigidTransform],
    loops: &[LoopClosure],
    vertex: impl Fn(Similarity3<f64>) -> T,
) -> Graph<T, D> {
    let unscaled = |pose: &RigidTransform| vertex(Similarity3::from_isometry(*pose, 1.0));
    let steps: Vec<RigidTransform> = world_from_cam
        .windows(2)
        .map(|pair| pair[0].inv_mul(&pair[1]))
        .collect();
    let mean_step = steps
        .iter()
        .map(|s| s.translation.vector.norm())
        .sum::<f64>()
        / steps.len() as f64;
    let mut information = SMatrix::<f64, D, D>::identity();
    if mean_step > 0.0 {
        for i in 0..3 {
            information[(i, i)] = 1.0 / (mean_step * mean_step);
        }
    }
    let steps = steps.iter().enumerate().map(|(i, step)| Edge {
        from: i,
        to: i + 1,
        from_from_to: unscaled(step),
        information,
    });
    let closures = loops.iter().map(|l| Edge {
        from: l.from,
        to: l.to,
        from_from_to: vertex(l.from_from_to),
        information: information * l.weight,
    });
    Graph {
        ids: (0..world_from_cam.len() as u64).collect(),
        vertices: world_from_cam.iter().map(unscaled).collect(),
        edges: steps.chain(closures).collect(),
        fixed: vec![0],
        ..Graph::default()
    }
}

fn optimize<T: GraphPose<D>, const D: usize>(
    graph: &mut Graph<T, D>,
    loss: RobustLoss,
    monitor: &mut dyn Monitor,
) -> Result<PoseGraphReport> {
    let options = LmOptions {
        max_iterations: 100,
        ..LmOptions::default()
    };
    graph.optimize(&options, loss, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Vector3;

    /// A round trip whose scale grows by the factor `growth` per step and whose heading drifts.
    fn drifted(count: usize, growth: f64) -> (Vec<RigidTransform>, Vec<RigidTransform>) {
        let angle_rad = std::f64::consts::TAU / count as f64;
        let mut truth = vec![RigidTransform::identity()];
        let mut path = truth.clone();
        let mut length = 1.0;
        for i in 1..count {
            let step = |length: f64, angle_rad: f64| {
                RigidTransform::new(
                    Vector3::new(0.0, 0.0, length),
                    Vector3::new(0.0, angle_rad, 0.0),
                )
            };
            truth.push(truth[i - 1] * step(1.0, angle_rad));
            path.push(path[i - 1] * step(length, angle_rad * 1.01));
            length *= growth;
        }
        (truth, path)
    }

    fn mean_error(path: &[RigidTransform], truth: &[RigidTransform]) -> f64 {
        let apart = |(a, b): (&RigidTransform, &RigidTransform)| {
            (a.translation.vector - b.translation.vector).norm()
        };
        path.iter().zip(truth).map(apart).sum::<f64>() / truth.len() as f64
    }

    /// Closes the loop between the first frame and the last, which is `drift` times too large.
    fn close(
        path: &[RigidTransform],
        truth: &[RigidTransform],
        drift: f64,
        motion: LoopMotion,
    ) -> ClosedPath {
        let last = truth.len() - 1;
        let closure = LoopClosure {
            from: 0,
            to: last,
            from_from_to: Similarity3::from_isometry(truth[last], 1.0 / drift),
            weight: 1e4,
        };
        close_loops(path, &[closure], motion, RobustLoss::Trivial, &mut ()).unwrap()
    }

    #[test]
    fn a_round_trip_that_drifts_in_scale_is_closed_by_similarities() {
        let count = 40;
        let (truth, path) = drifted(count, 1.01);
        let last = count - 1;
        // The last frame's reconstruction is larger than the first one's.
        let drift = 1.01f64.sqrt() * (1..last).fold(1.0, |s, _| s * 1.01);
        let similar = close(&path, &truth, drift, LoopMotion::Similarity);
        let rigid = close(&path, &truth, drift, LoopMotion::Rigid);
        let before = mean_error(&path, &truth);
        let [rigid_error, similar_error] =
            [&rigid, &similar].map(|closed| mean_error(&closed.world_from_cam, &truth));
        assert!(similar_error < 0.2 * before, "{before} to {similar_error}");
        assert!(
            (similar.scale[last] * drift - 1.0).abs() < 0.01,
            "{:?}",
            similar.scale
        );
        // The ends meet here as well, but the lengths in between stay wrong.
        assert!(
            rigid_error > 3.0 * similar_error,
            "{rigid_error}, {similar_error}"
        );
        assert_eq!(rigid.scale, vec![1.0; count]);
        for closed in [rigid, similar] {
            let gap =
                closed.world_from_cam[last].translation.vector - truth[last].translation.vector;
            assert!(gap.norm() < 0.01, "{gap}");
            assert_eq!(closed.world_from_cam[0], path[0]);
        }
    }

    #[test]
    fn a_round_trip_that_drifts_only_in_heading_is_closed_by_both() {
        let (truth, path) = drifted(40, 1.0);
        let before = mean_error(&path, &truth);
        for motion in [LoopMotion::Rigid, LoopMotion::Similarity] {
            let closed = close(&path, &truth, 1.0, motion);
            let after = mean_error(&closed.world_from_cam, &truth);
            assert!(after < 0.05 * before, "{motion:?}: {before} to {after}");
            for scale in closed.scale {
                assert!((scale - 1.0).abs() < 0.01, "{motion:?}: {scale}");
            }
        }
    }

    #[test]
    fn wrong_matches_do_not_spoil_the_similarity() {
        let mut random = Random::new(61);
        let truth = Similarity3::new(
            Vector3::new(1.0, 2.0, 3.0),
            Vector3::new(0.3, 0.2, 0.1),
            1.7,
        );
        let from: Vec<Point3<f64>> = (0..60)
            .map(|_| Point3::from(Vector3::from_fn(|_, _| random.normal())))
            .collect();
        let mut to: Vec<Point3<f64>> = from.iter().map(|p| truth * p).collect();
        for point in to.iter_mut().step_by(3) {
            *point += Vector3::from_fn(|_, _| 3.0 * random.normal());
        }
        let (found, inliers) = estimate_similarity_of_points(&from, &to, 0.05, 1).unwrap();
        assert!((found.scaling() - 1.7).abs() < 1e-9);
        assert_eq!(inliers.iter().filter(|inlier| **inlier).count(), 40);
        // An infinite pair is ignored at any index; NaN is rejected.
        let (mut far_from, mut far_to) = (from.clone(), to.clone());
        far_from.insert(1, Point3::new(f64::INFINITY, 0.0, 1.0));
        far_to.insert(1, Point3::origin());
        let (same, fits) = estimate_similarity_of_points(&far_from, &far_to, 0.05, 1).unwrap();
        let mut expected = inliers.clone();
        expected.insert(1, false);
        assert_eq!((same, fits), (found, expected));
        far_to[0].x = f64::NAN;
        assert!(estimate_similarity_of_points(&far_from, &far_to, 0.05, 1).is_err());
        assert!(estimate_similarity_of_points(&from, &to[1..], 0.05, 1).is_err());
        assert!(estimate_similarity_of_points(&from, &to, 0.0, 1).is_err());
        assert!(estimate_similarity_of_points(&from[..2], &to[..2], 0.1, 1).is_err());
    }

    #[test]
    fn bad_loops_are_refused() {
        let (truth, _) = drifted(6, 1.01);
        let good = LoopClosure {
            from: 0,
            to: 5,
            from_from_to: Similarity3::identity(),
            weight: 1.0,
        };
        let attempt = |loops: &[LoopClosure]| {
            let motion = LoopMotion::Similarity;
            close_loops(&truth, loops, motion, RobustLoss::Trivial, &mut ())
        };
        assert!(attempt(&[good]).is_ok());
        assert!(matches!(attempt(&[]), Err(Error::TooFew { .. })));
        let bad = LoopClosure { to: 6, ..good };
        assert!(matches!(attempt(&[bad]), Err(Error::OutOfRange { .. })));
        let bad = LoopClosure {
            weight: f64::NAN,
            ..good
        };
        assert!(matches!(attempt(&[bad]), Err(Error::OutOfRange { .. })));
    }
}
