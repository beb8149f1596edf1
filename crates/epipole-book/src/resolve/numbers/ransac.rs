//! Numbers of the chapter on RANSAC.

use super::entry::Number::{Count, Real};
use super::entry::{Arguments, Entry, sentence};
use epipole::robust::{num_trials_with_replacement, num_trials_without_replacement};

/// Numbers that chapters can print.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "ransac.trials",
        parameters: &["s", "w", "p"],
        summary: "samples of size s for confidence p when a share w of the data are inliers",
        compute: |a| {
            num_trials_with_replacement(a.get("w"), a.count("s")?, a.get("p"))
                .map(Count)
                .map_err(sentence)
        },
    },
    Entry {
        name: "ransac.trials-exact",
        parameters: &["s", "w", "p"],
        summary: "the same before rounding up, log(1 − p) / log(1 − wˢ)",
        compute: |a| {
            let good = all_inliers(a)?;
            Ok(Real(libm::log1p(-a.get("p")) / libm::log1p(-good), 3))
        },
    },
    Entry {
        name: "ransac.trials-without-replacement",
        parameters: &["inliers", "data", "s", "p"],
        summary: "samples of s different data for confidence p, counted exactly",
        compute: |a| {
            let (inliers, data) = (a.count("inliers")?, a.count("data")?);
            num_trials_without_replacement(inliers, data, a.count("s")?, a.get("p"))
                .map(Count)
                .map_err(sentence)
        },
    },
    Entry {
        name: "ransac.confidence-percent",
        parameters: &["s", "w", "n"],
        summary: "chance that one of n samples holds inliers only, percent",
        compute: |a| {
            let all_corrupted = libm::exp(a.get("n") * libm::log1p(-all_inliers(a)?));
            Ok(Real(100.0 * (1.0 - all_corrupted), 1))
        },
    },
];

/// Returns the probability that a sample contains only inliers, wˢ, for 0 < w < 1.
fn all_inliers(a: &Arguments) -> Result<f64, String> {
    let (ratio, size) = (a.get("w"), a.count("s")?);
    if ratio <= 0.0 || ratio >= 1.0 || size == 0 {
        return Err("w must be between 0 and 1, and s at least 1".to_owned());
    }
    Ok(libm::pow(ratio, size as f64))
}
