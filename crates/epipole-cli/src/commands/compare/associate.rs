//! Association of the poses of two trajectories.

use super::poses::Poses;
use crate::failure::Failure;
use std::collections::HashMap;
use std::path::Path;

/// Pairs of poses.
pub(super) struct Association {
    /// Indices into truth and estimate.
    pub(super) pairs: Vec<(usize, usize)>,
    /// `time`, `name` or `index`.
    pub(super) by: &'static str,
}

/// Pairs poses by nearest time, images by name, or poses by index if there are neither times nor
/// names.
///
/// * `max_difference_s`: seconds; `None`: always by index
///
/// # Errors
/// If no times are near, no names are equal, or the numbers of poses differ.
pub(super) fn associate(
    both: &[Poses; 2],
    max_difference_s: Option<f64>,
) -> Result<Association, Failure> {
    let [truth, estimate] = both.each_ref().map(|poses| &poses.trajectory);
    if let ([Some(first), Some(second)], Some(_)) = (
        both.each_ref().map(|poses| poses.names.as_deref()),
        max_difference_s,
    ) {
        let pairs = by_name(first, second)?;
        return Ok(Association { pairs, by: "name" });
    }
    let times = (&truth.stamps_ns, &estimate.stamps_ns, max_difference_s);
    if let (Some(truth), Some(estimate), Some(max_difference_s)) = times {
        let max_ns = max_difference_s * 1e9;
        // As in evo: each pose of the shorter trajectory, the first one if the lengths are equal.
        let pairs: Vec<(usize, usize)> = match estimate.len() > truth.len() {
            true => nearest(truth, estimate, max_ns),
            false => (nearest(estimate, truth, max_ns).into_iter())
                .map(|(j, i)| (i, j))
                .collect(),
        };
        if pairs.is_empty() {
            return Err(apart(truth, estimate, max_difference_s));
        }
        return Ok(Association { pairs, by: "time" });
    }
    let (first, second) = (truth.world_from_cam.len(), estimate.world_from_cam.len());
    if first != second {
        let message = format!(
            "without times, poses of equal number are compared, but there are {first} and {second}"
        );
        return Err(Failure::new("size-mismatch", message));
    }
    Ok(Association {
        pairs: (0..first).map(|i| (i, i)).collect(),
        by: "index",
    })
}

/// Part of a name that two images have in common.
type Key<'a> = &'a dyn Fn(&String) -> Option<String>;

/// Pairs images by name, or else by name without folder and extension.
fn by_name(first: &[String], second: &[String]) -> Result<Vec<(usize, usize)>, Failure> {
    let stem = |name: &String| {
        Path::new(name)
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
    };
    let keys: [Key; 2] = [&|name| Some(name.clone()), &stem];
    for key in keys {
        let place_of: HashMap<String, usize> = second
            .iter()
            .enumerate()
            .filter_map(|(j, name)| Some((key(name)?, j)))
            .collect();
        let pairs: Vec<(usize, usize)> = (first.iter().enumerate())
            .filter_map(|(i, name)| Some((i, *place_of.get(&key(name)?)?)))
            .collect();
        if !pairs.is_empty() {
            return Ok(pairs);
        }
    }
    let message = format!(
        "no image has the name of another: \"{}\" and others, \"{}\" and others (--by-index compares \
         images of equal number)",
        first[0], second[0]
    );
    Err(Failure::new("too-few", message))
}

/// Returns the nearest of `long` for each of `short`, if it is near enough; the earlier of two
/// equally near.
fn nearest(short: &[i64], long: &[i64], max_ns: f64) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    for (i, &time) in short.iter().enumerate() {
        let after = long.partition_point(|&other| other < time);
        let before = after.checked_sub(1);
        // Equal times: the first of them.
        let before = before.map(|last| long.partition_point(|&other| other < long[last]));
        let candidates = before
            .into_iter()
            .chain((after < long.len()).then_some(after));
        let distance = |j: usize| long[j].abs_diff(time);
        if let Some(j) = candidates.min_by_key(|&j| distance(j))
            && distance(j) as f64 <= max_ns
        {
            pairs.push((i, j));
        }
    }
    pairs
}

fn apart(truth: &[i64], estimate: &[i64], max_difference_s: f64) -> Failure {
    let range = |stamps: &[i64]| {
        let seconds = |stamp: Option<&i64>| stamp.map_or(0.0, |&ns| ns as f64 / 1e9);
        format!(
            "{:.3} to {:.3} s",
            seconds(stamps.first()),
            seconds(stamps.last())
        )
    };
    let message = format!(
        "no two poses are within {max_difference_s} s: the true ones are from {}, the estimated from {} \
         (--by-index compares poses of equal number)",
        range(truth),
        range(estimate)
    );
    Failure::new("too-few", message)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn each_time_has_its_nearest() {
        let long = [0, 10, 20, 20, 30];
        assert_eq!(
            nearest(&[1, 15, 21, 90], &long, 5.0),
            [(0, 0), (1, 1), (2, 2)]
        );
        assert_eq!(nearest(&[20, -3], &long, 0.0), [(0, 2)]);
        assert_eq!(nearest(&[i64::MIN], &[i64::MAX], 1.0), []);
    }
}
