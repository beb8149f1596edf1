//! COLMAP's rigs and frames: `rigs.txt` and `frames.txt`, or `rigs.bin` and `frames.bin`, which
//! COLMAP has since 3.12.
//!
//! The pose of an image is then `sensor_from_rig * rig_from_world`; the pose in the list of images
//! is for older programs.
//!
//! Source: COLMAP 4, `src/colmap/scene/reconstruction_io_text.cc` and `…_binary.cc`.

use super::{Model, ModelFile, Rig};
use crate::bytes::{Bytes, extend};
use crate::colmap::words::{Words, content};
use crate::rotation::{pose, rotation_from_quaternion};
use crate::{Result, text};
use epipole::camera::RigidTransform;
use std::fmt::Write;

/// Sensor type of a camera in binary files.
const CAMERA: i32 = 0;
/// Sensor type of a camera in text files.
const CAMERA_NAME: &str = "CAMERA";

/// A rig of the list.
pub(super) struct RigPart {
    pub(super) id: u32,
    /// The first one is the reference.
    pub(super) sensors: Vec<SensorPart>,
}

/// A sensor of a rig.
pub(super) struct SensorPart {
    /// ID of the camera; `None` for another sensor.
    pub(super) camera: Option<u32>,
    /// `sensor_from_rig`, if it is known.
    pub(super) pose: Option<RigidTransform>,
}

/// A frame of the list.
pub(super) struct FramePart {
    pub(super) id: u32,
    pub(super) rig: u32,
    pub(super) rig_from_world: Option<RigidTransform>,
    /// IDs of the images.
    pub(super) images: Vec<u32>,
}

/// Values of a record, in order.
trait Values {
    fn id(&mut self, what: &str) -> Result<u32>;
    fn is_camera(&mut self) -> Result<bool>;
    fn has_pose(&mut self) -> Result<bool>;
    fn number(&mut self) -> Result<f64>;
    fn image(&mut self) -> Result<u64>;
}

impl Values for Words<'_> {
    fn id(&mut self, what: &str) -> Result<u32> {
        self.whole(what)
    }
    fn is_camera(&mut self) -> Result<bool> {
        Ok(self.word("the type of a sensor")? == CAMERA_NAME)
    }
    fn has_pose(&mut self) -> Result<bool> {
        Ok(self.whole::<u8>("the flag of a pose")? != 0)
    }
    fn number(&mut self) -> Result<f64> {
        self.any_number("a pose")
    }
    fn image(&mut self) -> Result<u64> {
        self.whole("the ID of an image")
    }
}

impl Values for Bytes<'_> {
    fn id(&mut self, _: &str) -> Result<u32> {
        self.u32()
    }
    fn is_camera(&mut self) -> Result<bool> {
        Ok(self.i32()? == CAMERA)
    }
    fn has_pose(&mut self) -> Result<bool> {
        Ok(self.u8()? != 0)
    }
    fn number(&mut self) -> Result<f64> {
        self.f64()
    }
    fn image(&mut self) -> Result<u64> {
        self.u64()
    }
}

/// Reads a pose; `None` if it is not finite or its quaternion is 0.
fn read_pose(values: &mut impl Values) -> Result<Option<RigidTransform>> {
    let mut numbers = [0.0; 7];
    for number in &mut numbers {
        *number = values.number()?;
    }
    let [w, x, y, z, translation @ ..] = numbers;
    let rotation = rotation_from_quaternion(&[w, x, y, z]);
    Ok(rotation.and_then(|rotation| pose(rotation, translation.into())))
}

fn read_rig(values: &mut impl Values) -> Result<RigPart> {
    let id = values.id("the rig ID")?;
    let mut sensors = Vec::new();
    for index in 0..values.id("the number of sensors")? {
        let is_camera = values.is_camera()?;
        let sensor = values.id("the sensor ID")?;
        let pose = match index {
            0 => Some(RigidTransform::identity()),
            _ if values.has_pose()? => read_pose(values)?,
            _ => None,
        };
        let camera = is_camera.then_some(sensor);
        sensors.push(SensorPart { camera, pose });
    }
    Ok(RigPart { id, sensors })
}

fn read_frame(values: &mut impl Values) -> Result<FramePart> {
    let (id, rig) = (values.id("the frame ID")?, values.id("the rig ID")?);
    let rig_from_world = read_pose(values)?;
    let mut images = Vec::new();
    for _ in 0..values.id("the number of images")? {
        let is_camera = values.is_camera()?;
        values.id("the sensor ID")?;
        let image = values.image()?;
        // An ID beyond 32 bits is not that of an image.
        images.extend(u32::try_from(image).ok().filter(|_| is_camera));
    }
    Ok(FramePart {
        id,
        rig,
        rig_from_world,
        images,
    })
}

type Lists = (Vec<RigPart>, Vec<FramePart>);

