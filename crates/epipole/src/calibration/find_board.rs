//! Detection of a board in an image.

use super::board_search::BoardSearch;
use super::chessboard::find_chessboard;
use super::circle_grid::find_circle_grid;
use super::contrast::stretch_contrast;
use super::crossing::edges_through;
use super::marker_board::find_marker_board;
use super::refine_mark::{CLEAR_SQUARES, refine_mark};
use super::saddles::check_range;
use super::{Board, BoardView, Pattern};
use crate::Result;
use crate::imaging::{Border, GrayImage32, pyramid_down};
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::Point2;

/// Maximum longer side of the image in which the search starts, pixels.
const FIRST_SIDE: u32 = 1300;
/// Finds a board's marks with sub-pixel accuracy.
///
/// A chessboard may be partly hidden: half of its corners must be visible, and at least two in each
/// of its outermost rows and columns. The first corner has a dark square on its inner side, towards
/// the other corners; if two do (both numbers of corners even, or both odd), the upper left one is
/// first. The disks of a circle grid may be darker or brighter than the board.
///
/// For a board with markers any part suffices that shows one marker and six marks in two rows and
/// two columns, as the markers identify the marks.
///
/// If nothing is found in an image of low contrast, it is stretched and searched again.
///
/// * `image`: gray values in [0, 1]
///
/// The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled);
/// [`Error::NotFinite`](crate::Error::NotFinite) for an invalid pixel,
/// [`Error::OutOfRange`](crate::Error::OutOfRange) for gray values far from [0, 1].
///
/// Source: saddle points as in Bok, Ha & Kweon 2016, "Automated checkerboard detection and indexing
/// using circular boundaries"; refined by
/// [`refine_corners`](crate::feature::refine_corners), then by fitting two crossing blurred edges
/// to the gray values.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{Board, Pattern, find_board};
/// use epipole::imaging::GrayImage32;
/// // 6 × 5 squares of 20 pixels, with a white margin.
/// let image = GrayImage32::from_fn(160, 140, |u, v| {
///     let inside = (20..140).contains(&u) && (20..120).contains(&v);
///     image::Luma([f32::from(!inside || (u / 20 + v / 20) % 2 == 1)])
/// });
/// let board = Board::new(Pattern::Chessboard, 5, 4, 0.02)?;
/// let view = find_board(&image, &board, &mut ())?.view().expect("a board");
/// assert_eq!(view.num_visible(), 20);
/// let first = view.pixels[0].expect("the first corner");
/// assert!((first - nalgebra::Point2::new(119.5, 99.5)).norm() < 0.01 || (first - nalgebra::Point2::new(39.5, 39.5)).norm() < 0.01);
/// # Ok(()) }
/// ```
#[doc(alias = "findChessboardCorners")]
#[doc(alias = "findCirclesGrid")]
pub fn find_board(
    image: &GrayImage32,
    board: &Board,
    monitor: &mut dyn Monitor,
) -> Result<BoardSearch> {
    check_range(image)?;
    let found = search(image, board, &mut Part::new(monitor, 0.0, 0.5))?;
    if found == BoardSearch::Nothing {
        report(monitor, Stage::FeatureDetection, 0.5)?;
        if let Some(stretched) = stretch_contrast(image) {
            return search(&stretched, board, &mut Part::new(monitor, 0.5, 1.0));
        }
    }
    Ok(found)
}

/// Finds a board in an image of normal contrast.
fn search(image: &GrayImage32, board: &Board, monitor: &mut dyn Monitor) -> Result<BoardSearch> {
    if board.pattern().has_markers() {
        return find_marker_board(image, board, monitor);
    }
    let mut levels = vec![image.clone()];
    while let Some(last) = levels.last()
        && last.width().max(last.height()) > FIRST_SIDE / 4
    {
        levels.push(pyramid_down(last, Border::Reflect101));
    }
    let first = levels
        .iter()
        .position(|level| level.width().max(level.height()) <= FIRST_SIDE)
        .unwrap_or(levels.len() - 1);
    // Finer levels for small squares, then coarser ones for blurred squares.
    let mut order: Vec<usize> = (0..=first).rev().collect();
    order.extend(first + 1..levels.len());
    let mut best = BoardSearch::Nothing;
    for (n, &level) in order.iter().enumerate() {
        let [from, to] = [n, n + 1].map(|n| n as f32 / order.len() as f32);
        report(monitor, Stage::FeatureDetection, from)?;
        let part = &mut Part::new(monitor, from, to);
        let found = match board.pattern() {
            Pattern::Circles | Pattern::AsymmetricCircles => {
                find_circle_grid(&levels[level], board, part)?
            }
            _ => find_chessboard(&levels[level], board, part)?,
        };
        if let BoardSearch::Found(coarse) = found {
            if best.outdoes(&coarse, board) {
                continue;
            }
            let scale = f64::from(1_u32 << level);
            let pixels = coarse.pixels.iter();
            let at_full_size = BoardView {
                pixels: pixels.map(|p| p.map(|p| p * scale)).collect(),
            };
            if board.pattern() != Pattern::Chessboard {
                return Ok(BoardSearch::Found(at_full_size));
            }
            let refined = refine_corners(image, &at_full_size, board.columns())?;
            return Ok(BoardSearch::Found(refined));
        }
        best = best.or_more(found);
    }
    Ok(best.unless_accidental())
}

