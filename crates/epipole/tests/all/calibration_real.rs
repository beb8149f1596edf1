//! Calibration on photographs of a chessboard by a stereo rig.

use epipole::calibration::{
    Board, BoardView, CalibrationOptions, Pattern, calibrate, calibrate_rig, find_board,
};
use epipole::camera::LensKind;
use epipole_io::photo::{DecodeOptions, decode_gray};
use std::path::PathBuf;

/// OpenCV 5.0 on the same photographs, corners by its own search: `findChessboardCorners`,
/// `cornerSubPix` in windows of 11 × 11 pixels (half of that is what it is given),
/// `calibrateCamera` and `stereoCalibrate` with fixed intrinsics. With windows of 23 × 23 pixels,
/// as its samples have them, corners are less exact: 0.408, 0.458 and 0.447 px, and a baseline of
/// 83.6 mm.
const OPENCV: [f64; 3] = [0.1954, 0.2070, 0.2168];
const OPENCV_BASELINE_M: f64 = 0.083206;

#[test]
fn every_board_is_found_and_the_errors_are_no_larger_than_opencvs() {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let folder = root.join("calib/opencv_chessboard");
    if !folder.is_dir() {
        println!("skipped: no data at {}", folder.display());
        return;
    }
    let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).expect("a board");
    let gray_of = |name: &str| {
        let bytes = std::fs::read(folder.join(name)).expect("a photograph");
        (decode_gray(&bytes, &DecodeOptions::default()).expect("an image")).image
    };
    // Texture beside the board has looked like half of a smaller one.
    for (columns, rows) in [(7, 6), (8, 6), (5, 4)] {
        let smaller = Board::new(Pattern::Chessboard, columns, rows, 0.025).expect("a board");
        for name in ["left01.jpg", "left03.jpg", "right05.jpg"] {
            let search = find_board(&gray_of(name), &smaller, &mut ()).expect("a search");
            let problem = search.problem(&smaller).expect("another size");
            assert!(
                problem.contains("the board is of another size"),
                "{name}: {problem}"
            );
        }
    }
    let views = |side: &str| -> Vec<Option<BoardView>> {
        (1..=14)
            .filter(|number| *number != 10)
            .map(|number| {
                let gray = gray_of(&format!("{side}{number:02}.jpg"));
                let search = find_board(&gray, &board, &mut ()).expect("a search");
                println!("{side}{number}: {:?}", search.problem(&board));
                search.view()
            })
            .collect()
    };
    let sides = [views("left"), views("right")];
    for views in &sides {
        assert_eq!(views.iter().flatten().count(), 13);
    }
    let options = CalibrationOptions::default();
    let found = sides.each_ref().map(|views| {
        calibrate(&board, views, (640, 480), &options, &mut ()).expect("a calibration")
    });
    let rig = calibrate_rig(
        &board,
        &found.each_ref().map(|calibration| calibration.camera),
        &sides[0],
        &sides[1],
        &mut (),
    )
    .expect("a rig");
    for calibration in &found {
        println!("{calibration:#?}");
    }
    println!("{rig:?}");
    let marks: usize = sides
        .iter()
        .flatten()
        .flatten()
        .map(BoardView::num_visible)
        .sum();
    println!("{marks} of {} marks", 26 * 54);
    assert!(marks >= 26 * 54 - 10);
    for (ours, theirs) in [found[0].rms_px, found[1].rms_px, rig.rms_px]
        .iter()
        .zip(OPENCV)
    {
        assert!(*ours <= theirs, "{ours} {theirs}");
    }
    assert!(
        (rig.baseline_m - OPENCV_BASELINE_M).abs() < 0.0002,
        "{}",
        rig.baseline_m
    );
    for kind in [LensKind::Rational, LensKind::Fisheye] {
        let options = options.with_lens(kind);
        let other =
            calibrate(&board, &sides[0], (640, 480), &options, &mut ()).expect("a calibration");
        println!("{kind:?}: {} px", other.rms_px);
        assert!(other.rms_px < 1.1 * found[0].rms_px);
    }
}
