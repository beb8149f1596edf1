//! The long table: a hall with one movable object, for measuring depth.

use crate::light::Lighting;
use crate::objects::body::{Body, Paint, Placement};
use crate::objects::props::{PICTURE_DEPTH_M, PLASTER_M, Props, placed};
use crate::paint;
use crate::scene::{Fixed, Movable, Scene};
use crate::shape::{BACK, BOTTOM, TOP};
use epipole::{Error, Result};
use nalgebra::Vector3;
use std::sync::{Arc, OnceLock};

/// Vertical position of the table's top below the camera (y is down).
const TABLE_Y: f64 = 0.25;
const TABLE_WIDTH: f64 = 1.9;
const TABLE_NEAR_Z: f64 = 0.35;
const TABLE_FAR_Z: f64 = 11.35;
const HALL_CENTER: [f64; 3] = [0.0, -0.65, 5.0];
const HALL_SIZE: [f64; 3] = [5.6, 3.3, 14.0];
/// Index of the table's top among the bodies of the scene.
const TABLE_TOP: usize = 0;

/// Kind of object on the long table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MovableKind {
    /// A large mug, 20 cm high and 16 cm wide without its handle.
    Mug,
    /// A ball of 22 cm diameter.
    Ball,
}

/// The movable object and its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovableObject {
    /// Kind of object.
    pub kind: MovableKind,
    /// Sideways position of its axis, meters, positive to the right, in [−0.8, 0.8]. The lane |x| ≤
    /// 0.35 is free of other objects.
    pub x_m: f64,
    /// Depth of its axis from the first camera, meters, in [0.6, 11].
    pub z_m: f64,
}

