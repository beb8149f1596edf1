//! Reprojection of photographs to another camera.
//!
//! Every pixel has a depth, so [`carry`] can project it into the other camera. Surfaces visible
//! only to the other camera leave gaps, which [`gaps`] fills from a draft.

mod carry;
mod gaps;

pub use gaps::Reprojected;

use super::Photograph;
use carry::{Carry, NEAR_M, Run};
use epipole::camera::{Intrinsics, PosedCamera};
use epipole::{Error, Result};
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// An object that has moved since a photograph was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// Its former center in the world, meters.
    pub center: Point3<f64>,
    /// Radius around its center that contains its surface, meters.
    pub radius_m: f64,
    /// Radius around its former and its new center within which other surfaces are outdated,
    /// because its shade has moved, meters.
    pub stale_m: f64,
    /// Displacement, meters.
    pub by: Vector3<f64>,
}

impl Photograph {
    /// Reprojects this photograph to the camera `to`, with gaps at surfaces that it does not show.
    ///
    /// * `from`: the camera of this photograph
    /// * `to`: another one, for a picture of the same size
    /// * `moved`: an object that has moved since then
    ///
    /// Reflections and other view-dependent effects are unchanged.
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] if colors and depths differ in size; [`Error::NotFinite`] for a
    /// camera that is not finite.
    ///
    /// Source: McMillan and Bishop 1995, "Plenoptic Modeling: An Image-Based Rendering System".
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole_scenes::{Reprojected, Sampling, Scene, still_life_camera};
    /// let camera = still_life_camera(64, 48);
    /// let photo = Scene::still_life().render(&camera, 64, 48, Sampling::Full)?;
    /// let mut reprojected = Reprojected::default();
    /// photo.reproject(&camera, &camera, None, &mut reprojected)?;
    /// assert_eq!(reprojected.image(), &photo.image);
    /// // A camera that has moved sees something new.
    /// let mut other = camera;
    /// other.cam_from_world.translation.x -= 0.2;
    /// photo.reproject(&camera, &other, None, &mut reprojected)?;
    /// assert!((100..1000).contains(&reprojected.num_missing()));
    /// # Ok(()) }
    /// ```
    pub fn reproject(
        &self,
        from: &PosedCamera,
        to: &PosedCamera,
        moved: Option<&Moved>,
        target: &mut Reprojected,
    ) -> Result<()> {
        let size = self.image.dimensions();
        let depth_size = self.depth_m.dimensions();
        for (first, second) in [(size.0, depth_size.0), (size.1, depth_size.1)] {
            if first != second {
                return Err(Error::SizeMismatch {
                    what: "the colors and the depths of a photograph",
                    first: first as usize,
                    second: second as usize,
                });
            }
        }
        let carry = Carry::new(from, to, size)?;
        target.begin(size);
        let depths = self.depth_m.as_raw();
        let Some(moved) = moved else {
            if from == to {
                target.pixels = self.packed().collect();
            } else if from.cam_from_world == to.cam_from_world {
                self.zoom(from, to, &mut target.pixels);
            } else {
                carry.all(self, depths, &mut target.pixels);
            }
            target.finish();
            return Ok(());
        };
        let (stale, carried) = moved.find(self, from);
        if from == to {
            target.pixels = self.packed().collect();
            for &index in stale.iter().chain(&carried) {
                target.pixels[index as usize] = 0;
            }
        } else {
            let mut depths = depths.clone();
            for &index in stale.iter().chain(&carried) {
                depths[index as usize] = 0.0;
            }
            carry.all(self, &depths, &mut target.pixels);
        }
        // The moved object is drawn last, as if nothing were in front of it.
        let carry = carry.moved(to, &moved.by);
        for indices in carried.chunk_by(|a, b| a + 1 == *b && !b.is_multiple_of(size.0)) {
            let (u, v) = (indices[0] % size.0, indices[0] / size.0);
            let run = Run {
                places: u..u + indices.len() as u32,
                is_upward: true,
            };
            carry.run(self, depths, (&run, (v, true)), &mut target.pixels);
        }
        target.finish();
        Ok(())
    }

    /// Reprojects to a camera of equal pose and other intrinsics, which is independent of depth.
    // Inlining would compile it for size with its callers.
    #[inline(never)]
    fn zoom(&self, from: &PosedCamera, to: &PosedCamera, target: &mut [u32]) {
        let (width, height) = self.image.dimensions();
        let (here, there) = (&from.camera.intrinsics, &to.camera.intrinsics);
        let [center, new_center] = [here, there].map(Intrinsics::principal_point);
        let (zoom_u, zoom_v) = (here.fu_px() / there.fu_px(), here.fv_px() / there.fv_px());
        let sources = |size: u32, center: f64, new_center: f64, zoom: f64| {
            (0..size).map(move |at| {
                let source = (f64::from(at) - new_center) * zoom + center + 0.5;
                (source >= 0.0 && source < f64::from(size)).then_some(source as usize)
            })
        };
        // The columns inside are contiguous.
        let columns = sources(width, center.x, new_center.x, zoom_u);
        let skipped = columns.clone().take_while(Option::is_none).count();
        let columns: Vec<usize> = columns.flatten().collect();
        let rows = sources(height, center.y, new_center.y, zoom_v);
        let width = width as usize;
        let pixels = self.image.as_raw().as_chunks::<3>().0;
        for (source, target) in rows.zip(target.chunks_exact_mut(width.max(1))) {
            let Some(source) = source else { continue };
            let row = source * width..(source + 1) * width;
            let (row, depths) = (&pixels[row.clone()], &self.depth_m.as_raw()[row]);
            let target = target.iter_mut().skip(skipped);
            for (&column, target) in columns.iter().zip(target) {
                if depths[column] > 0.0 {
                    let [r, g, b] = row[column];
                    *target = u32::from_le_bytes([r, g, b, 255]);
                }
            }
        }
    }

    fn packed(&self) -> impl Iterator<Item = u32> {
        let pixels = self.image.as_raw().as_chunks::<3>().0;
        pixels
            .iter()
            .map(|&[r, g, b]| u32::from_le_bytes([r, g, b, 255]))
    }
}

