//! The photograph through the lens, and the same undistorted by the reader's guess.

use super::model::{Edge, LensBend, SHARP_SIZE, SIZE, camera, intrinsics, pixel, ray};
use crate::canvas::{Canvas, Place, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::photo::Photo;
use crate::kit::scenes::still_life;
use crate::theme::Role;
use epipole::camera::Distortion;
use epipole::stereo::PixelMap;
use image::RgbImage;
use nalgebra::Point2;

/// Maximum height of a photograph, CSS pixels.
const TALLEST: f64 = 430.0;
/// Spacing of the exact positions between which the lens is interpolated, pixels.
const NODE: u32 = 8;

/// Draws [`LensBend`].
#[derive(Default)]
pub(crate) struct LensBendView {
    photo: Photo,
    /// Number of finished slices of the sharp photograph.
    num_slices: u32,
    taken: Option<(Distortion, u32, RgbImage)>,
}

impl LensBendView {
    /// Returns the photograph through the lens.
    fn taken(&mut self, model: &LensBend) -> Option<&RgbImage> {
        let (lens, num_slices) = (model.lens(), self.num_slices);
        let kept = self.taken.take();
        let kept = kept.filter(|(of, at, _)| (*of, *at) == (lens, num_slices));
        let image = match kept {
            Some((.., image)) => image,
            None => {
                let (scene, camera) = (still_life(), camera(SHARP_SIZE));
                let sharp = self.photo.picture(&scene, &camera, [0.0; 3], SHARP_SIZE);
                through(&lens).ok()?.warp(sharp.ok()?, &mut ()).ok()?
            }
        };
        Some(&self.taken.insert((lens, num_slices, image)).2)
    }
}

impl View for LensBendView {
    type Model = LensBend;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &LensBend, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let [taken, corrected] = match grid::is_narrow(width) {
            true => [grid.row([aspect], 158.0), grid.row([aspect], 158.0)].map(|[cell]| cell),
            false => grid.row([aspect; 2], TALLEST),
        };
        grid.layout(vec![
            Panel::photograph("taken", taken, SIZE),
            Panel::photograph("corrected", corrected, SIZE),
        ])
    }

    fn photograph(&mut self, model: &LensBend, panel: &str) -> Option<RgbImage> {
        let taken = self.taken(model)?;
        match panel {
            "taken" => Some(taken.clone()),
            "corrected" => straightened(&model.guess(), taken).ok(),
            _ => None,
        }
    }

    fn draw(&mut self, model: &LensBend, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 2] = [
            ("taken", &["Through the lens"]),
            ("corrected", &["Corrected by your numbers", "Corrected"]),
        ];
        let panels = grid::open_all(canvas, layout, titles);
        let [taken, corrected] = panels;
        if let Some(image) = self.taken(model) {
            canvas.photograph(taken.rect, image);
            if let Ok(straight) = straightened(&model.guess(), image) {
                canvas.photograph(corrected.rect, &straight);
            }
        }
        for (panel, edges) in [(taken, model.bent()), (corrected, model.corrected())] {
            canvas.clipped(panel.rect.inset(1.0), |canvas| {
                draw_edges(canvas, panel, &edges)
            });
        }
    }

    fn prepare(&mut self, _: &LensBend) -> bool {
        (self.photo).prepare(&still_life(), &camera(SHARP_SIZE), [0.0; 3], SHARP_SIZE)
    }

    fn refine(&mut self, _: &LensBend) -> bool {
        let camera = camera(SHARP_SIZE);
        let is_working = (self.photo).refine(&still_life(), &camera, [0.0; 3], SHARP_SIZE);
        self.num_slices += u32::from(is_working);
        is_working
    }
}

/// Returns the map from the sharp photograph to that through the lens.
fn through(lens: &Distortion) -> epipole::Result<PixelMap> {
    let (width, height) = SIZE;
    let nodes = [width.div_ceil(NODE) + 1, height.div_ceil(NODE) + 1];
    let [of_seen, of_sharp] = [intrinsics(SIZE), intrinsics(SHARP_SIZE)];
    let mut exact = Vec::new();
    for row in 0..nodes[1] {
        for column in 0..nodes[0] {
            let seen = Point2::new(f64::from(column * NODE), f64::from(row * NODE));
            let straight = lens.undistort(&ray(&seen, &of_seen));
            exact.push(straight.ok().map(|ray| pixel(&ray, &of_sharp)));
        }
    }
    let at = |column: u32, row: u32| exact[(row * nodes[0] + column) as usize];
    let source = |u: u32, v: u32| {
        let (column, row) = (u / NODE, v / NODE);
        let [across, down] = [u, v].map(|place| f64::from(place % NODE) / f64::from(NODE));
        let between = |from: Option<Point2<f64>>, to: Option<Point2<f64>>, share: f64| {
            Some(Point2::from(from?.coords.lerp(&to?.coords, share)))
        };
        let upper = between(at(column, row), at(column + 1, row), across);
        let lower = between(at(column, row + 1), at(column + 1, row + 1), across);
        between(upper, lower, down)
    };
    PixelMap::from_fn(width, height, source, &mut ())
}

/// Returns the photograph undistorted.
fn straightened(guess: &Distortion, taken: &RgbImage) -> epipole::Result<RgbImage> {
    let (width, height) = SIZE;
    let intrinsics = intrinsics(SIZE);
    let source = |u, v| {
        let straight = ray(&Point2::new(f64::from(u), f64::from(v)), &intrinsics);
        Some(pixel(&guess.distort(&straight), &intrinsics))
    };
    PixelMap::from_fn(width, height, source, &mut ())?.warp(taken, &mut ())
}

/// Draws edges, each with the straight line through its ends.
fn draw_edges(canvas: &mut Canvas, panel: &Panel, edges: &[Edge]) {
    for Edge(points) in edges {
        let places: Vec<Place> = points.iter().map(|point| panel.place_of(point)).collect();
        if let (Some(first), Some(last)) = (places.first(), places.last()) {
            let chord = Stroke::solid(Role::Ink, 1.25).dashed().cased();
            canvas.line(*first, *last, chord);
        }
        canvas.polyline(&places, Stroke::solid(Role::Outlier, 2.0).cased());
    }
}
