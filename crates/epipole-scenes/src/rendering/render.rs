//! Rendering of photographs.
//!
//! One ray per pixel finds the surface; where neighboring pixels see different surfaces, eight more
//! rays antialias the edge. Textures are already averaged over a pixel's width, so no other pixels
//! need more rays. A pixel depends only on its neighbors' rays, never on how the work is divided.

use super::film::Film;
use super::view::{Sample, TILE, View};
use super::{Photograph, Sampling};
use crate::scene::Scene;
use epipole::camera::PosedCamera;
use epipole::{Error, Result};
use std::ops::Range;

/// Offsets of the extra rays at an edge: no two share a row or a column.
const EDGE_OFFSETS: [(f64, f64); 8] = [
    (-0.4375, 0.0625),
    (-0.3125, -0.3125),
    (-0.1875, 0.3125),
    (-0.0625, -0.1875),
    (0.0625, 0.1875),
    (0.1875, -0.4375),
    (0.3125, 0.4375),
    (0.4375, -0.0625),
];

impl Scene {
    /// Renders a photograph of the scene with its depth.
    ///
    /// * `camera`: inside the room and outside of objects; its intrinsics are for a picture of
    ///   `width × height` pixels
    ///
    /// Equal inputs give equal bytes on every platform, with any number of threads.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no pixels or more than 16 million; [`Error::NotFinite`] or
    /// [`Error::Degenerate`] for a camera that is not finite, inside an object or outside of the
    /// room.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole_scenes::{Sampling, Scene, still_life_camera};
    /// let camera = still_life_camera(64, 48);
    /// let photo = Scene::still_life().render(&camera, 64, 48, Sampling::Full)?;
    /// assert_eq!(photo.image.dimensions(), (64, 48));
    /// // The table is nearer at the bottom of the picture than the wall at its top.
    /// assert!(photo.depth_m[(5, 47)].0[0] < photo.depth_m[(5, 0)].0[0]);
    /// # Ok(()) }
    /// ```
    pub fn render(
        &self,
        camera: &PosedCamera,
        width: u32,
        height: u32,
        sampling: Sampling,
    ) -> Result<Photograph> {
        self.check(camera, width, height)?;
        let mut target = Photograph::blank(width, height);
        let view = View::new(self, camera, width, height, sampling);
        let band = Band {
            first: 0,
            rgb: &mut target.image,
            depth_m: &mut target.depth_m,
            wanted: None,
        };
        render_bands(&view, band);
        Ok(target)
    }

    /// Renders some rows of a photograph into `target`, created by [`Photograph::blank`].
    ///
    /// Any slices that cover the picture give exactly the pixels of [`Scene::render`], so a
    /// picture can be refined a few rows at a time. Rows beyond the picture are ignored.
    ///
    /// # Errors
    /// As [`Scene::render`], and [`Error::SizeMismatch`] if the target is not
    /// `width × height`.
    pub fn render_rows(
        &self,
        camera: &PosedCamera,
        width: u32,
        height: u32,
        sampling: Sampling,
        rows: Range<u32>,
        target: &mut Photograph,
    ) -> Result<()> {
        self.check(camera, width, height)?;
        for (got_width, got_height) in [target.image.dimensions(), target.depth_m.dimensions()] {
            for (first, second) in [(width, got_width), (height, got_height)] {
                check_size("the photograph and its target", first, second)?;
            }
        }
        let (start, end) = (rows.start.min(height), rows.end.min(height));
        if start >= end {
            return Ok(());
        }
        let view = View::new(self, camera, width, height, sampling);
        let (from, to) = ((start * width) as usize, (end * width) as usize);
        view.render(Band {
            first: start,
            rgb: &mut target.image.as_flat_samples_mut().samples[3 * from..3 * to],
            depth_m: &mut target.depth_m.as_flat_samples_mut().samples[from..to],
            wanted: None,
        });
        Ok(())
    }

    /// Renders some pixels of a photograph with [`Sampling::Draft`]; the other pixels of `target`
    /// stay unchanged.
    ///
    /// * `camera`: for a picture of the target's size
    /// * `wanted`: for each pixel of the target, row by row, whether to render it
    ///
    /// # Errors
    /// As [`Scene::render`], and [`Error::SizeMismatch`] if the sizes of the three differ.
    pub fn render_draft(
        &self,
        camera: &PosedCamera,
        wanted: &[bool],
        target: &mut Photograph,
    ) -> Result<()> {
        let (width, height) = target.image.dimensions();
        self.check(camera, width, height)?;
        let num_pixels = width * height;
        let num_wanted = u32::try_from(wanted.len()).unwrap_or(u32::MAX);
        check_size(
            "the pixels of a draft and those asked for",
            num_pixels,
            num_wanted,
        )?;
        for (depth, color) in [
            (target.depth_m.width(), width),
            (target.depth_m.height(), height),
        ] {
            check_size("the colors and the depths of a photograph", color, depth)?;
        }
        View::new(self, camera, width, height, Sampling::Draft).render(Band {
            first: 0,
            rgb: &mut target.image,
            depth_m: &mut target.depth_m,
            wanted: Some(wanted),
        });
        Ok(())
    }
}

