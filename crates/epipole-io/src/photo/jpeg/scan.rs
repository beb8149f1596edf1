//! Skipping a scan, unit by unit (ITU-T T.81, annexes A.2 and B.2.3).

use super::bits::{Bits, Huffman};
use super::blocks::{Progressive, dc_first, whole};
use super::flaw::Flaw;
use super::frame::Frame;
use super::tables::Tables;

/// A scan header.
pub(super) struct Scan {
    parts: Vec<Part>,
    /// The first of its coefficients.
    from: u32,
    /// The last one.
    to: u32,
    /// Whether the scan refines an earlier one.
    refines: bool,
}

struct Part {
    component: usize,
    dc: usize,
    ac: usize,
}

/// A component's blocks in a unit, and their codes.
struct Blocks<'a> {
    count: u32,
    dc: Option<&'a Huffman>,
    ac: Option<&'a Huffman>,
}

impl Scan {
    /// Reads a scan header; `None` if it does not fit this frame.
    pub(super) fn read(segment: &[u8], frame: &Frame) -> Option<Self> {
        let (&count, rest) = segment.split_first()?;
        let count = usize::from(count);
        let listed = rest.get(..2 * count)?.chunks_exact(2);
        let mut parts = Vec::with_capacity(count);
        for part in listed {
            parts.push(Part {
                component: frame.components.iter().position(|c| c.id == part[0])?,
                dc: usize::from(part[1] >> 4),
                ac: usize::from(part[1] & 15),
            });
        }
        let &[from, to, bits] = rest.get(2 * count..2 * count + 3)? else {
            return None;
        };
        let scan = if frame.progressive {
            Self {
                from: u32::from(from),
                to: u32::from(to),
                refines: bits >> 4 != 0,
                parts,
            }
        } else {
            // Sequential files have one kind of scan, so these values are ignored.
            Self {
                from: 0,
                to: 63,
                refines: false,
                parts,
            }
        };
        let fits = if scan.from == 0 {
            !frame.progressive || scan.to == 0
        } else {
            scan.parts.len() == 1 && scan.from <= scan.to && scan.to < 64
        };
        (fits && (1..=4).contains(&count)).then_some(scan)
    }

    /// Skips the data at `at`; returns their end, or the error and the number of rows before it.
    /// `None` without the tables it needs.
    pub(super) fn pass_over(
        &self,
        file: &[u8],
        at: usize,
        frame: &mut Frame,
        tables: &Tables,
    ) -> Option<Result<usize, (Flaw, u32)>> {
        let (across, down, rows) = self.units(frame);
        let mut parts = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            let component = &mut frame.components[part.component];
            component.has_scan = true;
            let is_single = self.parts.len() == 1;
            let blocks = Blocks {
                count: if is_single {
                    1
                } else {
                    component.wide * component.high
                },
                dc: tables.dc.get(part.dc)?.as_ref(),
                ac: tables.ac.get(part.ac)?.as_ref(),
            };
            let has_dc = blocks.dc.is_some() || self.from > 0 || self.refines;
            let has_ac = blocks.ac.is_some() || self.to == 0;
            if !has_dc || !has_ac {
                return None;
            }
            parts.push(blocks);
        }
        let count = across * down;
        let known = &mut frame.components[self.parts[0].component].known;
        if self.from > 0 && known.is_empty() {
            *known = vec![0; count as usize];
        }
        let mut walk = Walk {
            scan: self,
            progressive: frame.progressive,
            parts,
            known,
            idle_blocks: 0,
        };
        let each = if tables.restart == 0 {
            count
        } else {
            tables.restart
        };
        let (mut unit, mut at) = (0, at);
        while unit < count {
            let until = unit.saturating_add(each).min(count);
            match walk.interval(file, at, unit..until) {
                Ok(end) => at = end,
                Err((flaw, unit)) => return Some(Err((flaw, unit / across * rows))),
            }
            unit = until;
            if unit < count {
                match restart(file, at) {
                    Some(next) => at = next,
                    None => return Some(Err((Flaw::Ends, unit / across * rows))),
                }
            }
        }
        Some(Ok(at))
    }

    /// Returns the number of units across and down, and the height of a unit in rows of pixels.
    fn units(&self, frame: &Frame) -> (u32, u32, u32) {
        let (wide, high) = frame.unit();
        if let [part] = self.parts.as_slice() {
            // A single component is stored block by block, without padding blocks.
            let own = &frame.components[part.component];
            let across = (frame.width * own.wide).div_ceil(8 * wide);
            let down = (frame.height * own.high).div_ceil(8 * high);
            (across, down, 8 * high / own.high)
        } else {
            let (across, down) = (8 * wide, 8 * high);
            (
                frame.width.div_ceil(across),
                frame.height.div_ceil(down),
                down,
            )
        }
    }
}

