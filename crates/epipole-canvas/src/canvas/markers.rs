//! Markers, drawn from cached shapes.
//!
//! A figure shows hundreds of markers of a few kinds. Each kind is covered once per quarter pixel
//! in both directions, and then only blended.

use super::coverage::Coverage;
use super::place::At;
use super::stamp::{STEPS, Stamp, StampCache, pixel_and_step, stamp_width};
use super::strokes::Cap;
use super::{Canvas, Place, Shape};
use crate::theme::{Rgb, Role};
use std::cell::RefCell;

/// Radius from which markers are not cached, device pixels.
const LARGE: f32 = 64.0;

thread_local! {
    static CACHE: RefCell<StampCache<Key>> = const { RefCell::new(StampCache::new()) };
}

/// Cache key of a marker, in device pixels.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    shape: Shape,
    /// Bits of half the size.
    radius: u32,
    /// Bits of the outline's width; 0 for the filled shape.
    width: u32,
    /// Subpixel position, in steps.
    step: (u8, u8),
    /// Whether it is a disk with a rim; `width` then holds the bits of the rim's radius.
    is_dot: bool,
}

/// Transparency of a dot's rim, of 256.
const RIM_SEE_THROUGH: u16 = 115;
/// Width of a dot's rim, CSS pixels.
const RIM: f64 = 0.7;
/// Size step of cached dots, device pixels, since a cloud has as many sizes as depths.
const DOT_STEP: f64 = 0.125;

/// Draws a shape, or its outline if `width` is not 0. All arguments are in CSS pixels.
pub(super) fn draw(
    canvas: &mut Canvas,
    (x, y): Place,
    radius: f64,
    shape: Shape,
    width: f64,
    role: Role,
) {
    let scale = canvas.scale;
    let (radius, width) = ((radius * scale) as f32, (width * scale) as f32);
    if !(x.is_finite() && y.is_finite() && radius.is_finite() && width.is_finite()) {
        return;
    }
    if radius + width > LARGE {
        let center = canvas.device((x, y));
        canvas.cover(role, 1.0, |coverage| {
            add(coverage, center, radius, shape, width)
        });
        return;
    }
    let ((x, step_x), (y, step_y)) = (pixel_and_step(x * scale), pixel_and_step(y * scale));
    let key = Key {
        shape,
        radius: radius.to_bits(),
        width: width.to_bits(),
        step: (step_x, step_y),
        is_dot: false,
    };
    let color = canvas.theme.color(role);
    CACHE.with_borrow_mut(|cache| {
        cache
            .stamp(key, cover)
            .blend(&mut canvas.pixmap, (x, y), color);
    });
}

/// Draws a disk with a rim of the theme. All arguments are in CSS pixels.
pub(super) fn draw_dot(canvas: &mut Canvas, (x, y): Place, radius: f64, color: Rgb) {
    let scale = canvas.scale;
    let ((x, step_x), (y, step_y)) = (pixel_and_step(x * scale), pixel_and_step(y * scale));
    let rounded = |radius: f64| ((radius * scale / DOT_STEP).round() * DOT_STEP) as f32;
    let key = Key {
        shape: Shape::Disk,
        radius: rounded(radius).to_bits(),
        width: rounded(radius + RIM).to_bits(),
        step: (step_x, step_y),
        is_dot: true,
    };
    let rim = canvas.theme.color(Role::Muted);
    CACHE.with_borrow_mut(|rounded| {
        rounded
            .stamp(key, cover)
            .blend_both(&mut canvas.pixmap, (x, y), [rim, color]);
    });
}

fn cover(key: Key) -> Stamp {
    let (radius, width) = (f32::from_bits(key.radius), f32::from_bits(key.width));
    if !key.is_dot {
        return stamp(key, radius, width, 256);
    }
    // The rim shows where it is wider than the disk.
    let rim = stamp(key, width, 0.0, 256 - RIM_SEE_THROUGH);
    rim.bearing(&stamp(key, radius, 0.0, 256))
}

