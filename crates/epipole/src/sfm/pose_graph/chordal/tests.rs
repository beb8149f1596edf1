use super::super::Edge;
use super::*;
use crate::math::random::Random;
use crate::optim::LmOptions;
use nalgebra::Isometry2;

fn random_rotation(random: &mut Random, size: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| size * random.normal()))
}

fn anywhere(random: &mut Random, scale: f64) -> Similarity3<f64> {
    let place = Vector3::from_fn(|_, _| random.uniform(-10.0, 10.0));
    let rotation = random_rotation(random, 2.0);
    Similarity3::from_isometry(
        Isometry3::from_parts(Translation3::from(place), rotation),
        scale,
    )
}

/// A path through these poses with a loop from every fifth to every later fifth, measured with
/// noise; all vertices but the first are arbitrary.
fn graph<T: GraphPose<D>, const D: usize>(
    truth: &[Similarity3<f64>],
    noise: f64,
    random: &mut Random,
) -> Graph<T, D> {
    let mut pairs: Vec<(usize, usize)> = (1..truth.len()).map(|i| (i - 1, i)).collect();
    for i in (0..truth.len()).step_by(5) {
        pairs.extend((i + 5..truth.len()).step_by(5).map(|j| (i, j)));
    }
    let edges = pairs
        .iter()
        .map(|&(from, to)| {
            let exact = T::from_similarity(&(truth[from].inverse() * truth[to]));
            let off = SVector::<f64, D>::from_fn(|_, _| noise * random.normal());
            Edge {
                from,
                to,
                from_from_to: exact.plus(&off),
                information: SMatrix::identity(),
            }
        })
        .collect();
    let mut vertices: Vec<T> = (truth.iter())
        .map(|_| T::from_similarity(&anywhere(random, 1.5)))
        .collect();
    vertices[0] = T::from_similarity(&truth[0]);
    Graph {
        ids: (0..truth.len() as u64).collect(),
        vertices,
        edges,
        fixed: vec![0],
        ..Graph::default()
    }
}

fn apart<T: GraphPose<D>, const D: usize>(graph: &Graph<T, D>, truth: &[Similarity3<f64>]) -> f64 {
    let difference = |(vertex, truth): (&T, &Similarity3<f64>)| {
        let vertex = vertex.to_similarity();
        (vertex.to_homogeneous() - truth.to_homogeneous()).amax()
    };
    graph
        .vertices
        .iter()
        .zip(truth)
        .map(difference)
        .fold(0.0, f64::max)
}

#[test]
fn exact_measurements_are_met_from_anywhere() {
    let mut random = Random::new(1);
    for _ in 0..5 {
        let rigid: Vec<_> = (0..23).map(|_| anywhere(&mut random, 1.0)).collect();
        let mut of_space: Graph<Isometry3<f64>, 6> = graph(&rigid, 0.0, &mut random);
        of_space.initialize(&mut ()).unwrap();
        assert!(
            apart(&of_space, &rigid) < 1e-9,
            "{}",
            apart(&of_space, &rigid)
        );

        let scaled: Vec<_> = (0..23)
            .map(|i| anywhere(&mut random, 0.5 + 0.1 * f64::from(i)))
            .collect();
        let mut of_scale: Graph<Similarity3<f64>, 7> = graph(&scaled, 0.0, &mut random);
        of_scale.initialize(&mut ()).unwrap();
        assert!(
            apart(&of_scale, &scaled) < 1e-8,
            "{}",
            apart(&of_scale, &scaled)
        );

        let flat: Vec<_> = (rigid.iter())
            .map(|pose| Isometry2::<f64>::from_similarity(pose).to_similarity())
            .collect();
        let mut of_plane: Graph<Isometry2<f64>, 3> = graph(&flat, 0.0, &mut random);
        of_plane.initialize(&mut ()).unwrap();
        assert!(
            apart(&of_plane, &flat) < 1e-9,
            "{}",
            apart(&of_plane, &flat)
        );
    }
}

