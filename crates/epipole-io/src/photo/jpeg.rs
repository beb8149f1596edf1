//! Check that the data of a JPEG file are a complete image.
//!
//! Decoders fill the missing parts of a damaged file with arbitrary values, which must not reach
//! geometry. This check therefore parses the Huffman codes without decoding pixels: the number of
//! blocks must be that of the image, and all codes must be in the file's tables. Other files
//! (arithmetic coding, lossless, missing tables) are left to the decoder.
//!
//! Damage that leaves equally many valid codes is not noticed. In fourteen encodings of a photo,
//! 500 bytes cut out or overwritten were noticed in 99 of 100 cases, a single changed byte in every
//! second case; `libjpeg`, which continues with a warning, notices equally many.

mod bits;
mod blocks;
mod check;
mod flaw;
mod frame;
mod scan;
mod standard;
mod tables;
#[cfg(test)]
mod tests;

pub(super) use check::check;
