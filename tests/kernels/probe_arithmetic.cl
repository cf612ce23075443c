// SPDX-License-Identifier: Apache-2.0
// Measures the arithmetic of a device: chains of fused multiplies and adds, 8 of which are independent of each other,
// and nothing that memory could slow down. WT_SCALAR is float or double, WT_LANES 1 or the lanes of a vector of OpenCL.
// Assumes a global size that is a multiple of the local one.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define WT_JOIN_(a, b) a##b
#define WT_JOIN(a, b) WT_JOIN_(a, b)
#if WT_LANES > 1
#define WT_REAL WT_JOIN(WT_SCALAR, WT_LANES)
#else
#define WT_REAL WT_SCALAR
#endif

kernel void arithmetic(global WT_SCALAR* out, WT_SCALAR factor, uint rounds) {
  WT_REAL a[8];
  for (int k = 0; k < 8; ++k) a[k] = (WT_REAL)((WT_SCALAR)(get_global_id(0) + k));
  for (uint round = 0; round < rounds; ++round) {
    for (int k = 0; k < 8; ++k) a[k] = fma(a[k], (WT_REAL)factor, (WT_REAL)factor);
  }
  WT_REAL sum = a[0];
  for (int k = 1; k < 8; ++k) sum += a[k];
#if WT_LANES > 1
  WT_JOIN(vstore, WT_LANES)(sum, get_global_id(0), out);
#else
  out[get_global_id(0)] = sum;
#endif
}
