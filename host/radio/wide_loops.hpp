// Loops over columns of numbers, compiled for AVX2 besides the processor that the build is for; which of the two runs
// is decided once, by the processor. Their results are the same bits: sums keep their order, and contraction is off.
// Assumes real and imaginary parts apart, and no branches inside.
#pragma once
#include <complex>
#include <cstddef>

// Before a function that has such loops. Sanitizers start later than the choice is made, by a function that they would
// watch; other compilers and processors make one version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WAVETRACER_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WAVETRACER_WIDE
#endif
// Before what such a function calls in its loops: it becomes a part of each version.
#define WAVETRACER_WIDE_PART [[gnu::always_inline]] inline

namespace wavetracer {

// sum += z * factor, of so many numbers.
WAVETRACER_WIDE_PART void add_product(const std::complex<double>& z, const double* factor_re, const double* factor_im,
                                      size_t count, double* __restrict sum_re, double* __restrict sum_im) {
  const double re = z.real(), im = z.imag();
  for (size_t i = 0; i < count; ++i) {
    sum_re[i] += re * factor_re[i] - im * factor_im[i];
    sum_im[i] += re * factor_im[i] + im * factor_re[i];
  }
}

}  // namespace wavetracer
