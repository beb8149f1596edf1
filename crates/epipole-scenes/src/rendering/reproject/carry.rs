//! Forward warping of pixels from one picture to another, far ones before near ones.
//!
//! Pixels are visited in an order in which near ones cover far ones without depth comparisons
//! (McMillan and Bishop 1995, "Plenoptic Modeling", section 4): along epipolar lines, towards the
//! epipole if the other camera is in front of this one, away from it if it is behind.

use crate::rendering::Photograph;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::{Error, Result};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Near plane of the other camera, meters; nearer points are dropped.
pub(super) const NEAR_M: f32 = 0.02;
/// Maximum side of the square drawn for a pixel, pixels.
const LARGEST: f32 = 6.0;
/// Enlargement of squares relative to a fronto-parallel surface, for slanted ones.
const SLANT: f32 = 1.15;

/// Warp of pixels from one picture to the other: `(map · (u, v, 1)) z + shift`, up to scale.
pub(super) struct Carry {
    map: Matrix3<f32>,
    shift: Vector3<f32>,
    /// Epipole: projection of the other camera, pixels, clamped to the picture; and whether that
    /// camera is in front.
    epipole: (u32, u32),
    is_ahead: bool,
    /// Side of a pixel in the other picture at equal depth, pixels.
    zoom: f32,
    size: (u32, u32),
}

impl Carry {
    pub(super) fn new(from: &PosedCamera, to: &PosedCamera, size: (u32, u32)) -> Result<Self> {
        let motion: RigidTransform = to.cam_from_world * from.cam_from_world.inverse();
        let matrix = to.camera.intrinsics.matrix();
        let map = matrix
            * motion.rotation.to_rotation_matrix().matrix()
            * from.camera.intrinsics.inverse_matrix();
        let shift = matrix * motion.translation.vector;
        if !map.iter().chain(shift.iter()).all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "the places and directions of the cameras",
            });
        }
        let center = from.cam_from_world * to.center_in_world();
        // A distant epipole gives the same order as one at infinity.
        let depth = if center.z.abs() < 1e-9 {
            1e-9
        } else {
            center.z
        };
        let image = from.camera.intrinsics.matrix() * center.coords / depth;
        let place = |at: f64, size: u32| (at + 0.5).clamp(0.0, f64::from(size)) as u32;
        Ok(Self {
            map: map.map(|x| x as f32),
            shift: shift.map(|x| x as f32),
            epipole: (place(image.x, size.0), place(image.y, size.1)),
            is_ahead: depth > 0.0,
            zoom: (to.camera.intrinsics.fu_px() / from.camera.intrinsics.fu_px()) as f32,
            size,
        })
    }

    /// Returns the warp for pixels of an object that has moved in the world by `by`, meters.
    pub(super) fn moved(self, to: &PosedCamera, by: &Vector3<f64>) -> Self {
        let shift = to.camera.intrinsics.matrix() * (to.cam_from_world.rotation * by);
        Self {
            shift: self.shift + shift.map(|x| x as f32),
            ..self
        }
    }

    /// Warps all pixels with a depth, far ones before near ones.
    pub(super) fn all(&self, photo: &Photograph, depths: &[f32], target: &mut [u32]) {
        let [columns, rows] = [(self.epipole.0, self.size.0), (self.epipole.1, self.size.1)]
            .map(|(epipole, size)| self.order(epipole, size));
        for row in rows {
            for v in row.places() {
                for run in &columns {
                    let row = (v, row.is_upward);
                    self.run(photo, depths, (run, row), target);
                }
            }
        }
    }

    /// Returns the rows or columns on both sides of the epipole, towards it or away from it.
    fn order(&self, epipole: u32, size: u32) -> [Run; 2] {
        let [before, after] = [0..epipole, epipole..size];
        let run = |places, is_upward| Run { places, is_upward };
        [run(before, self.is_ahead), run(after, !self.is_ahead)]
    }

    /// Warps the pixels of a part of a row.
    pub(super) fn run(
        &self,
        photo: &Photograph,
        depths: &[f32],
        (run, (v, is_downward)): (&Run, (u32, bool)),
        target: &mut [u32],
    ) {
        let (width, height) = (self.size.0 as usize, self.size.1 as usize);
        let row = v as usize * width..(v as usize + 1) * width;
        let depths = &depths[row.clone()];
        let colors = &photo.image.as_raw().as_chunks::<3>().0[row];
        let way = Way {
            base: std::array::from_fn(|i| self.map[(i, 1)] * v as f32 + self.map[(i, 2)]),
            slope: std::array::from_fn(|i| self.map[(i, 0)]),
            shift: self.shift.into(),
            zoom: self.zoom,
            size: [width as f32, height as f32],
            is_upward: [run.is_upward, is_downward],
        };
        let mut squares = Squares::default();
        for piece in run.pieces() {
            let mut near = [0.0; AT_ONCE];
            near[..piece.len()].copy_from_slice(&depths[piece.clone()]);
            way.find(piece.start as f32, &near, &mut squares);
            let colors = &colors[piece];
            for step in 0..colors.len() {
                let index = match run.is_upward {
                    true => step,
                    false => colors.len() - 1 - step,
                };
                let side = squares.side[index] as usize;
                if side == 0 {
                    continue;
                }
                let (left, top) = (squares.left[index] as usize, squares.top[index] as usize);
                let [r, g, b] = colors[index];
                let pixel = u32::from_le_bytes([r, g, b, 255]);
                // Special cases: most squares have one or four pixels.
                let at = top * width + left;
                if side == 2 && left + 2 <= width && top + 2 <= height {
                    let rows = &mut target[at..at + width + 2];
                    (rows[0], rows[1]) = (pixel, pixel);
                    (rows[width], rows[width + 1]) = (pixel, pixel);
                } else if side == 1 {
                    target[at] = pixel;
                } else {
                    for row in top..(top + side).min(height) {
                        let end = (left + side).min(width);
                        target[row * width + left..row * width + end].fill(pixel);
                    }
                }
            }
        }
    }
}

