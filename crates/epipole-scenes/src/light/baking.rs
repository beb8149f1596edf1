//! Incremental computation of light and shade, a few cells at a time.

use super::lighting::Lighting;
use super::maps::{Decal, LightMap};
use super::shade::Shade;
use crate::detail::Detail;
use crate::objects::body::Body;
use crate::shape::Shape;

/// Cells along each side of a movable object's shade.
const DECAL_CELLS: usize = 96;

/// Partial light maps: one per body and chart.
#[derive(Debug, Default)]
pub(crate) struct Baking {
    maps: Vec<Vec<LightMap>>,
    cells: Vec<[f32; 4]>,
}

impl Baking {
    /// Computes cells and subtracts them from `num_cells`; returns all maps once none is missing.
    pub(crate) fn advance(
        &mut self,
        bodies: &[&Body],
        lighting: &Lighting,
        detail: Detail,
        num_cells: &mut usize,
    ) -> Option<Vec<Vec<LightMap>>> {
        let shade = Shade::new(bodies, lighting);
        for index in self.maps.len().saturating_sub(1)..bodies.len() {
            let body = bodies[index];
            if self.maps.len() == index {
                self.maps.push(Vec::new());
            }
            for chart in self.maps[index].len()..body.paints.len() {
                let size = body.paints[chart].light_cells.map(|side| detail.side(side));
                while self.cells.len() < size[0] * size[1] {
                    *num_cells = num_cells.checked_sub(1)?;
                    let next = self.cells.len();
                    self.cells
                        .push(shade.cell((index, body, chart), size, next));
                }
                self.maps[index].push(LightMap {
                    width: size[0],
                    height: size[1],
                    wraps: !matches!(body.shape, Shape::Cuboid(_)),
                    cells: std::mem::take(&mut self.cells),
                });
            }
        }
        Some(std::mem::take(&mut self.maps))
    }
}

/// Partial shade of a movable object.
#[derive(Debug, Default)]
pub(crate) struct Shading {
    factors: Vec<[f32; 2]>,
}

impl Shading {
    /// Computes cells of the shade on a square of `side_m` meters around the origin of the plane y
    /// = 0, and subtracts them from `num_cells`; returns the shade once none is missing.
    pub(crate) fn advance(
        &mut self,
        bodies: &[&Body],
        lighting: &Lighting,
        (detail, side_m, ground): (Detail, f64, &Body),
        num_cells: &mut usize,
    ) -> Option<Decal> {
        let shade = Shade::new(bodies, lighting);
        let cells = detail.side(DECAL_CELLS);
        // Fades out, so that the edge of the square is not visible.
        let rim = |i: usize| {
            let ratio = DECAL_CELLS as f32 / cells as f32;
            (i.min(cells - 1 - i) as f32 * ratio / 3.0).min(1.0)
        };
        while self.factors.len() < cells * cells {
            *num_cells = num_cells.checked_sub(1)?;
            let (x, y) = (self.factors.len() % cells, self.factors.len() / cells);
            let at = |i: usize| ((i as f64 + 0.5) / cells as f64 - 0.5) * side_m;
            let fade = rim(x).min(rim(y));
            let darker = shade.darker(at(x), at(y), ground);
            self.factors
                .push(darker.map(|factor| 1.0 - (1.0 - factor) * fade));
        }
        Some(Decal {
            cells,
            side_m,
            factors: std::mem::take(&mut self.factors),
        })
    }
}
