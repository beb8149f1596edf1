//! Undistorted photos with neighbors and depth ranges.

use crate::argument::{Argument, check_keys, entry};
use crate::fault::Result;
use crate::functions::functions;
use crate::images::Rgb;
use crate::options::Options;
use crate::output::{Indices, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::PosedCamera;
use epipole::image::RgbImage;
use epipole::mvs::{self, MvsOptions, MvsView};
use epipole::nalgebra::Vector2;
use epipole::sfm::Reconstruction;

structs! {
    /// Undistorted photo with its neighbors and depth range.
    struct View as MvsView {
        /// Index of the photo in the reconstruction.
        photo: usize,
        /// Camera without distortion, with the size of the image.
        camera: PosedCamera,
        /// Undistorted pixels.
        image: RgbImage,
        /// Indices of the views to compare with, best first.
        neighbors: Indices,
        /// Smallest and largest depth to search, in the unit of the reconstruction.
        depth_range: [f64; 2],
    }
}

impl Output for MvsView {
    fn typescript(types: &mut Types) -> String {
        View::typescript(types)
    }

    fn into_value(self) -> Value {
        let view = View {
            photo: self.photo,
            camera: self.camera,
            image: self.image,
            neighbors: Indices(self.neighbors),
            depth_range: self.depth_range,
        };
        view.into_value()
    }
}

impl Argument for MvsView {
    fn typescript(types: &mut Types) -> String {
        let camera = <PosedCamera as Argument>::typescript(types);
        Rgb::typescript(types);
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "MvsViewLike",
            "Undistorted photo with its neighbors and depth range.",
            &[
                (
                    "photo",
                    "number",
                    "Index of the photo in the reconstruction.",
                ),
                (
                    "camera",
                    &camera,
                    "Camera without distortion, with the size of the image.",
                ),
                ("image", "ImageLike", "Undistorted pixels."),
                (
                    "neighbors",
                    &indices,
                    "Indices of the views to compare with, best first; 1 to 16.",
                ),
                (
                    "depthRange",
                    "ArrayLike<number>",
                    "Smallest and largest depth to search.",
                ),
            ],
        );
        "MvsViewLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = ["photo", "camera", "image", "neighbors", "depthRange"];
        check_keys(name, value, &keys)?;
        Ok(Self {
            photo: entry::<u32>(name, value, "photo")? as usize,
            camera: entry(name, value, "camera")?,
            image: entry::<Rgb>(name, value, "image")?.0,
            neighbors: entry::<Indices>(name, value, "neighbors")?.0,
            depth_range: entry::<Vector2<f64>>(name, value, "depthRange")?.into(),
        })
    }
}

functions! {
    /// Photos of a reconstruction, undistorted and downscaled, with the neighbors and the depth
    /// range of each. Photos that share no points with another at a sufficient angle are left out.
    fn prepare_views(
        reconstruction: Reconstruction, photos: Vec<Rgb>, options: Options<MvsOptions>; monitor
    ) -> Vec<MvsView> {
        let photos: Vec<RgbImage> = photos.into_iter().map(|photo| photo.0).collect();
        mvs::prepare_views(&reconstruction, &photos, &options.0, monitor)?
    }
}