/// Refines corners with sub-pixel accuracy. Corners that move too far are dropped.
fn refine_corners(image: &GrayImage32, view: &BoardView, columns: usize) -> Result<BoardView> {
    let mut pixels = Vec::with_capacity(view.pixels.len());
    for (mark, pixel) in view.pixels.iter().enumerate() {
        let Some(pixel) = pixel else {
            pixels.push(None);
            continue;
        };
        let spacing = view.spacing(mark, columns).unwrap_or(10.0);
        let edges = edges_through(pixel, beside(view, mark, columns));
        pixels.push(match edges {
            Some(edges) => refine_mark(image, pixel, edges, spacing, &CLEAR_SQUARES, None)?,
            None => None,
        });
    }
    Ok(BoardView { pixels })
}

/// Returns the adjacent marks, as in [`BoardView::beside`]; along an axis without any, they are
/// extrapolated from the nearest mark with neighbors.
fn beside(view: &BoardView, mark: usize, columns: usize) -> [[Option<Point2<f64>>; 2]; 2] {
    let mut beside = view.beside(mark, columns);
    for (axis, pair) in beside.iter_mut().enumerate() {
        if pair.iter().any(Option::is_some) {
            continue;
        }
        let far = |other: usize| {
            let across = (other % columns).abs_diff(mark % columns);
            across.pow(2) + (other / columns).abs_diff(mark / columns).pow(2)
        };
        let step = |(other, at): (usize, Point2<f64>)| {
            let [before, behind] = view.beside(other, columns)[axis];
            (before.is_some() || behind.is_some())
                .then(|| (far(other), behind.unwrap_or(at) - before.unwrap_or(at)))
        };
        let nearest = view.visible().filter_map(step).min_by_key(|(far, _)| *far);
        if let (Some((_, step)), Some(Some(at))) = (nearest, view.pixels.get(mark)) {
            pair[1] = Some(at + step);
        }
    }
    beside
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{poses, render_board, true_view};
    use super::*;
    use crate::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
    use crate::math::random::Random;
    use core::f64::consts::FRAC_PI_2;
    use image::Luma;
    use nalgebra::Vector2;

    fn camera(kind: LensKind, focal_px: f64, coefficients: &[f64]) -> Camera {
        Camera {
            intrinsics: Intrinsics::new(focal_px, focal_px, 322.0, 236.0).unwrap(),
            lens: Lens::from_coefficients(kind, coefficients).unwrap(),
            width: 640,
            height: 480,
        }
    }

    fn cameras() -> [Camera; 3] {
        [
            camera(LensKind::Brown, 550.0, &[0.0; 5]),
            camera(LensKind::Brown, 450.0, &[-0.28, 0.08, 0.001, 0.0, 0.0]),
            camera(LensKind::Fisheye, 280.0, &[-0.02, 0.005, 0.0, 0.0]),
        ]
    }

    /// Maximum and RMS distance from the truth.
    fn errors(found: &BoardView, truth: &BoardView) -> (f64, f64) {
        let errors: Vec<f64> = found
            .visible()
            .map(|(mark, pixel)| (pixel - truth.pixels[mark].unwrap()).norm())
            .collect();
        let sum: f64 = errors.iter().map(|e| e * e).sum();
        (
            errors.iter().copied().fold(0.0, f64::max),
            (sum / errors.len() as f64).sqrt(),
        )
    }

    #[test]
    fn chessboards_are_found_through_every_lens() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let (mut num_found, mut num_poses) = (0, 0);
        for (number, camera) in cameras().iter().enumerate() {
            let distance = [19.0, 15.0, 9.5][number];
            for (seed, pose) in poses(&board, 5, distance, 7).iter().enumerate() {
                let truth = true_view(&board, camera, pose);
                let inside =
                    |p: &Point2<f64>| (12.0..628.0).contains(&p.x) && (12.0..468.0).contains(&p.y);
                if !truth.pixels.iter().flatten().all(inside) {
                    continue;
                }
                num_poses += 1;
                let image = render_board(&board, camera, pose, 0.01, seed as u64, &mut ()).unwrap();
                let search = find_board(&image, &board, &mut ()).unwrap();
                let problem = search.problem(&board);
                let Some(view) = search.view() else {
                    println!("{number} {seed}: {problem:?}");
                    continue;
                };
                assert!(problem.is_none() && view.num_visible() >= 50);
                let (largest, rms) = errors(&view, &truth);
                assert!(
                    largest < 0.5 && rms < 0.12,
                    "{number} {seed}: {largest} {rms}"
                );
                num_found += 1;
            }
        }
        println!("{num_found} of {num_poses}");
        assert!(num_poses >= 8 && num_found == num_poses);
    }

    /// Sixteen gray values of an 8-bit image, as from thermal cameras.
    #[test]
    fn a_board_of_little_contrast_is_found() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let [camera, ..] = cameras();
        for pose in poses(&board, 3, 17.0, 3) {
            let truth = true_view(&board, &camera, &pose);
            let mut image = render_board(&board, &camera, &pose, 0.01, 1, &mut ()).unwrap();
            for Luma([value]) in image.pixels_mut() {
                *value = (100.0 + (*value * 15.0).round()) / 255.0;
            }
            let view = find_board(&image, &board, &mut ()).unwrap().view().unwrap();
            let (largest, rms) = errors(&view, &truth);
            assert!(largest < 0.6 && rms < 0.15, "{largest} {rms}");
        }
    }

    #[test]
    fn a_hand_over_a_part_hides_only_that() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let [camera, ..] = cameras();
        let pose = poses(&board, 1, 17.0, 3)[0];
        let truth = true_view(&board, &camera, &pose);
        let mut image = render_board(&board, &camera, &pose, 0.01, 1, &mut ()).unwrap();
        // A hand over about eight corners of the interior.
        let (a, b) = (truth.pixels[12].unwrap(), truth.pixels[33].unwrap());
        for (u, v, value) in image.enumerate_pixels_mut() {
            let p = Point2::new(f64::from(u), f64::from(v));
            if (p - nalgebra::center(&a, &b)).norm() < 0.6 * (b - a).norm() {
                *value = Luma([0.55]);
            }
        }
        let view = find_board(&image, &board, &mut ()).unwrap().view().unwrap();
        assert!(
            (30..=50).contains(&view.num_visible()),
            "{}",
            view.num_visible()
        );
        let (largest, rms) = errors(&view, &truth);
        assert!(largest < 0.6 && rms < 0.15, "{largest} {rms}");
    }

    /// Corners at the rim of an occlusion, some without neighbors along a row or column, are as
    /// accurate as the others.
    #[test]
    fn corners_beside_a_hand_are_exact() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let [camera, ..] = cameras();
        let mut random = Random::new(2);
        let (mut num_visible, mut worst) = (0, 0.0_f64);
        for (number, pose) in (poses(&board, 12, 15.0, 5).iter()).enumerate() {
            let truth = true_view(&board, &camera, pose);
            let mut image =
                render_board(&board, &camera, pose, 0.01, number as u64, &mut ()).unwrap();
            let hand = truth.pixels[random.below(54)].unwrap();
            let mut corner = |quarter: u8| {
                let angle_rad = f64::from(quarter) * FRAC_PI_2 + random.uniform(0.0, 1.2);
                let (sine, cosine) = libm::sincos(angle_rad);
                hand + Vector2::new(cosine, sine) * random.uniform(25.0, 75.0)
            };
            let corners = [0, 1, 2, 3].map(&mut corner);
            let is_hidden = |p: &Point2<f64>| {
                (0..4).all(|k| (corners[(k + 1) % 4] - corners[k]).perp(&(p - corners[k])) > 0.0)
            };
            for (u, v, value) in image.enumerate_pixels_mut() {
                if is_hidden(&Point2::new(f64::from(u), f64::from(v))) {
                    *value = Luma([0.55]);
                }
            }
            if let Some(view) = find_board(&image, &board, &mut ()).unwrap().view() {
                num_visible += view.num_visible();
                worst = worst.max(errors(&view, &truth).0);
            }
        }
        assert!(num_visible > 500 && worst < 0.2, "{num_visible} {worst}");
    }

    #[test]
    fn circle_grids_are_found_dark_and_bright() {
        let board = Board::new(Pattern::AsymmetricCircles, 4, 11, 0.02).unwrap();
        let (mut num_found, mut num_poses) = (0, 0);
        for (number, camera) in cameras()[..2].iter().enumerate() {
            for (seed, pose) in poses(&board, 3, 21.0, 4).iter().enumerate() {
                let truth = true_view(&board, camera, pose);
                let inside =
                    |p: &Point2<f64>| (20.0..620.0).contains(&p.x) && (20.0..460.0).contains(&p.y);
                if !truth.pixels.iter().flatten().all(inside) {
                    continue;
                }
                num_poses += 1;
                let dark = render_board(&board, camera, pose, 0.01, seed as u64, &mut ()).unwrap();
                let bright =
                    GrayImage32::from_fn(640, 480, |u, v| Luma([1.0 - dark.get_pixel(u, v).0[0]]));
                for image in [dark, bright] {
                    let search = find_board(&image, &board, &mut ()).unwrap();
                    let problem = search.problem(&board);
                    let Some(view) = search.view() else {
                        println!("{number} {seed}: {problem:?}");
                        continue;
                    };
                    assert_eq!(view.num_visible(), 44);
                    // The center of an ellipse differs from the projection of the disk's center by
                    // a tenth of a pixel.
                    let (largest, rms) = errors(&view, &truth);
                    assert!(
                        largest < 0.4 && rms < 0.15,
                        "{number} {seed}: {largest} {rms}"
                    );
                    num_found += 1;
                }
            }
        }
        println!("{num_found} of {}", 2 * num_poses);
        assert!(num_poses >= 3 && num_found == 2 * num_poses);
    }

    /// In rows and columns, the first disk at the upper left, for any rotation of the board.
    #[test]
    fn circles_in_rows_are_found() {
        let board = Board::new(Pattern::Circles, 7, 5, 0.03).unwrap();
        let [camera, ..] = cameras();
        for (seed, pose) in poses(&board, 4, 14.0, 6).iter().enumerate() {
            let truth = true_view(&board, &camera, pose);
            let image = render_board(&board, &camera, pose, 0.01, seed as u64, &mut ()).unwrap();
            let view = find_board(&image, &board, &mut ()).unwrap().view().unwrap();
            assert_eq!(view.num_visible(), 35);
            // The center of an ellipse differs from the projection of the disk's center.
            let (largest, rms) = errors(&view, &truth);
            assert!(largest < 0.4 && rms < 0.15, "{seed}: {largest} {rms}");
        }
        let wider = Board::new(Pattern::Circles, 8, 5, 0.03).unwrap();
        let image = render_board(
            &board,
            &camera,
            &poses(&board, 1, 14.0, 6)[0],
            0.0,
            0,
            &mut (),
        )
        .unwrap();
        let problem = find_board(&image, &wider, &mut ())
            .unwrap()
            .problem(&wider)
            .unwrap();
        assert!(problem.contains("7 × 5"), "{problem}");
    }

    #[test]
    fn a_sentence_explains_why_there_is_none() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let [camera, ..] = cameras();
        let pose = poses(&board, 1, 17.0, 3)[0];
        let problem_of = |pose: &RigidTransform, columns: usize, rows: usize| {
            let image = render_board(&board, &camera, pose, 0.01, 2, &mut ()).unwrap();
            let wanted = Board::new(Pattern::Chessboard, columns, rows, 0.025).unwrap();
            let search = find_board(&image, &wanted, &mut ()).unwrap();
            assert!(!matches!(search, BoardSearch::Found(_)));
            search.problem(&wanted).unwrap()
        };
        let smaller = problem_of(&pose, 8, 6);
        assert!(
            smaller.contains("9 × 6") && smaller.contains("another size"),
            "{smaller}"
        );
        let larger = problem_of(&pose, 10, 7);
        assert!(
            larger.contains("9 × 6") && larger.contains("10 × 7"),
            "{larger}"
        );
        let half_out = RigidTransform::translation(0.18, 0.0, 0.0) * pose;
        assert!(problem_of(&half_out, 9, 6).contains("outside of the picture"));
        let nothing = GrayImage32::from_pixel(200, 100, Luma([0.5]));
        let search = find_board(&nothing, &board, &mut ()).unwrap();
        assert!(
            search
                .problem(&board)
                .unwrap()
                .contains("no board of 9 × 6")
        );
        for (width, height) in [(0, 0), (1, 1), (4, 900)] {
            let search = find_board(&GrayImage32::new(width, height), &board, &mut ()).unwrap();
            assert_eq!(search, BoardSearch::Nothing);
        }
        let nan = GrayImage32::from_pixel(20, 20, Luma([f32::NAN]));
        assert!(find_board(&nan, &board, &mut ()).is_err());
        let bytes = GrayImage32::from_pixel(20, 20, Luma([200.0]));
        assert!(find_board(&bytes, &board, &mut ()).is_err());
    }
}