fn check_size(what: &'static str, first: u32, second: u32) -> Result<()> {
    if first == second {
        return Ok(());
    }
    Err(Error::SizeMismatch {
        what,
        first: first as usize,
        second: second as usize,
    })
}

/// Rows of a picture in progress.
struct Band<'a> {
    first: u32,
    rgb: &'a mut [u8],
    depth_m: &'a mut [f32],
    /// Mask of the pixels to render; all if `None`. Only for drafts, where pixels do not depend on
    /// their neighbors.
    wanted: Option<&'a [bool]>,
}

#[cfg(not(feature = "parallel"))]
fn render_bands(view: &View, band: Band) {
    view.render(band);
}

#[cfg(feature = "parallel")]
fn render_bands(view: &View, band: Band) {
    use rayon::prelude::*;
    const ROWS: usize = 32;
    let width = view.width as usize;
    band.rgb
        .par_chunks_mut(3 * width * ROWS)
        .zip(band.depth_m.par_chunks_mut(width * ROWS))
        .enumerate()
        .for_each(|(index, (rgb, depth_m))| {
            view.render(Band {
                first: band.first + (index * ROWS) as u32,
                rgb,
                depth_m,
                wanted: None,
            });
        });
}

impl View<'_> {
    fn render(&self, band: Band) {
        let width = self.width as usize;
        let num_rows = (band.rgb.len() / (3 * width)) as u32;
        // Edges are found by comparison with the rows above and below.
        let margin = u32::from(self.sampling == Sampling::Full);
        let first = band.first.saturating_sub(margin);
        let end = (band.first + num_rows + margin).min(self.height);
        let mut samples = Vec::with_capacity((end - first) as usize * width);
        let mut lists = Vec::new();
        let mut listed = u32::MAX;
        let is_wanted = |place: usize| {
            band.wanted
                .is_none_or(|wanted| wanted.get(place) == Some(&true))
        };
        for row in first..end {
            if row / TILE != listed {
                listed = row / TILE;
                self.candidates(listed, &mut lists);
            }
            for column in 0..self.width {
                if !is_wanted(samples.len()) {
                    samples.push(Sample::default());
                    continue;
                }
                samples.push(self.trace(
                    f64::from(column),
                    f64::from(row),
                    &lists[(column / TILE) as usize],
                ));
            }
        }
        let film = Film::shared();
        let middle = (
            (self.width as f32 - 1.0) / 2.0,
            (self.height as f32 - 1.0) / 2.0,
        );
        let corner_sq = middle.0 * middle.0 + middle.1 * middle.1 + 1.0;
        listed = u32::MAX;
        for row in band.first..band.first + num_rows {
            if row / TILE != listed {
                listed = row / TILE;
                self.candidates(listed, &mut lists);
            }
            let offset = (row - first) as usize * width;
            let target = (row - band.first) as usize * width;
            for column in 0..width {
                if !is_wanted(target + column) {
                    continue;
                }
                let sample = samples[offset + column];
                band.depth_m[target + column] = sample.depth_m;
                let mut color = sample.color;
                if self.sampling == Sampling::Full && is_edge(&samples, width, offset, column) {
                    // Each ray is clamped, so that a bright reflection does not outweigh the rest
                    // of its pixel.
                    let mut sum = [color[0].min(1.5), color[1].min(1.5), color[2].min(1.5)];
                    let list = &lists[column / TILE as usize];
                    for (du, dv) in EDGE_OFFSETS {
                        let extra = self.trace(column as f64 + du, f64::from(row) + dv, list);
                        for i in 0..3 {
                            sum[i] += extra.color[i].min(1.5);
                        }
                    }
                    color = [sum[0] / 9.0, sum[1] / 9.0, sum[2] / 9.0];
                }
                let (x, y) = (column as f32 - middle.0, row as f32 - middle.1);
                let vignette = 1.0 - 0.2 * (x * x + y * y) / corner_sq;
                let color = [
                    color[0] * vignette,
                    color[1] * vignette,
                    color[2] * vignette,
                ];
                let pixel = film.develop(color, column as u32, row);
                band.rgb[3 * (target + column)..3 * (target + column) + 3].copy_from_slice(&pixel);
            }
        }
    }
}

