//! Fusion of the depth maps of all photos to a point cloud.

use super::consistency::{Agreement, agreements, num_needed};
use super::depth_map::DepthMap;
use super::options::MvsOptions;
use super::views::{MvsView, check_views};
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage};
use crate::stereo::PointCloud;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

/// Fuses depth maps to a point cloud with normals, colors, and the numbers of photos as
/// confidences.
///
/// Photo by photo, a pixel and the neighbors' pixels that agree with it give one point, with mean
/// position, normal and color. None of these pixels is used again.
///
/// * `views`, `maps`: input and result of [`estimate_depth_maps`](super::estimate_depth_maps)
/// * `monitor`: the only stage is [`Stage::Fusion`]
///
/// # Errors
/// [`Error::SizeMismatch`] if the maps do not match the views, [`Error::OutOfRange`] for an option
/// outside its range, [`Error::Canceled`].
///
/// Source: Galliani et al. 2015, §5; Schönberger et al. 2016, §4.7.
#[doc(alias = "stereo_fusion")]
pub fn fuse_depth_maps(
    views: &[MvsView],
    maps: &[DepthMap],
    options: &MvsOptions,
    monitor: &mut dyn Monitor,
) -> Result<PointCloud> {
    options.check()?;
    check_views(views)?;
    check_maps(views, maps)?;
    let mut cloud = PointCloud::default();
    let mut is_used: Vec<Vec<bool>> = maps
        .iter()
        .map(|map| vec![false; map.normals.len()])
        .collect();
    for photo in 0..views.len() {
        let fusion = Fusion {
            views,
            maps,
            photo,
            agreements: agreements(views, maps, photo, options),
            needed: num_needed(options, views[photo].neighbors.len()),
        };
        let rows: Vec<usize> = (0..maps[photo].depth.height() as usize).collect();
        let [from, to] = [photo, photo + 1].map(|photo| photo as f32 / views.len() as f32);
        let mut part = Part::new(monitor, from, to);
        // Only other photos use pixels of this one, so rows are independent.
        let used = &is_used[photo];
        let found = monitored::map(&rows, Stage::Fusion, &mut part, |&row| {
            fusion.row(row, used)
        })?;
        for fused in found.into_iter().flatten() {
            for (neighbor, pixel) in fused.members {
                is_used[neighbor][pixel] = true;
            }
            cloud.points.push(fused.point);
            cloud.normals.push(fused.normal);
            cloud.colors.push(fused.color);
            cloud.confidences.push(fused.confidence);
        }
    }
    Ok(cloud)
}

pub(super) fn check_maps(views: &[MvsView], maps: &[DepthMap]) -> Result<()> {
    let mismatch = |what, first, second| Error::SizeMismatch {
        what,
        first,
        second,
    };
    if views.len() != maps.len() {
        return Err(mismatch(
            "the lists of views and depth maps",
            views.len(),
            maps.len(),
        ));
    }
    for (view, map) in views.iter().zip(maps) {
        let num_pixels = view.image.width() as usize * view.image.height() as usize;
        let num_depths = map.depth.as_raw().len();
        if view.image.dimensions() != map.depth.dimensions() {
            return Err(mismatch(
                "a photo and its depth map",
                num_pixels,
                num_depths,
            ));
        }
        for len in [map.normals.len(), map.num_views.len()] {
            if len != num_depths {
                return Err(mismatch("the depths and normals of a map", num_depths, len));
            }
        }
    }
    Ok(())
}

/// A point of the cloud, and the pixels of neighbors fused into it.
struct Fused {
    point: Point3<f64>,
    normal: Vector3<f64>,
    color: [u8; 3],
    confidence: f32,
    members: Vec<(usize, usize)>,
}

/// Fusion of the pixels of one photo.
struct Fusion<'a> {
    views: &'a [MvsView],
    maps: &'a [DepthMap],
    photo: usize,
    agreements: Vec<Agreement<'a>>,
    needed: usize,
}

impl Fusion<'_> {
    /// Returns the points of a row.
    fn row(&self, row: usize, is_used: &[bool]) -> Vec<Fused> {
        let map = &self.maps[self.photo];
        let width = map.depth.width() as usize;
        let mut points = Vec::new();
        for pixel in row * width..(row + 1) * width {
            let depth = f64::from(map.depth.as_raw()[pixel]);
            if is_used[pixel] || depth.is_nan() {
                continue;
            }
            let place = [(pixel - row * width) as f64, row as f64];
            let agree = |agreement: &Agreement<'_>| {
                let found = agreement.pixel(place, depth, &map.normals[pixel])?;
                Some((agreement.neighbor, found))
            };
            let members: Vec<(usize, usize)> = self.agreements.iter().filter_map(agree).collect();
            if members.len() + 1 >= self.needed {
                points.push(self.mean(pixel, members));
            }
        }
        points
    }

    /// Returns the mean of a pixel and those that agree with it.
    fn mean(&self, pixel: usize, members: Vec<(usize, usize)>) -> Fused {
        let (mut point, mut normal, mut color) = (Vector3::zeros(), Vector3::zeros(), [0.0f64; 3]);
        for &(photo, pixel) in std::iter::once(&(self.photo, pixel)).chain(&members) {
            let (view, map) = (&self.views[photo], &self.maps[photo]);
            let width = map.depth.width() as usize;
            let (u, v) = (pixel % width, pixel / width);
            let ray = view
                .camera
                .camera
                .intrinsics
                .ray(&Point2::new(u as f64, v as f64));
            let in_cam = Point3::from(ray * f64::from(map.depth.as_raw()[pixel]));
            let cam_from_world = &view.camera.cam_from_world;
            point += cam_from_world.inverse_transform_point(&in_cam).coords;
            normal += cam_from_world.inverse_transform_vector(&map.normals[pixel].cast());
            let rgb = view.image.get_pixel(u as u32, v as u32).0;
            for (total, value) in color.iter_mut().zip(rgb) {
                *total += f64::from(value);
            }
        }
        let count = members.len() as f64 + 1.0;
        Fused {
            point: Point3::from(point / count),
            normal: normal.try_normalize(0.0).unwrap_or_default(),
            color: color.map(|total| (total / count).round() as u8),
            confidence: count as f32,
            members,
        }
    }
}
