//! Books.

use super::{Props, placed};
use crate::objects::body::{Body, Paint};
use crate::shape::{FRONT, TOP};

impl Props {
    /// Creates a book lying flat, with its spine toward −z and `center` in the middle of its lower
    /// face.
    pub(crate) fn book(
        &self,
        index: usize,
        center: [f64; 3],
        size_m: [f64; 3],
        yaw_rad: f64,
    ) -> Vec<Body> {
        let name = "a book";
        let edition = &self.editions[index % self.editions.len()];
        let [length, thick, deep] = size_m;
        let board = 0.0030;
        let cloth = Paint::new(&self.linen)
            .tinted(edition.cloth.map(|channel| channel * 1.7))
            .glossy(0.5)
            .lit(12, 12);
        let edge = cloth.clone().repeated(2.0, 0.05).lit(16, 1);
        let leaves = Paint::new(&self.pages).repeated(3.0, 1.0).lit(16, 8);
        let at = |x: f64, y: f64, z: f64| placed(center, yaw_rad, [x, y, z]);
        let cuboid = |size: [f64; 3], middle: [f64; 3], paint: &Paint| {
            Body::cuboid(name, size, middle, paint).yawed(yaw_rad)
        };
        let top_paint = match &edition.cover {
            Some(cover) => Paint::new(cover).glossy(0.6).lit(24, 18),
            None => cloth.clone().repeated(2.0, 1.5).lit(24, 18),
        };
        let mut parts = vec![
            cuboid([length, board, deep], at(0.0, -board / 2.0, 0.0), &edge),
            cuboid(
                [length, board, deep],
                at(0.0, board / 2.0 - thick, 0.0),
                &edge,
            )
            .painted(TOP, &top_paint),
            cuboid(
                [length - 0.010, thick - 2.0 * board, deep - 0.010],
                at(0.0, -thick / 2.0, 0.0),
                &leaves,
            ),
            cuboid(
                [length, thick, 0.004],
                at(0.0, -thick / 2.0, -deep / 2.0 - 0.002),
                &edge,
            )
            .painted(FRONT, &Paint::new(&edition.spine).glossy(0.8).lit(24, 6)),
        ];
        // One proxy for all four.
        let whole = cuboid(size_m, at(0.0, -thick / 2.0, 0.0), &edge).boxed();
        parts[2].proxies = whole.proxies;
        parts
    }
}
