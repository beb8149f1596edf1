//! Bodies that never move.

use crate::detail::Detail;
use crate::gradual::Gradual;
use crate::light::{Baking, LightMap, Lighting};
use crate::objects::body::Body;

/// Light on every body and chart.
pub(super) type Lights = Vec<Vec<LightMap>>;

/// Bodies that never move, with their light.
#[derive(Debug)]
pub(crate) struct Fixed {
    pub(crate) bodies: Vec<Body>,
    pub(crate) lighting: Lighting,
    lights: [Gradual<Baking, Lights>; 2],
}

impl Fixed {
    pub(crate) fn new(bodies: Vec<Body>, lighting: Lighting) -> Self {
        Self {
            bodies,
            lighting,
            lights: [Gradual::new(), Gradual::new()],
        }
    }

    fn bake(&self, detail: Detail, baking: &mut Baking, mut amount: usize) -> Option<Lights> {
        let bodies: Vec<&Body> = self.bodies.iter().collect();
        baking.advance(&bodies, &self.lighting, detail, &mut amount)
    }

    pub(super) fn lights(&self, detail: Detail) -> &Lights {
        self.lights[detail as usize].get(|baking, amount| self.bake(detail, baking, amount))
    }

    pub(super) fn advance(&self, detail: Detail, num_cells: usize) -> bool {
        self.lights[detail as usize].advance(num_cells, |baking, amount| {
            self.bake(detail, baking, amount)
        })
    }
}
