//! `epipole board`, and `calibrate` with the boards that it draws.

use crate::common::{Folder, fails, json, numbers, path};
use epipole::calibration::{Board, MarkerDictionary, Pattern, find_board, render_board};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use epipole::imaging::GrayImage32;
use image::{GrayImage, Luma};
use nalgebra::Vector3;
use serde_json::json;

const CHARUCO: Pattern = Pattern::Charuco {
    dictionary: MarkerDictionary::Aruco5x5_100,
    marker_ratio: 0.7,
};

/// Its options, its marks, and the width of what is black.
fn patterns() -> [(Vec<&'static str>, Board, f64); 5] {
    let board = |pattern, columns, rows| Board::new(pattern, columns, rows, 0.02).unwrap();
    [
        (
            vec!["chessboard", "--size", "7x5"],
            board(Pattern::Chessboard, 7, 5),
            160.0,
        ),
        (
            vec![
                "charuco",
                "--size",
                "7x5",
                "--marker-mm",
                "14",
                "--dictionary",
                "DICT_5X5_100",
            ],
            board(CHARUCO, 7, 5),
            140.0,
        ),
        (
            vec!["aprilgrid", "--size", "5x4", "--tag-spacing", "0.25"],
            board(Pattern::AprilGrid { spacing: 0.25 }, 5, 4),
            130.0,
        ),
        (
            vec!["circles", "--size", "7x5"],
            board(Pattern::Circles, 7, 5),
            132.0,
        ),
        (
            vec!["asymmetric-circles", "--size", "4x9"],
            board(Pattern::AsymmetricCircles, 4, 9),
            158.0,
        ),
    ]
}

#[test]
fn boards_are_drawn_to_scale_and_found() {
    let folder = Folder::new("board");
    let file = folder.file("board.png");
    for (options, board, width_mm) in patterns() {
        let mut arguments = vec!["board", "--kind"];
        arguments.extend(options);
        arguments.extend(["--square-mm", "20", "--dpi", "127", "-o", path(&file)]);
        let result = json(&arguments);
        let black = numbers(&result["board_mm"]);
        assert!((black[0] - width_mm).abs() < 1e-9, "{result}");
        let drawn = image::open(&file).unwrap().to_luma8();
        let paper = numbers(&result["paper_mm"]);
        // Five pixels a millimeter.
        assert_eq!(f64::from(drawn.width()), (5.0 * paper[0]).round());
        let gray = GrayImage32::from_fn(drawn.width(), drawn.height(), |u, v| {
            Luma([f32::from(drawn.get_pixel(u, v).0[0]) / 255.0])
        });
        let search = find_board(&gray, &board, &mut ()).unwrap();
        let problem = search.problem(&board);
        let view = search.view().unwrap_or_else(|| panic!("{problem:?}"));
        assert_eq!(view.num_visible(), board.num_marks(), "{result}");
        let first = view.pixels[0].unwrap();
        for (mark, pixel) in view.visible() {
            let expected = (board.mark(mark) - board.mark(0)) * 5000.0;
            // Boards that a half turn keeps may be counted from the other end.
            let off = (pixel - first - expected)
                .norm()
                .min((pixel - first + expected).norm());
            assert!(off < 0.1, "{result} {mark}: {off}");
        }
    }
}

#[test]
fn vectors_have_the_size_of_the_paper() {
    let folder = Folder::new("board-vectors");
    let pdf = folder.file("board.pdf");
    let arguments = ["board", "--size", "9x6", "--paper", "a4", "-o"];
    json(&[&arguments[..], &[path(&pdf)]].concat());
    let bytes = std::fs::read(&pdf).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("%PDF-") && text.trim_end().ends_with("%%EOF"));
    // A4 across, in points.
    assert!(text.contains("/MediaBox [0 0 841.8898 595.2756]"), "{text}");
    let svg = folder.file("board.svg");
    let result = json(&[&arguments[..], &[path(&svg)]].concat());
    assert_eq!(
        result["calibrate"],
        "--kind chessboard --board 9x6 --square-m 0.025"
    );
    let text = std::fs::read_to_string(&svg).unwrap();
    assert!(text.contains("width=\"297mm\" height=\"210mm\""));
    // 10 × 7 squares, half of them black, and the ruler with its ticks.
    assert_eq!(text.matches("h25.0000v25.0000").count(), 35);
    assert!(text.contains("h100.0000"));
}

