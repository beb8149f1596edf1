//! Skipping the blocks of 8 × 8 coefficients of a scan (ITU-T T.81, annexes F and G).

use super::bits::{Bits, Huffman};
use super::flaw::Flaw;

/// Skips a block with all of its coefficients, as in a sequential file.
#[inline]
pub(super) fn whole(bits: &mut Bits<'_>, dc: &Huffman, ac: &Huffman) -> Result<(), Flaw> {
    dc_first(bits, dc)?;
    let mut k = 1;
    while k < 64 {
        let symbol = bits.symbol(ac)?;
        let (run, size) = (u32::from(symbol >> 4), u32::from(symbol & 15));
        if size != 0 {
            k += run + 1;
            if k > 64 {
                return Err(Flaw::Senseless);
            }
            bits.skip(size)?;
        } else if run == 15 {
            k += 16;
        } else {
            break;
        }
    }
    Ok(())
}

/// Skips the DC difference to the previous block.
pub(super) fn dc_first(bits: &mut Bits<'_>, dc: &Huffman) -> Result<(), Flaw> {
    let size = u32::from(bits.symbol(dc)?);
    // Eleven bits suffice for eight bits per channel, sixteen for any.
    if size > 16 {
        return Err(Flaw::Senseless);
    }
    bits.skip(size)
}

/// State of a progressive scan of the coefficients `from ..= to`: the number of following blocks
/// without new coefficients. A bit set marks the nonzero coefficients of each block.
pub(super) struct Progressive<'a> {
    pub(super) ac: &'a Huffman,
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) idle_blocks: u32,
}

impl Progressive<'_> {
    /// Skips the first bits of a block's coefficients.
    pub(super) fn first(&mut self, bits: &mut Bits<'_>, known: &mut u64) -> Result<(), Flaw> {
        if self.idle_blocks > 0 {
            self.idle_blocks -= 1;
            return Ok(());
        }
        let mut k = self.from;
        while k <= self.to {
            let symbol = bits.symbol(self.ac)?;
            let (run, size) = (u32::from(symbol >> 4), u32::from(symbol & 15));
            if size != 0 {
                k += run;
                if k > self.to {
                    return Err(Flaw::Senseless);
                }
                *known |= 1 << k;
                k += 1;
                bits.skip(size)?;
            } else if run == 15 {
                k += 16;
            } else {
                self.idle_blocks = (1 << run) - 1 + bits.take(run)?;
                break;
            }
        }
        Ok(())
    }

    /// Skips one more bit of each known coefficient of a block, and new ones.
    pub(super) fn refine(&mut self, bits: &mut Bits<'_>, known: &mut u64) -> Result<(), Flaw> {
        let mut k = self.from;
        if self.idle_blocks == 0 {
            while k <= self.to {
                let symbol = bits.symbol(self.ac)?;
                let (mut zeros, size) = (symbol >> 4, symbol & 15);
                match size {
                    0 if zeros < 15 => {
                        let run = u32::from(zeros);
                        self.idle_blocks = (1 << run) + bits.take(run)?;
                        break;
                    }
                    0 => (),
                    1 => bits.skip(1)?,
                    _ => return Err(Flaw::Senseless),
                }
                while k <= self.to {
                    if *known >> k & 1 == 1 {
                        bits.take(1)?;
                    } else if zeros == 0 {
                        break;
                    } else {
                        zeros -= 1;
                    }
                    k += 1;
                }
                if size == 1 {
                    if k > self.to {
                        return Err(Flaw::Senseless);
                    }
                    *known |= 1 << k;
                }
                k += 1;
            }
        }
        if self.idle_blocks > 0 {
            for k in k..=self.to {
                if *known >> k & 1 == 1 {
                    bits.take(1)?;
                }
            }
            self.idle_blocks -= 1;
        }
        Ok(())
    }
}
