//! Choice of the sharpest frame in a part of a video.

use super::task::Task;
#[cfg(feature = "files")]
use super::task::{Monitor, Run, report};
use crate::project::Blob;
use serde::{Deserialize, Serialize};

/// Chooses the sharpest frame of a part of a video.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChooseFrame {
    /// Name of the video.
    pub name: String,
    /// Index of the part.
    pub part: u32,
    /// Some frames of it, as image files.
    pub frames: Vec<Blob>,
}

impl Task for ChooseFrame {
    /// The frame as a file whose name contains the number of the part; empty if no frame is
    /// readable.
    type Output = Vec<(String, Blob)>;
}

#[cfg(feature = "files")]
impl Run for ChooseFrame {
    /// Chooses just as `epipole frames` does.
    fn run(self, monitor: Monitor<'_>) -> Result<Vec<(String, Blob)>, String> {
        use epipole::feature::photo_to_gray;
        use epipole::imaging::sharpness;
        use epipole_io::photo::{DecodeOptions, decode_rgb};
        let Self { name, part, frames } = self;
        let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
        let num_frames = frames.len();
        let mut best: Option<(f64, Blob)> = None;
        // One decoded frame at a time.
        for (index, frame) in frames.into_iter().enumerate() {
            let share = index as f32 / num_frames as f32;
            report(monitor, share, "looking for the sharpest frame")?;
            let Ok(decoded) = decode_rgb(&frame, &DecodeOptions::default()) else {
                continue;
            };
            let value = sharpness(&photo_to_gray(&decoded.image));
            // Of equal values, the first wins.
            if best.as_ref().is_none_or(|(most, _)| value > *most) {
                best = Some((value, frame));
            }
        }
        let named = |(_, frame)| (format!("{stem}-{:02}.jpg", part + 1), frame);
        Ok(best.map(named).into_iter().collect())
    }
}

#[cfg(all(test, feature = "files"))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::tasks::Progress;
    use epipole::feature::photo_to_gray;
    use epipole::imaging::sharpness;
    use epipole_scenes::{Sampling, Scene, still_life_camera};
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

    /// Applies the motion blur of a camera that moves sideways by this many pixels during exposure.
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
        let go_on = &mut |_: Progress<'_>| ControlFlow::Continue(());
        let chosen = |frames: &[Blob], go_on: Monitor<'_>| {
            let task = ChooseFrame {
                name: "walk.mp4".to_owned(),
                part: 2,
                frames: frames.to_vec(),
            };
            task.run(go_on)
        };
        let expected = |frame: &Blob| Ok(vec![("walk-03.jpg".to_owned(), frame.clone())]);
        assert_eq!(chosen(&frames, go_on), expected(&frames[1]));
        let some = [broken.clone(), frames[2].clone(), frames[0].clone()];
        assert_eq!(chosen(&some, go_on), expected(&frames[0]));
        assert_eq!(chosen(&[broken], go_on), Ok(Vec::new()));
        assert_eq!(chosen(&[], go_on), Ok(Vec::new()));
        let stop = &mut |_: Progress<'_>| ControlFlow::Break(());
        assert_eq!(chosen(&frames, stop), Err("stopped".to_owned()));
    }
}
