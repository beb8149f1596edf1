//! The movable object of a scene.

use super::fixed::Lights;
use crate::detail::Detail;
use crate::gradual::Gradual;
use crate::light::{Baking, Decal, Lighting, Shading};
use crate::objects::body::Body;

/// A movable object: its bodies around the origin and its shade.
#[derive(Debug)]
pub(crate) struct Movable {
    pub(crate) bodies: Vec<Body>,
    /// Support while its light is computed: the plane y = 0.
    pub(crate) slab: Body,
    /// Index of the scene's body on which the shade falls.
    pub(crate) ground: usize,
    looks: [Gradual<Looking, Look>; 2],
}

/// Partial state of a [`Look`].
type Looking = (Baking, Shading, Option<Decal>);

/// Light maps of a movable object, and its shade.
#[derive(Debug)]
pub(super) struct Look {
    pub(super) lights: Lights,
    pub(super) decal: Decal,
}

/// Side of the square that holds the shade of a movable object, meters.
pub(crate) const SHADE_M: f64 = 1.1;

impl Movable {
    pub(crate) fn new(bodies: Vec<Body>, slab: Body, ground: usize) -> Self {
        Self {
            bodies,
            slab,
            ground,
            looks: [Gradual::new(), Gradual::new()],
        }
    }

    fn work(
        &self,
        lighting: &Lighting,
        detail: Detail,
        (baking, shading, decal): &mut Looking,
        mut amount: usize,
    ) -> Option<Look> {
        let mut bodies: Vec<&Body> = self.bodies.iter().collect();
        if decal.is_none() {
            let ground = (detail, SHADE_M, &self.slab);
            *decal = Some(shading.advance(&bodies, lighting, ground, &mut amount)?);
        }
        bodies.push(&self.slab);
        let mut lights = baking.advance(&bodies, lighting, detail, &mut amount)?;
        lights.truncate(self.bodies.len());
        Some(Look {
            lights,
            decal: decal.take()?,
        })
    }

    pub(super) fn look(&self, lighting: &Lighting, detail: Detail) -> &Look {
        self.looks[detail as usize].get(|part, amount| self.work(lighting, detail, part, amount))
    }

    pub(super) fn advance(&self, lighting: &Lighting, detail: Detail, num_cells: usize) -> bool {
        self.looks[detail as usize].advance(num_cells, |part, amount| {
            self.work(lighting, detail, part, amount)
        })
    }
}
