// SPDX-License-Identifier: Apache-2.0
// Types of a fixed size for records that C++ and OpenCL C share. Lanes of a vector are s[0], s[1], ... in C++.
#ifndef WAVETRACER_DEVICE_TYPES_H
#define WAVETRACER_DEVICE_TYPES_H

// A large function that is called from several places, or whose neighbours on a GPU come to it by different ways. A GPU
// compiler that put a copy into each place would make a kernel too large for the cache of instructions: that took twice
// the time in fields, and in the compiler. CPUs inline it.
#if defined(__OPENCL_VERSION__) && !defined(WT_CPU)
#define WT_CALLED __attribute__((noinline)) static
#else
#define WT_CALLED inline
#endif

#ifdef __OPENCL_VERSION__
typedef int wt_int;
typedef uint wt_uint;
typedef ulong wt_ulong;
typedef float4 wt_float4;
typedef float8 wt_float8;
typedef int4 wt_int4;
typedef uint4 wt_uint4;
#else
#include <cstdint>
typedef int32_t wt_int;
typedef uint32_t wt_uint;
typedef uint64_t wt_ulong;
struct alignas(16) wt_float4 {
  float s[4];
};
struct alignas(32) wt_float8 {
  float s[8];
};
struct alignas(16) wt_int4 {
  int32_t s[4];
};
struct alignas(16) wt_uint4 {
  uint32_t s[4];
};
#endif

#endif