/// Chordal least squares differ from those of the angles, but initialize them well.
#[test]
fn noise_is_shared_and_the_optimum_is_near() {
    let mut random = Random::new(2);
    for _ in 0..10 {
        let truth: Vec<_> = (0..41).map(|_| anywhere(&mut random, 1.0)).collect();
        let mut found: Graph<Isometry3<f64>, 6> = graph(&truth, 0.05, &mut random);
        let mut best = found.clone();
        best.vertices = truth.iter().map(GraphPose::from_similarity).collect();
        let solve = |graph: &mut Graph<Isometry3<f64>, 6>| {
            graph
                .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
                .unwrap()
        };
        let least = solve(&mut best).final_chi2;
        let anywhere = found.chi2();
        found.initialize(&mut ()).unwrap();
        let report = solve(&mut found);
        assert!(
            report.initial_chi2 < 1e-3 * anywhere,
            "{report:?}, {anywhere}"
        );
        assert!(report.iterations <= 8, "{report:?}");
        assert!(
            (report.final_chi2 - least).abs() < 1e-6 * least,
            "{report:?}, {least}"
        );
    }
}

#[test]
fn vertices_without_measurements_are_reported() {
    let mut random = Random::new(3);
    let truth: Vec<_> = (0..6).map(|_| anywhere(&mut random, 1.0)).collect();
    let mut open: Graph<Isometry3<f64>, 6> = graph(&truth, 0.0, &mut random);
    for edge in &mut open.edges {
        if edge.to == 4 || edge.from == 4 {
            edge.information = SMatrix::zeros();
        }
    }
    let before = open.clone();
    let error = open.initialize(&mut ()).unwrap_err();
    assert!(error.to_string().contains("without weight"), "{error}");
    assert_eq!(open, before);
    // Two parts, each with a fixed vertex.
    let mut parts: Graph<Isometry3<f64>, 6> = graph(&truth, 0.0, &mut random);
    parts.edges.retain(|edge| (edge.from < 3) == (edge.to < 3));
    let stays = parts.vertices[3];
    parts.initialize(&mut ()).unwrap();
    assert!(parts.chi2() < 1e-18 && parts.vertices[3] == stays);
    assert!(
        Graph::<Isometry2<f64>, 3>::default()
            .initialize(&mut ())
            .is_err()
    );
}

#[test]
fn rotations_are_averaged_though_some_are_wrong() {
    let mut random = Random::new(4);
    let truth: Vec<_> = (0..30).map(|_| random_rotation(&mut random, 1.0)).collect();
    let mut measured = Vec::new();
    for from in 0..truth.len() {
        for to in from + 1..truth.len() {
            if random.below(3) == 0 || to == from + 1 {
                let exact = truth[to] * truth[from].inverse();
                let wrong = to > from + 1 && random.below(10) == 0;
                let off = random_rotation(&mut random, if wrong { 1.0 } else { 0.005 });
                measured.push((
                    RelativeRotation {
                        from,
                        to,
                        to_from_from: off * exact,
                    },
                    wrong,
                ));
            }
        }
    }
    let list: Vec<_> = measured.iter().map(|(m, _)| *m).collect();
    let loss = RobustLoss::Cauchy { width: 0.01 };
    let (views, errors_rad) = average_rotations(truth.len(), &list, loss, &mut ()).unwrap();
    for (view, truth_of_view) in views.iter().zip(&truth) {
        let off = (view * views[0].inverse()).angle_to(&(truth_of_view * truth[0].inverse()));
        assert!(off < 0.01, "{off}");
    }
    for ((_, wrong), error) in measured.iter().zip(&errors_rad) {
        assert!(*wrong || *error < 0.05, "{error}");
    }
    assert!(average_rotations(3, &[], loss, &mut ()).is_err());
    assert!(average_rotations(1, &list, loss, &mut ()).is_err());
}
