//! Camera files: reading of many formats, with or without poses, and writing of three.

use super::task::Task;
use crate::project::{Blob, KnownPoses, LensCamera};
use serde::{Deserialize, Serialize};

/// Reads cameras of photographs from a file, or from the files of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReadCameras {
    /// Names and contents of the files.
    pub files: Vec<(String, Blob)>,
    /// Photographs whose poses are looked up. Of several cameras without poses, the first with the
    /// size of a photograph is used; a camera without a size gets the first size.
    pub photos: Vec<PhotoFile>,
}

/// The file of a photograph.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PhotoFile {
    /// Its name.
    pub name: String,
    /// Width and height in the sensor's orientation, pixels, once it is read.
    pub size: Option<(u32, u32)>,
}

impl Task for ReadCameras {
    type Output = CamerasRead;
}

/// Result of reading camera files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum CamerasRead {
    /// A camera, for photographs of its size.
    Camera(LensCamera),
    /// Cameras and poses of photographs.
    Poses(KnownPoses),
}

/// Format of a written camera file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum CameraFormat {
    /// OpenCV's YAML.
    OpenCv,
    /// ROS's YAML.
    Ros,
    /// COLMAP's `cameras.txt`.
    Colmap,
}

impl CameraFormat {
    /// Name of the file.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::OpenCv => "camera.yml",
            Self::Ros => "camera_info.yaml",
            Self::Colmap => "cameras.txt",
        }
    }
}

/// Writes a calibrated camera to a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WriteCamera {
    /// The camera.
    pub camera: LensCamera,
    /// Format of the file.
    pub format: CameraFormat,
}

impl Task for WriteCamera {
    type Output = Blob;
}

#[cfg(feature = "files")]
mod run {
    use super::super::convert::{core_lens_camera, lab_lens_camera};
    use super::super::task::{Monitor, Run};
    use super::{Blob, CameraFormat, CamerasRead, LensCamera, PhotoFile, ReadCameras, WriteCamera};
    use crate::project::{KnownImage, KnownPoses, Pose, file_stem};
    use epipole_io::camera::{self, Cameras, is_camera_file, read_cameras, write_cameras};
    use epipole_io::model::{
        Model, ModelFolder, ModelFormat, ModelImage, format_of_file, read_model_file,
        read_model_folder,
    };

    impl ModelFolder for ReadCameras {
        fn file(&self, name: &str) -> Option<Vec<u8>> {
            let mut files = self.files.iter();
            let (_, bytes) = files.find(|(own, _)| own.eq_ignore_ascii_case(name))?;
            Some(bytes.to_vec())
        }

        fn image_size(&self, name: &str) -> Option<(u32, u32)> {
            let name = file_stem(last_part(name));
            let mut photos = self.photos.iter();
            photos.find(|photo| file_stem(&photo.name) == name)?.size
        }
    }

    impl Run for ReadCameras {
        fn run(self, _monitor: Monitor<'_>) -> Result<CamerasRead, String> {
            if let Some((file, model)) = self.model()?
                && let Some(poses) = self.poses(file, &model)?
            {
                return Ok(CamerasRead::Poses(poses));
            }
            let [(name, file)] = &self.files[..] else {
                let names: Vec<&str> = self.files.iter().map(|(name, _)| &**name).collect();
                return Err(format!(
                    "{}: not the files of one model: open one camera file, or the files of one model",
                    names.join(", ")
                ));
            };
            self.camera(name, file).map(CamerasRead::Camera)
        }
    }

    impl ReadCameras {
        /// Returns the model in the files, and the name of one of them; `None` if they contain
        /// none.
        ///
        /// # Errors
        /// A message for an invalid model, or one without the sizes of its images.
        fn model(&self) -> Result<Option<(&str, Model)>, String> {
            let name = self.files.first().map_or("", |(name, _)| name);
            let is_one_file = self.files.len() == 1 && !is_alone(name);
            let folder = match read_model_folder(self) {
                Err(error) if !is_one_file => return Err(format!("{name}: {error}")),
                // A single file may be a camera file, with error messages of its own.
                found => found.unwrap_or(None),
            };
            let of_file = |(name, bytes): &(String, Blob)| {
                format_of_file(bytes).and(read_model_file(name, bytes, self).ok())
            };
            let read = folder.or_else(|| self.files.iter().find_map(of_file));
            let is_unread = |photo: &PhotoFile| photo.size.is_none();
            match read {
                // The model takes its sizes from the photographs.
                Some(read)
                    if read.format == ModelFormat::Bundler && self.photos.iter().any(is_unread) =>
                {
                    Err(format!(
                        "{name}: a model of Bundler has no image sizes, and the photographs are still being read: open it \
                         again then"
                    ))
                }
                read => Ok(read.map(|read| (name, read.model))),
            }
        }

