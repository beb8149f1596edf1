//! Undistorted photos with neighbors and depth ranges.

use super::neighbors::{choose_neighbors, depth_range};
use super::options::{MAX_NEIGHBORS, MvsOptions};
use crate::calibration::{Keep, Undistortion};
use crate::camera::{Camera, PosedCamera};
use crate::progress::{Monitor, Part, Stage, report};
use crate::sfm::Reconstruction;
use crate::{Error, Result};
use image::RgbImage;
use image::imageops::{FilterType, resize};
use nalgebra::{Point2, Vector3};

/// An undistorted photo for multi-view stereo.
#[derive(Debug, Clone, PartialEq)]
pub struct MvsView {
    /// Index of the image in the reconstruction.
    pub photo: usize,
    /// Camera without distortion, with the size of the image.
    pub camera: PosedCamera,
    /// Undistorted pixels.
    pub image: RgbImage,
    /// Indices of the views to compare with, best first; 1 to 16.
    pub neighbors: Vec<usize>,
    /// Minimum and maximum depth to search, in the unit of the reconstruction.
    pub depth_range: [f64; 2],
}

impl MvsView {
    /// Returns the ray of a pixel by its index, row by row, at depth 1.
    pub(super) fn ray(&self, pixel: usize) -> Vector3<f64> {
        let width = self.image.width() as usize;
        let (u, v) = ((pixel % width) as f64, (pixel / width) as f64);
        self.camera.camera.intrinsics.ray(&Point2::new(u, v))
    }
}

