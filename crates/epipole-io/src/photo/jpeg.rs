//! Whether the data of a JPEG file make a whole picture.
//!
//! Decoders for browsers show what they can of a damaged file, and fill the rest with something;
//! geometry must not be fooled by it. So the codes of the data are passed over once more, without
//! making pixels of them: there have to be as many blocks as the picture has, of codes that the
//! file's own tables have. What the passing over knows nothing of (arithmetic coding, lossless
//! files, tables that are missing) is left to the decoder to judge.
//!
//! Damage that leaves as many codes that make sense is not noticed. In fourteen encodings of a
//! photograph, a part that was cut out or overwritten (500 bytes) was found in 99 of 100 cases, a
//! single changed byte in every other one; `libjpeg`, which goes on with a warning, notices as
//! many.

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
