//! Rendered photographs for views: a draft at once, the sharp picture slice by slice.
//!
//! A reader who drags a slider wants every frame now, and a photograph worth looking at takes
//! longer than a frame. So a changed scene is drawn small and plain first, and each call of
//! [`View::refine`](crate::contract::View::refine) renders some rows of the full picture, which
//! replaces the draft when it is complete. The rows of a slice are fixed, not timed, so the same
//! calls give the same picture everywhere.

use epipole::Error;
use epipole::camera::Camera;
use epipole::synthetic::{Photograph, Sampling, Scene};
use image::RgbImage;

/// Pixels of a draft for every pixel of the full picture, along each side.
const DRAFT_FACTOR: f64 = 1.0 / 6.0;

/// Rows of the full picture that one slice renders.
const ROWS_PER_SLICE: u32 = 16;

/// One photograph of a scene, kept until the camera or the scene changes.
#[derive(Default)]
pub(crate) struct Photo {
    draft: Option<Shot>,
    full: Option<Shot>,
    num_rows_done: u32,
}

/// A photograph and what it shows.
struct Shot {
    camera: Camera,
    /// What moves in the scene, if something does.
    arrangement: [f64; 3],
    photograph: Photograph,
}

impl Shot {
    /// An empty photograph, in the memory of an old one if it has the size.
    fn blank(old: Option<Self>, camera: &Camera, arrangement: [f64; 3], size: (u32, u32)) -> Self {
        let photograph = old
            .map(|shot| shot.photograph)
            .filter(|photograph| photograph.image.dimensions() == size)
            .unwrap_or_else(|| Photograph::blank(size.0, size.1));
        Self {
            camera: *camera,
            arrangement,
            photograph,
        }
    }

    fn shows(&self, camera: &Camera, arrangement: [f64; 3]) -> bool {
        self.camera == *camera && self.arrangement == arrangement
    }
}

impl Photo {
    /// The best picture that there is now; renders a draft if there is none.
    ///
    /// * `camera`: for a full picture of `width × height` pixels
    /// * `arrangement`: where the movable things of the scene are; any constant if none move
    ///
    /// # Errors
    /// As [`Scene::render`]: the camera stands where no picture can be taken.
    pub(crate) fn picture(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        arrangement: [f64; 3],
        (width, height): (u32, u32),
    ) -> Result<&RgbImage, Error> {
        let is_sharp = self.num_rows_done >= height
            && (self.full.as_ref()).is_some_and(|shot| shot.shows(camera, arrangement));
        let has_draft = (self.draft.as_ref()).is_some_and(|shot| shot.shows(camera, arrangement));
        if !is_sharp && !has_draft {
            let small = |side: u32| (f64::from(side) * DRAFT_FACTOR).round().max(1.0) as u32;
            let size = (small(width), small(height));
            let mut shot = Shot::blank(self.draft.take(), camera, arrangement, size);
            let draft_camera = Camera {
                intrinsics: camera.intrinsics.scaled(DRAFT_FACTOR)?,
                ..*camera
            };
            scene.render_rows(
                &draft_camera,
                size.0,
                size.1,
                Sampling::Draft,
                0..size.1,
                &mut shot.photograph,
            )?;
            self.draft = Some(shot);
        }
        let shown = if is_sharp { &self.full } else { &self.draft };
        let shot = shown.as_ref().ok_or(Error::TooFew {
            what: "a photograph",
            needed: 1,
            got: 0,
        })?;
        Ok(&shot.photograph.image)
    }

    /// Renders the next slice of the full picture; false when it is complete, or cannot be made.
    ///
    /// Arguments as for [`Photo::picture`].
    pub(crate) fn refine(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        arrangement: [f64; 3],
        (width, height): (u32, u32),
    ) -> bool {
        let begun = (self.full.as_ref()).is_some_and(|shot| shot.shows(camera, arrangement));
        if !begun {
            let old = self.full.take();
            self.full = Some(Shot::blank(old, camera, arrangement, (width, height)));
            self.num_rows_done = 0;
        }
        let Some(shot) = self.full.as_mut().filter(|_| self.num_rows_done < height) else {
            return false;
        };
        let rows = self.num_rows_done..(self.num_rows_done + ROWS_PER_SLICE).min(height);
        let next = rows.end;
        let done = scene.render_rows(
            camera,
            width,
            height,
            Sampling::Full,
            rows,
            &mut shot.photograph,
        );
        if done.is_err() {
            self.full = None;
            return false;
        }
        self.num_rows_done = next;
        next < height
    }
}
