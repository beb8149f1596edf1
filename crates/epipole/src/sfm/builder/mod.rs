//! The state of a growing reconstruction, and how it starts and takes in image after image.

mod adjust;
mod place;
mod points;

use super::bundle::Sensor;
use super::incremental::{Reporter, SfmOptions, SfmStep};
use super::reconstruction::{Reconstruction, ScenePoint, SfmImage};
use super::tracks::TrackElement;
use super::triangulate_track::Sight;
use super::two_view_start::{VerifiedPair, pair_ransac};
use super::views::{View, Views};
use crate::absolute_pose::{estimate_absolute_pose, estimate_absolute_pose_of_rays};
use crate::camera::{Intrinsics, Lens, PosedCamera, RigidTransform};
use crate::robust::{RansacOptions, SamplerKind};
use nalgebra::Point3;

/// A point and the elements of its track that agree with it.
#[derive(Debug, Clone)]
pub(super) struct TrackPoint {
    pub(super) position: Point3<f64>,
    pub(super) seen: Vec<TrackElement>,
}

pub(super) struct Builder<'a> {
    pub(super) images: &'a [SfmImage],
    pub(super) options: &'a SfmOptions,
    pub(super) views: Views,
    pub(super) intrinsics: Vec<Intrinsics>,
    /// Of each image.
    pub(super) lenses: Vec<Lens>,
    pub(super) tracks: &'a [Vec<TrackElement>],
    /// Track of each keypoint, `u32::MAX` if none.
    pub(super) track_of: &'a [Vec<u32>],
    /// Images that earlier components have.
    pub(super) taken: Vec<bool>,
    /// Of a stereo rig: the second half of the images is what the right camera saw.
    pub(super) rig: Option<Sensor>,
    pub(super) cameras: Vec<Option<PosedCamera>>,
    pub(super) points: Vec<Option<TrackPoint>>,
    /// Whether the world is that of the known positions.
    pub(super) is_placed: bool,
}

