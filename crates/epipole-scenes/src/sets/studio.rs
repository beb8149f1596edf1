//! The studio: a mug that grows with its distance, ambiguous for a camera at table height.

use crate::light::Lighting;
use crate::objects::body::{Body, Paint, Placement};
use crate::objects::props::{
    GEOMETRIC_M, LANDSCAPE_M, MUG_HEIGHT_M, PICTURE_DEPTH_M, PLASTER_M, Props, STAR_CHART_M,
};
use crate::paint;
use crate::scene::{Fixed, Movable, Scene};
use crate::shape::{BACK, BOTTOM, FRONT, TOP};
use epipole::{Error, Result};
use nalgebra::Vector3;
use std::sync::{Arc, OnceLock};

/// Width of the table. Its top is y = 0, so a camera at the origin sees it edge-on.
const TABLE_WIDTH: f64 = 1.5;
const TABLE_NEAR_Z: f64 = 0.4;
const TABLE_FAR_Z: f64 = 3.4;
const TABLE_THICK: f64 = 0.05;
/// Size of the cloth that hangs down in front of it.
const CLOTH_M: [f64; 2] = [0.28, 0.20];
const ROOM_CENTER: [f64; 3] = [0.7, -0.55, 1.6];
const ROOM_SIZE: [f64; 3] = [4.8, 2.7, 5.6];
const FLOOR_Y: f64 = ROOM_CENTER[1] + ROOM_SIZE[1] / 2.0;
/// Index of the table's top among the bodies of the scene.
const TABLE_TOP: usize = 0;

impl Scene {
    /// Returns a room with a mug on a long table in even light, at any distance and of any size.
    ///
    /// * `foot_m`: position of its foot's center on the table's top, x to the right and z away,
    ///   meters; z in [0.4, 3.4] and |x| ≤ 0.7
    /// * `height_m`: its height, meters, in [0.05, 1]
    ///
    /// The world's origin lies in the plane of the table's top, y = 0, in front of its near edge at
    /// z = 0.4; x points right, y **down** and z along the table, meters. The room reaches from
    /// x = −1.7 to 3.1, y = −1.9 to 0.8 and z = −1.2 to 4.4.
    ///
    /// Scaling foot and height by one factor scales the mug about the origin, so a camera there
    /// takes the same photograph for every factor. The table's top with its shadow is seen edge-on.
    ///
    /// Only the first photograph computes textures and light.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole_scenes::Scene;
    /// use nalgebra::{Point3, Vector3};
    /// // The ray through the middle of the mug meets it at a distance that grows with its size.
    /// let ray = Vector3::new(0.1, -0.1, 1.0);
    /// let near = Scene::studio([0.05, 0.5], 0.1)?.cast(&Point3::origin(), &ray);
    /// let far = Scene::studio([0.25, 2.5], 0.5)?.cast(&Point3::origin(), &ray);
    /// let (near, far) = near.zip(far).ok_or(epipole::Error::TooFew { what: "a hit", needed: 2, got: 0 })?;
    /// assert_eq!(near.object, "the mug");
    /// assert!((far.distance_along - 5.0 * near.distance_along).abs() < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn studio(foot_m: [f64; 2], height_m: f64) -> Result<Self> {
        static ROOM: OnceLock<Arc<Fixed>> = OnceLock::new();
        static MUG: OnceLock<Arc<Movable>> = OnceLock::new();
        let [x_m, z_m] = foot_m;
        Error::check_range(
            "the mug's place across the table",
            "between -0.7 and 0.7 meters",
            x_m,
            -0.7..=0.7,
        )?;
        Error::check_range(
            "the mug's distance",
            "between 0.4 and 3.4 meters",
            z_m,
            TABLE_NEAR_Z..=TABLE_FAR_Z,
        )?;
        Error::check_range(
            "the mug's height",
            "between 0.05 and 1 meter",
            height_m,
            0.05..=1.0,
        )?;
        let placement = Placement {
            foot: Vector3::new(x_m, 0.0, z_m),
            scale: height_m / MUG_HEIGHT_M,
        };
        Ok(Self {
            fixed: Arc::clone(ROOM.get_or_init(|| Arc::new(build_room()))),
            movable: Some((
                Arc::clone(MUG.get_or_init(|| Arc::new(build_mug()))),
                placement,
            )),
        })
    }
}

