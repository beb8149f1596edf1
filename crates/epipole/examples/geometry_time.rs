//! Times robust estimation, triangulation and the minimal solvers on given problems, for scripts
//! that set them beside peers.
//!
//! Usage: `geometry_time FOLDER`, where the folder holds `general-0.f64`, `planar-0.f64` … : rows
//! of seven little-endian numbers `u1 v1 u2 v2 X Y Z`. Prints `name, problem, median and least
//! milliseconds, numbers of the answer` a line, separated by tabs. With `RAYON_NUM_THREADS=1` the
//! time is that for which the process had a processor.

mod timing;

use epipole::absolute_pose::pose_p3p;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{essential_5point, fundamental_7point, fundamental_8point};
use epipole::homography::homography_4point;
use epipole::robust::RansacOptions;
use epipole::triangulation::triangulate_dlt_all;
use epipole::{
    estimate_absolute_pose, estimate_fundamental, estimate_homography, estimate_relative_pose,
};
use nalgebra::{Point2, Point3, Rotation3, Vector3};
use std::array::from_fn;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use timing::timed;

/// Median and least time of some work, milliseconds, and the answer.
fn time<T>(work: impl FnMut() -> T) -> ([f64; 2], T) {
    let timed = timed(20, work);
    ([timed.median_ms, timed.least_ms], timed.last)
}

struct Problem {
    pixels1: Vec<Point2<f64>>,
    pixels2: Vec<Point2<f64>>,
    points: Vec<Point3<f64>>,
}

fn read(folder: &Path, kind: &str, index: usize) -> Result<Option<Problem>, Box<dyn Error>> {
    let path = folder.join(format!("{kind}-{index}.f64"));
    if !path.exists() {
        return Ok(None);
    }
    let bytes = std::fs::read(path)?;
    let numbers: Vec<f64> = bytes
        .chunks_exact(8)
        .map(|x| f64::from_le_bytes(from_fn(|i| x[i])))
        .collect();
    let rows = || numbers.chunks_exact(7);
    Ok(Some(Problem {
        pixels1: rows().map(|r| Point2::new(r[0], r[1])).collect(),
        pixels2: rows().map(|r| Point2::new(r[2], r[3])).collect(),
        points: rows().map(|r| Point3::new(r[4], r[5], r[6])).collect(),
    }))
}

fn print(name: &str, index: usize, [median_ms, least_ms]: [f64; 2], numbers: &[f64]) {
    let text: Vec<String> = numbers.iter().map(f64::to_string).collect();
    println!(
        "{name}\t{index}\t{median_ms}\t{least_ms}\t{}",
        text.join(" ")
    );
}

/// The rows of [R t].
fn rows_of(pose: &RigidTransform) -> Vec<f64> {
    let m = pose.to_matrix();
    (0..12).map(|i| m[(i / 4, i % 4)]).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("which folder?")?;
    let folder = Path::new(&folder);
    let k = Intrinsics::centered(800.0, 640, 480)?;
    let options = RansacOptions::default();
    let flat = |m: &nalgebra::Matrix3<f64>| m.transpose().as_slice().to_vec();
    for index in 0.. {
        let Some(p) = read(folder, "general", index)? else {
            break;
        };
        let (ms, found) = time(|| estimate_fundamental(&p.pixels1, &p.pixels2, &options, &mut ()));
        print("F RANSAC", index, ms, &flat(&found?.model));
        let (ms, found) = time(|| {
            estimate_relative_pose(
                &p.pixels1,
                &p.pixels2,
                [&Camera::pinhole(k, 640, 480); 2],
                &options,
                &mut (),
            )
        });
        print(
            "E RANSAC",
            index,
            ms,
            &rows_of(&found?.model.cam2_from_cam1()),
        );
        let (ms, found) = time(|| {
            estimate_absolute_pose(
                &p.points,
                &p.pixels2,
                &Camera::pinhole(k, 640, 480),
                &options,
                &mut (),
            )
        });
        print("P3P RANSAC", index, ms, &rows_of(&found?.model));
    }
    for index in 0.. {
        let Some(p) = read(folder, "planar", index)? else {
            break;
        };
        let (ms, found) = time(|| estimate_homography(&p.pixels1, &p.pixels2, &options, &mut ()));
        print("H RANSAC", index, ms, &flat(&found?.model));
    }
    let clean = read(folder, "clean", 0)?.ok_or("no clean-0.f64")?;
    let left = PosedCamera {
        camera: Camera::pinhole(k, 640, 480),
        cam_from_world: RigidTransform::identity(),
    };
    let rotation = Rotation3::new(Vector3::new(0.03, 0.12, -0.05));
    let right = PosedCamera {
        camera: Camera::pinhole(k, 640, 480),
        cam_from_world: RigidTransform::from_parts(
            Vector3::new(-0.6, 0.1, 0.1).into(),
            rotation.into(),
        ),
    };
    let (p1, p2) = (left.projection_matrix(), right.projection_matrix());
    let (ms, found) = time(|| triangulate_dlt_all(&p1, &p2, &clean.pixels1, &clean.pixels2));
    let mut numbers = Vec::new();
    for point in found? {
        numbers.extend(point?.iter());
    }
    print("triangulation", 0, ms, &numbers);

    let s = read(folder, "minimal", 0)?.ok_or("no minimal-0.f64")?;
    let first = |i: usize| 7 * i;
    let hundred = |solve: &dyn Fn(usize)| time(|| (0..100).for_each(|i| solve(first(i)))).0;
    let ms = hundred(&|at| {
        let (a, b) = (
            from_fn(|i| s.pixels1[at + i]),
            from_fn(|i| s.pixels2[at + i]),
        );
        black_box(fundamental_7point(&a, &b));
    });
    print("F7 × 100", 0, ms, &[]);
    let ms = hundred(&|at| {
        let _ = black_box(fundamental_8point(
            &s.pixels1[at..at + 8],
            &s.pixels2[at..at + 8],
        ));
    });
    print("F8 × 100", 0, ms, &[]);
    let ms = hundred(&|at| {
        let (a, b) = (
            from_fn(|i| k.ray(&s.pixels1[at + i])),
            from_fn(|i| k.ray(&s.pixels2[at + i])),
        );
        black_box(essential_5point(&a, &b));
    });
    print("E5 × 100", 0, ms, &[]);
    let ms = hundred(&|at| {
        let (a, b) = (
            from_fn(|i| k.ray(&s.pixels2[at + i])),
            from_fn(|i| s.points[at + i]),
        );
        black_box(pose_p3p(&a, &b));
    });
    print("P3P × 100", 0, ms, &[]);
    let ms = hundred(&|at| {
        let (a, b) = (
            from_fn(|i| s.pixels1[at + i]),
            from_fn(|i| s.pixels2[at + i]),
        );
        let _ = black_box(homography_4point(&a, &b));
    });
    print("H4 × 100", 0, ms, &[]);
    Ok(())
}
