// SPDX-License-Identifier: Apache-2.0
/* The C face of the kernel suite from C99, with a context and a queue of this program's own. */
#include "c_user.h"

enum { n = 3000 };

static int by_size(const void* a, const void* b) {
  const uint32_t x = *(const uint32_t*)a, y = *(const uint32_t*)b;
  return (x > y) - (x < y);
}

static uint32_t data[n], sorted[n], order[n], out[n];

static void sorts(wavetracer_kernels_context* suite, cl_context context, cl_command_queue queue) {
  wavetracer_kernels_error* error = NULL;
  wavetracer_kernels_sort* sort =
      wavetracer_kernels_sort_make(suite, 32, WAVETRACER_KERNELS_INDEX, WAVETRACER_KERNELS_RADIX, &error);
  EXPECT(sort && !error);
  for (uint32_t i = 0; i < n; ++i) data[i] = sorted[i] = i * 2654435761u;
  qsort(sorted, n, sizeof *sorted, by_size);
  cl_mem keys = memory_of(context, data, sizeof data), values = memory_of(context, data, sizeof data);
  cl_event done = NULL, again = NULL;
  EXPECT(wavetracer_kernels_sort_reserve(sort, n, &error));
  EXPECT(wavetracer_kernels_sort_run(sort, keys, values, n, 0, 0, 0, NULL, &done, &error));
  read_words(queue, keys, out, n, done);
  EXPECT(memcmp(out, sorted, sizeof out) == 0);
  read_words(queue, values, order, n, done);
  for (uint32_t i = 0; i < n; ++i) EXPECT(data[order[i]] == sorted[i]);
  cl_mem room =
      clCreateBuffer(context, CL_MEM_READ_WRITE, 4 * wavetracer_kernels_sort_temporary_words(sort, n), NULL, NULL);
  EXPECT(wavetracer_kernels_sort_use_temporary(sort, room, &error));
  EXPECT(wavetracer_kernels_sort_run(sort, keys, values, n, 0, 8, 1, &done, &again, &error));
  read_words(queue, keys, out, n, again);
  for (uint32_t i = 1; i < n; ++i) EXPECT((out[i - 1] & 255) <= (out[i] & 255));

  EXPECT(!wavetracer_kernels_sort_run(sort, keys, values, n + 1, 0, 0, 0, NULL, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "Sort: keys: the buffer has 12000 bytes"));
  EXPECT(wavetracer_kernels_error_code(error) == 0 && wavetracer_kernels_error_kernel(error)[0] == 0);
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_sort_run(sort, keys, values, n, 0, 0, 1, NULL, NULL, &error));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_sort_run(sort, keys, NULL, n, 0, 0, 0, NULL, NULL, NULL));
  error = NULL;
  EXPECT(!wavetracer_kernels_sort_make(suite, 16, 0, 0, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "32 or 64 bits"));
  wavetracer_kernels_error_free(error);
  error = NULL;
  EXPECT(!wavetracer_kernels_sort_make(suite, 32, 7, 0, NULL));
  EXPECT(!wavetracer_kernels_sort_make(NULL, 32, 0, 0, NULL));
  EXPECT(!wavetracer_kernels_sort_run(NULL, keys, values, n, 0, 0, 0, NULL, NULL, NULL));
  EXPECT(wavetracer_kernels_sort_temporary_words(NULL, n) == 0);
  wavetracer_kernels_sort_free(sort);
  clReleaseEvent(done);
  clReleaseEvent(again);
  clReleaseMemObject(keys);
  clReleaseMemObject(values);
  clReleaseMemObject(room);
}

static void scans(wavetracer_kernels_context* suite, cl_context context, cl_command_queue queue) {
  wavetracer_kernels_error* error = NULL;
  wavetracer_kernels_scan* scan = wavetracer_kernels_scan_make(suite, &error);
  wavetracer_kernels_compact* compact = wavetracer_kernels_compact_make(suite, &error);
  EXPECT(scan && compact);
  uint32_t total = 0;
  for (uint32_t i = 0; i < n; ++i) data[i] = i % 3 == 0 ? WAVETRACER_KERNELS_NOTHING : i;
  cl_mem words = memory_of(context, data, sizeof data), indices = memory_of(context, data, sizeof data),
         sum = memory_of(context, data, 4);
  EXPECT(wavetracer_kernels_compact_run(compact, words, n, indices, sum, 0, NULL, NULL, &error));
  read_words(queue, sum, &total, 1, NULL);
  EXPECT(total == n - n / 3);
  read_words(queue, indices, out, total, NULL);
  for (uint32_t i = 0; i < total; ++i) EXPECT(out[i] == 3 * (i / 2) + 1 + i % 2);
  EXPECT(wavetracer_kernels_scan_run(scan, indices, total, sum, 0, NULL, NULL, &error));
  read_words(queue, indices, order, total, NULL);
  read_words(queue, sum, &total, 1, NULL);
  uint32_t running = 0;
  for (uint32_t i = 0; i < n - n / 3; running += out[i++]) EXPECT(order[i] == running);
  EXPECT(total == running);
  EXPECT(wavetracer_kernels_scan_run(scan, indices, 5, NULL, 0, NULL, NULL, &error));
  wavetracer_kernels_scan_free(scan);
  wavetracer_kernels_compact_free(compact);
  clReleaseMemObject(words);
  clReleaseMemObject(indices);
  clReleaseMemObject(sum);
}

int main(void) {
  wavetracer_kernels_error* error = NULL;
  cl_device_id device = first_device();
  cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, NULL);
  cl_command_queue queue = clCreateCommandQueueWithProperties(context, device, NULL, NULL);
  wavetracer_kernels_context* suite = wavetracer_kernels_open(context, device, queue, &error);
  EXPECT(suite && !error);
  EXPECT(wavetracer_kernels_cl_context(suite) == context && wavetracer_kernels_cl_device(suite) == device &&
         wavetracer_kernels_cl_queue(suite) == queue);
  sorts(suite, context, queue);
  scans(suite, context, queue);
  wavetracer_kernels_close(suite);

  EXPECT(!wavetracer_kernels_open(NULL, device, queue, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "cl_context is null"));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_open_device("no such device", &error));
  wavetracer_kernels_error_free(error);
  wavetracer_kernels_error_free(NULL);
  wavetracer_kernels_close(NULL);
  wavetracer_kernels_sort_free(NULL);
  EXPECT(wavetracer_kernels_error_message(NULL)[0] == 0);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return 0;
}
