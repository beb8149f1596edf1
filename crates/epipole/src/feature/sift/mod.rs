//! SIFT: keypoints that survive scaling and rotation, and descriptors that survive light.

mod describe;
mod descriptor;
mod extrema;
mod layers;
mod orientation;
mod scale_space;

use super::keypoint::Keypoint;
use super::nms::stronger;
use super::{Descriptors, parallel};
use crate::imaging::{GrayImage32, require_finite};
use crate::math::order::{at_rank, order_by};
use crate::progress::{self, Monitor, Stage};
use crate::{Error, Result};
pub use describe::{describe_sift, sift_directions};
use descriptor::Samples;
use extrema::Extremum;
pub use layers::{ScaleOctave, ScaleSpace, scale_space};
use scale_space::{Octave, OctaveGrid};

/// How the 128 sums of a SIFT descriptor are scaled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SiftNormalization {
    /// Lowe's: unit length, entries above 0.2 cut, unit length again.
    #[default]
    L2,
    /// RootSIFT: the square roots of the entries' shares of their sum, so that the Euclidean
    /// distance compares histograms by the Hellinger kernel.
    ///
    /// Source: Arandjelović & Zisserman 2012, "Three things everyone should know to improve
    /// object retrieval", §3.
    Root,
}

/// How [`detect_sift`] works. The defaults are Lowe's, as OpenCV takes them, but for the blur that
/// the image is assumed to have: 0.3 in place of 0.5 pixels. The first octave is then blurred more,
/// and fewer of the features are too small to be seen from further away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SiftOptions {
    /// At most so many features, the strongest; 0 means no limit.
    pub max_features: usize,
    /// Layers per octave in which extrema are looked for, 1 to 10.
    pub layers_per_octave: usize,
    /// Blur of the first layer of an octave, pixels of that octave, 0.8 to 4.
    pub sigma_px: f64,
    /// Blur that the image is assumed to have, pixels, 0 to `sigma_px / 2`.
    pub input_blur_px: f64,
    /// Start at twice the image's size (octave −1): more and smaller features, four times the
    /// work.
    pub upsample: bool,
    /// Smallest answer of an extremum times the layers per octave, for gray values in [0, 1].
    pub contrast_threshold: f32,
    /// Largest ratio of the principal curvatures, > 1.
    pub edge_threshold: f32,
    /// At most so many directions per place, ≥ 1; each makes a feature.
    pub max_orientations: usize,
    /// A further direction needs this share of the strongest one's weight, in (0, 1].
    pub orientation_peak_ratio: f32,
    /// Take every direction to be 0: for cameras held upright.
    pub upright: bool,
    /// How descriptors are scaled.
    pub normalization: SiftNormalization,
}

impl Default for SiftOptions {
    fn default() -> Self {
        Self {
            max_features: 0,
            layers_per_octave: 3,
            sigma_px: 1.6,
            input_blur_px: 0.3,
            upsample: true,
            contrast_threshold: 0.04,
            edge_threshold: 10.0,
            max_orientations: 2,
            orientation_peak_ratio: 0.8,
            upright: false,
            normalization: SiftNormalization::L2,
        }
    }
}

/// Keypoints and their descriptors; entry k of one belongs to entry k of the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Features {
    /// Where.
    pub keypoints: Vec<Keypoint>,
    /// What it looks like there.
    pub descriptors: Descriptors,
}

