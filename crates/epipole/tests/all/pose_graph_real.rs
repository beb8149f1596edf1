//! A published pose graph.

use epipole::optim::{LmOptions, RobustLoss};
use epipole_io::pose_graph::{read_g2o, write_g2o};
use std::path::PathBuf;

/// The optimum that Gauss–Newton reaches from the given start with the first vertex fixed.
#[test]
fn intel_reaches_the_known_optimum() {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = root.join("posegraph/INTEL.g2o");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: no data at {}", path.display());
        return;
    };
    let mut graph = read_g2o(&text).expect("a pose graph").graph;
    assert_eq!(graph.size(), (1228, 1483));
    let begin = std::time::Instant::now();
    let report = graph
        .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
        .expect("an optimization");
    println!("{report:?} in {:?}", begin.elapsed());
    assert!((report.initial_chi2 / 5.14972e6 - 1.0).abs() < 1e-5);
    assert!((report.final_chi2 - 215.83).abs() < 0.01);
    let again = read_g2o(&write_g2o(&graph))
        .expect("what was written")
        .graph;
    assert!((again.chi2() - report.final_chi2).abs() < 1e-6);

    // From the measurements alone the start is nearer than the file's by three orders, and leads to
    // the same.
    let mut anew = read_g2o(&text).expect("a pose graph").graph;
    anew.initialize(&mut ()).expect("a start");
    let report = anew
        .optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ())
        .expect("an optimization");
    println!("{report:?}");
    assert!(report.initial_chi2 < 5e3, "{report:?}");
    assert!((report.final_chi2 - 215.83).abs() < 0.01, "{report:?}");
}
