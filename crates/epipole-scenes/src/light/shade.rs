//! Light that reaches a point, and its occlusion.

use super::lighting::Lighting;
use crate::objects::body::{Body, Placement};
use crate::objects::proxy::Proxy;
use crate::shape::Ray;
use epipole::math::length;
use nalgebra::Vector3;

/// Offset that lifts a surface point off its own surface, meters.
const LIFT_M: f64 = 2e-4;

/// Heights above a surface at which its openness is probed, meters, and their weights.
const PROBES: [(f64, f32); 5] = [
    (0.006, 0.16),
    (0.02, 0.20),
    (0.05, 0.22),
    (0.12, 0.22),
    (0.28, 0.20),
];

/// Returns sixteen points on the window, evenly spread in both directions (Roberts 2018, the R2
/// sequence).
fn window_places(lighting: &Lighting) -> [Vector3<f64>; 16] {
    std::array::from_fn(|i| {
        let i = i as f64 + 1.0;
        let (a, b) = (i * 0.754_877_666_246_692_7, i * 0.569_840_290_998_053_2);
        let (a, b) = (2.0 * (a - a.floor()) - 1.0, 2.0 * (b - b.floor()) - 1.0);
        lighting.center + lighting.half_u * a + lighting.half_v * b
    })
}

/// Returns directions of the upper half space with cosine-weighted density.
fn dome() -> [Vector3<f64>; 14] {
    std::array::from_fn(|i| {
        let fraction = (i as f64 + 0.5) / 14.0;
        let (sin, cos) = libm::sincos(i as f64 * 2.399_963_229_728_653);
        let r = fraction.sqrt();
        Vector3::new(r * cos, r * sin, (1.0 - fraction).sqrt())
    })
}

