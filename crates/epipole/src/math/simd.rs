//! Kernels compiled twice: for every processor, and for those with AVX2.
//!
//! The body is ordinary Rust that the compiler vectorizes; the second copy only lets it use wider
//! registers. The compiler neither reorders floating-point sums nor fuses a multiplication with an
//! addition, so both copies give the same bits, which are also those of WebAssembly.

#![allow(
    unsafe_code,
    reason = "calling what was compiled for AVX2 is unsafe; each call follows the check of the processor"
)]

/// A value aligned to a cache line.
///
/// A vector store across two lines takes twice as long. The stack aligns arrays of numbers only to
/// 16 bytes, so the speed of lane sums in memory would depend on the depth of the stack.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Aligned<T>(pub(crate) T);

/// Defines a function whose body is compiled for the baseline and for AVX2, and which selects one
/// at run time.
macro_rules! dispatched {
    ($(#[$meta:meta])* $vis:vis fn $name:ident $(<$(const $constant:ident: $kind:ty),+>)?
        ($($argument:ident: $type:ty),* $(,)?) $(-> $output:ty)? $body:block) => {
        $(#[$meta])*
        #[allow(
            unsafe_code,
            clippy::too_many_arguments,
            reason = "each call follows the check; kernels take what they need"
        )]
        #[inline]
        $vis fn $name $(<$(const $constant: $kind),+>)? ($($argument: $type),*) $(-> $output)? {
            #[inline(always)]
            fn portable $(<$(const $constant: $kind),+>)? ($($argument: $type),*) $(-> $output)? $body

            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2,popcnt")]
                fn wide $(<$(const $constant: $kind),+>)? ($($argument: $type),*) $(-> $output)? {
                    portable $(::<$($constant),+>)? ($($argument),*)
                }
                if std::is_x86_feature_detected!("avx2")
                    && std::is_x86_feature_detected!("popcnt")
                {
                    // SAFETY: the processor has both features, as checked above.
                    return unsafe { wide $(::<$($constant),+>)? ($($argument),*) };
                }
            }
            portable $(::<$($constant),+>)? ($($argument),*)
        }
    };
}
pub(crate) use dispatched;
