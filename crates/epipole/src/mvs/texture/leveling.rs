//! Color offsets that make photos agree along seams.

use super::super::mesh::Mesh;
use super::super::views::MvsView;
use super::adjacency::NONE;
use super::charts::Chart;
use crate::Result;
use crate::imaging::{Border, bilinear};
use crate::progress::{Monitor, Stage, report};
use image::RgbImage;
use nalgebra::{Point2, Vector3};
use std::collections::HashMap;

/// Weight of equal offsets at the ends of an edge, relative to equal colors along a seam.
const SMOOTHNESS: f64 = 0.1;
/// Weight of offsets of 0.
const ANCHOR: f64 = 1e-4;
/// Number of samples along an edge of a seam.
const NUM_SAMPLES: usize = 6;
const MAX_ITERATIONS: usize = 200;
/// Residual at which the iteration ends, relative to the first.
const TOLERANCE: f64 = 1e-4;

/// Color offsets at the vertices of each piece, for each corner of its triangles.
pub(super) type Offsets = Vec<Vec<[Vector3<f64>; 3]>>;

/// Returns the offsets, levels of 0 to 255, that minimize differences along seams and vary smoothly
/// in each piece.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Waechter, Moehrle & Goesele 2014, section 3.4 (global adjustment); Lempitsky & Ivanov
/// 2007, "Seamless mosaicing of image-based texture maps".
pub(super) fn offsets(
    mesh: &Mesh,
    views: &[MvsView],
    across: &[[u32; 3]],
    charts: &[Chart],
    monitor: &mut dyn Monitor,
) -> Result<Offsets> {
    report(monitor, Stage::Blending, 0.0)?;
    let system = System::of(mesh, views, across, charts);
    let solution = system.solve(monitor)?;
    let of_corner = |index: &u32| solution[*index as usize];
    let of_chart = |corners: &Vec<[u32; 3]>| {
        let triangles = corners.iter();
        triangles
            .map(|corners| corners.each_ref().map(of_corner))
            .collect()
    };
    Ok(system.unknowns.iter().map(of_chart).collect())
}

/// Linear least squares for one offset per vertex of each piece.
struct System {
    num_unknowns: usize,
    /// Unknown of each corner of each triangle of each piece.
    unknowns: Vec<Vec<[u32; 3]>>,
    /// Edges in pieces.
    smooth: Vec<[u32; 2]>,
    /// Vertices on seams: two unknowns, and the color at the first minus that at the second.
    seams: Vec<([u32; 2], Vector3<f64>)>,
}

impl System {
    fn of(mesh: &Mesh, views: &[MvsView], across: &[[u32; 3]], charts: &[Chart]) -> Self {
        let mut home = vec![(NONE, NONE); mesh.triangles.len()];
        let (mut num_unknowns, mut unknowns) = (0_u32, Vec::new());
        for (chart_index, chart) in charts.iter().enumerate() {
            let mut of_vertex: HashMap<u32, u32> = HashMap::new();
            let mut corners = Vec::with_capacity(chart.triangles.len());
            for (place, &triangle) in chart.triangles.iter().enumerate() {
                home[triangle] = (chart_index as u32, place as u32);
                corners.push(mesh.triangles[triangle].map(|vertex| {
                    *of_vertex.entry(vertex).or_insert_with(|| {
                        num_unknowns += 1;
                        num_unknowns - 1
                    })
                }));
            }
            unknowns.push(corners);
        }
        let mut smooth = Vec::new();
        let mut differences: Vec<([u32; 2], Vector3<f64>)> = Vec::new();
        for (chart_index, chart) in charts.iter().enumerate() {
            for (place, &triangle) in chart.triangles.iter().enumerate() {
                for slot in 0..3 {
                    let ends = [slot, (slot + 1) % 3];
                    let own = ends.map(|end| unknowns[chart_index][place][end]);
                    let other = across[triangle][slot];
                    if other == NONE {
                        smooth.push(own);
                        continue;
                    }
                    let (other_chart, other_place) = home[other as usize];
                    if other_chart == chart_index as u32 || other_chart == NONE {
                        if other_chart == NONE || triangle < other as usize {
                            smooth.push(own);
                        }
                        continue;
                    }
                    smooth.push(own);
                    if triangle > other as usize {
                        continue;
                    }
                    let twin = &charts[other_chart as usize];
                    let vertices = ends.map(|end| mesh.triangles[triangle][end]);
                    let twin_ends = vertices.map(|vertex| {
                        let corners = &mesh.triangles[other as usize];
                        corners
                            .iter()
                            .position(|corner| *corner == vertex)
                            .unwrap_or(0)
                    });
                    let own_side = Side {
                        photo: &views[chart.view].image,
                        ends: ends.map(|end| chart.pixels[place][end]),
                    };
                    let twin_side = Side {
                        photo: &views[twin.view].image,
                        ends: twin_ends.map(|end| twin.pixels[other_place as usize][end]),
                    };
                    let twins = twin_ends
                        .map(|end| unknowns[other_chart as usize][other_place as usize][end]);
                    for end in 0..2 {
                        let difference = own_side.color(end) - twin_side.color(end);
                        differences.push(([own[end], twins[end]], difference));
                    }
                }
            }
        }
        Self {
            num_unknowns: num_unknowns as usize,
            unknowns,
            smooth,
            seams: average_repeated(differences),
        }
    }

