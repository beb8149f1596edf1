//! The still life of the book: a table by a window, and the room around it.

use crate::light::Lighting;
use crate::objects::body::{Body, Paint};
use crate::objects::props::{
    GEOMETRIC_M, LANDSCAPE_M, PICTURE_DEPTH_M, PLASTER_M, Props, STAR_CHART_M, placed,
};
use crate::paint;
use crate::scene::{Fixed, Scene};
use crate::shape::{BACK, BOTTOM, FRONT, RIGHT, TOP};
use nalgebra::{Point3, Vector3};
use std::sync::{Arc, OnceLock};

/// The room: center and sides, meters. The table's top is y = 0.
const ROOM_CENTER: [f64; 3] = [0.1, -0.6, -1.1];
const ROOM_SIZE: [f64; 3] = [3.6, 2.7, 4.3];
const BACK_WALL_Z: f64 = ROOM_CENTER[2] + ROOM_SIZE[2] / 2.0;
const LEFT_WALL_X: f64 = ROOM_CENTER[0] - ROOM_SIZE[0] / 2.0;
const RIGHT_WALL_X: f64 = ROOM_CENTER[0] + ROOM_SIZE[0] / 2.0;

/// The cloth: width, thickness and depth, center, and rotation about the vertical, radians.
const CLOTH_M: [f64; 3] = [0.70, 0.0016, 0.50];
const CLOTH_CENTER: [f64; 3] = [0.13, -CLOTH_M[1] / 2.0, -0.13];
const CLOTH_YAW_RAD: f64 = 0.16;
/// Center of the landscape's frame, left and down from the middle of the back wall.
const LANDSCAPE_XY: [f64; 2] = [-0.36, -0.47];

/// Returns the corners of the cloth on the table of [`Scene::still_life`], 70 cm by 50 cm, meters
/// in the world: the far left one, the far right one, the near right one, the near left one.
///
/// ```
/// let [far_left, far_right, near_right, _] = epipole_scenes::still_life_cloth();
/// assert!(((far_right - far_left).norm() - 0.7).abs() < 1e-12);
/// assert!(((near_right - far_right).norm() - 0.5).abs() < 1e-12);
/// ```
pub fn still_life_cloth() -> [Point3<f64>; 4] {
    let (sin, cos) = libm::sincos(CLOTH_YAW_RAD);
    corners(CLOTH_M[0], CLOTH_M[2]).map(|[x, z]| {
        Point3::new(
            CLOTH_CENTER[0] + cos * x + sin * z,
            -CLOTH_M[1],
            CLOTH_CENTER[2] + sin * x - cos * z,
        )
    })
}

/// Returns the corners of the landscape's frame on the back wall of [`Scene::still_life`], 62 cm by
/// 46 cm, meters in the world: upper left, upper right, lower right, lower left.
pub fn still_life_landscape() -> [Point3<f64>; 4] {
    let [width, height] = LANDSCAPE_M;
    corners(width, height).map(|[x, y]| {
        let z = BACK_WALL_Z - PICTURE_DEPTH_M;
        Point3::new(LANDSCAPE_XY[0] + x, LANDSCAPE_XY[1] + y, z)
    })
}

/// Returns the corners of a rectangle about the origin: left and up, right and up, right and down,
/// left and down.
fn corners(width: f64, height: f64) -> [[f64; 2]; 4] {
    let (x, y) = (width / 2.0, height / 2.0);
    [[-x, -y], [x, -y], [x, y], [-x, y]]
}

impl Scene {
    /// Returns a table by a window with a mug of coffee, books, fruit, a jug and a tea tin on a
    /// printed cloth; pictures on a plastered wall.
    ///
    /// The world's origin is on the table's top in the middle of the objects; x points right, y
    /// **down** and z away from the viewer of [`still_life_camera`](crate::still_life_camera),
    /// meters. The room reaches from x = −1.7 to 1.9, y = −1.95 to 0.75 and z = −3.25 to 1.05;
    /// every camera inside (and outside of the objects) gets a photograph without holes.
    ///
    /// The first photograph paints the textures and computes the light; later ones share them.
    ///
    /// ```
    /// use epipole_scenes::Scene;
    /// let (first, second) = (Scene::still_life(), Scene::still_life());
    /// let ray = nalgebra::Vector3::new(0.0, 0.0, 1.0);
    /// let from = nalgebra::Point3::new(-0.6, -0.8, 0.0);
    /// assert_eq!(first.cast(&from, &ray), second.cast(&from, &ray));
    /// ```
    pub fn still_life() -> Self {
        static SCENE: OnceLock<Scene> = OnceLock::new();
        SCENE.get_or_init(build).clone()
    }
}

