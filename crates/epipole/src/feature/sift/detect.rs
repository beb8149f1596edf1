//! SIFT detection: the strongest features of an image.

use super::descriptor::{self, Samples};
use super::extrema::{self, Extremum};
use super::options::{SiftOptions, check};
use super::orientation;
use super::scale_space::{Octave, OctaveGrid};
use crate::Result;
use crate::feature::keypoint::Keypoint;
use crate::feature::nms::stronger;
use crate::feature::{Descriptors, Features};
use crate::imaging::{GrayImage32, require_finite};
use crate::math::order::{at_rank, order_by};
use crate::math::parallel;
use crate::progress::{self, Monitor, Part, Stage};

/// Detects the SIFT features of an image, strongest first: extrema of differences of Gaussians in
/// position and scale, with sub-pixel accuracy, with directions and 4×4×8 gradient histograms.
///
/// The image is doubled and halved symmetrically about its middle, so a mirrored image, or one
/// rotated by 180°, gives the mirrored or rotated keypoints. Descriptors hold bytes: 512 times a
/// unit vector, clipped at 255. The angle of a keypoint is `atan2(Iᵥ, Iᵤ)` with v down; `scale_px`
/// is the standard deviation of the blur; `octave` is −1 at twice the image's size.
///
/// A flat image, or one smaller than about a dozen pixels, has no features. The only stage is
/// [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::NotFinite`](crate::Error::NotFinite) for an invalid pixel,
/// [`Error::OutOfRange`](crate::Error::OutOfRange) for an option outside its range,
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: Lowe 2004, "Distinctive image features from scale-invariant keypoints".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{SiftOptions, detect_sift};
/// use epipole::imaging::GrayImage32;
/// // A blob of standard deviation 4: its difference of Gaussians peaks at its center.
/// let blob = GrayImage32::from_fn(65, 65, |u, v| {
///     let (x, y) = (u as f32 - 32.0, v as f32 - 30.0);
///     image::Luma([1.0 / (1.0 + (x * x + y * y) / 60.0)])
/// });
/// let features = detect_sift(&blob, &SiftOptions::default().with_upright(true), &mut ())?;
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
    let stage = Stage::FeatureDetection;
    progress::report(monitor, stage, 0.0)?;
    let mut found: Vec<(Keypoint, [u8; 128])> = Vec::new();
    let mut strongest = Strongest::new(options.max_features);
    // Each octave has a quarter of the previous one's pixels.
    let (mut done, mut fraction) = (0.0, 0.75 / options.layers_per_octave as f64);
    let first = &mut Part::new(monitor, 0.0, 0.0).of_stage(stage);
    let mut next = OctaveGrid::first(image, options, first)?;
    let mut memory = Default::default();
    while let Some(grid) = next {
        let mut octave = Octave::new(grid, memory, options);
        next = None;
        for layer in 1..=options.layers_per_octave {
            let at = |part: f64| (done + fraction * part).min(1.0) as f32;
            let blur = &mut Part::new(monitor, at(0.0), at(0.3)).of_stage(stage);
            octave.advance_to(layer, blur)?;
            if layer == 1 {
                let halve = &mut Part::new(monitor, at(0.3), at(0.3)).of_stage(stage);
                next = octave.next_grid(halve)?;
            }
            let search = &mut Part::new(monitor, at(0.3), at(0.5));
            let mut extrema = extrema::find(&octave, layer, options, search)?;
            strongest.keep(&mut extrema);
            for (k, piece) in extrema.chunks(DESCRIBED_AT_ONCE).enumerate() {
                let described = (k * DESCRIBED_AT_ONCE) as f64 / extrema.len() as f64;
                progress::report(monitor, stage, at(0.5 + 0.5 * described))?;
                let described = parallel::map_with(piece, Samples::default, |samples, extremum| {
                    describe(&octave, extremum, options, samples)
                });
                found.extend(described.into_iter().flatten());
            }
            done += fraction;
            progress::report(monitor, stage, done.min(1.0) as f32)?;
        }
        fraction /= 4.0;
        memory = octave.into_memory();
    }
    Ok(collect(&found, options.max_features))
}

/// Number of extrema described between two reports.
const DESCRIBED_AT_ONCE: usize = 512;

/// Returns the features at an extremum, one per direction.
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

/// Lower bound on the response of the returned features, so that weaker ones need no descriptor.
struct Strongest {
    limit: usize,
    /// Negated strongest responses, so that the strongest is the smallest.
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
