//! A scene: its bodies and light, exact rays through it, and exact correspondences.

use super::body::{Body, Placement};
use super::gradual::Gradual;
use super::light::{Baking, Decal, Detail, LightMap, Lighting, Shading};
use super::shape::{Contact, Ray};
use crate::camera::PosedCamera;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};
use std::sync::Arc;

/// A contact closer than this part of a ray is the place it started from.
const NEAR: f64 = 1e-9;

/// What one step of [`Scene::prepare`] computes: cells of light maps, or texels.
const CELLS_PER_STEP: usize = 256;
const TEXELS_PER_STEP: usize = 4096;

/// The first surface that a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Where, in the world, meters.
    pub point: Point3<f64>,
    /// Unit normal toward the outside of the surface; on round bodies the smooth one that
    /// shading uses.
    pub normal: Vector3<f64>,
    /// `point = origin + distance_along * direction`. With the direction of
    /// [`PosedCamera::ray_in_world`] it is the depth.
    pub distance_along: f64,
    /// What was hit, such as "the mug".
    pub object: &'static str,
}

/// Where the surface point seen at a pixel of one camera appears in another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transfer {
    /// The second camera sees it. Whether `pixel2` lies inside its picture is for the caller to
    /// compare: a camera knows no picture size.
    Visible {
        /// Where the second camera sees it.
        pixel2: Point2<f64>,
        /// The point.
        x_in_world: Point3<f64>,
    },
    /// Something stands between it and the second camera, possibly the thing's own other side.
    Occluded {
        /// Where the second camera would see it.
        pixel2: Point2<f64>,
        /// The point.
        x_in_world: Point3<f64>,
        /// What stands in the way.
        by: &'static str,
    },
    /// It is behind the second camera.
    BehindCamera {
        /// The point.
        x_in_world: Point3<f64>,
    },
    /// The first camera's ray meets nothing, because that camera is not in the room, or the
    /// pixel is not a finite number.
    Nothing,
}

/// Light on every body and chart.
type Lights = Vec<Vec<LightMap>>;

/// Bodies that never move, with their light.
#[derive(Debug)]
pub(super) struct Fixed {
    pub(super) bodies: Vec<Body>,
    pub(super) lighting: Lighting,
    lights: [Gradual<Baking, Lights>; 2],
}

impl Fixed {
    pub(super) fn new(bodies: Vec<Body>, lighting: Lighting) -> Self {
        Self {
            bodies,
            lighting,
            lights: [Gradual::new(), Gradual::new()],
        }
    }

    fn bake(&self, detail: Detail, baking: &mut Baking, mut amount: usize) -> Option<Lights> {
        let bodies: Vec<&Body> = self.bodies.iter().collect();
        baking.advance(&bodies, &self.lighting, detail, &mut amount)
    }

    fn lights(&self, detail: Detail) -> &Lights {
        self.lights[detail as usize].get(|baking, amount| self.bake(detail, baking, amount))
    }

    fn advance(&self, detail: Detail, num_cells: usize) -> bool {
        self.lights[detail as usize].advance(num_cells, |baking, amount| {
            self.bake(detail, baking, amount)
        })
    }
}

/// One thing that moves: its bodies around the origin and the shade it throws.
#[derive(Debug)]
pub(super) struct Movable {
    pub(super) bodies: Vec<Body>,
    /// What it stands on while its light is computed: the plane y = 0.
    pub(super) slab: Body,
    /// The body of the scene on which the shade falls.
    pub(super) ground: usize,
    looks: [Gradual<Looking, Look>; 2],
}

/// A look as far as it is computed.
type Looking = (Baking, Shading, Option<Decal>);

/// Light on every body and chart of a movable thing, and its shade.
#[derive(Debug)]
struct Look {
    lights: Lights,
    decal: Decal,
}

/// Side of the square that the shade of a movable thing covers, meters.
pub(super) const SHADE_M: f64 = 1.1;

impl Movable {
    pub(super) fn new(bodies: Vec<Body>, slab: Body, ground: usize) -> Self {
        Self {
            bodies,
            slab,
            ground,
            looks: [Gradual::new(), Gradual::new()],
        }
    }

