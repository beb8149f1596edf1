//! Renderings of boards with exact ground truth.

use super::Board;
#[cfg(test)]
use super::BoardView;
use super::drawing::BoardDrawing;
use super::footprint::Footprint;
use crate::Result;
use crate::camera::{Camera, RigidTransform};
use crate::imaging::GrayImage32;
use crate::math::random::Random;
use crate::progress::{Monitor, Stage, report};
use image::Luma;
use nalgebra::{Point2, Point3, Vector2, Vector3};

const BLACK: f64 = 0.12;
const WHITE: f64 = 0.85;
const TABLE: f64 = 0.45;
/// Width of the white margin around the outermost marks, squares.
const MARGIN: f64 = 2.2;

/// A board to render.
struct Sheet {
    drawing: BoardDrawing,
    /// Corner opposite to the one at (−[`MARGIN`], −[`MARGIN`]), squares.
    corner: Point2<f64>,
}

impl Sheet {
    fn new(board: &Board) -> Self {
        let marks = (0..board.num_marks()).map(|mark| board.mark_in_squares(mark));
        let last = marks.fold(Point2::origin(), |most: Point2<f64>, mark| most.sup(&mark));
        Self {
            drawing: board.drawing(),
            corner: Point2::new(last.x + MARGIN, last.y + MARGIN),
        }
    }

    /// Returns the mean gray value of a part.
    ///
    /// * `footprint`: footprint of a pixel, in squares
    fn gray(&self, footprint: &Footprint) -> f64 {
        let whole = footprint.area();
        let [low, high] = footprint.bounds();
        let is_aside = |i: usize| low[i] > self.corner[i] || high[i] < -MARGIN;
        if !(whole > 0.0 && whole.is_finite()) || is_aside(0) || is_aside(1) {
            return TABLE;
        }
        let sheet = footprint.area_in_rectangle(Point2::new(-MARGIN, -MARGIN), self.corner);
        let is_near =
            |a: &Point2<f64>, b: &Point2<f64>| (0..2).all(|i| a[i] <= high[i] && b[i] >= low[i]);
        let mut black = 0.0;
        for [a, b] in &self.drawing.rectangles {
            if is_near(a, b) {
                black += footprint.area_in_rectangle(*a, *b);
            }
        }
        let radius = self.drawing.disk_radius;
        let reach = Vector2::new(radius, radius);
        for center in &self.drawing.disks {
            if is_near(&(center - reach), &(center + reach)) {
                black += footprint.area_in_disk(*center, radius);
            }
        }
        TABLE + ((WHITE - TABLE) * sheet + (BLACK - WHITE) * black) / whole
    }
}