impl Scene {
    /// Returns a hall with a table of eleven meters, marked every decimeter, and one movable object
    /// on it.
    ///
    /// The world's origin is the center of
    /// [`long_table_camera`](crate::long_table_camera)`(0.0, …)`: x right, y down, z along the
    /// table, meters. The table's top is y = 0.25, from z = 0.35 to 11.35, its meters numbered; the
    /// wall behind is z = 12.
    ///
    /// Only the first photograph of each kind of object computes textures and light; moving the
    /// object is free, and its shade moves with it.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`] for a position that is not on the table.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole_scenes::{MovableKind, MovableObject, Scene};
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
        Error::check_range(
            "the thing's place across the table",
            "between -0.8 and 0.8 meters",
            object.x_m,
            -0.8..=0.8,
        )?;
        Error::check_range(
            "the thing's depth",
            "between 0.6 and 11 meters",
            object.z_m,
            0.6..=11.0,
        )?;
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

/// Returns even light through high windows on the left.
fn lighting() -> Lighting {
    Lighting::even([-0.62, -0.66, -0.42], 80.0, 0.09, [1.25, 1.16, 1.00])
}

fn build_hall() -> Fixed {
    let mut bodies = table();
    bodies.extend(hall());
    bodies.extend(props());
    Fixed::new(bodies, lighting())
}

/// Builds the object at the origin of the plane y = 0, lit as on the table.
fn build_movable(kind: MovableKind) -> Movable {
    let props = Props::shared();
    let bodies = match kind {
        MovableKind::Mug => props.mug([0.0; 3], -0.5, 1.7),
        MovableKind::Ball => vec![props.ball([0.0; 3], 0.11)],
    };
    Movable::new(bodies, props.slab(TABLE_WIDTH, 4.0), TABLE_TOP)
}

/// Builds the table with its numbered meters; its top comes first.
fn table() -> Vec<Body> {
    let props = Props::shared();
    let name = "the table";
    let wood = Arc::new(paint::measured_boards(props.noise, TABLE_WIDTH as f32));
    let edge = Paint::new(&wood).repeated(0.4, 0.04).lit(4, 4);
    let length = TABLE_FAR_Z - TABLE_NEAR_Z;
    let middle_z = (TABLE_FAR_Z + TABLE_NEAR_Z) / 2.0;
    let cuboid =
        |size: [f64; 3], center: [f64; 3], paint: &Paint| Body::cuboid(name, size, center, paint);
    // On the chart, t runs toward the camera from the far end; integers are whole meters.
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
        let plate = Paint::new(&Arc::new(paint::number(props.noise, meters)))
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

/// Builds the hall around the table, with windows on the left and pictures on the other walls.
fn hall() -> Vec<Body> {
    let props = Props::shared();
    let size = Vector3::from(HALL_SIZE);
    let (left, right, back) = (
        HALL_CENTER[0] - size.x / 2.0,
        HALL_CENTER[0] + size.x / 2.0,
        HALL_CENTER[2] + size.z / 2.0,
    );
    let wall = |width_m: f64, tile: f64, shift: f32| {
        Paint::new(&props.plaster)
            .repeated(
                (width_m / (PLASTER_M * tile)) as f32,
                (size.y / (PLASTER_M * tile)) as f32,
            )
            .shifted(shift, 0.3)
            .lit(40, 16)
    };
    let warm = [1.18, 1.05, 0.82];
    let walls = Body::room(HALL_SIZE, HALL_CENTER, &wall(size.z, 2.0, 0.2).tinted(warm))
        .painted(BACK, &wall(size.x, 3.0, 0.1).tinted(warm).lit(40, 24))
        .painted(TOP, &wall(size.x, 2.0, 0.0).tinted([2.1, 2.3, 2.7]))
        .painted(
            BOTTOM,
            &Paint::new(&props.floor).repeated(4.0, 10.0).lit(24, 60),
        );
    let mut bodies = vec![walls];
    for z in [2.6, 5.4, 8.2, 11.0] {
        bodies.push(props.window([left, -1.0, z], [1.3, 1.5]));
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    let pictures = [
        (&props.landscape, [1.30, 0.96]),
        (&props.geometric, [0.85, 1.03]),
        (&props.star_chart, [0.80, 1.04]),
    ];
    for (i, z) in [3.0, 4.7, 6.3, 7.9, 9.5, 11.1].into_iter().enumerate() {
        let (texture, size_m) = pictures[i % 3];
        bodies.push(props.picture(
            texture,
            size_m,
            [right - PICTURE_DEPTH_M / 2.0, -0.75, z],
            -quarter,
        ));
    }
    for (i, x) in [(1, -1.75), (0, 0.0), (2, 1.75)] {
        let (texture, size_m) = pictures[i];
        bodies.push(props.picture(
            texture,
            size_m.map(|side| 1.25 * side),
            [x, -0.85, back - PICTURE_DEPTH_M / 2.0],
            0.0,
        ));
    }
    bodies
}

/// Builds the static objects on the table, left and right of the free lane.
fn props() -> Vec<Body> {
    let props = Props::shared();
    let mut bodies = Vec::new();
    let mut books = |x: f64, z: f64, first: usize, yaw_rad: f64| {
        let foot = [x, TABLE_Y, z];
        bodies.extend(props.book(first, foot, [0.30, 0.05, 0.22], yaw_rad));
        bodies.extend(props.book(
            first + 1,
            placed(foot, 0.0, [0.01, -0.05, 0.0]),
            [0.27, 0.042, 0.20],
            yaw_rad + 0.2,
        ));
        bodies.extend(props.book(
            first + 2,
            placed(foot, 0.0, [-0.01, -0.092, 0.01]),
            [0.24, 0.036, 0.18],
            yaw_rad - 0.15,
        ));
    };
    books(-0.54, 1.85, 0, 0.1);
    books(0.55, 4.4, 1, -0.3);
    books(-0.52, 7.3, 2, 0.25);
    bodies.extend(props.apple([-0.54, TABLE_Y - 0.128, 1.85], 0.048, 0.3));
    bodies.push(props.jug([0.55, TABLE_Y, 2.65], 0.3, 1.15));
    bodies.push(props.jug([-0.56, TABLE_Y, 5.4], 1.3, 1.3));
    bodies.push(props.jug([0.58, TABLE_Y, 8.6], 2.3, 1.3));
    bodies.extend(props.tin([-0.55, TABLE_Y, 3.4], [0.17, 0.25, 0.14], 0.35));
    bodies.extend(props.tin([0.55, TABLE_Y, 6.3], [0.19, 0.28, 0.16], -0.4));
    bodies.push(props.orange([0.50, TABLE_Y, 1.62], 0.050, [0.9, 0.5]));
    bodies.push(props.orange([0.60, TABLE_Y, 1.72], 0.048, [2.0, -0.4]));
    bodies.push(props.lemon([0.49, TABLE_Y, 1.78], [0.3, std::f64::consts::FRAC_PI_2]));
    bodies
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Sampling, Transfer, long_table_camera};
    use nalgebra::{Point2, Point3};

    fn object(kind: MovableKind, x_m: f64, z_m: f64) -> MovableObject {
        MovableObject { kind, x_m, z_m }
    }

    /// Asserts Z = f B / d for the front of the ball.
    #[test]
    fn disparity_follows_depth() {
        let left = long_table_camera(0.0, 640, 480).unwrap();
        let right = long_table_camera(0.12, 640, 480).unwrap();
        for z_m in [1.0, 3.0, 7.5] {
            let scene = Scene::long_table(object(MovableKind::Ball, 0.0, z_m)).unwrap();
            let front = Point3::new(0.0, TABLE_Y - 0.11, z_m - 0.11);
            let pixel1 = left.project(&front).unwrap();
            let Transfer::Visible { pixel2, x_in_world } = scene.transfer(&left, &right, &pixel1)
            else {
                panic!("the front of the ball is seen from both sides");
            };
            assert!((pixel1.y - pixel2.y).abs() < 1e-9);
            let depth_m = 700.0 * 0.12 / (pixel1.x - pixel2.x);
            assert!((depth_m - x_in_world.z).abs() < 1e-9);
            // The lathed profile has facets of 7.5°, so it is within 0.3 mm of a sphere.
            assert!((depth_m - front.z).abs() < 1.5e-3, "{depth_m}");
        }
    }

    #[test]
    fn moving_the_object_changes_only_its_surroundings() {
        let camera = long_table_camera(0.0, 160, 120).unwrap();
        let render = |x_m: f64| {
            Scene::long_table(object(MovableKind::Mug, x_m, 2.0))
                .unwrap()
                .render(&camera, 160, 120, Sampling::Draft)
                .unwrap()
        };
        let (here, there) = (render(-0.2), render(0.2));
        assert!(here != there);
        for (u, v, pixel) in here.image.enumerate_pixels() {
            // Its shade reaches 0.55 m from its foot, only on the table.
            if !(60..92).contains(&v) {
                assert_eq!(pixel, there.image.get_pixel(u, v), "{u} {v}");
            }
        }
    }

    /// Asserts that the object darkens the table on the side away from the light.
    #[test]
    fn the_object_has_a_shadow() {
        let camera = long_table_camera(0.0, 320, 240).unwrap();
        let brightness = |z_m: f64, at: Point3<f64>| {
            let scene = Scene::long_table(object(MovableKind::Ball, 0.0, z_m)).unwrap();
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
            assert!(Scene::long_table(object(MovableKind::Ball, x_m, z_m)).is_err());
        }
        assert!(long_table_camera(f64::NAN, 640, 480).is_err());
    }
}