impl Moved {
    /// Returns the outdated pixels, and the pixels of the object itself.
    fn find(&self, photo: &Photograph, camera: &PosedCamera) -> (Vec<u32>, Vec<u32>) {
        let (width, height) = photo.image.dimensions();
        let old = camera.cam_from_world * self.center;
        let new = camera.cam_from_world * (self.center + self.by);
        let reach_m = self.radius_m.max(self.stale_m);
        let (mut stale, mut carried) = (Vec::new(), Vec::new());
        let all = [0..width, 0..height];
        let [columns, rows] = [&old, &new]
            .map(|middle| bounds(camera, middle, reach_m, &all))
            .into_iter()
            .reduce(|[a, b], [c, d]| [join(&a, &c), join(&b, &d)])
            .unwrap_or(all);
        let [radius_sq, stale_sq] = [self.radius_m, self.stale_m].map(|radius| radius * radius);
        for v in rows {
            for u in columns.clone() {
                let index = v * width + u;
                let depth_m = f64::from(photo.depth_m.as_raw()[index as usize]);
                let pixel = nalgebra::Point2::new(f64::from(u), f64::from(v));
                let point = Point3::from(camera.camera.intrinsics.ray(&pixel) * depth_m);
                if (point - old).norm_squared() <= radius_sq {
                    carried.push(index);
                } else if (point - old)
                    .norm_squared()
                    .min((point - new).norm_squared())
                    <= stale_sq
                {
                    stale.push(index);
                }
            }
        }
        (stale, carried)
    }
}

/// Returns columns and rows that may show a ball; all if it reaches up to the camera.
fn bounds(
    camera: &PosedCamera,
    middle: &Point3<f64>,
    radius_m: f64,
    all: &[Range<u32>; 2],
) -> [Range<u32>; 2] {
    let nearest = middle.z - radius_m;
    if nearest.is_nan() || nearest < f64::from(NEAR_M) {
        return all.clone();
    }
    let k = &camera.camera.intrinsics;
    let focal = [k.fu_px(), k.fv_px()];
    let center = k.principal_point();
    std::array::from_fn(|i| {
        // Among depths within the ball, the nearest gives the outermost edges.
        let edge = |sign: f64| {
            let offset = middle[i] + sign * radius_m;
            let depth = if offset * sign > 0.0 {
                nearest
            } else {
                middle.z + radius_m
            };
            center[i] + focal[i] * offset / depth
        };
        let most = f64::from(all[i].end);
        let start = (edge(-1.0) - 1.0).clamp(0.0, most) as u32;
        start..(edge(1.0) + 2.0).clamp(f64::from(start), most) as u32
    })
}

