//! Binary files: little-endian values, read in order.

use crate::{Error, Result};

/// Rest of a binary file, with bounds checks.
pub(crate) struct Bytes<'a> {
    all: &'a [u8],
    position: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(all: &'a [u8]) -> Self {
        Self { all, position: 0 }
    }

    /// Reads the next bytes.
    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let rest = &self.all[self.position..];
        if count > rest.len() {
            return Err(Error::malformed(format!(
                "the file ends after {} bytes, within a value at byte {}",
                self.all.len(),
                self.position
            )));
        }
        self.position += count;
        Ok(&rest[..count])
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N]> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    pub(crate) fn u8(&mut self) -> Result<u8> {
        Ok(self.array::<1>()?[0])
    }

    pub(crate) fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn i32(&mut self) -> Result<i32> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    pub(crate) fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub(crate) fn f64(&mut self) -> Result<f64> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    pub(crate) fn f64s<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64()?;
        }
        Ok(values)
    }

    /// Reads a 64-bit number of elements that the rest of the file can hold.
    ///
    /// * `what`: the elements, in the plural
    /// * `size`: minimum number of bytes of an element, at least 1
    pub(crate) fn count(&mut self, what: &str, size: usize) -> Result<usize> {
        let at = self.position;
        let count = self.u64()?;
        let rest = self.all.len() - self.position;
        match usize::try_from(count) {
            Ok(count) if count <= rest / size => Ok(count),
            _ => Err(Error::malformed(format!(
                "byte {at}: {count} {what} do not fit in the remaining {rest} bytes"
            ))),
        }
    }

    /// Reads text up to a byte 0.
    pub(crate) fn c_string(&mut self) -> Result<String> {
        let at = self.position;
        let rest = &self.all[at..];
        let end = rest
            .iter()
            .position(|byte| *byte == 0)
            .ok_or_else(|| Error::malformed(format!("the name at byte {at} does not end")))?;
        self.position += end + 1;
        String::from_utf8(rest[..end].to_vec())
            .map_err(|_| Error::malformed(format!("the name at byte {at} is not UTF-8")))
    }

    /// Returns an error if anything follows.
    pub(crate) fn end(&self) -> Result<()> {
        match self.all.len() - self.position {
            0 => Ok(()),
            rest => Err(Error::malformed(format!(
                "{rest} bytes follow the last value, at byte {}",
                self.position
            ))),
        }
    }
}

/// Appends numbers, little-endian.
pub(crate) fn extend(bytes: &mut Vec<u8>, values: &[f64]) {
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}
