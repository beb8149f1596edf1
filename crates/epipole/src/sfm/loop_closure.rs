//! Closing loops: what a camera sees again tells how far its path has drifted, in scale too.

use super::alignment::{AlignmentKind, align_points};
use super::pose_graph::{Edge, Graph, PoseGraphReport};
use crate::camera::RigidTransform;
use crate::optim::{Iteration, LmOptions, RobustLoss};
use crate::{Error, Result};
use nalgebra::{Point3, SMatrix, Similarity3};
use std::ops::ControlFlow;

/// A frame that shows again what an earlier one showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopClosure {
    /// Index of the earlier frame.
    pub from: usize,
    /// Index of the later frame.
    pub to: usize,
    /// The later camera in the frame of the earlier one, with the ratio of their scales: points
    /// that both reconstructed obey `x_in_from = from_from_to * x_in_to`.
    pub from_from_to: Similarity3<f64>,
    /// How much it weighs beside one step of odometry.
    pub weight: f64,
}

/// A path after its loops were closed.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedPath {
    /// `world_from_cam` of each frame, in the unit of the first one.
    pub world_from_cam: Vec<RigidTransform>,
    /// By how much lengths around each frame have to be multiplied.
    pub scale: Vec<f64>,
    /// How the optimization went.
    pub report: PoseGraphReport,
}

/// The similarity between two reconstructions of the same points, some of which are matched
/// wrongly, and which agree: `to_from_from * from[i]` is within `max_distance` of `to[i]`.
///
/// Samples of three points are aligned; the similarity that most points agree with is fitted to
/// them again.
///
/// * `max_distance`: in the unit of `to`, > 0
/// * `seed`: equal seeds give equal results
///
/// # Errors
/// As [`align_points`]; [`Error::OutOfRange`] for a distance ≤ 0, [`Error::NoConsensus`] if fewer
/// than four points agree.
///
/// Source: Horn 1987 and Umeyama 1991 on samples; Mur-Artal, Montiel & Tardós 2015, "ORB-SLAM",
/// §VII (its use for loops).
pub fn find_similarity_of_points(
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
    let estimator = SimilarityOfPoints::new(from, to)?;
    let options = crate::robust::RansacOptions {
        max_error_px: max_distance,
        seed,
        ..crate::robust::RansacOptions::default()
    };
    let report = crate::robust::ransac(estimator, &options)?;
    if report.num_inliers < 4 {
        return Err(Error::NoConsensus {
            needed: 4,
            got: from.len(),
            iterations: report.iterations,
        });
    }
    Ok((report.model, report.inliers))
}

struct SimilarityOfPoints<'a> {
    from: &'a [Point3<f64>],
    to: &'a [Point3<f64>],
}

