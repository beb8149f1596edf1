//! Bytes: of files and pixels, and of messages.

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// Large byte array, shared rather than copied, that serializes in one piece.
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Blob(pub Arc<[u8]>);

impl fmt::Debug for Blob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

impl Deref for Blob {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0
    }
}

impl From<Vec<u8>> for Blob {
    fn from(bytes: Vec<u8>) -> Self {
        Self(bytes.into())
    }
}

impl Serialize for Blob {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(&self.0)
    }
}

impl<'de> Deserialize<'de> for Blob {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Bytes;
        impl Visitor<'_> for Bytes {
            type Value = Blob;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("bytes")
            }

            fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Blob, E> {
                Ok(Blob(bytes.into()))
            }
        }
        deserializer.deserialize_bytes(Bytes)
    }
}

/// Serializes a message.
pub(crate) fn to_bytes<T: Serialize>(message: &T) -> Vec<u8> {
    // Allocated at its final size: growth by doubling would temporarily need three times as much,
    // and a page never returns memory.
    let size = postcard::serialize_with_flavor(message, postcard::ser_flavors::Size::default());
    let bytes = Vec::with_capacity(size.unwrap_or_default());
    // Writing to memory cannot fail, and all lengths are known beforehand.
    postcard::to_extend(message, bytes).unwrap_or_default()
}