    fn work(
        &self,
        lighting: &Lighting,
        detail: Detail,
        (baking, shading, decal): &mut Looking,
        mut amount: usize,
    ) -> Option<Look> {
        let mut bodies: Vec<&Body> = self.bodies.iter().collect();
        if decal.is_none() {
            let ground = (detail, SHADE_M, &self.slab);
            *decal = Some(shading.advance(&bodies, lighting, ground, &mut amount)?);
        }
        bodies.push(&self.slab);
        let mut lights = baking.advance(&bodies, lighting, detail, &mut amount)?;
        lights.truncate(self.bodies.len());
        Some(Look {
            lights,
            decal: decal.take()?,
        })
    }

    fn look(&self, lighting: &Lighting, detail: Detail) -> &Look {
        self.looks[detail as usize].get(|part, amount| self.work(lighting, detail, part, amount))
    }

    fn advance(&self, lighting: &Lighting, detail: Detail, num_cells: usize) -> bool {
        self.looks[detail as usize].advance(num_cells, |part, amount| {
            self.work(lighting, detail, part, amount)
        })
    }
}

/// A furnished room that can be photographed from anywhere inside.
///
/// Everything static is computed once, for the first sharp photograph or before it by
/// [`Scene::prepare`]: painted textures with all their smaller sizes, and maps of light with soft
/// shadows. Drafts have coarser ones of their own, which take a fraction of the time. A clone shares
/// them all, and costs next to nothing; rays and transfers need only the shapes.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(super) fixed: Arc<Fixed>,
    pub(super) movable: Option<(Arc<Movable>, Placement)>,
}

