//! The sharpest of the frames that a video has in each of its parts.

use super::{Blob, Progress, Told};
use epipole::feature::photo_to_gray;
use epipole::imaging::{DecodeOptions, GrayImage32, decode_rgb, laplacian_pyramid};

/// Of each part the sharpest frame, with a name that says which part; parts of which no frame can be read are left
/// out.
///
/// # Errors
/// A sentence, if none of all can be read, and if `progress` wants no more.
pub(super) fn sharpest(
    video: &str,
    parts: Vec<Vec<Blob>>,
    progress: Progress<'_>,
) -> Result<Vec<(String, Blob)>, String> {
    let num_parts = parts.len();
    let stem = video.rsplit_once('.').map_or(video, |(stem, _)| stem);
    let mut chosen = Vec::new();
    for (part, frames) in parts.into_iter().enumerate() {
        let share = part as f32 / num_parts as f32;
        if progress(Told::Share(share, "looking for the sharpest frames")).is_break() {
            return Err("stopped".to_owned());
        }
        let measured = frames.into_iter().filter_map(|frame| {
            let decoded = decode_rgb(&frame, &DecodeOptions::default()).ok()?;
            Some((sharpness(&photo_to_gray(&decoded.image)), frame))
        });
        // The first of equals.
        let best = measured.reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((_, frame)) = best {
            chosen.push((format!("{stem}-{:02}.jpg", part + 1), frame));
        }
    }
    match chosen.is_empty() {
        true => Err(format!("no frame of {video} can be read")),
        false => Ok(chosen),
    }
}

/// The mean square of what a photograph shows between one and two steps of its Laplacian pyramid: blur takes details of
/// a few pixels away. Single pixels do not count, since they are mostly noise, and what a codec makes of it.
///
/// Source: Burt & Adelson 1983, §3, for the pyramid.
fn sharpness(image: &GrayImage32) -> f64 {
    // Two differences, and what is left.
    let levels = laplacian_pyramid(image, 3);
    let Some(band) = levels.get(1).filter(|_| levels.len() == 3) else {
        return 0.0;
    };
    let values = band.as_raw();
    let sum: f64 = values.iter().map(|v| f64::from(*v) * f64::from(*v)).sum();
    sum / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use epipole::synthetic::{Sampling, Scene, still_life_camera};
    use image::{RgbImage, imageops};
    use std::io::Cursor;
    use std::ops::ControlFlow;

    fn photograph() -> RgbImage {
        let camera = still_life_camera(240, 180);
        let scene = Scene::still_life();
        scene
            .render(&camera, 240, 180, Sampling::Full)
            .unwrap()
            .image
    }

    /// As a camera that moves to the side by so many pixels while it is open.
    fn smeared(image: &RgbImage, by: u32) -> RgbImage {
        RgbImage::from_fn(image.width(), image.height(), |u, v| {
            let mut sum = [0_u32; 3];
            for k in 0..by {
                let pixel = image.get_pixel((u + k).min(image.width() - 1), v);
                for (sum, value) in sum.iter_mut().zip(pixel.0) {
                    *sum += u32::from(value);
                }
            }
            image::Rgb(sum.map(|sum| (sum / by) as u8))
        })
    }

    fn jpeg(image: &RgbImage) -> Blob {
        let mut bytes = Cursor::new(Vec::new());
        image
            .write_to(&mut bytes, image::ImageFormat::Jpeg)
            .unwrap();
        bytes.into_inner().into()
    }

    #[test]
    fn the_frame_that_was_blurred_least_is_chosen() {
        let sharp = photograph();
        let measure = |image: &RgbImage| sharpness(&photo_to_gray(image));
        let by_motion = [1, 2, 4, 8].map(|by| measure(&smeared(&sharp, by)));
        assert!(
            by_motion.windows(2).all(|two| two[1] < two[0]),
            "{by_motion:?}"
        );
        let by_focus = [0.8, 1.6, 3.2].map(|sigma| measure(&imageops::blur(&sharp, sigma)));
        assert!(measure(&sharp) > by_focus[0], "{by_focus:?}");
        assert!(
            by_focus.windows(2).all(|two| two[1] < two[0]),
            "{by_focus:?}"
        );

        let frames = [4, 1, 8].map(|by| jpeg(&smeared(&sharp, by)));
        let broken = Blob::from(vec![0xFF, 0xD8, 0xFF, 0]);
        let parts = vec![
            frames.to_vec(),
            vec![broken.clone()],
            vec![broken.clone(), frames[2].clone(), frames[0].clone()],
        ];
        let go_on = &mut |_: Told<'_>| ControlFlow::Continue(());
        let chosen = sharpest("walk.mp4", parts, go_on).unwrap();
        let expected = [
            ("walk-01.jpg".to_owned(), frames[1].clone()),
            ("walk-03.jpg".to_owned(), frames[0].clone()),
        ];
        assert_eq!(chosen, expected);
        let refused = sharpest("walk.mp4", vec![vec![broken]], go_on).unwrap_err();
        assert!(refused.contains("no frame of walk.mp4"), "{refused}");
        assert!(sharpest("walk", Vec::new(), go_on).is_err());
        let stop = &mut |_: Told<'_>| ControlFlow::Break(());
        assert_eq!(
            sharpest("a", vec![frames.to_vec()], stop),
            Err("stopped".to_owned())
        );
        for (width, height) in [(1, 1), (2, 1), (0, 0), (5, 3)] {
            let tiny = GrayImage32::new(width, height);
            assert_eq!(sharpness(&tiny), 0.0);
        }
    }
}
