//! The complete scale space, for inspection.

use super::options::{SiftOptions, check};
use super::scale_space::{Octave, OctaveGrid};
use crate::Result;
use crate::imaging::{Border, GrayImage32, from_vec, require_finite, sample_bilinear};
use crate::math::monitored;
use crate::progress::{Monitor, Part, Stage};

/// Increasingly blurred images, and the differences of successive blurs, in which
/// [`detect_sift`](super::detect_sift) finds extrema.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleSpace {
    /// Octaves, each with half as many samples along an axis as the previous one.
    pub octaves: Vec<ScaleOctave>,
}

/// Layers with samples at the same positions.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleOctave {
    /// log₂ of the pixels of the image per sample.
    pub octave: i32,
    /// Pixels of the image per sample.
    pub step_px: f64,
    /// Position of the first sample, pixels of the image.
    pub origin: [f64; 2],
    /// Blurred images, `layers_per_octave + 3` of them.
    pub blurred: Vec<GrayImage32>,
    /// Standard deviation of the blur of each image, pixels of the original.
    pub sigmas_px: Vec<f64>,
    /// Each blurred image minus the previous one: one fewer.
    pub differences: Vec<GrayImage32>,
}

/// Computes the scale space of an image.
///
/// Difference k of an octave is `G(σₖ₊₁) ∗ I − G(σₖ) ∗ I`. Its extrema have the blur `σₖ`. An image
/// smaller than about a dozen pixels has no octaves. The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// As [`detect_sift`](super::detect_sift).
///
/// Source: Lowe 2004, §3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{SiftOptions, scale_space};
/// use epipole::imaging::GrayImage32;
/// let space = scale_space(&GrayImage32::new(64, 48), &SiftOptions::default(), &mut ())?;
/// let first = &space.octaves[0];
/// assert_eq!((first.step_px, first.blurred.len(), first.differences.len()), (0.5, 6, 5));
/// assert_eq!(first.blurred[0].dimensions(), (127, 95));
/// assert!((first.sigmas_px[3] - 1.6).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn scale_space(
    image: &GrayImage32,
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<ScaleSpace> {
    check(options)?;
    require_finite(image)?;
    let last = options.layers_per_octave + 2;
    let mut octaves = Vec::new();
    let stage = Stage::FeatureDetection;
    let mut next = OctaveGrid::first(
        image,
        options,
        &mut Part::new(monitor, 0.0, 0.1).of_stage(stage),
    )?;
    // Each octave has a quarter of the previous one's samples.
    let mut done = 0.1;
    while let Some(grid) = next {
        let end = 1.0 - 0.25 * (1.0 - done);
        let mut octave = Octave::new(grid, Default::default(), options);
        let at = |k: f32| done + (end - done) * k / (last + 1) as f32;
        let part = &mut Part::new(monitor, done, done).of_stage(stage);
        octave.advance_to(1, part)?;
        next = octave.next_grid(part)?;
        let mut blurred: Vec<GrayImage32> = Vec::new();
        let mut differences = Vec::new();
        for k in 0..=last {
            let fractions = [0.0, 0.7, 1.0].map(|part| at(k as f32 + part));
            let blur = &mut Part::new(monitor, fractions[0], fractions[1]).of_stage(stage);
            octave.advance_to(k.max(3) - 2, blur)?;
            blurred.push(octave.layer(k).clone());
            if let [.., less, more] = blurred.as_slice() {
                let part = &mut Part::new(monitor, fractions[1], fractions[2]);
                differences.push(difference(more, less, part)?);
            }
        }
        done = end;
        let grid = octave.grid();
        octaves.push(ScaleOctave {
            octave: grid.octave,
            step_px: grid.step,
            origin: [grid.origin_u, grid.origin_v],
            sigmas_px: (0..=last)
                .map(|k| octave.sigma_at(k as f64) * grid.step)
                .collect(),
            differences,
            blurred,
        });
    }
    Ok(ScaleSpace { octaves })
}

