//! Panoramas.

use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::Result;
use crate::functions::functions;
use crate::images::Rgb;
use crate::options::{NoOptions, Options, Setting};
use crate::output::{Numbers, Output, structs};
use crate::sfm::pose_graph::count;
use crate::types::Types;
use crate::value::Value;
use epipole::camera::Intrinsics;
use epipole::image::RgbImage;
use epipole::nalgebra::Matrix3;
use epipole::stitch::{self, Overlap, OverlapOptions, Panorama, RenderOptions};

structs! {
    /// Two overlapping photos and their inliers.
    struct OverlapOfPhotos as Overlap {
        /// Index of the first photo.
        image1: usize,
        /// Index of the second photo.
        image2: usize,
        /// Inliers in the first photo, interleaved.
        pixels1: Numbers,
        /// Their matches in the second photo, interleaved.
        pixels2: Numbers,
        /// Homography from the first photo to the second.
        homography: Matrix3<f64>,
        /// Number of matches, including outliers.
        num_matches: usize,
        /// Whether the matches show parallax: the camera moved, and no homography fits all of
        /// them.
        has_parallax: bool,
    }

    /// Photos in the frame of a panorama, which looks along z with y down.
    struct PlacedPhotos as Panorama {
        /// Matrix of each photo from directions of the panorama to homogeneous pixels; null
        /// without overlap.
        pixel_from_direction: Vec<Option<Matrix3<f64>>>,
        /// Rotation of each camera, for rotating cameras: `dInCam = R d`.
        rotations: Vec<Option<Matrix3<f64>>>,
        /// Pixels per unit of a direction at z = 1: the focal length, for rotating cameras.
        scale_px: f64,
        /// Common factor of the focal lengths, if it was estimated.
        focal_factor: Option<f64>,
    }
}

impl Output for Overlap {
    fn typescript(types: &mut Types) -> String {
        OverlapOfPhotos::typescript(types)
    }

    fn into_value(self) -> Value {
        let overlap = OverlapOfPhotos {
            image1: self.images[0],
            image2: self.images[1],
            pixels1: Numbers::of_points(&self.pixels[0]),
            pixels2: Numbers::of_points(&self.pixels[1]),
            homography: self.homography,
            num_matches: self.num_matches,
            has_parallax: self.has_parallax,
        };
        overlap.into_value()
    }
}

impl Argument for Overlap {
    fn typescript(types: &mut Types) -> String {
        let pixels = Vectors::<2>::typescript(types);
        let matrix = <Matrix3<f64> as Argument>::typescript(types);
        types.interface(
            "OverlapLike",
            "Two overlapping photos and their inliers.",
            &[
                ("image1", "number", "Index of the first photo."),
                ("image2", "number", "Index of the second photo."),
                ("pixels1", &pixels, "Inliers in the first photo."),
                ("pixels2", &pixels, "Their matches in the second photo."),
                (
                    "homography",
                    &matrix,
                    "Homography from the first photo to the second.",
                ),
                (
                    "numMatches?",
                    "number",
                    "Number of matches, including outliers. That of the inliers if not given.",
                ),
                (
                    "hasParallax?",
                    "boolean",
                    "Whether the matches show parallax. False if not given.",
                ),
            ],
        );
        "OverlapLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = [
            "image1",
            "image2",
            "pixels1",
            "pixels2",
            "homography",
            "numMatches",
            "hasParallax",
        ];
        check_keys(name, value, &keys)?;
        let index = |key| -> Result<usize> { Ok(entry::<u32>(name, value, key)? as usize) };
        let pixels = |key| entry::<Vectors<2>>(name, value, key);
        let (pixels1, pixels2) = crate::pairs::zip(
            (&format!("{name}.pixels1"), pixels("pixels1")?),
            (&format!("{name}.pixels2"), pixels("pixels2")?),
        )?;
        let num_matches = entry::<Option<u32>>(name, value, "numMatches")?;
        let has_parallax = entry::<Option<Setting<bool>>>(name, value, "hasParallax")?;
        Ok(Self {
            images: [index("image1")?, index("image2")?],
            num_matches: num_matches.map_or(pixels1.len(), |count| count as usize),
            pixels: [pixels1, pixels2],
            homography: entry(name, value, "homography")?,
            has_parallax: has_parallax.is_some_and(|flag| flag.0),
        })
    }
}