        /// Returns poses of the photographs; `None` if there are none and the files may be meant as
        /// a camera.
        fn poses(&self, file: &str, model: &Model) -> Result<Option<KnownPoses>, String> {
            let image = |image: &ModelImage| {
                let pose = &image.cam_from_world;
                Some(KnownImage {
                    name: last_part(&image.name).to_owned(),
                    camera: lab_lens_camera(model.cameras.get(image.camera)?),
                    pose: Pose {
                        rotation: pose.rotation.coords.into(),
                        translation: pose.translation.vector.into(),
                    },
                })
            };
            let poses = KnownPoses {
                file: file.to_owned(),
                images: model.images.iter().filter_map(image).collect(),
            };
            let photos = self.photos.iter();
            let num_known = photos
                .filter(|photo| poses.image_of(&photo.name).is_some())
                .count();
            let (num_images, few) = (poses.images.len(), self.photos.len() < 2);
            match (num_known, poses.images.first()) {
                (2.., _) => Ok(Some(poses)),
                // A single file may be opened for its camera.
                _ if self.files.len() == 1 => Ok(None),
                (_, None) => Err(format!("{file}: the model has no images")),
                _ if few => Err(format!(
                    "{file}: the model has poses of {num_images} images: add these photographs first"
                )),
                (_, Some(first)) => {
                    let count = match num_known {
                        0 => "none".to_owned(),
                        count => format!("only {count}"),
                    };
                    Err(format!(
                        "{file}: {count} of the model's {num_images} images has the name of a photograph here, and two are \
                         needed; its first is {}",
                        first.name
                    ))
                }
            }
        }

        /// Reads the camera of a file.
        fn camera(&self, name: &str, file: &[u8]) -> Result<LensCamera, String> {
            let about = |why: String| format!("{name}: {why}");
            if !is_camera_file(file) {
                return Err(about("neither a photograph nor a camera file".to_owned()));
            }
            let sizes = || self.photos.iter().filter_map(|photo| photo.size);
            let (_, cameras) =
                read_cameras(file, sizes().next()).map_err(|error| about(error.to_string()))?;
            let all: Vec<_> = cameras.cameras.iter().map(|named| named.camera).collect();
            let fits = |camera: &&epipole::camera::Camera| {
                let (width, height) = (camera.width, camera.height);
                sizes().any(|size| size == (width, height) || size == (height, width))
            };
            let chosen = match &all[..] {
                [one] => one,
                several => several.iter().find(fits).ok_or_else(|| {
                    let count = several.len();
                    about(match sizes().next().is_none() {
                        true => format!(
                            "it has {count} cameras: add the photographs first, and the one of their size is taken"
                        ),
                        false => format!("it has {count} cameras, and none has the size of a photograph"),
                    })
                })?,
            };
            Ok(lab_lens_camera(chosen))
        }
    }

    /// Whether a file of COLMAP's poses was given without that of its cameras.
    fn is_alone(name: &str) -> bool {
        ["images.txt", "images.bin"].contains(&&*name.to_lowercase())
    }

    fn last_part(path: &str) -> &str {
        path.rsplit(['/', '\\']).next().unwrap_or(path)
    }

    impl Run for WriteCamera {
        fn run(self, _monitor: Monitor<'_>) -> Result<Blob, String> {
            let cameras = Cameras::of(core_lens_camera(&self.camera)?);
            let format = match self.format {
                CameraFormat::OpenCv => camera::CameraFormat::OpenCv,
                CameraFormat::Ros => camera::CameraFormat::Ros,
                CameraFormat::Colmap => camera::CameraFormat::Colmap,
            };
            let text = write_cameras(format, &cameras).map_err(|error| error.to_string())?;
            Ok(text.into_bytes().into())
        }
    }
}
