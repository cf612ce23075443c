// SPDX-License-Identifier: Apache-2.0
// Loops over columns of numbers, compiled for AVX2 as well as for the processor that the build is for; the processor
// decides once which of the two runs. Their results have the same bits: sums keep their order, and contraction is off.
// Real and imaginary parts must be apart, and there must be no branches inside.
#pragma once
#include <complex>
#include <cstddef>

// Put this before a function that has such loops. Sanitizers start after the choice is made, by a function that they
// would watch, so they get one version; so do other compilers and processors.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WAVETRACER_WIDE __attribute__((target_clones("avx2", "default")))
#define WAVETRACER_WIDE_FMA __attribute__((target_clones("fma", "default")))
#else
#define WAVETRACER_WIDE
#define WAVETRACER_WIDE_FMA
#endif
// WAVETRACER_WIDE_FMA is for functions that call fma: its first version has instructions for them. They round once, as
// those of the library do.
// Put this before a function that such a function calls in its loops: it becomes a part of each version.
#define WAVETRACER_WIDE_PART [[gnu::always_inline]] inline

namespace wavetracer {

// Adds z * factor to sum, for this many numbers.
WAVETRACER_WIDE_PART void add_product(const std::complex<double>& z, const double* factor_re, const double* factor_im,
                                      size_t count, double* __restrict sum_re, double* __restrict sum_im) {
  const double re = z.real(), im = z.imag();
  for (size_t i = 0; i < count; ++i) {
    sum_re[i] += re * factor_re[i] - im * factor_im[i];
    sum_im[i] += re * factor_im[i] + im * factor_re[i];
  }
}

}  // namespace wavetracer
