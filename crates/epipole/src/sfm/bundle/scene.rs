//! Cameras with their lenses, points and observations.

use super::observation::BundleObservation;
use crate::camera::{Camera, Lens, PosedCamera, RigidTransform};
use crate::{Error, Result};
use nalgebra::{Point3, Vector2};

/// A camera rigidly mounted on each camera of a bundle, such as the right camera of a stereo rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Transformation from the frame of the camera to that of the sensor; not refined.
    pub sensor_from_camera: RigidTransform,
    /// Image size, intrinsics and lens.
    pub camera: Camera,
    /// Number of its lens, as in [`Bundle::lens_of_camera`].
    pub lens: usize,
}

/// Cameras, points and observations.
///
/// Cameras of one lens share its refined parameters: a factor of their focal lengths, a shift of
/// their principal points, and its coefficients. By default all cameras share one lens; as many
/// lenses as cameras give each its own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bundle {
    /// The cameras.
    pub cameras: Vec<PosedCamera>,
    /// Lens number of each camera; missing entries are 0. Cameras and sensors with the same number
    /// must have equal lenses.
    pub lens_of_camera: Vec<usize>,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// Observations.
    pub observations: Vec<BundleObservation>,
    /// Sensors mounted on each camera.
    pub sensors: Vec<Sensor>,
    /// For each observation, 0 if the camera itself made it, k if sensor k − 1 did; missing entries
    /// are 0.
    pub sensor_of_observation: Vec<usize>,
}

impl Bundle {
    /// Returns the optics of an observation: the camera itself, or a sensor.
    pub(super) fn eye(&self, observation: usize) -> Eye<'_> {
        let sensor = match self.sensor_of_observation.get(observation) {
            Some(&k) if k > 0 => self.sensors.get(k - 1),
            _ => None,
        };
        let camera = self.observations[observation].camera;
        match sensor {
            Some(sensor) => Eye {
                camera: &sensor.camera,
                lens: sensor.lens,
                sensor_from_camera: Some(&sensor.sensor_from_camera),
            },
            None => Eye {
                camera: &self.cameras[camera].camera,
                lens: self.lens_of(camera),
                sensor_from_camera: None,
            },
        }
    }

    /// Returns the lens number of a camera.
    pub(super) fn lens_of(&self, camera: usize) -> usize {
        self.lens_of_camera.get(camera).copied().unwrap_or(0)
    }

    /// Returns the lenses by number; numbers without a camera have no distortion.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if cameras with the same number have different lenses,
    /// [`Error::NotFinite`] for a coefficient.
    pub(super) fn lenses(&self) -> Result<Vec<Lens>> {
        let mut lenses: Vec<Option<Lens>> = vec![None; self.num_lenses()];
        let of_cameras = self.cameras.iter().map(|camera| camera.camera.lens);
        let of_cameras = of_cameras
            .enumerate()
            .map(|(n, lens)| (self.lens_of(n), lens));
        let of_sensors = (self.sensors.iter()).map(|sensor| (sensor.lens, sensor.camera.lens));
        for (number, lens) in of_cameras.chain(of_sensors) {
            lens.check()?;
            if *lenses[number].get_or_insert(lens) != lens {
                return Err(Error::Degenerate {
                    what: "a lens that cameras of a bundle share",
                    why: "their coefficients differ; give each its own number in lens_of_camera",
                });
            }
        }
        Ok(lenses.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Returns the number of lenses of cameras and sensors.
    pub(super) fn num_lenses(&self) -> usize {
        let of_cameras = self.lens_of_camera.iter().take(self.cameras.len());
        let used = of_cameras.chain(self.sensors.iter().map(|sensor| &sensor.lens));
        used.max().map_or(1, |last| last.saturating_add(1))
    }

    /// Returns the predicted minus the observed pixel of an observation; not finite if the lens
    /// does not see the point, or the point is in the camera's center plane. Points behind the
    /// camera are mirrored through its center, as in [`adjust_bundle`](super::adjust_bundle),
    /// except by a fisheye, which may see them.
    pub fn residual_px(&self, observation: usize) -> Vector2<f64> {
        let o = &self.observations[observation];
        let eye = self.eye(observation);
        let mut p = self.cameras[o.camera].cam_from_world * self.points[o.point];
        if let Some(sensor_from_camera) = eye.sensor_from_camera {
            p = sensor_from_camera * p;
        }
        let k = &eye.camera.intrinsics;
        let shown = eye.camera.lens.project_or_mirror(&p.coords);
        let center = k.principal_point();
        Vector2::new(
            k.fu_px() * shown.x + center.x - o.pixel.x,
            k.fv_px() * shown.y + center.y - o.pixel.y,
        )
    }
}

/// Camera or sensor that made an observation.
pub(super) struct Eye<'a> {
    pub(super) camera: &'a Camera,
    /// Lens number.
    pub(super) lens: usize,
    /// `None` for the camera itself.
    pub(super) sensor_from_camera: Option<&'a RigidTransform>,
}
