//! Rendered photographs for views: an immediate preview, and the sharp picture in slices.
//!
//! A sharp photograph takes longer than a frame during a drag. Until it is ready, the last sharp
//! photograph is reprojected to the current camera by its depth map, and a small draft fills the
//! holes; before the first sharp photograph the draft fills everything. Each call of
//! [`View::refine`](crate::contract::View::refine) then prepares the scene or renders some rows of
//! the next sharp photograph, shown when complete. Slices have fixed sizes rather than durations,
//! so that pictures are reproducible.

use epipole::Error;
use epipole::camera::{Camera, PosedCamera};
use epipole_scenes::{Moved, Photograph, Reprojected, Sampling, Scene};
use image::RgbImage;
use std::ops::Range;

/// Scale of a draft relative to the full picture, along each side.
const DRAFT_FACTOR: f64 = 1.0 / 6.0;

/// Rows of the full picture per slice.
const ROWS_PER_SLICE: u32 = 4;

/// Column and row range of a draft.
type Part = [Range<u32>; 2];

/// One photograph of a scene, kept until the camera or the scene changes.
#[derive(Default)]
pub(crate) struct Photo {
    /// Last completed photograph, of the current camera or another.
    sharp: Option<Shot>,
    /// Photograph in progress.
    growing: Option<Shot>,
    num_rows_done: u32,
    /// Draft shown until a sharp photograph is available.
    draft: Option<Photograph>,
    /// Camera and size of the draft if it is complete, and its pixels of movable objects.
    drafted: Option<(PosedCamera, (u32, u32), Part)>,
    meanwhile: Reprojected,
    shown: Option<(PosedCamera, [f64; 3])>,
    follow: Option<Follow>,
}

/// Function that returns the motion between two arrangements of a scene, if any.
pub(crate) type Follow = fn([f64; 3], [f64; 3]) -> Option<Moved>;

/// One slice of work on a photograph: [`Photo::prepare`] or [`Photo::refine`].
pub(crate) type Slice = fn(&mut Photo, &Scene, &PosedCamera, [f64; 3], (u32, u32)) -> bool;

/// A photograph with its camera and arrangement.
struct Shot {
    camera: PosedCamera,
    /// Positions of the scene's movable objects, as defined by the figure.
    arrangement: [f64; 3],
    photograph: Photograph,
}

impl Shot {
    fn shows(&self, camera: &PosedCamera, arrangement: [f64; 3]) -> bool {
        self.camera == *camera && self.arrangement == arrangement
    }
}

/// Returns an empty photograph that reuses the memory of an old one of the same size.
fn blank(old: Option<Photograph>, (width, height): (u32, u32)) -> Photograph {
    old.filter(|photograph| photograph.image.dimensions() == (width, height))
        .unwrap_or_else(|| Photograph::blank(width, height))
}

impl Photo {
    /// Creates a photograph of a scene whose movable object can be reprojected. Without `follow`,
    /// sharp photographs of other arrangements are not reused.
    pub(crate) fn following(follow: Follow) -> Self {
        Self {
            follow: Some(follow),
            ..Self::default()
        }
    }

    /// Discards the sharp photograph and the one in progress.
    pub(crate) fn forget(&mut self) {
        (self.sharp, self.growing, self.shown) = (None, None, None);
    }

