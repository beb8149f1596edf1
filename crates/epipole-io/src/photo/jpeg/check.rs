//! Check of the segments of a file.

use super::flaw::Flaw;
use super::frame::Frame;
use super::scan::Scan;
use super::standard;
use super::tables::Tables;
use std::borrow::Cow;

/// Parts that an intact file may lack and its decoder needs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(in crate::photo) struct Missing {
    /// End of the last block, if there is no end-of-image marker.
    pub(super) end_at: Option<usize>,
    /// Whether it has no Huffman tables and uses the standard ones.
    pub(super) tables: bool,
}

impl Missing {
    /// Returns the file with these parts.
    pub(in crate::photo) fn added_to(self, file: &[u8]) -> Cow<'_, [u8]> {
        let mut whole = Cow::from(file);
        if let Some(at) = self.end_at {
            // Otherwise the decoder would treat the last rows as lost.
            whole = [&file[..at], &[0xFF, 0xD9]].concat().into();
        }
        if self.tables {
            whole = standard::inserted(&whole).into();
        }
        whole
    }
}

/// Checks a JPEG file; only its markers if the image is larger than `max_pixels`.
///
/// # Errors
/// A description of the damage.
pub(in crate::photo) fn check(file: &[u8], max_pixels: u64) -> Result<Missing, String> {
    let mut tables = Tables::default();
    let mut missing = Missing::default();
    let mut frame: Option<Frame> = None;
    // Whether the coding is supported here.
    let mut known = true;
    let (mut at, mut behind) = (2, 2);
    while at + 1 < file.len() {
        let marker = match (file[at], file[at + 1]) {
            (0xFF, 0xD9) => {
                return match &frame {
                    Some(frame) if known && !frame.is_complete() => Err(ENDS.to_owned()),
                    _ => Ok(missing),
                };
            }
            (0xFF, 0x00 | 0x01 | 0xD0..=0xD8) => {
                at += 2;
                continue;
            }
            (0xFF, marker @ 0x02..=0xFE) => marker,
            // Extra bytes before a marker are harmless; or data of an unsupported coding.
            _ => {
                at += 1;
                continue;
            }
        };
        let Some(segment) = segment(file, at + 2) else {
            break;
        };
        at += 4 + segment.len();
        match marker {
            0xC4 => tables.read_huffman(segment),
            0xDD => tables.read_restart(segment),
            0xC0..=0xC2 if frame.is_none() => {
                frame = Frame::read(segment, marker == 0xC2);
                known &= (frame.as_ref()).is_some_and(|frame| frame.pixels() <= max_pixels);
            }
            // Arithmetic coding, lossless files and files of several frames.
            0xC0..=0xCF => known = false,
            0xDA if known => {
                if frame.as_ref().is_some_and(|frame| !frame.progressive) {
                    missing.tables |= tables.complete();
                }
                let scan =
                    (frame.as_mut()).and_then(|frame| Some((Scan::read(segment, frame)?, frame)));
                let passed = scan.and_then(|(scan, frame)| {
                    let passed = scan.pass_over(file, at, frame, &tables)?;
                    Some(passed.map_err(|(flaw, row)| words(flaw, row, frame.height)))
                });
                match passed {
                    Some(end) => {
                        behind = end?;
                        at = behind;
                    }
                    None => known = false,
                }
            }
            _ => (),
        }
    }
    match frame {
        // Progressive files could always continue.
        Some(frame) if known && !frame.progressive && frame.is_complete() => {
            missing.end_at = Some(behind);
            Ok(missing)
        }
        _ => Err(ENDS.to_owned()),
    }
}

const ENDS: &str = "the JPEG file ends before its picture does";

/// Returns the bytes after the length at `at`, if the file has that many.
fn segment(file: &[u8], at: usize) -> Option<&[u8]> {
    let length = file.get(at..at + 2)?;
    let length = usize::from(u16::from_be_bytes([length[0], length[1]])).max(2);
    file.get(at + 2..at + length)
}

fn words(flaw: Flaw, row: u32, rows: u32) -> String {
    match flaw {
        Flaw::Ends => format!("the JPEG file is damaged: its data end after {row} of {rows} rows"),
        Flaw::Senseless => {
            format!("the JPEG file is damaged: its data make no sense after {row} of {rows} rows")
        }
        Flaw::Surplus => {
            format!("the JPEG file is damaged: its data are for more than {rows} rows")
        }
    }
}
