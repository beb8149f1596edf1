//! Zero level of a signed distance field: one vertex per crossed cell, at the mean of the crossings
//! of the cell's edges.

use super::blocks::{Block, EDGE};
use super::signed_distance::{Field, Voxel};
use super::surface::Mesh;
use crate::Result;
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// Corners at the ends of a cell's edges; bit `axis` of a corner is its coordinate along the axis.
const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

struct Vertex {
    /// First corner of the cell.
    cell: [i32; 3],
    point: Point3<f64>,
    normal: Vector3<f64>,
    color: [u8; 3],
    /// Whether the surface crosses each of the three edges at the first corner, and if so, whether
    /// outwards.
    crossings: [Option<bool>; 3],
}

/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn extract(field: &Field, monitor: &mut dyn Monitor) -> Result<Mesh> {
    let found = monitored::map(field.blocks(), Stage::Fusion, monitor, |block| {
        of_block(field, block)
    })?;
    let vertices: Vec<Vertex> = found.into_iter().flatten().collect();
    let cells = vertices.iter().map(|vertex| vertex.cell);
    let index: HashMap<[i32; 3], u32> = cells.zip(0..).collect();
    let mut mesh = Mesh::default();
    for vertex in &vertices {
        mesh.vertices.points.push(vertex.point);
        mesh.vertices.normals.push(vertex.normal);
        mesh.vertices.colors.push(vertex.color);
        for (axis, crossing) in vertex.crossings.iter().enumerate() {
            let quad = crossing.and_then(|outwards| quad(vertex.cell, axis, outwards, &index));
            mesh.triangles
                .extend(quad.into_iter().flat_map(|quad| triangles(&vertices, quad)));
        }
    }
    Ok(mesh)
}

/// Returns the vertices of the cells whose first corner is in a block.
fn of_block(field: &Field, block: &Block) -> Vec<Vertex> {
    let first = block.map(|index| index * EDGE as i32);
    let mut vertices = Vec::new();
    for index in 0..EDGE * EDGE * EDGE {
        let within = [index % EDGE, index / EDGE % EDGE, index / (EDGE * EDGE)];
        let cell = [0, 1, 2].map(|axis| first[axis] + within[axis] as i32);
        vertices.extend(vertex(field, cell));
    }
    vertices
}

fn vertex(field: &Field, cell: [i32; 3]) -> Option<Vertex> {
    let corner =
        |corner: usize| field.get([0, 1, 2].map(|axis| cell[axis] + (corner >> axis & 1) as i32));
    let start = corner(0)?;
    let mut corners = [start; 8];
    for (n, place) in corners.iter_mut().enumerate().skip(1) {
        *place = corner(n)?;
    }
    let is_inside = |corner: usize| corners[corner].distance < 0.0;
    let (mut sum, mut count) = (Vector3::zeros(), 0.0);
    for [from, to] in EDGES {
        if is_inside(from) != is_inside(to) {
            let [a, b] = [from, to].map(|corner| f64::from(corners[corner].distance));
            let fraction = a / (a - b);
            sum += place(from).lerp(&place(to), fraction);
            count += 1.0;
        }
    }
    if count == 0.0 {
        return None;
    }
    let within = sum / count;
    Some(Vertex {
        cell,
        point: field.position(cell) + within * field.voxel_size,
        normal: gradient(&corners).try_normalize(0.0).unwrap_or_default(),
        color: color(&corners),
        crossings: [1, 2, 4].map(|end| (is_inside(0) != is_inside(end)).then(|| is_inside(0))),
    })
}

fn place(corner: usize) -> Vector3<f64> {
    Vector3::from([0, 1, 2].map(|axis| (corner >> axis & 1) as f64))
}

/// Returns the mean gradient in a cell.
fn gradient(corners: &[Voxel; 8]) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for [from, to] in EDGES {
        let difference = f64::from(corners[to].distance) - f64::from(corners[from].distance);
        sum += (place(to) - place(from)) * difference;
    }
    sum
}

fn color(corners: &[Voxel; 8]) -> [u8; 3] {
    [0, 1, 2].map(|channel| {
        let total: u16 = corners.iter().map(|c| u16::from(c.color[channel])).sum();
        ((total + 4) / 8) as u8
    })
}

/// Returns the four vertices around the edge from the first corner of a cell along an axis,
/// counterclockwise as seen from outside; `None` if one is missing.
fn quad(
    cell: [i32; 3],
    axis: usize,
    outwards: bool,
    index: &HashMap<[i32; 3], u32>,
) -> Option<[u32; 4]> {
    let mut quad = [0; 4];
    for (place, (b, c)) in quad.iter_mut().zip([(1, 1), (0, 1), (0, 0), (1, 0)]) {
        let mut other = cell;
        other[(axis + 1) % 3] -= b;
        other[(axis + 2) % 3] -= c;
        *place = *index.get(&other)?;
    }
    if !outwards {
        quad.reverse();
    }
    Some(quad)
}

/// Returns two triangles, split along the shorter diagonal.
fn triangles(vertices: &[Vertex], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let length = |from: u32, to: u32| {
        nalgebra::distance_squared(&vertices[from as usize].point, &vertices[to as usize].point)
    };
    match length(a, c) <= length(b, d) {
        true => [[a, b, c], [a, c, d]],
        false => [[b, c, d], [b, d, a]],
    }
}