/// Returns light from so far away that it is uniform, even in the glaze of the mug.
fn lighting() -> Lighting {
    Lighting::even([-0.55, -0.70, -0.46], 1e6, 0.12, [1.20, 1.13, 1.00])
}

/// Builds the mug at the origin of the plane y = 0, with its shade on the table.
fn build_mug() -> Movable {
    let props = Props::shared();
    let slab = props.slab(TABLE_WIDTH, 3.0);
    Movable::new(props.mug([0.0; 3], -0.5, 1.0), slab, TABLE_TOP)
}

/// Builds the static bodies; the table's top comes first.
fn build_room() -> Fixed {
    let mut bodies = table();
    bodies.extend(walls());
    Fixed::new(bodies, lighting())
}

/// Builds the table, a cloth that hangs down in front, and a number at every meter.
fn table() -> Vec<Body> {
    let props = Props::shared();
    let name = "the table";
    let wood = Arc::new(paint::measured_boards(props.noise, TABLE_WIDTH as f32));
    let cloth = Arc::new(paint::block_print(
        props.noise,
        (CLOTH_M[0] / CLOTH_M[1]) as f32,
    ));
    let length = TABLE_FAR_Z - TABLE_NEAR_Z;
    let middle_z = (TABLE_FAR_Z + TABLE_NEAR_Z) / 2.0;
    let cuboid =
        |size: [f64; 3], center: [f64; 3], paint: &Paint| Body::cuboid(name, size, center, paint);
    // On the chart, t runs toward the camera from the far end; integers are whole meters.
    let top = Paint::new(&wood)
        .repeated(1.0, length as f32)
        .shifted(0.0, (1.0 - TABLE_FAR_Z.fract()) as f32)
        .lit(4, 4);
    let edge = Paint::new(&wood).repeated(0.4, 0.04).lit(4, 4);
    let mut bodies = vec![
        cuboid(
            [TABLE_WIDTH, TABLE_THICK, length],
            [0.0, TABLE_THICK / 2.0, middle_z],
            &edge,
        )
        .painted(TOP, &top)
        .boxed(),
        cuboid(
            [TABLE_WIDTH - 0.3, FLOOR_Y - TABLE_THICK, length - 0.6],
            [0.0, (FLOOR_Y + TABLE_THICK) / 2.0, middle_z],
            &edge,
        )
        .boxed(),
        Body::cuboid(
            "the cloth",
            [CLOTH_M[0], CLOTH_M[1], 0.002],
            [0.0, CLOTH_M[1] / 2.0, TABLE_NEAR_Z - 0.001],
            &Paint::new(&cloth).repeated(0.05, 1.0).lit(4, 4),
        )
        .painted(FRONT, &Paint::new(&cloth).lit(4, 4)),
    ];
    for meters in 1..=3 {
        let plate = Paint::new(&Arc::new(paint::number(props.noise, meters))).lit(2, 2);
        let plate = cuboid(
            [0.12, 0.0004, 0.12],
            [TABLE_WIDTH / 2.0 - 0.16, -0.0002, f64::from(meters)],
            &plate,
        );
        bodies.push(plate.yawed(std::f64::consts::FRAC_PI_2));
    }
    bodies
}