impl Scene {
    /// Every body and where it stands.
    pub(super) fn placed(&self) -> impl Iterator<Item = (&Body, Placement)> {
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

    /// Light on the charts of every body, in the order of [`Scene::placed`].
    pub(super) fn lights(&self, detail: Detail) -> impl Iterator<Item = &[LightMap]> {
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

    /// The shade of the movable thing, where it stands, and the body on which the shade falls.
    pub(super) fn shade(&self, detail: Detail) -> Option<(&Decal, Placement, usize)> {
        let (movable, placed) = self.movable.as_ref()?;
        let look = movable.look(&self.fixed.lighting, detail);
        Some((&look.decal, *placed, movable.ground))
    }

    /// Does a few milliseconds of what the first sharp photograph waits for: textures are painted and
    /// light is computed. False once all of it is there. The photographs are the same with and
    /// without.
    ///
    /// ```
    /// use epipole::synthetic::Scene;
    /// let scene = Scene::still_life();
    /// let num_steps = (0..10_000).take_while(|_| scene.prepare()).count();
    /// assert!(num_steps < 10_000 && !scene.prepare());
    /// ```
    pub fn prepare(&self) -> bool {
        self.advance(Detail::Full)
    }

    /// The same for the first draft, which has coarser textures and light of its own.
    ///
    /// ```
    /// use epipole::synthetic::Scene;
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

    /// The first surface that the ray `origin + a direction`, `a > 0`, meets; `None` if the
    /// origin is outside of the room and the ray misses it, or a number is not finite.
    ///
    /// Contacts closer than `10⁻⁹` directions do not count, so a ray may start on a surface.
    ///
    /// ```
    /// use epipole::synthetic::Scene;
    /// use nalgebra::{Point3, Vector3};
    /// // The table's top is the plane y = 0, and y points down.
    /// let scene = Scene::still_life();
    /// let down = Vector3::new(0.0, 2.0, 0.0);
    /// let hit = scene.cast(&Point3::new(-0.7, -0.5, -0.5), &down).ok_or("nothing")?;
    /// assert_eq!(hit.object, "the table");
    /// assert!((hit.distance_along - 0.25).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn cast(&self, origin: &Point3<f64>, direction: &Vector3<f64>) -> Option<Hit> {
        let finite = origin.coords.iter().chain(direction.iter());
        if !finite.into_iter().all(|x| x.is_finite()) || direction.norm_squared() == 0.0 {
            return None;
        }
        let ray = Ray {
            origin: origin.coords,
            direction: *direction,
        };
        let mut nearest: Option<(Contact, &Body, Placement)> = None;
        for (body, placed) in self.placed() {
            let far = nearest.map_or(f64::INFINITY, |(contact, ..)| contact.along);
            if let Some(contact) = body.meet(&ray, &placed, NEAR, far) {
                nearest = Some((contact, body, placed));
            }
        }
        let (contact, body, placed) = nearest?;
        let local = body.local_ray(&ray, &placed).at(contact.along);
        let place = body.shape.place(&local, contact.part);
        Some(Hit {
            point: Point3::from(ray.at(contact.along)),
            normal: body.normal_in_world(&place.normal),
            distance_along: contact.along,
            object: body.name,
        })
    }

    /// Where the surface point that `cam1` sees at `pixel1` appears in `cam2`, exactly.
    ///
    /// The ray of `pixel1` is followed to the first surface, the point is projected into `cam2`,
    /// and the ray from there decides whether something hides it.
    ///
    /// ```
    /// use epipole::synthetic::{Scene, Transfer, still_life_camera};
    /// use nalgebra::Point2;
    /// // From the same camera, every pixel is seen where it is.
    /// let camera = still_life_camera(640, 480);
    /// let pixel = Point2::new(320.0, 300.0);
    /// let Transfer::Visible { pixel2, .. } = Scene::still_life().transfer(&camera, &camera, &pixel)
    /// else {
    ///     panic!("a camera sees what it sees");
    /// };
    /// assert!((pixel2 - pixel).norm() < 1e-9);
    /// ```
    pub fn transfer(
        &self,
        cam1: &PosedCamera,
        cam2: &PosedCamera,
        pixel1: &Point2<f64>,
    ) -> Transfer {
        let Some(hit) = self.cast(&cam1.center_in_world(), &cam1.ray_in_world(pixel1)) else {
            return Transfer::Nothing;
        };
        let x_in_world = hit.point;
        let Ok(pixel2) = cam2.project(&x_in_world) else {
            return Transfer::BehindCamera { x_in_world };
        };
        let center2 = cam2.center_in_world();
        match self.cast(&center2, &(x_in_world - center2)) {
            // The surface itself is met at 1, up to rounding.
            Some(blocker) if blocker.distance_along < 1.0 - 1e-7 => Transfer::Occluded {
                pixel2,
                x_in_world,
                by: blocker.object,
            },
            _ => Transfer::Visible { pixel2, x_in_world },
        }
    }

    /// Refuses cameras from which no picture can be taken.
    pub(super) fn check(&self, camera: &PosedCamera, width: u32, height: u32) -> Result<()> {
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

    /// Bytes held by textures and light maps, each texture counted once.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        let mut seen = Vec::new();
        let mut bytes = 0;
        for ((body, _), lights) in self.placed().zip(self.lights(Detail::Full)) {
            bytes += lights.iter().map(|light| light.bytes()).sum::<usize>();
            for paint in &body.paints {
                let address = Arc::as_ptr(&paint.texture);
                if !seen.contains(&address) {
                    seen.push(address);
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
    use crate::camera::{cross_matrix, relative_motion};
    use crate::synthetic::still_life_camera;
    use nalgebra::{Isometry3, Translation3};

    fn pair() -> (PosedCamera, PosedCamera) {
        let camera1 = still_life_camera(640, 480);
        let camera2 = PosedCamera {
            cam_from_world: Isometry3::rotation(Vector3::new(0.02, -0.2, 0.05))
                * Translation3::new(-0.4, 0.05, -0.1)
                * camera1.cam_from_world,
            ..camera1
        };
        (camera1, camera2)
    }

    #[test]
    fn a_ray_passes_by_nothing_that_it_meets() {
        use crate::math::random::Random;
        use crate::synthetic::{MovableKind, MovableObject};
        let mut random = Random::new(4);
        let ball = MovableObject {
            kind: MovableKind::Ball,
            x_m: 0.2,
            z_m: 1.7,
        };
        let scenes = [Scene::still_life(), Scene::long_table(ball).unwrap()];
        let mut num_things = 0;
        for scene in &scenes {
            for _ in 0..4000 {
                let mut point = |reach: f64| Vector3::from_fn(|_, _| random.uniform(-reach, reach));
                let (origin, direction) = (point(0.8), point(1.0));
                let ray = Ray { origin, direction };
                // All shapes, without a look at whether they are aside.
                let contacts = scene.placed().filter_map(|(body, placed)| {
                    let local = body.local_ray(&ray, &placed);
                    let contact = body.shape.meet(&local, NEAR, f64::INFINITY)?;
                    Some((contact.along, body.name))
                });
                let nearest = contacts.min_by(|a, b| a.0.total_cmp(&b.0));
                let hit = scene.cast(&origin.into(), &direction);
                let found = hit.map(|hit| (hit.distance_along, hit.object));
                assert_eq!(
                    found.map(|(along, _)| along),
                    nearest.map(|(along, _)| along)
                );
                num_things += usize::from(found.is_some_and(|(_, name)| name != "the wall"));
            }
        }
        assert!(num_things > 1000, "{num_things}");
    }

    /// Points found by rays obey x2ᵀ F x1 = 0 with F from the cameras, and go back to where they
    /// came from.
    #[test]
    fn transfers_obey_the_epipolar_constraint() {
        let scene = Scene::still_life();
        let (camera1, camera2) = pair();
        let motion = relative_motion(&camera1.cam_from_world, &camera2.cam_from_world);
        let essential = cross_matrix(&motion.translation.vector)
            * motion.rotation.to_rotation_matrix().into_inner();
        let f = camera2.intrinsics.inverse_matrix().transpose()
            * essential
            * camera1.intrinsics.inverse_matrix();
        let (mut num_visible, mut num_occluded) = (0, 0);
        for v in (3..480).step_by(17) {
            for u in (2..640).step_by(13) {
                let pixel1 = Point2::new(f64::from(u), f64::from(v));
                let (pixel2, x_in_world) = match scene.transfer(&camera1, &camera2, &pixel1) {
                    Transfer::Visible { pixel2, x_in_world } => {
                        num_visible += 1;
                        let Transfer::Visible { pixel2: back, .. } =
                            scene.transfer(&camera2, &camera1, &pixel2)
                        else {
                            panic!("what both see goes back: {pixel1}");
                        };
                        assert!((back - pixel1).norm() < 1e-4, "{pixel1} {back}");
                        (pixel2, x_in_world)
                    }
                    Transfer::Occluded {
                        pixel2, x_in_world, ..
                    } => {
                        num_occluded += 1;
                        (pixel2, x_in_world)
                    }
                    other => panic!("{other:?}"),
                };
                assert!((camera1.project(&x_in_world).unwrap() - pixel1).norm() < 1e-8);
                let line = f * pixel1.to_homogeneous();
                let distance_px = line.dot(&pixel2.to_homogeneous()).abs()
                    / (line.x * line.x + line.y * line.y).sqrt();
                assert!(distance_px < 1e-7, "{pixel1}: {distance_px}");
            }
        }
        assert!(
            num_visible > 1000 && num_occluded > 50,
            "{num_visible} {num_occluded}"
        );
    }

    /// The wall behind the jug, seen from the left of it, is hidden from the right.
    #[test]
    fn the_jug_hides_the_wall() {
        let scene = Scene::still_life();
        let camera1 = still_life_camera(640, 480);
        let behind_jug = Point3::new(0.08, -0.20, 1.05);
        let beside = PosedCamera {
            cam_from_world: Translation3::new(0.8, 0.0, 0.0) * camera1.cam_from_world,
            ..camera1
        };
        let pixel1 = beside.project(&behind_jug).unwrap();
        match scene.transfer(&beside, &camera1, &pixel1) {
            Transfer::Occluded { by, x_in_world, .. } => {
                assert_eq!(by, "the jug");
                assert!((x_in_world - behind_jug).norm() < 1e-9);
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn behind_the_camera_and_nothing() {
        let scene = Scene::still_life();
        let camera1 = still_life_camera(640, 480);
        let backward = PosedCamera {
            cam_from_world: Isometry3::rotation(Vector3::new(0.0, std::f64::consts::PI, 0.0))
                * camera1.cam_from_world,
            ..camera1
        };
        let middle = Point2::new(320.0, 240.0);
        assert!(matches!(
            scene.transfer(&camera1, &backward, &middle),
            Transfer::BehindCamera { .. }
        ));
        let nan = Point2::new(f64::NAN, 1.0);
        assert_eq!(scene.transfer(&camera1, &camera1, &nan), Transfer::Nothing);
        let outside = Point3::new(0.0, -90.0, 0.0);
        assert_eq!(scene.cast(&outside, &-Vector3::y()), None);
        assert_eq!(scene.cast(&outside, &Vector3::zeros()), None);
    }

    /// Both scenes stay small enough for a phone.
    #[test]
    fn textures_and_light_fit_in_memory() {
        let ball = crate::synthetic::MovableObject {
            kind: crate::synthetic::MovableKind::Ball,
            x_m: 0.0,
            z_m: 2.0,
        };
        let bytes =
            [Scene::still_life(), Scene::long_table(ball).unwrap()].map(|scene| scene.bytes());
        println!("{bytes:?} bytes");
        assert!(bytes[0] > 1 << 20 && bytes.iter().all(|bytes| *bytes < 12 << 20));
    }
}
