//! Screenshots of the panels without a graphics card: the toolkit's triangles, rasterized on the
//! CPU.

use super::desk::{Bench, Desk};
use egui::epaint::{ImageData, Mesh, Primitive, TextureId, Vertex};
use egui::{Color32, ColorImage, Pos2, Rect, TextureFilter, TextureOptions, TexturesDelta};
use egui_kittest::TestRenderer;
use epipole_lab::app::{App, prepare};
use image::{Rgb, RgbImage};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

type Textures = HashMap<TextureId, (ColorImage, TextureOptions)>;

/// All textures that the toolkit has loaded.
#[derive(Clone, Default)]
pub(crate) struct Raster(Rc<RefCell<Textures>>);

impl TestRenderer for Raster {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut textures = self.0.borrow_mut();
        for (id, deltas) in delta.set.drain() {
            for delta in deltas {
                let ImageData::Color(image) = delta.image;
                match (delta.pos, textures.get_mut(&id)) {
                    (Some([left, top]), Some((whole, _))) => {
                        for (row, pixels) in image.pixels.chunks(image.size[0]).enumerate() {
                            let first = (top + row) * whole.size[0] + left;
                            whole.pixels[first..first + pixels.len()].copy_from_slice(pixels);
                        }
                    }
                    _ => drop(textures.insert(id, ((*image).clone(), delta.options))),
                }
            }
        }
        for id in delta.free.drain() {
            textures.remove(&id);
        }
    }
}

/// The Lab on a screen of this size in points, for screenshots.
pub(crate) fn open<'a>(width: f32, height: f32, scale: f32) -> (Bench<'a>, Raster) {
    let raster = Raster::default();
    let frame = |ui: &mut egui::Ui, app: &mut App<Desk>| {
        app.advance();
        app.ui(ui);
    };
    let bench = egui_kittest::Harness::builder()
        .with_size(egui::vec2(width, height))
        .with_pixels_per_point(scale)
        .with_context_setup(prepare)
        .renderer(raster.clone())
        .build_ui_state(frame, App::new(Desk::default()));
    (bench, raster)
}

/// Colored triangles on white, in an image of this size.
pub(crate) fn of(mesh: &Mesh, width: u32, height: u32) -> RgbImage {
    let mut picture = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let plain = ColorImage::filled([1, 1], Color32::WHITE);
    let texture = (plain, TextureOptions::NEAREST);
    fill(&mut picture, mesh, &texture, Rect::EVERYTHING, 1.0);
    picture
}

impl Raster {
    /// Screenshot of the current frame.
    pub(crate) fn picture(&self, bench: &Bench<'_>) -> RgbImage {
        let (context, output) = (&bench.ctx, bench.output());
        let scale = output.pixels_per_point;
        let size = context.content_rect().size() * scale;
        let (width, height) = (size.x.round() as u32, size.y.round() as u32);
        let mut picture = RgbImage::from_pixel(width, height, Rgb([255; 3]));
        let textures = self.0.borrow();
        for clipped in context.tessellate(output.shapes.clone(), scale) {
            if let Primitive::Mesh(mesh) = clipped.primitive {
                let clip = Rect::from_min_max(
                    (clipped.clip_rect.min.to_vec2() * scale).to_pos2(),
                    (clipped.clip_rect.max.to_vec2() * scale).to_pos2(),
                );
                let texture = textures.get(&mesh.texture_id).expect("it was loaded");
                fill(&mut picture, &mesh, texture, clip, scale);
            }
        }
        picture
    }
}

/// Twice the area of the triangle, positive where the corners go round with the clock on the
/// screen.
fn area(a: Pos2, b: Pos2, c: Pos2) -> f32 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether pixels on the edge itself are within: of two triangles that share an edge, one has them.
fn owns_edge(a: Pos2, b: Pos2) -> bool {
    b.y < a.y || (b.y == a.y && b.x > a.x)
}

