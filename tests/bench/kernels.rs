//! Kernels of the browser benchmark as a bare WebAssembly module, which passes numbers through its
//! memory. `tests/browser/opencv.mjs` compares it with opencv.js.
//!
//! A page writes inputs to `floats` or `doubles`, calls `prepare` once and `run` repeatedly, then
//! calls `result` and reads `floats(2, …)` or `doubles`.

#![allow(unsafe_code, reason = "exported names must not be mangled")]
#![allow(unreachable_pub, reason = "exports have no other user")]

use epipole::epipolar::estimate_fundamental;
use epipole::feature::{
    Descriptors, Neighbors, StructureTensorOptions, Window, harris_response, nearest_two,
};
use epipole::homography::estimate_homography;
use epipole::imaging::{
    Border, Gradient, GrayImage32, gaussian_kernel, gray_from_values, separable_filter, sobel,
};
use epipole::robust::RansacOptions;
use epipole::stereo::StereoSgm;
use image::{GrayImage, Luma};
use nalgebra::{Matrix3, Point2};
use std::cell::RefCell;

/// State kept between calls of the page.
#[derive(Default)]
struct Room {
    floats: [Vec<f32>; 3],
    doubles: Vec<f64>,
    frame: GrayImage32,
    gradient: Option<Gradient>,
    response: GrayImage32,
    descriptors: Option<[Descriptors; 2]>,
    neighbors: Vec<Neighbors>,
    matches: [Vec<Point2<f64>>; 2],
    found: Matrix3<f64>,
    pair: [GrayImage; 2],
    disparities: Vec<f32>,
}

thread_local! {
    static ROOM: RefCell<Room> = RefCell::default();
}

const SOBEL: usize = 0;
const GAUSSIAN: usize = 1;
const HARRIS: usize = 2;
const MATCH: usize = 3;
const HOMOGRAPHY: usize = 4;
const FUNDAMENTAL: usize = 5;
const SEMI_GLOBAL: usize = 6;

/// Resizes a buffer to `length` numbers and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn floats(index: usize, length: usize) -> *mut f32 {
    ROOM.with_borrow_mut(|room| {
        room.floats[index].resize(length, 0.0);
        room.floats[index].as_mut_ptr()
    })
}

/// Resizes the buffer of double precision, likewise.
#[unsafe(no_mangle)]
pub extern "C" fn doubles(length: usize) -> *mut f64 {
    ROOM.with_borrow_mut(|room| {
        room.doubles.resize(length, 0.0);
        room.doubles.as_mut_ptr()
    })
}

/// Takes the input of a kernel: an image of `width` × `height` from `floats(0)`; two lists of
/// `height` descriptors of `width` numbers from `floats(0)` and `floats(1)`; `height` matches u1 v1
/// u2 v2 from `doubles`; a rectified pair of gray values 0 to 255 from `floats(0)` and `floats(1)`.
/// Returns whether it is valid.
#[unsafe(no_mangle)]
pub extern "C" fn prepare(work: usize, width: usize, height: usize) -> bool {
    ROOM.with_borrow_mut(|room| {
        let taken = match work {
            SOBEL | GAUSSIAN | HARRIS => {
                gray_from_values(width as u32, height as u32, room.floats[0].clone()).map(|frame| {
                    room.gradient = Some(sobel(&frame, Border::Reflect101));
                    room.frame = frame;
                })
            }
            MATCH => {
                let list = |values: &Vec<f32>| Descriptors::from_floats(width, values.clone());
                list(&room.floats[0])
                    .and_then(|a| Ok([a, list(&room.floats[1])?]))
                    .map(|both| room.descriptors = Some(both))
            }
            SEMI_GLOBAL => {
                let picture = |values: &Vec<f32>| {
                    GrayImage::from_fn(width as u32, height as u32, |u, v| {
                        Luma([values[v as usize * width + u as usize] as u8])
                    })
                };
                room.pair = [picture(&room.floats[0]), picture(&room.floats[1])];
                Ok(())
            }
            _ => {
                let pixels = |at: usize| -> Vec<Point2<f64>> {
                    let matches = room.doubles.chunks_exact(4);
                    matches.map(|m| Point2::new(m[at], m[at + 1])).collect()
                };
                room.matches = [pixels(0), pixels(2)];
                Ok(())
            }
        };
        taken.is_ok()
    })
}

/// Runs the kernel once. Returns whether it succeeded.
#[unsafe(no_mangle)]
pub extern "C" fn run(work: usize) -> bool {
    ROOM.with_borrow_mut(|room| work_once(room, work).is_ok())
}

fn work_once(room: &mut Room, work: usize) -> epipole::Result<()> {
    match work {
        SOBEL => {
            room.gradient = Some(sobel(&room.frame, Border::Reflect101));
        }
        GAUSSIAN => {
            let kernel = gaussian_kernel(1.1, 5)?;
            room.response =
                separable_filter(&room.frame, &kernel, &kernel, Border::Reflect101, &mut ())?;
        }
        HARRIS => {
            let options = StructureTensorOptions::default()
                .with_window(Window::Box(3))
                .with_scaling(epipole::feature::Scaling::OpenCv);
            room.response = harris_response(&room.frame, 0.04, &options, &mut ())?;
        }
        MATCH => {
            if let Some([first, second]) = &room.descriptors {
                room.neighbors = nearest_two(first, second, &mut ())?;
            }
        }
        HOMOGRAPHY => {
            let [pixels1, pixels2] = &room.matches;
            room.found =
                estimate_homography(pixels1, pixels2, &RansacOptions::default(), &mut ())?.model;
        }
        FUNDAMENTAL => {
            let [pixels1, pixels2] = &room.matches;
            room.found =
                estimate_fundamental(pixels1, pixels2, &RansacOptions::default(), &mut ())?.model;
        }
        SEMI_GLOBAL => {
            let [left, right] = &room.pair;
            let found = StereoSgm::default().compute(left, right, &mut ())?;
            room.disparities = found.as_raw().to_vec();
        }
        _ => {}
    }
    Ok(())
}

/// Copies the last result to `floats(2)`, or a matrix to `doubles`. Returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn result(work: usize) -> usize {
    ROOM.with_borrow_mut(|room| {
        let found: Vec<f32> = match work {
            SOBEL => {
                let gradient = room.gradient.iter();
                let both = gradient.flat_map(|gradient| [&gradient.du, &gradient.dv]);
                both.flat_map(|image| image.as_raw().clone()).collect()
            }
            GAUSSIAN | HARRIS => room.response.as_raw().clone(),
            MATCH => room
                .neighbors
                .iter()
                .map(|near| near.index as f32)
                .collect(),
            SEMI_GLOBAL => room.disparities.clone(),
            _ => {
                // Row-major, as in OpenCV.
                room.doubles = room.found.transpose().as_slice().to_vec();
                return room.doubles.len();
            }
        };
        room.floats[2] = found;
        room.floats[2].len()
    })
}
