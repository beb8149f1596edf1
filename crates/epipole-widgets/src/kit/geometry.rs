//! Epipolar geometry of two cameras that photograph the book's scenes.

use crate::contract::{Mark, Symbol};
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use epipole::camera::{PosedCamera, relative_motion};
use epipole::epipolar::{
    Epipole, epipolar_line1, epipolar_line2, epipoles, essential_from_motion,
    fundamental_from_cameras,
};
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2};

/// Epipolar geometry of two cameras.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Geometry {
    pub(crate) fundamental: Matrix3<f64>,
    pub(crate) essential: Matrix3<f64>,
    pub(crate) epipole1: Epipole,
    pub(crate) epipole2: Epipole,
}

impl Geometry {
    /// Computes the geometry; `None` if both cameras have the same center.
    pub(crate) fn of([first, second]: &[PosedCamera; 2]) -> Option<Self> {
        let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
        let fundamental = fundamental_from_cameras(first, second).ok()?;
        let (epipole1, epipole2) = epipoles(&fundamental).ok()?;
        Some(Self {
            fundamental,
            essential: essential_from_motion(&motion).ok()?,
            epipole1,
            epipole2,
        })
    }

    /// Returns the epipolar line of a pixel of photograph 1; `None` also at the epipole.
    pub(crate) fn line2(&self, pixel1: &Point2<f64>) -> Option<Line2> {
        epipolar_line2(&self.fundamental, pixel1).ok()
    }

    /// Returns the epipolar line through a pixel of photograph 1, all points of which have the same
    /// line in photograph 2.
    pub(crate) fn line1(&self, pixel1: &Point2<f64>) -> Option<Line2> {
        let line2 = self.line2(pixel1)?;
        // Any point of the line in photograph 2 determines it, except for the epipole.
        let center = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) * 0.5;
        let foot = line2.nearest(&center);
        let other = Point2::new(foot.x - 500.0 * line2.b, foot.y + 500.0 * line2.a);
        let nearness = |line: &Line2| line.signed_distance(pixel1).abs();
        [foot, other]
            .iter()
            .filter_map(|pixel2| epipolar_line1(&self.fundamental, pixel2).ok())
            .min_by(|a, b| nearness(a).total_cmp(&nearness(b)))
    }
}

/// Returns the symbols of a pixel, its match, its epipolar line and the epipoles, in the panels
/// `first` and `second`.
///
/// * `pixels`: p and p′, if visible to the cameras
/// * `geometry`: `None` if both cameras have the same center
pub(crate) fn symbols(
    pixels: [Option<Point2<f64>>; 2],
    geometry: Option<&Geometry>,
) -> Vec<Symbol> {
    let finite = |epipole: &Epipole| match epipole {
        Epipole::Finite(pixel) => Some(*pixel),
        Epipole::AtInfinity(_) => None,
    };
    let [epipole1, epipole2] = geometry.map_or([None; 2], |geometry| {
        [&geometry.epipole1, &geometry.epipole2].map(finite)
    });
    let line2 = geometry.and_then(|geometry| geometry.line2(pixels[0].as_ref()?));
    let epipoles = [("e", "first", epipole1), ("e'", "second", epipole2)];
    match_symbols(pixels, line2)
        .into_iter()
        .chain(epipoles.into_iter().filter_map(point_symbol))
        .collect()
}

/// Returns the symbols of a pixel, its match and its line in the panel `second`, if they exist.
pub(crate) fn match_symbols(
    [pixel1, pixel2]: [Option<Point2<f64>>; 2],
    line2: Option<Line2>,
) -> Vec<Symbol> {
    let line2 = line2.map(|line| {
        let foot = line.nearest(&Point2::origin());
        Symbol {
            name: "ℓ'",
            panel: "second",
            mark: Mark::Line((foot.x, foot.y), (-line.b, line.a)),
        }
    });
    [("p", "first", pixel1), ("p'", "second", pixel2)]
        .into_iter()
        .filter_map(point_symbol)
        .chain(line2)
        .collect()
}

