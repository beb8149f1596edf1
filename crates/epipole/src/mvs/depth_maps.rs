//! Coarse-to-fine estimation of the depth maps of all photos.

use super::consistency::{Agreement, agreements, num_needed};
use super::depth_map::DepthMap;
use super::field::Surface;
use super::hypothesis_cost::{Matching, Neighbor};
use super::level::{Level, num_levels};
use super::options::MvsOptions;
use super::pair::Pair;
use super::patch::gray_weights;
use super::sweep::{Pass, Round, mixed};
use super::views::{MvsView, check_views};
use crate::Result;
use crate::feature::photo_to_gray;
use crate::math::parallel;
use crate::progress::{Monitor, Part, Stage, report};
use image::{ImageBuffer, Luma};
use nalgebra::{Point2, Vector3};

/// Number of rows between two reports of the filter.
const ROWS: usize = 64;
/// Number of rounds from random planes at the coarsest resolution.
const FIRST_ROUNDS: usize = 6;
/// Progress when only the filter is left.
const ESTIMATED: f32 = 0.95;
/// Maximum change of a normal in the first round; halved in each further round.
const FIRST_NORMAL: f64 = 1.0;
/// Minimum and maximum change of the inverse depth in the rounds of a later pass, as pixels of
/// motion in a neighbor.
const STEPS_PX: [f64; 2] = [0.5, 2.0];

/// Estimates depth and normal of each pixel of each view.
///
/// PatchMatch with slanted planes: each pixel takes the plane of a neighboring pixel, or a random
/// perturbation, if that lowers the cost. The cost is one minus the bilaterally weighted
/// correlation of an 11 × 11 patch, averaged over the
/// [`num_best_neighbors`](MvsOptions::num_best_neighbors) best views, plus, after a first pass at
/// the coarsest resolution, the reprojection errors by the neighbors' depth maps. Each resolution
/// continues from half its size. Finally, a depth is kept if [`min_views`](MvsOptions::min_views)
/// photos agree on it.
///
/// * `views`: from [`prepare_views`](super::prepare_views)
/// * `monitor`: the only stage is [`Stage::DepthEstimation`]
///
/// # Errors
/// [`Error::OutOfRange`](crate::Error::OutOfRange) for an invalid option, neighbor or depth range,
/// [`Error::SizeMismatch`](crate::Error::SizeMismatch) for an image with another size than its
/// camera, [`Error::Degenerate`](crate::Error::Degenerate) for a camera with distortion,
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Galliani et al. 2015; Schönberger et al. 2016; Xu & Tao 2019.
#[doc(alias = "patch_match_stereo")]
pub fn estimate_depth_maps(
    views: &[MvsView],
    options: &MvsOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<DepthMap>> {
    options.check()?;
    check_views(views)?;
    let schedule = schedule(num_levels(views), options);
    let work = |level: &LevelPlan| level.num_passes() as f32 / (1 << (2 * level.halvings)) as f32;
    let total: f32 = schedule.iter().map(work).sum();
    let mut surfaces = Vec::new();
    let mut done = 0.0;
    for (number, plan) in schedule.iter().enumerate() {
        let fraction = ESTIMATED * work(plan) / total;
        let mut part = Part::new(monitor, done, done + fraction);
        surfaces = plan.run(views, surfaces, (number, options), &mut part)?;
        done += fraction;
    }
    let mut maps = Vec::new();
    for (view, surface) in views.iter().zip(surfaces) {
        report(monitor, Stage::DepthEstimation, done)?;
        maps.push(to_depth_map(view, surface, options));
    }
    let mut part = Part::new(monitor, done, 1.0);
    keep_confirmed(views, &mut maps, options, &mut part)?;
    Ok(maps)
}

/// Passes over all photos at one resolution.
struct LevelPlan {
    halvings: usize,
    num_rounds: usize,
    /// Whether to start from random planes, without the maps of neighbors.
    is_first: bool,
}

fn schedule(num_levels: usize, options: &MvsOptions) -> Vec<LevelPlan> {
    let coarsest = num_levels - 1;
    let first = LevelPlan {
        halvings: coarsest,
        num_rounds: FIRST_ROUNDS,
        is_first: true,
    };
    let others = (0..num_levels).rev().map(|halvings| LevelPlan {
        halvings,
        num_rounds: options.num_rounds,
        is_first: false,
    });
    std::iter::once(first).chain(others).collect()
}

impl LevelPlan {
    fn num_passes(&self) -> usize {
        self.num_rounds + 1
    }

    /// Computes the surfaces of all photos from those of the previous pass.
    fn run(
        &self,
        views: &[MvsView],
        before: Vec<Surface>,
        (number, options): (usize, &MvsOptions),
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<Surface>> {
        let mut levels = Vec::new();
        for view in views {
            report(monitor, Stage::DepthEstimation, 0.0)?;
            levels.push(Level::new(
                view,
                &photo_to_gray(&view.image),
                self.halvings,
            )?);
        }
        let mut surfaces = Vec::new();
        for photo in 0..views.len() {
            let fraction = |photo: usize| photo as f32 / views.len() as f32;
            let mut part = Part::new(monitor, fraction(photo), fraction(photo + 1));
            let matching = matching(views, &levels, &before, photo, options);
            let pass = Pass {
                matching: &matching,
                seed: mixed(options.seed, number as u64, photo as u64),
            };
            surfaces.push(self.match_photo(&pass, before.get(photo), &mut part)?);
        }
        Ok(surfaces)
    }

    fn match_photo(
        &self,
        pass: &Pass<'_>,
        before: Option<&Surface>,
        monitor: &mut dyn Monitor,
    ) -> Result<Surface> {
        let fraction = |done: usize| done as f32 / self.num_passes() as f32;
        let mut field = pass.start(before, &mut Part::new(monitor, 0.0, fraction(1)))?;
        for number in 0..self.num_rounds {
            let mut part = Part::new(monitor, fraction(number + 1), fraction(number + 2));
            let round = self.round(pass.matching, number);
            pass.round(&mut field, (number as u64, &round), &mut part)?;
        }
        Ok(field.into_surface())
    }

    fn round(&self, matching: &Matching<'_>, number: usize) -> Round {
        let halved = 1.0 / f64::from(1u32 << number.min(20));
        let pairs = matching.neighbors.iter().map(|n| n.to.px_per_inverse_depth);
        let step_px = pairs.clone().sum::<f64>() / pairs.count() as f64;
        let [fine, coarse] = STEPS_PX.map(|px| px / step_px);
        let [low, high] = matching.range.map(f64::from);
        match self.is_first {
            true => Round {
                inverse_depth: (0.5 * halved * (high - low)).max(fine),
                normal: FIRST_NORMAL * halved,
                is_wild: true,
                chooses_views: true,
            },
            false => Round {
                inverse_depth: (coarse * halved).max(0.5 * fine),
                normal: 0.25 * FIRST_NORMAL * halved,
                is_wild: false,
                chooses_views: false,
            },
        }
    }
}

/// Returns a photo and its neighbors at one resolution.
fn matching<'a>(
    views: &[MvsView],
    levels: &'a [Level],
    before: &'a [Surface],
    photo: usize,
    options: &MvsOptions,
) -> Matching<'a> {
    let here = &levels[photo];
    let neighbor = |&neighbor: &usize| {
        let there = &levels[neighbor];
        Neighbor {
            level: there,
            to: Pair::new(&here.camera, &there.camera),
            from: Pair::new(&there.camera, &here.camera),
            surface: before.get(neighbor).map(|s| (s, s.scale(there))),
        }
    };
    let [near, far] = views[photo].depth_range;
    Matching {
        level: here,
        neighbors: views[photo].neighbors.iter().map(neighbor).collect(),
        num_best: options.num_best_neighbors,
        range: [1.0 / far, 1.0 / near].map(|w| w as f32),
        gray_weights: gray_weights(),
    }
}

