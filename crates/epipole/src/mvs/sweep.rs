//! PatchMatch: propagation of planes between neighboring pixels, and random refinement.

use super::field::{Field, Hypothesis, Surface, row_len};
use super::hypothesis_cost::{Matching, PixelCost};
use super::plane::{MIN_COSINE, Plane};
use crate::Result;
use crate::math::parallel;
use crate::math::random::Random;
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::{Point2, Vector3};

/// Number of pixels between two reports.
const BAND: usize = 1 << 13;

/// Positions from which planes are propagated, by direction; all of the other color. In each
/// direction the plane with the lowest cost is tried: Xu & Tao 2019, §3.1.
const SOURCES: [[[isize; 2]; 7]; 4] = {
    let mut sources = [[[0; 2]; 7]; 4];
    let ahead = [[0, 1], [-1, 2], [1, 2], [0, 3], [0, 5], [0, 7], [0, 11]];
    let mut k = 0;
    while k < 7 {
        let [side, far]: [isize; 2] = ahead[k];
        sources[0][k] = [side, -far];
        sources[1][k] = [side, far];
        sources[2][k] = [-far, side];
        sources[3][k] = [far, side];
        k += 1;
    }
    sources
};

/// Minimum motion of the image in some neighbor for a plane to be tried, pixels.
const SAME_PX: f32 = 0.03;
/// Distance at which planes are compared, pixels: that of the patch's border.
const REACH_PX: f32 = 5.0;

/// Random perturbations of one round.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    /// Maximum change of the inverse depth.
    pub(super) inverse_depth: f64,
    /// Maximum change of a unit normal.
    pub(super) normal: f64,
    /// Whether to try a plane with a random normal as well.
    pub(super) is_wild: bool,
    /// Whether the best neighbors are chosen for each plane, or kept.
    pub(super) chooses_views: bool,
}

/// A pass over one photo.
pub(super) struct Pass<'a> {
    pub(super) matching: &'a Matching<'a>,
    /// Seed that differs between photos and passes.
    pub(super) seed: u64,
}

impl Pass<'_> {
    /// Calls `update` with the pixel and hypothesis of each pixel of a color, rows in parallel.
    fn for_each_pixel(
        &self,
        hypotheses: &mut [Hypothesis],
        (color, stream): (usize, u64),
        monitor: &mut dyn Monitor,
        update: impl Fn([usize; 2], &mut Hypothesis, &mut Random) + Sync,
    ) -> Result<()> {
        let width = self.matching.level.width;
        let half = row_len(width);
        let rows = BAND.div_ceil(half);
        let num_bands = self.matching.level.height.div_ceil(rows);
        for (band, part) in hypotheses.chunks_mut(rows * half).enumerate() {
            report(
                monitor,
                Stage::DepthEstimation,
                band as f32 / num_bands as f32,
            )?;
            parallel::for_each_chunk(part, half, |first, row| {
                let v = band * rows + first / half;
                let mut random = Random::new(mixed(self.seed, stream, v as u64));
                for (k, hypothesis) in row.iter_mut().enumerate() {
                    let u = 2 * k + (v + color) % 2;
                    if u < width {
                        update([u, v], hypothesis, &mut random);
                    }
                }
            });
        }
        Ok(())
    }

    /// Initializes planes from a surface, or at random, with their costs.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn start(&self, from: Option<&Surface>, monitor: &mut dyn Monitor) -> Result<Field> {
        let mut field = Field::new(self.matching.level);
        for color in 0..2 {
            let mut part = Part::new(monitor, 0.5 * color as f32, 0.5 * color as f32 + 0.5);
            let hypotheses = &mut field.colors[color];
            self.for_each_pixel(
                hypotheses,
                (color, color as u64),
                &mut part,
                |[u, v], hypothesis, random| {
                    let pixel = self.matching.pixel(u, v);
                    let plane = match from {
                        Some(surface) => self.continued(surface, u, v),
                        None => self.random_plane(&pixel, random),
                    };
                    let (cost, views) = self.matching.of_best(&pixel, plane);
                    *hypothesis = Hypothesis { plane, cost, views };
                },
            )?;
        }
        Ok(field)
    }

    /// Returns the plane of a coarser surface.
    fn continued(&self, surface: &Surface, u: usize, v: usize) -> Plane {
        let scale = surface.scale(self.matching.level);
        let plane = surface.plane_at(u as f32, v as f32, scale);
        let [low, high] = self.matching.range;
        Plane {
            inverse_depth: plane.inverse_depth.clamp(low, high),
            du: plane.du * scale[0],
            dv: plane.dv * scale[1],
        }
    }

    /// Runs one round: propagation to both colors, and refinement.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub(super) fn round(
        &self,
        field: &mut Field,
        (number, round): (u64, &Round),
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let (width, height) = (field.width, field.height);
        for color in 0..2 {
            let mut part = Part::new(monitor, 0.5 * color as f32, 0.5 * color as f32 + 0.5);
            let [first, second] = &mut field.colors;
            let (own, others) = match color {
                0 => (first, &*second),
                _ => (second, &*first),
            };
            let stream = 2 * (number + 1) + color as u64;
            self.for_each_pixel(
                own,
                (color, stream),
                &mut part,
                |[u, v], hypothesis, random| {
                    let pixel = self.matching.pixel(u, v);
                    let mut tested = Tested {
                        pass: self,
                        round,
                        pixel: &pixel,
                        best: hypothesis,
                    };
                    for sources in &SOURCES {
                        if let Some(plane) = cheapest(others, (width, height), [u, v], sources) {
                            tested.propose(plane);
                        }
                    }
                    tested.refine(random);
                },
            )?;
        }
        Ok(())
    }

    /// Returns a plane of random depth and normal.
    fn random_plane(&self, pixel: &PixelCost, random: &mut Random) -> Plane {
        let [low, high] = self.matching.range.map(f64::from);
        let inverse_depth = random.uniform(low, high);
        self.facing(pixel, inverse_depth, &random_vector(random))
    }

    /// Returns a plane with a normal towards the camera; frontal if the angle is too grazing.
    fn facing(&self, pixel: &PixelCost, inverse_depth: f64, normal: &Vector3<f64>) -> Plane {
        let ray = Vector3::from(pixel.ray);
        let along = normal.dot(&ray);
        let is_flat =
            along * along < MIN_COSINE * MIN_COSINE * normal.norm_squared() * ray.norm_squared();
        // The sign of a normal does not affect its plane.
        let normal = if is_flat { ray } else { *normal };
        let k = &self.matching.level.camera.camera.intrinsics;
        Plane::from_normal(k, &ray, inverse_depth, &normal)
    }
}