    /// Multiplies the normal equations by a vector.
    fn apply(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let mut y: Vec<Vector3<f64>> = x.iter().map(|value| value * ANCHOR).collect();
        let seams = self.seams.iter().map(|(pair, _)| (pair, 1.0));
        let smooth = self.smooth.iter().map(|pair| (pair, SMOOTHNESS));
        for (&[i, j], weight) in seams.chain(smooth) {
            let (i, j) = (i as usize, j as usize);
            let pull = (x[i] - x[j]) * weight;
            y[i] += pull;
            y[j] -= pull;
        }
        y
    }

    /// Solves the normal equations of the three channels by conjugate gradients.
    ///
    /// # Errors
    /// [`Error::Canceled`](crate::Error::Canceled).
    fn solve(&self, monitor: &mut dyn Monitor) -> Result<Vec<Vector3<f64>>> {
        let mut x = vec![Vector3::zeros(); self.num_unknowns];
        let mut residual = x.clone();
        for (pair, difference) in &self.seams {
            residual[pair[0] as usize] -= difference;
            residual[pair[1] as usize] += difference;
        }
        let mut direction = residual.clone();
        let mut norms = dot(&residual, &residual);
        let first = norms;
        for number in 0..MAX_ITERATIONS {
            report(
                monitor,
                Stage::Blending,
                number as f32 / MAX_ITERATIONS as f32,
            )?;
            let ends = norms.iter().zip(&first);
            if ends
                .into_iter()
                .all(|(now, first)| *now <= TOLERANCE * TOLERANCE * first)
            {
                break;
            }
            let image = self.apply(&direction);
            let curvature = dot(&direction, &image);
            let step = norms.zip_map(&curvature, |n, c| if c > 0.0 { n / c } else { 0.0 });
            for index in 0..x.len() {
                x[index] += direction[index].component_mul(&step);
                residual[index] -= image[index].component_mul(&step);
            }
            let next = dot(&residual, &residual);
            let ratio = next.zip_map(&norms, |a, b| if b > 0.0 { a / b } else { 0.0 });
            for (value, residual) in direction.iter_mut().zip(&residual) {
                *value = residual + value.component_mul(&ratio);
            }
            norms = next;
        }
        Ok(x)
    }
}

/// Returns the sums of products for each channel.
fn dot(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> Vector3<f64> {
    let products = a.iter().zip(b).map(|(a, b)| a.component_mul(b));
    products.fold(Vector3::zeros(), |sum, product| sum + product)
}

/// Returns the mean of the differences of each pair.
fn average_repeated(mut all: Vec<([u32; 2], Vector3<f64>)>) -> Vec<([u32; 2], Vector3<f64>)> {
    // Stable, so that sums keep their order.
    all.sort_by_key(|(pair, _)| *pair);
    let mean = |run: &[([u32; 2], Vector3<f64>)]| {
        let sum = run
            .iter()
            .fold(Vector3::zeros(), |sum, (_, value)| sum + value);
        (run[0].0, sum / run.len() as f64)
    };
    all.chunk_by(|a, b| a.0 == b.0).map(mean).collect()
}

/// An edge of a seam in a photo.
struct Side<'a> {
    photo: &'a RgbImage,
    ends: [Point2<f64>; 2],
}

impl Side<'_> {
    /// Returns the mean color along the edge, weighted from 1 at one end to 0 at the other.
    fn color(&self, end: usize) -> Vector3<f64> {
        let (from, to) = (self.ends[end], self.ends[1 - end]);
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for n in 0..NUM_SAMPLES {
            let t = n as f64 / NUM_SAMPLES as f64;
            let pixel = from + (to - from) * t;
            sum += color_at(self.photo, &pixel) * (1.0 - t);
            total += 1.0 - t;
        }
        sum / total
    }
}

/// Returns red, green and blue of a photo, 0 to 255, by bilinear interpolation; border pixels are
/// repeated outside.
pub(super) fn color_at(photo: &RgbImage, pixel: &Point2<f64>) -> Vector3<f64> {
    let raw = photo.as_raw();
    Vector3::from_fn(|channel, _| {
        let read = |pixel: usize| raw[3 * pixel + channel].into();
        let size = photo.dimensions();
        f64::from(bilinear(size, pixel.x, pixel.y, Border::Replicate, read))
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn offsets_halve_a_difference_and_keep_the_mean() {
        // Two pieces of two vertices each, brighter by 20 in the first.
        let system = System {
            num_unknowns: 4,
            unknowns: Vec::new(),
            smooth: vec![[0, 1], [2, 3]],
            seams: vec![([1, 2], Vector3::new(20.0, -4.0, 0.0))],
        };
        let offsets = system.solve(&mut ()).unwrap();
        let expected = [-10.0, -10.0, 10.0, 10.0];
        for (offset, expected) in offsets.iter().zip(expected) {
            assert!((offset.x - expected).abs() < 0.1, "{offset}");
            assert!((offset.y + 0.2 * expected).abs() < 0.02, "{offset}");
            assert_eq!(offset.z, 0.0);
        }
    }

    #[test]
    fn colors_are_interpolated() {
        let photo = RgbImage::from_fn(3, 2, |u, v| image::Rgb([10 * u as u8, 100 * v as u8, 7]));
        let color = color_at(&photo, &Point2::new(0.5, 0.25));
        assert!((color - Vector3::new(5.0, 25.0, 7.0)).amax() < 1e-12);
        let outside = color_at(&photo, &Point2::new(9.0, -4.0));
        assert_eq!(outside, Vector3::new(20.0, 0.0, 7.0));
    }
}
