//! The job of `calibrate`: photographs of a board, its corners, and the camera calibrated from some
//! of them.

use crate::contract::{Problem, Progress};
use crate::kit::board;
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use epipole::Error;
use epipole::calibration::{
    Board, BoardSearch, BoardView, CalibrationOptions, Pattern, calibrate, find_board, render_board,
};
use epipole::camera::{Camera, Distortion, Intrinsics, Lens, RigidTransform};
use epipole::imaging::{gray_to_u8, resize};
use image::{DynamicImage, GrayImage};
use nalgebra::{Point2, Vector2, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// Size of the photographs, pixels.
pub(super) const SIZE: (u32, u32) = (512, 384);
/// Size at which the photographs are shown, pixels.
const SHOWN_SIZE: (u32, u32) = (256, 192);
pub(super) const NUM_VIEWS: usize = 10;
/// Columns and rows of the map of errors.
pub(super) const CELLS: (u32, u32) = (32, 24);
/// Focal length of the camera, pixels.
pub(super) const FOCAL_PX: f64 = 480.0;
/// Standard deviation of the noise, for white = 1.
const NOISE: f64 = 0.02;
const SQUARE_M: f64 = 0.03;

/// Bit mask of the views used.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) views: u16,
}

/// Camera calibrated from some views.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    pub(super) focal_px: f64,
    /// One standard deviation of the focal length, pixels.
    pub(super) focal_std_px: f64,
    pub(super) k1: f64,
    pub(super) rms_px: f64,
    /// Fraction of the image inside some board.
    pub(super) coverage: f64,
    /// Distance of the projection of a true ray from its pixel, for each of [`CELLS`], pixels.
    pub(super) errors_px: Vec<f32>,
}

/// Photographs, corners, and the camera or an error message.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photographs: Vec<Picture>,
    /// Corners found in each photograph, pixels.
    pub(super) corners: Vec<Vec<[f64; 2]>>,
    pub(super) found: Result<Found, String>,
}