/// Reads `rigs.txt` and `frames.txt`.
pub(super) fn read_text(rigs: &[u8], frames: &[u8]) -> Result<Lists> {
    fn list<T>(bytes: &[u8], read: impl Fn(&mut Words<'_>) -> Result<T>) -> Result<Vec<T>> {
        let lines = content(text::decode(bytes)?);
        lines
            .map(|(line, content)| read(&mut Words::new(line, content)))
            .collect()
    }
    Ok((
        list(rigs, |words| read_rig(words)).map_err(|error| error.in_file("rigs.txt"))?,
        list(frames, |words| read_frame(words)).map_err(|error| error.in_file("frames.txt"))?,
    ))
}

/// Reads `rigs.bin` and `frames.bin`.
pub(super) fn read_binary(rigs: &[u8], frames: &[u8]) -> Result<Lists> {
    fn list<T>(
        bytes: &[u8],
        what: &str,
        size: usize,
        read: impl Fn(&mut Bytes<'_>) -> Result<T>,
    ) -> Result<Vec<T>> {
        let mut bytes = Bytes::new(bytes);
        let count = bytes.count(what, size)?;
        let all = (0..count).map(|_| read(&mut bytes)).collect();
        bytes.end().and(all)
    }
    Ok((
        list(rigs, "rigs", 8, |bytes| read_rig(bytes)).map_err(|e| e.in_file("rigs.bin"))?,
        list(frames, "frames", 68, |bytes| read_frame(bytes))
            .map_err(|e| e.in_file("frames.bin"))?,
    ))
}

fn numbers(pose: &RigidTransform) -> [f64; 7] {
    let (q, t) = (pose.rotation, pose.translation.vector);
    [q.w, q.i, q.j, q.k, t.x, t.y, t.z]
}

impl Model {
    /// Writes `rigs.txt` and `frames.txt`; nothing if each camera moves alone, as COLMAP does not
    /// need them.
    pub(super) fn rigs_text(&self) -> Vec<ModelFile> {
        let all = self.rigs_of_all();
        if all.is_empty() {
            return Vec::new();
        }
        let mut rigs = String::from(
            "# RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID, SENSORS[] as (SENSOR_TYPE, SENSOR_ID, HAS_POSE, [QW, QX, QY, QZ, TX, TY, TZ])\n",
        );
        let mut frames = String::from(
            "# FRAME_ID, RIG_ID, RIG_FROM_WORLD[QW, QX, QY, QZ, TX, TY, TZ], NUM_DATA_IDS, DATA_IDS[] as (SENSOR_TYPE, SENSOR_ID, DATA_ID)\n",
        );
        let words = |pose: &RigidTransform| numbers(pose).map(|x| x.to_string()).join(" ");
        // Writing to a string cannot fail.
        for Rig {
            id,
            cameras,
            frames: of_rig,
        } in &all
        {
            let _ = write!(rigs, "{id} {}", cameras.len());
            for (index, camera) in cameras.iter().enumerate() {
                let _ = write!(rigs, " {CAMERA_NAME} {}", self.camera_id(camera.camera));
                if index > 0 {
                    let _ = write!(rigs, " 1 {}", words(&camera.cam_from_rig));
                }
            }
            rigs.push('\n');
            for frame in of_rig {
                let pose = words(&frame.rig_from_world);
                let _ = write!(frames, "{} {id} {pose} {}", frame.id, frame.images.len());
                for &image in &frame.images {
                    let image = &self.images[image];
                    let camera = self.camera_id(image.camera);
                    let _ = write!(frames, " {CAMERA_NAME} {camera} {}", image.id);
                }
                frames.push('\n');
            }
        }
        vec![
            ModelFile::new("rigs.txt", rigs),
            ModelFile::new("frames.txt", frames),
        ]
    }

    /// Writes `rigs.bin` and `frames.bin`, as [`rigs_text`](Self::rigs_text).
    pub(super) fn rigs_binary(&self) -> Vec<ModelFile> {
        let all = self.rigs_of_all();
        if all.is_empty() {
            return Vec::new();
        }
        let num_frames: usize = all.iter().map(|rig| rig.frames.len()).sum();
        let mut rigs = (all.len() as u64).to_le_bytes().to_vec();
        let mut frames = (num_frames as u64).to_le_bytes().to_vec();
        let sensor = |bytes: &mut Vec<u8>, camera: usize| {
            bytes.extend(CAMERA.to_le_bytes());
            bytes.extend(self.camera_id(camera).to_le_bytes());
        };
        for rig in &all {
            rigs.extend(rig.id.to_le_bytes());
            rigs.extend((rig.cameras.len() as u32).to_le_bytes());
            for (index, camera) in rig.cameras.iter().enumerate() {
                sensor(&mut rigs, camera.camera);
                if index > 0 {
                    rigs.push(1);
                    extend(&mut rigs, &numbers(&camera.cam_from_rig));
                }
            }
            for frame in &rig.frames {
                frames.extend(frame.id.to_le_bytes());
                frames.extend(rig.id.to_le_bytes());
                extend(&mut frames, &numbers(&frame.rig_from_world));
                frames.extend((frame.images.len() as u32).to_le_bytes());
                for &image in &frame.images {
                    let image = &self.images[image];
                    sensor(&mut frames, image.camera);
                    frames.extend(u64::from(image.id).to_le_bytes());
                }
            }
        }
        vec![
            ModelFile::new("rigs.bin", rigs),
            ModelFile::new("frames.bin", frames),
        ]
    }
}
