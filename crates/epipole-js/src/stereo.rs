//! Rectification, dense disparity, depth.

use crate::argument::Vectors;
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::images::{Image, require_camera, same_kind};
use crate::options::Options;
use crate::output::{Numbers, records, structs};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::image::GrayImage;
use epipole::imaging::GrayImage32;
use epipole::nalgebra::{Matrix3, Matrix4};
use epipole::progress::{Monitor, Part};
use epipole::stereo::{
    self, DepthInterval, DisparityImage, PixelRect, RectifyOptions, StereoBm, StereoSgm,
};

records! {
    /// Depths that a disparity and its error allow.
    DepthInterval as DepthInterval {
        /// Smallest depth, meters.
        near_m: f64,
        /// Largest depth, meters; null if the interval reaches infinity.
        far_m: Option<f64>,
    }

    /// Rectangle of pixels.
    PixelRect as PixelRect {
        /// Left.
        u_min: f64,
        /// Top.
        v_min: f64,
        /// Right.
        u_max: f64,
        /// Bottom.
        v_max: f64,
    }
}

structs! {
    /// Rectification of a rig: matches share a row, or a column if it is vertical.
    struct Rectification as Rectification {
        /// Homography from undistorted pixels of image 1 to the rectified image.
        homography1: Matrix3<f64>,
        /// The same of image 2.
        homography2: Matrix3<f64>,
        /// K of rectified image 1.
        intrinsics1: Intrinsics,
        /// K of rectified image 2.
        intrinsics2: Intrinsics,
        /// Rotation from camera 1 to the rectified camera, 9 numbers by row.
        rotation1: Matrix3<f64>,
        /// The same of camera 2.
        rotation2: Matrix3<f64>,
        /// Matrix from (u, v, disparity, 1) to homogeneous points, 16 numbers by row.
        q: Matrix4<f64>,
        /// Whether matches share a column.
        is_vertical: bool,
        /// Distance of the camera centers, meters.
        baseline_m: f64,
        /// Width of the rectified images, pixels.
        width: u32,
        /// Height of the rectified images, pixels.
        height: u32,
    }

    /// Rectified images of a rig.
    struct RectifiedImages as RectifiedImages {
        /// Image 1, of the kind that was given.
        image1: Image,
        /// Image 2.
        image2: Image,
        /// Rectification.
        rectification: Rectification,
    }

    /// Rectification without calibration.
    struct UncalibratedRectification as UncalibratedRectification {
        /// Homography of image 1.
        homography1: Matrix3<f64>,
        /// Homography of image 2.
        homography2: Matrix3<f64>,
        /// Whether matches share a column.
        is_vertical: bool,
        /// Smallest and largest disparity of the matches, pixels.
        disparity_range_px: Numbers,
        /// Bounds of image 1.
        outline1: PixelRect,
        /// Bounds of image 2.
        outline2: PixelRect,
    }
}

impl From<&stereo::Rectification> for Rectification {
    fn from(rig: &stereo::Rectification) -> Self {
        Self {
            homography1: rig.homographies[0],
            homography2: rig.homographies[1],
            intrinsics1: rig.intrinsics[0],
            intrinsics2: rig.intrinsics[1],
            rotation1: rig.rect_from_cam[0].into_inner(),
            rotation2: rig.rect_from_cam[1].into_inner(),
            q: rig.q,
            is_vertical: rig.is_vertical,
            baseline_m: rig.baseline_m,
            width: rig.width,
            height: rig.height,
        }
    }
}

/// Matches two images of equal kind.
fn disparity(
    left: Image,
    right: Image,
    monitor: &mut dyn Monitor,
    bytes: impl FnOnce(&GrayImage, &GrayImage, &mut dyn Monitor) -> epipole::Result<DisparityImage>,
    floats: impl FnOnce(&GrayImage32, &GrayImage32, &mut dyn Monitor) -> epipole::Result<DisparityImage>,
) -> Result<GrayImage32> {
    let found = match (left.into_gray(), right.into_gray()) {
        (Image::Gray8(left), Image::Gray8(right)) => bytes(&left, &right, monitor)?,
        (Image::Gray32(left), Image::Gray32(right)) => floats(&left, &right, monitor)?,
        _ => {
            let message = "left and right must be both bytes or both floats";
            return Err(Fault::of_type(message.to_owned()));
        }
    };
    Ok(found.into_image())
}

/// Reads a disparity image, in which NaN stands for pixels without a match.
pub(crate) struct Disparity(pub(crate) DisparityImage);

impl crate::argument::Argument for Disparity {
    fn typescript(types: &mut crate::types::Types) -> String {
        <GrayImage32 as crate::output::Output>::typescript(types)
    }

    fn read(name: &str, value: &crate::value::Value) -> Result<Self> {
        use crate::argument::{check_keys, entry, not};
        use crate::value::Value;
        check_keys(name, value, &["width", "height", "data"])?;
        let Value::Floats(values) = value.get("data") else {
            return Err(not(
                &format!("{name}.data"),
                "a Float32Array",
                value.get("data"),
            ));
        };
        let (width, height) = (entry(name, value, "width")?, entry(name, value, "height")?);
        DisparityImage::from_raw(width, height, values.clone())
            .map(Self)
            .map_err(|error| Fault::of_range(format!("{name}: {error}")))
    }
}

