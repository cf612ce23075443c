// SPDX-License-Identifier: Apache-2.0
/* Trees and ray caches through the C face, from C99: against heights above planes, and hits that name their rays. */
#include <math.h>

#include "c_user.h"

enum { count = 512 };

static cl_context context;
static cl_command_queue queue;
static wavetracer_kernels_context* suite;

/* Two large triangles, at z = 0 and z = -10, and rays that go straight down from z = height + i. */
static const float floors[18] = {-100, -100, 0, 100, -100, 0, 0, 100, 0, -900, -900, -10, 900, -900, -10, 0, 900, -10};
static wavetracer_kernels_ray rays[count];
static wavetracer_kernels_hit hits[count];

static void fall_from(float height, uint32_t n) {
  for (uint32_t i = 0; i < n; ++i) {
    const wavetracer_kernels_ray ray = {{0.25f * (float)(i % 8), 1, height + (float)i}, 0, {0, 0, -1}, INFINITY};
    rays[i] = ray;
  }
}

/* Directions of which no two share a cell. */
static void fan_out(void) {
  for (int i = 0; i < count; ++i) {
    const float angle = 3.0f * (float)i / count;
    const wavetracer_kernels_ray ray = {{0, 0, 0}, 0, {cosf(angle), sinf(angle), 0}, INFINITY};
    rays[i] = ray;
  }
}

static wavetracer_kernels_bvh* traces(void) {
  wavetracer_kernels_error* error = NULL;
  uint32_t met[count];
  wavetracer_kernels_bvh* bvh = wavetracer_kernels_bvh_make(suite, floors, 2, 1000, &error);
  EXPECT(bvh && !error);
  fall_from(1, count);
  for (int i = 0; i < count; i += 4) rays[i].t_max = 0.5f;
  for (int i = 1; i < count; i += 4) rays[i].t_min = (float)i + 2; /* past the upper floor */
  cl_mem from = memory_of(context, rays, sizeof rays), to = memory_of(context, hits, sizeof hits);
  cl_mem any = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof met, NULL, NULL);
  EXPECT(wavetracer_kernels_bvh_nearest(bvh, from, count, to, 0, NULL, NULL, &error));
  EXPECT(wavetracer_kernels_bvh_any(bvh, from, count, any, 0, NULL, NULL, &error));
  read_bytes(queue, to, hits, sizeof hits, NULL);
  read_words(queue, any, met, count, NULL);
  for (uint32_t i = 0; i < count; ++i) {
    const int missed = i % 4 == 0, lower = i % 4 == 1;
    EXPECT(met[i] == !missed);
    EXPECT(hits[i].triangle == (missed ? WAVETRACER_KERNELS_NO_TRIANGLE : lower ? 1u : 0u));
    EXPECT(missed ? isinf(hits[i].t) : hits[i].t == 1 + (float)i + (lower ? 10.0f : 0.0f));
  }
  EXPECT(!wavetracer_kernels_bvh_nearest(bvh, from, count + 1, to, 0, NULL, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "Bvh: rays: the buffer has"));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_bvh_make(suite, NULL, 2, 0, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "the corners are null"));
  wavetracer_kernels_error_free(error);
  EXPECT(!wavetracer_kernels_bvh_any(NULL, from, 1, any, 0, NULL, NULL, NULL));
  clReleaseMemObject(from);
  clReleaseMemObject(to);
  clReleaseMemObject(any);
  return bvh;
}

/* Looks the rays up; returns how many must be traced. */
static size_t ask(wavetracer_kernels_ray_cache* cache, cl_mem from, cl_mem to, cl_mem left) {
  wavetracer_kernels_error* error = NULL;
  size_t to_trace = 0;
  EXPECT(wavetracer_kernels_ray_cache_look_up(cache, from, count, to, left, NULL, &to_trace, 0, NULL, NULL, &error));
  return to_trace;
}

/* Stores a hit for each ray that must be traced, which names the ray: t is 1 + its index in the batch. */
static size_t name_hits(wavetracer_kernels_ray_cache* cache, cl_mem to, size_t to_trace) {
  wavetracer_kernels_error* error = NULL;
  uint32_t indices[count];
  size_t after = 0;
  if (to_trace == 0) return 0;
  read_words(queue, wavetracer_kernels_ray_cache_indices(cache), indices, to_trace, NULL);
  for (size_t k = 0; k < to_trace; ++k) {
    const wavetracer_kernels_hit hit = {1 + (float)indices[k], indices[k] % 16, 0, 0};
    hits[k] = hit;
  }
  cl_mem traced = memory_of(context, hits, sizeof hits);
  EXPECT(wavetracer_kernels_ray_cache_store(cache, traced, to, &after, 0, NULL, NULL, &error));
  clReleaseMemObject(traced);
  return after;
}

