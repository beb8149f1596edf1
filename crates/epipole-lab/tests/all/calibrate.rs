//! Calibration from photographs of a board: same result as the core's, applied to photographs of
//! that size, with a reason if it fails.

use crate::common::{finish, jpeg, reopened};
use epipole::calibration::{
    Board, BoardView, CalibrationOptions, Keep, Pattern, Undistortion, calibrate, find_board,
    render_board,
};
use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
use epipole::feature::photo_to_gray;
use epipole_lab::project::{Blob, BoardPattern, LensModel, Project, Step};
use epipole_lab::session::{BoardOutcome, Event};
use epipole_lab::tasks::{BoardOf, CalibrationOfBoards, FocalOrigin, Progress, compute};
use image::{Rgb, RgbImage};
use nalgebra::Vector3;
use std::io::Cursor;
use std::ops::ControlFlow;

/// The sample, calibrated.
fn calibrated() -> Project {
    let mut project = Project::default();
    project.update(Event::Show(Step::Calibrate));
    project.update(Event::OpenBoards);
    finish(&mut project);
    project
}

fn png(image: &RgbImage) -> Blob {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner().into()
}

fn true_camera(width: u32, height: u32) -> Camera {
    let focal_px = 0.82 * f64::from(width);
    Camera {
        intrinsics: Intrinsics::centered(focal_px, width, height).unwrap(),
        lens: Lens::from_coefficients(LensKind::Brown, &[-0.2, 0.05, 0.0, 0.0, 0.0]).unwrap(),
        width,
        height,
    }
}

/// A photograph of a board rotated by `turn_deg` about x and y, its middle 2 cm to the left, at a
/// distance of `far_m`.
fn photographed(board: &Board, camera: &Camera, turn_deg: [f64; 2], far_m: f64) -> Blob {
    let [x, y] = turn_deg.map(f64::to_radians);
    let rotation = nalgebra::UnitQuaternion::from_euler_angles(x, y, 0.1);
    let middle = board.mark(board.num_marks() - 1) / 2.0;
    let at = Vector3::new(-0.02, 0.0, far_m) - rotation * Vector3::new(middle.x, middle.y, 0.0);
    let pose = RigidTransform::from_parts(at.into(), rotation);
    let gray = render_board(board, camera, &pose, 0.005, 1, &mut ()).unwrap();
    png(&RgbImage::from_fn(camera.width, camera.height, |u, v| {
        Rgb([(255.0 * gray.get_pixel(u, v).0[0]).round() as u8; 3])
    }))
}

fn chessboard() -> Board {
    Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap()
}

/// A project with these photographs of boards, computed to its end.
fn with_boards(files: Vec<Blob>) -> Project {
    let mut project = Project::default();
    project.update(Event::Show(Step::Calibrate));
    let named = files.into_iter().enumerate();
    let named = named.map(|(n, file)| (format!("view-{}.png", n + 1), file));
    project.update(Event::AddBoards(named.collect()));
    finish(&mut project);
    project
}