/// The SIFT features of an image, strongest first: extrema of differences of Gaussians in place
/// and scale, located to a fraction of a pixel, with directions and 4×4×8 histograms of gradients.
///
/// The image is doubled and halved symmetrically about its middle, so a mirrored or half-turned
/// image gives the mirrored or turned keypoints. Descriptors hold bytes: 512 times a unit vector,
/// cut at 255. The angle of a keypoint is `atan2(Iᵥ, Iᵤ)` with v down; `scale_px` is the standard
/// deviation of the blur; `octave` is −1 at twice the image's size.
///
/// An image that is flat, or smaller than about a dozen pixels, has no features. The one stage is
/// [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::NotFinite`] for a bad pixel, [`Error::OutOfRange`] for an option outside its range,
/// [`Error::Canceled`].
///
/// Source: Lowe 2004, "Distinctive image features from scale-invariant keypoints".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{SiftOptions, detect_sift};
/// use epipole::imaging::GrayImage32;
/// // One blob of standard deviation 4: its difference of Gaussians peaks at its center.
/// let blob = GrayImage32::from_fn(65, 65, |u, v| {
///     let (x, y) = (u as f32 - 32.0, v as f32 - 30.0);
///     image::Luma([1.0 / (1.0 + (x * x + y * y) / 60.0)])
/// });
/// let features = detect_sift(&blob, &SiftOptions { upright: true, ..SiftOptions::default() }, &mut ())?;
/// let strongest = features.keypoints[0];
/// assert!((strongest.u - 32.0).abs() < 0.01 && (strongest.v - 30.0).abs() < 0.01);
/// # Ok(()) }
/// ```
pub fn detect_sift(
    image: &GrayImage32,
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<Features> {
    check(options)?;
    require_finite(image)?;
    let mut tell =
        |share: f64| progress::report(monitor, Stage::FeatureDetection, share.min(1.0) as f32);
    tell(0.0)?;
    let mut found: Vec<(Keypoint, [u8; 128])> = Vec::new();
    let mut strongest = Strongest::new(options.max_features);
    // Each octave has a quarter of the pixels of the one before it.
    let (mut done, mut share) = (0.0, 0.75 / options.layers_per_octave as f64);
    let mut next = OctaveGrid::first(image, options);
    let mut memory = Default::default();
    while let Some(grid) = next {
        let mut octave = Octave::new(grid, memory, options);
        next = None;
        for layer in 1..=options.layers_per_octave {
            // A blur of the first octave takes as long as all that follows from a small one, and so do
            // some hundred descriptors: who wants to stop is asked after each.
            while octave.advance_towards(layer) {
                tell(done)?;
            }
            if layer == 1 {
                next = octave.next_grid();
            }
            let mut extrema = extrema::find(&octave, layer, options);
            strongest.keep(&mut extrema);
            for (k, piece) in extrema.chunks(DESCRIBED_AT_ONCE).enumerate() {
                tell(done + share * (k * DESCRIBED_AT_ONCE) as f64 / extrema.len() as f64)?;
                let described = parallel::map_with(piece, Samples::default, |samples, extremum| {
                    describe(&octave, extremum, options, samples)
                });
                found.extend(described.into_iter().flatten());
            }
            done += share;
            tell(done)?;
        }
        share /= 4.0;
        memory = octave.into_memory();
    }
    Ok(collect(&found, options.max_features))
}

/// How many extrema are described between two reports.
const DESCRIBED_AT_ONCE: usize = 512;

/// The features at one extremum: one for each of its directions.
fn describe(
    octave: &Octave,
    extremum: &Extremum,
    options: &SiftOptions,
    scratch: &mut Samples,
) -> Vec<(Keypoint, [u8; 128])> {
    let layer = octave.layer(extremum.layer);
    let (center, sigma) = ((extremum.x, extremum.y), extremum.sigma);
    let angles = if options.upright {
        vec![0.0]
    } else {
        orientation::directions(layer, center, sigma, options, scratch)
    };
    let grid = octave.grid();
    angles
        .into_iter()
        .map(|angle_rad| {
            let keypoint = Keypoint {
                u: grid.origin_u + grid.step * f64::from(extremum.x),
                v: grid.origin_v + grid.step * f64::from(extremum.y),
                scale_px: (f64::from(sigma) * grid.step) as f32,
                angle_rad,
                response: extremum.response,
                octave: grid.octave,
            };
            let sums = descriptor::histogram(layer, center, sigma, angle_rad, scratch);
            (keypoint, descriptor::normalize(sums, options.normalization))
        })
        .collect()
}

/// What is known about the weakest feature that can still be among those returned, so that weaker
/// ones need no descriptor.
struct Strongest {
    limit: usize,
    /// The strongest, negative: so the strongest is the least.
    responses: Vec<f64>,
}

impl Strongest {
    fn new(limit: usize) -> Self {
        Self {
            limit,
            responses: Vec::new(),
        }
    }

    fn keep(&mut self, extrema: &mut Vec<Extremum>) {
        if self.limit == 0 {
            return;
        }
        let negative = |e: &Extremum| -f64::from(e.response);
        self.responses.extend(extrema.iter().map(negative));
        if self.responses.len() > self.limit {
            let weakest = at_rank(&mut self.responses, self.limit - 1);
            self.responses.truncate(self.limit);
            extrema.retain(|e| negative(e) <= weakest);
        }
    }
}

fn collect(found: &[(Keypoint, [u8; 128])], max_features: usize) -> Features {
    let mut order = order_by(found.len(), &mut |a, b| stronger(&found[a].0, &found[b].0));
    order.dedup_by(|a, b| found[*a].0 == found[*b].0);
    if max_features > 0 {
        order.truncate(max_features);
    }
    let bytes = order.iter().flat_map(|&i| found[i].1).collect();
    Features {
        keypoints: order.iter().map(|&i| found[i].0).collect(),
        descriptors: Descriptors::from_bytes(128, bytes).expect("each descriptor has 128 bytes"),
    }
}

fn check(options: &SiftOptions) -> Result<()> {
    let ranges = [
        (
            "the layers per octave",
            "between 1 and 10",
            options.layers_per_octave as f64,
            (1..=10).contains(&options.layers_per_octave),
        ),
        (
            "the blur of an octave's first layer in pixels",
            "between 0.8 and 4",
            options.sigma_px,
            (0.8..=4.0).contains(&options.sigma_px),
        ),
        (
            "the blur of the input in pixels",
            "between 0 and half that of the first layer",
            options.input_blur_px,
            (0.0..=0.5 * options.sigma_px).contains(&options.input_blur_px),
        ),
        (
            "the contrast threshold",
            "between 0 and 1",
            f64::from(options.contrast_threshold),
            (0.0..=1.0).contains(&options.contrast_threshold),
        ),
        (
            "the edge threshold",
            "greater than 1",
            f64::from(options.edge_threshold),
            options.edge_threshold > 1.0,
        ),
        (
            "the number of directions per keypoint",
            "at least 1",
            options.max_orientations as f64,
            options.max_orientations >= 1,
        ),
        (
            "the share of a further direction",
            "greater than 0 and at most 1",
            f64::from(options.orientation_peak_ratio),
            options.orientation_peak_ratio > 0.0 && options.orientation_peak_ratio <= 1.0,
        ),
    ];
    Error::check_rules(&ranges)
}

#[cfg(test)]
mod tests;
