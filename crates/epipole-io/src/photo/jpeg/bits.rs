//! The bits of an entropy-coded segment, and the Huffman codes in them (ITU-T T.81, annexes C, F).

use super::flaw::Flaw;

/// Bits of a code that are looked up at once; longer ones are rare.
const LOOKUP_BITS: u32 = 10;

/// The Huffman codes of one table.
#[derive(Clone)]
pub(super) struct Huffman {
    /// By the next [`LOOKUP_BITS`] bits: symbol · 256 + length, or 0 if the code is longer.
    lookup: Vec<u16>,
    /// By length: the first 16-bit window that is beyond the codes of this length.
    end: [u32; 17],
    /// By length: index of the first symbol of this length, minus the first code.
    offset: [i32; 17],
    symbols: Vec<u8>,
}

impl Huffman {
    /// Builds the table from the number of codes of each length and their symbols in order, as in
    /// the file. `None` if the codes are invalid.
    pub(super) fn new(counts: &[u8], symbols: &[u8]) -> Option<Self> {
        let mut table = Self {
            lookup: vec![0; 1 << LOOKUP_BITS],
            end: [0; 17],
            offset: [0; 17],
            symbols: symbols.to_vec(),
        };
        let (mut code, mut at) = (0u32, 0usize);
        for (length, &count) in (1u32..).zip(counts) {
            table.offset[length as usize] = at as i32 - code as i32;
            for _ in 0..count {
                let symbol = *symbols.get(at)?;
                if code >> length != 0 {
                    return None;
                }
                if length <= LOOKUP_BITS {
                    let free = LOOKUP_BITS - length;
                    let first = (code << free) as usize;
                    table.lookup[first..first + (1 << free)]
                        .fill(u16::from(symbol) << 8 | length as u16);
                }
                code += 1;
                at += 1;
            }
            table.end[length as usize] = code << (16 - length);
            code <<= 1;
        }
        Some(table)
    }
}

/// Reads the bits between two markers.
pub(super) struct Bits<'a> {
    data: &'a [u8],
    /// Offset of the next byte; after the end of the data, of the marker or the end of the file.
    pub(super) at: usize,
    /// The next bits, most significant first.
    window: u64,
    /// Number of bits in the window that come from the file. Negative if more bits were taken.
    left: i32,
    ended: bool,
}

impl<'a> Bits<'a> {
    pub(super) fn new(data: &'a [u8], at: usize) -> Self {
        Self {
            data,
            at,
            window: 0,
            left: 0,
            ended: false,
        }
    }

    /// Ensures at least 32 bits in the window; zeros after the end of the data.
    #[inline(always)]
    fn fill(&mut self) {
        if self.left >= 32 || self.ended {
            return;
        }
        if let Some(&[a, b, c, d]) = self.data.get(self.at..self.at + 4) {
            let four = u32::from_be_bytes([a, b, c, d]);
            // No byte is 0xFF: none of the complements is zero.
            let not = !four;
            if not.wrapping_sub(0x0101_0101) & four & 0x8080_8080 == 0 {
                self.window |= u64::from(four) << (32 - self.left);
                self.left += 32;
                self.at += 4;
                return;
            }
        }
        self.fill_by_bytes();
    }

    #[cold]
    fn fill_by_bytes(&mut self) {
        while self.left <= 48 {
            let Some(&byte) = self.data.get(self.at) else {
                self.ended = true;
                return;
            };
            if byte == 0xFF && self.data.get(self.at + 1) != Some(&0) {
                // Fill bytes may precede a marker.
                self.ended = true;
                return;
            }
            self.at += if byte == 0xFF { 2 } else { 1 };
            self.window |= u64::from(byte) << (56 - self.left);
            self.left += 8;
        }
    }

    /// Reads the next symbol; its additional bits are then in the window.
    #[inline(always)]
    pub(super) fn symbol(&mut self, table: &Huffman) -> Result<u8, Flaw> {
        self.fill();
        let found = table.lookup[(self.window >> (64 - LOOKUP_BITS)) as usize];
        if found != 0 {
            self.skip(u32::from(found & 0xFF))?;
            return Ok((found >> 8) as u8);
        }
        self.long_symbol(table)
    }

    #[cold]
    fn long_symbol(&mut self, table: &Huffman) -> Result<u8, Flaw> {
        let next = (self.window >> 48) as u32;
        let length = (LOOKUP_BITS + 1..=16).find(|&length| next < table.end[length as usize]);
        let Some(length) = length else {
            return Err(if self.left < 16 {
                Flaw::Ends
            } else {
                Flaw::Senseless
            });
        };
        let code = (next >> (16 - length)) as i32;
        self.skip(length)?;
        let symbol = table
            .symbols
            .get((code + table.offset[length as usize]) as usize);
        symbol.copied().ok_or(Flaw::Senseless)
    }

    /// Skips bits of the window, up to 16 after a symbol.
    #[inline(always)]
    pub(super) fn skip(&mut self, count: u32) -> Result<(), Flaw> {
        self.window <<= count;
        self.left -= count as i32;
        if self.left < 0 {
            Err(Flaw::Ends)
        } else {
            Ok(())
        }
    }

    /// Reads the value of the next bits, up to 16.
    pub(super) fn take(&mut self, count: u32) -> Result<u32, Flaw> {
        self.fill();
        let value = if count == 0 {
            0
        } else {
            self.window >> (64 - count)
        };
        self.skip(count)?;
        Ok(value as u32)
    }

    /// Returns whether only the padding of the last byte is left: ones.
    pub(super) fn only_padding(&mut self) -> bool {
        self.fill();
        self.ended && self.left < 8 && self.window.leading_ones() >= self.left as u32
    }

    /// Skips to the next marker and returns its offset.
    pub(super) fn into_marker(mut self) -> usize {
        while !self.ended {
            self.left = 0;
            self.window = 0;
            self.fill_by_bytes();
        }
        self.at
    }
}