/// Returns the offset after the restart marker that must be at `at`.
fn restart(file: &[u8], at: usize) -> Option<usize> {
    let fill = file.get(at..)?.iter().take_while(|&&byte| byte == 0xFF);
    let marker = at + fill.count();
    matches!(file.get(marker), Some(0xD0..=0xD7)).then_some(marker + 1)
}

struct Walk<'a> {
    scan: &'a Scan,
    progressive: bool,
    parts: Vec<Blocks<'a>>,
    /// State of each block in a progressive scan of AC coefficients.
    known: &'a mut [u64],
    idle_blocks: u32,
}

impl Walk<'_> {
    /// Skips one restart interval; returns its end, or the error and the unit where it occurred.
    fn interval(
        &mut self,
        file: &[u8],
        at: usize,
        units: std::ops::Range<u32>,
    ) -> Result<usize, (Flaw, u32)> {
        let mut bits = Bits::new(file, at);
        self.idle_blocks = 0;
        for unit in units.clone() {
            self.unit(&mut bits, unit).map_err(|flaw| (flaw, unit))?;
        }
        if self.idle_blocks > 0 || self.goes_on(&mut bits) {
            return Err((Flaw::Surplus, units.end));
        }
        Ok(bits.into_marker())
    }

    fn unit(&mut self, bits: &mut Bits<'_>, unit: u32) -> Result<(), Flaw> {
        let scan = self.scan;
        for part in &self.parts {
            match (part.dc, part.ac) {
                (Some(dc), Some(ac)) if !self.progressive => {
                    for _ in 0..part.count {
                        whole(bits, dc, ac)?;
                    }
                }
                (_, Some(ac)) if scan.from > 0 => {
                    let mut blocks = Progressive {
                        ac,
                        from: scan.from,
                        to: scan.to,
                        idle_blocks: self.idle_blocks,
                    };
                    let known = &mut self.known[unit as usize];
                    if scan.refines {
                        blocks.refine(bits, known)?;
                    } else {
                        blocks.first(bits, known)?;
                    }
                    self.idle_blocks = blocks.idle_blocks;
                }
                _ if scan.refines => {
                    for _ in 0..part.count {
                        bits.take(1)?;
                    }
                }
                (Some(dc), _) => {
                    for _ in 0..part.count {
                        dc_first(bits, dc)?;
                    }
                }
                _ => (),
            }
        }
        Ok(())
    }

    /// Returns whether the remaining bytes are further units, to the last bit, which means that a
    /// code was lost and blocks are misplaced. Other bytes after the last unit are harmless, as
    /// some cameras write a few extra bytes. In progressive files a single bit may be a block, so
    /// those cannot be judged.
    fn goes_on(&mut self, bits: &mut Bits<'_>) -> bool {
        if self.progressive || bits.only_padding() {
            return false;
        }
        while self.unit(bits, u32::MAX).is_ok() {
            if bits.only_padding() {
                return true;
            }
        }
        false
    }
}