/// Returns the symbols of one of many matches, the one nearest to the center of photograph 1.
pub(crate) fn symbols_of_one(
    matches: impl Iterator<Item = [Point2<f64>; 2]>,
    (width, height): (u32, u32),
) -> Vec<Symbol> {
    let middle = Point2::new(f64::from(width), f64::from(height)) * 0.5;
    let off = |[pixel1, _]: &[Point2<f64>; 2]| (pixel1 - middle).norm_squared();
    let nearest = matches.min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map_or_else(Vec::new, |pixels| match_symbols(pixels.map(Some), None))
}

fn point_symbol(
    (name, panel, pixel): (&'static str, &'static str, Option<Point2<f64>>),
) -> Option<Symbol> {
    pixel.map(|pixel| Symbol::point(name, panel, pixel.x, pixel.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::{PHOTO_SIZE, Seen, still_life_pair};
    use epipole::epipolar::sampson_px;

    #[test]
    fn every_match_is_on_its_line() {
        for (right_m, forward_m, left_deg) in [(0.5, -0.4, 14.0), (0.1, 0.4, 0.0), (0.8, 0.0, 30.0)]
        {
            let cameras = still_life_pair(PHOTO_SIZE, right_m, forward_m, left_deg);
            let geometry = Geometry::of(&cameras).unwrap();
            for (u, v) in [(216.0, 60.0), (332.0, 130.0), (300.0, 410.0)] {
                let point = Point2::new(u, v);
                let Some(pixel2) = Seen::of(&cameras, &point).pixel() else {
                    continue;
                };
                let line = geometry.line2(&point).unwrap();
                assert!(line.signed_distance(&pixel2).abs() < 1e-6);
                assert!(sampson_px(&geometry.fundamental, &point, &pixel2) < 1e-6);
                let line1 = geometry.line1(&point).unwrap();
                assert!(line1.signed_distance(&point).abs() < 1e-6);
                // Checks with E, which constrains rays as F constrains pixels.
                let [ray1, ray2] = [
                    cameras[0].camera.intrinsics.ray(&point),
                    cameras[1].camera.intrinsics.ray(&pixel2),
                ];
                assert!(ray2.dot(&(geometry.essential * ray1)).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_epipole_is_camera_1_seen_by_camera_2() {
        let cameras = still_life_pair(PHOTO_SIZE, 0.5, -0.4, 14.0);
        let seen = cameras[1].project(&cameras[0].center_in_world()).unwrap();
        let Epipole::Finite(pixel) = Geometry::of(&cameras).unwrap().epipole2 else {
            panic!("it is finite");
        };
        assert!((pixel - seen).norm() < 1e-6);
    }

    #[test]
    fn a_match_lies_on_the_line_of_its_letter_and_what_is_nowhere_has_none() {
        let cameras = still_life_pair((PHOTO_WIDTH, PHOTO_HEIGHT), 0.2, 0.3, 4.0);
        let geometry = Geometry::of(&cameras).unwrap();
        let pixel1 = Point2::new(200.0, 150.0);
        let on_line = geometry.line2(&pixel1).unwrap();
        let pixel2 = on_line.nearest(&Point2::new(300.0, 200.0));
        let found = symbols([Some(pixel1), Some(pixel2)], Some(&geometry));
        let names: Vec<_> = found.iter().map(|symbol| symbol.name).collect();
        assert_eq!(names, ["p", "p'", "ℓ'", "e", "e'"]);
        let Mark::Line(start, direction) = found[2].mark else {
            panic!("{:?}", found[2]);
        };
        let (dx, dy) = (pixel2.x - start.0, pixel2.y - start.1);
        assert!((dx * direction.1 - dy * direction.0).abs() < 1e-6);
        let alone = symbols([Some(pixel1), None], None);
        assert_eq!(alone, [Symbol::point("p", "first", 200.0, 150.0)]);
        assert!(symbols([None; 2], None).is_empty());
    }

    #[test]
    fn of_many_matches_the_one_in_the_middle_has_the_letters() {
        let pair = |u, v| [Point2::new(u, v), Point2::new(u + 9.0, v)];
        let all = [pair(10.0, 10.0), pair(60.0, 45.0), pair(90.0, 95.0)];
        let found = symbols_of_one(all.into_iter(), (100, 100));
        let expected = [
            Symbol::point("p", "first", 60.0, 45.0),
            Symbol::point("p'", "second", 69.0, 45.0),
        ];
        assert_eq!(found, expected);
        assert!(symbols_of_one(std::iter::empty(), (100, 100)).is_empty());
    }
}
