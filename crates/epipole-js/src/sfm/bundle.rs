//! Bundle adjustment.

use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, Numbers, Output, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, PosedCamera, RigidTransform};
use epipole::optim::LmReport;
use epipole::sfm::{self, Bundle, BundleObservation, BundleOptions, Sensor};

structs! {
    /// Bundle after its adjustment.
    struct AdjustedBundle as AdjustedBundle {
        /// Refined cameras and points, with the observations that were given.
        bundle: Bundle,
        /// Report of the refinement.
        report: LmReport,
    }
}

records! {
    /// Camera rigidly mounted on each camera of a bundle.
    Sensor as Sensor {
        /// From the frame of the camera to that of the sensor.
        sensor_from_camera: RigidTransform,
        /// Size, intrinsics and lens.
        camera: Camera,
        /// Number of its lens, as in `lensOfCamera`.
        lens: usize,
    }
}

impl Argument for Sensor {
    fn typescript(types: &mut Types) -> String {
        let transform = <RigidTransform as Argument>::typescript(types);
        let camera = <Camera as Argument>::typescript(types);
        types.interface(
            "SensorLike",
            "Camera rigidly mounted on each camera of a bundle, such as the right one of a rig.",
            &[
                (
                    "sensorFromCamera",
                    &transform,
                    "From the frame of the camera to that of the sensor; it is not refined.",
                ),
                ("camera", &camera, "Size, intrinsics and lens."),
                (
                    "lens?",
                    "number",
                    "Number of its lens, as in `lensOfCamera`. 0 if not given.",
                ),
            ],
        );
        "SensorLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["sensorFromCamera", "camera", "lens"])?;
        Ok(Self {
            sensor_from_camera: entry(name, value, "sensorFromCamera")?,
            camera: entry(name, value, "camera")?,
            lens: entry::<Option<u32>>(name, value, "lens")?.unwrap_or(0) as usize,
        })
    }
}

impl Argument for Bundle {
    fn typescript(types: &mut Types) -> String {
        let camera = <PosedCamera as Argument>::typescript(types);
        let sensor = <Sensor as Argument>::typescript(types);
        let (points, pixels) = (
            Vectors::<3>::typescript(types),
            Vectors::<2>::typescript(types),
        );
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "BundleLike",
            "Cameras, points and observations: entry k of each array of observations belongs to \
             observation k.",
            &[
                ("cameras", &format!("readonly {camera}[]"), "Cameras."),
                ("points", &points, "Points in the world."),
                ("observationCamera", &indices, "Index of the camera."),
                ("observationPoint", &indices, "Index of the point."),
                ("observationPixel", &pixels, "Measured pixel."),
                (
                    "lensOfCamera?",
                    &indices,
                    "Number of the lens of each camera; 0 for missing entries. Cameras of one lens \
                     have equal lenses and share its refined parameters.",
                ),
                (
                    "sensors?",
                    &format!("readonly {sensor}[]"),
                    "Further cameras mounted on each camera.",
                ),
                (
                    "observationSensor?",
                    &indices,
                    "0 if the camera itself made the observation, k if sensor k - 1 did; 0 for \
                     missing entries.",
                ),
            ],
        );
        "BundleLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = [
            "cameras",
            "points",
            "observationCamera",
            "observationPoint",
            "observationPixel",
            "lensOfCamera",
            "sensors",
            "observationSensor",
        ];
        check_keys(name, value, &keys)?;
        let indices = |key| -> Result<Vec<usize>> {
            Ok(entry::<Option<Indices>>(name, value, key)?.map_or(Vec::new(), |list| list.0))
        };
        let sensors = entry::<Option<Vec<Sensor>>>(name, value, "sensors")?;
        Ok(Self {
            cameras: entry(name, value, "cameras")?,
            lens_of_camera: indices("lensOfCamera")?,
            points: entry::<Vectors<3>>(name, value, "points")?.points(),
            observations: observations(name, value)?,
            sensors: sensors.unwrap_or_default(),
            sensor_of_observation: indices("observationSensor")?,
        })
    }
}

fn observations(name: &str, value: &Value) -> Result<Vec<BundleObservation>> {
    let pixels = entry::<Vectors<2>>(name, value, "observationPixel")?.points();
    let indices = |key| -> Result<Vec<usize>> {
        let Indices(list) = entry(name, value, key)?;
        match list.len() == pixels.len() {
            true => Ok(list),
            false => Err(Fault::of_range(format!(
                "{name}.{key} must have {} numbers, one for each pixel, but has {}",
                pixels.len(),
                list.len()
            ))),
        }
    };
    let (cameras, points) = (indices("observationCamera")?, indices("observationPoint")?);
    let pairs = cameras.into_iter().zip(points).zip(pixels);
    let observation = |((camera, point), pixel)| BundleObservation {
        camera,
        point,
        pixel,
    };
    Ok(pairs.map(observation).collect())
}

structs! {
    /// Cameras, points and observations.
    struct BundleInput as Bundle {
        /// Cameras.
        cameras: Vec<PosedCamera>,
        /// Points in the world, interleaved.
        points: Numbers,
        /// Index of the camera of each observation.
        observation_camera: Indices,
        /// Index of the point of each observation.
        observation_point: Indices,
        /// Measured pixel of each observation, interleaved.
        observation_pixel: Numbers,
        /// Number of the lens of each camera; 0 for missing entries.
        lens_of_camera: Indices,
        /// Further cameras mounted on each camera.
        sensors: Vec<Sensor>,
        /// Sensor of each observation, 0 for the camera itself and for missing entries.
        observation_sensor: Indices,
    }
}

impl Output for Bundle {
    fn typescript(types: &mut Types) -> String {
        BundleInput::typescript(types)
    }

    fn into_value(self) -> Value {
        let observations = &self.observations;
        let pixels: Vec<_> = observations
            .iter()
            .map(|observations| observations.pixel)
            .collect();
        let input = BundleInput {
            observation_camera: Indices(
                observations
                    .iter()
                    .map(|observations| observations.camera)
                    .collect(),
            ),
            observation_point: Indices(
                observations
                    .iter()
                    .map(|observations| observations.point)
                    .collect(),
            ),
            observation_pixel: Numbers::of_points(&pixels),
            points: Numbers::of_points(&self.points),
            cameras: self.cameras,
            lens_of_camera: Indices(self.lens_of_camera),
            sensors: self.sensors,
            observation_sensor: Indices(self.sensor_of_observation),
        };
        input.into_value()
    }
}

functions! {
    /// Refines cameras and points, and their lenses if asked, by the reprojection errors.
    fn adjust_bundle(bundle: Bundle, options: Options<BundleOptions>; monitor) -> AdjustedBundle {
        let mut bundle = bundle;
        let report = sfm::adjust_bundle(&mut bundle, &options.0, monitor)?;
        AdjustedBundle { bundle, report }
    }
}