impl Output for Panorama {
    fn typescript(types: &mut Types) -> String {
        PlacedPhotos::typescript(types)
    }

    fn into_value(self) -> Value {
        let placed = PlacedPhotos {
            pixel_from_direction: self.pixel_from_direction,
            rotations: self.rotations,
            scale_px: self.scale_px,
            focal_factor: self.focal_factor,
        };
        placed.into_value()
    }
}

impl Argument for Panorama {
    fn typescript(types: &mut Types) -> String {
        let matrices = <Vec<Option<Matrix3<f64>>> as Argument>::typescript(types);
        types.interface(
            "PanoramaLike",
            "Photos in the frame of a panorama, which looks along z with y down.",
            &[
                (
                    "pixelFromDirection",
                    &matrices,
                    "Matrix of each photo from directions of the panorama to homogeneous pixels; \
                     null for photos to leave out.",
                ),
                (
                    "rotations?",
                    &format!("{matrices} | null"),
                    "Rotation of each camera.",
                ),
                (
                    "scalePx",
                    "number",
                    "Pixels per unit of a direction at z = 1.",
                ),
                (
                    "focalFactor?",
                    "number | null",
                    "Common factor of the focal lengths.",
                ),
            ],
        );
        "PanoramaLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = ["pixelFromDirection", "rotations", "scalePx", "focalFactor"];
        check_keys(name, value, &keys)?;
        let pixel_from_direction: Vec<_> = entry(name, value, "pixelFromDirection")?;
        let rotations = entry::<Option<Vec<_>>>(name, value, "rotations")?;
        Ok(Self {
            rotations: rotations.unwrap_or_else(|| vec![None; pixel_from_direction.len()]),
            pixel_from_direction,
            scale_px: entry(name, value, "scalePx")?,
            focal_factor: entry(name, value, "focalFactor")?,
        })
    }
}

functions! {
    /// Homography on which the matches of two photos agree, with its inliers; null if no more
    /// matches agree than wrong ones might by chance. `image1` and `image2` are the indices of the
    /// photos.
    fn find_overlap(
        image1: u32, image2: u32, pixels1: Vectors<2>, pixels2: Vectors<2>,
        options: Options<OverlapOptions>; monitor
    ) -> Option<Overlap> {
        let images = [image1 as usize, image2 as usize];
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        stitch::find_overlap(images, &pixels1, &pixels2, &options.0, monitor)?
    }

    /// Rotations of photos from one position, from their overlaps and the intrinsics of each. With
    /// `findFocal`, also a common factor of all focal lengths, from 1/4 to 4.
    fn estimate_panorama(
        intrinsics: Vec<Intrinsics>, overlaps: Vec<Overlap>, find_focal: Option<Setting<bool>>,
        options: NoOptions; monitor
    ) -> Panorama {
        let NoOptions = options;
        let find_focal = find_focal.is_some_and(|flag| flag.0);
        stitch::estimate_panorama(&intrinsics, &overlaps, find_focal, monitor)?
    }

    /// Positions of `numImages` photos of one plane, by homographies from one to the next; to
    /// render on the surface "plane".
    fn chain_homographies(num_images: u32, overlaps: Vec<Overlap>) -> Panorama {
        stitch::chain_homographies(count("numImages", num_images)?, &overlaps)?
    }

    /// Picture of all photos of a panorama, blended; black where there is none.
    fn render_panorama(
        panorama: Panorama, photos: Vec<Rgb>, options: Options<RenderOptions>; monitor
    ) -> RgbImage {
        let photos: Vec<&RgbImage> = photos.iter().map(|photo| &photo.0).collect();
        stitch::render_panorama(&panorama, &photos, &options.0, monitor)?
    }
}
