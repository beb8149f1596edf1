//! Published bundle adjustment problems.

use epipole::optim::{LmOptions, RobustLoss};
use epipole::sfm::adjust_bal;
use epipole_io::bundle::read_bal;
use std::path::PathBuf;

/// A file of the test data, or `None`, said aloud, where it is absent.
fn data(name: &str) -> Option<String> {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = root.join(name);
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(text),
        Err(_) => {
            println!("skipped: no data at {}", path.display());
            None
        }
    }
}

fn tight(max_iterations: usize) -> LmOptions {
    LmOptions::default()
        .with_max_iterations(max_iterations)
        .with_cost_tolerance(1e-9)
}

/// The initial cost is published with 13 digits; 13344.28 is the optimum that several solvers
/// agree on when every observation counts.
#[test]
fn ladybug_49_reaches_the_known_optimum() {
    let Some(text) = data("ba/ladybug-problem-49-7776-pre.txt") else {
        return;
    };
    let mut problem = read_bal(&text).expect("a BAL problem");
    assert_eq!(
        (
            problem.cameras.len(),
            problem.points.len(),
            problem.observations.len()
        ),
        (49, 7776, 31843)
    );
    let initial = problem.cost(RobustLoss::Trivial);
    assert!((initial - 850_912.460_680_8).abs() < 1e-6, "{initial}");
    let begin = std::time::Instant::now();
    let report =
        adjust_bal(&mut problem, &tight(100), RobustLoss::Trivial, &mut ()).expect("an adjustment");
    println!("{report:?} in {:?}", begin.elapsed());
    assert!(report.final_cost <= 13344.3, "{}", report.final_cost);
    let again = problem.cost(RobustLoss::Trivial);
    assert!((again - report.final_cost).abs() < 1e-6, "{again}");
}

/// Seven points seen by three cameras with nine unknowns each: the cost can fall to nothing.
#[test]
fn dubrovnik_3_is_under_determined() {
    let Some(text) = data("ba/dubrovnik-3-7-pre.txt") else {
        return;
    };
    let mut problem = read_bal(&text).expect("a BAL problem");
    let report =
        adjust_bal(&mut problem, &tight(500), RobustLoss::Trivial, &mut ()).expect("an adjustment");
    println!("{report:?}");
    assert!((report.initial_cost - 2764.22).abs() < 0.01);
    assert!(report.final_cost <= 0.019_983_3, "{}", report.final_cost);
}
