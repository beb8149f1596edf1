//! Poses of two trajectories that belong together.

use crate::failure::Failure;
use epipole_io::trajectory::Trajectory;

/// Pairs of poses.
pub(super) struct Association {
    /// Indices into truth and estimate.
    pub(super) pairs: Vec<(usize, usize)>,
    /// `time` or `index`.
    pub(super) by: &'static str,
}

/// Nearest poses in time, or poses of equal number if a trajectory has no times.
///
/// * `max_difference_s`: seconds; `None` for numbers in any case
///
/// # Errors
/// A sentence, if no times are near, or numbers of poses differ.
pub(super) fn associate(
    truth: &Trajectory,
    estimate: &Trajectory,
    max_difference_s: Option<f64>,
) -> Result<Association, Failure> {
    let times = (&truth.stamps_ns, &estimate.stamps_ns, max_difference_s);
    if let (Some(truth), Some(estimate), Some(max_difference_s)) = times {
        let max_ns = max_difference_s * 1e9;
        // As evo does: each pose of the shorter one, the first trajectory if they are equally long.
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

/// The nearest of `long` for each of `short`, if it is near enough; the earlier of two.
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
