//! A custom robust estimator in thirty lines: a circle among points that are on none.

use epipole::math::random::Random;
use epipole::prelude::*;
use epipole::robust::{Data, Problem};

struct Circles(Vec<Point2<f64>>);

impl Circles {
    /// Linear least squares of `x² + y² = 2 cx x + 2 cy y + r² − cx² − cy²` (Kåsa 1976).
    fn fit(&self, points: &[usize]) -> Option<(Point2<f64>, f64)> {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for p in points.iter().map(|&i| self.0[i]) {
            let row = Vector3::new(2.0 * p.x, 2.0 * p.y, 1.0);
            normal += row * row.transpose();
            right += row * p.coords.norm_squared();
        }
        let [cx, cy, rest] = (normal.try_inverse()? * right).into();
        let radius = (rest + cx * cx + cy * cy).sqrt();
        radius.is_finite().then_some((Point2::new(cx, cy), radius))
    }
}

#[rustfmt::skip]
impl Estimator for Circles {
    type Model = (Point2<f64>, f64); // center and radius, pixels
    fn problem(&self) -> Problem<'_> {
        Problem { name: "a circle from points", sample_size: 3, max_models: 1, codimension: 1, data: Data::Other(self.0.len()) }
    }
    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        models.extend(self.fit(sample));
    }
    fn error_sq(&self, (center, radius): &Self::Model, index: usize) -> f64 {
        let distance = (self.0[index] - center).norm() - radius;
        distance * distance
    }
    fn refine(&mut self, _: &Self::Model, inliers: &[usize], _: f64) -> Option<Self::Model> {
        self.fit(inliers)
    }
}

pub(crate) fn run() -> Result<(), Error> {
    let mut random = Random::new(1);
    let on_circle = |i: i32| {
        let rotation = epipole::nalgebra::Rotation2::new(0.1 * f64::from(i));
        Point2::new(300.0, 200.0) + rotation * Vector2::new(90.0, 0.0)
    };
    let mut points: Vec<_> = (0..60).map(on_circle).collect();
    let anywhere = |_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
    points.extend((0..60).map(anywhere));
    let found = ransac(Circles(points), &RansacOptions::default(), &mut ())?;
    let (center, radius) = found.model;
    println!("{} around {center}", found.num_inliers);
    assert!((center - Point2::new(300.0, 200.0)).norm() + (radius - 90.0).abs() < 0.5);
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
#[rustfmt::skip]
fn main() -> Result<(), Error> { run() }
