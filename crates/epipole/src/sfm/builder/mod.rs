//! State of a growing reconstruction: initialization and registration of images.

mod adjust;
mod place;
mod points;

use super::bundle::Sensor;
use super::options::{SfmOptions, pair_ransac};
use super::reconstruction::{Reconstruction, ScenePoint, SfmImage};
use super::tracks::{PairMatches, TrackElement, build_tracks};
use super::triangulate_track::Sight;
use super::two_view_start::VerifiedPair;
use super::views::Views;
use crate::Result;
use crate::absolute_pose::estimate_absolute_pose;
use crate::camera::{Camera, PosedCamera, RigidTransform};
use crate::progress::Monitor;
use crate::robust::{RansacOptions, SamplerKind};
use nalgebra::Point3;

/// A point and the elements of its track that agree with it.
#[derive(Debug, Clone)]
pub(super) struct TrackPoint {
    pub(super) position: Point3<f64>,
    pub(super) elements: Vec<TrackElement>,
}

pub(super) struct Builder {
    pub(super) images: Vec<SfmImage>,
    pub(super) options: SfmOptions,
    /// Cameras of all images before any refinement.
    first_calibration: Vec<Camera>,
    pub(super) views: Views,
    /// Cameras of all images, refined so far.
    pub(super) calibration: Vec<Camera>,
    pub(super) tracks: Vec<Vec<TrackElement>>,
    /// Track of each keypoint, `u32::MAX` if none.
    pub(super) track_of: Vec<Vec<u32>>,
    /// Images in earlier components.
    pub(super) taken: Vec<bool>,
    /// Second sensor of a stereo rig; its images are the second half.
    pub(super) rig: Option<Sensor>,
    pub(super) cameras: Vec<Option<PosedCamera>>,
    pub(super) points: Vec<Option<TrackPoint>>,
    /// Whether the world is aligned with known positions.
    pub(super) is_placed: bool,
}

impl Builder {
    /// Creates a builder without registered images; [`join_tracks`](Self::join_tracks) adds tracks.
    ///
    /// * `calibration`: camera of each image
    pub(super) fn new(images: &[SfmImage], calibration: Vec<Camera>, options: &SfmOptions) -> Self {
        Self {
            images: images.to_vec(),
            options: options.clone(),
            views: Views::new(images, &calibration),
            first_calibration: calibration.clone(),
            calibration,
            tracks: Vec::new(),
            track_of: Vec::new(),
            taken: vec![false; images.len()],
            rig: None,
            cameras: vec![None; images.len()],
            points: Vec::new(),
            is_placed: false,
        }
    }

    /// Joins matches into tracks.
    pub(super) fn join_tracks(&mut self, pairs: &[PairMatches]) -> Result<()> {
        let counts: Vec<usize> = (self.images.iter())
            .map(|image| image.keypoints.len())
            .collect();
        self.tracks = build_tracks(&counts, pairs)?;
        self.track_of = counts.iter().map(|n| vec![u32::MAX; *n]).collect();
        for (index, track) in self.tracks.iter().enumerate() {
            for element in track {
                self.track_of[element.image as usize][element.keypoint as usize] = index as u32;
            }
        }
        self.points = vec![None; self.tracks.len()];
        Ok(())
    }

    /// Clears cameras, points and refined lenses, for another component.
    pub(super) fn clear(&mut self) {
        self.calibration.clone_from(&self.first_calibration);
        self.views = Views::new(&self.images, &self.calibration);
        self.cameras.fill(None);
        self.points.fill(None);
        self.is_placed = false;
    }

    /// Returns the image that holds the camera of `image`, and 1 if `image` is the right one of a
    /// rig.
    fn frame_of(&self, image: usize) -> (usize, usize) {
        let num_frames = self.images.len() / 2;
        if self.rig.is_some() && image >= num_frames {
            (image - num_frames, 1)
        } else {
            (image, 0)
        }
    }

    /// Returns the camera of an image at a pose.
    pub(super) fn posed(&self, image: usize, cam_from_world: RigidTransform) -> PosedCamera {
        PosedCamera {
            camera: self.calibration[image],
            cam_from_world,
        }
    }

    /// Sets the pose of a camera, and thereby that of the right camera of its rig.
    pub(super) fn place(&mut self, image: usize, camera: Option<PosedCamera>) {
        self.cameras[image] = camera;
        if let Some(rig) = self.rig {
            self.cameras[self.images.len() / 2 + image] = camera.map(|camera| PosedCamera {
                camera: rig.camera,
                cam_from_world: rig.sensor_from_camera * camera.cam_from_world,
            });
        }
    }

