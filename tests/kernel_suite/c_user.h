// SPDX-License-Identifier: Apache-2.0
/* Parts that the tests of the C face share: an expectation, and a user of OpenCL's C interface. */
#ifndef WAVETRACER_TESTS_C_USER_H
#define WAVETRACER_TESTS_C_USER_H
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wavetracer/kernels/kernels.h"

#define EXPECT(condition)                                                                         \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      printf("line %d: %s: %s\n", __LINE__, #condition, wavetracer_kernels_error_message(error)); \
      exit(1);                                                                                    \
    }                                                                                             \
  } while (0)

/* The first device of the platform that WAVETRACER_TEST_PLATFORM names, else of the first platform that has one. */
static inline cl_device_id first_device(void) {
  cl_platform_id platforms[16];
  cl_uint count = 0;
  const char* expected = getenv("WAVETRACER_TEST_PLATFORM");
  clGetPlatformIDs(16, platforms, &count);
  for (cl_uint i = 0; i < count && i < 16; ++i) {
    char name[256] = "";
    cl_device_id device = NULL;
    clGetPlatformInfo(platforms[i], CL_PLATFORM_NAME, sizeof name, name, NULL);
    if (expected && strcmp(name, expected) != 0) continue;
    if (clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, 1, &device, NULL) == CL_SUCCESS) return device;
  }
  printf("no OpenCL device\n");
  exit(1);
}

static inline cl_mem memory_of(cl_context context, const void* data, size_t bytes) {
  return clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, bytes, (void*)data, NULL);
}

static inline void read_bytes(cl_command_queue queue, cl_mem memory, void* to, size_t bytes, cl_event after) {
  if (clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, bytes, to, after ? 1 : 0, after ? &after : NULL, NULL) !=
      CL_SUCCESS)
    exit(1);
}

static inline void read_words(cl_command_queue queue, cl_mem memory, uint32_t* to, size_t count, cl_event after) {
  read_bytes(queue, memory, to, 4 * count, after);
}

#endif
