// SPDX-License-Identifier: Apache-2.0
/* The kernel suite for C99, and for every language that calls C: sorts, prefix sums, compaction, keys along curves,
   traced triangles and ray caches in an OpenCL context, queue and memory of the caller's. For C++ there is
   wavetracer/kernels/kernels.hpp, which documents shapes, limits and cost of each pass; they are the same here.

   Objects are opaque and belong to the caller: what _open and _make return is given back to _close and _free, an error
   to _error_free, each once; null is allowed there. A pass may outlive its context.

   Errors: a function that takes `error` returns null or 0 on failure and then stores an error there, unless `error` is
   null; on success it stores null. A null object is a failure as well, never a crash. No exception leaves the library.

   Events: the commands of a call start after the after_count events of `after` (null if there are none), and after what
   is in the queue already. If `done` is not null, *done becomes an event that completes with the last command of the
   call; the caller releases it. Calls only enqueue: nothing waits for the device, but ray caches read counts of rays.

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
typedef struct wavetracer_kernels_curve_keys wavetracer_kernels_curve_keys;
typedef struct wavetracer_kernels_bvh wavetracer_kernels_bvh;
typedef struct wavetracer_kernels_ray_cache wavetracer_kernels_ray_cache;
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

/* curve_keys: keys of points along space-filling curves, which are codes of the cells of a box (see curves.hpp).
   key_bits: 32 or 64. The most cells in each dimension are 2^16, 2^10, 2^6, 2^16, 2^10 with keys of 32 bits, and 2^32,
   2^21, 2^12, 2^32, 2^21 with keys of 64. */
enum wavetracer_kernels_curve {
  WAVETRACER_KERNELS_MORTON2 = 0,
  WAVETRACER_KERNELS_MORTON3 = 1,
  WAVETRACER_KERNELS_MORTON5 = 2,
  WAVETRACER_KERNELS_HILBERT2 = 3,
  WAVETRACER_KERNELS_HILBERT3 = 4
};
wavetracer_kernels_curve_keys* wavetracer_kernels_curve_keys_make(const wavetracer_kernels_context* context, int curve,
                                                                  unsigned key_bits, wavetracer_kernels_error** error);
void wavetracer_kernels_curve_keys_free(wavetracer_kernels_curve_keys* self);
/* The number of components of a point; 0 for null. */
unsigned wavetracer_kernels_curve_keys_dimensions(const wavetracer_kernels_curve_keys* self);
/* The number of the lowest bits of keys that count in a box of so many cells; 0 for null. */
unsigned wavetracer_kernels_curve_keys_bits(const wavetracer_kernels_curve_keys* self, uint64_t cells);
/* Computes the keys of the first n points. Component d of point i is points[i * stride + d], a float; a stride of 0
   stands for the number of dimensions. lower, upper: the corners of the box on the host, a float for each dimension.
   cells: its cells in each dimension; a number that is no power of two makes a histogram, whose bins are visited along
   the curve of the next power. Returns 1, or 0 with an error. */
int wavetracer_kernels_curve_keys_run(wavetracer_kernels_curve_keys* self, cl_mem points, size_t n, size_t stride,
                                      const float* lower, const float* upper, uint64_t cells, cl_mem keys,
                                      cl_uint after_count, const cl_event* after, cl_event* done,
                                      wavetracer_kernels_error** error);

/* Rays and their hits in memory of the device, one record after the other (see rays.hpp). */
#define WAVETRACER_KERNELS_NO_TRIANGLE 0xffffffffu
typedef struct {
  float origin[3], t_min; /* it meets what lies at origin + t * direction with t_min < t <= t_max */
  float direction[3], t_max;
} wavetracer_kernels_ray;
typedef struct {
  float t;           /* infinite where nothing is met */
  uint32_t triangle; /* WAVETRACER_KERNELS_NO_TRIANGLE where nothing is met */
  float u, v;        /* weights of the second and third corner */
} wavetracer_kernels_hit;

/* bvh: a tree over triangles. corners: nine floats on the host for each triangle. reach: the largest absolute
   coordinate of origins of rays, 0 if that is one of the triangles'. It needs double precision. */
wavetracer_kernels_bvh* wavetracer_kernels_bvh_make(const wavetracer_kernels_context* context, const float* corners,
                                                    size_t triangles, float reach, wavetracer_kernels_error** error);
void wavetracer_kernels_bvh_free(wavetracer_kernels_bvh* self);
/* hits[i] becomes the nearest hit of rays[i], for i < n; met[i], a 32-bit word, 1 where rays[i] meets any triangle,
   else 0. */
int wavetracer_kernels_bvh_nearest(wavetracer_kernels_bvh* self, cl_mem rays, size_t n, cl_mem hits,
                                   cl_uint after_count, const cl_event* after, cl_event* done,
                                   wavetracer_kernels_error** error);
int wavetracer_kernels_bvh_any(wavetracer_kernels_bvh* self, cl_mem rays, size_t n, cl_mem met, cl_uint after_count,
                               const cl_event* after, cl_event* done, wavetracer_kernels_error** error);

