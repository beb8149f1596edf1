//! The long table: a hall with one thing that can be moved, for measuring depth.

use super::body::{Body, Paint, Placement};
use super::light::{Lighting, Proxy};
use super::paint;
use super::scene::{Fixed, Movable, Scene};
use super::shape::{BACK, BOTTOM, Cuboid, Shape, TOP};
use super::wares::{PICTURE_DEPTH_M, PLASTER_M, Wares, placed};
use crate::camera::{Intrinsics, PosedCamera, RigidTransform};
use crate::{Error, Result};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use std::sync::{Arc, OnceLock};

/// Height of the table's top below the camera (y is down).
const TABLE_Y: f64 = 0.25;
const TABLE_WIDTH: f64 = 1.9;
const TABLE_NEAR_Z: f64 = 0.35;
const TABLE_FAR_Z: f64 = 11.35;
const HALL_CENTER: [f64; 3] = [0.0, -0.65, 5.0];
const HALL_SIZE: [f64; 3] = [5.6, 3.3, 14.0];
/// The table's top is the first body of the scene.
const TABLE_TOP: usize = 0;

/// Which thing stands on the long table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MovableKind {
    /// A large mug, 20 cm high and 16 cm wide without its handle.
    Mug,
    /// A ball of 22 cm diameter.
    Ball,
}

/// The thing on the long table and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovableObject {
    /// What it is.
    pub kind: MovableKind,
    /// Sideways place of its axis, meters, positive to the right, in [−0.8, 0.8]. The lane
    /// |x| ≤ 0.35 is free of other things.
    pub x_m: f64,
    /// Depth of its axis from the first camera, meters, in [0.6, 11].
    pub z_m: f64,
}

impl Scene {
    /// A hall with a table of eleven meters, marked every decimeter, and one thing that stands on
    /// it at a given place.
    ///
    /// The world's origin is the center of [`long_table_camera`]`(0.0, …)`: x right, y down, z
    /// along the table, meters. The table's top is y = 0.25, from z = 0.35 to 11.35, its meters
    /// numbered; the wall behind is z = 12.
    ///
    /// Only the first photograph of each kind of thing computes textures and light; moving the
    /// thing is free, its shade moves along.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`] for a place that is not on the table.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::synthetic::{MovableKind, MovableObject, Scene};
    /// use nalgebra::{Point3, Vector3};
    /// let ball = MovableObject { kind: MovableKind::Ball, x_m: 0.1, z_m: 3.0 };
    /// let scene = Scene::long_table(ball)?;
    /// // Seen along the ray through its middle, 0.11 m above the table, it is 0.11 m nearer than
    /// // its axis.
    /// let hit = scene.cast(&Point3::new(0.1, 0.14, 0.0), &Vector3::new(0.0, 0.0, 1.0));
    /// let hit = hit.filter(|hit| hit.object == "the ball");
    /// assert!(hit.is_some_and(|hit| (hit.distance_along - 2.89).abs() < 1e-3));
    /// # Ok(()) }
    /// ```
    pub fn long_table(object: MovableObject) -> Result<Self> {
        static HALL: OnceLock<Arc<Fixed>> = OnceLock::new();
        static MUG: OnceLock<Arc<Movable>> = OnceLock::new();
        static BALL: OnceLock<Arc<Movable>> = OnceLock::new();
        for (what, requirement, value, low, high) in [
            (
                "the thing's place across the table",
                "between -0.8 and 0.8 meters",
                object.x_m,
                -0.8,
                0.8,
            ),
            (
                "the thing's depth",
                "between 0.6 and 11 meters",
                object.z_m,
                0.6,
                11.0,
            ),
        ] {
            if !value.is_finite() {
                return Err(Error::NotFinite { what });
            }
            if !(low..=high).contains(&value) {
                return Err(Error::OutOfRange {
                    what,
                    requirement,
                    value,
                });
            }
        }
        let movable = match object.kind {
            MovableKind::Mug => &MUG,
            MovableKind::Ball => &BALL,
        };
        let movable = movable.get_or_init(|| Arc::new(build_movable(object.kind)));
        Ok(Self {
            fixed: Arc::clone(HALL.get_or_init(|| Arc::new(build_hall()))),
            movable: Some((
                Arc::clone(movable),
                Placement::at(Vector3::new(object.x_m, TABLE_Y, object.z_m)),
            )),
        })
    }
}

