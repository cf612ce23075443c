// SPDX-License-Identifier: Apache-2.0
/* The kernel suite for C99, and for every language that calls C: sorts, prefix sums and compaction in an OpenCL
   context, queue and memory of the caller's. For C++ there is wavetracer/kernels/kernels.hpp, which documents shapes,
   limits and cost of each pass; they are the same here.

   Objects are opaque and belong to the caller: what _open and _make return is given back to _close and _free, an error
   to _error_free, each once; null is allowed there. A pass may outlive its context.

   Errors: a function that takes `error` returns null or 0 on failure and then stores an error there, unless `error` is
   null; on success it stores null. A null object is a failure as well, never a crash. No exception leaves the library.

   Events: the commands of a call start after the after_count events of `after` (null if there are none), and after what
   is in the queue already. If `done` is not null, *done becomes an event that completes with the last command of the
   call; the caller releases it. Calls only enqueue: nothing waits for the device.

   Threads: one thread at a time may use a context with its passes; contexts of other threads may use other queues. */
#ifndef WAVETRACER_KERNELS_H
#define WAVETRACER_KERNELS_H
#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 300
#endif
#include <CL/cl.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wavetracer_kernels_context wavetracer_kernels_context;
typedef struct wavetracer_kernels_sort wavetracer_kernels_sort;
typedef struct wavetracer_kernels_scan wavetracer_kernels_scan;
typedef struct wavetracer_kernels_compact wavetracer_kernels_compact;
typedef struct wavetracer_kernels_error wavetracer_kernels_error;

/* The code of OpenCL that made the error, 0 if the suite itself refused an argument, or for null. */
cl_int wavetracer_kernels_error_code(const wavetracer_kernels_error* error);
/* The text, and "program/kernel" if a kernel could not be launched; "" for null. They live as long as the error. */
const char* wavetracer_kernels_error_message(const wavetracer_kernels_error* error);
const char* wavetracer_kernels_error_kernel(const wavetracer_kernels_error* error);
void wavetracer_kernels_error_free(wavetracer_kernels_error* error);

/* Uses handles of the caller's and retains them. The queue is an in-order one of this context and device. */
wavetracer_kernels_context* wavetracer_kernels_open(cl_context context, cl_device_id device, cl_command_queue queue,
                                                    wavetracer_kernels_error** error);
/* Opens a device with a queue of its own: an index, a part of a name, or null or "" for the default choice. */
wavetracer_kernels_context* wavetracer_kernels_open_device(const char* device, wavetracer_kernels_error** error);
void wavetracer_kernels_close(wavetracer_kernels_context* self);
/* The handles in use, which the caller does not own; null for null. */
cl_context wavetracer_kernels_cl_context(const wavetracer_kernels_context* self);
cl_device_id wavetracer_kernels_cl_device(const wavetracer_kernels_context* self);
cl_command_queue wavetracer_kernels_cl_queue(const wavetracer_kernels_context* self);

/* sort: ascending and stable, keys of 32 or 64 bits.
   Payload: nothing moves with the keys; a 32-bit word for each; or the sort writes the place that each key had. */
enum wavetracer_kernels_payload {
  WAVETRACER_KERNELS_NONE = 0,
  WAVETRACER_KERNELS_WORDS = 1,
  WAVETRACER_KERNELS_INDEX = 2
};
enum wavetracer_kernels_method {
  WAVETRACER_KERNELS_AUTOMATIC = 0,
  WAVETRACER_KERNELS_RADIX = 1,
  WAVETRACER_KERNELS_BITONIC = 2
};
wavetracer_kernels_sort* wavetracer_kernels_sort_make(const wavetracer_kernels_context* context, unsigned key_bits,
                                                      int payload, int method, wavetracer_kernels_error** error);
void wavetracer_kernels_sort_free(wavetracer_kernels_sort* self);
/* Sorts the first n keys by bits first_bit to end_bit - 1; end_bit 0 stands for all bits above. values: null without a
   payload. Returns 1, or 0 with an error. */
int wavetracer_kernels_sort_run(wavetracer_kernels_sort* self, cl_mem keys, cl_mem values, size_t n, unsigned first_bit,
                                unsigned end_bit, cl_uint after_count, const cl_event* after, cl_event* done,
                                wavetracer_kernels_error** error);
/* 32-bit words of temporary memory for up to n keys; 0 for null, and above 2^32 - 1 keys. */
size_t wavetracer_kernels_sort_temporary_words(const wavetracer_kernels_sort* self, size_t n);
/* Makes the temporary memory of the object's own large enough, so that sorts of up to n keys allocate nothing. */
int wavetracer_kernels_sort_reserve(wavetracer_kernels_sort* self, size_t n, wavetracer_kernels_error** error);
/* The object uses the caller's memory instead from now on; null returns to memory of its own. */
int wavetracer_kernels_sort_use_temporary(wavetracer_kernels_sort* self, cl_mem memory,
                                          wavetracer_kernels_error** error);

/* scan: the first n words become their exclusive prefix sums, modulo 2^32, in place. total: its first word becomes the
   sum of all; may be null. */
wavetracer_kernels_scan* wavetracer_kernels_scan_make(const wavetracer_kernels_context* context,
                                                      wavetracer_kernels_error** error);
void wavetracer_kernels_scan_free(wavetracer_kernels_scan* self);
int wavetracer_kernels_scan_run(wavetracer_kernels_scan* self, cl_mem words, size_t n, cl_mem total,
                                cl_uint after_count, const cl_event* after, cl_event* done,
                                wavetracer_kernels_error** error);

/* compact: the indices of those of the first n words that are not WAVETRACER_KERNELS_NOTHING, ascending, and their
   number as the first word of total. indices has room for n. */
#define WAVETRACER_KERNELS_NOTHING 0xffffffffu
wavetracer_kernels_compact* wavetracer_kernels_compact_make(const wavetracer_kernels_context* context,
                                                            wavetracer_kernels_error** error);
void wavetracer_kernels_compact_free(wavetracer_kernels_compact* self);
int wavetracer_kernels_compact_run(wavetracer_kernels_compact* self, cl_mem words, size_t n, cl_mem indices,
                                   cl_mem total, cl_uint after_count, const cl_event* after, cl_event* done,
                                   wavetracer_kernels_error** error);

#ifdef __cplusplus
}
#endif
#endif
