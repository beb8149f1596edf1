//! Reasons why photos are missing from a reconstruction.

use super::scene::check_observations;
use crate::argument::{Argument, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, Text};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::Camera;
use epipole::sfm::{self, PairMatches, Reconstruction, SfmImage, SfmInput, SfmOptions, SfmResult};

/// Result of structure from motion, passed back.
struct GivenResult(SfmResult);

impl Argument for GivenResult {
    fn typescript(types: &mut Types) -> String {
        let component = <Reconstruction as Argument>::typescript(types);
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "SfmResultLike",
            "Result of structure from motion.",
            &[
                (
                    "components",
                    &format!("readonly {component}[]"),
                    "Reconstructions that could not be connected.",
                ),
                (
                    "unregistered",
                    &indices,
                    "Indices of photos that are in none.",
                ),
                ("steps?", "unknown", "Ignored."),
            ],
        );
        "SfmResultLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["components", "unregistered", "steps"])?;
        Ok(Self(SfmResult {
            components: entry(name, value, "components")?,
            unregistered: entry::<Indices>(name, value, "unregistered")?.0,
            steps: Vec::new(),
            is_complete: true,
        }))
    }
}

functions! {
    /// Why each of the `unregistered` photos of a result of `reconstruct` is in no reconstruction,
    /// a sentence each. The other arguments are those of `reconstruct`.
    fn why_unregistered(
        images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>, result: GivenResult,
        options: Options<SfmOptions>; monitor
    ) -> Vec<Text> {
        let GivenResult(result) = result;
        let count = images.len();
        for component in &result.components {
            check_observations(component, &images)?;
        }
        if let Some(image) = result.unregistered.iter().find(|&&image| image >= count) {
            return Err(Fault::of_range(format!(
                "result.unregistered has photo {image}, but images has {count} entries"
            )));
        }
        let input = SfmInput { images, cameras, pairs };
        let reasons = sfm::why_unregistered(&input, &options.0, &result, monitor)?;
        reasons.iter().map(|reason| Text(reason.to_string())).collect()
    }
}
