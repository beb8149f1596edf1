//! Tests of the format g2o.

use super::*;
use epipole::optim::{LmOptions, RobustLoss};
use epipole::sfm::{Edge, Graph, GraphPose};
use nalgebra::{SMatrix, Translation3, UnitQuaternion, Vector3};

const SE2: &str =
    "VERTEX_SE2 5 0 0 0\nVERTEX_SE2 9 1.5 0 0.25\nFIX 5\nEDGE_SE2 5 9 1 0 0 4 0.5 0 3 0 2\n";
const SE3: &str = "# comment\n\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 3 0 0 0 -2\nEDGE_SE3:QUAT 0 1 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";

#[test]
fn what_is_written_is_read_back() {
    for text in [SE2, SE3] {
        let graph = read_g2o(text).unwrap().graph;
        let again = read_g2o(&write_g2o(&graph)).unwrap().graph;
        assert_eq!(graph.size(), again.size());
        assert!((graph.chi2() - again.chi2()).abs() < 1e-15);
    }
    let PoseGraph::Se2(graph) = read_g2o(SE2).unwrap().graph else {
        panic!("a planar graph");
    };
    assert_eq!((graph.ids, graph.fixed), (vec![5, 9], vec![0]));
    assert_eq!(graph.edges[0].information[(1, 0)], 0.5);
    let PoseGraph::Se3(graph) = read_g2o(SE3).unwrap().graph else {
        panic!("a spatial graph");
    };
    assert!(graph.chi2() < 1e-15);
}

#[test]
fn quaternions_may_be_as_long_as_numbers_are() {
    let text = "VERTEX_SE3:QUAT 0 0 0 0 0 0 1.5e300 -1.5e300\n";
    let PoseGraph::Se3(graph) = read_g2o(text).unwrap().graph else {
        panic!("a spatial graph");
    };
    let rotation = graph.vertices[0].rotation;
    assert!((rotation.angle() - core::f64::consts::FRAC_PI_2).abs() < 1e-12);
    let text = write_g2o(&PoseGraph::Se3(graph));
    assert!(read_g2o(&text).is_ok(), "{text}");
}

#[test]
fn similarities_have_their_own_tags() {
    let mut graph = Graph::<Similarity3<f64>, 7> {
        ids: vec![0, 1],
        vertices: vec![Similarity3::identity(); 2],
        edges: Vec::new(),
        ..Graph::default()
    };
    graph.vertices[1] = Similarity3::from_isometry(Isometry3::translation(1.0, 2.0, 3.0), 2.0);
    graph.edges.push(Edge {
        from: 0,
        to: 1,
        from_from_to: graph.vertices[1],
        information: SMatrix::identity(),
    });
    let text = write_g2o(&PoseGraph::Sim3(graph.clone()));
    assert_eq!(read_g2o(&text).unwrap().graph, PoseGraph::Sim3(graph));
    assert!(read_g2o("VERTEX_SIM3:QUAT 0 0 0 0 0 0 0 1 -2\n").is_err());
}

#[test]
fn malformed_texts_name_the_line() {
    for (bad, line, why) in [
        ("VERTEX_SE2 0 0 0\n", 1, "needs 4"),
        ("VERTEX_SE2 0 0 0 inf\n", 1, "finite"),
        ("VERTEX_SE2 -1 0 0 0\n", 1, "number of a vertex"),
        ("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 0 0 0\n", 2, "twice"),
        (
            "VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n",
            2,
            "another kind",
        ),
        ("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0\n", 1, "zero"),
        ("SOMETHING 1 2\n", 1, "not known"),
        ("VERTEX_XY x 2 3\n", 1, "number of a vertex"),
        (
            "EDGE_SE3_TILT_PRIOR 1 0 1\n",
            1,
            "prior “EDGE_SE3_TILT_PRIOR” is not known",
        ),
        (
            "EDGE_PRIOR_SE2 1 0 0 0 1\n",
            1,
            "needs 10 values, but has 5",
        ),
        ("PARAMS_SE3OFFSET 0 0 0 0 0 0 1\n", 1, "needs 8 values"),
        ("VERTEX3 1 0 0 0 0 0 0\n", 1, "TORO"),
        (
            "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\nEDGE_SE3_XYZ_PRIOR 2 0 5 0 0 1 0 0 1 0 1\n",
            2,
            "no vertex 2",
        ),
        (
            "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\nEDGE_SE3_PRIOR 1 7 5 0 0 0 0 0 1 \
             1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
            2,
            "no line PARAMS_SE3OFFSET 7",
        ),
        (
            "PARAMS_SE3OFFSET 3 0.5 0 0 0 0.6 0 0\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n\
             VERTEX_TRACKXYZ 1 4 -5 6\nEDGE_SE3_TRACKXYZ 0 1 3 0.1 0.2 -1e308 2 0.5 0.25 3 1 5\n",
            4,
            "too large to shift it by the offset",
        ),
        ("VERTEX_SE2 0 0,5 0 0\n", 1, "“0,5” has a decimal comma"),
        (
            "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 7 1 0 0 4 0 0 4 0 4\n",
            2,
            "no vertex 7",
        ),
        (
            "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 1 0 0 4 0 0 4 0 4\n",
            2,
            "itself",
        ),
        (
            "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 4 9 0 4 0 4\n",
            2,
            "semi-definite",
        ),
        ("VERTEX_SE2 0 0 0 0\nFIX 3\n", 2, "no vertex 3"),
    ] {
        match read_g2o(bad) {
            Err(Error::Malformed {
                line: got,
                message: text,
            }) => {
                assert_eq!(got, Some(line), "{bad:?}");
                assert!(text.contains(why), "{text}");
            }
            other => panic!("{bad:?} gave {other:?}"),
        }
    }
    assert!(matches!(
        read_g2o("\n"),
        Err(Error::Invalid(epipole::Error::TooFew { .. }))
    ));
}

