//! Two views through lenses other than pinholes.

use super::TwoViewOptions;
use super::motion::{best_and_rival, in_front_of_plane};
use super::report::{Configuration, TwoViewModel, TwoViewReport};
use super::rotation_search::find_explaining_rotation;
use crate::Result;
use crate::camera::{Camera, Intrinsics, Observation, RigidTransform};
use crate::epipolar::{ObservedMatches, estimate_relative_pose, tangent_sampson_px};
use crate::homography::{decompose_homography, estimate_homography_calibrated};
use crate::math::order::at_rank;
use crate::progress::Monitor;
use crate::robust::{RansacOptions, RansacReport};
use nalgebra::{Matrix3, Point2, Rotation3, Vector3};

/// Maximum number of samples of four matches: where a homography explains nearly all, a tenth is
/// plenty.
const MAX_SAMPLES: usize = 500;

/// Finds the homography of rays that explains nearly all inliers of a motion, if any: they show a
/// plane, or the camera only rotated.
pub(crate) fn find_plane_through_lenses(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &TwoViewOptions,
) -> Option<RansacReport<Matrix3<f64>>> {
    let in_two_dimensions = options.in_two_dimensions();
    let ransac = RansacOptions {
        max_iterations: in_two_dimensions.max_iterations.min(MAX_SAMPLES),
        ..in_two_dimensions
    };
    let found = estimate_homography_calibrated(pixels1, pixels2, cameras, &ransac, &mut ()).ok()?;
    let needed = options.max_homography_ratio * pixels1.len() as f64;
    (found.num_inliers as f64 >= needed).then_some(found)
}

/// Body of [`estimate_two_view_calibrated`](super::estimate_two_view_calibrated) for cameras with
/// any lens: E, or H of rays for a plane or a rotation. Errors of H are in image 2.
///
/// # Errors
/// As [`estimate_relative_pose`].
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited", §4.1.
pub(super) fn estimate_through_lenses(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &TwoViewOptions,
    monitor: &mut dyn Monitor,
) -> Result<TwoViewReport> {
    let epipolar = estimate_relative_pose(pixels1, pixels2, cameras, &options.ransac, monitor)?;
    let options = &options.within(epipolar.max_error_px);
    let motion = epipolar.model.cam2_from_cam1();
    let is_degenerate =
        epipolar.num_unique_inliers < options.min_num_inliers || epipolar.could_be_random();
    let mut found = TwoViewReport {
        configuration: Configuration::General,
        model: TwoViewModel::Essential(epipolar.model.essential()),
        is_of_rays: true,
        fundamental: None,
        homography: None,
        cam2_from_cam1: Some(motion),
        other_cam2_from_cam1: None,
        inliers: epipolar.inliers,
        num_inliers: epipolar.num_inliers,
        num_left_out: epipolar.num_left_out,
        max_error_px: epipolar.max_error_px,
        iterations: epipolar.iterations,
        required_iterations: epipolar.required_iterations,
        stop: epipolar.stop,
        median_triangulation_angle_rad: None,
    };
    if is_degenerate {
        found.configuration = Configuration::Degenerate;
        found.cam2_from_cam1 = None;
        return Ok(found);
    }
    let of_motion = Inliers::new(pixels1, pixels2, cameras, &found.inliers)?;
    let [in1, in2] = &of_motion.pixels;
    let all = vec![true; in1.len()];
    let explaining = find_explaining_rotation(in1, in2, cameras, &all, options)?;
    let plane = find_plane_through_lenses(in1, in2, cameras, options);
    let flat = if let Some(explaining) = explaining {
        found.configuration = Configuration::Panoramic;
        found.cam2_from_cam1 = Some(explaining.cam2_from_cam1);
        let rotation = explaining.cam2_from_cam1.rotation.to_rotation_matrix();
        Some(rotation.into_inner() / 3.0_f64.sqrt())
    } else if let Some(plane) = plane {
        found.configuration = Configuration::Planar;
        let motions = planar_motions(&of_motion.observations, &motion, &plane, options);
        [found.cam2_from_cam1, found.other_cam2_from_cam1] = motions;
        Some(plane.model)
    } else {
        None
    };
    found.homography = flat;
    if let Some(homography) = flat {
        found.model = TwoViewModel::Homography(homography);
        let max_error_px = options.in_two_dimensions().max_error_px;
        let observed = ObservedMatches::new(pixels1, pixels2, cameras)?;
        let [observations1, observations2] = &observed.observations;
        let fits = |place: &Option<usize>| {
            place.is_some_and(|i| {
                observations2[i].error_sq(&(homography * observations1[i].ray()))
                    < max_error_px * max_error_px
            })
        };
        found.inliers = observed
            .matches
            .unique()
            .places()
            .iter()
            .map(fits)
            .collect();
        found.num_inliers = found.inliers.iter().filter(|is| **is).count();
    }
    if let (Some(motion), false) = (&found.cam2_from_cam1, explaining.is_some()) {
        let inliers = Inliers::new(pixels1, pixels2, cameras, &found.inliers)?;
        let mut angles: Vec<f64> = (inliers.observations.iter())
            .map(|[observation1, observation2]| {
                (motion.rotation * observation1.ray()).angle(&observation2.ray())
            })
            .collect();
        let middle = angles.len() / 2;
        found.median_triangulation_angle_rad =
            (!angles.is_empty()).then(|| at_rank(&mut angles, middle));
    }
    Ok(found)
}

