//! Options are read from files and written to them.

use epipole::calibration::{CalibrationOptions, MarkerOptions};
use epipole::feature::{
    FeatureOptions, GoodFeaturesOptions, MatchOptions, OrbOptions, RefineOptions, SiftOptions,
    StructureTensorOptions, TrackOptions,
};
use epipole::mvs::{MeshOptions, MvsOptions, TextureOptions};
use epipole::optim::{LmOptions, RobustLoss};
use epipole::robust::{LeastMedianOptions, RansacOptions};
use epipole::sfm::{
    BundleOptions, LocalizeOptions, OdometryOptions, PhotoOptions, SfmOptions,
    TwoViewReconstructionOptions,
};
use epipole::stereo::{RectifyOptions, StereoBm, StereoSgm};
use epipole::stitch::{OverlapOptions, RenderOptions};
use epipole::two_view::TwoViewOptions;
use serde::{Serialize, de::DeserializeOwned};
use std::fmt::Debug;

/// No text is the defaults, a text of the defaults gives them back, and a field that does not exist
/// is named.
fn check<T: Default + Debug + PartialEq + Serialize + DeserializeOwned>() {
    let default = T::default();
    assert_eq!(serde_json::from_str::<T>("{}").unwrap(), default);
    let text = serde_json::to_string(&default).unwrap();
    assert_eq!(serde_json::from_str::<T>(&text).unwrap(), default);
    let error = serde_json::from_str::<T>(r#"{"no_such_option": 1}"#).unwrap_err();
    assert!(error.to_string().contains("no_such_option"), "{error}");
}

#[test]
fn every_kind_of_options_goes_through_a_file() {
    check::<BundleOptions>();
    check::<CalibrationOptions>();
    check::<FeatureOptions>();
    check::<GoodFeaturesOptions>();
    check::<LeastMedianOptions>();
    check::<LmOptions>();
    check::<LocalizeOptions>();
    check::<MarkerOptions>();
    check::<MeshOptions>();
    check::<MvsOptions>();
    check::<MatchOptions>();
    check::<OdometryOptions>();
    check::<OrbOptions>();
    check::<OverlapOptions>();
    check::<PhotoOptions>();
    check::<RansacOptions>();
    check::<RectifyOptions>();
    check::<RefineOptions>();
    check::<RenderOptions>();
    check::<SfmOptions>();
    check::<SiftOptions>();
    check::<StereoBm>();
    check::<StereoSgm>();
    check::<StructureTensorOptions>();
    check::<TextureOptions>();
    check::<TrackOptions>();
    check::<TwoViewOptions>();
    check::<TwoViewReconstructionOptions>();
}

#[test]
fn some_fields_are_enough() {
    let options: RansacOptions =
        serde_json::from_str(r#"{"max_error_px": 2.5, "sampler": "uniform"}"#).unwrap();
    let expected = RansacOptions::default()
        .with_max_error_px(2.5)
        .with_sampler(epipole::robust::SamplerKind::Uniform);
    assert_eq!(options, expected);
    let options: BundleOptions =
        serde_json::from_str(r#"{"loss": {"huber": {"width": 1.5}}, "gauge": "free"}"#).unwrap();
    assert_eq!(options.loss, RobustLoss::Huber { width: 1.5 });
    let wrong = serde_json::from_str::<BundleOptions>(r#"{"gauge": "loose"}"#).unwrap_err();
    assert!(wrong.to_string().contains("two_cameras"), "{wrong}");
}
