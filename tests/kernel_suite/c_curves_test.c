// SPDX-License-Identifier: Apache-2.0
/* Keys along curves through the C face, from C99: against loops over bits, and walks from cell to cell. */
#include <math.h>

#include "c_user.h"

enum { count = 512 };

static cl_context context;
static cl_command_queue queue;
static wavetracer_kernels_context* suite;

/* The bits of cells in turn, the lowest of each first: component d of bit b is bit b * dimensions + d of the code. */
static uint64_t interleaved(const uint32_t* cell, unsigned dimensions, unsigned bits) {
  uint64_t code = 0;
  for (unsigned b = 0; b < bits; ++b)
    for (unsigned d = 0; d < dimensions; ++d) code |= (uint64_t)(cell[d] >> b & 1) << (b * dimensions + d);
  return code;
}

/* Keys of `count` points, whose components are side by side with one float of padding. */
static void keys_of(wavetracer_kernels_curve_keys* keys, const float* points, unsigned dimensions, const float* lower,
                    const float* upper, uint64_t cells, unsigned key_bits, uint64_t* to) {
  wavetracer_kernels_error* error = NULL;
  static uint32_t narrow[count];
  cl_event done = NULL;
  cl_mem from = memory_of(context, points, sizeof(float) * count * (dimensions + 1));
  cl_mem out = clCreateBuffer(context, CL_MEM_READ_WRITE, count * key_bits / 8, NULL, NULL);
  EXPECT(wavetracer_kernels_curve_keys_run(keys, from, count, dimensions + 1, lower, upper, cells, out, 0, NULL, &done,
                                           &error));
  read_bytes(queue, out, key_bits == 64 ? (void*)to : (void*)narrow, count * key_bits / 8, done);
  if (key_bits == 32)
    for (int i = 0; i < count; ++i) to[i] = narrow[i];
  clReleaseEvent(done);
  clReleaseMemObject(from);
  clReleaseMemObject(out);
}

/* Morton keys of a box from -1 to 3; a number of cells that is no power of two makes a histogram. */
static void morton(int curve, unsigned dimensions, unsigned key_bits, uint32_t cells, unsigned level) {
  wavetracer_kernels_error* error = NULL;
  const float lower[5] = {-1, -1, -1, -1, -1}, upper[5] = {3, 3, 3, 3, 3};
  static float points[count * 6];
  static uint32_t cell[count][5];
  static uint64_t keys[count];
  wavetracer_kernels_curve_keys* object = wavetracer_kernels_curve_keys_make(suite, curve, key_bits, &error);
  EXPECT(object && !error);
  EXPECT(wavetracer_kernels_curve_keys_dimensions(object) == dimensions);
  EXPECT(wavetracer_kernels_curve_keys_bits(object, cells) == level * dimensions);
  for (uint32_t i = 0; i < count; ++i)
    for (unsigned d = 0; d < dimensions; ++d) {
      cell[i][d] = (i * 2654435761u >> d) % cells;
      points[i * (dimensions + 1) + d] = -1 + 4 * ((float)cell[i][d] + 0.5f) / (float)cells;
    }
  keys_of(object, points, dimensions, lower, upper, cells, key_bits, keys);
  for (int i = 0; i < count; ++i) EXPECT(keys[i] == interleaved(cell[i], dimensions, level));
  wavetracer_kernels_curve_keys_free(object);
}

/* A Hilbert curve visits each cell once and goes from a cell to one beside it. */
static void hilbert(int curve, unsigned dimensions, unsigned key_bits) {
  wavetracer_kernels_error* error = NULL;
  const uint32_t side = dimensions == 3 ? 8 : 16, all = dimensions == 3 ? 512 : 256;
  const float lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  static float points[count * 4];
  static uint64_t keys[count];
  uint32_t at[count];
  wavetracer_kernels_curve_keys* object = wavetracer_kernels_curve_keys_make(suite, curve, key_bits, &error);
  EXPECT(object && !error);
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t d = 0, rest = i % all; d < dimensions; ++d, rest /= side)
      points[i * (dimensions + 1) + d] = ((float)(rest % side) + 0.5f) / (float)side;
  keys_of(object, points, dimensions, lower, upper, side, key_bits, keys);
  for (uint32_t i = 0; i < all; ++i) at[i] = all;
  for (uint32_t i = 0; i < all; ++i) {
    EXPECT(keys[i] < all && at[keys[i]] == all);
    at[keys[i]] = i;
  }
  for (uint32_t k = 1; k < all; ++k) {
    float way = 0;
    for (unsigned d = 0; d < dimensions; ++d)
      way += fabsf(points[at[k] * (dimensions + 1) + d] - points[at[k - 1] * (dimensions + 1) + d]);
    EXPECT(fabsf(way * (float)side - 1) < 1e-3f);
  }
  wavetracer_kernels_curve_keys_free(object);
}

static void refused_curves(void) {
  wavetracer_kernels_error* error = NULL;
  const float zero[2] = {0, 0}, one[2] = {1, 1};
  cl_mem memory = clCreateBuffer(context, CL_MEM_READ_WRITE, 64, NULL, NULL);
  wavetracer_kernels_curve_keys* keys = wavetracer_kernels_curve_keys_make(suite, 0, 32, &error);
  EXPECT(keys);
  EXPECT(!wavetracer_kernels_curve_keys_run(keys, memory, 17, 0, zero, one, 4, memory, 0, NULL, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "CurveKeys: keys: the buffer has 64 bytes"));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_curve_keys_run(keys, memory, 4, 0, NULL, one, 4, memory, 0, NULL, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "the box is null"));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_curve_keys_run(keys, memory, 4, 0, one, zero, 4, memory, 0, NULL, NULL, NULL));
  EXPECT(!wavetracer_kernels_curve_keys_run(NULL, memory, 4, 0, zero, one, 4, memory, 0, NULL, NULL, NULL));
  wavetracer_kernels_curve_keys_free(keys);
  EXPECT(!wavetracer_kernels_curve_keys_make(suite, 5, 32, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "no such curve"));
  wavetracer_kernels_error_free(error);
  error = NULL;
  EXPECT(!wavetracer_kernels_curve_keys_make(suite, 0, 16, NULL));
  EXPECT(wavetracer_kernels_curve_keys_bits(NULL, 4) == 0 && wavetracer_kernels_curve_keys_dimensions(NULL) == 0);
  wavetracer_kernels_curve_keys_free(NULL);
  clReleaseMemObject(memory);
}

int main(void) {
  wavetracer_kernels_error* error = NULL;
  cl_device_id device = first_device();
  context = clCreateContext(NULL, 1, &device, NULL, NULL, NULL);
  queue = clCreateCommandQueueWithProperties(context, device, NULL, NULL);
  suite = wavetracer_kernels_open(context, device, queue, &error);
  EXPECT(suite && !error);
  morton(WAVETRACER_KERNELS_MORTON2, 2, 32, 1024, 10);
  morton(WAVETRACER_KERNELS_MORTON3, 3, 32, 64, 6);
  morton(WAVETRACER_KERNELS_MORTON3, 3, 32, 7, 3);
  morton(WAVETRACER_KERNELS_MORTON5, 5, 64, 4096, 12);
  hilbert(WAVETRACER_KERNELS_HILBERT2, 2, 32);
  hilbert(WAVETRACER_KERNELS_HILBERT3, 3, 64);
  refused_curves();
  wavetracer_kernels_close(suite);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return 0;
}
