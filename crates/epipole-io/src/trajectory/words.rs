//! Words and numbers of lines.

use crate::text::number;
use crate::{Error, Result};
use epipole::camera::RigidTransform;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};

/// Smallest norm of a quaternion that has a direction.
const MIN_NORM: f64 = 1e-6;

/// Splits a line at semicolons, or else at commas (words may be empty), or else at blanks.
pub(super) fn words(line: &str) -> Vec<&str> {
    let separator = if line.contains(';') { ';' } else { ',' };
    let fields = line.split(separator).map(str::trim);
    match line.contains(separator) {
        // `1, 2, 3,` has three fields.
        true => {
            let mut fields: Vec<&str> = fields.collect();
            if fields.last().is_some_and(|last| last.is_empty()) {
                fields.pop();
            }
            fields
        }
        false => line.split_whitespace().collect(),
    }
}

/// Returns a pose from a position and a quaternion, which is normalized.
///
/// * `position`: x, y, z
/// * `rotation`: x, y, z, w
pub(super) fn pose(line: usize, position: &[&str], rotation: [&str; 4]) -> Result<RigidTransform> {
    let mut place = [0.0; 3];
    for (place, word) in place.iter_mut().zip(position) {
        *place = number(line, word)?;
    }
    let mut numbers = [0.0; 4];
    for (value, word) in numbers.iter_mut().zip(rotation) {
        *value = number(line, word)?;
    }
    let [x, y, z, w] = numbers;
    let largest = numbers
        .iter()
        .fold(0.0, |most: f64, value| value.abs().max(most));
    if largest < MIN_NORM {
        return Err(Error::at(line, "the quaternion is zero: it is no rotation"));
    }
    // Scaled first, so that squares stay finite.
    let quaternion = Quaternion::new(w / largest, x / largest, y / largest, z / largest);
    Ok(RigidTransform::from_parts(
        Translation3::new(place[0], place[1], place[2]),
        UnitQuaternion::from_quaternion(quaternion),
    ))
}

/// Returns texts of numbers, 0 for −0.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> Vec<String> {
    let texts = values.into_iter().map(|value| (value + 0.0).to_string());
    texts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_between_blanks_or_commas() {
        assert_eq!(words(" 1  2\t3 "), ["1", "2", "3"]);
        assert_eq!(words("1, 2,3,"), ["1", "2", "3"]);
        assert_eq!(words("1;;3,5"), ["1", "", "3,5"]);
    }

    #[test]
    fn quaternions_are_normalized_and_zero_is_none() {
        let pose_of = |w| pose(7, &["1", "2", "3"], ["0", "0", "0", w]);
        assert_eq!(pose_of("2").unwrap().rotation, UnitQuaternion::identity());
        assert_eq!(
            pose_of("1e200").unwrap().rotation,
            UnitQuaternion::identity()
        );
        let message = "line 7: the quaternion is zero: it is no rotation";
        assert_eq!(pose_of("0").unwrap_err().to_string(), message);
        assert!(pose_of("nan").is_err());
    }
}
