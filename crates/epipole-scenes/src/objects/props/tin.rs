//! The tea tin.

use super::{Props, placed};
use crate::objects::body::{Body, Paint};

impl Props {
    /// Creates a tea tin with `foot` in the middle of its lower face.
    pub(crate) fn tin(&self, foot: [f64; 3], size_m: [f64; 3], yaw_rad: f64) -> Vec<Body> {
        let name = "the tea tin";
        let side = Paint::new(&self.tin).glossy(0.9).lit(16, 24);
        let lid = Paint::new(&self.linen)
            .tinted([0.30, 0.05, 0.055])
            .glossy(1.2)
            .lit(16, 16);
        let lid_m = 0.012;
        vec![
            Body::cuboid(
                name,
                size_m,
                placed(foot, yaw_rad, [0.0, -size_m[1] / 2.0, 0.0]),
                &side,
            )
            .yawed(yaw_rad)
            .boxed(),
            Body::cuboid(
                name,
                [size_m[0] * 1.03, lid_m, size_m[2] * 1.03],
                placed(foot, yaw_rad, [0.0, -size_m[1] - lid_m / 2.0, 0.0]),
                &lid,
            )
            .yawed(yaw_rad)
            .boxed(),
        ]
    }
}
