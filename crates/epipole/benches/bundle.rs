//! Bundle adjustment and pose graphs on published problems; silent where the data are absent.
//!
//! For one thread set `RAYON_NUM_THREADS=1`.

use criterion::{Criterion, criterion_group, criterion_main};
use epipole::optim::{LmOptions, RobustLoss};
use epipole::sfm::adjust_bal;
use epipole_io::bundle::read_bal;
use epipole_io::pose_graph::read_g2o;
use std::hint::black_box;
use std::path::PathBuf;

fn data(name: &str) -> Option<String> {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = root.join(name);
    let text = std::fs::read_to_string(&path).ok();
    if text.is_none() {
        println!("skipped: no data at {}", path.display());
    }
    text
}

fn bundle(c: &mut Criterion) {
    let mut group = c.benchmark_group("bundle");
    group.sample_size(10);
    if let Some(problem) =
        data("ba/ladybug-problem-49-7776-pre.txt").and_then(|text| read_bal(&text).ok())
    {
        // Until the cost that SciPy, Ceres and others stop at.
        let adjust = |max_iterations| {
            let options = LmOptions::default().with_max_iterations(max_iterations);
            adjust_bal(&mut problem.clone(), &options, RobustLoss::Trivial, &mut ())
        };
        let history = adjust(100).map_or(Vec::new(), |report| report.history);
        let reached = history.iter().find(|step| step.cost <= 13344.3);
        let max_iterations = reached.map_or(100, |step| step.index);
        group.bench_function("ladybug 49 to 13344.3", |b| {
            b.iter(|| black_box(adjust(max_iterations)));
        });
    }
    if let Some(graph) = data("posegraph/INTEL.g2o")
        .and_then(|text| read_g2o(&text).ok())
        .map(|read| read.graph)
    {
        group.bench_function("INTEL pose graph", |b| {
            b.iter(|| {
                let mut graph = graph.clone();
                black_box(graph.optimize(&LmOptions::default(), RobustLoss::Trivial, &mut ()))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, bundle);
criterion_main!(benches);
