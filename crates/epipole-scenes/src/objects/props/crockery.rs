//! The mug and the jug.

use super::profiles::{MUG_HEIGHT_M, MUG_RADIUS_M, jug_profile, mug_profile};
use super::{Props, placed};
use crate::objects::body::{Body, Paint};
use crate::objects::proxy::Proxy;
use crate::shape::{Lathe, Ring, Shape};
use nalgebra::Vector3;

impl Props {
    /// Creates a mug of coffee that stands at `foot`, with the handle along local x.
    pub(crate) fn mug(&self, foot: [f64; 3], yaw_rad: f64, scale: f64) -> Vec<Body> {
        let name = "the mug";
        let (radius, height) = (MUG_RADIUS_M * scale, MUG_HEIGHT_M * scale);
        let glaze = Paint::new(&self.mug).glossy(1.0).lit(44, 30);
        let cup = Body::new(
            name,
            Shape::Lathe(Lathe::new(mug_profile().scaled(scale))),
            foot,
            &glaze,
        )
        .yawed(yaw_rad)
        .with_proxies(&[Proxy::Post {
            center: Vector3::new(0.0, -height / 2.0, 0.0),
            radius,
            half_height: height / 2.0,
        }])
        .hollow();
        let offset = radius - 0.004 * scale;
        let handle = Paint::new(&self.plain)
            .tinted([0.030, 0.075, 0.27])
            .glossy(1.0)
            .lit(32, 10);
        let ring = Ring::new(
            0.0285 * scale,
            0.0062 * scale,
            1.25,
            1.25,
            radius - 0.003 * scale - offset,
        );
        let handle = Body::new(
            name,
            Shape::Ring(ring),
            placed(foot, yaw_rad, [offset, -0.53 * height, 0.0]),
            &handle,
        )
        .yawed(yaw_rad)
        .hollow();
        vec![cup, handle]
    }

    /// Creates a tall jug.
    pub(crate) fn jug(&self, foot: [f64; 3], yaw_rad: f64, scale: f64) -> Body {
        let post = |low: f64, high: f64, radius: f64| Proxy::Post {
            center: Vector3::new(0.0, -(low + high) / 2.0 * scale, 0.0),
            radius: radius * scale,
            half_height: (high - low) / 2.0 * scale,
        };
        Body::new(
            "the jug",
            Shape::Lathe(Lathe::new(jug_profile().scaled(scale))),
            foot,
            &Paint::new(&self.jug).glossy(1.0).lit(32, 44),
        )
        .yawed(yaw_rad)
        .with_proxies(&[
            post(0.0, 0.03, 0.062),
            post(0.03, 0.20, 0.092),
            post(0.20, 0.34, 0.045),
        ])
        .hollow()
    }
}
