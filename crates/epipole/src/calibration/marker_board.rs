//! Detection of the marks of a board with markers.

use super::board_markers::{BoardMarkers, board_markers};
use super::board_search::BoardSearch;
use super::grown_marks::GrownMarks;
use super::markers::{Marker, MarkerOptions, detect_markers};
use super::{Board, BoardView};
use crate::Result;
use crate::homography::{fit_homography, homography_4point, transfer};
use crate::imaging::GrayImage32;
use crate::progress::Monitor;
use nalgebra::{Matrix3, Point2, center};

/// Minimum number of marks, which lie in at least two rows and two columns.
const LEAST_MARKS: usize = 6;
/// Maximum distance between two markers to compare, squares.
const COMPARED: f64 = 3.0;
/// Maximum distance of a marker from its prediction by another one, relative to their distance.
const MOST_STRAYED: f64 = 0.2;
/// Maximum distance of a mark from the middle of a marker that predicts it, squares.
const BESIDE: f64 = 0.8;

/// Finds a board with markers. Its marks have sub-pixel accuracy.
pub(super) fn find_marker_board(
    image: &GrayImage32,
    board: &Board,
    monitor: &mut dyn Monitor,
) -> Result<BoardSearch> {
    let Some(markers) = board_markers(board) else {
        return Ok(BoardSearch::Nothing);
    };
    let options = MarkerOptions::default().with_border_bits(markers.border_bits);
    let found = detect_markers(image, markers.dictionary, &options, monitor)?;
    if found.is_empty() {
        return Ok(BoardSearch::Nothing);
    }
    let agreed = largest_agreeing(&found, &markers);
    let search = BoardSearch::Markers {
        num_of_board: agreed.len(),
        num_others: found.len() - agreed.len(),
    };
    let is_of_board = |marker: &&Marker| marker.id < markers.corners.len();
    if 2 * agreed.len() < found.iter().filter(is_of_board).count() {
        return Ok(search);
    }
    let mut near = GrownMarks::new(image, board, &markers);
    for mark in 0..board.num_marks() {
        if let Some(pixel_from_square) = beside(mark, board, &agreed, &markers) {
            near.add(mark, &pixel_from_square)?;
        }
    }
    near.grow()?;
    let view = near.into_view();
    Ok(match is_enough(&view, board.columns()) {
        true => BoardSearch::Found(view),
        false => search,
    })
}

/// Returns the largest set of markers that agree with the board's arrangement relative to nearby
/// ones, at most one per number.
fn largest_agreeing(found: &[Marker], markers: &BoardMarkers) -> Vec<Marker> {
    let of_board: Vec<&Marker> = found
        .iter()
        .filter(|marker| marker.id < markers.corners.len())
        .collect();
    let homographies: Vec<Option<Matrix3<f64>>> = (of_board.iter())
        .map(|marker| homography_4point(&markers.corners[marker.id], &marker.corners).pop())
        .collect();
    let agree = |a: usize, b: usize| {
        let apart =
            middle(&markers.corners[of_board[a].id]) - middle(&markers.corners[of_board[b].id]);
        apart.norm() > 0.0
            && apart.norm() < COMPARED
            && expects(&homographies[a], of_board[a], of_board[b], markers)
            && expects(&homographies[b], of_board[b], of_board[a], markers)
    };
    let mut taken = vec![false; of_board.len()];
    let mut largest: Vec<usize> = Vec::new();
    for seed in 0..of_board.len() {
        if core::mem::replace(&mut taken[seed], true) {
            continue;
        }
        let mut group = vec![seed];
        let mut next = 0;
        while let Some(&here) = group.get(next) {
            next += 1;
            for other in 0..of_board.len() {
                if !taken[other] && agree(here, other) {
                    taken[other] = true;
                    group.push(other);
                }
            }
        }
        if group.len() > largest.len() {
            largest = group;
        }
    }
    let mut agreed: Vec<Marker> = largest.into_iter().map(|k| *of_board[k]).collect();
    agreed.sort_by_key(|marker| (marker.id, marker.hamming));
    agreed.dedup_by_key(|marker| marker.id);
    agreed
}

/// Returns whether a marker is at the position predicted by another one.
fn expects(
    pixel_from_square: &Option<Matrix3<f64>>,
    from: &Marker,
    to: &Marker,
    markers: &BoardMarkers,
) -> bool {
    let [a, b] = [from, to].map(|marker| middle(&markers.corners[marker.id]));
    let (here, there) = (middle(&from.corners), middle(&to.corners));
    let expected = pixel_from_square.and_then(|h| transfer(&h, &b));
    let off = expected.map(|expected| (expected - there).norm());
    a != b && off.is_some_and(|off| off < MOST_STRAYED * (there - here).norm())
}