/// Undistorts and downscales the photos of a reconstruction, and chooses the neighbors and the
/// depth range of each from its points.
///
/// * `photos`: one for each image of the reconstruction, with the size of its camera; those of
///   images without a camera are ignored
/// * `monitor`: the only stage is [`Stage::Warping`]
///
/// Photos without common points with another one at a sufficient angle are left out.
///
/// # Errors
/// [`Error::SizeMismatch`] for a photo with another size than its camera, or another number of
/// photos than images; [`Error::TooFew`] for fewer than two images with a camera, or no points;
/// [`Error::Degenerate`] if no two photos have common points at a sufficient angle, and as
/// [`Undistortion::new`]; [`Error::OutOfRange`] for an option outside its range;
/// [`Error::Canceled`].
#[doc(alias = "image_undistorter")]
pub fn prepare_views(
    reconstruction: &Reconstruction,
    photos: &[RgbImage],
    options: &MvsOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<MvsView>> {
    options.check()?;
    check_input(reconstruction, photos)?;
    let neighbors = choose_neighbors(reconstruction, options);
    let mut place = vec![None; photos.len()];
    let chosen: Vec<(usize, [f64; 2])> = (0..photos.len())
        .filter(|&photo| !neighbors[photo].is_empty())
        .filter_map(|photo| Some((photo, depth_range(reconstruction, photo)?)))
        .collect();
    for (index, &(photo, _)) in chosen.iter().enumerate() {
        place[photo] = Some(index);
    }
    let mut undistortion = None;
    let mut views = Vec::new();
    for (index, &(photo, depth_range)) in chosen.iter().enumerate() {
        let [from, to] = [index, index + 1].map(|index| index as f32 / chosen.len() as f32);
        let mut part = Part::new(monitor, from, to).of_stage(Stage::Warping);
        let Some(posed) = &reconstruction.cameras[photo] else {
            continue;
        };
        let (camera, image) = prepare(
            &posed.camera,
            &photos[photo],
            options,
            &mut undistortion,
            &mut part,
        )?;
        views.push(MvsView {
            photo,
            camera: PosedCamera {
                camera,
                cam_from_world: posed.cam_from_world,
            },
            image,
            neighbors: neighbors[photo].iter().filter_map(|&n| place[n]).collect(),
            depth_range,
        });
    }
    if views.is_empty() {
        return Err(Error::Degenerate {
            what: "the depth of the photos",
            why: "no two of them show the same points from different places; take photos that overlap, with steps to \
                  the side",
        });
    }
    Ok(views)
}

fn check_input(reconstruction: &Reconstruction, photos: &[RgbImage]) -> Result<()> {
    let mismatch = |what, first, second| {
        Err(Error::SizeMismatch {
            what,
            first,
            second,
        })
    };
    let num_images = reconstruction.cameras.len();
    if num_images != photos.len() {
        return mismatch("the lists of cameras and photos", num_images, photos.len());
    }
    let num_registered = reconstruction.num_registered();
    if num_registered < 2 {
        return Err(Error::TooFew {
            what: "multi-view stereo of photos with known cameras",
            needed: 2,
            got: num_registered,
        });
    }
    if reconstruction.points.is_empty() {
        return Err(Error::TooFew {
            what: "the choice of neighbors and depths by points of the reconstruction",
            needed: 1,
            got: 0,
        });
    }
    for (camera, photo) in reconstruction.cameras.iter().zip(photos) {
        let Some(posed) = camera else { continue };
        for (what, first, second) in [
            (
                "the widths of a camera and its photo",
                posed.camera.width,
                photo.width(),
            ),
            (
                "the heights of a camera and its photo",
                posed.camera.height,
                photo.height(),
            ),
        ] {
            if first != second {
                return mismatch(what, first as usize, second as usize);
            }
        }
    }
    Ok(())
}

/// Downscales a photo, then undistorts it; returns it with its camera.
///
/// * `last`: undistortion of the previous photo, which usually applies to this one as well
fn prepare(
    camera: &Camera,
    photo: &RgbImage,
    options: &MvsOptions,
    last: &mut Option<(Camera, Undistortion)>,
    monitor: &mut dyn Monitor,
) -> Result<(Camera, RgbImage)> {
    let size = (camera.width, camera.height);
    let longer = size.0.max(size.1);
    report(monitor, Stage::Warping, 0.0)?;
    let scaled = |side: u32| {
        let scaled = u64::from(side) * u64::from(options.max_size_px) / u64::from(longer.max(1));
        (scaled as u32).max(1)
    };
    let (camera, image) = match longer > options.max_size_px {
        false => (*camera, photo.clone()),
        true => {
            let small = (scaled(size.0), scaled(size.1));
            let reduced = Camera {
                intrinsics: camera.intrinsics.resized(size, small)?,
                lens: camera.lens,
                width: small.0,
                height: small.1,
            };
            (
                reduced,
                resize(photo, small.0, small.1, FilterType::Triangle),
            )
        }
    };
    if camera.is_pinhole() {
        return Ok((camera, image));
    }
    let flat = match last.take() {
        Some((of, flat)) if of == camera => flat,
        _ => Undistortion::new(&camera, Keep::Valid, &mut Part::new(monitor, 0.0, 0.5))?,
    };
    let undistorted = (flat.map).warp(&image, &mut Part::new(monitor, 0.5, 1.0))?;
    let pinhole = Camera::pinhole(flat.intrinsics, camera.width, camera.height);
    *last = Some((camera, flat));
    Ok((pinhole, undistorted))
}

/// Checks views from a caller.
pub(super) fn check_views(views: &[MvsView]) -> Result<()> {
    for view in views {
        let camera = &view.camera.camera;
        if (camera.width, camera.height) != view.image.dimensions() {
            return Err(Error::SizeMismatch {
                what: "the widths of a camera and its photo",
                first: camera.width as usize,
                second: view.image.width() as usize,
            });
        }
        if !camera.is_pinhole() {
            return Err(Error::Degenerate {
                what: "the depth of a photo",
                why: "its camera has distortion; remove it first, as prepare_views does",
            });
        }
        let side = camera.width.min(camera.height);
        let count = view.neighbors.len();
        let farthest = view.neighbors.iter().copied().max().unwrap_or(0);
        let [near, far] = view.depth_range;
        Error::check_rules(&[
            (
                "the shorter side of a photo",
                "at least 1 pixel",
                f64::from(side),
                side >= 1,
            ),
            (
                "the number of neighbors of a photo",
                "1 to 16",
                count as f64,
                (1..=MAX_NEIGHBORS).contains(&count),
            ),
            (
                "the index of a neighbor",
                "that of a view",
                farthest as f64,
                farthest < views.len(),
            ),
            (
                "the smallest depth of a photo",
                "greater than 0",
                near,
                near > 0.0 && near.is_finite(),
            ),
            (
                "the largest depth of a photo",
                "greater than the smallest",
                far,
                far > near && far.is_finite(),
            ),
        ])?;
    }
    Ok(())
}