#[test]
fn single_markers_are_drawn_to_scale_and_found() {
    let folder = Folder::new("markers");
    let file = folder.file("markers.png");
    let output = ["--dpi", "127", "-o", path(&file)];
    for (name, first) in [("36h11", 560), ("5x5_100", 0)] {
        let first_id = first.to_string();
        let arguments = [
            "board",
            "--markers",
            name,
            "--size",
            "3x4",
            "--square-mm",
            "40",
        ];
        let ids = ["--first-id", &first_id];
        let result = json(&[&arguments[..], &ids, &output].concat());
        assert_eq!(
            (&result["kind"], &result["gap_mm"]),
            (&json!("markers"), &json!(10.0))
        );
        assert_eq!(result["ids"], json!([first, first + 11]));
        // Three markers and two gaps, four and three.
        let board = numbers(&result["board_mm"]);
        assert!((board[0] - 140.0).abs() < 1e-9 && (board[1] - 190.0).abs() < 1e-9);
        let found = json(&["detect", path(&file), "--markers", name]);
        let markers = found["markers"].as_array().unwrap();
        assert_eq!(markers.len(), 12, "{name}");
        for marker in markers {
            let place = marker["id"].as_u64().unwrap() - first;
            let corners: Vec<Vec<f64>> = marker["corners"]
                .as_array()
                .unwrap()
                .iter()
                .map(numbers)
                .collect();
            let origin = numbers(&markers.iter().find(|m| m["id"] == first).unwrap()["corners"][0]);
            // Five pixels a millimeter, upright, row by row.
            let expected = [250.0 * (place % 3) as f64, 250.0 * (place / 3) as f64];
            for axis in 0..2 {
                assert!((corners[0][axis] - origin[axis] - expected[axis]).abs() < 0.5);
            }
            assert!((corners[1][0] - corners[0][0] - 200.0).abs() < 0.5);
        }
        let pdf = folder.file("markers.pdf");
        json(&[&arguments[..], &ids, &["-o", path(&pdf)]].concat());
        assert!(std::fs::read(&pdf).unwrap().starts_with(b"%PDF-"));
    }
    for (more, why) in [
        (&["--first-id", "580"][..], "whose markers are 0 to 586"),
        (&["--gap-mm", "2"], "--gap-mm must be 3.13 at least"),
        (&["--kind", "charuco"], "cannot be used with"),
        (&["--square-mm", "100"], "does not fit"),
    ] {
        let arguments = ["board", "--markers", "36h11", "--size", "3x4"];
        let all = [&arguments[..], more, &output].concat();
        fails(&folder, &all, 2, why);
    }
}

#[test]
fn boards_that_do_not_fit_are_refused() {
    let folder = Folder::new("board-refused");
    let file = folder.file("board.pdf");
    let large = [
        "board",
        "--size",
        "12x9",
        "--square-mm",
        "30",
        "-o",
        path(&file),
    ];
    fails(&folder, &large, 2, "--square-mm");
    let many = [
        "board",
        "--kind",
        "charuco",
        "--size",
        "12x10",
        "-o",
        path(&file),
    ];
    fails(&folder, &many, 2, "at most that of the dictionary");
    let other = folder.file("board.gif");
    fails(
        &folder,
        &["board", "--size", "9x6", "-o", path(&other)],
        2,
        ".pdf, .svg or .png",
    );
    fails(
        &folder,
        &["board", "--size", "9x6", "--paper", "b5", "-o", path(&file)],
        2,
        "none of a4",
    );
}