impl<'a> SimilarityOfPoints<'a> {
    fn new(from: &'a [Point3<f64>], to: &'a [Point3<f64>]) -> Result<Self> {
        // The alignment of all finds what is wrong with the lists.
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

    fn name(&self) -> &'static str {
        "a similarity from matched points"
    }
    fn sample_size(&self) -> usize {
        3
    }
    fn num_data(&self) -> usize {
        self.from.len()
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

/// Spreads the error of closed loops over a path, by a graph of similarities: each step of the
/// path is one edge, each loop another.
///
/// * `world_from_cam`: the path, frame after frame
/// * `loops`: which frames meet again, and how
/// * `loss`: robust to wrong loops; its width is in standard deviations of a step
/// * `observer`: as in [`Graph::optimize`]
///
/// The first frame stays. Translations count relative to the mean length of a step.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two frames or no loop, and as [`Graph::optimize`].
///
/// Source: Strasdat, Montiel & Davison 2010, "Scale drift-aware large scale monocular SLAM".
pub fn close_loops(
    world_from_cam: &[RigidTransform],
    loops: &[LoopClosure],
    loss: RobustLoss,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
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
    let steps: Vec<RigidTransform> = world_from_cam
        .windows(2)
        .map(|pair| pair[0].inv_mul(&pair[1]))
        .collect();
    let mean_step = steps
        .iter()
        .map(|s| s.translation.vector.norm())
        .sum::<f64>()
        / steps.len() as f64;
    let mut information = SMatrix::<f64, 7, 7>::identity();
    if mean_step > 0.0 {
        for i in 0..3 {
            information[(i, i)] = 1.0 / (mean_step * mean_step);
        }
    }
    let mut graph = Graph::<Similarity3<f64>, 7> {
        ids: (0..world_from_cam.len() as u64).collect(),
        vertices: world_from_cam
            .iter()
            .map(|pose| Similarity3::from_isometry(*pose, 1.0))
            .collect(),
        edges: steps
            .iter()
            .enumerate()
            .map(|(i, step)| Edge {
                from: i,
                to: i + 1,
                from_from_to: Similarity3::from_isometry(*step, 1.0),
                information,
            })
            .collect(),
        fixed: vec![0],
    };
    for l in loops {
        graph.edges.push(Edge {
            from: l.from,
            to: l.to,
            from_from_to: l.from_from_to,
            information: information * l.weight,
        });
    }
    let options = LmOptions {
        max_iterations: 100,
        ..LmOptions::default()
    };
    let report = graph.optimize(&options, loss, observer)?;
    Ok(ClosedPath {
        world_from_cam: graph
            .vertices
            .iter()
            .map(|vertex| vertex.isometry)
            .collect(),
        scale: graph.vertices.iter().map(Similarity3::scaling).collect(),
        report,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Vector3;

    fn go_on(_: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// A round trip whose scale grows by 1 % a step and whose heading drifts.
    fn drifted(count: usize) -> (Vec<RigidTransform>, Vec<RigidTransform>) {
        let turn = std::f64::consts::TAU / count as f64;
        let mut truth = vec![RigidTransform::identity()];
        let mut path = truth.clone();
        let mut length = 1.0;
        for i in 1..count {
            let step = |length: f64, turn: f64| {
                RigidTransform::new(Vector3::new(0.0, 0.0, length), Vector3::new(0.0, turn, 0.0))
            };
            truth.push(truth[i - 1] * step(1.0, turn));
            path.push(path[i - 1] * step(length, turn * 1.01));
            length *= 1.01;
        }
        (truth, path)
    }

    #[test]
    fn a_drifted_round_trip_is_closed() {
        let count = 40;
        let (truth, path) = drifted(count);
        let last = count - 1;
        // What the last frame reconstructs is larger than what the first one does.
        let drift = 1.01f64.sqrt() * (1..count - 1).fold(1.0, |s, _| s * 1.01);
        let closure = LoopClosure {
            from: 0,
            to: last,
            from_from_to: Similarity3::from_isometry(truth[last], 1.0 / drift),
            weight: 1e4,
        };
        let closed = close_loops(&path, &[closure], RobustLoss::Trivial, &mut go_on).unwrap();
        let mean_error = |path: &[RigidTransform]| {
            let apart = |(a, b): (&RigidTransform, &RigidTransform)| {
                (a.translation.vector - b.translation.vector).norm()
            };
            path.iter().zip(&truth).map(apart).sum::<f64>() / count as f64
        };
        let (before, after) = (mean_error(&path), mean_error(&closed.world_from_cam));
        assert!(after < 0.2 * before, "{before} to {after}");
        assert!(
            (closed.scale[last] * drift - 1.0).abs() < 0.01,
            "{:?}",
            closed.scale
        );
        assert_eq!(closed.world_from_cam[0], path[0]);
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
        let (found, inliers) = find_similarity_of_points(&from, &to, 0.05, 1).unwrap();
        assert!((found.scaling() - 1.7).abs() < 1e-9);
        assert_eq!(inliers.iter().filter(|inlier| **inlier).count(), 40);
        assert!(find_similarity_of_points(&from, &to, 0.0, 1).is_err());
        assert!(find_similarity_of_points(&from[..2], &to[..2], 0.1, 1).is_err());
    }

    #[test]
    fn bad_loops_are_refused() {
        let (truth, _) = drifted(6);
        let good = LoopClosure {
            from: 0,
            to: 5,
            from_from_to: Similarity3::identity(),
            weight: 1.0,
        };
        let attempt =
            |loops: &[LoopClosure]| close_loops(&truth, loops, RobustLoss::Trivial, &mut go_on);
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