/// All occluders of a scene.
pub(crate) struct Shade<'a> {
    lighting: &'a Lighting,
    places: [Vector3<f64>; 16],
    dome: [Vector3<f64>; 14],
    casters: Vec<(usize, &'a Body, Vector3<f64>, f64)>,
    /// Proxies with the index of their body.
    proxies: Vec<(usize, &'a Proxy)>,
}

impl<'a> Shade<'a> {
    pub(crate) fn new(bodies: &[&'a Body], lighting: &'a Lighting) -> Self {
        let transparent =
            |body: &Body| body.is_room() || body.paints.iter().any(|paint| paint.glow > 0.0);
        Self {
            lighting,
            places: window_places(lighting),
            dome: dome(),
            casters: bodies
                .iter()
                .enumerate()
                .filter(|(_, body)| !transparent(body))
                .map(|(index, body)| {
                    let (center, radius) = body.bounding_sphere();
                    (index, *body, center, radius)
                })
                .collect(),
            proxies: bodies
                .iter()
                .enumerate()
                .flat_map(|(index, body)| body.proxies.iter().map(move |proxy| (index, proxy)))
                .collect(),
        }
    }

    /// Returns the fraction of the window's light that reaches a point, weighted by the cosine at
    /// its surface, and the unweighted visible fraction of the window.
    fn window(&self, own: usize, body: &Body, p: &Vector3<f64>, n: &Vector3<f64>) -> (f64, f64) {
        let origin = p + n * LIFT_M;
        let to_center = self.lighting.center - origin;
        let distance_sq = to_center.norm_squared();
        let spread = length(&(self.lighting.half_u + self.lighting.half_v));
        let mut nearby: Vec<&Body> = Vec::new();
        for (index, caster, center, radius) in &self.casters {
            if *index == own && !body.hollow {
                continue;
            }
            // Skips casters whose box is below the surface.
            let (half, _) = caster.shape.bounds();
            let reach = half.dot(&(caster.local_from_world * n).abs());
            if (center - p).dot(n) + reach < 2.0 * LIFT_M {
                continue;
            }
            // Keeps casters whose sphere meets the cone from the point to the window.
            let along = ((center - origin).dot(&to_center) / distance_sq).clamp(0.0, 1.0);
            let off = length(&(center - (origin + to_center * along)));
            if off < radius + spread * along.max(0.02) {
                nearby.push(caster);
            }
        }
        let placed = Placement::as_built();
        let (mut lit, mut visible) = (0.0, 0.0);
        for place in &self.places {
            let direction = place - origin;
            let cosine = n.dot(&direction) / length(&direction);
            if cosine <= 0.0 {
                continue;
            }
            let ray = Ray { origin, direction };
            if nearby
                .iter()
                .all(|caster| caster.meet(&ray, &placed, 1e-9, 0.999).is_none())
            {
                lit += cosine;
                visible += 1.0;
            }
        }
        let strength = self
            .lighting
            .reference_m
            .map_or(1.0, |reference| reference * reference / distance_sq);
        (lit / 16.0 * strength, visible / 16.0)
    }

    /// Returns the openness of a surface point's surroundings, 0 to 1, by comparing heights above
    /// the surface with distances to nearby proxies (after Evans 2006).
    fn openness(&self, own: usize, p: &Vector3<f64>, n: &Vector3<f64>) -> f32 {
        let reach = PROBES[PROBES.len() - 1].0 * 2.0;
        let mut nearby: Vec<&Proxy> = Vec::new();
        for (index, proxy) in &self.proxies {
            if *index != own && proxy.distance(p) < reach {
                nearby.push(proxy);
            }
        }
        let mut open = 1.0;
        for (height, weight) in PROBES {
            let probe = p + n * height;
            let distance = nearby
                .iter()
                .fold(height, |least, proxy| proxy.distance(&probe).min(least))
                .max(0.0);
            open -= weight * (1.0 - (distance / height) as f32);
        }
        open
    }

    /// Returns the fraction of the upper half space that a hollow body itself leaves open.
    fn own_openness(&self, body: &Body, p: &Vector3<f64>, n: &Vector3<f64>) -> f32 {
        let side = if n.x.abs() < 0.7 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        let u = n.cross(&side).normalize();
        let v = n.cross(&u);
        let placed = Placement::as_built();
        let origin = p + n * (5.0 * LIFT_M);
        let num_open = self
            .dome
            .iter()
            .filter(|d| {
                let direction = u * d.x + v * d.y + n * d.z;
                let ray = Ray { origin, direction };
                body.meet(&ray, &placed, 1e-9, 0.3).is_none()
            })
            .count();
        num_open as f32 / self.dome.len() as f32
    }

    /// Returns the light at a point of a surface.
    fn at(&self, own: usize, body: &Body, p: &Vector3<f64>, n: &Vector3<f64>) -> [f32; 4] {
        let (lit, visible) = self.window(own, body, p, n);
        let mut open = self.openness(own, p, n);
        if body.hollow {
            open *= 0.25 + 0.75 * self.own_openness(body, p, n);
        }
        let soft = self.lighting.ambient([n.x as f32, n.y as f32, n.z as f32]);
        let key = self.lighting.color.map(|channel| channel * lit as f32);
        // Ambient light in corners is warm: shade loses blue before red.
        let shade = [open * (1.1 - 0.1 * open), open, open * (0.9 + 0.1 * open)];
        [
            key[0] + soft[0] * shade[0],
            key[1] + soft[1] * shade[1],
            key[2] + soft[2] * shade[2],
            visible as f32,
        ]
    }

    /// Returns the light in a cell of a chart, given the numbers of cells across and down.
    pub(super) fn cell(
        &self,
        (own, body, chart): (usize, &Body, usize),
        [width, height]: [usize; 2],
        index: usize,
    ) -> [f32; 4] {
        let s = ((index % width) as f64 + 0.5) / width as f64;
        let t = ((index / width) as f64 + 0.5) / height as f64;
        let (point, normal) = body.shape.point(chart, s, t);
        let p = body.center + body.local_from_world.tr_mul(&point);
        let n = body.normal_in_world(&normal);
        self.at(own, body, &p, &n)
    }

    /// Returns how bodies darken the plane y = 0 at a position: factors for window and ambient
    /// light.
    pub(super) fn darker(&self, x_m: f64, z_m: f64, ground: &Body) -> [f32; 2] {
        let p = Vector3::new(x_m, 0.0, z_m);
        let up = Vector3::new(0.0, -1.0, 0.0);
        let (_, visible) = self.window(usize::MAX, ground, &p, &up);
        [visible as f32, self.openness(usize::MAX, &p, &up)]
    }
}