/// Builds the room, with pictures on the visible walls.
fn walls() -> Vec<Body> {
    let props = Props::shared();
    let size = Vector3::from(ROOM_SIZE);
    let (left, back) = (ROOM_CENTER[0] - size.x / 2.0, ROOM_CENTER[2] + size.z / 2.0);
    let wall = |width_m: f64, shift: f32| {
        Paint::new(&props.plaster)
            .repeated((width_m / PLASTER_M) as f32, (size.y / PLASTER_M) as f32)
            .shifted(shift, 0.3)
            .lit(12, 8)
    };
    let warm = [1.18, 1.05, 0.82];
    let room = Body::room(ROOM_SIZE, ROOM_CENTER, &wall(size.z, 0.2).tinted(warm))
        .painted(BACK, &wall(size.x, 0.1).tinted(warm))
        .painted(TOP, &wall(size.x, 0.0).tinted([2.1, 2.3, 2.7]))
        .painted(
            BOTTOM,
            &Paint::new(&props.floor).repeated(4.0, 4.0).lit(12, 12),
        );
    let quarter = std::f64::consts::FRAC_PI_2;
    let (on_back, on_left) = (back - PICTURE_DEPTH_M / 2.0, left + PICTURE_DEPTH_M / 2.0);
    let mut bodies = vec![room];
    for (texture, size_m, x) in [
        (&props.geometric, GEOMETRIC_M, -0.62),
        (&props.landscape, LANDSCAPE_M, 1.32),
    ] {
        let size_m = size_m.map(|side| 1.5 * side);
        bodies.push(props.picture(texture, size_m, [x, -0.85, on_back], 0.0));
    }
    for (texture, size_m, z) in [
        (&props.star_chart, STAR_CHART_M, 0.35),
        (&props.landscape, LANDSCAPE_M, 1.55),
        (&props.geometric, GEOMETRIC_M, 2.75),
    ] {
        let size_m = size_m.map(|side| 1.3 * side);
        bodies.push(props.picture(texture, size_m, [on_left, -0.80, z], quarter));
    }
    bodies
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sampling;
    use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};

    fn camera1(width: u32, height: u32) -> PosedCamera {
        PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::centered(1.25 * f64::from(width), width, height).unwrap(),
                width,
                height,
            ),
            cam_from_world: RigidTransform::identity(),
        }
    }

    /// Returns a scene with the mug at this distance, a fifth of it tall.
    fn grown(z_m: f64) -> Scene {
        Scene::studio([0.1 * z_m, z_m], 0.2 * z_m).unwrap()
    }

    /// Asserts identical bytes for all distances.
    #[test]
    fn a_mug_scaled_with_its_distance_has_one_image() {
        let camera = camera1(320, 240);
        for sampling in [Sampling::Draft, Sampling::Full] {
            let render = |z_m: f64| grown(z_m).render(&camera, 320, 240, sampling).unwrap();
            let first = render(0.5);
            for z_m in [0.55, 0.8, 1.0, 1.3, 1.75, 2.1, 2.5] {
                let other = render(z_m);
                assert!(first.image == other.image, "{z_m} m, {sampling:?}");
                assert!(first.depth_m != other.depth_m);
            }
        }
    }

    /// Asserts that moving or growing alone changes the photograph, so that the test above can
    /// fail.
    #[test]
    fn a_mug_that_only_moves_or_only_grows_changes_the_image() {
        let camera = camera1(160, 120);
        let render = |z_m: f64, height_m: f64| {
            let scene = Scene::studio([0.1 * z_m, z_m], height_m).unwrap();
            scene.render(&camera, 160, 120, Sampling::Draft).unwrap()
        };
        let first = render(1.0, 0.2).image;
        for (z_m, height_m) in [(1.1, 0.2), (1.0, 0.22)] {
            let other = render(z_m, height_m).image;
            let differences = first.iter().zip(other.iter());
            assert!(differences.filter(|(a, b)| a.abs_diff(**b) > 20).count() > 100);
        }
    }

    /// Asserts that the axis of a mug is imaged with height f H / Z.
    #[test]
    fn heights_follow_similar_triangles() {
        let camera = camera1(640, 480);
        let (z_m, height_m) = (2.0, 0.3);
        let rows = [0.0, -height_m].map(|y| {
            let point = nalgebra::Point3::new(0.2, y, z_m);
            camera.project(&point).unwrap().y
        });
        assert!((rows[0] - rows[1] - 800.0 * height_m / z_m).abs() < 1e-9);
        let scene = Scene::studio([0.2, z_m], height_m).unwrap();
        // Just below the rim and just above it, at the mug's center.
        let meets = |y: f64| {
            let ray = Vector3::new(0.2, y, z_m);
            scene
                .cast(&nalgebra::Point3::origin(), &ray)
                .unwrap()
                .object
        };
        assert_eq!(meets(-0.27), "the mug");
        assert_eq!(meets(-0.33), "the wall");
    }

    #[test]
    fn impossible_mugs_are_refused() {
        for (foot_m, height_m) in [
            ([f64::NAN, 1.0], 0.2),
            ([0.0, f64::INFINITY], 0.2),
            ([0.0, 0.2], 0.2),
            ([0.9, 1.0], 0.2),
            ([0.0, 1.0], 0.0),
            ([0.0, 1.0], 2.0),
        ] {
            assert!(Scene::studio(foot_m, height_m).is_err());
        }
    }
}