functions! {
    /// Rectifies a calibrated rig with cameras of the same size.
    fn rectify_calibrated(
        camera1: Camera, camera2: Camera, cam2_from_cam1: RigidTransform,
        options: Options<RectifyOptions>
    ) -> Rectification {
        let rig = stereo::rectify_calibrated(&[camera1, camera2], &cam2_from_cam1, &options.0)?;
        Rectification::from(&rig)
    }

    /// Rectifies a calibrated rig and its images; pixels that the camera did not see are black.
    fn rectify_images(
        image1: Image, image2: Image, camera1: Camera, camera2: Camera,
        cam2_from_cam1: RigidTransform, options: Options<RectifyOptions>; monitor
    ) -> RectifiedImages {
        require_camera("image1", &image1, &camera1)?;
        require_camera("image2", &image2, &camera2)?;
        let rig = stereo::rectify_calibrated(&[camera1, camera2], &cam2_from_cam1, &options.0)?;
        let map1 = rig.map(0, &mut Part::new(monitor, 0.0, 0.25))?;
        let map2 = rig.map(1, &mut Part::new(monitor, 0.25, 0.5))?;
        let part1 = &mut Part::new(monitor, 0.5, 0.75);
        let image1 = same_kind!(&image1, |pixels| map1.warp(pixels, part1)?);
        let part2 = &mut Part::new(monitor, 0.75, 1.0);
        RectifiedImages {
            image1,
            image2: same_kind!(&image2, |pixels| map2.warp(pixels, part2)?),
            rectification: Rectification::from(&rig),
        }
    }

    /// Rectifies two images from their fundamental matrix and matches without outliers.
    fn rectify_uncalibrated(
        fundamental: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>, width: u32,
        height: u32
    ) -> UncalibratedRectification {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let found = stereo::rectify_uncalibrated(&fundamental, &pixels1, &pixels2, width, height)?;
        let (smallest, largest) = found.disparity_range_px;
        UncalibratedRectification {
            homography1: found.homographies[0],
            homography2: found.homographies[1],
            is_vertical: found.is_vertical,
            disparity_range_px: Numbers(vec![smallest, largest]),
            outline1: found.outlines[0],
            outline2: found.outlines[1],
        }
    }

    /// Disparities `uLeft - uRight` of the pixels of a rectified image by block matching; NaN
    /// without a match.
    fn stereo_bm(left: Image, right: Image, options: Options<StereoBm>; monitor) -> GrayImage32 {
        disparity(
            left, right, monitor,
            |left, right, monitor| options.0.compute(left, right, monitor),
            |left, right, monitor| options.0.compute_f32(left, right, monitor),
        )?
    }

    /// Disparities `uLeft - uRight` of the pixels of a rectified image by semi-global matching;
    /// NaN without a match.
    fn stereo_sgm(left: Image, right: Image, options: Options<StereoSgm>; monitor) -> GrayImage32 {
        disparity(
            left, right, monitor,
            |left, right, monitor| options.0.compute(left, right, monitor),
            |left, right, monitor| options.0.compute_f32(left, right, monitor),
        )?
    }

    /// Removes connected regions of fewer than `minSize` pixels, whose neighbors differ by at most
    /// `rangePx`.
    fn remove_speckles(disparity: Disparity, min_size: u32, range_px: f64; monitor) -> GrayImage32 {
        let mut disparity = disparity.0;
        stereo::remove_speckles(&mut disparity, min_size, range_px as f32, monitor)?;
        disparity.into_image()
    }

    /// Disparities with all gaps filled by the background beside them, along edges of the left
    /// image, which has bytes.
    fn fill_gaps(disparity: Disparity, left: Image; monitor) -> GrayImage32 {
        let Image::Gray8(left) = left.into_gray() else {
            let message = "left must be an image of bytes, but has floats";
            return Err(Fault::of_type(message.to_owned()));
        };
        stereo::fill_gaps(&disparity.0, &left, monitor)?.into_image()
    }

    /// Matrix Q of a rectified rig, for `pointCloud`, 16 numbers by row.
    fn q_from_rig(focal_px: f64, baseline_m: f64, cu_px: f64, cv_px: f64) -> Matrix4<f64> {
        stereo::q_from_rig(focal_px, baseline_m, cu_px, cv_px)?
    }

    /// Depth of every pixel, meters; NaN without disparity or where it is not positive.
    fn depth_image(disparity: Disparity, focal_px: f64, baseline_m: f64) -> GrayImage32 {
        stereo::depth_image(&disparity.0, focal_px, baseline_m)?
    }

    /// Points of all pixels with a disparity, interleaved, by the matrix Q of a rectification.
    fn point_cloud(disparity: Disparity, q: Matrix4<f64>) -> Numbers {
        Numbers::of_points(&stereo::point_cloud(&disparity.0, &q, None)?.points)
    }

    /// Depth of a disparity, meters.
    fn depth_from_disparity(focal_px: f64, baseline_m: f64, disparity_px: f64) -> f64 {
        stereo::depth_from_disparity(focal_px, baseline_m, disparity_px)?
    }

    /// Depths of a disparity that is wrong by at most `errorPx` pixels.
    fn depth_interval(
        focal_px: f64, baseline_m: f64, disparity_px: f64, error_px: f64
    ) -> DepthInterval {
        stereo::depth_interval(focal_px, baseline_m, disparity_px, error_px)?
    }
}