/// Renders a board on a gray table; each pixel is the exact mean over the area that it sees.
///
/// * `cam_from_board`: pose of the board, meters
/// * `noise`: standard deviation of the noise, relative to the difference between black and white
/// * `seed`: seed of the noise
///
/// The table also fills pixels without rays, and those behind the board. The only stage is
/// [`Stage::Rendering`].
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{Board, Pattern, find_board, render_board};
/// use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
/// let board = Board::new(Pattern::Chessboard, 5, 4, 0.02)?;
/// let camera = Camera {
///     intrinsics: Intrinsics::centered(200.0, 160, 120)?,
///     lens: Lens::from_coefficients(LensKind::Brown, &[0.0; 5])?,
///     width: 160,
///     height: 120,
/// };
/// // The corner in row 1 and column 2 is 2 cm to the right of the first and 2 cm below it.
/// let pose = RigidTransform::translation(-0.04, -0.03, 0.2);
/// let image = render_board(&board, &camera, &pose, 0.0, 0, &mut ())?;
/// let found = find_board(&image, &board, &mut ())?.view().expect("a board");
/// let pixel = found.pixels[7].expect("a corner");
/// assert!((pixel - nalgebra::Point2::new(79.5, 49.5)).norm() < 0.1);
/// # Ok(()) }
/// ```
pub fn render_board(
    board: &Board,
    camera: &Camera,
    cam_from_board: &RigidTransform,
    noise: f64,
    seed: u64,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    let mut random = Random::new(seed);
    let sheet = Sheet::new(board);
    let board_from_cam = cam_from_board.inverse();
    let origin = board_from_cam * Point3::origin();
    // Position on the board that an image point sees, in squares.
    let place = |u: f64, v: f64| {
        let ray: Vector3<f64> =
            board_from_cam.rotation * camera.unproject(&Point2::new(u, v)).ok()?;
        let depth = -origin.z / ray.z;
        (depth > 0.0).then(|| (origin + ray * depth).xy() / board.square_m())
    };
    let row = |v: u32| -> Vec<_> {
        (0..=camera.width)
            .map(|u| place(f64::from(u) - 0.5, f64::from(v) - 0.5))
            .collect()
    };
    let mut above = row(0);
    let mut image = GrayImage32::new(camera.width, camera.height);
    for v in 0..camera.height {
        report(monitor, Stage::Rendering, v as f32 / camera.height as f32)?;
        let below = row(v + 1);
        for u in 0..camera.width {
            let k = u as usize;
            let mean = match [above[k], above[k + 1], below[k + 1], below[k]] {
                [Some(a), Some(b), Some(c), Some(d)] => sheet.gray(&Footprint::new([a, b, c, d])),
                _ => TABLE,
            };
            let value = mean + noise * random.normal();
            image.put_pixel(u, v, Luma([value.clamp(0.0, 1.0) as f32]));
        }
        above = below;
    }
    Ok(image)
}

/// Returns the true pixels of the marks.
#[cfg(test)]
pub(crate) fn true_view(
    board: &Board,
    camera: &Camera,
    cam_from_board: &RigidTransform,
) -> BoardView {
    let pixel = |mark| {
        let p = board.mark(mark);
        camera
            .project(&(cam_from_board * Point3::new(p.x, p.y, 0.0)))
            .ok()
    };
    BoardView {
        pixels: (0..board.num_marks()).map(pixel).collect(),
    }
}

