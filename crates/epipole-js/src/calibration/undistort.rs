//! Undistortion of photos, and warping by a pixel map.

use crate::argument::{Argument, check_keys, entry, not};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::images::{Image, require_camera, require_size, same_kind};
use crate::options::Setting;
use crate::output::{Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::calibration::{self, Keep};
use epipole::camera::{Camera, Intrinsics};
use epipole::nalgebra::Point2;
use epipole::progress::{Monitor, Part};
use epipole::stereo::{PixelMap, PixelRect};

structs! {
    /// Best camera without distortion for the photos of a camera.
    struct Undistortion as Undistortion {
        /// K of the new camera, with square pixels. Its images have the size of the photos.
        intrinsics: Intrinsics,
        /// Part of the result in which every pixel was photographed.
        valid: PixelRect,
        /// Place in the photo that each pixel of the result is read from, for `remap`.
        map: PixelMap,
    }

    /// Photo without distortion.
    struct UndistortedImage as UndistortedImage {
        /// Image of the kind that was given.
        image: Image,
        /// K of the new camera.
        intrinsics: Intrinsics,
        /// Part of the image in which every pixel was photographed.
        valid: PixelRect,
    }
}

const MAP: &[(&str, &str, &str)] = &[
    ("width", "number", "Width of the result, pixels."),
    ("height", "number", "Height of the result, pixels."),
    (
        "sources",
        "Float32Array",
        "Place (u, v) in the source that each pixel is read from, interleaved; NaN for none.",
    ),
];

impl Output for PixelMap {
    fn typescript(types: &mut Types) -> String {
        types.interface("PixelMap", "Map of pixels of a result to a source.", MAP);
        "PixelMap".to_owned()
    }

    fn into_value(self) -> Value {
        let mut sources = Vec::new();
        for v in 0..self.height() {
            for u in 0..self.width() {
                let place = self
                    .source(u, v)
                    .map(|place| [place.x as f32, place.y as f32]);
                sources.extend(place.unwrap_or([f32::NAN; 2]));
            }
        }
        Value::Record(vec![
            ("width".into(), self.width().into_value()),
            ("height".into(), self.height().into_value()),
            ("sources".into(), Value::Floats(sources)),
        ])
    }
}

impl Argument for PixelMap {
    fn typescript(types: &mut Types) -> String {
        <Self as Output>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["width", "height", "sources"])?;
        let (width, height) = (entry(name, value, "width")?, entry(name, value, "height")?);
        require_size(name, width, height)?;
        let Value::Floats(sources) = value.get("sources") else {
            let expected = "a Float32Array";
            return Err(not(
                &format!("{name}.sources"),
                expected,
                value.get("sources"),
            ));
        };
        let expected = 2 * width as usize * height as usize;
        if sources.len() != expected {
            return Err(Fault::of_range(format!(
                "{name}.sources must have {expected} numbers for {width} x {height} pixels, but \
                 has {}",
                sources.len()
            )));
        }
        let source = |u: u32, v: u32| {
            let place = 2 * (v as usize * width as usize + u as usize);
            let source = Point2::new(sources[place], sources[place + 1]).cast::<f64>();
            (source.x.is_finite() && source.y.is_finite()).then_some(source)
        };
        Ok(Self::from_fn(width, height, source, &mut ())?)
    }
}

/// Creates the undistortion of the core.
fn of_camera(
    camera: &Camera,
    keep: Option<Setting<Keep>>,
    monitor: &mut dyn Monitor,
) -> Result<calibration::Undistortion> {
    require_size("camera", camera.width, camera.height)?;
    let keep = keep.map_or(Keep::default(), |keep| keep.0);
    Ok(calibration::Undistortion::new(camera, keep, monitor)?)
}

functions! {
    /// Best camera without distortion for the photos of a camera, and the map to its images: valid
    /// keeps the area that was photographed everywhere, all keeps everything, with black borders.
    fn undistortion_map(camera: Camera, keep: Option<Setting<Keep>>; monitor) -> Undistortion {
        let found = of_camera(&camera, keep, monitor)?;
        Undistortion { intrinsics: found.intrinsics, valid: found.valid, map: found.map }
    }

    /// Photo redrawn without the distortion of its camera; `keep` as for `undistortionMap`.
    fn undistort_image(
        image: Image, camera: Camera, keep: Option<Setting<Keep>>; monitor
    ) -> UndistortedImage {
        require_camera("image", &image, &camera)?;
        let found = of_camera(&camera, keep, &mut Part::new(monitor, 0.0, 0.7))?;
        let warp = &mut Part::new(monitor, 0.7, 1.0);
        UndistortedImage {
            image: same_kind!(&image, |pixels| found.map.warp(pixels, warp)?),
            intrinsics: found.intrinsics,
            valid: found.valid,
        }
    }

    /// Image redrawn by a map, bilinear; 0 where nothing is read.
    fn remap(image: Image, map: PixelMap; monitor) -> Image {
        same_kind!(&image, |pixels| map.warp(pixels, monitor)?)
    }
}