/// Returns the numbers of a pose, then an identity as upper triangle.
fn pose_words(pose: &Isometry3<f64>) -> String {
    let (t, q) = (pose.translation.vector, pose.rotation);
    format!("{} {} {} {} {} {} {}", t.x, t.y, t.z, q.i, q.j, q.k, q.w)
}

#[test]
fn a_prior_is_that_of_a_sensor_at_its_offset() {
    let pose = |t: [f64; 3], r: [f64; 3]| {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(r));
        Isometry3::from_parts(Translation3::from(t), rotation)
    };
    let vertex = pose([1.0, 2.0, 3.0], [0.3, -0.2, 0.5]);
    let mut information =
        SMatrix::<f64, 6, 6>::from_diagonal(&[4.0, 9.0, 1.0, 25.0, 16.0, 36.0].into());
    information[(0, 4)] = 2.0;
    information[(4, 0)] = 2.0;
    let mut upper = String::new();
    for i in 0..6 {
        for j in i..6 {
            upper += &format!(" {}", information[(i, j)]);
        }
    }
    for (offset, tolerance) in [
        (pose([0.0; 3], [0.0; 3]), 1e-9),
        (pose([0.0; 3], [0.7, 0.1, -1.1]), 1e-9),
        (pose([0.5, -0.3, 0.8], [0.7, 0.1, -1.1]), 2e-3),
    ] {
        // The error is defined as in g2o: of the sensor, in the measured frame.
        let error = pose([2e-3, -1e-3, 3e-3], [1e-3, 4e-3, -2e-3]);
        let measured = vertex * offset * error.inverse();
        let terms = <Isometry3<f64> as GraphPose<6>>::error(
            &measured,
            &(vertex * offset),
            &Isometry3::identity(),
        );
        let expected = terms.dot(&(information * terms));
        let text = format!(
            "EDGE_SE3_PRIOR 4 1 {}{upper}\nPARAMS_SE3OFFSET 1 {}\nVERTEX_SE3:QUAT 4 {}\n",
            pose_words(&measured),
            pose_words(&offset),
            pose_words(&vertex)
        );
        let graph = read_g2o(&text).unwrap().graph;
        assert_eq!(graph.num_priors(), 1);
        assert!(
            (graph.chi2() / expected - 1.0).abs() < tolerance,
            "{}",
            graph.chi2() / expected
        );
        let again = read_g2o(&write_g2o(&graph)).unwrap().graph;
        assert!((again.chi2() / graph.chi2() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn positions_and_poses_hold_a_graph_in_the_plane() {
    // Two poses 1 apart; the first is at (5, 5) and faces up.
    let text = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n\
                EDGE_PRIOR_SE2_XY 0 5 5 4 0 4\nEDGE_PRIOR_SE2 1 5 6 1.5707963267948966 9 0 0 9 0 9\n";
    let mut graph = read_g2o(text).unwrap().graph;
    assert_eq!((graph.size(), graph.num_priors()), ((2, 1), 2));
    // Of the edge 1, of the position 4 · 50, of the pose 9 · (5² + 6² + (π/2)²).
    let quarter_rad = core::f64::consts::FRAC_PI_2;
    let chi2 = 1.0 + 200.0 + 9.0 * (61.0 + quarter_rad * quarter_rad);
    assert!((graph.chi2() - chi2).abs() < 1e-9, "{}", graph.chi2());
    graph
        .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
        .unwrap();
    assert!(graph.chi2() < 1e-12);
    let again = read_g2o(&write_g2o(&graph)).unwrap().graph;
    assert_eq!((again.size(), again.num_priors()), ((2, 1), 2));
    assert!(again.chi2() < 1e-12);
}

#[test]
fn landmarks_are_read_written_and_optimized() {
    let text = "VERTEX_XY 2 4 4\nVERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nFIX 0\n\
                EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 2 3 4 2 1 5\n\
                EDGE_SE2_XY 1 2 2 4 1 0 1\n";
    let mut graph = read_g2o(text).unwrap().graph;
    assert_eq!((graph.size(), graph.num_landmarks()), ((3, 3), 1));
    let written = write_g2o(&graph);
    assert!(written.starts_with("VERTEX_XY 2 4 4\n"), "{written}");
    assert_eq!(read_g2o(&written).unwrap().graph, graph);
    // Both poses measure it 1 too near.
    assert_eq!(graph.chi2(), 2.0 + 1.0);
    graph
        .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
        .unwrap();
    assert!(graph.chi2() < 1e-20, "{}", graph.chi2());
    for (bad, why) in [
        (
            "EDGE_SE2 0 2 1 0 0 1 0 0 1 0 1\n",
            "line 8: vertex 2 is a landmark",
        ),
        (
            "EDGE_PRIOR_SE2 2 1 0 0 1 0 0 1 0 1\n",
            "line 8: vertex 2 is a landmark",
        ),
        ("EDGE_SE2_XY 0 1 1 0 1 0 1\n", "line 8: vertex 1 is a pose"),
        (
            "EDGE_SE2_XY 0 9 1 0 1 0 1\n",
            "line 8: there is no vertex 9",
        ),
        ("EDGE_SE2_XY 0 2 1 0 1 0 -1\n", "line 8: the information"),
        ("VERTEX_XY 2 4 4\n", "line 8: vertex 2 is there twice"),
    ] {
        let error = read_g2o(&format!("{text}{bad}")).unwrap_err().to_string();
        assert!(error.starts_with(why), "{error}");
    }
}

/// The error of g2o is that of the sensor, (T O)⁻¹ p − z, for any offset.
#[test]
fn sightings_of_a_sensor_are_those_of_its_pose() {
    let text = "PARAMS_SE3OFFSET 3 0.5 -1 2 0.5 0.5 0.5 0.5\nVERTEX_SE3:QUAT 0 1 2 3 0 0 0.6 0.8\n\
                VERTEX_TRACKXYZ 1 4 -5 6\nEDGE_SE3_TRACKXYZ 0 1 3 0.1 0.2 0.3 2 0.5 0.25 3 1 5\n";
    let graph = read_g2o(text).unwrap().graph;
    let quaternion =
        |x, y, z, w| UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let pose = Isometry3::from_parts(
        Translation3::new(1.0, 2.0, 3.0),
        quaternion(0.0, 0.0, 0.6, 0.8),
    );
    let offset = Isometry3::from_parts(
        Translation3::new(0.5, -1.0, 2.0),
        quaternion(0.5, 0.5, 0.5, 0.5),
    );
    let in_sensor = (pose * offset).inverse_transform_point(&nalgebra::Point3::new(4.0, -5.0, 6.0));
    let error = in_sensor.coords - Vector3::new(0.1, 0.2, 0.3);
    let information = nalgebra::Matrix3::new(2.0, 0.5, 0.25, 0.5, 3.0, 1.0, 0.25, 1.0, 5.0);
    let chi2 = error.dot(&(information * error));
    assert!(
        (graph.chi2() - chi2).abs() < 1e-12 * chi2,
        "{} {chi2}",
        graph.chi2()
    );
    let again = read_g2o(&write_g2o(&graph)).unwrap().graph;
    assert!((again.chi2() - chi2).abs() < 1e-12 * chi2);
    let without = text.replace("PARAMS_SE3OFFSET 3", "PARAMS_SE3OFFSET 4");
    let error = read_g2o(&without).unwrap_err().to_string();
    assert_eq!(error, "line 4: there is no line PARAMS_SE3OFFSET 3");
}

#[test]
fn other_measurements_are_left_out_and_counted() {
    let text = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 4 4\nFIX 0 2\nVERTEX_LINE2D 5 1 2\n\
                EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 2 4 4 1 0 1\nEDGE_BEARING_SE2_XY 1 2 0.7 1\n";
    let read = read_g2o(text).unwrap();
    assert_eq!(read.graph.size(), (3, 2));
    let note = &read.notes[0];
    assert!(
        note.starts_with("left out: 1 landmark and 1 measurement. "),
        "{note}"
    );
    assert!(read_g2o(SE2).unwrap().notes.is_empty());
}