/// Returns poses that show the board from all sides, at a distance in squares.
#[cfg(test)]
pub(crate) fn poses(board: &Board, count: usize, distance: f64, seed: u64) -> Vec<RigidTransform> {
    let mut random = Random::new(seed);
    let last = board.mark(board.num_marks() - 1);
    let middle = Vector3::new(last.x / 2.0, last.y / 2.0, 0.0);
    (0..count)
        .map(|_| {
            let rotation_vector = Vector3::new(
                random.uniform(-0.55, 0.55),
                random.uniform(-0.55, 0.55),
                random.uniform(-0.4, 0.4),
            );
            let rotation = nalgebra::UnitQuaternion::from_scaled_axis(rotation_vector);
            let far = distance * board.square_m();
            let at = Vector3::new(
                random.uniform(-0.12, 0.12) * far,
                random.uniform(-0.08, 0.08) * far,
                far * random.uniform(0.9, 1.3),
            );
            RigidTransform::from_parts((at - rotation * middle).into(), rotation)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::Pattern;
    use super::*;
    use crate::camera::{Intrinsics, Lens, LensKind};
    use core::f64::consts::PI;
    use nalgebra::UnitQuaternion;

    const SQUARE_M: f64 = 0.03;

    fn camera() -> Camera {
        Camera {
            intrinsics: Intrinsics::new(300.0, 300.0, 99.3, 79.8).unwrap(),
            lens: Lens::from_coefficients(LensKind::Brown, &[0.0; 5]).unwrap(),
            width: 200,
            height: 160,
        }
    }

    /// The board's mark 1 on the optical axis, offset by `offset_px`, rotated about the board's
    /// normal and tilted.
    fn pose(board: &Board, yaw_rad: f64, tip_rad: f64, offset_px: f64) -> RigidTransform {
        let rotation = UnitQuaternion::from_euler_angles(tip_rad, 0.3 * tip_rad, 0.0)
            * UnitQuaternion::from_euler_angles(0.0, 0.0, yaw_rad);
        let mark = board.mark(4);
        let at = Vector3::new(offset_px * 0.25 / 300.0, 0.0, 0.25);
        let middle = rotation * Vector3::new(mark.x, mark.y, 0.0);
        RigidTransform::from_parts((at - middle).into(), rotation)
    }

    /// Column at which an edge crosses a row of pixels, from the sum of their gray values, the area
    /// on either side.
    fn crossing(image: &GrayImage32, columns: core::ops::Range<u32>, v: u32) -> f64 {
        let gray = |u: u32| f64::from(image.get_pixel(u, v).0[0]);
        let (first, last) = (gray(columns.start), gray(columns.end - 1));
        let sum: f64 = columns
            .clone()
            .map(|u| (gray(u) - last) / (first - last))
            .sum();
        f64::from(columns.start) - 0.5 + sum
    }

    /// Edges of squares agree with projected corners, at any angle.
    #[test]
    fn edges_are_exact() {
        let board = Board::new(Pattern::Chessboard, 3, 3, SQUARE_M).unwrap();
        let camera = camera();
        let mut num_rows = 0;
        for degrees in [3.0, 17.0, 30.0, 45.0, 58.0, -45.0, -20.0] {
            for tip_rad in [0.0, 0.35, -0.5] {
                for offset_px in [0.0, 0.13, 0.37, 0.5, 0.71] {
                    let pose = pose(&board, f64::to_radians(degrees), tip_rad, offset_px);
                    let image = render_board(&board, &camera, &pose, 0.0, 0, &mut ()).unwrap();
                    // The edges above and below the middle corner, along the board's y.
                    let corner = |j: f64| {
                        let place = Point3::new(SQUARE_M, j * SQUARE_M, 0.0);
                        camera.project(&(pose * place)).unwrap()
                    };
                    for [a, b] in [[corner(0.0), corner(1.0)], [corner(1.0), corner(2.0)]] {
                        let slope = (b.x - a.x) / (b.y - a.y);
                        // Far enough from both ends for windows of 5 pixels on either side.
                        let (top, bottom) = (a.y.min(b.y) + 8.0, a.y.max(b.y) - 8.0);
                        for v in top.ceil() as u32..bottom.floor() as u32 {
                            let truth = a.x + slope * (f64::from(v) - a.y);
                            let middle = truth.round() as u32;
                            let found = crossing(&image, middle - 5..middle + 6, v);
                            assert!(
                                (found - truth).abs() < 0.01,
                                "{degrees} {tip_rad} {v}: {found} {truth}"
                            );
                            num_rows += 1;
                        }
                    }
                }
            }
        }
        assert!(num_rows > 1000, "{num_rows}");
    }

    /// A frontal disk has the area and the center of its circle.
    #[test]
    fn disks_are_exact() {
        let board = Board::new(Pattern::AsymmetricCircles, 3, 3, SQUARE_M).unwrap();
        let camera = camera();
        for offset_px in [0.0, 0.13, 0.37, 0.5, 0.71] {
            let pose = pose(&board, 0.7, 0.0, offset_px);
            let image = render_board(&board, &camera, &pose, 0.0, 0, &mut ()).unwrap();
            let mark = board.mark(4);
            let center = camera
                .project(&(pose * Point3::new(mark.x, mark.y, 0.0)))
                .unwrap();
            let radius_px = 0.45 * SQUARE_M * 300.0 / 0.25;
            let (mut area, mut moment) = (0.0, Vector2::zeros());
            for (u, v, value) in image.enumerate_pixels() {
                let from = Vector2::new(f64::from(u), f64::from(v)) - center.coords;
                if from.norm() < radius_px + 3.0 {
                    let dark = (WHITE - f64::from(value.0[0])) / (WHITE - BLACK);
                    area += dark;
                    moment += from * dark;
                }
            }
            assert!((area - PI * radius_px * radius_px).abs() < 0.01, "{area}");
            // A gray value gives the covered area of its pixel but not its position: the centroid
            // is accurate to 1/1000 px.
            assert!((moment / area).norm() < 1e-3, "{}", moment / area);
        }
    }
}
