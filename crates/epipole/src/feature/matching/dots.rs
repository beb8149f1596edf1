//! Inner products of eight packed descriptors with four others, in 16-bit integers.
//!
//! All variants add the same integers, so all give the same result: SSE2 on any 64-bit x86
//! processor, AVX2 if available, WebAssembly SIMD, and otherwise the portable loop.

#![allow(
    unsafe_code,
    reason = "loading vectors is unsafe; array types fix their lengths, or a check beside it does"
)]

use super::integers::{Integers, Packed, Piece, State, walk};
use super::neighbors::Scanned;

/// Returns the two nearest neighbors of each descriptor in a piece of the first list.
pub(super) fn scan(second: &Integers, bytes: &[u8]) -> Scanned<i32> {
    let piece = Piece::new(bytes, second);
    let mut state = State::new(second, &piece);
    walk_best(second, &piece, &mut state);
    state.scanned(second, &piece)
}

/// Compares a piece of the first list with the second list by the best available variant.
fn walk_best(second: &Integers, piece: &Piece, state: &mut State) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn wide(second: &Integers, piece: &Piece, state: &mut State) {
            walk(second, piece, state, |eight, four| avx2(eight, four));
        }
        if std::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2, as checked above.
            return unsafe { wide(second, piece, state) };
        }
        walk(second, piece, state, sse2);
    }
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    walk(second, piece, state, wasm);
    #[cfg(not(any(
        target_arch = "x86_64",
        all(target_arch = "wasm32", target_feature = "simd128")
    )))]
    walk(second, piece, state, portable);
}

/// Computes inner products of eight packed descriptors with each of four plain ones, whose pairs of
/// numbers are packed into one `i32`, low half first. All have the same number of pairs.
#[cfg_attr(
    any(target_arch = "x86_64", target_arch = "wasm32"),
    allow(dead_code, reason = "only other processors take it")
)]
#[inline(always)]
pub(super) fn portable(eight: &[Packed], four: [&[i32]; 4]) -> [[i32; 8]; 4] {
    let mut sums = [[0i32; 8]; 4];
    for (k, packed) in eight.iter().enumerate() {
        for (sums, plain) in sums.iter_mut().zip(four) {
            let (low, high) = (i32::from(plain[k] as i16), plain[k] >> 16);
            for lane in 0..8 {
                sums[lane] += i32::from(packed[2 * lane]) * low;
                sums[lane] += i32::from(packed[2 * lane + 1]) * high;
            }
        }
    }
    sums
}

#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn sse2(eight: &[Packed], four: [&[i32]; 4]) -> [[i32; 8]; 4] {
    use std::arch::x86_64::{
        __m128i, _mm_add_epi32, _mm_loadu_si128, _mm_madd_epi16, _mm_set1_epi32, _mm_setzero_si128,
        _mm_storeu_si128,
    };
    let pairs = eight.len();
    let four = four.map(|plain| &plain[..pairs]);
    let mut out = [[0i32; 8]; 4];
    // SAFETY: SSE2 is part of x86-64; a packed entry is 32 bytes, an output row 32 bytes.
    unsafe {
        let mut sums = [[_mm_setzero_si128(); 2]; 4];
        for k in 0..pairs {
            let at = eight[k].as_ptr().cast::<__m128i>();
            let (a, b) = (_mm_loadu_si128(at), _mm_loadu_si128(at.add(1)));
            for j in 0..4 {
                let pair = _mm_set1_epi32(four[j][k]);
                sums[j][0] = _mm_add_epi32(sums[j][0], _mm_madd_epi16(a, pair));
                sums[j][1] = _mm_add_epi32(sums[j][1], _mm_madd_epi16(b, pair));
            }
        }
        for j in 0..4 {
            let to = out[j].as_mut_ptr().cast::<__m128i>();
            _mm_storeu_si128(to, sums[j][0]);
            _mm_storeu_si128(to.add(1), sums[j][1]);
        }
    }
    out
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline]
pub(super) fn avx2(eight: &[Packed], four: [&[i32]; 4]) -> [[i32; 8]; 4] {
    use std::arch::x86_64::{
        __m256i, _mm256_add_epi32, _mm256_loadu_si256, _mm256_madd_epi16, _mm256_set1_epi32,
        _mm256_setzero_si256, _mm256_storeu_si256,
    };
    let pairs = eight.len();
    let four = four.map(|plain| &plain[..pairs]);
    let mut sums = [_mm256_setzero_si256(); 4];
    for k in 0..pairs {
        // SAFETY: a packed entry is 32 bytes.
        let packed = unsafe { _mm256_loadu_si256(eight[k].as_ptr().cast::<__m256i>()) };
        for j in 0..4 {
            let product = _mm256_madd_epi16(packed, _mm256_set1_epi32(four[j][k]));
            sums[j] = _mm256_add_epi32(sums[j], product);
        }
    }
    let mut out = [[0i32; 8]; 4];
    for j in 0..4 {
        // SAFETY: an output row is 32 bytes.
        unsafe { _mm256_storeu_si256(out[j].as_mut_ptr().cast::<__m256i>(), sums[j]) };
    }
    out
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
pub(super) fn wasm(eight: &[Packed], four: [&[i32]; 4]) -> [[i32; 8]; 4] {
    use std::arch::wasm32::{i32x4_add, i32x4_dot_i16x8, i32x4_splat, v128, v128_load, v128_store};
    let pairs = eight.len();
    let four = four.map(|plain| &plain[..pairs]);
    let mut sums = [[i32x4_splat(0); 2]; 4];
    for k in 0..pairs {
        let at = eight[k].as_ptr().cast::<v128>();
        // SAFETY: a packed entry is 32 bytes.
        let (a, b) = unsafe { (v128_load(at), v128_load(at.add(1))) };
        for j in 0..4 {
            let pair = i32x4_splat(four[j][k]);
            sums[j][0] = i32x4_add(sums[j][0], i32x4_dot_i16x8(a, pair));
            sums[j][1] = i32x4_add(sums[j][1], i32x4_dot_i16x8(b, pair));
        }
    }
    let mut out = [[0i32; 8]; 4];
    for j in 0..4 {
        let to = out[j].as_mut_ptr().cast::<v128>();
        // SAFETY: an output row is 32 bytes.
        unsafe {
            v128_store(to, sums[j][0]);
            v128_store(to.add(1), sums[j][1]);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_variants_agree() {
        let eight: Vec<Packed> = (0..9)
            .map(|k| std::array::from_fn(|i| ((k * 37 + i * 91) % 256) as i16))
            .collect();
        let four: [Vec<i32>; 4] = std::array::from_fn(|j| {
            (0..9)
                .map(|k| ((k * 13 + j as i32 * 7) % 256) | ((k * 5) % 256) << 16)
                .collect()
        });
        let four = four.each_ref().map(|v| v.as_slice());
        let expected = portable(&eight, four);
        assert_ne!(expected[0], expected[1]);
        #[cfg(target_arch = "x86_64")]
        {
            assert_eq!(sse2(&eight, four), expected);
            if std::is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has AVX2.
                assert_eq!(unsafe { avx2(&eight, four) }, expected);
            }
        }
    }
}