fn fill(
    picture: &mut RgbImage,
    mesh: &Mesh,
    texture: &(ColorImage, TextureOptions),
    clip: Rect,
    scale: f32,
) {
    let bounds = clip.intersect(Rect::from_min_size(
        Pos2::ZERO,
        egui::vec2(picture.width() as f32, picture.height() as f32),
    ));
    for corners in mesh.indices.chunks_exact(3) {
        let [a, mut b, mut c] = [0, 1, 2].map(|n| mesh.vertices[corners[n] as usize]);
        for vertex in [&mut b, &mut c] {
            vertex.pos = (vertex.pos.to_vec2() * scale).to_pos2();
        }
        let a = Vertex {
            pos: (a.pos.to_vec2() * scale).to_pos2(),
            ..a
        };
        if area(a.pos, b.pos, c.pos) < 0.0 {
            std::mem::swap(&mut b, &mut c);
        }
        let whole = area(a.pos, b.pos, c.pos);
        if whole <= 0.0 {
            continue;
        }
        let mut place = Rect::from_points(&[a.pos, b.pos, c.pos]);
        place = place.intersect(bounds);
        if !place.is_positive() {
            continue;
        }
        let edges = [(b.pos, c.pos), (c.pos, a.pos), (a.pos, b.pos)];
        for row in place.top().floor() as u32..place.bottom().ceil() as u32 {
            for column in place.left().floor() as u32..place.right().ceil() as u32 {
                let at = Pos2::new(column as f32 + 0.5, row as f32 + 0.5);
                if !bounds.contains(at) || column >= picture.width() || row >= picture.height() {
                    continue;
                }
                let shares = edges.map(|(from, to)| area(from, to, at));
                let within = shares.iter().zip(&edges).all(|(share, (from, to))| {
                    *share > 0.0 || (*share == 0.0 && owns_edge(*from, *to))
                });
                if within {
                    let shares = shares.map(|share| share / whole);
                    paint(picture, [column, row], [&a, &b, &c], shares, texture);
                }
            }
        }
    }
}

fn paint(
    picture: &mut RgbImage,
    [column, row]: [u32; 2],
    corners: [&Vertex; 3],
    shares: [f32; 3],
    texture: &(ColorImage, TextureOptions),
) {
    let mut uv = egui::Vec2::ZERO;
    let mut tint = [0.0_f32; 4];
    for (corner, share) in corners.into_iter().zip(shares) {
        uv += share * corner.uv.to_vec2();
        for (sum, value) in tint.iter_mut().zip(corner.color.to_array()) {
            *sum += share * f32::from(value) / 255.0;
        }
    }
    let texel = sample(&texture.0, texture.1, uv);
    let color: Vec<f32> = texel.iter().zip(tint).map(|(a, b)| a * b).collect();
    let Rgb(before) = *picture.get_pixel(column, row);
    let mut after = before;
    for (value, color_of) in after.iter_mut().zip(&color) {
        // Colors are multiplied with their opacity already.
        let under = f32::from(*value) / 255.0 * (1.0 - color[3]);
        *value = ((color_of + under) * 255.0).round().clamp(0.0, 255.0) as u8;
    }
    picture.put_pixel(column, row, Rgb(after));
}

fn sample(image: &ColorImage, options: TextureOptions, uv: egui::Vec2) -> [f32; 4] {
    let [width, height] = image.size.map(|side| side as i64);
    let texel = |x: i64, y: i64| -> [f32; 4] {
        let (x, y) = (x.clamp(0, width - 1), y.clamp(0, height - 1));
        let color: Color32 = image.pixels[(y * width + x) as usize];
        color.to_array().map(|value| f32::from(value) / 255.0)
    };
    let (x, y) = (uv.x * width as f32, uv.y * height as f32);
    if options.magnification == TextureFilter::Nearest {
        return texel(x.floor() as i64, y.floor() as i64);
    }
    let (x, y) = (x - 0.5, y - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let (right, down) = (x - left, y - top);
    let mut sum = [0.0; 4];
    for (dx, dy, share) in [
        (0, 0, (1.0 - right) * (1.0 - down)),
        (1, 0, right * (1.0 - down)),
        (0, 1, (1.0 - right) * down),
        (1, 1, right * down),
    ] {
        let color = texel(left as i64 + dx, top as i64 + dy);
        for (total, value) in sum.iter_mut().zip(color) {
            *total += share * value;
        }
    }
    sum
}