impl Builder<'_> {
    /// The image that holds the camera of `image`, and 1 if it is the right one of a rig.
    fn frame_of(&self, image: usize) -> (usize, usize) {
        let num_frames = self.images.len() / 2;
        if self.rig.is_some() && image >= num_frames {
            (image - num_frames, 1)
        } else {
            (image, 0)
        }
    }

    /// Places a camera, and with it the right one of its rig.
    pub(super) fn place(&mut self, image: usize, camera: Option<PosedCamera>) {
        self.cameras[image] = camera;
        if let Some(rig) = self.rig {
            self.cameras[self.images.len() / 2 + image] = camera.map(|camera| PosedCamera {
                intrinsics: rig.intrinsics,
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
        let camera = self.cameras[image]?;
        let view = self.views.of(image, keypoint)?;
        Some(Sight { camera, view })
    }

    /// Starts from the best pair that works, and answers which images these are.
    pub(super) fn start(
        &mut self,
        verified: &[VerifiedPair],
        reporter: &mut Reporter<'_>,
    ) -> Option<[usize; 2]> {
        let mut wanted_rad = self.options.min_start_angle_deg.to_radians();
        let mut tried = vec![false; verified.len()];
        // Below a quarter of a degree a pair says nothing about depth.
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
                if self.start_from(&verified[n], reporter) {
                    let pair = &verified[n].pair;
                    let images = [pair.image1, pair.image2];
                    reporter.tell(&SfmStep::Started {
                        images,
                        num_points: self.num_points(),
                    });
                    return Some(images);
                }
                if reporter.canceled {
                    return None;
                }
            }
            wanted_rad *= 0.5;
        }
        None
    }

    pub(super) fn start_from(
        &mut self,
        verified: &VerifiedPair,
        reporter: &mut Reporter<'_>,
    ) -> bool {
        let (a, b) = (verified.pair.image1, verified.pair.image2);
        let camera = |intrinsics, cam_from_world| {
            Some(PosedCamera {
                intrinsics,
                cam_from_world,
            })
        };
        self.cameras[a] = camera(self.intrinsics[a], RigidTransform::identity());
        self.cameras[b] = camera(self.intrinsics[b], verified.cam2_from_cam1);
        self.triangulate();
        if self.num_points() >= self.options.min_num_inliers {
            self.adjust(None, 20, false, reporter);
            self.filter();
            self.triangulate();
        }
        if self.num_points() >= self.options.min_num_inliers && self.num_registered() == 2 {
            return true;
        }
        self.cameras.fill(None);
        self.points.fill(None);
        false
    }

    /// Adds images while there are any that can be added.
    pub(super) fn grow(&mut self, reporter: &mut Reporter<'_>) {
        // Points that an image saw when it could not be registered: it is tried again with more.
        let mut failed_with = vec![0; self.images.len()];
        let mut adjusted_at = self.num_registered();
        while !reporter.canceled {
            let Some(image) = self.next_image(&failed_with) else {
                break;
            };
            let Some(num_visible) = self.register(image) else {
                failed_with[image] = self.visible(image).len();
                continue;
            };
            debug_assert!(num_visible > 0);
            self.triangulate_of(Some(image));
            let num_registered = self.num_registered();
            // Everything is refined while it is small, later whenever it has grown by a tenth.
            let everything = num_registered <= 12 || num_registered * 10 >= adjusted_at * 11;
            let cost = if everything {
                adjusted_at = num_registered;
                self.adjust(None, 15, num_registered >= 4, reporter)
            } else {
                let near = self.neighborhood(image, 6);
                self.adjust(Some(&near), 15, false, reporter)
            };
            self.filter();
            if everything {
                self.complete();
                self.triangulate();
            }
            if let Some(cost) = cost {
                reporter.tell(&SfmStep::Adjusted { cost });
            }
            reporter.tell(&SfmStep::Registered {
                image,
                num_registered: self.num_registered(),
                num_points: self.num_points(),
            });
            reporter.show(|| self.so_far());
        }
        if reporter.canceled {
            return;
        }
        for _ in 0..2 {
            self.complete();
            self.triangulate();
            self.drop_short_tracks();
            let cost = self.adjust(None, 50, true, reporter);
            self.filter();
            self.drop_short_tracks();
            if let Some(cost) = cost
                && !reporter.tell(&SfmStep::Adjusted { cost })
            {
                return;
            }
        }
        if self.place_in_world()
            && let Some(cost) = self.adjust(None, 50, true, reporter)
        {
            self.filter();
            self.drop_short_tracks();
            reporter.tell(&SfmStep::Adjusted { cost });
        }
    }

    /// The points that an image sees through its tracks.
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

    /// The image whose view of the points is best: many, and spread over the picture.
    ///
    /// Source: Schönberger & Frahm 2016, §4.2.
    fn next_image(&self, failed_with: &[usize]) -> Option<usize> {
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
            let (width, height) = (self.images[image].width, self.images[image].height);
            let mut score = 0;
            for level in 1..=4 {
                let side = 1usize << level;
                let mut occupied = vec![false; side * side];
                for (element, _) in &visible {
                    let pixel = self.images[image].keypoints[element.keypoint as usize];
                    let cell = |x: f64, size: u32| {
                        let share = (x + 0.5) / f64::from(size.max(1));
                        ((share * side as f64) as usize).min(side - 1)
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

    /// Finds the camera of an image from the points it sees, and adds its observations.
    pub(super) fn register(&mut self, image: usize) -> Option<usize> {
        let visible = self.visible(image);
        // Points come in no order.
        let ransac = RansacOptions {
            sampler: SamplerKind::Uniform,
            ..pair_ransac(self.options).within(self.options.max_registration_error_px)
        };
        let intrinsics = self.intrinsics[image];
        let (mut pixels, mut rays, mut positions) = (Vec::new(), Vec::new(), Vec::new());
        let mut of_visible = Vec::new();
        for (n, (element, track)) in visible.iter().enumerate() {
            let view = self.views.of(image, element.keypoint as usize);
            if let (Some(point), Some(view)) = (&self.points[*track], view) {
                match view {
                    View::Pixel(pixel) => pixels.push(pixel),
                    View::Ray(ray) => rays.push(*ray),
                }
                positions.push(point.position);
                of_visible.push(n);
            }
        }
        // Without consensus the image is not registered, and may be later.
        let found = match &self.views {
            Views::Pinhole(_) => {
                estimate_absolute_pose(&positions, &pixels, &intrinsics, &ransac, &mut ())
            }
            Views::Rays(_) => estimate_absolute_pose_of_rays(&positions, &rays, &ransac, &mut ()),
        };
        let found = found.ok()?;
        if found.num_unique_inliers < self.options.min_num_inliers {
            return None;
        }
        let camera = PosedCamera {
            intrinsics,
            cam_from_world: found.model,
        };
        self.place(image, Some(camera));
        for (n, inlier) in of_visible.into_iter().zip(&found.inliers) {
            let (element, track) = &visible[n];
            if *inlier && let Some(point) = &mut self.points[*track] {
                insert(&mut point.seen, *element);
            }
        }
        Some(found.num_inliers)
    }

    pub(super) fn finish(self) -> Reconstruction {
        self.so_far()
    }

    /// What there is.
    pub(super) fn so_far(&self) -> Reconstruction {
        let mut reconstruction = Reconstruction {
            lenses: self.lenses.clone(),
            is_placed: self.is_placed,
            points: (self.points.iter().flatten())
                .map(|point| ScenePoint {
                    position: point.position,
                    color: [128; 3],
                    track: point.seen.clone(),
                    error_px: 0.0,
                })
                .collect(),
            cameras: self.cameras.clone(),
        };
        reconstruction.finish_points(self.images);
        reconstruction
    }
}

/// Inserts into a list sorted by image.
fn insert(seen: &mut Vec<TrackElement>, element: TrackElement) {
    if let Err(place) = seen.binary_search(&element) {
        seen.insert(place, element);
    }
}
