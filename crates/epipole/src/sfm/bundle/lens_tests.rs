//! Bundle adjustment with lenses beyond Brown's model.

use super::lens_state::{OF_ANY, OF_BROWN};
use super::tests::{all_free, check_derivatives, disturb, project_points, set_lenses};
use super::*;
use crate::Error;
use crate::camera::{
    Camera, Division, Fisheye, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform,
};
use crate::math::random::Random;
use nalgebra::{Point2, Point3, Vector3};

fn lens(kind: LensKind) -> Lens {
    let numbers: &[f64] = match kind {
        LensKind::Brown => &[-0.05, 0.01, 0.002, -0.001, 0.0],
        LensKind::Rational => &[0.3, 0.05, 0.001, -0.002, 0.01, 0.5, 0.1, 0.005],
        LensKind::Fisheye => &[-0.03, 0.008, -0.003, 0.0004],
        LensKind::Division => &[-0.15],
    };
    Lens::from_coefficients(kind, numbers).unwrap()
}

/// Cameras amid points in all directions. A camera sees the points within `half_deg` degrees of its
/// axis.
fn surrounded(num_cameras: usize, num_points: usize, lenses: &[Lens], half_deg: f64) -> Bundle {
    let mut random = Random::new(31);
    let mut bundle = Bundle {
        lens_of_camera: (0..num_cameras).map(|i| i % lenses.len()).collect(),
        ..Bundle::default()
    };
    for _ in 0..num_cameras {
        let rotation_vector = 0.3 * Vector3::from_fn(|_, _| random.normal());
        let shift = 0.6 * Vector3::from_fn(|_, _| random.normal());
        bundle.cameras.push(PosedCamera {
            camera: Camera::pinhole(
                Intrinsics::new(300.0, 303.0, 500.0, 490.0).unwrap(),
                640,
                480,
            ),
            cam_from_world: RigidTransform::new(shift, rotation_vector),
        });
    }
    for _ in 0..num_points {
        let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
        bundle
            .points
            .push(Point3::from(direction * random.uniform(3.0, 6.0)));
    }
    for camera in 0..num_cameras {
        for point in 0..num_points {
            let p = bundle.cameras[camera].cam_from_world * bundle.points[point];
            if p.coords.angle(&Vector3::z()) < half_deg.to_radians() {
                bundle.observations.push(BundleObservation {
                    camera,
                    point,
                    pixel: Point2::origin(),
                });
            }
        }
    }
    set_lenses(&mut bundle, lenses);
    project_points(&mut bundle);
    bundle
}

#[test]
fn derivatives_of_every_lens_are_those_of_central_differences() {
    let all = [
        LensKind::Fisheye,
        LensKind::Division,
        LensKind::Brown,
        LensKind::Rational,
    ];
    let options = all_free();
    let few = surrounded(
        3,
        60,
        &all[..3].iter().map(|k| lens(*k)).collect::<Vec<_>>(),
        60.0,
    );
    check_derivatives::<OF_BROWN>(&few, &options);
    let mut any = surrounded(4, 60, &all.map(lens), 60.0);
    check_derivatives::<OF_ANY>(&any, &options);
    // Points beside the camera and behind it.
    check_derivatives::<OF_BROWN>(
        &surrounded(2, 90, &[lens(LensKind::Fisheye)], 100.0),
        &options,
    );
    // Through a sensor that looks from the side.
    let free_camera = any.cameras[0].camera;
    any.sensors.push(Sensor {
        sensor_from_camera: RigidTransform::new(Vector3::new(-0.5, 0.1, 0.05), Vector3::y() * 0.2),
        camera: Camera {
            intrinsics: Intrinsics::new(310.0, 312.0, 480.0, 500.0).unwrap(),
            ..free_camera
        },
        lens: 0,
    });
    any.sensor_of_observation = (0..any.observations.len()).map(|o| o % 2).collect();
    project_points(&mut any);
    check_derivatives::<OF_ANY>(&any, &options);
}

/// Recovers exact parameters from a wrong focal length, principal point and coefficients.
fn comes_back(lenses: &[Lens], start: &[Lens], half_deg: f64) -> Bundle {
    let mut bundle = surrounded(6, 200, lenses, half_deg);
    let truth = bundle.clone();
    disturb(&mut bundle, 0.005);
    for camera in &mut bundle.cameras {
        camera.camera.intrinsics = Intrinsics::new(309.0, 312.09, 502.0, 487.0).unwrap();
    }
    set_lenses(&mut bundle, start);
    let report = adjust_bundle(&mut bundle, &all_free(), &mut ()).unwrap();
    assert!(report.final_cost < 1e-9, "{report:?}");
    for (got, want) in bundle.cameras.iter().zip(&truth.cameras) {
        let (got, want) = (got.camera.intrinsics, want.camera.intrinsics);
        assert!((got.fu_px() - want.fu_px()).abs() < 0.01, "{got:?}");
        assert!((got.fv_px() - want.fv_px()).abs() < 0.01, "{got:?}");
        assert!(
            (got.principal_point() - want.principal_point()).norm() < 0.01,
            "{got:?}"
        );
    }
    bundle
}