    /// Returns the best picture currently available.
    ///
    /// * `camera`: for a full picture of `width × height` pixels
    /// * `arrangement`: positions of the scene's movable objects; any constant if there are none
    ///
    /// # Errors
    /// As [`Scene::render`]: no picture can be rendered at the camera's position.
    pub(crate) fn picture(
        &mut self,
        scene: &Scene,
        camera: &PosedCamera,
        arrangement: [f64; 3],
        size: (u32, u32),
    ) -> Result<&RgbImage, Error> {
        let sharp = self.sharp.as_ref();
        let sharp = sharp.filter(|shot| shot.photograph.image.dimensions() == size);
        if let Some(shot) = sharp.filter(|shot| shot.shows(camera, arrangement)) {
            return Ok(&shot.photograph.image);
        }
        if self.shown != Some((*camera, arrangement)) {
            self.shown = None;
            match sharp.filter(|shot| shot.arrangement == arrangement || self.follow.is_some()) {
                Some(shot) => {
                    let moved = self
                        .follow
                        .and_then(|follow| follow(shot.arrangement, arrangement));
                    let (from, into) = (&shot.camera, &mut self.meanwhile);
                    let photograph = &shot.photograph;
                    photograph.reproject(from, camera, moved.as_ref(), into)?;
                }
                None => self.meanwhile.clear(size),
            }
            let small = |side: u32| (f64::from(side) * DRAFT_FACTOR).round().max(1.0) as u32;
            let small_size = (small(size.0), small(size.1));
            let mut draft = blank(self.draft.take(), small_size);
            let small_camera = PosedCamera {
                camera: Camera::pinhole(
                    camera.camera.intrinsics.scaled(DRAFT_FACTOR)?,
                    small_size.0,
                    small_size.1,
                ),
                ..*camera
            };
            let mut wanted = self.meanwhile.wanted(small_size);
            let is_whole = wanted.iter().all(|&wanted| wanted);
            let moving = scene.pixels_of_movable(&small_camera, small_size);
            if let Some((from, size, before)) = self.drafted.take()
                && (from, size) == (small_camera, small_size)
            {
                // Pixels without movable objects are unchanged.
                let parts = [&before, &moving];
                for (place, wanted) in (0..).zip(&mut wanted) {
                    let (u, v) = (place % size.0, place / size.0);
                    *wanted &= (parts.iter()).any(|[us, vs]| us.contains(&u) && vs.contains(&v));
                }
            }
            scene.render_draft(&small_camera, &wanted, &mut draft)?;
            self.drafted = is_whole.then_some((small_camera, small_size, moving));
            self.meanwhile.fill(&draft.image);
            self.draft = Some(draft);
            self.shown = Some((*camera, arrangement));
        }
        Ok(self.meanwhile.image())
    }

    /// Does the next slice of work towards the first picture: first the textures for drafts, then
    /// the draft; false when a picture is available or none can be rendered.
    ///
    /// Arguments as for [`Photo::picture`].
    pub(crate) fn prepare(
        &mut self,
        scene: &Scene,
        camera: &PosedCamera,
        arrangement: [f64; 3],
        size: (u32, u32),
    ) -> bool {
        let is_there = self.shown.is_some() || self.sharp.is_some();
        scene.prepare_draft()
            || (!is_there && self.picture(scene, camera, arrangement, size).is_ok())
    }