/// Returns whether a pixel's neighbors see another surface, or a fold of the same one.
fn is_edge(samples: &[Sample], width: usize, offset: usize, column: usize) -> bool {
    let at = offset + column;
    let here = &samples[at];
    let left = &samples[at - usize::from(column > 0)];
    let right = &samples[at + usize::from(column + 1 < width)];
    let above = &samples[if at >= width { at - width } else { at }];
    let below = &samples[if at + width < samples.len() {
        at + width
    } else {
        at
    }];
    if [left, right, above, below]
        .iter()
        .any(|other| other.key != here.key)
    {
        return true;
    }
    // Inverse depth is linear on a plane.
    let bend = |a: &Sample, b: &Sample| {
        (a.inverse_depth + b.inverse_depth - 2.0 * here.inverse_depth).abs()
    };
    let inside = column > 0 && column + 1 < width;
    let limit = 0.006 * here.inverse_depth;
    (inside && bend(left, right) > limit)
        || (at >= width && at + width < samples.len() && bend(above, below) > limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sets::still_life_camera;
    use epipole::camera::{Camera, Intrinsics};
    use image::ImageBuffer;
    use nalgebra::{Point2, Vector3};

    fn fingerprint(bytes: &[u8]) -> u64 {
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }

    /// Pixels must not change: the bytes are the same natively and in the browser.
    #[test]
    fn bytes_are_pinned() {
        let camera = still_life_camera(96, 72);
        let scene = Scene::still_life();
        let photo = scene.render(&camera, 96, 72, Sampling::Full).unwrap();
        let draft = scene.render(&camera, 96, 72, Sampling::Draft).unwrap();
        assert_eq!(
            (
                fingerprint(&photo.image),
                fingerprint(&draft.image),
                photo
                    .depth_m
                    .iter()
                    .fold(0u64, |sum, depth| sum.wrapping_mul(31)
                        + u64::from(depth.to_bits()))
            ),
            PINNED
        );
        assert_eq!(photo.depth_m, draft.depth_m);
    }

    const PINNED: (u64, u64, u64) = (
        10_741_224_663_931_580_679,
        10_724_003_982_137_813_183,
        17_117_404_129_774_592_211,
    );

    #[test]
    fn slices_equal_the_whole() {
        let camera = still_life_camera(80, 60);
        let scene = Scene::still_life();
        for sampling in [Sampling::Draft, Sampling::Full] {
            let whole = scene.render(&camera, 80, 60, sampling).unwrap();
            let mut sliced = Photograph::blank(80, 60);
            for rows in [40..60, 0..1, 1..17, 17..39, 39..40, 90..99] {
                scene
                    .render_rows(&camera, 80, 60, sampling, rows, &mut sliced)
                    .unwrap();
            }
            assert!(whole == sliced, "{sampling:?}");
        }
    }

    /// Asserts that every pixel's depth equals that of a ray cast through all bodies without
    /// shortcuts.
    #[test]
    fn depth_equals_exact_rays() {
        let scene = Scene::still_life();
        let front = still_life_camera(64, 48);
        for (dx, dz, yaw) in [(0.0, 0.0, 0.0), (0.5, 0.3, -0.35), (-0.5, 0.5, 0.35)] {
            let rotation = nalgebra::Isometry3::rotation(Vector3::new(0.0, yaw, 0.0));
            let camera = PosedCamera {
                camera: front.camera,
                cam_from_world: rotation
                    * front.cam_from_world
                    * nalgebra::Translation3::new(-dx, 0.0, -dz),
            };
            let photo = scene.render(&camera, 64, 48, Sampling::Draft).unwrap();
            for (u, v, depth) in photo.depth_m.enumerate_pixels() {
                let pixel = Point2::new(f64::from(u), f64::from(v));
                let hit = scene
                    .cast(&camera.center_in_world(), &camera.ray_in_world(&pixel))
                    .unwrap();
                let error = (f64::from(depth.0[0]) - hit.distance_along).abs();
                assert!(error < 1e-6 * hit.distance_along, "{u} {v}: {error}");
            }
        }
    }

    #[test]
    fn bad_requests_are_refused() {
        let scene = Scene::still_life();
        let camera = still_life_camera(64, 48);
        for (width, height) in [(0, 48), (64, 0), (8000, 8000), (u32::MAX, u32::MAX)] {
            assert!(matches!(
                scene.render(&camera, width, height, Sampling::Draft),
                Err(Error::OutOfRange { .. })
            ));
        }
        let at = |x: f64, y: f64, z: f64| PosedCamera {
            camera: Camera::pinhole(Intrinsics::centered(60.0, 64, 48).unwrap(), 64, 48),
            cam_from_world: nalgebra::Isometry3::translation(-x, -y, -z),
        };
        // In the table top, and far outside of the room.
        for camera in [at(0.0, 0.01, 0.0), at(0.0, -50.0, 0.0)] {
            assert!(matches!(
                scene.render(&camera, 64, 48, Sampling::Draft),
                Err(Error::Degenerate { .. })
            ));
        }
        assert!(matches!(
            scene.render(&at(f64::NAN, 0.0, 0.0), 64, 48, Sampling::Draft),
            Err(Error::NotFinite { .. })
        ));
        let mut target = Photograph::blank(8, 8);
        target.depth_m = ImageBuffer::new(4, 4);
        assert!(matches!(
            scene.render_rows(&camera, 8, 8, Sampling::Draft, 0..8, &mut target),
            Err(Error::SizeMismatch { .. })
        ));
    }
}
