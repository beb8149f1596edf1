//! A camera from photographs of a chessboard.
//!
//! `cargo run --release --example calibrate -- 9x6 0.025 left*.jpg`: inner corners along both
//! sides, and the side of a square in meters. Without arguments the places of the corners are
//! computed, not found.

mod common;

use common::{Outcome, read_gray};
use epipole::calibration::BoardView;
use epipole::prelude::*;

pub(crate) fn run(arguments: &[String]) -> Outcome<()> {
    let (mut board, mut size) = (Board::new(Pattern::Chessboard, 9, 6, 0.025)?, (640, 480));
    let mut views = Vec::new();
    if let [marks, square_m, photos @ ..] = arguments {
        let (columns, rows) = marks.split_once('x').ok_or("how many corners?")?;
        let (m, n, side) = (columns.parse()?, rows.parse()?, square_m.parse()?);
        board = Board::new(Pattern::Chessboard, m, n, side)?;
        for path in photos {
            let image = read_gray(path)?;
            size = image.dimensions();
            let search = find_board(&image, &board, &mut ())?;
            println!("{path}: {:?}", search.problem(&board));
            views.push(search.view());
        }
    } else {
        let k = Intrinsics::new(540.0, 541.0, 330.0, 236.0)?;
        let rotations = [[0.5, 0.0, 0.1], [-0.5, 0.1, 0.0], [0.0, 0.5, 0.0]];
        for rotation in rotations {
            let at = Vector3::new(-0.1, -0.06, 0.35);
            let pose = RigidTransform::new(at, Vector3::from(rotation));
            let marks = (0..board.num_marks()).map(|mark| board.mark(mark));
            let project = |p: Point2<f64>| k.project(&(pose * Point3::new(p.x, p.y, 0.0))).ok();
            let pixels = marks.map(project).collect();
            views.push(Some(BoardView { pixels }));
        }
    }
    let found = calibrate(
        &board,
        &views,
        size,
        &CalibrationOptions::default(),
        &mut (),
    )?;
    let (camera, [sigma, ..]) = (found.camera, found.std_dev_k);
    println!("off by {:.3} px", found.rms_px);
    println!(
        "focal length {:.2} ± {sigma:.2} px",
        camera.intrinsics.fu_px()
    );
    println!("lens {:.4?}", camera.lens.coefficients());
    assert!(!arguments.is_empty() || found.rms_px < 1e-3);
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Outcome<()> {
    run(&common::arguments())
}