fn middle(corners: &[Point2<f64>; 4]) -> Point2<f64> {
    center(
        &center(&corners[0], &corners[2]),
        &center(&corners[1], &corners[3]),
    )
}

/// Returns the homography of the markers next to a mark.
fn beside(
    mark: usize,
    board: &Board,
    agreed: &[Marker],
    markers: &BoardMarkers,
) -> Option<Matrix3<f64>> {
    let place = board.mark_in_squares(mark);
    let (mut squares, mut pixels) = (Vec::new(), Vec::new());
    for marker in agreed {
        let corners = &markers.corners[marker.id];
        if (middle(corners) - place).norm() < BESIDE {
            squares.extend(corners);
            pixels.extend(marker.corners);
        }
    }
    fit_homography(&squares, &pixels).ok()
}

fn is_enough(view: &BoardView, columns: usize) -> bool {
    let spans = |line: &dyn Fn(usize) -> usize| {
        let mut lines = view.visible().map(|(mark, _)| line(mark));
        let first = lines.next();
        lines.any(|line| Some(line) != first)
    };
    view.num_visible() >= LEAST_MARKS
        && spans(&|mark| mark / columns)
        && spans(&|mark| mark % columns)
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{poses, render_board, true_view};
    use super::super::{MarkerDictionary, Pattern, find_board};
    use super::*;
    use crate::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
    use crate::imaging::{Border, gaussian_blur};
    use crate::math::random::Random;
    use core::f64::consts::PI;
    use image::Luma;
    use nalgebra::{Point3, Translation3, Vector3};

    const CHARUCO: Pattern = Pattern::Charuco {
        dictionary: MarkerDictionary::Aruco4x4_50,
        marker_ratio: 0.75,
    };

    fn camera() -> Camera {
        Camera {
            intrinsics: Intrinsics::new(550.0, 550.0, 319.5, 239.5).unwrap(),
            lens: Lens::from_coefficients(LensKind::Brown, &[-0.1, 0.02, 0.0, 0.0, 0.0]).unwrap(),
            width: 640,
            height: 480,
        }
    }

    /// A ChArUco board and an AprilGrid, each with poses that show the whole board.
    fn boards() -> [(Board, Vec<RigidTransform>); 2] {
        let charuco = Board::new(CHARUCO, 7, 5, 0.03).unwrap();
        let tags = Board::new(Pattern::AprilGrid { spacing: 0.3 }, 4, 3, 0.06).unwrap();
        [(charuco, 11.0), (tags, 8.5)].map(|(board, distance)| {
            let mut shown = poses(&board, 8, distance, 3);
            shown.retain(|pose| {
                let truth = true_view(&board, &camera(), pose);
                let is_inside =
                    |p: &Point2<f64>| (15.0..625.0).contains(&p.x) && (15.0..465.0).contains(&p.y);
                truth.pixels.iter().flatten().all(is_inside)
            });
            assert!(shown.len() >= 3, "{}", shown.len());
            shown.truncate(3);
            (board, shown)
        })
    }

    /// Number of marks, maximum and RMS distance from the truth.
    fn search(image: &GrayImage32, board: &Board, pose: &RigidTransform) -> (usize, f64, f64) {
        let truth = true_view(board, &camera(), pose);
        let search = find_board(image, board, &mut ()).unwrap();
        let problem = search.problem(board);
        let view = search.view().unwrap_or_else(|| panic!("{problem:?}"));
        let errors: Vec<f64> = view
            .visible()
            .map(|(mark, pixel)| (pixel - truth.pixels[mark].unwrap()).norm())
            .collect();
        let sum: f64 = errors.iter().map(|e| e * e).sum();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        (errors.len(), largest, (sum / errors.len() as f64).sqrt())
    }

    #[test]
    fn sharp_boards_are_exact() {
        for (board, poses) in boards() {
            for pose in &poses {
                let image = render_board(&board, &camera(), pose, 0.0, 0, &mut ()).unwrap();
                // No lens is sharper.
                let image = gaussian_blur(&image, 0.5, Border::Replicate, &mut ()).unwrap();
                let (count, largest, rms) = search(&image, &board, pose);
                assert_eq!(count, board.num_marks());
                assert!(
                    largest < 0.1 && rms < 0.04,
                    "{:?}: {largest} {rms}",
                    board.pattern()
                );
            }
        }
    }

    /// Neighbors predict marks accurately even where the lens distorts most.
    #[test]
    fn fisheyes_observe_all_marks() {
        let camera = Camera {
            intrinsics: Intrinsics::new(290.0, 290.0, 319.5, 239.5).unwrap(),
            lens: Lens::from_coefficients(LensKind::Fisheye, &[-0.02, 0.005, 0.0, 0.0]).unwrap(),
            width: 640,
            height: 480,
        };
        for (board, far) in boards().map(|(board, poses)| (board, poses[0])) {
            let nearer = Translation3::from(Vector3::new(0.03, -0.02, -0.45 * far.translation.z));
            let pose = nearer * far;
            let truth = true_view(&board, &camera, &pose);
            let image = render_board(&board, &camera, &pose, 0.01, 0, &mut ()).unwrap();
            let view = find_board(&image, &board, &mut ()).unwrap().view().unwrap();
            let missing = (truth.pixels.iter().zip(&view.pixels)).filter(|(truth, found)| {
                let is_inside =
                    |p: &Point2<f64>| (10.0..630.0).contains(&p.x) && (10.0..470.0).contains(&p.y);
                truth.as_ref().is_some_and(is_inside) && found.is_none()
            });
            assert_eq!(missing.count(), 0, "{:?}", board.pattern());
        }
    }

    #[test]
    fn boards_are_found_upside_down() {
        for (board, poses) in boards() {
            let last = board.mark(board.num_marks() - 1);
            let middle = Vector3::new(last.x / 2.0, last.y / 2.0, 0.0);
            let rotated = poses[0]
                * RigidTransform::translation(middle.x, middle.y, 0.0)
                * RigidTransform::new(Vector3::zeros(), Vector3::new(0.0, 0.0, PI))
                * RigidTransform::translation(-middle.x, -middle.y, 0.0);
            let image = render_board(&board, &camera(), &rotated, 0.01, 1, &mut ()).unwrap();
            let (count, largest, _) = search(&image, &board, &rotated);
            assert!(
                count == board.num_marks() && largest < 0.2,
                "{count} {largest}"
            );
        }
    }

    #[test]
    fn blurred_boards_are_found() {
        for (board, poses) in boards() {
            for pose in &poses {
                let sharp = render_board(&board, &camera(), pose, 0.01, 2, &mut ()).unwrap();
                let image = gaussian_blur(&sharp, 2.0, Border::Replicate, &mut ()).unwrap();
                let (count, largest, rms) = search(&image, &board, pose);
                assert!(10 * count >= 9 * board.num_marks(), "{count}");
                assert!(
                    largest < 0.3 && rms < 0.1,
                    "{:?}: {largest} {rms}",
                    board.pattern()
                );
            }
        }
    }

    /// Sharp and blurred, with small markers and large ones.
    #[test]
    fn corners_are_as_exact_as_those_of_chessboards() {
        let rms_px = |pattern: Pattern, blur_px: f64| {
            let board = Board::new(pattern, 7, 5, 0.03).unwrap();
            let (mut sum_sq, mut count) = (0.0, 0);
            for (seed, pose) in poses(&board, 6, 11.0, 3).iter().enumerate() {
                let truth = true_view(&board, &camera(), pose);
                let is_inside =
                    |p: &Point2<f64>| (30.0..610.0).contains(&p.x) && (30.0..450.0).contains(&p.y);
                if !truth.pixels.iter().flatten().all(is_inside) {
                    continue;
                }
                let image =
                    render_board(&board, &camera(), pose, 0.01, seed as u64, &mut ()).unwrap();
                let image = gaussian_blur(&image, blur_px, Border::Replicate, &mut ()).unwrap();
                let (seen, _, rms) = search(&image, &board, pose);
                sum_sq += rms * rms * seen as f64;
                count += seen;
            }
            (count, libm::sqrt(sum_sq / count as f64))
        };
        for (blur_px, marker_ratios) in
            [(0.5, [0.5, 0.75]), (1.5, [0.5, 0.85]), (2.0, [0.75, 0.85])]
        {
            let (_, chessboard_px) = rms_px(Pattern::Chessboard, blur_px);
            for marker_ratio in marker_ratios {
                let charuco = Pattern::Charuco {
                    dictionary: MarkerDictionary::Aruco4x4_50,
                    marker_ratio,
                };
                let (count, charuco_px) = rms_px(charuco, blur_px);
                assert!(
                    count > 100 && charuco_px < 0.025 && charuco_px < 1.2 * chessboard_px,
                    "{blur_px} {marker_ratio}: {count} {charuco_px} {chessboard_px}"
                );
            }
        }
    }

    /// Two fifths of the board, from the left or from above.
    #[test]
    fn hidden_parts_are_left_out() {
        for (board, poses) in boards() {
            let last = board.mark(board.num_marks() - 1);
            for (pose, axis) in poses.iter().zip([0, 1, 0]) {
                let mut image = render_board(&board, &camera(), pose, 0.01, 3, &mut ()).unwrap();
                let edge = Point2::new(0.4 * last.x, 0.4 * last.y);
                // The edge of the occluder, on the board, as a line in the image.
                let ends = match axis {
                    0 => [[edge.x, -1.0], [edge.x, 1.0]],
                    _ => [[1.0, edge.y], [-1.0, edge.y]],
                };
                let [a, b] = ends.map(|[x, y]| {
                    let near = Point3::new(x.clamp(-0.1, last.x), y.clamp(-0.1, last.y), 0.0);
                    camera().project(&(pose * near)).unwrap()
                });
                for (u, v, value) in image.enumerate_pixels_mut() {
                    let p = Point2::new(f64::from(u), f64::from(v));
                    if (b - a).perp(&(p - a)) > 0.0 {
                        *value = Luma([0.6]);
                    }
                }
                let (count, largest, rms) = search(&image, &board, pose);
                assert!(2 * count >= board.num_marks(), "{count}");
                assert!(
                    largest < 0.3 && rms < 0.08,
                    "{:?}: {largest} {rms}",
                    board.pattern()
                );
            }
        }
    }

    #[test]
    fn another_board_is_recognized_by_its_markers() {
        let (board, poses) = &boards()[0];
        let image = render_board(board, &camera(), &poses[0], 0.01, 4, &mut ()).unwrap();
        let wider = Board::new(CHARUCO, 8, 5, 0.03).unwrap();
        let search = find_board(&image, &wider, &mut ()).unwrap();
        let problem = search.problem(&wider).unwrap();
        assert!(
            problem.contains("17 markers") && problem.contains("count"),
            "{problem}"
        );
        let other = Pattern::Charuco {
            dictionary: MarkerDictionary::Aruco6x6_250,
            marker_ratio: 0.75,
        };
        let other = Board::new(other, 7, 5, 0.03).unwrap();
        let problem = find_board(&image, &other, &mut ())
            .unwrap()
            .problem(&other)
            .unwrap();
        assert!(problem.contains("dictionary"), "{problem}");
    }

    #[test]
    fn noise_has_no_markers() {
        let mut random = Random::new(7);
        let options = MarkerOptions::default();
        for number in 0..200 {
            let noise =
                GrayImage32::from_fn(160, 120, |_, _| Luma([random.uniform(0.0, 1.0) as f32]));
            // Spots of all sizes.
            let image = gaussian_blur(
                &noise,
                0.5 + f64::from(number % 10),
                Border::Replicate,
                &mut (),
            );
            let image = image.unwrap();
            let (least, most) = image
                .as_raw()
                .iter()
                .fold((1.0_f32, 0.0_f32), |(a, b), v| (a.min(*v), b.max(*v)));
            let image = GrayImage32::from_fn(160, 120, |u, v| {
                Luma([(image.get_pixel(u, v).0[0] - least) / (most - least)])
            });
            for dictionary in [
                MarkerDictionary::Aruco4x4_1000,
                MarkerDictionary::Aruco6x6_250,
                MarkerDictionary::AprilTag36h11,
            ] {
                let found = detect_markers(&image, dictionary, &options, &mut ()).unwrap();
                assert_eq!(found, [], "{number} {dictionary:?}");
            }
        }
    }

    #[test]
    fn images_without_content_have_no_boards() {
        for (board, _) in boards() {
            for (width, height) in [(0, 0), (1, 1), (1, 400), (400, 1), (90, 70)] {
                let image = GrayImage32::from_pixel(width, height, Luma([0.5]));
                assert_eq!(
                    find_board(&image, &board, &mut ()).unwrap(),
                    BoardSearch::Nothing
                );
            }
            let nan = GrayImage32::from_pixel(20, 20, Luma([f32::NAN]));
            assert!(find_board(&nan, &board, &mut ()).is_err());
        }
    }
}