/// Returns the plane of the lowest cost at some positions, moved to a pixel.
fn cheapest(
    others: &[Hypothesis],
    (width, height): (usize, usize),
    [u, v]: [usize; 2],
    sources: &[[isize; 2]],
) -> Option<Plane> {
    let half = row_len(width);
    let mut best: Option<(&Hypothesis, [isize; 2])> = None;
    for &[du, dv] in sources {
        let (x, y) = (u as isize + du, v as isize + dv);
        if x < 0 || y < 0 || x >= width as isize || y >= height as isize {
            continue;
        }
        let other = &others[y as usize * half + x as usize / 2];
        if best.is_none_or(|(best, _)| other.cost < best.cost) {
            best = Some((other, [du, dv]));
        }
    }
    let (other, [du, dv]) = best?;
    Some(other.plane.moved(-du as f32, -dv as f32))
}

/// The best hypothesis of a pixel so far.
struct Tested<'a> {
    pass: &'a Pass<'a>,
    round: &'a Round,
    pixel: &'a PixelCost,
    best: &'a mut Hypothesis,
}

impl Tested<'_> {
    /// Accepts a plane if it costs less.
    fn propose(&mut self, plane: Plane) {
        let matching = self.pass.matching;
        if self.is_same(plane) || !matching.is_possible(self.pixel, plane) {
            return;
        }
        let (cost, views) = match self.round.chooses_views {
            true => matching.of_best(self.pixel, plane),
            false => {
                let views = self.best.views;
                let cost = matching.of_views(self.pixel, plane, views, self.best.cost);
                (cost, views)
            }
        };
        if cost < self.best.cost {
            *self.best = Hypothesis { plane, cost, views };
        }
    }

    /// Returns whether a plane moves no pixel of the patch noticeably.
    fn is_same(&self, plane: Plane) -> bool {
        let best = self.best.plane;
        let change = (plane.inverse_depth - best.inverse_depth).abs()
            + REACH_PX * ((plane.du - best.du).abs() + (plane.dv - best.dv).abs());
        let matching = self.pass.matching;
        let most = matching.neighbors.iter().map(|n| n.to.px_per_inverse_depth);
        change * most.fold(0.0, f64::max) as f32 <= SAME_PX
    }

    /// Tries random perturbations of the depth, of the normal, and of both.
    fn refine(&mut self, random: &mut Random) {
        let round = self.round;
        let k = &self.pass.matching.level.camera.camera.intrinsics;
        let here = Point2::new(self.pixel.u, self.pixel.v);
        let change = |random: &mut Random| round.inverse_depth * random.uniform(-1.0, 1.0);
        if round.is_wild {
            let depth = f64::from(self.best.plane.inverse_depth) + change(random);
            let plane = self.pass.facing(self.pixel, depth, &random_vector(random));
            self.propose(plane);
        }
        let plane = self.best.plane;
        // The normal is unchanged: slopes scale with the inverse depth.
        let depth = f64::from(plane.inverse_depth) + change(random);
        let factor = (depth / f64::from(plane.inverse_depth)) as f32;
        self.propose(Plane {
            inverse_depth: depth as f32,
            du: plane.du * factor,
            dv: plane.dv * factor,
        });
        let plane = self.best.plane;
        let normal = plane.normal(k, &here) + random_vector(random) * round.normal;
        let depth = f64::from(plane.inverse_depth);
        self.propose(self.pass.facing(self.pixel, depth, &normal));
    }
}

/// Returns a random nonzero vector within the unit ball, uniform in direction.
fn random_vector(random: &mut Random) -> Vector3<f64> {
    loop {
        let vector = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
        let square = vector.norm_squared();
        if square <= 1.0 && square > 1e-6 {
            return vector;
        }
    }
}

/// Returns a distinct seed for each row of each stream.
pub(super) fn mixed(seed: u64, stream: u64, row: u64) -> u64 {
    // Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators".
    let mut z = seed
        .wrapping_add(stream.wrapping_mul(0x9e37_79b9_7f4a_7c15))
        .wrapping_add(row.wrapping_mul(0xd1b5_4a32_d192_ed03));
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}