/* A table of exact keys has the rays that were stored until they are purged. */
static void caches(int kind) {
  wavetracer_kernels_error* error = NULL;
  wavetracer_kernels_cache_options options = wavetracer_kernels_cache_defaults();
  options.kind = kind;
  options.key = WAVETRACER_KERNELS_CACHE_EXACT;
  options.buffer_size = 1 << 16;
  wavetracer_kernels_ray_cache* cache = wavetracer_kernels_ray_cache_make(suite, &options, NULL, 16, 1, NULL, &error);
  EXPECT(cache && !error);
  fan_out();
  cl_mem from = memory_of(context, rays, sizeof rays), to = memory_of(context, hits, sizeof hits);
  EXPECT(ask(cache, from, to, NULL) == count);
  EXPECT(name_hits(cache, to, count) == 0);
  const size_t again = ask(cache, from, to, NULL);
  EXPECT(kind == WAVETRACER_KERNELS_CACHE_OPEN ? again < count / 4 : again == 0);
  name_hits(cache, to, again);
  read_bytes(queue, to, hits, sizeof hits, NULL);
  for (int i = 0; i < count; ++i) EXPECT(hits[i].t == 1 + (float)i && hits[i].triangle == (uint32_t)i % 16);
  wavetracer_kernels_cache_statistics statistics;
  EXPECT(wavetracer_kernels_ray_cache_statistics(cache, &statistics, &error));
  EXPECT(statistics.look_ups == 2 * count && statistics.hits == count - again && statistics.shared == 0);
  EXPECT(statistics.entries == 1 << 16 && statistics.bytes >= statistics.entries * 64);
  EXPECT(wavetracer_kernels_ray_cache_next_frame(cache, &error));
  EXPECT(wavetracer_kernels_ray_cache_purge(cache, 1, &error)); /* nothing was asked in this frame */
  if (kind != WAVETRACER_KERNELS_CACHE_OPEN) EXPECT(ask(cache, from, to, NULL) == count);
  EXPECT(wavetracer_kernels_ray_cache_clear(cache, &error));
  EXPECT(ask(cache, from, to, NULL) == count);
  wavetracer_kernels_ray_cache_free(cache);
  clReleaseMemObject(from);
  clReleaseMemObject(to);
}

/* With points of their own, rays of one direction get their own height above the plane that the first of them met. */
static void own_points(wavetracer_kernels_bvh* bvh) {
  wavetracer_kernels_error* error = NULL;
  wavetracer_kernels_cache_options options = wavetracer_kernels_cache_defaults();
  options.innerframe = 1;
  options.buffer_size = 1 << 10;
  wavetracer_kernels_ray_cache* cache = wavetracer_kernels_ray_cache_make(suite, &options, bvh, 0, 1, NULL, &error);
  EXPECT(cache && !error);
  const double place[3] = {0, 0, 1}, other[3] = {0, 0, 99};
  fall_from(1, count);
  rays[5].origin[0] = 200; /* it passes the upper floor */
  cl_mem from = memory_of(context, rays, sizeof rays), to = memory_of(context, hits, sizeof hits),
         traced = memory_of(context, hits, sizeof hits);
  EXPECT(wavetracer_kernels_ray_cache_place_region(cache, 0, place, &error));
  size_t to_trace = ask(cache, from, to, NULL);
  for (int round = 0; round < 2; ++round) { /* the first ray; then the one that its hit is not for */
    EXPECT(to_trace == 1);
    EXPECT(wavetracer_kernels_bvh_nearest(bvh, wavetracer_kernels_ray_cache_rays(cache), 1, traced, 0, NULL, NULL,
                                          &error));
    EXPECT(wavetracer_kernels_ray_cache_store(cache, traced, to, &to_trace, 0, NULL, NULL, &error));
  }
  EXPECT(to_trace == 0);
  read_bytes(queue, to, hits, sizeof hits, NULL);
  for (int i = 0; i < count; ++i) EXPECT(fabsf(hits[i].t - (1 + (float)i + (i == 5 ? 10.0f : 0.0f))) < 1e-3f);
  wavetracer_kernels_cache_statistics statistics;
  EXPECT(wavetracer_kernels_ray_cache_statistics(cache, &statistics, &error));
  EXPECT(statistics.shared == count - 2);
  EXPECT(wavetracer_kernels_ray_cache_next_frame(cache, &error));
  EXPECT(wavetracer_kernels_ray_cache_place_region(cache, 0, other, &error));
  EXPECT(ask(cache, from, to, NULL) == 1);
  EXPECT(wavetracer_kernels_ray_cache_statistics(cache, &statistics, &error) && statistics.hits == 0);
  wavetracer_kernels_ray_cache_free(cache);
  clReleaseMemObject(from);
  clReleaseMemObject(to);
  clReleaseMemObject(traced);
}