/// Some views show only a part of the board.
#[test]
fn parts_of_charuco_boards_calibrate_a_camera() {
    let folder = Folder::new("charuco");
    let camera = Camera {
        intrinsics: Intrinsics::new(400.0, 402.0, 241.0, 178.0).unwrap(),
        lens: Lens::from_coefficients(LensKind::Brown, &[-0.2, 0.0, 0.0, 0.0, 0.0]).unwrap(),
        width: 480,
        height: 360,
    };
    let board = Board::new(CHARUCO, 7, 5, 0.03).unwrap();
    let mut arguments = vec!["calibrate".to_owned()];
    for (index, [a, b, c, x, y]) in [
        [0.5, 0.0, 0.1, 0.0, 0.0],
        [-0.5, 0.1, 0.0, 0.1, 0.01],
        [0.0, 0.55, -0.1, -0.1, 0.03],
        [0.1, -0.5, 0.2, 0.0, -0.08],
        [0.3, 0.3, 3.0, 0.16, 0.12],
    ]
    .into_iter()
    .enumerate()
    {
        let pose = RigidTransform::new(
            Vector3::new(x - 0.08, y - 0.05, 0.27),
            Vector3::new(a, b, c),
        );
        let photo = render_board(&board, &camera, &pose, 0.01, index as u64, &mut ()).unwrap();
        let file = folder.file(&format!("board{index}.png"));
        GrayImage::from_fn(480, 360, |u, v| {
            Luma([(255.0 * photo.get_pixel(u, v).0[0]).round() as u8])
        })
        .save(&file)
        .unwrap();
        arguments.push(path(&file).to_owned());
    }
    let options =
        "--kind charuco --board 7x5 --square-m 0.03 --marker-m 0.021 --dictionary 5x5_100";
    arguments.extend(options.split(' ').map(str::to_owned));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = json(&arguments);
    assert!(result["rms_px"].as_f64().unwrap() < 0.1, "{result}");
    for (value, truth) in numbers(&result["k"])
        .iter()
        .zip([400.0, 402.0, 241.0, 178.0])
    {
        assert!((value - truth).abs() < 2.0, "{result}");
    }
    let views = result["views"].as_array().unwrap();
    let num_marks = |view: &serde_json::Value| view["num_marks"].as_u64().unwrap();
    assert!(
        views
            .iter()
            .all(|view| view["found"] == true && num_marks(view) >= 6)
    );
    assert!(views.iter().any(|view| num_marks(view) < 24), "{result}");
}

#[test]
fn markers_are_detected_without_a_board() {
    let folder = Folder::new("markers");
    let [file, marked] = ["board.png", "marked.png"].map(|name| folder.file(name));
    for (board, options, count) in [
        (
            "--kind charuco --size 7x5 --dictionary 5x5_100",
            "--markers DICT_5X5_100",
            17,
        ),
        (
            "--kind aprilgrid --size 5x4",
            "--markers 36h11 --border-bits 2",
            20,
        ),
    ] {
        let board: Vec<&str> = board.split(' ').collect();
        json(&[&["board", "-o", path(&file)], &board[..]].concat());
        let options: Vec<&str> = options.split(' ').collect();
        let found = json(
            &[
                &["detect", path(&file), "--png", path(&marked)],
                &options[..],
            ]
            .concat(),
        );
        let markers = found["markers"].as_array().unwrap();
        let ids: Vec<u64> = markers
            .iter()
            .map(|marker| marker["id"].as_u64().unwrap())
            .collect();
        assert_eq!(ids, (0..count).collect::<Vec<u64>>());
        assert!(
            markers
                .iter()
                .all(|marker| marker["corners"].as_array().unwrap().len() == 4)
        );
        assert!(marked.exists());
    }
    let arguments = [
        "board",
        "--size",
        "7x5",
        "--marker-mm",
        "9",
        "-o",
        path(&file),
    ];
    fails(&folder, &arguments, 2, "--marker-mm is of --kind charuco");
    let arguments = ["detect", path(&file), "--markers", "8x8"];
    fails(&folder, &arguments, 2, "\"8x8\" is none of");
}