fn lighting() -> Lighting {
    Lighting::new(
        [
            Vector3::new(LEFT_WALL_X + 0.02, -1.02, -0.62),
            Vector3::new(0.0, 0.0, -0.42),
            Vector3::new(0.0, 0.50, 0.0),
        ],
        [2.75, 2.50, 2.10],
        Some(2.0),
        [
            [0.26, 0.29, 0.33],
            [0.17, 0.155, 0.14],
            [0.27, 0.285, 0.31],
            [0.16, 0.105, 0.065],
            [0.20, 0.20, 0.205],
            [0.17, 0.165, 0.16],
        ],
    )
}

fn build() -> Scene {
    let mut bodies = room();
    bodies.extend(table());
    bodies.extend(objects());
    Scene {
        fixed: Arc::new(Fixed::new(bodies, lighting())),
        movable: None,
    }
}

/// Builds walls, floor, window and pictures.
fn room() -> Vec<Body> {
    let props = Props::shared();
    let wall = |width_m: f64, shift: f32| {
        Paint::new(&props.plaster)
            .repeated(
                (width_m / PLASTER_M) as f32,
                (ROOM_SIZE[1] / PLASTER_M) as f32,
            )
            .shifted(shift, 0.0)
            .lit(24, 24)
    };
    let size = Vector3::from(ROOM_SIZE);
    let walls = Body::room(ROOM_SIZE, ROOM_CENTER, &wall(size.z, 0.37))
        .painted(BACK, &wall(size.x, 0.0).lit(88, 60))
        .painted(RIGHT, &wall(size.z, 0.61))
        .painted(TOP, &wall(size.x, 0.2).tinted([1.5, 1.45, 1.4]))
        .painted(
            BOTTOM,
            &Paint::new(&props.floor).repeated(4.0, 4.0).lit(24, 24),
        );
    let quarter = std::f64::consts::FRAC_PI_2;
    let on_back = BACK_WALL_Z - PICTURE_DEPTH_M / 2.0;
    vec![
        walls,
        props.picture(
            &props.landscape,
            LANDSCAPE_M,
            [LANDSCAPE_XY[0], LANDSCAPE_XY[1], on_back],
            0.0,
        ),
        props.picture(&props.geometric, GEOMETRIC_M, [0.32, -0.50, on_back], 0.0),
        props.picture(&props.star_chart, STAR_CHART_M, [0.84, -0.46, on_back], 0.0),
        props.picture(
            &props.star_chart,
            STAR_CHART_M,
            [-1.12, -0.55, on_back],
            0.0,
        ),
        props.picture(
            &props.landscape,
            LANDSCAPE_M,
            [RIGHT_WALL_X - PICTURE_DEPTH_M / 2.0, -0.55, 0.1],
            -quarter,
        ),
        props.window([LEFT_WALL_X, -1.02, -0.62], [0.95, 1.1]),
    ]
}

/// Builds the table, its apron and legs.
fn table() -> Vec<Body> {
    let props = Props::shared();
    let (width, depth, thick) = (1.9, 1.16, 0.036);
    let z = -0.06;
    let top = Arc::new(paint::boards(
        props.noise,
        [512, 512],
        [width as f32, depth as f32],
        8.0,
    ));
    let plank = |across: f32, down: f32| Paint::new(&top).repeated(across, down).lit(24, 4);
    let name = "the table";
    let cuboid = |size: [f64; 3], center: [f64; 3], paint: &Paint| {
        Body::cuboid(name, size, center, paint).boxed()
    };
    let mut bodies = vec![
        cuboid(
            [width, thick, depth],
            [0.0, thick / 2.0, z],
            &plank(1.0, 0.03),
        )
        .painted(TOP, &Paint::new(&top).glossy(0.55).lit(148, 90)),
    ];
    // The apron is four boards instead of one block, so that rays to the top miss it early.
    for side in [-1.0, 1.0] {
        let (x, y) = (side * (width / 2.0 - 0.09), thick + 0.045);
        bodies.push(cuboid(
            [0.022, 0.09, depth - 0.2],
            [x, y, z],
            &plank(0.5, 0.09),
        ));
        bodies.push(cuboid(
            [width - 0.2, 0.09, 0.022],
            [0.0, y, z + side * (depth / 2.0 - 0.09)],
            &plank(0.9, 0.09),
        ));
    }
    for (side_x, side_z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        bodies.push(cuboid(
            [0.07, 0.75 - thick, 0.07],
            [
                side_x * (width / 2.0 - 0.09),
                (0.75 + thick) / 2.0,
                z + side_z * (depth / 2.0 - 0.09),
            ],
            &plank(0.05, 0.5),
        ));
    }
    bodies
}