/// A camera of the rectified pair that looks along the long table: its center at (`x_m`, 0, 0),
/// no rotation, and a focal length of 700 px for a picture of 640 × 480.
///
/// The second camera of a pair with baseline B has `x_m` = B.
///
/// # Errors
/// [`Error::NotFinite`] if `x_m` is not finite.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::synthetic::long_table_camera;
/// use nalgebra::Point3;
/// let (left, right) = (long_table_camera(0.0, 640, 480)?, long_table_camera(0.2, 640, 480)?);
/// let x_in_world = Point3::new(0.0, 0.1, 2.0);
/// let disparity_px = left.project(&x_in_world)?.x - right.project(&x_in_world)?.x;
/// assert!((disparity_px - 700.0 * 0.2 / 2.0).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn long_table_camera(x_m: f64, width: u32, height: u32) -> Result<PosedCamera> {
    if !x_m.is_finite() {
        return Err(Error::NotFinite {
            what: "the camera's place",
        });
    }
    let (width, height) = (width.max(1), height.max(1));
    let focal_px = (f64::from(width) / 640.0).min(f64::from(height) / 480.0) * 700.0;
    Ok(PosedCamera {
        intrinsics: Intrinsics::centered(focal_px, width, height)?,
        cam_from_world: RigidTransform::from_parts(
            Translation3::new(-x_m, 0.0, 0.0),
            UnitQuaternion::identity(),
        ),
    })
}

/// Even light through high windows on the left.
fn lighting() -> Lighting {
    let toward = Vector3::new(-0.62, -0.66, -0.42).normalize();
    let far_m = 80.0;
    let half_u = toward.cross(&Vector3::y()).normalize() * (0.09 * far_m);
    let half_v = toward.cross(&half_u).normalize() * (0.09 * far_m);
    Lighting::new(
        [toward * far_m, half_v, half_u],
        [1.25, 1.16, 1.00],
        None,
        [
            [0.36, 0.37, 0.40],
            [0.38, 0.37, 0.35],
            [0.36, 0.375, 0.40],
            [0.24, 0.19, 0.14],
            [0.30, 0.30, 0.30],
            [0.28, 0.28, 0.275],
        ],
    )
}

fn build_hall() -> Fixed {
    let mut bodies = table();
    bodies.extend(hall());
    bodies.extend(props());
    Fixed::new(bodies, lighting())
}

/// The thing at the origin of the plane y = 0, lit as on the table.
fn build_movable(kind: MovableKind) -> Movable {
    let wares = Wares::shared();
    let bodies = match kind {
        MovableKind::Mug => wares.mug([0.0; 3], -0.5, 1.7),
        MovableKind::Ball => vec![wares.ball([0.0; 3], 0.11)],
    };
    let slab = Body::new(
        "the table",
        Shape::Cuboid(Cuboid::solid(TABLE_WIDTH, 0.04, 4.0)),
        [0.0, 0.02, 0.0],
        &Paint::new(&wares.plaster).lit(1, 1),
    );
    Movable::new(bodies, slab.boxed(), TABLE_TOP)
}

/// The table with its numbered meters; its top comes first.
fn table() -> Vec<Body> {
    let wares = Wares::shared();
    let name = "the table";
    let wood = Arc::new(paint::measured_boards(wares.noise, TABLE_WIDTH as f32));
    let edge = Paint::new(&wood).repeated(0.4, 0.04).lit(4, 4);
    let length = TABLE_FAR_Z - TABLE_NEAR_Z;
    let middle_z = (TABLE_FAR_Z + TABLE_NEAR_Z) / 2.0;
    let cuboid = |size: [f64; 3], center: [f64; 3], paint: &Paint| {
        Body::new(
            name,
            Shape::Cuboid(Cuboid::solid(size[0], size[1], size[2])),
            center,
            paint,
        )
    };
    // On the chart, t runs toward the camera from the far end; whole t are whole meters.
    let top = Paint::new(&wood)
        .repeated(1.0, length as f32)
        .shifted(0.0, (1.0 - TABLE_FAR_Z.fract()) as f32)
        .glossy(0.45)
        .lit(80, 400);
    let mut bodies = vec![
        cuboid(
            [TABLE_WIDTH, 0.05, length],
            [0.0, TABLE_Y + 0.025, middle_z],
            &edge,
        )
        .painted(TOP, &top)
        .boxed(),
    ];
    for i in 0..4 {
        let z = TABLE_NEAR_Z + 0.5 + f64::from(i) * (length - 1.0) / 3.0;
        bodies.push(
            cuboid(
                [TABLE_WIDTH - 0.3, 1.0 - TABLE_Y - 0.05, 0.10],
                [0.0, (1.0 + TABLE_Y + 0.05) / 2.0, z],
                &edge,
            )
            .boxed(),
        );
    }
    for meters in 1..=11 {
        let plate = Paint::new(&Arc::new(paint::number(wares.noise, meters)))
            .glossy(0.6)
            .lit(2, 2);
        for side in [-1.0, 1.0] {
            bodies.push(cuboid(
                [0.100, 0.0004, 0.100],
                [side * 0.345, TABLE_Y - 0.0002, f64::from(meters)],
                &plate,
            ));
        }
    }
    bodies
}

