//! Calibrations of KITTI: `calib.txt` of the odometry and object benchmarks, and
//! `calib_cam_to_cam.txt` of the raw recordings.
//!
//! Projections `P0` … of rectified cameras without the size of their images; `K_00`, `D_00` of
//! cameras with lenses, posed by `R_00`, `T_00`. Pixel centers are at integers, meters.
//!
//! Source: Geiger et al. 2013, "Vision meets robotics: The KITTI dataset", section 4.

use super::named::{Cameras, NamedCamera};
use super::parts::{Size, intrinsics, motion, opencv_lens, size_or, translation};
use crate::Result;
use crate::tree::Field;
use epipole::camera::{Camera, Lens, RigidTransform};
use nalgebra::{UnitQuaternion, Vector3};

pub(super) fn is_it(root: &Field) -> bool {
    let is_row = |key: &str, count| {
        root.get(key)
            .is_some_and(|field| field.numbers().is_ok_and(|numbers| numbers.len() == count))
    };
    (0..4).any(|n| is_row(&format!("P{n}"), 12) || is_row(&format!("K_0{n}"), 9))
}

pub(super) fn read(root: &Field, size: Option<Size>) -> Result<Cameras> {
    let mut all = Cameras::default();
    for n in 0..4 {
        let camera = if let Some(projection) = root.get(&format!("P{n}")) {
            read_projection(&projection, size)?
        } else if let Some(k) = root.get(&format!("K_0{n}")) {
            with_lens(root, &k, n)?
        } else {
            continue;
        };
        all.cameras.push(NamedCamera {
            name: format!("cam{n}"),
            ..camera
        });
    }
    if let [left, right, ..] = &all.cameras[..]
        && let (Some(left), Some(right)) = (left.cam_from_world, right.cam_from_world)
    {
        all.right_from_left = Some(right * left.inverse());
    }
    Ok(all)
}

/// Reads a projection K (I | t).
fn read_projection(field: &Field, size: Option<Size>) -> Result<NamedCamera> {
    let p: [f64; 12] = field.array()?;
    let k = intrinsics(field, &[&p[..3], &p[4..7], &p[8..11]].concat())?;
    let (width, height) = size_or(size, "width and height")?;
    let offset = k
        .matrix()
        .try_inverse()
        .map(|inverse| inverse * Vector3::new(p[3], p[7], p[11]));
    let offset = offset.ok_or_else(|| field.wrong("is not a projection"))?;
    let pose = RigidTransform::from_parts(
        translation(field, offset.into())?,
        UnitQuaternion::identity(),
    );
    Ok(with_pose(
        Camera {
            width,
            height,
            intrinsics: k,
            lens: Lens::NONE,
        },
        pose,
    ))
}

fn with_lens(root: &Field, k: &Field, n: usize) -> Result<NamedCamera> {
    let part = |name: &str, expected: &str| root.need(&format!("{name}_0{n}"), expected);
    let sides = part("S", "width and height in pixels")?;
    let d = part("D", "five numbers")?;
    let [width, height] = sides.array()?;
    let whole = |side: f64| match side.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&side)
    {
        true => Ok(side as u32),
        false => Err(sides.wrong("is not width and height in pixels")),
    };
    let camera = Camera {
        width: whole(width)?,
        height: whole(height)?,
        intrinsics: intrinsics(k, &k.numbers()?)?,
        lens: opencv_lens(&d, &d.numbers()?)?,
    };
    let place = part("T", "three numbers")?;
    let pose = motion(&part("R", "nine numbers")?, &place)?;
    Ok(with_pose(camera, pose))
}

fn with_pose(camera: Camera, pose: RigidTransform) -> NamedCamera {
    NamedCamera {
        cam_from_world: Some(pose),
        ..NamedCamera::new("", camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{CameraFormat, read_cameras};

    #[test]
    fn projections_are_a_rectified_rig() {
        let text = "P0: 718.856 0 607.1928 0 0 718.856 185.2157 0 0 0 1 0\n\
            P1: 7.18856e+02 0 607.1928 -386.1448 0 718.856 185.2157 0 0 0 1 0\n";
        let (format, rig) = read_cameras(text.as_bytes(), Some((1241, 376))).unwrap();
        assert_eq!(format, CameraFormat::Kitti);
        assert_eq!(rig.cameras[0].camera.intrinsics.fu_px(), 718.856);
        let baseline = rig.right_from_left.unwrap().translation.vector;
        // Baseline of the odometry benchmark: 0.5372 m.
        assert!(
            (baseline - Vector3::new(-0.5372, 0.0, 0.0)).norm() < 1e-4,
            "{baseline}"
        );
        let error = read_cameras(text.as_bytes(), None).unwrap_err().to_string();
        assert!(error.starts_with("the file has no image size"), "{error}");
    }

    #[test]
    fn raw_calibrations_have_lenses() {
        let camera = |n, x: f64| {
            format!(
                "S_0{n}: 1.392e+03 5.12e+02\nK_0{n}: 984.2 0 690 0 980.8 233.2 0 0 1\n\
                 D_0{n}: -0.37 0.2 0.002 0.001 -0.07\nR_0{n}: 1 0 0 0 1 0 0 0 1\nT_0{n}: {x} 0 0\n"
            )
        };
        let text = format!(
            "calib_time: 09-Jan-2012 13:57:47\n{}{}",
            camera(0, 0.0),
            camera(1, -0.5)
        );
        let (_, rig) = read_cameras(text.as_bytes(), None).unwrap();
        assert_eq!(
            (rig.cameras[1].camera.width, rig.cameras[1].camera.height),
            (1392, 512)
        );
        assert_eq!(rig.cameras[0].camera.lens.coefficients()[4], -0.07);
        assert_eq!(rig.right_from_left.unwrap().translation.vector.x, -0.5);
    }
}