/// Builds the objects on the table.
fn objects() -> Vec<Body> {
    let props = Props::shared();
    let cloth = Arc::new(paint::block_print(
        props.noise,
        (CLOTH_M[0] / CLOTH_M[2]) as f32,
    ));
    let print = Paint::new(&cloth);
    let mut bodies = vec![
        Body::cuboid(
            "the cloth",
            CLOTH_M,
            CLOTH_CENTER,
            &print.clone().repeated(1.0, 0.01),
        )
        .yawed(CLOTH_YAW_RAD)
        .painted(TOP, &print.lit(72, 52))
        .painted(FRONT, &Paint::new(&cloth).repeated(1.0, 0.01)),
    ];
    let on_cloth = -CLOTH_M[1];

    // Three books, the lowest the largest, not quite in line.
    let stack = [-0.315, 0.0, 0.06];
    let heights = [0.046, 0.037, 0.032];
    bodies.extend(props.book(0, stack, [0.295, heights[0], 0.215], -0.10));
    bodies.extend(props.book(
        1,
        placed(stack, 0.0, [0.012, -heights[0], 0.004]),
        [0.27, heights[1], 0.19],
        0.07,
    ));
    bodies.extend(props.book(
        2,
        placed(stack, 0.0, [-0.010, -heights[0] - heights[1], 0.006]),
        [0.24, heights[2], 0.17],
        -0.21,
    ));
    let stack_m: f64 = heights.iter().sum();
    bodies.extend(props.apple([-0.33, -stack_m, 0.055], 0.041, 0.6));

    bodies.extend(props.mug([0.19, on_cloth, -0.16], -0.45, 1.12));
    bodies.push(props.jug([0.045, 0.0, 0.215], 0.3, 1.0));
    bodies.extend(props.tin([0.40, 0.0, 0.16], [0.105, 0.150, 0.085], -0.42));
    bodies.push(props.orange([-0.01, on_cloth, -0.085], 0.042, [0.9, 0.5]));
    bodies.push(props.orange([-0.085, on_cloth, -0.165], 0.039, [2.4, -0.9]));
    bodies.push(props.lemon(
        [0.045, on_cloth, -0.245],
        [0.55, std::f64::consts::FRAC_PI_2],
    ));
    bodies.push(props.orange([0.47, 0.0, 0.015], 0.041, [4.0, 0.3]));
    bodies
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that points a little toward the middle are on the named object, and points a little
    /// farther out are not.
    fn assert_outline(corners: &[Point3<f64>; 4], from: &Vector3<f64>, name: &str) {
        let scene = Scene::still_life();
        let middle = corners.iter().map(|corner| corner.coords / 4.0).sum();
        // A book lies on the first corner of the cloth, the tea tin stands on the second.
        for corner in &corners[2..] {
            for (fraction, is_on) in [(0.99, true), (1.01, false)] {
                let point = Point3::from(corner.coords.lerp(&middle, 1.0 - fraction));
                let hit = scene.cast(&(point - from), from).unwrap();
                assert_eq!(
                    hit.object == name,
                    is_on,
                    "{corner} {fraction} {}",
                    hit.object
                );
            }
        }
    }

    #[test]
    fn corners_of_cloth_and_landscape_are_where_they_are_said_to_be() {
        let down = Vector3::new(0.0, 0.3, 0.0);
        assert_outline(&still_life_cloth(), &down, "the cloth");
        let ahead = Vector3::new(0.0, 0.0, 0.3);
        assert_outline(&still_life_landscape(), &ahead, "a picture");
    }
}
