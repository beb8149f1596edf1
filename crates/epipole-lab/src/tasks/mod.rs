//! What takes long, from bytes to bytes: a thread natively and a worker in the browser run the same.
//!
//! A [`Request`] holds everything that its [`Answer`] depends on, so equal requests have equal answers
//! everywhere. `compute` is a function of the request alone.

mod answer;
mod blob;
#[cfg(feature = "compute")]
mod compute;
#[cfg(feature = "compute")]
mod features;
#[cfg(feature = "compute")]
mod matching;
mod options;
#[cfg(feature = "compute")]
mod photograph;
#[cfg(feature = "compute")]
mod reconstruction;
mod request;
mod sample;
#[cfg(feature = "compute")]
mod two_views;

pub use answer::{
    Answer, CameraFound, Component, Feature, Features, Match, Photograph, PointFound,
    Reconstructed, Shows, TwoViews, ViewModel,
};
pub use blob::Blob;
#[cfg(feature = "compute")]
pub use compute::compute;
pub use options::{FeatureKind, FeatureOptions, MatchOptions, PairOptions, SfmOptions};
pub use request::{Calibrated, Described, ImagePoints, Packed, PairOf, Request, Source};
pub use sample::Sample;
#[cfg(feature = "compute")]
pub(crate) use {
    features::to_image,
    reconstruction::{core_reconstruction, sfm_images},
};

/// How far a computation is: the share that is done, and what it does in a few words. Whoever hears
/// of it ends the computation by [`std::ops::ControlFlow::Break`].
pub type Progress<'a> = &'a mut dyn FnMut(f32, &str) -> std::ops::ControlFlow<()>;

/// A message as bytes.
pub(crate) fn to_bytes<T: serde::Serialize>(message: &T) -> Vec<u8> {
    // Writing to memory cannot fail, and none of the messages has a length unknown beforehand.
    postcard::to_allocvec(message).unwrap_or_default()
}

impl Request {
    /// For [`Request::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// The request of these bytes.
    ///
    /// # Errors
    /// A sentence, if they are none.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|_| "the request did not arrive whole".to_owned())
    }
}

impl Answer {
    /// For [`Answer::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// The answer of these bytes.
    ///
    /// # Errors
    /// A sentence, if they are none.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|_| "the answer did not arrive whole".to_owned())
    }
}
