// SPDX-License-Identifier: Apache-2.0
// Types for device headers that are written once and compiled for any number of lanes: C++ and OpenCL C with one lane,
// or OpenCL C with 16 where the kernel defines WT_LANES as 16 before its first include (CPU devices). Such code has no
// branches on lane values and selects only by `comparison ? a : b`, which works lane by lane, too; wt_gather reads a
// WT_TABLE of floats, each lane at a place of its own. It assumes no contraction.
#ifndef WAVETRACER_DEVICE_LANES_H
#define WAVETRACER_DEVICE_LANES_H

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#ifndef WT_LANES
#define WT_LANES 1
#endif
#if WT_LANES == 16
#define WT_U32 uint16
#define WT_U64 ulong16
#define WT_F32 float16
#define WT_TO_F32(x) convert_float16(x)
#define WT_TO_U32(x) convert_uint16(x)
#define WT_TO_U64(x) convert_ulong16(x)
inline float16 wt_gather(const global float* table, uint16 index) {
  return (float16)(table[index.s0], table[index.s1], table[index.s2], table[index.s3], table[index.s4], table[index.s5],
                   table[index.s6], table[index.s7], table[index.s8], table[index.s9], table[index.sa], table[index.sb],
                   table[index.sc], table[index.sd], table[index.se], table[index.sf]);
}
#else
#define WT_U32 uint
#define WT_U64 ulong
#define WT_F32 float
#define WT_TO_F32(x) ((float)(x))
#define WT_TO_U32(x) ((uint)(x))
#define WT_TO_U64(x) ((ulong)(x))
inline float wt_gather(const global float* table, uint index) { return table[index]; }
#endif
#define WT_TABLE const global float*
#else
#include <cmath>
#include <cstdint>
#define WT_U32 uint32_t
#define WT_U64 uint64_t
#define WT_F32 float
#define WT_TO_F32(x) static_cast<float>(x)
#define WT_TO_U32(x) static_cast<uint32_t>(x)
#define WT_TO_U64(x) static_cast<uint64_t>(x)
#define WT_TABLE const float*
namespace wavetracer::device {
inline float wt_gather(const float* table, uint32_t index) { return table[index]; }
using std::fabs;
using std::fma;
using std::sqrt;
}  // namespace wavetracer::device
#endif

#endif
