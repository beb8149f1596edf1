//! Light sources of a scene: a window, and the ambient light of the room.

use nalgebra::Vector3;

/// Light sources: a rectangle such as a window, and ambient light from six sides.
#[derive(Debug, Clone)]
pub(crate) struct Lighting {
    pub(crate) center: Vector3<f64>,
    /// Half sides of the rectangle; u × v points into the room.
    pub(crate) half_u: Vector3<f64>,
    pub(crate) half_v: Vector3<f64>,
    pub(crate) color: [f32; 3],
    /// Distance at which the rectangle has full strength; `None` if far away, for even light.
    pub(crate) reference_m: Option<f64>,
    /// Light on surfaces that face −x, +x, −y (up), +y, −z, +z.
    pub(crate) sides: [[f32; 3]; 6],
    pub(crate) mirror: Mirror,
}

/// The rectangle in the form needed for reflections.
#[derive(Debug, Clone)]
pub(crate) struct Mirror {
    /// Its plane: `normal · x = offset`.
    pub(crate) normal: [f32; 3],
    pub(crate) offset: f32,
    /// Axis: `u · x − u_offset` is −1 … 1 from edge to edge.
    pub(crate) u: [f32; 3],
    pub(crate) u_offset: f32,
    pub(crate) v: [f32; 3],
    pub(crate) v_offset: f32,
}

impl Lighting {
    /// * `center`, `half_u`, `half_v`: the rectangle, meters; u × v points into the room
    /// * `reference_m`: distance of full strength; `None` if far away
    /// * `sides`: ambient light on surfaces that face −x, +x, −y (up), +y, −z, +z
    pub(crate) fn new(
        [center, half_u, half_v]: [Vector3<f64>; 3],
        color: [f32; 3],
        reference_m: Option<f64>,
        sides: [[f32; 3]; 6],
    ) -> Self {
        let normal = half_u.cross(&half_v).normalize();
        let (u, v) = (
            half_u / half_u.norm_squared(),
            half_v / half_v.norm_squared(),
        );
        let mirror = Mirror {
            normal: single(&normal),
            offset: normal.dot(&center) as f32,
            u: single(&u),
            u_offset: u.dot(&center) as f32,
            v: single(&v),
            v_offset: v.dot(&center) as f32,
        };
        Self {
            center,
            half_u,
            half_v,
            color,
            reference_m,
            sides,
            mirror,
        }
    }

    /// Creates even light from far away, such as through the high windows of a hall.
    ///
    /// * `toward`: direction to the light
    /// * `half_side`: half the side of its square, as a fraction of the distance
    pub(crate) fn even(toward: [f64; 3], far_m: f64, half_side: f64, color: [f32; 3]) -> Self {
        let toward = Vector3::from(toward).normalize();
        let half_u = toward.cross(&Vector3::y()).normalize() * (half_side * far_m);
        let half_v = toward.cross(&half_u).normalize() * (half_side * far_m);
        Self::new(
            [toward * far_m, half_v, half_u],
            color,
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

    /// Returns the ambient light on a surface with this normal: the sides weighted by the squares
    /// of the normal's components (McTaggart 2004).
    #[inline]
    pub(crate) fn ambient(&self, normal: [f32; 3]) -> [f32; 3] {
        let mut color = [0.0; 3];
        for axis in 0..3 {
            let side = self.sides[2 * axis + usize::from(normal[axis] > 0.0)];
            let weight = normal[axis] * normal[axis];
            for i in 0..3 {
                color[i] += weight * side[i];
            }
        }
        color
    }
}

#[inline]
pub(crate) fn single(v: &Vector3<f64>) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}
