//! A scene: its bodies, its light, and one movable object.

mod fixed;
mod movable;
pub(crate) mod rays;

pub(crate) use fixed::Fixed;
pub(crate) use movable::{Movable, SHADE_M};

use crate::detail::Detail;
use crate::light::{Decal, LightMap};
use crate::objects::body::{Body, Placement};
use epipole::camera::PosedCamera;
use epipole::{Error, Result};
use std::sync::Arc;

/// Number of light cells, or of texels, per step of [`Scene::prepare`].
const CELLS_PER_STEP: usize = 256;
const TEXELS_PER_STEP: usize = 4096;

/// A furnished room that can be photographed from anywhere inside.
///
/// Static parts are computed once, for the first sharp photograph or ahead of it by
/// [`Scene::prepare`]: mipmapped textures, and light maps with soft shadows. Drafts have coarser
/// ones, which take a fraction of the time. Clones share them at hardly any cost; rays and
/// transfers need only the shapes.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(crate) fixed: Arc<Fixed>,
    pub(crate) movable: Option<(Arc<Movable>, Placement)>,
}

impl Scene {
    /// Returns every body with its placement.
    pub(crate) fn placed(&self) -> impl Iterator<Item = (&Body, Placement)> {
        let moved = self
            .movable
            .iter()
            .flat_map(|(movable, placed)| movable.bodies.iter().map(|body| (body, *placed)));
        self.fixed
            .bodies
            .iter()
            .map(|body| (body, Placement::as_built()))
            .chain(moved)
    }

    /// Returns the light maps of every body, in the order of [`Scene::placed`].
    pub(crate) fn lights(&self, detail: Detail) -> impl Iterator<Item = &[LightMap]> {
        let moved = self
            .movable
            .iter()
            .flat_map(move |(movable, _)| &movable.look(&self.fixed.lighting, detail).lights);
        self.fixed
            .lights(detail)
            .iter()
            .chain(moved)
            .map(Vec::as_slice)
    }

    /// Returns the shade of the movable object, its placement, and the index of the body under it.
    pub(crate) fn shade(&self, detail: Detail) -> Option<(&Decal, Placement, usize)> {
        let (movable, placed) = self.movable.as_ref()?;
        let look = movable.look(&self.fixed.lighting, detail);
        Some((&look.decal, *placed, movable.ground))
    }

    /// Does a few milliseconds of work ahead of the first sharp photograph: painting textures and
    /// computing light. False once all is done. Photographs are the same without it.
    ///
    /// ```
    /// use epipole_scenes::Scene;
    /// let scene = Scene::still_life();
    /// let num_steps = (0..10_000).take_while(|_| scene.prepare()).count();
    /// assert!(num_steps < 10_000 && !scene.prepare());
    /// ```
    pub fn prepare(&self) -> bool {
        self.advance(Detail::Full)
    }

    /// Does the same for the first draft, which has its own coarser textures and light.
    ///
    /// ```
    /// use epipole_scenes::Scene;
    /// let scene = Scene::still_life();
    /// let num_steps = (0..1000).take_while(|_| scene.prepare_draft()).count();
    /// assert!(num_steps < 1000 && !scene.prepare_draft());
    /// ```
    pub fn prepare_draft(&self) -> bool {
        self.advance(Detail::Sketch)
    }

    fn advance(&self, detail: Detail) -> bool {
        let lighting = &self.fixed.lighting;
        let movable = self.movable.iter();
        if self.fixed.advance(detail, CELLS_PER_STEP)
            || (movable.clone())
                .any(|(movable, _)| movable.advance(lighting, detail, CELLS_PER_STEP))
        {
            return true;
        }
        let mut paints = self.placed().flat_map(|(body, _)| &body.paints);
        paints.any(|paint| paint.texture.advance(detail, TEXELS_PER_STEP))
    }

    /// Rejects cameras for which no picture can be rendered.
    pub(crate) fn check(&self, camera: &PosedCamera, width: u32, height: u32) -> Result<()> {
        let num_pixels = u64::from(width) * u64::from(height);
        if num_pixels == 0 || num_pixels > 16_000_000 {
            return Err(Error::OutOfRange {
                what: "the number of pixels of a rendered photograph",
                requirement: "between 1 and 16 million",
                value: num_pixels as f64,
            });
        }
        let center = camera.center_in_world();
        let rotation = camera.cam_from_world.rotation.coords;
        if !center.coords.iter().chain(&rotation).all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "the place and direction of the camera",
            });
        }
        let what = "a rendered photograph";
        for (body, placed) in self.placed() {
            if body.contains(&center, &placed) {
                return Err(Error::Degenerate {
                    what,
                    why: "the camera is inside an object or outside of the room",
                });
            }
        }
        Ok(())
    }

    /// Returns the bytes of textures and light maps, each texture counted once.
    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        let mut visible = Vec::new();
        let mut bytes = 0;
        for ((body, _), lights) in self.placed().zip(self.lights(Detail::Full)) {
            bytes += lights.iter().map(|light| light.bytes()).sum::<usize>();
            for paint in &body.paints {
                let address = Arc::as_ptr(&paint.texture);
                if !visible.contains(&address) {
                    visible.push(address);
                    bytes += paint.texture.bytes();
                }
            }
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that scenes are small enough for a phone: below 12 MiB each.
    #[test]
    fn textures_and_light_fit_in_memory() {
        let ball = crate::MovableObject {
            kind: crate::MovableKind::Ball,
            x_m: 0.0,
            z_m: 2.0,
        };
        let bytes =
            [Scene::still_life(), Scene::long_table(ball).unwrap()].map(|scene| scene.bytes());
        println!("{bytes:?} bytes");
        assert!(bytes[0] > 1 << 20 && bytes.iter().all(|bytes| *bytes < 12 << 20));
    }
}