/// The hall around the table, with windows on the left and pictures on the other walls.
fn hall() -> Vec<Body> {
    let wares = Wares::shared();
    let size = Vector3::from(HALL_SIZE);
    let (left, right, back) = (
        HALL_CENTER[0] - size.x / 2.0,
        HALL_CENTER[0] + size.x / 2.0,
        HALL_CENTER[2] + size.z / 2.0,
    );
    let wall = |width_m: f64, tile: f64, shift: f32| {
        Paint::new(&wares.plaster)
            .repeated(
                (width_m / (PLASTER_M * tile)) as f32,
                (size.y / (PLASTER_M * tile)) as f32,
            )
            .shifted(shift, 0.3)
            .lit(40, 16)
    };
    let warm = [1.18, 1.05, 0.82];
    let mut walls = Body::new(
        "the wall",
        Shape::Cuboid(Cuboid::room(size.x, size.y, size.z)),
        HALL_CENTER,
        &wall(size.z, 2.0, 0.2).tinted(warm),
    )
    .painted(BACK, &wall(size.x, 3.0, 0.1).tinted(warm).lit(40, 24))
    .painted(TOP, &wall(size.x, 2.0, 0.0).tinted([2.1, 2.3, 2.7]))
    .painted(
        BOTTOM,
        &Paint::new(&wares.floor).repeated(4.0, 10.0).lit(24, 60),
    );
    walls.proxies = vec![Proxy::Room {
        center: walls.center,
        half: size / 2.0,
    }];
    let mut bodies = vec![walls];
    for z in [2.6, 5.4, 8.2, 11.0] {
        bodies.push(wares.window([left, -1.0, z], [1.3, 1.5]));
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    let pictures = [
        (&wares.landscape, [1.30, 0.96]),
        (&wares.geometric, [0.85, 1.03]),
        (&wares.star_chart, [0.80, 1.04]),
    ];
    for (i, z) in [3.0, 4.7, 6.3, 7.9, 9.5, 11.1].into_iter().enumerate() {
        let (texture, size_m) = pictures[i % 3];
        bodies.push(wares.picture(
            texture,
            size_m,
            [right - PICTURE_DEPTH_M / 2.0, -0.75, z],
            -quarter,
        ));
    }
    for (i, x) in [(1, -1.75), (0, 0.0), (2, 1.75)] {
        let (texture, size_m) = pictures[i];
        bodies.push(wares.picture(
            texture,
            size_m.map(|side| 1.25 * side),
            [x, -0.85, back - PICTURE_DEPTH_M / 2.0],
            0.0,
        ));
    }
    bodies
}

/// What stands still on the table, left and right of the free lane.
fn props() -> Vec<Body> {
    let wares = Wares::shared();
    let mut bodies = Vec::new();
    let mut books = |x: f64, z: f64, first: usize, yaw_rad: f64| {
        let foot = [x, TABLE_Y, z];
        bodies.extend(wares.book(first, foot, [0.30, 0.05, 0.22], yaw_rad));
        bodies.extend(wares.book(
            first + 1,
            placed(foot, 0.0, [0.01, -0.05, 0.0]),
            [0.27, 0.042, 0.20],
            yaw_rad + 0.2,
        ));
        bodies.extend(wares.book(
            first + 2,
            placed(foot, 0.0, [-0.01, -0.092, 0.01]),
            [0.24, 0.036, 0.18],
            yaw_rad - 0.15,
        ));
    };
    books(-0.54, 1.85, 0, 0.1);
    books(0.55, 4.4, 1, -0.3);
    books(-0.52, 7.3, 2, 0.25);
    bodies.extend(wares.apple([-0.54, TABLE_Y - 0.128, 1.85], 0.048, 0.3));
    bodies.push(wares.jug([0.55, TABLE_Y, 2.65], 0.3, 1.15));
    bodies.push(wares.jug([-0.56, TABLE_Y, 5.4], 1.3, 1.3));
    bodies.push(wares.jug([0.58, TABLE_Y, 8.6], 2.3, 1.3));
    bodies.extend(wares.tin([-0.55, TABLE_Y, 3.4], [0.17, 0.25, 0.14], 0.35));
    bodies.extend(wares.tin([0.55, TABLE_Y, 6.3], [0.19, 0.28, 0.16], -0.4));
    bodies.push(wares.orange([0.50, TABLE_Y, 1.62], 0.050, [0.9, 0.5]));
    bodies.push(wares.orange([0.60, TABLE_Y, 1.72], 0.048, [2.0, -0.4]));
    bodies.push(wares.lemon([0.49, TABLE_Y, 1.78], [0.3, std::f64::consts::FRAC_PI_2]));
    bodies
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Sampling, Transfer};
    use nalgebra::{Point2, Point3};

    fn thing(kind: MovableKind, x_m: f64, z_m: f64) -> MovableObject {
        MovableObject { kind, x_m, z_m }
    }

    /// Depth and disparity obey Z = f B / d for the front of the ball.
    #[test]
    fn disparity_follows_depth() {
        let left = long_table_camera(0.0, 640, 480).unwrap();
        let right = long_table_camera(0.12, 640, 480).unwrap();
        for z_m in [1.0, 3.0, 7.5] {
            let scene = Scene::long_table(thing(MovableKind::Ball, 0.0, z_m)).unwrap();
            let front = Point3::new(0.0, TABLE_Y - 0.11, z_m - 0.11);
            let pixel1 = left.project(&front).unwrap();
            let Transfer::Visible { pixel2, x_in_world } = scene.transfer(&left, &right, &pixel1)
            else {
                panic!("the front of the ball is seen from both sides");
            };
            assert!((pixel1.y - pixel2.y).abs() < 1e-9);
            let depth_m = 700.0 * 0.12 / (pixel1.x - pixel2.x);
            assert!((depth_m - x_in_world.z).abs() < 1e-9);
            // The turned profile has facets of 7.5°, so it is within 0.3 mm of a sphere.
            assert!((depth_m - front.z).abs() < 1.5e-3, "{depth_m}");
        }
    }

    #[test]
    fn moving_the_thing_changes_only_its_surroundings() {
        let camera = long_table_camera(0.0, 160, 120).unwrap();
        let render = |x_m: f64| {
            Scene::long_table(thing(MovableKind::Mug, x_m, 2.0))
                .unwrap()
                .render(&camera, 160, 120, Sampling::Draft)
                .unwrap()
        };
        let (here, there) = (render(-0.2), render(0.2));
        assert!(here != there);
        for (u, v, pixel) in here.image.enumerate_pixels() {
            // Its shade reaches 0.55 m from its foot, onto the table only.
            if !(60..92).contains(&v) {
                assert_eq!(pixel, there.image.get_pixel(u, v), "{u} {v}");
            }
        }
    }

    /// The thing darkens the table beside it, on the side away from the light.
    #[test]
    fn the_thing_has_a_shadow() {
        let camera = long_table_camera(0.0, 320, 240).unwrap();
        let brightness = |z_m: f64, at: Point3<f64>| {
            let scene = Scene::long_table(thing(MovableKind::Ball, 0.0, z_m)).unwrap();
            let picture = scene.render(&camera, 320, 240, Sampling::Draft).unwrap();
            let pixel: Point2<f64> = camera.project(&at).unwrap();
            let color = picture.image[(pixel.x as u32, pixel.y as u32)].0;
            color.iter().map(|channel| f64::from(*channel)).sum::<f64>()
        };
        let beside = Point3::new(0.14, TABLE_Y, 2.0);
        assert!(brightness(2.0, beside) < 0.8 * brightness(6.0, beside));
    }

    #[test]
    fn places_off_the_table_are_refused() {
        for (x_m, z_m) in [
            (f64::NAN, 2.0),
            (0.0, f64::INFINITY),
            (0.0, 0.1),
            (2.0, 2.0),
        ] {
            assert!(Scene::long_table(thing(MovableKind::Ball, x_m, z_m)).is_err());
        }
        assert!(long_table_camera(f64::NAN, 640, 480).is_err());
    }
}