fn difference(
    more: &GrayImage32,
    less: &GrayImage32,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    let (width, height) = less.dimensions();
    let mut values = vec![0.0; less.as_raw().len()];
    let stage = Stage::FeatureDetection;
    monitored::for_each_chunk(&mut values, width as usize, stage, monitor, |from, row| {
        let pairs = more.as_raw()[from..].iter().zip(&less.as_raw()[from..]);
        for (value, (more, less)) in row.iter_mut().zip(pairs) {
            *value = more - less;
        }
    })?;
    Ok(from_vec(width, height, values))
}

impl ScaleSpace {
    /// Returns the responses of the differences at a pixel: pairs of the blur in pixels and the
    /// difference, by increasing blur. Each octave contributes the layers that are searched for
    /// extrema.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::feature::{SiftOptions, scale_space};
    /// use epipole::imaging::GrayImage32;
    /// // A bright blob of standard deviation 5 has its maximum response near that blur.
    /// let blob = GrayImage32::from_fn(129, 129, |u, v| {
    ///     let (x, y) = (u as f32 - 64.0, v as f32 - 64.0);
    ///     image::Luma([libm::expf(-(x * x + y * y) / 50.0)])
    /// });
    /// let answers = scale_space(&blob, &SiftOptions::default(), &mut ())?.answers(64.0, 64.0);
    /// let least = answers.iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    /// assert!(least.0 > 4.0 && least.0 < 5.5 && least.1 < 0.0);
    /// # Ok(()) }
    /// ```
    pub fn answers(&self, u: f64, v: f64) -> Vec<(f64, f64)> {
        let octaves = self.octaves.iter().flat_map(|octave| {
            let (x, y) = (u - octave.origin[0], v - octave.origin[1]);
            let (x, y) = (x / octave.step_px, y / octave.step_px);
            let inner = 1..octave.differences.len() - 1;
            inner.map(move |k| {
                let value = sample_bilinear(&octave.differences[k], x, y, Border::Replicate);
                (octave.sigmas_px[k], f64::from(value))
            })
        });
        octaves.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::detect_sift;
    use crate::imaging::{fixture, gray_to_f32};

    #[test]
    fn features_are_extrema_of_the_answers() {
        let image = gray_to_f32(&fixture::gray8("sift_image.npy"));
        let options = SiftOptions::default();
        let space = scale_space(&image, &options, &mut ()).unwrap();
        let found = detect_sift(&image, &options, &mut ()).unwrap();
        let mut count = 0;
        for keypoint in &found.keypoints {
            let answers = space.answers(keypoint.u, keypoint.v);
            let near = answers.iter().position(|(sigma, _)| {
                (libm::log2(*sigma / f64::from(keypoint.scale_px)) * 3.0).abs() <= 0.5
            });
            let Some(k) = near.filter(|k| (1..answers.len() - 1).contains(k)) else {
                continue;
            };
            let [before, here, after] = [k - 1, k, k + 1].map(|k| answers[k].1.abs());
            count += usize::from(here >= 0.95 * before && here >= 0.95 * after);
        }
        assert!(
            10 * count >= 8 * found.keypoints.len(),
            "{count} of {}",
            found.keypoints.len()
        );
    }

    #[test]
    fn sigmas_grow_from_octave_to_octave() {
        let image = GrayImage32::new(100, 80);
        for layers_per_octave in [1, 3, 5] {
            let options = SiftOptions {
                layers_per_octave,
                ..SiftOptions::default()
            };
            let space = scale_space(&image, &options, &mut ()).unwrap();
            let sigmas: Vec<f64> = space.answers(3.0, 4.0).iter().map(|a| a.0).collect();
            let factor = libm::exp2(1.0 / layers_per_octave as f64);
            for pair in sigmas.windows(2) {
                assert!((pair[1] / pair[0] - factor).abs() < 1e-9);
            }
            assert_eq!(space.octaves[1].step_px, 1.0);
            assert_eq!(space.octaves[0].blurred.len(), layers_per_octave + 3);
        }
        assert!(
            scale_space(&GrayImage32::new(4, 4), &SiftOptions::default(), &mut ())
                .unwrap()
                .octaves
                .is_empty()
        );
    }
}
