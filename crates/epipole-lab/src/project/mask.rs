//! Sets of indices.

use super::bytes::Blob;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Set of indices, one bit each; shared rather than copied.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Mask(Blob);

impl Mask {
    /// Returns the set of these indices.
    pub fn of(indices: impl IntoIterator<Item = u32>) -> Self {
        let mut bytes = Vec::new();
        for index in indices {
            let at = index as usize / 8;
            if at >= bytes.len() {
                bytes.resize(at + 1, 0);
            }
            bytes[at] |= 1 << (index % 8);
        }
        Self(bytes.into())
    }

    /// Whether it has this index.
    pub fn has(&self, index: u32) -> bool {
        let byte = self.0.get(index as usize / 8);
        byte.is_some_and(|byte| byte >> (index % 8) & 1 == 1)
    }

    /// Returns the number of indices.
    pub fn len(&self) -> usize {
        self.0.iter().map(|byte| byte.count_ones() as usize).sum()
    }

    /// Whether it has no index.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|byte| *byte == 0)
    }

    /// Returns the union with another set.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a | b)
    }

    /// Returns the set without the indices of another one.
    #[must_use]
    pub fn without(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a & !b)
    }

    fn combined(&self, other: &Self, combine: impl Fn(u8, u8) -> u8) -> Self {
        let at = |bytes: &Blob, n: usize| bytes.get(n).copied().unwrap_or(0);
        let len = self.0.len().max(other.0.len());
        let bytes = (0..len).map(|n| combine(at(&self.0, n), at(&other.0, n)));
        Self::trimmed(bytes.collect())
    }

    /// Equal sets have equal bytes: the last one is not 0.
    fn trimmed(mut bytes: Vec<u8>) -> Self {
        let len = bytes.iter().rposition(|byte| *byte != 0);
        bytes.truncate(len.map_or(0, |last| last + 1));
        Self(bytes.into())
    }
}

/// Text has two hexadecimal digits for each byte, other formats the bytes.
impl Serialize for Mask {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !serializer.is_human_readable() {
            return self.0.serialize(serializer);
        }
        let digit = |half: u8| char::from(b"0123456789abcdef"[usize::from(half & 15)]);
        let digits = self
            .0
            .iter()
            .flat_map(|byte| [digit(byte >> 4), digit(*byte)]);
        serializer.serialize_str(&digits.collect::<String>())
    }
}

impl<'de> Deserialize<'de> for Mask {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if !deserializer.is_human_readable() {
            return Ok(Self::trimmed(Blob::deserialize(deserializer)?.to_vec()));
        }
        let text = String::deserialize(deserializer)?;
        let digit = |byte: &u8| char::from(*byte).to_digit(16).map(|digit| digit as u8);
        let (pairs, rest) = text.as_bytes().as_chunks();
        let byte = |[high, low]: &[u8; 2]| Some(digit(high)? << 4 | digit(low)?);
        let bytes: Option<Vec<u8>> = pairs.iter().map(byte).collect();
        let bytes = bytes.filter(|_| rest.is_empty());
        let bytes = bytes.ok_or_else(|| D::Error::custom("a set needs pairs of hex digits"))?;
        Ok(Self::trimmed(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_have_the_indices_that_went_in() {
        let set = Mask::of([3, 9, 200, 3]);
        assert_eq!(set.len(), 3);
        let found: Vec<u32> = (0..300).filter(|n| set.has(*n)).collect();
        assert_eq!(found, [3, 9, 200]);
        assert_eq!(set.with(&Mask::of([4])), Mask::of([3, 4, 9, 200]));
        assert_eq!(set.without(&Mask::of([200, 7])), Mask::of([9, 3]));
        assert!(set.without(&set).is_empty());
        assert_eq!(set.without(&set), Mask::default());
    }

    #[test]
    fn sets_survive_in_text_and_in_bytes() {
        for set in [
            Mask::default(),
            Mask::of([0]),
            Mask::of([17, 4]),
            Mask::of(0..99),
        ] {
            let bytes = super::super::to_bytes(&set);
            assert_eq!(postcard::from_bytes(&bytes), Ok(set.clone()));
            let text = serde_json::to_string(&set).unwrap_or_default();
            assert_eq!(
                serde_json::from_str::<Mask>(&text).ok(),
                Some(set),
                "{text}"
            );
        }
        for text in ["\"1\"", "\"xy\"", "\"é1\"", "[1]"] {
            assert!(serde_json::from_str::<Mask>(text).is_err(), "{text}");
        }
        assert_eq!(
            serde_json::from_str::<Mask>("\"0800\"").ok(),
            Some(Mask::of([3]))
        );
    }
}
