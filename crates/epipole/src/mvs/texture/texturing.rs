//! Texturing of a mesh.

use super::super::mesh::Mesh;
use super::super::views::{MvsView, check_views};
use super::charts::{Chart, PADDING, charts, pack};
use super::leveling::{color_at, offsets};
use super::mesh_texture::MeshTexture;
use super::options::TextureOptions;
use super::raster::for_each_pixel;
use super::{adjacency, labels, visibility};
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};
use image::{Rgb, RgbImage, imageops};
use nalgebra::{Point2, Vector2, Vector3};

/// Progress when the views of triangles are known, when they are chosen, and when colors agree.
const LEAST_VISIBLE: f32 = 0.5;
const CHOSEN: f32 = 0.6;
const LEVELED: f32 = 0.75;
/// Sides of the patch of triangles that no photo shows, pixels.
const UNSEEN: u32 = 1 + 2 * PADDING;

/// Textures a mesh with the photos: each triangle takes the photo that shows it largest, with few
/// seams, and colors are adjusted to agree along seams.
///
/// * `mesh`: from [`mesh_depth_maps`](crate::mvs::mesh_depth_maps)
/// * `views`: photos without distortion, from [`prepare_views`](crate::mvs::prepare_views); those
///   of the depth maps, or of the same cameras at another size
/// * `monitor`: the only stage is [`Stage::Blending`](crate::progress::Stage::Blending)
///
/// Triangles that no photo shows get the photo of a neighbor, or the mean color of the mesh.
///
/// # Errors
/// [`Error::OutOfRange`] for an option outside its range, an index of a vertex that does not exist,
/// and a mesh with more pieces than fit into the image; [`Error::TooFew`] for no views or no
/// triangles; [`Error::SizeMismatch`] and [`Error::Degenerate`] for views as in
/// [`estimate_depth_maps`](crate::mvs::estimate_depth_maps); [`Error::Canceled`].
///
/// Source: Waechter, Moehrle & Goesele 2014, "Let there be color! Large-scale texturing of 3D
/// reconstructions", without its test of photo-consistency and its local adjustment.
#[doc(alias = "texrecon")]
#[doc(alias = "mesh_texturer")]
pub fn texture_mesh(
    mesh: &Mesh,
    views: &[MvsView],
    options: &TextureOptions,
    monitor: &mut dyn Monitor,
) -> Result<MeshTexture> {
    options.check()?;
    check_views(views)?;
    check_mesh(mesh, views)?;
    let across = adjacency::neighbors(&mesh.triangles);
    let candidates =
        visibility::candidates(mesh, views, &mut Part::new(monitor, 0.0, LEAST_VISIBLE))?;
    let part = &mut Part::new(monitor, LEAST_VISIBLE, CHOSEN);
    let labels = labels::choose(mesh, views, &candidates, &across, options.seam_cost, part)?;
    let mut charts = charts(mesh, views, &across, &labels);
    let (size, scale) = pack(&mut charts, options.max_size_px - UNSEEN)?;
    let part = &mut Part::new(monitor, CHOSEN, LEVELED);
    let offsets = offsets(mesh, views, &across, &charts, part)?;
    let part = &mut Part::new(monitor, LEVELED, 1.0);
    let indices: Vec<usize> = (0..charts.len()).collect();
    let patches = monitored::map(&indices, Stage::Blending, part, |&index| {
        let chart = &charts[index];
        patch(&views[chart.view].image, chart, &offsets[index], scale)
    })?;
    let (width, height) = (size[0].max(UNSEEN), size[1] + UNSEEN);
    let mut image = RgbImage::new(width, height);
    let unseen = f32::from(PADDING as u16);
    let at = Point2::new(unseen, size[1] as f32 + unseen);
    let mut corners = vec![[at; 3]; mesh.triangles.len()];
    let gray = RgbImage::from_pixel(UNSEEN, UNSEEN, mean_color(mesh));
    imageops::replace(&mut image, &gray, 0, i64::from(size[1]));
    for (chart, patch) in charts.iter().zip(&patches) {
        let [column, row] = chart.place;
        imageops::replace(&mut image, patch, i64::from(column), i64::from(row));
        let place = Vector2::new(f64::from(column), f64::from(row));
        for (&triangle, pixels) in chart.triangles.iter().zip(&chart.pixels) {
            let in_image = pixels
                .each_ref()
                .map(|pixel| chart.in_chart(pixel, scale) + place);
            corners[triangle] = in_image.map(|pixel| pixel.cast());
        }
    }
    Ok(MeshTexture { image, corners })
}

