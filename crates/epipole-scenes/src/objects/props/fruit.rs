//! Fruit, and a ball.

use super::Props;
use super::profiles::ball_profile;
use crate::objects::body::{Body, Paint};
use crate::objects::proxy::Proxy;
use crate::paint::texture::Texture;
use crate::shape::{Lathe, Profile, Shape};
use nalgebra::Vector3;
use std::sync::Arc;

impl Props {
    /// Creates an orange that rests on `foot`.
    pub(crate) fn orange(&self, foot: [f64; 3], radius_m: f64, rotation: [f64; 2]) -> Body {
        let shape = ball_profile(radius_m, radius_m * 0.95, 0.0);
        self.fruit(
            "an orange",
            shape,
            &self.orange,
            foot,
            radius_m * 0.97,
            rotation,
        )
    }

    /// Creates a ball that touches the table at `foot`.
    pub(crate) fn ball(&self, foot: [f64; 3], radius_m: f64) -> Body {
        let shape = ball_profile(radius_m, radius_m, 0.0);
        let mut body = self.fruit("the ball", shape, &self.orange, foot, radius_m, [0.4, 0.5]);
        body.paints[0].light_cells = [48, 32];
        body
    }

    /// Creates a lemon that lies on `foot`.
    pub(crate) fn lemon(&self, foot: [f64; 3], rotation: [f64; 2]) -> Body {
        let shape = ball_profile(0.030, 0.041, 0.007);
        self.fruit("a lemon", shape, &self.lemon, foot, 0.0305, rotation)
    }

    fn fruit(
        &self,
        name: &'static str,
        profile: Profile,
        texture: &Arc<Texture>,
        foot: [f64; 3],
        rest_m: f64,
        rotation: [f64; 2],
    ) -> Body {
        Body::new(
            name,
            Shape::Lathe(Lathe::new(profile)),
            [foot[0], foot[1] - rest_m, foot[2]],
            &Paint::new(texture).glossy(0.55).lit(24, 18),
        )
        .rotated(rotation[0], rotation[1])
        .with_proxies(&[Proxy::Ball {
            center: Vector3::zeros(),
            radius: rest_m,
        }])
    }

    /// Creates an apple with its stalk that rests on `foot`.
    pub(crate) fn apple(&self, foot: [f64; 3], radius_m: f64, yaw_rad: f64) -> Vec<Body> {
        let name = "the apple";
        let mut profile = Profile::from_height(0.0);
        let num = 26;
        let mut lowest = f64::INFINITY;
        let curve: Vec<(f64, f64)> = (0..=num)
            .map(|i| {
                let angle = std::f64::consts::PI * f64::from(i) / f64::from(num);
                let (sin, cos) = libm::sincos(angle);
                let dimple = |width: f64, from: f64| {
                    let x = from / width;
                    libm::exp(-x * x)
                };
                // From the blossom end at the bottom to the stalk at the top.
                let reach = 1.0 + 0.05 * cos.abs()
                    - 0.22 * dimple(0.30, angle)
                    - 0.50 * dimple(0.34, std::f64::consts::PI - angle)
                    - 0.10 * (1.0 - angle / std::f64::consts::PI) * (0.3 - cos).abs() * 0.5;
                lowest = lowest.min(-reach * cos * radius_m);
                (reach * sin * radius_m, -reach * cos * radius_m)
            })
            .collect();
        for (i, (radius, height)) in curve.iter().enumerate() {
            let height = height - lowest;
            profile = if i == 0 {
                Profile::from_height(height)
            } else {
                profile.to(if i == curve.len() - 1 { 0.0 } else { *radius }, height)
            };
        }
        let top_m = curve[curve.len() - 1].1 - lowest;
        let flesh = Body::new(
            name,
            Shape::Lathe(Lathe::new(profile)),
            foot,
            &Paint::new(&self.apple).glossy(0.9).lit(28, 20),
        )
        .yawed(yaw_rad)
        .with_proxies(&[Proxy::Ball {
            center: Vector3::new(0.0, -radius_m, 0.0),
            radius: radius_m * 0.95,
        }])
        .hollow();
        let stalk = Body::new(
            name,
            Shape::Lathe(Lathe::new(
                Profile::new()
                    .to(0.0014, 0.0)
                    .to(0.0011, 0.016)
                    .to(0.0019, 0.024)
                    .sharp()
                    .to(0.0, 0.024),
            )),
            [foot[0], foot[1] - top_m + 0.001, foot[2]],
            &Paint::new(&self.plain).tinted([0.10, 0.055, 0.025]),
        )
        .rotated(yaw_rad, 0.25);
        vec![flesh, stalk]
    }
}