    pub(super) fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }

    pub(super) fn num_points(&self) -> usize {
        self.points.iter().flatten().count()
    }

    fn sight(&self, element: TrackElement) -> Option<Sight<'_>> {
        let (image, keypoint) = (element.image as usize, element.keypoint as usize);
        let mut camera = self.cameras[image]?;
        camera.camera.lens = self.views.cameras[image].lens;
        let view = self.views.of(image, keypoint)?;
        Some(Sight { camera, view })
    }

    /// Initializes from the best pair that works. Returns its images.
    pub(super) fn start(
        &mut self,
        verified: &[VerifiedPair],
        monitor: &mut dyn Monitor,
    ) -> Result<Option<[usize; 2]>> {
        let mut wanted_rad = self.options.min_start_angle_deg.to_radians();
        let mut tried = vec![false; verified.len()];
        // Below a quarter of a degree a pair has no depth information.
        while wanted_rad > 0.25f64.to_radians() {
            let mut order: Vec<usize> = (0..verified.len())
                .filter(|&n| {
                    let v = &verified[n];
                    !tried[n]
                        && v.median_angle_rad >= wanted_rad
                        && !self.taken[v.pair.image1]
                        && !self.taken[v.pair.image2]
                })
                .collect();
            order.sort_by_key(|&n| {
                let v = &verified[n];
                (v.is_flat, std::cmp::Reverse(v.pair.matches.len()), n)
            });
            for n in order {
                tried[n] = true;
                if self.start_from(&verified[n], monitor)? {
                    let pair = &verified[n].pair;
                    return Ok(Some([pair.image1, pair.image2]));
                }
            }
            wanted_rad *= 0.5;
        }
        Ok(None)
    }

    pub(super) fn start_from(
        &mut self,
        verified: &VerifiedPair,
        monitor: &mut dyn Monitor,
    ) -> Result<bool> {
        let (a, b) = (verified.pair.image1, verified.pair.image2);
        self.cameras[a] = Some(self.posed(a, RigidTransform::identity()));
        self.cameras[b] = Some(self.posed(b, verified.cam2_from_cam1));
        self.triangulate();
        let mut adjusted = Ok(None);
        if self.num_points() >= self.options.min_num_inliers {
            adjusted = self.adjust(None, 20, false, monitor);
            self.filter();
            self.triangulate();
        }
        if self.num_points() >= self.options.min_num_inliers && self.num_registered() == 2 {
            return adjusted.map(|_| true);
        }
        self.cameras.fill(None);
        self.points.fill(None);
        adjusted.map(|_| false)
    }

    /// Returns the points that an image sees through its tracks.
    pub(super) fn visible(&self, image: usize) -> Vec<(TrackElement, usize)> {
        let mut visible = Vec::new();
        for (keypoint, &track) in self.track_of[image].iter().enumerate() {
            if track != u32::MAX && self.points[track as usize].is_some() {
                let element = TrackElement {
                    image: image as u32,
                    keypoint: keypoint as u32,
                };
                visible.push((element, track as usize));
            }
        }
        visible
    }

    /// Returns the image with the best view of the points: many, and well spread.
    ///
    /// Source: Schönberger & Frahm 2016, §4.2.
    pub(super) fn next_image(&self, failed_with: &[usize]) -> Option<usize> {
        let mut best = None;
        for image in 0..self.images.len() {
            if self.cameras[image].is_some() || self.taken[image] {
                continue;
            }
            let visible = self.visible(image);
            let again = failed_with[image];
            if visible.len() < self.options.min_num_inliers.max(again + again / 4 + 1) {
                continue;
            }
            let Camera { width, height, .. } = self.views.cameras[image];
            let mut score = 0;
            for level in 1..=4 {
                let side = 1usize << level;
                let mut occupied = vec![false; side * side];
                for (element, _) in &visible {
                    let pixel = self.images[image].keypoints[element.keypoint as usize];
                    let cell = |x: f64, size: u32| {
                        let fraction = (x + 0.5) / f64::from(size.max(1));
                        ((fraction * side as f64) as usize).min(side - 1)
                    };
                    occupied[cell(pixel.y, height) * side + cell(pixel.x, width)] = true;
                }
                score += side * side * occupied.iter().filter(|x| **x).count();
            }
            let rank = (score, visible.len());
            if best.is_none_or(|(other, _)| rank > other) {
                best = Some((rank, image));
            }
        }
        best.map(|(_, image)| image)
    }

    /// Registers an image by the points that it sees, and adds its observations.
    pub(super) fn register(&mut self, image: usize) -> Option<usize> {
        let visible = self.visible(image);
        // The points are in no particular order.
        let ransac = RansacOptions {
            sampler: SamplerKind::Uniform,
            ..pair_ransac(&self.options).within(self.options.max_registration_error_px)
        };
        let (mut pixels, mut positions, mut of_visible) = (Vec::new(), Vec::new(), Vec::new());
        for (n, (element, track)) in visible.iter().enumerate() {
            if let Some(point) = &self.points[*track] {
                pixels.push(self.views.pixels[image][element.keypoint as usize]);
                positions.push(point.position);
                of_visible.push(n);
            }
        }
        // Without consensus the image stays unregistered; it may be tried again.
        let camera = &self.views.cameras[image];
        let found = estimate_absolute_pose(&positions, &pixels, camera, &ransac, &mut ());
        let found = found.ok()?;
        if found.num_unique_inliers < self.options.min_num_inliers {
            return None;
        }
        let camera = self.posed(image, found.model);
        self.place(image, Some(camera));
        for (n, inlier) in of_visible.into_iter().zip(&found.inliers) {
            let (element, track) = &visible[n];
            if *inlier && let Some(point) = &mut self.points[*track] {
                insert(&mut point.elements, *element);
            }
        }
        Some(found.num_inliers)
    }

    /// Returns the current reconstruction.
    pub(super) fn so_far(&self) -> Reconstruction {
        let mut reconstruction = Reconstruction {
            is_placed: self.is_placed,
            points: (self.points.iter().flatten())
                .map(|point| ScenePoint {
                    position: point.position,
                    color: [128; 3],
                    track: point.elements.clone(),
                    error_px: 0.0,
                })
                .collect(),
            cameras: self.cameras.clone(),
        };
        reconstruction.finish_points(&self.images);
        reconstruction
    }
}

/// Inserts into a list sorted by image.
fn insert(elements: &mut Vec<TrackElement>, element: TrackElement) {
    if let Err(place) = elements.binary_search(&element) {
        elements.insert(place, element);
    }
}