#[test]
fn a_fisheye_of_180_degrees_finds_its_coefficients() {
    let truth = lens(LensKind::Fisheye);
    let bundle = comes_back(&[truth], &[Fisheye::default().into()], 90.0);
    for (got, want) in (bundle.cameras[0].camera.lens)
        .coefficients()
        .iter()
        .zip(truth.coefficients())
    {
        assert!((got - want).abs() < 1e-5, "{got} {want}");
    }
}

#[test]
fn lenses_of_all_models_in_one_bundle_find_theirs() {
    let kinds = [LensKind::Division, LensKind::Fisheye, LensKind::Brown];
    let start = [
        Lens::from(Division { k: -0.1 }),
        Fisheye::default().into(),
        Lens::NONE,
    ];
    let bundle = comes_back(&kinds.map(lens), &start, 55.0);
    for (got, want) in bundle.lenses().unwrap().iter().zip(kinds.map(lens)) {
        assert_eq!(got.kind(), want.kind());
        for (got, want) in got.coefficients().iter().zip(want.coefficients()) {
            assert!((got - want).abs() < 1e-3, "{got} {want}");
        }
    }
}

/// The eight coefficients are nearly redundant, so compare the distortion instead.
#[test]
fn a_rational_lens_finds_how_it_bends() {
    let truth = lens(LensKind::Rational);
    let mut bundle = surrounded(6, 300, &[truth], 60.0);
    let exact = bundle.clone();
    disturb(&mut bundle, 0.003);
    let start = [0.28, 0.05, 0.0, 0.0, 0.01, 0.5, 0.1, 0.005];
    let start = Lens::from_coefficients(LensKind::Rational, &start).unwrap();
    set_lenses(&mut bundle, &[start]);
    let options = BundleOptions {
        refine_focal: false,
        refine_principal_point: false,
        ..all_free()
    };
    let report = adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
    assert!(report.final_cost < 1e-6, "{report:?}");
    for degrees in [10.0f64, 30.0, 50.0, 59.0] {
        let ray = Vector3::new(libm::tan(degrees.to_radians()), 0.1, 1.0);
        let off =
            bundle.cameras[0].camera.lens.project_or_mirror(&ray) - truth.project_or_mirror(&ray);
        assert!(off.norm() < 1e-5, "{degrees} {off}");
    }
    assert_eq!(
        bundle.cameras[0].camera.intrinsics,
        exact.cameras[0].camera.intrinsics
    );
}

#[test]
fn what_is_not_to_be_refined_stays_the_same_bits() {
    for kind in [LensKind::Fisheye, LensKind::Rational, LensKind::Division] {
        let mut bundle = surrounded(3, 80, &[lens(kind)], 60.0);
        disturb(&mut bundle, 0.005);
        for (refine_distortion, refine_tangential) in [(false, true), (true, false), (false, false)]
        {
            let options = BundleOptions {
                refine_distortion,
                refine_tangential,
                ..BundleOptions::default()
            };
            let mut bundle = bundle.clone();
            adjust_bundle(&mut bundle, &options, &mut ()).unwrap();
            let changed: Vec<bool> = (bundle.cameras[0].camera.lens.coefficients().into_iter())
                .zip(lens(kind).coefficients())
                .map(|(new, old)| new != old)
                .collect();
            let refined = options.refined(kind);
            assert_eq!(changed, refined[..changed.len()], "{kind:?}");
        }
    }
}

#[test]
fn bad_lenses_are_refused_or_leave_the_bundle_as_it_was() {
    let good = surrounded(3, 80, &[lens(LensKind::Fisheye)], 80.0);
    for k in [f64::NAN, f64::INFINITY] {
        let mut bundle = good.clone();
        let bad = Fisheye {
            coefficients: [0.0, k, 0.0, 0.0],
        };
        set_lenses(&mut bundle, &[bad.into()]);
        let refused = adjust_bundle(&mut bundle, &all_free(), &mut ());
        assert!(
            matches!(refused, Err(Error::NotFinite { .. })),
            "{refused:?}"
        );
        assert!(refused.unwrap_err().to_string().contains("coefficient"));
    }
    // A point straight behind a fisheye projects to the whole circle.
    let mut behind = good.clone();
    let o = behind.observations[0];
    let camera = behind.cameras[o.camera].cam_from_world;
    behind.points[o.point] = camera.inverse() * Point3::new(0.0, 0.0, -2.0);
    behind.cameras[o.camera].cam_from_world = camera;
    match adjust_bundle(&mut behind, &all_free(), &mut ()) {
        Ok(_) => assert!(
            behind
                .points
                .iter()
                .all(|p| p.iter().all(|x| x.is_finite()))
        ),
        Err(error) => assert!(matches!(error, Error::NotFinite { .. }), "{error}"),
    }
    // A pincushion lens sees no rays beyond its fold.
    let mut folded = good;
    set_lenses(&mut folded, &[Division { k: 0.5 }.into()]);
    let refused = adjust_bundle(&mut folded, &all_free(), &mut ());
    assert!(
        matches!(refused, Err(Error::NotFinite { .. })),
        "{refused:?}"
    );
}
