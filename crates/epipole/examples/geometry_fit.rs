//! Prints the models that robust estimation fits to two-view problems, for scripts that set them
//! beside peers.
//!
//! Usage: `geometry_fit FILE`. The file holds little-endian 64-bit floating-point numbers, problem
//! after problem: the kind (0: F, 1: E, 2: H), the threshold in pixels, the most samples, the
//! confidence, the seed, `fu fv cu cv` of both cameras (read for E only), the number of matches,
//! then `u1 v1 u2 v2` of each match. Prints a line for each problem: milliseconds, the numbers of
//! the model row by row (F and H, or \[R t\] for E), and 1 or 0 for each match, an inlier or not;
//! separated by tabs, the last two empty if there is no model.

#[path = "timing/clock.rs"]
mod clock;

use clock::now;
use epipole::camera::{Camera, Intrinsics};
use epipole::robust::{RansacOptions, RansacReport};
use epipole::{estimate_fundamental, estimate_homography, estimate_relative_pose};
use nalgebra::{Matrix3, Point2};
use std::array::from_fn;
use std::error::Error;
use std::time::Instant;

struct Problem {
    kind: u64,
    options: RansacOptions,
    intrinsics: [f64; 4],
    pixels1: Vec<Point2<f64>>,
    pixels2: Vec<Point2<f64>>,
}

fn read(numbers: &mut impl Iterator<Item = f64>) -> Option<Problem> {
    let kind = numbers.next()? as u64;
    let mut next = || numbers.next();
    let options = RansacOptions::default()
        .with_max_error_px(next()?)
        .with_max_iterations(next()? as usize)
        .with_confidence(next()?)
        .with_seed(next()? as u64);
    let intrinsics = [next()?, next()?, next()?, next()?];
    let (mut pixels1, mut pixels2) = (Vec::new(), Vec::new());
    for _ in 0..next()? as usize {
        pixels1.push(Point2::new(next()?, next()?));
        pixels2.push(Point2::new(next()?, next()?));
    }
    Some(Problem {
        kind,
        options,
        intrinsics,
        pixels1,
        pixels2,
    })
}

/// The numbers of the model row by row.
fn fit(p: &Problem) -> epipole::Result<RansacReport<Vec<f64>>> {
    let (a, b, options) = (&p.pixels1, &p.pixels2, &p.options);
    let rows_of = |m: Matrix3<f64>| m.transpose().as_slice().to_vec();
    Ok(match p.kind {
        0 => estimate_fundamental(a, b, options, &mut ())?.map(rows_of),
        1 => {
            let [fu, fv, cu, cv] = p.intrinsics;
            let k = Intrinsics::new(fu, fv, cu, cv)?;
            estimate_relative_pose(a, b, [&Camera::pinhole(k, 640, 480); 2], options, &mut ())?.map(
                |pose| {
                    let m = pose.cam2_from_cam1().to_matrix();
                    (0..12).map(|i| m[(i / 4, i % 4)]).collect()
                },
            )
        }
        _ => estimate_homography(a, b, options, &mut ())?.map(rows_of),
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which file?")?;
    let bytes = std::fs::read(path)?;
    let mut numbers = bytes
        .chunks_exact(8)
        .map(|x| f64::from_le_bytes(from_fn(|i| x[i])));
    let start = Instant::now();
    while let Some(problem) = read(&mut numbers) {
        let before = now(&start);
        let found = fit(&problem);
        let ms = now(&start) - before;
        let (model, inliers) = found.map_or_else(
            |_| Default::default(),
            |report| (report.model, report.inliers),
        );
        let model: Vec<String> = model.iter().map(f64::to_string).collect();
        let inliers: String = inliers.iter().map(|&i| if i { '1' } else { '0' }).collect();
        println!("{ms}\t{}\t{inliers}", model.join(" "));
    }
    Ok(())
}
