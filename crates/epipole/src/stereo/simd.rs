//! Wider vectors where the processor has them, with the same results.
//!
//! The crate is built for the lowest x86-64 processors, with vectors of 16 bytes. A [`Kernel`] is
//! compiled a second time for AVX2 (32 bytes) from the same safe source. All its arithmetic is on
//! integers, so both versions give the same bits.
#![allow(unsafe_code)] // One call below: the processor was asked first.

/// A computation worth compiling twice. `run` and all it calls must be `#[inline(always)]`, or
/// the wider version would call the narrow one.
pub(super) trait Kernel {
    type Output;
    fn run(self) -> Self::Output;
}

/// Runs a kernel in the widest version that this processor understands.
pub(super) fn run_widest<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has just said that it has AVX2.
        return unsafe { run_avx2(kernel) };
    }
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
