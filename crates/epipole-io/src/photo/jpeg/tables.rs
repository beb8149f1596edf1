//! Tables set by the segments before a scan.

use super::bits::Huffman;
use super::standard;

/// Settings of the segments before a scan.
#[derive(Default)]
pub(super) struct Tables {
    pub(super) dc: [Option<Huffman>; 4],
    pub(super) ac: [Option<Huffman>; 4],
    /// Number of units between two restarts; 0: none.
    pub(super) restart: u32,
}

impl Tables {
    pub(super) fn read_restart(&mut self, segment: &[u8]) {
        if let Some(&[high, low]) = segment.first_chunk() {
            self.restart = u32::from(u16::from_be_bytes([high, low]));
        }
    }

    /// Sets the standard tables if no segment set any; returns whether it did.
    pub(super) fn complete(&mut self) -> bool {
        let is_empty = self.dc.iter().chain(&self.ac).all(Option::is_none);
        if is_empty {
            self.read_huffman(&standard::TABLES);
        }
        is_empty
    }

    pub(super) fn read_huffman(&mut self, mut segment: &[u8]) {
        while let Some((&[id, ref counts @ ..], rest)) = segment.split_first_chunk::<17>() {
            let count: usize = counts.iter().map(|&n| usize::from(n)).sum();
            let Some(symbols) = rest.get(..count) else {
                return;
            };
            segment = &rest[count..];
            let tables = if id >> 4 == 0 {
                &mut self.dc
            } else {
                &mut self.ac
            };
            tables[usize::from(id & 3)] = Huffman::new(counts, symbols);
        }
    }
}