/* ray_cache: a table of traced rays that answers similar ones (see ray_cache.hpp). It needs 64-bit atomics. */
enum wavetracer_kernels_cache_kind {
  WAVETRACER_KERNELS_CACHE_CHAINED = 1,
  WAVETRACER_KERNELS_CACHE_OPEN = 2,
  WAVETRACER_KERNELS_CACHE_CONCURRENT = 3,
  WAVETRACER_KERNELS_CACHE_THESIS = 4,
  WAVETRACER_KERNELS_CACHE_THESIS_CHAINED = 5
};
enum wavetracer_kernels_cache_key { WAVETRACER_KERNELS_CACHE_QUANTISED = 0, WAVETRACER_KERNELS_CACHE_EXACT = 1 };
enum wavetracer_kernels_cache_hit_point { WAVETRACER_KERNELS_CACHE_OWN = 0, WAVETRACER_KERNELS_CACHE_CACHED = 1 };
enum wavetracer_kernels_cache_purge { WAVETRACER_KERNELS_CACHE_POSITION = 0, WAVETRACER_KERNELS_CACHE_PRECISION = 1 };
enum wavetracer_kernels_cache_locking { WAVETRACER_KERNELS_CACHE_MUTEX = 0, WAVETRACER_KERNELS_CACHE_READERS = 1 };
enum wavetracer_kernels_cache_scope { WAVETRACER_KERNELS_CACHE_STATIC = 0, WAVETRACER_KERNELS_CACHE_ALL = 1 };
typedef struct {
  int kind, key, hit_point, purge, locking, scope; /* the words above */
  int innerframe;                                  /* not 0: one ray of each key of a batch is traced */
  uint32_t hash_method;                            /* 1 uniform, 2 Morton, 3 mixed */
  uint32_t division;                               /* cells for each component of a direction, of a quantised key */
  uint32_t readers_number;                         /* an open entry must be renewed after so many reads */
  uint64_t buffer_size;                            /* entries, which the regions share evenly */
  double load_factor;                              /* chained: entries for each bucket, on average */
  double position_step_m;                          /* the step of the position of a region */
  double residual_value;                           /* precision: the largest L1 distance of origins and directions */
} wavetracer_kernels_cache_options;
/* The default options, with a concurrent table. */
wavetracer_kernels_cache_options wavetracer_kernels_cache_defaults(void);

/* bvh: the triangles that rays leave and meet; null: a tracer of the caller's own with this number of triangles, which
   needs an exact key or cached points. regions: places that rays start from. objects: with the scope ALL, the object of
   each triangle on the host, WAVETRACER_KERNELS_NO_TRIANGLE for what stands still; else null. */
wavetracer_kernels_ray_cache* wavetracer_kernels_ray_cache_make(const wavetracer_kernels_context* context,
                                                                const wavetracer_kernels_cache_options* options,
                                                                const wavetracer_kernels_bvh* bvh, size_t triangles,
                                                                uint32_t regions, const uint32_t* objects,
                                                                wavetracer_kernels_error** error);
void wavetracer_kernels_ray_cache_free(wavetracer_kernels_ray_cache* self);
/* Answers the first n rays: hits[i] becomes the answer, or a hit of nothing. left: 32-bit words with the triangle that
   each ray leaves; null: none. regions: 32-bit words with the region of each ray; null: 0. *to_trace becomes the number
   of rays that must be traced. */
int wavetracer_kernels_ray_cache_look_up(wavetracer_kernels_ray_cache* self, cl_mem rays, size_t n, cl_mem hits,
                                         cl_mem left, cl_mem regions, size_t* to_trace, cl_uint after_count,
                                         const cl_event* after, cl_event* done, wavetracer_kernels_error** error);
/* The rays that must be traced, side by side, and the index in the batch of each, a 32-bit word. They belong to the
   cache and change with its next look-up or store; null without a look-up of some rays. */
cl_mem wavetracer_kernels_ray_cache_rays(const wavetracer_kernels_ray_cache* self);
cl_mem wavetracer_kernels_ray_cache_indices(const wavetracer_kernels_ray_cache* self);
/* Stores the hits of the rays that had to be traced, in their order, and puts them among the hits of the look-up.
   *to_trace becomes the number of rays that must be traced after all and stored by another call; it is 0 without
   innerframe, and to_trace may be null then. */
int wavetracer_kernels_ray_cache_store(wavetracer_kernels_ray_cache* self, cl_mem traced, cl_mem hits, size_t* to_trace,
                                       cl_uint after_count, const cl_event* after, cl_event* done,
                                       wavetracer_kernels_error** error);
/* Begins the next frame; frames are counted from 1. */
int wavetracer_kernels_ray_cache_next_frame(wavetracer_kernels_ray_cache* self, wavetracer_kernels_error** error);
/* Says where the rays of a region start in this frame (three doubles, metres), and that an object has moved. */
int wavetracer_kernels_ray_cache_place_region(wavetracer_kernels_ray_cache* self, uint32_t region,
                                              const double* position_m, wavetracer_kernels_error** error);
int wavetracer_kernels_ray_cache_move_object(wavetracer_kernels_ray_cache* self, uint32_t object,
                                             wavetracer_kernels_error** error);
/* Removes entries that were neither stored nor answered in the last `frames` frames, this one included; all entries. */
int wavetracer_kernels_ray_cache_purge(wavetracer_kernels_ray_cache* self, uint32_t frames,
                                       wavetracer_kernels_error** error);
int wavetracer_kernels_ray_cache_clear(wavetracer_kernels_ray_cache* self, wavetracer_kernels_error** error);
/* Counts since the cache was made, and its state now; see RayCacheStatistics. Waits for the queue. */
typedef struct {
  uint64_t look_ups, hits, shared, conflicts, stale, stored, replaced, duplicates, dropped, evicted;
  uint64_t entries, used, bytes;
} wavetracer_kernels_cache_statistics;
int wavetracer_kernels_ray_cache_statistics(wavetracer_kernels_ray_cache* self,
                                            wavetracer_kernels_cache_statistics* statistics,
                                            wavetracer_kernels_error** error);

#ifdef __cplusplus
}
#endif
#endif