/// Number of neighbors whose squares are computed together.
const AT_ONCE: usize = 8;

/// Squares of neighbors in the other picture, pixels; those outside have side 0.
#[derive(Default)]
struct Squares {
    left: [i32; AT_ONCE],
    top: [i32; AT_ONCE],
    side: [i32; AT_ONCE],
}

/// Warp of the pixels of a row: `(slope u + base) z + shift`, up to scale.
struct Way {
    slope: [f32; 3],
    base: [f32; 3],
    shift: [f32; 3],
    zoom: f32,
    /// Width and height of the other picture.
    size: [f32; 2],
    /// Whether columns and rows are visited in increasing order.
    is_upward: [bool; 2],
}

impl Way {
    /// Computes the squares of the neighbors from a column on; branch-free for vector instructions.
    ///
    /// * `depths`: 0 for no pixel
    #[inline(always)]
    fn find(&self, column: f32, depths: &[f32; AT_ONCE], squares: &mut Squares) {
        for index in 0..AT_ONCE {
            let (x, z) = (column + index as f32, depths[index]);
            let along = |i: usize| (self.slope[i] * x + self.base[i]) * z + self.shift[i];
            let depth = along(2);
            let inverse = 1.0 / depth;
            let zoom = self.zoom * z * inverse;
            // `f32::min` would be a call.
            let reach = zoom * SLANT;
            // Processors cast to signed integers in one instruction.
            let side = if reach < LARGEST { reach } else { LARGEST } as i32 + 1;
            // A square covers the gap to the next one, which is drawn later and covers the rest.
            let half = 0.5 * (zoom - 1.0);
            let first = |is_upward: bool| match is_upward {
                true => 0.5 - half,
                false => 1.5 + half - side as f32,
            };
            // Squares that cross the left or upper edge are dropped: they are small, and a draft
            // fills the edge.
            let left = along(0) * inverse + first(self.is_upward[0]);
            let top = along(1) * inverse + first(self.is_upward[1]);
            let is_there = (z > 0.0)
                & (depth > NEAR_M)
                & (left >= 0.0)
                & (top >= 0.0)
                & (left < self.size[0])
                & (top < self.size[1]);
            squares.left[index] = left as i32;
            squares.top[index] = top as i32;
            squares.side[index] = if is_there { side } else { 0 };
        }
    }
}

/// Range of a row or column with its direction.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub(super) places: Range<u32>,
    pub(super) is_upward: bool,
}

impl Run {
    /// Splits the range into groups of neighbors, in this direction.
    fn pieces(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (start, end) = (self.places.start as usize, self.places.end as usize);
        let count = (end - start).div_ceil(AT_ONCE);
        let is_upward = self.is_upward;
        (0..count).map(move |step| {
            let index = if is_upward { step } else { count - 1 - step };
            let first = start + index * AT_ONCE;
            first..(first + AT_ONCE).min(end)
        })
    }

    fn places(&self) -> impl Iterator<Item = u32> + use<> {
        // Counting down adds `u32::MAX`, with wrapping.
        let (first, step) = match self.is_upward {
            true => (self.places.start, 1),
            false => (self.places.end.wrapping_sub(1), u32::MAX),
        };
        (0..self.places.len() as u32).map(move |index| first.wrapping_add(index.wrapping_mul(step)))
    }
}