/// Unique matches that fit a model.
struct Inliers {
    pixels: [Vec<Point2<f64>>; 2],
    observations: Vec<[Observation; 2]>,
}

impl Inliers {
    fn new(
        pixels1: &[Point2<f64>],
        pixels2: &[Point2<f64>],
        cameras: [&Camera; 2],
        mask: &[bool],
    ) -> Result<Self> {
        let inlier_pixels = super::pairs::inliers_of(pixels1, pixels2, mask)?;
        let observed = ObservedMatches::new(&inlier_pixels[0], &inlier_pixels[1], cameras)?;
        let [observations1, observations2] = observed.observations;
        let first = observed.matches.unique().first_occurrences();
        Ok(Self {
            pixels: inlier_pixels.map(|pixels| first.iter().map(|&i| pixels[i]).collect()),
            observations: observations1
                .into_iter()
                .zip(observations2)
                .map(|(a, b)| [a, b])
                .collect(),
        })
    }
}

/// Returns the motion past a plane with which most matches agree, and another one with nearly as
/// many.
///
/// * `motion`: motion of E
fn planar_motions(
    inliers: &[[Observation; 2]],
    motion: &RigidTransform,
    plane: &RansacReport<Matrix3<f64>>,
    options: &TwoViewOptions,
) -> [Option<RigidTransform>; 2] {
    let on_plane = inliers.iter().zip(&plane.inliers).filter(|(_, is)| **is);
    let rays1 = on_plane.map(|([observation1, _], _)| observation1.ray());
    // Rays are pixels of a camera with K = I.
    let of_rays = Intrinsics::new(1.0, 1.0, 0.0, 0.0);
    let decomposed = of_rays.and_then(|k| decompose_homography(&plane.model, &k, &k));
    let mut motions = vec![*motion];
    for (rotation, direction) in in_front_of_plane(&decomposed.unwrap_or_default(), rays1) {
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        motions.push(RigidTransform::from_parts(
            direction.into(),
            rotation.into(),
        ));
    }
    let max_error_px = options.ransac.max_error_px;
    let score = |motion: &RigidTransform| {
        let fits = |[observation1, observation2]: &&[Observation; 2]| {
            tangent_sampson_px(motion, observation1, observation2) < max_error_px
        };
        inliers.iter().filter(fits).count()
    };
    let scores: Vec<usize> = motions.iter().map(score).collect();
    let pose = |i: usize| -> (Matrix3<f64>, Vector3<f64>) {
        let rotation = motions[i].rotation.to_rotation_matrix().into_inner();
        (rotation, motions[i].translation.vector)
    };
    best_and_rival(&scores, pose).map(|place| place.map(|i| motions[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::camera::{Division, Fisheye, Lens};
    use crate::math::random::Random;
    use crate::two_view::estimate_two_view_calibrated;
    use nalgebra::Point3;

    /// Matches with half a pixel of noise, every tenth wrong.
    fn observations(
        camera: &Camera,
        motion: &RigidTransform,
        point: impl Fn(&mut Random) -> Point3<f64>,
    ) -> [Vec<Point2<f64>>; 2] {
        let mut random = Random::new(4);
        let mut observations = [Vec::new(), Vec::new()];
        while observations[0].len() < 240 {
            let x = point(&mut random);
            let mut observe = |x: &Point3<f64>, off_px: f64| {
                let off = Point2::new(random.normal(), random.normal()).coords * off_px;
                let pixel = camera.project(x).ok()? + off;
                let inside = 0.0..800.0;
                let is_inside = inside.contains(&pixel.x) && inside.contains(&pixel.y);
                is_inside.then_some(pixel)
            };
            let off_px = if observations[0].len() % 10 == 0 {
                50.0
            } else {
                0.5
            };
            if let (Some(one), Some(two)) = (observe(&x, 0.5), observe(&(motion * x), off_px)) {
                observations[0].push(one);
                observations[1].push(two);
            }
        }
        observations
    }

    fn camera(lens: Lens, focal_px: f64) -> Camera {
        let k = Intrinsics::centered(focal_px, 800, 800).unwrap();
        Camera {
            lens,
            ..Camera::pinhole(k, 800, 800)
        }
    }

    fn wall(random: &mut Random) -> Point3<f64> {
        Point3::new(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 3.0)
    }

    fn room(random: &mut Random) -> Point3<f64> {
        Point3::new(
            random.uniform(-3.0, 3.0),
            random.uniform(-3.0, 3.0),
            random.uniform(2.0, 7.0),
        )
    }

    #[test]
    fn wide_and_narrow_lenses_distinguish_depth_plane_and_rotation() {
        let fisheye = Lens::Fisheye(Fisheye {
            coefficients: [-0.02, 0.004, 0.0, 0.0],
        });
        let narrow = Lens::Division(Division { k: -0.2 });
        let rotation_vector = Vector3::new(0.03, -0.1, 0.05);
        let step = RigidTransform::new(Vector3::new(-0.5, 0.1, 0.2), rotation_vector);
        let still = RigidTransform::rotation(rotation_vector);
        let options = TwoViewOptions::default().within(2.0);
        for (lens, focal_px) in [(fisheye, 260.0), (narrow, 1400.0)] {
            let run = |motion, point: fn(&mut Random) -> Point3<f64>| {
                let camera = camera(lens, focal_px);
                let [p1, p2] = observations(&camera, motion, point);
                estimate_two_view_calibrated(&p1, &p2, [&camera; 2], &options, &mut ()).unwrap()
            };
            let general = run(&step, room);
            assert!(general.is_of_rays);
            assert_eq!(general.configuration, Configuration::General, "{lens:?}");
            let found = general.cam2_from_cam1.unwrap();
            let off = found.rotation.angle_to(&step.rotation).to_degrees();
            let direction = step.translation.vector;
            let aside = found.translation.vector.angle(&direction).to_degrees();
            assert!(off < 0.3 && aside < 4.0, "{lens:?} {off} {aside}");

            let planar = run(&step, wall);
            assert_eq!(planar.configuration, Configuration::Planar, "{lens:?}");
            // One of the two is right, if there are two.
            let both = [planar.cam2_from_cam1, planar.other_cam2_from_cam1];
            let off = both
                .iter()
                .flatten()
                .map(|motion| motion.rotation.angle_to(&step.rotation).to_degrees());
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off < 1.0, "{lens:?} {off}");
            assert!(
                (214..=226).contains(&planar.num_inliers),
                "{}",
                planar.num_inliers
            );

            let panoramic = run(&still, room);
            assert_eq!(
                panoramic.configuration,
                Configuration::Panoramic,
                "{lens:?}"
            );
            let found = panoramic.cam2_from_cam1.unwrap();
            assert!(found.rotation.angle_to(&still.rotation) < 1e-3);
            assert_eq!(found.translation.vector, Vector3::zeros());
            assert_eq!(panoramic.median_triangulation_angle_rad, None);
        }
    }

    #[test]
    fn few_matches_are_degenerate_or_refused() {
        let camera = camera(Lens::Fisheye(Fisheye::default()), 260.0);
        let step = RigidTransform::translation(-0.5, 0.0, 0.0);
        let [p1, p2] = observations(&camera, &step, room);
        let options = TwoViewOptions::default().within(2.0);
        let run = |num: usize| {
            let (p1, p2) = (&p1[..num], &p2[..num]);
            estimate_two_view_calibrated(p1, p2, [&camera; 2], &options, &mut ())
        };
        let few = run(12).unwrap();
        assert_eq!(few.configuration, Configuration::Degenerate);
        assert_eq!(few.cam2_from_cam1, None);
        assert!(matches!(run(4), Err(Error::TooFew { .. })));
    }
}