fn join(a: &Range<u32>, b: &Range<u32>) -> Range<u32> {
    a.start.min(b.start)..a.end.max(b.end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rendering::Sampling;
    use crate::scene::Scene;
    use crate::sets::{MovableKind, MovableObject, still_life_camera};
    use epipole::camera::{Camera, RigidTransform};
    use image::RgbImage;
    use nalgebra::{Isometry3, Point2, Translation3};

    const SIZE: (u32, u32) = (160, 120);

    fn moved(right_m: f64, down_m: f64, ahead_m: f64, left_rad: f64) -> PosedCamera {
        let camera = still_life_camera(SIZE.0, SIZE.1);
        PosedCamera {
            cam_from_world: Isometry3::rotation(Vector3::new(0.0, left_rad, 0.0))
                * Translation3::new(-right_m, -down_m, -ahead_m)
                * camera.cam_from_world,
            ..camera
        }
    }

    fn places() -> [PosedCamera; 8] {
        [
            moved(0.2, 0.0, 0.0, 0.0),
            moved(-0.2, 0.0, 0.0, 0.0),
            moved(0.0, -0.1, 0.0, 0.0),
            moved(0.05, 0.05, 0.3, 0.0),
            moved(0.0, 0.0, -0.3, 0.0),
            moved(0.0, 0.0, 0.0, 0.2),
            moved(0.4, 0.0, -0.3, 0.2),
            moved(-0.1, -0.05, 0.2, -0.1),
        ]
    }

    fn render(scene: &Scene, camera: &PosedCamera) -> Photograph {
        scene
            .render(camera, SIZE.0, SIZE.1, Sampling::Full)
            .unwrap()
    }

    /// Pairs of colors at pixels that are not missing.
    fn pairs<'a>(
        reprojected: &'a Reprojected,
        truth: &'a RgbImage,
    ) -> impl Iterator<Item = ([u8; 3], [u8; 3])> + 'a {
        let missing: std::collections::BTreeSet<u32> =
            reprojected.missing.iter().cloned().flatten().collect();
        let pixels = reprojected.image.pixels().zip(truth.pixels()).enumerate();
        pixels
            .filter(move |(index, _)| !missing.contains(&(*index as u32)))
            .map(|(_, (a, b))| (a.0, b.0))
    }

    /// Asserts that the reprojection is close to a photograph from the new camera, much closer than
    /// a draft.
    #[test]
    fn it_looks_like_a_photo_from_there() {
        let scene = Scene::still_life();
        let from = still_life_camera(SIZE.0, SIZE.1);
        let photo = render(&scene, &from);
        let mut reprojected = Reprojected::default();
        for (index, to) in places().iter().enumerate() {
            photo.reproject(&from, to, None, &mut reprojected).unwrap();
            let truth = render(&scene, to).image;
            let mean = |pairs: &mut dyn Iterator<Item = ([u8; 3], [u8; 3])>| {
                let (mut sum, mut count) = (0.0, 0.0);
                for (a, b) in pairs {
                    sum += (0..3).map(|i| f64::from(a[i].abs_diff(b[i]))).sum::<f64>();
                    count += 3.0;
                }
                sum / count
            };
            let error = mean(&mut pairs(&reprojected, &truth));
            let mut draft = Reprojected::default();
            draft.clear(SIZE);
            let small = PosedCamera {
                camera: Camera::pinhole(
                    to.camera.intrinsics.scaled(1.0 / 6.0).unwrap(),
                    SIZE.0.div_ceil(6),
                    SIZE.1 / 6,
                ),
                ..*to
            };
            let sixth = (SIZE.0.div_ceil(6), SIZE.1 / 6);
            let sketch = scene.render(&small, sixth.0, sixth.1, Sampling::Draft);
            draft.fill(&sketch.unwrap().image);
            draft.missing.clear();
            let of_draft = mean(&mut pairs(&draft, &truth));
            assert!(
                error < 0.6 * of_draft,
                "{index}: {error}, a draft {of_draft}"
            );
            assert!(
                reprojected.num_missing() < truth.len() / 3 * 45 / 100,
                "{index}"
            );
        }
    }

    /// Asserts that near surfaces cover far ones for any camera motion, with positions in the room
    /// as colors.
    #[test]
    fn near_surfaces_cover_far_ones() {
        let scene = Scene::still_life();
        let from = still_life_camera(SIZE.0, SIZE.1);
        let mut photo = render(&scene, &from);
        let in_world = |camera: &PosedCamera, photo: &Photograph, u: u32, v: u32| {
            let pixel = Point2::new(f64::from(u), f64::from(v));
            let depth = f64::from(photo.depth_m.get_pixel(u, v).0[0]);
            camera.center_in_world() + camera.ray_in_world(&pixel) * depth
        };
        // Color of a surface by its z in the room, from front to back.
        let paint = |point: Point3<f64>| [((point.z + 0.6) * 140.0).clamp(0.0, 250.0) as u8 + 3; 3];
        let painted = RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| {
            image::Rgb(paint(in_world(&from, &photo, u, v)))
        });
        photo.image = painted;
        let mut reprojected = Reprojected::default();
        for (index, to) in places().iter().enumerate() {
            photo.reproject(&from, to, None, &mut reprojected).unwrap();
            let there = render(&scene, to);
            let truth = RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| {
                image::Rgb(paint(in_world(to, &there, u, v)))
            });
            let (mut all, mut wrong) = (0, 0);
            for (a, b) in pairs(&reprojected, &truth) {
                all += 1;
                wrong += usize::from(a[0].abs_diff(b[0]) > 10);
            }
            // At outlines, either neighbor is correct.
            assert!(wrong * 100 < all * 6, "{index}: {wrong} of {all}");
        }
    }

    #[test]
    fn what_was_hidden_is_filled_from_a_draft() {
        let scene = Scene::still_life();
        let from = still_life_camera(SIZE.0, SIZE.1);
        let to = moved(0.3, 0.0, 0.0, 0.0);
        let mut reprojected = Reprojected::default();
        let photo = render(&scene, &from);
        photo.reproject(&from, &to, None, &mut reprojected).unwrap();
        let missing: Vec<u32> = reprojected.missing.iter().cloned().flatten().collect();
        assert!(!missing.is_empty());
        let mut num_new = 0;
        for &index in &missing {
            let pixel2 = Point2::new(f64::from(index % SIZE.0), f64::from(index / SIZE.0));
            let there = scene.transfer(&to, &from, &pixel2);
            let was_rendered = match there {
                crate::Transfer::Visible { pixel2: p, .. } => {
                    (1.0..f64::from(SIZE.0) - 2.0).contains(&p.x)
                        && (1.0..f64::from(SIZE.1) - 2.0).contains(&p.y)
                }
                _ => false,
            };
            num_new += usize::from(!was_rendered);
        }
        assert!(
            num_new * 100 > missing.len() * 90,
            "{num_new} of {}",
            missing.len()
        );
        reprojected.fill(&RgbImage::from_pixel(20, 15, image::Rgb([1, 2, 3])));
        for index in missing {
            let pixel = reprojected.image.get_pixel(index % SIZE.0, index / SIZE.0);
            assert_eq!(pixel.0, [1, 2, 3]);
        }
    }

    /// Asserts that rendering only the wanted pixels of a draft fills the gaps equally well.
    #[test]
    fn only_what_is_wanted_of_a_draft_is_used() {
        let scene = Scene::still_life();
        let from = still_life_camera(SIZE.0, SIZE.1);
        let photo = render(&scene, &from);
        let small = (SIZE.0.div_ceil(6), SIZE.1 / 6);
        for to in places() {
            let fill = |all: bool| {
                let mut reprojected = Reprojected::default();
                photo.reproject(&from, &to, None, &mut reprojected).unwrap();
                let camera = PosedCamera {
                    camera: Camera::pinhole(
                        to.camera.intrinsics.scaled(1.0 / 6.0).unwrap(),
                        SIZE.0.div_ceil(6),
                        SIZE.1 / 6,
                    ),
                    ..to
                };
                let wanted = reprojected.wanted(small);
                assert!(wanted.iter().any(|&wanted| !wanted));
                let wanted = wanted.iter().map(|&wanted| wanted || all);
                let mut draft = Photograph::blank(small.0, small.1);
                scene
                    .render_draft(&camera, &wanted.collect::<Vec<_>>(), &mut draft)
                    .unwrap();
                reprojected.fill(&draft.image);
                reprojected.image
            };
            assert_eq!(fill(true), fill(false));
        }
    }

    #[test]
    fn a_ball_is_carried_along() {
        let camera = still_life_camera(SIZE.0, SIZE.1);
        let camera = PosedCamera {
            cam_from_world: RigidTransform::identity(),
            ..camera
        };
        let ball = |x_m: f64| {
            let kind = MovableKind::Ball;
            Scene::long_table(MovableObject {
                kind,
                x_m,
                z_m: 2.0,
            })
            .unwrap()
        };
        let before = render(&ball(0.0), &camera);
        let after = render(&ball(0.3), &camera);
        let moved = Moved {
            center: Point3::new(0.0, 0.14, 2.0),
            radius_m: 0.115,
            stale_m: 0.3,
            by: Vector3::new(0.3, 0.0, 0.0),
        };
        let mut reprojected = Reprojected::default();
        before
            .reproject(&camera, &camera, Some(&moved), &mut reprojected)
            .unwrap();
        reprojected.fill(&after.image);
        let wrong = (reprojected.image.pixels().zip(after.image.pixels()))
            .filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 40))
            .count();
        let differs = (before.image.pixels().zip(after.image.pixels()))
            .filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 40))
            .count();
        assert!(wrong * 8 < differs, "{wrong}, {differs}");
    }

    /// Asserts that a longer focal length only enlarges: no pixel covers another, and there is no
    /// gap inside.
    #[test]
    fn another_focal_length_zooms() {
        let scene = Scene::still_life();
        let from = still_life_camera(SIZE.0, SIZE.1);
        let photo = render(&scene, &from);
        let mut reprojected = Reprojected::default();
        for factor in [0.8, 1.25, 2.0] {
            let k = &from.camera.intrinsics;
            let focal_px = factor * k.fu_px();
            let to = PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::centered(focal_px, SIZE.0, SIZE.1).unwrap(),
                    SIZE.0,
                    SIZE.1,
                ),
                ..from
            };
            photo.reproject(&from, &to, None, &mut reprojected).unwrap();
            let truth = render(&scene, &to).image;
            let (mut sum, mut count) = (0.0, 0.0);
            for (a, b) in pairs(&reprojected, &truth) {
                sum += (0..3).map(|i| f64::from(a[i].abs_diff(b[i]))).sum::<f64>();
                count += 3.0;
            }
            assert!(sum / count < 8.0, "{factor}: {}", sum / count);
            let whole = f64::from(SIZE.0 * SIZE.1);
            let expected = whole * (1.0 - f64::min(factor * factor, 1.0));
            let missing = reprojected.num_missing() as f64;
            assert!(
                (missing - expected).abs() < 0.02 * whole,
                "{factor}: {missing}"
            );
        }
    }

    #[test]
    fn bad_requests_are_refused() {
        let camera = still_life_camera(8, 6);
        let mut photo = Photograph::blank(8, 6);
        let mut reprojected = Reprojected::default();
        let mut nowhere = camera;
        nowhere.cam_from_world.translation.x = f64::NAN;
        let refused = photo.reproject(&camera, &nowhere, None, &mut reprojected);
        assert!(matches!(refused, Err(Error::NotFinite { .. })));
        // Pixels without depth are not projected.
        let other = still_life_camera(9, 6);
        photo
            .reproject(&camera, &other, None, &mut reprojected)
            .unwrap();
        assert_eq!(reprojected.num_missing(), 48);
        reprojected.fill(&RgbImage::new(0, 0));
        photo.depth_m = image::ImageBuffer::new(4, 4);
        let refused = photo.reproject(&camera, &camera, None, &mut reprojected);
        assert!(matches!(refused, Err(Error::SizeMismatch { .. })));
    }
}
