//! A function on an integer grid as a terrain: a map with level lines, and a wireframe surface
//! viewed from the front above.

use crate::canvas::{Canvas, Place, Stroke, TextStyle};
use crate::contract::Rect;
use crate::kit::grid::SMALL;
use crate::theme::{Rgb, Role};
use image::RgbImage;

/// Pixels of the map per grid step.
const FINE: usize = 16;

/// A non-negative function on the grid.
pub(crate) struct Terrain<'a> {
    /// Half size of the grid, steps to each side of the middle.
    pub(crate) reach: usize,
    /// Value at a grid point: x to the right, y down.
    pub(crate) height: &'a dyn Fn((f64, f64)) -> f64,
}

impl Terrain<'_> {
    fn at(&self, x: i32, y: i32) -> f64 {
        (self.height)((f64::from(x), f64::from(y)))
    }

    /// Draws the map, interpolated between grid points.
    ///
    /// * `level`: index of the level of a value, from 0
    /// * `colors`: color of a level, and of the line around it
    pub(crate) fn map(
        &self,
        level: impl Fn(f64) -> usize,
        colors: impl Fn(usize) -> [Rgb; 2],
    ) -> RgbImage {
        let (levels, side) = self.levels(level);
        let most = levels.iter().copied().max().unwrap_or(0);
        let colors: Vec<[Rgb; 2]> = (0..=most).map(colors).collect();
        let rows: Vec<&[usize]> = levels.chunks_exact(side).collect();
        let mut map = RgbImage::new(side as u32, side as u32);
        let pixels = map.as_chunks_mut::<3>().0;
        for (v, pixels) in pixels.chunks_exact_mut(side).enumerate() {
            let (row, below) = (rows[v], rows[(v + 1).min(side - 1)]);
            let above = rows[v.saturating_sub(1)];
            for (u, pixel) in pixels.iter_mut().enumerate() {
                let here = row[u];
                let next = row[(u + 1).min(side - 1)].max(below[u]);
                let before = row[u.saturating_sub(1)].max(above[u]);
                *pixel = colors[here][usize::from(here != next || here < before)];
            }
        }
        map
    }

    /// Returns the level of every pixel of the map, row by row, and the number of pixels per row.
    fn levels(&self, level: impl Fn(f64) -> usize) -> (Vec<usize>, usize) {
        let reach = self.reach as i32;
        let side = (2 * self.reach + 1) * FINE;
        let limit = f64::from(reach);
        // Grid point before each pixel, and the fraction beyond it.
        let places: Vec<(usize, f64)> = (0..side)
            .map(|pixel| {
                let at = (pixel as f64 + 0.5) / FINE as f64 - 0.5 - limit;
                let at = at.clamp(-limit, limit - 1e-9);
                ((at.floor() + limit) as usize, at - at.floor())
            })
            .collect();
        // Interpolates across the columns once per grid row, then down the rows.
        let across: Vec<Vec<f64>> = (-reach..=reach)
            .map(|y| {
                let row: Vec<f64> = (-reach..=reach).map(|x| self.at(x, y)).collect();
                let between = |&(left, right): &(usize, f64)| {
                    row[left] * (1.0 - right) + row[left + 1] * right
                };
                places.iter().map(between).collect()
            })
            .collect();
        let mut levels = Vec::with_capacity(side * side);
        for &(above, below) in &places {
            let rows = across[above].iter().zip(&across[above + 1]);
            levels.extend(rows.map(|(upper, lower)| level(upper * (1.0 - below) + lower * below)));
        }
        (levels, side)
    }

    /// Draws the wireframe with a marked point.
    ///
    /// * `top`: value at the upper edge
    /// * `color`: color of a value
    pub(crate) fn draw_net(
        &self,
        canvas: &mut Canvas,
        rect: Rect,
        top: f64,
        marked: (f64, f64),
        color: impl Fn(f64) -> Rgb,
    ) {
        let reach = self.reach as i32;
        let (half_width, half_depth) = (rect.width * 0.47, rect.height * 0.2);
        let ground = rect.bottom() - half_depth - 10.0;
        let room = ground - half_depth - rect.y - 4.0;
        let project = |(x, y): (f64, f64), height: f64| -> Place {
            let (x, y) = (x / f64::from(reach), y / f64::from(reach));
            (
                rect.center().0 + 0.5 * (x - y) * half_width,
                ground + 0.5 * (x + y) * half_depth - (height / top).min(1.05) * room,
            )
        };
        let corner = |x: i32, y: i32| project((f64::from(x), f64::from(y)), self.at(x, y));
        // Far cells first, so that near ones cover them.
        for diagonal in -2 * reach..2 * reach {
            for x in (-reach).max(diagonal - reach + 1)..reach.min(diagonal + reach + 1) {
                let y = diagonal - x;
                let cell = [(0, 0), (1, 0), (1, 1), (0, 1)];
                let places = cell.map(|(right, down)| corner(x + right, y + down));
                let heights = cell.map(|(right, down)| self.at(x + right, y + down));
                canvas.polygon_color(&places, color(heights.iter().sum::<f64>() / 4.0));
                // The sides towards the viewer are drawn with the cells in front of them.
                let [back, right, front, left] = places;
                let mut sides = vec![left, back, right];
                if x == reach - 1 {
                    sides.push(front);
                }
                if y == reach - 1 {
                    sides.insert(0, front);
                }
                canvas.polyline(&sides, Stroke::solid(Role::Ink, 0.5));
            }
        }
        let style = TextStyle::new(Role::Ink, SMALL);
        let edge = f64::from(reach);
        let (right, down) = (project((edge, 0.0), 0.0), project((0.0, edge), 0.0));
        canvas.label((right.0 + 6.0, rect.bottom() - 10.0), "right", style);
        canvas.label((down.0 - 6.0, rect.bottom() - 10.0), "down", style.end());
        let place = project(marked, (self.height)(marked));
        let stem = Stroke::solid(Role::Grip, 2.0).cased();
        canvas.line(project(marked, 0.0), place, stem);
        canvas.disk(place, 4.5, Role::Halo, 1.0);
        canvas.disk(place, 3.5, Role::Grip, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_lines_lie_where_the_levels_change() {
        let slope = |(x, _): (f64, f64)| x + 2.0;
        let terrain = Terrain {
            reach: 2,
            height: &slope,
        };
        let fill = |level: usize| [level as u8; 3];
        let map = terrain.map(|height| height as usize, |level| [fill(level), [200; 3]]);
        assert_eq!(map.dimensions(), (80, 80));
        // A value applies to the center of its block of pixels.
        let row: Vec<u8> = (0..80).map(|u| map.get_pixel(u, 40).0[0]).collect();
        let lines: Vec<usize> = (0..80).filter(|&u| row[u] == 200).collect();
        assert_eq!(lines, [23, 39, 55]);
        assert_eq!([row[0], row[30], row[50], row[79]], [0, 1, 2, 3]);
    }
}
