//! Stored light and shade: on every chart of a body, and below movable objects.

use crate::paint::noise::split;

/// Light on a chart: red, green, blue, and the visible fraction of the window.
#[derive(Debug, Clone)]
pub(crate) struct LightMap {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) wraps: bool,
    pub(super) cells: Vec<[f32; 4]>,
}

impl LightMap {
    /// Interpolates the light at chart coordinates (s, t) between the centers of four cells.
    #[inline]
    pub(crate) fn sample(&self, s: f32, t: f32) -> [f32; 4] {
        let (x, fx) = split(s * self.width as f32 - 0.5);
        let (y, fy) = split(t * self.height as f32 - 0.5);
        let (w, h) = (self.width as i32, self.height as i32);
        let (x0, x1) = if self.wraps {
            (
                if x < 0 { w - 1 } else { x.min(w - 1) },
                if x + 1 >= w { 0 } else { x + 1 },
            )
        } else {
            (x.clamp(0, w - 1), (x + 1).clamp(0, w - 1))
        };
        let (y0, y1) = (y.clamp(0, h - 1), (y + 1).clamp(0, h - 1));
        let cell = |x: i32, y: i32| self.cells[(y * w + x) as usize];
        let (a, b, c, d) = (cell(x0, y0), cell(x1, y0), cell(x0, y1), cell(x1, y1));
        let mut light = [0.0; 4];
        for i in 0..4 {
            let upper = a[i] + (b[i] - a[i]) * fx;
            let lower = c[i] + (d[i] - c[i]) * fx;
            light[i] = upper + (lower - upper) * fy;
        }
        light
    }

    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        16 * self.cells.len()
    }
}

/// Shade of a movable object on the table, which moves with it.
#[derive(Debug)]
pub(crate) struct Decal {
    pub(super) cells: usize,
    pub(super) side_m: f64,
    pub(super) factors: Vec<[f32; 2]>,
}

impl Decal {
    /// Returns factors for window and ambient light at a position relative to the object's foot;
    /// `None` outside.
    pub(crate) fn sample(&self, x_m: f64, z_m: f64) -> Option<[f32; 2]> {
        let n = self.cells as f64;
        let (x, z) = (
            (x_m / self.side_m + 0.5) * n - 0.5,
            (z_m / self.side_m + 0.5) * n - 0.5,
        );
        if !(x >= 0.0 && z >= 0.0 && x < n - 1.0 && z < n - 1.0) {
            return None;
        }
        let (x0, fx) = split(x as f32);
        let (z0, fz) = split(z as f32);
        let at = |dx: usize, dz: usize| {
            let x = (x0 as usize + dx).min(self.cells - 1);
            let z = (z0 as usize + dz).min(self.cells - 1);
            self.factors[z * self.cells + x]
        };
        let (a, b, c, d) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1));
        Some([0, 1].map(|i| {
            let upper = a[i] + (b[i] - a[i]) * fx;
            let lower = c[i] + (d[i] - c[i]) * fx;
            upper + (lower - upper) * fz
        }))
    }
}
