//! Serialization of a reconstruction's lens as two radial terms.

use epipole::camera::{Distortion, Lens};
use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

fn radial([k1, k2]: [f64; 2]) -> Lens {
    Lens::Brown(Distortion {
        k1,
        k2,
        ..Distortion::NONE
    })
}

/// Writes `[k1, k2]`.
///
/// # Errors
/// A message for a lens with other terms, which the Lab never makes.
pub(super) fn serialize<S: Serializer>(lens: &Lens, serializer: S) -> Result<S::Ok, S::Error> {
    let terms = match lens {
        Lens::Brown(distortion) => [distortion.k1, distortion.k2],
        _ => [0.0; 2],
    };
    match *lens == radial(terms) {
        true => terms.serialize(serializer),
        false => Err(S::Error::custom("the lens has more than two radial terms")),
    }
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Lens, D::Error> {
    <[f64; 2]>::deserialize(deserializer).map(radial)
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::Fisheye;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Message(#[serde(with = "super")] Lens);

    #[test]
    fn files_hold_two_numbers_as_before() {
        let lens = Message(radial([-0.1, 0.02]));
        let bytes = postcard::to_allocvec(&lens).unwrap();
        assert_eq!(bytes, postcard::to_allocvec(&[-0.1, 0.02]).unwrap());
        assert_eq!(postcard::from_bytes::<Message>(&bytes).unwrap(), lens);
        let fisheye = Message(Fisheye::default().into());
        assert!(postcard::to_allocvec(&fisheye).is_err());
        let tangential = Distortion {
            p1: 0.1,
            ..Distortion::NONE
        };
        assert!(postcard::to_allocvec(&Message(tangential.into())).is_err());
    }
}