/// Returns depths and normals of the planes that fit.
fn to_depth_map(view: &MvsView, surface: Surface, options: &MvsOptions) -> DepthMap {
    let intrinsics = &view.camera.camera.intrinsics;
    let (width, height) = (surface.width as u32, surface.height as u32);
    let max_cost = (1.0 - options.min_correlation) as f32;
    let depth =
        (surface.planes.iter().zip(&surface.costs)).map(|(plane, cost)| match *cost <= max_cost {
            true => 1.0 / plane.inverse_depth,
            false => f32::NAN,
        });
    let depth = ImageBuffer::<Luma<f32>, _>::from_raw(width, height, depth.collect::<Vec<f32>>())
        .expect("one depth for every pixel");
    let mut normals = vec![Vector3::zeros(); surface.planes.len()];
    parallel::for_each_chunk(&mut normals, surface.width, |first, row| {
        for (u, normal) in row.iter_mut().enumerate() {
            let pixel = Point2::new(u as f64, (first / surface.width) as f64);
            *normal = surface.planes[first + u].normal(intrinsics, &pixel).cast();
        }
    });
    DepthMap {
        depth,
        num_views: vec![1; normals.len()],
        normals,
    }
}

/// Counts the photos that agree on each depth, and keeps depths with enough agreement.
fn keep_confirmed(
    views: &[MvsView],
    maps: &mut [DepthMap],
    options: &MvsOptions,
    monitor: &mut dyn Monitor,
) -> Result<()> {
    let mut counts = Vec::new();
    for photo in 0..views.len() {
        let fraction = |photo: usize| photo as f32 / views.len() as f32;
        let mut part = Part::new(monitor, fraction(photo), fraction(photo + 1));
        counts.push(confirmations(views, maps, (photo, options), &mut part)?);
    }
    for ((map, counts), view) in maps.iter_mut().zip(counts).zip(views) {
        let needed = num_needed(options, view.neighbors.len());
        map.num_views = counts;
        for pixel in 0..map.num_views.len() {
            if usize::from(map.num_views[pixel]) < needed {
                map.clear(pixel);
            }
        }
    }
    Ok(())
}

/// Returns the number of photos that agree on the depth of each pixel; 0 without depth.
fn confirmations(
    views: &[MvsView],
    maps: &[DepthMap],
    (photo, options): (usize, &MvsOptions),
    monitor: &mut dyn Monitor,
) -> Result<Vec<u8>> {
    let map = &maps[photo];
    let agreements = agreements(views, maps, photo, options);
    let width = map.depth.width() as usize;
    let mut counts = vec![0u8; map.normals.len()];
    let num_pixels = counts.len();
    for (band, part) in counts.chunks_mut(ROWS * width).enumerate() {
        let start = band * ROWS * width;
        report(
            monitor,
            Stage::DepthEstimation,
            start as f32 / num_pixels as f32,
        )?;
        parallel::for_each_chunk(part, width, |first, row| {
            let v = ((start + first) / width) as f64;
            for (u, count) in row.iter_mut().enumerate() {
                let place = start + first + u;
                let depth = f64::from(map.depth.as_raw()[place]);
                if depth.is_nan() {
                    continue;
                }
                let agrees = |agreement: &&Agreement<'_>| {
                    let normal = &map.normals[place];
                    agreement.pixel([u as f64, v], depth, normal).is_some()
                };
                *count = 1 + agreements.iter().filter(agrees).count() as u8;
            }
        });
    }
    Ok(counts)
}