#[test]
fn the_sample_gives_the_camera_that_it_was_rendered_with() {
    let project = calibrated();
    let found = project.get(CalibrationOfBoards).unwrap();
    let truth = [520.0, 521.0, 323.0, 236.0];
    for n in 0..4 {
        let off = (found.camera.k[n] - truth[n]).abs();
        assert!(off < 1.0, "{:?}", found.camera.k);
        // Within the reported uncertainty: more than four deviations practically never happen.
        assert!(
            off < 4.0 * found.std_dev_k[n],
            "{off} {}",
            found.std_dev_k[n]
        );
    }
    assert!((found.camera.coefficients[0] + 0.26).abs() < 0.01);
    assert!(found.rms_px < 0.1, "{}", found.rms_px);
    assert!((0.4..1.0).contains(&found.coverage), "{}", found.coverage);
    assert_eq!(found.views.iter().flatten().count(), 9);
    assert_eq!(found.warnings, []);
    let last = &project.document().boards[9];
    assert!(matches!(
        project.board_outcome(last),
        BoardOutcome::NotFound(_)
    ));
    let words = project.describe();
    for part in [
        "found in 9 of 10 photographs",
        "Focal lengths 52",
        "board-10.png",
        "all of the board in sight",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

/// The steps of `epipole calibrate`, with the same files.
#[test]
fn files_give_what_the_core_gives_bit_for_bit() {
    let (board, camera) = (chessboard(), true_camera(400, 300));
    let turns = [
        [0.0, 0.0],
        [30.0, 5.0],
        [-30.0, 10.0],
        [5.0, 32.0],
        [0.0, -32.0],
    ];
    let files: Vec<Blob> = (turns.iter())
        .map(|turn| photographed(&board, &camera, *turn, 0.36))
        .collect();
    let views: Vec<Option<BoardView>> = (files.iter())
        .map(|file| {
            let image = image::load_from_memory(file).unwrap().to_rgb8();
            find_board(&photo_to_gray(&image), &board, &mut ())
                .unwrap()
                .view()
        })
        .collect();
    assert_eq!(views.iter().flatten().count(), 5);
    let mut project = with_boards(files);
    for (ours, kind) in [
        (LensModel::Brown, LensKind::Brown),
        (LensModel::Rational, LensKind::Rational),
        (LensModel::Fisheye, LensKind::Fisheye),
    ] {
        let mut settings = project.document().settings.clone();
        settings.calibration.lens = ours;
        project.update(Event::Set(settings));
        let num_tasks = finish(&mut project);
        assert_eq!(
            num_tasks,
            usize::from(ours != LensModel::Brown),
            "the boards are known"
        );
        let options = CalibrationOptions::default().with_lens(kind);
        let direct = match calibrate(&board, &views, (400, 300), &options, &mut ()) {
            Ok(direct) => direct,
            // Five views leave eight numbers of a usual lens open.
            Err(error) => {
                assert_eq!(ours, LensModel::Rational, "{error}");
                let told = project.failure(CalibrationOfBoards).unwrap();
                assert!(told.starts_with(&error.to_string()), "{told}");
                continue;
            }
        };
        let found = project.get(CalibrationOfBoards).unwrap();
        let k = direct.camera.intrinsics;
        let center = k.principal_point();
        assert_eq!(found.camera.k, [k.fu_px(), k.fv_px(), center.x, center.y]);
        assert_eq!(found.camera.coefficients, direct.camera.lens.coefficients());
        assert_eq!(found.rms_px, direct.rms_px);
        assert_eq!(found.std_dev_k, direct.std_dev_k);
        assert_eq!(found.std_dev_lens, direct.std_dev_lens);
        assert_eq!(found.coverage, direct.coverage);
        for (view, other) in found.views.iter().zip(&direct.views) {
            let (view, other) = (view.unwrap(), other.unwrap());
            assert_eq!(view.rms_px, other.rms_px);
            let pose = other.cam_from_board;
            assert_eq!(view.rotation, <[f64; 4]>::from(pose.rotation.coords));
            assert_eq!(view.translation, <[f64; 3]>::from(pose.translation.vector));
        }
        // The file says the same, and is JSON.
        let json: serde_json::Value =
            serde_json::from_str(&project.camera_json().unwrap()).unwrap();
        assert_eq!(json["k"][1].as_f64(), Some(k.fv_px()));
        assert_eq!(json["image"]["width"], 400);
        assert_eq!(json["distortion"]["model"], ours.name());
        let written = json["distortion"]["coefficients"].as_array().unwrap();
        let written: Vec<f64> = written.iter().filter_map(|k| k.as_f64()).collect();
        assert_eq!(written, direct.camera.lens.coefficients());
        assert_eq!(
            json["std_dev"].as_array().unwrap().len(),
            4 + direct.std_dev_lens.len()
        );
    }
    assert_eq!(
        project.calibrate_command(),
        "epipole calibrate boards/ --board 9x6 --square-m 0.025 --model fisheye -o camera.json"
    );
}

#[test]
fn the_camera_is_used_for_photographs_of_its_size() {
    let mut project = calibrated();
    let picture = |width, height| {
        png(&RgbImage::from_fn(width, height, |u, v| {
            Rgb([
                (u * 7 % 256) as u8,
                (v * 9 % 256) as u8,
                (u * v % 251) as u8,
            ])
        }))
    };
    let fitting = picture(640, 480);
    project.update(Event::Add(vec![
        ("fits.png".to_owned(), fitting.clone()),
        ("other.png".to_owned(), picture(320, 240)),
    ]));
    finish(&mut project);
    let id = project.document().photos[0].id;
    project.update(Event::Focal(vec![id], Some(700.0)));
    finish(&mut project);
    let camera = project.get(CalibrationOfBoards).unwrap().camera.clone();
    project.update(Event::UseCamera(Some(camera.clone())));
    finish(&mut project);
    let [fits, other] = &project.document().photos[..] else {
        panic!("two photographs")
    };
    assert_eq!(project.focal_origin(fits), Some(FocalOrigin::Calibration));
    assert_eq!(project.focal_origin(other), Some(FocalOrigin::Guessed));
    // As `epipole undistort` redraws it.
    let truth = Camera {
        intrinsics: Intrinsics::new(camera.k[0], camera.k[1], camera.k[2], camera.k[3]).unwrap(),
        lens: Lens::from_coefficients(LensKind::Brown, &camera.coefficients).unwrap(),
        width: 640,
        height: 480,
    };
    let flat = Undistortion::new(&truth, Keep::Valid, &mut ()).unwrap();
    let image = image::load_from_memory(&fitting).unwrap().to_rgb8();
    let pixels = project.photograph(fits).unwrap();
    assert_eq!(
        pixels.rgb[..],
        flat.map.warp(&image, &mut ()).unwrap().as_raw()[..]
    );
    let (k, center) = (flat.intrinsics, flat.intrinsics.principal_point());
    let expected = [k.fu_px(), k.fv_px(), center.x, center.y];
    assert_eq!(project.camera(fits).unwrap().k, expected);
    assert!(!pixels.as_given);
    let words = project.describe();
    assert!(words.contains("used for 1 of 2 photographs"), "{words}");

    // Reduced to a quarter of the pixels, it is half the camera.
    let mut settings = project.document().settings.clone();
    settings.max_megapixels = 0.1;
    project.update(Event::Set(settings));
    finish(&mut project);
    let small = project.camera(&project.document().photos[0]).unwrap();
    let share = f64::from(small.width) / 640.0;
    assert!((small.k[0] / (expected[0] * share) - 1.0).abs() < 1e-12);
    assert!((small.k[2] - ((expected[2] + 0.5) * share - 0.5)).abs() < 1e-9);
    project.update(Event::Undo);

    // It is saved, together with the boards.
    let again = reopened(&project);
    assert_eq!(again.document().camera, Some(camera));
    assert_eq!(again.document().boards.len(), 10);
    assert_eq!(again.document().settings, project.document().settings);

    // One step back, and the focal length that was typed is there again.
    project.update(Event::Undo);
    assert_eq!(project.document().camera, None);
    let fits = &project.document().photos[0];
    assert_eq!(project.focal_origin(fits), Some(FocalOrigin::Typed));
    assert!(project.pending().is_empty(), "undo is instant");
}

/// The lens is fixed to the sensor: if the file has an orientation, the camera is rotated with it,
/// and if not, the camera is not used, with a message.
#[test]
fn the_camera_is_turned_with_photographs_taken_upright() {
    let mut project = calibrated();
    let picture = RgbImage::from_fn(640, 480, |u, v| {
        Rgb([(u / 3) as u8, (v / 2) as u8, ((u + v) / 5) as u8])
    });
    let silent = image::imageops::rotate90(&picture);
    project.update(Event::Add(vec![
        ("lying.jpg".to_owned(), jpeg(&picture, 1)),
        ("upright.jpg".to_owned(), jpeg(&picture, 6)),
        ("upside.jpg".to_owned(), jpeg(&picture, 3)),
        ("silent.jpg".to_owned(), jpeg(&silent, 1)),
    ]));
    finish(&mut project);
    let camera = project.get(CalibrationOfBoards).unwrap().camera.clone();
    project.update(Event::UseCamera(Some(camera)));
    finish(&mut project);
    let [lying, upright, upside, silent] = &project.document().photos[..] else {
        panic!("four photographs");
    };
    let [fu, fv, cu, cv] = project.camera(lying).unwrap().k;
    assert_eq!(project.camera(upright).unwrap().k, [fv, fu, 479.0 - cv, cu]);
    assert_eq!(
        project.camera(upside).unwrap().k,
        [fu, fv, 639.0 - cu, 479.0 - cv]
    );
    // The same pixels, rotated after undistortion.
    let pixels = |given| {
        let found = project.photograph(given).unwrap();
        RgbImage::from_raw(found.width, found.height, found.rgb.to_vec()).unwrap()
    };
    assert_eq!(pixels(upright), image::imageops::rotate90(&pixels(lying)));
    assert_eq!(pixels(upside), image::imageops::rotate180(&pixels(lying)));
    assert_eq!(project.focal_origin(silent), Some(FocalOrigin::Guessed));
    let words = project.unused_camera_words(silent);
    assert!(
        words.contains("in the other orientation without saying which way"),
        "{words}"
    );
    assert_eq!(project.unused_camera_words(upright), "");
    let words = project.describe();
    assert!(words.contains("used for 3 of 4 photographs"), "{words}");
    assert!(
        words.contains("not used for 1 photograph in the other orientation"),
        "{words}"
    );
    project.update(Event::Show(Step::Photographs));
    let words = project.describe();
    assert!(
        words.contains("2 are upright and 2 are landscape"),
        "{words}"
    );
}

/// However the camera was held when it photographed the board, it is one camera.
#[test]
fn boards_taken_upright_and_lying_give_one_camera() {
    let (board, camera) = (chessboard(), true_camera(400, 300));
    let turns = [
        [0.0, 0.0],
        [30.0, 5.0],
        [-30.0, 10.0],
        [5.0, 32.0],
        [0.0, -32.0],
    ];
    let view = |turn| {
        image::load_from_memory(&photographed(&board, &camera, turn, 0.36))
            .unwrap()
            .to_rgb8()
    };
    let lying: Vec<Blob> = turns.iter().map(|turn| jpeg(&view(*turn), 1)).collect();
    let mixed: Vec<Blob> = (turns.iter().zip([1, 6, 8, 3, 6]))
        .map(|(turn, orientation)| jpeg(&view(*turn), orientation))
        .collect();
    let (lying, mixed) = (with_boards(lying), with_boards(mixed));
    let words = mixed.describe();
    assert!(words.contains("found in 5 of 5"), "{words}");
    let cameras =
        [&lying, &mixed].map(|project| project.get(CalibrationOfBoards).unwrap().camera.clone());
    assert_eq!(cameras[0], cameras[1]);
    assert_eq!(cameras[0].size, (400, 300));
}

#[test]
fn boards_and_photographs_of_one_name_stay_apart_in_a_saved_project() {
    let board = photographed(&chessboard(), &true_camera(400, 300), [10.0, 0.0], 0.36);
    let other = png(&RgbImage::new(40, 30));
    let mut project = Project::default();
    project.update(Event::Add(vec![("one.png".to_owned(), other.clone())]));
    project.update(Event::AddBoards(vec![(
        "one.png".to_owned(),
        board.clone(),
    )]));
    let again = reopened(&project);
    let source = |file: &Blob| epipole_lab::project::Source::File(file.clone());
    assert_eq!(again.document().photos[0].source, source(&other));
    assert_eq!(again.document().boards[0].source, source(&board));
    assert_eq!(again.document().boards[0].name, "one.png");
}

#[test]
fn what_gives_no_camera_is_told_with_what_helps() {
    let (board, camera) = (chessboard(), true_camera(400, 300));
    let view = |turn_deg| photographed(&board, &camera, turn_deg, 0.36);
    let told = |project: &Project, parts: &[&str]| {
        let words = project.describe();
        for part in parts {
            assert!(words.contains(part), "{part}: {words}");
        }
    };
    // No board, and no photograph.
    let gray = png(&RgbImage::from_pixel(200, 100, Rgb([128; 3])));
    let project = with_boards(vec![gray, vec![1, 2, 3].into()]);
    told(
        &project,
        &[
            "found in 0 of 2",
            "no board of 9 × 6",
            "view-2.png: cannot be read",
            "at least two",
        ],
    );
    // One view alone.
    let project = with_boards(vec![view([0.0, 30.0])]);
    told(
        &project,
        &["found in 1 of 1 photograph.", "at least two", "30° to 45°"],
    );
    assert_eq!(project.failure(CalibrationOfBoards), None);
    // All parallel to the image plane.
    let far = [0.36, 0.4, 0.45].map(|far_m| photographed(&board, &camera, [0.0, 0.0], far_m));
    let project = with_boards(far.to_vec());
    told(&project, &["parallel", "30° to 45°"]);
    // A board of another size in the settings.
    let views = [[0.0, 30.0], [30.0, 0.0]].map(view);
    let mut project = with_boards(views.to_vec());
    let mut settings = project.document().settings.clone();
    settings.calibration.board.columns = 8;
    project.update(Event::Set(settings.clone()));
    finish(&mut project);
    told(
        &project,
        &["found in 0 of 2", "if the board has 9 × 6 marks, say so"],
    );
    settings.calibration.board.pattern = BoardPattern::Circles;
    project.update(Event::Set(settings));
    finish(&mut project);
    told(&project, &["found in 0 of 2"]);
    // A photograph of another size.
    let odd = photographed(&board, &true_camera(480, 360), [20.0, 0.0], 0.36);
    let mut files: Vec<Blob> = [[0.0, 30.0], [30.0, 0.0], [-25.0, 20.0]].map(view).to_vec();
    files.insert(0, odd);
    let mut project = with_boards(files);
    told(
        &project,
        &[
            "found in 3 of 4",
            "view-1.png: 480 × 360 pixels, the others 400 × 300",
        ],
    );
    assert_eq!(
        project.get(CalibrationOfBoards).unwrap().camera.size,
        (400, 300)
    );
    assert!(project.get(CalibrationOfBoards).unwrap().views[0].is_none());
    // After the reader excludes it, there is no warning about it.
    let id = project.document().boards[0].id;
    project.update(Event::Exclude(id, true));
    finish(&mut project);
    told(&project, &["view-1.png: left out by you"]);
    assert_eq!(project.get(CalibrationOfBoards).unwrap().views.len(), 3);
}

#[test]
fn asymmetric_circles_do_as_well() {
    let board = Board::new(Pattern::AsymmetricCircles, 4, 11, 0.02).unwrap();
    let camera = true_camera(480, 360);
    let turns = [
        [0.0, 0.0],
        [25.0, 5.0],
        [-25.0, 10.0],
        [5.0, 28.0],
        [0.0, -28.0],
    ];
    let files: Vec<Blob> = (turns.iter())
        .map(|turn| photographed(&board, &camera, *turn, 0.42))
        .collect();
    let mut project = with_boards(files);
    let mut settings = project.document().settings.clone();
    settings.calibration.board.pattern = BoardPattern::Circles;
    settings.calibration.board.columns = 4;
    settings.calibration.board.rows = 11;
    settings.calibration.square_m = 0.02;
    project.update(Event::Set(settings));
    finish(&mut project);
    let found = project
        .get(CalibrationOfBoards)
        .unwrap_or_else(|| panic!("{}", project.describe()));
    let truth = camera.intrinsics.fu_px();
    assert!(
        (found.camera.k[0] / truth - 1.0).abs() < 0.01,
        "{:?}",
        found.camera
    );
}

#[test]
fn every_piece_of_it_can_be_stopped() {
    let mut project = calibrated();
    let id = project.document().boards[0].id;
    project.update(Event::Exclude(id, true));
    let solve = project.pending()[0];
    let solve = solve.request(&project).unwrap().to_bytes();
    project.update(Event::Exclude(id, false));
    let mut settings = project.document().settings.clone();
    settings.calibration.board.rows = 7;
    project.update(Event::Set(settings));
    let search = project.pending()[0];
    let search = search.request(&project).unwrap().to_bytes();
    for request in [solve, search] {
        let mut calls = 0;
        let result = compute(&request, &mut |progress| {
            let Progress::Share(share, words) = progress else {
                panic!("there is nothing to show so far");
            };
            assert!((0.0..=1.0).contains(&share) && !words.is_empty());
            calls += 1;
            match calls {
                2 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        assert_eq!((result, calls), (Err("stopped".to_owned()), 2));
    }
}

#[test]
fn each_photograph_of_a_board_has_a_small_picture() {
    let project = calibrated();
    for photo in &project.document().boards {
        let small = &project.get(BoardOf(photo.id)).unwrap().picture.small;
        let pixels = small.width as usize * small.height as usize;
        assert!(pixels > 1000, "{}", photo.name);
        assert_eq!(small.rgb.len(), 3 * pixels);
    }
}