/// Photographs with their boards, cached.
struct Taken {
    photographs: Vec<GrayImage>,
    views: Vec<Option<BoardView>>,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Calibrating";
    const FAILED: &'static str = "There are no photographs";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let board = board()?;
        let taken = taken(&board, progress)?;
        let is_used = |index: &usize| self.views >> index & 1 == 1;
        let used: Vec<_> = (0..NUM_VIEWS).filter(is_used).collect();
        let views: Vec<_> = used
            .iter()
            .map(|&index| taken.views[index].clone())
            .collect();
        let corners = taken.views.iter().map(|found| {
            let pixels = found.iter().flat_map(|found| found.pixels.iter().flatten());
            pixels.map(|pixel| [pixel.x, pixel.y]).collect()
        });
        let colored = |image: &GrayImage| DynamicImage::from(image.clone()).into_rgb8().into();
        Ok(Answer {
            photographs: taken.photographs.iter().map(colored).collect(),
            corners: corners.collect(),
            found: found(&board, &views).map_err(|error| error.to_string()),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let num_cells = (CELLS.0 * CELLS.1) as usize;
        let is_sound = |found: &Found| {
            let numbers = [found.focal_px, found.focal_std_px, found.rms_px, found.k1];
            numbers.iter().all(|number| number.is_finite()) && found.errors_px.len() == num_cells
        };
        answer.photographs.len() == NUM_VIEWS
            && answer.corners.len() == NUM_VIEWS
            && answer.found.as_ref().map_or(true, is_sound)
    }
}

fn board() -> Result<Board, Error> {
    Board::new(Pattern::Chessboard, 8, 6, SQUARE_M)
}

/// Returns the camera that takes the photographs.
fn camera() -> Result<Camera, Error> {
    let (width, height) = SIZE;
    Ok(Camera {
        width,
        height,
        intrinsics: Intrinsics::new(FOCAL_PX, FOCAL_PX, 262.0, 186.0)?,
        lens: Lens::Brown(Distortion {
            k1: -0.16,
            k2: 0.04,
            ..Distortion::NONE
        }),
    })
}

/// Rotation of the board about x and y, degrees, and its middle in the camera's frame, meters.
const POSES: [([f64; 2], [f64; 3]); NUM_VIEWS] = [
    ([0.0, 0.0], [0.0, 0.0, 0.36]),
    ([0.0, 0.0], [0.0, 0.0, 0.6]),
    ([0.0, 0.0], [0.07, 0.04, 0.45]),
    ([0.0, 38.0], [0.0, 0.0, 0.55]),
    ([0.0, -38.0], [0.0, 0.0, 0.55]),
    ([38.0, 0.0], [0.0, 0.0, 0.55]),
    ([-38.0, 0.0], [0.0, 0.0, 0.55]),
    ([25.0, -25.0], [-0.1, -0.07, 0.44]),
    ([-25.0, 25.0], [0.1, 0.07, 0.44]),
    ([25.0, 28.0], [0.1, -0.07, 0.44]),
];

/// Returns the pose of the board in one of the photographs.
fn pose(board: &Board, index: usize) -> RigidTransform {
    let ([about_x, about_y], middle) = POSES[index];
    let tilt = Vector3::new(about_x.to_radians(), about_y.to_radians(), 0.0);
    board::pose(board, tilt, &middle.into())
}

/// Renders the photographs and finds their boards, on the first call.
fn taken(board: &Board, progress: Progress<'_>) -> Result<&'static Taken, Error> {
    static TAKEN: OnceLock<Taken> = OnceLock::new();
    if let Some(taken) = TAKEN.get() {
        return Ok(taken);
    }
    let (camera, mut photographs, mut views) = (camera()?, Vec::new(), Vec::new());
    for index in 0..NUM_VIEWS {
        tell(progress, index as f64 / NUM_VIEWS as f64)?;
        let image = render_board(
            board,
            &camera,
            &pose(board, index),
            NOISE,
            index as u64,
            &mut (),
        )?;
        views.push(match find_board(&image, board, &mut ())? {
            BoardSearch::Found(found) => Some(found),
            _ => None,
        });
        let (width, height) = SHOWN_SIZE;
        photographs.push(gray_to_u8(&resize(&image, width, height)?));
    }
    Ok(TAKEN.get_or_init(|| Taken { photographs, views }))
}

fn found(board: &Board, views: &[Option<BoardView>]) -> Result<Found, Error> {
    let options = CalibrationOptions::default();
    let found = calibrate(board, views, SIZE, &options, &mut ())?;
    let lens = found.camera.lens.coefficients();
    Ok(Found {
        focal_px: found.camera.intrinsics.fu_px(),
        focal_std_px: found.std_dev_k[0],
        k1: lens.first().copied().unwrap_or(0.0),
        rms_px: found.rms_px,
        coverage: found.coverage,
        errors_px: errors_px(&camera()?, &found.camera),
    })
}

/// Returns the distances of the projections of true rays from their pixels. Their mean is
/// subtracted: it is equivalent to a rotation of the camera, which the poses of the boards absorb.
fn errors_px(truth: &Camera, found: &Camera) -> Vec<f32> {
    let (columns, rows) = CELLS;
    let mut offsets: Vec<Option<Vector2<f64>>> = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let share = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
            let pixel = Point2::new(
                share(column, columns) * f64::from(SIZE.0) - 0.5,
                share(row, rows) * f64::from(SIZE.1) - 0.5,
            );
            let ray = truth.unproject(&pixel).ok();
            let seen = ray.and_then(|ray| found.project(&ray.into()).ok());
            offsets.push(seen.map(|seen| seen - pixel));
        }
    }
    let known: Vec<_> = offsets.iter().flatten().collect();
    let mean = known.iter().copied().sum::<Vector2<f64>>() / known.len().max(1) as f64;
    let length = |offset: Option<Vector2<f64>>| offset.map_or(f64::INFINITY, |o| (o - mean).norm());
    offsets
        .into_iter()
        .map(|offset| length(offset) as f32)
        .collect()
}