/// * `opacity`: of 256
fn stamp(key: Key, radius: f32, width: f32, opacity: u16) -> Stamp {
    // Corners reach farther than the radius, and strokes half their width farther.
    let margin = (1.3 * radius + 0.5 * width).ceil() as i32 + 2;
    let side = 2 * margin as usize + 1;
    let middle = |step: u8| margin as f32 + f32::from(step) / STEPS as f32;
    let center = (middle(key.step.0), middle(key.step.1));
    let stride = stamp_width(side);
    let mut coverage = Coverage::default().sized(stride, side);
    add(&mut coverage, center, radius, key.shape, width);
    let mut alpha = coverage.into_alpha();
    if opacity < 256 {
        for alpha in &mut alpha {
            *alpha = ((u16::from(*alpha) * opacity + 128) >> 8) as u8;
        }
    }
    Stamp::trimmed((-margin, -margin), stride, &alpha)
}

/// Covers a shape, or its outline if `width` is not 0. All arguments are in device pixels.
fn add(coverage: &mut Coverage, center: At, radius: f32, shape: Shape, width: f32) {
    let corners = corners(center, radius, shape);
    match (shape, corners.as_slice()) {
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
}

/// Returns the corners of a shape in order; none for round shapes.
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
    fn a_cached_marker_equals_a_new_one_and_is_around_its_place() {
        let empty = drawn(Shape::Disk, (f64::NAN, 3.0));
        for shape in SHAPES {
            let first = drawn(shape, (20.1, 15.3));
            CACHE.with_borrow_mut(StampCache::forget);
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
    fn a_large_marker_is_drawn_as_well() {
        let inked = |radius: f64| {
            let mut canvas =
                Canvas::new(300.0, 300.0, 1.0, Theme::Light, Picture::default()).unwrap();
            canvas.marker((150.0, 150.0), radius, Shape::Diamond, Role::Ink, false);
            let picture = canvas.finish();
            let paper = picture.rgba()[0];
            picture
                .rgba()
                .chunks(4)
                .filter(|pixel| pixel[0] != paper)
                .count() as f64
        };
        for radius in [30.0, 100.0] {
            let area = 2.0 * (1.2 * radius) * (1.2 * radius);
            assert!((inked(radius) / area - 1.0).abs() < 0.05, "{radius}");
        }
    }

    #[test]
    fn a_dot_is_a_disk_of_its_color_in_a_rim_that_lets_the_ground_through() {
        let mut canvas = Canvas::new(20.0, 20.0, 2.0, Theme::Light, Picture::default()).unwrap();
        let paper = Theme::Light.color(Role::Background);
        let rim = Theme::Light.color(Role::Muted);
        canvas.dot((10.25, 10.25), 3.0, [200, 30, 40]);
        for place in [(f64::NAN, 3.0), (3.0, f64::INFINITY), (30.0, 3.0)] {
            canvas.dot(place, 3.0, [0, 0, 0]);
        }
        canvas.dot((1.0, 1.0), f64::NAN, [0, 0, 0]);
        let picture = canvas.finish();
        let at = |x: usize, y: usize| &picture.rgba()[4 * (40 * y + x)..][..3];
        assert_eq!(at(20, 20), [200, 30, 40]);
        assert_eq!(at(25, 20), [200, 30, 40]);
        assert_eq!(at(29, 20), paper);
        assert_eq!(at(2, 2), paper);
        let (mixed, expected) = (
            at(27, 20)[0],
            (paper[0] as f64 * 115.0 + rim[0] as f64 * 141.0) / 256.0,
        );
        let between = (paper[0].min(rim[0])..=paper[0].max(rim[0])).contains(&mixed);
        assert!(
            between && mixed != paper[0] && f64::from(mixed) >= expected - 2.0,
            "{mixed} {expected}"
        );
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
