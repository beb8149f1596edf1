//! Initial points for robust triangulation.

use super::midpoint::triangulate_weighted_midpoint;
use super::nview_problem::Problem;
use crate::camera::relative_motion;
use crate::optim::FixedProblem;
use crate::{Error, Result};
use nalgebra::Point3;

/// Maximum number of pairs of views to try: all pairs of 12 views.
const MAX_PAIRS: usize = 66;

/// Returns the lower of two minima: from the linear solution, and from the best pair of views.
///
/// * `linear`: solution of all views, or its error, which is returned if no pair gives a point
pub(super) fn robust_minimum(
    problem: &Problem<'_>,
    linear: Result<Point3<f64>>,
) -> Result<Point3<f64>> {
    let finite = |x: &f64| x.is_finite();
    if !problem.pixels.iter().all(|p| p.iter().all(finite)) {
        return Err(Error::NotFinite { what: "a pixel" });
    }
    let from_all = linear.and_then(|start| problem.refined(start));
    if let Ok(point) = from_all
        && fits_every_view(problem, &point)
    {
        return from_all;
    }
    let Some(from_pair) = best_of_pairs(problem).and_then(|start| problem.refined(start).ok())
    else {
        return from_all;
    };
    match from_all {
        Ok(point) if problem.cost(&point) <= problem.cost(&from_pair) => Ok(point),
        _ => Ok(from_pair),
    }
}

/// Returns whether no view is treated as an outlier: each has at least half its weight.
fn fits_every_view(problem: &Problem<'_>, point: &Point3<f64>) -> bool {
    let mut views = problem.cameras.iter().zip(problem.pixels);
    views.all(|(camera, pixel)| match camera.project(point) {
        Ok(projected) => problem.loss.weight((projected - pixel).norm_squared()) >= 0.5,
        Err(_) => false,
    })
}

/// Returns the point with the least cost in all views among those of pairs of views.
fn best_of_pairs(problem: &Problem<'_>) -> Option<Point3<f64>> {
    let count = problem.cameras.len();
    let num_pairs = count * (count - 1) / 2;
    let num_tried = num_pairs.min(MAX_PAIRS);
    let (mut least, mut best) = (f64::INFINITY, None);
    for tried in 0..num_tried {
        // Spread evenly over the list (0, 1), (0, 2), (1, 2), (0, 3), …
        let place = tried * num_pairs / num_tried;
        let (i, j) = pair(place);
        if let Ok(point) = point_of_pair(problem, i, j)
            && let Some(cost) = cost_below(problem, &point, least)
        {
            (least, best) = (cost, Some(point));
        }
    }
    best
}

/// Returns the cost of a point in all views, if it is below a limit.
fn cost_below(problem: &Problem<'_>, point: &Point3<f64>, limit: f64) -> Option<f64> {
    let mut total = 0.0;
    for (camera, pixel) in problem.cameras.iter().zip(problem.pixels) {
        let projected = camera.project(point).ok()?;
        total += 0.5 * problem.loss.rho((projected - pixel).norm_squared());
        if total.is_nan() || total >= limit {
            return None;
        }
    }
    Some(total)
}

/// Returns the pair i < j at an index in the list (0, 1), (0, 2), (1, 2), (0, 3), …
fn pair(place: usize) -> (usize, usize) {
    // j (j − 1)/2 pairs precede the first one of j.
    let mut j = ((1.0 + (1.0 + 8.0 * place as f64).sqrt()) / 2.0) as usize;
    // Correct rounding errors of the root.
    while j * (j - 1) / 2 > place {
        j -= 1;
    }
    while j * (j + 1) / 2 <= place {
        j += 1;
    }
    (place - j * (j - 1) / 2, j)
}

fn point_of_pair(problem: &Problem<'_>, i: usize, j: usize) -> Result<Point3<f64>> {
    let (cam1, cam2) = (&problem.cameras[i], &problem.cameras[j]);
    let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
    let (ray1, ray2) = (
        cam1.camera.intrinsics.ray(&problem.pixels[i]),
        cam2.camera.intrinsics.ray(&problem.pixels[j]),
    );
    let x_in_cam1 = triangulate_weighted_midpoint(&motion, &ray1, &ray2)?;
    Ok(cam1.cam_from_world.inverse_transform_point(&x_in_cam1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_listed_one_after_the_other() {
        let mut place = 0;
        for j in 1..200 {
            for i in 0..j {
                assert_eq!(pair(place), (i, j));
                place += 1;
            }
        }
        // Of a million views.
        let (i, j) = pair(1_000_000 * 999_999 / 2 - 1);
        assert_eq!((i, j), (999_998, 999_999));
    }
}
