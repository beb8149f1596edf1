//! Markers, drawn from shapes that are covered once.
//!
//! A figure shows hundreds of a few kinds of markers. Each kind is covered once for a quarter of a
//! pixel both ways and then only blended. What is kept changes no pixel: a marker is the same
//! whenever it is made.

use super::coverage::Coverage;
use super::stamp::{STEPS, Stamp, pixel_and_step};
use super::strokes::{At, Cap};
use super::{Canvas, Place, Shape};
use crate::theme::Role;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Shapes kept before all are forgotten: a page that is zoomed needs new ones each time.
const MOST_KEPT: usize = 1024;
/// A larger marker is not drawn, device pixels: nobody asks for one.
const LARGEST: f64 = 200.0;

thread_local! {
    static KEPT: RefCell<BTreeMap<Key, Stamp>> = const { RefCell::new(BTreeMap::new()) };
}

/// What a marker looks like, in device pixels.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    shape: Shape,
    /// Bits of half the size.
    radius: u32,
    /// Bits of the outline's width; 0 for the filled shape.
    width: u32,
    /// Place within the pixel, in steps.
    step: (u8, u8),
}

/// Draws a shape, or its outline if `width` is not 0; everything in CSS pixels.
pub(super) fn draw(
    canvas: &mut Canvas,
    (x, y): Place,
    radius: f64,
    shape: Shape,
    width: f64,
    role: Role,
) {
    let scale = canvas.scale;
    let (x, y, radius, width) = (x * scale, y * scale, radius * scale, width * scale);
    if !(x.is_finite() && y.is_finite() && radius + width < LARGEST) {
        return;
    }
    let ((x, step_x), (y, step_y)) = (pixel_and_step(x), pixel_and_step(y));
    let key = Key {
        shape,
        radius: (radius as f32).to_bits(),
        width: (width as f32).to_bits(),
        step: (step_x, step_y),
    };
    let color = canvas.theme.color(role);
    KEPT.with_borrow_mut(|kept| {
        if kept.len() > MOST_KEPT {
            kept.clear();
        }
        let stamp = kept.entry(key).or_insert_with(|| cover(key));
        stamp.blend(&mut canvas.pixmap, (x, y), color);
    });
}

fn cover(key: Key) -> Stamp {
    let (radius, width) = (f32::from_bits(key.radius), f32::from_bits(key.width));
    // Corners reach farther than the radius, and strokes half their width farther.
    let margin = (1.3 * radius + 0.5 * width).ceil() as i32 + 2;
    let side = 2 * margin as usize + 1;
    let middle = |step: u8| margin as f32 + f32::from(step) / STEPS as f32;
    let center = (middle(key.step.0), middle(key.step.1));
    let mut coverage = Coverage::default().sized(side, side);
    let corners = corners(center, radius, key.shape);
    match (key.shape, corners.as_slice()) {
        (Shape::Disk, _) if width == 0.0 => coverage.add_disk(center, radius),
        (Shape::Disk | Shape::Ring, _) => coverage.add_ring(center, radius, width),
        (Shape::Cross | Shape::Plus, &[a, b, c, d]) => {
            coverage.add_segment(a, c, width, Cap::Round);
            coverage.add_segment(b, d, width, Cap::Round);
        }
        (_, corners) if width == 0.0 => coverage.add_polygon(corners),
        (_, corners) => {
            for (&from, &to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                coverage.add_segment(from, to, width, Cap::Round);
            }
        }
    }
    Stamp {
        left: -margin,
        top: -margin,
        width: side,
        alpha: coverage.into_alpha(),
    }
}

/// The corners of a shape in turn; none for those that are round.
fn corners((x, y): At, radius: f32, shape: Shape) -> Vec<At> {
    let unit: &[At] = match shape {
        Shape::Disk | Shape::Ring => &[],
        Shape::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        Shape::Diamond => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
        Shape::Triangle => &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
        Shape::Cross => &[(-0.8, -0.8), (0.8, -0.8), (0.8, 0.8), (-0.8, 0.8)],
        Shape::Plus => &[(-1.1, 0.0), (0.0, -1.1), (1.1, 0.0), (0.0, 1.1)],
    };
    unit.iter()
        .map(|&(u, v)| (x + radius * u, y + radius * v))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Picture;
    use crate::theme::Theme;

    const SHAPES: [Shape; 7] = [
        Shape::Disk,
        Shape::Ring,
        Shape::Square,
        Shape::Diamond,
        Shape::Triangle,
        Shape::Cross,
        Shape::Plus,
    ];

    fn drawn(shape: Shape, place: Place) -> Vec<u8> {
        let mut canvas = Canvas::new(40.0, 30.0, 2.0, Theme::Light, Picture::default()).unwrap();
        canvas.marker(place, 6.0, shape, Role::Ink, false);
        canvas.finish().rgba().to_vec()
    }

    #[test]
    fn a_kept_marker_is_the_same_as_a_new_one_and_lies_around_its_place() {
        let empty = drawn(Shape::Disk, (f64::NAN, 3.0));
        for shape in SHAPES {
            let first = drawn(shape, (20.1, 15.3));
            KEPT.with_borrow_mut(BTreeMap::clear);
            assert_eq!(first, drawn(shape, (20.1, 15.3)), "{shape:?}");
            assert_eq!(first, drawn(shape, (20.1, 15.3)), "{shape:?}");
            let covered = first.chunks(4).zip(empty.chunks(4)).enumerate();
            let covered: Vec<usize> = covered
                .filter(|(_, (a, b))| a != b)
                .map(|(k, _)| k)
                .collect();
            let mean = |pick: fn(usize) -> usize| {
                covered.iter().map(|&k| pick(k) as f64).sum::<f64>() / covered.len() as f64 + 0.5
            };
            let (x, y) = (mean(|k| k % 80), mean(|k| k / 80));
            // The middle of a triangle is below that of its circle.
            let below = if shape == Shape::Triangle { 1.6 } else { 0.0 };
            let off = (x - 40.2, y - 30.6 - below);
            assert!(off.0.abs() < 0.5 && off.1.abs() < 0.5, "{shape:?} {off:?}");
        }
    }

    #[test]
    fn markers_at_the_edge_are_cut() {
        for shape in SHAPES {
            for place in [(0.0, 0.0), (40.0, 30.0), (39.9, 0.1), (f64::INFINITY, 5.0)] {
                drawn(shape, place);
            }
        }
    }
}