    /// Does the next slice of work towards a sharp picture; false when it is available or cannot be
    /// rendered.
    ///
    /// Arguments as for [`Photo::picture`].
    pub(crate) fn refine(
        &mut self,
        scene: &Scene,
        camera: &PosedCamera,
        arrangement: [f64; 3],
        (width, height): (u32, u32),
    ) -> bool {
        let is_of = |shot: &Shot| {
            shot.shows(camera, arrangement) && shot.photograph.image.dimensions() == (width, height)
        };
        if self.sharp.as_ref().is_some_and(is_of) {
            return false;
        }
        if scene.prepare() {
            return true;
        }
        if !self.growing.as_ref().is_some_and(is_of) {
            let old = self.growing.take().map(|shot| shot.photograph);
            self.growing = Some(Shot {
                camera: *camera,
                arrangement,
                photograph: blank(old, (width, height)),
            });
            self.num_rows_done = 0;
        }
        let Some(shot) = self.growing.as_mut() else {
            return false;
        };
        let next = (self.num_rows_done + ROWS_PER_SLICE).min(height);
        let rows = self.num_rows_done..next;
        let target = &mut shot.photograph;
        let done = scene.render_rows(camera, width, height, Sampling::Full, rows, target);
        if done.is_err() {
            self.growing = None;
            return false;
        }
        self.num_rows_done = next;
        if next < height {
            return true;
        }
        // The next photograph reuses the memory of the last one.
        std::mem::swap(&mut self.sharp, &mut self.growing);
        self.num_rows_done = 0;
        self.shown = None;
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::{long_table, moved_ball, still_life_pair};
    use epipole::camera::Intrinsics;
    use nalgebra::Isometry3;

    const SIZE: (u32, u32) = (160, 120);

    fn error(a: &RgbImage, b: &RgbImage) -> f64 {
        let sum: f64 = (a.iter().zip(b.iter()))
            .map(|(a, b)| f64::from(a.abs_diff(*b)))
            .sum();
        sum / a.len() as f64
    }

    fn settle(photo: &mut Photo, scene: &Scene, camera: &PosedCamera, arrangement: [f64; 3]) {
        while photo.refine(scene, camera, arrangement, SIZE) {}
    }

    #[test]
    fn a_moving_camera_sees_something_sharper_than_a_draft() {
        let scene = Scene::still_life();
        let still = [0.0; 3];
        let [first, second] = still_life_pair(SIZE, 0.1, 0.1, 2.0);
        let truth = scene.render(&second, SIZE.0, SIZE.1, Sampling::Full);
        let truth = truth.unwrap().image;
        let mut photo = Photo::default();
        let draft = photo.picture(&scene, &second, still, SIZE).unwrap();
        let draft_error = error(draft, &truth);
        settle(&mut photo, &scene, &first, still);
        let moving = photo.picture(&scene, &second, still, SIZE).unwrap();
        let moving_error = error(moving, &truth);
        assert!(
            moving_error < 0.6 * draft_error,
            "{moving_error} {draft_error}"
        );
        // The final picture does not depend on the previews before it.
        settle(&mut photo, &scene, &second, still);
        assert_eq!(photo.picture(&scene, &second, still, SIZE).unwrap(), &truth);
        assert!(!photo.refine(&scene, &second, still, SIZE));
    }

    #[test]
    fn a_ball_that_moves_is_at_its_new_place_at_once() {
        let camera = PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::centered(175.0, SIZE.0, SIZE.1).unwrap(),
                SIZE.0,
                SIZE.1,
            ),
            cam_from_world: Isometry3::identity(),
        };
        let at = |x_m: f64, z_m: f64| (long_table((x_m, z_m)).unwrap(), [x_m, 0.14, z_m]);
        let mut photo = Photo::following(moved_ball);
        let (scene, place) = at(0.0, 2.0);
        settle(&mut photo, &scene, &camera, place);
        let before = photo.picture(&scene, &camera, place, SIZE).unwrap().clone();
        let (scene, place) = at(0.25, 1.6);
        let truth = scene.render(&camera, SIZE.0, SIZE.1, Sampling::Full);
        let truth = truth.unwrap().image;
        let moving = photo.picture(&scene, &camera, place, SIZE).unwrap();
        let (stale, moving) = (error(&before, &truth), error(moving, &truth));
        assert!(moving < 0.5 * stale, "{moving} {stale}");
    }

    #[test]
    fn a_camera_in_the_wall_gets_a_sentence_and_a_photo_recovers() {
        let scene = Scene::still_life();
        let [first, _] = still_life_pair(SIZE, 0.0, 0.0, 0.0);
        let wall = PosedCamera {
            cam_from_world: Isometry3::translation(0.0, 50.0, 0.0),
            ..first
        };
        let mut photo = Photo::default();
        settle(&mut photo, &scene, &first, [0.0; 3]);
        assert!(photo.picture(&scene, &wall, [0.0; 3], SIZE).is_err());
        assert!(!photo.refine(&scene, &wall, [0.0; 3], SIZE));
        assert!(photo.picture(&scene, &first, [0.0; 3], SIZE).is_ok());
    }
}
