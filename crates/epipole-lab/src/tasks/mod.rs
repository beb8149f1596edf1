//! Long computations, from bytes to bytes: a native thread and a worker in the browser run the
//! same.
//!
//! A [`Request`] holds everything that its [`Answer`] depends on, so equal requests have equal
//! answers everywhere. `compute` is a function of the request alone.

mod answer;
mod blob;
#[cfg(feature = "files")]
mod board;
#[cfg(feature = "files")]
mod board_sample;
mod boards;
#[cfg(feature = "vision")]
mod calibration;
#[cfg(any(feature = "vision", feature = "files"))]
mod compute;
#[cfg(any(feature = "vision", feature = "files"))]
mod convert;
mod dense;
#[cfg(feature = "vision")]
mod depth;
#[cfg(feature = "vision")]
mod depth_size;
#[cfg(feature = "vision")]
mod features;
#[cfg(feature = "files")]
mod frames;
#[cfg(feature = "vision")]
mod matching;
mod options;
#[cfg(feature = "files")]
mod photograph;
mod radial_lens;
#[cfg(feature = "vision")]
mod reconstruction;
mod request;
mod sample;
mod thumbnail;
#[cfg(feature = "vision")]
mod two_views;

pub use answer::{
    Answer, CameraFound, Component, Feature, Features, Match, Photograph, PointFound,
    Reconstructed, Shows, TwoViews, ViewModel,
};
pub use blob::Blob;
pub use boards::{
    BoardFound, BoardOptions, BoardPattern, Calibration, CalibrationOptions, LensCamera, LensModel,
    ViewFound,
};
#[cfg(any(feature = "vision", feature = "files"))]
pub use compute::compute;
#[cfg(feature = "files")]
pub(crate) use convert::{core_reconstruction, sfm_images, to_image};
pub use dense::Dense;
pub use options::{
    DepthMethod, DepthOptions, FeatureKind, FeatureOptions, MatchOptions, PairOptions, SfmOptions,
};
pub use request::{
    Branch, Calibrated, Described, ImagePoints, Packed, PairOf, Recipe, Request, Source,
};
pub use sample::Sample;
pub use thumbnail::Thumbnail;

/// Report of a running computation.
#[derive(Debug)]
pub enum Told<'a> {
    /// Progress, 0 to 1, and the current stage in a few words.
    Share(f32, &'a str),
    /// Intermediate result: the bytes of an [`Answer`].
    SoFar(Vec<u8>),
}

/// Progress callback of a computation; cancels it by [`std::ops::ControlFlow::Break`].
pub type Progress<'a> = &'a mut dyn FnMut(Told<'_>) -> std::ops::ControlFlow<()>;

/// Reports progress.
///
/// # Errors
/// If the callback cancels.
#[cfg(any(feature = "vision", feature = "files"))]
fn ask(progress: Progress<'_>, share: f32) -> Result<(), String> {
    match progress(Told::Share(share, "")).is_break() {
        true => Err("stopped".to_owned()),
        false => Ok(()),
    }
}

/// A message as bytes.
pub(crate) fn to_bytes<T: serde::Serialize>(message: &T) -> Vec<u8> {
    // A buffer that grows by doubling would take three times its size for a while, and a page never
    // returns memory.
    let size = postcard::serialize_with_flavor(message, postcard::ser_flavors::Size::default());
    let bytes = Vec::with_capacity(size.unwrap_or_default());
    // Writing to memory cannot fail, and none of the messages has a length unknown beforehand.
    postcard::to_extend(message, bytes).unwrap_or_default()
}

impl Request {
    /// For [`Request::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// Parses a request.
    ///
    /// # Errors
    /// A message for invalid bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|_| "the request did not arrive whole".to_owned())
    }
}

impl Answer {
    /// For [`Answer::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// Parses an answer.
    ///
    /// # Errors
    /// A message for invalid bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let broken = "the answer did not arrive whole";
        match postcard::from_bytes(bytes) {
            Ok(Self::Depth(pair)) if !pair.is_whole() => Err(broken.to_owned()),
            Ok(answer) => Ok(answer),
            Err(_) => Err(broken.to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_takes_the_room_of_its_bytes_alone() {
        let file = |len: usize| Request::Photograph {
            source: Source::File(vec![7; len].into()),
            max_pixels: 3_000_000,
            camera: None,
        };
        for len in [0, 100, 1_000_003] {
            let request = file(len);
            let bytes = request.to_bytes();
            assert!((len..len + 20).contains(&bytes.len()), "{}", bytes.len());
            assert_eq!(bytes.capacity(), bytes.len());
            assert_eq!(Request::from_bytes(&bytes), Ok(request));
        }
    }
}