fn check_mesh(mesh: &Mesh, views: &[MvsView]) -> Result<()> {
    for (what, got) in [
        ("a texture from photos", views.len()),
        ("a texture of triangles", mesh.triangles.len()),
    ] {
        if got == 0 {
            return Err(Error::TooFew {
                what,
                needed: 1,
                got,
            });
        }
    }
    let last = mesh
        .triangles
        .as_flattened()
        .iter()
        .max()
        .copied()
        .unwrap_or(0);
    Error::check_rules(&[(
        "the index of a vertex",
        "that of a point of the mesh",
        f64::from(last),
        (last as usize) < mesh.vertices.points.len(),
    )])
}

/// Returns the mean color of the vertices; gray without colors.
fn mean_color(mesh: &Mesh) -> Rgb<u8> {
    let colors = &mesh.vertices.colors;
    let sum = |channel: usize| {
        colors
            .iter()
            .map(|color| u64::from(color[channel]))
            .sum::<u64>()
    };
    match colors.len() as u64 {
        0 => Rgb([128; 3]),
        count => Rgb([0, 1, 2].map(|channel| (sum(channel) / count) as u8)),
    }
}

/// Returns the pixels of a piece: the photo plus the offsets, which continue into the padding.
fn patch(photo: &RgbImage, chart: &Chart, offsets: &[[Vector3<f64>; 3]], scale: f64) -> RgbImage {
    let [width, height] = chart.size;
    let mut known: Vec<Option<Vector3<f64>>> = vec![None; width as usize * height as usize];
    for (pixels, offsets) in chart.pixels.iter().zip(offsets) {
        let corners = pixels.each_ref().map(|pixel| chart.in_chart(pixel, scale));
        for_each_pixel(&corners, (width, height), |u, v, weights| {
            let offset = (0..3).fold(Vector3::zeros(), |sum, n| sum + offsets[n] * weights[n]);
            known[(v * width + u) as usize] = Some(offset);
        });
        // Small triangles contain no pixel center.
        for (corner, offset) in corners.iter().zip(offsets) {
            let (u, v) = (corner.x.round() as u32, corner.y.round() as u32);
            let place = (v.min(height - 1) * width + u.min(width - 1)) as usize;
            known[place].get_or_insert(*offset);
        }
    }
    for _ in 0..=PADDING {
        known = grow_colors(&known, width as usize);
    }
    RgbImage::from_fn(width, height, |u, v| {
        match known[(v * width + u) as usize] {
            None => Rgb([0; 3]),
            Some(offset) => {
                let color = color_at(photo, &chart.in_photo(u, v, scale)) + offset;
                Rgb([color.x, color.y, color.z].map(|level| level.round().clamp(0.0, 255.0) as u8))
            }
        }
    })
}

/// Extends offsets to the neighbors of known pixels, by their means.
fn grow_colors(known: &[Option<Vector3<f64>>], width: usize) -> Vec<Option<Vector3<f64>>> {
    let height = known.len() / width.max(1);
    let mut grown = known.to_vec();
    for v in 0..height {
        for u in 0..width {
            if known[v * width + u].is_some() {
                continue;
            }
            let (mut sum, mut count) = (Vector3::zeros(), 0);
            for v in v.saturating_sub(1)..(v + 2).min(height) {
                for u in u.saturating_sub(1)..(u + 2).min(width) {
                    if let Some(offset) = known[v * width + u] {
                        (sum, count) = (sum + offset, count + 1);
                    }
                }
            }
            if count > 0 {
                grown[v * width + u] = Some(sum / f64::from(count));
            }
        }
    }
    grown
}
