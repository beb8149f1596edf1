//! Figures against closed forms.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::*;
use nalgebra::{Rotation3, Translation3};

/// A rotation and translation out of all planes of coordinates.
fn moved(points: &[[f64; 3]]) -> Vec<Point3<f64>> {
    let rotation = Rotation3::from_euler_angles(0.4, -1.1, 2.3);
    let motion = Translation3::new(3.0, -7.0, 11.0);
    let one = |point: &[f64; 3]| motion * (rotation * Point3::from(*point));
    points.iter().map(one).collect()
}

/// A box of sides 1, 1 and `height` on the plane z = 0, without its base; the top has an apex
/// `apex` above its middle.
fn tent(height: f64, apex: f64) -> Vec<[[f64; 3]; 3]> {
    let corner = |n: usize| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][n % 4];
    let mut triangles = Vec::new();
    for n in 0..4 {
        let ([x0, y0], [x1, y1]) = (corner(n), corner(n + 1));
        let (low, high) = ([x0, y0, 0.0], [x0, y0, height]);
        let (next_low, next) = ([x1, y1, 0.0], [x1, y1, height]);
        triangles.push([low, next_low, next]);
        triangles.push([low, next, high]);
        triangles.push([high, next, [0.5, 0.5, height + apex]]);
    }
    triangles
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} {expected}");
}

#[test]
fn a_rotated_square_has_its_area_and_lies_in_its_plane() {
    let side = 0.25;
    let flat = [
        [0.0, 0.0, 0.0],
        [side, 0.0, 0.0],
        [side, side, 0.0],
        [0.0, side, 0.0],
    ];
    let square = moved(&flat);
    let plane = Plane::fit(&square).unwrap();
    near(signed_area(&plane.outline(&square)).abs(), side * side);
    near(plane.deviation(&square), 0.0);
    near(plane.axes.determinant(), 1.0);
    // Corners alternately above and below by h: the plane stays, and so does the area in it.
    let h = 0.01;
    let mut bent = flat;
    for (n, corner) in bent.iter_mut().enumerate() {
        corner[2] = [h, -h][n % 2];
    }
    let bent = moved(&bent);
    let plane = Plane::fit(&bent).unwrap();
    near(plane.deviation(&bent), h);
    near(signed_area(&plane.outline(&bent)).abs(), side * side);
    assert!(Plane::fit(&square[..2]).is_none());
    let line = moved(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 1e-4, 0.0]]);
    assert!(Plane::fit(&line).is_none());
}

#[test]
fn a_concave_outline_has_its_area_and_a_crossed_one_is_refused() {
    // An L of three unit squares.
    let ell = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    near(signed_area(&ell), 3.0);
    assert!(is_simple(&ell));
    let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert!(!is_simple(&bow));
}

#[test]
fn boxes_and_pyramids_have_their_volumes() {
    let wide = [[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]];
    let cube = prisms(&wide, tent(1.0, 0.0));
    near(cube.volume, 1.0);
    near(cube.covered, 1.0);
    near(cube.moments[0], 0.5);
    near(prisms(&wide, tent(0.0, 0.6)).volume, 0.2);
    near(prisms(&wide, tent(-0.5, 0.0)).volume, -0.5);
    // A base that faces down closes it: the same volume, and nothing covered on balance.
    let base = [
        [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ];
    let raised = |t: [[f64; 3]; 3]| t.map(|[x, y, z]| [x, y, z + 3.0]);
    let closed = tent(1.0, 0.0).into_iter().chain(base).map(raised);
    let closed = prisms(&wide, closed);
    near(closed.volume, 1.0);
    near(closed.covered, 0.0);
}

#[test]
fn walls_that_rounding_tilts_add_no_volume() {
    let wide = [[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]];
    let tilted = |n: usize| {
        let shift = 1e-17 * (n % 7) as f64;
        move |t: [[f64; 3]; 3]| t.map(|[x, y, z]| [x + shift * z, y - 1.3 * shift * z, z])
    };
    for n in 0..50 {
        let found = prisms(&wide, tent(1.0, 0.0).into_iter().map(tilted(n)));
        near(found.volume, 1.0);
    }
}

#[test]
fn prisms_are_clipped_to_the_outline_whatever_its_direction() {
    let half = [[-1.0, -1.0], [0.5, -1.0], [0.5, 2.0], [-1.0, 2.0]];
    let half_pyramid = prisms(&half, tent(0.0, 0.6));
    near(half_pyramid.volume, 0.1);
    near(half_pyramid.covered, 0.5);
    let mut clockwise = half;
    clockwise.reverse();
    near(prisms(&clockwise, tent(0.0, 0.6)).volume, 0.1);
    // A concave outline that leaves one corner of the cube out.
    let ell = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 0.5],
        [0.5, 0.5],
        [0.5, 1.0],
        [0.0, 1.0],
    ];
    near(prisms(&ell, tent(2.0, 0.0)).volume, 1.5);
    // A U over two arms of the top: the clipped parts are joined, and the joint has no area.
    let u = [
        [-0.5, -0.5],
        [1.5, -0.5],
        [1.5, 1.5],
        [0.75, 1.5],
        [0.75, -0.25],
        [0.25, -0.25],
        [0.25, 1.5],
        [-0.5, 1.5],
    ];
    near(prisms(&u, tent(1.0, 0.0)).volume, 0.5);
}

#[test]
fn heights_of_a_plane_follow_its_points() {
    let points = [[0.0, 0.0], [1.0, 0.1], [0.3, 0.9], [-0.4, 0.5]];
    let at = [0.7, -0.2];
    let weights = height_weights(&points, at).unwrap();
    // Any plane is reproduced.
    let height = |[x, y]: [f64; 2]| 0.3 + 2.0 * x - 0.7 * y;
    let sum: f64 = (weights.iter().zip(points))
        .map(|(w, p)| w * height(p))
        .sum();
    near(sum, height(at));
}
