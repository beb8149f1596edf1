//! Objects on walls: windows and pictures.

use super::{PICTURE_DEPTH_M, Props};
use crate::objects::body::{Body, Paint};
use crate::paint::texture::Texture;
use crate::shape::{FRONT, RIGHT};
use std::sync::Arc;

impl Props {
    /// Returns the support of a movable object while its light is computed: the plane y = 0.
    pub(crate) fn slab(&self, width_m: f64, depth_m: f64) -> Body {
        let paint = Paint::new(&self.plaster).lit(1, 1);
        let center = [0.0, 0.02, 0.0];
        Body::cuboid("the table", [width_m, 0.04, depth_m], center, &paint).boxed()
    }

    /// Creates a window at `middle` of a wall that faces +x.
    pub(crate) fn window(&self, middle: [f64; 3], size_m: [f64; 2]) -> Body {
        let deep = 0.03;
        Body::cuboid(
            "the window",
            [deep, size_m[1], size_m[0]],
            [middle[0] + deep / 2.0, middle[1], middle[2]],
            &Paint::new(&self.floor).tinted([1.6; 3]),
        )
        .painted(RIGHT, &Paint::new(&self.window).glowing(1.25))
    }

    /// Creates a framed picture on a wall, its painted face toward local −z.
    pub(crate) fn picture(
        &self,
        texture: &Arc<Texture>,
        size_m: [f64; 2],
        middle: [f64; 3],
        yaw_rad: f64,
    ) -> Body {
        let side = Paint::new(&self.linen).tinted([0.12, 0.07, 0.04]);
        Body::cuboid(
            "a picture",
            [size_m[0], size_m[1], PICTURE_DEPTH_M],
            middle,
            &side,
        )
        .yawed(yaw_rad)
        .painted(FRONT, &Paint::new(texture).glossy(0.25).lit(16, 16))
        .boxed()
    }
}