/* The entries of an object that has moved are gone, and no others. */
static void objects_that_move(void) {
  wavetracer_kernels_error* error = NULL;
  uint32_t objects[16], left[count];
  wavetracer_kernels_cache_options options = wavetracer_kernels_cache_defaults();
  options.hit_point = WAVETRACER_KERNELS_CACHE_CACHED;
  options.scope = WAVETRACER_KERNELS_CACHE_ALL;
  options.buffer_size = 1 << 12;
  for (uint32_t i = 0; i < 16; ++i) objects[i] = i < 8 ? WAVETRACER_KERNELS_NO_TRIANGLE : i % 2;
  for (uint32_t i = 0; i < count; ++i) left[i] = i % 16;
  wavetracer_kernels_ray_cache* cache =
      wavetracer_kernels_ray_cache_make(suite, &options, NULL, 16, 1, objects, &error);
  EXPECT(cache && !error);
  fan_out();
  cl_mem from = memory_of(context, rays, sizeof rays), to = memory_of(context, hits, sizeof hits),
         out_of = memory_of(context, left, sizeof left);
  EXPECT(ask(cache, from, to, out_of) == count);
  name_hits(cache, to, count);
  EXPECT(wavetracer_kernels_ray_cache_next_frame(cache, &error));
  EXPECT(ask(cache, from, to, out_of) == 0);
  EXPECT(wavetracer_kernels_ray_cache_move_object(cache, 1, &error));
  EXPECT(ask(cache, from, to, out_of) == count / 4); /* triangles 9, 11, 13, 15 of 16 */
  EXPECT(!wavetracer_kernels_ray_cache_move_object(cache, 2, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "RayCache: object 2 of 2"));
  wavetracer_kernels_error_free(error);
  wavetracer_kernels_ray_cache_free(cache);
  clReleaseMemObject(from);
  clReleaseMemObject(to);
  clReleaseMemObject(out_of);
}

static void refused_caches(void) {
  wavetracer_kernels_error* error = NULL;
  wavetracer_kernels_cache_options options = wavetracer_kernels_cache_defaults();
  EXPECT(!wavetracer_kernels_ray_cache_make(suite, &options, NULL, 16, 1, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "needs the Bvh"));
  wavetracer_kernels_error_free(error);
  options.kind = 9;
  EXPECT(!wavetracer_kernels_ray_cache_make(suite, &options, NULL, 16, 1, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "RayCache: kind = 9"));
  wavetracer_kernels_error_free(error);
  error = NULL;
  EXPECT(!wavetracer_kernels_ray_cache_make(suite, NULL, NULL, 16, 1, NULL, NULL));
  options = wavetracer_kernels_cache_defaults();
  options.key = WAVETRACER_KERNELS_CACHE_EXACT;
  options.buffer_size = 64;
  wavetracer_kernels_ray_cache* cache = wavetracer_kernels_ray_cache_make(suite, &options, NULL, 16, 1, NULL, NULL);
  EXPECT(cache && !wavetracer_kernels_ray_cache_rays(cache) && !wavetracer_kernels_ray_cache_indices(cache));
  cl_mem memory = clCreateBuffer(context, CL_MEM_READ_WRITE, 64, NULL, NULL);
  EXPECT(!wavetracer_kernels_ray_cache_store(cache, memory, memory, NULL, 0, NULL, NULL, &error));
  EXPECT(error && strstr(wavetracer_kernels_error_message(error), "store() without a look_up()"));
  wavetracer_kernels_error_free(error);
  error = NULL;
  EXPECT(!wavetracer_kernels_ray_cache_place_region(cache, 0, NULL, NULL));
  EXPECT(!wavetracer_kernels_ray_cache_statistics(cache, NULL, NULL));
  EXPECT(!wavetracer_kernels_ray_cache_clear(NULL, NULL) && !wavetracer_kernels_ray_cache_rays(NULL));
  wavetracer_kernels_ray_cache_free(cache);
  wavetracer_kernels_ray_cache_free(NULL);
  clReleaseMemObject(memory);
}

int main(void) {
  wavetracer_kernels_error* error = NULL;
  cl_device_id device = first_device();
  context = clCreateContext(NULL, 1, &device, NULL, NULL, NULL);
  queue = clCreateCommandQueueWithProperties(context, device, NULL, NULL);
  suite = wavetracer_kernels_open(context, device, queue, &error);
  EXPECT(suite && !error);
  wavetracer_kernels_bvh* bvh = traces();
  caches(WAVETRACER_KERNELS_CACHE_CHAINED);
  caches(WAVETRACER_KERNELS_CACHE_OPEN);
  caches(WAVETRACER_KERNELS_CACHE_CONCURRENT);
  own_points(bvh);
  objects_that_move();
  refused_caches();
  wavetracer_kernels_bvh_free(bvh);
  wavetracer_kernels_close(suite);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return 0;
}
